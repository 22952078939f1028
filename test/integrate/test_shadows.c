/* SPDX-License-Identifier: MIT */
/* Curved shapes that shadow and touch one another: closed forms where a shadow has one (cast by a
   sphere or a cylinder on a plate), rays over the true shapes elsewhere. Every bound holds, from
   the coarsest mesh to a fine one. */
#include <lrcs/lrcs.h>

#include <stdlib.h>

#include "check.h"
#include "ray_caster.h"
#include "recipe.h"

#define PI 3.14159265358979323846

static const lrcs_brdf glossy = {1, 0.25, 0.2, 0.5};

typedef struct shadow_scene {
    lrcs_recipe_part part[72];
    lrcs_recipe_material material;
    uint32_t parts;
} shadow_scene;

static lrcs_recipe_part *add(shadow_scene *s, lrcs_shape shape, double x, double y, double z)
{
    lrcs_recipe_part *part = &s->part[s->parts++];
    *part = (lrcs_recipe_part){.name = "", .shape = shape, .place = lrcs_place_default()};
    part->place.translate[0] = x;
    part->place.translate[1] = y;
    part->place.translate[2] = z;
    part->material = "skin";
    part->material_index = 0;
    return part;
}

/* Half a turn about x. */
static void turn_over(lrcs_recipe_part *part)
{
    part->place.rotate[1][1] = -1;
    part->place.rotate[2][2] = -1;
}

static shadow_scene scene_of(lrcs_brdf brdf, int two_sided)
{
    shadow_scene s = {.parts = 0};
    s.material = (lrcs_recipe_material){.name = "skin", .brdf = brdf, .two_sided = two_sided};
    return s;
}

/* Builds and prepares; the rest of the work area is for runs. */
static lrcs_scene scene;
static lrcs_work run_work;

static const lrcs_prepared *shadow_prepare(shadow_scene *s, uint32_t facets)
{
    lrcs_recipe recipe = {
        .part = s->part, .part_count = s->parts, .material = &s->material, .material_count = 1};
    lrcs_build_options build = {1e-9, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    return recipe_prepare(&recipe, NULL, &build, &scene, &run_work);
}

static double tolerance = 1e-7; /* means over patches have a small remainder */

static lrcs_result prepared_run(const lrcs_prepared *prepared, const double d[3], int method)
{
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_work work = run_work;
    lrcs_pose pose;
    lrcs_result result;
    run.method = method;
    run.tolerance = tolerance;
    run.resolution = method == LRCS_METHOD_ZBUFFER ? 300 : 0;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &result, NULL, NULL), LRCS_OK);
    assert_true(result.budget.tessellation_m2 >= 0);
    return result;
}

static lrcs_result shadow_run(shadow_scene *s, uint32_t facets, const double d[3], int method)
{
    return prepared_run(shadow_prepare(s, facets), d, method);
}

/* What a scene has in truth, seen from d. */
typedef struct shadow_truth {
    double d[3];
    double sigma, error;
    double tight; /* how close the finest mesh is to it, which takes the longest; 0: not asked */
} shadow_truth;

/* All methods on a coarse mesh, and exactly on finer ones, against the truth. Method auto takes the
   closed forms of shapes that nothing hides, on any mesh. */
static void check_truths(shadow_scene *s, const shadow_truth *truth, int count)
{
    static const uint32_t facets[] = {64, 200, 1500};
    for (int i = 0; i < 3; i++) {
        const lrcs_prepared *prepared = NULL;
        for (const shadow_truth *t = truth; t < truth + count; t++) {
            if (i == 2 && !(t->tight > 0)) {
                continue;
            }
            prepared = prepared ? prepared : shadow_prepare(s, facets[i]);
            int first = i == 0 ? LRCS_METHOD_FACET : LRCS_METHOD_EXACT;
            lrcs_result chosen = prepared_run(prepared, t->d, LRCS_METHOD_AUTO);
            check_abs(chosen.sigma_m2, t->sigma, chosen.bound_m2 + t->error);
            for (int method = first; method <= LRCS_METHOD_EXACT; method++) {
                lrcs_result r = prepared_run(prepared, t->d, method);
                check_abs(r.sigma_m2, t->sigma, r.bound_m2 + t->error);
                if (method == LRCS_METHOD_EXACT) {
                    /* what rounding adds to visible areas may differ */
                    check_most(chosen.bound_m2, 1.000001 * r.bound_m2 + 1e-12 * t->sigma);
                    check_most(i == 2 && t->sigma > 0 ? r.bound_m2 : 0, t->tight * t->sigma);
                }
            }
        }
    }
}

static void check_truth(shadow_scene *s, const double d[3], double truth, double error,
                        double tight)
{
    const shadow_truth one = {{d[0], d[1], d[2]}, truth, error, tight};
    check_truths(s, &one, 1);
}

/* --- closed forms ----------------------------------------------------------------------------- */

/* 4 pi f_r cos^2 at theta. */
static double lambertian(const lrcs_brdf *brdf, double theta)
{
    return 4 * PI * cast_reflect(brdf, cos(theta));
}

/* All of the sphere is lit; its shadow on the plate is an ellipse, wholly on it. */
static void a_sphere_over_a_plate(void **state)
{
    (void)state;
    const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {8, 8}};
    static const double height[] = {0.5, 0.75, 2}; /* the first rests on the plate */
    const lrcs_aspect any = {.deg = 0};
    lrcs_closed_form sphere;
    assert_int_equal(lrcs_closed_eval(&ball, &glossy, &any, &sphere), LRCS_OK);
    for (int i = 0; i < 9; i++) {
        double theta = (i % 3) * 25 * PI / 180;
        shadow_scene s = scene_of(glossy, 0);
        add(&s, ball, 0.125, 0.25, height[i / 3]);
        add(&s, plate, 0, 0, 0);
        const double d[3] = {sin(theta), 0, cos(theta)};
        double truth = sphere.sigma_m2 + lambertian(&glossy, theta) * (64 - PI * 0.25 / cos(theta));
        check_truth(&s, d, truth, 1e-13 * truth, i % 4 == 0 ? 0.1 : 0);
    }
}

/* All of the cone is lit. Its shadow is that of its base, and what lies between it and the tip. */
static void a_cone_on_its_tip_over_a_plate(void **state)
{
    (void)state;
    const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .length = 1};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {8, 8}};
    const double R = cone.radius;
    for (int i = 0; i < 4; i++) {
        double deg = 18 * i; /* in the first two the tip is in the shadow of the base */
        double theta = deg * PI / 180;
        double away = cone.length * tan(theta);
        double shadow =
            away > R ? R * R * (PI - acos(R / away)) + R * sqrt(away * away - R * R) : PI * R * R;
        const lrcs_aspect aspect = {.deg = 180 - deg};
        const double d[3] = {sin(theta), 0, cos(theta)};
        lrcs_closed_form whole;
        shadow_scene s = scene_of(glossy, 0);
        turn_over(add(&s, cone, 0.125, 0.25, cone.length));
        add(&s, plate, 0, 0, 0);
        assert_int_equal(lrcs_closed_eval(&cone, &glossy, &aspect, &whole), LRCS_OK);
        double truth = whole.sigma_m2 + lambertian(&glossy, theta) * (64 - shadow);
        check_truth(&s, d, truth, 1e-12 * truth, i % 3 == 2 ? 0.1 : 0);
    }
}

/* The plate's hidden part is the base and all that it sweeps over the length of the shadow. */
static void a_cylinder_on_a_plate(void **state)
{
    (void)state;
    const lrcs_shape post = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {8, 8}};
    for (int degrees = 0; degrees <= 60; degrees += 20) {
        double theta = degrees * PI / 180;
        lrcs_aspect aspect = {.deg = degrees};
        lrcs_closed_form cylinder;
        assert_int_equal(lrcs_closed_eval(&post, &glossy, &aspect, &cylinder), LRCS_OK);
        for (int above = 0; above < 2; above++) { /* standing, and a little sunk */
            shadow_scene s = scene_of(glossy, 0);
            lrcs_recipe_part *placed = add(&s, post, 0, 0, 0);
            placed->shape.length = above ? 1 : 1.25;
            placed->place.translate[2] = above ? 0 : -0.25;
            add(&s, plate, 0, 0, 0);
            const double d[3] = {sin(theta), 0, cos(theta)};
            double dark = PI * 0.0625 + 2 * 0.25 * tan(theta);
            double truth = cylinder.sigma_m2 + lambertian(&glossy, theta) * (64 - dark);
            check_truth(&s, d, truth, 1e-13 * truth, degrees == 40 ? 1e-4 : 0);
        }
    }
}

/* --- rays ------------------------------------------------------------------------------------- */

/* From directions along axes, in planes and between, the standard error allowed for six times. */
static void check_rays(shadow_scene *s, double tight)
{
    static const double d[4][3] = {{0, 0, 1}, {0, -1, 0}, {0.48, 0.64, 0.6}, {-0.6, 0, -0.8}};
    cast_scene rays = {.seed = 1};
    for (uint32_t i = 0; i < s->parts; i++) {
        cast_part(&rays, &s->part[i], &s->material.brdf, s->material.two_sided);
    }
    shadow_truth truth[4];
    for (int i = 0; i < 4; i++) {
        cast_answer cast = cast_run(&rays, d[i], 24);
        truth[i] = (shadow_truth){{d[i][0], d[i][1], d[i][2]},
                                  cast.sigma,
                                  6 * cast.error + 1e-12 * cast.sigma,
                                  i == 2 ? tight : 0};
    }
    check_truths(s, truth, 4);
}

static void a_nozzle_flush_on_a_box(void **state)
{
    (void)state;
    shadow_scene s = scene_of(glossy, 0);
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}}, 0, 0, 0.5);
    turn_over(add(
        &s, (lrcs_shape){.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.4, .radius2 = 0.2, .length = 1}, 0,
        0, 0));
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = 0.375}, 0, 0, 1);
    check_rays(&s, 0.1);
}

static void the_inside_of_an_open_dish(void **state)
{
    (void)state;
    shadow_scene s = scene_of((lrcs_brdf){0.1, 0.3, 0.4, 0}, 1);
    lrcs_shape dish = {
        .kind = LRCS_SHAPE_CONE, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .length = 0.5};
    turn_over(add(&s, dish, 0, 0, 0));
    check_rays(&s, 0.02);
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.125}, 0.125, 0, -0.25);
    check_rays(&s, 0.2);
}

/* The shadow of a rim on the inside of its own wall is known exactly: a few facets have no larger
   bound than many. */
static void rims_of_open_walls_shade_them_exactly(void **state)
{
    (void)state;
    static const lrcs_shape open[] = {
        {.kind = LRCS_SHAPE_CONE, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .length = 0.2},
        {.kind = LRCS_SHAPE_CYLINDER, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .length = 1},
        {.kind = LRCS_SHAPE_PARABOLOID, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .length = 0.3},
        {.kind = LRCS_SHAPE_DOME, .parts = LRCS_SHAPE_WALL, .radius = 0.5},
        {.kind = LRCS_SHAPE_FRUSTUM,
         .parts = LRCS_SHAPE_WALL,
         .radius = 0.3,
         .radius2 = 0.5,
         .length = 0.5}};
    static const double d[3] = {0.75, 0.5, -0.3};
    tolerance = 1e-9;
    for (int i = 0; i < 5; i++) {
        shadow_scene s = scene_of((lrcs_brdf){0.02, 0.25, 0.4, 0.2}, 1);
        add(&s, open[i], 0, 0, 0);
        add(&s, (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {0.25, 0.25, 0.5}}, 0, 0, 2.5);
        const lrcs_result coarse = shadow_run(&s, 400, d, LRCS_METHOD_EXACT);
        const lrcs_result fine = shadow_run(&s, 3200, d, LRCS_METHOD_EXACT);
        check_most(coarse.bound_m2, 1e-10 * coarse.sigma_m2);
        check_abs(coarse.sigma_m2, fine.sigma_m2, coarse.bound_m2 + fine.bound_m2);
    }
    tolerance = 1e-7;
}

/* Sets of parts share their last bit among all parts from the 64th on: one of these may hide the
   inside of another. */
static void one_of_many_parts_shades_the_inside_of_another(void **state)
{
    (void)state;
    static const double d[3] = {0.1, 0.05, -1};
    lrcs_result results[2];
    for (int many = 0; many < 2; many++) {
        shadow_scene s = scene_of((lrcs_brdf){0, 0.25, 0.4, 0.2}, 1);
        for (int i = 0; i < 65 && many; i++) {
            add(&s, (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {1e-6, 1e-6}}, 10 + i, 40, 0);
        }
        add(&s, (lrcs_shape){.kind = LRCS_SHAPE_DOME, .parts = LRCS_SHAPE_WALL, .radius = 1}, 0, 0,
            0);
        add(&s, (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {0.6, 0.5, 0.1}}, 0.35, 0.1, -0.6);
        results[many] = shadow_run(&s, 1000, d, LRCS_METHOD_EXACT);
    }
    check_abs(results[0].sigma_m2, results[1].sigma_m2,
              results[0].bound_m2 + results[1].bound_m2 + 1e-9);
    check_most(results[1].bound_m2, 1e-2 * results[1].sigma_m2);
}

static void tube_in_tube(void **state)
{
    (void)state;
    shadow_scene s = scene_of((lrcs_brdf){0, 0.3, 1, 0}, 1);
    lrcs_shape tube = {
        .kind = LRCS_SHAPE_CYLINDER, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .length = 1};
    add(&s, tube, 0, 0, 0);
    tube.radius = 0.375;
    add(&s, tube, 0, 0, 0.25);
    check_rays(&s, 0.05);
}

static void eclipsed_and_nested_spheres(void **state)
{
    (void)state;
    shadow_scene s = scene_of(glossy, 0);
    lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    add(&s, ball, 0, 0, 0);
    ball.radius = 0.25;
    add(&s, ball, 0.125, 0, 0); /* inside */
    add(&s, ball, 0, 0, 0.75);  /* touching */
    add(&s, ball, 0.5, 0.5, 0.5);
    check_rays(&s, 0.4);
}

static void a_tube_pierced_by_a_box(void **state)
{
    (void)state;
    shadow_scene s = scene_of(glossy, 1);
    add(&s,
        (lrcs_shape){.kind = LRCS_SHAPE_FRUSTUM,
                     .parts = LRCS_SHAPE_WALL,
                     .radius = 0.25,
                     .radius2 = 0.5,
                     .length = 1},
        0, 0, 0);
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1.5, 0.25, 0.25}}, 0, 0, 0.5);
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_DISC, .radius = 0.75}, 0, 0.25, 1.25);
    check_rays(&s, 0.1);
}

/* --- unevenly scaled -------------------------------------------------------------------------- */

/* 4 pi times the integral of F over an ellipsoid with these semi-axes: over the unit sphere's
   normals, whose half that faces the laser is the one around e = M^-1 d, by the midpoint rule. */
static double ellipsoid_truth(const lrcs_brdf *brdf, const double axis[3], const double d[3])
{
    double e[3];
    double a[3];
    double b[3];
    double length = 0;
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = d[k] / axis[k];
        length += e[k] * e[k];
    }
    length = sqrt(length);
    int least = fabs(e[0]) < fabs(e[1]) ? 0 : 1;
    double root = sqrt(length * length - e[least] * e[least]);
    for (int k = 0; k < 3; k++) {
        e[k] /= length;
    }
    for (int k = 0; k < 3; k++) {
        a[k] = ((k == least) - e[least] * e[k]) / (root / length);
    }
    for (int k = 0; k < 3; k++) {
        b[k] = e[(k + 1) % 3] * a[(k + 2) % 3] - e[(k + 2) % 3] * a[(k + 1) % 3];
    }
    for (int i = 0; i < 1000; i++) { /* z = cos of the angle from e, as 1 - x^2 */
        double t = (i + 0.5) / 1000;
        double x = t * t * (3 - 2 * t); /* the integrand begins and ends without a slope */
        double z = 1 - x * x;
        double r = x * sqrt(2 - x * x);
        for (int j = 0; j < 256; j++) {
            double phi = 2 * PI * (j + 0.5) / 256;
            double square = 0;
            for (int k = 0; k < 3; k++) {
                double n = z * e[k] + r * (cos(phi) * a[k] + sin(phi) * b[k]);
                square += n * n / axis[k] / axis[k];
            }
            double cosine = fmin(1, z * length / sqrt(square));
            sum += cast_reflect(brdf, cosine) * sqrt(square) * 2 * x * 6 * t * (1 - t);
        }
    }
    return 4 * PI * axis[0] * axis[1] * axis[2] * sum * 2 * PI / 256 / 1000;
}

/* The quadrature is good to 1e-11: Gauss-Legendre rules give the same. */
static void ellipsoids_alone_and_over_a_plate(void **state)
{
    (void)state;
    static const double scale[][3] = {{1, 2, 1}, {1, 1, 0.5}, {0.5, 1, 1.5}, {3, 1, 1}};
    static const int angle[] = {0, 1, 1, 2};
    for (int i = 0; i < 4; i++) {
        const double *axes = scale[i];
        double theta = angle[i] * 25 * PI / 180;
        const double d[3] = {0.6 * sin(theta), 0.8 * sin(theta), cos(theta)};
        double round = 0;
        double half[3];
        shadow_scene s = scene_of(glossy, 0);
        lrcs_recipe_part *part =
            add(&s, (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5}, 0.125, 0.25, 2);
        for (int k = 0; k < 3; k++) {
            part->place.scale[k] = axes[k];
            half[k] = 0.5 * axes[k];
            round += d[k] / half[k] * (d[k] / half[k]);
        }
        double truth = ellipsoid_truth(&glossy, half, d);
        check_truth(&s, d, truth, 1e-10 * truth, i == 1 ? 1.5 : 0);
        check_most(shadow_run(&s, 200, d, LRCS_METHOD_FACET).bound_m2, 1e-5 * truth);
        add(&s, (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {12, 12}}, 0, 0, 0);
        double shadow = PI * half[0] * half[1] * half[2] * sqrt(round) / cos(theta);
        truth += lambertian(&glossy, theta) * (144 - shadow);
        check_truth(&s, d, truth, 1e-10 * truth, i == 1 ? 0.6 : 0);
    }
}

/* Elliptic tubes, cones and bowls that shade one another. */
static void unevenly_scaled_shapes_among_others(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        shadow_scene s = scene_of(glossy, i == 1);
        lrcs_shape shape = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.375, .length = 0.75};
        lrcs_shape other = {
            .kind = LRCS_SHAPE_FRUSTUM, .radius = 0.25, .radius2 = 0.5, .length = 1};
        if (i == 1) {
            shape = (lrcs_shape){.kind = LRCS_SHAPE_PARABOLOID,
                                 .parts = LRCS_SHAPE_WALL,
                                 .radius = 0.5,
                                 .length = 0.375};
            other.parts = LRCS_SHAPE_WALL;
        } else if (i == 2) {
            shape.kind = LRCS_SHAPE_CONE;
            other = (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = 0.5};
        }
        lrcs_recipe_part *part = add(&s, shape, 0, 0, 0);
        part->place.scale[0] = 1.5;
        part->place.scale[2] = 2;
        part = add(&s, other, 0.5, 0.5, 0.75);
        part->place.scale[1] = 0.625;
        part = add(&s, (lrcs_shape){.kind = LRCS_SHAPE_DISC, .radius = 0.5}, -0.5, 0.25, -0.5);
        part->place.scale[1] = 2;
        check_rays(&s, 0.9);
    }
}

static void scenes_of_flat_parts_have_no_tessellation_error(void **state)
{
    (void)state;
    shadow_scene s = scene_of(glossy, 0);
    const double d[3] = {0.48, 0.64, 0.6};
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}}, 0, 0, 1);
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {3, 3}}, 0, 0, 0);
    check_same(shadow_run(&s, 64, d, LRCS_METHOD_EXACT).budget.tessellation_m2, 0);
}

static void parts_far_apart_cost_no_more_than_alone(void **state)
{
    (void)state;
    shadow_scene s = scene_of(glossy, 0);
    const double d[3] = {0, 0, 1};
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5}, 0, 0, 0);
    double alone = shadow_run(&s, 1000, d, LRCS_METHOD_EXACT).budget.tessellation_m2;
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {3, 3}}, 5, 0, 0);
    check_rel(shadow_run(&s, 1000, d, LRCS_METHOD_EXACT).budget.tessellation_m2, alone, 1e-9);
}

/* There doubles are some 1e-10 of a part apart, which tilts and resizes its facets. */
static void parts_far_from_the_origin_count_how_placing_rounds_them(void **state)
{
    (void)state;
    const lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 1e-6};
    const lrcs_shape can = {.kind = LRCS_SHAPE_CYLINDER, .radius = 1e-6, .length = 1e-6};
    for (int i = 0; i < 40; i++) {
        lrcs_aspect aspect = {.deg = 2.0 * i};
        double theta = aspect.deg * PI / 180;
        const double d[3] = {sin(theta), 0, cos(theta)};
        lrcs_closed_form truth;
        shadow_scene s = scene_of(glossy, 0);
        lrcs_recipe_part *part = add(&s, i % 2 ? can : disc, 1.3, -0.7, 1.9);
        assert_int_equal(lrcs_closed_eval(&part->shape, &glossy, &aspect, &truth), LRCS_OK);
        lrcs_result r = shadow_run(&s, 64, d, LRCS_METHOD_AUTO);
        check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2);
        check_most(i % 2 ? 0 : r.bound_m2, 1e-6 * r.sigma_m2);
    }
}

static void what_is_wholly_hidden_is_exactly_nothing(void **state)
{
    (void)state;
    shadow_scene s = scene_of(glossy, 0);
    const double d[3] = {0.1, 0.2, 1};
    add(&s, (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5}, 0, 0, -1);
    turn_over(add(&s, (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {3, 3}}, 0, 0, 0));
    for (int method = LRCS_METHOD_ZBUFFER; method <= LRCS_METHOD_EXACT; method++) {
        lrcs_result r = shadow_run(&s, 1000, d, method);
        check_same(r.sigma_m2, 0);
        check_same(r.bound_m2, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_over_a_plate),
        cmocka_unit_test(a_cone_on_its_tip_over_a_plate),
        cmocka_unit_test(a_cylinder_on_a_plate),
        cmocka_unit_test(a_nozzle_flush_on_a_box),
        cmocka_unit_test(the_inside_of_an_open_dish),
        cmocka_unit_test(rims_of_open_walls_shade_them_exactly),
        cmocka_unit_test(one_of_many_parts_shades_the_inside_of_another),
        cmocka_unit_test(tube_in_tube),
        cmocka_unit_test(eclipsed_and_nested_spheres),
        cmocka_unit_test(a_tube_pierced_by_a_box),
        cmocka_unit_test(ellipsoids_alone_and_over_a_plate),
        cmocka_unit_test(unevenly_scaled_shapes_among_others),
        cmocka_unit_test(scenes_of_flat_parts_have_no_tessellation_error),
        cmocka_unit_test(what_is_wholly_hidden_is_exactly_nothing),
        cmocka_unit_test(parts_far_from_the_origin_count_how_placing_rounds_them),
        cmocka_unit_test(parts_far_apart_cost_no_more_than_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
