/* Any map that a verb can be asked about: a code, or contour lines in full detail. */
#ifndef YB_MAP_FILE_H
#define YB_MAP_FILE_H

#include "code_file.h"
#include "contour_lines.h"
#include "error.h"

/* What could not be kept of the lines, in words; empty if all is there. */
typedef struct {
    char text[256];
} yb_map_note_t;

/* Reads a code (see code_file.h) or a vector file of contour lines, of which field and window are
 * as for yb_lines_from_vector. The map of lines has no code (size 0), no fractal detail, and an
 * origin. NULL with a sentence in `error` if it is neither. The caller frees it by
 * yb_code_file_free.
 */
yb_code_file_t *yb_map_file_read(const char *path, const char *field, const yb_window_t *window,
                                 yb_map_note_t *note, yb_error_t *error);

#endif
