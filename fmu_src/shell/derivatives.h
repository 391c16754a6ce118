/* derivatives.c */
#ifndef DERIVATIVES_H
#define DERIVATIVES_H

#include "instance.h"

/* Of a call that asks for directional derivatives.  FMI 2 refers to cells, FMI 3 to whole variables by their first cell. */
struct direction {
    const char *function;
    int whole_variables;
    const uint32_t *unknowns;
    size_t unknown_count;
    const uint32_t *knowns;
    size_t known_count;
    const double *seed;
    size_t seed_count;
    double *sensitivity;
    size_t sensitivity_count;
};
INTERNAL enum status directional_derivative(struct instance *, const struct direction *);

#endif
