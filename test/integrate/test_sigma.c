/* SPDX-License-Identifier: MIT */
/* sigma of whole scenes against closed forms and hand arithmetic: plates, boxes, and the shadows of
   solar arrays and a cube. Hard cases are in test_hard.c. */
#include "integrate/sigma.h"

#include "integrate/sigma_run.h"
#include "recipe.h"
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

/* Whatever its material: a glint that is forced on a surface without slope, one as wide as s = 2.
 */
static void a_plate_all_but_edge_on_follows_eq_2_with_any_material(void **state)
{
    (void)state;
    static const lrcs_brdf brdf[] = {{0, 0.25, 0, 0.5}, {1, 0.25, 2, 0.5}, {1, 0.25, 0.2, 0.5}};
    need_wide_long_double();
    for (int i = 0; i < 9; i++) {
        double tangent = i / 3 == 0 ? 1e-9 : i / 3 == 1 ? 1e-40 : 1e-200;
        lrcs_pose pose;
        lrcs_work work;
        lrcs_result r;
        lrcs_run_options options = lrcs_run_options_default();
        scene_start(&scene);
        unit_plate(0);
        unit_plate(-9);
        scene.material[0].brdf = brdf[i % 3];
        options.with = 1u << LRCS_EFFECT_GLINT;
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        assert_int_equal(lrcs_pose_from_direction((const double[3]){1, 0, tangent}, &pose),
                         LRCS_OK);
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
        long double cosine = (long double)tangent / sqrtl(1 + (long double)tangent * tangent);
        lrcs_brdf sloped = brdf[i % 3];
        sloped.s = sloped.s > 0 ? sloped.s : 1;
        check_bound(r, 2 * (double)scene_eq2(&sloped, 1, cosine * cosine));
    }
}

/* Two plates in one place are one, from behind too: without a search for shadows its back counts
   once among the back sides that are seen. */
static void back_sides_stored_twice_count_once(void **state)
{
    (void)state;
    const double below[3] = {0.6, 0, -0.8};
    for (int twice = 0; twice < 2; twice++) {
        scene_start(&scene);
        unit_plate(0);
        if (twice) {
            unit_plate(0);
        }
        lrcs_result r = scene_run(&scene, below, LRCS_METHOD_FACET, 0);
        check_same(r.sigma_m2, 0);
        check_abs(r.back_side_area_m2, 0.8, 1e-14);
        assert_int_equal(r.back_side_facets, 2);
    }
}

/* --- round bodies ----------------------------------------------------------------------------- */

static unsigned char built_area[1u << 22], prepared_area[1u << 24];

/* A ball alone, stretched, of so many facets. */
static const lrcs_prepared *ball(const lrcs_brdf *brdf, double stretch, int only, lrcs_scene *built)
{
    lrcs_recipe_part part = {.name = "", .place = lrcs_place_default(), .material_index = -1};
    part.shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    part.place.scale[0] = stretch;
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = *brdf, .two_sided = 0};
    const lrcs_recipe recipe = {
        .part = &part, .part_count = 1, .binding = &binding, .binding_count = 1};
    const lrcs_build_options options = {1e-2, 8000, LRCS_NORMALS_FLAT, only, 0, NULL};
    const lrcs_prepared *prepared;
    lrcs_work work = lrcs_work_make(built_area, sizeof built_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &options, &work, built, NULL), LRCS_OK);
    work = lrcs_work_make(prepared_area, sizeof prepared_area);
    assert_int_equal(lrcs_prepare_run(built, &work, &prepared), LRCS_OK);
    return prepared;
}

/* An ellipsoid is convex by construction, however it is seen; a search for shadows finds as much.
 */
static void a_search_for_shadows_on_a_convex_body_finds_none(void **state)
{
    (void)state;
    const lrcs_brdf brdf = {1, 0.25, 0.3, 0.5};
    lrcs_scene built;
    const lrcs_prepared *prepared = ball(&brdf, 3, LRCS_FACETS_TOTAL, &built);
    for (int i = 0; i < 10; i++) {
        lrcs_pose pose;
        lrcs_result r[2];
        lrcs_run_options options = lrcs_run_options_default();
        const double d[3] = {cos(i), sin(i), 0.7 * sin(0.37 * i)};
        assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
        for (int k = 0; k < 2; k++) {
            lrcs_work work = lrcs_work_make(scene_memory, sizeof scene_memory);
            options.method = k ? LRCS_METHOD_EXACT : LRCS_METHOD_FACET;
            options.with = k ? 1u << LRCS_EFFECT_SELF_SHADOWING : 0;
            assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r[k], NULL, NULL),
                             LRCS_OK);
            assert_int_equal(r[k].method, options.method);
        }
        check_abs(r[0].sigma_m2, r[1].sigma_m2,
                  r[0].budget.visibility_m2 + r[1].budget.visibility_m2 + 1e-13);
    }
}

/* The closed form of a clear ball is divided among its facets, each term by itself. */
static void records_of_a_clear_ball_add_up_to_it(void **state)
{
    (void)state;
    static const lrcs_brdf brdf[] = {
        {1, 0, 0.3, 0.5}, {0, 0.25, 0.3, 0.5}, {1, 0.25, 0.3, 0.5}, {1, 0, 1e-3, 0.5}};
    for (int i = 0; i < 4; i++) {
        lrcs_scene built;
        lrcs_pose pose;
        lrcs_result r;
        const lrcs_prepared *prepared = ball(&brdf[i], 1, LRCS_FACETS_BASE, &built);
        lrcs_run_options options = lrcs_run_options_default();
        lrcs_work work = lrcs_work_make(scene_memory, sizeof scene_memory);
        assert_true(built.facet_count <= SCENE_FACETS);
        assert_int_equal(lrcs_pose_from_direction((const double[3]){0.2, 0.3, 1}, &pose), LRCS_OK);
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, scene.record, NULL),
                         LRCS_OK);
        assert_int_equal(r.method, LRCS_METHOD_CLOSED);
        double sum[2] = {0, 0};
        for (uint32_t f = 0; f < built.facet_count; f++) {
            assert_true(scene.record[f].sigma_m2 >= 0);
            sum[0] += scene.record[f].sigma_m2;
            sum[1] += scene.record[f].sigma_glint_m2;
        }
        check_rel(sum[0], r.sigma_m2, 1e-12);
        check_abs(sum[1], r.sigma_glint_m2, 1e-12 * r.sigma_m2);
    }
}

/* How many sectors of a part are integrated over what the laser sees of their patches. */
static uint32_t integrated_sectors(const lrcsi_sigma *run, uint32_t part)
{
    const lrcs_part *of = &run->view.prepared->scene->part[part];
    uint32_t count = 0;
    for (uint32_t f = 0; f < of->facet_count && run->areas.wall_terms; f++) {
        count += run->areas.wall_terms[of->first_facet + f].way != LRCSI_WALL_FACET;
    }
    return count;
}

/* An open dome, alone or in front of a ball that is beside it: by its closed form, so that nothing
   of it is integrated as well; its limb is if clipping is asked for, which uses no closed forms. */
static void walls_with_closed_forms_are_not_integrated(void **state)
{
    (void)state;
    static lrcsi_sigma run;
    const lrcs_brdf brdf = {1, 0.25, 0.3, 0.5};
    const lrcs_build_options build = {1e-2, 8000, LRCS_NORMALS_FLAT, LRCS_FACETS_BASE, 0, NULL};
    for (int i = 0; i < 4; i++) {
        lrcs_recipe_part part[2];
        lrcs_recipe_material material[2];
        lrcs_scene built;
        lrcs_work work;
        lrcs_pose pose;
        lrcs_recipe recipe = recipe_bright_and_black(&brdf, part, material);
        part[0].shape =
            (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = 1, .parts = LRCS_SHAPE_WALL};
        part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
        part[1].place.translate[0] = 3;
        recipe.part_count = i % 2 ? 2 : 1;
        const lrcs_prepared *prepared = recipe_prepare(&recipe, NULL, &build, &built, &work);
        lrcs_run_options options = lrcs_run_options_default();
        options.method = i < 2 ? LRCS_METHOD_AUTO : LRCS_METHOD_EXACT;
        assert_int_equal(lrcs_pose_from_direction((const double[3]){0.1, 0.4, 0.6}, &pose),
                         LRCS_OK);
        const lrcsi_sigma_request request = {.options = &options, .last = LRCSI_SIGMA_SUM};
        assert_int_equal(lrcsi_sigma_stages(&request, prepared, &pose, &work, &run), LRCS_OK);
        assert_int_equal(lrcsi_is_clear_shape(&run.clear, 0), i < 2);
        if (i < 2) {
            assert_int_equal(integrated_sectors(&run, 0), 0);
        } else {
            assert_true(integrated_sectors(&run, 0) > 10);
        }
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
            assert_int_equal(lrcsi_sigma_run_until(prepared, &pose, &options, last, &work),
                             LRCS_OK);
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
            lrcsi_sigma_run_until(prepared, &pose, &options, LRCSI_SIGMA_VISIBILITY, &work),
            LRCS_OK);
        options.tolerance = -1;
        assert_int_equal(lrcsi_sigma_run_until(prepared, &pose, &options, LRCSI_SIGMA_SUM, &work),
                         LRCS_E_ARGUMENT);
    }
    lrcs_run_options options = lrcs_run_options_default();
    assert_int_equal(lrcsi_sigma_run_until(prepared, &pose, &options, LRCSI_SIGMA_SUM, &work),
                     LRCS_E_ARGUMENT);
    options.method = LRCS_METHOD_EXACT;
    work.size = work.used;
    assert_int_equal(lrcsi_sigma_run_until(prepared, &pose, &options, LRCSI_SIGMA_VIEW, &work),
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
        cmocka_unit_test(a_plate_all_but_edge_on_follows_eq_2_with_any_material),
        cmocka_unit_test(back_sides_stored_twice_count_once),
        cmocka_unit_test(a_search_for_shadows_on_a_convex_body_finds_none),
        cmocka_unit_test(records_of_a_clear_ball_add_up_to_it),
        cmocka_unit_test(walls_with_closed_forms_are_not_integrated),
        cmocka_unit_test(a_run_ends_after_the_stage_that_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
