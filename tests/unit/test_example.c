/* The example of yamabiko.h's essay, word for word (the build checks that), and what it does. */
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"

static const uint8_t code[] = {
    0x20, 0x02, 0x03, 0x0c, 0xff, 0xff, 0x07, 0x80, 0x02, 0x80, 0x03, 0xe8, 0x07, 0x08,
    0x00, 0x0a, 0x04, 0x03, 0x01, 0x40, 0x00, 0x14, 0x40, 0x40, 0x60, 0x00, 0x18, 0xa0,
    0x00, 0x03, 0xc6, 0x06, 0x02, 0x82, 0xe4, 0x70, 0x06, 0x47, 0x06, 0xc0, 0x1f,
};
static const size_t code_bytes = sizeof code;

static uint8_t picture[64 * 64];
static int sent;

static void send_to_panel(uint16_t y, const uint8_t *rows)
{
    memcpy(picture + 64 * y, rows, (size_t)64 * 8);
    sent++;
}

static void show(void)
{
#include "example.inc"
}

static void the_example_draws_a_mountain(void **state)
{
    (void)state;
    show();
    assert_int_equal(sent, 8);
    int ground = 0;
    for (size_t i = 0; i < sizeof picture; i++)
        ground += (picture[i] >> 4 != 0) + ((picture[i] & 15) != 0);
    print_message("%d of 8192 pixels are ground\n", ground);
    assert_true(ground > 2000 && ground < 7000);
    assert_int_equal(picture[0], 0);
    assert_int_not_equal(picture[64 * 40 + 32], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_example_draws_a_mountain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
