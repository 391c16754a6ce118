/* How a call of either FMI version becomes one of the functions that both share.
 *
 * Before including it a version says how it writes its names: FMI(Reset), and those of saved states.
 */
#ifndef FMI
#error "define FMI(name), STATE(before, after) and DESERIALISE first"
#endif

#include "instance.h"

/* In ``expression`` the instance is ``i``; without one the call is an error. */
#define FORWARD(name, parameters, expression)                                                                                    \
    FMI(Status) FMI(name) parameters                                                                                             \
    {                                                                                                                            \
        struct instance *i = c;                                                                                                  \
        return i ? (FMI(Status))(expression) : FMI(Error);                                                                       \
    }

/* What the unit does not offer; for nothing (count 0) anyone may ask. */
#define REFUSE_SOME(name, parameters, count, what)                                                                               \
    FMI(Status) FMI(name) parameters                                                                                             \
    {                                                                                                                            \
        return (FMI(Status))refuse(c, __func__, count, what);                                                                    \
    }
#define REFUSE(name, parameters, what) REFUSE_SOME(name, parameters, 1, what)
