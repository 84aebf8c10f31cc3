/* The viewer: one map, drawn from a standard orbit on a 128 x 64 screen of 16 greys.
 *
 * Portable C without an operating system: the firmware of every board, the simulator and the tests
 * on the PC compile this very file, so that a picture can be compared by its hash. No globals;
 * the caller places one yb_viewer_t (sizeof: about 14 KB with 255 vertices).
 *
 *     static yb_viewer_t viewer;
 *     if (yb_viewer_load(&viewer, code, sizeof code) == YB_OK)
 *         hash = yb_viewer_draw(&viewer, YB_DEGREES(45), send_band, &panel);
 */
#ifndef YB_VIEWER_H
#define YB_VIEWER_H

#include <stddef.h>
#include <stdint.h>

#include "yamabiko/yamabiko.h"

#define YB_VIEWER_WIDTH 128
#define YB_VIEWER_HEIGHT 64
#define YB_VIEWER_PITCH (YB_VIEWER_WIDTH / 2)
/* Memory for the rows that are drawn at once, beside what the map leaves. More are faster. With
 * memory for sixteen, maps of up to 170 vertices are drawn in one piece: nearly all of the gallery.
 */
#ifndef YB_VIEWER_BAND_BYTES
#define YB_VIEWER_BAND_BYTES (16 * YB_VIEWER_PITCH)
#endif
#if YB_VIEWER_BAND_BYTES < 2 * YB_VIEWER_PITCH
#error "YB_VIEWER_BAND_BYTES: 128 or more, a row of it for what alignment takes"
#endif

/* From one frame of a turn to the next: 256 frames go round the mountain. */
#define YB_VIEWER_STEP_BAM 256

/* The standard orbit: degrees above the horizon, and map widths from the centre, 8 fractional
 * bits (1.2 widths).
 */
#define YB_VIEWER_ELEVATION 30
#define YB_VIEWER_DISTANCE_Q8 307
/* Heights are drawn doubled, as on relief maps: a screen this small would hide low mountains. */
#define YB_VIEWER_EXAGGERATE_Q8 512

/* Cells along a side of the shadows' grid. */
#define YB_VIEWER_SHADOW_SIDE 64

/* What may be drawn beside the relief; any of these together. */
enum {
    YB_VIEWER_SHADOWS = 1, /* that mountains cast, from the standard sun */
    YB_VIEWER_LINES = 2    /* contour lines, about ten of them, at round heights */
};

typedef struct {
    yb_map_t map;
    union { /* behind the map; never two at once */
        yb_load_t load;
        uint8_t heights[YB_SHADOW_WORK(YB_VIEWER_SHADOW_SIDE)];
        uint8_t drawing[sizeof(yb_frame_t) + YB_VIEWER_BAND_BYTES];
    } work;
    uint8_t looks; /* YB_VIEWER_SHADOWS, YB_VIEWER_LINES; 0 after loading */
    yb_shadow_t shadow;
    uint8_t lit[YB_SHADOW_BYTES(YB_VIEWER_SHADOW_SIDE)];
} yb_viewer_t;

/* Takes some finished rows, any number of them, from row y down, YB_VIEWER_PITCH bytes each;
 * `pixels` is valid for the call.
 */
typedef void (*yb_viewer_band_fn)(void *context, uint16_t y, uint16_t rows, const uint8_t *pixels);

/* Loads a code of at most `room` bytes. What follows the code's last byte is not looked at, so a
 * code may lie at the start of a larger piece of flash. After an error there is no map to draw. The
 * shadows are cast here, once for all frames.
 */
YB_MUST_CHECK yb_status_t yb_viewer_load(yb_viewer_t *viewer, const uint8_t *code, size_t room);

/* Metres between the contour lines of YB_VIEWER_LINES: 1, 2 or 5 times a power of ten. */
uint32_t yb_viewer_interval_m(const yb_map_t *map);

/* Draws one frame of the loaded map from top to bottom and answers its hash: FNV-1a, 32 bits, over
 * its pixel bytes. `band` may be NULL.
 */
uint32_t yb_viewer_draw(yb_viewer_t *viewer, uint16_t azimuth_bam, yb_viewer_band_fn band,
                        void *context);

#endif
