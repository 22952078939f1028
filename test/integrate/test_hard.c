/* SPDX-License-Identifier: MIT */
/* Hard cases, one a test, named by what is hard about it. References: test/vectors/hard.py at 50
   digits, hand arithmetic, exact symmetry. A mesh of 10^7 facets is in test_large.c. */
#include "scenes.h"

static test_scene scene;
static const int methods[] = {LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT,
                              LRCS_METHOD_AUTO};

static const struct reference {
    const char *name;
    double sigma;
} references[] = {
#include "../vectors/hard.inc"
};

static double reference(const char *name)
{
    for (size_t i = 0; i < sizeof references / sizeof *references; i++) {
        if (strcmp(references[i].name, name) == 0) {
            return references[i].sigma;
        }
    }
    fprintf(stderr, "hard.inc has no '%s'\n", name);
    fail();
    return 0;
}

static void unit_plate(double z)
{
    const double corner[3] = {0, 0, z};
    const double u[3] = {1, 0, 0};
    const double v[3] = {0, 1, 0};
    scene_plate(&scene, corner, u, v);
}

/* --- incidence and material ------------------------------------------------------------------- */

static const double tangents[] = {1e-9, 1e-3, 1, 57, 1e6, 1e12, 1e60};
static const double slopes[] = {1e-6, 1e-3, 0.2, 1, 1e3};
static const double powers[] = {0, 0.5, 1e3, 1e4};

/* A unit plate against 50 digits; its bound is no larger than it must be, but for underflow. */
static void check_plate(double tangent, double slope, double power)
{
    char name[64];
    snprintf(name, sizeof name, "plate %g %g %g", tangent, slope, power);
    double want = reference(name);
    scene_start(&scene);
    scene_material(&scene, 1, 0.25, slope, power);
    unit_plate(0);
    for (int k = 0; k < 4; k++) {
        lrcs_result r = scene_run(&scene, (const double[3]){tangent, 0, 1}, methods[k], 16);
        check_abs(r.sigma_m2, want, r.bound_m2 + 0x1p-53 * want + 0x1p-1074);
        if (k > 0) { /* facet's bound has all that could be hidden */
            check_most(r.bound_m2, 1e-10 * want + 0x1p-900);
        }
    }
}

static void theta_to_90_deg_keeps_its_digits(void **state)
{
    (void)state;
    for (int t = 0; t < 7; t++) {
        check_plate(tangents[t], 0.2, 0.5);
    }
}

static void s_from_1e_minus_6_to_1e3_keeps_its_digits(void **state)
{
    (void)state;
    for (int s = 0; s < 5; s++) {
        for (int t = 0; t < 7; t++) {
            check_plate(tangents[t], slopes[s], 0.5);
        }
    }
}

static void m_from_0_to_1e4_keeps_its_digits(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m++) {
        for (int s = 0; s < 5; s++) {
            for (int t = 0; t < 7; t++) {
                check_plate(tangents[t], slopes[s], powers[m]);
            }
        }
    }
}

static void glint_that_underflows_leaves_the_diffuse_part(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_material(&scene, 1, 0.25, 1e-3, 0.5);
    unit_plate(0);
    const double d[3] = {1.7320508075688772, 0, 1}; /* exp(-3e6) */
    const lrcs_brdf diffuse = {0, 0.25, 0, 0.5};
    for (int k = 1; k < 4; k++) {
        lrcs_result r = scene_run(&scene, d, methods[k], 16);
        check_same(r.sigma_glint_m2, 0);
        check_rel(r.sigma_m2, (double)scene_eq2(&diffuse, 1, 0.25L), 1e-15);
        check_most(r.bound_m2, 1e-14 * r.sigma_m2);
    }
}

/* --- cones ------------------------------------------------------------------------------------ */

/* At aspect 0, its half-angle, 90 deg, beyond its tangent, 180 deg; base and wall. */
static void check_cone(double half_angle)
{
    const double aspect[] = {0, half_angle, 90, 180 - half_angle, 180};
    static const char *const from[] = {"nose", "side", "broad", "tangent", "base"};
    const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = half_angle};
    const lrcs_brdf brdf = lrcs_brdf_default();
    for (int i = 0; i < 5; i++) {
        char name[64];
        lrcs_closed_form c;
        const lrcs_aspect at = {.deg = aspect[i]};
        snprintf(name, sizeof name, "cone %.9g %s", half_angle, from[i]);
        double want = reference(name);
        assert_int_equal(lrcs_closed_eval(&cone, &brdf, &at, &c), LRCS_OK);
        check_abs(c.sigma_m2, want, c.bound_m2 + 0x1p-53 * want);
        check_most(c.bound_m2, 1e-13 * want);
    }
}

static void cone_half_angle_to_0_keeps_its_digits(void **state)
{
    (void)state;
    check_cone(1e-4);
    check_cone(1e-9);
}

static void cone_half_angle_to_90_deg_keeps_its_digits(void **state)
{
    (void)state;
    check_cone(89.9999);
    check_cone(89.9999999);
}

/* The wall is dark from its tangent on, and a facet mesh of it is so exactly. */
static void aspect_0_tangent_to_the_cone_and_180_agree(void **state)
{
    (void)state;
    const lrcs_brdf brdf = lrcs_brdf_default();
    const lrcs_shape wall = {
        .kind = LRCS_SHAPE_CONE, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 45};
    check_cone(45);
    for (double deg = 135; deg <= 180; deg += 22.5) {
        lrcs_closed_form c;
        const lrcs_aspect at = {.deg = deg};
        assert_int_equal(lrcs_closed_eval(&wall, &brdf, &at, &c), LRCS_OK);
        check_same(c.sigma_m2, 0);
        check_same(c.bound_m2, 0);
    }
    enum { SIDES = 16 };
    scene_start(&scene);
    uint32_t apex = scene_vertex(&scene, 0, 0, 1);
    for (int i = 0; i < SIDES; i++) {
        double a = 2 * (double)SCENE_PI * i / SIDES;
        scene_vertex(&scene, cos(a), sin(a), 0);
    }
    for (uint32_t i = 0; i < SIDES; i++) {
        scene_facet(&scene, apex, apex + 1 + i, apex + 1 + (i + 1) % SIDES);
    }
    for (int k = 1; k < 4; k++) { /* from below all is back side, from +z all is seen */
        lrcs_result r = scene_run(&scene, (const double[3]){0, 0, -1}, methods[k], 32);
        check_same(r.sigma_m2, 0);
        check_same(r.bound_m2, 0);
        r = scene_run(&scene, (const double[3]){0, 0, 1}, methods[k], 32);
        check_rel(r.projected_area_m2, 0.5 * SIDES * sin(2 * (double)SCENE_PI / SIDES), 1e-13);
        assert_int_equal(r.facets_front, SIDES);
    }
}

/* --- odd facets ------------------------------------------------------------------------------- */

/* A unit square fanned from a point 1e-8 off its edge: two slivers of that height. */
static void slivers_of_aspect_1e8_count_for_what_they_are(void **state)
{
    (void)state;
    const double e = 0x1p-27;
    const double d[3] = {1, 2, 4};
    scene_start(&scene);
    uint32_t a = scene_vertex(&scene, 0, 0, 0);
    uint32_t b = scene_vertex(&scene, 1, 0, 0);
    uint32_t c = scene_vertex(&scene, 1, 1, 0);
    uint32_t f = scene_vertex(&scene, 0, 1, 0);
    uint32_t m = scene_vertex(&scene, 0.5, e, 0);
    scene_facet(&scene, a, b, m);
    scene_facet(&scene, b, c, m);
    scene_facet(&scene, c, f, m);
    scene_facet(&scene, f, a, m);
    double want = (double)scene_eq2(&scene.material[0].brdf, 1, 16 / 21.0L);
    for (int k = 1; k < 4; k++) {
        lrcs_result r = scene_run(&scene, d, methods[k], 64);
        check_bound(r, want);
        check_most(r.bound_m2, 1e-13 * want);
        check_rel(scene.record[0].area_m2, 0.5 * e, 1e-15);
        check_rel(scene.record[0].visible_area_m2, 0.5 * e * 4 / sqrt(21), 1e-14);
        check_rel(r.projected_area_m2, 4 / sqrt(21), 1e-14);
    }
}

static void zero_area_facets_change_nothing(void **state)
{
    (void)state;
    const double d[3] = {1, 2, 4};
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    lrcs_result without[4];
    for (int k = 0; k < 4; k++) {
        without[k] = scene_run(&scene, d, methods[k], 64);
    }
    uint32_t first = scene.scene.facet_count;
    scene_facet(&scene, 0, 0, 0);
    scene_facet(&scene, 0, 7, 7);
    uint32_t middle = scene_vertex(&scene, 0.5, 0.5, 1); /* on the top's diagonal */
    scene_facet(&scene, 4, middle, 7);
    scene_facet(&scene, 7, middle, 4);
    uint32_t far = scene_vertex(&scene, 0.25, 0.5, 0.75); /* in front of the near faces */
    scene_vertex(&scene, 1.25, 2.5, 3.75);
    scene_vertex(&scene, 2.25, 4.5, 6.75);
    scene_facet(&scene, far, far + 1, far + 2);
    for (int k = 0; k < 4; k++) {
        lrcs_result r = scene_run(&scene, d, methods[k], 64);
        check_same(r.sigma_m2, without[k].sigma_m2);
        check_rel(r.projected_area_m2, 7 / sqrt(21), 1e-14);
        check_abs(r.bound_m2, without[k].bound_m2, 1e-14 * r.sigma_m2);
        check_same(scene_seen(&scene, first, 5), 0);
        for (uint32_t f = first; f < first + 5; f++) {
            check_same(scene.record[f].area_m2, 0);
            check_same(scene.record[f].sigma_m2, 0);
        }
    }
}

/* Two skins in one plane: a front beats a back, then the lower index. */
static void duplicate_facets_count_once(void **state)
{
    (void)state;
    const double d[3] = {0.25, 0.5, 1};
    for (int flipped = 0; flipped < 2; flipped++) {
        scene_start(&scene);
        unit_plate(0);
        scene_material(&scene, 0.5, 0.125, 0.3, 2);
        unit_plate(0);
        if (flipped) { /* the first skin now faces away */
            scene.facet[0] = (lrcs_facet){{0, 2, 1}};
            scene.facet[1] = (lrcs_facet){{0, 3, 2}};
        }
        double want = (double)scene_eq2(&scene.material[flipped].brdf, 1, 16.0L / 21);
        for (int k = 1; k < 4; k++) {
            lrcs_result r = scene_run(&scene, d, methods[k], 64);
            check_bound(r, want);
            check_rel(r.projected_area_m2, 4 / sqrt(21), 1e-13);
            check_same(scene_seen(&scene, flipped ? 0 : 2, 2), 0);
            if (r.method == LRCS_METHOD_EXACT) {
                check_most(r.bound_m2, 1e-12 * want);
            }
        }
    }
}

/* Different cuts of one plane: the second square overlaps a quarter of the first. */
static void coplanar_coincident_facets_show_their_union(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 0, 0},
                (const double[3]){0, 2, 0});
    scene_material(&scene, 0, 1, 0.2, 0);
    scene_plate(&scene, (const double[3]){1, 1, 0}, (const double[3]){2, 0, 0},
                (const double[3]){0, 2, 0});
    double want = (double)(scene_eq2(&scene.material[0].brdf, 4, 1) +
                           scene_eq2(&scene.material[1].brdf, 3, 1));
    lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_EXACT, 0);
    check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
    check_rel(r.projected_area_m2, 7.0, 1e-13);
    check_rel(scene_seen(&scene, 0, 2), 4.0, 1e-13);
    r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_ZBUFFER, 100);
    check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
}

/* Splitting one side of an edge only: a T-junction. */
static void t_junctions_leave_no_crack(void **state)
{
    (void)state;
    static const double direction[][3] = {{0, 0, 1},      {1, 0, 0},       {1, 1, 1},
                                          {0.3, -0.5, 1}, {-2, 0.125, -1}, {0.5, 3, 0.01}};
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){3, 2, 1});
    uint32_t m = scene_vertex(&scene, 1.5, 1, 1); /* on the diagonal of the top */
    lrcs_facet old = scene.facet[10];             /* 4 5 7, the diagonal from 7 to 4 */
    scene.facet[10] = (lrcs_facet){{old.corner[0], old.corner[1], m}};
    scene_facet(&scene, old.corner[1], old.corner[2], m);
    for (int i = 0; i < 6; i++) {
        const double *d = direction[i];
        double silhouette = (2 * fabs(d[0]) + 3 * fabs(d[1]) + 6 * fabs(d[2])) /
                            sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 1; k < 4; k++) {
            lrcs_result r = scene_run(&scene, d, methods[k], 128);
            check_rel(r.projected_area_m2, silhouette, 1e-13);
            check_most(r.back_side_area_m2, 1e-14);
        }
    }
}

static void directions_in_a_facets_plane_are_exactly_edge_on(void **state)
{
    (void)state;
    static const double corner[3] = {0.3, -0.7, 0.2};
    static const double u[3] = {1, 2, 3};
    static const double v[3] = {-2, 1, 0.5};
    static const double in_plane[3][3] = {{1, 2, 3}, {-2, 1, 0.5}, {-1, 3, 3.5}};
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0.25, -0.75, 0.5}, u, v);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            lrcs_result r = scene_run(&scene, in_plane[i], methods[k], 64);
            check_same(r.sigma_m2, 0);
            check_same(r.bound_m2, 0);
            assert_int_equal(r.facets_front, 0);
        }
    }
    scene_start(&scene); /* rounded corners: the plate is not quite in its plane any more */
    scene_plate(&scene, corner, u, v);
    for (int i = 0; i < 3; i++) {
        lrcs_result r = scene_run(&scene, in_plane[i], LRCS_METHOD_EXACT, 0);
        check_most(r.sigma_m2, 1e-25);
    }
}

/* --- what hides what -------------------------------------------------------------------------- */

/* Plates z = x and z = -x over |x| <= 1 cross on the y axis; seen from (1, 0, 2), of z = x the half
   x > 0 is seen. Of z = -x all of x < 0, and beyond the shadow of the other, in u = 2 x - z, what
   lies in 1 .. 3 out of 0 .. 3. */
static void interpenetrating_plates_hide_part_of_each_other(void **state)
{
    (void)state;
    const double d[3] = {1, 0, 2};
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){-1, 0, -1}, (const double[3]){2, 0, 2},
                (const double[3]){0, 1, 0});
    scene_plate(&scene, (const double[3]){-1, 0, 1}, (const double[3]){2, 0, -2},
                (const double[3]){0, 1, 0});
    double first = 2 / sqrt(5); /* projected areas: |d . (-2, 0, 2)| and |d . (2, 0, 2)| over |d| */
    double second = 6 / sqrt(5);
    lrcs_result r = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
    check_rel(scene_seen(&scene, 0, 2), first / 2, 1e-13);
    check_rel(scene_seen(&scene, 2, 2), second * 5 / 6, 1e-13);
    const lrcs_brdf *b = &scene.material[0].brdf;
    double size = 2 * sqrt(2);
    double want =
        (double)(scene_eq2(b, size / 2, 1 / 10.0L) + scene_eq2(b, size * 5 / 6, 9 / 10.0L));
    check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
    for (uint32_t n = 16; n <= 512; n = 2 * n + 1) {
        r = scene_run(&scene, d, LRCS_METHOD_ZBUFFER, n);
        check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
    }
}

/* A needle whose edge on x = -7 passes a corner of another facet by 1.4e-5, and which falls away so
   steeply that the other passes through it within 7e-12 of that corner, in a segment whose ends are
   one and the same to 1e-17 of the needle. It hides what lies between y = u / 2 and 25/21 u over
   the corner, u = x + 7, as far as the needle's third side. */
static void needle_pierced_beside_a_corner_is_hidden_as_by_hand(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){-7, -2e6, 7}, (const double[3]){-6, 3, -2e6},
                   (const double[3]){-7, -5, -7});
    scene_triangle(&scene, (const double[3]){-2e-12, 4 / 3.0, 3}, (const double[3]){-3, -5, -7},
                   (const double[3]){-7, -7, -7});
    long double low = 1999993 / (2000003 - 0.5L);
    long double high = 1999993 / (2000003 - 25 / 21.0L);
    long double seen = 999997.5L - 0.5L * low * high * (25 / 21.0L - 0.5L);
    scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_EXACT, 0);
    check_abs(scene_seen(&scene, 0, 1), (double)seen, 1e-12 * 999997.5);
}

/* The back of a facet above one quarter of a needle 2^-40 wide, and below the rest; by less and
   less. */
static void needle_pierced_by_a_plane_all_but_its_own_shows_what_is_above_it(void **state)
{
    (void)state;
    static const double height[] = {1e-3, 1e-9, 1e-12, 2e-14, 1.2e-14, 1e-20, 1e-60};
    for (size_t i = 0; i < sizeof height / sizeof *height; i++) {
        double z = height[i];
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                       (const double[3]){0.5, 0x1p-40, 0});
        scene_triangle(&scene, (const double[3]){0, -1, z}, (const double[3]){0, 1, z},
                       (const double[3]){1, 0, -3 * z});
        lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_EXACT, 0);
        check_abs(scene_seen(&scene, 0, 1), 0.875 * 0x1p-41, 1e-12 * 0x1p-41);
        check_most(r.bound_m2, 1e-11 * r.sigma_m2);
    }
}

/* Fins of height h stand every p along x on a plate; light from (t, 0, 1). The next fin shades each
   below h - p / t, and each gap of the plate is lit over p - h t. */
static void combs_of_thin_fins_shade_as_by_hand(void **state)
{
    (void)state;
    enum { FINS = 40 };
    const double p = 0.125;
    const double h = 1;
    static const double tangent[] = {0.0625, 0.125, 0.25, 1, 3};
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){FINS * p, 0, 0},
                (const double[3]){0, 1, 0});
    for (int i = 0; i < FINS; i++) { /* fronts on +x, the last on the plate's edge */
        scene_plate(&scene, (const double[3]){(i + 1) * p, 0, 0}, (const double[3]){0, 1, 0},
                    (const double[3]){0, 0, h});
    }
    for (int i = 0; i < 5; i++) {
        double t = tangent[i];
        const double d[3] = {t, 0, 1};
        double cosine = 1 / sqrt(1 + t * t);
        double sine = t / sqrt(1 + t * t);
        lrcs_result r = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
        check_abs(scene_seen(&scene, 0, 2), FINS * fmax(0, p - h * t) * cosine, 1e-12);
        for (uint32_t f = 0; f < FINS; f++) {
            double lit = f + 1 < FINS ? fmin(h, p / t) : h;
            check_abs(scene_seen(&scene, 2 + 2 * f, 2), lit * sine, 1e-13);
        }
        double want = (double)(scene_eq2(&scene.material[0].brdf, FINS * fmax(0, p - h * t),
                                         (long double)cosine * cosine) +
                               scene_eq2(&scene.material[0].brdf, (FINS - 1) * fmin(h, p / t) + h,
                                         (long double)sine * sine));
        check_abs(r.sigma_m2, want, r.bound_m2 + 2e-15 * want);
        r = scene_run(&scene, d, LRCS_METHOD_ZBUFFER, 128);
        check_abs(r.sigma_m2, want, r.bound_m2 + 2e-15 * want);
    }
}

static void inverted_closed_box_reflects_nothing_and_is_noticed(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    scene_invert(&scene, 0);
    /* The far walls face the laser and the near ones hide them. */
    for (int k = 1; k < 4; k++) {
        lrcs_result r = scene_run(&scene, (const double[3]){1, 2, 3}, methods[k], 64);
        check_same(r.sigma_m2, 0);
        check_same(r.bound_m2, 0);
        assert_true(r.notices & LRCS_NOTICE_BACK_SIDES_VISIBLE);
        check_rel(r.back_side_area_m2, 6 / sqrt(14), 1e-14);
        assert_int_equal(r.back_side_facets, 6);
        assert_int_equal(r.facets_hidden, 6);
    }
}

/* The upper of two skins is seen, however near the lower, whichever comes first; from (1/4, 1/8, 1)
   the lower peeks out by 1/4 and 1/8 of the gap. */
static void near_coplanar_skins_one_ulp_apart_keep_their_order(void **state)
{
    (void)state;
    static const double level[][2] = {{1, 1 + 0x1p-52}, {0, 0x1p-80}, {1e3, 1e3 + 0x1p-43}};
    static const double direction[2][3] = {{0, 0, 1}, {0.25, 0.125, 1}};
    for (int i = 0; i < 3; i++) {
        for (int upper = 0; upper < 2; upper++) {
            scene_start(&scene);
            unit_plate(level[i][upper == 0]);
            scene_material(&scene, 0, 1, 0.2, 0);
            unit_plate(level[i][upper == 1]);
            uint32_t top = upper == 0 ? 0 : 2;
            double peeks = 0.375 * (level[i][1] - level[i][0]) * 8 / sqrt(69);
            for (int j = 0; j < 2; j++) {
                for (int k = 1; k < 4; k++) {
                    scene_run(&scene, direction[j], methods[k], 32);
                    check_rel(scene_seen(&scene, top, 2), j == 0 ? 1 : 8 / sqrt(69), 1e-14);
                    if (k != 1) {
                        check_abs(scene_seen(&scene, 2 - top, 2), j == 0 ? 0 : peeks, 1e-15);
                    }
                }
            }
        }
    }
}

/* Its parts shade and pierce each other, all of them behind the screen. Symptom: bounds of
   undecided facets that nothing of the laser reaches. */
static void scene_wholly_hidden_is_exactly_nothing(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 1});
    scene_sphere(&scene, (const double[3]){0.5, 0, 0.2}, 1.1, 12);
    unit_plate(2);
    uint32_t hidden = scene.scene.facet_count;
    scene_material(&scene, 0, 0, 0.2, 0);
    scene_box(&scene, (const double[3]){-9, -8, 10}, (const double[3]){10, 8, 11});
    static const double direction[3][3] = {{0, 0, 1}, {0.125, 0.0625, 1}, {-0.1, 0.2, 1}};
    for (int i = 0; i < 3; i++) {
        for (int k = 1; k < 4; k++) {
            lrcs_result r = scene_run(&scene, direction[i], methods[k], 16);
            check_same(r.sigma_m2, 0);
            check_same(r.bound_m2, 0);
            check_same(scene_seen(&scene, 0, hidden), 0);
            assert_int_equal(r.facets_partial, 0);
        }
    }
}

static void empty_scene_is_exactly_nothing(void **state)
{
    (void)state;
    scene_start(&scene);
    for (int k = 0; k < 4; k++) {
        lrcs_result r = scene_run(&scene, (const double[3]){1, 2, 3}, methods[k], 32);
        check_same(r.sigma_m2, 0);
        check_same(r.bound_m2, 0);
        check_same(r.projected_area_m2, 0);
        assert_int_equal(r.facets_total, 0);
    }
}

/* --- the same scene elsewhere ----------------------------------------------------------------- */

/* A plate at (at, at, at) and a black wall on its edge that shades 3/8 of it from (3, 0, 8). */
static const double bracket_light[3] = {3, 0, 8};
static void bracket(double at, double side)
{
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){at, at, at}, (const double[3]){side, 0, 0},
                (const double[3]){0, side, 0});
    scene_material(&scene, 0, 0, 0.2, 0);
    scene_plate(&scene, (const double[3]){at + side, at, at}, (const double[3]){0, side, 0},
                (const double[3]){0, 0, side});
}

static void check_bracket(const double direction[3], double want)
{
    for (int k = 1; k < 4; k++) {
        lrcs_result r = scene_run(&scene, direction, methods[k], 64);
        check_abs(r.sigma_m2, want, r.bound_m2 + 4e-16 * want);
        check_most(r.bound_m2, (r.method == LRCS_METHOD_EXACT ? 1e-9 : 0.1) * want);
    }
}

static void moved_by_1e6_m_is_the_same(void **state)
{
    (void)state;
    double want = reference("L-bracket, 3/8 in shadow");
    bracket(1e6, 1);
    check_bracket(bracket_light, want);
    bracket(-1e6, 1);
    check_bracket(bracket_light, want);
    bracket(0, 1);
    scene_move(&scene, 1, (const double[3]){1e6, -2e6, 3e6});
    check_bracket(bracket_light, want);
}

static void scaled_by_1e_minus_6_and_1e6_scales_by_the_square(void **state)
{
    (void)state;
    double want = reference("L-bracket, 3/8 in shadow");
    static const double factor[] = {1e-6, 1e6};
    for (int i = 0; i < 2; i++) {
        bracket(0, factor[i]);
        check_bracket(bracket_light, want * factor[i] * factor[i]);
    }
}

/* To the bit: sigma, its parts, its bound. */
static void scaled_by_a_power_of_two_is_exact(void **state)
{
    (void)state;
    static const int power[] = {-300, -20, -1, 1, 20, 300};
    for (int k = 0; k < 4; k++) {
        bracket(0, 1);
        lrcs_result one = scene_run(&scene, bracket_light, methods[k], 64);
        for (int i = 0; i < 6; i++) {
            double square = ldexp(1, 2 * power[i]);
            bracket(0, ldexp(1, power[i]));
            lrcs_result r = scene_run(&scene, bracket_light, methods[k], 64);
            check_same(r.sigma_m2, one.sigma_m2 * square);
            check_same(r.sigma_glint_m2, one.sigma_glint_m2 * square);
            check_same(r.sigma_diffuse_m2, one.sigma_diffuse_m2 * square);
            check_same(r.bound_m2, one.bound_m2 * square);
        }
    }
}

/* Turns that doubles hold exactly, with a scale: the symmetries of the cube and thirds. */
static void mesh_rotated_with_the_laser_is_the_same(void **state)
{
    (void)state;
    static const int turn[][4] = {{1, 1, 0, 0}, {0, 0, 1, 0}, {1, 1, 1, 1},
                                  {1, 2, 2, 0}, {2, 1, 0, 2}, {5, 1, -3, 2}};
    double want = reference("L-bracket, 3/8 in shadow");
    for (int i = 0; i < 6; i++) {
        double d[3] = {bracket_light[0], bracket_light[1], bracket_light[2]};
        bracket(0.5, 1);
        double factor = scene_turn(&scene, turn[i], d);
        check_bracket(d, want * factor * factor);
    }
}

/* Fins in any order: sums in facet order are compensated. */
static void facet_order_shuffled_gives_the_same_sum(void **state)
{
    (void)state;
    double want = reference("comb of 40 fins");
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){5, 0, 0},
                (const double[3]){0, 1, 0});
    for (int i = 1; i <= 40; i++) {
        scene_plate(&scene, (const double[3]){0.125 * i, 0, 0}, (const double[3]){0, 1, 0},
                    (const double[3]){0, 0, 1});
    }
    for (uint64_t seed = 1; seed < 6; seed++) {
        for (int k = 1; k < 4; k++) {
            lrcs_result r = scene_run(&scene, (const double[3]){1, 0, 2}, methods[k], 64);
            check_abs(r.sigma_m2, want, r.bound_m2 + 4e-16 * want);
            if (r.method == LRCS_METHOD_EXACT) {
                check_rel(r.sigma_m2, want, 1e-14);
            }
        }
        scene_shuffle(&scene, seed);
    }
}

/* A triangle of area 2^-1201 that reflects f_r = 2^k: sigma = 4 pi 2^(k - 127) times 2^-1074. */
static void sigma_below_the_least_normal_double_is_within_its_bound(void **state)
{
    (void)state;
    for (int k = 118; k < 134; k++) {
        double want = ldexp(12.566370614359172954, k - 127);
        scene_start(&scene);
        scene_material(&scene, 0, ldexp(1, k), 1, 0);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){0x1p-600, 0, 0},
                       (const double[3]){0, 0x1p-600, 0});
        for (int m = 0; m < 4; m++) {
            lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, methods[m], 16);
            check_abs(ldexp(r.sigma_m2, 1074), want, ldexp(r.bound_m2, 1074));
            check_most(ldexp(r.budget.rounding_m2, 1074), 2);
        }
    }
}

/* --- what is refused -------------------------------------------------------------------------- */

static const double unfit[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308, 1.0000001e100};

/* Invalid numbers are refused in scenes, materials, poses and shapes; outputs stay as they are. */
static void nan_inf_and_1e308_are_refused(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        const lrcs_prepared *prepared = NULL;
        lrcs_work work = lrcs_work_make(scene_memory, sizeof scene_memory);
        scene_start(&scene);
        unit_plate(0);
        scene.vertex[i % 4].x[i % 3] = unfit[i];
        assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_E_NUMBER);
        assert_null(prepared);
        assert_int_equal(work.used, 0);
    }
    for (int i = 0; i < 3; i++) {
        lrcs_pose pose = lrcs_pose_default();
        const lrcs_brdf in_A = {unfit[i], 0.25, 0.2, 0.5};
        const lrcs_brdf in_B = {1, unfit[i], 0.2, 0.5};
        const lrcs_brdf in_s = {1, 0.25, unfit[i], 0.5};
        const lrcs_brdf in_m = {1, 0.25, 0.2, unfit[i]};
        assert_true(lrcs_brdf_check(&in_A) < 0 && lrcs_brdf_check(&in_B) < 0);
        assert_true(lrcs_brdf_check(&in_s) < 0 && lrcs_brdf_check(&in_m) < 0);
        assert_true(lrcs_pose_from_direction((const double[3]){0, unfit[i], 1}, &pose) < 0);
        assert_true(lrcs_pose_from_azel(unfit[i], 0, &pose) < 0);
        check_same(pose.direction[2], 1);
    }
    for (int i = 0; i < 6; i++) {
        lrcs_where where;
        const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = unfit[i]};
        assert_int_equal(lrcs_shape_check(&ball, &where), LRCS_E_NUMBER);
        assert_string_equal(where.item, "radius");
    }
}

/* sigma of the largest scenes that are taken would be 1e200: it is finite, and so is its bound. */
static void coordinates_above_1e100_m_are_refused_with_the_reason(void **state)
{
    (void)state;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1.1e100 0\nf 1 2 3\n";
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(lrcs_obj_count(text, sizeof text - 1, &counts, &where), LRCS_E_NUMBER);
    assert_int_equal(where.line, 3);
    assert_string_equal(where.found, "1.1e100");
    assert_string_equal(where.expected, "a magnitude of at most 1e100");

    lrcs_recipe_part part = {.name = "far",
                             .shape = {.kind = LRCS_SHAPE_PLATE, .size = {1, 1, 0}},
                             .place = lrcs_place_default(),
                             .material_index = -1};
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_build_options options = lrcs_build_options_default();
    lrcs_work work = lrcs_work_make(scene_memory, sizeof scene_memory);
    lrcs_scene built;
    part.place.translate[1] = 1.1e100;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &options, &work, &built, &where),
                     LRCS_E_NUMBER);
    assert_string_equal(where.expected, "coordinates of at most 1e100 m after placing");
    assert_string_equal(where.found, "far");

    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1e100, 0, 0},
                (const double[3]){0, 1e100, 0});
    for (int k = 1; k < 4; k++) {
        double want = reference("skins one ulp apart") * 1e100 * 1e100;
        lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, methods[k], 16);
        check_abs(r.sigma_m2, want, r.bound_m2 + 4e-16 * want);
        check_most(r.bound_m2, 1e-13 * want);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(theta_to_90_deg_keeps_its_digits),
        cmocka_unit_test(s_from_1e_minus_6_to_1e3_keeps_its_digits),
        cmocka_unit_test(m_from_0_to_1e4_keeps_its_digits),
        cmocka_unit_test(glint_that_underflows_leaves_the_diffuse_part),
        cmocka_unit_test(cone_half_angle_to_0_keeps_its_digits),
        cmocka_unit_test(cone_half_angle_to_90_deg_keeps_its_digits),
        cmocka_unit_test(aspect_0_tangent_to_the_cone_and_180_agree),
        cmocka_unit_test(slivers_of_aspect_1e8_count_for_what_they_are),
        cmocka_unit_test(zero_area_facets_change_nothing),
        cmocka_unit_test(duplicate_facets_count_once),
        cmocka_unit_test(coplanar_coincident_facets_show_their_union),
        cmocka_unit_test(t_junctions_leave_no_crack),
        cmocka_unit_test(directions_in_a_facets_plane_are_exactly_edge_on),
        cmocka_unit_test(interpenetrating_plates_hide_part_of_each_other),
        cmocka_unit_test(needle_pierced_beside_a_corner_is_hidden_as_by_hand),
        cmocka_unit_test(needle_pierced_by_a_plane_all_but_its_own_shows_what_is_above_it),
        cmocka_unit_test(combs_of_thin_fins_shade_as_by_hand),
        cmocka_unit_test(inverted_closed_box_reflects_nothing_and_is_noticed),
        cmocka_unit_test(near_coplanar_skins_one_ulp_apart_keep_their_order),
        cmocka_unit_test(scene_wholly_hidden_is_exactly_nothing),
        cmocka_unit_test(empty_scene_is_exactly_nothing),
        cmocka_unit_test(moved_by_1e6_m_is_the_same),
        cmocka_unit_test(scaled_by_1e_minus_6_and_1e6_scales_by_the_square),
        cmocka_unit_test(scaled_by_a_power_of_two_is_exact),
        cmocka_unit_test(mesh_rotated_with_the_laser_is_the_same),
        cmocka_unit_test(facet_order_shuffled_gives_the_same_sum),
        cmocka_unit_test(sigma_below_the_least_normal_double_is_within_its_bound),
        cmocka_unit_test(nan_inf_and_1e308_are_refused),
        cmocka_unit_test(coordinates_above_1e100_m_are_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
