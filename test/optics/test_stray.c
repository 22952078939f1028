/* SPDX-License-Identifier: MIT */
/* The proved error of a facet in place of a curved patch: sums over whole bodies against the
   definition integrated elsewhere (vectors/shapes.py), and the corners of its domain. */
#include "optics/reflect.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "check.h"

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

/* sigma of a convex mesh seen alone, and the sum of the stray bounds of its curved facets. */
static void facet_sum(const lrcs_mesh *mesh, const lrcs_curvature *curvature, const lrcs_brdf *brdf,
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
                      : 2.0 * pi * size * lrcsi_reflect_stray(brdf, c / size, tan2, curvature);
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
        lrcs_divisions divisions = {arounds[i % 3], 1};
        if (b->kind == LRCS_SHAPE_SPHERE || b->kind == LRCS_SHAPE_DOME ||
            b->kind == LRCS_SHAPE_PARABOLOID) {
            divisions.along = divisions.around / 4;
        }
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_mesh mesh;
        lrcs_curvature curvature;
        assert_int_equal(lrcs_shape_mesh(&shape, &divisions, &work, &mesh, &curvature), LRCS_OK);
        double s_hat[3];
        double sigma = 0.0;
        double bound = 0.0;
        aspect_direction(b->aspect_deg, 0.1 * (double)i, s_hat);
        facet_sum(&mesh, &curvature, &b->brdf, s_hat, &sigma, &bound);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_err_by_less_than_their_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
