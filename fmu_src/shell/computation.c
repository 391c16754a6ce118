/* The kernels' initialisation and steps; one that fails leaves the state as it was. */
#include "computation.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static int append(char *text, int used, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int more = vsnprintf(text + used, TEXT_SIZE - (size_t)used, format, arguments);
    va_end(arguments);
    return used + more < TEXT_SIZE ? used + more : TEXT_SIZE - 1;
}

/* A fault's message with the numbers that the cells hold now. */
static void report_fault(struct instance *i, enum status status, int64_t code, double time)
{
    char text[TEXT_SIZE] = "";
    int used = 0;
    const struct fault *fault = NULL;
    for (int f = 0; f < unit.fault_count; f++)
        if (unit.faults[f].code == code)
            fault = &unit.faults[f];
    if (!fault)
        used = append(text, used, "the kernels failed with code %lld; check the values set", (long long)code);
    for (int p = 0; fault && p < fault->piece_count; p++) {
        const struct piece *piece = &fault->pieces[p];
        used = append(text, used, "%s", piece->literal);
        if (piece->cell < 0)
            continue;
        if (piece->is_integer)
            used = append(text, used, piece->format, (long long)i->cells[piece->cell].integer);
        else
            used = append(text, used, piece->format, i->cells[piece->cell].real);
    }
    report(i, status, "at time %.9g s: %s", time, text);
}

/* The first output that is not finite, or NULL. */
static const struct variable *spoilt_output(const struct instance *i)
{
    for (const struct variable *v = unit.variables; v < unit.variables + unit.variable_count; v++)
        if (v->role == OUTPUT && !v->is_integer)
            for (uint32_t k = 0; k < v->size; k++)
                if (!isfinite(i->cells[v->first + k].real))
                    return v;
    return NULL;
}

enum status compute_start(struct instance *i)
{
    memcpy(i->backup, i->cells, STATE_BYTES);
    int64_t code = initialise(i->cells);
    const struct variable *spoilt = code ? NULL : spoilt_output(i);
    if (code)
        report_fault(i, ERROR, code, i->time);
    else if (spoilt)
        report(i, ERROR, "at time %.9g s: %s is not finite after initialisation; check the parameters", i->time, spoilt->name);
    if (code || spoilt)
        memcpy(i->cells, i->backup, STATE_BYTES);
    return code || spoilt ? ERROR : OK;
}

enum status refresh_outputs(struct instance *i)
{
    enum status status = compute_start(i);
    /* What was set, with the outputs of now. */
    for (const struct variable *v = unit.variables; v < unit.variables + unit.variable_count; v++)
        if (status == OK && v->role == OUTPUT)
            memcpy(i->backup + v->first, i->cells + v->first, v->size * sizeof *i->cells);
    memcpy(i->cells, i->backup, STATE_BYTES);
    i->is_stale = status != OK;
    return status;
}

static enum status check_step(struct instance *i, const char *function, double time, double duration)
{
    if (require_phase(i, 1 << STEPPING, function))
        return ERROR;
    if (!isfinite(time))
        return report(i, ERROR, "%s: communication point of %g s is not a finite number", function, time);
    if (!(duration > 0.0 && duration <= unit.longest_step))
        return report(i, ERROR, "at time %.9g s: communication step of %g s: give a positive one of at most %g s", time,
                      duration, unit.longest_step);
    double slack = 1e-9 * (fabs(time) + duration);
    if (time + duration > i->stop_time + slack)
        return report(i, ERROR, "at time %.9g s: a step of %g s goes beyond the stop time of %.9g s; set it later or not at all",
                      time, duration, i->stop_time);
    if (fabs(time - i->time) > slack)
        return report(i, WARNING, "step from %.9g s, but the last one ended at %.9g s; it starts from the present state", time,
                      i->time);
    return OK;
}

static void say_cautions(struct instance *i)
{
    for (int k = 0; k < unit.caution_count; k++) {
        if (i->cells[unit.cautions[k].cell].integer == 0 || i->cautioned >> k & 1)
            continue;
        i->cautioned |= (uint32_t)1 << k;
        report(i, WARNING, "at time %.9g s: %s", i->time, unit.cautions[k].text);
    }
}

enum status do_step(struct instance *i, const char *function, double time, double duration)
{
    enum status status = check_step(i, function, time, duration);
    i->last_step = status;
    if (status > WARNING)
        return status;
    /* Importers that know of no smaller step ask for the refused one for ever. */
    int is_again = time == i->refused_time && duration == i->refused_duration && !memcmp(i->backup, i->cells, GUARDED_BYTES);
    memcpy(i->backup, i->cells, GUARDED_BYTES);
    if (unit.pause_cell >= 0)
        i->cells[unit.pause_cell].integer = i->pausing;
    int64_t code = step(i->cells, time, duration);
    /* An importer's wish is no part of the state. */
    if (unit.pause_cell >= 0)
        i->cells[unit.pause_cell].integer = NOWHERE;
    const struct variable *spoilt = code ? NULL : spoilt_output(i);
    if (!code && !spoilt) {
        double done = unit.pause_cell >= 0 ? i->cells[unit.paused_cell].real : 0.0;
        i->time = time + (done > 0.0 ? done : duration);
        i->refused_duration = 0.0;
        say_cautions(i);
        return status;
    }
    /* What lies beyond the guarded cells, worn surfaces, is not put back. */
    int is_lost = spoilt && unit.guarded_cells < unit.state_cells;
    /* Why a first step is refused, or a unit ends: many an importer stops there. */
    i->is_urgent = is_again || is_lost || !i->has_refused;
    i->has_refused = 1;
    if (code)
        report_fault(i, DISCARD, code, time);
    else
        report(i, DISCARD, "at time %.9g s: the step would make %s infinite or not a number; check the inputs%s", time, spoilt->name,
               is_lost ? "; the unit is terminated, reset it" : "");
    memcpy(i->cells, i->backup, GUARDED_BYTES);
    if (is_again)
        report(i, DISCARD, "at time %.9g s: the same step of %.9g s was asked for again: the unit is terminated", time, duration);
    i->is_urgent = 0;
    if (is_lost || is_again)
        i->phase = TERMINATED;
    i->refused_time = time;
    i->refused_duration = duration;
    return i->last_step = DISCARD;
}
