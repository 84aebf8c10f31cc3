/* One drawn frame, kept whole. */
#ifndef YB_STILL_H
#define YB_STILL_H

#include <jansson.h>

#include <yamabiko/yamabiko.h>

typedef struct {
    yb_view_t view;
    yb_screen_t screen;
    yb_stats_t stats;
    uint16_t shadow_side;
    uint8_t *pixels; /* height rows of yb_screen_pitch bytes */
} yb_still_t;

/* Draws a frame, band_rows rows at a time (0: all at once), with shadows by a grid of so many cells
 * a side (0: none; view->shadow is not looked at). False: no memory.
 */
bool yb_still_draw(yb_still_t *still, const yb_map_t *map, const yb_view_t *view,
                   const yb_screen_t *screen, uint16_t band_rows, uint16_t shadow_side);
void yb_still_free(yb_still_t *still);

/* FNV-1a, 32 bits, over the pixel bytes of the rows from top to bottom. */
uint32_t yb_still_hash(const yb_still_t *still);

/* The still in the engine's own units, so that a firmware can repeat and check it:
 *   {"view": every field of yb_view_t but the shadow, "screen": of yb_screen_t, "stats": of
 * yb_stats_t, "shadow_side": cells or 0, "fnv1a": the hash as eight hexadecimal digits} water_q8
 * and lamp_q8 are null when there is none. A new reference; NULL: no memory.
 */
json_t *yb_still_json(const yb_still_t *still);

#endif
