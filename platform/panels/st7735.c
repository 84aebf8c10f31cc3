/* Sitronix ST7735 (R and S) with glasses of 128 x 160, 80 x 160 and 128 x 128 pixels.
 *
 * "Datasheet" is Sitronix's ST7735R, V0.2; its chapter 10 describes the commands, named below. With
 * the cable below the picture, columns and rows run backwards, and red and blue change places.
 */
#include "mipi.h"

enum {
    SET_FRAME_RATE = 0xB1, /* in normal, idle and partial mode */
    SET_IDLE_RATE = 0xB2,
    SET_PARTIAL_RATE = 0xB3,
    SET_POLARITY = 0xB4,
    SET_POWER_1 = 0xC0,
    SET_POWER_2 = 0xC1,
    SET_POWER_3 = 0xC2,
    SET_POWER_4 = 0xC3,
    SET_POWER_5 = 0xC4,
    SET_VCOM = 0xC5,
    SET_GAMMA_UP = 0xE0,
    SET_GAMMA_DOWN = 0xE1,

    FLAGS = YB_PANEL_MIRROR_X | YB_PANEL_MIRROR_Y | YB_PANEL_BGR,
};

/* clang-format off */
/* Each line: how many arguments, the command, the arguments. */
static const uint8_t setup[] = {
    /* Datasheet, "COLMOD": 16 bits a pixel. */
    1, YB_MIPI_PIXEL_FORMAT, 0x05,
    /* "FRMCTR1" to "FRMCTR3": 850 kHz / (1 x 2 + 40) / (160 + 44 + 45 lines): 81 frames a second. */
    3, SET_FRAME_RATE, 0x01, 0x2C, 0x2D,
    3, SET_IDLE_RATE, 0x01, 0x2C, 0x2D,
    6, SET_PARTIAL_RATE, 0x01, 0x2C, 0x2D, 0x01, 0x2C, 0x2D,
    /* "INVCTR": polarity changes from column to column, not from dot to dot, in all modes. */
    1, SET_POLARITY, 0x07,
    /* "PWCTR1" to "PWCTR5", "VMCTR1": source voltages of 4.6 V either way, gates of 14.7 V and -10 V,
     * currents as in the datasheet's table of defaults, and the common electrode at -0.775 V. */
    3, SET_POWER_1, 0xA2, 0x02, 0x84,
    1, SET_POWER_2, 0xC5,
    2, SET_POWER_3, 0x0A, 0x00,
    2, SET_POWER_4, 0x8A, 0x2A,
    2, SET_POWER_5, 0x8A, 0xEE,
    1, SET_VCOM, 0x0E,
    /* "GMCTRP1", "GMCTRN1": what these glasses' makers recommend. */
    16, SET_GAMMA_UP, 0x02, 0x1C, 0x07, 0x12, 0x37, 0x32, 0x29, 0x2D,
                      0x29, 0x25, 0x2B, 0x39, 0x00, 0x01, 0x03, 0x10,
    16, SET_GAMMA_DOWN, 0x03, 0x1D, 0x07, 0x06, 0x2E, 0x2C, 0x29, 0x2D,
                        0x2E, 0x2E, 0x37, 0x3F, 0x00, 0x00, 0x02, 0x10,
};
/* clang-format on */

const yb_panel_t yb_panel_st7735 = {
    .name = "st7735",
    .title = "Sitronix ST7735, 128 x 160 TFT",
    .screen = {.width = 128, .height = 160, .format = YB_RGB565},
    /* Datasheet, "Serial interface characteristics (4-line serial)": a write cycle takes 66 ns. */
    .spi_hz = 15150000,
    .ram_width = 132,
    .ram_height = 162,
    .ram_x = 2,
    .ram_y = 1,
    .flags = FLAGS,
    YB_MIPI_PANEL(setup),
};

const yb_panel_t yb_panel_st7735_80x160 = {
    .name = "st7735-80x160",
    .title = "Sitronix ST7735S, 80 x 160 IPS TFT",
    .screen = {.width = 80, .height = 160, .format = YB_RGB565},
    .spi_hz = 15150000,
    .ram_width = 132,
    .ram_height = 162,
    .ram_x = 26,
    .ram_y = 1,
    .flags = FLAGS | YB_PANEL_INVERTED,
    YB_MIPI_PANEL(setup),
};

const yb_panel_t yb_panel_st7735_128x128 = {
    .name = "st7735-128x128",
    .title = "Sitronix ST7735, 128 x 128 TFT",
    .screen = {.width = 128, .height = 128, .format = YB_RGB565},
    .spi_hz = 15150000,
    .ram_width = 132,
    .ram_height = 132,
    .ram_x = 2,
    .ram_y = 3,
    .flags = FLAGS,
    YB_MIPI_PANEL(setup),
};
