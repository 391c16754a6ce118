/* Steps the plant through a tenth of a second without Python, with a parameter of its own, and reads a number and an element of an array:
 *     unzip -d plant dist/fmi2/RvPlant.fmu
 *     cc -I FMI_HEADERS examples/load_fmu.c -o load_fmu -ldl && ./load_fmu plant linux64/RvPlant.so
 * The headers are those of the FMI 2.0 standard; fmpy brings them in its folder c-code. */
#include "fmi2FunctionTypes.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <windows.h>
#define LOAD(path) LoadLibraryA(path)
#define FIND(library, name) ((name##TYPE *)(void *)GetProcAddress(library, #name))
#else
#include <dlfcn.h>
#define LOAD(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) ((name##TYPE *)dlsym(library, #name))
#endif

static void say(void *environment, const char *name, fmi2Status status, const char *category, const char *text, ...)
{
    fprintf(stderr, "%s: %s\n", name, text);
}

/* Number by which calls name a variable, out of its model description.  FMI 2.0 has each element of an array as a variable, counted from 1. */
static fmi2ValueReference reference(const char *description, const char *name)
{
    char wanted[128];
    snprintf(wanted, sizeof wanted, "name=\"%s\"", name);
    const char *found = strstr(description, wanted);
    if (!found)
        fprintf(stderr, "no variable %s\n", name), exit(2);
    return (unsigned)strtoul(strstr(found, "valueReference=") + 16, NULL, 10);
}

int main(int count, char **arguments)
{
    char path[1024], guid[64];
    static char text[1 << 22];
    if (count != 3)
        return fprintf(stderr, "load_fmu FOLDER LIBRARY\n"), 2;
    snprintf(path, sizeof path, "%s/modelDescription.xml", arguments[1]);
    FILE *file = fopen(path, "rb");
    if (!file || !fread(text, 1, sizeof text - 1, file) || sscanf(strstr(text, "guid="), "guid=\"%63[^\"]", guid) != 1)
        return fprintf(stderr, "no model description at %s\n", path), 2;
    snprintf(path, sizeof path, "%s/binaries/%s", arguments[1], arguments[2]);
    void *library = LOAD(path);
    if (!library)
        return fprintf(stderr, "cannot load %s\n", path), 2;
    fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
    /* Radial clearance of the needle bearings [m], set before initialisation as any parameter; force of the first disc on the 30th pin. */
    fmi2ValueReference clearance = reference(text, "bearing.clearance"), seen[] = {reference(text, "output.lag"), reference(text, "mesh.force[1,30]")};
    double wider = 3e-6;
    fmi2Component plant = FIND(library, fmi2Instantiate)("plant", fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2True);
    if (!plant || FIND(library, fmi2SetupExperiment)(plant, fmi2False, 0, 0, fmi2False, 0) ||
        FIND(library, fmi2SetReal)(plant, &clearance, 1, &wider) ||
        FIND(library, fmi2EnterInitializationMode)(plant) || FIND(library, fmi2ExitInitializationMode)(plant))
        return 1;
    for (int i = 0; i < 100; i++) {
        double values[2];
        if (FIND(library, fmi2DoStep)(plant, 1e-3 * i, 1e-3, fmi2True) || FIND(library, fmi2GetReal)(plant, seen, 2, values))
            return 1;
        printf("%.3f s  lag %.17g rad  force %.17g N\n", 1e-3 * (i + 1), values[0], values[1]);
    }
    FIND(library, fmi2FreeInstance)(plant);
    return 0;
}
