/* Why a call of the library failed, in one sentence for the user: it names the file and says what
 * to do. Calls that can fail take a yb_error_t, fill it and answer false (or NULL).
 */
#ifndef YB_ERROR_H
#define YB_ERROR_H

#include <stdbool.h>

typedef struct {
    char text[640];
} yb_error_t;

/* Writes the sentence; always false, so that a caller can return it. */
bool yb_error_set(yb_error_t *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
