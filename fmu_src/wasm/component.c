/* FMI 3.0 as WebAssembly's component model wants to call it (draft layered standard FMI-LS-WASM).
 *
 * One function for each of the interface co-simulation: strings and lists come as address and length, results of several
 * parts go to an area whose address is given back.  component.py says which function has which type.
 */
#include "computation.h"
#include "fmi3Functions.h"
#include "values.h"

#include <stdlib.h>
#include <string.h>

#define EXPORT(name) __attribute__((export_name(name)))
#define METHOD(name) EXPORT("[method]co-simulation-instance." name)

/* Who wants to know: callbacks.log-message, with the instance's name. */
__attribute__((import_module("callbacks"), import_name("log-message"))) void log_message(
    const char *instance, size_t instance_length, int32_t status, const char *category, size_t category_length, const char *text,
    size_t text_length);

/* What a handle stands for. */
struct held {
    fmi3Instance unit;
    char name[256];
};

struct text {
    const char *text;
    size_t length;
};

/* Memory for arguments and results of one call: taken by the host and here, given back after the call. */
struct block {
    struct block *before;
    double content[];
};
static struct block *blocks;

static void *take(size_t size)
{
    struct block *block = malloc(sizeof *block + (size ? size : 1));
    if (!block)
        abort();
    block->before = blocks;
    blocks = block;
    return block->content;
}

EXPORT("cabi_realloc") void *cabi_realloc(void *old, size_t old_size, size_t alignment, size_t size)
{
    (void)alignment; /* a double's serves all */
    void *place = take(size);
    if (old_size)
        memcpy(place, old, old_size < size ? old_size : size);
    return place;
}

EXPORT("after_call") void after_call(int32_t result)
{
    (void)result;
    while (blocks) {
        struct block *before = blocks->before;
        free(blocks);
        blocks = before;
    }
}

static char *text_of(const char *text, size_t length)
{
    char *copy = take(length + 1);
    memcpy(copy, text, length);
    copy[length] = 0;
    return copy;
}

/* Results: a mark (0 well, 1 refused), then what there is or the status; nothing in them is wider than 4 bytes. */
static struct {
    uint8_t mark;
    union {
        uint8_t status;
        uint32_t handle;
        struct {
            const void *items;
            size_t count;
        } list;
    } is;
} area;

static void *list(fmi3Status status, const void *items, size_t count)
{
    area.mark = status > fmi3Warning;
    if (area.mark) {
        area.is.status = (uint8_t)status;
    } else {
        area.is.list.items = items;
        area.is.list.count = count;
    }
    return &area;
}

/* The same for results with numbers of 8 bytes. */
static struct {
    uint8_t mark;
    union {
        uint8_t status;
        uint64_t count;
        struct {
            double last_successful_time;
            uint8_t event_handling_needed, terminate_simulation, early_return;
        } step;
    } is;
} wide_area;

static void *refused_wide(fmi3Status status)
{
    wide_area.mark = 1;
    wide_area.is.status = (uint8_t)status;
    return &wide_area;
}

EXPORT("get-version") void *get_version(void)
{
    static struct text answer;
    answer = (struct text){fmi3GetVersion(), strlen(fmi3GetVersion())};
    return &answer;
}

static void deliver(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    const struct held *held = environment;
    log_message(held->name, strlen(held->name), status, category, strlen(category), text, strlen(text));
}

EXPORT("instantiate") void *instantiate_co_simulation(const char *name, size_t name_length, const char *token, size_t token_length,
                                                      const char *path, size_t path_length, int32_t visible, int32_t logging,
                                                      int32_t event_mode, int32_t early_return, const uint32_t *intermediate,
                                                      size_t intermediate_count)
{
    struct held *held = calloc(1, sizeof *held);
    area.mark = 0;
    if (!held)
        return &area;
    memcpy(held->name, name, name_length < sizeof held->name ? name_length : sizeof held->name - 1);
    held->unit = fmi3InstantiateCoSimulation(text_of(name, name_length), text_of(token, token_length), text_of(path, path_length),
                                             visible, logging, event_mode, early_return, intermediate, intermediate_count, held,
                                             deliver, NULL);
    if (!held->unit) {
        free(held);
        return &area;
    }
    area.mark = 1;
    area.is.handle = (uint32_t)(uintptr_t)held;
    return &area;
}

EXPORT("drop") void drop(struct held *held)
{
    fmi3FreeInstance(held->unit);
    free(held);
}

METHOD("set-debug-logging") int32_t set_debug_logging(struct held *h, int32_t on, const struct text *categories, size_t count)
{
    const char **names = take(count * sizeof *names);
    for (size_t k = 0; k < count; k++)
        names[k] = text_of(categories[k].text, categories[k].length);
    return fmi3SetDebugLogging(h->unit, on, count, names);
}

METHOD("enter-initialization-mode") int32_t enter_initialisation(struct held *h, int32_t has_tolerance, double tolerance,
                                                                 double start, int32_t has_stop, double stop)
{
    return fmi3EnterInitializationMode(h->unit, has_tolerance, tolerance, start, has_stop, stop);
}

#define SIMPLE(method, function) METHOD(method) int32_t wasm_##function(struct held *h) { return fmi3##function(h->unit); }
SIMPLE("exit-initialization-mode", ExitInitializationMode)
SIMPLE("enter-event-mode", EnterEventMode)
SIMPLE("terminate", Terminate)
SIMPLE("reset", Reset)
SIMPLE("enter-configuration-mode", EnterConfigurationMode)
SIMPLE("exit-configuration-mode", ExitConfigurationMode)
SIMPLE("evaluate-discrete-states", EvaluateDiscreteStates)
SIMPLE("enter-step-mode", EnterStepMode)

METHOD("update-discrete-states") void *update_discrete_states(struct held *h)
{
    fmi3Boolean flags[5];
    fmi3Float64 time;
    fmi3Status status = fmi3UpdateDiscreteStates(h->unit, flags, flags + 1, flags + 2, flags + 3, flags + 4, &time);
    return refused_wide(status > fmi3Warning ? status : fmi3Error);
}

/* How many values the variables have: nobody says it here. */
static size_t values_together(const uint32_t *references, size_t count)
{
    size_t total = 0;
    for (size_t k = 0; k < count; k++) {
        const struct variable *v = find_variable(references[k]);
        total += v ? v->size : references[k] == unit.cell_count;
    }
    return total;
}

/* Values that the unit has. */
#define VALUES(type, Type, c_type)                                                                                               \
    METHOD("get-" type) void *wasm_get_##Type(struct held *h, const uint32_t *references, size_t count)                          \
    {                                                                                                                            \
        size_t total = values_together(references, count);                                                                       \
        c_type *values = take(total * sizeof *values);                                                                           \
        return list(fmi3Get##Type(h->unit, references, count, values, total), values, total);                                    \
    }                                                                                                                            \
    METHOD("set-" type) int32_t wasm_set_##Type(struct held *h, const uint32_t *references, size_t count, const c_type *values,  \
                                               size_t total)                                                                     \
    {                                                                                                                            \
        return fmi3Set##Type(h->unit, references, count, values, total);                                                         \
    }
VALUES("float64", Float64, double)
VALUES("int64", Int64, int64_t)

/* Kinds of values that it has not: whoever asks for nothing gets nothing, all else is refused. */
#define ABSENT(type, Type)                                                                                                       \
    METHOD("get-" type) void *wasm_get_##Type(struct held *h, const uint32_t *references, size_t count)                          \
    {                                                                                                                            \
        return list(fmi3Get##Type(h->unit, references, count, NULL, 0), NULL, 0);                                                \
    }                                                                                                                            \
    METHOD("set-" type) int32_t wasm_set_##Type(struct held *h, const uint32_t *references, size_t count, const void *values,    \
                                               size_t total)                                                                     \
    {                                                                                                                            \
        (void)values;                                                                                                            \
        return fmi3Set##Type(h->unit, references, count, NULL, total);                                                           \
    }
ABSENT("float32", Float32)
ABSENT("int8", Int8)
ABSENT("int16", Int16)
ABSENT("int32", Int32)
ABSENT("uint8", UInt8)
ABSENT("uint16", UInt16)
ABSENT("uint32", UInt32)
ABSENT("uint64", UInt64)
ABSENT("boolean", Boolean)
ABSENT("string", String)

#define NO_LIST(method, name, what)                                                                                              \
    METHOD(method) void *wasm_##name(struct held *h, const void *items, size_t count)                                            \
    {                                                                                                                            \
        (void)items;                                                                                                             \
        return list((fmi3Status)refuse(h->unit, method, count, what), NULL, 0);                                                  \
    }
#define NO_SETTING(method, name, what)                                                                                           \
    METHOD(method) int32_t wasm_##name(struct held *h, const void *items, size_t count, const void *values, size_t total)        \
    {                                                                                                                            \
        (void)items, (void)values, (void)total;                                                                                  \
        return refuse(h->unit, method, count, what);                                                                             \
    }
NO_LIST("get-binary", get_binary, "Binary variables")
NO_SETTING("set-binary", set_binary, "Binary variables")
NO_LIST("get-clock", get_clock, "clocks")
NO_SETTING("set-clock", set_clock, "clocks")
NO_LIST("get-interval-decimal", get_interval_decimal, "clocks")
NO_LIST("get-interval-fraction", get_interval_fraction, "clocks")
NO_LIST("get-shift-decimal", get_shift_decimal, "clocks")
NO_LIST("get-shift-fraction", get_shift_fraction, "clocks")
NO_SETTING("set-interval-decimal", set_interval_decimal, "clocks")
NO_SETTING("set-interval-fraction", set_interval_fraction, "clocks")
NO_SETTING("set-shift-decimal", set_shift_decimal, "clocks")
NO_SETTING("set-shift-fraction", set_shift_fraction, "clocks")
NO_SETTING("set-input-derivatives", set_input_derivatives, "input derivatives")
NO_LIST("get-output-derivatives", get_output_derivatives, "output derivatives")

METHOD("get-number-of-variable-dependencies") void *get_number_of_dependencies(struct held *h, uint32_t reference)
{
    size_t count = 0;
    fmi3Status status = fmi3GetNumberOfVariableDependencies(h->unit, reference, &count);
    if (status > fmi3Warning)
        return refused_wide(status);
    wide_area.mark = 0;
    wide_area.is.count = count;
    return &wide_area;
}

METHOD("get-variable-dependencies") void *get_dependencies(struct held *h, uint32_t reference)
{
    return list(fmi3GetVariableDependencies(h->unit, reference, NULL, NULL, NULL, NULL, 0), NULL, 0);
}

METHOD("get-directional-derivative") void *get_directional(struct held *h, const uint32_t *unknowns, size_t unknown_count,
                                                           const uint32_t *knowns, size_t known_count, const double *seed,
                                                           size_t seed_count)
{
    size_t total = values_together(unknowns, unknown_count);
    double *found = take(total * sizeof *found);
    fmi3Status status = fmi3GetDirectionalDerivative(h->unit, unknowns, unknown_count, knowns, known_count, seed, seed_count, found, total);
    return list(status, found, total);
}

METHOD("get-adjoint-derivative") void *get_adjoint(struct held *h, const uint32_t *unknowns, size_t unknown_count,
                                                   const uint32_t *knowns, size_t known_count, const double *seed,
                                                   size_t seed_count)
{
    size_t total = values_together(knowns, known_count);
    double *found = take(total * sizeof *found);
    fmi3Status status = fmi3GetAdjointDerivative(h->unit, unknowns, unknown_count, knowns, known_count, seed, seed_count, found, total);
    return list(status, found, total);
}

/* The whole state as bytes. */
METHOD("get-fmu-state") void *get_fmu_state(struct held *h)
{
    fmi3FMUState state = NULL;
    size_t size = 0;
    fmi3Byte *bytes = NULL;
    fmi3Status status = fmi3GetFMUState(h->unit, &state);
    if (status <= fmi3Warning)
        status = fmi3SerializedFMUStateSize(h->unit, state, &size);
    if (status <= fmi3Warning) {
        bytes = take(size);
        status = fmi3SerializeFMUState(h->unit, state, bytes, size);
    }
    fmi3FreeFMUState(h->unit, &state);
    return list(status, bytes, size);
}

METHOD("set-fmu-state") int32_t set_fmu_state(struct held *h, const fmi3Byte *bytes, size_t size)
{
    fmi3FMUState state = NULL;
    fmi3Status status = fmi3DeserializeFMUState(h->unit, bytes, size, &state);
    if (status > fmi3Warning)
        return status;
    status = fmi3SetFMUState(h->unit, state);
    fmi3FreeFMUState(h->unit, &state);
    return status;
}

METHOD("do-step") void *do_step_of(struct held *h, double time, double duration, int32_t keeps_no_state)
{
    fmi3Boolean events, ends, early;
    fmi3Float64 reached;
    fmi3Status status = fmi3DoStep(h->unit, time, duration, keeps_no_state, &events, &ends, &early, &reached);
    if (status > fmi3Warning)
        return refused_wide(status);
    wide_area.mark = 0;
    wide_area.is.step.last_successful_time = reached;
    wide_area.is.step.event_handling_needed = events;
    wide_area.is.step.terminate_simulation = ends;
    wide_area.is.step.early_return = early;
    return &wide_area;
}
