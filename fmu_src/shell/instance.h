/* One instance of the unit, whatever the FMI version. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "unit.h"

/* The numbers are those of fmi2Status and fmi3Status. */
enum status { OK, WARNING, DISCARD, ERROR, FATAL };

/* Saved states hold these numbers, see fmu_src/state.py. */
/* The kernels know these numbers, see rv_reducer/judgement.py. */
enum pausing { NOWHERE, WHERE_JUDGED_OTHERWISE, EVERYWHERE };

enum phase { INSTANTIATED, INITIALISING, STEPPING, TERMINATED };

struct instance;
struct state;

/* What goes to the importer's log: without debug logging the reasons of errors alone, and what is urgent. */
enum logging { NOTHING, ERRORS, ALL };

/* Who asks. */
struct importer {
    /* Hands a message to the logger in the manner of the importer's FMI version. */
    void (*deliver)(const struct instance *, enum status, const char *category, const char *text);
    void (*logger)(void);
    void *environment;
};

struct instance {
    struct importer importer;
    char *name;
    enum logging logging;
    int is_urgent;
    uint32_t muted; /* one bit per category */
    enum phase phase;
    int is_set_up;   /* FMI 2: fmi2SetupExperiment was called */
    int is_stale;    /* initialisation mode: outputs do not fit the values set */
    double time, stop_time;
    enum status last_step;
    double refused_time, refused_duration; /* of the last step that could not be done; 0 long: none */
    int has_refused; /* a step, since it was made or reset */
    enum pausing pausing; /* FMI 3: where a step may end before its time */
    int may_return_early;
    void (*update)(void); /* FMI 3: called between the parts of a step */
    uint32_t cautioned; /* one bit per caution that was said */
    union cell *cells;
    union cell *backup; /* cells before a step or an initialisation: nothing is allocated then */
    struct state *states; /* those handed out, see state.c */
};

#define TEXT_SIZE 2048
#define GUARDED_BYTES (unit.guarded_cells * sizeof(union cell))
#define STATE_BYTES (unit.state_cells * sizeof(union cell))

/* Logs a message and returns the status. */
INTERNAL enum status report(struct instance *, enum status, const char *format, ...)
#if defined(__GNUC__) && !defined(__MINGW32__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;
INTERNAL enum status set_logging(struct instance *, int on, size_t count, const char *const *categories);

/* For what the unit does not offer: ERROR with a message, unless nothing (count 0) was asked for. */
INTERNAL enum status refuse(struct instance *, const char *function, size_t count, const char *what);

/* ERROR with a message unless the instance is in one of the phases (bits 1 << phase). */
INTERNAL enum status require_phase(struct instance *, unsigned phases, const char *function);

#endif
