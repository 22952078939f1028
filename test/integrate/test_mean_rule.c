/* SPDX-License-Identifier: MIT */
/* The Gauss-Legendre rules against the means of powers over [-1, 1] in closed form. */
#include "integrate/wall/mean_rule.h"

#include "check.h"

/* The mean of x^degree by a rule, in long double. */
static double mean_of_power(const lrcsi_mean_rule *rule, int degree)
{
    double x[LRCSI_MEAN_RULE_POINTS];
    double weight[LRCSI_MEAN_RULE_POINTS];
    int count = lrcsi_mean_rule_points(rule, x, weight);
    long double sum = 0;
    for (int i = 0; i < count; i++) {
        long double power = 1;
        for (int k = 0; k < degree; k++) {
            power *= x[i];
        }
        sum += weight[i] * power;
    }
    return (double)sum;
}

static double true_mean(int degree)
{
    return degree % 2 ? 0 : 1.0 / (degree + 1);
}

static void points_lie_within_the_interval_and_weights_make_one(void **state)
{
    (void)state;
    for (int r = 0; r < LRCSI_MEAN_RULES; r++) {
        const lrcsi_mean_rule *rule = &lrcsi_mean_rules[r];
        double x[LRCSI_MEAN_RULE_POINTS];
        double weight[LRCSI_MEAN_RULE_POINTS];
        assert_in_range(rule->points, 2, LRCSI_MEAN_RULE_POINTS);
        assert_int_equal(rule->half, (rule->points + 1) / 2);
        assert_int_equal(lrcsi_mean_rule_points(rule, x, weight), rule->points);
        assert_true(r == 0 || rule->points > lrcsi_mean_rules[r - 1].points);
        double sum = 0;
        for (int i = 0; i < rule->points; i++) {
            assert_true(x[i] > -1 && x[i] < 1);
            assert_true(weight[i] > 0);
            for (int j = 0; j < i; j++) {
                assert_true(x[i] != x[j]);
            }
            sum += weight[i];
        }
        check_abs(sum, 1, 1e-15);
    }
}

static void a_rule_of_n_points_is_exact_up_to_degree_2n_minus_1(void **state)
{
    (void)state;
    for (int r = 0; r < LRCSI_MEAN_RULES; r++) {
        for (int degree = 0; degree < 2 * lrcsi_mean_rules[r].points; degree++) {
            check_abs(mean_of_power(&lrcsi_mean_rules[r], degree), true_mean(degree), 1e-15);
        }
    }
}

/* The mean of x^2n by a rule of n points is too small by the mean of the square of the monic
   Legendre polynomial, 2^2n (n!)^4 / ((2n)!^2 (2n + 1)), which is far more than rounding. */
static void a_rule_of_n_points_errs_at_degree_2n_by_the_known_remainder(void **state)
{
    (void)state;
    for (int r = 0; r < LRCSI_MEAN_RULES; r++) {
        int n = lrcsi_mean_rules[r].points;
        double remainder = 1.0 / (2 * n + 1);
        for (int k = 1; k <= n; k++) {
            double factor = 2.0 * k / (n + k);
            remainder *= factor * factor;
        }
        double short_of = true_mean(2 * n) - mean_of_power(&lrcsi_mean_rules[r], 2 * n);
        check_abs(short_of, remainder, 1e-15);
        assert_true(remainder > 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_lie_within_the_interval_and_weights_make_one),
        cmocka_unit_test(a_rule_of_n_points_is_exact_up_to_degree_2n_minus_1),
        cmocka_unit_test(a_rule_of_n_points_errs_at_degree_2n_by_the_known_remainder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
