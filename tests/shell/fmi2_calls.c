/* Every decision of the C shell, each way: calls on a unit without physics (shell_unit.py), their statuses and words.
 *
 * Linked with --wrap=malloc --wrap=calloc.  Exit code 1 at the first call that does not do what it should.
 */
#include "fmi2Functions.h"
#include "calls.h"

char said[8192];
int countdown = NEVER;
static unsigned long calls;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_malloc(size_t size) { return countdown != NEVER && countdown-- == 0 ? NULL : __real_malloc(size); }
void *__wrap_calloc(size_t count, size_t size) { return countdown != NEVER && countdown-- == 0 ? NULL : __real_calloc(count, size); }

static void hear2(void *environment, const char *name, fmi2Status status, const char *category, const char *text, ...)
{
    (void)environment, (void)name, (void)status, (void)category;
    snprintf(said, sizeof said, "%s", text);
}
static const fmi2CallbackFunctions HEARD = {hear2, calloc, free, NULL, NULL}, UNHEARD = {NULL, calloc, free, NULL, NULL};

void expect(int status, int right, const char *words, const char *call, int line)
{
    calls++;
    if (status == right && (words ? strstr(said, words) != NULL : !*said))
        return;
    fprintf(stderr, "line %d: %s gives %d, not %d (%s), and says \"%s\"\n", line, call, status, right, words ? words : "nothing", said);
    exit(1);
}

static void set_mode(fmi2Component c, int mode)
{
    unsigned reference = AT_MODE;
    WELL(fmi2SetInteger(c, &reference, 1, &mode));
}

static fmi2Component new2(void)
{
    return fmi2Instantiate("two", fmi2CoSimulation, unit.identity, "", &HEARD, 0, 1);
}

fmi2Component ready2(void)
{
    fmi2Component c = new2();
    WELL(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0));
    WELL(fmi2EnterInitializationMode(c));
    WELL(fmi2ExitInitializationMode(c));
    return c;
}

static void starts(void)
{
    IS(fmi2Instantiate("a", fmi2CoSimulation, unit.identity, "", NULL, 0, 1) == NULL);
    SAYS(1, "needs a name", fmi2Instantiate("", fmi2CoSimulation, unit.identity, "", &HEARD, 0, 1) == NULL);
    SAYS(1, "needs a name", fmi2Instantiate(NULL, fmi2CoSimulation, unit.identity, "", &HEARD, 0, 1) == NULL);
    SAYS(1, "not one for model exchange", fmi2Instantiate("a", fmi2ModelExchange, unit.identity, "", &HEARD, 0, 1) == NULL);
    SAYS(1, "of two builds", fmi2Instantiate("a", fmi2CoSimulation, "{100%}", "", &HEARD, 0, 1) == NULL);
    SAYS(1, "{100%%}", fmi2Instantiate("a", fmi2CoSimulation, "{100%}", "", &HEARD, 0, 1) == NULL);
    SAYS(1, "NULL", fmi2Instantiate("a", fmi2CoSimulation, NULL, "", &HEARD, 0, 1) == NULL);
    IS(fmi2Instantiate("a", fmi2CoSimulation, NULL, "", &UNHEARD, 0, 1) == NULL);
    for (int n = 0; n < 4; n++) {
        countdown = n;
        SAYS(1, "out of memory", new2() == NULL);
    }
    countdown = NEVER;
    IS(strcmp(fmi2GetVersion(), "2.0") == 0);
    IS(strcmp(fmi2GetTypesPlatform(), "default") == 0);
    fmi2FreeInstance(NULL);

    fmi2Component c = new2();
    FAILS("fmi2SetupExperiment first", fmi2EnterInitializationMode(c));
    FAILS("before initialisation", fmi2ExitInitializationMode(c));
    FAILS("before initialisation", fmi2Terminate(c));
    FAILS("start time of nan s", fmi2SetupExperiment(c, 0, 0.0, NAN, 0, 0.0));
    FAILS("lies before", fmi2SetupExperiment(c, 0, 0.0, 1.0, 1, 0.5));
    WELL(fmi2SetupExperiment(c, 0, 0.0, 0.0, 1, 1.0));
    WELL(fmi2EnterInitializationMode(c));
    FAILS("not allowed in initialisation mode", fmi2EnterInitializationMode(c));
    FAILS("not allowed in initialisation mode", fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0));
    set_mode(c, 4);
    FAILS("answers is not finite after initialisation", fmi2ExitInitializationMode(c));
    set_mode(c, 3);
    FAILS("failed with code 99", fmi2ExitInitializationMode(c));
    set_mode(c, 0);
    WELL(fmi2ExitInitializationMode(c));
    WELL(fmi2Terminate(c));
    FAILS("after termination", fmi2Terminate(c));
    FAILS("after termination", fmi2SetReal(c, LIST(AT_PUSH), REALS(1.0)));
    WELL(fmi2Reset(c));
    fmi2FreeInstance(c);
}

static void messages_of_an_instance(void)
{
    fmi2Component c = new2(), quiet = fmi2Instantiate("a", fmi2CoSimulation, unit.identity, "", &HEARD, 0, 0);
    fmi2String error = "logStatusError", warning = "logStatusWarning", none = NULL, unknown = "none";
    fmi2String all[] = {"logStatusError", "logAll", "never looked at"};
    /* Without debug logging errors alone are told, switched off nothing is. */
    FAILS("not allowed", fmi2Terminate(quiet));
    WELL(fmi2SetupExperiment(quiet, 0, 0.0, 0.0, 0, 0.0));
    WELL(fmi2EnterInitializationMode(quiet));
    WELL(fmi2ExitInitializationMode(quiet));
    SAYS(1, NULL, fmi2DoStep(quiet, 0.5, 1e-3, 1));
    /* The first refused step is told, the second is not. */
    set_mode(quiet, 3);
    DISCARDS("code 99", fmi2DoStep(quiet, 0.501, 1e-3, 1));
    SAYS(2, NULL, fmi2DoStep(quiet, 0.501, 5e-4, 1));
    WELL(fmi2SetDebugLogging(quiet, 0, 0, NULL));
    SAYS(3, NULL, fmi2ExitInitializationMode(quiet));
    fmi2FreeInstance(quiet);
    FAILS("none given", fmi2SetDebugLogging(c, 1, 1, NULL));
    FAILS("no log category none", fmi2SetDebugLogging(c, 1, 1, &unknown));
    FAILS("no log category NULL", fmi2SetDebugLogging(c, 1, 1, &none));
    WELL(fmi2SetDebugLogging(c, 1, 1, &warning));
    SAYS(3, NULL, fmi2Terminate(c));
    WELL(fmi2SetDebugLogging(c, 1, 1, &error));
    FAILS("not allowed", fmi2Terminate(c));
    WELL(fmi2SetDebugLogging(c, 1, 3, all));
    FAILS("not allowed", fmi2Terminate(c));
    WELL(fmi2SetDebugLogging(c, 1, 0, NULL));
    FAILS("not allowed", fmi2Terminate(c));
    fmi2FreeInstance(c);
}

static void values(void)
{
    fmi2Component c = new2();
    double real[8];
    int integer[2];
    unsigned most = unit.cell_count + 7;
    WELL(fmi2GetReal(c, NULL, 0, NULL));
    FAILS("an array is missing", fmi2GetReal(c, NULL, 1, real));
    FAILS("an array is missing", fmi2GetReal(c, LIST(AT_PUSH), NULL));
    FAILS("no variable with value reference", fmi2GetReal(c, &most, 1, real));
    FAILS("no variable with value reference", fmi2GetReal(c, LIST(AT_PUSH, AT_MEMORY), real));
    FAILS("no variable with value reference", fmi2GetReal(c, LIST(AT_PROFILE + 1), real));
    FAILS("no variable with value reference", fmi2GetReal(c, LIST(unit.cell_count), real));
    FAILS("is a real: use", fmi2GetInteger(c, LIST(AT_FAR_FIELD + 4), integer));
    FAILS("far.field[2,2] is a real", fmi2GetInteger(c, LIST(AT_FAR_FIELD + 4), integer));
    FAILS("mode is an integer or enumeration", fmi2GetReal(c, LIST(AT_MODE), real));
    /* A name longer than the room for it is cut. */
    FAILS("xxxxxx is an output", fmi2SetReal(c, LIST(AT_COUNT + 1), REALS(1.0)));
    WELL(fmi2GetInteger(c, LIST(AT_NUMBER), integer));
    IS(integer[0] == 3);
    WELL(fmi2SetReal(c, LIST(AT_FAR_FIELD, AT_FAR_FIELD + 1, AT_FAR_FIELD + 2, AT_FAR_FIELD + 5, AT_FAR_FIELD, AT_PUSH), REALS(1, 2, 3, 6, 1, 4)));
    WELL(fmi2GetReal(c, LIST(AT_PUSH, AT_FAR_FIELD, AT_FAR_FIELD + 1, AT_FAR_FIELD + 2, AT_FAR_FIELD + 3, AT_FAR_FIELD + 4, AT_FAR_FIELD + 5, AT_STIFFNESS), real));
    IS(real[0] == 4 && real[1] == 1 && real[3] == 3 && real[4] == 0 && real[6] == 6 && real[7] == 1);
    /* Neighbours beyond the end of a variable are another's. */
    WELL(fmi2GetReal(c, LIST(AT_FAR_FIELD + 4, AT_FAR_FIELD + 5, AT_STIFFNESS), real));
    IS(real[1] == 6 && real[2] == 1);
    FAILS("no variable with value reference", fmi2SetReal(c, &most, 1, real));
    FAILS("cannot be set", fmi2SetReal(c, LIST(AT_ANSWER), REALS(1.0)));
    FAILS("push = nan N is not a finite number", fmi2SetReal(c, LIST(AT_PUSH), REALS(NAN)));
    FAILS("push = inf N", fmi2SetReal(c, LIST(AT_PUSH), REALS(INFINITY)));
    FAILS("gain = -inf is not a finite number; give a value in 1", fmi2SetReal(c, LIST(AT_GAIN), REALS(-INFINITY)));
    FAILS("push = 11 N is out of range", fmi2SetReal(c, LIST(AT_PUSH), REALS(11.0)));
    FAILS("push = -11 N is out of range", fmi2SetReal(c, LIST(AT_PUSH), REALS(-11.0)));
    integer[0] = 99;
    FAILS("number = 99 is out of range", fmi2SetInteger(c, LIST(AT_NUMBER), integer));
    FAILS("mode = 99 is not one of 0 (still)", fmi2SetInteger(c, LIST(AT_MODE), integer));

    WELL(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0));
    WELL(fmi2GetReal(c, LIST(AT_ANSWER), real));
    IS(real[0] == 0.0);
    WELL(fmi2EnterInitializationMode(c));
    WELL(fmi2GetReal(c, LIST(AT_PUSH), real));
    WELL(fmi2GetReal(c, LIST(AT_ANSWER), real));
    IS(real[0] == 8.0 + 1e-4);
    WELL(fmi2GetReal(c, LIST(AT_ANSWER), real));
    set_mode(c, 3);
    FAILS("code 99", fmi2GetReal(c, LIST(AT_ANSWER), real));
    FAILS("code 99", fmi2GetReal(c, LIST(AT_ANSWER), real));
    set_mode(c, 0);
    WELL(fmi2SetReal(c, LIST(AT_STIFFNESS), REALS(2.0)));
    WELL(fmi2ExitInitializationMode(c));
    WELL(fmi2SetReal(c, LIST(AT_PUSH, AT_GAIN), REALS(2.0, 1.0)));
    FAILS("stiffness is fixed once", fmi2SetReal(c, LIST(AT_STIFFNESS), REALS(3.0)));
    fmi2FreeInstance(c);
}

static void steps(void)
{
    fmi2Component c = new2();
    FAILS("before initialisation", fmi2DoStep(c, 0.0, 1e-3, 1));
    WELL(fmi2SetupExperiment(c, 0, 0.0, 0.0, 1, 1.0));
    WELL(fmi2EnterInitializationMode(c));
    WELL(fmi2ExitInitializationMode(c));
    FAILS("communication point of inf s", fmi2DoStep(c, INFINITY, 1e-3, 1));
    FAILS("communication step of 0 s", fmi2DoStep(c, 0.0, 0.0, 1));
    FAILS("communication step of 3601 s", fmi2DoStep(c, 0.0, 3601.0, 1));
    FAILS("beyond the stop time", fmi2DoStep(c, 0.0, 1.1, 1));
    WARNS(unit.caution_count ? "said at once" : "starts from the present state", fmi2DoStep(c, 0.5, 1e-3, 1));
    WARNS("starts from the present state", fmi2DoStep(c, 0.6, 1e-3, 1));
    WELL(fmi2DoStep(c, 0.601, 1e-3, 1));
    set_mode(c, 6);
    if (unit.caution_count)
        SAYS(0, "the first caution", fmi2DoStep(c, 0.602, 1e-3, 1));
    else
        WELL(fmi2DoStep(c, 0.602, 1e-3, 1));
    WELL(fmi2DoStep(c, 0.603, 1e-3, 1));
    set_mode(c, 1);
    DISCARDS(unit.fault_count ? "push of 0 N in mode 1" : "code 1", fmi2DoStep(c, 0.604, 1e-3, 1));
    set_mode(c, 2);
    DISCARDS(unit.fault_count ? "word word" : "code 2", fmi2DoStep(c, 0.604, 1e-3, 1));
    set_mode(c, 3);
    DISCARDS("code 99", fmi2DoStep(c, 0.604, 1e-3, 1));
    set_mode(c, 4);
    DISCARDS("would make answers infinite", fmi2DoStep(c, 0.604, 1e-3, 1));
    fmi2FreeInstance(c);
    /* A refused step once more: with another input, at another time, shorter, and then unchanged, which ends the unit. */
    c = ready2();
    set_mode(c, 1);
    SAYS(2, unit.fault_count ? "in mode 1" : "code 1", fmi2DoStep(c, 0.0, 1e-3, 1));
    set_mode(c, 3);
    DISCARDS("code 99", fmi2DoStep(c, 0.0, 1e-3, 1));
    DISCARDS("code 99", fmi2DoStep(c, 0.1, 1e-3, 1));
    DISCARDS("code 99", fmi2DoStep(c, 0.1, 5e-4, 1));
    DISCARDS("the same step of 0.0005 s was asked for again: the unit is terminated", fmi2DoStep(c, 0.1, 5e-4, 1));
    FAILS("fmi2DoStep", fmi2DoStep(c, 0.1, 5e-4, 1));
    fmi2FreeInstance(c);
    c = ready2();
    set_mode(c, 3);
    DISCARDS("code 99", fmi2DoStep(c, 0.0, 1e-3, 1));
    DISCARDS("terminated", fmi2DoStep(c, 0.0, 1e-3, 1));
    WELL(fmi2Terminate(c));
    fmi2FreeInstance(c);
}

static void questions(void)
{
    fmi2Component c = ready2();
    fmi2Status status;
    double real = 0.0;
    int boolean = 0, integer = 1;
    fmi2String string = NULL;
    unsigned reference = 0;
    (void)status;
    WELL(fmi2GetStatus(c, fmi2DoStepStatus, &status));
    FAILS("no status of this kind", fmi2GetStatus(c, fmi2Terminated, &status));
    FAILS("no status of this kind", fmi2GetStatus(c, fmi2DoStepStatus, NULL));
    WELL(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &real));
    FAILS("no real status", fmi2GetRealStatus(c, fmi2Terminated, &real));
    FAILS("no real status", fmi2GetRealStatus(c, fmi2LastSuccessfulTime, NULL));
    WELL(fmi2GetBooleanStatus(c, fmi2Terminated, &boolean));
    FAILS("no Boolean status", fmi2GetBooleanStatus(c, fmi2PendingStatus, &boolean));
    FAILS("no Boolean status", fmi2GetBooleanStatus(c, fmi2Terminated, NULL));
    WELL(fmi2GetStringStatus(c, fmi2PendingStatus, &string));
    FAILS("no string status", fmi2GetStringStatus(c, fmi2Terminated, &string));
    FAILS("no string status", fmi2GetStringStatus(c, fmi2PendingStatus, NULL));
    FAILS("no Boolean variables", fmi2GetBoolean(c, &reference, 1, &boolean));
    WELL(fmi2GetBoolean(c, &reference, 0, &boolean));
    FAILS("no Boolean variables", fmi2SetBoolean(c, &reference, 1, &boolean));
    FAILS("no String variables", fmi2GetString(c, &reference, 1, &string));
    FAILS("no String variables", fmi2SetString(c, &reference, 1, &string));
    FAILS("no input derivatives", fmi2SetRealInputDerivatives(c, &reference, 1, &integer, &real));
    FAILS("no output derivatives", fmi2GetRealOutputDerivatives(c, &reference, 1, &integer, &real));
    FAILS("no integer status", fmi2GetIntegerStatus(c, fmi2DoStepStatus, &integer));
    FAILS("no step in progress", fmi2CancelStep(c));
    IS(fmi2GetBoolean(NULL, &reference, 1, &boolean) == fmi2Error);
    fmi2FreeInstance(c);
}

static double derived(fmi2Component c, unsigned known, double seed)
{
    double slope = NAN;
    WELL(fmi2GetDirectionalDerivative(c, LIST(AT_ANSWER), LIST(known), &seed, &slope));
    return slope;
}

static void derivatives2(void)
{
    fmi2Component c = new2();
    double slope[2];
    FAILS("before initialisation", fmi2GetDirectionalDerivative(c, LIST(AT_ANSWER), LIST(AT_PUSH), REALS(1), slope));
    fmi2FreeInstance(c);
    c = ready2();
    FAILS("push cannot be an unknown", fmi2GetDirectionalDerivative(c, LIST(AT_PUSH), LIST(AT_PUSH), REALS(1), slope));
    FAILS("answer cannot be a known", fmi2GetDirectionalDerivative(c, LIST(AT_ANSWER), LIST(AT_ANSWER), REALS(1), slope));
    FAILS("no variable", fmi2GetDirectionalDerivative(c, LIST(AT_MEMORY), LIST(AT_PUSH), REALS(1), slope));
    FAILS("seed 0 of inf", fmi2GetDirectionalDerivative(c, LIST(AT_ANSWER), LIST(AT_PUSH), REALS(INFINITY), slope));
    IS(fabs(derived(c, AT_PUSH, 1.0) - 2.0) < 1e-12);
    IS(fabs(derived(c, AT_PUSH, -3.0) + 6.0) < 1e-12);
    IS(derived(c, AT_PUSH, 0.0) == 0.0);
    IS(derived(c, AT_GAIN, 1.0) == 0.0);
    WELL(fmi2SetReal(c, LIST(AT_PUSH), REALS(10.0)));
    IS(fabs(derived(c, AT_PUSH, 1.0) - 2.0) < 1e-10);
    WELL(fmi2SetReal(c, LIST(AT_PUSH), REALS(-10.0)));
    IS(fabs(derived(c, AT_PUSH, 1.0) - 2.0) < 1e-10);
    IS(fabs(derived(c, AT_TIGHT, 1.0) - 1.0) < 1e-9);
    DISCARDS("no room to change", fmi2GetDirectionalDerivative(c, LIST(AT_ANSWER), LIST(AT_STUCK), REALS(1), slope));
    WELL(fmi2GetDirectionalDerivative(c, LIST(AT_ANSWERS + 1, AT_ANSWERS + 5), LIST(AT_PUSH, AT_FAR_FIELD + 1), REALS(1, 1), slope));
    IS(fabs(slope[0] - 2.0) < 1e-10 && fabs(slope[1] - 5.0) < 1e-10);
    WELL(fmi2SetReal(c, LIST(AT_PUSH), REALS(0.0)));
    set_mode(c, 7);
    DISCARDS("no equilibrium here", fmi2GetDirectionalDerivative(c, LIST(AT_ANSWER), LIST(AT_PUSH), REALS(1), slope));
    fmi2FreeInstance(c);
}

static void without_an_instance(void)
{
    fmi2FMUstate state = NULL;
    fmi2Status status;
    double real;
    int whole;
    size_t size;
    fmi2String text;
    IS(fmi2SetDebugLogging(NULL, 1, 0, NULL) == fmi2Error && fmi2SetupExperiment(NULL, 0, 0.0, 0.0, 0, 0.0) == fmi2Error);
    IS(fmi2EnterInitializationMode(NULL) == fmi2Error && fmi2ExitInitializationMode(NULL) == fmi2Error);
    IS(fmi2Terminate(NULL) == fmi2Error && fmi2Reset(NULL) == fmi2Error && fmi2DoStep(NULL, 0.0, 1.0, 1) == fmi2Error);
    IS(fmi2GetReal(NULL, NULL, 0, &real) == fmi2Error && fmi2SetReal(NULL, NULL, 0, &real) == fmi2Error);
    IS(fmi2GetInteger(NULL, NULL, 0, &whole) == fmi2Error && fmi2SetInteger(NULL, NULL, 0, &whole) == fmi2Error);
    IS(fmi2GetFMUstate(NULL, &state) == fmi2Error && fmi2SetFMUstate(NULL, state) == fmi2Error && fmi2FreeFMUstate(NULL, &state) == fmi2Error);
    IS(fmi2SerializedFMUstateSize(NULL, state, &size) == fmi2Error && fmi2SerializeFMUstate(NULL, state, NULL, 0) == fmi2Error);
    IS(fmi2DeSerializeFMUstate(NULL, NULL, 0, &state) == fmi2Error);
    IS(fmi2GetDirectionalDerivative(NULL, NULL, 0, NULL, 0, NULL, NULL) == fmi2Error);
    IS(fmi2GetStatus(NULL, fmi2DoStepStatus, &status) == fmi2Error && fmi2GetRealStatus(NULL, fmi2LastSuccessfulTime, &real) == fmi2Error);
    IS(fmi2GetBooleanStatus(NULL, fmi2Terminated, &whole) == fmi2Error && fmi2GetStringStatus(NULL, fmi2PendingStatus, &text) == fmi2Error);
}

int main(void)
{
    without_an_instance();
    starts();
    messages_of_an_instance();
    values();
    steps();
    questions();
    call_states();
    derivatives2();
    call_fmi3();
    printf("%lu calls\n", calls);
    return 0;
}
