/* SPDX-License-Identifier: MIT */
/* The estimate of glint adequacy against the exact sums of flat-sided cylinders. */
#include "optics/aliasing.h"

#include "check.h"

/* The sum over an N-gon's sides of the glint at broadside, azimuth `phase` from a side's normal,
   over the integral round the circle. */
static double polygon_over_circle(int n, double s, double phase)
{
    const double pi = 3.14159265358979323846;
    double sum = 0;
    for (int k = 0; k < n; k++) {
        double c = cos(2 * pi * k / n + phase);
        sum += c > 0 ? 2 * sin(pi / n) * pow(c, -4) * exp(-(1 / (c * c) - 1) / (s * s)) : 0;
    }
    return sum / (sqrt(pi) * s * (1 + s * s / 2));
}

static void the_estimate_is_the_worst_error_of_a_polygon_or_up_to_three_times_that(void **state)
{
    (void)state;
    static const struct {
        int n;
        double s;
    } row[] = {{64, 0.05}, {93, 0.05}, {231, 0.02}, {47, 0.1}, {24, 0.2}, {41, 0.2}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double turn = 2 * 3.14159265358979323846 / row[i].n;
        double worst = 0;
        for (int k = 0; k <= 100; k++) {
            double ratio = polygon_over_circle(row[i].n, row[i].s, 0.005 * k * turn);
            worst = fmax(worst, fabs(ratio - 1));
        }
        check_most(worst, 1.05 * lrcsi_aliasing_error(turn, row[i].s));
        check_most(lrcsi_aliasing_error(turn, row[i].s), 3 * worst);
    }
}

static void the_count_is_the_least_that_serves(void **state)
{
    (void)state;
    static const double slope[] = {0.02, 0.05, 0.1, 0.2};
    static const double most[] = {1e-2, 1e-3};
    static const double about[4][2] = {{231, 277}, {93, 112}, {47, 58}, {24, 41}};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 2; k++) {
            double n = lrcsi_aliasing_around(slope[i], most[k]);
            double turn = 2 * 3.14159265358979323846;
            check_most(lrcsi_aliasing_error(turn / n, slope[i]), most[k]);
            assert_true(lrcsi_aliasing_error(turn / (n - 1), slope[i]) > most[k]);
            check_rel(n, about[i][k], 0.06); /* the table of the design */
        }
    }
}

static void no_count_serves_a_slope_narrower_than_rounding(void **state)
{
    (void)state;
    double n = lrcsi_aliasing_around(1e-20, 1e-3);
    assert_true(n >= 1e15 && n <= 2e15);
    assert_true(lrcsi_aliasing_error(2 * 3.14159265358979323846 / n, 1e-20) > 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_estimate_is_the_worst_error_of_a_polygon_or_up_to_three_times_that),
        cmocka_unit_test(the_count_is_the_least_that_serves),
        cmocka_unit_test(no_count_serves_a_slope_narrower_than_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
