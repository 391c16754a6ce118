/* computation.c */
#ifndef COMPUTATION_H
#define COMPUTATION_H

#include "instance.h"

/* Runs the initialisation; on failure the state is what it was. */
INTERNAL enum status compute_start(struct instance *);
/* Outputs for the values set so far; all else stays, so that the later initialisation is not touched by it. */
INTERNAL enum status refresh_outputs(struct instance *);
/* The time then is what was reached: before the end of the step if the instance lets it pause. */
INTERNAL enum status do_step(struct instance *, const char *function, double time, double duration);

#endif
