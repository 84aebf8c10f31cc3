/* A contour set as the bytes of its profile, and what the engine makes of them. */
#ifndef YB_CONTOUR_CODE_H
#define YB_CONTOUR_CODE_H

#include "code_bits.h"
#include "code_file.h"
#include "contour_set.h"

/* Room for any code, on the stack. */
enum {
    YB_CONTOUR_CODE_BYTES = 4096
};

/* Writes the code by its profile; answers its size, or 0 if it does not fit the profile or the
 * room. bits, which may be NULL, becomes its size with fractions of a bit, where it has such.
 */
size_t yb_contour_code_write(const yb_contour_set_t *set, uint8_t *code, size_t room,
                             yb_bits_t *bits);
bool yb_contour_code_fits(const yb_contour_set_t *set, size_t most_bytes);

/* Writes the code, with the number of vertices if that is not known yet, and loads it with the
 * engine: what the one decoder says of it. The caller frees it by yb_code_file_free. NULL with a
 * sentence: it does not fit the profile, or its contours are impossible.
 */
yb_code_file_t *yb_contour_code_load(const yb_contour_set_t *set, yb_error_t *error);

#endif
