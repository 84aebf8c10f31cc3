/* Chips that speak the MIPI Display Command Set, and the glasses on them. */
#ifndef YB_MIPI_MODEL_H
#define YB_MIPI_MODEL_H

#include "model_parts.h"

/* Bits of MADCTL, command 36h. */
enum {
    YB_MADCTL_MY = 0x80,  /* rows run upwards */
    YB_MADCTL_MX = 0x40,  /* columns run leftwards */
    YB_MADCTL_MV = 0x20,  /* rows and columns change places */
    YB_MADCTL_ML = 0x10,  /* refreshed from the bottom: no pixel changes */
    YB_MADCTL_BGR = 0x08, /* the glass has blue where the chip has red */
    YB_MADCTL_MH = 0x04,  /* refreshed from the right: no pixel changes */
};

typedef struct {
    uint16_t ram_width;
    uint16_t ram_height;
    /* With these bits of MADCTL the picture is the right way up, and the address of the glass's top
     * left pixel is x, y. */
    uint8_t upright;
    uint16_t x;
    uint16_t y;
    bool bgr;
    bool inverted; /* colours are right while inversion is on */
    /* Bits of yb_mipi_set_scan: with these the picture is the right way up, and these hold after a
     * reset. */
    uint8_t scan;
    uint8_t scan_at_reset;
    uint32_t settles_us;   /* from a software reset or sleep-out to the next command */
    yb_model_table_t more; /* what the chip has beyond the commands of all chips */
} yb_mipi_glass_t;

extern const yb_mipi_glass_t yb_mipi_st7735;
extern const yb_mipi_glass_t yb_mipi_st7735_80x160;
extern const yb_mipi_glass_t yb_mipi_st7735_128x128;
extern const yb_mipi_glass_t yb_mipi_st7789; /* 240 x 240 and 240 x 320 */
extern const yb_mipi_glass_t yb_mipi_st7789_135x240;
extern const yb_mipi_glass_t yb_mipi_ili9341;
extern const yb_mipi_glass_t yb_mipi_gc9a01;

/* The directions in which the glass is scanned, for all that is in memory already: command B6h of
 * those chips that have it. */
enum {
    YB_SCAN_GS = 0x40,      /* rows upwards */
    YB_SCAN_SS = 0x20,      /* columns leftwards */
    YB_SCAN_UNKNOWN = 0x80, /* the datasheet does not tell, so the driver must */
};
void yb_mipi_set_scan(yb_panel_model_t *model, uint8_t scan);

/* Runs command 3Ch, which not every chip has. */
bool yb_mipi_continue_pixels(yb_panel_model_t *model, uint8_t code, const uint8_t *args);

#endif
