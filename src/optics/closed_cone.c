/* SPDX-License-Identifier: MIT */
/* Walls whose normals make one circle about the axis: cylinder, cone, frustum. It decides which
   part of the circle is lit; the integral of F over it is the Gauss-Legendre rule of closed_arc.c,
   except for the cylinder, which has a closed form.

   With the half-angle beta (the wall's normals are at an angle of pi/2 - beta to the axis) the
   normal at azimuth phi has
     cos(theta) = sin(beta) cos(alpha) + cos(beta) sin(alpha) cos(phi)
                = c_max (1 - k sin^2(phi/2)),
   where c_max = sin(alpha + beta), k = 2 cos(beta) sin(alpha) / c_max, and 1 - k is c_min / c_max
   with c_min = sin(beta - alpha). The integral of F over the wall is
     area/pi F(c_max) times the integral over phi = 0 .. phi_1 of F / F(c_max). */
#include <math.h>

#include "base/degrees.h"
#include "optics/closed_arc.h"
#include "optics/special.h"

/* The half-angle and the surface of a wall of revolution. beta_deg is negative if the angle is
   computed from lengths. */
typedef struct cone_wall {
    lrcsi_angle beta;
    double beta_deg, area;
} cone_wall;

/* tan(beta) = (base - top) / length, of either sign. */
static cone_wall cone_wall_make(double top, double base, double length)
{
    lrcsi_dd rise = lrcsi_dd_two_sum(base, -top);
    lrcsi_dd height = {length, 0.0};
    lrcsi_dd slant = lrcsi_closed_hypot(rise, height);
    cone_wall wall = {{{0.0, 0.0}, {1.0, 0.0}}, -1.0, 0.0};
    if (slant.hi > 0.0) {
        wall.beta.sine = lrcsi_dd_div(rise, slant);
        wall.beta.cosine = lrcsi_dd_div(height, slant);
        wall.area = LRCS_PI * (top + base) * slant.hi;
    }
    return wall;
}

static cone_wall cone_wall_from_degrees(double radius, double beta_deg)
{
    cone_wall wall;
    lrcsi_degrees_sincos_dd(beta_deg, 0.0, &wall.beta.sine, &wall.beta.cosine);
    wall.beta_deg = beta_deg;
    wall.area = LRCS_PI * radius * radius / wall.beta.sine.hi;
    return wall;
}

/* At the left end sin^2(phi/2) is computed, at the right end its complement at phi = pi or phi_1:
   1 - k sin^2(phi/2) = k sin(d/2) sin(phi_1 - d/2) at phi = phi_1 - d, phi_1 = pi - psi_1. */
lrcsi_arc_point lrcsi_circle_point(const lrcsi_arc *arc, int right, double d)
{
    const lrcsi_normal_circle *circle = &arc->circle;
    double sine = sin(0.5 * d);
    double y = circle->k * sine * sine;
    double q = 1.0 - y;
    if (right && circle->q_pi >= 0.0) {
        double cosine = cos(0.5 * d);
        q = circle->q_pi + y;
        y = circle->k * cosine * cosine;
    } else if (right) {
        double phi_1 = arc->length;
        double far = phi_1 < circle->psi_1 ? phi_1 - 0.5 * d : circle->psi_1 + 0.5 * d;
        q = circle->k * sine * sin(far);
        y = 1.0 - q;
    }
    return (lrcsi_arc_point){y, q, 1.0};
}

static lrcsi_arc circle_arc(const lrcs_brdf *brdf, double c_max, double c_min, double b)
{
    lrcsi_arc arc = {0};
    for (int term = 0; term < LRCSI_TERMS; term++) {
        arc.integrand[term] = lrcsi_arc_integrand_make(brdf, term, c_max);
    }
    arc.circle.k = 2.0 * b / c_max;
    arc.circle.q_pi = c_min / c_max;
    arc.length = LRCS_PI;
    arc.left_smooth = LRCS_PI;
    arc.weight_scale = LRCS_PI;
    if (c_min < 0.0) {
        arc.length = 2.0 * atan2(sqrt(c_max), sqrt(-c_min));
        arc.circle.psi_1 = 2.0 * atan2(sqrt(-c_min), sqrt(c_max));
    } else {
        /* q varies by at most an eighth of itself, and its zeros are at pi +- 2 sqrt(q_pi/k) i */
        arc.right_smooth = fmin(LRCS_PI, sqrt(0.5 * arc.circle.q_pi / arc.circle.k));
    }
    return arc;
}

/* Units beside F: area 6, c_max and k 4, phi_1 6, the arc. */
lrcsi_term_integrals lrcsi_closed_cone(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                       const lrcsi_laser_direction *laser)
{
    /* 1. the wall; if it is wider at the top, it is the same cone upside down */
    double base = shape->kind == LRCS_SHAPE_FRUSTUM ? shape->radius2 : shape->radius;
    double top = shape->kind == LRCS_SHAPE_FRUSTUM ? shape->radius : 0.0;
    cone_wall wall = shape->half_angle_deg > 0.0
                         ? cone_wall_from_degrees(base, shape->half_angle_deg)
                         : cone_wall_make(top, base, shape->length);
    lrcsi_angle aspect = laser->aspect;
    double deg = laser->deg;
    if (wall.beta.sine.hi < 0.0) {
        wall.beta.sine = lrcsi_dd_negate(wall.beta.sine);
        aspect.cosine = lrcsi_dd_negate(aspect.cosine);
        deg = -1.0;
    }
    /* 2. alpha + beta and beta - alpha; from exact degrees if both are given in degrees, so that 0
       and 180 are exact */
    lrcsi_angle sum, difference;
    if (wall.beta_deg >= 0.0 && deg >= 0.0) {
        lrcsi_degrees_sincos_dd(deg, wall.beta_deg, &sum.sine, &sum.cosine);
        lrcsi_degrees_sincos_dd(wall.beta_deg, -deg, &difference.sine, &difference.cosine);
    } else {
        sum = lrcsi_closed_angle_sum(aspect, wall.beta);
        difference = lrcsi_closed_angle_difference(wall.beta, aspect);
    }
    /* 3. F(c_max), then the integral relative to it, and the area */
    lrcsi_angle theta = {sum.cosine, sum.sine}; /* cos(theta) = sin(alpha + beta) */
    lrcsi_term_integrals amount = lrcsi_closed_reflect(brdf, theta);
    double b = wall.beta.cosine.hi * aspect.sine.hi;
    double factor[LRCSI_TERMS] = {1.0, 1.0};
    if (b > 0.0 && (amount.value[LRCSI_GLINT] > 0.0 || amount.value[LRCSI_DIFFUSE] > 0.0)) {
        double integral[LRCSI_TERMS];
        lrcsi_arc arc = circle_arc(brdf, sum.sine.hi, difference.sine.hi, b);
        for (int term = 0; term < LRCSI_TERMS; term++) {
            arc.requested[term] = amount.value[term] > 0.0;
        }
        lrcsi_arc_integral(&arc, integral);
        for (int term = 0; term < LRCSI_TERMS; term++) {
            factor[term] = arc.requested[term] ? integral[term] / LRCS_PI : 1.0;
        }
    }
    lrcsi_closed_scale_terms(&amount, factor, LRCSI_ARC_UNITS + 12.0);
    lrcsi_closed_scale(&amount, wall.area, 6.0);
    return amount;
}

/* F at the brightest line, theta = pi/2 - alpha, times 2 R L / 2 pi and the integrals over phi of
   q^-4 exp(-(1/q^2 - 1)/w^2) = sqrt(pi) w (1 + w^2/2), w = s sin(alpha) (t = tan(phi)), and of
   cos^(m+2). Units: area 2, w 2, sum and products 6; special 48. */
lrcsi_term_integrals lrcsi_closed_cylinder(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                           const lrcsi_laser_direction *laser)
{
    lrcsi_angle theta = {laser->aspect.cosine, laser->aspect.sine};
    lrcsi_term_integrals amount = lrcsi_closed_reflect(brdf, theta);
    double w = brdf->s * laser->aspect.sine.hi;
    const double factor[LRCSI_TERMS] = {sqrt(LRCS_PI) * w * (1.0 + 0.5 * w * w),
                                        lrcsi_special_cosine_power(brdf->m + 2.0)};
    lrcsi_closed_scale_terms(&amount, factor, 50.0);
    lrcsi_closed_scale(&amount, shape->radius * shape->length, 1.0);
    return amount;
}
