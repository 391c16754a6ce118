/* One instance of the unit, whatever the FMI version. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "unit.h"

/* The numbers are those of fmi2Status and fmi3Status. */
enum status { OK, WARNING, DISCARD, ERROR, FATAL };

/* Saved states hold these numbers, see fmu_src/state.py. */
enum phase { INSTANTIATED, INITIALISING, STEPPING, TERMINATED };

struct state;

struct instance {
    /* Hands a message to the importer's logger in the manner of its FMI version. */
    void (*deliver)(const struct instance *, enum status, const char *category, const char *text);
    void (*logger)(void);
    void *environment;
    char *name;
    int logging;
    uint32_t muted; /* one bit per category */
    enum phase phase;
    int is_set_up;   /* FMI 2: fmi2SetupExperiment was called */
    int is_stale;    /* initialisation mode: outputs do not fit the values set */
    double time, stop_time;
    enum status last_step;
    union cell *cells;
    union cell *backup; /* guarded cells before a step; NULL if failing steps change nothing */
    struct state *states;
};

#define TEXT_SIZE 2048

/* Logs a message and returns the status. */
INTERNAL enum status report(struct instance *, enum status, const char *format, ...)
#if defined(__GNUC__) && !defined(__MINGW32__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;
INTERNAL enum status set_logging(struct instance *, int on, size_t count, const char *const *categories);

INTERNAL struct instance *new_instance(const char *name);
INTERNAL void free_instance(struct instance *);
INTERNAL enum status reset(struct instance *);

/* ERROR with a message unless the instance is in one of the phases (bits 1 << phase). */
INTERNAL enum status require_phase(struct instance *, unsigned phases, const char *function);
INTERNAL enum status enter_initialisation(struct instance *, const char *function, double start, int has_stop, double stop);
INTERNAL enum status exit_initialisation(struct instance *, const char *function);
INTERNAL enum status refresh_outputs(struct instance *);
INTERNAL enum status do_step(struct instance *, const char *function, double time, double duration);
INTERNAL enum status terminate(struct instance *, const char *function);

/* values.c */
enum kind { REAL, INTEGER_32, INTEGER_64 };

/* One call that gets or sets values.  FMI 2 refers to cells, FMI 3 to whole variables by their first cell. */
struct call {
    const char *function;
    const uint32_t *references;
    size_t reference_count;
    enum kind kind;
    int whole_variables;
    size_t value_count;
};
INTERNAL enum status get_values(struct instance *, const struct call *, void *values);
INTERNAL enum status set_values(struct instance *, const struct call *, const void *values);

/* state.c */
INTERNAL enum status get_state(struct instance *, const char *function, void **state);
INTERNAL enum status set_state(struct instance *, const char *function, void *state);
INTERNAL enum status free_state(struct instance *, const char *function, void **state);
INTERNAL enum status state_size(struct instance *, const char *function, void *state, size_t *size);
INTERNAL enum status serialise(struct instance *, const char *function, void *state, void *bytes, size_t size);
INTERNAL enum status deserialise(struct instance *, const char *function, const void *bytes, size_t size, void **state);
INTERNAL void free_states(struct instance *);

#endif
