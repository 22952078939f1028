/* SPDX-License-Identifier: MIT */
/* Where the solid of a curved shape is farthest in a direction: on its round wall, on one of its
   circles, or at its apex; and along which curve that point moves if the direction turns. */
#include "mesh/shape/support.h"

#include <math.h>

#include <lrcs/shape.h>

#include "base/range.h"

/* Let r be the component of a direction across the axis, and z that along it. Where z > c r, the
   support point is on the upper part of the solid: its round wall, upper circle or apex; else it is
   on the base's circle. Here c is 0 for a dome or cylinder, positive where the solid narrows
   upwards, negative where it widens. A sphere is all round. */
static int is_on_upper_part(const lrcsi_support *s, double r, double z)
{
    switch (s->kind) {
    case LRCS_SHAPE_SPHERE:
        return 1;
    case LRCS_SHAPE_DOME:
    case LRCS_SHAPE_CYLINDER:
        return z > 0;
    case LRCS_SHAPE_CONE:
        return s->length * z > s->radius * r;
    case LRCS_SHAPE_FRUSTUM:
        return s->radius * r + s->length * z > s->radius2 * r;
    default: /* paraboloid */
        return 2 * s->length * z > s->radius * r;
    }
}

/* The sign of c. */
static int boundary_side(const lrcsi_support *s)
{
    if (s->kind == LRCS_SHAPE_FRUSTUM) {
        return (s->radius2 > s->radius) - (s->radius2 < s->radius);
    }
    return s->kind == LRCS_SHAPE_CONE || s->kind == LRCS_SHAPE_PARABOLOID;
}

/* The radius of the base's circle. */
static double base_radius(const lrcsi_support *s)
{
    return s->kind == LRCS_SHAPE_FRUSTUM ? s->radius2 : s->radius;
}

/* The meridian in the direction's half-plane gives the distance rho from the axis and the height:
   rho r + height z is largest
   - on a sphere where the normal is n;
   - on a paraboloid, rho r + z H (1 - rho^2/R^2), at rho = R r / (2 H z) R, up to its rim;
   - on a straight wall at one of its ends. */
void lrcsi_support_point(const lrcsi_support *s, const double n[3], double point[3])
{
    double z = n[2];
    double r = sqrt(n[0] * n[0] + n[1] * n[1]);
    double rho = base_radius(s);
    double height = 0;
    if (is_on_upper_part(s, r, z)) {
        rho = s->radius;
        height = s->length;
        if (s->kind == LRCS_SHAPE_SPHERE || s->kind == LRCS_SHAPE_DOME) {
            double length = sqrt(r * r + z * z);
            rho = s->radius * (r / length);
            height = s->radius * (z / length);
        } else if (s->kind == LRCS_SHAPE_CONE) {
            rho = 0;
        } else if (s->kind == LRCS_SHAPE_PARABOLOID) {
            double fraction = s->radius * r / (2 * s->length * z);
            rho = s->radius * fraction;
            height = s->length * (1 - fraction) * (1 + fraction);
        }
    }
    point[0] = r > 0 ? rho * (n[0] / r) : rho;
    point[1] = r > 0 ? rho * (n[1] / r) : 0;
    point[2] = height;
}

/* Are the support points on the same part of the solid, upper part or base, for all directions
   between two? z - c r is a concave function along a straight line if c > 0, convex if c < 0. So
   the directions of the upper part are convex in the first case, those of the base in the second.
   In the other cases, z is between its values at both ends, and r at least the smaller of its
   values there times the cosine of the angle between the two. */
static int is_on_one_part(const lrcsi_support *s, const double n[3], const double m[3])
{
    const double r[2] = {sqrt(n[0] * n[0] + n[1] * n[1]), sqrt(m[0] * m[0] + m[1] * m[1])};
    const int upper = is_on_upper_part(s, r[0], n[2]);
    const double along = n[0] * m[0] + n[1] * m[1]; /* r r cos */
    if (upper != is_on_upper_part(s, r[1], m[2])) {
        return 0;
    }
    if (upper ? boundary_side(s) >= 0 : boundary_side(s) <= 0) {
        return 1;
    }
    if (!(along > 0)) {
        return 0;
    }
    const double narrow = along / lrcsi_max(r[0], r[1]);
    const double z = upper ? lrcsi_min(n[2], m[2]) : lrcsi_max(n[2], m[2]);
    return is_on_upper_part(s, narrow, z) == upper;
}

/* A sphere's support points for directions in a plane are on a great circle. Those of a paraboloid
   for directions along a straight line are in a plane parallel to its axis, because their positions
   across the axis, R/(2 H z) R times the direction's, are on a straight line: on a parabola. An arc
   of 0.5 rad is at most 1.011 times as long as its chord. */
double lrcsi_support_arc(const lrcsi_support *s, const double n[3], const double p[3],
                         const double m[3], const double q[3])
{
    double square = 0;
    if (!is_on_one_part(s, n, m)) {
        return HUGE_VAL;
    }
    const int upper = is_on_upper_part(s, sqrt(n[0] * n[0] + n[1] * n[1]), n[2]);
    if (upper && (s->kind == LRCS_SHAPE_PARABOLOID || s->kind == LRCS_SHAPE_CONE)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        square += (q[k] - p[k]) * (q[k] - p[k]);
    }
    const double radius = upper ? s->radius : base_radius(s);
    const double chord = radius > 0 ? sqrt(square) / radius : 0;
    return chord < 0.49 ? 1.02 * chord : HUGE_VAL;
}
