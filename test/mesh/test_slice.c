/* SPDX-License-Identifier: MIT */
/* The interval of heights that a part of a triangle covers, against heights chosen beforehand. */
#include "mesh/slice.h"

#include "check.h"

static const double corner_o[3] = {0.25, 0.75, 0.125};
static const double corner_p[3] = {-0.5, -0.25, 0.125};
static const double corner_q[3] = {0.5, -0.25, 0.125};
static const double up[3] = {0, 1, 0};
static const double down[3] = {0, -1, 0};

static void an_extent_is_the_interval_of_heights(void **state)
{
    (void)state;
    lrcsi_slice slice = lrcsi_slice_start(corner_o, corner_p, corner_q);
    check_same(lrcsi_slice_extent(&slice, corner_o, corner_p, corner_q), 1);
    lrcsi_slice_cut(&slice, up, corner_p, 0.5);
    lrcsi_slice_cut(&slice, down, corner_p, -0.25);
    double extent = lrcsi_slice_extent(&slice, corner_o, corner_p, corner_q);
    assert_true(extent >= 0.25);
    check_abs(extent, 0.25, 1e-11);
    extent = lrcsi_slice_extent(&slice, corner_o, corner_q, corner_p);
    assert_true(extent >= 0.25);
    check_abs(extent, 0.25, 1e-11);
}

static void an_empty_slice_has_no_extent_and_a_degenerate_triangle_all(void **state)
{
    (void)state;
    lrcsi_slice slice = lrcsi_slice_start(corner_o, corner_p, corner_q);
    check_same(lrcsi_slice_extent(&slice, corner_o, corner_p, corner_p), 1);
    check_same(lrcsi_slice_extent(&slice, corner_p, corner_p, corner_q), 1);
    lrcsi_slice_cut(&slice, up, corner_p, -0.5);
    assert_int_equal(slice.count, 0);
    check_same(lrcsi_slice_extent(&slice, corner_o, corner_p, corner_q), 0);
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
        cmocka_unit_test(an_extent_is_the_interval_of_heights),
        cmocka_unit_test(an_empty_slice_has_no_extent_and_a_degenerate_triangle_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
