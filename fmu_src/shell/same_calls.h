/* The calls that both versions have under names of their own; included once by the file of each. */
#include "calls.h"
#include "life_cycle.h"
#include "state.h"

const char *FMI(GetVersion)(void)
{
    return FMI(Version);
}

void FMI(FreeInstance)(void *c)
{
    if (c)
        free_instance(c);
}

FORWARD(SetDebugLogging, (void *c, FMI(Boolean) on, size_t count, const FMI(String) categories[]),
        set_logging(i, on, count, categories))
FORWARD(ExitInitializationMode, (void *c), exit_initialisation(i, __func__))
FORWARD(Terminate, (void *c), terminate(i, __func__))
FORWARD(Reset, (void *c), reset(i))

FORWARD(STATE(Get, ), (void *c, void **state), get_state(i, __func__, state))
FORWARD(STATE(Set, ), (void *c, void *state), set_state(i, __func__, state))
FORWARD(STATE(Free, ), (void *c, void **state), free_state(i, __func__, state))
FORWARD(STATE(Serialized, Size), (void *c, void *state, size_t *size), state_size(i, __func__, state, size))
FORWARD(STATE(Serialize, ), (void *c, void *state, FMI(Byte) bytes[], size_t size), serialise(i, __func__, state, bytes, size))
FORWARD(DESERIALISE, (void *c, const FMI(Byte) bytes[], size_t size, void **state),
        deserialise(i, __func__, bytes, size, state))
