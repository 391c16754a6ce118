/* From instantiation to the end. */
#include "life_cycle.h"

#include "computation.h"
#include "state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void set_starts(struct instance *i)
{
    union cell *cell = i->cells;
    for (int r = 0; r < unit.run_count; r++)
        for (uint32_t k = 0; k < unit.starts[r].count; k++)
            memcpy(cell++, &unit.starts[r].bits, sizeof *cell);
    i->phase = INSTANTIATED;
    i->is_set_up = 0;
    i->is_stale = 1;
    i->time = 0.0;
    i->stop_time = INFINITY;
    i->last_step = OK;
    i->refused_time = i->refused_duration = 0.0;
    i->has_refused = 0;
    i->cautioned = 0;
}

static struct instance *new_instance(const char *name)
{
    struct instance *i = calloc(1, sizeof *i);
    if (!i)
        return NULL;
    i->name = malloc(strlen(name) + 1);
    i->cells = calloc(unit.cell_count, sizeof *i->cells);
    i->backup = malloc(STATE_BYTES);
    if (!i->name || !i->cells || !i->backup) {
        free_instance(i);
        return NULL;
    }
    strcpy(i->name, name);
    set_starts(i);
    return i;
}

struct instance *instantiate(struct importer importer, int logging, const char *function, const char *name,
                             const char *objection, const char *key_name, const char *key)
{
    struct instance refused = {.importer = importer, .name = "", .logging = ERRORS};
    if (!name || !*name)
        return report(&refused, ERROR, "%s: the instance needs a name", function), NULL;
    if (objection)
        return report(&refused, ERROR, "%s: %s", function, objection), NULL;
    if (!key || strcmp(key, unit.identity) != 0)
        return report(&refused, ERROR, "%s: %s %.60s is not %s: library and modelDescription.xml are of two builds", function,
                      key_name, key ? key : "NULL", unit.identity),
               NULL;
    struct instance *i = new_instance(name);
    if (!i)
        return report(&refused, ERROR, "%s: out of memory", function), NULL;
    i->importer = importer;
    i->logging = logging ? ALL : ERRORS;
    return i;
}

void free_instance(struct instance *i)
{
    free_states(i);
    free(i->backup);
    free(i->cells);
    free(i->name);
    free(i);
}

enum status reset(struct instance *i)
{
    set_starts(i);
    return OK;
}

enum status set_times(struct instance *i, const char *function, double start, int has_stop, double stop)
{
    if (require_phase(i, 1 << INSTANTIATED, function))
        return ERROR;
    if (!isfinite(start))
        return report(i, ERROR, "%s: start time of %g s is not a finite number", function, start);
    if (has_stop && !(stop >= start))
        return report(i, ERROR, "%s: stop time of %g s lies before the start time of %g s", function, stop, start);
    i->time = start;
    i->stop_time = has_stop ? stop : INFINITY;
    return OK;
}

enum status exit_initialisation(struct instance *i, const char *function)
{
    if (require_phase(i, 1 << INITIALISING, function) || compute_start(i))
        return ERROR;
    i->phase = STEPPING;
    return OK;
}

enum status terminate(struct instance *i, const char *function)
{
    /* It has ended by itself, at a step that could not be done. */
    if (i->phase == TERMINATED && i->last_step == DISCARD)
        return OK;
    if (require_phase(i, 1 << INITIALISING | 1 << STEPPING, function))
        return ERROR;
    i->phase = TERMINATED;
    return OK;
}
