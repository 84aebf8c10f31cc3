/* Output files that are never half-written: what a verb makes is written in a new directory beside
 * the file it will be, and moved there in one step when it is whole.
 *
 *     yb_output_t *output = yb_output_open("map.png", force, &error);
 *     if (output == NULL)
 *         return cli_fail("%s", error.text);
 *     bool good = write_png(yb_output_path(output));
 *     good = good && yb_output_commit(output, &error);
 *     yb_output_close(output);
 *
 * "-" means the standard output: it gets the whole file at the commit, or nothing. So do devices
 * and pipes.
 */
#ifndef YB_OUTPUT_H
#define YB_OUTPUT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "error.h"

typedef struct yb_output yb_output_t;

/* False if `path` may not be written: it is a directory, its directory does not exist, or it exists
 * and `force` is false. For verbs that work long before they write.
 */
bool yb_output_allowed(const char *path, bool force, yb_error_t *error);

/* Checks as above and makes room for the file. NULL with a sentence if that fails. */
yb_output_t *yb_output_open(const char *path, bool force, yb_error_t *error);

/* Where to write until the commit: a name that does not exist yet, with the same ending as the
 * path. Valid until yb_output_close.
 */
const char *yb_output_path(const yb_output_t *output);

/* Moves what was written to its place. */
bool yb_output_commit(yb_output_t *output, yb_error_t *error);

/* Removes what was not committed. NULL does nothing. */
void yb_output_close(yb_output_t *output);

/* All of it: opens a stream, lets `write` fill it, commits. */
typedef bool (*yb_output_write_fn)(FILE *stream, const void *context);
bool yb_output_stream(const char *path, bool force, yb_output_write_fn write, const void *context,
                      yb_error_t *error);

/* The same for bytes at hand. */
bool yb_output_write(const char *path, bool force, const void *bytes, size_t size,
                     yb_error_t *error);

#endif
