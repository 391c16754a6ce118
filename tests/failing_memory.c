/* A unit's life with each of its allocations failing once: a message and an error, the values as they were, nothing leaked (sanitizers).
 *
 * Linked with --wrap=malloc --wrap=calloc; prints how many allocations there are.
 */
#include "fmi2Functions.h"
#include "unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static long countdown = -1; /* allocations until one fails; below 0 none does */
static unsigned failed, messages, refused;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);

static int fails(void)
{
    if (countdown < 0 || countdown-- != 0)
        return 0;
    failed++;
    return 1;
}

void *__wrap_malloc(size_t size) { return fails() ? NULL : __real_malloc(size); }
void *__wrap_calloc(size_t count, size_t size) { return fails() ? NULL : __real_calloc(count, size); }

static void say(void *e, const char *n, fmi2Status status, const char *c, const char *text, ...)
{
    (void)e, (void)n, (void)c;
    messages += status >= fmi2Error && strlen(text) > 10;
}

static const fmi2CallbackFunctions CALLBACKS = {say, calloc, free, NULL, NULL};

static void complain(const char *what)
{
    fprintf(stderr, "%s\n", what);
    exit(1);
}

/* A call that fails says why, and is good when it is repeated. */
#define TRY(call)                                            \
    do {                                                     \
        unsigned before = failed, said = messages;           \
        if ((call) > fmi2Warning) {                          \
            refused++;                                       \
            if (failed == before || messages == said)        \
                complain("an error without reason: " #call); \
            if ((call) > fmi2Warning)                        \
                complain("refused again: " #call);           \
        }                                                    \
    } while (0)

static void live(double *last)
{
    const struct variable *v = unit.variables;
    while (v->role != OUTPUT || v->is_integer)
        v++;
    fmi2ValueReference reference = v->first;
    fmi2FMUstate state = NULL, other = NULL;
    size_t size = 0;
    fmi2Component unit = fmi2Instantiate("a", fmi2CoSimulation, GUID, "", &CALLBACKS, 0, 1);
    if (!unit) {
        refused++;
        unit = fmi2Instantiate("a", fmi2CoSimulation, GUID, "", &CALLBACKS, 0, 1);
        if (!unit)
            complain("not instantiated");
    }
    TRY(fmi2SetupExperiment(unit, 0, 0.0, 0.0, 0, 0.0));
    TRY(fmi2EnterInitializationMode(unit));
    TRY(fmi2GetReal(unit, &reference, 1, last));
    TRY(fmi2ExitInitializationMode(unit));
    TRY(fmi2DoStep(unit, 0.0, 1e-3, 1));
    TRY(fmi2GetFMUstate(unit, &state));
    TRY(fmi2SerializedFMUstateSize(unit, state, &size));
    char *block = __real_malloc(size);
    TRY(fmi2SerializeFMUstate(unit, state, block, size));
    TRY(fmi2DoStep(unit, 1e-3, 1e-3, 1));
    TRY(fmi2DeSerializeFMUstate(unit, block, size, &other));
    TRY(fmi2SetFMUstate(unit, other));
    TRY(fmi2DoStep(unit, 1e-3, 1e-3, 1));
    TRY(fmi2FreeFMUstate(unit, &other));
    TRY(fmi2Reset(unit));
    TRY(fmi2SetupExperiment(unit, 0, 0.0, 0.0, 0, 0.0));
    TRY(fmi2EnterInitializationMode(unit));
    TRY(fmi2ExitInitializationMode(unit));
    TRY(fmi2DoStep(unit, 0.0, 1e-3, 1));
    TRY(fmi2GetReal(unit, &reference, 1, last));
    fmi2FreeInstance(unit);
    free(block);
}

int main(void)
{
    double right, found;
    live(&right);
    long n = 0;
    for (;; n++) {
        unsigned before = failed;
        countdown = n;
        live(&found);
        if (failed == before)
            break;
        if (memcmp(&right, &found, sizeof right) != 0)
            complain("another result after an allocation that failed");
    }
    printf("%ld allocations, %u refusals\n", n, refused);
    return 0;
}
