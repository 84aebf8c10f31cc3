/* Fixed-point arithmetic against double: every accuracy that fix.h and yamabiko.h promise. */
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "rng.h"

#include "fix.c"

static const double turn = 6.283185307179586476925;

static void tables_equal_their_formulas(void **state)
{
    (void)state;
    for (int i = 0; i <= 32; i++) {
        assert_int_equal(log_table[i], lround(2048 * log2(1 + i / 32.0)));
        assert_int_equal(exp_table[i], lround(32768 * (exp2(i / 32.0) - 1)));
    }
    for (int i = 0; i <= 64; i++)
        assert_int_equal(sine_of(i), lround(16384 * sin(i / 64.0 * turn / 4)));
}

static void abs_min_max_clamp(void **state)
{
    (void)state;
    assert_int_equal(fix_abs(-7), 7);
    assert_int_equal(fix_abs(-INT32_MAX), INT32_MAX);
    assert_int_equal(fix_min(INT32_MIN, INT32_MAX), INT32_MIN);
    assert_int_equal(fix_max(INT32_MIN, INT32_MAX), INT32_MAX);
    assert_int_equal(fix_clamp(5, 0, 4), 4);
    assert_int_equal(fix_clamp(-5, 0, 4), 0);
    assert_int_equal(fix_clamp(3, 0, 4), 3);
}

static void length_is_within_its_bounds(void **state)
{
    (void)state;
    rng_t rng = {1};
    for (int i = 0; i < 1000000; i++) {
        int most = 1 << rng_range(&rng, 4, 28);
        int32_t dx = rng_range(&rng, 1 - most, most - 1);
        int32_t dy = rng_range(&rng, 1 - most, most - 1);
        double truth = sqrt((double)dx * dx + (double)dy * dy);
        int32_t length = fix_length(dx, dy);
        /* Whole numbers: 3/8 of the smaller side is rounded down. */
        assert_true(length > truth * 0.9722 - 1);
        assert_true(length <= truth * 1.06801);
        assert_int_equal(length, fix_length(-dx, dy));
        assert_int_equal(length, fix_length(dy, dx));
    }
    const int32_t most = (1 << 28) - 1;
    assert_int_equal(fix_length(-most, most), most + (3 * most >> 3));
    assert_int_equal(fix_length(0, 0), 0);
}

static void highest_bit(void **state)
{
    (void)state;
    for (int i = 0; i < 32; i++) {
        assert_int_equal(fix_log2_floor(1u << i), i);
        assert_int_equal(fix_log2_floor((1u << i) | ((1u << i) - 1)), i);
    }
}

static double log_error(uint64_t a)
{
    return fabs(fix_log2_q11(a) - 2048 * log2((double)a));
}

static void log2_is_within_its_bound(void **state)
{
    (void)state;
    double worst = 0;
    for (uint64_t a = 1; a < 1 << 20; a++)
        worst = fmax(worst, log_error(a));
    rng_t rng = {2};
    for (int i = 0; i < 2000000; i++) {
        uint64_t a = rng_next(&rng) >> rng_range(&rng, 0, 63);
        worst = fmax(worst, a == 0 ? 0 : log_error(a));
    }
    for (int i = 0; i < 64; i++) {
        worst = fmax(worst, log_error((uint64_t)1 << i));
        worst = fmax(worst, log_error(((uint64_t)2 << i) - 1));
    }
    print_message("log2: error up to %.3f / 2048\n", worst);
    assert_int_equal(fix_log2_q11(1), 0);
    assert_int_equal(fix_log2_q11((uint64_t)1 << 63), 63 * 2048);
    assert_true(worst < 1.2);
}

static void log2_never_falls(void **state)
{
    (void)state;
    int32_t before = 0;
    for (uint64_t a = 1; a < 1 << 18; a++) {
        assert_true(fix_log2_q11(a) >= before);
        before = fix_log2_q11(a);
    }
}

static void exp2_is_within_its_bound(void **state)
{
    (void)state;
    double worst = 0;
    uint32_t before = 0;
    for (int32_t e = -4 * 2048; e < 34 * 2048; e++) {
        uint32_t result = fix_exp2_q11(e);
        double truth = fmin(exp2(e / 2048.0), 4294967295.0);
        double error = fabs(result - truth);
        /* Half a unit of rounding, and the relative error. */
        assert_true(error <= 0.5 + truth / 2048);
        if (truth >= 65536)
            worst = fmax(worst, error / truth);
        assert_true(result >= before);
        before = result;
    }
    print_message("exp2: relative error up to 2^%.2f\n", log2(worst));
    assert_true(worst < 1 / 2048.0);
    assert_int_equal(fix_exp2_q11(0), 1);
    assert_int_equal(fix_exp2_q11(31 * 2048), 1u << 31);
    assert_int_equal(fix_exp2_q11(32 * 2048), UINT32_MAX);
    assert_int_equal(fix_exp2_q11(INT32_MAX), UINT32_MAX);
    assert_int_equal(fix_exp2_q11(INT32_MIN), 0);
}

static void square_root_is_exact(void **state)
{
    (void)state;
    for (uint64_t a = 0; a < 1 << 18; a++) {
        uint64_t root = fix_sqrt(a);
        assert_true(root * root <= a && (root + 1) * (root + 1) > a);
    }
    rng_t rng = {3};
    for (int i = 0; i < 500000; i++) {
        uint64_t root = rng_next(&rng) >> rng_range(&rng, 32, 63);
        assert_int_equal(fix_sqrt(root * root), root);
        if (root > 0)
            assert_int_equal(fix_sqrt(root * root - 1), root - 1);
    }
    assert_int_equal(fix_sqrt(UINT64_MAX), UINT32_MAX);
}

static void sine_and_cosine(void **state)
{
    (void)state;
    double worst = 0;
    for (uint32_t a = 0; a < 65536; a++) {
        uint16_t angle = (uint16_t)a;
        worst = fmax(worst, fabs(yb_sin_q14(angle) / 16384.0 - sin(a * turn / 65536)));
        worst = fmax(worst, fabs(yb_cos_q14(angle) / 16384.0 - cos(a * turn / 65536)));
        assert_int_equal(yb_sin_q14((uint16_t)-angle), -yb_sin_q14(angle));
        assert_int_equal(yb_cos_q14((uint16_t)-angle), yb_cos_q14(angle));
    }
    print_message("sine: error up to 1/%.0f\n", 1 / worst);
    assert_true(worst < 1 / 8192.0);
    assert_int_equal(yb_sin_q14(0x4000), 16384);
    assert_int_equal(yb_cos_q14(0x8000), -16384);
}

static void products(void **state)
{
    (void)state;
    assert_int_equal(fix_product(INT32_MIN, INT32_MIN, 62), 1);
    assert_int_equal(fix_product(INT32_MIN, INT32_MAX, 62), -1);
    assert_int_equal(fix_product(INT32_MAX, INT32_MAX, 61), 1);
    assert_int_equal(fix_product(-1, 1, 14), -1); /* rounded down */
    assert_int_equal(fix_product(-(1 << 24), 1 << 14, 14), -(1 << 24));
    assert_int_equal(fix_product(1 << 24, 1 << 8, 0), 0); /* the low 32 bits */
}

static void shares(void **state)
{
    (void)state;
    assert_true(fix_wide(INT32_MIN, INT32_MIN) == (int64_t)1 << 62);
    assert_true(fix_add(INT64_MAX - ((int64_t)1 << 62), INT32_MIN, INT32_MIN) == INT64_MAX);
    assert_true(fix_add(-7, -2, 3) == -13);
    assert_true(fix_wide(INT32_MIN, INT32_MAX) == -(((int64_t)1 << 62) - ((int64_t)1 << 31)));
    assert_int_equal(fix_scale(INT32_MAX, INT32_MAX, INT32_MAX), INT32_MAX);
    assert_int_equal(fix_scale(-INT32_MAX, INT32_MAX, INT32_MAX), -INT32_MAX);
    for (int sign = -1; sign <= 1; sign += 2) { /* towards zero, whichever is negative */
        assert_int_equal(fix_scale(7 * sign, 3, 4), 5 * sign);
        assert_int_equal(fix_scale(7, 3 * sign, 4), 5 * sign);
        assert_int_equal(fix_scale(7, 3, 4 * sign), 5 * sign);
    }
    assert_int_equal(fix_share(UINT64_MAX, 1, 12), 12);
    assert_int_equal(fix_share(UINT64_MAX, UINT32_MAX, UINT32_MAX), UINT32_MAX); /* 2^32 + 1 */
    assert_int_equal(fix_share(((uint64_t)1 << 32) - 1, 1, UINT32_MAX), UINT32_MAX);
    assert_int_equal(fix_share(99, 10, 9), 9);
    assert_int_equal(fix_share(99, 10, 10), 9);
}

static void inverses(void **state)
{
    (void)state;
    for (int32_t a = 1; a < 256; a++)
        assert_int_equal(fix_inverse(a), (1 << 20) / a);
    for (int32_t a = 1 << 14; a < 1 << 15; a++) {
        const int32_t inverse = fix_reciprocal(a);
        CHECK(fabs(inverse - exp2(29) / a) < 4, "2^29 / %d is not %d", a, inverse);
        assert_in_range(inverse, 1 << 14, 1 << 15);
    }
}

static void degrees(void **state)
{
    (void)state;
    for (unsigned d = 0; d < 360; d++)
        assert_int_equal(YB_DEGREES(d), lround(d * 65536 / 360.0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_equal_their_formulas),
        cmocka_unit_test(abs_min_max_clamp),
        cmocka_unit_test(length_is_within_its_bounds),
        cmocka_unit_test(highest_bit),
        cmocka_unit_test(log2_is_within_its_bound),
        cmocka_unit_test(log2_never_falls),
        cmocka_unit_test(exp2_is_within_its_bound),
        cmocka_unit_test(square_root_is_exact),
        cmocka_unit_test(sine_and_cosine),
        cmocka_unit_test(products),
        cmocka_unit_test(shares),
        cmocka_unit_test(inverses),
        cmocka_unit_test(degrees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
