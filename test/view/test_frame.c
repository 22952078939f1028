/* SPDX-License-Identifier: MIT */
/* The axes of a view: how far they are from an exact rotation, in double-double. */
#include "check.h"
#include "random.h"

#include "base/dd.h"
#include "view/frame.h"

#include <math.h>

#define U 0x1p-53

static lrcsi_dd dot(const double a[3], const double b[3])
{
    lrcsi_dd sum = lrcsi_dd_two_product(a[0], b[0]);
    sum = lrcsi_dd_add(sum, lrcsi_dd_two_product(a[1], b[1]));
    return lrcsi_dd_add(sum, lrcsi_dd_two_product(a[2], b[2]));
}

/* Along e and d x e, e being the unit vector along the first row less its part along d, vectors are
   off by what the rows' lengths are from 1 and by their parts along d and each other: to first
   order, which is all that counts here. */
static double frame_off(const double d[3], double R[3][3])
{
    double most = 0;
    double length = sqrt(dot(d, d).hi);
    for (int k = 0; k < 2; k++) {
        lrcsi_dd square = dot(R[k], R[k]);
        double size = 0.5 * ((square.hi - 1) + square.lo);
        double along = dot(R[k], d).hi / length;
        double skew = k == 1 ? dot(R[0], R[1]).hi - dot(R[0], d).hi * dot(R[1], d).hi : 0;
        most = fmax(most, sqrt(size * size + along * along + skew * skew));
    }
    for (int k = 0; k < 3; k++) {
        most = fmax(most, fabs(R[2][k] - d[k] / length) - U);
    }
    return most;
}

static double uniform(uint64_t *state)
{
    return 2 * random_fraction(random_mmix(state)) - 1;
}

static void axes_are_within_four_roundings_of_a_rotation(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 20000; i++) {
        lrcs_pose pose;
        double d[3];
        double R[3][3];
        const double angle[3] = {400 * uniform(&random), 400 * uniform(&random),
                                 400 * uniform(&random)};
        const double q[4] = {uniform(&random), uniform(&random), uniform(&random),
                             uniform(&random)};
        assert_int_equal(i % 2 ? lrcs_pose_from_euler("xyz", angle, &pose)
                               : lrcs_pose_from_quaternion(q, &pose),
                         LRCS_OK);
        for (int k = 0; k < 9 && i % 3 == 0; k++) { /* an R that is not so good */
            pose.R[k / 3][k % 3] = (float)pose.R[k / 3][k % 3];
        }
        assert_int_equal(lrcsi_frame_make(&pose, d, R), LRCS_OK);
        assert_memory_equal(d, pose.direction, sizeof d);
        assert_true(frame_off(d, R) <= 4 * U);
    }
}

static void axes_that_are_exact_stay_so(void **state)
{
    (void)state;
    static const double angle[4] = {0, 90, 180, -90};
    for (int i = 0; i < 64; i++) {
        const double angles[3] = {angle[i & 3], angle[i >> 2 & 3], angle[i >> 4]};
        lrcs_pose pose;
        double d[3];
        double R[3][3];
        assert_int_equal(lrcs_pose_from_euler("XYZ", angles, &pose), LRCS_OK);
        assert_int_equal(lrcsi_frame_make(&pose, d, R), LRCS_OK);
        for (int k = 0; k < 9; k++) {
            check_same(R[k / 3][k % 3], pose.R[k / 3][k % 3]);
        }
    }
}

static void components_that_count_as_zero_are_zero(void **state)
{
    (void)state;
    lrcs_pose pose;
    double d[3];
    double R[3][3];
    const double direction[3] = {1e-300, 1, 0};
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_frame_make(&pose, d, R), LRCS_OK);
    check_same(d[0], 0);
    check_same(R[2][0], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_are_within_four_roundings_of_a_rotation),
        cmocka_unit_test(axes_that_are_exact_stay_so),
        cmocka_unit_test(components_that_count_as_zero_are_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
