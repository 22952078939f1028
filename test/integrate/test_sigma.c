/* SPDX-License-Identifier: MIT */
/* sigma of whole scenes against closed forms and hand arithmetic: the shadows of DESIGN.md, hidden
   and edge-on facets, surfaces that pierce each other or coincide, and hard numbers. */
#include "scenes.h"

static test_scene scene;
static const int methods[] = {LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT,
                              LRCS_METHOD_AUTO};

static void unit_plate(double z)
{
    const double corner[3] = {0, 0, z};
    const double u[3] = {1, 0, 0};
    const double v[3] = {0, 1, 0};
    scene_plate(&scene, corner, u, v);
}

/* --- plates and boxes: closed forms ----------------------------------------------------------- */

static void plate_has_its_published_values(void **state)
{
    (void)state;
    static const double degrees[] = {0, 20, 60, 85};
    static const double sigma[] = {15.7079632679, 3.27656091132, 0.55536036727, 0.00704514431103};
    scene_start(&scene);
    unit_plate(0);
    for (int i = 0; i < 4; i++) {
        double t = degrees[i] * (double)SCENE_PI / 180;
        const double direction[3] = {sin(t), 0, cos(t)};
        for (int k = 0; k < 4; k++) {
            lrcs_result r = scene_run(&scene, direction, methods[k], 64);
            check_rel(r.sigma_m2, sigma[i], 1e-11);
        }
    }
}

static void edge_on_plate_is_exactly_nothing(void **state)
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

/* Eq. 2 over the three faces of a box that see the direction. */
static long double box_sigma(const lrcs_brdf *brdf, const double size[3], const double d[3])
{
    long double dd = (long double)d[0] * d[0] + (long double)d[1] * d[1] + (long double)d[2] * d[2];
    long double sigma = 0;
    for (int k = 0; k < 3; k++) {
        if (d[k] != 0) {
            sigma += scene_eq2(brdf, (long double)size[(k + 1) % 3] * size[(k + 2) % 3],
                               (long double)d[k] * d[k] / dd);
        }
    }
    return sigma;
}

static void box_follows_its_closed_form_from_everywhere(void **state)
{
    (void)state;
    static const double low[3] = {-0.5, -1, -0.25};
    static const double high[3] = {1, 1, 0.5};
    static const double size[3] = {1.5, 2, 0.75};
    scene_start(&scene);
    scene_box(&scene, low, high);
    lrcs_work work;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int i = -3; i <= 3; i++) {
        for (int j = -3; j <= 3; j++) {
            for (int k = -3; k <= 3; k++) {
                const double d[3] = {i, j, k};
                if (i == 0 && j == 0 && k == 0) {
                    continue;
                }
                double want = (double)box_sigma(&scene.material[0].brdf, size, d);
                for (int m = 0; m < 4; m++) {
                    lrcs_result r = scene_pose(&scene, prepared, &work, d, methods[m], 16);
                    check_bound(r, want);
                    check_most(r.bound_m2, 1e-13 * want);
                }
            }
        }
    }
}

static void inverted_box_reflects_nothing_and_is_noticed(void **state)
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

/* --- shadows ---------------------------------------------------------------------------------- */

/* The wall stands on the plate's edge and shades 1 - tan a of it, tan a = d_x / d_z. */
static void l_bracket_is_lit_to_one_minus_tan(void **state)
{
    (void)state;
    static const double tangent[] = {0, 0.125, 0.5, 0.7071, 0.99, 1};
    scene_start(&scene);
    unit_plate(0);
    scene_material(&scene, 0, 0, 0.2, 0); /* the wall faces the laser, and is black */
    scene_plate(&scene, (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0},
                (const double[3]){0, 0, 1});
    for (int i = 0; i < 6; i++) {
        const double d[3] = {tangent[i], 0, 1};
        double cosine = 1 / sqrt(1 + tangent[i] * tangent[i]);
        double want = (1 - tangent[i]) *
                      (double)scene_eq2(&scene.material[0].brdf, 1, cosine * (long double)cosine);
        lrcs_result r = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
        check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
        check_abs(scene_seen(&scene, 0, 2), (1 - tangent[i]) * cosine, 1e-13);
        check_rel(scene_seen(&scene, 2, 2), tangent[i] * cosine, 1e-13);
        for (uint32_t size = 16; size <= 256; size *= 4) {
            r = scene_run(&scene, d, LRCS_METHOD_ZBUFFER, size);
            check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
        }
    }
}

/* A 1 m cube and two 2 x 1 m arrays at +-1.6 m, whose fronts face +z. Cube: facets 0 to 11 (its
   face on +x is 2 and 3), array at -x: 12 and 13, array at +x: 14 and 15. */
static void cube_with_arrays(void)
{
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-0.5, -0.5, -0.5}, (const double[3]){0.5, 0.5, 0.5});
    for (int side = -1; side <= 1; side += 2) {
        scene_plate(&scene, (const double[3]){side * 1.6 - 1, -0.5, 0}, (const double[3]){2, 0, 0},
                    (const double[3]){0, 1, 0});
    }
}

static void arrays_and_cube_shade_each_other(void **state)
{
    (void)state;
    static const double tangent[] = {0.1, 0.2, 0.5, 1, 1.7320508075688772, 4, 4.2, 5.67128181961771,
                                     30};
    cube_with_arrays();
    lrcs_work work;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int i = 0; i < 9; i++) {
        double t = tangent[i];
        const double d[3] = {t, 0, 1};
        double array = 1 - fmin(1, fmax(0, (0.5 * t - 0.1) / 2));
        double face = 1 - fmax(0, fmin(0.5, 2.1 / t) - 0.1 / t);
        double cosine = 1 / sqrt(1 + t * t);
        double sine = t / sqrt(1 + t * t);
        /* The array at +x sees all, the cube's top too; the array's back is seen by nobody. */
        const lrcs_brdf *b = &scene.material[0].brdf;
        double want = (double)(scene_eq2(b, 2 * array + 3, (long double)cosine * cosine) +
                               scene_eq2(b, face, (long double)sine * sine));
        lrcs_result r = scene_pose(&scene, prepared, &work, d, LRCS_METHOD_EXACT, 0);
        check_abs(scene_seen(&scene, 12, 2), 2 * array * cosine, 2e-12 * cosine + 4e-14);
        check_abs(scene_seen(&scene, 2, 2), face * sine, 1e-12 * sine + 4e-14);
        check_rel(scene_seen(&scene, 14, 2), 2 * cosine, 1e-13);
        check_abs(r.sigma_m2, want, r.bound_m2 + 2e-15 * want);
        check_most(r.bound_m2, 1e-11 * want);
        for (uint32_t size = 32; size <= 512; size *= 4) {
            r = scene_pose(&scene, prepared, &work, d, LRCS_METHOD_ZBUFFER, size);
            check_abs(r.sigma_m2, want, r.bound_m2 + 2e-15 * want);
        }
    }
}

/* The two fractions as DESIGN.md prints them. */
static void arrays_and_cube_at_sixty_and_eighty_degrees(void **state)
{
    (void)state;
    static const double degrees[] = {60, 80};
    static const double array[] = {0.616987, 0};
    static const double face[] = {0.557735, 0.647346};
    cube_with_arrays();
    for (int i = 0; i < 2; i++) {
        double t = degrees[i] * (double)SCENE_PI / 180;
        const double d[3] = {sin(t), 0, cos(t)};
        scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
        check_abs(scene_seen(&scene, 12, 2) / (2 * cos(t)), array[i], 5e-7);
        check_abs(scene_seen(&scene, 2, 2) / sin(t), face[i], 5e-7);
    }
}

/* Its parts shade and pierce each other, all of them behind the screen. Symptom: bounds of
   contested facets that nothing of the laser reaches. */
static void scene_behind_a_black_screen_is_exactly_nothing(void **state)
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

/* Fins of height h stand every p along x on a plate; light from (t, 0, 1). The next fin shades each
   below h - p / t, and each gap of the plate is lit over p - h t. */
static void comb_of_fins_shades_as_by_hand(void **state)
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

/* --- surfaces that pierce each other or coincide ---------------------------------------------- */

/* Plates z = x and z = -x over |x| <= 1 cross on the y axis; seen from (1, 0, 2), of z = x the half
   x > 0 is seen. Of z = -x all of x < 0, and beyond the shadow of the other, in u = 2 x - z, what
   lies in 1 .. 3 out of 0 .. 3. */
static void crossing_plates_hide_half_of_each_other(void **state)
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

/* Two skins in one plane: a front beats a back, then the lower index. */
static void coincident_plates_count_once(void **state)
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
static void overlapping_coplanar_plates_show_their_union(void **state)
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

/* The upper of two skins is seen, however near the lower, whichever comes first; from (1/4, 1/8, 1)
   the lower peeks out by 1/4 and 1/8 of the gap. */
static void skins_one_ulp_apart_keep_their_order(void **state)
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

/* --- slivers -----------------------------------------------------------------------------------
 */

/* A unit square fanned from a point 1e-8 off its edge: two slivers of that height. */
static void slivers_count_for_what_they_are(void **state)
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

/* --- hard materials ----------------------------------------------------------------------------
 */

static void underflowing_glint_leaves_the_diffuse_part(void **state)
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

static void every_slope_and_diffusivity_is_finite_within_its_bound(void **state)
{
    (void)state;
    static const double slope[] = {1e-6, 1e-3, 0.2, 0.7, 1, 30, 1e3};
    static const double power[] = {0, 0.5, 7, 1e3, 1e4};
    static const double tangent[] = {0, 1e-9, 1e-3, 1, 57, 1e6, 1e12};
    for (int i = 0; i < 7; i++) {
        for (int j = 0; j < 5; j++) {
            scene_start(&scene);
            scene_material(&scene, 1, 0.25, slope[i], power[j]);
            unit_plate(0);
            for (int k = 0; k < 7; k++) {
                long double t2 = (long double)tangent[k] * tangent[k];
                lrcs_result r =
                    scene_run(&scene, (const double[3]){0, tangent[k], 1}, LRCS_METHOD_AUTO, 0);
                long double glint = (1 + t2) * (1 + t2) * expl(-t2 / slope[i] / slope[i]);
                long double diffuse = 0.25L * expl(-(0.5L * power[j] + 1) * log1pl(t2));
                long double want = 4 * SCENE_PI * (glint + diffuse);
                assert_true(isfinite(r.bound_m2));
                assert_true(r.sigma_m2 >= 0);
                check_abs(r.sigma_m2, (double)want, r.bound_m2 + 4e-16 * (double)want);
            }
        }
    }
}

/* The last degrees before edge-on, where tan^2 / s^2 is known to less and less, then not at all:
   there the glint is nothing, and the bound may not take it for its peak. */
static void a_plate_nearly_edge_on_keeps_a_useful_bound(void **state)
{
    (void)state;
    for (int power = -3; power <= 3; power++) {
        scene_start(&scene);
        unit_plate(0);
        lrcs_brdf *brdf = &scene.material[0].brdf;
        brdf->s = pow(10, power);
        for (int fall = 1; fall <= 60; fall++) {
            double e = ldexp(1.375, -fall);
            long double cos2 = (long double)e * e / (0.390625L + 1 + (long double)e * e);
            lrcs_result r = scene_run(&scene, (const double[3]){1, 0.625, e}, LRCS_METHOD_AUTO, 0);
            double want = (double)scene_eq2(brdf, 1, cos2);
            check_bound(r, want);
            check_most(r.bound_m2, 1e-9 * want);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plate_has_its_published_values),
        cmocka_unit_test(edge_on_plate_is_exactly_nothing),
        cmocka_unit_test(empty_scene_is_exactly_nothing),
        cmocka_unit_test(box_follows_its_closed_form_from_everywhere),
        cmocka_unit_test(inverted_box_reflects_nothing_and_is_noticed),
        cmocka_unit_test(l_bracket_is_lit_to_one_minus_tan),
        cmocka_unit_test(arrays_and_cube_shade_each_other),
        cmocka_unit_test(arrays_and_cube_at_sixty_and_eighty_degrees),
        cmocka_unit_test(scene_behind_a_black_screen_is_exactly_nothing),
        cmocka_unit_test(comb_of_fins_shades_as_by_hand),
        cmocka_unit_test(crossing_plates_hide_half_of_each_other),
        cmocka_unit_test(coincident_plates_count_once),
        cmocka_unit_test(overlapping_coplanar_plates_show_their_union),
        cmocka_unit_test(skins_one_ulp_apart_keep_their_order),
        cmocka_unit_test(slivers_count_for_what_they_are),
        cmocka_unit_test(underflowing_glint_leaves_the_diffuse_part),
        cmocka_unit_test(every_slope_and_diffusivity_is_finite_within_its_bound),
        cmocka_unit_test(a_plate_nearly_edge_on_keeps_a_useful_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
