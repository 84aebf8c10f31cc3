#include "colour.h"

#include <yamabiko/rom.h>

#include "camera.h"
#include "fix.h"
#include "pixels.h"

/* clang-format off */
static const uint8_t hues[YB_PALETTES][ALL_HUES][3] YB_ROM = {
    [YB_PALETTE_NATURAL] = { /* woods, meadows, bare soil, rock, snow */
        {62, 112, 66},   {81, 125, 70},   {99, 139, 74},   {118, 152, 78},
        {137, 157, 87},  {157, 163, 95},  {176, 168, 104}, {169, 152, 97},
        {163, 136, 89},  {156, 120, 82},  {151, 123, 95},  {147, 127, 109},
        {142, 130, 122}, {169, 162, 157}, {196, 194, 192}, {248, 248, 252},
        {72, 116, 168},  {150, 132, 112}, {92, 58, 34},    {224, 232, 228},
        {206, 222, 236}, {92, 148, 212},
    },
    [YB_PALETTE_HYPSOMETRIC] = { /* the tints of an atlas: green, yellow, brown, white */
        {36, 124, 74},   {70, 146, 82},   {108, 168, 92},  {146, 188, 104},
        {182, 206, 120}, {212, 220, 138}, {236, 230, 152}, {240, 218, 134},
        {236, 200, 112}, {226, 178, 92},  {212, 154, 76},  {194, 130, 64},
        {174, 108, 60},  {166, 118, 92},  {196, 168, 152}, {244, 240, 238},
        {120, 176, 216}, {172, 160, 146}, {110, 66, 40},   {48, 92, 148},
        {240, 244, 248}, {176, 206, 236},
    },
    [YB_PALETTE_MONO] = { /* one ink: light alone shapes the relief */
        {212, 210, 204}, {214, 212, 206}, {216, 214, 208}, {218, 216, 210},
        {220, 218, 212}, {222, 220, 214}, {224, 222, 216}, {226, 224, 218},
        {228, 226, 220}, {230, 228, 222}, {232, 230, 224}, {234, 232, 226},
        {236, 234, 228}, {238, 236, 230}, {240, 238, 232}, {244, 242, 236},
        {150, 152, 154}, {168, 166, 160}, {60, 58, 54},    {28, 28, 28},
        {250, 249, 246}, {226, 226, 224},
    },
    [YB_PALETTE_NIGHT] = { /* moonlight, for eyes that must stay used to the dark */
        {40, 58, 74},    {44, 64, 82},    {48, 70, 90},    {54, 76, 98},
        {60, 82, 106},   {66, 88, 114},   {72, 94, 120},   {80, 100, 128},
        {88, 108, 136},  {96, 116, 144},  {106, 124, 150}, {116, 132, 156},
        {126, 140, 164}, {140, 152, 174}, {158, 168, 186}, {188, 196, 210},
        {22, 38, 78},    {56, 60, 72},    {168, 72, 40},   {96, 120, 150},
        {24, 32, 52},    {4, 6, 16},
    },
};
/* clang-format on */

void colour_begin(yb_frame_t *frame)
{
    int32_t relief = fix_max(frame->map->high_q8 - frame->map->low_q8, 1);
    frame->tone_q16 = (int32_t)(((uint32_t)HUES << 16) / (uint32_t)relief);
    frame->haze_near = 0;
    if (frame->view.haze_q8 > 0) { /* depths have 17 bits */
        int32_t depth = fix_min(frame->view.haze_q8 >> frame->eye_shift, ((int32_t)1 << 17) - 1);
        frame->haze_near = camera_near(frame, fix_max(depth, frame->near));
    }
    frame->haze_q16 = frame->haze_near > 0 ? ((int32_t)256 << 16) / frame->haze_near : 0;
    const yb_view_t *view = &frame->view;
    const bool odd = view->lamp || view->water_q8 != YB_NO_WATER || view->exaggerate_q8 != 256 ||
                     !frame->map->smooth;
    frame->looks = (uint8_t)((frame->screen.format == YB_RGB565 ? LOOK_COLOURS : 0) |
                             (frame->haze_near > 0 ? LOOK_HAZE : 0) |
                             (view->shadow != NULL ? LOOK_SHADOWS : 0) | (odd ? LOOK_ODD : 0));
}

/* Red and blue of a colour, 16 bits apart, so that one product serves both. */
static inline uint32_t red_blue(const uint8_t *colour)
{
    return (uint32_t)yb_rom_u8(&colour[0]) << 16 | yb_rom_u8(&colour[2]);
}

/* A colour of which 16ths are left, blended towards another by a share of 256, and brighter by so
 * much: half as much in green. There is room for that, but in red.
 */
COPIED uint16_t blend(const uint8_t *from, uint32_t of_16, const uint8_t *to, uint32_t share,
                      uint32_t more)
{
    uint32_t both = red_blue(from) * of_16 >> 4 & 0xff00ff;
    uint32_t green = yb_rom_u8(&from[1]) * of_16 >> 4;
    if (share > 0) {
        both = (both * (256 - share) + red_blue(to) * share) >> 8;
        green = (green * (256 - share) + yb_rom_u8(&to[1]) * share) >> 8;
    }
    const uint32_t red = (both >> 16) + more;
    return (uint16_t)((red < 255 ? red >> 3 : 31) << 11 | (green + (more >> 1)) >> 2 << 5 |
                      ((both & 0xff) + more) >> 3);
}

uint16_t colour_pixel(const yb_frame_t *frame, int hue, int32_t shade, int32_t near)
{
    if ((frame->looks & LOOK_COLOURS) == 0)
        return colour_grey(frame, shade, near);
    const uint8_t(*palette)[3] = hues[frame->view.palette];
    return PIXELS_DRAWN | blend(palette[hue], (uint32_t)shade + 1, palette[HUE_HAZE],
                                (uint32_t)(256 - colour_clear(frame, near)), 0);
}

uint16_t colour_sky(const yb_frame_t *frame, int32_t row)
{
    if (frame->screen.format != YB_RGB565)
        return 0;
    /* The sine of about the elevation of the row's middle: its full change takes 60 degrees about
     * the horizon. Rows lie within 2^15 of the middle, in 1/16 pixel. */
    int32_t off_q4 = (frame->screen.height - 2 * row - 1) * 8;
    int32_t rise_q14 = frame->depth_z + off_q4 * frame->up_z / frame->focal_q4;
    const uint32_t high = (uint32_t)fix_clamp((rise_q14 >> 6) + 128, 0, 256);
    const uint8_t(*palette)[3] = hues[frame->view.palette];
    /* Rows are rounded up by turns, so that the few bits of a colour make no bands. */
    const uint32_t more = (uint32_t)((row & 1) * 2 + (row >> 1 & 1)) * 2;
    return blend(palette[HUE_HAZE], 16, palette[HUE_SKY], high, more) & (uint16_t)~PIXELS_DRAWN;
}
