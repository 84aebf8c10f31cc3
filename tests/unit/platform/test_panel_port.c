/* The example of docs/PANELS.md, word for word (the build checks that), on pins that lead to a
 * model: what it draws is on the glass. */
#include "panel_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static yb_panel_model_t *model;
static bool dc;

static void set_select(int level)
{
    assert_true(yb_panel_model_select(model, level == 0));
}

static void set_dc(int level)
{
    dc = level != 0;
}

static void set_reset(int level)
{
    if (level != 0)
        yb_panel_model_reset(model);
}

static void spi_send(uint8_t byte)
{
    if (!yb_panel_model_byte(model, dc, byte))
        fail_msg("%s", yb_panel_model_error(model));
}

static void spi_finish(void)
{
}

static void delay_ms(uint32_t ms)
{
    yb_panel_model_wait(model, ms * 1000);
}

/* Row y is of the colour y, in green. */
static void draw_rows(uint16_t y, uint16_t rows, uint8_t *band)
{
    for (uint16_t row = 0; row < rows; row++) {
        const unsigned colour = ((y + row) & 63U) << 5;
        for (int x = 0; x < 240; x++) {
            *band++ = (uint8_t)(colour >> 8);
            *band++ = (uint8_t)colour;
        }
    }
}

#include "panel_port.inc"

/* Turned clockwise, the picture's rows are the glass's columns from the right. */
static void the_port_of_the_page_draws(void **state)
{
    yb_model_picture_t picture;

    (void)state;
    model = yb_panel_model_new("st7789-135x240");
    assert_non_null(model);
    assert_true(show());
    assert_true(yb_panel_model_lit(model));
    if (!yb_panel_model_picture(model, &picture))
        fail_msg("%s", yb_panel_model_error(model));
    for (unsigned y = 0; y < 240; y++) {
        for (unsigned x = 0; x < 135; x++) {
            const uint8_t *rgb = picture.rgb + 3 * (y * 135 + x);
            assert_int_equal(rgb[1] >> 2, (134 - x) & 63);
            assert_int_equal(rgb[0] + rgb[2], 0);
        }
    }
    yb_panel_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_port_of_the_page_draws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
