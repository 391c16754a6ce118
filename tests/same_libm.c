/* A source unit through some steps, then its whole state to the standard output: run it with the C library that the
 * WebAssembly component has, and not a bit may differ.  Arguments: token, then reference and value of what is set. */
#include "all.c"

#include <stdio.h>
#include <stdlib.h>

static void log_nothing(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    (void)environment;
    fprintf(stderr, "%d %s %s\n", status, category, text);
}

int main(int count, char **given)
{
    fmi3Instance i = fmi3InstantiateCoSimulation("unit", given[1], "", false, true, false, false, NULL, 0, NULL, log_nothing, NULL);
    for (int k = 2; k + 2 < count; k += 3) {
        fmi3ValueReference reference = (fmi3ValueReference)atoi(given[k + 1]);
        double real = atof(given[k + 2]);
        fmi3Int64 whole = (fmi3Int64)real;
        if (given[k][0] == 'r' ? fmi3SetFloat64(i, &reference, 1, &real, 1) : fmi3SetInt64(i, &reference, 1, &whole, 1))
            return 1;
    }
    if (fmi3EnterInitializationMode(i, false, 0.0, 0.0, false, 0.0) || fmi3ExitInitializationMode(i))
        return 2;
    for (int n = 0; n < 40; n++)
        if (fmi3DoStep(i, n * 0x1p-10, 0x1p-10, true, NULL, NULL, NULL, NULL))
            return 3;
    fmi3FMUState state = NULL;
    size_t size;
    if (fmi3GetFMUState(i, &state) || fmi3SerializedFMUStateSize(i, state, &size))
        return 4;
    fmi3Byte *bytes = malloc(size);
    if (fmi3SerializeFMUState(i, state, bytes, size))
        return 5;
    return fwrite(bytes, 1, size, stdout) != size;
}
