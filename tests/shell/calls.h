/* What the callers of the C shell (fmi2_calls.c, fmi2_states.c, fmi3_calls.c) have in common: calls with the status and the words that they must give. */
#include "places.h" /* AT_...: the first cell of each variable */
#include "unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern char said[8192];     /* by the unit, last */
extern int countdown;       /* allocations until one fails */
#define NEVER (-1)

void expect(int status, int right, const char *words, const char *call, int line);
void *ready2(void); /* an initialised instance of FMI 2.0 */
void call_states(void);
void call_fmi3(void);

/* A call's status and what it must say; NULL: nothing at all. */
#define SAYS(status, words, call)                            \
    do {                                                     \
        *said = 0;                                           \
        expect((int)(call), status, words, #call, __LINE__); \
    } while (0)
#define WELL(call) SAYS(0, NULL, call)
#define WARNS(words, call) SAYS(1, words, call)
#define DISCARDS(words, call) SAYS(2, words, call)
#define FAILS(words, call) SAYS(3, words, call)
#define IS(what) SAYS(1, NULL, (what) != 0)

/* References of FMI 2 and 3: an array's first cell. */
#define LIST(...) ((const unsigned[]){__VA_ARGS__}), sizeof((const unsigned[]){__VA_ARGS__}) / sizeof(unsigned)
#define REALS(...) ((double[]){__VA_ARGS__})
