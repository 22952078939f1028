/* SPDX-License-Identifier: MIT */
/* Facet meshes of shapes: closed, outward, convex, symmetric to the bit; and the bounds of patches
   against an integration over each patch that shares nothing with their derivation. */
#include "mesh/shape/revolution_normals.h"
#include "mesh/shape/tessellate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

static const double pi = 3.14159265358979323846;
static unsigned char area[1u << 21];

static void minus(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
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

static const double *corner(const lrcs_mesh *mesh, uint32_t i, int k)
{
    return mesh->vertex[mesh->facet[i].corner[k % 3]].x;
}

/* Half the cross product of two sides. */
static void facet_vector(const lrcs_mesh *mesh, uint32_t i, double out[3])
{
    double a[3];
    double b[3];
    minus(corner(mesh, i, 1), corner(mesh, i, 0), a);
    minus(corner(mesh, i, 2), corner(mesh, i, 0), b);
    cross(a, b, out);
    for (int k = 0; k < 3; k++) {
        out[k] *= 0.5;
    }
}

static double facet_area(const lrcs_mesh *mesh, uint32_t i)
{
    double n[3];
    facet_vector(mesh, i, n);
    return sqrt(dot(n, n));
}

/* Area of the facets of a smoothing group. */
static double group_area(const lrcs_mesh *mesh, uint32_t smooth)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        sum += mesh->facet_smooth[i] == smooth ? facet_area(mesh, i) : 0.0;
    }
    return sum;
}

static double volume(const lrcs_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        double n[3];
        facet_vector(mesh, i, n);
        sum += dot(n, corner(mesh, i, 0)) / 3.0;
    }
    return sum;
}

static lrcs_mesh make_zones(const lrcs_shape *shape, uint32_t around, uint32_t along,
                            int level_zones, lrcs_patch_bounds *bounds)
{
    lrcs_divisions divisions = {around, along, level_zones};
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_mesh mesh;
    assert_int_equal(lrcs_shape_mesh(shape, &divisions, &work, &mesh, bounds), LRCS_OK);
    return mesh;
}

static lrcs_mesh make(const lrcs_shape *shape, uint32_t around, uint32_t along,
                      lrcs_patch_bounds *bounds)
{
    return make_zones(shape, around, along, 0, bounds);
}

typedef struct sample {
    lrcs_shape shape;
    uint32_t around, along;
    double wall, flat, inside; /* areas of wall and caps, volume */
} sample;

static const sample samples[] = {
    {{.kind = LRCS_SHAPE_BOX, .size = {1, 2, 3}}, 4, 1, 0.0, 22.0, 6.0},
    {{.kind = LRCS_SHAPE_SPHERE, .radius = 2}, 32, 8, 50.26548245743669, 0.0, 33.51032163829113},
    {{.kind = LRCS_SHAPE_SPHERE, .radius = 2}, 8, 2, 50.26548245743669, 0.0, 33.51032163829113},
    {{.kind = LRCS_SHAPE_DOME, .radius = 2},
     32,
     8,
     25.132741228718345,
     12.566370614359172,
     16.755160819145562},
    {{.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2},
     32,
     1,
     6.283185307179586,
     1.5707963267948966,
     1.5707963267948966},
    {{.kind = LRCS_SHAPE_CONE, .radius = 3, .length = 4},
     36,
     1,
     47.12388980384690,
     28.274333882308138,
     37.69911184307752},
    {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 1, .radius2 = 4, .length = 4},
     32,
     1,
     78.53981633974483,
     53.40707511102649,
     87.96459430051421},
    {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 4, .radius2 = 1, .length = 4},
     32,
     1,
     78.53981633974483,
     53.40707511102649,
     87.96459430051421},
    {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 0, .radius2 = 3, .length = 4},
     32,
     1,
     47.12388980384690,
     28.274333882308138,
     37.69911184307752},
    /* pi/6 (5 sqrt 5 - 1) */
    {{.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 1},
     32,
     6,
     5.330413500511922,
     3.141592653589793,
     1.5707963267948966},
};
#define SAMPLES (sizeof samples / sizeof samples[0])

static void areas_and_volumes_tend_to_the_bodys_as_the_square(void **state)
{
    (void)state;
    for (size_t i = 0; i < SAMPLES; i++) {
        const sample *s = &samples[i];
        lrcs_patch_bounds c;
        lrcs_mesh mesh = make(&s->shape, s->around, s->along, &c);
        double h = pi / s->around;
        double most = s->shape.kind == LRCS_SHAPE_BOX ? 1e-15 : 2.0 * h * h;
        if (s->wall > 0.0) {
            double wall = group_area(&mesh, 1);
            check_abs(wall, s->wall, (c.area_err + 1e-14) * wall);
            check_most(c.area_err, 0.4 * h * h + 1e-12);
        }
        check_rel(group_area(&mesh, 0), s->flat, 1e-14);
        check_rel(volume(&mesh), s->inside, most);
    }
}

/* How often a directed edge, by positions, is used. */
static int edge_uses(const lrcs_mesh *mesh, const double *a, const double *b)
{
    int uses = 0;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            uses += memcmp(corner(mesh, i, k), a, sizeof(lrcs_point)) == 0 &&
                    memcmp(corner(mesh, i, k + 1), b, sizeof(lrcs_point)) == 0 &&
                    facet_area(mesh, i) > 0.0;
        }
    }
    return uses;
}

static void solids_are_closed_manifolds_that_face_outward(void **state)
{
    (void)state;
    for (size_t i = 0; i < SAMPLES; i++) {
        lrcs_mesh mesh = make(&samples[i].shape, samples[i].around, samples[i].along, NULL);
        for (uint32_t f = 0; f < mesh.facet_count; f++) {
            for (int k = 0; k < 3 && facet_area(&mesh, f) > 0.0; k++) {
                const double *a = corner(&mesh, f, k);
                const double *b = corner(&mesh, f, k + 1);
                assert_int_equal(edge_uses(&mesh, a, b), 1);
                assert_int_equal(edge_uses(&mesh, b, a), 1);
            }
        }
        assert_true(volume(&mesh) > 0.0);
    }
}

static void solids_are_convex_up_to_rounding(void **state)
{
    (void)state;
    for (size_t i = 0; i < SAMPLES; i++) {
        lrcs_mesh mesh = make(&samples[i].shape, samples[i].around, samples[i].along, NULL);
        for (uint32_t f = 0; f < mesh.facet_count; f++) {
            double n[3];
            facet_vector(&mesh, f, n);
            double size = sqrt(dot(n, n));
            for (uint32_t v = 0; v < mesh.vertex_count && size > 0.0; v++) {
                double d[3];
                minus(mesh.vertex[v].x, corner(&mesh, f, 0), d);
                check_most(dot(d, n) / size, 1e-14 * 8.0);
            }
        }
    }
}

static void polygons_are_symmetric_to_the_bit_and_start_on_x(void **state)
{
    (void)state;
    const uint32_t arounds[] = {8, 12, 20, 36, 64, 100};
    lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 0.7};
    for (size_t i = 0; i < sizeof arounds / sizeof arounds[0]; i++) {
        uint32_t n = arounds[i];
        lrcs_mesh mesh = make(&disc, n, 1, NULL);
        double h = pi / n;
        check_rel(mesh.vertex[0].x[0], 0.7 * sqrt(2.0 * h / sin(2.0 * h)), 1e-15);
        check_same(mesh.vertex[0].x[1], 0.0);
        check_rel(group_area(&mesh, 0), pi * 0.49, 1e-14);
        for (uint32_t k = 0; k < n; k++) {
            const double *p = mesh.vertex[k].x;
            const double *flip = mesh.vertex[(n - k) % n].x;
            const double *swap = mesh.vertex[(n / 4 + n - k) % n].x;
            const double *turn = mesh.vertex[(k + n / 4) % n].x;
            check_same(flip[0], p[0]);
            check_same(flip[1], -p[1]);
            check_same(swap[0], p[1]);
            check_same(swap[1], p[0]);
            check_same(turn[0], -p[1]);
            check_same(turn[1], p[0]);
        }
    }
}

/* As fans they would be n/pi times as long as high, and all would meet in the middle. */
static void discs_of_many_sides_have_no_slivers(void **state)
{
    (void)state;
    const uint32_t arounds[] = {64, 100, 516, 1000, 4096};
    lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 0.7};
    for (size_t i = 0; i < sizeof arounds / sizeof arounds[0]; i++) {
        uint32_t n = arounds[i];
        lrcs_mesh mesh = make(&disc, n, 1, NULL);
        check_rel(group_area(&mesh, 0), pi * 0.49, 1e-13);
        assert_true(mesh.facet_count < 1.4 * n);
        for (uint32_t f = 0; f < mesh.facet_count; f++) {
            double u[3];
            double v[3];
            double w[3];
            minus(corner(&mesh, f, 1), corner(&mesh, f, 0), u);
            minus(corner(&mesh, f, 2), corner(&mesh, f, 0), v);
            minus(corner(&mesh, f, 2), corner(&mesh, f, 1), w);
            double longest = fmax(dot(u, u), fmax(dot(v, v), dot(w, w)));
            double twice = u[0] * v[1] - u[1] * v[0]; /* of the area, from above */
            check_most(longest / twice, 24.0);
        }
    }
}

static void a_sphere_is_symmetric_about_its_equator_which_lies_at_zero(void **state)
{
    (void)state;
    lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 1.3};
    lrcs_mesh mesh = make(&sphere, 20, 5, NULL);
    uint32_t level = 0;
    for (uint32_t v = 0; v < mesh.vertex_count; v++) {
        const double *x = mesh.vertex[v].x;
        int mirrored = 0;
        for (uint32_t w = 0; w < mesh.vertex_count; w++) {
            const double *y = mesh.vertex[w].x;
            mirrored += x[0] == y[0] && x[1] == y[1] && x[2] == -y[2];
        }
        assert_int_equal(mirrored, 1);
        level += x[2] == 0.0;
    }
    assert_int_equal(level, 20);
}

static void plane_faced_bodies_and_discs_have_no_curvature(void **state)
{
    (void)state;
    const lrcs_shape shapes[] = {{.kind = LRCS_SHAPE_PLATE, .size = {1, 2}},
                                 {.kind = LRCS_SHAPE_BOX, .size = {1, 2, 3}},
                                 {.kind = LRCS_SHAPE_DISC, .radius = 1}};
    for (int i = 0; i < 3; i++) {
        lrcs_patch_bounds c = {1.0, 1.0, 1.0, 1.0};
        lrcs_mesh mesh = make(&shapes[i], i < 2 ? 4 : 16, 1, &c);
        check_same(c.turn + c.area_err + c.bias + c.rms_turn, 0.0);
        double n[3];
        facet_vector(&mesh, 0, n);
        assert_true(i == 1 || n[2] > 0.0);
    }
}

/* The true body near a facet: the point at height z' of its radius, by kind. */
typedef struct patch {
    double area, incidence[3], turn,
        square; /* integrals of 1, turn vector, turn^2; the largest turn */
} patch;

/* Polar angle of the normal and radius at a fraction t of the way from radius r0 to r1. */
static void profile_at(const lrcs_shape *shape, double r, double *polar, double *stretch)
{
    double slope = 0.0; /* d rho / d z, downward */
    if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        slope = 2.0 * shape->length * r / (shape->radius * shape->radius);
        *polar = atan(slope);
    } else {
        *polar = asin(fmin(1.0, r / shape->radius));
    }
    *stretch = 1.0 / cos(*polar);
}

/* Adds one point of a patch, weight dA, normal n, to the integrals about the facet normal f. */
static void patch_add(patch *p, double weight, const double n[3], const double f[3])
{
    double x[3];
    cross(n, f, x);
    double turn = atan2(sqrt(dot(x, x)), dot(n, f));
    p->area += weight;
    p->turn = fmax(p->turn, turn);
    p->square += weight * turn * turn;
    double off[3];
    for (int k = 0; k < 3; k++) {
        off[k] = n[k] - dot(n, f) * f[k];
    }
    double size = sqrt(dot(off, off));
    for (int k = 0; k < 3 && size > 0.0; k++) {
        p->incidence[k] += weight * turn * off[k] / size;
    }
}

/* Integrates over the sector [-h, h] about +x between two radii (r = R sin on a sphere, so that
   the equator is no pole of the integrand), or up a straight wall. */
static patch patch_integrate(const lrcs_shape *shape, double r0, double r1, double h,
                             const double f[3])
{
    enum { NODES = 60 };
    patch p = {0.0, {0.0, 0.0, 0.0}, 0.0, 0.0};
    int straight = shape->kind == LRCS_SHAPE_FRUSTUM;
    int round = !straight && shape->kind != LRCS_SHAPE_PARABOLOID;
    double a0 = round ? asin(fmin(1.0, r0 / shape->radius)) : r0;
    double a1 = round ? asin(fmin(1.0, r1 / shape->radius)) : r1;
    for (int i = 0; i < NODES; i++) {
        double a = a0 + (a1 - a0) * (i + 0.5) / NODES;
        double polar = a;
        double stretch = shape->radius;
        double r = round ? shape->radius * sin(a) : a;
        if (straight) {
            polar = atan2(shape->length, r0 - r1);
            stretch = 1.0 / cos(polar);
        } else if (!round) {
            profile_at(shape, r, &polar, &stretch);
        }
        for (int j = 0; j < NODES; j++) {
            double phi = h * ((j + 0.5) / (NODES / 2) - 1.0);
            double n[3] = {sin(polar) * cos(phi), sin(polar) * sin(phi), cos(polar)};
            double weight = r * fabs(stretch * (a1 - a0)) / NODES * (2.0 * h / NODES);
            patch_add(&p, weight, n, f);
        }
    }
    return p;
}

/* Checks the numbers on every strip of a body's wall; `upper` strips, by the radii of its rows. */
static void check_zones(const lrcs_shape *shape, uint32_t around, uint32_t along, int level_zones)
{
    lrcs_patch_bounds c;
    lrcs_mesh mesh = make_zones(shape, around, along, level_zones, &c);
    double h = pi / around;
    double swell = sqrt(2.0 * h / sin(2.0 * h));
    lrcs_patch_bounds seen = {0.0, 0.0, 0.0, 0.0};
    for (uint32_t i = 0; i < along; i++) {
        const double *low = mesh.vertex[i * around].x;
        const double *high = mesh.vertex[(i + 1) * around].x;
        int apex = i + 1 == along && shape->kind != LRCS_SHAPE_FRUSTUM;
        double top = apex ? 0.0 : high[0];
        double slant[2] = {(low[0] - top) * cos(h), high[2] - low[2]};
        double length = hypot(slant[0], slant[1]);
        double f[3] = {slant[1] / length, 0.0, slant[0] / length};
        double facet = sin(h) * (low[0] + top) * length;
        patch p = patch_integrate(shape, low[0] / swell, top / swell, h, f);
        seen.turn = fmax(seen.turn, p.turn);
        seen.area_err = fmax(seen.area_err, fabs(p.area - facet) / facet);
        seen.bias = fmax(seen.bias, sqrt(dot(p.incidence, p.incidence)) / facet);
        seen.rms_turn = fmax(seen.rms_turn, sqrt(p.square / facet));
    }
    check_most(seen.turn, c.turn);
    check_most(seen.area_err, c.area_err * 1.002);
    check_most(seen.bias, c.bias * 1.002 + 1e-4 * h * h);
    check_most(seen.rms_turn, c.rms_turn * 1.0005);
    check_most(c.turn, seen.turn * 1.1); /* the bounds are not far too wide */
    check_most(c.area_err, seen.area_err * 1.1 + 1e-3 * h * h);
    check_most(c.rms_turn, seen.rms_turn * 1.1);
}

static void check_strips(const lrcs_shape *shape, uint32_t around, uint32_t along)
{
    check_zones(shape, around, along, 0);
    check_zones(shape, around, along, 1);
}

static void curvature_bounds_every_patch_and_is_nearly_reached(void **state)
{
    (void)state;
    const lrcs_shape sphere = {.kind = LRCS_SHAPE_DOME, .radius = 2, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape bowl = {
        .kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 1.5, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape flat = {
        .kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 0.05, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape needle = {
        .kind = LRCS_SHAPE_PARABOLOID, .radius = 0.1, .length = 2, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape zone = {.kind = LRCS_SHAPE_FRUSTUM,
                             .radius = 0.5,
                             .radius2 = 1,
                             .length = 0.7,
                             .parts = LRCS_SHAPE_WALL};
    const lrcs_shape funnel = {.kind = LRCS_SHAPE_FRUSTUM,
                               .radius = 3,
                               .radius2 = 1,
                               .length = 0.7,
                               .parts = LRCS_SHAPE_WALL};
    check_strips(&sphere, 8, 1);
    check_strips(&sphere, 24, 6);
    check_strips(&sphere, 100, 25);
    check_strips(&bowl, 24, 6);
    check_strips(&bowl, 64, 13);
    check_strips(&flat, 24, 1);
    check_strips(&flat, 24, 3);
    check_strips(&needle, 48, 12);
    check_strips(&zone, 8, 1);
    check_strips(&zone, 64, 1);
    check_strips(&funnel, 16, 1);
}

/* True radius and height at a fraction of the area of a strip, counted from its upper row, given
   the true radii of both rows. */
static void true_point(const lrcs_shape *shape, double lower, double upper, double fraction,
                       double *r, double *z)
{
    double rim = shape->radius;
    double height = shape->length;
    double square = upper * upper + fraction * (lower * lower - upper * upper);
    if (shape->kind == LRCS_SHAPE_DOME) {
        double a = sqrt(rim * rim - upper * upper);
        double b = sqrt(fmax(0.0, rim * rim - lower * lower));
        *z = a + fraction * (b - a);
        *r = sqrt(rim * rim - *z * *z);
    } else if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        double k = 2.0 * height / (rim * rim); /* slope = k r */
        double a = pow(1.0 + k * k * upper * upper, 1.5);
        double b = pow(1.0 + k * k * lower * lower, 1.5);
        double w = cbrt(a + fraction * (b - a));
        *r = sqrt((w - 1.0) * (w + 1.0)) / k;
        *z = height * (1.0 - *r * *r / (rim * rim));
    } else {
        double base = shape->kind == LRCS_SHAPE_FRUSTUM ? shape->radius2 : rim;
        double top = shape->kind == LRCS_SHAPE_CONE ? 0.0 : rim;
        *r = sqrt(square);
        *z = base == top ? height * (1.0 - fraction) : height * (*r - base) / (top - base);
    }
}

/* The map of mesh/shape/revolution.c from the true surface onto the facets, point by point over a
   sector. */
static void check_reach(const lrcs_shape *shape, uint32_t around, uint32_t along, int level_zones)
{
    enum { STEPS = 24 };
    lrcs_mesh mesh = make_zones(shape, around, along, level_zones, NULL);
    lrcsi_reach reach =
        lrcsi_tessellate_reach(shape, &(lrcs_divisions){around, along, level_zones});
    double h = pi / around;
    double swell = sqrt(2.0 * h / sin(2.0 * h));
    lrcsi_reach seen = {.all = 0.0};
    for (uint32_t i = 0; i < along; i++) {
        const double *low = mesh.vertex[i * around].x;
        const double *high = mesh.vertex[(i + 1) * around].x;
        int apex = i + 1 == along && shape->kind != LRCS_SHAPE_FRUSTUM;
        double lower = low[0] / swell;
        double upper = apex ? 0.0 : high[0] / swell;
        for (int j = 0; j <= STEPS * STEPS; j++) {
            double fraction = (double)(j / STEPS) / STEPS;
            double v = 2.0 * (j % STEPS) / (STEPS - 1.0) - 1.0;
            double r;
            double z;
            true_point(shape, lower, upper, fraction, &r, &z);
            double ours = sqrt(upper * upper + fraction * (lower * lower - upper * upper));
            double down = lower == upper ? fraction : (ours - upper) / (lower - upper);
            const double off[3] = {swell * cos(h) * ours - r * cos(v * h),
                                   swell * sin(h) * v * ours - r * sin(v * h),
                                   high[2] + down * (low[2] - high[2]) - z};
            seen.all = fmax(seen.all, sqrt(dot(off, off)));
            seen.radial = fmax(seen.radial, fabs(off[0]));
            seen.axial = fmax(seen.axial, fabs(off[2]));
            seen.tangential = fmax(seen.tangential, fabs(off[1]));
        }
    }
    check_most(seen.all, reach.all);
    check_most(seen.radial, reach.radial);
    check_most(seen.axial, reach.axial);
    check_most(seen.tangential, reach.tangential);
    if (along == 1 || along > 20) { /* the bounds are not far too wide, unless zones are coarse */
        check_most(reach.all, 4.0 * seen.all + 1e-12);
        check_most(reach.radial, 2.0 * seen.radial + 1e-12);
    }
}

/* The normals of the true surface beside linear functions of the images of their points, over the
   same map. */
static void check_normals(const lrcs_shape *shape, uint32_t around, uint32_t along, int level_zones)
{
    enum { STEPS = 60 };
    const lrcs_divisions divisions = {around, along, level_zones};
    lrcs_mesh mesh = make_zones(shape, around, along, level_zones, NULL);
    lrcsi_revolution body = lrcsi_revolution_make(shape, &divisions);
    double h = pi / around;
    double swell = sqrt(2.0 * h / sin(2.0 * h));
    for (uint32_t i = 0; i < along; i++) {
        lrcsi_revolution_normals n = lrcsi_revolution_normals_make(&body, i);
        const double *low = mesh.vertex[i * around].x;
        const double *high = mesh.vertex[(i + 1) * around].x;
        int apex = i + 1 == along && shape->kind != LRCS_SHAPE_FRUSTUM;
        double lower = low[0] / swell;
        double upper = apex ? 0.0 : high[0] / swell;
        double across = 0.0;
        double mean = 0.0;
        double least = HUGE_VAL;
        double most = -HUGE_VAL;
        check_rel(n.sine * n.sine + n.cosine * n.cosine, 1.0, 1e-14);
        for (int j = 0; j < STEPS * STEPS; j++) {
            double fraction = (j / STEPS + 0.5) / STEPS;
            double v = 2.0 * (j % STEPS + 0.5) / STEPS - 1.0;
            double r;
            double z;
            true_point(shape, lower, upper, fraction, &r, &z);
            double ours = sqrt(upper * upper + fraction * (lower * lower - upper * upper));
            double down = lower == upper ? fraction : (ours - upper) / (lower - upper);
            double x = swell * sin(h) * v * ours;
            double y =
                n.cosine * swell * cos(h) * ours - n.sine * (high[2] + down * (low[2] - high[2]));
            double out = shape->length; /* the true normal, away from the axis and along it */
            double up = shape->radius2 - shape->radius;
            if (shape->kind == LRCS_SHAPE_DOME) {
                out = r;
                up = z;
            } else if (shape->kind == LRCS_SHAPE_PARABOLOID) {
                out = 2.0 * shape->length * r / (shape->radius * shape->radius);
                up = 1.0;
            } else if (shape->kind == LRCS_SHAPE_CONE) {
                up = shape->radius;
            }
            double length = hypot(out, up);
            double by_x = out / length * sin(v * h) - n.across * x;
            double by_y = n.cosine * out / length * cos(v * h) - n.sine * up / length - n.along * y;
            across = fmax(across, fabs(by_x));
            mean += fabs(by_x) / STEPS / STEPS;
            least = fmin(least, by_y);
            most = fmax(most, by_y);
            check_most(fabs(x), n.width);
        }
        check_most(across, n.across_err);
        check_most(mean, n.across_mean * (1.0 + 1e-3)); /* the quadrature's error */
        check_most(0.5 * (most - least), n.along_err);
        check_most(hypot(swell * cos(h) * (lower - upper), high[2] - low[2]), n.length);
        if (along > 20 && !apex &&
            shape->kind == LRCS_SHAPE_DOME) { /* the bounds are not far too wide */
            check_most(n.across_err, 8.0 * across + 1e-12);
            check_most(n.along_err, 4.0 * (most - least) + 1e-12);
        }
    }
}

/* Between two heights of a straight wall: across x beside the component of the true normals along
   the rows; of its absolute error the mean over a row is twice what regions leave of it. */
static void check_normals_between(const lrcs_shape *shape, uint32_t around, double low, double high)
{
    enum { STEPS = 60 };
    const lrcs_divisions divisions = {around, 1, 0};
    const lrcsi_revolution body = lrcsi_revolution_make(shape, &divisions);
    const lrcsi_revolution_normals whole = lrcsi_revolution_normals_make(&body, 0);
    const lrcsi_revolution_normals n = lrcsi_revolution_normals_between(&body, low, high);
    const double base = shape->kind == LRCS_SHAPE_CONE ? shape->radius : shape->radius2;
    const double top = shape->kind == LRCS_SHAPE_CONE ? 0 : shape->radius;
    const double length = hypot(shape->length, base - top);
    const double h = pi / around;
    for (int i = 0; i <= STEPS; i++) {
        const double rho = base + (low + (high - low) * i / STEPS) * (top - base);
        double mean = 0;
        for (int j = 0; j < STEPS; j++) {
            const double v = 2 * (j + 0.5) / STEPS - 1;
            const double x = sqrt(2 * h / sin(2 * h)) * sin(h) * v * rho;
            const double off = fabs(shape->length / length * sin(v * h) - n.across * x);
            check_most(off, n.across_err);
            mean += off / STEPS;
        }
        check_most(0.5 * mean, n.across_mean * (1 + 1e-3)); /* the sum's error */
    }
    check_same(n.width, whole.width);
    check_same(n.length, whole.length);
    check_most(n.across_err, whole.across_err);
}

static void normals_are_nearly_linear_in_position_on_facets(void **state)
{
    (void)state;
    const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 0.7, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape bowl = {
        .kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.4, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape flat = {
        .kind = LRCS_SHAPE_PARABOLOID, .radius = 2.0, .length = 0.1, .parts = LRCS_SHAPE_WALL};
    const lrcs_shape cone = {
        .kind = LRCS_SHAPE_CONE, .radius = 0.5, .length = 0.8, .parts = LRCS_SHAPE_WALL};
    lrcs_shape frustum = {.kind = LRCS_SHAPE_FRUSTUM,
                          .radius = 0.3,
                          .radius2 = 0.5,
                          .length = 0.8,
                          .parts = LRCS_SHAPE_WALL};
    static const uint32_t around[] = {8, 12, 24, 100};
    for (int i = 0; i < 4; i++) {
        for (uint32_t along = 1; along <= 36; along += along < 4 ? 1 : 8) {
            for (int level = 0; level < 2; level++) {
                check_normals(&dome, around[i], along, level);
                check_normals(&bowl, around[i], along, level);
                check_normals(&flat, around[i], along, level);
            }
        }
        check_normals(&cone, around[i], 1, 0);
        check_normals(&frustum, around[i], 1, 0);
        for (double low = 0; low < 1; low += 0.2) {
            check_normals_between(&cone, around[i], low, low + 0.01);
            check_normals_between(&cone, around[i], low, low + 0.1);
            check_normals_between(&frustum, around[i], low, low + 0.15);
        }
        frustum.radius = 0.5; /* a cylinder */
        check_normals(&frustum, around[i], 1, 0);
        frustum.radius = 1.3;
        check_normals(&frustum, around[i], 1, 0);
        frustum.radius = 0.3;
    }
}

static void reach_bounds_how_far_the_map_onto_facets_moves_points(void **state)
{
    (void)state;
    const lrcs_shape shapes[] = {
        {.kind = LRCS_SHAPE_DOME, .radius = 2, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 1.5, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 0.1, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 2, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_FRUSTUM,
         .radius = 0.5,
         .radius2 = 1,
         .length = 0.7,
         .parts = LRCS_SHAPE_WALL}};
    for (int i = 0; i < 5 * 2; i++) {
        uint32_t along = i / 2 < 3 ? 5 : 1;
        check_reach(&shapes[i / 2], 16, along, i % 2);
        check_reach(&shapes[i / 2], 64, along * along, i % 2);
        check_reach(&shapes[i / 2], 400, along, i % 2);
    }
}

/* The distance of a point from a triangle: from its plane, if the point is above it, else from the
   nearest side. */
static double triangle_distance(const double p[3], const lrcs_mesh *mesh, uint32_t facet)
{
    double n[3];
    double off[3];
    double best = HUGE_VAL;
    int above = 1;
    facet_vector(mesh, facet, n);
    for (int k = 0; k < 3; k++) {
        double side[3];
        double inward[3];
        minus(corner(mesh, facet, k + 1), corner(mesh, facet, k), side);
        minus(p, corner(mesh, facet, k), off);
        cross(n, side, inward);
        above &= dot(inward, off) >= 0.0;
        double t = fmin(1.0, fmax(0.0, dot(side, off) / dot(side, side)));
        const double rest[3] = {off[0] - t * side[0], off[1] - t * side[1], off[2] - t * side[2]};
        best = fmin(best, sqrt(dot(rest, rest)));
    }
    return above ? fabs(dot(n, off)) / sqrt(dot(n, n)) : best;
}

/* The distance of the point at radius r and height z from the true meridian within one strip, by a
   search for the nearest fraction of its area. */
static double meridian_distance(const lrcs_shape *shape, double lower, double upper, double r,
                                double z)
{
    double at = 0.0;
    double best = HUGE_VAL;
    double step = 0.5;
    for (int round = 0; round < 40; round++) {
        double middle = round == 0 ? 0.5 : at;
        for (int k = -4; k <= 4; k++) {
            double fraction = fmin(1.0, fmax(0.0, middle + 0.25 * k * step));
            double rho;
            double height;
            true_point(shape, lower, upper, fraction, &rho, &height);
            double distance = hypot(r - rho, z - height);
            if (distance < best) {
                best = distance;
                at = fraction;
            }
        }
        step *= 0.5;
    }
    return best;
}

/* Both Hausdorff distances, by distances of points of each surface from the other. Points of a
   patch are compared with the facets of the same sector, in its own strip and the next ones. */
static void check_hausdorff(const lrcs_shape *shape, uint32_t around, uint32_t along,
                            int level_zones)
{
    enum { STEPS = 7 };
    lrcs_mesh mesh = make_zones(shape, around, along, level_zones, NULL);
    lrcsi_reach reach =
        lrcsi_tessellate_reach(shape, &(lrcs_divisions){around, along, level_zones});
    double h = pi / around;
    double swell = sqrt(2.0 * h / sin(2.0 * h));
    double solid = 0.0;
    double surface = 0.0;
    int has_apex = shape->kind != LRCS_SHAPE_FRUSTUM;
    for (uint32_t i = 0; i < along; i++) {
        int apex = i + 1 == along && has_apex;
        const double *low = mesh.vertex[i * around].x;
        const double *high = mesh.vertex[(i + 1) * around].x;
        double lower = low[0] / swell;
        double upper = apex ? 0.0 : high[0] / swell;
        for (int j = 0; j < STEPS * STEPS; j++) {
            double fraction = (double)(j / STEPS) / (STEPS - 1);
            double angle = h + h * (2.0 * (j % STEPS) / (STEPS - 1.0) - 1.0); /* sector 0 */
            double r;
            double z;
            true_point(shape, lower, upper, fraction, &r, &z);
            const double p[3] = {r * cos(angle), r * sin(angle), z};
            double nearest = HUGE_VAL;
            int outside = 0;
            for (uint32_t strip = i > 0 ? i - 1 : 0; strip < along && strip <= i + 1; strip++) {
                uint32_t per = strip + 1 == along && has_apex ? 1 : 2;
                for (uint32_t f = 2 * around * strip; f < 2 * around * strip + per; f++) {
                    nearest = fmin(nearest, triangle_distance(p, &mesh, f));
                    double n[3];
                    double off[3];
                    facet_vector(&mesh, f, n);
                    minus(p, corner(&mesh, f, 0), off);
                    outside |= dot(n, off) > 0.0;
                }
            }
            surface = fmax(surface, nearest);
            solid = outside ? fmax(solid, nearest) : solid;
            /* the same fractions of a facet */
            double width = swell * (lower + fraction * (upper - lower));
            double side = tan(angle - h) / tan(h);
            double x = width * hypot(cos(h), side * sin(h));
            double height = low[2] + fraction * (high[2] - low[2]);
            double distance = HUGE_VAL;
            for (uint32_t strip = i > 0 ? i - 1 : 0; strip < along && strip <= i + 1; strip++) {
                int end = strip + 1 == along && has_apex;
                double from = mesh.vertex[strip * around].x[0] / swell;
                double to = end ? 0.0 : mesh.vertex[(strip + 1) * around].x[0] / swell;
                distance = fmin(distance, meridian_distance(shape, from, to, x, height));
            }
            surface = fmax(surface, distance);
            true_point(shape, lower, upper, 1.0, &r, &z);
            solid = x > lower ? fmax(solid, distance) : solid; /* surely outside */
        }
    }
    check_most(surface, reach.surface);
    check_most(solid, reach.solid);
    check_most(reach.surface, 3.0 * surface + 1e-12); /* the bounds are not far too wide */
    check_most(reach.solid, 3.0 * solid + 1e-12);
    check_most(reach.solid, reach.surface);
}

static void hausdorff_distances_bound_how_far_the_surfaces_are_from_each_other(void **state)
{
    (void)state;
    const lrcs_shape shapes[] = {
        {.kind = LRCS_SHAPE_DOME, .radius = 2, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 1.5, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 0.1, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 2, .parts = LRCS_SHAPE_WALL},
        {.kind = LRCS_SHAPE_FRUSTUM,
         .radius = 0.5,
         .radius2 = 1,
         .length = 0.7,
         .parts = LRCS_SHAPE_WALL}};
    for (int i = 0; i < 5 * 2; i++) {
        int is_round = i / 2 < 3;
        check_hausdorff(&shapes[i / 2], 16, is_round ? 5 : 1, i % 2);
        check_hausdorff(&shapes[i / 2], 64, is_round ? 20 : 1, i % 2);
        check_hausdorff(&shapes[i / 2], 400, is_round ? 10 : 1, i % 2);
    }
}

static void level_zones_are_closer_to_the_true_surface(void **state)
{
    (void)state;
    const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 2};
    lrcs_mesh mesh = make_zones(&dome, 64, 40, 1, NULL);
    for (uint32_t v = 0; v < mesh.vertex_count; v++) {
        const double *x = mesh.vertex[v].x;
        double h = pi / 64;
        double r = sqrt(x[0] * x[0] + x[1] * x[1]) / sqrt(2.0 * h / sin(2.0 * h));
        if (x[2] > 0.0) {
            check_rel(r * r + x[2] * x[2], 4.0, 1e-14);
        }
    }
    double level = lrcsi_tessellate_reach(&dome, &(lrcs_divisions){400, 40, 1}).all;
    check_most(2.0 * level, lrcsi_tessellate_reach(&dome, &(lrcs_divisions){400, 40, 0}).all);
}

static void no_dimension_at_all_makes_a_mesh_of_no_area(void **state)
{
    (void)state;
    for (int kind = 0; kind < LRCS_SHAPE_KINDS; kind++) {
        lrcs_shape shape = {.kind = kind};
        shape.half_angle_deg = kind == LRCS_SHAPE_CONE ? 15.0 : 0.0;
        int plane = kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_BOX;
        lrcs_patch_bounds c;
        lrcs_mesh mesh = make(&shape, plane ? 4 : 8, 1, &c);
        check_same(group_area(&mesh, 0) + group_area(&mesh, 1), 0.0);
        assert_true(isfinite(c.turn + c.area_err + c.bias + c.rms_turn));
    }
}

static void extreme_dimensions_stay_finite(void **state)
{
    (void)state;
    const double length[] = {0.0, 5e-324, 1e-300, 1e-150, 1.0, 1e50, 1e100};
    for (int i = 0; i < 7 * 7 * 4; i++) {
        const int kinds[] = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_FRUSTUM, LRCS_SHAPE_PARABOLOID,
                             LRCS_SHAPE_DOME};
        lrcs_shape shape = {.kind = kinds[i % 4], .radius = length[i / 4 % 7]};
        shape.length = shape.kind == LRCS_SHAPE_DOME ? 0.0 : length[i / 28];
        shape.radius2 = shape.kind == LRCS_SHAPE_FRUSTUM ? 1.0 : 0.0;
        uint32_t along = i % 4 < 2 ? 1 : 3;
        lrcs_patch_bounds c;
        lrcs_mesh mesh = make(&shape, 8, along, &c);
        assert_true(isfinite(c.turn + c.area_err + c.bias + c.rms_turn));
        double reach = lrcsi_tessellate_reach(&shape, &(lrcs_divisions){8, along, 0}).all;
        double size = shape.radius + shape.radius2 + shape.length;
        assert_true(reach >= 0.0 && reach <= 3.0 * size + 1e-300);
        for (uint32_t v = 0; v < mesh.vertex_count; v++) {
            const double *x = mesh.vertex[v].x;
            assert_true(isfinite(x[0] + x[1] + x[2]));
        }
    }
}

static void a_cone_by_half_angle_is_the_cone_by_length(void **state)
{
    (void)state;
    lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 2, .half_angle_deg = 45};
    lrcs_mesh mesh = make(&cone, 8, 1, NULL);
    check_rel(mesh.vertex[mesh.vertex_count - 1].x[2], 2.0, 4e-16);
}

static void divisions_that_do_not_suit_are_refused(void **state)
{
    (void)state;
    const lrcs_divisions bad[] = {{0, 1, 0}, {4, 1, 0}, {10, 1, 0},
                                  {8, 0, 0}, {8, 2, 0}, {1u << 25, 1, 0}};
    lrcs_shape cylinder = {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 1};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_mesh mesh;
        assert_int_equal(lrcs_shape_mesh(&cylinder, &bad[i], &work, &mesh, NULL), LRCS_E_ARGUMENT);
        assert_int_equal(work.used, 0);
    }
    lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    lrcs_divisions huge = {1u << 24, 1u << 24, 0};
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_mesh mesh;
    assert_int_equal(lrcs_shape_mesh(&sphere, &huge, &work, &mesh, NULL), LRCS_E_ARGUMENT);
    huge = (lrcs_divisions){8, (1u << 24) + 1, 0};
    assert_int_equal(lrcs_shape_mesh(&sphere, &huge, &work, &mesh, NULL), LRCS_E_ARGUMENT);
    const lrcs_divisions whole[] = {{8, 1, 0}, {4, 2, 0}};
    lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(lrcs_shape_mesh(&box, &whole[i], &work, &mesh, NULL), LRCS_E_ARGUMENT);
    }
    box.size[1] = -1;
    assert_int_equal(lrcs_shape_mesh(&box, &(lrcs_divisions){4, 1, 0}, &work, &mesh, NULL),
                     LRCS_E_ARGUMENT);
    assert_int_equal(work.used, 0);
}

static void a_work_area_that_is_too_small_is_left_as_it_was(void **state)
{
    (void)state;
    lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 1};
    lrcs_divisions divisions = {8, 2, 0};
    int status = LRCS_E_MEMORY;
    size_t size = 0;
    for (; status == LRCS_E_MEMORY && size < 8192; size++) {
        lrcs_work work = lrcs_work_make(area, size);
        lrcs_mesh mesh = {.vertex_count = 77};
        status = lrcs_shape_mesh(&dome, &divisions, &work, &mesh, NULL);
        if (status == LRCS_E_MEMORY) {
            assert_int_equal(work.used, 0);
            assert_int_equal(mesh.vertex_count, 77);
            assert_true(work.peak > size);
        }
    }
    assert_int_equal(status, LRCS_OK);
    assert_true(size > 40 * sizeof(lrcs_facet));
}

/* Every facet of a wall is one of the two of its patch, or the one at an apex; those of caps, of
   discs and of plane faces have none. Each patch is listed as often as it has facets. */
static void walls_have_patches_and_what_is_flat_has_none(void **state)
{
    (void)state;
    static const int kinds[] = {LRCS_SHAPE_PLATE,    LRCS_SHAPE_BOX,  LRCS_SHAPE_DISC,
                                LRCS_SHAPE_CYLINDER, LRCS_SHAPE_CONE, LRCS_SHAPE_DOME,
                                LRCS_SHAPE_SPHERE};
    for (int i = 0; i < 14; i++) {
        lrcs_shape shape = {.kind = kinds[i / 2], .size = {1, 1, 1}, .radius = 1, .length = 1};
        shape.parts = i % 2 ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL;
        int is_round = kinds[i / 2] >= LRCS_SHAPE_DOME || kinds[i / 2] == LRCS_SHAPE_SPHERE;
        lrcs_divisions divisions = {.around = i < 4 ? 4 : 12, .along = is_round ? 3 : 1};
        if (lrcsi_tessellate_fits(&shape, &divisions) == 0) {
            divisions.along = 1;
        }
        lrcs_mesh_counts counts = lrcsi_tessellate_counts(&shape, &divisions);
        uint32_t shares = 0; /* in twelfths of patches */
        uint32_t patches = 0;
        for (uint32_t f = 0; f < counts.facets + 2; f++) {
            lrcsi_wall_patch on;
            if (lrcsi_tessellate_patch(&shape, &divisions, f, &on)) {
                assert_true(f < counts.facets && i >= 6);
                assert_true(on.row < divisions.along && on.sector < divisions.around);
                assert_true(on.facets == 1 || on.facets == 2);
                shares += 2 / on.facets;
                patches++;
            }
        }
        uint32_t halves = kinds[i / 2] == LRCS_SHAPE_SPHERE ? 2 : 1;
        assert_int_equal(shares, i < 6 ? 0 : halves * 2 * divisions.around * divisions.along);
        assert_true(i < 6 || patches <= counts.facets);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_have_patches_and_what_is_flat_has_none),
        cmocka_unit_test(areas_and_volumes_tend_to_the_bodys_as_the_square),
        cmocka_unit_test(solids_are_closed_manifolds_that_face_outward),
        cmocka_unit_test(solids_are_convex_up_to_rounding),
        cmocka_unit_test(polygons_are_symmetric_to_the_bit_and_start_on_x),
        cmocka_unit_test(discs_of_many_sides_have_no_slivers),
        cmocka_unit_test(a_sphere_is_symmetric_about_its_equator_which_lies_at_zero),
        cmocka_unit_test(plane_faced_bodies_and_discs_have_no_curvature),
        cmocka_unit_test(curvature_bounds_every_patch_and_is_nearly_reached),
        cmocka_unit_test(reach_bounds_how_far_the_map_onto_facets_moves_points),
        cmocka_unit_test(normals_are_nearly_linear_in_position_on_facets),
        cmocka_unit_test(hausdorff_distances_bound_how_far_the_surfaces_are_from_each_other),
        cmocka_unit_test(level_zones_are_closer_to_the_true_surface),
        cmocka_unit_test(no_dimension_at_all_makes_a_mesh_of_no_area),
        cmocka_unit_test(extreme_dimensions_stay_finite),
        cmocka_unit_test(a_cone_by_half_angle_is_the_cone_by_length),
        cmocka_unit_test(divisions_that_do_not_suit_are_refused),
        cmocka_unit_test(a_work_area_that_is_too_small_is_left_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
