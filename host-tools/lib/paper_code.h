/* Writes codes of the paper profile (docs/SPEC.md 1.1 and 1.2). */
#ifndef YB_PAPER_CODE_H
#define YB_PAPER_CODE_H

#include "contour_set.h"

/* Bytes of the whole code, check included. */
size_t yb_paper_size(const yb_contour_set_t *set);

/* Writes the code; answers its size, or 0 if a difference does not fit. At most 255 points. Whether
 * the contours are possible only the engine says.
 */
size_t yb_paper_write(const yb_contour_set_t *set, uint8_t code[YB_MAX_CODE_BYTES]);

/* Lays further points on the segments that are longer than a difference can be; a set of another
 * profile needs none. False if there are too many points then.
 */
bool yb_paper_split(yb_contour_set_t *set);

#endif
