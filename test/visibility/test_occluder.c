/* SPDX-License-Identifier: MIT */
/* The region in which one facet hides another: the half-space cut by hand, and what hides nothing.
 */
#include "visibility/occluder.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;

/* What is left of facet 0, as a share of its projected area, once facet 1 has hidden its part; in
 *error, the rim's width over the target's diameter. */
static double share_left(const double direction[3], double *error)
{
    lrcs_pose pose;
    lrcsi_view view;
    lrcsi_target target;
    lrcsi_occluder occluder;
    lrcsi_clip_polygon whole;
    lrcsi_clip clip;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_clip_make(&work, &clip), LRCS_OK);
    lrcsi_target_make(&view, 0, &target);
    lrcsi_clip_triangle((const double(*)[2])target.corner, &whole);
    check_rel(lrcsi_clip_polygon_area(&whole), lrcsi_view_tilt(&view, 0).projected, 1e-14);
    *error = 0;
    if (!lrcsi_occluder_make(&target, 1, &occluder)) {
        return 1;
    }
    *error = occluder.error / target.diameter;
    lrcsi_clip_start(&clip, &whole);
    assert_true(lrcsi_clip_subtract(&clip, &occluder.region));
    return lrcsi_clip_area(&clip) / lrcsi_clip_polygon_area(&whole);
}

/* The target: (0,0,0) (4,0,0) (0,4,0), front up. */
static void start(const double a[3], const double b[3], const double c[3])
{
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                   (const double[3]){0, 4, 0});
    scene_triangle(&scene, a, b, c);
}

static const double up[3] = {0, 0, 1};

static void facet_in_front_hides_its_shadow(void **state)
{
    (void)state;
    double error;
    start((const double[3]){1, 1, 2}, (const double[3]){2, 1, 2}, (const double[3]){1, 2, 1});
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14);
    check_most(error, 1e-13);
    scene_invert(&scene, 1); /* from either side */
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14);
    /* From (-1, 0, 1) the shadow of a level facet at height 1 lies 1 further along x. */
    start((const double[3]){1, 0, 1}, (const double[3]){3, 0, 1}, (const double[3]){1, 2, 1});
    check_rel(share_left((const double[3]){-1, 0, 1}, &error), 6 / 8.0, 1e-14);
    check_rel(share_left((const double[3]){1, 0, 1}, &error), 6 / 8.0, 1e-14);
}

/* Corners at heights 1, 1 and -1: the side to the lower corner passes the plane half-way. */
static void piercing_facet_hides_only_what_its_upper_part_covers(void **state)
{
    (void)state;
    double error;
    start((const double[3]){0, 0, 1}, (const double[3]){2, 0, 1}, (const double[3]){0, 2, -1});
    check_rel(share_left(up, &error), 1 - 1.5 / 8, 1e-14); /* 2 less its upper half-sized tip */
    check_most(error, 1e-12);
    start((const double[3]){0, 0, -1}, (const double[3]){2, 0, -1}, (const double[3]){0, 2, 1});
    check_rel(share_left(up, &error), 1 - 0.5 / 8, 1e-14);
    start((const double[3]){0, 0, 1}, (const double[3]){2, 0, -1}, (const double[3]){0, 2, -3});
    check_rel(share_left(up, &error), 1 - 2 * 0.5 * 0.25 / 8, 1e-14); /* cut at 1/2 and 1/4 */
}

static void facets_behind_beside_or_in_contact_hide_nothing(void **state)
{
    (void)state;
    double error;
    static const double none[][3][3] = {
        {{1, 1, -1}, {2, 1, -2}, {1, 2, -1}}, /* behind */
        {{4, 0, 1}, {8, 0, 1}, {4, 4, 1}},    /* beside: touches a corner in projection */
        {{4, 0, 1}, {4, 4, 1}, {0, 4, 1}},    /* beyond the hypotenuse */
        {{1, 1, 0}, {2, 1, -1}, {1, 2, -1}},  /* behind, a corner on the plane */
        {{1, 1, 0}, {2, 1, 0}, {1, 2, -1}},   /* behind, a side on the plane */
        {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}},    /* in the plane, of higher index */
        {{0, 0, 0}, {0, 4, 0}, {-1, 0, 3}}};  /* a wall on the target's side, leaning out */
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        start(none[i][0], none[i][1], none[i][2]);
        check_same(share_left(up, &error), 1);
    }
    start((const double[3]){1, 1, 0}, (const double[3]){2, 1, 0}, (const double[3]){1, 2, 1});
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14); /* in front, a side on the plane */
}

static void front_skin_hides_a_back_in_its_plane(void **state)
{
    (void)state;
    double error;
    start((const double[3]){1, 1, 0}, (const double[3]){2, 1, 0}, (const double[3]){1, 2, 0});
    scene.facet[0] = (lrcs_facet){{0, 2, 1}}; /* the target now faces away */
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14);
    scene_invert(&scene, 1);
    check_same(share_left(up, &error), 1);
}

/* Planes that meet at 1e-9: the cut is where exact arithmetic puts it, and its slip is charged. */
static void shallow_cuts_own_up_to_their_slip(void **state)
{
    (void)state;
    for (int power = 1; power <= 50; power += 7) {
        double e = ldexp(1, -power);
        double error;
        start((const double[3]){0, 0, e}, (const double[3]){2, 0, e}, (const double[3]){0, 2, -e});
        double left = share_left(up, &error);
        check_abs(left, 1 - 1.5 / 8, 1e-13);
        check_most(fabs(left - (1 - 1.5 / 8)), 4 * error);
    }
}

/* Needles an ulp wide through the target's plane, many of which rounding turns over in the view:
   the sides of those open backwards, and what is cut out must not. */
static void needles_turned_over_by_rounding_hide_nothing(void **state)
{
    (void)state;
    uint64_t seed = 3;
    double worst = 0;
    for (int i = 0; i < 4000; i++) {
        double length = ldexp(1, -(int)scene_random(&seed, 30));
        double angle = 0.001 * scene_random(&seed, 6283);
        double error;
        const double a[3] = {0.7 + 0.0001 * i, 1.3 - 0.0001 * i, 0.3 * length};
        double b[3] = {a[0] + length * cos(angle), a[1] + length * sin(angle), -0.7 * length};
        double c[3] = {nextafter(b[0], 9), b[1], b[2]};
        const double from[3] = {0.3 + 0.00007 * i, -0.1, 1};
        start(a, b, c);
        double hidden = 1 - share_left(from, &error);
        worst = fmax(worst, hidden - 4 * error);
    }
    check_most(worst, 4e-16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facet_in_front_hides_its_shadow),
        cmocka_unit_test(piercing_facet_hides_only_what_its_upper_part_covers),
        cmocka_unit_test(facets_behind_beside_or_in_contact_hide_nothing),
        cmocka_unit_test(front_skin_hides_a_back_in_its_plane),
        cmocka_unit_test(shallow_cuts_own_up_to_their_slip),
        cmocka_unit_test(needles_turned_over_by_rounding_hide_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
