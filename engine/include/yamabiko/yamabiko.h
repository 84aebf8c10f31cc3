/* Yamabiko: a whole mountain coded in about a hundred bytes, rebuilt and drawn in 3-D.
 *
 *     code ──► contours ──► mesh ──► (refined on the fly) ──► pixels, band by band
 *
 * What it is. A *code* is one map: the feature points of its contour lines, their heights and one
 * fractal dimension (docs/SPEC.md). The engine decodes it as its bytes arrive, triangulates the
 * contours, and draws the surface from any eye: every edge that looks long on the screen is split
 * at its midpoint, which a smooth bulge and a place-keyed noise lift or lower.
 *
 * Coordinates. x east, y north, z up, right-handed. Plan positions are 8.8 fixed point in steps of
 * the map's lattice (1 step = cell_m metres), heights are signed, in 1/256 step, above the code's
 * base. A name ending in _q8 has 8 fractional bits, _q12 has 12; _bam is an angle of which 65536
 * make a full turn.
 *
 * Memory. The engine allocates nothing, keeps no globals, never recurses and uses no floating
 * point. The caller places three structs:
 *   yb_map_t    the mesh: as long as the map is used              (6.9 KB with 255 vertices)
 *   yb_load_t   working memory of decoding: until YB_OK           (3.2 KB)
 *   yb_frame_t  working memory of drawing: one frame at a time    (5.9 KB)
 * A yb_load_t and a yb_frame_t are never needed at once: a union of both saves RAM. What a map
 * leaves of its own makes bands taller: yb_frame_place.
 *
 * Threads. Calls on different structs are independent; a loaded map is only read by the frames, but
 * for a map that yb_frame_place has packed: that belongs to its one frame.
 *
 * Trust. Code bytes may be hostile: any byte string ends in YB_OK or an error, in bounded time
 * (about n² steps for n vertices) and in the memory above. Struct contents are trusted.
 *
 * Example (tests/unit/test_example.c compiles it):
 *
 *     static yb_map_t map;
 *     static union { yb_load_t load; yb_frame_t frame; } work;
 *     static uint8_t pixels[64 * 8];
 *
 *     if (yb_map_load(&map, &work.load, code, code_bytes) != YB_OK)
 *         return;
 *     yb_view_t view;
 *     yb_screen_t screen = {.width = 128, .height = 64, .format = YB_GREY4};
 *     yb_view_init(&view, &map);
 *     yb_view_orbit(&view, &map, YB_DEGREES(45), YB_DEGREES(30), 307);
 *     yb_frame_begin(&work.frame, &map, &view, &screen);
 *     yb_band_t band = {.rows = 8, .pixels = pixels, .pitch = 64};
 *     for (band.y = 0; band.y < 64; band.y = (uint16_t)(band.y + 8)) {
 *         yb_frame_band(&work.frame, &band);
 *         send_to_panel(band.y, pixels);
 *     }
 */
#ifndef YAMABIKO_YAMABIKO_H
#define YAMABIKO_YAMABIKO_H

#include "yamabiko/frame.h"
#include "yamabiko/map.h"

#endif
