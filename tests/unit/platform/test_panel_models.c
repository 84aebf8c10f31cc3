/* The models of the panels against byte sequences from the datasheets, written by hand: what must
 * be seen is seen, and what a chip would take amiss is refused where it happens. */
#include "model_script.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void models_are_found_by_name(void **state)
{
    size_t count = 0;

    (void)state;
    for (const char *name = NULL; (name = yb_panel_model_name(count)) != NULL; count++)
        yb_panel_model_free(new_model(name));
    assert_int_equal(count, 16);
    assert_null(yb_panel_model_name(SIZE_MAX));
    assert_null(yb_panel_model_new("ssd032"));
    assert_null(yb_panel_model_new("ssd03233"));
    assert_null(yb_panel_model_new(""));
    yb_panel_model_free(NULL);
}

static void a_fresh_panel_is_dark(void **state)
{
    const char *name = NULL;

    (void)state;
    for (size_t i = 0; (name = yb_panel_model_name(i)) != NULL; i++) {
        yb_panel_model_t *model = new_model(name);
        assert_string_equal(yb_panel_model_error(model), "");
        assert_int_equal(yb_panel_model_bytes(model), 0);
        if (strncmp(name, "ls0", 3) != 0) {
            assert_false(yb_panel_model_lit(model));
            assert_all(model, 0x000000);
        }
        yb_panel_model_free(model);
    }
}

static void bytes_that_are_not_for_the_panel_are_refused(void **state)
{
    const char *name = NULL;

    (void)state;
    for (size_t i = 0; (name = yb_panel_model_name(i)) != NULL; i++) {
        const bool sharp = strncmp(name, "ls0", 3) == 0;
        const wrong_t released = {name,
                                  "00h came while the panel was not selected",
                                  {SELECT, 0x20, D(0x00), RELEASE, 0x00, END}};
        const wrong_t never = {name, "00h came while the panel was not selected", {0x00, END}};
        const wrong_t released_dc = {
            name, "11h came while the panel was not selected", {SELECT, RELEASE, 0x11, END}};
        if (sharp)
            assert_refused(NULL, &never, 1);
        assert_refused(NULL, sharp ? &released : &released_dc, 1);
    }
}

static yb_panel_model_t *awake_model(const char *name)
{
    yb_panel_model_t *model = new_model(name);

    (void)yb_panel_model_select(model, true);
    if (strncmp(name, "ls0", 3) != 0 && strncmp(name, "ssd", 3) != 0)
        play(model, (const int[]){0x11, 0x3A, D(0x55), 0x29, 0x2C, END});
    return model;
}

/* One thing at random; false if the model answers so. */
static bool poke(yb_panel_model_t *model, uint32_t random)
{
    /* Half of the bytes have few bits set, so that they do not all fail at once. */
    const uint8_t byte = (uint8_t)(random >> 24 & ((random >> 21 & 1) != 0 ? 0xC1 : 0xFF));
    yb_model_picture_t picture;

    switch (random >> 12 & 0x3F) {
    case 0:
        yb_panel_model_reset(model);
        return true;
    case 1:
        yb_panel_model_wait(model, random);
        return yb_panel_model_error(model)[0] == '\0';
    case 2:
    case 3:
        return yb_panel_model_select(model, false) && yb_panel_model_select(model, true);
    case 4:
        return byte >= 16 || yb_panel_model_picture(model, &picture);
    default:
        return yb_panel_model_byte(model, (random >> 20 & 1) != 0, byte);
    }
}

static unsigned long random_bytes = 2000;

/* Whatever comes, a model answers, and says what was wrong if anything was. */
static void random_bytes_do_no_harm(void **state)
{
    uint32_t seed = 7;
    const char *name = NULL;

    (void)state;
    for (size_t i = 0; (name = yb_panel_model_name(i)) != NULL; i++) {
        yb_panel_model_t *model = awake_model(name);
        unsigned long refused = 0;
        for (unsigned long n = 0; n < random_bytes; n++) {
            seed = seed * 1664525U + 1013904223U;
            const bool well = poke(model, seed);
            assert_int_equal(well, yb_panel_model_error(model)[0] == '\0');
            if (!well) {
                assert_memory_equal(yb_panel_model_error(model), "byte ", 5);
                assert_false(yb_panel_model_byte(model, false, 0x00));
                yb_panel_model_free(model);
                model = awake_model(name);
                refused++;
            }
        }
        assert_in_range(refused, random_bytes / 100, random_bytes * 19 / 20);
        yb_panel_model_free(model);
    }
}

/* test_panel_models [COUNT]: how many bytes at random each model gets. */
int main(int argc, char **argv)
{
    const struct CMUnitTest models[] = {
        cmocka_unit_test(models_are_found_by_name),
        cmocka_unit_test(a_fresh_panel_is_dark),
        cmocka_unit_test(bytes_that_are_not_for_the_panel_are_refused),
        cmocka_unit_test(random_bytes_do_no_harm),
    };

    if (argc > 1)
        random_bytes = strtoul(argv[1], NULL, 10);
    int failed = cmocka_run_group_tests(models, NULL, NULL);

    failed += test_solomon_models();
    failed += test_mipi_models();
    failed += test_sharp_models();
    return failed;
}
