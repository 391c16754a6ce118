/* Random legal and illegal calls on a unit's FMI 2.0 and 3.0 functions; see fuzz.py.
 *
 * After every call that fails there must be a message, and the state must be what it was.
 * After every call that succeeds all outputs must be finite.  The sanitizers watch the rest.
 */
#include "fmi2Functions.h"
#include "fmi3Functions.h"
#include "instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define INSTANCES 3
#define SAVED 4

struct slot {
    struct instance *instance;
    int version;
    void *saved[SAVED];
};

static struct slot slots[INSTANCES];
static unsigned messages;
static char last_message[256];
static unsigned long calls, failures, steps, steps_done;
static double slowest_step;
static unsigned char *blob; /* a serialised state, at times spoilt */
static size_t blob_size;

/* Random numbers come from the fuzzer's input as long as there is some. */
static const unsigned char *input, *input_end;

static unsigned choose(unsigned count)
{
    unsigned number = 0;
    for (int i = 0; i < 4 && input < input_end; i++)
        number = number << 8 | *input++;
    return number % count;
}

static void heard(const char *text)
{
    messages += strlen(text) > 10;
    size_t length = strlen(text), shown = sizeof last_message - 1;
    /* The end says what becomes of the unit. */
    strcpy(last_message, length > shown ? text + length - shown : text);
}

static void say2(void *environment, const char *name, fmi2Status status, const char *category, const char *text, ...)
{
    (void)environment, (void)name, (void)status, (void)category;
    heard(text);
}

static void say3(void *environment, fmi3Status status, const char *category, const char *text)
{
    (void)environment, (void)status, (void)category;
    heard(text);
}

static const fmi2CallbackFunctions CALLBACKS = {say2, calloc, free, NULL, NULL};

static double wild(void)
{
    static const double VALUES[] = {0.0, -0.0, 1.0, -1.0, NAN, -NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e-300, 1e9, 4e-320, 1e15};
    return VALUES[choose(sizeof VALUES / sizeof *VALUES)];
}

/* Often near the start value, sometimes a bound, sometimes impossible. */
static double value_for(const struct variable *v, double present)
{
    switch (choose(8)) {
    case 0: return wild();
    case 1: return v->lowest;
    case 2: return v->highest;
    case 3: return v->highest * 1.0001 + 1.0;
    case 4: return 0.0;
    default: return present * (0.9 + choose(200) * 1e-3) + (present == 0.0 ? choose(100) * 1e-7 : 0.0);
    }
}

static uint64_t fingerprint(const struct instance *i)
{
    uint64_t sum = (uint64_t)i->phase * 31 + (uint64_t)i->is_set_up, bits;
    for (uint32_t k = 0; k < unit.state_cells; k++)
        sum = sum * 0x100000001b3u ^ (uint64_t)i->cells[k].integer;
    memcpy(&bits, &i->time, sizeof bits);
    return sum * 0x100000001b3u ^ bits;
}

static void stop(const char *what, const char *call)
{
    fprintf(stderr, "FUZZ: %s after %s (call %lu)\n", what, call, calls);
    abort();
}

static void check(struct instance *i, const char *call, int status, unsigned before_messages, uint64_t before)
{
    calls++;
    if (status < 0 || status > 3)
        stop("a status that is none", call);
    if (status >= 2) {
        failures++;
        if (i->logging == ALL && !i->muted && messages == before_messages)
            stop("no message", call);
        /* A step whose outputs would be infinite ends a unit whose surfaces have worn by then, and says so. */
        int is_silent = i->logging == NOTHING || i->muted;
        if (fingerprint(i) != before && !(i->phase == TERMINATED && (is_silent || strstr(last_message, "the unit is terminated"))))
            stop("a changed state", call);
    }
    if (i->phase == TERMINATED)
        return;
    for (const struct variable *v = unit.variables; v < unit.variables + unit.variable_count; v++)
        if (v->role == OUTPUT && !v->is_integer)
            for (uint32_t k = 0; k < v->size; k++)
                if (!isfinite(i->cells[v->first + k].real))
                    stop("an output that is not finite", call);
}

#define TRY(expression)                                                                                                          \
    do {                                                                                                                         \
        unsigned messages_before_ = messages;                                                                                    \
        uint64_t before_ = fingerprint(i);                                                                                       \
        int status_ = (int)(expression);                                                                                         \
        check(i, #expression, status_, messages_before_, before_);                                                               \
    } while (0)

static void instantiate(struct slot *slot)
{
    const char *name = choose(10) ? "one" : choose(2) ? "" : NULL;
    const char *token = choose(10) ? unit.identity : choose(2) ? "{other}" : NULL;
    unsigned before = messages;
    slot->version = 2 + (int)choose(2);
    if (slot->version == 2)
        slot->instance = fmi2Instantiate(name, choose(10) ? fmi2CoSimulation : fmi2ModelExchange, token, "", &CALLBACKS, 0, choose(10) != 0);
    else
        slot->instance = fmi3InstantiateCoSimulation(name, token, "", 0, choose(10) != 0, choose(10) == 0, 0, NULL, 0, NULL, say3, NULL);
    if (!slot->instance && messages == before)
        stop("no message", "instantiate");
    memset(slot->saved, 0, sizeof slot->saved);
}

static void free_slot(struct slot *slot)
{
    if (slot->version == 2)
        fmi2FreeInstance(slot->instance);
    else
        fmi3FreeInstance(slot->instance);
    slot->instance = NULL;
}

static void get_or_set(struct slot *slot)
{
    struct instance *i = slot->instance;
    enum { MOST = 4 };
    uint32_t references[MOST];
    size_t count = choose(MOST + 1), total = 0;
    int integers = choose(4) == 0, sets = (int)choose(3);
    static double reals[1 << 20];
    static int64_t longs[1 << 20];
    int32_t ints[MOST];
    for (size_t k = 0; k < count; k++) {
        const struct variable *v = &unit.variables[choose((unsigned)unit.variable_count)];
        for (int again = 0; again < 8 && (v->is_integer != integers || (sets && v->role > TUNABLE_PARAMETER)); again++)
            v = &unit.variables[choose((unsigned)unit.variable_count)];
        int whole = slot->version == 3;
        references[k] = choose(30) ? v->first + (whole ? 0 : choose(v->size)) : choose(2) ? unit.cell_count : choose(1u << 31);
        for (uint32_t e = 0; e < (whole ? v->size : 1) && total < (1 << 20); e++) {
            double present = v->is_integer ? (double)i->cells[v->first + e].integer : i->cells[v->first + e].real;
            double value = e && choose(50) ? present : value_for(v, present);
            reals[total] = value;
            longs[total] = fabs(value) < 1e18 ? (int64_t)value : INT64_MIN;
            if (!whole)
                ints[k] = fabs(value) < 2e9 ? (int32_t)value : INT32_MIN;
            total++;
        }
    }
    size_t given = choose(30) ? total : choose(100);
    const uint32_t *list = choose(50) ? references : NULL;
    int missing = choose(50) == 0;
    if (slot->version == 2 && integers)
        TRY(sets ? fmi2SetInteger(i, list, count, missing ? NULL : ints) : fmi2GetInteger(i, list, count, missing ? NULL : ints));
    else if (slot->version == 2)
        TRY(sets ? fmi2SetReal(i, list, count, missing ? NULL : reals) : fmi2GetReal(i, list, count, missing ? NULL : reals));
    else if (integers)
        TRY(sets ? fmi3SetInt64(i, list, count, missing ? NULL : longs, given) : fmi3GetInt64(i, list, count, missing ? NULL : longs, given));
    else
        TRY(sets ? fmi3SetFloat64(i, list, count, missing ? NULL : reals, given) : fmi3GetFloat64(i, list, count, missing ? NULL : reals, given));
}

static void do_steps(struct slot *slot)
{
    struct instance *i = slot->instance;
    fmi3Boolean a, b, c;
    double last;
    for (unsigned k = choose(6) + 1; k; k--) {
        double time = choose(10) ? i->time : wild(), duration = choose(5) ? 1e-6 * (1 + choose(1000)) : wild();
        if (!choose(20))
            duration = unit.longest_step * 1.0000001;
        if (!(duration > 0.0 && duration <= 1e-3) && duration > 0.0 && duration <= unit.longest_step)
            duration = 1e-3; /* allowed, but it would take its time */
        steps++;
        clock_t start = clock();
        if (slot->version == 2)
            TRY(fmi2DoStep(i, time, duration, 1));
        else
            TRY(choose(10) ? fmi3DoStep(i, time, duration, 1, &a, &b, &c, &last) : fmi3DoStep(i, time, duration, 1, NULL, NULL, NULL, NULL));
        steps_done += i->last_step <= WARNING;
        double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
        slowest_step = fmax(slowest_step, taken);
        if (taken > 0.5) {
            /* Its parameters make every step slow; others are more to learn from. */
            free_slot(slot);
            return;
        }
    }
}

static void use_states(struct slot *slot)
{
    struct instance *i = slot->instance;
    void **state = &slot->saved[choose(SAVED)];
    void *foreign = choose(2) ? (void *)&messages : slots[choose(INSTANCES)].saved[choose(SAVED)];
    int two = slot->version == 2;
    size_t size = 0;
    switch (choose(7)) {
    case 0:
    case 1: TRY(two ? fmi2GetFMUstate(i, state) : (fmi2Status)fmi3GetFMUState(i, state)); break;
    case 2: TRY(two ? fmi2SetFMUstate(i, *state) : (fmi2Status)fmi3SetFMUState(i, *state)); break;
    case 3: TRY(two ? fmi2FreeFMUstate(i, state) : (fmi2Status)fmi3FreeFMUState(i, state)); break;
    case 4: TRY(two ? fmi2SetFMUstate(i, foreign) : (fmi2Status)fmi3SetFMUState(i, foreign)); break;
    case 5:
        TRY(two ? fmi2SerializedFMUstateSize(i, *state, &size) : (fmi2Status)fmi3SerializedFMUStateSize(i, *state, &size));
        if (size) {
            if (choose(10) == 0)
                size -= 1 + choose((unsigned)size - 1);
            unsigned char *bytes = malloc(size);
            TRY(two ? fmi2SerializeFMUstate(i, *state, (char *)bytes, size) : (fmi2Status)fmi3SerializeFMUState(i, *state, bytes, size));
            free(blob);
            blob = bytes;
            blob_size = size;
        }
        break;
    default:
        if (blob) {
            /* A copy of its exact size, so that the sanitizer sees a byte too far. */
            size_t given = choose(3) ? blob_size : choose((unsigned)blob_size + 1);
            unsigned char *bytes = malloc(given ? given : 1);
            memcpy(bytes, blob, given);
            int spoilt = given && choose(2);
            if (spoilt)
                bytes[choose((unsigned)given)] ^= (unsigned char)(1 + choose(255));
            void *fresh = NULL;
            TRY(two ? fmi2DeSerializeFMUstate(i, (char *)bytes, given, &fresh) : (fmi2Status)fmi3DeserializeFMUState(i, bytes, given, &fresh));
            if (fresh && (spoilt || given != 104 + 8 * (size_t)unit.state_cells))
                stop("a spoilt state taken", "deserialise");
            if (fresh)
                TRY(two ? fmi2SetFMUstate(i, fresh) : (fmi2Status)fmi3SetFMUState(i, fresh));
            if (fresh)
                TRY(two ? fmi2FreeFMUstate(i, &fresh) : (fmi2Status)fmi3FreeFMUState(i, &fresh));
            free(bytes);
        }
    }
}

static void rarely_used(struct slot *slot)
{
    struct instance *i = slot->instance;
    double real = 0.0;
    uint32_t reference = 0;
    size_t count = choose(2);
    if (slot->version == 2) {
        fmi2String category = choose(2) ? unit.categories[choose((unsigned)unit.category_count)] : choose(2) ? "none" : NULL;
        fmi2Status status;
        fmi2Boolean boolean = 0;
        fmi2Integer integer = 0;
        fmi2String string = "";
        switch (choose(12)) {
        case 0: TRY(fmi2SetDebugLogging(i, (fmi2Boolean)choose(3) != 0, choose(2), choose(10) ? &category : NULL)); break;
        case 1: TRY(fmi2GetDirectionalDerivative(i, &reference, 1, &reference, 1, &real, &real)); break;
        case 2: TRY(fmi2GetBoolean(i, &reference, count, &boolean)); break;
        case 3: TRY(fmi2SetString(i, &reference, count, &string)); break;
        case 4: TRY(fmi2CancelStep(i)); break;
        case 5: TRY(fmi2GetStatus(i, (fmi2StatusKind)choose(4), &status)); break;
        case 6: TRY(fmi2GetRealStatus(i, (fmi2StatusKind)choose(4), choose(5) ? &real : NULL)); break;
        case 7: TRY(fmi2GetBooleanStatus(i, (fmi2StatusKind)choose(4), &boolean)); break;
        case 8: TRY(fmi2GetIntegerStatus(i, (fmi2StatusKind)choose(4), &integer)); break;
        case 9: TRY(fmi2GetStringStatus(i, (fmi2StatusKind)choose(4), &string)); break;
        case 10: TRY(fmi2SetRealInputDerivatives(i, &reference, count, &integer, &real)); break;
        default: TRY(fmi2SetDebugLogging(i, 1, 0, NULL));
        }
        return;
    }
    fmi3Boolean boolean = 0;
    fmi3String category = choose(2) ? unit.categories[choose((unsigned)unit.category_count)] : "none";
    fmi3Int32 integer = 0;
    switch (choose(10)) {
    case 0: TRY(fmi3SetDebugLogging(i, choose(3) != 0, choose(2), &category)); break;
    case 1: TRY(fmi3GetDirectionalDerivative(i, &reference, 1, &reference, 1, &real, 1, &real, 1)); break;
    case 2: TRY(fmi3GetBoolean(i, &reference, count, &boolean, count)); break;
    case 3: TRY(fmi3SetInt32(i, &reference, count, &integer, count)); break;
    case 4: TRY(fmi3EnterConfigurationMode(i)); break;
    case 5: TRY(fmi3EnterEventMode(i)); break;
    case 6: TRY(fmi3EnterStepMode(i)); break;
    case 7: TRY(fmi3GetClock(i, &reference, count, &boolean)); break;
    case 8: TRY(fmi3SetTime(i, real)); break;
    default: TRY(fmi3SetDebugLogging(i, 1, 0, NULL));
    }
}

static void life_cycle(struct slot *slot)
{
    struct instance *i = slot->instance;
    double start = choose(5) ? 0.0 : wild(), end = choose(3) ? 1.0 : wild();
    int has_stop = choose(4) == 0, two = slot->version == 2;
    switch (choose(8)) {
    case 0:
    case 1:
        if (two)
            TRY(fmi2SetupExperiment(i, 0, 0.0, start, has_stop, end));
        break;
    case 2:
    case 3: TRY(two ? fmi2EnterInitializationMode(i) : (fmi2Status)fmi3EnterInitializationMode(i, 0, 0.0, start, has_stop, end)); break;
    case 4:
    case 5: TRY(two ? fmi2ExitInitializationMode(i) : (fmi2Status)fmi3ExitInitializationMode(i)); break;
    case 6:
        if (choose(4) == 0)
            TRY(two ? fmi2Terminate(i) : (fmi2Status)fmi3Terminate(i));
        break;
    default:
        if (choose(4) == 0)
            TRY(two ? fmi2Reset(i) : (fmi2Status)fmi3Reset(i));
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    input = data;
    input_end = data + size;
    while (input < input_end) {
        struct slot *slot = &slots[choose(INSTANCES)];
        if (!slot->instance) {
            instantiate(slot);
            continue;
        }
        switch (choose(16)) {
        case 0:
            if (choose(8) == 0)
                free_slot(slot);
            break;
        case 1:
        case 2:
        case 3: life_cycle(slot); break;
        case 4:
        case 5:
        case 6: use_states(slot); break;
        case 7: rarely_used(slot); break;
        case 8: if (fmi2DoStep(NULL, 0, 1, 1) != fmi2Error || fmi3Reset(NULL) != fmi3Error) stop("no error", "a call without instance"); break;
        case 9:
        case 10:
        case 11: do_steps(slot); break;
        default: get_or_set(slot);
        }
    }
    for (int k = 0; k < INSTANCES; k++)
        if (slots[k].instance)
            free_slot(&slots[k]);
    free(blob);
    blob = NULL;
    return 0;
}

#ifndef LIBFUZZER
int main(int count, char **arguments)
{
    double seconds = count > 1 ? atof(arguments[1]) : 10.0;
    uint64_t state = count > 2 ? strtoull(arguments[2], NULL, 10) : 1;
    static unsigned char data[1 << 16];
    unsigned long runs = 0;
    for (time_t start = time(NULL); difftime(time(NULL), start) < seconds; runs++) {
        for (size_t k = 0; k < sizeof data; k++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            data[k] = (unsigned char)(state >> 56);
        }
        LLVMFuzzerTestOneInput(data, sizeof data);
    }
    printf("{\"runs\": %lu, \"calls\": %lu, \"refused\": %lu, \"steps\": %lu, \"steps_done\": %lu, \"messages\": %u, \"slowest_step_s\": %.3g}\n",
           runs, calls, failures, steps, steps_done, messages, slowest_step);
    return 0;
}
#endif
