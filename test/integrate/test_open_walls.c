/* SPDX-License-Identifier: MIT */
/* What open walls hide of their own insides, and the integrals over what the laser sees of these:
   against rays through the implicit surfaces, and against sums over many points of them. */
#include <lrcs/lrcs.h>

#include <string.h>

#include "base/rotate.h"
#include "check.h"
#include "integrate/wall/patch.h"
#include "integrate/wall/rim_shadow.h"
#include "patch_scene.h"
#include "random.h"

#define PI 3.14159265358979323846

static uint64_t seed = 1;

static double between(double low, double high)
{
    return low + (high - low) * random_unit(&seed);
}

/* --- the reference: rays in the shape's frame ------------------------------------------------- */

typedef struct open_wall {
    lrcs_shape shape;
    double height, bottom, top; /* radii at z = 0 and at z = height */
} open_wall;

static open_wall wall_at_random(int i)
{
    static const int kind[] = {LRCS_SHAPE_DOME, LRCS_SHAPE_PARABOLOID, LRCS_SHAPE_CYLINDER,
                               LRCS_SHAPE_CONE, LRCS_SHAPE_FRUSTUM};
    open_wall w = {.shape = {.kind = kind[i % 5], .parts = LRCS_SHAPE_WALL}};
    w.shape.radius = between(0.2, 1);
    w.shape.length = w.shape.kind == LRCS_SHAPE_DOME ? 0 : between(0.2, 1.5);
    w.shape.radius2 = w.shape.kind == LRCS_SHAPE_FRUSTUM ? between(0.2, 1) : 0;
    w.height = w.shape.kind == LRCS_SHAPE_DOME ? w.shape.radius : w.shape.length;
    w.bottom = w.shape.kind == LRCS_SHAPE_FRUSTUM ? w.shape.radius2 : w.shape.radius;
    w.top = w.shape.kind == LRCS_SHAPE_FRUSTUM || w.shape.kind == LRCS_SHAPE_CYLINDER
                ? w.shape.radius
                : 0;
    return w;
}

/* The radius at a height, and its square, which is defined beyond the ends too. */
static double radius_squared(const open_wall *w, double z)
{
    const double r = w->shape.radius;
    if (w->shape.kind == LRCS_SHAPE_DOME) {
        return r * r - z * z;
    }
    if (w->shape.kind == LRCS_SHAPE_PARABOLOID) {
        return r * r * (1 - z / w->height);
    }
    const double at = w->bottom + (w->top - w->bottom) * z / w->height;
    return at * at;
}

/* Does a ray from a point of the inside leave through an opening? It is followed in small steps to
   the end of the body's heights: it hits the wall if it is outside before. */
static int ray_leaves(const open_wall *w, const double p[3], const double d[3])
{
    const int steps = 4000;
    const double end = d[2] < 0 ? -p[2] / d[2] : d[2] > 0 ? (w->height - p[2]) / d[2] : 1e9;
    const int is_open = d[2] < 0 || (w->top > 0 && d[2] > 0);
    for (int i = 1; i < steps && is_open; i++) {
        const double t = end * i / steps;
        const double x = p[0] + t * d[0];
        const double y = p[1] + t * d[1];
        if (x * x + y * y > radius_squared(w, p[2] + t * d[2])) {
            return 0;
        }
    }
    return is_open;
}

/* A point of the wall and its outward normal, given a height. */
static void wall_point(const open_wall *w, double z, double phi, double p[3], double n[3])
{
    const double rho = sqrt(radius_squared(w, z));
    const double slope = (radius_squared(w, z + 1e-6) - radius_squared(w, z - 1e-6)) / 4e-6;
    p[0] = rho * cos(phi);
    p[1] = rho * sin(phi);
    p[2] = z;
    n[0] = p[0];
    n[1] = p[1];
    n[2] = -slope;
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        n[k] /= length;
    }
}

static void any_direction(double d[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = between(-1, 1);
        square += d[k] * d[k];
    }
    for (int k = 0; k < 3; k++) {
        d[k] /= sqrt(square);
    }
}

/* --- tests ------------------------------------------------------------------------------------ */

static lrcs_part part_of(const open_wall *w)
{
    lrcs_part part = {.kind = w->shape.kind, .shape = w->shape, .rigid = 1};
    part.divisions.around = 32;
    part.divisions.along = 8;
    for (int k = 0; k < 3; k++) {
        part.axis[k][k] = 1;
    }
    return part;
}

/* The height of a straight wall above the rim that is nearer to the laser up to which it is visible
   where a fraction of its area is. */
static double height_of(const open_wall *w, double from, double to, double fraction)
{
    const double sigma = (to - from) / w->height;
    const double area = fraction * w->height * (from + to);
    return fabs(sigma) < 1e-9 ? area / (2 * from)
                              : (sqrt(fmax(0, from * from + sigma * area)) - from) / sigma;
}

static void shadows_end_where_rays_leave_an_opening(void **state)
{
    (void)state;
    int seen = 0;
    int hidden = 0;
    for (int i = 0; i < 4000; i++) {
        const open_wall w = wall_at_random(i);
        const lrcs_part part = part_of(&w);
        double d[3];
        double p[3];
        double n[3];
        any_direction(d);
        const lrcsi_rim_shadow shadow = lrcsi_rim_shadow_make(&part, d);
        const double z = w.height * between(0.01, 0.99);
        const double phi = between(0, 2 * PI);
        wall_point(&w, z, phi, p, n);
        const double cosine = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
        int says;
        double margin;
        if (shadow.round) {
            const lrcsi_rim_value at = lrcsi_rim_shadow_at(&shadow, acos(n[2]), phi);
            says = shadow.lit && at.value > 0;
            margin = fabs(at.value);
        } else {
            const double y = d[2] < 0 ? z : w.height - z;
            const double limit =
                height_of(&w, d[2] < 0 ? w.bottom : w.top, d[2] < 0 ? w.top : w.bottom,
                          lrcsi_rim_shadow_fraction(&shadow, phi).value);
            says = cosine < 0 && y < limit;
            margin = fabs(y - limit) / w.height;
        }
        if (fabs(cosine) < 0.02 || margin < 0.02) {
            continue; /* too close for the steps of the ray */
        }
        const int truth = cosine < 0 && ray_leaves(&w, p, d);
        assert_int_equal(says, truth);
        seen += truth;
        hidden += cosine < 0 && !truth;
    }
    assert_true(seen > 500 && hidden > 500);
}

/* E changes sign where the second-order bound allows it, and its derivatives are those of E. */
static void derivatives_and_bounds_of_the_shadow_hold(void **state)
{
    (void)state;
    for (int i = 0; i < 400; i++) {
        const open_wall w = wall_at_random(i % 2);
        const lrcs_part part = part_of(&w);
        double d[3];
        any_direction(d);
        const lrcsi_rim_shadow s = lrcsi_rim_shadow_make(&part, d);
        const double alpha = between(0, 1.5);
        const double phi = between(0, 6);
        const double x = between(-0.3, 0.3);
        const double y = between(-0.3, 0.3);
        const lrcsi_rim_value at = lrcsi_rim_shadow_at(&s, alpha, phi);
        const lrcsi_rim_value next = lrcsi_rim_shadow_at(&s, alpha + x, phi + y);
        check_most(fabs(next.value - (at.value + at.slope[0] * x + at.slope[1] * y)),
                   lrcsi_rim_shadow_second(&s, fabs(x), fabs(y)) + 1e-14);
        for (int k = 0; k < 2; k++) {
            check_most(fabs(next.slope[k] - at.slope[k]),
                       lrcsi_rim_shadow_slope_change(&s, k, fabs(x), fabs(y)) + 1e-14);
        }
    }
}

/* The place of a shape: turned, and with uneven scales if asked for. */
static lrcs_place place_at_random(int uneven)
{
    lrcs_place place = lrcs_place_default();
    const double euler[3] = {between(0, 360), between(0, 360), between(0, 360)};
    assert_int_equal(lrcsi_rotate_euler("XYZ", euler, place.rotate), LRCS_OK);
    for (int k = 0; k < 3; k++) {
        place.scale[k] = uneven ? between(0.4, 1) : 0.7;
        place.translate[k] = between(-1, 1);
    }
    return place;
}

/* The direction to the laser in the shape's frame, not normalised, from that in the body frame. */
static void direction_in_shape(const lrcs_place *place, const double d[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] =
            (place->rotate[0][k] * d[0] + place->rotate[1][k] * d[1] + place->rotate[2][k] * d[2]) /
            place->scale[k];
    }
}

/* f_r cos^2 of a side at a point of the wall, times the ratio of areas that the scales make. */
static double reflected(const lrcs_place *place, const lrcs_brdf *brdf, const double n[3],
                        const double d[3], int side)
{
    const double m[3] = {n[0] / place->scale[0], n[1] / place->scale[1], n[2] / place->scale[2]};
    const double length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    double c = 0;
    for (int i = 0; i < 3; i++) {
        c += d[i] *
             (place->rotate[i][0] * m[0] + place->rotate[i][1] * m[1] + place->rotate[i][2] * m[2]);
    }
    return patch_reflect_at(brdf, side * c / length) * length * place->scale[0] * place->scale[1] *
           place->scale[2];
}

/* Sums over both sides of the whole wall: of many points, the inside with rays. around: sectors. */
static double sum_over_points(const open_wall *w, const lrcs_place *place, const lrcs_brdf *brdf,
                              const double d[3], int n)
{
    double sum = 0;
    double ray[3];
    direction_in_shape(place, d, ray);
    for (int i = 0; i < n; i++) {
        const double z = w->height * (i + 0.5) / n;
        for (int k = 0; k < n; k++) {
            double p[3];
            double m[3];
            wall_point(w, z, 2 * PI * (k + 0.5) / n, p, m);
            const double across = hypot(m[0], m[1]);
            const double area = hypot(p[0], p[1]) * (2 * PI / n) * (w->height / n) / across;
            const double inside = reflected(place, brdf, m, d, -1);
            sum += area * reflected(place, brdf, m, d, 1);
            sum += inside > 0 && ray_leaves(w, p, ray) ? area * inside : 0;
        }
    }
    return sum;
}

/* The same from patches; *err: their errors. */
static double sum_over_patches(const patch_scene *s, const lrcs_brdf *brdf, double *err)
{
    const lrcs_part *part = &s->scene.part[0];
    const lrcsi_rim_shadow shadow = lrcsi_rim_shadow_make(part, s->view.unit);
    double sum = 0;
    *err = 0;
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        lrcsi_patch patch;
        for (int side = 1; side >= -1 && !s->view.prepared->skip[f]; side -= 2) {
            assert_int_equal(lrcsi_patch_make_side(&s->view, &s->plan, brdf, f,
                                                   side > 0 ? NULL : &shadow, 0, &patch),
                             1);
            const double area = 0.5 * s->view.prepared->normal[f].length;
            sum += area * (patch.glint + patch.diffuse);
            *err += area * (patch.remainder + patch.rounding);
        }
    }
    *err = lrcsi_prepared_area(s->view.prepared, *err);
    return lrcsi_prepared_area(s->view.prepared, sum);
}

static void insides_and_outsides_add_up_to_those_of_many_points(void **state)
{
    (void)state;
    static patch_scene s;
    for (int i = 0; i < 15; i++) {
        const open_wall w = wall_at_random(i);
        const lrcs_brdf brdf = {i % 2 ? 0.2 : 0, 0.3, between(0.2, 1), between(0, 2)};
        double d[3];
        double err;
        any_direction(d);
        s.place = place_at_random(i / 5 % 2);
        patch_scene_make(&w.shape, 0.2, &brdf, 1, d, &s);
        s.plan.tolerance = 1e-6;
        const double sum = sum_over_patches(&s, &brdf, &err);
        check_most(err, 1e-6 * sum);
        check_rel(sum, sum_over_points(&w, &s.place, &brdf, s.view.unit, 80), 1.2e-2);
    }
}

/* Coarse and fine divisions, small and large tolerances: within their errors, which are as small as
   was asked for. */
static void answers_agree_within_their_errors(void **state)
{
    (void)state;
    static patch_scene s;
    for (int i = 0; i < 15; i++) {
        const open_wall w = wall_at_random(i);
        const lrcs_brdf brdf = {i % 3 ? 0.3 : 0, i % 3 == 1 ? 0 : 0.3, between(0.05, 1),
                                between(0, 3)};
        double d[3];
        double sum[2];
        double err[2];
        any_direction(d);
        s.place = place_at_random(i / 5 % 2);
        for (int fine = 0; fine < 2; fine++) {
            patch_scene_make(&w.shape, fine ? 0.02 : 0.2, &brdf, 1, d, &s);
            s.plan.tolerance = fine ? 1e-9 : 1e-4;
            sum[fine] = sum_over_patches(&s, &brdf, &err[fine]);
        }
        check_abs(sum[0], sum[1], err[0] + err[1]);
        if (brdf.B > 0) {
            check_most(err[1], 1e-8 * sum[1]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadows_end_where_rays_leave_an_opening),
        cmocka_unit_test(derivatives_and_bounds_of_the_shadow_hold),
        cmocka_unit_test(insides_and_outsides_add_up_to_those_of_many_points),
        cmocka_unit_test(answers_agree_within_their_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
