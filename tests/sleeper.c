/* An FMI 2.0 unit that hangs, crashes or answers, in whichever function the environment names: HANG_IN, from the time HANG_FROM on. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static double now, x;

static void perhaps_hang(const char *function)
{
    const char *named = getenv("HANG_IN"), *from = getenv("HANG_FROM");
    if (named && strcmp(named, function) == 0 && now >= (from ? atof(from) : 0.0))
        for (;;)
            sleep(1);
}

#define CALL(name, ...) \
    int name(__VA_ARGS__) \
    { \
        perhaps_hang(#name);

void *fmi2Instantiate(const char *a, int b, const char *c, const char *d, const void *e, int f, int g)
{
    perhaps_hang("fmi2Instantiate");
    return &x;
}

void fmi2FreeInstance(void *c) { perhaps_hang("fmi2FreeInstance"); }

CALL(fmi2SetupExperiment, void *c, int a, double b, double time, int d, double e) now = time; return 0; }
CALL(fmi2EnterInitializationMode, void *c) return 0; }
CALL(fmi2ExitInitializationMode, void *c) return 0; }
CALL(fmi2Terminate, void *c) return 0; }
CALL(fmi2DoStep, void *c, double time, double step, int d) now = time + step; x += step; return 0; }
CALL(fmi2GetReal, void *c, const unsigned *r, size_t n, double *v) for (size_t k = 0; k < n; k++) v[k] = x; return 0; }
CALL(fmi2SetReal, void *c, const unsigned *r, size_t n, const double *v) return 0; }
CALL(fmi2GetFMUstate, void *c, void **s) *s = &x; return 0; }
CALL(fmi2SetFMUstate, void *c, void *s) return 0; }
CALL(fmi2FreeFMUstate, void *c, void **s) *s = NULL; return 0; }

/* What a unit must have and this one does not need. */
#define NONE(name) \
    int name(void) { return 3; }
NONE(fmi2GetTypesPlatform)
NONE(fmi2GetVersion)
NONE(fmi2SetDebugLogging)
NONE(fmi2Reset)
NONE(fmi2GetInteger)
NONE(fmi2GetBoolean)
NONE(fmi2GetString)
NONE(fmi2SetInteger)
NONE(fmi2SetBoolean)
NONE(fmi2SetString)
NONE(fmi2SerializedFMUstateSize)
NONE(fmi2SerializeFMUstate)
NONE(fmi2DeSerializeFMUstate)
NONE(fmi2GetDirectionalDerivative)
NONE(fmi2SetRealInputDerivatives)
NONE(fmi2GetRealOutputDerivatives)
NONE(fmi2CancelStep)
NONE(fmi2GetStatus)
NONE(fmi2GetRealStatus)
NONE(fmi2GetIntegerStatus)
NONE(fmi2GetBooleanStatus)
NONE(fmi2GetStringStatus)
