/* What the MIPI chips have each for itself: their glasses, and the manufacturer's commands with the
 * number of arguments that the datasheet gives them. Those commands set voltages, times and gamma
 * curves, which a model does not show.
 *
 * Datasheets: Sitronix ST7735R and ST7735S, Sitronix ST7789V, Ilitek ILI9341, GalaxyCore GC9A01;
 * in each, "System Function Command List" and "Panel Function Command List" or the like. */
#include "mipi_model.h"

/* ILI9341, "Display Function Control": the second argument has REV, GS, SS, SM, ISC; the third, how
 * many lines the glass has, by eights. */
static bool set_ili9341_functions(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    if ((args[1] & 0x90) != 0x80 || args[2] != 0x27)
        return yb_model_fail(model, "display functions %02Xh %02Xh are not for this glass", args[1],
                             args[2]);
    yb_mipi_set_scan(model, args[1] & (YB_SCAN_GS | YB_SCAN_SS));
    return true;
}

/* GC9A01, "Display Function Control": the second argument has GS and SS. */
static bool set_gc9a01_functions(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    yb_mipi_set_scan(model, args[1] & (YB_SCAN_GS | YB_SCAN_SS));
    return true;
}

/* ILI9341, "Interface Control": the third argument has ENDIAN, DM, RM, RIM. */
static bool set_ili9341_interface(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return args[2] == 0 ||
           yb_model_fail(model, "interface %02Xh does not take pixels high byte first", args[2]);
}

/* ST7789, "RAMCTRL": RM and DM; then EPF, ENDIAN, RIM, MDT. */
static bool set_st7789_ram(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return ((args[0] & 0x13) == 0 && (args[1] & 0xCF) == 0xC0) ||
           yb_model_fail(model, "RAM control %02Xh %02Xh does not take pixels high byte first",
                         args[0], args[1]);
}

/* clang-format off */
#define TUNES(code, args) {(code), (code), (args), 0x00, 0xFF, NULL}
#define CONTINUES {0x3C, 0x3C, 0, 0, 0, yb_mipi_continue_pixels}
#define TABLE(array) {(array), sizeof(array) / sizeof((array)[0])}

static const yb_model_command_t st7735[] = {
    TUNES(0xB1, 3),  /* frame rate: normal, */
    TUNES(0xB2, 3),  /* idle, */
    TUNES(0xB3, 6),  /* partial */
    TUNES(0xB4, 1),  /* inversion of dots or lines */
    TUNES(0xC0, 3),  /* power */
    TUNES(0xC1, 1),
    TUNES(0xC2, 2),
    TUNES(0xC3, 2),
    TUNES(0xC4, 2),
    TUNES(0xC5, 1),  /* VCOM */
    TUNES(0xC7, 1),  /* VCOM offset */
    TUNES(0xD1, 1),  /* identity */
    TUNES(0xD2, 1),
    TUNES(0xD9, 1),  /* fuses */
    TUNES(0xDE, 1),
    TUNES(0xDF, 2),
    TUNES(0xE0, 16), /* gamma */
    TUNES(0xE1, 16),
    TUNES(0xF0, 1),  /* gate pump */
    TUNES(0xFC, 1),
};

static const yb_model_command_t st7789[] = {
    CONTINUES,
    TUNES(0x44, 2),  /* tearing line */
    TUNES(0x51, 1),  /* brightness */
    TUNES(0x53, 1),
    TUNES(0x55, 1),
    TUNES(0x5E, 1),
    {0xB0, 0xB0, 2, 0, 0xFF, set_st7789_ram},
    TUNES(0xB1, 3),  /* RGB interface */
    TUNES(0xB2, 5),  /* porches */
    TUNES(0xB3, 3),  /* frame rate */
    TUNES(0xB5, 1),
    TUNES(0xB7, 1),  /* gates */
    TUNES(0xB8, 4),
    TUNES(0xBA, 1),  /* digital gamma */
    TUNES(0xBB, 1),  /* VCOM */
    TUNES(0xBC, 1),  /* power saving */
    TUNES(0xBD, 1),
    {0xC0, 0xC0, 1, 0x2C, 0x2C, NULL}, /* LCM control: turns MADCTL's bits over, as XORs of them */
    TUNES(0xC1, 3),  /* identity */
    TUNES(0xC2, 2),  /* VDV, VRH */
    TUNES(0xC3, 1),
    TUNES(0xC4, 1),
    TUNES(0xC5, 1),  /* VCOM offset */
    TUNES(0xC6, 1),  /* frame rate in normal mode */
    TUNES(0xC7, 1),
    TUNES(0xC8, 1),
    TUNES(0xCA, 1),
    TUNES(0xCC, 1),
    TUNES(0xD0, 2),  /* power */
    TUNES(0xD2, 1),
    TUNES(0xDF, 4),  /* second command set */
    TUNES(0xE0, 14), /* gamma */
    TUNES(0xE1, 14),
    TUNES(0xE2, 64),
    TUNES(0xE3, 64),
    TUNES(0xE4, 3),  /* gates */
    TUNES(0xE7, 1),
    TUNES(0xE8, 1),  /* power */
    TUNES(0xE9, 3),
    TUNES(0xEC, 1),  /* fuses */
    TUNES(0xFA, 4),
    TUNES(0xFC, 2),
    TUNES(0xFE, 2),
};

static const yb_model_command_t ili9341[] = {
    CONTINUES,
    TUNES(0x44, 2),  /* tearing line */
    TUNES(0x51, 1),  /* brightness */
    TUNES(0x53, 1),
    TUNES(0x55, 1),
    TUNES(0x5E, 1),
    TUNES(0xB0, 1),  /* RGB interface */
    TUNES(0xB1, 2),  /* frame rate: normal, */
    TUNES(0xB2, 2),  /* idle, */
    TUNES(0xB3, 2),  /* partial */
    TUNES(0xB4, 1),  /* inversion of dots or lines */
    TUNES(0xB5, 4),  /* porches */
    {0xB6, 0xB6, 4, 0, 0xFF, set_ili9341_functions},
    TUNES(0xB7, 1),  /* entry mode */
    TUNES(0xB8, 1),  /* backlight */
    TUNES(0xB9, 1),
    TUNES(0xBA, 1),
    TUNES(0xBB, 1),
    TUNES(0xBC, 1),
    TUNES(0xBE, 1),
    TUNES(0xBF, 1),
    TUNES(0xC0, 1),  /* power */
    TUNES(0xC1, 1),
    TUNES(0xC5, 2),  /* VCOM */
    TUNES(0xC7, 1),
    TUNES(0xCB, 5),  /* power control A */
    TUNES(0xCF, 3),  /* power control B */
    TUNES(0xD0, 2),  /* fuses */
    TUNES(0xD1, 3),
    TUNES(0xE0, 15), /* gamma */
    TUNES(0xE1, 15),
    TUNES(0xE2, 16),
    TUNES(0xE3, 64),
    TUNES(0xE8, 3),  /* driver timing control A */
    TUNES(0xEA, 2),  /* driver timing control B */
    TUNES(0xED, 4),  /* power-on sequence */
    TUNES(0xF2, 1),  /* 3 gamma control */
    {0xF6, 0xF6, 3, 0, 0xFF, set_ili9341_interface},
    TUNES(0xF7, 1),  /* pump ratio */
};

static const yb_model_command_t gc9a01[] = {
    CONTINUES,
    TUNES(0x44, 2),  /* tearing line */
    TUNES(0x51, 1),  /* brightness */
    TUNES(0x53, 1),
    TUNES(0x62, 12), /* not described: gate and source timing, as the maker's examples set them */
    TUNES(0x63, 12),
    TUNES(0x64, 7),
    TUNES(0x66, 10),
    TUNES(0x67, 10),
    TUNES(0x70, 9),
    TUNES(0x74, 7),
    {0x84, 0x8F, 1, 0, 0xFF, NULL},
    TUNES(0x90, 4),
    TUNES(0x98, 2),
    TUNES(0xA7, 1),  /* core voltage */
    TUNES(0xAE, 1),
    TUNES(0xB0, 1),  /* RGB interface */
    TUNES(0xB5, 4),  /* porches */
    {0xB6, 0xB6, 2, 0, 0xFF, set_gc9a01_functions},
    TUNES(0xBA, 1),  /* tearing */
    TUNES(0xBC, 1),
    TUNES(0xBD, 1),
    TUNES(0xBE, 1),
    TUNES(0xC1, 1),  /* power */
    TUNES(0xC3, 1),
    TUNES(0xC4, 1),
    TUNES(0xC9, 1),
    TUNES(0xCD, 1),
    TUNES(0xDF, 3),
    TUNES(0xE1, 2),
    TUNES(0xE8, 1),  /* frame rate */
    TUNES(0xE9, 1),
    TUNES(0xEB, 1),
    TUNES(0xED, 2),
    TUNES(0xEF, 0),  /* internal registers accessible: FEh, then EFh */
    TUNES(0xF0, 6),  /* gamma */
    TUNES(0xF1, 6),
    TUNES(0xF2, 6),
    TUNES(0xF3, 6),
    TUNES(0xF6, 1),  /* interface */
    TUNES(0xFE, 0),
    TUNES(0xFF, 3),
};
/* clang-format on */

/* 128 x 160, and two smaller glasses. The pauses of "SWRESET" and "SLPOUT" are longer than in the
 * other chips' datasheets. */
const yb_mipi_glass_t yb_mipi_st7735 = {
    .ram_width = 132,
    .ram_height = 162,
    .upright = YB_MADCTL_MX | YB_MADCTL_MY,
    .x = 2,
    .y = 1,
    .bgr = true,
    .settles_us = 120000,
    .more = TABLE(st7735),
};

const yb_mipi_glass_t yb_mipi_st7735_80x160 = {
    .ram_width = 132,
    .ram_height = 162,
    .upright = YB_MADCTL_MX | YB_MADCTL_MY,
    .x = 26,
    .y = 1,
    .bgr = true,
    .inverted = true,
    .settles_us = 120000,
    .more = TABLE(st7735),
};

const yb_mipi_glass_t yb_mipi_st7735_128x128 = {
    .ram_width = 132,
    .ram_height = 132,
    .upright = YB_MADCTL_MX | YB_MADCTL_MY,
    .x = 2,
    .y = 3,
    .bgr = true,
    .settles_us = 120000,
    .more = TABLE(st7735),
};

const yb_mipi_glass_t yb_mipi_st7789 = {
    .ram_width = 240,
    .ram_height = 320,
    .inverted = true,
    .settles_us = 5000,
    .more = TABLE(st7789),
};

const yb_mipi_glass_t yb_mipi_st7789_135x240 = {
    .ram_width = 240,
    .ram_height = 320,
    .x = 52,
    .y = 40,
    .inverted = true,
    .settles_us = 5000,
    .more = TABLE(st7789),
};

const yb_mipi_glass_t yb_mipi_ili9341 = {
    .ram_width = 240,
    .ram_height = 320,
    .upright = YB_MADCTL_MX,
    .bgr = true,
    .settles_us = 5000,
    .more = TABLE(ili9341),
};

/* Round: of the square that is shown, the corners cannot be seen. The maker's examples set SS with
 * MADCTL 0, or MX without SS. */
const yb_mipi_glass_t yb_mipi_gc9a01 = {
    .ram_width = 240,
    .ram_height = 240,
    .bgr = true,
    .inverted = true,
    .scan = YB_SCAN_SS,
    .scan_at_reset = YB_SCAN_UNKNOWN,
    .settles_us = 5000,
    .more = TABLE(gc9a01),
};
