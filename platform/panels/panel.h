/* Panels: the SPI displays that Yamabiko draws on.
 *
 * Four thin layers lie between a picture and the wires, and each knows only the next one:
 *
 *     display       yb_display_t    a panel on a bus, turned as it was mounted; the caller's
 *     panel         yb_panel_t      set-up, windows of pixels, sleep; this folder's
 *     command/data  yb_panel_bus_t  bytes marked as command or as data; the port's
 *     pins          the port's      SPI hardware, a kernel driver, bits one by one, a model
 *
 * A panel is a const description; all that changes at run time lies in the caller's yb_display_t.
 * Nothing here allocates, keeps state of its own, or needs an operating system, so the same files
 * are compiled into firmware, into the PC's tools and into the tests. A firmware of somebody else
 * takes panel.h, panel_driver.h, panel.c, the file of its panel (with mipi.h and mipi.c, if that
 * file includes mipi.h), and writes the four functions command, data, reset and wait_ms. Calls on
 * one bus must not overlap.
 *
 * Drawing a frame, band by band:
 *
 *     yb_display_t display = {.panel = &yb_panel_st7789, .bus = &bus, .turn = YB_TURN_90};
 *     if (!yb_display_start(&display))
 *         return false;
 *     const yb_screen_t screen = yb_display_screen(&display);
 *     for (uint16_t y = 0; y < screen.height; y += BAND_ROWS) {
 *         draw(&screen, band, y);
 *         if (!yb_display_write_rows(&display, y, BAND_ROWS, band))
 *             return false;
 *     }
 *
 * update.h sends only what differs from the frame before.
 */
#ifndef YB_PANEL_H
#define YB_PANEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <yamabiko/yamabiko.h>

/* ---- What the port gives ------------------------------------------------------------------ */

/* How a panel's driver reaches the display; filled in by the port, which owns the context. Each
 * function answers false when the bus failed (why is the port's to say). The bytes are borrowed for
 * the call. While a call lasts the display is selected; between calls it is not. */
typedef struct {
    void *context;
    bool (*command)(void *context, const uint8_t *bytes, size_t count); /* D/C low */
    bool (*data)(void *context, const uint8_t *bytes, size_t count);    /* D/C high */
    /* As `data`, for pixels, but it may return while the bytes still go out, by DMA or in a thread:
     * they must stay as they are until `finish`, or any other function of the bus, has returned.
     * NULL where `data` will do. */
    bool (*pixels)(void *context, const uint8_t *bytes, size_t count);
    /* Waits until nothing is under way; NULL where nothing ever is. */
    bool (*finish)(void *context);
    /* Pulls the display's reset line for at least 10 microseconds and lets it go; NULL where the
     * board does that by itself. */
    bool (*reset)(void *context);
    /* Waits at least so long; NULL where the supplies are known to stand already and the panel asks
     * for no pause (panels of the MIPI kind do). */
    void (*wait_ms)(void *context, uint32_t ms);
} yb_panel_bus_t;

/* ---- Panels ------------------------------------------------------------------------------- */

/* How far the picture is turned clockwise on the glass. */
typedef enum {
    YB_TURN_0,
    YB_TURN_90,
    YB_TURN_180,
    YB_TURN_270
} yb_turn_t;

/* A rectangle of pixels and where it goes, as the turned picture counts. */
typedef struct {
    uint16_t x;
    uint16_t y;
    uint16_t width;
    uint16_t rows;
    const uint8_t *pixels; /* the byte with the top left corner, in the panel's format; where it
                            * holds eight pixels, that one is x % 8 from the left */
    size_t pitch_bytes;    /* from one row to the next */
} yb_panel_window_t;

static inline bool yb_turn_lies_across(yb_turn_t turn)
{
    return turn == YB_TURN_90 || turn == YB_TURN_270;
}

/* Bits of a pixel. */
static inline uint8_t yb_pixel_bits(yb_format_t format)
{
    return format == YB_MONO ? 1 : format == YB_GREY4 ? 4 : 16;
}

typedef struct yb_display yb_display_t;

/* What a family of controllers does. Windows have been checked before they come here. */
typedef struct {
    /* Sets the display up after its reset, blackens it and switches it on. */
    bool (*start)(yb_display_t *display);
    bool (*write)(yb_display_t *display, const yb_panel_window_t *window);
    /* NULL: there is no command for it. */
    bool (*sleep)(yb_display_t *display, bool asleep);
    /* Light for dark, in hardware. */
    bool (*invert)(yb_display_t *display, bool inverted);
    /* 0 dark to 255 the most that the glass is rated for; NULL: the backlight does that. */
    bool (*brightness)(yb_display_t *display, uint8_t level);
    /* What the display must hear every `tick_ms`; NULL: nothing. */
    bool (*tick)(yb_display_t *display);
} yb_panel_driver_t;

enum {
    YB_PANEL_SELECT_HIGH = 1, /* chip select is high while bytes go out; else low */
    YB_PANEL_NO_DC = 2,       /* no D/C line: everything is sent as data */
    YB_PANEL_INVERTED = 4,    /* the glass shows colours right when the chip inverts them */
    YB_PANEL_BGR = 8,         /* the glass has blue where the chip has red */
    YB_PANEL_MIRROR_X = 0x10, /* unturned, the chip's columns run from right to left */
    YB_PANEL_MIRROR_Y = 0x20, /* unturned, its rows run upwards */
};

typedef struct {
    const char *name;  /* as users write it */
    const char *title; /* chip and glass */
    const yb_panel_driver_t *driver;
    yb_screen_t screen; /* unturned size, and pixels, as the engine draws them */
    uint32_t spi_hz;    /* the fastest serial clock that the datasheet allows */
    uint16_t ram_width; /* the chip's picture memory, pixels */
    uint16_t ram_height;
    /* Where the unturned picture's top left pixel lies in that, counted as the picture is: from the
     * chip's last column or row where YB_PANEL_MIRROR_X or _Y is set. */
    uint16_t ram_x;
    uint16_t ram_y;
    uint16_t x_step; /* windows begin and end on multiples of these, unturned */
    uint8_t y_step;
    uint8_t flags;
    uint8_t turns;        /* those that the chip does: bit 1 << yb_turn_t */
    uint8_t window_bytes; /* what one window costs on the wire beside its pixels */
    uint8_t row_bytes;    /* what each of its rows costs beside its pixels */
    uint16_t tick_ms;     /* driver->tick is due so often; 0: never */
    const uint8_t *setup; /* the glass's own commands: yb_panel_run */
    uint16_t setup_bytes;
} yb_panel_t;

/* Solomon's OLED controllers. */
extern const yb_panel_t yb_panel_ssd0323; /* OSRAM Pictiva 128 x 64, 16 greys */
extern const yb_panel_t yb_panel_ssd1306; /* 128 x 64, lit or not */
extern const yb_panel_t yb_panel_ssd1306_128x32;
extern const yb_panel_t yb_panel_ssd1351; /* 128 x 128, colour */
extern const yb_panel_t yb_panel_ssd1351_128x96;

/* Colour TFTs whose controllers speak MIPI DCS: mipi.c. */
extern const yb_panel_t yb_panel_st7735; /* 128 x 160 */
extern const yb_panel_t yb_panel_st7735_80x160;
extern const yb_panel_t yb_panel_st7735_128x128;
extern const yb_panel_t yb_panel_st7789; /* 240 x 240 */
extern const yb_panel_t yb_panel_st7789_240x320;
extern const yb_panel_t yb_panel_st7789_135x240;
extern const yb_panel_t yb_panel_ili9341; /* 240 x 320 */
extern const yb_panel_t yb_panel_gc9a01;  /* 240 x 240, round */

/* Sharp's memory LCDs: reflecting, white or black. They start white, not black; only lines written
 * after yb_display_invert are inverted; and yb_display_tick must be called, or the glass ages. */
extern const yb_panel_t yb_panel_ls013b7dh03; /* 128 x 128 */
extern const yb_panel_t yb_panel_ls013b7dh05; /* 144 x 168 */
extern const yb_panel_t yb_panel_ls027b7dh01; /* 400 x 240 */

/* A whole frame on the wire, with what its window costs. */
static inline uint32_t yb_panel_frame_bytes(const yb_panel_t *panel)
{
    return panel->window_bytes + (uint32_t)panel->screen.height *
                                     (panel->row_bytes + (uint32_t)yb_screen_pitch(&panel->screen));
}

/* ---- Displays: a panel on a bus ----------------------------------------------------------- */

/* The caller's; to be zeroed but for the first three fields, which stay as they are. */
struct yb_display {
    const yb_panel_t *panel;
    const yb_panel_bus_t *bus;
    yb_turn_t turn; /* one of panel->turns */
    uint8_t state;  /* the driver's */
};

/* Resets the display, sets it up, blackens it (memory LCDs: whitens it) and switches it on; also
 * after a failure of the bus. False also when the panel cannot be turned so, and then nothing is
 * sent. */
bool yb_display_start(yb_display_t *display);

/* Size and pixels of the turned picture. */
yb_screen_t yb_display_screen(const yb_display_t *display);

/* The steps of windows in the turned picture. */
uint16_t yb_display_x_step(const yb_display_t *display);
uint16_t yb_display_y_step(const yb_display_t *display);

/* Writes one window; false also when it does not lie on the display or not on its steps, and then
 * nothing is sent. Pixels are borrowed until yb_display_finish or the next call. */
bool yb_display_write(yb_display_t *display, const yb_panel_window_t *window);

/* Writes a band: `rows` full rows from row `y` down, one after the other in `pixels`. */
bool yb_display_write_rows(yb_display_t *display, uint16_t y, uint16_t rows, const uint8_t *pixels);

/* Waits until the pixels are on the display. */
bool yb_display_finish(yb_display_t *display);

/* Switches the display off or on again; the picture is kept. True, and nothing is sent, where no
 * command does that: a memory LCD shows its picture for microwatts, and goes white while its pin
 * DISP is low. */
bool yb_display_sleep(yb_display_t *display, bool asleep);

/* Shows light for dark and dark for light, or as it should be. */
bool yb_display_invert(yb_display_t *display, bool inverted);

/* 0 dark to 255 the most that the glass is rated for. True, and nothing is sent, where the panel's
 * backlight must do it. */
bool yb_display_brightness(yb_display_t *display, uint8_t level);

/* To be called every panel->tick_ms where that is not 0. */
bool yb_display_tick(yb_display_t *display);

/* ---- Lists, for programs on a PC: they link every panel there is -------------------------- */

/* The panel of that name, or NULL. */
const yb_panel_t *yb_panel_find(const char *name);

/* The panels one by one: index from 0, NULL after the last. */
const yb_panel_t *yb_panel_at(size_t index);

#endif
