/* Takes a native unit of FMI 3.0 through a file of orders (see flavours.py) and writes its state after the start and after each step:
 *     run_unit LIBRARY TOKEN ORDERS OUT */
#include "fmi3FunctionTypes.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <windows.h>
#define LOAD(path) LoadLibraryA(path)
#define FIND(name) ((name##TYPE *)(void *)GetProcAddress(library, #name))
#else
#include <dlfcn.h>
#define LOAD(path) dlopen(path, RTLD_NOW)
#define FIND(name) ((name##TYPE *)dlsym(library, #name))
#endif
#define MOST 4096

static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    (void)environment, (void)category;
    fprintf(stderr, "%d: %s\n", status, text);
}

static void *library;

static int write_state(fmi3Instance unit, FILE *out)
{
    fmi3FMUState state = NULL;
    size_t size;
    if (FIND(fmi3GetFMUState)(unit, &state) || FIND(fmi3SerializedFMUStateSize)(unit, state, &size))
        return 1;
    fmi3Byte *bytes = malloc(size);
    int failed = FIND(fmi3SerializeFMUState)(unit, state, bytes, size) || fwrite(bytes, 1, size, out) != size;
    free(bytes);
    return failed || FIND(fmi3FreeFMUState)(unit, &state);
}

int main(int count, char **given)
{
    if (count != 5 || !(library = (void *)LOAD(given[1])))
        return fprintf(stderr, "run_unit LIBRARY TOKEN ORDERS OUT\n"), 2;
    FILE *orders = fopen(given[3], "r"), *out = fopen(given[4], "wb");
    fmi3Instance unit = FIND(fmi3InstantiateCoSimulation)("unit", given[2], "", false, true, false, false, NULL, 0, NULL, say, NULL);
    if (!orders || !out || !unit)
        return 2;
    static double reals[MOST];
    static fmi3Int64 whole[MOST];
    char order[16];
    while (fscanf(orders, "%15s", order) == 1) {
        if (strcmp(order, "init") == 0 || strcmp(order, "step") == 0) {
            double time, duration;
            if (fscanf(orders, "%lf %lf", &time, &duration) != 2)
                return 3;
            fmi3Boolean a, b, c;
            double last;
            if (*order == 'i' ? FIND(fmi3EnterInitializationMode)(unit, false, 0.0, 0.0, false, 0.0) || FIND(fmi3ExitInitializationMode)(unit)
                              : FIND(fmi3DoStep)(unit, time, duration, true, &a, &b, &c, &last) > fmi3Warning)
                return 4;
            if (write_state(unit, out))
                return 5;
            continue;
        }
        fmi3ValueReference reference;
        unsigned long size;
        if (fscanf(orders, "%u %lu", &reference, &size) != 2 || size > MOST)
            return 6;
        for (unsigned long k = 0; k < size; k++) {
            if (fscanf(orders, "%lf", &reals[k]) != 1)
                return 7;
            whole[k] = (fmi3Int64)reals[k];
        }
        if (*order == 'i' ? FIND(fmi3SetInt64)(unit, &reference, 1, whole, size) : FIND(fmi3SetFloat64)(unit, &reference, 1, reals, size))
            return 8;
    }
    FIND(fmi3FreeInstance)(unit);
    return fclose(out) != 0;
}
