/* Ilitek ILI9341 with glasses of 240 x 320 pixels.
 *
 * "Datasheet" is Ilitek's ILI9341, V1.11; its chapter 8 describes the commands, named below. With
 * the cable below the picture, columns run backwards, and red and blue change places.
 */
#include "mipi.h"

enum {
    SET_GAMMA_CURVE = 0x26,
    SET_FRAME_RATE = 0xB1,
    SET_POWER_1 = 0xC0,
    SET_POWER_2 = 0xC1,
    SET_VCOM_1 = 0xC5,
    SET_VCOM_2 = 0xC7,
    SET_POWER_A = 0xCB,
    SET_POWER_B = 0xCF,
    SET_GAMMA_UP = 0xE0,
    SET_GAMMA_DOWN = 0xE1,
    SET_TIMING_A = 0xE8,
    SET_TIMING_B = 0xEA,
    SET_POWER_ON = 0xED,
    ENABLE_3_GAMMAS = 0xF2,
    SET_PUMP = 0xF7,
};

/* clang-format off */
/* Each line: how many arguments, the command, the arguments. */
static const uint8_t setup[] = {
    /* Datasheet, "Power control B", "Power on sequence control", "Driver timing control A",
     * "Power control A", "Pump ratio control", "Driver timing control B": how the chip makes its
     * voltages from one supply of about 3 V. */
    3, SET_POWER_B, 0x00, 0xC1, 0x30,
    4, SET_POWER_ON, 0x64, 0x03, 0x12, 0x81,
    3, SET_TIMING_A, 0x85, 0x00, 0x78,
    5, SET_POWER_A, 0x39, 0x2C, 0x00, 0x34, 0x02,
    1, SET_PUMP, 0x20,
    2, SET_TIMING_B, 0x00, 0x00,
    /* "Power Control 1", "Power Control 2", "VCOM Control 1", "VCOM Control 2": grey levels span
     * 4.6 V, the common electrode 4.25 V and -1.5 V. */
    1, SET_POWER_1, 0x23,
    1, SET_POWER_2, 0x10,
    2, SET_VCOM_1, 0x3E, 0x28,
    1, SET_VCOM_2, 0x86,
    /* "COLMOD": 16 bits a pixel. "Frame Rate Control": 79 frames a second. */
    1, YB_MIPI_PIXEL_FORMAT, 0x55,
    2, SET_FRAME_RATE, 0x00, 0x18,
    /* "Enable 3G", "Gamma Set", "Positive Gamma Correction", "Negative Gamma Correction": one curve
     * for all three colours, as these glasses' makers recommend it. */
    1, ENABLE_3_GAMMAS, 0x00,
    1, SET_GAMMA_CURVE, 0x01,
    15, SET_GAMMA_UP, 0x0F, 0x31, 0x2B, 0x0C, 0x0E, 0x08, 0x4E, 0xF1,
                      0x37, 0x07, 0x10, 0x03, 0x0E, 0x09, 0x00,
    15, SET_GAMMA_DOWN, 0x00, 0x0E, 0x14, 0x03, 0x11, 0x07, 0x31, 0xC1,
                        0x48, 0x08, 0x0F, 0x0C, 0x31, 0x36, 0x0F,
};
/* clang-format on */

const yb_panel_t yb_panel_ili9341 = {
    .name = "ili9341",
    .title = "Ilitek ILI9341, 240 x 320 TFT",
    .screen = {.width = 240, .height = 320, .format = YB_RGB565},
    /* Datasheet, "Display Serial Interface Timing Characteristics (4-line SPI system)": a write
     * cycle takes 100 ns. Glasses are commonly run at several times that. */
    .spi_hz = 10000000,
    .ram_width = 240,
    .ram_height = 320,
    .flags = YB_PANEL_MIRROR_X | YB_PANEL_BGR,
    YB_MIPI_PANEL(setup),
};
