/* SPDX-License-Identifier: MIT */
/* Round shapes that a straight edge hides in part: a sphere, and a dome and a paraboloid seen along
   their axes. Their sigma is then an integral over one angle, computed here. */
#include <lrcs/lrcs.h>

#include "check.h"
#include "curved.h"
#include "recipe.h"

#define PI 3.14159265358979323846

static double reflect(const lrcs_brdf *b, double cosine)
{
    double tan2 = (1 - cosine) * (1 + cosine) / (cosine * cosine);
    double glint = b->A / (cosine * cosine * cosine * cosine) * exp(-tan2 / (b->s * b->s));
    return glint + b->B * pow(cosine, b->m + 2); /* f_r cos^2 */
}

/* The part of the circle of radius r about the axis that is below y = edge, times 2 pi. */
static double lit_angle(double r, double edge)
{
    return fabs(edge) < r ? PI + 2 * asin(edge / r) : edge > 0 ? 2 * PI : 0;
}

/* The integral of f_r cos over the disc of the given radius, below y = edge; slope: of a paraboloid
   at its rim; 0: a sphere. Gauss's rule of two points on many intervals of r, closer where the
   integrand has a root: at the edge and at the outline. */
static double lit_integral(const lrcs_brdf *brdf, double radius, double slope, double edge)
{
    const int n = 20000;
    const double limit[3] = {0, fmin(fabs(edge), radius), radius};
    double sum = 0;
    for (int part = 0; part < 2; part++) {
        double width = limit[part + 1] - limit[part];
        for (int i = 0; i < 2 * n && width > 0; i++) {
            double t = (i / 2 + 0.5 + (i % 2 ? 0.5 : -0.5) * 0.57735026918962576451) / n;
            double x = t * t * (3 - 2 * t);
            double r = limit[part] + width * x;
            double sine = r / radius;
            double cosine =
                slope > 0 ? 1 / hypot(1, slope * r / radius) : sqrt((1 - sine) * (1 + sine));
            sum += reflect(brdf, cosine) / cosine * lit_angle(r, edge) * r * width *
                   (6 * t * (1 - t)) * 0.5 / n;
        }
    }
    return sum;
}

static lrcs_run_options exact_options(void)
{
    lrcs_run_options run = lrcs_run_options_default();
    run.method = LRCS_METHOD_EXACT;
    run.tolerance = 1e-9;
    return run;
}

/* The shape, and a box in front of it that begins at y = edge, as seen along +z. Prepares them;
   *work: the memory that is left. */
static const lrcs_prepared *half_hidden_prepare(lrcs_shape shape, const double turn[3][3],
                                                double edge, const lrcs_brdf *brdf, uint32_t facets,
                                                lrcs_scene *scene, lrcs_work *work)
{
    lrcs_recipe_part part[2];
    lrcs_recipe_material material[2] = {{.name = "skin", .brdf = *brdf},
                                        {.name = "black", .brdf = {0, 0, 1, 0}}};
    for (int i = 0; i < 2; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material = material[i].name;
        part[i].material_index = i;
    }
    material[0].two_sided = turn[2][2] < 0; /* the inside is seen */
    part[0].shape = shape;
    for (int i = 0; i < 9; i++) {
        part[0].place.rotate[i / 3][i % 3] = turn[i / 3][i % 3];
    }
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {8, 8, 0.25}};
    part[1].place.translate[1] = edge + 4;
    part[1].place.translate[2] = 3;
    const lrcs_recipe recipe = {
        .part = part, .part_count = 2, .material = material, .material_count = 2};
    const lrcs_build_options build = {1e-9, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    return recipe_prepare(&recipe, NULL, &build, scene, work);
}

static lrcs_result half_hidden(lrcs_shape shape, const double turn[3][3], double edge,
                               const lrcs_brdf *brdf, uint32_t facets)
{
    lrcs_scene scene;
    lrcs_work work;
    lrcs_pose pose = lrcs_pose_default();
    lrcs_result result;
    const lrcs_run_options run = exact_options();
    const lrcs_prepared *prepared =
        half_hidden_prepare(shape, turn, edge, brdf, facets, &scene, &work);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &result, NULL, NULL), LRCS_OK);
    return result;
}

static const lrcs_brdf brdfs[3] = {{1, 0.25, 0.3, 0.5}, {0, 1, 1, 0}, {1, 0, 0.15, 0}};

/* 0.6, 0.64, 0.48: a rotation with exact fractions of 125. */
static const double turns[2][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      {{0.6, 0, 0.8}, {0.64, 0.6, -0.48}, {-0.48, 0.8, 0.36}}};

/* From meshes of few facets. The glint of the third material is dark at the outline, so that the
   bound is that of the pieces alone; that of the others includes the facets along the outline. */
static void check_hidden(lrcs_shape shape, double slope, int turn, double most)
{
    static const double edges[3] = {0, 0.25, -0.4};
    for (int i = 0; i < 9; i++) {
        const lrcs_brdf *brdf = &brdfs[i % 3];
        double edge = edges[i / 3];
        double truth = 4 * PI * lit_integral(brdf, shape.radius, slope, edge);
        double whole = 4 * PI * lit_integral(brdf, shape.radius, slope, shape.radius);
        const int finer = i / 3 % 3 == i % 3; /* each material with one edge or two */
        for (uint32_t facets = 2000; facets <= (finer ? 8000 : 2000); facets *= 4) {
            lrcs_result r = half_hidden(shape, turns[turn], edge, brdf, facets);
            assert_int_equal(r.method, LRCS_METHOD_EXACT);
            check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-11 * whole);
            check_most(r.bound_m2, (i % 3 == 2 ? most : 0.01) * whole);
        }
    }
}

static void a_sphere_behind_a_straight_edge(void **state)
{
    (void)state;
    const lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.75};
    check_hidden(sphere, 0, 0, 1e-6);
    check_hidden(sphere, 0, 1, 3e-3); /* the edge passes corners of facets where the glint is */
}

/* Along its axis a dome looks like a sphere. */
static void a_dome_behind_a_straight_edge(void **state)
{
    (void)state;
    const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 0.75};
    check_hidden(dome, 0, 0, 1e-6);
}

static void a_paraboloid_behind_a_straight_edge(void **state)
{
    (void)state;
    const lrcs_shape bowl = {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.75, .length = 0.3};
    check_hidden(bowl, 2 * bowl.length / bowl.radius, 0, 1e-6);
}

/* The narrowest have no means over patches, the next ones remainders that no rule makes small. */
static void the_bound_holds_for_narrow_glints(void **state)
{
    (void)state;
    static const double slopes[4] = {5e-4, 2e-3, 0.01, 0.05};
    static const double edges[2] = {0, 0.02};
    const lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.75};
    for (int i = 0; i < 8; i++) {
        const lrcs_brdf brdf = {1, 0.25, slopes[i % 4], 0.5};
        double truth = 4 * PI * lit_integral(&brdf, sphere.radius, 0, edges[i / 4]);
        double whole = 4 * PI * lit_integral(&brdf, sphere.radius, 0, sphere.radius);
        lrcs_result r = half_hidden(sphere, turns[1], edges[i / 4], &brdf, 2000);
        check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-9 * whole);
    }
}

/* With any work area down to a half of what a run takes, the answer holds or there is none. */
static void with_less_memory_the_bound_holds(void **state)
{
    (void)state;
    const lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.75};
    const lrcs_brdf brdf = {1, 0.25, 0.3, 0.5};
    const lrcs_run_options run = exact_options();
    double truth = 4 * PI * lit_integral(&brdf, sphere.radius, 0, 0.25);
    lrcs_scene scene;
    lrcs_work all;
    lrcs_pose pose = lrcs_pose_default();
    lrcs_result r;
    const lrcs_prepared *prepared =
        half_hidden_prepare(sphere, turns[0], 0.25, &brdf, 600, &scene, &all);
    lrcs_work work = all;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &r, NULL, NULL), LRCS_OK);
    const double best = r.bound_m2;
    const size_t most = work.peak - all.used;
    int wider = 0;
    for (size_t left = 100; left >= 50; left--) {
        work = all;
        work.size = all.used + most / 100 * left;
        int status = lrcs_sigma_run(prepared, &pose, &run, &work, &r, NULL, NULL);
        if (status == LRCS_OK) {
            check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-11 * truth);
            check_most(best, r.bound_m2 * (1 + 1e-9));
            wider += r.bound_m2 > 2 * best;
        } else {
            assert_int_equal(status, LRCS_E_MEMORY);
        }
    }
    assert_true(wider > 0);
}

/* The derivatives of sigma in s and m by differences of order 4: where no step of s changes the rule
   of an integral or which sectors are used, so that sigma does not jump within its bound. */
static double sigma_slope(lrcs_shape shape, const double turn[3][3], const lrcs_brdf *brdf,
                          uint32_t facets, int of_s)
{
    static const double weight[5] = {1, -8, 0, 8, -1};
    const double own = of_s ? brdf->s : brdf->m;
    const double step = 2e-4 * own;
    double sum = 0;
    for (int k = -2; k <= 2; k++) {
        lrcs_brdf at = *brdf;
        *(of_s ? &at.s : &at.m) += k * step;
        if (k != 0) {
            sum += weight[k + 2] * half_hidden(shape, turn, 0.25, &at, facets).sigma_m2;
        }
    }
    return sum / (12 * step);
}

/* sigma is linear in both amplitudes. Derivatives come from the visible pieces, as sigma does: of
   the outside, and of the inside, from which the rim takes something away. */
static void derivatives_are_those_of_sigma(void **state)
{
    (void)state;
    static const lrcs_brdf some[3] = {{1, 0.25, 0.3, 0.5}, {0, 1, 1, 0.75}, {1, 0, 0.16, 0}};
    static const double inward[3][3] = {{1, 0, 0}, {0, -0.6, -0.8}, {0, 0.8, -0.6}};
    static const uint32_t facets[3] = {250, 500, 2000};
    const int wall = LRCS_SHAPE_WALL;
    const lrcs_shape shape[3] = {
        {.kind = LRCS_SHAPE_SPHERE, .radius = 0.75},
        {.kind = LRCS_SHAPE_DOME, .radius = 0.75, .parts = wall},
        {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.75, .length = 0.3, .parts = wall}};
    lrcs_run_options run = exact_options();
    const lrcs_uncertainty_options how = {0, 1};
    for (int i = 0; i < 6; i++) {
        const int which = i * 2 / 3; /* of four bodies */
        const lrcs_brdf *brdf = &some[i % 3];
        const lrcs_shape *body = &shape[which < 2 ? 0 : which - 1];
        const double(*turn)[3] = which < 2 ? turns[which] : inward;
        const uint32_t count = facets[(i + which) % 3];
        lrcs_scene scene;
        lrcs_work work;
        lrcs_pose pose = lrcs_pose_default();
        lrcs_result r;
        lrcs_sensitivity d[2];
        lrcs_uncertainty uncertainty;
        const lrcs_prepared *prepared =
            half_hidden_prepare(*body, turn, 0.25, brdf, count, &scene, &work);
        for (int fine = 0; fine < 2; fine++) {
            run.tolerance = fine ? 1e-9 : 0.01;
            assert_int_equal(
                lrcs_uncertainty_run(prepared, &pose, &run, &how, &work, &r, d, &uncertainty),
                LRCS_OK);
            check_rel(brdf->A * d[0].dA, r.sigma_glint_m2, 1e-12);
            check_rel(brdf->B * d[0].dB, r.sigma_diffuse_m2, 1e-12);
        }
        check_same(r.sigma_m2, half_hidden(*body, turn, 0.25, brdf, count).sigma_m2);
        double want = brdf->A > 0 ? sigma_slope(*body, turn, brdf, count, 1) : 0;
        check_abs(d[0].ds, want, 1e-8 * (fabs(want) + r.sigma_m2));
        want = brdf->B > 0 ? sigma_slope(*body, turn, brdf, count, 0) : 0;
        check_abs(d[0].dm, want, 1e-8 * (fabs(want) + r.sigma_m2));
    }
}

/* Where sigma is close to linear in s, the sample has its mean and the deviation of first order: at
   other s too the pieces count, on meshes of so few facets that means over patches are off by
   percents. */
static void a_sample_of_slopes_is_about_sigma(void **state)
{
    (void)state;
    static const uint32_t facets[3] = {250, 500, 2000};
    const lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.75};
    const lrcs_brdf brdf = {1, 0, 0.15, 0};
    const lrcs_run_options run = exact_options();
    const lrcs_uncertainty_options how = {20000, 1};
    for (int i = 0; i < 3; i++) {
        lrcs_scene scene;
        lrcs_work work;
        lrcs_pose pose = lrcs_pose_default();
        lrcs_result r;
        lrcs_sensitivity d[2];
        lrcs_uncertainty u;
        const lrcs_prepared *prepared =
            half_hidden_prepare(sphere, turns[1], 0.25, &brdf, facets[i], &scene, &work);
        lrcs_material material[4];
        assert_true(scene.material_count <= 4);
        for (uint32_t k = 0; k < scene.material_count; k++) {
            material[k] = scene.material[k];
            material[k].error.s = material[k].brdf.A > 0 ? 0.01 * brdf.s : 0;
        }
        scene.material = material;
        assert_int_equal(lrcs_uncertainty_run(prepared, &pose, &run, &how, &work, &r, d, &u),
                         LRCS_OK);
        check_rel(u.first_order_m2, 0.01 * brdf.s * d[0].ds, 1e-12);
        check_rel(u.sample_m2, u.first_order_m2, 0.02);
        check_abs(u.sample_mean_m2, r.sigma_m2, 0.03 * u.sample_m2);
    }
}

/* A sphere that a box hides in part, beside a cylinder with curved normals: there each set of
   parameters has a pose of its own. */
static void beside_curved_normals_the_result_is_that_of_the_pose(void **state)
{
    (void)state;
    static char text[CURVED_TEXT];
    lrcs_recipe_part part[3];
    lrcs_recipe_material material[2] = {
        {.name = "skin", .brdf = {1, 0.25, 0.3, 0.5}, .error = {.A = 0.1, .B = 0.01, .s = 0.003}},
        {.name = "black", .brdf = {0, 0, 1, 0}}};
    curved_cylinder(text, 12, 0.5, 1, 'v');
    curved_case model = curved_obj(text);
    for (int i = 0; i < 3; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = i / 2;
        part[i].material = material[i / 2].name;
    }
    part[0].file = "model";
    part[0].place.translate[0] = 5;
    part[0].place.rotate[1][1] = part[0].place.rotate[2][2] = 0; /* it lies along y */
    part[0].place.rotate[1][2] = -1;
    part[0].place.rotate[2][1] = 1;
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.75};
    part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {3, 3, 0.25}};
    part[2].place.translate[1] = 1.75;
    part[2].place.translate[2] = 3;
    const lrcs_recipe recipe = {
        .part = part, .part_count = 3, .material = material, .material_count = 2};
    const lrcs_build_options build = {1e-3, 500, LRCS_NORMALS_SMOOTH, 1, 0, NULL};
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    lrcs_run_options run = exact_options();
    lrcs_pose pose = lrcs_pose_default();
    lrcs_scene scene;
    lrcs_work all;
    lrcs_result want;
    lrcs_result got;
    lrcs_sensitivity d[2];
    lrcs_uncertainty uncertainty;
    run.tolerance = 1e-3;
    const lrcs_prepared *prepared = recipe_prepare(&recipe, &model.mesh, &build, &scene, &all);
    lrcs_work work = all;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &want, NULL, NULL), LRCS_OK);
    work = all;
    assert_int_equal(
        lrcs_uncertainty_run(prepared, &pose, &run, &how, &work, &got, d, &uncertainty), LRCS_OK);
    check_same(got.sigma_m2, want.sigma_m2);
    check_same(got.bound_m2, want.bound_m2);
    check_rel(d[0].dA + 0.25 * d[0].dB, want.sigma_m2, 5e-3);
    double deviation = hypot(hypot(0.1 * d[0].dA, 0.01 * d[0].dB), 0.003 * d[0].ds);
    check_rel(uncertainty.deviation_m2, deviation, 5e-2);
    curved_free(&model);
}

/* The halves of a sphere as two domes, which share the points of their rims, behind the edge. The
   second one is the first one turned over. */
static lrcs_result two_domes(const double turn[3][3], double edge, const lrcs_brdf brdf[2],
                             int exchanged, uint32_t facets)
{
    lrcs_recipe_part part[3];
    lrcs_recipe_material material[3] = {{.name = "first", .brdf = brdf[0]},
                                        {.name = "second", .brdf = brdf[1]},
                                        {.name = "black", .brdf = {0, 0, 1, 0}}};
    for (int i = 0; i < 3; i++) {
        const int half = i == 2 ? 2 : exchanged ? 1 - i : i;
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material = material[half].name;
        part[i].material_index = half;
        part[i].shape =
            (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = 0.75, .parts = LRCS_SHAPE_WALL};
        for (int k = 0; k < 9 && half < 2; k++) {
            part[i].place.rotate[k / 3][k % 3] =
                (half == 1 && k % 3 > 0 ? -1 : 1) * turn[k / 3][k % 3];
        }
    }
    part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {8, 8, 0.25}};
    part[2].place.translate[1] = edge + 4;
    part[2].place.translate[2] = 3;
    const lrcs_recipe recipe = {
        .part = part, .part_count = 3, .material = material, .material_count = 3};
    const lrcs_build_options build = {1e-9, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    const lrcs_run_options run = exact_options();
    return recipe_run(&recipe, &build, &run, (const double[3]){0, 0, 1});
}

/* Two domes are a sphere, whatever their materials, and in which order they come. */
static void two_domes_are_a_sphere(void **state)
{
    (void)state;
    static const double turn[3][3][3] = {{{1, 0, 0}, {0, 0.6, 0.8}, {0, -0.8, 0.6}},
                                         {{0.6, 0, 0.8}, {0.64, 0.6, -0.48}, {-0.48, 0.8, 0.36}},
                                         {{0, 1, 0}, {0.28, 0, 0.96}, {0.96, 0, -0.28}}};
    static const double edges[3] = {0.6, 0.05, -0.27};
    static const lrcs_brdf black = {0, 0, 1, 0};
    for (int i = 0; i < 9; i++) {
        const lrcs_brdf *brdf = &brdfs[(i + i / 3) % 3];
        const double edge = edges[i % 3];
        const double truth = 4 * PI * lit_integral(brdf, 0.75, 0, edge);
        const double whole = 4 * PI * lit_integral(brdf, 0.75, 0, 0.75);
        double sum[2] = {0, 0}; /* of the halves, the other one black; of their bounds */
        for (int half = 0; half < 2; half++) {
            const lrcs_brdf one[2] = {half ? black : *brdf, half ? *brdf : black};
            lrcs_result r = two_domes(turn[i / 3], edge, one, 0, 2000);
            lrcs_result other = two_domes(turn[i / 3], edge, one, 1, 2000);
            check_abs(other.sigma_m2, r.sigma_m2, r.bound_m2 + other.bound_m2);
            sum[0] += r.sigma_m2;
            sum[1] += r.bound_m2;
        }
        check_abs(sum[0], truth, sum[1] + 1e-11 * whole);
        const lrcs_brdf both[2] = {*brdf, *brdf};
        lrcs_result r = two_domes(turn[i / 3], edge, both, 0, 2000);
        check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-11 * whole);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_behind_a_straight_edge),
        cmocka_unit_test(a_dome_behind_a_straight_edge),
        cmocka_unit_test(a_paraboloid_behind_a_straight_edge),
        cmocka_unit_test(two_domes_are_a_sphere),
        cmocka_unit_test(the_bound_holds_for_narrow_glints),
        cmocka_unit_test(with_less_memory_the_bound_holds),
        cmocka_unit_test(derivatives_are_those_of_sigma),
        cmocka_unit_test(a_sample_of_slopes_is_about_sigma),
        cmocka_unit_test(beside_curved_normals_the_result_is_that_of_the_pose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
