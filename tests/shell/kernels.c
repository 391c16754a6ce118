/* Kernels without physics for the tables of shell_unit.py. */
#include "places.h"
#include "unit.h"

#include <math.h>

enum mode { STILL, FAULT, LONG_FAULT, UNKNOWN_FAULT, NOT_FINITE, PARTS, CAUTIONED, NO_WAY_UP };

static int64_t answer(union cell *c)
{
    enum mode mode = (enum mode)c[AT_MODE].integer;
    c[AT_ANSWER].real = c[AT_GAIN].real * c[AT_PUSH].real + c[AT_TIGHT].real + c[AT_STUCK].real;
    for (int k = 0; k < 6; k++)
        c[AT_ANSWERS + k].real = c[AT_FAR_FIELD + k].real + (double)k * c[AT_PUSH].real;
    if (mode == NOT_FINITE)
        c[AT_ANSWERS + 4].real = INFINITY;
    if (mode == CAUTIONED)
        c[AT_COUNT].integer = 1;
    return mode == FAULT ? 1 : mode == LONG_FAULT ? 2 : mode == UNKNOWN_FAULT ? 99 : mode == NO_WAY_UP && c[AT_PUSH].real > 0.0 ? 1 : 0;
}

int64_t initialise(void *cells)
{
    return answer(cells);
}

int64_t step(void *cells, double time, double duration)
{
    union cell *c = cells;
    (void)time;
    c[AT_MEMORY].real += duration;
    c[AT_DONE].real = c[AT_MODE].integer == PARTS && c[AT_EARLY].integer > 0 ? 0.25e-3 : 0.0;
    if (c[AT_DONE].real >= duration)
        c[AT_DONE].real = 0.0;
    return answer(c);
}
