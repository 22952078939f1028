/* SPDX-License-Identifier: MIT */
/* Closed forms of every shape against the defining integral (mpmath, test/vectors/closed.py), their
   bounds, their limits into one another, and what is refused. */
#include <lrcs/shape.h>

#include "check.h"
#include "optics/closed.h"

static const struct vector {
    int kind, parts;
    double size[3], radius, radius2, length, half_angle_deg;
    int by_direction;
    double where[3], A, B, s, m, glint, diffuse;
} vectors[] = {
#include "vectors/closed.inc"
};

/* The accepted relative error of each part; no vector needs more. */
#define ACCURACY 1e-13

static lrcs_closed_form closed_of(const lrcs_shape *shape, const lrcs_brdf *brdf, double deg)
{
    lrcs_aspect aspect = {0, deg, {0, 0, 0}};
    lrcs_closed_form closed = {nan(""), nan(""), nan(""), nan("")};
    assert_int_equal(lrcs_closed_eval(shape, brdf, &aspect, &closed), LRCS_OK);
    return closed;
}

static lrcs_closed_form vector_closed(const struct vector *v)
{
    lrcs_shape shape = {v->kind,          v->parts,   {v->size[0], v->size[1], v->size[2]},
                        v->radius,        v->radius2, v->length,
                        v->half_angle_deg};
    lrcs_brdf brdf = {v->A, v->B, v->s, v->m};
    lrcs_aspect aspect = {v->by_direction, v->where[0], {v->where[0], v->where[1], v->where[2]}};
    lrcs_closed_form closed = {nan(""), nan(""), nan(""), nan("")};
    assert_int_equal(lrcs_closed_eval(&shape, &brdf, &aspect, &closed), LRCS_OK);
    return closed;
}

static void every_shape_agrees_with_the_defining_integral(void **state)
{
    (void)state;
    double worst = 0.0;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        const struct vector *v = &vectors[i];
        lrcs_closed_form c = vector_closed(v);
        check_abs(c.sigma_glint_m2, v->glint, ACCURACY * v->glint + 0x1p-1070);
        check_abs(c.sigma_diffuse_m2, v->diffuse, ACCURACY * v->diffuse + 0x1p-1070);
        worst = fmax(worst, v->glint > 1e-300 ? fabs(c.sigma_glint_m2 / v->glint - 1) : 0);
        worst = fmax(worst, v->diffuse > 1e-300 ? fabs(c.sigma_diffuse_m2 / v->diffuse - 1) : 0);
    }
    print_message("worst relative error of a part %.2g\n", worst);
}

static void the_bound_holds_and_is_tight(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        const struct vector *v = &vectors[i];
        lrcs_closed_form c = vector_closed(v);
        check_most(fabs(c.sigma_glint_m2 - v->glint) + fabs(c.sigma_diffuse_m2 - v->diffuse),
                   c.bound_m2);
        check_most(fabs(c.sigma_m2 - (v->glint + v->diffuse)), c.bound_m2);
        check_most(c.bound_m2, 2e-14 * c.sigma_m2 + 0x1p-890);
    }
}

/* Values worked out once to 12 digits: A = 1, B = 0.25, s = 0.2, m = 0.5. */
static void the_spot_values_of_the_design_come_out(void **state)
{
    (void)state;
    lrcs_brdf brdf = lrcs_brdf_default();
    lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {1, 1, 0}};
    lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    lrcs_shape cylinder = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2};
    lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 15};
    check_rel(closed_of(&plate, &brdf, 0).sigma_m2, 15.7079632679, 1e-11);
    check_rel(closed_of(&plate, &brdf, 20).sigma_m2, 3.27656091132, 1e-11);
    check_rel(closed_of(&plate, &brdf, 60).sigma_m2, 0.55536036727, 1e-11);
    check_rel(closed_of(&plate, &brdf, 85).sigma_m2, 0.00704514431103, 1e-11);
    check_rel(closed_of(&sphere, &brdf, 85).sigma_m2, 7.24989628827, 1e-11);
    check_rel(closed_of(&cylinder, &brdf, 90).sigma_m2, 9.06063791671, 1e-11);
    check_rel(closed_of(&cylinder, &brdf, 60).sigma_m2, 3.59042673334, 1e-11);
    check_rel(closed_of(&cylinder, &brdf, 30).sigma_m2, 2.52482862495, 1e-11);
    check_rel(closed_of(&cone, &brdf, 0).sigma_m2, 0.324888321144, 2e-12);
}

static void what_faces_away_or_stands_edge_on_is_exactly_nothing(void **state)
{
    (void)state;
    lrcs_brdf brdf = {1.0, 0.25, 1e3, 0.0};
    lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {1, 1, 0}};
    lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .parts = 1, .radius = 1, .half_angle_deg = 10};
    lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .parts = 1, .radius = 1};
    lrcs_shape tube = {.kind = LRCS_SHAPE_CYLINDER, .parts = 1, .radius = 1, .length = 1};
    const struct {
        const lrcs_shape *shape;
        double deg;
    } dark[] = {{&plate, 90}, {&plate, 91}, {&plate, 180}, {&cone, 170}, {&cone, 175},
                {&cone, 180}, {&dome, 180}, {&tube, 0},    {&tube, 180}};
    for (size_t i = 0; i < sizeof dark / sizeof dark[0]; i++) {
        lrcs_closed_form c = closed_of(dark[i].shape, &brdf, dark[i].deg);
        check_same(c.sigma_m2, 0.0);
        check_same(c.bound_m2, 0.0);
    }
}

static void sigma_scales_exactly_by_powers_of_two(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i += 7) {
        struct vector v = vectors[i];
        lrcs_closed_form c = vector_closed(&v);
        double *length[] = {&v.size[0], &v.size[1], &v.size[2], &v.radius, &v.radius2, &v.length};
        for (int k = 0; k < 6; k++) {
            *length[k] *= 0x1p-6;
        }
        lrcs_closed_form d = vector_closed(&v);
        if (c.sigma_glint_m2 > 1e-290 || c.sigma_glint_m2 == 0.0) {
            check_same(d.sigma_glint_m2, c.sigma_glint_m2 * 0x1p-12);
        }
        if (c.sigma_diffuse_m2 > 1e-290) {
            check_same(d.sigma_diffuse_m2, c.sigma_diffuse_m2 * 0x1p-12);
        }
    }
}

/* Two shapes that are the same body, whose closed forms are computed by different formulas. */
static void shapes_that_coincide_agree(void **state)
{
    (void)state;
    const lrcs_shape pair[][2] = {
        {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.7, .radius2 = 0.7, .length = 3},
         {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.7, .length = 3}},
        {{.kind = LRCS_SHAPE_FRUSTUM, .radius2 = 0.7, .length = 3},
         {.kind = LRCS_SHAPE_CONE, .radius = 0.7, .length = 3}},
        {{.kind = LRCS_SHAPE_CONE, .radius = 1, .half_angle_deg = 45},
         {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 1}},
        {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 1, .radius2 = 1, .length = 0},
         {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 0}},
    };
    const lrcs_brdf brdf[] = {{1, 0.25, 0.2, 0.5}, {1, 0.25, 1e-3, 1e3}, {1, 0.25, 5, 0}};
    for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
        for (size_t k = 0; k < 3; k++) {
            for (double deg = 0; deg <= 180; deg += 7.5) {
                lrcs_closed_form a = closed_of(&pair[i][0], &brdf[k], deg);
                lrcs_closed_form b = closed_of(&pair[i][1], &brdf[k], deg);
                check_abs(a.sigma_m2, b.sigma_m2, a.bound_m2 + b.bound_m2);
            }
        }
    }
}

static void limits_are_reached(void **state)
{
    (void)state;
    lrcs_brdf brdf = lrcs_brdf_default();
    lrcs_shape cone = {
        .kind = LRCS_SHAPE_CONE, .parts = 1, .radius = 1, .half_angle_deg = 89.9999999};
    lrcs_shape bowl = {.kind = LRCS_SHAPE_PARABOLOID, .parts = 1, .radius = 1, .length = 1e-9};
    lrcs_shape thin = {.kind = LRCS_SHAPE_PARABOLOID, .parts = 1, .radius = 1, .length = 1e-149};
    lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 1};
    for (double deg = 0; deg < 90; deg += 7.5) {
        double flat = closed_of(&disc, &brdf, deg).sigma_m2;
        check_rel(closed_of(&cone, &brdf, deg).sigma_m2, flat, 1e-7);
        check_rel(closed_of(&bowl, &brdf, deg).sigma_m2, flat, 1e-7);
        check_rel(closed_of(&thin, &brdf, deg).sigma_m2, flat, 1e-14);
    }
}

/* The dome seen from alpha and from 180 - alpha are the two halves of a sphere. */
static void two_domes_make_a_sphere(void **state)
{
    (void)state;
    lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .parts = 1, .radius = 1};
    const lrcs_brdf brdf[] = {{1, 0.25, 0.2, 0.5}, {1, 0.25, 1e-6, 1e4}, {1, 0.25, 1e3, 0}};
    for (size_t k = 0; k < 3; k++) {
        lrcs_closed_form whole = closed_of(&sphere, &brdf[k], 0);
        for (double deg = 0; deg <= 90; deg += 3.75) {
            lrcs_closed_form upper = closed_of(&dome, &brdf[k], deg);
            lrcs_closed_form lower = closed_of(&dome, &brdf[k], 180 - deg);
            check_abs(upper.sigma_m2 + lower.sigma_m2, whole.sigma_m2,
                      upper.bound_m2 + lower.bound_m2 + whole.bound_m2);
        }
    }
}

static void a_direction_and_its_angle_give_the_same(void **state)
{
    (void)state;
    lrcs_brdf brdf = lrcs_brdf_default();
    const lrcs_shape shapes[] = {
        {.kind = LRCS_SHAPE_DISC, .radius = 1},
        {.kind = LRCS_SHAPE_BOX, .size = {1, 2, 3}},
        {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 2},
        {.kind = LRCS_SHAPE_DOME, .radius = 1},
        {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 2},
    };
    const struct {
        double deg, direction[3];
    } same[] = {{0, {0, 0, 1e-300}},
                {45, {3e200, 0, 3e200}},
                {90, {1e-200, 0, 0}},
                {135, {7, 0, -7}},
                {180, {0, 0, -3}}};
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        for (size_t k = 0; k < sizeof same / sizeof same[0]; k++) {
            lrcs_aspect aspect = {
                1, 0, {same[k].direction[0], same[k].direction[1], same[k].direction[2]}};
            lrcs_closed_form by_direction;
            lrcs_closed_form by_angle = closed_of(&shapes[i], &brdf, same[k].deg);
            assert_int_equal(lrcs_closed_eval(&shapes[i], &brdf, &aspect, &by_direction), LRCS_OK);
            check_rel(by_direction.sigma_m2, by_angle.sigma_m2, 1e-15);
        }
    }
}

/* tau + alpha is a right angle to the last bit: the normals of the rim end on the horizon. */
static void a_rim_exactly_on_the_horizon_is_as_beside_it(void **state)
{
    (void)state;
    static const double rim[][4] = {/* radius, length, and x and z of the direction */
                                    {0.5, 0.25, 1, 1},
                                    {1, 0.375, 4, 3},
                                    {3, 2, 3, 4},
                                    {1, 0.5, -2, 2}};
    for (size_t i = 0; i < sizeof rim / sizeof *rim; i++) {
        const lrcs_shape shape = {
            .kind = LRCS_SHAPE_PARABOLOID, .radius = rim[i][0], .length = rim[i][1]};
        const lrcs_brdf brdf = {1, 0.25, 0.4, 2.5};
        lrcs_closed_form at[3];
        for (int k = 0; k < 3; k++) {
            lrcs_aspect aspect = {.by_direction = 1,
                                  .direction = {rim[i][2], 0, rim[i][3] * (1 + (k - 1) * 0x1p-50)}};
            assert_int_equal(lrcs_closed_eval(&shape, &brdf, &aspect, &at[k]), LRCS_OK);
            check_most(at[k].bound_m2, 1e-13 * at[k].sigma_m2);
        }
        check_rel(at[1].sigma_m2, at[0].sigma_m2, 1e-13);
        check_rel(at[1].sigma_m2, at[2].sigma_m2, 1e-13);
    }
}

static void no_corner_of_the_domain_gives_a_nan(void **state)
{
    (void)state;
    static const double slope[] = {1e-100, 1e-6, 0.7072, 1e3, 1e30};
    static const double power[] = {0, 1e-300, 1e4, 1e300};
    static const double angle[] = {0, 5e-324, 1e-100, 1e-8, 44, 90, 179.99999999999997, 180};
    static const double length[] = {0, 1e-100, 1, 1e100};
    for (int kind = 0; kind < LRCS_SHAPE_KINDS; kind++) {
        for (size_t i = 0; i < 5 * 4 * 8 * 4 * 4; i += 7) {
            lrcs_brdf brdf = {1, 1, slope[i % 5], power[i / 5 % 4]};
            double a = length[i / 160 % 4];
            double b = length[i / 640];
            lrcs_shape shape = {.kind = kind};
            if (kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_BOX) {
                shape.size[0] = a;
                shape.size[1] = b;
                shape.size[2] = kind == LRCS_SHAPE_BOX ? a : 0;
            } else {
                int long_kind = kind >= LRCS_SHAPE_CYLINDER;
                shape.radius = a;
                shape.length = long_kind ? b : 0;
                shape.radius2 = kind == LRCS_SHAPE_FRUSTUM ? b : 0;
            }
            lrcs_aspect aspect = {0, angle[i / 20 % 8], {0, 0, 0}};
            lrcs_closed_form c = {0, 0, 0, 0};
            int status = lrcs_closed_eval(&shape, &brdf, &aspect, &c);
            if (status == LRCS_OK) {
                assert_true(isfinite(c.sigma_m2) && c.sigma_m2 >= 0 && c.bound_m2 >= 0);
                check_most(c.bound_m2, 2e-14 * c.sigma_m2 + 0x1p-980 * (a * a + b * b) + 0x1p-900);
            }
        }
    }
}

static void what_is_outside_the_domain_is_refused(void **state)
{
    (void)state;
    lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    lrcs_brdf brdf = lrcs_brdf_default();
    lrcs_closed_form c = {1, 2, 3, 4};
    static const struct {
        lrcs_aspect aspect;
        int status;
    } bad[] = {{{0, -1, {0, 0, 0}}, LRCS_E_ARGUMENT},
               {{0, 180.1, {0, 0, 0}}, LRCS_E_ARGUMENT},
               {{0, HUGE_VAL, {0, 0, 0}}, LRCS_E_NUMBER},
               {{1, 0, {0, 0, 0}}, LRCS_E_ARGUMENT},
               {{1, 0, {1, HUGE_VAL, 0}}, LRCS_E_NUMBER}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(lrcs_closed_eval(&sphere, &brdf, &bad[i].aspect, &c), bad[i].status);
    }
    lrcs_aspect aspect = {0, 0, {0, 0, 0}};
    lrcs_brdf wrong = {1, 0, 0, 0};
    assert_int_equal(lrcs_closed_eval(&sphere, &wrong, &aspect, &c), LRCS_E_NUMBER);
    lrcs_brdf vast = {1e300, 0, 1e30, 0};
    assert_int_equal(lrcs_closed_eval(&sphere, &vast, &aspect, &c), LRCS_E_NUMBER);
    lrcs_brdf narrow = {1, 0.25, 0x1p-334, 0.5};
    assert_int_equal(lrcs_closed_eval(&sphere, &narrow, &aspect, &c), LRCS_E_NUMBER);
    lrcs_brdf wide = {1, 0.25, 0x1p334, 0.5};
    assert_int_equal(lrcs_closed_eval(&sphere, &wide, &aspect, &c), LRCS_E_NUMBER);
    sphere.radius = 1e-151;
    assert_int_equal(lrcs_closed_eval(&sphere, &brdf, &aspect, &c), LRCS_E_NUMBER);
    sphere.radius = -1;
    assert_int_equal(lrcs_closed_eval(&sphere, &brdf, &aspect, &c), LRCS_E_NUMBER);
    check_same(c.sigma_m2, 1.0);
    check_same(c.bound_m2, 4.0);
}

/* 4 pi B times the integral of cos^(2+m) over a hemisphere, 2 pi r^2 / (3 + m). */
static void a_matt_sphere_needs_no_slope(void **state)
{
    (void)state;
    lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 2};
    lrcs_aspect aspect = {0, 30, {0, 0, 0}};
    for (int m = 0; m < 4; m++) {
        lrcs_brdf brdf = {0, 0.25, 0, m};
        lrcs_closed_form c;
        assert_int_equal(lrcs_closed_eval(&sphere, &brdf, &aspect, &c), LRCS_OK);
        check_same(c.sigma_glint_m2, 0.0);
        check_abs(c.sigma_m2, 78.956835208714869 / (3 + m), c.bound_m2 + 1e-14);
    }
}

/* Cauchy: a convex body's projected area, averaged over all directions, is a quarter of its
   surface. */
static void silhouettes_average_a_quarter_of_the_surface(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846;
    const struct {
        lrcs_shape shape;
        double surface;
    } body[] = {
        {{.kind = LRCS_SHAPE_SPHERE, .radius = 2}, 16 * pi},
        {{.kind = LRCS_SHAPE_DOME, .radius = 2}, 12 * pi},
        {{.kind = LRCS_SHAPE_CYLINDER, .radius = 2, .length = 3}, 20 * pi},
        {{.kind = LRCS_SHAPE_CONE, .radius = 3, .length = 4}, 24 * pi},
        {{.kind = LRCS_SHAPE_CONE, .radius = 1, .half_angle_deg = 30}, 3 * pi},
        {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 1, .radius2 = 4, .length = 4}, 42 * pi},
        {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 4, .radius2 = 1, .length = 4}, 42 * pi},
        {{.kind = LRCS_SHAPE_PARABOLOID, .radius = 2, .length = 2},
         pi * (4 + (pow(20, 1.5) - 8) / 12)},
    };
    for (size_t i = 0; i < sizeof body / sizeof *body; i++) {
        double sum = 0;
        for (int k = 0; k < 20000; k++) {
            double aspect = pi * (k + 0.5) / 20000;
            sum += lrcsi_closed_silhouette(&body[i].shape, sin(aspect), cos(aspect)) * sin(aspect);
        }
        check_rel(0.5 * sum * pi / 20000, 0.25 * body[i].surface, 1e-7);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_agrees_with_the_defining_integral),
        cmocka_unit_test(the_bound_holds_and_is_tight),
        cmocka_unit_test(the_spot_values_of_the_design_come_out),
        cmocka_unit_test(what_faces_away_or_stands_edge_on_is_exactly_nothing),
        cmocka_unit_test(sigma_scales_exactly_by_powers_of_two),
        cmocka_unit_test(shapes_that_coincide_agree),
        cmocka_unit_test(limits_are_reached),
        cmocka_unit_test(two_domes_make_a_sphere),
        cmocka_unit_test(a_direction_and_its_angle_give_the_same),
        cmocka_unit_test(a_rim_exactly_on_the_horizon_is_as_beside_it),
        cmocka_unit_test(no_corner_of_the_domain_gives_a_nan),
        cmocka_unit_test(what_is_outside_the_domain_is_refused),
        cmocka_unit_test(a_matt_sphere_needs_no_slope),
        cmocka_unit_test(silhouettes_average_a_quarter_of_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
