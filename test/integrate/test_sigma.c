/* SPDX-License-Identifier: MIT */
/* sigma of whole scenes against closed forms and hand arithmetic: plates, boxes, and the shadows of
   solar arrays and a cube. Hard cases are in test_hard.c. */
#include "integrate/sigma.h"

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

/* The two fractions, worked out by hand to six digits. */
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

/* The bracket again. Where no resolution is given the first serves a loose tolerance, a finer one a
   strict one; one that no raster meets, or no sum of doubles, ends at the finest for which there is
   memory. */
static void rasters_are_refined_until_they_meet_the_tolerance(void **state)
{
    (void)state;
    static const double tolerance[] = {0.1, 0.01, 1e-9, 1e-17};
    static const double d[3] = {0.7071, 0.1, 1};
    const double square = 0.7071 * 0.7071 + 0.1 * 0.1 + 1;
    scene_start(&scene);
    unit_plate(0);
    scene_material(&scene, 0, 0, 0.2, 0);
    scene_plate(&scene, (const double[3]){1, -1, 0}, (const double[3]){0, 3, 0},
                (const double[3]){0, 0, 1});
    double want =
        (1 - 0.7071) * (double)scene_eq2(&scene.material[0].brdf, 1, 1 / (long double)square);
    lrcs_work work;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    for (int i = 0; i < 4; i++) {
        lrcs_result r;
        lrcs_run_options options = {.tolerance = tolerance[i], .method = LRCS_METHOD_ZBUFFER};
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
        check_abs(r.sigma_m2, want, r.bound_m2 + 1e-15 * want);
        assert_int_equal(r.bound_m2 <= tolerance[i] * r.sigma_m2, i < 2);
        assert_int_equal(r.resolution > 512, i > 0);
        assert_int_equal((r.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0, i >= 2);
    }
}

/* A term that is not there may be asked for; a glint without a slope cannot even be evaluated. */
static void a_glint_forced_on_a_matt_surface_adds_nothing(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.25, 1};
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    for (int i = 0; i < 2; i++) {
        scene_start(&scene);
        unit_plate(0);
        scene.material[0].brdf = (lrcs_brdf){0, 0.25, i ? 0.2 : 0, 0.5};
        lrcs_work work;
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        lrcs_run_options options = lrcs_run_options_default();
        options.with = 1u << LRCS_EFFECT_GLINT;
        lrcs_result r;
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
        check_bound(r, (double)scene_eq2(&(lrcs_brdf){0, 0.25, 1, 0.5}, 1, 1 / 1.3125L));
        check_same(r.sigma_glint_m2, 0.0);
    }
}

/* --- a run as far as a stage ------------------------------------------------------------------ */

/* Each stage takes the steps of those before it and its own, and all memory is given back: so hosts
   time stages by differences. Auto is not asked, but the method that it chose. */
static void a_run_ends_after_the_stage_that_is_asked_for(void **state)
{
    (void)state;
    static const int by[] = {LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT,
                             LRCS_METHOD_CLOSED};
    lrcs_work work;
    lrcs_pose pose;
    cube_with_arrays();
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.75, 0.1, 1}, &pose), LRCS_OK);
    for (int i = 0; i < 4; i++) {
        lrcs_run_options options = lrcs_run_options_default();
        options.method = by[i];
        options.resolution = by[i] == LRCS_METHOD_ZBUFFER ? 64 : 0;
        size_t used = work.used;
        size_t taken[LRCSI_SIGMA_STAGES];
        for (int last = 0; last < LRCSI_SIGMA_STAGES; last++) {
            work.peak = used;
            assert_int_equal(lrcsi_sigma_until(prepared, &pose, &options, last, &work), LRCS_OK);
            assert_int_equal(work.used, used);
            taken[last] = work.peak - used;
            assert_true(last == 0 || taken[last] >= taken[last - 1]);
        }
        if (by[i] == LRCS_METHOD_ZBUFFER || by[i] == LRCS_METHOD_EXACT) {
            assert_true(taken[LRCSI_SIGMA_CLASSIFY] > taken[LRCSI_SIGMA_VIEW]);
            assert_true(taken[LRCSI_SIGMA_VISIBILITY] > taken[LRCSI_SIGMA_CLASSIFY]);
            lrcs_result r;
            work.peak = used;
            assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL),
                             LRCS_OK);
            assert_int_equal(work.peak - used, taken[LRCSI_SIGMA_SUM]);
        }
        options.steps = 1; /* a limit of steps ends no stage with an error */
        assert_int_equal(
            lrcsi_sigma_until(prepared, &pose, &options, LRCSI_SIGMA_VISIBILITY, &work), LRCS_OK);
        options.tolerance = -1;
        assert_int_equal(lrcsi_sigma_until(prepared, &pose, &options, LRCSI_SIGMA_SUM, &work),
                         LRCS_E_ARGUMENT);
    }
    lrcs_run_options options = lrcs_run_options_default();
    assert_int_equal(lrcsi_sigma_until(prepared, &pose, &options, LRCSI_SIGMA_SUM, &work),
                     LRCS_E_ARGUMENT);
    options.method = LRCS_METHOD_EXACT;
    work.size = work.used;
    assert_int_equal(lrcsi_sigma_until(prepared, &pose, &options, LRCSI_SIGMA_VIEW, &work),
                     LRCS_E_MEMORY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plate_has_its_published_values),
        cmocka_unit_test(box_follows_its_closed_form_from_everywhere),
        cmocka_unit_test(l_bracket_is_lit_to_one_minus_tan),
        cmocka_unit_test(arrays_and_cube_shade_each_other),
        cmocka_unit_test(arrays_and_cube_at_sixty_and_eighty_degrees),
        cmocka_unit_test(a_plate_nearly_edge_on_keeps_a_useful_bound),
        cmocka_unit_test(rasters_are_refined_until_they_meet_the_tolerance),
        cmocka_unit_test(a_glint_forced_on_a_matt_surface_adds_nothing),
        cmocka_unit_test(a_run_ends_after_the_stage_that_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
