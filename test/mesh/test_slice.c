/* SPDX-License-Identifier: MIT */
/* The interval of heights that a part of a triangle covers, against heights chosen beforehand. */
#include "mesh/slice.h"

#include "check.h"

static const double corner_o[3] = {0.25, 0.75, 0.125};
static const double corner_p[3] = {-0.5, -0.25, 0.125};
static const double corner_q[3] = {0.5, -0.25, 0.125};
static const double up[3] = {0, 1, 0};
static const double down[3] = {0, -1, 0};

/* Over the side from p to q, rounded outward. */
static void check_heights(const lrcsi_slice *slice, const double p[3], const double q[3],
                          double want_low, double want_high)
{
    double low;
    double high;
    assert_true(lrcsi_slice_heights(slice, corner_o, p, q, &low, &high));
    assert_true(low >= 0 && high <= 1 && low <= want_low && high >= want_high);
    check_abs(low, want_low, 1e-11);
    check_abs(high, want_high, 1e-11);
}

static void heights_are_an_interval(void **state)
{
    (void)state;
    lrcsi_slice slice = lrcsi_slice_start(corner_o, corner_p, corner_q);
    check_heights(&slice, corner_p, corner_q, 0, 1);
    lrcsi_slice_cut(&slice, up, corner_p, 0.5);
    lrcsi_slice_cut(&slice, down, corner_p, -0.25);
    check_heights(&slice, corner_p, corner_q, 0.25, 0.5);
    check_heights(&slice, corner_q, corner_p, 0.25, 0.5);
}

static void an_empty_slice_has_no_heights_and_a_degenerate_triangle_all(void **state)
{
    (void)state;
    lrcsi_slice slice = lrcsi_slice_start(corner_o, corner_p, corner_q);
    double low;
    double high;
    check_heights(&slice, corner_p, corner_p, 0, 1);
    assert_true(lrcsi_slice_heights(&slice, corner_p, corner_p, corner_q, &low, &high));
    check_same(low, 0);
    check_same(high, 1);
    lrcsi_slice_cut(&slice, up, corner_p, -0.5);
    assert_int_equal(slice.count, 0);
    assert_false(lrcsi_slice_heights(&slice, corner_o, corner_p, corner_q, &low, &high));
}

/* A triangle outside a half-space that touches it in a corner or along a side has no area in it. */
static void contact_without_overlap_has_no_area(void **state)
{
    (void)state;
    static const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const double n[3] = {1, 0, 0};
    for (int side = 0; side < 2; side++) {
        lrcsi_slice slice = lrcsi_slice_start(x[0], x[1], side ? x[3] : x[2]);
        lrcsi_slice_cut(&slice, n, x[0], 0);
        assert_int_equal(slice.count, 1 + side);
        assert_true(lrcsi_slice_fraction(&slice, 0.5, 1.5) == 0);
        lrcsi_slice_cut(&slice, n, x[0], 0x1p-20);
        assert_int_equal(slice.count, 1 + side);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contact_without_overlap_has_no_area),
        cmocka_unit_test(heights_are_an_interval),
        cmocka_unit_test(an_empty_slice_has_no_heights_and_a_degenerate_triangle_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
