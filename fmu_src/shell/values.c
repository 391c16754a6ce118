/* Getting and setting values, with the checks of fmu_src/variables.py. */
#include "values.h"

#include "computation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What one value reference stands for. */
struct span {
    const struct variable *variable; /* NULL: the time */
    uint32_t cell, size;
};

const struct variable *find_variable(uint32_t cell)
{
    int low = 0, high = unit.variable_count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (unit.variables[middle].first <= cell)
            low = middle;
        else
            high = middle;
    }
    const struct variable *v = &unit.variables[low];
    /* A cell before the first one wraps round to a large number. */
    return cell - v->first < v->size ? v : NULL;
}

/* "mesh_force[1,7]" */
static const char *element_name(const struct variable *v, uint32_t element, char *text, size_t size)
{
    uint32_t index[MOST_DIMENSIONS];
    for (int d = v->dimensions - 1; d >= 0; d--) {
        index[d] = element % v->shape[d] + 1;
        element /= v->shape[d];
    }
    int used = snprintf(text, size, "%s", v->name);
    for (int d = 0; d < v->dimensions && used < (int)size; d++)
        used += snprintf(text + used, size - (size_t)used, "%s%u%s", d ? "," : "[", (unsigned)index[d],
                         d == v->dimensions - 1 ? "]" : "");
    return text;
}

static enum status resolve(struct instance *i, const struct call *call, size_t k, struct span *span)
{
    uint32_t reference = call->references[k];
    const struct variable *v = span->variable;
    if (call->whole_variables && reference == unit.cell_count && call->kind == REAL) {
        *span = (struct span){NULL, 0, 1};
        return OK;
    }
    if (!v || reference < v->first || reference - v->first >= v->size)
        v = find_variable(reference);
    if (!v || (call->whole_variables ? reference != v->first : v->role == PROFILE))
        return report(i, ERROR, "%s: %s has no variable with value reference %u", call->function, unit.name, (unsigned)reference);
    if (v->is_integer != (call->kind != REAL)) {
        char name[256];
        return report(i, ERROR, "%s: %s is %s: use the functions of its type", call->function,
                      element_name(v, reference - v->first, name, sizeof name),
                      v->is_integer ? "an integer or enumeration" : "a real");
    }
    *span = (struct span){v, reference, call->whole_variables ? v->size : 1};
    return OK;
}

/* Resolves references from number k on; how many of them the span stands for, 0 if there is no such variable.
 * Elements of one variable in a row are one span: masters ask for hundreds of them in one call.
 */
static size_t resolve_span(struct instance *i, const struct call *call, size_t k, struct span *span)
{
    const uint32_t *references = call->references + k;
    size_t count = 1;
    if (resolve(i, call, k, span))
        return 0;
    if (call->whole_variables)
        return 1;
    size_t left = call->reference_count - k, most = span->variable->size - (span->cell - span->variable->first);
    if (most > left)
        most = left;
    while (count < most && references[count] == references[0] + count)
        count++;
    span->size = (uint32_t)count;
    return count;
}

/* Resolves all references: each must exist, and together they must have as many values as were given. */
static enum status check_call(struct instance *i, const struct call *call, const void *values, int *has_outputs)
{
    struct span span = {0};
    size_t total = 0;
    if ((call->reference_count && !call->references) || (call->value_count && !values))
        return report(i, ERROR, "%s: an array is missing (NULL)", call->function);
    for (size_t k = 0, count; k < call->reference_count; k += count) {
        count = resolve_span(i, call, k, &span);
        if (!count)
            return ERROR;
        total += span.size;
        *has_outputs |= span.variable && span.variable->role == OUTPUT;
    }
    if (total != call->value_count)
        return report(i, ERROR, "%s: the variables have %lu values, %lu were given", call->function, (unsigned long)total,
                      (unsigned long)call->value_count);
    return OK;
}

enum status check_roles(struct instance *i, const struct call *call, const void *values, unsigned roles, const char *what)
{
    int has_outputs = 0;
    if (check_call(i, call, values, &has_outputs))
        return ERROR;
    struct span span = {0};
    for (size_t k = 0; k < call->reference_count; k++) {
        char name[256];
        resolve(i, call, k, &span);
        if (!span.variable || !(roles >> span.variable->role & 1))
            return report(i, ERROR, "%s: %s cannot be %s", call->function,
                          span.variable ? element_name(span.variable, span.cell - span.variable->first, name, sizeof name) : "time", what);
    }
    return OK;
}

enum status get_values(struct instance *i, const struct call *call, void *values)
{
    int has_outputs = 0;
    if (check_call(i, call, values, &has_outputs))
        return ERROR;
    if (has_outputs && i->phase == INITIALISING && i->is_stale && refresh_outputs(i))
        return ERROR;
    struct span span = {0};
    for (size_t k = 0, place = 0; k < call->reference_count;) {
        k += resolve_span(i, call, k, &span);
        const union cell *from = i->cells + span.cell;
        if (!span.variable)
            ((double *)values)[place++] = i->time;
        else if (call->kind == REAL) {
            memcpy((double *)values + place, from, span.size * sizeof *from);
            place += span.size;
        } else
            for (uint32_t e = 0; e < span.size; e++, place++)
                if (call->kind == INTEGER_32)
                    ((int32_t *)values)[place] = (int32_t)from[e].integer;
                else
                    ((int64_t *)values)[place] = from[e].integer;
    }
    return OK;
}

static union cell value_at(const struct call *call, const void *values, size_t place)
{
    union cell value;
    if (call->kind == REAL)
        value.real = ((const double *)values)[place];
    else
        value.integer = call->kind == INTEGER_32 ? ((const int32_t *)values)[place] : ((const int64_t *)values)[place];
    return value;
}

static enum status check_settable(struct instance *i, const struct call *call, const struct span *span)
{
    char name[256];
    if (!span->variable)
        return report(i, ERROR, "%s: the time is set by steps, not as a variable", call->function);
    const struct variable *v = span->variable;
    if (v->role == OUTPUT || v->role == PROFILE)
        return report(i, ERROR, "%s is an output of %s; it cannot be set",
                      element_name(v, span->cell - v->first, name, sizeof name), unit.name);
    if (v->role == FIXED_PARAMETER && i->phase == STEPPING)
        return report(i, ERROR, "%s is fixed once the unit is initialised; reset the unit to change it",
                      element_name(v, span->cell - v->first, name, sizeof name));
    return OK;
}

static enum status refuse_value(struct instance *i, const struct variable *v, uint32_t element, union cell value)
{
    double number = v->is_integer ? (double)value.integer : value.real;
    char name[256];
    element_name(v, element, name, sizeof name);
    if (v->choices)
        return report(i, ERROR, "%s = %g is not one of %s", name, number, v->choices);
    if (isnan(number) || isinf(number))
        return report(i, ERROR, "%s = %s%s is not a finite number; give a value in %s", name,
                      isnan(number) ? "nan" : number > 0 ? "inf" : "-inf", v->unit, *v->unit ? v->unit + 1 : "1");
    return report(i, ERROR, "%s = %g%s is out of range: it must lie in [%g, %g]%s", name, number, v->unit, v->lowest, v->highest,
                  v->unit);
}

/* Number of the first value of a span that is out of its variable's range, or the span's size. */
static uint32_t first_out_of_range(const struct call *call, const struct span *span, const void *values, size_t place)
{
    double lowest = span->variable->lowest, highest = span->variable->highest;
    const double *reals = (const double *)values + place;
    for (uint32_t e = 0; e < span->size; e++) {
        double number = call->kind == REAL ? reals[e] : (double)value_at(call, values, place + e).integer;
        if (!(number >= lowest && number <= highest)) /* true for a NaN */
            return e;
    }
    return span->size;
}

/* All values are checked before the first is set. */
enum status set_values(struct instance *i, const struct call *call, const void *values)
{
    int has_outputs = 0;
    if (require_phase(i, 1 << INSTANTIATED | 1 << INITIALISING | 1 << STEPPING, call->function)
        || check_call(i, call, values, &has_outputs))
        return ERROR;
    struct span span = {0};
    for (size_t k = 0, place = 0; k < call->reference_count;) {
        k += resolve_span(i, call, k, &span);
        if (check_settable(i, call, &span))
            return ERROR;
        uint32_t e = first_out_of_range(call, &span, values, place);
        if (e < span.size)
            return refuse_value(i, span.variable, span.cell - span.variable->first + e, value_at(call, values, place + e));
        place += span.size;
    }
    span.variable = NULL;
    for (size_t k = 0, place = 0; k < call->reference_count;) {
        k += resolve_span(i, call, k, &span);
        if (call->kind == REAL)
            memcpy(i->cells + span.cell, (const double *)values + place, span.size * sizeof *i->cells);
        else
            for (uint32_t e = 0; e < span.size; e++)
                i->cells[span.cell + e] = value_at(call, values, place + e);
        place += span.size;
    }
    i->is_stale = 1;
    return OK;
}
