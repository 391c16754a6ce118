/* What all else needs of an instance: its messages, and whether it may do what it is asked. */
#include "instance.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const CATEGORY[] = {"logAll", "logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal"};

static int category_index(const char *name)
{
    for (int i = 0; i < unit.category_count; i++)
        if (name && strcmp(name, unit.categories[i]) == 0)
            return i;
    return -1;
}

enum status report(struct instance *i, enum status status, const char *format, ...)
{
    char text[TEXT_SIZE];
    int index = category_index(CATEGORY[status]);
    if (i->logging == NOTHING || (i->logging == ERRORS && status < ERROR && !i->is_urgent) || i->muted >> index & 1)
        return status;
    va_list arguments;
    va_start(arguments, format);
    int used = snprintf(text, sizeof text, "%s: ", unit.name);
    vsnprintf(text + used, sizeof text - (size_t)used, format, arguments);
    va_end(arguments);
    i->importer.deliver(i, status, CATEGORY[status], text);
    return status;
}

enum status set_logging(struct instance *i, int on, size_t count, const char *const *categories)
{
    uint32_t muted = count ? ~(uint32_t)0 : 0;
    if (count && !categories)
        return report(i, ERROR, "%lu log categories announced, none given", (unsigned long)count);
    for (size_t k = 0; k < count; k++) {
        int index = category_index(categories[k]);
        if (index < 0)
            return report(i, ERROR, "there is no log category %.100s; see LogCategories of the model description",
                          categories[k] ? categories[k] : "NULL");
        muted = strcmp(categories[k], "logAll") == 0 ? 0 : muted & ~((uint32_t)1 << index);
        if (!muted)
            break;
    }
    i->logging = on ? ALL : NOTHING;
    i->muted = muted;
    return OK;
}

enum status refuse(struct instance *i, const char *function, size_t count, const char *what)
{
    if (!i)
        return ERROR;
    return count ? report(i, ERROR, "%s: the unit has no %s", function, what) : OK;
}

enum status require_phase(struct instance *i, unsigned phases, const char *function)
{
    static const char *const WHERE[] = {
        "before initialisation; enter and exit initialisation mode first",
        "in initialisation mode; exit it first",
        "once the unit is initialised; reset the unit to start anew",
        "after termination; reset the unit, or restore a state",
    };
    if (phases >> i->phase & 1)
        return OK;
    return report(i, ERROR, "%s is not allowed %s", function, WHERE[i->phase]);
}
