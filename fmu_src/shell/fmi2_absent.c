/* What FMI 2.0 wants exported and this unit does not offer: each call is refused with a message. */
#include "fmi2Functions.h"

#define FMI(name) fmi2##name
#include "calls.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"

#define REFERENCES fmi2Component c, const fmi2ValueReference references[], size_t count
#define REFUSE_TYPE(type)                                                                                                        \
    REFUSE_SOME(Get##type, (REFERENCES, fmi2##type values[]), count, #type " variables")                                         \
    REFUSE_SOME(Set##type, (REFERENCES, const fmi2##type values[]), count, #type " variables")

REFUSE_TYPE(Boolean)
REFUSE_TYPE(String)
REFUSE_SOME(SetRealInputDerivatives, (REFERENCES, const fmi2Integer orders[], const fmi2Real values[]), count,
            "input derivatives")
REFUSE_SOME(GetRealOutputDerivatives, (REFERENCES, const fmi2Integer orders[], fmi2Real values[]), count, "output derivatives")
REFUSE(GetIntegerStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value), "integer status")
REFUSE(CancelStep, (fmi2Component c), "step in progress: steps end before they return")
