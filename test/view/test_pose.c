/* SPDX-License-Identifier: MIT */
/* Poses against 50-digit rotations (test/vectors/pose.py), their exact cases, and what is
   refused. */
#include <lrcs/pose.h>

#include <float.h>
#include <string.h>

#include "base/rotate.h"
#include "check.h"

typedef struct euler_row {
    const char *sequence;
    double deg[3];
    double R[9];
} euler_row;

typedef struct axis_row {
    double axis[3], deg;
    double R[9];
} axis_row;

typedef struct quaternion_row {
    double q[4];
    double R[9];
} quaternion_row;

typedef struct direction_row {
    double direction[3];
    double R[9];
} direction_row;

typedef struct azel_row {
    double az, el;
    double R[9];
} azel_row;

#include "vectors/pose.inc"

#define ROWS(table) (sizeof table / sizeof table[0])
/* What base/rotate.h claims, 8 u. */
#define ENTRY_MOST (8 * 0x1p-53)

static void check_matrix(double got[3][3], const double want[9])
{
    for (int i = 0; i < 9; i++) {
        check_abs(got[i / 3][i % 3], want[i], ENTRY_MOST);
    }
}

static void check_identity(double got[3][3])
{
    for (int i = 0; i < 9; i++) {
        check_same(got[i / 3][i % 3], i % 4 == 0 ? 1.0 : 0.0);
    }
}

/* The direction's form, and that it is the third row. */
static void check_direction(const lrcs_pose *pose)
{
    const double *d = pose->direction;
    double largest = fmax(fabs(d[0]), fmax(fabs(d[1]), fabs(d[2])));
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    assert_true(largest >= 0.5 && largest <= 1.0);
    for (int i = 0; i < 3; i++) {
        check_abs(d[i] / length, pose->R[2][i], ENTRY_MOST);
        assert_false(signbit(d[i]) && d[i] == 0.0);
    }
}

static void check_orthonormal(const lrcs_pose *pose)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double dot = 0.0;
            for (int k = 0; k < 3; k++) {
                dot += pose->R[i][k] * pose->R[j][k];
            }
            check_abs(dot, i == j ? 1.0 : 0.0, 3 * ENTRY_MOST);
        }
    }
}

static void euler_angles_agree_with_products_at_50_digits(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(euler_rows); i++) {
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_euler(euler_rows[i].sequence, euler_rows[i].deg, &pose),
                         LRCS_OK);
        check_matrix(pose.R, euler_rows[i].R);
        check_direction(&pose);
    }
}

static void axis_and_angle_agree_with_rodrigues_at_50_digits(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(axis_rows); i++) {
        double R[3][3];
        assert_int_equal(lrcsi_rotate_axis(axis_rows[i].axis, axis_rows[i].deg, R), LRCS_OK);
        check_matrix(R, axis_rows[i].R);
    }
}

static void quaternions_of_any_length_agree_at_50_digits(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(quaternion_rows); i++) {
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_quaternion(quaternion_rows[i].q, &pose), LRCS_OK);
        check_matrix(pose.R, quaternion_rows[i].R);
        check_direction(&pose);
    }
}

static void directions_take_the_shortest_arc_even_beside_minus_z(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(direction_rows); i++) {
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_direction(direction_rows[i].direction, &pose), LRCS_OK);
        check_matrix(pose.R, direction_rows[i].R);
        check_direction(&pose);
    }
}

static void azimuth_and_elevation_agree_at_50_digits(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(azel_rows); i++) {
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_azel(azel_rows[i].az, azel_rows[i].el, &pose), LRCS_OK);
        check_matrix(pose.R, azel_rows[i].R);
        check_direction(&pose);
    }
}

static void the_default_is_the_initial_attitude(void **state)
{
    (void)state;
    lrcs_pose pose = lrcs_pose_default();
    const double z[3] = {0.0, 0.0, 1.0};
    check_identity(pose.R);
    assert_memory_equal(pose.direction, z, sizeof z);
}

static void elevation_90_is_exactly_plus_z(void **state)
{
    (void)state;
    static const double az[] = {0.0, 37.0, -180.0, 1e300};
    const double z[3] = {0.0, 0.0, 1.0};
    for (size_t i = 0; i < ROWS(az); i++) {
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_azel(az[i], 90.0, &pose), LRCS_OK);
        assert_memory_equal(pose.direction, z, sizeof z);
        check_identity(pose.R);
        assert_int_equal(lrcs_pose_from_azel(az[i], 450.0, &pose), LRCS_OK);
        assert_memory_equal(pose.direction, z, sizeof z);
    }
}

static void minus_z_is_half_a_turn_about_x(void **state)
{
    (void)state;
    static const double want[9] = {1, 0, 0, 0, -1, 0, 0, 0, -1};
    const double down[3] = {0.0, -0.0, -7.0};
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(down, &pose), LRCS_OK);
    assert_memory_equal(pose.R, want, sizeof want);
    assert_int_equal(lrcs_pose_from_azel(12.0, -90.0, &pose), LRCS_OK);
    assert_memory_equal(pose.R, want, sizeof want);
}

static void right_angles_are_exact(void **state)
{
    (void)state;
    static const double about_x[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0};
    static const double both[9] = {0, -1, 0, 0, 0, -1, 1, 0, 0};
    const double ninety[3] = {90.0, 0.0, 0.0};
    const double two[3] = {90.0, 0.0, 90.0};
    const double x[3] = {1.0, 0.0, 0.0};
    lrcs_pose pose;
    double R[3][3];
    assert_int_equal(lrcs_pose_from_euler("XYZ", ninety, &pose), LRCS_OK);
    assert_memory_equal(pose.R, about_x, sizeof about_x);
    assert_int_equal(lrcsi_rotate_axis(x, 90.0, R), LRCS_OK);
    assert_memory_equal(R, about_x, sizeof about_x);
    assert_int_equal(lrcs_pose_from_euler("XYZ", two, &pose), LRCS_OK);
    assert_memory_equal(pose.R, both, sizeof both);
    const double half_turn[4] = {0.0, 3.0, 0.0, 0.0};
    assert_int_equal(lrcs_pose_from_quaternion(half_turn, &pose), LRCS_OK);
    check_same(pose.R[1][1], -1.0);
    check_same(pose.R[2][2], -1.0);
}

static void directions_are_scaled_by_powers_of_two_only(void **state)
{
    (void)state;
    static const double length[] = {1.0, 0x1p-1000, 0x1p900, 0x1p-1, 0x1p3};
    for (size_t i = 0; i < ROWS(length); i++) {
        const double d[3] = {0.3 * length[i], -0.7 * length[i], 0.1 * length[i]};
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
        check_same(pose.direction[0], 0.3);
        check_same(pose.direction[1], -0.7);
        check_same(pose.direction[2], 0.1);
    }
    const double far[3] = {DBL_MAX, DBL_TRUE_MIN, -DBL_MAX};
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(far, &pose), LRCS_OK);
    check_same(pose.direction[0], -pose.direction[2]);
    check_orthonormal(&pose);
}

static void matrices_stay_orthonormal_all_round_the_sphere(void **state)
{
    (void)state;
    for (int el = -90; el <= 90; el += 3) {
        for (int az = 0; az < 360; az += 7) {
            lrcs_pose pose;
            assert_int_equal(lrcs_pose_from_azel(az, el, &pose), LRCS_OK);
            check_orthonormal(&pose);
            check_direction(&pose);
        }
    }
    for (double incidence = 1.0; incidence > 1e-300; incidence /= 1024.0) {
        const double d[3] = {incidence, -0.6 * incidence, -1.0};
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
        check_orthonormal(&pose);
    }
}

static void unfit_input_is_refused_and_the_pose_untouched(void **state)
{
    (void)state;
    static const char *const sequence[] = {"",    "X",   "XY",  "XYZX", "XXY", "XYY",
                                           "XyZ", "xYz", "ABC", "XY ",  "zzx", "XYZ "};
    const double angles[3] = {1.0, 2.0, 3.0};
    const double broken[4] = {0.0, (double)NAN, 1.0, 2.0};
    const double endless[4] = {(double)INFINITY, 0.0, 1.0, 2.0};
    const double zero[4] = {0.0, -0.0, 0.0, 0.0};
    lrcs_pose pose;
    lrcs_pose before;
    memset(&pose, 0x5a, sizeof pose);
    before = pose;
    for (size_t i = 0; i < ROWS(sequence); i++) {
        assert_int_equal(lrcs_pose_from_euler(sequence[i], angles, &pose), LRCS_E_NAME);
    }
    for (int k = 0; k < 3; k++) { /* the broken one in each place */
        const double *from = &broken[1];
        const double turned[3] = {from[(3 - k) % 3], from[(4 - k) % 3], from[(5 - k) % 3]};
        assert_int_equal(lrcs_pose_from_euler("XYZ", turned, &pose), LRCS_E_NUMBER);
    }
    assert_int_equal(lrcs_pose_from_direction(broken, &pose), LRCS_E_NUMBER);
    assert_int_equal(lrcs_pose_from_direction(endless, &pose), LRCS_E_NUMBER);
    assert_int_equal(lrcs_pose_from_direction(zero, &pose), LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_pose_from_quaternion(broken, &pose), LRCS_E_NUMBER);
    assert_int_equal(lrcs_pose_from_quaternion(endless, &pose), LRCS_E_NUMBER);
    assert_int_equal(lrcs_pose_from_quaternion(zero, &pose), LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_pose_from_azel((double)NAN, 0.0, &pose), LRCS_E_NUMBER);
    assert_int_equal(lrcs_pose_from_azel(0.0, -(double)INFINITY, &pose), LRCS_E_NUMBER);
    assert_memory_equal(&pose, &before, sizeof pose);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(euler_angles_agree_with_products_at_50_digits),
        cmocka_unit_test(axis_and_angle_agree_with_rodrigues_at_50_digits),
        cmocka_unit_test(quaternions_of_any_length_agree_at_50_digits),
        cmocka_unit_test(directions_take_the_shortest_arc_even_beside_minus_z),
        cmocka_unit_test(azimuth_and_elevation_agree_at_50_digits),
        cmocka_unit_test(the_default_is_the_initial_attitude),
        cmocka_unit_test(elevation_90_is_exactly_plus_z),
        cmocka_unit_test(minus_z_is_half_a_turn_about_x),
        cmocka_unit_test(right_angles_are_exact),
        cmocka_unit_test(directions_are_scaled_by_powers_of_two_only),
        cmocka_unit_test(matrices_stay_orthonormal_all_round_the_sphere),
        cmocka_unit_test(unfit_input_is_refused_and_the_pose_untouched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
