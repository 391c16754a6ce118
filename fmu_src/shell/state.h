/* state.c */
#ifndef STATE_H
#define STATE_H

#include "instance.h"

INTERNAL enum status get_state(struct instance *, const char *function, void **state);
INTERNAL enum status set_state(struct instance *, const char *function, void *state);
INTERNAL enum status free_state(struct instance *, const char *function, void **state);
INTERNAL enum status state_size(struct instance *, const char *function, void *state, size_t *size);
INTERNAL enum status serialise(struct instance *, const char *function, void *state, void *bytes, size_t size);
INTERNAL enum status deserialise(struct instance *, const char *function, const void *bytes, size_t size, void **state);
INTERNAL void free_states(struct instance *);

#endif
