#include "codes.h"

#include "contour_code.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static yb_code_file_t *finish(const yb_contour_set_t *set)
{
    yb_error_t error = {""};
    yb_code_file_t *file = yb_contour_code_load(set, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    return file;
}

static yb_code_file_t *hill_at(uint8_t x, uint8_t gain)
{
    static const yb_step_t outer[] = {{28, 28},   {128, 20},  {228, 28}, {232, 128},
                                      {228, 228}, {128, 236}, {28, 228}, {20, 128}};
    const uint8_t west = (uint8_t)(x - 24), east = (uint8_t)(x + 24);
    const yb_step_t inner[] = {{west, 104}, {east, 104}, {east, 152}, {west, 152}};
    const yb_step_t summit = {x, 128};
    yb_contour_set_t set = {.east = 255,
                            .north = 255,
                            .shift = 2,
                            .cell = yb_unit_coded(30),
                            .unit = yb_unit_coded(1),
                            .base_m = 100,
                            .seed = 7,
                            .gain = gain,
                            .dimension = 64,
                            .frame = 50};
    assert_true(yb_contour_set_append(&set, 100, false, outer, COUNT(outer)));
    assert_true(yb_contour_set_append(&set, 600, false, inner, COUNT(inner)));
    assert_true(yb_contour_set_append(&set, 1000, false, &summit, 1));
    return finish(&set);
}

yb_code_file_t *code_hill(void)
{
    return hill_at(128, 0);
}

yb_code_file_t *code_eastern_hill(void)
{
    return hill_at(192, 0);
}

yb_code_file_t *code_rough_hill(void)
{
    return hill_at(128, 8);
}

yb_code_file_t *code_slope(void)
{
    static const yb_step_t line[] = {{0, 20}, {48, 28}, {100, 20}};
    yb_contour_set_t set = {.east = 100,
                            .north = 60,
                            .shift = 2,
                            .cell = yb_unit_coded(10),
                            .unit = yb_unit_coded(1),
                            .corners = 0xf,
                            .corner = {0, 0, 200, 200}};
    assert_true(yb_contour_set_append(&set, 100, true, line, COUNT(line)));
    return finish(&set);
}
