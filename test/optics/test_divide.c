/* SPDX-License-Identifier: MIT */
/* How many facets are planned: enough for the proved error of the mesh itself, evaluated facet by
   facet, and no more than allowed. */
#include <lrcs/shape.h>

#include <math.h>

#include "check.h"
#include "optics/reflect.h"

static const double pi = 3.14159265358979323846;
static unsigned char area[48u << 20];

static const lrcs_shape bodies[] = {
    {.kind = LRCS_SHAPE_SPHERE, .radius = 1},
    {.kind = LRCS_SHAPE_DOME, .radius = 1, .parts = LRCS_SHAPE_WALL},
    {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2, .parts = LRCS_SHAPE_WALL},
    {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 15, .parts = LRCS_SHAPE_WALL},
    {.kind = LRCS_SHAPE_FRUSTUM,
     .radius = 0.5,
     .radius2 = 1,
     .length = 1,
     .parts = LRCS_SHAPE_WALL},
    {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 1, .parts = LRCS_SHAPE_WALL},
};
#define BODIES (sizeof bodies / sizeof bodies[0])

/* Sums over the facets from a direction: sigma, proved error, and the area. */
static void facet_sums(const lrcs_mesh *mesh, const lrcs_patch_bounds *bounds,
                       const lrcs_brdf *brdf, const double s_hat[3], double sum[3])
{
    sum[0] = sum[1] = sum[2] = 0.0;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        const double *p[3];
        double n[3];
        double x[3];
        for (int k = 0; k < 3; k++) {
            p[k] = mesh->vertex[mesh->facet[i].corner[k]].x;
        }
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3;
            int b = (k + 2) % 3;
            n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) -
                   (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
        }
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3;
            int b = (k + 2) % 3;
            x[k] = n[a] * s_hat[b] - n[b] * s_hat[a];
        }
        double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        double c = n[0] * s_hat[0] + n[1] * s_hat[1] + n[2] * s_hat[2];
        double tan2 = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / (c * c);
        lrcsi_reflection f = lrcsi_reflect(brdf, tan2, 0.0);
        sum[0] += c > 0.0 ? 2.0 * pi * size * (f.glint + f.diffuse) : 0.0;
        sum[1] += 2.0 * pi * size * lrcsi_reflect_deviation(brdf, c / size, tan2, bounds);
        sum[2] += 0.5 * size;
    }
}

/* sigma per unit of surface, mean over attitudes, of any convex body: 2 pi times the integral of
   F sin(theta). */
static double mean_sigma(const lrcs_brdf *brdf)
{
    enum { NODES = 4000 };
    double sum = 0.0;
    for (int k = 0; k < NODES; k++) {
        double theta = 0.5 * pi * (k + 0.5) / NODES;
        lrcsi_reflection f = lrcsi_reflect(brdf, tan(theta) * tan(theta), 0.0);
        sum += (f.glint + f.diffuse) * sin(theta) * (0.5 * pi / NODES);
    }
    return 2.0 * pi * sum;
}

static void the_planned_mesh_proves_the_tolerance(void **state)
{
    (void)state;
    const double s[] = {0.05, 0.2, 0.7};
    for (size_t i = 0; i < BODIES * 3; i++) {
        lrcs_fineness fineness = lrcs_fineness_default();
        fineness.tolerance = 1e-2;
        fineness.brdf.s = s[i % 3];
        lrcs_divisions divisions;
        lrcs_mesh_counts counts;
        assert_int_equal(lrcs_shape_count(&bodies[i / 3], &fineness, &divisions, &counts), LRCS_OK);
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_mesh mesh;
        lrcs_patch_bounds c;
        assert_int_equal(lrcs_shape_mesh(&bodies[i / 3], &divisions, &work, &mesh, &c), LRCS_OK);
        assert_int_equal(mesh.vertex_count, counts.vertices);
        assert_int_equal(mesh.facet_count, counts.facets);
        double worst = 0.0;
        for (int k = 0; k < 13; k++) {
            double angle = pi * (k + 0.37) / 13.0;
            double s_hat[3] = {sin(angle) * cos(1.1), sin(angle) * sin(1.1), cos(angle)};
            double sum[3];
            facet_sums(&mesh, &c, &fineness.brdf, s_hat, sum);
            double base = fmax(sum[0], sum[2] * mean_sigma(&fineness.brdf));
            worst = fmax(worst, sum[1] / base);
        }
        check_most(worst, 1.25e-2); /* the plan samples aspects: it aims, the certificate proves */
    }
}

static void a_tighter_tolerance_never_has_fewer_facets(void **state)
{
    (void)state;
    for (size_t i = 0; i < BODIES; i++) {
        uint32_t last = 0;
        for (double tolerance = 1.0; tolerance > 1e-5; tolerance *= 0.2) {
            lrcs_fineness fineness = lrcs_fineness_default();
            fineness.tolerance = tolerance;
            lrcs_divisions divisions;
            lrcs_mesh_counts counts;
            assert_int_equal(lrcs_shape_count(&bodies[i], &fineness, &divisions, &counts), LRCS_OK);
            assert_true(counts.facets >= last && counts.facets <= fineness.max_facets);
            last = counts.facets;
        }
    }
}

static void no_count_exceeds_its_cap(void **state)
{
    (void)state;
    for (int kind = 0; kind < LRCS_SHAPE_KINDS; kind++) {
        lrcs_shape shape = {.kind = kind};
        shape.half_angle_deg = kind == LRCS_SHAPE_CONE ? 40.0 : 0.0;
        shape.radius = kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_BOX ? 0.0 : 1.0;
        shape.length = kind == LRCS_SHAPE_CYLINDER || kind == LRCS_SHAPE_PARABOLOID ? 100.0 : 0.0;
        for (uint32_t most = 64; most < 100000; most = most * 3 / 2 + 1) {
            lrcs_fineness fineness = {1e-9, {1.0, 0.25, 0.3, 0.5}, most};
            lrcs_divisions divisions;
            lrcs_mesh_counts counts;
            assert_int_equal(lrcs_shape_count(&shape, &fineness, &divisions, &counts), LRCS_OK);
            assert_true(counts.facets <= most);
        }
    }
}

static void a_glint_too_sharp_for_any_count_takes_few_facets(void **state)
{
    (void)state;
    lrcs_fineness fineness = {1e-3, {1e9, 0.0, 1e-6, 0.0}, 1u << 20};
    lrcs_divisions divisions;
    lrcs_mesh_counts counts;
    assert_int_equal(lrcs_shape_count(&bodies[0], &fineness, &divisions, &counts), LRCS_OK);
    assert_true(counts.facets < 200000);
    fineness.brdf.s = 1e-300;
    assert_int_equal(lrcs_shape_count(&bodies[0], &fineness, &divisions, &counts), LRCS_OK);
    assert_true(counts.facets < 200000);
    const lrcs_brdf dark[] = {{0.0, 0.0, 0.0, 0.0}, {1e-320, 0.0, 1e-3, 0.0}};
    for (size_t i = 0; i < BODIES * 2; i++) { /* of the second nothing is left but rounding */
        fineness.brdf = dark[i % 2];
        assert_int_equal(lrcs_shape_count(&bodies[i / 2], &fineness, &divisions, &counts), LRCS_OK);
        assert_true(counts.facets < 200000);
    }
}

/* tan(0.1 deg) by mpmath. Half of the aspects around its glint lie on the other side of the
   axis. */
static void a_cone_nearly_flat_is_divided_by_either_of_its_numbers(void **state)
{
    (void)state;
    lrcs_fineness fineness = lrcs_fineness_default();
    lrcs_divisions divisions[2];
    lrcs_mesh_counts counts;
    const lrcs_shape cone[] = {
        {.kind = LRCS_SHAPE_CONE, .radius = 1, .half_angle_deg = 89.9},
        {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 0.0017453310241888004}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(lrcs_shape_count(&cone[i], &fineness, &divisions[i], &counts), LRCS_OK);
        assert_true(counts.facets < fineness.max_facets);
    }
    assert_int_equal(divisions[0].around, divisions[1].around);
}

static void plane_faces_and_discs_need_no_planning(void **state)
{
    (void)state;
    lrcs_fineness fineness = lrcs_fineness_default();
    lrcs_divisions divisions;
    lrcs_mesh_counts counts;
    lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {1, 1}};
    assert_int_equal(lrcs_shape_count(&plate, &fineness, &divisions, &counts), LRCS_OK);
    assert_int_equal(counts.facets, 2);
    lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};
    assert_int_equal(lrcs_shape_count(&box, &fineness, &divisions, &counts), LRCS_OK);
    assert_int_equal(counts.facets, 12);
    assert_int_equal(counts.text_bytes, 4);
    lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 1};
    assert_int_equal(lrcs_shape_count(&disc, &fineness, &divisions, &counts), LRCS_OK);
    assert_int_equal(divisions.around, 160); /* pi sqrt(0.2566e4) = 159.1 */
}

static void bad_arguments_leave_the_outputs_alone(void **state)
{
    (void)state;
    const lrcs_fineness good = lrcs_fineness_default();
    lrcs_fineness bad[] = {good, good, good, good, good};
    bad[0].tolerance = 0.0;
    bad[1].tolerance = (double)NAN;
    bad[2].max_facets = 63;
    bad[3].brdf.A = -1.0;
    bad[4].brdf.s = (double)NAN;
    lrcs_divisions divisions = {77, 77, 0};
    lrcs_mesh_counts counts = {.facets = 77};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_true(lrcs_shape_count(&bodies[0], &bad[i], &divisions, &counts) < 0);
    }
    lrcs_shape shape = {.kind = LRCS_SHAPE_SPHERE, .radius = -1};
    assert_true(lrcs_shape_count(&shape, &good, &divisions, &counts) < 0);
    assert_int_equal(divisions.around, 77);
    assert_int_equal(counts.facets, 77);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_planned_mesh_proves_the_tolerance),
        cmocka_unit_test(a_tighter_tolerance_never_has_fewer_facets),
        cmocka_unit_test(no_count_exceeds_its_cap),
        cmocka_unit_test(a_glint_too_sharp_for_any_count_takes_few_facets),
        cmocka_unit_test(a_cone_nearly_flat_is_divided_by_either_of_its_numbers),
        cmocka_unit_test(plane_faces_and_discs_need_no_planning),
        cmocka_unit_test(bad_arguments_leave_the_outputs_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
