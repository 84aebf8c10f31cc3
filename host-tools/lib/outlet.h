/* The outlet of a picture: a display, and a thread that sends what has been drawn while the next
 * band is drawn. Only what changed is sent; a turn that the panel's chip cannot do is done here.
 *
 *     yb_outlet_t *outlet = yb_outlet_open(panel, turn, bus, band_rows, NULL);
 *     if (outlet == NULL || !yb_outlet_start(outlet)) …
 *     for each frame {
 *         for (y = 0; y < screen.height; y += rows) {
 *             draw(yb_outlet_band(outlet, y), y, rows);
 *             yb_outlet_send(outlet, y, rows);
 *         }
 *         if (!yb_outlet_finish(outlet)) the bus failed: it can say why
 *     }
 *     yb_outlet_close(outlet);
 *
 * Between yb_outlet_send and yb_outlet_finish the bus is the thread's. The
 * thread also does what the panel must hear regularly (yb_panel_t.tick_ms). One caller at a time.
 */
#ifndef YB_OUTLET_H
#define YB_OUTLET_H

#include <panel.h>

typedef struct yb_outlet yb_outlet_t;

/* The turned picture, as it is to be drawn. */
yb_screen_t yb_outlet_screen(const yb_panel_t *panel, yb_turn_t turn);

/* The fewest rows of a band, of which every band's height and place must be a multiple. */
uint16_t yb_outlet_step(const yb_panel_t *panel, yb_turn_t turn);

/* The time by which the panel must hear from us: of a model, say. Asked by the thread. */
typedef struct {
    uint64_t (*now_ms)(void *context);
    void *context;
} yb_outlet_clock_t;

/* For bands of at most band_rows. The bus must live as long. A clock of NULL is the machine's.
 * NULL: no memory. */
yb_outlet_t *yb_outlet_open(const yb_panel_t *panel, yb_turn_t turn, const yb_panel_bus_t *bus,
                            uint16_t band_rows, const yb_outlet_clock_t *clock);

/* Starts the display: black and on. The next frame is sent whole. */
bool yb_outlet_start(yb_outlet_t *outlet);

/* Brightness, 0 to 255; light for dark. Between frames, while it is started. */
bool yb_outlet_set_brightness(yb_outlet_t *outlet, uint8_t level);
bool yb_outlet_invert(yb_outlet_t *outlet, bool inverted);

/* Nothing is seen any more: the display is off or, where it cannot be switched off, cleared. Start
 * it before the next frame. */
bool yb_outlet_blank(yb_outlet_t *outlet);

/* False: the bus has failed, also while no frames were sent. */
bool yb_outlet_well(yb_outlet_t *outlet);

/* The next frame is sent whole. */
void yb_outlet_refresh(yb_outlet_t *outlet);

/* Memory for the next band, which begins at row y; waits until there is some. */
uint8_t *yb_outlet_band(yb_outlet_t *outlet, uint16_t y);

/* Hands over the band that is in the memory that yb_outlet_band gave. */
void yb_outlet_send(yb_outlet_t *outlet, uint16_t y, uint16_t rows);

/* Waits until every band is on the display; false if the bus failed since the last time. */
bool yb_outlet_finish(yb_outlet_t *outlet);

/* Ends the thread; the display stays as it is. NULL is allowed. */
void yb_outlet_close(yb_outlet_t *outlet);

#endif
