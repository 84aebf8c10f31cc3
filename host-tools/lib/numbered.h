/* Names of a series of files: a pattern with one %d or %0Nd, as in f-%03d.png. */
#ifndef YB_NUMBERED_H
#define YB_NUMBERED_H

#include "error.h"

/* False with a sentence unless the pattern has exactly one number, %d or %0Nd with N from 1 to 9,
 * and otherwise no % but %%.
 */
bool yb_numbered_check(const char *pattern, yb_error_t *error);

/* The name with a number filled in, to be freed; the pattern must have passed the check. NULL: no
 * memory.
 */
char *yb_numbered_name(const char *pattern, int number);

#endif
