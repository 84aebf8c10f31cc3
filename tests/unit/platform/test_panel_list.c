/* The panels as descriptions: found by name, each with a model, consistent in themselves and with
 * docs/PANELS.md. */
#include "panel.h"
#include "panel_driver.h"
#include "panel_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void panels_are_found_by_name(void **state)
{
    const yb_panel_t *panel;
    size_t count = 0;

    (void)state;
    assert_ptr_equal(yb_panel_find("ssd0323"), &yb_panel_ssd0323);
    assert_ptr_equal(yb_panel_find("st7789-135x240"), &yb_panel_st7789_135x240);
    assert_null(yb_panel_find("ssd032"));
    assert_null(yb_panel_find("ssd03233"));
    assert_null(yb_panel_find("SSD0323"));
    assert_null(yb_panel_find(""));
    for (; (panel = yb_panel_at(count)) != NULL; count++)
        assert_ptr_equal(yb_panel_find(panel->name), panel);
    assert_int_equal(count, 16);
    assert_null(yb_panel_at(count));
    assert_null(yb_panel_at(SIZE_MAX));
}

static void every_panel_has_a_model(void **state)
{
    const char *name;
    size_t count = 0;

    (void)state;
    for (; (name = yb_panel_model_name(count)) != NULL; count++)
        assert_non_null(yb_panel_find(name));
    assert_null(yb_panel_at(count));
}

static void descriptions_fit_together(void **state)
{
    const yb_panel_t *panel;

    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        assert_true(panel->ram_x + panel->screen.width <= panel->ram_width);
        assert_true(panel->ram_y + panel->screen.height <= panel->ram_height);
        assert_int_equal(panel->screen.width % panel->x_step, 0);
        assert_int_equal(panel->screen.height % panel->y_step, 0);
        assert_true(panel->x_step > 0 &&
                    panel->x_step * panel->y_step * yb_pixel_bits(panel->screen.format) % 8 == 0);
        assert_true(panel->spi_hz >= 1000000);
        size_t at = 0;
        while (at < panel->setup_bytes) {
            const uint8_t head = panel->setup[at];
            at += 2U + (head & (YB_SETUP_WAIT - 1U)) + ((head & YB_SETUP_WAIT) != 0);
        }
        assert_int_equal(at, panel->setup_bytes);
    }
}

/* A number as the page writes it: 153,611. */
static void write_number(char text[16], uint32_t number)
{
    if (number < 1000)
        (void)snprintf(text, 16, "%u", (unsigned)number);
    else
        (void)snprintf(text, 16, "%u,%03u", (unsigned)(number / 1000), (unsigned)(number % 1000));
}

/* The table of docs/PANELS.md has a row for each panel, with its figures. */
static void the_page_knows_every_panel(void **state)
{
    const yb_panel_t *panel;

    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        const uint32_t bytes = yb_panel_frame_bytes(panel);
        char name[32];
        char size[32];
        char costs[64];
        char number[2][16];
        char line[512] = "";
        FILE *page = fopen(YB_PAGE, "r");
        assert_non_null(page);
        (void)snprintf(name, sizeof name, "| `%s` |", panel->name);
        while (strncmp(line, name, strlen(name)) != 0)
            if (fgets(line, sizeof line, page) == NULL)
                fail_msg("the page has no row for %s", panel->name);
        (void)fclose(page);
        (void)snprintf(size, sizeof size, "| %u x %u |", panel->screen.width, panel->screen.height);
        write_number(number[0], bytes);
        write_number(number[1], panel->spi_hz / (8 * bytes));
        (void)snprintf(costs, sizeof costs, " MHz | %s | %s |", number[0], number[1]);
        if (strstr(line, size) == NULL || strstr(line, costs) == NULL)
            fail_msg("the page's row for %s wants \"%s\" and \"%s\"", panel->name, size, costs);
        assert_int_equal(strstr(line, "| all |") != NULL, panel->turns == 0x0F);
        assert_int_equal(strstr(line, "| 0, 180 |") != NULL, panel->turns == 0x05);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panels_are_found_by_name),
        cmocka_unit_test(every_panel_has_a_model),
        cmocka_unit_test(descriptions_fit_together),
        cmocka_unit_test(the_page_knows_every_panel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
