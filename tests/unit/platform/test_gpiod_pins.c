/* The wiring of a panel as people write it. */
#include "gpiod_bus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void wiring_is_read_in_any_order(void **state)
{
    char error[YB_GPIOD_ERROR_BYTES] = "";
    yb_gpiod_pins_t pins = {.chip = "gpiochip0"};

    (void)state;
    assert_true(
        yb_gpiod_pins_parse(&pins, "sck=11,mosi=10,cs=8,dc=25,reset=24", error, sizeof error));
    assert_int_equal(pins.sck, 11);
    assert_int_equal(pins.mosi, 10);
    assert_int_equal(pins.cs, 8);
    assert_int_equal(pins.dc, 25);
    assert_int_equal(pins.reset, 24);
    assert_string_equal(pins.chip, "gpiochip0");

    assert_true(yb_gpiod_pins_parse(&pins, "dc=0,cs=1,mosi=9999,sck=3", error, sizeof error));
    assert_int_equal(pins.sck, 3);
    assert_int_equal(pins.mosi, 9999);
    assert_int_equal(pins.cs, 1);
    assert_int_equal(pins.dc, 0);
    assert_int_equal(pins.reset, YB_GPIOD_NOT_WIRED);
    assert_string_equal(error, "");
}

static void other_texts_are_refused(void **state)
{
    static const struct {
        const char *text;
        const char *sentence;
    } wrong[] = {
        {"", "\"\" is not one of sck=N, mosi=N, cs=N, dc=N, reset=N"},
        {"sck=1,", "\"\" is not one of sck=N, mosi=N, cs=N, dc=N, reset=N"},
        {"sck=1,miso=2", "\"miso=2\" is not one of sck=N, mosi=N, cs=N, dc=N, reset=N"},
        {"11,10,8,25", "\"11\" is not one of sck=N, mosi=N, cs=N, dc=N, reset=N"},
        {"a very long name for a line, really",
         "\"a very long name for\" is not one of sck=N, mosi=N, cs=N, dc=N, reset=N"},
        {"sck=1,sck=1", "\"sck=1\" names that line a second time"},
        {"sck=", "\"sck=\" has no line number, 0 to 9999"},
        {"sck=-1", "\"sck=-1\" has no line number, 0 to 9999"},
        {"sck=1 ,cs=2", "\"sck=1 \" has no line number, 0 to 9999"},
        {"sck=99999999999", "\"sck=99999999999\" has no line number, 0 to 9999"},
        {"sck=1,mosi=2,cs=3", "\"sck=1,mosi=2,cs=3\" lacks dc=N"},
        {"reset=1", "\"reset=1\" lacks sck=N"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char error[YB_GPIOD_ERROR_BYTES] = "";
        yb_gpiod_pins_t pins = {.chip = NULL};
        assert_false(yb_gpiod_pins_parse(&pins, wrong[i].text, error, sizeof error));
        assert_string_equal(error, wrong[i].sentence);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wiring_is_read_in_any_order),
        cmocka_unit_test(other_texts_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
