/* SPDX-License-Identifier: MIT */
/* Facets on planes, cylinders, spheres and cones: bounds against a search in 50 digits
   (test/vectors/quadric.py), regions of generated meshes against what these were generated from,
   and those of real models (../shared/models; without them that test skips) against long doubles.
 */
#include <lrcs/load.h>
#include <lrcs/lrcs.h>
#include <lrcs/quadric.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "memory_limit.h"
#include "random.h"

#define FOLDER        "../shared/models/"
#define VERTICES_MOST 4096
#define FACETS_MOST   8192

static const double pi = 3.14159265358979323846;

static const struct {
    int kind;
    double point[3], axis[3], radius, slope;
    lrcs_point corner[3];
    double distance, angle;
} bound_cases[] = {
#include "../vectors/quadric.inc"
};

#define CASES (sizeof bound_cases / sizeof *bound_cases)

/* ---- the bound of one facet ---- */

static double size_about(const lrcs_quadric *surface, const lrcs_point corner[3])
{
    double most = surface->radius;
    for (int i = 0; i < 9; i++) {
        most = fmax(most, fabs(corner[i / 3].x[i % 3] - surface->point[i % 3]));
    }
    return most;
}

static double axis_distance(const lrcs_quadric *surface, const lrcs_point *p)
{
    double q[3], z = 0.0, square = 0.0;
    for (int k = 0; k < 3; k++) {
        q[k] = p->x[k] - surface->point[k];
        z += q[k] * surface->axis[k];
    }
    for (int k = 0; k < 3; k++) {
        double r = q[k] - z * surface->axis[k];
        square += r * r;
    }
    return sqrt(square);
}

static void bounds_hold_and_are_close(void **state)
{
    (void)state;
    int angles = 0;
    for (size_t i = 0; i < CASES; i++) {
        lrcs_quadric surface = {
            bound_cases[i].kind, {0}, {0}, bound_cases[i].radius, bound_cases[i].slope};
        lrcs_quadric_bound bound;
        memcpy(surface.point, bound_cases[i].point, sizeof surface.point);
        memcpy(surface.axis, bound_cases[i].axis, sizeof surface.axis);
        assert_int_equal(lrcs_quadric_facet_bound(&surface, bound_cases[i].corner, &bound),
                         LRCS_OK);
        double rounding = 1e-13 * size_about(&surface, bound_cases[i].corner);
        double truth = bound_cases[i].distance;
        check_most(truth, bound.displacement);
        check_most(bound.displacement, 2.5 * truth + rounding);
        if (surface.kind != LRCS_QUADRIC_CONE) { /* as close as the search is */
            check_most(bound.displacement, 1.000001 * truth + rounding);
        }
        assert_true(bound.normal_angle >= 0.0);
        int apex = 0; /* a corner counts as the apex: another facet is bounded */
        for (int k = 0; k < 3 && surface.kind == LRCS_QUADRIC_CONE; k++) {
            apex |= axis_distance(&surface, &bound_cases[i].corner[k]) <= 2.0 * bound.displacement;
        }
        if (bound_cases[i].angle < 0.0) {
            assert_true(bound.normal_angle == HUGE_VAL || bound.normal_angle < pi / 2);
        } else if (!apex && bound.normal_angle < HUGE_VAL) {
            check_most(bound_cases[i].angle, bound.normal_angle);
            check_most(bound.normal_angle, 1.0001 * bound_cases[i].angle + 1e-4);
            angles++;
        }
    }
    assert_true(angles > 100);
}

static void exact_corners_leave_the_sagitta(void **state)
{
    (void)state;
    /* two opposite strips' halves of a hexagonal prism in the unit circle: sqrt(3)/2 from its axis
     */
    const lrcs_quadric cylinder = {LRCS_QUADRIC_CYLINDER, {0, 0, 0}, {0, 0, 1}, 1.0, 0.0};
    const double h = sqrt(3.0) / 2;
    const lrcs_point corner[3] = {{{1, 0, 0}}, {{0.5, h, 0}}, {{0.5, h, 5}}};
    const lrcs_point inside[3] = {{{1, 0, 0}}, {{0.5, h, 5}}, {{0.5, h, 0}}};
    lrcs_quadric_bound bound;
    assert_int_equal(lrcs_quadric_facet_bound(&cylinder, corner, &bound), LRCS_OK);
    check_abs(bound.displacement, 1.0 - h, 1e-12);
    check_abs(bound.normal_angle, pi / 6, 1e-12);
    assert_int_equal(bound.inside, 0);
    assert_int_equal(lrcs_quadric_facet_bound(&cylinder, inside, &bound), LRCS_OK);
    check_abs(bound.normal_angle, pi / 6, 1e-12);
    assert_int_equal(bound.inside, 1);
}

static void a_triangle_across_the_axis_is_displaced_by_the_radius(void **state)
{
    (void)state;
    const lrcs_quadric cylinder = {LRCS_QUADRIC_CYLINDER, {0, 0, 0}, {0, 0, 1}, 1.0, 0.0};
    const lrcs_quadric sphere = {LRCS_QUADRIC_SPHERE, {0, 0, 0}, {0, 0, 0}, 1.0, 0.0};
    const lrcs_point corner[3] = {{{1, 0, 0}}, {{-0.5, 0.75, 0}}, {{-0.5, -0.75, 0}}};
    lrcs_quadric_bound bound;
    assert_int_equal(lrcs_quadric_facet_bound(&cylinder, corner, &bound), LRCS_OK);
    assert_true(bound.displacement >= 1.0 && bound.normal_angle == HUGE_VAL);
    assert_int_equal(lrcs_quadric_facet_bound(&sphere, corner, &bound), LRCS_OK);
    assert_true(bound.displacement >= 1.0 && bound.normal_angle == HUGE_VAL);
}

static void behind_the_apex_the_distance_is_to_the_apex(void **state)
{
    (void)state;
    const lrcs_quadric cone = {LRCS_QUADRIC_CONE, {0, 0, 0}, {0, 0, 1}, 0.0, 1.0};
    const lrcs_point corner[3] = {{{1, 0, -1}}, {{2, 0, -2}}, {{1, 0.5, -1.1180339887498949}}};
    lrcs_quadric_bound bound; /* on the other nappe */
    assert_int_equal(lrcs_quadric_facet_bound(&cone, corner, &bound), LRCS_OK);
    check_most(sqrt(8.0), bound.displacement);
}

static void surfaces_without_meaning_are_refused(void **state)
{
    (void)state;
    const lrcs_point corner[3] = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
    const lrcs_point far[3] = {{{1e101, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
    lrcs_quadric_bound bound;
    const lrcs_quadric good = {LRCS_QUADRIC_CYLINDER, {0, 0, 0}, {0, 0, 1}, 1.0, 0.0};
    lrcs_quadric bad = good;
    bad.kind = 4;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_ARGUMENT);
    bad = good;
    bad.axis[2] = 1.0 + 1e-14;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_ARGUMENT);
    bad.axis[2] = (double)NAN;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_NUMBER);
    bad = good;
    bad.radius = 0.0;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_ARGUMENT);
    bad.radius = (double)NAN;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_NUMBER);
    bad = good;
    bad.point[1] = HUGE_VAL;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_NUMBER);
    bad = good;
    bad.kind = LRCS_QUADRIC_CONE;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_ARGUMENT);
    bad.slope = 1e7;
    assert_int_equal(lrcs_quadric_facet_bound(&bad, corner, &bound), LRCS_E_NUMBER);
    assert_int_equal(lrcs_quadric_facet_bound(&good, far, &bound), LRCS_E_NUMBER);
}

/* ---- generated meshes ---- */

typedef struct made {
    lrcs_scene scene;
    lrcs_point vertex[VERTICES_MOST];
    lrcs_facet facet[FACETS_MOST];
    uint32_t facet_material[FACETS_MOST], facet_part[FACETS_MOST], facet_smooth[FACETS_MOST];
    uint32_t facet_region[FACETS_MOST];
    lrcs_material material[1];
    lrcs_part part[1];
    lrcs_quadric_region *list;
    uint32_t count;
    void *bytes;
} made;

static made mesh; /* one at a time */

static void mesh_begin(void)
{
    memset(&mesh, 0, sizeof mesh);
    mesh.material[0] = (lrcs_material){.name = "", .brdf = {1.0, 0.25, 0.2, 0.5}};
    mesh.part[0] = (lrcs_part){.name = "mesh", .kind = -1};
    mesh.scene = (lrcs_scene){.material_count = 1,
                              .part_count = 1,
                              .vertex = mesh.vertex,
                              .facet = mesh.facet,
                              .facet_material = mesh.facet_material,
                              .facet_part = mesh.facet_part,
                              .facet_smooth = mesh.facet_smooth,
                              .material = mesh.material,
                              .part = mesh.part};
}

static uint32_t vertex_add(double x, double y, double z)
{
    mesh.vertex[mesh.scene.vertex_count] = (lrcs_point){{x, y, z}};
    return mesh.scene.vertex_count++;
}

static void facet_add(uint32_t a, uint32_t b, uint32_t c)
{
    mesh.facet[mesh.scene.facet_count++] = (lrcs_facet){{a, b, c}};
    mesh.part[0].facet_count++;
}

/* A grid of quadrilaterals: `place` gives the point of row i, column k; columns close a ring if
   `ring`. */
static void grid_add(uint32_t rows, uint32_t columns, int ring,
                     void (*place)(double row, double column, double x[3]))
{
    uint32_t across = ring ? columns : columns + 1;
    uint32_t first = mesh.scene.vertex_count;
    for (uint32_t i = 0; i <= rows; i++) {
        for (uint32_t k = 0; k < across; k++) {
            double x[3];
            place((double)i / rows, (double)k / columns, x);
            vertex_add(x[0], x[1], x[2]);
        }
    }
    for (uint32_t i = 0; i < rows; i++) {
        for (uint32_t k = 0; k < columns; k++) {
            uint32_t a = first + i * across + k;
            uint32_t b = first + i * across + (k + 1) % across;
            facet_add(a, b, b + across);
            facet_add(a, b + across, a + across);
        }
    }
}

static void on_cylinder(double row, double column, double x[3])
{
    x[0] = 2.0 * cos(2.0 * pi * column);
    x[1] = 2.0 * sin(2.0 * pi * column);
    x[2] = 5.0 * row;
}

static void on_cone(double row, double column, double x[3]) /* half angle: tangent 0.5 */
{
    double z = 1.0 + 3.0 * row;
    x[0] = 0.5 * z * cos(2.0 * pi * column);
    x[1] = 0.5 * z * sin(2.0 * pi * column);
    x[2] = z;
}

static void on_sphere(double row, double column, double x[3])
{
    double theta = pi * (0.9 - 0.8 * row);
    x[0] = 3.0 * sin(theta) * cos(2.0 * pi * column);
    x[1] = 3.0 * sin(theta) * sin(2.0 * pi * column);
    x[2] = 3.0 * cos(theta);
}

static void on_plane(double row, double column, double x[3])
{
    x[0] = 4.0 * column * (1.0 + 0.2 * row);
    x[1] = 3.0 * row;
    x[2] = 0.0;
}

static uint64_t ragged = 7;

static void on_ragged(double row, double column, double x[3])
{
    x[0] = column + 0.01 * random_unit(&ragged);
    x[1] = row + 0.01 * random_unit(&ragged);
    x[2] = 0.03 * random_unit(&ragged);
}

static void on_saddle(double row, double column, double x[3])
{
    x[0] = 2.0 * column - 1.0;
    x[1] = 2.0 * row - 1.0;
    x[2] = 0.7 * (x[0] * x[0] - x[1] * x[1]) + 0.3 * x[0] * x[0] * x[1];
}

/* Turns the mesh by a rotation of exact unit length up to rounding, and moves it. */
static void mesh_move(double by)
{
    /* the rotation of the quaternion (1, 2, 3, 4) */
    static const double r[3][3] = {{-20.0 / 30, 4.0 / 30, 22.0 / 30},
                                   {20.0 / 30, -10.0 / 30, 20.0 / 30},
                                   {10.0 / 30, 28.0 / 30, 4.0 / 30}};
    for (uint32_t i = 0; i < mesh.scene.vertex_count; i++) {
        double x[3];
        memcpy(x, mesh.vertex[i].x, sizeof x);
        for (int k = 0; k < 3; k++) {
            mesh.vertex[i].x[k] = (r[k][0] * x[0] + r[k][1] * x[1] + r[k][2] * x[2]) + by * (k + 1);
        }
    }
}

static void mesh_perturb(double by)
{
    uint64_t state = 99;
    for (uint32_t i = 0; i < mesh.scene.vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            mesh.vertex[i].x[k] += by * (2.0 * random_unit(&state) - 1.0);
        }
    }
}

static void mesh_find(void)
{
    size_t need = lrcs_quadric_need(&mesh.scene);
    mesh.bytes = malloc(need);
    lrcs_work work = lrcs_work_make(mesh.bytes, need);
    assert_int_equal(
        lrcs_quadric_find(&mesh.scene, &work, &mesh.list, &mesh.count, mesh.facet_region), LRCS_OK);
}

static void mesh_end(void)
{
    free(mesh.bytes);
}

/* |d| of a point in long doubles, from the definition. */
static long double distance_of(const lrcs_quadric *s, const long double p[3])
{
    long double q[3], a[3] = {0}, z = 0, square = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        q[k] = p[k] - (long double)s->point[k];
        length += (long double)s->axis[k] * (long double)s->axis[k];
    }
    for (int k = 0; k < 3 && s->kind != LRCS_QUADRIC_SPHERE; k++) {
        a[k] = (long double)s->axis[k] / sqrtl(length);
        z += a[k] * q[k];
    }
    for (int k = 0; k < 3; k++) {
        square += (q[k] - z * a[k]) * (q[k] - z * a[k]);
    }
    long double rho = sqrtl(square);
    long double half = s->kind == LRCS_QUADRIC_CONE ? atanl((long double)s->slope) : 0;
    long double d = s->kind == LRCS_QUADRIC_PLANE  ? z
                    : s->kind == LRCS_QUADRIC_CONE ? rho * cosl(half) - z * sinl(half)
                                                   : rho - (long double)s->radius;
    int beyond = s->kind == LRCS_QUADRIC_CONE && z * cosl(half) + rho * sinl(half) < 0;
    return beyond ? sqrtl(z * z + rho * rho) : fabsl(d);
}

/* Points of the facets of all regions are not farther from their surfaces than claimed. Returns the
   greatest share of a claim that one of the points of region 0 takes. */
static double claims_hold(const lrcs_scene *scene, const lrcs_quadric_region *list, uint32_t count,
                          const uint32_t *facet_region)
{
    uint64_t state = 5;
    double most = 0.0;
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const lrcs_quadric_region *region =
            &list[facet_region[i] == LRCS_NONE ? 0 : facet_region[i]];
        if (facet_region[i] == LRCS_NONE) {
            continue;
        }
        assert_true(facet_region[i] < count);
        for (int j = 0; j < 24; j++) {
            /* corners, then points of sides, then any */
            long double w[3] = {0, 0, 0}, p[3] = {0, 0, 0};
            w[j % 3] = j < 3 ? 1 : (long double)random_unit(&state);
            w[(j + 1) % 3] = j < 3 ? 0 : 1 - w[j % 3];
            if (j >= 12) {
                long double part = (long double)random_unit(&state);
                w[(j + 2) % 3] = 1 - part;
                w[j % 3] *= part;
                w[(j + 1) % 3] *= part;
            }
            for (int k = 0; k < 9; k++) {
                p[k % 3] +=
                    w[k / 3] * (long double)scene->vertex[scene->facet[i].corner[k / 3]].x[k % 3];
            }
            double d = (double)distance_of(&region->surface, p);
            check_most(d, region->bound.displacement);
            most = facet_region[i] == 0 ? fmax(most, d / region->bound.displacement) : most;
        }
    }
    return most;
}

static void found_one(int kind, uint32_t facets)
{
    assert_int_equal(mesh.count, 1);
    assert_int_equal(mesh.list[0].surface.kind, kind);
    assert_int_equal(mesh.list[0].facet_count, facets);
    assert_int_equal(mesh.list[0].first_facet, 0);
    for (uint32_t i = 0; i < facets; i++) {
        assert_int_equal(mesh.facet_region[i], 0);
    }
    double most = claims_hold(&mesh.scene, mesh.list, mesh.count, mesh.facet_region);
    assert_true(kind == LRCS_QUADRIC_PLANE || most > 0.25);
}

static void a_cylinder_is_found(void **state)
{
    (void)state;
    for (int moved = 0; moved < 2; moved++) {
        mesh_begin();
        grid_add(6, 24, 1, on_cylinder);
        if (moved) {
            mesh_move(1e5);
        }
        mesh_find();
        found_one(LRCS_QUADRIC_CYLINDER, 288);
        const lrcs_quadric_region *found = mesh.list;
        double sagitta = 2.0 * (1.0 - cos(pi / 24));
        check_rel(found->surface.radius, 2.0, 1e-9);
        check_rel(found->bound.displacement, sagitta, 1e-6);
        check_rel(found->bound.normal_angle, pi / 24, 1e-6);
        check_rel(found->area, 5.0 * 24 * 4.0 * sin(pi / 24), 1e-9);
        assert_int_equal(found->bound.inside, 0);
        /* the glint's error as of glint.h for a turn of 15 deg */
        check_rel(found->glint_error, pow(pi / 12, 2) / 24 + 2.0 * exp(-pow(0.2 * 12, 2)), 1e-5);
        mesh_end();
    }
}

static void a_cone_is_found_with_its_tip(void **state)
{
    (void)state;
    for (int moved = 0; moved < 2; moved++) {
        mesh_begin();
        grid_add(4, 20, 1, on_cone);
        uint32_t tip = vertex_add(0, 0, 0);
        for (uint32_t k = 0; k < 20; k++) {
            facet_add(tip, (k + 1) % 20, k);
        }
        if (moved) {
            mesh_move(1e4);
        }
        mesh_find();
        found_one(LRCS_QUADRIC_CONE, 180);
        check_rel(mesh.list[0].surface.slope, 0.5, 1e-9);
        check_rel(mesh.list[0].bound.displacement, 2.0 * (1.0 - cos(pi / 20)) * sqrt(0.8), 1e-6);
        check_most(mesh.list[0].bound.normal_angle, pi / 20);
        assert_int_equal(mesh.list[0].bound.inside, 0);
        mesh_end();
    }
}

static void a_frustum_of_one_row_is_a_cone_and_no_sphere(void **state)
{
    (void)state;
    mesh_begin();
    grid_add(1, 32, 1, on_cone); /* its corners lie on a sphere too */
    mesh_find();
    found_one(LRCS_QUADRIC_CONE, 64);
    mesh_end();
}

static void a_sphere_is_found(void **state)
{
    (void)state;
    mesh_begin();
    grid_add(20, 30, 1, on_sphere);
    mesh_move(1e5);
    mesh_find();
    found_one(LRCS_QUADRIC_SPHERE, 1200);
    check_rel(mesh.list[0].surface.radius, 3.0, 1e-9);
    for (int k = 0; k < 3; k++) {
        check_abs(mesh.list[0].surface.point[k], 1e5 * (k + 1), 1e-8);
    }
    mesh_end();
}

static void size_does_not_matter(void **state)
{
    (void)state;
    for (int power = -30; power <= 30; power += 20) {
        mesh_begin();
        grid_add(6, 24, 1, on_cylinder);
        for (uint32_t i = 0; i < 3 * mesh.scene.vertex_count; i++) {
            mesh.vertex[i / 3].x[i % 3] = ldexp(mesh.vertex[i / 3].x[i % 3], power);
        }
        mesh_find();
        found_one(LRCS_QUADRIC_CYLINDER, 288);
        check_rel(mesh.list[0].surface.radius, ldexp(2.0, power), 1e-9);
        mesh_end();
    }
}

static void a_plane_is_found_beside_a_cylinder(void **state)
{
    (void)state;
    mesh_begin();
    grid_add(8, 8, 0, on_plane);
    mesh_move(1e3);
    grid_add(2, 12, 1, on_cylinder);
    mesh_find();
    assert_int_equal(mesh.count, 2);
    assert_int_equal(mesh.list[0].surface.kind, LRCS_QUADRIC_CYLINDER);
    assert_int_equal(mesh.list[1].surface.kind, LRCS_QUADRIC_PLANE);
    assert_true(mesh.list[0].area > mesh.list[1].area);
    assert_int_equal(mesh.list[1].facet_count, 128);
    check_most(mesh.list[1].bound.displacement, 1e-11);
    check_same(mesh.list[1].glint_error, 0.0);
    claims_hold(&mesh.scene, mesh.list, mesh.count, mesh.facet_region);
    mesh_end();
}

static void perturbed_corners_widen_the_claim(void **state)
{
    (void)state;
    double before = 0.0;
    for (int i = 0; i < 4; i++) {
        mesh_begin();
        grid_add(6, 24, 1, on_cylinder);
        mesh_perturb(i == 0 ? 0.0 : 1e-5 * pow(10.0, i - 1));
        mesh_move(100.0);
        mesh_find();
        found_one(LRCS_QUADRIC_CYLINDER, 288);
        assert_true(mesh.list[0].bound.displacement > before);
        before = mesh.list[0].bound.displacement;
        mesh_end();
    }
}

static void facets_without_area_are_left_out(void **state)
{
    (void)state;
    mesh_begin();
    grid_add(6, 24, 1, on_cylinder);
    for (uint32_t k = 0; k < 24; k++) {
        facet_add(k, k, k + 24);
        facet_add(k, k, k);
    }
    mesh_find();
    assert_int_equal(mesh.count, 1);
    assert_int_equal(mesh.list[0].facet_count, 288);
    for (uint32_t i = 288; i < mesh.scene.facet_count; i++) {
        assert_int_equal(mesh.facet_region[i], LRCS_NONE);
    }
    const lrcs_quadric_region *found = mesh.list;
    assert_true(isfinite(found->bound.displacement) && isfinite(found->bound.normal_angle) &&
                isfinite(found->area) && isfinite(found->glint_error));
    mesh_end();
}

static void free_form_surfaces_are_not_claimed(void **state)
{
    (void)state;
    void (*const place[])(double, double, double[3]) = {on_ragged, on_saddle};
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 20; k++) {
            mesh_begin();
            grid_add(20 + (uint32_t)k, 30, 0, place[i]);
            mesh_find();
            assert_int_equal(mesh.count, 0);
            mesh_end();
        }
    }
}

static void a_prism_of_eight_sides_is_no_cylinder(void **state)
{
    (void)state;
    mesh_begin();
    grid_add(5, 8, 1, on_cylinder);
    mesh_find();
    assert_true(mesh.count <= 8);
    for (uint32_t i = 0; i < mesh.count; i++) {
        assert_int_equal(mesh.list[i].surface.kind, LRCS_QUADRIC_PLANE);
    }
    mesh_end();
}

static void shapes_and_transparent_facets_are_left_out(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        mesh_begin();
        grid_add(6, 24, 1, on_cylinder);
        mesh.part[0].kind = i == 0 ? LRCS_SHAPE_CYLINDER : -1;
        mesh.material[0].omitted = i == 1;
        mesh_find();
        assert_int_equal(mesh.count, 0);
        mesh_end();
    }
}

static void a_scene_without_facets_has_no_regions(void **state)
{
    (void)state;
    mesh_begin();
    mesh_find();
    assert_int_equal(mesh.count, 0);
    mesh_end();
}

static int limited_find(lrcs_work *work)
{
    lrcs_quadric_region *list;
    uint32_t count;
    int status = lrcs_quadric_find(&mesh.scene, work, &list, &count, NULL);
    if (status == LRCS_OK) {
        mesh.list = list;
        mesh.count = count;
    }
    return status;
}

static void too_little_memory_is_refused(void **state)
{
    (void)state;
    mesh_begin();
    grid_add(2, 12, 1, on_cylinder);
    check_memory_limit(
        MEMORY_CASE("quadric_find", lrcs_quadric_need(&mesh.scene), limited_find, mesh.count, 1));
}

/* ---- models ---- */

static void claims_on_models_hold(void **state)
{
    (void)state;
    static const char *const name[] = {"skylab.3ds", "new_horizons_antenna.stl", "kepler.obj",
                                       "aura.3ds"};
    int read = 0;
    need_wide_long_double();
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        char path[256];
        lrcs_host_scene host;
        lrcs_host_error error;
        lrcs_host_options options = lrcs_host_options_default();
        snprintf(path, sizeof path, FOLDER "%s", name[i]);
        memset(&host, 0, sizeof host);
        if (lrcs_host_scene_read(path, &options, &host, &error) != LRCS_OK) {
            continue;
        }
        const lrcs_scene *scene = &host.scene;
        lrcs_quadric_region *list;
        uint32_t count;
        size_t need = lrcs_quadric_need(scene);
        void *bytes = malloc(need);
        uint32_t *facet_region = malloc(scene->facet_count * sizeof *facet_region);
        lrcs_work work = lrcs_work_make(bytes, need);
        assert_int_equal(lrcs_quadric_find(scene, &work, &list, &count, facet_region), LRCS_OK);
        assert_true(count > 0);
        claims_hold(scene, list, count, facet_region);
        free(facet_region);
        free(bytes);
        lrcs_host_scene_free(&host);
        read++;
    }
    if (read == 0) {
        print_message(FOLDER " is not there\n");
        skip();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold_and_are_close),
        cmocka_unit_test(exact_corners_leave_the_sagitta),
        cmocka_unit_test(a_triangle_across_the_axis_is_displaced_by_the_radius),
        cmocka_unit_test(behind_the_apex_the_distance_is_to_the_apex),
        cmocka_unit_test(surfaces_without_meaning_are_refused),
        cmocka_unit_test(a_cylinder_is_found),
        cmocka_unit_test(a_cone_is_found_with_its_tip),
        cmocka_unit_test(a_frustum_of_one_row_is_a_cone_and_no_sphere),
        cmocka_unit_test(a_sphere_is_found),
        cmocka_unit_test(size_does_not_matter),
        cmocka_unit_test(a_plane_is_found_beside_a_cylinder),
        cmocka_unit_test(perturbed_corners_widen_the_claim),
        cmocka_unit_test(facets_without_area_are_left_out),
        cmocka_unit_test(free_form_surfaces_are_not_claimed),
        cmocka_unit_test(a_prism_of_eight_sides_is_no_cylinder),
        cmocka_unit_test(shapes_and_transparent_facets_are_left_out),
        cmocka_unit_test(a_scene_without_facets_has_no_regions),
        cmocka_unit_test(too_little_memory_is_refused),
        cmocka_unit_test(claims_on_models_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
