/* Sitronix ST7789 with IPS glasses of 240 x 240, 240 x 320 and 135 x 240 pixels.
 *
 * "Datasheet" is Sitronix's ST7789V, version 1.3; its chapter 9 describes the commands, named
 * below. The glass's liquid crystal is dark without voltage, so the chip has to invert.
 */
#include "mipi.h"

enum {
    SET_PORCHES = 0xB2,
    SET_GATES = 0xB7,
    SET_VCOM = 0xBB,
    SET_LCM = 0xC0,
    ENABLE_VDV_VRH = 0xC2,
    SET_VRH = 0xC3,
    SET_VDV = 0xC4,
    SET_FRAME_RATE = 0xC6,
    SET_POWER = 0xD0,
    SET_GAMMA_UP = 0xE0,
    SET_GAMMA_DOWN = 0xE1,
};

/* clang-format off */
/* Each line: how many arguments, the command, the arguments. */
static const uint8_t setup[] = {
    /* Datasheet, "COLMOD": 16 bits a pixel. */
    1, YB_MIPI_PIXEL_FORMAT, 0x55,
    /* "PORCTRL", "FRCTRL2": 12 lines before and after a frame, 60 frames a second. */
    5, SET_PORCHES, 0x0C, 0x0C, 0x00, 0x33, 0x33,
    1, SET_FRAME_RATE, 0x0F,
    /* "GCTRL", "VCOMS", "LCMCTRL", "VDVVRHEN", "VRHS", "VDVS", "PWCTRL1": gates at 13.3 V and
     * -10.4 V, the common electrode at 0.725 V, source voltages of 4.45 V from that either way. */
    1, SET_GATES, 0x35,
    1, SET_VCOM, 0x19,
    1, SET_LCM, 0x2C,
    2, ENABLE_VDV_VRH, 0x01, 0xFF,
    1, SET_VRH, 0x12,
    1, SET_VDV, 0x20,
    2, SET_POWER, 0xA4, 0xA1,
    /* "PVGAMCTRL", "NVGAMCTRL": what these glasses' makers recommend. */
    14, SET_GAMMA_UP, 0xD0, 0x04, 0x0D, 0x11, 0x13, 0x2B, 0x3F,
                      0x54, 0x4C, 0x18, 0x0D, 0x0B, 0x1F, 0x23,
    14, SET_GAMMA_DOWN, 0xD0, 0x04, 0x0C, 0x11, 0x13, 0x2C, 0x3F,
                        0x44, 0x51, 0x2F, 0x1F, 0x1F, 0x20, 0x23,
};
/* clang-format on */

const yb_panel_t yb_panel_st7789 = {
    .name = "st7789",
    .title = "Sitronix ST7789, 240 x 240 IPS TFT",
    .screen = {.width = 240, .height = 240, .format = YB_RGB565},
    /* Datasheet, "Serial Interface Characteristics (4-line serial)": a write cycle takes 16 ns. */
    .spi_hz = 62500000,
    .ram_width = 240,
    .ram_height = 320,
    .flags = YB_PANEL_INVERTED,
    YB_MIPI_PANEL(setup),
};

const yb_panel_t yb_panel_st7789_240x320 = {
    .name = "st7789-240x320",
    .title = "Sitronix ST7789, 240 x 320 IPS TFT",
    .screen = {.width = 240, .height = 320, .format = YB_RGB565},
    .spi_hz = 62500000,
    .ram_width = 240,
    .ram_height = 320,
    .flags = YB_PANEL_INVERTED,
    YB_MIPI_PANEL(setup),
};

const yb_panel_t yb_panel_st7789_135x240 = {
    .name = "st7789-135x240",
    .title = "Sitronix ST7789, 135 x 240 IPS TFT",
    .screen = {.width = 135, .height = 240, .format = YB_RGB565},
    .spi_hz = 62500000,
    .ram_width = 240,
    .ram_height = 320,
    .ram_x = 52,
    .ram_y = 40,
    .flags = YB_PANEL_INVERTED,
    YB_MIPI_PANEL(setup),
};
