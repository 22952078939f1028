/* SPDX-License-Identifier: MIT */
/* Derivatives of sigma and its material uncertainty. References: mpmath at 40 digits
   (uncertainty_reference.py beside this file), runs with other parameters, and the variances of
   linear functions. */
#include "curved.h"
#include "memory_limit.h"
#include "scenes.h"

#define ROWS(a) (sizeof(a) / sizeof(a)[0])

static unsigned char scene_area[1u << 24];
static unsigned char run_area[1u << 26];

/* A pose's outcome. */
typedef struct outcome {
    lrcs_result result;
    lrcs_sensitivity d[4];
    lrcs_uncertainty u;
} outcome;

static int try_run(const lrcs_prepared *prepared, const double direction[3], int method,
                   const lrcs_uncertainty_options *how, lrcs_work *work, outcome *out)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_pose pose;
    options.method = method;
    options.tolerance = 1e-8; /* means over patches have a small remainder */
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    return lrcs_uncertainty_run(prepared, &pose, &options, how, work, &out->result, out->d,
                                &out->u);
}

static outcome run_with(const lrcs_prepared *prepared, const double direction[3], int method,
                        const lrcs_uncertainty_options *how)
{
    outcome out;
    lrcs_work work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(try_run(prepared, direction, method, how, &work, &out), LRCS_OK);
    assert_true(work.used == 0);
    return out;
}

/* --- shapes, alone ---------------------------------------------------------------------------- */

static lrcs_scene shape_scene;

static const lrcs_prepared *shape_prepare(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                          const lrcs_brdf_error *error, double scale)
{
    static lrcs_recipe_material material;
    static lrcs_recipe_part part;
    const lrcs_build_options build = lrcs_build_options_default();
    const lrcs_prepared *prepared;
    material = (lrcs_recipe_material){.name = "skin", .brdf = *brdf, .two_sided = -1};
    material.error = error ? *error : material.error;
    part = (lrcs_recipe_part){.name = "",
                              .shape = *shape,
                              .place = lrcs_place_default(),
                              .material = "skin",
                              .material_index = 0};
    for (int k = 0; k < 3; k++) {
        part.place.scale[k] = scale;
    }
    lrcs_recipe recipe = {
        .part = &part, .part_count = 1, .material = &material, .material_count = 1};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &shape_scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_prepare_run(&shape_scene, &work, &prepared), LRCS_OK);
    return prepared;
}

static void aspect(double deg, double direction[3])
{
    direction[0] = sin(deg * CURVED_PI / 180);
    direction[1] = 0;
    direction[2] = cos(deg * CURVED_PI / 180);
}

typedef struct reference {
    lrcs_shape shape;
    double deg;
    lrcs_brdf brdf;
    double d[4]; /* uncertainty_reference.py */
} reference;

#define PLATE                                                                                      \
    {                                                                                              \
        .kind = LRCS_SHAPE_PLATE, .size = { 1, 1 }                                                 \
    }
#define SPHERE                                                                                     \
    {                                                                                              \
        .kind = LRCS_SHAPE_SPHERE, .radius = 0.5                                                   \
    }
#define WALL                                                                                       \
    {                                                                                              \
        .kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1.5, .parts = LRCS_SHAPE_WALL       \
    }

static const reference references[] = {
    {PLATE, 0, {1, 0.25, 0.2, 0.5}, {12.566370614359173, 12.566370614359173, 0.0, 0.0}},
    {PLATE,
     20,
     {1, 0.25, 0.2, 0.5},
     {0.58741471268846423, 10.756584794533006, 19.454342834150948, -0.16727149906049578}},
    {PLATE,
     60,
     {1, 0.25, 0.2, 0.5},
     {5.3857191685442184e-31, 2.2214414690791831, 4.0392893764081638e-28, -0.38494647276779468}},
    {PLATE,
     20,
     {1, 0.25, 0.05, 0},
     {1.5635729352806951e-22, 11.096384496831318, 3.3141324679385304e-19, -0.17255559309865527}},
    {SPHERE,
     20,
     {1, 0.25, 0.2, 0.5},
     {0.40253058619826528, 5.6397739434796335, 4.1013562543012455, -0.40284099596283096}},
    {SPHERE,
     90,
     {2, 0.1, 0.02, 0},
     {0.0039486311709688138, 6.5797362673929057, 0.78988408475548527, -0.21932454224643019}},
    {WALL,
     30,
     {1, 0.25, 0.2, 0.5},
     {3.5976256400935362e-32, 1.1977192814462601, 2.7163863446208732e-29, -0.25621736242910032}},
    {WALL,
     80,
     {1, 0.25, 0.4, 3},
     {3.1037175723705041, 4.6561520084780653, 11.892224669370039, -0.12280017068763053}},
};

/* The directions are rounded: at 60 degrees u / s^2 = 75 makes some 1e-13 of it. */
static void derivatives_of_shapes_are_those_of_their_formulas(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {0, 1};
    for (size_t i = 0; i < ROWS(references); i++) {
        const reference *r = &references[i];
        double direction[3];
        aspect(r->deg, direction);
        for (int big = 0; big < 2; big++) {
            double area = big ? 64 : 1;
            outcome got = run_with(shape_prepare(&r->shape, &r->brdf, NULL, big ? 8 : 1), direction,
                                   LRCS_METHOD_AUTO, &how);
            double most = r->shape.kind == LRCS_SHAPE_PLATE ? 1e-12 : 1e-9;
            check_rel(got.d[0].dA, area * r->d[0], 1e-12);
            check_rel(got.d[0].dB, area * r->d[1], 1e-12);
            check_abs(got.d[0].ds, area * r->d[2], most * area * r->d[2] + 1e-50);
            check_abs(got.d[0].dm, area * r->d[3], most * area * fabs(r->d[3]) + 1e-50);
        }
    }
}

static void glint_and_diffuse_are_amplitudes_times_their_derivatives(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {0, 1};
    for (size_t i = 0; i < ROWS(references); i++) {
        const reference *r = &references[i];
        double direction[3];
        aspect(r->deg, direction);
        outcome got = run_with(shape_prepare(&r->shape, &r->brdf, NULL, 1), direction,
                               LRCS_METHOD_AUTO, &how);
        check_rel(r->brdf.A * got.d[0].dA, got.result.sigma_glint_m2, 1e-13);
        check_rel(r->brdf.B * got.d[0].dB, got.result.sigma_diffuse_m2, 1e-13);
    }
}

/* A term of amplitude 0 has the derivative of amplitude 1, and none in its shape; without slope
   there is no glint. */
static void limits_of_absent_terms_and_of_no_slope(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {0, 1};
    const lrcs_shape plate = PLATE;
    const lrcs_shape ball = SPHERE;
    const lrcs_brdf absent = {0, 0, 0.2, 0.5};
    const lrcs_brdf flat = {0, 0.25, 0, 0};
    double direction[3];
    aspect(20, direction);
    outcome got =
        run_with(shape_prepare(&plate, &absent, NULL, 1), direction, LRCS_METHOD_AUTO, &how);
    check_rel(got.d[0].dA, references[1].d[0], 1e-12);
    check_rel(got.d[0].dB, references[1].d[1], 1e-12);
    check_same(got.d[0].ds, 0.0);
    check_same(got.d[0].dm, 0.0);
    got = run_with(shape_prepare(&plate, &flat, NULL, 1), direction, LRCS_METHOD_AUTO, &how);
    check_same(got.d[0].dA, 0.0);
    check_same(got.d[0].ds, 0.0);
    check_rel(got.d[0].dm, references[3].d[3], 1e-12);
    const double normal[3] = {0, 0, 1};
    got = run_with(shape_prepare(&ball, &flat, NULL, 1), normal, LRCS_METHOD_AUTO, &how);
    check_same(got.d[0].dA, 0.0);
    check_same(got.d[0].ds, 0.0);
}

/* --- facets under shadow, and curved normals -------------------------------------------------- */

static test_scene scene;

/* A box before a two-sided plate, two materials. */
static void shadowed_scene(void)
{
    static const double low[3] = {-0.3, -0.2, 0.5};
    static const double high[3] = {0.4, 0.3, 0.9};
    static const double corner[3] = {-1, -1, 0};
    static const double u[3] = {2, 0.1, 0.2};
    static const double v[3] = {0, 2, -0.1};
    scene_start(&scene);
    scene_material(&scene, 1.5, 0.2, 0.3, 0.7);
    scene.material[0].two_sided = 1;
    scene.assigned = 0;
    scene_plate(&scene, corner, u, v);
    scene.assigned = 1;
    scene_box(&scene, low, high);
    scene.material[1].brdf = (lrcs_brdf){0.5, 0.3, 0.25, 2};
}

static double sigma_of(const double direction[3], int method)
{
    return scene_run(&scene, direction, method, 256).sigma_m2;
}

static double *parameter(lrcs_brdf *brdf, int i)
{
    return i == 0 ? &brdf->A : i == 1 ? &brdf->B : i == 2 ? &brdf->s : &brdf->m;
}

/* Central differences of runs, order 4: their own error is some 1e-9 of sigma. */
static void derivatives_under_shadow_are_differences_of_runs(void **state)
{
    (void)state;
    static const int method[] = {LRCS_METHOD_EXACT, LRCS_METHOD_ZBUFFER, LRCS_METHOD_FACET};
    static const double directions[][3] = {{0.2, 0.1, 1}, {-0.7, 0.3, 0.6}, {0.5, -0.2, -1}};
    const lrcs_uncertainty_options how = {0, 1};
    for (size_t j = 0; j < ROWS(method); j++) {
        const double *direction = directions[j];
        int by = method[j];
        lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
        lrcs_run_options options = lrcs_run_options_default();
        lrcs_pose pose;
        outcome got;
        shadowed_scene();
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        options.method = by;
        options.resolution = 256;
        assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
        work = lrcs_work_make(run_area, sizeof run_area);
        assert_int_equal(lrcs_uncertainty_run(prepared, &pose, &options, &how, &work, &got.result,
                                              got.d, &got.u),
                         LRCS_OK);
        for (int i = 0; i < 8; i++) {
            double d[4] = {0, 0, 0, 0};
            for (int k = -2; k <= 2; k++) {
                shadowed_scene();
                double *p = parameter(&scene.material[i / 4].brdf, i % 4);
                double step = 1e-3 * *p;
                *p += k * step;
                double sigma = sigma_of(direction, by);
                d[0] += (k == -2   ? 1
                         : k == -1 ? -8
                         : k == 1  ? 8
                         : k == 2  ? -1
                                   : 0) *
                        sigma / 12 / step;
            }
            const lrcs_sensitivity *at = &got.d[i / 4];
            double is = i % 4 == 0 ? at->dA : i % 4 == 1 ? at->dB : i % 4 == 2 ? at->ds : at->dm;
            check_abs(is, d[0], 1e-8 * (fabs(d[0]) + got.result.sigma_m2));
        }
    }
}

/* Over curved normals: the difference of two cubatures is off by what they are, 1e-5 of sigma over
   the step. */
static void derivatives_over_curved_normals_are_differences_of_runs(void **state)
{
    (void)state;
    static char text[CURVED_TEXT];
    static const double directions[][3] = {{1, 0.2, 0}, {0.6, 0.5, 0.7}, {0.3, 1, -0.2}};
    const lrcs_uncertainty_options how = {0, 1};
    curved_cylinder(text, 16, 0.5, 2, 'v');
    for (size_t j = 0; j < ROWS(directions); j++) {
        for (int i = 0; i < 4; i++) {
            double end[2];
            double step = 0;
            curved_case c = curved_obj(text);
            for (int k = 0; k < 2; k++) {
                c.brdf = (lrcs_brdf){1, 0.25, 0.15, 0.8};
                c.tolerance = 1e-6;
                step = 0.02 * *parameter(&c.brdf, i);
                *parameter(&c.brdf, i) += k == 0 ? -step : step;
                curved_build(&c, LRCS_NORMALS_SMOOTH);
                end[k] = curved_run(&c, directions[j], LRCS_METHOD_AUTO, 0).sigma_m2;
            }
            c.brdf = (lrcs_brdf){1, 0.25, 0.15, 0.8};
            curved_build(&c, LRCS_NORMALS_SMOOTH);
            outcome got = run_with(c.prepared, directions[j], LRCS_METHOD_AUTO, &how);
            double want = (end[1] - end[0]) / (2 * step);
            double is = i == 0   ? got.d[0].dA
                        : i == 1 ? got.d[0].dB
                        : i == 2 ? got.d[0].ds
                                 : got.d[0].dm;
            assert_true(got.result.curvature_estimate_m2 >= 0);
            check_abs(is, want, 3e-3 * fabs(want) + 1e-4 * got.result.sigma_m2);
            curved_free(&c);
        }
    }
}

/* A ball and a cylinder that partly hide each other, before a plate: a wall counts with the mean
   over its true surface, and so do its derivatives. The facets are those of one division. */
static void derivatives_over_walls_are_differences_of_runs(void **state)
{
    (void)state;
    static const double directions[][3] = {{0.9, 0.2, 0.3}, {0.1, -0.3, 1}};
    static const int method[] = {LRCS_METHOD_EXACT, LRCS_METHOD_FACET};
    const lrcs_uncertainty_options how = {0, 1};
    const lrcs_build_options build = {1e-3, 250, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_recipe_part part[3];
    for (int i = 0; i < 3; i++) {
        part[i] = (lrcs_recipe_part){
            .name = "", .place = lrcs_place_default(), .material = i == 1 ? "b" : "a"};
        part[i].material_index = i == 1;
    }
    part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 0.4, .length = 1.5};
    part[1].place.translate[0] = -1;
    part[1].place.translate[2] = -0.25;
    part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {2, 2}};
    part[2].place.translate[2] = -0.5;
    lrcs_recipe_material material[2] = {{.name = "a", .brdf = {1, 0.25, 0.3, 0.5}},
                                        {.name = "b", .brdf = {0.5, 0.3, 0.25, 2}}};
    const lrcs_recipe recipe = {
        .part = part, .part_count = 3, .material = material, .material_count = 2};
    lrcs_scene walls;
    lrcs_work base = lrcs_work_make(scene_area, sizeof scene_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &base, &walls, NULL), LRCS_OK);
    for (size_t j = 0; j < ROWS(method); j++) {
        const double *direction = directions[j];
        int by = method[j];
        outcome got[5];
        for (int i = 0; i < 8; i++) {
            double slope = 0;
            double step = 0;
            for (int k = 0; k < 5; k++) { /* the middle last, the others to either side */
                static const int at[] = {-2, -1, 1, 2, 0};
                static const int weight[] = {1, -8, 8, -1, 0};
                lrcs_material changed[4];
                lrcs_scene other = walls;
                assert_true(walls.material_count <= 4);
                memcpy(changed, walls.material, walls.material_count * sizeof *changed);
                other.material = changed;
                uint32_t which = 0;
                while (strcmp(changed[which].name, i < 4 ? "a" : "b") != 0) {
                    which++;
                }
                double *p = parameter(&changed[which].brdf, i % 4);
                step = 1e-3 * *p;
                *p += at[k] * step;
                const lrcs_prepared *prepared;
                lrcs_work work = base;
                assert_int_equal(lrcs_prepare_run(&other, &work, &prepared), LRCS_OK);
                got[k] = run_with(prepared, direction, by, &how);
                slope += weight[k] * got[k].result.sigma_m2 / 12 / step;
                if (at[k] == 0) {
                    const lrcs_sensitivity *d = &got[k].d[which];
                    double is = i % 4 == 0   ? d->dA
                                : i % 4 == 1 ? d->dB
                                : i % 4 == 2 ? d->ds
                                             : d->dm;
                    check_abs(is, slope, 1e-7 * (fabs(slope) + got[k].result.sigma_m2));
                    assert_true(is != 0);
                }
            }
        }
    }
}

/* Terms that a wall's material lacks: the derivative in an amplitude of 0 is that in a small one,
   and there is none where there is no slope. A ball before a plate that is seen in part, and a ball
   that nothing hides. */
static void absent_terms_of_walls_have_the_derivatives_of_small_ones(void **state)
{
    (void)state;
    static const lrcs_brdf lacking[] = {
        {0, 0.25, 0.3, 0.5}, {1, 0, 0.3, 0.5}, {0, 0.25, 1e-4, 0.5}, {0, 0.25, 0, 0.5}};
    static const int method[] = {LRCS_METHOD_EXACT, LRCS_METHOD_AUTO};
    const double direction[3] = {0.9, 0.2, 0.3};
    const lrcs_uncertainty_options how = {0, 1};
    const lrcs_build_options build = {1e-3, 500, LRCS_NORMALS_FLAT, 1, 0, NULL};
    for (size_t i = 0; i < 2 * ROWS(lacking); i++) {
        outcome got[2];
        double small = 1e-3;
        int glint = lacking[i / 2].A == 0;
        for (int k = 0; k < 2; k++) {
            lrcs_recipe_part part[4];
            lrcs_recipe_material material = {.name = "a", .brdf = lacking[i / 2]};
            *(glint ? &material.brdf.A : &material.brdf.B) = k * small;
            material.brdf.s = k == 1 && material.brdf.s == 0 ? 1e-3 : material.brdf.s;
            for (int n = 0; n < 4; n++) {
                part[n] =
                    (lrcs_recipe_part){.name = "", .place = lrcs_place_default(), .material = "a"};
                part[n].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
            }
            part[1].place.translate[0] = -1;
            part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {2, 2}};
            part[2].place.translate[2] = -0.5;
            part[3].place.translate[1] = 9;
            const lrcs_recipe recipe = {
                .part = part, .part_count = 4, .material = &material, .material_count = 1};
            lrcs_scene walls;
            const lrcs_prepared *prepared;
            lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
            assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &walls, NULL), LRCS_OK);
            assert_int_equal(lrcs_prepare_run(&walls, &work, &prepared), LRCS_OK);
            got[k] = run_with(prepared, direction, method[i % 2], &how);
        }
        double is = glint ? got[0].d[0].dA : got[0].d[0].dB;
        double next = glint ? got[1].d[0].dA : got[1].d[0].dB;
        if (lacking[i / 2].s > 0.01) { /* a facet at the limb may have a mean in one of them only */
            check_rel(is, next, 1e-2);
            assert_true(is > 0);
        } else if (lacking[i / 2].s == 0) {
            check_same(is, 0);
        } else {
            assert_true(is >= 0 && isfinite(is));
        }
        check_same(glint ? got[0].d[0].ds : got[0].d[0].dm, 0);
        check_rel(got[0].d[0].dB * lacking[i / 2].B, got[0].result.sigma_diffuse_m2, 1e-12);
        check_rel(got[0].d[0].dA * lacking[i / 2].A, got[0].result.sigma_glint_m2, 1e-12);
    }
}

/* A plate stored twice counts once, and one that the laser sees from 1e-200 rad off its plane not
   at all: without a search for shadows too. */
static void redundant_and_edge_on_facets_have_no_derivatives(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {0, 1};
    double once = 0;
    for (int i = 0; i < 4; i++) {
        lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
        scene_start(&scene);
        for (int k = 0; k <= i % 2; k++) {
            scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                        (const double[3]){0, 1, 0});
        }
        const double above[3] = {0.2, 0.1, 1};
        const double aside[3] = {1, 0, 1e-200};
        outcome got =
            run_with(scene_prepare(&scene, &work), i / 2 ? aside : above, LRCS_METHOD_FACET, &how);
        once = i == 0 ? got.d[0].dA : once;
        check_same(got.d[0].dA, i / 2 ? 0 : once);
        check_abs(got.d[0].dB * 0.25, got.result.sigma_diffuse_m2, 1e-15 * got.result.sigma_m2);
        assert_true(isfinite(got.d[0].ds) && isfinite(got.d[0].dm));
    }
}

/* With curved normals each node is a pose of its own: the sample against the same distribution put
   together from runs at other slopes; and with a material that has no slope, beside. */
static void over_curved_normals_the_sample_is_that_of_runs(void **state)
{
    (void)state;
    static char text[CURVED_TEXT];
    const lrcs_uncertainty_options how = {1u << 16, 5};
    const double direction[3] = {1, 0.2, 0.05};
    const lrcs_brdf own = {1, 0.05, 0.3, 0.8};
    curved_cylinder(text, 12, 0.5, 2, 'v');
    curved_case c = curved_obj(text);
    c.tolerance = 1e-5;
    double sums[3] = {0, 0, 0};
    for (int k = -16; k <= 16; k++) {
        double z = k * 0.25;
        double weight = exp(-z * z / 2);
        c.brdf = own;
        c.brdf.s = fmax(own.s / 16, own.s + 0.04 * z);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        double sigma = curved_run(&c, direction, LRCS_METHOD_AUTO, 0).sigma_m2;
        sums[0] += weight;
        sums[1] += weight * sigma;
        sums[2] += weight * sigma * sigma;
        free(c.built);
        free(c.kept);
        c.built = c.kept = NULL;
    }
    double mean = sums[1] / sums[0];
    double deviation = sqrt(sums[2] / sums[0] - mean * mean);
    c.brdf = own;
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    lrcs_scene uncertain = c.scene;
    lrcs_material material[8];
    assert_true(uncertain.material_count <= 8);
    memcpy(material, uncertain.material, uncertain.material_count * sizeof *material);
    for (uint32_t i = 0; i < uncertain.material_count; i++) {
        material[i].error = (lrcs_brdf_error){.s = 0.04};
    }
    uncertain.material = material;
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared;
    assert_int_equal(lrcs_prepare_run(&uncertain, &work, &prepared), LRCS_OK);
    outcome got = run_with(prepared, direction, LRCS_METHOD_AUTO, &how);
    check_rel(got.u.sample_mean_m2, mean, 0.01);
    check_rel(got.u.sample_m2, deviation, 0.03);
    const lrcs_run_options options = lrcs_run_options_default();
    size_t need = lrcs_uncertainty_need(prepared, &options, &how);
    int before = LRCS_E_MEMORY; /* it ends in a later node, or before */
    for (size_t size = need / 2; size <= need; size += need / 40) {
        outcome less = got;
        work = lrcs_work_make(run_area, size);
        int status = try_run(prepared, direction, LRCS_METHOD_AUTO, &how, &work, &less);
        assert_true(status == LRCS_OK || (status == LRCS_E_MEMORY && before != LRCS_OK));
        before = status;
    }
    curved_free(&c);
    c = curved_obj(text);
    c.brdf = (lrcs_brdf){0, 0.25, 0, 0.8};
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    outcome flat = run_with(c.prepared, direction, LRCS_METHOD_AUTO, &how);
    check_same(flat.d[0].dA, 0);
    check_rel(0.25 * flat.d[0].dB, flat.result.sigma_m2, 1e-6);
    curved_free(&c);
}

/* A little curvature moves the mean by more than a tenth of the deviation, which it leaves as it
   is: then too the sample is reported. */
static void a_mean_that_is_off_is_reported_too(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {1u << 16, 3};
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {1, 0, 0.2, 0};
    const lrcs_brdf_error error = {.s = 0.0038};
    double direction[3];
    aspect(30, direction);
    outcome got =
        run_with(shape_prepare(&plate, &brdf, &error, 1), direction, LRCS_METHOD_AUTO, &how);
    check_rel(got.u.first_order_m2, got.u.sample_m2, 0.05);
    assert_true(got.u.sample_mean_m2 - got.result.sigma_m2 > 0.1 * got.u.sample_m2);
    assert_int_equal(got.u.sampled, 1);
    check_same(got.u.deviation_m2, got.u.sample_m2);
}

/* Shapes that nothing hides: a plate that faces away reflects nothing, whatever its material; so
   does a glint of next to no width off its normal. */
static void clear_shapes_that_show_nothing_have_no_derivatives(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {0, 1};
    const lrcs_shape plate = PLATE;
    const lrcs_shape ball = SPHERE;
    const lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    const lrcs_brdf narrow = {1, 0.25, 0x1p-340, 0.5};
    const double below[3] = {0.1, 0, -1};
    outcome got = run_with(shape_prepare(&plate, &brdf, NULL, 1), below, LRCS_METHOD_AUTO, &how);
    check_same(got.d[0].dA, 0);
    check_same(got.d[0].dB, 0);
    check_same(got.d[0].ds, 0);
    check_same(got.d[0].dm, 0);
    got = run_with(shape_prepare(&ball, &narrow, NULL, 1), below, LRCS_METHOD_AUTO, &how);
    check_same(got.d[0].ds, 0);
    check_rel(0.25 * got.d[0].dB, got.result.sigma_diffuse_m2, 1e-13);
}

static void the_result_is_that_of_the_pose_alone(void **state)
{
    (void)state;
    static const double direction[3] = {-0.7, 0.3, 0.6};
    const lrcs_uncertainty_options how = {64, 3};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    shadowed_scene();
    lrcs_result alone = scene_run(&scene, direction, LRCS_METHOD_AUTO, 0);
    scene.material[0].error = (lrcs_brdf_error){.A = 0.5, .s = 0.1};
    outcome got = run_with(scene_prepare(&scene, &work), direction, LRCS_METHOD_AUTO, &how);
    check_same(got.result.sigma_m2, alone.sigma_m2);
    check_same(got.result.bound_m2, alone.bound_m2); /* errors are no part of it */
    assert_true(got.u.deviation_m2 > 0);
}

/* --- uncertainty ------------------------------------------------------------------------------ */

static void without_errors_there_is_no_uncertainty(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const double direction[3] = {0.2, 0.1, 1};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    shadowed_scene();
    outcome got = run_with(scene_prepare(&scene, &work), direction, LRCS_METHOD_AUTO, &how);
    assert_int_equal(got.u.stated, 0);
    check_same(got.u.deviation_m2, 0.0);
}

/* sigma is linear in A and B: the deviation is exact, the sample agrees, and first order is
   reported. */
static void first_order_is_the_square_root_of_g_c_g(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    const lrcs_brdf_error error = {.A = 0.1, .B = 0.01, .correlation = {-0.6}};
    double direction[3];
    aspect(20, direction);
    outcome got =
        run_with(shape_prepare(&plate, &brdf, &error, 1), direction, LRCS_METHOD_AUTO, &how);
    double a = 0.1 * references[1].d[0];
    double b = 0.01 * references[1].d[1];
    check_rel(got.u.deviation_m2, sqrt(a * a + b * b - 1.2 * a * b), 1e-12);
    assert_int_equal(got.u.sampled, 0);
    check_rel(got.u.low_m2, got.result.sigma_m2 - got.u.deviation_m2, 1e-12);
    check_rel(got.u.high_m2, got.result.sigma_m2 + got.u.deviation_m2, 1e-12);
    check_rel(got.u.sample_m2, got.u.first_order_m2, 0.05);
}

/* The same numbers from one source move together, from two they do not. */
static void materials_of_one_source_are_off_together(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const double direction[3] = {0.2, 0.1, 1};
    for (int shared = 0; shared < 2; shared++) {
        lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
        shadowed_scene();
        scene.material[1].brdf = scene.material[0].brdf;
        scene.material[0].error = scene.material[1].error = (lrcs_brdf_error){.B = 0.02};
        scene.material[0].source = 5;
        scene.material[1].source = shared ? 5 : 6;
        outcome got = run_with(scene_prepare(&scene, &work), direction, LRCS_METHOD_EXACT, &how);
        double a = 0.02 * got.d[0].dB;
        double b = 0.02 * got.d[1].dB;
        assert_true(a > 0 && b > 0);
        check_rel(got.u.first_order_m2, shared ? a + b : sqrt(a * a + b * b), 1e-12);
        check_rel(got.u.sample_m2, got.u.first_order_m2, 0.05);
    }
}

/* A glint on its flank is far from linear in s: the sample against the quadrature of the same
   distribution, by Gauss-like sums over a fine grid of s. */
static void where_sigma_bends_the_sample_is_reported_and_right(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {1u << 18, 7};
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {1, 0, 0.2, 0};
    const lrcs_brdf_error error = {.s = 0.06};
    double direction[3];
    aspect(30, direction);
    outcome got =
        run_with(shape_prepare(&plate, &brdf, &error, 1), direction, LRCS_METHOD_AUTO, &how);
    double u = 1.0 / 3;
    double sums[3] = {0, 0, 0};
    for (int k = -4000; k <= 4000; k++) {
        double z = k * 1e-3;
        double s = fmax(0.2 / 16, 0.2 + 0.06 * z);
        double sigma = 4 * CURVED_PI * (1 + u) * (1 + u) * exp(-u / s / s);
        double weight = exp(-z * z / 2);
        sums[0] += weight;
        sums[1] += weight * sigma;
        sums[2] += weight * sigma * sigma;
    }
    double mean = sums[1] / sums[0];
    assert_int_equal(got.u.sampled, 1);
    check_rel(got.u.sample_mean_m2, mean, 0.02);
    check_rel(got.u.deviation_m2, sqrt(sums[2] / sums[0] - mean * mean), 0.03);
    /* sigma grows with s: its quantiles are at one deviation of s */
    check_rel(got.u.low_m2, 4 * CURVED_PI * 16 / 9 * exp(-u / 0.14 / 0.14), 0.1);
    check_rel(got.u.high_m2, 4 * CURVED_PI * 16 / 9 * exp(-u / 0.26 / 0.26), 0.02);
}

/* Only the diffuse exponent is uncertain: sigma varies as cos(theta)^m, nearly linear in m over so
   small an error. */
static void an_error_of_m_alone_is_first_order_and_sampled(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    const lrcs_brdf_error error = {.m = 0.01};
    double direction[3];
    aspect(60, direction);
    outcome got =
        run_with(shape_prepare(&plate, &brdf, &error, 1), direction, LRCS_METHOD_AUTO, &how);
    check_rel(got.u.first_order_m2, 0.01 * fabs(references[2].d[3]), 1e-12);
    check_rel(got.u.sample_m2, got.u.first_order_m2, 0.05);
}

/* The derivatives and the first order are those of a run with a sample, to the bit. */
static void without_draws_the_first_order_is_reported(void **state)
{
    (void)state;
    const lrcs_uncertainty_options draws[2] = {{0, 1}, {4096, 1}};
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {1, 0, 0.2, 0};
    const lrcs_brdf_error error = {.s = 0.06};
    double direction[3];
    outcome got[2];
    aspect(30, direction);
    for (int i = 0; i < 2; i++) {
        got[i] = run_with(shape_prepare(&plate, &brdf, &error, 1), direction, LRCS_METHOD_AUTO,
                          &draws[i]);
    }
    assert_int_equal(got[0].u.sampled, 0);
    assert_int_equal(got[1].u.sampled, 1);
    check_same(got[0].d[0].ds, got[1].d[0].ds);
    check_same(got[0].u.first_order_m2, got[1].u.first_order_m2);
    check_same(got[0].u.deviation_m2, got[0].u.first_order_m2);
    assert_true(got[0].u.first_order_m2 > 0);
}

/* A term that a run leaves out has no derivatives; those of the other term stay. */
static void terms_left_out_have_no_derivatives(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const lrcs_shape plate = PLATE;
    double direction[3];
    lrcs_pose pose;
    aspect(20, direction);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    for (int glint = 0; glint < 2; glint++) {
        lrcs_run_options options = lrcs_run_options_default();
        outcome got;
        options.without = 1u << (glint ? LRCS_EFFECT_DIFFUSE : LRCS_EFFECT_GLINT);
        const lrcs_prepared *prepared = shape_prepare(&plate, &references[1].brdf, NULL, 1);
        lrcs_work work = lrcs_work_make(run_area, sizeof run_area);
        assert_int_equal(lrcs_uncertainty_run(prepared, &pose, &options, &how, &work, &got.result,
                                              got.d, &got.u),
                         LRCS_OK);
        const double *want = references[1].d;
        check_rel(got.d[0].dA, glint ? want[0] : 0, 1e-12);
        check_rel(got.d[0].dB, glint ? 0 : want[1], 1e-12);
        check_rel(got.d[0].ds, glint ? want[2] : 0, 1e-12);
        check_rel(got.d[0].dm, glint ? 0 : want[3], 1e-12);
    }
}

static void a_failed_run_leaves_outputs_alone(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const lrcs_run_options options = lrcs_run_options_default();
    const lrcs_shape plate = PLATE;
    const lrcs_pose nowhere = {.direction = {NAN, 0, 1}};
    outcome got;
    memset(&got, 0x5a, sizeof got);
    const outcome before = got;
    const lrcs_prepared *prepared = shape_prepare(&plate, &references[0].brdf, NULL, 1);
    lrcs_work work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(
        lrcs_uncertainty_run(prepared, &nowhere, &options, &how, &work, &got.result, got.d, &got.u),
        LRCS_E_NUMBER);
    assert_memory_equal(&got, &before, sizeof got);
    assert_true(work.used == 0);
}

static void draws_stay_in_the_domain(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {4096, 1};
    const lrcs_shape ball = SPHERE;
    const lrcs_brdf brdf = {0.01, 0.01, 0.05, 0.05};
    const lrcs_brdf_error error = {1, 1, 1, 1, {0}};
    const double direction[3] = {0, 0, 1};
    outcome got =
        run_with(shape_prepare(&ball, &brdf, &error, 1), direction, LRCS_METHOD_AUTO, &how);
    assert_int_equal(got.u.sampled, 1);
    assert_true(got.u.low_m2 >= 0 && got.u.low_m2 < got.u.high_m2);
    assert_true(isfinite(got.u.high_m2) && got.u.high_m2 < 100);
    assert_true(got.u.sample_mean_m2 > 0);
}

static void a_seed_gives_one_sample(void **state)
{
    (void)state;
    const lrcs_shape ball = SPHERE;
    const lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    const lrcs_brdf_error error = {0.1, 0.02, 0.05, 0.2, {0.1, -0.5, 0, 0, 0.3, 0}};
    const double direction[3] = {0, 0, 1};
    double got[3];
    for (int i = 0; i < 3; i++) {
        const lrcs_uncertainty_options how = {1000, i == 2 ? 2 : 1};
        got[i] = run_with(shape_prepare(&ball, &brdf, &error, 1), direction, LRCS_METHOD_AUTO, &how)
                     .u.sample_m2;
    }
    check_same(got[0], got[1]);
    assert_true(got[0] != got[2]);
    check_rel(got[2], got[0], 0.15);
}

/* Correlations of 1 and -1 are a matrix of rank 1. */
static void full_correlation_is_one_deviate(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {4096, 1};
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {1, 1, 0.2, 0};
    const lrcs_brdf_error error = {.A = 0.1, .B = 0.1, .correlation = {-1, 0, 0, 0, 0, 0}};
    const double normal[3] = {0, 0, 1};
    outcome got = run_with(shape_prepare(&plate, &brdf, &error, 1), normal, LRCS_METHOD_AUTO, &how);
    check_abs(got.u.first_order_m2, 0, 1e-7);
    check_abs(got.u.sample_m2, 0, 1e-7);
}

static void errors_outside_their_range_are_refused(void **state)
{
    (void)state;
    const lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    const lrcs_brdf flat = {0, 0.25, 0, 0.5};
    static const lrcs_brdf_error bad[] = {{.A = -1},
                                          {.m = (double)INFINITY},
                                          {.B = (double)NAN},
                                          {.correlation = {1.5}},
                                          {.correlation = {0.9, 0.9, 0, -0.9}}};
    for (size_t i = 0; i < ROWS(bad); i++) {
        assert_int_equal(lrcs_brdf_error_check(&brdf, &bad[i]), LRCS_E_NUMBER);
    }
    const lrcs_brdf_error slope = {.s = 0.1};
    const lrcs_brdf_error fair = {0.1, 0.1, 0.1, 0.1, {0.9, 0.9, 0, 0.9, 0, 0}};
    assert_int_equal(lrcs_brdf_error_check(&flat, &slope), LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_brdf_error_check(&brdf, &fair), LRCS_OK);
}

static void the_need_serves_and_less_leaves_outputs_alone(void **state)
{
    (void)state;
    const lrcs_uncertainty_options how = {512, 1};
    const lrcs_run_options options = lrcs_run_options_default();
    const double direction[3] = {-0.7, 0.3, 0.6};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    outcome got;
    outcome before;
    shadowed_scene();
    scene.material[0].error = (lrcs_brdf_error){.A = 0.5, .s = 0.1};
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    size_t need = lrcs_uncertainty_need(prepared, &options, &how);
    memset(&before, 0x5a, sizeof before);
    for (size_t size = 0; size <= need; size += need / 64 + 1) {
        got = before;
        work = lrcs_work_make(run_area, size);
        int status = try_run(prepared, direction, LRCS_METHOD_AUTO, &how, &work, &got);
        assert_true(status == LRCS_OK || status == LRCS_E_MEMORY);
        assert_true(status == LRCS_OK || memcmp(&got, &before, sizeof got) == 0);
    }
    work = lrcs_work_make(run_area, need);
    assert_int_equal(try_run(prepared, direction, LRCS_METHOD_AUTO, &how, &work, &got), LRCS_OK);
    assert_int_equal(got.result.flags, 0);
    const lrcs_uncertainty_options one = {1, 1};
    got = before;
    assert_int_equal(try_run(prepared, direction, LRCS_METHOD_AUTO, &one, &work, &got),
                     LRCS_E_ARGUMENT);
    assert_memory_equal(&got, &before, sizeof got);
    const lrcs_uncertainty_options many = {(1u << 20) + 1, 1};
    assert_int_equal(try_run(prepared, direction, LRCS_METHOD_AUTO, &many, &work, &got),
                     LRCS_E_ARGUMENT);
    assert_int_equal(try_run(prepared, direction, -1, &how, &work, &got), LRCS_E_ARGUMENT);
    scene.material[0].error.s = -1;
    assert_int_equal(try_run(prepared, direction, LRCS_METHOD_AUTO, &how, &work, &got),
                     LRCS_E_NUMBER);
    assert_memory_equal(&got, &before, sizeof got);
}

static outcome limited;
static const lrcs_prepared *limited_scene;
static const lrcs_uncertainty_options limited_how = {64, 1};

static int run_limited(lrcs_work *work)
{
    static const double direction[3] = {-0.7, 0.3, 0.6};
    return try_run(limited_scene, direction, LRCS_METHOD_FACET, &limited_how, work, &limited);
}

static void the_work_area_grows_until_it_suffices(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_FACET;
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    shadowed_scene();
    scene.material[0].error = (lrcs_brdf_error){.A = 0.5, .s = 0.1};
    limited_scene = scene_prepare(&scene, &work);
    check_memory_limit(MEMORY_CASE("lrcs_uncertainty_run",
                                   lrcs_uncertainty_need(limited_scene, &options, &limited_how),
                                   run_limited, limited, 0));
}

/* --- attitude --------------------------------------------------------------------------------- */

/* sigma of a plate turned by deg about y: 4 pi cos^2 f_r. Turning the body by +1 deg about the
   view's y axis takes the normal from theta to theta - 1 deg where the laser stands on that side.
 */
static void attitude_slopes_of_a_plate(void **state)
{
    (void)state;
    const lrcs_shape plate = PLATE;
    const lrcs_brdf brdf = {0, 0.25, 0.2, 1};
    const lrcs_run_options options = lrcs_run_options_default();
    lrcs_attitude_slope slope;
    lrcs_pose pose;
    double direction[3];
    aspect(40, direction);
    const lrcs_prepared *prepared = shape_prepare(&plate, &brdf, NULL, 1);
    lrcs_work work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcs_attitude_slope_run(prepared, &pose, &options, &work, &slope), LRCS_OK);
    /* d/d theta of pi cos^3 theta, per degree */
    double a = 40 * CURVED_PI / 180;
    double want = 3 * CURVED_PI * cos(a) * cos(a) * sin(a) * CURVED_PI / 180;
    check_abs(slope.per_deg_m2[0], 0, slope.bound_m2[0] + 2 * slope.estimate_m2[0]);
    check_rel(fabs(slope.per_deg_m2[1]), want, 1e-6);
    assert_true(fabs(fabs(slope.per_deg_m2[1]) - want) <= slope.bound_m2[1] + slope.estimate_m2[1]);
    /* v_obs' = Ry(d) v_obs: the normal stands at x = -sin 40 deg in the view, and x' = x + d z */
    assert_true(pose.R[0][2] < 0 && slope.per_deg_m2[1] > 0);
}

static void attitude_slopes_want_a_run_that_succeeds(void **state)
{
    (void)state;
    const lrcs_run_options options = lrcs_run_options_default();
    const lrcs_pose nowhere = {.direction = {NAN, 0, 1}};
    lrcs_attitude_slope slope;
    memset(&slope, 0x5a, sizeof slope);
    const lrcs_attitude_slope before = slope;
    double direction[3];
    lrcs_pose pose;
    aspect(40, direction);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    shadowed_scene();
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    work = lrcs_work_make(run_area, sizeof run_area);
    assert_true(lrcs_attitude_slope_run(prepared, &nowhere, &options, &work, &slope) < 0);
    work = lrcs_work_make(run_area, 64);
    assert_int_equal(lrcs_attitude_slope_run(prepared, &pose, &options, &work, &slope),
                     LRCS_E_MEMORY);
    assert_memory_equal(&slope, &before, sizeof slope);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_of_shapes_are_those_of_their_formulas),
        cmocka_unit_test(glint_and_diffuse_are_amplitudes_times_their_derivatives),
        cmocka_unit_test(limits_of_absent_terms_and_of_no_slope),
        cmocka_unit_test(derivatives_under_shadow_are_differences_of_runs),
        cmocka_unit_test(derivatives_over_curved_normals_are_differences_of_runs),
        cmocka_unit_test(derivatives_over_walls_are_differences_of_runs),
        cmocka_unit_test(absent_terms_of_walls_have_the_derivatives_of_small_ones),
        cmocka_unit_test(redundant_and_edge_on_facets_have_no_derivatives),
        cmocka_unit_test(over_curved_normals_the_sample_is_that_of_runs),
        cmocka_unit_test(a_mean_that_is_off_is_reported_too),
        cmocka_unit_test(clear_shapes_that_show_nothing_have_no_derivatives),
        cmocka_unit_test(the_result_is_that_of_the_pose_alone),
        cmocka_unit_test(without_errors_there_is_no_uncertainty),
        cmocka_unit_test(first_order_is_the_square_root_of_g_c_g),
        cmocka_unit_test(materials_of_one_source_are_off_together),
        cmocka_unit_test(where_sigma_bends_the_sample_is_reported_and_right),
        cmocka_unit_test(an_error_of_m_alone_is_first_order_and_sampled),
        cmocka_unit_test(without_draws_the_first_order_is_reported),
        cmocka_unit_test(terms_left_out_have_no_derivatives),
        cmocka_unit_test(a_failed_run_leaves_outputs_alone),
        cmocka_unit_test(draws_stay_in_the_domain),
        cmocka_unit_test(a_seed_gives_one_sample),
        cmocka_unit_test(full_correlation_is_one_deviate),
        cmocka_unit_test(errors_outside_their_range_are_refused),
        cmocka_unit_test(the_need_serves_and_less_leaves_outputs_alone),
        cmocka_unit_test(the_work_area_grows_until_it_suffices),
        cmocka_unit_test(attitude_slopes_want_a_run_that_succeeds),
        cmocka_unit_test(attitude_slopes_of_a_plate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
