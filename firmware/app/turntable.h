/* The turntable: the viewer's mountain turning step by step, and a console to hold it still.
 *
 * At the start the map slot (a piece of flash that can be written apart from the program) is
 * tried; if it is empty or holds no valid code, the built-in map is shown. One line says so:
 *
 *     yamabiko 0.1.0 lm3s6965evb slot=empty map=built-in
 *
 * `slot` is `empty` or the engine's word for how loading it ended; `map` is `slot`, `built-in`, or
 * `none` if neither can be shown. Then the console takes single characters:
 *
 *     p    pause after the frame being drawn        answer: paused azimuth=00512 hash=89abcdef
 *     n    draw the next frame; only while paused   the same answer
 *     N    the same, but turn by 16 steps at once   the same answer
 *     s    shadows on or off                        the same answer, if paused
 *     l    contour lines on or off                  the same
 *     r    run on
 *
 * Anything else is passed over. azimuth is in binary angle, hash is yb_viewer_draw's. A board
 * without a display may set `report`: every frame drawn while running then says
 *
 *     frame azimuth=00768 hash=01234567
 */
#ifndef YB_TURNTABLE_H
#define YB_TURNTABLE_H

#include "viewer.h"

/* What the board gives; all of it stays valid while the turntable is used. */
typedef struct {
    const char *board;
    void *context; /* handed to the functions */
    /* The next character of the console, or -1 if none has come; does not wait. */
    int (*read)(void *context);
    void (*write)(void *context, char character);
    yb_viewer_band_fn band; /* to the display; NULL if there is none */
    const uint8_t *slot;    /* at least 2 bytes */
    size_t slot_bytes;
    const uint8_t *built_in;
    size_t built_in_bytes;
    bool report;
} yb_turntable_port_t;

typedef struct {
    yb_viewer_t viewer;
    const yb_turntable_port_t *port;
    uint32_t hash;        /* of the frame on the display */
    uint16_t azimuth_bam; /* of the frame on the display */
    bool shown;           /* there is a map */
    bool paused;
} yb_turntable_t;

/* Loads a map, says which, and draws the frame of azimuth 0. */
void yb_turntable_begin(yb_turntable_t *table, const yb_turntable_port_t *port);

/* Obeys the next character of the console, or else draws the next frame unless paused. To be
 * called for ever.
 */
void yb_turntable_step(yb_turntable_t *table);

/* The map of a program that was given none: firmware/app/cone.c, or the code that the build
 * embeds.
 */
extern const uint8_t yb_built_in_map[];
extern const size_t yb_built_in_map_bytes;

#endif
