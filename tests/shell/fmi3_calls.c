/* What FMI 3.0 has of its own: whole arrays, the time as a variable, early return, intermediate updates, all that is refused. */
#include "fmi3Functions.h"
#include "calls.h"

static void hear(void *environment, fmi3Status status, const char *category, const char *text)
{
    (void)environment, (void)status, (void)category;
    snprintf(said, sizeof said, "%s", text);
}

/* What the importer wishes when it is asked between the parts of a step. */
static struct {
    int asked, wants_early;
    double until;
} wish;

static void between(void *environment, double time, fmi3Boolean set, fmi3Boolean get, fmi3Boolean finished, fmi3Boolean may_return,
                    fmi3Boolean *requested, double *until)
{
    (void)environment, (void)time, (void)set, (void)get, (void)finished, (void)may_return;
    wish.asked++;
    *requested = wish.wants_early;
    *until = wish.until;
}

static fmi3Instance made(int early_return, int updates, fmi3LogMessageCallback logger)
{
    return fmi3InstantiateCoSimulation("three", unit.identity, "", 0, 1, 0, early_return, NULL, 0, NULL, logger, updates ? between : NULL);
}

static fmi3Instance ready(int early_return, int updates)
{
    fmi3Instance c = made(early_return, updates, hear);
    WELL(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0));
    WELL(fmi3ExitInitializationMode(c));
    return c;
}

static fmi3Instance asking_for(const unsigned *intermediate, size_t count, int events, int updates)
{
    return fmi3InstantiateCoSimulation("a", unit.identity, "", 0, 1, events, 0, intermediate, count, NULL, hear, updates ? between : NULL);
}

static void starts(void)
{
    int pauses = unit.pause_cell >= 0;
    IS(strcmp(fmi3GetVersion(), "3.0") == 0);
    fmi3FreeInstance(NULL);
    const unsigned known = AT_ANSWER, unknown = unit.cell_count + 9;
    fmi3Instance c = made(0, 0, NULL);
    SAYS(3, NULL, fmi3ExitInitializationMode(c));
    fmi3FreeInstance(c);
    SAYS(1, "no event mode", asking_for(NULL, 0, 1, 0) == NULL);
    SAYS(1, pauses ? "no callback" : "no intermediate values", asking_for(&known, 1, 0, 0) == NULL);
    SAYS(1, pauses ? "does not know" : "no intermediate values", asking_for(NULL, 1, 0, 1) == NULL);
    SAYS(1, pauses ? "does not know" : "no intermediate values", asking_for(&unknown, 1, 0, 1) == NULL);
    c = asking_for(&known, 1, 0, 1);
    IS((c != NULL) == pauses);
    fmi3FreeInstance(c);
    c = made(0, 0, hear);
    FAILS("start time of inf", fmi3EnterInitializationMode(c, 0, 0.0, INFINITY, 0, 0.0));
    WELL(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 1, 1.0));
    FAILS("in initialisation mode", fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0));
    fmi3FreeInstance(c);
    SAYS(1, "model exchange", fmi3InstantiateModelExchange("a", unit.identity, "", 0, 1, NULL, hear) == NULL);
    IS(fmi3InstantiateModelExchange("a", unit.identity, "", 0, 1, NULL, NULL) == NULL);
    SAYS(1, "scheduled", fmi3InstantiateScheduledExecution("a", unit.identity, "", 0, 1, NULL, hear, NULL, NULL, NULL) == NULL);
    IS(fmi3InstantiateScheduledExecution("a", unit.identity, "", 0, 1, NULL, NULL, NULL, NULL, NULL) == NULL);
}

static void values(void)
{
    fmi3Instance c = ready(0, 0);
    double real[16];
    int64_t whole[2] = {5, 0};
    WELL(fmi3GetFloat64(c, LIST(AT_FAR_FIELD, unit.cell_count, AT_PUSH), real, 8));
    FAILS("have 6 values, 5 were given", fmi3GetFloat64(c, LIST(AT_FAR_FIELD), real, 5));
    FAILS("have 1 values, 0 were given", fmi3GetFloat64(c, LIST(AT_PUSH), real, 0));
    FAILS("no variable", fmi3GetFloat64(c, LIST(AT_FAR_FIELD + 1), real, 1));
    FAILS("no variable", fmi3GetInt64(c, LIST(unit.cell_count), whole, 1));
    WELL(fmi3GetFloat64(c, LIST(AT_PROFILE), real, 4));
    FAILS("profile[1] is an output", fmi3SetFloat64(c, LIST(AT_PROFILE), REALS(0, 0, 0, 0), 4));
    FAILS("the time is set by steps", fmi3SetFloat64(c, LIST(unit.cell_count), REALS(0), 1));
    WELL(fmi3SetInt64(c, LIST(AT_NUMBER), whole, 1));
    WELL(fmi3GetInt64(c, LIST(AT_NUMBER), whole, 1));
    IS(whole[0] == 5);
    fmi3FreeInstance(c);
}

static void derivatives(void)
{
    fmi3Instance c = ready(0, 0);
    double slopes[6], seed[6] = {1, 0, 0, 0, 0, 2};
    FAILS("time cannot be an unknown", fmi3GetDirectionalDerivative(c, LIST(unit.cell_count), LIST(AT_PUSH), seed, 1, slopes, 1));
    WELL(fmi3GetDirectionalDerivative(c, LIST(AT_ANSWERS), LIST(AT_FAR_FIELD), seed, 6, slopes, 6));
    IS(fabs(slopes[0] - 1.0) < 1e-12 && slopes[1] == 0.0 && fabs(slopes[5] - 2.0) < 1e-12);
    fmi3FreeInstance(c);
}

static int step_to(fmi3Instance c, double time, double duration, int *early, double *last)
{
    fmi3Boolean events, terminates, returned;
    int status = fmi3DoStep(c, time, duration, 1, &events, &terminates, &returned, last);
    *early = returned;
    return status;
}

static void parts(void)
{
    int early, asked = unit.pause_cell >= 0 ? 4 : 0;
    double last;
    int64_t mode = 5;
    /* With a callback, which is asked after each part. */
    fmi3Instance c = ready(1, 1);
    WELL(fmi3SetInt64(c, LIST(AT_MODE), &mode, 1));
    wish.asked = wish.wants_early = 0;
    SAYS(0, unit.caution_count ? "at once" : NULL, step_to(c, 0.0, 1e-3, &early, &last));
    IS(wish.asked == asked && !early && last == 1e-3);
    if (unit.pause_cell >= 0) {
        /* At once, between two parts, within the next one, later than the end. */
        const double until[] = {0.0, 1.25e-3, 1.3e-3, 9.0};
        const double ends[] = {1.25e-3, 1.25e-3, 1.3e-3, 2e-3};
        for (int k = 0; k < 4; k++) {
            fmi3FMUState state = NULL;
            WELL(fmi3GetFMUState(c, &state));
            wish.wants_early = 1, wish.until = until[k];
            WELL(step_to(c, 1e-3, 1e-3, &early, &last));
            IS(fabs(last - ends[k]) < 1e-12 && early == (k < 3));
            WELL(fmi3SetFMUState(c, state));
            WELL(fmi3FreeFMUState(c, &state));
        }
    }
    fmi3FreeInstance(c);
    /* One who must not return early is asked, and goes on. */
    c = ready(0, 1);
    WELL(fmi3SetInt64(c, LIST(AT_MODE), &mode, 1));
    wish.wants_early = 1, wish.until = 0.0;
    SAYS(0, unit.caution_count ? "at once" : NULL, step_to(c, 0.0, 1e-3, &early, &last));
    IS(!early && last == 1e-3);
    fmi3FreeInstance(c);
    /* Without a callback: early where a judgement changes, if that is allowed. */
    for (int may = 0; may < 2; may++) {
        c = ready(may, 0);
        WELL(fmi3SetInt64(c, LIST(AT_MODE), &mode, 1));
        SAYS(0, unit.caution_count ? "at once" : NULL, step_to(c, 0.0, 1e-3, &early, &last));
        IS(early == (may && unit.pause_cell >= 0) && last == (early ? 0.25e-3 : 1e-3));
        fmi3FreeInstance(c);
    }
    /* A warning in the first part stays; a fault ends the step. */
    c = ready(1, 1);
    WELL(fmi3SetInt64(c, LIST(AT_MODE), &mode, 1));
    wish.wants_early = 0;
    WARNS(unit.caution_count ? "at once" : "present state", step_to(c, 0.5, 1e-3, &early, &last));
    mode = 3;
    WELL(fmi3SetInt64(c, LIST(AT_MODE), &mode, 1));
    DISCARDS("code 99", fmi3DoStep(c, 0.501, 1e-3, 1, NULL, NULL, NULL, NULL));
    fmi3FreeInstance(c);
}

#define REFUSED_TYPE(type)                                                                       \
    FAILS("no " #type " variables", fmi3Get##type(c, &reference, 1, (fmi3##type *)place, 1));    \
    FAILS("no " #type " variables", fmi3Set##type(c, &reference, 1, (fmi3##type *)place, 1));    \
    WELL(fmi3Get##type(c, &reference, 0, (fmi3##type *)place, 0));                               \
    WELL(fmi3Set##type(c, &reference, 0, (fmi3##type *)place, 0));

static void refusals(void)
{
    fmi3Instance c = ready(0, 0);
    const unsigned reference = 0;
    union { double real; void *pointer; uint64_t word; } place[4] = {{0.0}};
    double real[2] = {0.0, 0.0};
    size_t size = 0;
    fmi3Boolean b = 0;
    fmi3Int32 order = 1;
    fmi3Clock clock = 0;
    fmi3UInt64 counter = 1;
    fmi3IntervalQualifier qualifier;
    fmi3DependencyKind kind;
    unsigned found;
    REFUSED_TYPE(Float32)
    REFUSED_TYPE(Int8)
    REFUSED_TYPE(UInt8)
    REFUSED_TYPE(Int16)
    REFUSED_TYPE(UInt16)
    REFUSED_TYPE(Int32)
    REFUSED_TYPE(UInt32)
    REFUSED_TYPE(UInt64)
    REFUSED_TYPE(Boolean)
    REFUSED_TYPE(String)
    FAILS("Binary", fmi3GetBinary(c, &reference, 1, &size, (fmi3Binary *)place, 1));
    FAILS("Binary", fmi3SetBinary(c, &reference, 1, &size, (fmi3Binary *)place, 1));
    FAILS("clocks", fmi3GetClock(c, &reference, 1, &clock));
    FAILS("clocks", fmi3SetClock(c, &reference, 1, &clock));
    FAILS("clocks", fmi3GetIntervalDecimal(c, &reference, 1, real, &qualifier));
    FAILS("clocks", fmi3GetIntervalFraction(c, &reference, 1, &counter, &counter, &qualifier));
    FAILS("clocks", fmi3GetShiftDecimal(c, &reference, 1, real));
    FAILS("clocks", fmi3GetShiftFraction(c, &reference, 1, &counter, &counter));
    FAILS("clocks", fmi3SetIntervalDecimal(c, &reference, 1, real));
    FAILS("clocks", fmi3SetIntervalFraction(c, &reference, 1, &counter, &counter));
    FAILS("clocks", fmi3SetShiftDecimal(c, &reference, 1, real));
    FAILS("clocks", fmi3SetShiftFraction(c, &reference, 1, &counter, &counter));
    FAILS("output derivatives", fmi3GetOutputDerivatives(c, &reference, 1, &order, real, 1));
    FAILS("adjoint", fmi3GetAdjointDerivative(c, &reference, 1, &reference, 1, real, 1, real, 1));
    FAILS("dependencies", fmi3GetNumberOfVariableDependencies(c, reference, &size));
    FAILS("dependencies", fmi3GetVariableDependencies(c, reference, &size, &found, &size, &kind, 1));
    FAILS("structural", fmi3EnterConfigurationMode(c));
    FAILS("structural", fmi3ExitConfigurationMode(c));
    FAILS("event mode", fmi3EnterEventMode(c));
    FAILS("event mode", fmi3EnterStepMode(c));
    FAILS("event mode", fmi3EvaluateDiscreteStates(c));
    FAILS("event mode", fmi3UpdateDiscreteStates(c, &b, &b, &b, &b, &b, real));
    FAILS("scheduled", fmi3ActivateModelPartition(c, reference, 0.0));
    FAILS("model exchange", fmi3EnterContinuousTimeMode(c));
    FAILS("model exchange", fmi3CompletedIntegratorStep(c, 1, &b, &b));
    FAILS("model exchange", fmi3SetTime(c, 0.0));
    FAILS("model exchange", fmi3SetContinuousStates(c, real, 1));
    FAILS("model exchange", fmi3GetContinuousStates(c, real, 1));
    FAILS("model exchange", fmi3GetContinuousStateDerivatives(c, real, 1));
    FAILS("model exchange", fmi3GetNominalsOfContinuousStates(c, real, 1));
    FAILS("model exchange", fmi3GetEventIndicators(c, real, 1));
    FAILS("model exchange", fmi3GetNumberOfEventIndicators(c, &size));
    FAILS("model exchange", fmi3GetNumberOfContinuousStates(c, &size));
    fmi3FreeInstance(c);
}

static void of_both_versions(void)
{
    fmi3Instance c = ready(0, 0);
    fmi3FMUState state = NULL, other = NULL;
    size_t size;
    WELL(fmi3GetFMUState(c, &state));
    WELL(fmi3SerializedFMUStateSize(c, state, &size));
    unsigned char *bytes = malloc(size);
    WELL(fmi3SerializeFMUState(c, state, bytes, size));
    WELL(fmi3DeserializeFMUState(c, bytes, size, &other));
    WELL(fmi3SetFMUState(c, other));
    WELL(fmi3FreeFMUState(c, &state));
    WELL(fmi3SetDebugLogging(c, 1, 0, NULL));
    WELL(fmi3Terminate(c));
    WELL(fmi3Reset(c));
    free(bytes);
    fmi3FreeInstance(c);
    double real;
    int64_t whole;
    IS(fmi3SetDebugLogging(NULL, 1, 0, NULL) == fmi3Error && fmi3Terminate(NULL) == fmi3Error && fmi3Reset(NULL) == fmi3Error);
    IS(fmi3EnterInitializationMode(NULL, 0, 0, 0, 0, 0) == fmi3Error && fmi3ExitInitializationMode(NULL) == fmi3Error);
    IS(fmi3GetFMUState(NULL, &state) == fmi3Error && fmi3SetFMUState(NULL, state) == fmi3Error && fmi3FreeFMUState(NULL, &state) == fmi3Error);
    IS(fmi3SerializedFMUStateSize(NULL, state, &size) == fmi3Error && fmi3SerializeFMUState(NULL, state, NULL, 0) == fmi3Error);
    IS(fmi3DeserializeFMUState(NULL, NULL, 0, &state) == fmi3Error);
    IS(fmi3GetFloat64(NULL, NULL, 0, &real, 0) == fmi3Error && fmi3SetFloat64(NULL, NULL, 0, &real, 0) == fmi3Error);
    IS(fmi3GetInt64(NULL, NULL, 0, &whole, 0) == fmi3Error && fmi3SetInt64(NULL, NULL, 0, &whole, 0) == fmi3Error);
    IS(fmi3GetDirectionalDerivative(NULL, NULL, 0, NULL, 0, NULL, 0, NULL, 0) == fmi3Error);
    IS(fmi3DoStep(NULL, 0.0, 1.0, 1, NULL, NULL, NULL, NULL) == fmi3Error);
}

void call_fmi3(void)
{
    starts();
    values();
    derivatives();
    parts();
    refusals();
    of_both_versions();
}
