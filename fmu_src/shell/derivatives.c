/* Directional derivatives of outputs by inputs and tunable parameters, what the unit has gone through held.
 *
 * They are differences of steps of no length: the kernels go there from the present point by Newton steps with
 * the tangent, which leaves rounding alone.  Where a bound is near all points lie on its inner side.
 */
#include "derivatives.h"

#include "values.h"

#include <math.h>
#include <string.h>

/* Largest change of a known, over its nominal value. */
#define SHARE 1e-3

/* Where the outputs are taken, as multiples of the step, and what they count. */
struct points {
    int count;
    double place[3], weight[3];
};
static const struct points CENTRAL = {2, {1.0, -1.0, 0.0}, {0.5, -0.5, 0.0}};
static const struct points FORWARD = {3, {0.0, 1.0, 2.0}, {-1.5, 2.0, -0.5}};
static const struct points BACKWARD = {3, {0.0, -1.0, -2.0}, {1.5, -2.0, 0.5}};

static enum status check(struct instance *i, const struct direction *d)
{
    if (require_phase(i, 1 << STEPPING, d->function))
        return ERROR;
    struct call unknowns = {d->function, d->unknowns, d->unknown_count, REAL, d->whole_variables, d->sensitivity_count};
    struct call knowns = {d->function, d->knowns, d->known_count, REAL, d->whole_variables, d->seed_count};
    if (check_roles(i, &unknowns, d->sensitivity, 1 << OUTPUT, "an unknown: only outputs have directional derivatives")
        || check_roles(i, &knowns, d->seed, 1 << INPUT | 1 << TUNABLE_PARAMETER,
                       "a known: derivatives are by inputs and tunable parameters"))
        return ERROR;
    for (size_t k = 0; k < d->seed_count; k++)
        if (!isfinite(d->seed[k]))
            return report(i, ERROR, "%s: seed %lu of %g is not a finite number", d->function, (unsigned long)k, d->seed[k]);
    return OK;
}

/* The cell that a value of a call stands for; walks on from ``place`` through the references. */
struct walk {
    size_t reference;
    uint32_t element;
};
static uint32_t next_cell(const uint32_t *references, int whole_variables, struct walk *w, const struct variable **v)
{
    uint32_t cell = references[w->reference] + w->element;
    *v = find_variable(cell);
    if (whole_variables && ++w->element < (*v)->size)
        return cell;
    w->element = 0;
    w->reference++;
    return cell;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* The step along the seed, and on which side of the present values there is room for it. */
static double step_along(const struct instance *i, const struct direction *d, const struct points **points)
{
    double size = INFINITY, up = INFINITY, down = INFINITY;
    struct walk w = {0, 0};
    for (size_t k = 0; k < d->seed_count; k++) {
        const struct variable *v;
        double now = i->cells[next_cell(d->knowns, d->whole_variables, &w, &v)].real, seed = d->seed[k];
        if (seed == 0.0)
            continue;
        size = smaller(size, SHARE * v->nominal / fabs(seed));
        up = smaller(up, ((seed > 0.0 ? v->highest : v->lowest) - now) / seed);
        down = smaller(down, (now - (seed > 0.0 ? v->lowest : v->highest)) / seed);
    }
    *points = up >= size && down >= size ? &CENTRAL : up >= down ? &FORWARD : &BACKWARD;
    /* Between bounds closer than the step. */
    return *points == &CENTRAL ? size : smaller(size, 0.5 * (up > down ? up : down));
}

static void add(struct instance *i, const struct direction *d, double weight)
{
    struct walk w = {0, 0};
    for (size_t k = 0; k < d->sensitivity_count; k++) {
        const struct variable *v;
        d->sensitivity[k] += weight * i->cells[next_cell(d->unknowns, d->whole_variables, &w, &v)].real;
    }
}

static int64_t look_at(struct instance *i, const struct direction *d, double way)
{
    struct walk w = {0, 0};
    memcpy(i->cells, i->backup, STATE_BYTES);
    for (size_t k = 0; k < d->seed_count; k++) {
        const struct variable *v;
        uint32_t cell = next_cell(d->knowns, d->whole_variables, &w, &v);
        i->cells[cell].real += way * d->seed[k];
    }
    return step(i->cells, i->time, 0.0);
}

enum status directional_derivative(struct instance *i, const struct direction *d)
{
    const struct points *points;
    int64_t code = 0;
    if (check(i, d))
        return ERROR;
    memset(d->sensitivity, 0, d->sensitivity_count * sizeof *d->sensitivity);
    double size = step_along(i, d, &points);
    if (!isfinite(size))
        return OK; /* nothing is to be changed */
    if (!(size > 0.0))
        return report(i, DISCARD, "%s: between their bounds the knowns have no room to change; see min and max", d->function);
    memcpy(i->backup, i->cells, STATE_BYTES);
    for (int p = 0; p < points->count && !code; p++) {
        code = look_at(i, d, points->place[p] * size);
        add(i, d, points->weight[p] / size);
    }
    memcpy(i->cells, i->backup, STATE_BYTES);
    if (code)
        return report(i, DISCARD, "%s: with other values of the knowns there is no equilibrium here (fault %lld)", d->function,
                      (long long)code);
    return OK;
}
