/* Writes codes of the compact profile (docs/SPEC.md 1.3), and tells what each bit goes for. */
#ifndef YB_COMPACT_CODE_H
#define YB_COMPACT_CODE_H

#include "code_bits.h"
#include "code_file.h"
#include "contour_set.h"

/* Writes a code; answers its size, or 0 if the set does not fit the profile: a point off the
 * lattice, a line at no multiple of the interval, more than `room` bytes. Lines come in the set's
 * order, from the first of their points; spot heights in the order of their rows. bits, which may
 * be NULL, becomes the size with its fractions of a bit. Whether the contours are possible only the
 * engine says.
 */
size_t yb_compact_write(const yb_contour_set_t *set, uint8_t *code, size_t room, yb_bits_t *bits);

/* The set that a code was written from: writing it again gives the code's bytes. */
void yb_compact_read(const yb_code_file_t *file, yb_contour_set_t *set);

#endif
