/* FMI 3.0 co-simulation over an instance. */
#include "fmi3Functions.h"

#define FMI(name) fmi3##name
#define STATE(before, after) before##FMUState##after
#define DESERIALISE DeserializeFMUState

#include "computation.h"
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
    (void)resources, (void)visible, (void)early_return, (void)intermediate, (void)update;
    struct importer importer = {deliver, (void (*)(void))logger, environment};
    const char *objection =
        event_mode || intermediate_count ? "the unit has no event mode and no intermediate values; ask for neither" : NULL;
    return instantiate(importer, logging, __func__, name, objection, "token", token);
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

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 duration, fmi3Boolean no_return_before,
                      fmi3Boolean *needs_events, fmi3Boolean *terminates, fmi3Boolean *early_return, fmi3Float64 *last_time)
{
    struct instance *i = c;
    (void)no_return_before;
    if (!i)
        return fmi3Error;
    fmi3Status status = (fmi3Status)do_step(i, __func__, time, duration);
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
