/* SPDX-License-Identifier: MIT */
/* Proves how far a facet is at most from a plane, cylinder, sphere or cone, and how far its normal
   turns from that of the surface. It does not find the surface (quadric_find).

   Let c be the surface's point, a its axis divided by its length, and for a point p: q = p - c,
   z = q.a, r = q - z a and rho = |r|; for a sphere, r = q and z = 0. With the half angle alpha,
   which is 0 for a cylinder and a sphere, and R = 0 for a cone, the signed distance from the
   surface is
       d(p) = rho cos(alpha) - z sin(alpha) - R,
   for the nappe of a cone where z >= 0. It is convex in p, since rho is.
   Upper bound: a convex function on a triangle is greatest at a corner.
   Lower bound: for every vector w of length 1, rho >= w.r, with r linear in p. So
       d(p) >= w.r cos(alpha) - z sin(alpha) - R,
   which is linear in p and least at a corner. Every w gives a bound; the best is r/rho at the point
   of the facet with the least d. That lies on a side, or inside the facet where the normals agree:
   so w is tried at the least point of each side, and along the facet's normal.
   A corner of a facet with z < 0 lies beyond the apex, by h at most. Moved by h along the axis, the
   facet does not; that changes d by h sin(alpha), and distances by h.
   For a plane, the distance z is linear.

   Normals: that of the surface at the point nearest to p is N = r/rho cos(alpha) - a sin(alpha).
   Let n be the facet's unit normal and s = 1 or -1. {r: s n.r >= m rho} is convex for m >= 0, so
   that s n.r/rho is least at a corner if it is not negative there; so is then s n.N, and the angle
   between n and s N is greatest there. It is 2 asin(|n - s N|/2).

   Rounding, u = 2^-53, second-order terms covered by the margins of the constants. |a|^2
   computed is within 16 u of 1, so its length within 10 u. q is accurate to u |q|; z to 1 + 3 + 10
   = 14 u |q|, r to 1 + 14 + 10 + 2 = 27 u |q|, rho or w.r to 27 + 3 + 5 = 35 u |q|; cos(alpha) to 4
   u and sin(alpha) to 5 u relative; so d to (35 + 4 + 1) + (14 + 5 + 1) + 3 = 63 u |q| + 2 u R,
   below 80 u (|q| + R). Underflow adds less than 2^-500. */
#include "analysis/quadric.h"

#include "base/constant.h"
#include "base/length.h"
#include "base/vec3.h"

#define DISTANCE_ERROR    (80 * LRCSI_U)
#define CROSS_MIN         0x1p-500
#define CROSS_MAX         0x1p500 /* above it, squares overflow */
#define QUADRIC_SLOPE_MAX 1e6     /* slope: cos(alpha) and sin(alpha) stay normal numbers */
#define RIGHT_ANGLE_CHORD 1.4142  /* a little less than the chord of a right angle */

lrcsi_quadric_at lrcsi_quadric_locate(const lrcs_quadric *surface, const double p[3])
{
    lrcsi_quadric_at at;
    lrcsi_vec3_between(surface->point, p, at.q);
    at.z = surface->kind == LRCS_QUADRIC_SPHERE ? 0.0 : lrcsi_vec3_dot(at.q, surface->axis);
    for (int k = 0; k < 3; k++) {
        at.r[k] =
            surface->kind == LRCS_QUADRIC_SPHERE ? at.q[k] : at.q[k] - at.z * surface->axis[k];
    }
    at.rho = lrcsi_length(at.r);
    at.cos = 1.0;
    at.sin = 0.0;
    at.radius = surface->kind == LRCS_QUADRIC_PLANE ? 0.0 : surface->radius;
    if (surface->kind == LRCS_QUADRIC_CONE) {
        at.cos = 1.0 / sqrt(1.0 + surface->slope * surface->slope);
        at.sin = surface->slope * at.cos;
        at.radius = 0.0;
    }
    at.distance =
        surface->kind == LRCS_QUADRIC_PLANE ? at.z : (at.rho * at.cos - at.z * at.sin) - at.radius;
    return at;
}

void lrcsi_quadric_normal(const lrcs_quadric *surface, const lrcsi_quadric_at *at, double n[3])
{
    for (int k = 0; k < 3; k++) {
        n[k] = surface->kind == LRCS_QUADRIC_PLANE ? surface->axis[k]
               : surface->kind == LRCS_QUADRIC_CONE
                   ? at->r[k] / at->rho * at->cos - surface->axis[k] * at->sin
                   : at->r[k] / at->rho;
    }
}

double lrcsi_quadric_cross(const lrcs_point corner[3], double n[3])
{
    double side[2][3];
    lrcsi_vec3_between(corner[0].x, corner[1].x, side[0]);
    lrcsi_vec3_between(corner[0].x, corner[2].x, side[1]);
    lrcsi_vec3_cross(side[0], side[1], n);
    return lrcsi_length(side[0]) * lrcsi_length(side[1]);
}

static double error_of(const lrcsi_quadric_at *at)
{
    return DISTANCE_ERROR * (lrcsi_length(at->q) + at->radius) + CROSS_MIN;
}

/* The greatest lower bound of d over the facet that w gives; w of any length, all zero for none. */
static double lower_bound(const lrcsi_quadric_at at[3], const double w[3])
{
    double length = lrcsi_length(w);
    if (!(length > CROSS_MIN && length < CROSS_MAX)) {
        return -HUGE_VAL;
    }
    double least = HUGE_VAL;
    const double unit[3] = {w[0] / length, w[1] / length, w[2] / length};
    for (int i = 0; i < 3; i++) {
        double rho = lrcsi_vec3_dot(unit, at[i].r);
        double d = (rho * at[i].cos - at[i].z * at[i].sin) - at[i].radius;
        least = fmin(least, d - error_of(&at[i]));
    }
    return least;
}

/* w = r of the point of a side with the least d. Along the side, from t = 0 to 1,
   rho^2 = A (t + B/A)^2 + D with A = |side|^2, B = r.side at t = 0 and D the square of the distance
   of its line from the axis; d is stationary where A (t + B/A) = k sqrt(A) rho, with k the slope
   times the change of z, divided by sqrt(A). Without one, d falls to one of the ends. */
static void nearest_on_side(const lrcs_quadric *surface, const lrcsi_quadric_at *from,
                            const lrcsi_quadric_at *to, double w[3])
{
    double side[3];
    lrcsi_vec3_between(from->r, to->r, side);
    double A = lrcsi_vec3_dot(side, side);
    double t = 0.0;
    if (A > 0.0) {
        double foot = -lrcsi_vec3_dot(from->r, side) / A;
        double k =
            surface->kind == LRCS_QUADRIC_CONE ? surface->slope * (to->z - from->z) / sqrt(A) : 0.0;
        double D = 0.0;
        for (int i = 0; i < 3; i++) {
            double r = from->r[i] + foot * side[i];
            D += r * r;
        }
        t = fabs(k) < 1.0 ? foot + k * sqrt(D / (A * (1.0 - k * k))) : k > 0.0 ? 1.0 : 0.0;
        t = fmin(fmax(t, 0.0), 1.0);
    }
    for (int i = 0; i < 3; i++) {
        w[i] = from->r[i] + t * side[i];
    }
}

/* A bound of |d| over the facet. */
static double displacement_bound(const lrcs_quadric *surface, const lrcsi_quadric_at at[3],
                                 const double normal[3])
{
    double bound = 0.0;
    double low = -HUGE_VAL;
    double beyond = 0.0; /* h */
    for (int i = 0; i < 3; i++) {
        double w[3];
        double error = error_of(&at[i]);
        bound = fmax(bound, at[i].distance + error);
        if (surface->kind == LRCS_QUADRIC_PLANE) {
            bound = fmax(bound, error - at[i].distance);
            continue;
        }
        if (surface->kind == LRCS_QUADRIC_CONE) {
            beyond = fmax(beyond, error - at[i].z);
        }
        nearest_on_side(surface, &at[i], &at[(i + 1) % 3], w);
        low = fmax(low, lower_bound(at, w));
    }
    if (surface->kind != LRCS_QUADRIC_PLANE) {
        double w[3];
        int centre = surface->kind == LRCS_QUADRIC_SPHERE;
        double along = centre ? 0.0 : lrcsi_vec3_dot(normal, surface->axis);
        double sign = lrcsi_vec3_dot(normal, at[0].r) < 0.0 ? -1.0 : 1.0;
        for (int k = 0; k < 3; k++) {
            w[k] = sign * (normal[k] - (centre ? 0.0 : along * surface->axis[k]));
        }
        low = fmax(low, lower_bound(at, w));
        bound = fmax(bound, -low);
    }
    return (bound + 2.0 * beyond) * (1.0 + 8 * LRCSI_U);
}

/* A bound of the angle between the normals. The cross product of two sides is accurate to 8 u of
   the product of their lengths, r/rho to 64 u |q|/rho; all else to less than 40 u. */
static double normal_angle_bound(const lrcs_quadric *surface, const lrcsi_quadric_at at[3],
                                 const lrcs_point corner[3], double displacement, int *inside)
{
    double n[3];
    double product = lrcsi_quadric_cross(corner, n);
    double length = lrcsi_length(n);
    if (!(length > 32 * LRCSI_U * product) || !(length > CROSS_MIN && length < CROSS_MAX)) {
        return HUGE_VAL;
    }
    int used = 0;
    double chord_max = 0.0;
    int flat = surface->kind == LRCS_QUADRIC_PLANE;
    double toward = flat ? lrcsi_vec3_dot(n, surface->axis) : 0.0;
    for (int i = 0; i < 3 && !flat; i++) {
        toward += lrcsi_vec3_dot(n, at[i].r);
    }
    double sign = toward < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        if (!flat && !(at[i].rho > displacement)) {
            continue;
        }
        double error = 10 * LRCSI_U * product / length + 40 * LRCSI_U;
        error += flat ? 0.0 : 70 * LRCSI_U * lrcsi_length(at[i].q) / at[i].rho;
        double normal[3];
        double apart[3];
        lrcsi_quadric_normal(surface, &at[i], normal);
        for (int k = 0; k < 3; k++) {
            apart[k] = n[k] / length - sign * normal[k];
        }
        double chord = lrcsi_length(apart) + error;
        double outward = flat ? 1.0 : sign * lrcsi_vec3_dot(n, at[i].r) / length / at[i].rho;
        if (!(chord <= RIGHT_ANGLE_CHORD) || !(outward > error)) {
            return HUGE_VAL;
        }
        chord_max = fmax(chord_max, chord);
        used++;
    }
    *inside = sign < 0.0;
    int enough = surface->kind == LRCS_QUADRIC_CONE ? used >= 2 : used == 3;
    return enough ? 2.0 * asin(0.5 * chord_max) * (1.0 + 16 * LRCSI_U) : HUGE_VAL;
}

int lrcsi_quadric_check(const lrcs_quadric *s)
{
    int round = s->kind == LRCS_QUADRIC_CYLINDER || s->kind == LRCS_QUADRIC_SPHERE;
    if (s->kind < LRCS_QUADRIC_PLANE || s->kind > LRCS_QUADRIC_CONE) {
        return LRCS_E_ARGUMENT;
    }
    for (int k = 0; k < 3; k++) {
        if (!(fabs(s->point[k]) <= LRCSI_COORDINATE_MAX)) {
            return LRCS_E_NUMBER;
        }
        if (s->kind != LRCS_QUADRIC_SPHERE && !(fabs(s->axis[k]) <= 2.0)) {
            return isfinite(s->axis[k]) ? LRCS_E_ARGUMENT : LRCS_E_NUMBER;
        }
    }
    if ((round && !(s->radius <= LRCSI_COORDINATE_MAX)) ||
        (s->kind == LRCS_QUADRIC_CONE && !(s->slope <= QUADRIC_SLOPE_MAX))) {
        return LRCS_E_NUMBER;
    }
    if ((round && !(s->radius > 0.0)) || (s->kind == LRCS_QUADRIC_CONE && !(s->slope > 0.0)) ||
        (s->kind != LRCS_QUADRIC_SPHERE &&
         !(fabs(lrcsi_vec3_dot(s->axis, s->axis) - 1.0) <= 16 * LRCSI_U))) {
        return LRCS_E_ARGUMENT;
    }
    return LRCS_OK;
}

int lrcs_quadric_facet_bound(const lrcs_quadric *surface, const lrcs_point corner[3],
                             lrcs_quadric_bound *bound)
{
    lrcsi_quadric_at at[3];
    double normal[3];
    int status = lrcsi_quadric_check(surface);
    for (int i = 0; i < 9 && status == LRCS_OK; i++) {
        status = fabs(corner[i / 3].x[i % 3]) <= LRCSI_COORDINATE_MAX ? LRCS_OK : LRCS_E_NUMBER;
    }
    if (status != LRCS_OK) {
        return status;
    }
    for (int i = 0; i < 3; i++) {
        at[i] = lrcsi_quadric_locate(surface, corner[i].x);
    }
    lrcsi_quadric_cross(corner, normal);
    *bound = (lrcs_quadric_bound){0};
    bound->displacement = displacement_bound(surface, at, normal);
    bound->normal_angle =
        normal_angle_bound(surface, at, corner, bound->displacement, &bound->inside);
    return LRCS_OK;
}
