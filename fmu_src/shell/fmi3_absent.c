/* What FMI 3.0 wants exported and this unit does not offer: each call is refused with a message. */
#include "fmi3Functions.h"

#define FMI(name) fmi3##name
#include "calls.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"

#define REFERENCES fmi3Instance c, const fmi3ValueReference references[], size_t count
#define REFUSE_TYPE(type)                                                                                                        \
    REFUSE_SOME(Get##type, (REFERENCES, fmi3##type values[], size_t value_count), count, #type " variables")                     \
    REFUSE_SOME(Set##type, (REFERENCES, const fmi3##type values[], size_t value_count), count, #type " variables")

REFUSE_TYPE(Float32)
REFUSE_TYPE(Int8)
REFUSE_TYPE(UInt8)
REFUSE_TYPE(Int16)
REFUSE_TYPE(UInt16)
REFUSE_TYPE(Int32)
REFUSE_TYPE(UInt32)
REFUSE_TYPE(UInt64)
REFUSE_TYPE(Boolean)
REFUSE_TYPE(String)
REFUSE_SOME(GetBinary, (REFERENCES, size_t sizes[], fmi3Binary values[], size_t value_count), count, "Binary variables")
REFUSE_SOME(SetBinary, (REFERENCES, const size_t sizes[], const fmi3Binary values[], size_t value_count), count,
            "Binary variables")
REFUSE_SOME(GetClock, (REFERENCES, fmi3Clock values[]), count, "clocks")
REFUSE_SOME(SetClock, (REFERENCES, const fmi3Clock values[]), count, "clocks")
REFUSE_SOME(GetIntervalDecimal, (REFERENCES, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]), count, "clocks")
REFUSE_SOME(GetIntervalFraction,
            (REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]), count, "clocks")
REFUSE_SOME(GetShiftDecimal, (REFERENCES, fmi3Float64 shifts[]), count, "clocks")
REFUSE_SOME(GetShiftFraction, (REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[]), count, "clocks")
REFUSE_SOME(SetIntervalDecimal, (REFERENCES, const fmi3Float64 intervals[]), count, "clocks")
REFUSE_SOME(SetIntervalFraction, (REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]), count, "clocks")
REFUSE_SOME(SetShiftDecimal, (REFERENCES, const fmi3Float64 shifts[]), count, "clocks")
REFUSE_SOME(SetShiftFraction, (REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]), count, "clocks")
REFUSE_SOME(GetOutputDerivatives, (REFERENCES, const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count), count,
            "output derivatives")

#define DERIVATIVE                                                                                                               \
    (fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[],               \
     size_t known_count, const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count)
REFUSE(GetAdjointDerivative, DERIVATIVE, "adjoint derivatives")
REFUSE(GetNumberOfVariableDependencies, (fmi3Instance c, fmi3ValueReference reference, size_t *count),
       "dependencies per element; see ModelStructure")
REFUSE(GetVariableDependencies,
       (fmi3Instance c, fmi3ValueReference dependent, size_t elements[], fmi3ValueReference independents[],
        size_t independent_elements[], fmi3DependencyKind kinds[], size_t count),
       "dependencies per element; see ModelStructure")

REFUSE(EnterConfigurationMode, (fmi3Instance c), "structural parameters")
REFUSE(ExitConfigurationMode, (fmi3Instance c), "structural parameters")
REFUSE(EnterEventMode, (fmi3Instance c), "event mode")
REFUSE(EnterStepMode, (fmi3Instance c), "event mode to return from")
REFUSE(EvaluateDiscreteStates, (fmi3Instance c), "event mode")
REFUSE(UpdateDiscreteStates,
       (fmi3Instance c, fmi3Boolean *needs_update, fmi3Boolean *terminates, fmi3Boolean *nominals_changed,
        fmi3Boolean *values_changed, fmi3Boolean *has_next_event, fmi3Float64 *next_event),
       "event mode")
REFUSE(ActivateModelPartition, (fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time), "scheduled execution")

REFUSE(EnterContinuousTimeMode, (fmi3Instance c), "model exchange")
REFUSE(CompletedIntegratorStep,
       (fmi3Instance c, fmi3Boolean no_return_before, fmi3Boolean *enters_event_mode, fmi3Boolean *terminates), "model exchange")
REFUSE(SetTime, (fmi3Instance c, fmi3Float64 time), "model exchange")
REFUSE(SetContinuousStates, (fmi3Instance c, const fmi3Float64 states[], size_t count), "model exchange")
REFUSE(GetContinuousStates, (fmi3Instance c, fmi3Float64 states[], size_t count), "model exchange")
REFUSE(GetContinuousStateDerivatives, (fmi3Instance c, fmi3Float64 derivatives[], size_t count), "model exchange")
REFUSE(GetNominalsOfContinuousStates, (fmi3Instance c, fmi3Float64 nominals[], size_t count), "model exchange")
REFUSE(GetEventIndicators, (fmi3Instance c, fmi3Float64 indicators[], size_t count), "model exchange")
REFUSE(GetNumberOfEventIndicators, (fmi3Instance c, size_t *count), "model exchange")
REFUSE(GetNumberOfContinuousStates, (fmi3Instance c, size_t *count), "model exchange")

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger)
{
    if (logger)
        logger(environment, fmi3Error, "logStatusError", "this is a co-simulation unit, not one for model exchange");
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                               fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback logger, fmi3ClockUpdateCallback update,
                                               fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    if (logger)
        logger(environment, fmi3Error, "logStatusError", "this is a co-simulation unit, not one for scheduled execution");
    return NULL;
}
