#include "error.h"

#include <stdarg.h>
#include <stdio.h>

bool yb_error_set(yb_error_t *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof(error->text), format, arguments);
    va_end(arguments);
    return false;
}
