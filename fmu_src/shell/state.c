/* The complete state as one block: a header, then the record's cells.  fmu_src/state.py has the same layout. */
#include "state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct header {
    char magic[8];
    char identity[40];
    int64_t cells, phase, is_set_up;
    double time, stop_time;
    uint64_t sum, weighted_sum;
};

/* A state that an instance has handed out.  Only those in its list are ever read. */
struct state {
    struct state *next;
    struct header header;
    union cell cells[];
};

#define BLOCK_BYTES (sizeof(struct header) + STATE_BYTES)

static const char MAGIC[8] = {'R', 'V', 's', 't', 'a', 't', 'e', '3'};

/* Plain and weighted sum of all words: finds what is changed, missing or in another place. */
static void add_sums(struct header *header, const void *words, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        uint64_t word;
        memcpy(&word, (const char *)words + k * sizeof word, sizeof word);
        header->sum += word;
        header->weighted_sum += (k + 1) * word;
    }
}

/* The header with the sums that belong to it and these cells. */
static struct header summed(struct header header, const void *cells)
{
    struct header bare = header;
    bare.sum = bare.weighted_sum = header.sum = header.weighted_sum = 0;
    add_sums(&header, &bare, sizeof bare / sizeof(uint64_t));
    add_sums(&header, cells, unit.state_cells);
    return header;
}

static struct state *known(struct instance *i, const char *function, const void *state)
{
    for (struct state *s = i->states; s; s = s->next)
        if (s == state)
            return s;
    report(i, ERROR, "%s: this is no state of this instance, or it was freed; serialise a state to carry it elsewhere", function);
    return NULL;
}

static struct state *new_state(struct instance *i)
{
    struct state *s = malloc(sizeof *s + STATE_BYTES);
    if (!s) {
        report(i, ERROR, "out of memory for a state of %lu bytes", (unsigned long)BLOCK_BYTES);
        return NULL;
    }
    s->next = i->states;
    i->states = s;
    return s;
}

void free_states(struct instance *i)
{
    while (i->states) {
        struct state *s = i->states;
        i->states = s->next;
        free(s);
    }
}

enum status get_state(struct instance *i, const char *function, void **state)
{
    if (!state)
        return report(i, ERROR, "%s: no place for the state (NULL)", function);
    struct state *s = *state ? known(i, function, *state) : new_state(i);
    if (!s)
        return ERROR;
    memset(&s->header, 0, sizeof s->header);
    memcpy(s->header.magic, MAGIC, sizeof MAGIC);
    strncpy(s->header.identity, unit.identity, sizeof s->header.identity - 1);
    s->header.cells = unit.state_cells;
    s->header.phase = i->phase;
    s->header.is_set_up = i->is_set_up;
    s->header.time = i->time;
    s->header.stop_time = i->stop_time;
    memcpy(s->cells, i->cells, STATE_BYTES);
    *state = s;
    return OK;
}

enum status set_state(struct instance *i, const char *function, void *state)
{
    struct state *s = known(i, function, state);
    if (!s)
        return ERROR;
    memcpy(i->cells, s->cells, STATE_BYTES);
    i->phase = (enum phase)s->header.phase;
    i->is_set_up = s->header.is_set_up != 0;
    i->time = s->header.time;
    i->stop_time = s->header.stop_time;
    i->is_stale = 1;
    return OK;
}

enum status free_state(struct instance *i, const char *function, void **state)
{
    if (!state || !*state)
        return OK;
    struct state *s = known(i, function, *state), **link = &i->states;
    if (!s)
        return ERROR;
    while (*link != s)
        link = &(*link)->next;
    *link = s->next;
    free(s);
    *state = NULL;
    return OK;
}

enum status state_size(struct instance *i, const char *function, void *state, size_t *size)
{
    if (!size)
        return report(i, ERROR, "%s: no place for the size (NULL)", function);
    if (!known(i, function, state))
        return ERROR;
    *size = BLOCK_BYTES;
    return OK;
}

enum status serialise(struct instance *i, const char *function, void *state, void *bytes, size_t size)
{
    struct state *s = known(i, function, state);
    if (!s)
        return ERROR;
    if (!bytes || size < BLOCK_BYTES)
        return report(i, ERROR, "%s: %lu bytes are too few for a state of %lu", function, (unsigned long)(bytes ? size : 0),
                      (unsigned long)BLOCK_BYTES);
    s->header = summed(s->header, s->cells);
    memcpy(bytes, &s->header, sizeof s->header);
    memcpy((char *)bytes + sizeof s->header, s->cells, STATE_BYTES);
    return OK;
}

/* The first number of a state that the unit cannot have got to, or NULL.  A NaN fails both comparisons. */
static const struct range *impossible(const union cell *cells)
{
    for (const struct range *r = unit.ranges; r < unit.ranges + unit.range_count; r++)
        for (const union cell *c = cells + r->first; c < cells + r->first + r->size; c++) {
            double value = r->is_integer ? (double)c->integer : c->real;
            if (!(value >= r->lowest && value <= r->highest))
                return r;
        }
    return NULL;
}

enum status deserialise(struct instance *i, const char *function, const void *bytes, size_t size, void **state)
{
    struct header header;
    if (!bytes || !state)
        return report(i, ERROR, "%s: no state given, or no place for it (NULL)", function);
    if (size < sizeof header || memcmp(bytes, MAGIC, sizeof MAGIC) != 0)
        return report(i, ERROR, "%s: %lu bytes that are not a state of this kind of unit", function, (unsigned long)size);
    memcpy(&header, bytes, sizeof header);
    if (header.identity[sizeof header.identity - 1] || strcmp(header.identity, unit.identity) != 0)
        return report(i, ERROR, "%s: the state is of unit %.39s, this is %s: it must come from the same build", function,
                      header.identity, unit.identity);
    if (size != BLOCK_BYTES || header.cells != unit.state_cells)
        return report(i, ERROR, "%s: %lu bytes of a state that has %lu: it was cut off or added to", function, (unsigned long)size,
                      (unsigned long)BLOCK_BYTES);
    struct header right = summed(header, (const char *)bytes + sizeof header);
    if (header.sum != right.sum || header.weighted_sum != right.weighted_sum)
        return report(i, ERROR, "%s: the state is damaged, its checksum does not fit", function);
    if (header.phase < INSTANTIATED || header.phase > TERMINATED || !isfinite(header.time) || isnan(header.stop_time))
        return report(i, ERROR, "%s: the state's header makes no sense", function);
    struct state *s = new_state(i);
    if (!s)
        return ERROR;
    s->header = header;
    memcpy(s->cells, (const char *)bytes + sizeof header, STATE_BYTES);
    const struct range *wrong = impossible(s->cells);
    if (wrong) {
        void *useless = s;
        free_state(i, function, &useless);
        return report(i, ERROR, "%s: the state is impossible in %s; it was not saved by this unit", function, wrong->name);
    }
    *state = s;
    return OK;
}
