/* States of the C shell: saved, restored, freed, and blocks of bytes that are no states. */
#include "fmi2Functions.h"
#include "calls.h"

static void states(void)
{
    fmi2Component c = ready2();
    fmi2FMUstate first = NULL, second = NULL, third = NULL, none = NULL;
    size_t size = 0;
    FAILS("no place for the state", fmi2GetFMUstate(c, NULL));
    countdown = 0;
    FAILS("out of memory for a state", fmi2GetFMUstate(c, &first));
    countdown = NEVER;
    WELL(fmi2GetFMUstate(c, &first));
    WELL(fmi2GetFMUstate(c, &first));
    WELL(fmi2GetFMUstate(c, &second));
    FAILS("no state of this instance", fmi2GetFMUstate(c, &c));
    FAILS("no state of this instance", fmi2SetFMUstate(c, c));
    FAILS("no place for the size", fmi2SerializedFMUstateSize(c, first, NULL));
    FAILS("no state of this instance", fmi2SerializedFMUstateSize(c, c, &size));
    WELL(fmi2SerializedFMUstateSize(c, first, &size));
    char *bytes = malloc(size), *forged = malloc(size);
    FAILS("no state of this instance", fmi2SerializeFMUstate(c, c, bytes, size));
    FAILS("0 bytes are too few", fmi2SerializeFMUstate(c, first, NULL, size));
    FAILS("are too few", fmi2SerializeFMUstate(c, first, bytes, size - 1));
    WELL(fmi2SerializeFMUstate(c, first, bytes, size));
    WELL(fmi2SetFMUstate(c, first));
    FAILS("no state of this instance", fmi2FreeFMUstate(c, &c));
    WELL(fmi2FreeFMUstate(c, NULL));
    WELL(fmi2FreeFMUstate(c, &none));
    WELL(fmi2FreeFMUstate(c, &first));

    FAILS("no state given", fmi2DeSerializeFMUstate(c, NULL, size, &third));
    FAILS("no state given", fmi2DeSerializeFMUstate(c, bytes, size, NULL));
    FAILS("not a state", fmi2DeSerializeFMUstate(c, bytes, 7, &third));
    memcpy(forged, bytes, size);
    forged[0] = 'X';
    FAILS("not a state", fmi2DeSerializeFMUstate(c, forged, size, &third));
    memcpy(forged, bytes, size);
    forged[8] = '?';
    FAILS("from the same build", fmi2DeSerializeFMUstate(c, forged, size, &third));
    memset(forged + 8, '?', 40);
    FAILS("from the same build", fmi2DeSerializeFMUstate(c, forged, size, &third));
    FAILS("cut off", fmi2DeSerializeFMUstate(c, bytes, size - 8, &third));
    memcpy(forged, bytes, size);
    forged[48]++; /* so many cells */
    FAILS("cut off or added to", fmi2DeSerializeFMUstate(c, forged, size, &third));
    memcpy(forged, bytes, size);
    forged[size - 1]++;
    FAILS("damaged", fmi2DeSerializeFMUstate(c, forged, size, &third));
    /* Two words changed so that their sum stays: the weighted sum finds it. */
    memcpy(forged, bytes, size);
    forged[size - 8] = 1;
    forged[size - 16] = -1;
    memset(forged + size - 15, -1, 7);
    FAILS("damaged", fmi2DeSerializeFMUstate(c, forged, size, &third));
    countdown = 0;
    FAILS("out of memory for a state", fmi2DeSerializeFMUstate(c, bytes, size, &third));
    countdown = NEVER;
    WELL(fmi2DeSerializeFMUstate(c, bytes, size, &third));
    WELL(fmi2SetFMUstate(c, third));
    WELL(fmi2FreeFMUstate(c, &second));
    free(bytes);
    free(forged);
    fmi2FreeInstance(c); /* with the third */
}

/* Words of a block as fmu_src/state.py has them. */
enum { IDENTITY = 8, CELLS = 48, PHASE = 56, IS_SET_UP = 64, TIME = 72, STOP_TIME = 80, SUMS = 88, HEADER = 104 };

static void sum_up(char *block, size_t size)
{
    uint64_t sums[2] = {0, 0}, word;
    memcpy(block + SUMS, sums, sizeof sums);
    for (size_t k = 0; k < size / 8; k++) {
        memcpy(&word, block + 8 * k, 8);
        sums[0] += word;
        sums[1] += (k < HEADER / 8 ? k + 1 : k - HEADER / 8 + 1) * word;
    }
    memcpy(block + SUMS, sums, sizeof sums);
}

static void forge(fmi2Component c, const char *good, size_t size, size_t place, const void *word, const char *words)
{
    fmi2FMUstate state = NULL;
    char *block = malloc(size);
    memcpy(block, good, size);
    memcpy(block + place, word, 8);
    sum_up(block, size);
    FAILS(words, fmi2DeSerializeFMUstate(c, block, size, &state));
    free(block);
}

static void forged_states(void)
{
    fmi2Component c = ready2();
    fmi2FMUstate state = NULL;
    size_t size;
    WELL(fmi2GetFMUstate(c, &state));
    WELL(fmi2SerializedFMUstateSize(c, state, &size));
    char *good = malloc(size);
    WELL(fmi2SerializeFMUstate(c, state, good, size));
    int64_t below = -1, beyond = 4;
    double nan = NAN, small = -11.0, large = 11.0;
    forge(c, good, size, PHASE, &below, "header makes no sense");
    forge(c, good, size, PHASE, &beyond, "header makes no sense");
    forge(c, good, size, TIME, &nan, "header makes no sense");
    forge(c, good, size, STOP_TIME, &nan, "header makes no sense");
    forge(c, good, size, HEADER + 8 * AT_PUSH, &small, "impossible in push");
    forge(c, good, size, HEADER + 8 * AT_PUSH, &large, "impossible in push");
    forge(c, good, size, HEADER + 8 * AT_MODE, &below, "impossible in mode");
    free(good);
    fmi2FreeInstance(c);
}

void call_states(void)
{
    states();
    forged_states();
}
