/* FMI 2.0 co-simulation over an instance. */
#include "fmi2Functions.h"

#define FMI(name) fmi2##name
#define STATE(before, after) before##FMUstate##after
#define DESERIALISE DeSerializeFMUstate

#include "computation.h"
#include "derivatives.h"
#include "same_calls.h"
#include "values.h"

static void deliver(const struct instance *i, enum status status, const char *category, const char *text)
{
    /* The message is a format to the importer: its percent signs are doubled. */
    char format[2 * TEXT_SIZE], *to = format;
    for (; *text; text++) {
        *to++ = *text;
        if (*text == '%')
            *to++ = '%';
    }
    *to = 0;
    fmi2CallbackLogger logger = (fmi2CallbackLogger)i->importer.logger;
    if (logger)
        logger(i->importer.environment, i->name, (fmi2Status)status, category, format);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)resources, (void)visible;
    if (!callbacks)
        return NULL;
    struct importer importer = {deliver, (void (*)(void))callbacks->logger, callbacks->componentEnvironment};
    const char *objection = type == fmi2CoSimulation ? NULL : "this is a co-simulation unit, not one for model exchange";
    return instantiate(importer, logging, __func__, name, objection, "guid", guid);
}

/* Start and stop time come in a call of their own, before initialisation mode is entered. */
static enum status set_up(struct instance *i, const char *function, double start, int has_stop, double stop)
{
    if (set_times(i, function, start, has_stop, stop))
        return ERROR;
    i->is_set_up = 1;
    return OK;
}

static enum status enter_initialisation(struct instance *i, const char *function)
{
    if (require_phase(i, 1 << INSTANTIATED, function))
        return ERROR;
    if (!i->is_set_up)
        return report(i, ERROR, "%s is not allowed yet; call fmi2SetupExperiment first", function);
    i->phase = INITIALISING;
    return OK;
}

FORWARD(SetupExperiment,
        (fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop),
        ((void)has_tolerance, (void)tolerance, set_up(i, __func__, start, has_stop, stop)))
FORWARD(EnterInitializationMode, (fmi2Component c), enter_initialisation(i, __func__))
FORWARD(DoStep, (fmi2Component c, fmi2Real time, fmi2Real duration, fmi2Boolean no_return_before),
        ((void)no_return_before, do_step(i, __func__, time, duration)))

#define VALUES(type, kind)                                                                                                       \
    FORWARD(Get##type, (fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2##type values[]),              \
            get_values(i, &(struct call){__func__, references, count, kind, 0, count}, values))                                  \
    FORWARD(Set##type, (fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2##type values[]),        \
            set_values(i, &(struct call){__func__, references, count, kind, 0, count}, values))
VALUES(Real, REAL)
VALUES(Integer, INTEGER_32)

FORWARD(GetDirectionalDerivative,
        (fmi2Component c, const fmi2ValueReference unknowns[], size_t unknown_count, const fmi2ValueReference knowns[],
         size_t known_count, const fmi2Real seed[], fmi2Real sensitivity[]),
        directional_derivative(i, &(struct direction){__func__, 0, unknowns, unknown_count, knowns, known_count, seed, known_count,
                                                      sensitivity, unknown_count}))

/* What may be asked about a step, which ends before it returns: one kind of each type. */
#define ASK(name, type, kind_offered, answer, what)                                                                              \
    FORWARD(name, (fmi2Component c, const fmi2StatusKind kind, type *value),                                                     \
            kind == kind_offered && value ? (*value = answer, OK) : refuse(i, __func__, 1, what))
ASK(GetStatus, fmi2Status, fmi2DoStepStatus, (fmi2Status)i->last_step, "status of this kind")
ASK(GetRealStatus, fmi2Real, fmi2LastSuccessfulTime, i->time, "real status of this kind")
ASK(GetBooleanStatus, fmi2Boolean, fmi2Terminated, i->phase == TERMINATED, "Boolean status of this kind")
ASK(GetStringStatus, fmi2String, fmi2PendingStatus, "", "string status of this kind")
