/* FMI 3.0 co-simulation over an instance. */
#include "fmi3Functions.h"

#define FMI(name) fmi3##name
#define STATE(before, after) before##FMUState##after
#define DESERIALISE DeserializeFMUState

#include "computation.h"
#include "derivatives.h"
#include "same_calls.h"
#include "values.h"

static void deliver(const struct instance *i, enum status status, const char *category, const char *text)
{
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)i->importer.logger;
    if (logger)
        logger(i->importer.environment, (fmi3Status)status, category, text);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t intermediate_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)resources, (void)visible;
    struct importer importer = {deliver, (void (*)(void))logger, environment};
    int pauses = unit.pause_cell >= 0;
    const char *objection = event_mode ? "the unit has no event mode; do not ask for it" : NULL;
    if (intermediate_count && !(pauses && update))
        objection = pauses ? "intermediate variables are asked for, but there is no callback to be called then"
                           : "the unit has no intermediate values; ask for none";
    for (size_t k = 0; k < intermediate_count && !objection; k++)
        if (!intermediate || !find_variable(intermediate[k]))
            objection = "an intermediate variable has a value reference that the unit does not know";
    struct instance *i = instantiate(importer, logging, __func__, name, objection, "token", token);
    if (i && pauses) {
        i->may_return_early = early_return;
        i->update = (void (*)(void))update;
        i->pausing = update ? EVERYWHERE : early_return ? WHERE_JUDGED_OTHERWISE : NOWHERE;
    }
    return i;
}

static enum status enter_initialisation(struct instance *i, const char *function, double start, int has_stop, double stop)
{
    if (set_times(i, function, start, has_stop, stop))
        return ERROR;
    i->phase = INITIALISING;
    return OK;
}

FORWARD(EnterInitializationMode,
        (fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop,
         fmi3Float64 stop),
        ((void)has_tolerance, (void)tolerance, enter_initialisation(i, __func__, start, has_stop, stop)))

#define REFERENCES fmi3Instance c, const fmi3ValueReference references[], size_t count
#define VALUES(type, kind)                                                                                                       \
    FORWARD(Get##type, (REFERENCES, fmi3##type values[], size_t value_count),                                                    \
            get_values(i, &(struct call){__func__, references, count, kind, 1, value_count}, values))                            \
    FORWARD(Set##type, (REFERENCES, const fmi3##type values[], size_t value_count),                                              \
            set_values(i, &(struct call){__func__, references, count, kind, 1, value_count}, values))
VALUES(Float64, REAL)
VALUES(Int64, INTEGER_64)

FORWARD(GetDirectionalDerivative,
        (fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[],
         size_t known_count, const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count),
        directional_derivative(i, &(struct direction){__func__, 1, unknowns, unknown_count, knowns, known_count, seed, seed_count,
                                                      sensitivity, sensitivity_count}))

/* Asks the importer between two parts; how much of the step is still to be done. */
static double left_after_update(struct instance *i, double left)
{
    fmi3Boolean requested = fmi3False;
    fmi3Float64 until = i->time;
    ((fmi3IntermediateUpdateCallback)i->update)(i->importer.environment, i->time, fmi3False, fmi3True, fmi3True,
                                                i->may_return_early && left > 0.0, &requested, &until);
    if (!requested || !i->may_return_early)
        return left;
    double wanted = until - i->time;
    return wanted <= 0.0 ? 0.0 : wanted < left ? wanted : left;
}

/* A step, in parts where the importer wants to hear of them; ``early`` if it ends before its time. */
static enum status through_parts(struct instance *i, const char *function, double time, double duration, int *early)
{
    enum status worst = OK;
    double left = duration, end = time + duration;
    do {
        enum status status = do_step(i, function, time, left);
        worst = status > worst ? status : worst;
        if (worst > WARNING)
            return worst;
        double done = unit.pause_cell >= 0 ? i->cells[unit.paused_cell].real : 0.0;
        left = done > 0.0 ? left - done : 0.0;
        if (left == 0.0)
            i->time = end;
        time = i->time;
        if (i->update) {
            double wanted = left_after_update(i, left);
            if (wanted < left) {
                *early = 1;
                end = i->time + wanted;
            }
            left = wanted;
        } else if (left > 0.0) {
            *early = 1;
            return worst;
        }
    } while (left > 0.0);
    return worst;
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 duration, fmi3Boolean no_return_before,
                      fmi3Boolean *needs_events, fmi3Boolean *terminates, fmi3Boolean *early_return, fmi3Float64 *last_time)
{
    struct instance *i = c;
    (void)no_return_before;
    if (!i)
        return fmi3Error;
    int early = 0;
    fmi3Status status = (fmi3Status)through_parts(i, __func__, time, duration, &early);
    if (needs_events)
        *needs_events = fmi3False;
    if (terminates)
        *terminates = i->phase == TERMINATED;
    if (early_return)
        *early_return = early != 0;
    if (last_time)
        *last_time = i->time;
    return status;
}
