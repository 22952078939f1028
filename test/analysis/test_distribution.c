/* SPDX-License-Identifier: MIT */
/* The distribution of sigma over poses, against what follows from its definition: percentiles of
   numbers that are listed here, weights as copies, and ends that enclose every choice of sigma. */
#include <lrcs/distribution.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "random.h"

#define ROWS 200u

static lrcs_distribution_row row[2 * ROWS];
static lrcs_distribution_row room[2 * ROWS];
static lrcs_distribution d;

static lrcs_distribution_row row_of(double sigma, double bound, double weight, uint64_t index)
{
    return (lrcs_distribution_row){sigma, bound, weight, (double)NAN, (double)NAN, index};
}

static void percentiles_of_1_to_200_are_twice_the_percent(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < ROWS; i++) { /* in another order */
        row[i] = row_of(1.0 + i * 37u % ROWS, 0.0, 1.0, i);
    }
    assert_int_equal(lrcs_distribution_make(row, room, ROWS, &d), LRCS_OK);
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
        for (int end = LRCS_DISTRIBUTION_LEAST; end <= LRCS_DISTRIBUTION_MOST; end++) {
            check_same(d.percentile_m2[k].at[end], 2.0 * d.percent[k]);
        }
    }
    check_rel(d.mean_m2.at[LRCS_DISTRIBUTION_VALUE], 100.5, 1e-15);
    /* the variance of 1 .. n is (n^2 - 1) / 12, of which n / (n - 1) is the estimate */
    check_rel(d.standard_error_m2, sqrt((ROWS * ROWS - 1.0) / 12.0 / (ROWS - 1.0)), 1e-12);
    for (uint32_t i = 0; i < ROWS; i++) {
        check_same(row[i].sigma_m2, i + 1.0);
    }
}

static void a_weight_of_2_is_a_row_twice(void **state)
{
    (void)state;
    lrcs_distribution twice;
    uint64_t seed = 5;
    for (uint32_t i = 0; i < ROWS; i++) {
        double sigma = random_unit(&seed);
        double bound = 0.1 * random_unit(&seed);
        row[i] = row_of(sigma, bound, 2.0, i);
        row[ROWS + i] = row_of(sigma, bound, 1.0, i);
    }
    assert_int_equal(lrcs_distribution_make(row, room, ROWS, &d), LRCS_OK);
    memcpy(row, row + ROWS, ROWS * sizeof *row);
    assert_int_equal(lrcs_distribution_make(row, room, 2 * (uint64_t)ROWS, &twice), LRCS_OK);
    check_rel(d.mean_m2.at[LRCS_DISTRIBUTION_VALUE], twice.mean_m2.at[LRCS_DISTRIBUTION_VALUE],
              1e-14);
    assert_int_equal(d.bins, twice.bins);
    for (uint32_t i = 0; i < d.bins; i++) {
        check_abs(d.share[i], twice.share[i], 1e-14);
    }
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
        check_same(d.percentile_m2[k].at[LRCS_DISTRIBUTION_VALUE],
                   twice.percentile_m2[k].at[LRCS_DISTRIBUTION_VALUE]);
    }
}

/* The first two weights are less than a quarter of all, but by less than rounding shows: the ends of
   the 25th percentile enclose the third sigma. */
static void weights_that_add_up_to_the_number_of_rows_are_no_whole_numbers(void **state)
{
    (void)state;
    const double weight[4] = {0.5, 0.5 - 0x1p-54, 1.5, 1.5};
    const double sigma[4] = {1, 2, 1000, 2000};
    int quarter = 0;
    for (uint32_t i = 0; i < 4; i++) {
        row[i] = row_of(sigma[i], 0.0, weight[i], i);
    }
    assert_int_equal(lrcs_distribution_make(row, room, 4, &d), LRCS_OK);
    while (d.percent[quarter] != 25) {
        quarter++;
    }
    check_most(d.percentile_m2[quarter].at[LRCS_DISTRIBUTION_LEAST], 1000);
    check_most(1000, d.percentile_m2[quarter].at[LRCS_DISTRIBUTION_MOST]);
}

/* Every sigma moves to a random place within its bound: no number leaves its ends. */
static void ends_enclose_every_sigma_within_its_bound(void **state)
{
    (void)state;
    static lrcs_distribution_row moved[ROWS];
    lrcs_distribution other;
    uint64_t seed = 7;
    for (int trial = 0; trial < 50; trial++) {
        for (uint32_t i = 0; i < ROWS; i++) {
            double sigma = random_unit(&seed);
            double bound = 0.2 * random_unit(&seed) * sigma;
            double weight = random_unit(&seed);
            row[i] = row_of(sigma, bound, weight, i);
            moved[i] = row_of(sigma + (2.0 * random_unit(&seed) - 1.0) * bound, 0.0, weight, i);
        }
        assert_int_equal(lrcs_distribution_make(row, room, ROWS, &d), LRCS_OK);
        assert_int_equal(lrcs_distribution_make(moved, room, ROWS, &other), LRCS_OK);
        double mean = other.mean_m2.at[LRCS_DISTRIBUTION_VALUE];
        check_most(d.mean_m2.at[LRCS_DISTRIBUTION_LEAST], mean);
        check_most(mean, d.mean_m2.at[LRCS_DISTRIBUTION_MOST]);
        for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
            double value = other.percentile_m2[k].at[LRCS_DISTRIBUTION_VALUE];
            check_most(d.percentile_m2[k].at[LRCS_DISTRIBUTION_LEAST], value);
            check_most(value, d.percentile_m2[k].at[LRCS_DISTRIBUTION_MOST]);
        }
        for (uint32_t i = 0; i <= d.bins; i++) { /* its share up to an edge of d */
            double below = 0.0;
            double whole = 0.0;
            for (uint32_t k = 0; k < ROWS; k++) {
                whole += moved[k].weight;
                below += moved[k].sigma_m2 <= d.edge_m2[i] ? moved[k].weight : 0.0;
            }
            check_most(d.cdf[LRCS_DISTRIBUTION_LEAST][i], below / whole + 1e-14);
            check_most(below / whole, d.cdf[LRCS_DISTRIBUTION_MOST][i] + 1e-14);
        }
    }
}

static void bins_hold_every_row(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int decades = 1; decades < 9; decades++) {
        double sum = 0.0;
        for (uint32_t i = 0; i < ROWS; i++) {
            row[i] = row_of(pow(10.0, -decades * random_unit(&seed)), 0.0, 1.0, i);
        }
        assert_int_equal(lrcs_distribution_make(row, room, ROWS, &d), LRCS_OK);
        assert_in_range(d.bins, 1, LRCS_DISTRIBUTION_BINS);
        for (uint32_t i = 0; i < d.bins; i++) {
            sum += d.share[i];
        }
        check_abs(sum, 1.0, 1e-12);
        check_same(d.cdf[LRCS_DISTRIBUTION_VALUE][0], 0.0);
        check_same(d.cdf[LRCS_DISTRIBUTION_VALUE][d.bins], 1.0);
    }
    row[0] = row_of(0.0, 0.0, 1.0, 0);
    assert_int_equal(lrcs_distribution_make(row, room, 1, &d), LRCS_OK);
    assert_int_equal(d.bins, 0);
    assert_true(isnan(d.standard_error_m2));
}

static void material_intervals_are_carried_through(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < ROWS; i++) {
        double sigma = 1.0 + i;
        row[i] = (lrcs_distribution_row){sigma, 0.0, 1.0, 0.5 * sigma, 2.0 * sigma, i};
    }
    assert_int_equal(lrcs_distribution_make(row, room, ROWS, &d), LRCS_OK);
    assert_true(d.has_intervals);
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
        check_same(d.percentile_m2[k].at[LRCS_DISTRIBUTION_LOW], 1.0 * d.percent[k]);
        check_same(d.percentile_m2[k].at[LRCS_DISTRIBUTION_HIGH], 4.0 * d.percent[k]);
    }
    check_rel(d.mean_m2.at[LRCS_DISTRIBUTION_HIGH], 201.0, 1e-15);
}

static void rows_that_are_no_rows_are_refused(void **state)
{
    (void)state;
    const lrcs_distribution_row bad[] = {
        row_of(-1.0, 0.0, 1.0, 0),           row_of((double)NAN, 0.0, 1.0, 0),
        row_of(HUGE_VAL, 0.0, 1.0, 0),       row_of(1.0, -1.0, 1.0, 0),
        row_of(1.0, (double)NAN, 1.0, 0),    row_of(1.0, 0.0, -1.0, 0),
        row_of(1.0, 0.0, (double)NAN, 0),    {1.0, 0.0, 1.0, 1.0, (double)NAN, 0},
        {1.0, 0.0, 1.0, (double)NAN, 2.0, 0}};
    memset(&d, 1, sizeof d);
    lrcs_distribution before = d;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        row[0] = bad[i];
        assert_int_equal(lrcs_distribution_make(row, room, 1, &d), LRCS_E_NUMBER);
    }
    row[0] = row_of(1.0, 0.0, 0.0, 0);
    assert_int_equal(lrcs_distribution_make(row, room, 1, &d), LRCS_E_EMPTY);
    assert_int_equal(lrcs_distribution_make(row, room, 0, &d), LRCS_E_EMPTY);
    assert_memory_equal(&d, &before, sizeof d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(percentiles_of_1_to_200_are_twice_the_percent),
        cmocka_unit_test(a_weight_of_2_is_a_row_twice),
        cmocka_unit_test(weights_that_add_up_to_the_number_of_rows_are_no_whole_numbers),
        cmocka_unit_test(ends_enclose_every_sigma_within_its_bound),
        cmocka_unit_test(bins_hold_every_row),
        cmocka_unit_test(material_intervals_are_carried_through),
        cmocka_unit_test(rows_that_are_no_rows_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
