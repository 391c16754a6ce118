/* FMI 3.0 co-simulation over an instance. */
#include "fmi3Functions.h"
#include "instance.h"

#include <string.h>

#define STATUS(expression) ((fmi3Status)(expression))
#define REQUIRE_INSTANCE(c)                                                                                                      \
    struct instance *i = c;                                                                                                      \
    if (!i)                                                                                                                      \
        return fmi3Error;

static void deliver(const struct instance *i, enum status status, const char *category, const char *text)
{
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)i->logger;
    if (logger)
        logger(i->environment, STATUS(status), category, text);
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t intermediate_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)resources, (void)visible, (void)early_return, (void)intermediate, (void)update;
    struct instance refused = {.deliver = deliver, .name = "", .logging = 1};
    refused.logger = (void (*)(void))logger;
    refused.environment = environment;
    if (!name || !*name)
        return report(&refused, ERROR, "%s: the instance needs a name", __func__), NULL;
    if (event_mode || intermediate_count)
        return report(&refused, ERROR, "%s: the unit has no event mode and no intermediate values; ask for neither", __func__), NULL;
    if (!token || strcmp(token, unit.identity) != 0)
        return report(&refused, ERROR, "%s: token %.60s is not %s: library and modelDescription.xml are of two builds", __func__,
                      token ? token : "NULL", unit.identity),
               NULL;
    struct instance *i = new_instance(name);
    if (!i)
        return report(&refused, ERROR, "%s: out of memory", __func__), NULL;
    i->deliver = deliver;
    i->logger = refused.logger;
    i->environment = environment;
    i->logging = logging;
    return i;
}

void fmi3FreeInstance(fmi3Instance c)
{
    if (c)
        free_instance(c);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[])
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_logging(i, on, count, categories));
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop)
{
    REQUIRE_INSTANCE(c)
    (void)has_tolerance, (void)tolerance;
    if (require_phase(i, 1 << INSTANTIATED, __func__) || enter_initialisation(i, __func__, start, has_stop, stop))
        return fmi3Error;
    i->phase = INITIALISING;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c)
{
    REQUIRE_INSTANCE(c)
    return STATUS(exit_initialisation(i, __func__));
}

fmi3Status fmi3Terminate(fmi3Instance c)
{
    REQUIRE_INSTANCE(c)
    return STATUS(terminate(i, __func__));
}

fmi3Status fmi3Reset(fmi3Instance c)
{
    REQUIRE_INSTANCE(c)
    return STATUS(reset(i));
}

#define CALL(kind) &(struct call){__func__, references, reference_count, kind, 1, value_count}, values

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference references[], size_t reference_count, fmi3Float64 values[],
                          size_t value_count)
{
    REQUIRE_INSTANCE(c)
    return STATUS(get_values(i, CALL(REAL)));
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference references[], size_t reference_count,
                          const fmi3Float64 values[], size_t value_count)
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_values(i, CALL(REAL)));
}

fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference references[], size_t reference_count, fmi3Int64 values[],
                        size_t value_count)
{
    REQUIRE_INSTANCE(c)
    return STATUS(get_values(i, CALL(INTEGER_64)));
}

fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference references[], size_t reference_count, const fmi3Int64 values[],
                        size_t value_count)
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_values(i, CALL(INTEGER_64)));
}

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(get_state(i, __func__, state));
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_state(i, __func__, state));
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(free_state(i, __func__, state));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    REQUIRE_INSTANCE(c)
    return STATUS(state_size(i, __func__, state, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    REQUIRE_INSTANCE(c)
    return STATUS(serialise(i, __func__, state, bytes, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(deserialise(i, __func__, bytes, size, state));
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 duration, fmi3Boolean no_return_before,
                      fmi3Boolean *needs_events, fmi3Boolean *terminates, fmi3Boolean *early_return, fmi3Float64 *last_time)
{
    REQUIRE_INSTANCE(c)
    (void)no_return_before;
    fmi3Status status = STATUS(do_step(i, __func__, time, duration));
    if (needs_events)
        *needs_events = fmi3False;
    if (terminates)
        *terminates = i->phase == TERMINATED;
    if (early_return)
        *early_return = fmi3False;
    if (last_time)
        *last_time = i->time;
    return status;
}
