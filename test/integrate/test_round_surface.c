/* SPDX-License-Identifier: MIT */
/* The wall of a round shape as a function on the view plane: against its definition, evaluated
   independently, and its bound against values at complex points. */
#include "integrate/wall/round_surface.h"

#include <lrcs/lrcs.h>

#include <complex.h>

#include "check.h"
#include "random.h"

static unsigned char scene_area[1u << 23];
static unsigned char view_area[1u << 24];
static uint64_t seed = 5;

static double between(double low, double high)
{
    return low + (high - low) * random_unit(&seed);
}

/* A rotation by three angles. */
static void rotation(double matrix[3][3])
{
    double a = between(0, 6);
    double b = between(0, 6);
    double c = between(0, 6);
    const double x[3][3] = {{1, 0, 0}, {0, cos(a), -sin(a)}, {0, sin(a), cos(a)}};
    const double z[3][3] = {{cos(b), -sin(b), 0}, {sin(b), cos(b), 0}, {0, 0, 1}};
    const double y[3][3] = {{cos(c), 0, sin(c)}, {0, 1, 0}, {-sin(c), 0, cos(c)}};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            matrix[i][k] = 0;
            for (int j = 0; j < 9; j++) {
                matrix[i][k] += x[i][j / 3] * z[j / 3][j % 3] * y[j % 3][k];
            }
        }
    }
}

static lrcsi_view placed_view(int kind, lrcs_scene *scene)
{
    lrcs_recipe_part part[2];
    for (int i = 0; i < 2; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = -1;
    }
    part[0].shape = (lrcs_shape){.kind = kind, .radius = between(0.2, 1)};
    part[0].shape.length = kind == LRCS_SHAPE_PARABOLOID ? between(0.1, 1) : 0;
    rotation(part[0].place.rotate);
    for (int k = 0; k < 3; k++) {
        part[0].place.translate[k] = between(-1, 1);
    }
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {1, 1}};
    const lrcs_recipe recipe = {.part = part, .part_count = 2};
    const lrcs_build_options build = {1e-2, 500, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared;
    lrcs_pose pose;
    lrcsi_view view;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_prepare_run(scene, &work, &prepared), LRCS_OK);
    const double d[3] = {between(-1, 1), between(-1, 1), between(-1, 1)};
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    work = lrcs_work_make(view_area, sizeof view_area);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    return view;
}

/* G above a point of the view plane, real or complex, from the shape's definition in its own frame:
   the larger root of the quadratic equation for the point's height. */
static double complex definition(const lrcsi_round_surface *s, const lrcs_brdf *brdf,
                                 const double complex x[2])
{
    const double *d = s->axis[2];
    double complex X[3];
    double complex a = 0;
    double complex b = s->beta * d[2];
    double complex c = s->gamma;
    const double weight[3] = {1, 1, s->alpha};
    for (int k = 0; k < 3; k++) {
        X[k] = s->origin[k] + x[0] * s->axis[0][k] + x[1] * s->axis[1][k];
        a += weight[k] * d[k] * d[k];
        b += weight[k] * d[k] * X[k];
        c += weight[k] * X[k] * X[k] + (k == 2 ? 2 * s->beta * X[2] : 0);
    }
    double complex t = (csqrt(b * b - a * c) - b) / a;
    double complex square = 0;
    double complex cosine = 0;
    for (int k = 0; k < 3; k++) {
        double complex g = weight[k] * (X[k] + t * d[k]) + (k == 2 ? s->beta : 0);
        square += g * g;
        cosine += g * d[k];
    }
    double complex w = square / (cosine * cosine);
    double complex glint = brdf->A * cpow(w, 2.5) * cexp((1 - w) / (brdf->s * brdf->s));
    return glint + brdf->B * cpow(w, -0.5 * (brdf->m + 1));
}

static const int kinds[3] = {LRCS_SHAPE_SPHERE, LRCS_SHAPE_DOME, LRCS_SHAPE_PARABOLOID};

/* A point above some place of the wall that faces the laser. */
static int some_point(const lrcsi_view *view, const lrcsi_round_surface *s,
                      lrcsi_round_point *point)
{
    double radius = s->part->shape.radius * ldexp(1, -view->prepared->exponent);
    const double x[2] = {s->view[0] + between(-radius, radius),
                         s->view[1] + between(-radius, radius)};
    return lrcsi_round_point_make(s, x, point) && point->s > 0.05 * point->length;
}

static void values_are_those_of_the_definition(void **state)
{
    (void)state;
    int count = 0;
    lrcs_scene scene;
    lrcsi_view view;
    for (int i = 0; i < 300; i++) {
        lrcsi_round_point point;
        const lrcs_brdf brdf = {between(0, 1), between(0, 1), between(0.1, 1), between(0, 4)};
        if (i % 10 == 0) { /* points of 30 views, which take longer */
            view = placed_view(kinds[i / 10 % 3], &scene);
        }
        lrcsi_round_surface s = lrcsi_round_surface_make(&view, 0, 1);
        if (!some_point(&view, &s, &point)) {
            continue;
        }
        double radius = 0.05 * point.s;
        const double v[2] = {between(-radius, radius), between(-radius, radius)};
        const double complex x[2] = {point.x[0] + v[0], point.x[1] + v[1]};
        lrcsi_round_value got = lrcsi_round_value_make(&s, &brdf, &point, v);
        double want = creal(definition(&s, &brdf, x));
        count++;
        check_abs(got.glint + got.diffuse, want, got.error + 1e-11 * want);
        check_most(got.error, 1e-9 * (brdf.A + brdf.B));
    }
    assert_true(count > 100);
}

static void the_bound_holds_at_complex_points(void **state)
{
    (void)state;
    int count = 0;
    double closest = 0;
    lrcs_scene scene;
    lrcsi_view view;
    for (int i = 0; i < 600; i++) {
        lrcsi_round_point point;
        const lrcs_brdf brdf = {i % 2, i % 4 < 2, between(0.1, 1), between(0, 4)};
        if (i % 10 == 0) {
            view = placed_view(kinds[i / 10 % 3], &scene);
        }
        lrcsi_round_surface s = lrcsi_round_surface_make(&view, 0, 1);
        if (!some_point(&view, &s, &point)) {
            continue;
        }
        double e = between(0, 0.3) * point.s;
        double bound = lrcsi_round_bound(&s, &brdf, &point, e);
        for (int k = 0; k < 50 && bound < HUGE_VAL; k++) {
            double v[4];
            double length = 0;
            for (int j = 0; j < 4; j++) {
                v[j] = between(-1, 1);
                length += v[j] * v[j];
            }
            double scale = e / sqrt(length);
            const double complex x[2] = {point.x[0] + scale * (v[0] + I * v[1]),
                                         point.x[1] + scale * (v[2] + I * v[3])};
            double value = cabs(definition(&s, &brdf, x));
            check_most(value, bound * (1 + 1e-12));
            closest = fmax(closest, value / bound);
            count++;
        }
    }
    assert_true(count > 3000 && closest > 0.5);
}

/* Beyond the outline there is no point. */
static void outside_the_outline_there_is_no_point(void **state)
{
    (void)state;
    lrcs_scene scene;
    lrcsi_round_point point;
    lrcsi_view view = placed_view(LRCS_SHAPE_SPHERE, &scene);
    lrcsi_round_surface s = lrcsi_round_surface_make(&view, 0, 1);
    const double x[2] = {s.view[0] + 1.0001 * sqrt(-s.gamma), s.view[1]};
    assert_int_equal(lrcsi_round_point_make(&s, x, &point), 0);
    const double y[2] = {s.view[0] + 0.9999 * sqrt(-s.gamma), s.view[1]};
    assert_int_equal(lrcsi_round_point_make(&s, y, &point), 1);
    const lrcs_brdf brdf = {1, 1, 0.3, 1};
    assert_true(isinf(lrcsi_round_bound(&s, &brdf, &point, 1e-3)));
}

static void check_unknown(lrcsi_round_value value)
{
    assert_true(isinf(value.glint) && isinf(value.diffuse) && isinf(value.error));
}

/* Beyond the outline, so near it that rounding of the position is large, and for materials that
   amplify rounding errors. */
static void values_that_rounding_leaves_open_are_infinite(void **state)
{
    (void)state;
    lrcs_scene scene;
    lrcsi_round_point top;
    const lrcs_brdf brdf = {1, 1, 0.3, 1};
    const lrcs_brdf narrow = {1, 1, 1e-9, 1};
    const lrcs_brdf steep = {0, 1, 1, 1e17};
    lrcsi_view view = placed_view(LRCS_SHAPE_SPHERE, &scene);
    lrcsi_round_surface s = lrcsi_round_surface_make(&view, 0, 1);
    const double radius = sqrt(-s.gamma);
    assert_int_equal(lrcsi_round_point_make(&s, s.view, &top), 1);
    for (int i = 0; i < 40; i++) {
        const double v[2] = {radius * (1 - ldexp(1, -i - 2)), 0};
        const double beyond[2] = {radius * (1 + ldexp(1, -i - 2)), 0};
        lrcsi_round_value at = lrcsi_round_value_make(&s, &brdf, &top, v);
        const double complex x[2] = {s.view[0] + v[0], s.view[1]};
        double want = creal(definition(&s, &brdf, x));
        if (isfinite(at.error)) {
            check_abs(at.glint + at.diffuse, want, at.error + 1e-6 * want);
        } else {
            check_unknown(at);
        }
        check_unknown(lrcsi_round_value_make(&s, &brdf, &top, beyond));
    }
    const double rim[2] = {radius * (1 - 0x1p-53), 0};
    const double half[2] = {0.5 * radius, 0};
    check_unknown(lrcsi_round_value_make(&s, &brdf, &top, rim));
    check_unknown(lrcsi_round_value_make(&s, &narrow, &top, half));
    check_unknown(lrcsi_round_value_make(&s, &steep, &top, half));
}

/* Along its axis a paraboloid has a point above every point of the plane, but not one whose numbers
   overflow. */
static void numbers_that_overflow_are_refused(void **state)
{
    (void)state;
    lrcsi_round_surface s = {.alpha = 0, .beta = 0.5, .gamma = -1};
    lrcsi_round_point point;
    const lrcs_brdf brdf = {1, 1, 0.3, 1};
    const double origin[2] = {0, 0};
    const double far[2] = {1e154, 0}; /* tan^2 overflows, or a coordinate's square too */
    const double farther[2] = {1e160, 0};
    for (int k = 0; k < 3; k++) {
        s.axis[k][k] = 1;
    }
    assert_int_equal(lrcsi_round_point_make(&s, origin, &point), 1);
    check_unknown(lrcsi_round_value_make(&s, &brdf, &point, far));
    check_unknown(lrcsi_round_value_make(&s, &brdf, &point, farther));
    assert_int_equal(lrcsi_round_point_make(&s, farther, &point), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_the_definition),
        cmocka_unit_test(the_bound_holds_at_complex_points),
        cmocka_unit_test(outside_the_outline_there_is_no_point),
        cmocka_unit_test(values_that_rounding_leaves_open_are_infinite),
        cmocka_unit_test(numbers_that_overflow_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
