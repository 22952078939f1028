/* SPDX-License-Identifier: MIT */
/* The proved error of a facet in place of a curved patch: sums over whole bodies against the
   definition integrated elsewhere (vectors/shapes.py), and the corners of its domain. */
#include "optics/reflect.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "random.h"

typedef struct body {
    int kind, parts;
    double radius, radius2, length;
    lrcs_brdf brdf;
    double aspect_deg, sigma;
} body;

static const body bodies[] = {
#include "../vectors/shapes.inc"
};
#define BODIES (sizeof bodies / sizeof bodies[0])

static const double pi = 3.14159265358979323846;
static unsigned char area[1u << 22];

static lrcs_shape body_shape(const body *b)
{
    return (lrcs_shape){.kind = b->kind,
                        .parts = b->parts,
                        .radius = b->radius,
                        .radius2 = b->radius2,
                        .length = b->length};
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

/* Twice the area vector of a facet. */
static void facet_vector(const lrcs_mesh *mesh, uint32_t i, double out[3])
{
    const double *p[3];
    double e[2][3];
    for (int k = 0; k < 3; k++) {
        p[k] = mesh->vertex[mesh->facet[i].corner[k]].x;
    }
    for (int k = 0; k < 3; k++) {
        e[0][k] = p[1][k] - p[0][k];
        e[1][k] = p[2][k] - p[0][k];
    }
    cross(e[0], e[1], out);
}

/* sigma of a convex mesh that is alone in its scene, and the sum of the deviation bounds of its
   curved facets. */
static void facet_sum(const lrcs_mesh *mesh, const lrcs_patch_bounds *bounds, const lrcs_brdf *brdf,
                      const double s_hat[3], double *sigma, double *bound)
{
    *sigma = 0.0;
    *bound = 0.0;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        double n[3];
        double x[3];
        facet_vector(mesh, i, n);
        cross(n, s_hat, x);
        double size = sqrt(dot(n, n));
        if (size == 0.0) {
            continue;
        }
        double c = dot(n, s_hat);
        double tan2 = c == 0.0 ? HUGE_VAL : dot(x, x) / (c * c);
        lrcsi_reflection f = lrcsi_reflect(brdf, tan2, 0x1p-40);
        *sigma += c > 0.0 ? 2.0 * pi * size * (f.glint + f.diffuse) : 0.0;
        *bound += mesh->facet_smooth[i] == 0
                      ? 0.0
                      : 2.0 * pi * size * lrcsi_reflect_deviation(brdf, c / size, tan2, bounds);
    }
}

/* A direction at the aspect, at an azimuth that favours no facet. */
static void aspect_direction(double deg, double azimuth, double s_hat[3])
{
    double angle = deg * (pi / 180.0);
    s_hat[0] = sin(angle) * cos(azimuth);
    s_hat[1] = sin(angle) * sin(azimuth);
    s_hat[2] = cos(angle);
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void facets_err_by_less_than_their_bound(void **state)
{
    (void)state;
    static const uint32_t arounds[] = {8, 24, 64};
    static double looseness[3 * BODIES];
    size_t count = 0;
    for (size_t i = 0; i < 3 * BODIES; i++) {
        const body *b = &bodies[i / 3];
        lrcs_shape shape = body_shape(b);
        lrcs_divisions divisions = {arounds[i % 3], 1, 0};
        if (b->kind == LRCS_SHAPE_SPHERE || b->kind == LRCS_SHAPE_DOME ||
            b->kind == LRCS_SHAPE_PARABOLOID) {
            divisions.along = divisions.around / 4;
        }
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_mesh mesh;
        lrcs_patch_bounds bounds;
        assert_int_equal(lrcs_shape_mesh(&shape, &divisions, &work, &mesh, &bounds), LRCS_OK);
        double s_hat[3];
        double sigma = 0.0;
        double bound = 0.0;
        aspect_direction(b->aspect_deg, 0.1 * (double)i, s_hat);
        facet_sum(&mesh, &bounds, &b->brdf, s_hat, &sigma, &bound);
        double rounding = 1e-9 * (fabs(b->sigma) + sigma);
        double error = fabs(sigma - b->sigma);
        if (!(error <= bound + rounding)) {
            fprintf(stderr, "body %zu around %u: mesh %.9g, true %.9g, bound %.3g\n", i / 3,
                    divisions.around, sigma, b->sigma, bound);
        }
        check_most(error, bound + rounding);
        if (error > rounding) {
            looseness[count++] = bound / error;
        }
    }
    qsort(looseness, count, sizeof looseness[0], compare_doubles);
    printf("bound / error over %zu: least %.3g, median %.3g, 90th percentile %.3g\n", count,
           looseness[0], looseness[count / 2], looseness[count - count / 10]);
}

/* A number between low and high, evenly in its logarithm. */
static double draw(uint64_t *seed, double low, double high)
{
    return low * pow(high / low, random_fraction(random_mmix(seed)));
}

/* F at an angle; polar coordinates (turn, azimuth) about a normal at theta give the angle. */
static double f_at(const lrcs_brdf *brdf, double theta, double turn, double azimuth)
{
    /* haversines: no loss for small angles */
    double a = sin(0.5 * (theta - turn));
    double b = sin(0.5 * azimuth);
    double h = a * a + sin(theta) * sin(turn) * b * b;
    double c = 1.0 - 2.0 * h;
    double tan2 = 4.0 * h * (1.0 - h) / (c * c);
    lrcsi_reflection f = lrcsi_reflect(brdf, tan2, 0.0);
    return c > 0.0 ? f.glint + f.diffuse : 0.0;
}

/* A round cap of normals about the facet's: its bias is 0, its mean squared turn spread^2.
   Midpoints in turn^2 are exact for the second-order error, which is all of the bound for a small
   cap. */
static void a_round_cap_of_normals_errs_by_less_than_its_bound(void **state)
{
    (void)state;
    enum { RINGS = 24, SPOKES = 32 };
    uint64_t seed = 5;
    double tightest = HUGE_VAL;
    for (int i = 0; i < 4000; i++) {
        lrcs_brdf brdf = {i % 3 ? 1.0 : 0.0, i % 3 != 1 ? 1.0 : 0.0, draw(&seed, 1e-6, 1e3),
                          draw(&seed, 1e-3, 1e4) - 1e-3};
        double theta = i % 7 ? draw(&seed, 1e-4, 3.1) : 0.5 * pi - draw(&seed, 1e-9, 0.1);
        double scale = fmin(1.0, brdf.A > 0.0 ? brdf.s : 1.0 / sqrt(brdf.m + 2.0));
        double turn = draw(&seed, 1e-3, 2.0) * scale;
        if (i % 5 == 0) {
            theta = draw(&seed, 1e-3, 3.0) * scale;
        }
        double sum = 0.0;
        double cap_area = 0.0;
        double square = 0.0;
        for (int k = 0; k < RINGS * SPOKES; k++) {
            double t = turn * sqrt((k / SPOKES + 0.5) / RINGS);
            double weight = sin(t) / t;
            cap_area += weight;
            square += weight * t * t;
            sum += weight * f_at(&brdf, theta, t, pi * (k % SPOKES + 0.5) / SPOKES);
        }
        lrcs_patch_bounds cap = {turn, 0.0, 0.0, sqrt(square / cap_area)};
        double slope = tan(theta);
        double here = f_at(&brdf, theta, 0.0, 0.0);
        double bound = lrcsi_reflect_deviation(&brdf, cos(theta), slope * slope, &cap);
        double error = fabs(sum / cap_area - here);
        double rounding = 1e-11 * fmax(here, sum / cap_area);
        check_most(error, bound + rounding);
        if (error > 100.0 * rounding) {
            tightest = fmin(tightest, bound / error);
        }
    }
    check_most(tightest, 1.01); /* about the normal of a small cap nothing is given away */
}

static void a_flat_patch_has_no_deviation(void **state)
{
    (void)state;
    const lrcs_patch_bounds flat = {0.0, 0.0, 0.0, 0.0};
    const lrcs_brdf brdf = {1.0, 1.0, 1e-6, 1e4};
    check_same(lrcsi_reflect_deviation(&brdf, 1.0, 0.0, &flat), 0.0);
    check_same(lrcsi_reflect_deviation(&brdf, 0.0, HUGE_VAL, &flat), 0.0);
}

static void a_patch_wholly_turned_away_has_no_error(void **state)
{
    (void)state;
    const lrcs_patch_bounds c = {0.1, 0.01, 0.001, 0.05};
    const lrcs_brdf brdf = {1.0, 1.0, 0.3, 0.0};
    double t = tan(0.5 * pi - 0.11);
    check_same(lrcsi_reflect_deviation(&brdf, -0.11, t * t, &c), 0.0);
    t = tan(0.5 * pi - 0.09);
    assert_true(lrcsi_reflect_deviation(&brdf, -0.09, t * t, &c) > 0.0);
    assert_true(lrcsi_reflect_deviation(&brdf, 0.0, HUGE_VAL, &c) > 0.0);
}

static void no_corner_of_the_domain_gives_nan_or_less_than_zero(void **state)
{
    (void)state;
    const double s[] = {1e-300, 1e-160, 1e-6, 0.2, 1.0, 1e3, 1e76, 1e200, 1e300};
    const double m[] = {0.0, 1e-300, 0.5, 1e4, 1e300};
    const double turn[] = {1e-300, 1e-16, 1e-3, 0.5, 1.6, 3.14159265358979};
    const double tan2[] = {0.0, 5e-324, 1e-200, 1e-9, 1.0, 1e9, 1e32, 1e300, HUGE_VAL};
    for (int i = 0; i < 9 * 5 * 6 * 9 * 2 * 3; i++) {
        lrcs_brdf brdf = {i % 3 ? 1.0 : 0.0, i % 3 < 2 ? 1.0 : 0.0, s[i / 3 % 9], m[i / 27 % 5]};
        double t = turn[i / 135 % 6];
        double u = tan2[i / 810 % 9];
        double c = (i / 7290 ? -1.0 : 1.0) / sqrt(1.0 + u);
        lrcs_patch_bounds bounds = {t, 0.1, 0.1 * t, 0.5 * t};
        double deviation = lrcsi_reflect_deviation(&brdf, c, u, &bounds);
        assert_true(deviation >= 0.0); /* no NaN either */
        if (brdf.s < 1e70 && t < 3.0 && u < 1e30) {
            assert_true(isfinite(deviation) || brdf.s > 0.5);
        }
    }
}

static void a_finer_patch_deviates_less(void **state)
{
    (void)state;
    const lrcs_brdf brdf = {1.0, 0.25, 0.2, 0.5};
    for (int i = 0; i < 60; i++) {
        double theta = 0.05 * i;
        double t = tan(theta);
        double last = HUGE_VAL;
        for (double turn = 1.0; turn > 1e-6; turn *= 0.5) {
            lrcs_patch_bounds c = {turn, turn * turn / 6.0, turn * turn / 6.0, 0.6 * turn};
            double deviation = lrcsi_reflect_deviation(&brdf, cos(theta), t * t, &c);
            check_most(deviation, last);
            last = deviation;
        }
        check_most(last, 1e-9);
    }
}

/* Over dense angles in the range, and never more than the largest by 1 % of a step's growth. */
static void the_most_of_f_r_cos_is_its_largest_value_over_the_range(void **state)
{
    (void)state;
    static const double slope[] = {1e-6, 0.05, 0.2, 0.8, 10};
    static const double centre[] = {0, 0.1, 0.7, 1.5, 1.8};
    static const double turn[] = {1e-7, 0.05, 0.3, 1.2};
    for (int i = 0; i < 5 * 5 * 4; i++) {
        lrcs_brdf brdf = {2, 0.25, slope[i % 5], 3};
        double theta = centre[i / 5 % 5];
        double half = turn[i / 25];
        lrcsi_reflection most = lrcsi_reflect_bound(&brdf, theta, half);
        double glint = 0;
        double diffuse = 0;
        for (int k = 0; k <= 20000; k++) {
            double angle = fabs(theta - half + 2 * half * k / 20000);
            double t = tan(angle);
            if (angle < 1.5707963) {
                lrcsi_reflection at = lrcsi_reflect(&brdf, t * t, 0);
                glint = fmax(glint, at.glint / cos(angle));
                diffuse = fmax(diffuse, at.diffuse / cos(angle));
            }
        }
        check_most(glint, most.glint);
        check_most(diffuse, most.diffuse);
        check_most(most.diffuse, diffuse * 1.001 + 1e-9);
        if (brdf.s >= 0.05) { /* the samples see narrower peaks not at all */
            check_most(most.glint, glint * 1.01 + 1e-300);
        }
    }
}

static void each_number_of_a_curvature_counts_for_itself(void **state)
{
    (void)state;
    lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    double f = lrcsi_reflect(&brdf, 0.01, 0).glint + lrcsi_reflect(&brdf, 0.01, 0).diffuse;
    double cosine = 1 / sqrt(1.01);
    const lrcs_patch_bounds larger = {0, 0.125, 0, 0};
    const lrcs_patch_bounds leaning = {0, 0, 0.125, 0}; /* all normals alike: they lean nowhere */
    const lrcs_patch_bounds spread = {0, 0, 0, 0.125};
    double deviation = lrcsi_reflect_deviation(&brdf, cosine, 0.01, &larger);
    assert_true(deviation >= 0.125 * f && deviation <= 0.126 * f);
    check_same(lrcsi_reflect_deviation(&brdf, cosine, 0.01, &leaning), 0.0);
    assert_true(lrcsi_reflect_deviation(&brdf, cosine, 0.01, &spread) > 0.0);
}

/* Where tan^2 overflows the facet itself reflects nothing, its patch may. */
static void a_patch_nearly_edge_on_deviates_by_what_it_reflects(void **state)
{
    (void)state;
    lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    const lrcs_patch_bounds c = {0.1, 0.001, 0.001, 0.06};
    lrcsi_deviation deviation = lrcsi_deviation_make(&brdf, 1e-200, HUGE_VAL, &c);
    double t = 1 / tan(0.1);
    lrcsi_reflection f = lrcsi_reflect(&brdf, t * t, 0);
    check_same(deviation.value, 0.0);
    assert_true(deviation.value_max >= f.glint + f.diffuse &&
                deviation.value_max <= 1.5 * (f.glint + f.diffuse));
    assert_true(deviation.point >= f.glint + f.diffuse && isfinite(deviation.whole));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_err_by_less_than_their_bound),
        cmocka_unit_test(a_round_cap_of_normals_errs_by_less_than_its_bound),
        cmocka_unit_test(a_flat_patch_has_no_deviation),
        cmocka_unit_test(a_patch_wholly_turned_away_has_no_error),
        cmocka_unit_test(no_corner_of_the_domain_gives_nan_or_less_than_zero),
        cmocka_unit_test(a_finer_patch_deviates_less),
        cmocka_unit_test(the_most_of_f_r_cos_is_its_largest_value_over_the_range),
        cmocka_unit_test(each_number_of_a_curvature_counts_for_itself),
        cmocka_unit_test(a_patch_nearly_edge_on_deviates_by_what_it_reflects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
