/* SPDX-License-Identifier: MIT */
/* A smooth model in the shadow of an engine-made sphere. The truth is that of the true sphere, from
   an integral over the model's sides which knows nothing of facets, clipping or cubature; the
   sphere's mesh is coarse, and the bound must cover the error of its shadow. */
#include "curved.h"
#include "ray_caster.h"

#define SIDES  24
#define RADIUS 0.5
#define LENGTH 2.0

static char text[CURVED_TEXT];
static unsigned char scene_area[1u << 22];
static unsigned char run_area[1u << 27];

typedef struct shadow_case {
    double d[3];      /* to the laser */
    double centre[3]; /* of the sphere: between the laser and the cylinder */
    double radius;
} shadow_case;

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How much of the line (x, y, *) of the wall lies behind the sphere: |w x d|^2 < r^2 is a quadratic
   in z. Its ends must lie on the wall. */
static double hidden_height(const shadow_case *s, double x, double y)
{
    const double w[3] = {x - s->centre[0], y - s->centre[1], 0};
    double along = dot3(w, s->d);
    double a = 1 - s->d[2] * s->d[2];
    double b = -along * s->d[2]; /* a z^2 + 2 b z + c */
    double c = dot3(w, w) - along * along - s->radius * s->radius;
    double root = b * b - a * c;
    if (!(root > 0)) {
        return 0;
    }
    double top = (-b + sqrt(root)) / a + s->centre[2];
    double bottom = (-b - sqrt(root)) / a + s->centre[2];
    check_most(top, 0.5 * LENGTH);
    check_most(-0.5 * LENGTH, bottom);
    return top - bottom;
}

/* One side of the wall, from corner i to the next, its normals linear between theirs. */
static double side_sigma(const shadow_case *s, const lrcs_brdf *brdf, int i, int steps)
{
    double from = 2 * CURVED_PI * i / SIDES;
    double to = 2 * CURVED_PI * (i + 1) / SIDES;
    const double p[2][3] = {{cos(from), sin(from), 0}, {cos(to), sin(to), 0}};
    const double out[3] = {cos(0.5 * (from + to)), sin(0.5 * (from + to)), 0};
    double width = 2 * RADIUS * sin(0.5 * (to - from));
    double sum = 0;
    for (int k = 0; k < steps && dot3(out, s->d) > 0; k++) {
        double t = (k + 0.5) / steps;
        double n[3];
        for (int c = 0; c < 3; c++) {
            n[c] = (1 - t) * p[0][c] + t * p[1][c];
        }
        double cosine = dot3(n, s->d) / sqrt(dot3(n, n));
        if (cosine > 0) {
            double seen = LENGTH - hidden_height(s, RADIUS * n[0], RADIUS * n[1]);
            sum += cast_reflect(brdf, cosine) / cosine * seen * width / steps;
        }
    }
    return 4 * CURVED_PI * sum * fmax(0, dot3(out, s->d));
}

/* All of the cylinder, by midpoints; caps have no shadow. */
static double cylinder_sigma(const shadow_case *s, const lrcs_brdf *brdf, int steps)
{
    double area = 0.5 * SIDES * sin(2 * CURVED_PI / SIDES) * RADIUS * RADIUS;
    double sigma = s->d[2] > 0 ? 4 * CURVED_PI * area * cast_reflect(brdf, s->d[2]) : 0;
    for (int i = 0; i < SIDES; i++) {
        sigma += side_sigma(s, brdf, i, steps);
    }
    return sigma;
}

/* From azimuth and elevation in degrees; the sphere stands before a point of the axis, aside. */
static shadow_case shadow_from(double azimuth, double elevation, double aside)
{
    shadow_case s = {.radius = 0.25};
    double a = azimuth * CURVED_PI / 180;
    double e = elevation * CURVED_PI / 180;
    const double d[3] = {cos(e) * cos(a), cos(e) * sin(a), sin(e)};
    const double across[3] = {-sin(a), cos(a), 0};
    for (int k = 0; k < 3; k++) {
        s.d[k] = d[k];
        s.centre[k] = 1.5 * d[k] + aside * across[k] - (k == 2 ? 0.3 : 0);
    }
    return s;
}

/* The smooth cylinder and the black sphere, of so many facets at most. */
static lrcs_result shadow_run(const shadow_case *s, const lrcs_mesh *cylinder,
                              const lrcs_brdf *brdf, uint32_t facets, int method)
{
    lrcs_recipe_part part[2] = {
        {.name = "can", .file = "can", .place = lrcs_place_default(), .material_index = -1},
        {.name = "ball", .place = lrcs_place_default(), .material = "black", .material_index = 0}};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = s->radius};
    for (int k = 0; k < 3; k++) {
        part[1].place.translate[k] = s->centre[k];
    }
    lrcs_recipe_material black = {.name = "black", .brdf = {0, 0, 0.2, 0}};
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = *brdf};
    lrcs_recipe recipe = {.part = part,
                          .material = &black,
                          .binding = &binding,
                          .part_count = 2,
                          .material_count = 1,
                          .binding_count = 1};
    const lrcs_mesh models[2] = {*cylinder};
    lrcs_build_options build = {1e-9, facets, LRCS_NORMALS_SMOOTH, 1, 0, NULL};
    lrcs_run_options run = lrcs_run_options_default();
    run.method = method;
    run.resolution = method == LRCS_METHOD_ZBUFFER ? 300 : 0;
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    lrcs_scene scene;
    const lrcs_prepared *prepared;
    lrcs_pose pose;
    lrcs_result result;
    assert_int_equal(lrcs_scene_build(&recipe, models, &build, &work, &scene, NULL), LRCS_OK);
    assert_non_null(scene.corner_normal);
    work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(s->d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &result, NULL, NULL), LRCS_OK);
    return result;
}

/* All methods on the coarsest sphere, and exactly on finer ones. */
static void check_shadow(const shadow_case *s, const lrcs_mesh *cylinder, const lrcs_brdf *brdf)
{
    static const uint32_t facets[] = {64, 250, 3000};
    double truth = cylinder_sigma(s, brdf, 8000);
    double error = fabs(truth - cylinder_sigma(s, brdf, 4000)); /* several times the truth's own */
    lrcs_result r = {0};
    check_most(error, 1e-5 * truth);
    for (int i = 0; i < 3; i++) {
        int first = i == 0 ? LRCS_METHOD_FACET : LRCS_METHOD_EXACT;
        for (int method = first; method <= LRCS_METHOD_EXACT; method++) {
            r = shadow_run(s, cylinder, brdf, facets[i], method);
            check_abs(r.sigma_m2, truth, r.bound_m2 + r.curvature_estimate_m2 + error);
            if (method == LRCS_METHOD_EXACT && i == 0) { /* what the shadow of facets misses */
                double rest = r.bound_m2 - r.budget.tessellation_m2 + r.curvature_estimate_m2;
                assert_true(fabs(r.sigma_m2 - truth) > 10 * (rest + error));
            }
        }
    }
    check_most(r.bound_m2, 0.05 * truth);
}

static void a_sphere_that_is_a_mesh_hides_what_the_true_one_hides_to_within_the_bound(void **state)
{
    (void)state;
    static const lrcs_brdf brdf[] = {{1, 0.25, 0.05, 0.5}, {0, 0.3, 0.2, 0}};
    static const double azimuth[] = {0, 7, 10.3, 52};
    curved_cylinder(text, SIDES, RADIUS, LENGTH, 'v');
    curved_case c = curved_obj(text);
    for (int i = 0; i < 16; i++) {
        shadow_case s = shadow_from(azimuth[i % 4], i % 3 * 10, i < 8 ? 0 : 0.3);
        check_shadow(&s, &c.mesh, &brdf[i / 4 % 2]);
    }
    curved_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_that_is_a_mesh_hides_what_the_true_one_hides_to_within_the_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
