/* SPDX-License-Identifier: MIT */
/* Compensated sums, one and in lanes, against exact sums of integers. */
#include "base/sum.h"

#include "check.h"

/* 2^60 and small numbers in turn: plain sums lose every small one. Eight blocks of them. */
static double term(int i)
{
    return i % 3 == 0 ? 0x1p60 : i % 3 == 1 ? 1.0 + i % 7 : -0x1p60;
}

#define TERMS (8 * LRCSI_LANES)

/* The sum of the small terms alone, which remains where the large ones cancel. */
static double small_ones(void)
{
    double sum = 0.0;
    for (int i = 0; i < TERMS; i++) {
        sum += i % 3 == 1 ? 1.0 + i % 7 : 0.0;
    }
    return sum;
}

static void a_sum_keeps_what_large_terms_hide(void **state)
{
    (void)state;
    lrcsi_sum sum = {0, 0};
    double large = 0.0;
    for (int i = 0; i < TERMS; i++) {
        lrcsi_sum_add(&sum, term(i));
        large += i % 3 == 1 ? 0.0 : term(i);
    }
    lrcsi_sum_add(&sum, -large);
    check_same(lrcsi_sum_value(&sum), small_ones());
}

static void lanes_keep_it_too(void **state)
{
    (void)state;
    lrcsi_sum_lanes lanes = {{0}, {0}};
    lrcsi_sum sum = {0, 0};
    double large = 0.0;
    double block[LRCSI_LANES];
    for (int i = 0; i < TERMS; i++) {
        block[i % LRCSI_LANES] = term(i);
        large += i % 3 == 1 ? 0.0 : term(i);
        if (i % LRCSI_LANES == LRCSI_LANES - 1) {
            lrcsi_sum_lanes_add(&lanes, block);
        }
    }
    lrcsi_sum_lanes_join(&sum, &lanes);
    lrcsi_sum_add(&sum, -large);
    check_same(lrcsi_sum_value(&sum), small_ones());
}

/* Term i of a block goes to lane i mod 8, whatever the width that a machine adds at once. */
static void lanes_are_eight_and_fixed(void **state)
{
    (void)state;
    assert_int_equal(LRCSI_SUM_LANES, 8);
    assert_int_equal(LRCSI_LANES % LRCSI_SUM_LANES, 0);
    lrcsi_sum_lanes lanes = {{0}, {0}};
    double block[LRCSI_LANES];
    for (int i = 0; i < LRCSI_LANES; i++) {
        block[i] = i % LRCSI_SUM_LANES == 3 ? 1.0 : i % LRCSI_SUM_LANES == 5 ? 0x1p-80 : 0.0;
    }
    block[5] = 1.0;
    lrcsi_sum_lanes_add(&lanes, block);
    check_same(lanes.high[3], LRCSI_LANES / LRCSI_SUM_LANES);
    check_same(lanes.high[5], 1.0);
    check_same(lanes.low[5], (LRCSI_LANES / LRCSI_SUM_LANES - 1) * 0x1p-80);
    check_same(lanes.high[4], 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sum_keeps_what_large_terms_hide),
        cmocka_unit_test(lanes_keep_it_too),
        cmocka_unit_test(lanes_are_eight_and_fixed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
