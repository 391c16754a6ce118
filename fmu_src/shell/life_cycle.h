/* life_cycle.c */
#ifndef LIFE_CYCLE_H
#define LIFE_CYCLE_H

#include "instance.h"

/* NULL with a message if there is no name, an objection, or a key (what the version calls key_name) that is not this unit's. */
INTERNAL struct instance *instantiate(struct importer, int logging, const char *function, const char *name, const char *objection,
                                      const char *key_name, const char *key);
INTERNAL void free_instance(struct instance *);
INTERNAL enum status reset(struct instance *);
/* Start and stop time, before initialisation. */
INTERNAL enum status set_times(struct instance *, const char *function, double start, int has_stop, double stop);
INTERNAL enum status exit_initialisation(struct instance *, const char *function);
INTERNAL enum status terminate(struct instance *, const char *function);

#endif
