/* SPDX-License-Identifier: MIT */
/* The cubature over interpolated normals against references of another method
   (test/vectors/cubature.py), closed forms, and its own promises. */
#include "integrate/cubature/cubature.h"

#include "check.h"

typedef struct vector {
    double normal[3][3], s, m, glint, diffuse;
} vector;

static const vector vectors[] = {
#include "../vectors/cubature.inc"
};
#define VECTORS (sizeof vectors / sizeof vectors[0])

/* An empty sum, with room that all of them share. */
static lrcsi_cubature start(const lrcs_brdf *brdf, const double normal[3][3], double tolerance)
{
    static unsigned char room[1 << 16];
    lrcs_work work = lrcs_work_make(room, lrcsi_cubature_need());
    assert_true(lrcsi_cubature_need() <= sizeof room);
    lrcsi_cubature_cell *stack = lrcsi_cubature_stack(&work);
    assert_non_null(stack);
    lrcsi_cubature_surface surface = lrcsi_cubature_surface_make(brdf, normal, tolerance, stack);
    surface.area = 1;
    surface.position_err = 0x1p-44;
    return lrcsi_cubature_start(&surface);
}

static lrcsi_cubature integrate(const lrcs_brdf *brdf, const double normal[3][3], double tolerance)
{
    lrcsi_cubature sum = start(brdf, normal, tolerance);
    lrcsi_cubature_add(&sum, normal, NULL, 1);
    return sum;
}

/* The references are good to 1e-12. */
static void check_vector(const vector *v, double A, double B, double tolerance)
{
    lrcs_brdf brdf = {A, B, v->s, v->m};
    lrcsi_cubature sum = integrate(&brdf, v->normal, tolerance);
    double want = A * v->glint + B * v->diffuse;
    double got = lrcsi_sum_value(&sum.glint) + lrcsi_sum_value(&sum.diffuse);
    check_abs(got, want, sum.estimate + sum.rounding + 1e-12 * want);
    check_most(sum.estimate, 3 * tolerance * want);
    double steep = 4 * ((A > 0 ? 1 / (v->s * v->s) : 0) + v->m + 5); /* for tan(theta) up to 2 */
    check_most(sum.rounding, sum.surface.position_err * steep * want + 1e-10 * want);
}

static void the_glint_is_within_its_estimate_and_that_within_the_tolerance(void **state)
{
    (void)state;
    for (size_t i = 0; i < VECTORS; i++) {
        if (vectors[i].glint < 1e-30) { /* far out on a flank: only that it is nothing */
            lrcs_brdf brdf = {1, 0, vectors[i].s, 0};
            check_most(integrate(&brdf, vectors[i].normal, 1e-3).estimate, 1e-30);
            continue;
        }
        check_vector(&vectors[i], 1, 0, 1e-3);
        check_vector(&vectors[i], 7, 0, 1e-6);
        check_vector(&vectors[i], 1, 0, 1e-5);
    }
}

static void the_diffuse_part_is_too(void **state)
{
    (void)state;
    for (size_t i = 0; i < VECTORS; i++) {
        check_vector(&vectors[i], 0, 1, 1e-3);
        check_vector(&vectors[i], 0, 0.25, 1e-9);
    }
}

static void both_parts_together_are_each_what_they_are_alone(void **state)
{
    (void)state;
    for (size_t i = 0; i < VECTORS; i++) {
        const vector *v = &vectors[i];
        lrcs_brdf brdf = {1, 0.25, v->s, v->m};
        lrcsi_cubature sum = integrate(&brdf, v->normal, 1e-6);
        double most = sum.estimate + sum.rounding;
        check_abs(lrcsi_sum_value(&sum.glint), v->glint, most);
        check_abs(lrcsi_sum_value(&sum.diffuse), 0.25 * v->diffuse, most);
        check_most(sum.estimate, 3e-6 * (v->glint + 0.25 * v->diffuse));
    }
}

/* A flank may lie below the smallest double by any factor, and no subdivision would tell. */
static void a_mirror_that_shows_no_glint_is_done_at_once(void **state)
{
    (void)state;
    const double normal[3][3] = {{-0.4, -0.2, 0.9}, {-0.2, -0.2, 0.95}, {-0.3, -0.1, 0.95}};
    const lrcs_brdf dark[2] = {{1, 0, 1e-3, 0}, {0, 1, 1e-3, 1e5}};
    for (int i = 0; i < 2; i++) {
        lrcsi_cubature sum = integrate(&dark[i], normal, 1e-3);
        check_most(sum.estimate, 1e-300);
        assert_true(sum.splits < 64);
    }
}

/* Beside brighter surfaces the error allowed is relative to those; the estimate still covers it. */
static void beside_others_the_error_is_larger_and_within_its_estimate(void **state)
{
    (void)state;
    double looser = 0;
    for (size_t i = 0; i < 8 * VECTORS; i++) {
        const vector *v = &vectors[i / 8];
        lrcs_brdf brdf = {1, 0.25, v->s, v->m};
        double want = v->glint + 0.25 * v->diffuse;
        lrcsi_cubature sum = start(&brdf, v->normal, 1e-6);
        sum.surface.reference = pow(10, (double)(i % 8)) * want;
        lrcsi_cubature_add(&sum, v->normal, NULL, 1);
        double got = lrcsi_sum_value(&sum.glint) + lrcsi_sum_value(&sum.diffuse);
        check_abs(got, want, sum.estimate + sum.rounding + 1e-12 * want);
        check_most(sum.estimate, 3e-6 * (want + sum.surface.reference));
        looser = fmax(looser, want > 0 ? sum.estimate / want : 0);
    }
    assert_true(looser > 1e-3);
}

/* From the dark edge, where cos^(m + 1) has no power series, to the slope z: the integral of
   2 t (u / (1 + u))^((m + 1)/2), u = (z t)^2, over t from 0 to 1, by mpmath with 30 digits. */
static void a_dark_edge_is_within_its_estimate(void **state)
{
    (void)state;
    static const struct {
        double z, m, want;
    } edge[] = {{1, 0.5, 0.40164552605569989},
                {1, 0.2, 0.47498317554918742},
                {0.1, 0.5, 0.017984463546417887},
                {0.1, 0.2, 0.039290064101245827}};
    for (int i = 0; i < 40; i++) {
        double z = edge[i % 4].z;
        const double normal[3][3] = {{1, 0, 0}, {1, 0, z}, {1, 0, z}};
        lrcs_brdf brdf = {0, 1, 0.2, edge[i % 4].m};
        lrcsi_cubature sum = start(&brdf, normal, 1e-5);
        sum.surface.reference = ldexp(edge[i % 4].want, i / 4 * 2 - 4);
        lrcsi_cubature_add(&sum, normal, NULL, 1);
        check_abs(lrcsi_sum_value(&sum.diffuse), edge[i % 4].want, sum.estimate + sum.rounding);
    }
}

/* Equal normals of any length: the value of one normal. */
static void a_flat_triangle_is_its_value_to_rounding(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++) {
        double t = 0.3 * i;
        double normal[3][3] = {{t, 0, 1}, {t, 0, 1}, {t, 0, 1}};
        lrcs_brdf brdf = {1, 0.25, 0.5, 3};
        lrcsi_cubature sum = integrate(&brdf, (const double(*)[3])normal, 1e-5);
        double u = t * t;
        double want = pow(1 + u, 2.5) * exp(-u / 0.25) + 0.25 / ((1 + u) * (1 + u));
        double got = lrcsi_sum_value(&sum.glint) + lrcsi_sum_value(&sum.diffuse);
        check_rel(got, want, 2e-14);
        check_abs(got, want, sum.rounding + 1e-15 * want);
        check_most(sum.estimate, 4e-16 * want);
    }
}

/* f_r cos theta at a normal of any length, plainly. */
static double value_at(const lrcs_brdf *brdf, const double n[3])
{
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double c = n[2] / length;
    if (!(c > 0)) {
        return 0;
    }
    double tan2 = (n[0] * n[0] + n[1] * n[1]) / (n[2] * n[2]);
    return brdf->A / pow(c, 5) * exp(-tan2 / (brdf->s * brdf->s)) + brdf->B * pow(c, brdf->m + 1);
}

static void normals_that_face_away_reflect_nothing(void **state)
{
    (void)state;
    const double normal[3][3] = {{1, 0, -0.1}, {0, 1, -0.5}, {1, 1, -1e-12}};
    lrcs_brdf brdf = {1, 1, 0.2, 0};
    lrcsi_cubature sum = integrate(&brdf, normal, 1e-5);
    check_same(lrcsi_sum_value(&sum.glint) + lrcsi_sum_value(&sum.diffuse), 0);
    check_same(sum.estimate + sum.rounding, 0);
}

/* Normals within their error of the plane across the line of sight may reflect, or reflect more
   than as computed: that is within the rounding bound. */
static void nearly_grazing_normals_reflect_within_the_rounding_bound(void **state)
{
    (void)state;
    lrcs_brdf brdf = {0, 1, 0.2, 0};
    for (int i = -4; i <= 4; i++) {
        double z = 0x1p-46 * i;
        const double normal[3][3] = {{1, 0, z}, {1, 0, z}, {1, 0, z}};
        lrcsi_cubature sum = integrate(&brdf, normal, 1e-5);
        double most = lrcsi_sum_value(&sum.diffuse) + sum.rounding;
        check_most(value_at(&brdf, (const double[3]){1, 0, z + sum.surface.position_err}), most);
        check_most(most, 8 * sum.surface.position_err);
    }
}

/* Where no steps are left, the parts that were not subdivided any further count in the bound and
   not in the estimate; also where the normals have the error that position_err states. */
static void without_steps_what_is_left_is_within_its_bound(void **state)
{
    (void)state;
    for (size_t i = 0; i < 4 * VECTORS; i++) {
        const vector *v = &vectors[i / 4];
        lrcs_brdf brdf = {1, 0.25, v->s, v->m};
        double position_err = i % 2 ? 1e-3 : 0x1p-44;
        double normal[3][3];
        for (int k = 0; k < 9; k++) {
            normal[k / 3][k % 3] = v->normal[k / 3][k % 3] + (k % 3 == 0 ? 0.99 : 0) * position_err;
        }
        lrcsi_meter meter = {.limit = i % 4 < 2 ? 0 : 2000};
        lrcsi_cubature sum = start(&brdf, (const double(*)[3])normal, 1e-5);
        sum.surface.position_err = position_err;
        sum.surface.meter = &meter;
        lrcsi_cubature_add(&sum, (const double(*)[3])normal, NULL, 1);
        double want = v->glint + 0.25 * v->diffuse;
        double got = lrcsi_sum_value(&sum.glint) + lrcsi_sum_value(&sum.diffuse);
        check_most(sum.estimate, 1e-4 * (want + got + sum.unresolved));
        check_abs(got, want, sum.unresolved + sum.rounding + sum.estimate + 1e-12 * want);
    }
}

/* For every slope the cubature ends; if it misses the tolerance, the estimate says so. */
static void absurd_slopes_end_in_finite_work_and_an_estimate_that_tells(void **state)
{
    (void)state;
    static const double slope[] = {1e-300, 1e-12, 1e-9, 1e3};
    for (size_t i = 0; i < sizeof slope / sizeof slope[0]; i++) {
        for (size_t k = 0; k < VECTORS; k += 5) { /* one of each kind */
            lrcs_brdf brdf = {1, 0, slope[i], 0};
            lrcsi_cubature sum = integrate(&brdf, vectors[k].normal, 1e-5);
            double got = lrcsi_sum_value(&sum.glint);
            double peak = k < 3 ? vectors[3].glint * (slope[i] / 1e-6) * (slope[i] / 1e-6) : 0;
            assert_true(isfinite(got) && got >= 0 && sum.estimate >= 0);
            assert_true(sum.splits <= (1u << 15) + 3 + 4); /* as examples/flight/README.md says */
            if (slope[i] < 1e-6 && k < 3) { /* the normal towards the laser is inside */
                check_abs(got, peak, sum.estimate + sum.rounding + 1e-5 * peak);
            }
        }
    }
}

static void the_most_is_above_every_value_and_near_the_largest(void **state)
{
    (void)state;
    for (size_t i = 0; i < VECTORS; i++) {
        const vector *v = &vectors[i];
        lrcs_brdf brdf = {1, 0.25, v->s, v->m};
        lrcsi_cubature sum = start(&brdf, v->normal, 1e-5);
        for (int a = 0; a <= 64; a++) {
            for (int b = 0; a + b <= 64; b++) {
                double n[3];
                for (int k = 0; k < 3; k++) {
                    n[k] = (a * v->normal[0][k] + b * v->normal[1][k] +
                            (64 - a - b) * v->normal[2][k]) /
                           64;
                }
                check_most(value_at(&brdf, n), (1 + 1e-12) * (sum.surface.upper_bound.glint +
                                                              sum.surface.upper_bound.diffuse));
            }
        }
    }
}

/* Moments: of the glint by u, of the diffuse term by log(1 + u), 0 for a term that is absent or too
   small for a double. */
static void moments_of_one_incidence_are_products(void **state)
{
    (void)state;
    const double tilted[3] = {0.6, 0, 0.8};
    const double normal[3][3] = {
        {tilted[0], 0, tilted[2]}, {tilted[0], 0, tilted[2]}, {tilted[0], 0, tilted[2]}};
    double u = 0.5625;
    for (int i = 0; i < 4; i++) {
        const lrcs_brdf brdf = {i % 2, i / 2, i == 3 ? 0.4 : 0.02, i == 3 ? 2 : 1e4};
        lrcsi_cubature sum = start(&brdf, normal, 1e-6);
        sum.surface.derivatives = 1;
        lrcsi_cubature_add(&sum, normal, NULL, 1);
        double glint = lrcsi_sum_value(&sum.glint);
        double diffuse = lrcsi_sum_value(&sum.diffuse);
        check_abs(lrcsi_sum_value(&sum.glint_u), glint * u, 1e-14 * glint);
        check_abs(lrcsi_sum_value(&sum.diffuse_log), diffuse * log1p(u), 1e-14 * diffuse);
        assert_true((glint > 0) == (i == 3) && (diffuse > 0) == (i == 3));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_of_one_incidence_are_products),
        cmocka_unit_test(the_glint_is_within_its_estimate_and_that_within_the_tolerance),
        cmocka_unit_test(the_diffuse_part_is_too),
        cmocka_unit_test(both_parts_together_are_each_what_they_are_alone),
        cmocka_unit_test(a_mirror_that_shows_no_glint_is_done_at_once),
        cmocka_unit_test(beside_others_the_error_is_larger_and_within_its_estimate),
        cmocka_unit_test(a_dark_edge_is_within_its_estimate),
        cmocka_unit_test(a_flat_triangle_is_its_value_to_rounding),
        cmocka_unit_test(normals_that_face_away_reflect_nothing),
        cmocka_unit_test(nearly_grazing_normals_reflect_within_the_rounding_bound),
        cmocka_unit_test(without_steps_what_is_left_is_within_its_bound),
        cmocka_unit_test(absurd_slopes_end_in_finite_work_and_an_estimate_that_tells),
        cmocka_unit_test(the_most_is_above_every_value_and_near_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
