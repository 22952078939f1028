/* SPDX-License-Identifier: MIT */
/* The projected area of the surface of bodies of revolution that faces the laser, wall and ends.
   An element of surface with unit normal n is weighted by |n . s_hat|; the bodies are convex, so
   that nothing hides it. Reported beside sigma, not part of it: no error bound is derived. */
#include <math.h>

#include "base/degrees.h"
#include "optics/closed.h"

double lrcsi_closed_length(const lrcs_shape *shape)
{
    double sine;
    double cosine;
    if (shape->half_angle_deg > 0.0) {
        lrcsi_degrees_sincos(shape->half_angle_deg, &sine, &cosine);
        return shape->radius * cosine / sine;
    }
    return shape->length;
}

/* A wall whose normals make a circle (closed_cone.c): cos(theta) = a + b cos(phi) is positive for
   |phi| < phi_1; area/pi times the integral from 0 to phi_1. */
static double cone_silhouette(double top, double base, double length, double sine, double cosine)
{
    double slant = hypot(base - top, length);
    if (!(slant > 0.0)) {
        return 0.0;
    }
    double a = (base - top) / slant * cosine;
    double b = length / slant * sine;
    double phi_1 = atan2(sqrt(fmax(0.0, (b - a) * (b + a))), -a); /* acos(-a / b), in 0 .. pi */
    return (top + base) * slant * (a * phi_1 + b * sin(phi_1));
}

/* z = H (1 - r^2/R^2): n dA = (T x, T y, 1) R^2 dx dy over the unit disc, T = 2 H/R. With
   c = cosine and k = T sine, the integral of 2 sqrt(1 - x^2) (c + k x) over x > x_0 = -c/k. */
static double paraboloid_silhouette(const lrcs_shape *shape, double sine, double cosine)
{
    double k = 2.0 * shape->length / shape->radius * sine;
    double x_0 = fmax(-1.0, fmin(1.0, k > 0.0 ? -cosine / k : cosine > 0.0 ? -1.0 : 1.0));
    double root = sqrt((1.0 - x_0) * (1.0 + x_0));
    double sum = cosine * (atan2(root, x_0) - x_0 * root) + k * (2.0 / 3.0) * root * root * root;
    return shape->radius > 0.0 ? shape->radius * shape->radius * fmax(0.0, sum) : 0.0;
}

double lrcsi_closed_silhouette(const lrcs_shape *shape, double sine, double cosine)
{
    double r = shape->radius;
    double up = LRCS_PI * fmax(0.0, cosine);    /* a unit disc that faces up, as seen */
    double down = LRCS_PI * fmax(0.0, -cosine); /* or down */
    double ends = shape->parts == LRCS_SHAPE_ALL ? 1.0 : 0.0;
    switch (shape->kind) {
    case LRCS_SHAPE_SPHERE:
        return LRCS_PI * r * r;
    case LRCS_SHAPE_DOME: /* half a disc, plus or minus half an ellipse */
        return 0.5 * LRCS_PI * r * r * (1.0 + cosine) + ends * r * r * down;
    case LRCS_SHAPE_CYLINDER:
        return 2.0 * r * shape->length * sine + ends * r * r * (up + down);
    case LRCS_SHAPE_CONE:
        return cone_silhouette(0.0, r, lrcsi_closed_length(shape), sine, cosine) +
               ends * r * r * down;
    case LRCS_SHAPE_FRUSTUM:
        return cone_silhouette(r, shape->radius2, shape->length, sine, cosine) +
               ends * (r * r * up + shape->radius2 * shape->radius2 * down);
    case LRCS_SHAPE_PARABOLOID:
        return paraboloid_silhouette(shape, sine, cosine) + ends * r * r * down;
    default:
        return 0.0;
    }
}
