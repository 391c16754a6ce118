/* values.c */
#ifndef VALUES_H
#define VALUES_H

#include "instance.h"

enum kind { REAL, INTEGER_32, INTEGER_64 };

/* One call that gets or sets values.  FMI 2 refers to cells, FMI 3 to whole variables by their first cell. */
struct call {
    const char *function;
    const uint32_t *references;
    size_t reference_count;
    enum kind kind;
    int whole_variables;
    size_t value_count;
};
/* The variable that a cell belongs to; NULL if none. */
INTERNAL const struct variable *find_variable(uint32_t cell);
/* ERROR with a message unless all variables of the call exist, have so many values, and are of one of the roles (bits 1 << role). */
INTERNAL enum status check_roles(struct instance *, const struct call *, const void *values, unsigned roles, const char *what);
INTERNAL enum status get_values(struct instance *, const struct call *, void *values);
INTERNAL enum status set_values(struct instance *, const struct call *, const void *values);

#endif
