/* SPDX-License-Identifier: MIT */
/* Placing points: what is exact, what the order of steps is, and how far rounding may go. */
#include "scene/build/place.h"

#include <string.h>

#include "base/rotate.h"
#include "base/vec3.h"
#include "check.h"
#include "random.h"

static const lrcs_joint no_joint = {0, {0}, {0}, 0.0};

static void the_default_place_keeps_every_bit(void **state)
{
    (void)state;
    const lrcs_place place = lrcs_place_default();
    const double given[3] = {-0.0, 1e-310, 0.1};
    const lrcs_joint still = {1, {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, 720.0};
    lrcsi_placer placer;
    double placed[3];
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    lrcsi_placer_run(&placer, given, placed);
    assert_memory_equal(placed, given, sizeof given);
    assert_int_equal(lrcsi_placer_make(&place, &still, &placer), LRCS_OK);
    lrcsi_placer_run(&placer, given, placed);
    assert_memory_equal(placed, given, sizeof given);
    check_same(lrcsi_placer_error(&placer, 1.0, 0.0), 0.0);
}

static void scaling_by_powers_of_two_is_exact(void **state)
{
    (void)state;
    lrcs_place place = lrcs_place_default();
    const double given[3] = {0.1, -1.0 / 3.0, 7e77};
    lrcsi_placer placer;
    double placed[3];
    place.scale[0] = place.scale[1] = place.scale[2] = 0x1p-20;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    lrcsi_placer_run(&placer, given, placed);
    for (int i = 0; i < 3; i++) {
        check_same(placed[i] * 0x1p20, given[i]);
    }
}

/* joint: a quarter turn about z through (1, 0, 0): (2, 0, 0) -> (1, 1, 0). scale (2, 3, 4):
   (2, 3, 0). rotate a quarter turn about x, (x, y, z) -> (x, -z, y): (2, 0, 3). translate. */
static void joint_then_scale_then_rotation_then_translation(void **state)
{
    (void)state;
    const lrcs_place place = {
        {10.0, 20.0, 30.0}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {2.0, 3.0, 4.0}};
    const lrcs_joint joint = {1, {0.0, 0.0, 5.0}, {1.0, 0.0, 0.0}, 90.0};
    const double given[3] = {2.0, 0.0, 0.0};
    lrcsi_placer placer;
    double placed[3];
    assert_int_equal(lrcsi_placer_make(&place, &joint, &placer), LRCS_OK);
    lrcsi_placer_run(&placer, given, placed);
    check_same(placed[0], 12.0);
    check_same(placed[1], 20.0);
    check_same(placed[2], 33.0);
    assert_int_equal(placer.reflects, 0);
}

static void an_odd_number_of_mirrors_flips(void **state)
{
    (void)state;
    for (int signs = 0; signs < 16; signs++) {
        lrcs_place place = lrcs_place_default();
        int odd = 0;
        for (int i = 0; i < 3; i++) {
            place.scale[i] = signs >> i & 1 ? -2.0 : 2.0;
            odd ^= signs >> i & 1;
        }
        if (signs & 8) { /* an improper rotation, from a caller of the library */
            place.rotate[0][0] = -1.0;
            odd ^= 1;
        }
        lrcsi_placer placer;
        assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
        assert_int_equal(placer.reflects, odd);
    }
}

/* Long double has 64 bits here or equals double: then the bound is only met more easily. */
static void rounding_stays_within_its_bound(void **state)
{
    (void)state;
    uint32_t seed = 7;
    for (int n = 0; n < 2000; n++) {
        double r[12];
        for (int i = 0; i < 12; i++) {
            seed = seed * 1664525u + 1013904223u;
            r[i] = (double)(seed >> 8) / 0x1p23 - 1.0;
        }
        lrcs_place place = {{100.0 * r[0], r[1], 1e-3 * r[2]},
                            {{0.6, -0.8, 0.0}, {0.64, 0.48, -0.6}, {0.48, 0.36, 0.8}},
                            {3.0 * r[3] + 4.0, 0.3, r[4] + 2.0}};
        const lrcs_joint joint = {1, {r[5], r[6], 1.0}, {r[7], r[8], 10.0}, 180.0 * r[11]};
        lrcsi_placer placer;
        const double given[3] = {r[9], r[10], r[11]};
        double placed[3];
        assert_int_equal(lrcsi_placer_make(&place, &joint, &placer), LRCS_OK);
        lrcsi_placer_run(&placer, given, placed);
        long double v[3] = {(long double)given[0], (long double)given[1], (long double)given[2]};
        long double w[3];
        for (int i = 0; i < 3; i++) {
            w[i] = (long double)joint.origin[i];
            for (int k = 0; k < 3; k++) {
                w[i] += (long double)placer.joint[i][k] * (v[k] - (long double)joint.origin[k]);
            }
            w[i] *= (long double)place.scale[i];
        }
        long double off = 0.0L;
        for (int i = 0; i < 3; i++) {
            long double x = (long double)place.translate[i];
            for (int k = 0; k < 3; k++) {
                x += (long double)place.rotate[i][k] * w[k];
            }
            off += (x - (long double)placed[i]) * (x - (long double)placed[i]);
        }
        check_most(sqrt((double)off), lrcsi_placer_error(&placer, 1.0, 0.0));
    }
}

static void unfit_places_are_refused(void **state)
{
    (void)state;
    const lrcs_place good = lrcs_place_default();
    lrcsi_placer placer;
    lrcs_place place = good;
    place.scale[1] = 0.0;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_E_ARGUMENT);
    place = good;
    place.translate[2] = (double)NAN;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_E_NUMBER);
    place = good;
    place.scale[0] = (double)INFINITY;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_E_NUMBER);
    place = good;
    place.rotate[2][2] = (double)NAN;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_E_NUMBER);
    place = good;
    memset(place.rotate, 0, sizeof place.rotate);
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_E_ARGUMENT);
    lrcs_joint joint = {1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1.0};
    assert_int_equal(lrcsi_placer_make(&good, &joint, &placer), LRCS_E_ARGUMENT);
    joint.axis[0] = 1.0;
    joint.angle_deg = (double)NAN;
    assert_int_equal(lrcsi_placer_make(&good, &joint, &placer), LRCS_E_NUMBER);
    joint.angle_deg = 1.0;
    joint.origin[1] = (double)INFINITY;
    assert_int_equal(lrcsi_placer_make(&good, &joint, &placer), LRCS_E_NUMBER);
}

/* Against long doubles: to 1e-18 where the matrix itself is off by 1e-16. */
static void axes_are_those_of_the_nearest_rotation(void **state)
{
    (void)state;
    need_wide_long_double();
    for (int run = 0; run < 200; run++) {
        lrcs_place place = lrcs_place_default();
        const double deg[3] = {37.3 * run, 11.1 * run, 50.7 * run};
        const lrcs_joint joint = {1, {1.0, run % 7, 0.5}, {0.1, 0.2, 0.3}, 3.7 * run};
        lrcsi_placer placer;
        lrcsi_axes axes;
        double placed[3];
        double origin[3];
        const double zero[3] = {0.0, 0.0, 0.0};
        assert_int_equal(lrcsi_rotate_euler("XYZ", deg, place.rotate), LRCS_OK);
        place.scale[1] = run % 2 ? -1.0 : 1.0;
        assert_int_equal(lrcsi_placer_make(&place, &joint, &placer), LRCS_OK);
        assert_int_equal(lrcsi_placer_axes(&placer, &axes), 1);
        lrcsi_placer_run(&placer, zero, origin);
        for (int i = 0; i < 3; i++) {
            const double along[3] = {i == 0, i == 1, i == 2};
            lrcsi_placer_run(&placer, along, placed);
            for (int k = 0; k < 3; k++) {
                check_abs(axes.high[i][k], placed[k] - origin[k], 4e-15);
            }
            for (int j = 0; j <= i; j++) {
                long double product = 0;
                for (int k = 0; k < 3; k++) {
                    product += ((long double)axes.high[i][k] + axes.low[i][k]) *
                               ((long double)axes.high[j][k] + axes.low[j][k]);
                }
                check_abs((double)(product - (i == j)), 0.0, 1e-18);
            }
        }
        assert_int_equal(axes.exact, 0);
    }
}

static void axes_of_quarter_turns_and_mirrors_are_exact(void **state)
{
    (void)state;
    for (int run = 0; run < 64; run++) {
        lrcs_place place = lrcs_place_default();
        const double deg[3] = {90.0 * (run % 4), 90.0 * (run / 4 % 4), 90.0 * (run / 16)};
        lrcsi_placer placer;
        lrcsi_axes axes;
        assert_int_equal(lrcsi_rotate_euler("zyx", deg, place.rotate), LRCS_OK);
        place.scale[0] = place.scale[1] = 0.3;
        place.scale[2] = -0.3;
        assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
        assert_int_equal(lrcsi_placer_axes(&placer, &axes), 1);
        assert_int_equal(axes.exact, 1);
    }
}

static void a_shape_that_is_changed_has_no_axes(void **state)
{
    (void)state;
    lrcs_place place = lrcs_place_default();
    lrcsi_placer placer;
    lrcsi_axes axes;
    double most;
    double ratio;
    place.scale[2] = -4.0;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    assert_int_equal(lrcsi_placer_axes(&placer, &axes), 0);
    lrcsi_placer_singular_values(&placer, &most, &ratio);
    check_rel(most, 4.0, 1e-5);
    check_rel(ratio, 4.0, 1e-5);
    place.scale[1] = -4.0; /* now the first differs */
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    assert_int_equal(lrcsi_placer_axes(&placer, &axes), 0);
    place = lrcs_place_default();
    place.rotate[0][1] = 0.1; /* singular values 1.0512, 1 and 0.9512 */
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    assert_int_equal(lrcsi_placer_axes(&placer, &axes), 0);
    lrcsi_placer_singular_values(&placer, &most, &ratio);
    assert_true(most >= 1.0512 && most < 1.1);
    assert_true(ratio >= 1.1051 && ratio < 1.2);
    place.rotate[0][1] = 2.0; /* far from any */
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    lrcsi_placer_singular_values(&placer, &most, &ratio);
    assert_true(isinf(ratio));
}

/* The image of a parallelogram's normal is normal to the parallelogram's image; its length, times
   the area factor, is the ratio of their areas. */
static void normals_and_areas_are_those_of_placed_parallelograms(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int run = 0; run < 64; run++) {
        lrcs_place place = lrcs_place_default();
        const lrcs_joint joint = {1, {1.0, 0.25 * (run % 7), 0.5}, {1, 2, 3}, 3.7 * run};
        const double deg[3] = {20.0 * run, 100.0, 7.0 * run};
        const double zero[3] = {0};
        double given[2][3];
        double placed[3][3]; /* the origin and the two sides */
        double image[3][3];
        double normal[3];
        double cross[3];
        double n[3] = {0};
        double area;
        double most = 0;
        lrcsi_placer placer;
        assert_int_equal(lrcsi_rotate_euler("XYZ", deg, place.rotate), LRCS_OK);
        for (int k = 0; k < 3; k++) {
            place.scale[k] = (random_unit(&seed) < 0.5 ? -3 : 2) * (0.1 + random_unit(&seed));
            most = fmax(most, fabs(place.scale[k]));
            given[0][k] = random_unit(&seed) - 0.5;
            given[1][k] = random_unit(&seed) - 0.5;
        }
        assert_int_equal(lrcsi_placer_make(&place, &joint, &placer), LRCS_OK);
        assert_int_equal(lrcsi_placer_normals(&placer, image, &area), 1);
        lrcsi_placer_run(&placer, zero, placed[0]);
        for (int i = 0; i < 2; i++) {
            lrcsi_placer_run(&placer, given[i], placed[i + 1]);
            lrcsi_vec3_between(placed[0], placed[i + 1], placed[i + 1]);
        }
        lrcsi_vec3_cross(given[0], given[1], normal);
        lrcsi_vec3_cross(placed[1], placed[2], cross);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                n[k] += normal[i] * image[i][k];
            }
        }
        double sign = placer.reflects ? -1 : 1; /* a reflection reverses the product of the sides */
        for (int k = 0; k < 3; k++) {
            check_abs(sign * cross[k], most * most * area * n[k], 1e-13 * most * most);
        }
    }
}

static void normals_of_flat_scales_are_refused(void **state)
{
    (void)state;
    lrcs_place place = lrcs_place_default();
    lrcsi_placer placer;
    double image[3][3];
    double area;
    place.scale[1] = 0x1p-21;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    assert_int_equal(lrcsi_placer_normals(&placer, image, &area), 0);
    place.scale[1] = 0x1p-20;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    assert_int_equal(lrcsi_placer_normals(&placer, image, &area), 1);
    assert_true(image[1][1] == 1 && image[0][0] == 0x1p-20 && area == 1);
    place.rotate[0][1] = 2.0;
    assert_int_equal(lrcsi_placer_make(&place, &no_joint, &placer), LRCS_OK);
    assert_int_equal(lrcsi_placer_normals(&placer, image, &area), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_default_place_keeps_every_bit),
        cmocka_unit_test(scaling_by_powers_of_two_is_exact),
        cmocka_unit_test(joint_then_scale_then_rotation_then_translation),
        cmocka_unit_test(an_odd_number_of_mirrors_flips),
        cmocka_unit_test(rounding_stays_within_its_bound),
        cmocka_unit_test(unfit_places_are_refused),
        cmocka_unit_test(axes_are_those_of_the_nearest_rotation),
        cmocka_unit_test(axes_of_quarter_turns_and_mirrors_are_exact),
        cmocka_unit_test(a_shape_that_is_changed_has_no_axes),
        cmocka_unit_test(normals_and_areas_are_those_of_placed_parallelograms),
        cmocka_unit_test(normals_of_flat_scales_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
