/* A code and the map that the engine makes of it; or contour lines and their map (map_file.h). */
#ifndef YB_CODE_FILE_H
#define YB_CODE_FILE_H

#include <stddef.h>
#include <stdint.h>

#include <yamabiko/yamabiko.h>

#include "contour_lines.h"
#include "error.h"
#include "sections.h"

typedef struct {
    yb_map_t map;
    yb_load_t load;         /* its contours stay valid: see yamabiko.h */
    size_t size;            /* of the code in bytes; 0: there is none, the map is made of lines */
    yb_origin_t origin;     /* of a map made of lines, or of a code that says its place */
    yb_sections_t sections; /* of a code */
    uint8_t bytes[];
} yb_code_file_t;

/* Reads a code, the whole of the standard input if path is "-", and loads it. NULL with a sentence
 * in `error` if there is no such file or it is no valid code. The caller frees it by
 * yb_code_file_free.
 */
yb_code_file_t *yb_code_file_read(const char *path, yb_error_t *error);

/* The same for bytes at hand; `name` stands for them in the sentence. */
yb_code_file_t *yb_code_file_from_bytes(const char *name, const uint8_t *bytes, size_t size,
                                        yb_error_t *error);

/* NULL does nothing. */
void yb_code_file_free(yb_code_file_t *file);

#endif
