/* FMI 2.0 co-simulation over an instance. */
#include "fmi2Functions.h"
#include "instance.h"

#include <stdlib.h>
#include <string.h>

#define STATUS(expression) ((fmi2Status)(expression))
#define REQUIRE_INSTANCE(c)                                                                                                      \
    struct instance *i = c;                                                                                                      \
    if (!i)                                                                                                                      \
        return fmi2Error;

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
    fmi2CallbackLogger logger = (fmi2CallbackLogger)i->logger;
    if (logger)
        logger(i->environment, i->name, STATUS(status), category, format);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)resources, (void)visible;
    struct instance refused = {.deliver = deliver, .name = "", .logging = 1};
    if (!callbacks)
        return NULL;
    refused.logger = (void (*)(void))callbacks->logger;
    refused.environment = callbacks->componentEnvironment;
    if (!name || !*name)
        return report(&refused, ERROR, "fmi2Instantiate: the instance needs a name"), NULL;
    if (type != fmi2CoSimulation)
        return report(&refused, ERROR, "fmi2Instantiate: this is a co-simulation unit, not one for model exchange"), NULL;
    if (!guid || strcmp(guid, unit.identity) != 0)
        return report(&refused, ERROR, "fmi2Instantiate: guid %.60s is not %s: library and modelDescription.xml are of two builds",
                      guid ? guid : "NULL", unit.identity),
               NULL;
    struct instance *i = new_instance(name);
    if (!i)
        return report(&refused, ERROR, "fmi2Instantiate: out of memory"), NULL;
    i->deliver = deliver;
    i->logger = refused.logger;
    i->environment = refused.environment;
    i->logging = logging;
    return i;
}

void fmi2FreeInstance(fmi2Component c)
{
    if (c)
        free_instance(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_logging(i, on, count, categories));
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    REQUIRE_INSTANCE(c)
    (void)has_tolerance, (void)tolerance;
    if (require_phase(i, 1 << INSTANTIATED, __func__) || enter_initialisation(i, __func__, start, has_stop, stop))
        return fmi2Error;
    i->is_set_up = 1;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    REQUIRE_INSTANCE(c)
    if (require_phase(i, 1 << INSTANTIATED, __func__))
        return fmi2Error;
    if (!i->is_set_up)
        return STATUS(report(i, ERROR, "%s is not allowed yet; call fmi2SetupExperiment first", __func__));
    i->phase = INITIALISING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    REQUIRE_INSTANCE(c)
    return STATUS(exit_initialisation(i, __func__));
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    REQUIRE_INSTANCE(c)
    return STATUS(terminate(i, __func__));
}

fmi2Status fmi2Reset(fmi2Component c)
{
    REQUIRE_INSTANCE(c)
    return STATUS(reset(i));
}

#define CALL(kind) &(struct call){__func__, references, count, kind, 0, count}, values

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    REQUIRE_INSTANCE(c)
    return STATUS(get_values(i, CALL(REAL)));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_values(i, CALL(REAL)));
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Integer values[])
{
    REQUIRE_INSTANCE(c)
    return STATUS(get_values(i, CALL(INTEGER_32)));
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Integer values[])
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_values(i, CALL(INTEGER_32)));
}

static fmi2Status without(fmi2Component c, const char *function, size_t count, const char *what)
{
    REQUIRE_INSTANCE(c)
    return count ? STATUS(report(i, ERROR, "%s: the unit has no %s", function, what)) : fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Boolean values[])
{
    (void)references, (void)values;
    return without(c, __func__, count, "Boolean variables");
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Boolean values[])
{
    (void)references, (void)values;
    return without(c, __func__, count, "Boolean variables");
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2String values[])
{
    (void)references, (void)values;
    return without(c, __func__, count, "String variables");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2String values[])
{
    (void)references, (void)values;
    return without(c, __func__, count, "String variables");
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(get_state(i, __func__, state));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(set_state(i, __func__, state));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(free_state(i, __func__, state));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    REQUIRE_INSTANCE(c)
    return STATUS(state_size(i, __func__, state, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    REQUIRE_INSTANCE(c)
    return STATUS(serialise(i, __func__, state, bytes, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    REQUIRE_INSTANCE(c)
    return STATUS(deserialise(i, __func__, bytes, size, state));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t unknown_count,
                                        const fmi2ValueReference knowns[], size_t known_count, const fmi2Real seed[],
                                        fmi2Real sensitivity[])
{
    (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count, (void)seed, (void)sensitivity;
    return without(c, __func__, 1, "directional derivatives");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                       const fmi2Integer orders[], const fmi2Real values[])
{
    (void)references, (void)orders, (void)values;
    return without(c, __func__, count, "input derivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                        const fmi2Integer orders[], fmi2Real values[])
{
    (void)references, (void)orders, (void)values;
    return without(c, __func__, count, "output derivatives");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real duration, fmi2Boolean no_return_before)
{
    REQUIRE_INSTANCE(c)
    (void)no_return_before;
    return STATUS(do_step(i, __func__, time, duration));
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return without(c, __func__, 1, "step in progress: steps end before they return");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    REQUIRE_INSTANCE(c)
    if (kind != fmi2DoStepStatus || !value)
        return without(c, __func__, 1, "status of this kind");
    *value = STATUS(i->last_step);
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    REQUIRE_INSTANCE(c)
    if (kind != fmi2LastSuccessfulTime || !value)
        return without(c, __func__, 1, "real status of this kind");
    *value = i->time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind, (void)value;
    return without(c, __func__, 1, "integer status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    REQUIRE_INSTANCE(c)
    if (kind != fmi2Terminated || !value)
        return without(c, __func__, 1, "Boolean status of this kind");
    *value = i->phase == TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    REQUIRE_INSTANCE(c)
    if (kind != fmi2PendingStatus || !value)
        return without(c, __func__, 1, "string status of this kind");
    *value = "";
    return fmi2OK;
}
