/* SPDX-License-Identifier: MIT */
/* What an open body of revolution hides of its own inside: where the laser sees the inside of its
   true wall, if nothing else is in front of it.

   In the shape's frame let d be the direction to the laser, at the azimuth phi_d, with components
   d_rho across the axis and d_z along it, and p a point of the wall at the azimuth phi. The wall is
   part of a quadric Q(X) = X . D X + 2 beta z + gamma = 0, with the outward normal along
   g = D p + (0, 0, beta). The line p + t d meets it again at
       q = p + t d,  t = -2 (g . d) / a,  a = d . D d.
   The inside faces the laser at p where g . d < 0. Since the solid that the quadric bounds (a
   cone's on one side of its apex) is convex, the ray of p leaves it at q, if a > 0; if a <= 0 it
   never does. So the laser sees the inside at p if and only if g . d < 0, and q is beyond an
   opening. q is a linear function of p, because (g . d) is: the shadow of a rim on the inside ends
   in a plane.

   Round walls have their rim at z = 0, and z > 0 elsewhere. The laser sees their inside only if d_z
   < 0, and then where a q_z < 0: this implies that t d_z < 0, so that g . d < 0. Written in the
   angles of the normal (integrate/wall/patch_frame.h), divided by the radius R of a dome, or by
   beta / cos^2 alpha = R^2 / (2 H cos^2 alpha) of a paraboloid with the slope y = 2 H / R at its
   rim, -a q_z is
       E = P sin(nu alpha) cos(phi - phi_d) + K cos(nu alpha) + C:
       dome        nu = 1,  P = 2 d_z d_rho,  K = 2 d_z^2 - d . d,  C = 0,
       paraboloid  nu = 2,  P = d_z d_rho,
                   K = d_z^2 - a (y^2 + 1) / 4,  C = d_z^2 - a (y^2 - 1) / 4,  a = d_rho^2.
   It is visible where E > 0. The second-order terms of E, where alpha and phi
   change by complex numbers of sizes x and y, are together at most
       (nu^2 (|P| + |K|) x^2 + 2 nu |P| x y + |P| y^2) / 2 e^(nu x + y).

   Straight walls have the radius r0 at the rim that is nearer to the laser, and r1 = r0 + sigma h
   at the other end. With kappa = (radius at z = 0 - radius at z = h) / h, c = -(d_rho cos(phi -
   phi_d) + kappa d_z) and W = c^2 + d_rho^2 sin^2(phi - phi_d) = a - 2 kappa d_z c, a = d_rho^2 -
   kappa^2 d_z^2, the inside faces the laser where c > 0. The laser sees it up to the height y above
   that rim:
       y = min(h, 2 r0 c |d_z| / W),  or h if a <= 0,
   which is the fraction y (2 r0 + sigma y) / (h (r0 + r1)) of the wall at this azimuth. Both c and
   W are linear in cos(phi - phi_d), so that y reaches h at one value of it at most. */
#ifndef LRCSI_RIM_SHADOW_H
#define LRCSI_RIM_SHADOW_H

#include <lrcs/scene.h>

#include "base/constant.h"

/* The error of a normal of a patch and the direction to the laser together. */
#define LRCSI_PATCH_NORMAL_ERR (64 * LRCSI_U)

typedef struct lrcsi_rim_shadow {
    int round;                       /* 1 for a round wall */
    int lit;                         /* 0: the laser sees nothing of the inside */
    double azimuth;                  /* phi_d */
    double across;                   /* d_rho */
    double up;                       /* d_z */
    double p, k, c, nu;              /* of E */
    double err;                      /* bound on the rounding error of E */
    double kappa, r0, r1, height, a; /* of straight walls */
} lrcsi_rim_shadow;

/* For a part that is an open shape, and the direction to the laser in the body frame. */
lrcsi_rim_shadow lrcsi_rim_shadow_make(const lrcs_part *part, const double unit[3]);

/* E on a round wall and its derivatives with respect to alpha and phi. */
typedef struct lrcsi_rim_value {
    double value, slope[2];
} lrcsi_rim_value;
lrcsi_rim_value lrcsi_rim_shadow_at(const lrcsi_rim_shadow *shadow, double alpha, double phi);

/* The bound on the second-order terms; and a bound on the change of a derivative of E, with respect
   to alpha (0) or phi (1), for real changes of at most x and y. */
double lrcsi_rim_shadow_second(const lrcsi_rim_shadow *shadow, double x, double y);
double lrcsi_rim_shadow_slope_change(const lrcsi_rim_shadow *shadow, int variable, double x,
                                     double y);

/* The visible fraction of a straight wall at an azimuth where it faces the laser, with a bound on
   its rounding error; and an upper bound of its size for complex changes of the azimuth of at most
   b, given e^b, where y is not h; infinite if none is known. */
typedef struct lrcsi_rim_fraction {
    double value, err;
} lrcsi_rim_fraction;
lrcsi_rim_fraction lrcsi_rim_shadow_fraction(const lrcsi_rim_shadow *shadow, double phi);
double lrcsi_rim_shadow_fraction_bound(const lrcsi_rim_shadow *shadow, double phi, double exp_b);

/* The azimuths in the interior of an interval, shorter than pi, at which y reaches h. Returns how
   many there are, in ascending order. */
int lrcsi_rim_shadow_kinks(const lrcsi_rim_shadow *shadow, double from, double to, double kink[2]);

#endif
