/* SPDX-License-Identifier: MIT */
/* Exponential and logarithm against mpmath, within the errors declared with them; the ends of their
   domains; and lanes within the error that is proved for them. */
#include "base/elementary.h"

#include "check.h"

enum { EXP, LOG, LOG1P };

static const struct vector {
    int function;
    double x, high, low;
} vectors[] = {
#include "vectors/elementary.inc"
};

#define COUNT (sizeof vectors / sizeof vectors[0])
#define U     0x1p-53

/* |a + b - value| in units of u |value|. Where a differs from the value in its last digits only,
   the difference is exact. */
static double units(double a, double b, const struct vector *v)
{
    double error = fabs((a - v->high) + (b - v->low));
    return error == 0.0 ? 0.0 : error / U / fabs(v->high);
}

static void check_units(double *worst, double got, double most, const struct vector *v)
{
    if (!(got <= most)) {
        fail_msg("function %d at %a: %g units", v->function, v->x, got);
    }
    *worst = fmax(*worst, got);
}

static void scalars_stay_within_the_errors_declared(void **state)
{
    (void)state;
    static const double most[] = {LRCSI_EXP_ERROR, LRCSI_LOG_ERROR, LRCSI_LOG1P_ERROR};
    double worst[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < COUNT; i++) {
        const struct vector *v = &vectors[i];
        lrcsi_dd got = v->function == EXP   ? (lrcsi_dd){lrcsi_exp(v->x), 0.0}
                       : v->function == LOG ? lrcsi_log(v->x)
                                            : lrcsi_log1p(v->x);
        check_units(&worst[v->function], units(got.hi, got.lo, v), most[v->function], v);
        if (v->function == LOG1P && v->x > 0x1p-40) {
            assert_true(units(got.hi, got.lo, v) <= LRCSI_LOG_ERROR + 0x1p-12);
        }
    }
    print_message("worst, in units of 2^-53: exp %.2f, log %.3f, log1p %.3f\n", worst[EXP],
                  worst[LOG], worst[LOG1P]);
}

static void lanes_stay_within_the_errors_declared(void **state)
{
    (void)state;
    double worst[2] = {0.0, 0.0};
    for (size_t i = 0; i < COUNT; i++) {
        const struct vector *v = &vectors[i];
        double x[LRCSI_LANES];
        double out[LRCSI_LANES];
        for (size_t k = 0; k < LRCSI_LANES; k++) {
            x[k] = 1.0 + (double)k;
        }
        size_t lane = i % LRCSI_LANES;
        x[lane] = v->x;
        if (v->function == EXP) {
            lrcsi_exp_lanes(x, out);
            check_units(&worst[EXP], units(out[lane], 0.0, v), LRCSI_EXP_ERROR, v);
        } else if (v->function == LOG && v->x >= 0x1p-1000 && v->x <= 0x1p1000) {
            lrcsi_log_lanes(x, out);
            check_units(&worst[LOG], units(out[lane], 0.0, v), LRCSI_LOG_LANES_ERROR, v);
        }
    }
    print_message("worst, in units of 2^-53: exp %.2f, log %.2f\n", worst[EXP], worst[LOG]);
}

static void lanes_give_the_bits_of_the_scalar_exponential(void **state)
{
    (void)state;
    double x[LRCSI_LANES];
    double out[LRCSI_LANES];
    for (int i = 0; i < LRCSI_LANES; i++) {
        x[i] = -11.0 * i + 0.37;
    }
    lrcsi_exp_lanes(x, out);
    for (int i = 0; i < LRCSI_LANES; i++) {
        check_same(out[i], lrcsi_exp(x[i]));
    }
}

/* The split exponent: e^(hi + lo) against the vectors' e^hi, times 1 + lo. */
static void a_low_part_of_the_exponent_counts(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT; i++) {
        const struct vector *v = &vectors[i];
        double low = 0.49 * U * v->x;
        if (v->function == EXP) {
            double got = lrcsi_exp_dd((lrcsi_dd){v->x, low});
            check_abs((got - v->high) - (v->low + v->high * low), 0.0,
                      LRCSI_EXP_DD_ERROR * U * v->high);
        }
    }
}

static void the_ends_are_zero_and_infinity(void **state)
{
    (void)state;
    check_same(lrcsi_exp(-HUGE_VAL), 0.0);
    check_same(lrcsi_exp(HUGE_VAL), HUGE_VAL);
    check_same(lrcsi_exp(-746.5), 0.0);
    check_same(lrcsi_exp(709.9), HUGE_VAL);
    check_same(lrcsi_exp(0.0), 1.0);
    check_same(lrcsi_exp(-745.0), 0x1p-1074);
    check_rel(lrcsi_exp(709.5), 0x1.81e9b4b52d0c9p+1023, 5 * U);
    check_abs(lrcsi_exp(-720.0), 0x1.32769b92a3d7cp-1039, 0x1p-1073);
    check_same(lrcsi_exp_dd((lrcsi_dd){-800.0, 0.0}), 0.0);
    check_same(lrcsi_exp_dd((lrcsi_dd){800.0, -1e-14}), HUGE_VAL);
    check_same(lrcsi_log(1.0).hi, 0.0);
    check_same(lrcsi_log(1.0).lo, 0.0);
    check_same(lrcsi_log1p(0.0).hi, 0.0);
}

static void powers_beyond_the_range_are_0_or_infinite(void **state)
{
    (void)state;
    lrcsi_dd log_2 = lrcsi_log(2.0);
    assert_true(lrcsi_power(log_2, 2000.0) == HUGE_VAL);
    assert_true(lrcsi_power(log_2, -2000.0) == 0.0);
    assert_true(lrcsi_power(log_2, 1e300) == HUGE_VAL);
    assert_true(fabs(lrcsi_power(log_2, 10.0) - 1024.0) < 1e-9);
    assert_true(fabs(lrcsi_power(log_2, -10.0) * 1024.0 - 1.0) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_beyond_the_range_are_0_or_infinite),
        cmocka_unit_test(scalars_stay_within_the_errors_declared),
        cmocka_unit_test(lanes_stay_within_the_errors_declared),
        cmocka_unit_test(lanes_give_the_bits_of_the_scalar_exponential),
        cmocka_unit_test(a_low_part_of_the_exponent_counts),
        cmocka_unit_test(the_ends_are_zero_and_infinity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
