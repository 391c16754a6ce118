/* What the generated table of a unit tells the shell; nothing here knows a particular unit. */
#ifndef UNIT_H
#define UNIT_H

#include <stddef.h>
#include <stdint.h>

/* Hidden, so that two units in one process cannot take each other's functions; in one source file (all.c) they are static. */
#if defined(UNIT_IN_ONE_FILE)
#define INTERNAL static
#define DECLARED static
#define DEFINED static
#else
#if defined(__ELF__)
#define INTERNAL __attribute__((visibility("hidden")))
#else
#define INTERNAL
#endif
#define DECLARED extern INTERNAL
#define DEFINED
#endif

#define MOST_DIMENSIONS 4

union cell {
    double real;
    int64_t integer;
};

enum role { INPUT, FIXED_PARAMETER, TUNABLE_PARAMETER, OUTPUT, PROFILE };

struct variable {
    const char *name;
    const char *unit;    /* with a blank before it; empty if there is none */
    const char *choices; /* "0 (line), 1 (palmgren)", or NULL */
    enum role role;
    int is_integer;
    uint32_t first, size;
    int dimensions;
    uint32_t shape[MOST_DIMENSIONS];
    double lowest, highest, nominal;
};

/* Start values of all cells, equal neighbours together. */
struct run {
    uint32_t count;
    uint64_t bits;
};

/* A fault's text: literals, each followed by the number in a cell (or by nothing if cell < 0). */
struct piece {
    const char *literal;
    int cell;
    int is_integer;
    const char *format;
};

struct fault {
    int64_t code;
    const struct piece *pieces;
    int piece_count;
};

/* Said once when the integer in the cell is no longer 0. */
struct caution {
    uint32_t cell;
    const char *text;
};

/* What the numbers of a part of the state may be; integers are indices and counts of the kernels. */
struct range {
    const char *name;
    uint32_t first, size;
    int is_integer;
    double lowest, highest;
};

struct unit {
    const char *name;
    const char *identity; /* FMI 2 guid, FMI 3 instantiation token */
    uint32_t cell_count, state_cells, interface_cells;
    const struct variable *variables; /* by ascending first cell */
    int variable_count;
    const struct run *starts;
    int run_count;
    const struct fault *faults;
    int fault_count;
    const struct caution *cautions; /* at most 32 */
    int caution_count;
    const char *const *categories; /* at most 32, those of all statuses among them */
    int category_count;
    uint32_t guarded_cells; /* leading cells that a failing step may have changed */
    double longest_step;
    int pause_cell, paused_cell; /* where a step may end before its time, and how much of it was done; -1: never */
    const struct range *ranges; /* all cells of the state, in their order */
    int range_count;
};

DECLARED const struct unit unit;

/* The kernels; 0, or a fault's code. */
DECLARED int64_t initialise(void *cells);
DECLARED int64_t step(void *cells, double time, double duration);

#endif
