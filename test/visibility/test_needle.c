/* SPDX-License-Identifier: MIT */
/* The frame of a needle. Coordinates are such that shares are known exactly: a point is put
   together from the sides with dyadic shares, and moved along the direction, without rounding. */
#include "visibility/cells/target.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_needle needle;

/* The facet (0,0,0) (1/4,0,1/2) (1/2,0,0), in the plane y = 0, seen from (1, 2^-thin, 1/2). Is it a
   needle? The scene is no larger than 1 in all, and so not scaled. */
static int is_needle(int thin)
{
    lrcs_pose pose;
    const double from[3] = {1, ldexp(1, -thin), 0.5};
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){0.25, 0, 0.5},
                   (const double[3]){0.5, 0, 0});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(from, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    lrcsi_target target;
    lrcsi_target_make(&view, 0, &target);
    const double *const point[3] = {lrcsi_target_frame_corner(&view, 0, 0),
                                    lrcsi_target_frame_corner(&view, 0, 1),
                                    lrcsi_target_frame_corner(&view, 0, 2)};
    return lrcsi_needle_make(&view, point, (const double(*)[2])target.corner, target.reach,
                             &needle);
}

/* The point of shares (u, v), moved by s of the direction. */
static void point_of(double u, double v, double s, double x[3])
{
    const double *o = lrcsi_target_corner(&view, 0, 0);
    const double *p = lrcsi_target_corner(&view, 0, 1);
    const double *q = lrcsi_target_corner(&view, 0, 2);
    for (int k = 0; k < 3; k++) {
        x[k] = o[k] + u * (p[k] - o[k]) + v * (q[k] - o[k]) + s * view.direction[k];
    }
}

static void only_what_double_double_tells_is_a_needle(void **state)
{
    (void)state;
    assert_int_equal(is_needle(4), 0);
    assert_int_equal(is_needle(24), 1);
    assert_int_equal(is_needle(70), 1);
    assert_int_equal(is_needle(90), 0);
}

static void shares_are_exact_however_thin(void **state)
{
    (void)state;
    static const double share[][3] = {{0, 0, 0},        {1, 0, 0.5},     {0, 1, -0.25},
                                      {0.25, 0.5, 0.5}, {-0.5, 0.75, 1}, {1.5, -0.125, 0}};
    for (int thin = 24; thin <= 70; thin += 2) {
        assert_int_equal(is_needle(thin), 1);
        for (size_t n = 0; n < sizeof share / sizeof *share; n++) {
            double x[3];
            lrcsi_dd at[2];
            point_of(share[n][0], share[n][1], share[n][2], x);
            double off = lrcsi_needle_coordinates(&needle, x, at);
            for (int i = 0; i < 2; i++) {
                check_abs(lrcsi_dd_value(at[i]), share[n][i], off + 2e-16);
            }
            check_most(off, ldexp(1, thin - 96));
        }
    }
}

/* Along v = 1/4, from far on one side to far on the other; and one that passes by. */
static void segments_are_clipped_to_what_is_near(void **state)
{
    (void)state;
    double from[3];
    double to[3];
    double end[2][2];
    assert_int_equal(is_needle(50), 1);
    point_of(-1, 0.25, 0, from);
    point_of(-1, 0.25, 1, to);
    to[1] = 0.125; /* off the plane by 2^47 of its width */
    double off = lrcsi_needle_segment(&needle, from, to, end);
    check_abs(end[0][0], -1, 1e-15 + off);
    check_abs(end[0][1], 0.25, 1e-15 + off);
    for (int i = 0; i < 2; i++) {
        assert_true(end[1][i] >= -1 - off && end[1][i] <= 2 + off);
    }
    point_of(3, 0, 0, from);
    point_of(3, 1, 0, to);
    lrcsi_needle_segment(&needle, from, to, end);
    for (int i = 0; i < 4; i++) {
        check_same(end[i / 2][i % 2], 2);
    }
}

/* A line through (1/4, 1/4) along u: on it nothing is sure; 2^-40 of the width beside it all is. */
/* The square from -1 to 2, and segments past its corners: each coordinate is within it somewhere,
   but not both at once. What touches a corner does not miss it. */
static void segments_past_a_corner_are_not_near(void **state)
{
    (void)state;
    for (int i = 0; i < 16; i++) {
        int touches = i / 8;
        double far = touches ? 4 : 4 + 0x1p-60 * (1 << 3 * (i % 4)) * 1024;
        lrcsi_dd from[2] = {{far, 0}, {0, 0}};
        lrcsi_dd to[2] = {{0, 0}, {far, 0}};
        double end[2][2];
        lrcsi_dd part[2];
        if (i % 8 / 4) { /* the other way round */
            lrcsi_dd swap = from[0];
            from[0] = from[1];
            from[1] = swap;
            swap = to[0];
            to[0] = to[1];
            to[1] = swap;
        }
        if (!touches) {
            from[i % 8 / 4].lo = 0x1p-70; /* less than half a unit in the last place of 4 */
        }
        lrcsi_needle_clip(from, to, end, part);
        for (int k = 0; k < 4; k++) {
            check_same(end[k / 2][k % 2], 2);
        }
        double length = lrcsi_dd_value(lrcsi_dd_sub(part[1], part[0]));
        assert_true(touches ? length == 0 : length < 0);
    }
}

static void sides_are_decided_within_the_width_of_a_needle(void **state)
{
    (void)state;
    double from[3];
    double to[3];
    for (int thin = 24; thin <= 48; thin += 4) {
        assert_int_equal(is_needle(thin), 1);
        point_of(0, 0.25, 0.25, from);
        point_of(0.5, 0.25, -0.5, to);
        const double on[2] = {0.25, 0.25};
        const double left[2] = {0.25, 0.25 + 0x1p-40};
        const double right[2] = {0.25, 0.25 - 0x1p-40};
        check_same(lrcsi_needle_side(&needle, from, to, on, 0), 0);
        assert_true(lrcsi_needle_side(&needle, from, to, left, 0) > 0);
        assert_true(lrcsi_needle_side(&needle, from, to, right, 0) < 0);
    }
}

/* A line that passes (1/4, 1/4): at all places but those nearly on it the plain line has the sign
   of the side in double-double. */
static void lines_have_the_sign_of_the_side(void **state)
{
    (void)state;
    double from[3];
    double to[3];
    double line[3];
    for (int thin = 24; thin <= 70; thin += 2) {
        uint32_t sure = 0;
        assert_int_equal(is_needle(thin), 1);
        point_of(-0.75, 0.125, 0.25, from);
        point_of(1.25, 0.375, -0.5, to);
        double clear = lrcsi_needle_line(&needle, from, to, line);
        for (int k = -60; k <= 60; k++) {
            const double at[2] = {0.25, 0.25 + (k < 0 ? -1 : 1) * ldexp(1, k < 0 ? k : -k)};
            double value = line[0] * at[0] + line[1] * at[1] + line[2];
            assert_true(!(fabs(value) > clear) || value * (at[1] - 0.25) > 0);
            sure += fabs(value) > clear;
        }
        assert_true(sure >= (thin <= 48 ? 80 : 40));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_double_double_tells_is_a_needle),
        cmocka_unit_test(shares_are_exact_however_thin),
        cmocka_unit_test(segments_are_clipped_to_what_is_near),
        cmocka_unit_test(segments_past_a_corner_are_not_near),
        cmocka_unit_test(sides_are_decided_within_the_width_of_a_needle),
        cmocka_unit_test(lines_have_the_sign_of_the_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
