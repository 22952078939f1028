/* SPDX-License-Identifier: MIT */
/* What the families of closed forms share: lengths and angles in double-double, F = f_r cos^2 at
   such an angle, and sums of terms with their relative error. */
#ifndef LRCSI_CLOSED_H
#define LRCSI_CLOSED_H

#include <lrcs/shape.h>

#include "base/constant.h"
#include "base/dd.h"
#include "optics/reflect.h"

/* An angle by its sine and cosine, accurate to 2^-96 each. */
typedef struct lrcsi_angle {
    lrcsi_dd sine, cosine;
} lrcsi_angle;

/* The direction to the laser: s_hat in the shape's frame, and its angle from +z. deg is that angle
   if it was given in degrees, else negative. */
typedef struct lrcsi_laser_direction {
    lrcsi_dd s_hat[3];
    lrcsi_angle aspect;
    double deg;
} lrcsi_laser_direction;

/* The terms of F. */
enum lrcsi_term { LRCSI_GLINT, LRCSI_DIFFUSE, LRCSI_TERMS };

/* The integral of F over some surface, by term, with absolute bounds on the errors. */
typedef struct lrcsi_term_integrals {
    double value[LRCSI_TERMS], error[LRCSI_TERMS];
} lrcsi_term_integrals;

/* Length of (a, b): relative error at most 2^-98 for operands of that accuracy; a component that is
   less than 2^-480 of the other counts as 0. */
lrcsi_dd lrcsi_closed_hypot(lrcsi_dd a, lrcsi_dd b);

/* sine and cosine of a + b and a - b: relative error 2^-94 times the cancellation. */
lrcsi_angle lrcsi_closed_angle_sum(lrcsi_angle a, lrcsi_angle b);
lrcsi_angle lrcsi_closed_angle_difference(lrcsi_angle a, lrcsi_angle b);

/* The angle in [0, pi] in radians, for sine >= 0: relative error 6 units. */
double lrcsi_closed_radians(lrcsi_angle a);

/* F per unit of surface at that angle to its normal; 0 if the cosine is not positive. */
lrcsi_term_integrals lrcsi_closed_reflect(const lrcs_brdf *brdf, lrcsi_angle theta);

/* amount *= factor, by term; the factors have a relative error of `units` of 2^-53, or an absolute
   one of 2^-1070 if they are subnormal. A factor of 0 is exact: no area. */
void lrcsi_closed_scale_terms(lrcsi_term_integrals *amount, const double factor[LRCSI_TERMS],
                              double units);

/* The same factor for both terms. */
void lrcsi_closed_scale(lrcsi_term_integrals *amount, double factor, double units);

/* sum += amount. */
void lrcsi_closed_add(lrcsi_term_integrals *sum, const lrcsi_term_integrals *amount);

/* LRCS_OK if a closed form holds for shape and material; else as lrcs_closed_eval. */
int lrcsi_closed_check(const lrcs_shape *shape, const lrcs_brdf *brdf);

/* For such a shape, not a plate or box: the integral of F over its lit surface, without the 4 pi,
   and its projected area, rounded.
   Given: the direction to the laser in the shape's frame, of any length, taken as exact.
   Status: LRCS_OK; LRCS_E_ARGUMENT (no length); LRCS_E_NUMBER (not finite). */
int lrcsi_closed_shape(const lrcs_shape *shape, const lrcs_brdf *brdf, const lrcsi_dd direction[3],
                       lrcsi_term_integrals *sum, double *silhouette);

/* The projected area of a closed body of revolution, or of the part of an open one's outside that
   faces the laser, from the sine and cosine of the aspect. Accurate to about 20 u of its largest
   value. */
double lrcsi_closed_silhouette(const lrcs_shape *shape, double sine, double cosine);

/* The length of a cone, or of another shape of revolution. */
double lrcsi_closed_length(const lrcs_shape *shape);

/* The families: integral of F over the lit wall, without the 4 pi, caps or base. Lengths are about
   1 or smaller. */
lrcsi_term_integrals lrcsi_closed_cylinder(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                           const lrcsi_laser_direction *laser);
lrcsi_term_integrals lrcsi_closed_cone(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                       const lrcsi_laser_direction *laser);
lrcsi_term_integrals lrcsi_closed_sphere(const lrcs_shape *shape, const lrcs_brdf *brdf);
lrcsi_term_integrals lrcsi_closed_dome(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                       const lrcsi_laser_direction *laser);
lrcsi_term_integrals lrcsi_closed_paraboloid(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                             const lrcsi_laser_direction *laser);

#endif
