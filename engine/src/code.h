/* The decoder's parts: the container (code.c) and the two profiles of what it holds.
 *
 *     yb_map_feed ─► first byte ─┬─► paper_take ───┬─► sections ─► check ─► yb_map_build
 *                                └─► compact_take ─┘
 */
#ifndef YB_CODE_H
#define YB_CODE_H

#include <yamabiko/yamabiko.h>

/* A section begins with a byte: is it the last one, which is it, how long (15: two bytes say). */
enum {
    SECTION_LAST = 0x80,
    SECTION_LONG = 15
};

/* Each takes the next byte of the relief. YB_MORE until the byte that ends it, then YB_OK: for the
 * paper profile that is its last byte, for the compact one the first byte after it.
 */
YB_MUST_CHECK yb_status_t paper_take(yb_load_t *load, uint8_t byte);
YB_MUST_CHECK yb_status_t compact_take(yb_load_t *load, uint8_t byte);

/* Adds a point of a contour, at whole steps. False: it is not in the frame, or one too many. */
YB_MUST_CHECK bool add_point(yb_load_t *load, int32_t x, int32_t y, int32_t units);

/* From units above the base to q8 steps; rest_64th_m is what base_m leaves of the base. False: too
 * low or too high.
 */
YB_MUST_CHECK bool settle_height(const yb_map_t *map, uint32_t rest_64th_m, int32_t *height);

/* Gets ready for the byte after the first one. */
void compact_begin(yb_load_t *load);

#endif
