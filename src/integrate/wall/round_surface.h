/* SPDX-License-Identifier: MIT */
/* The true wall of a round shape (a sphere, dome or paraboloid) as a function on the view plane:
   the point above (x, y), and G, what it reflects per unit of projected area, f_r cos(theta).
   The inside of an open shape is the outside seen from the other side of the view plane: below, d
   is then the direction away from the laser, and z of the view is negated.

   In the shape's frame the wall is part of the quadric
       Q(X) = X . D X + 2 beta z + gamma = 0,  D = diag(1, 1, alpha),
   z its component along the axis, where alpha, beta, gamma are
       1, 0, -R^2 of a sphere or dome,  0, R^2 / (2 H), -R^2 of a paraboloid.
   g = D X + (0, 0, beta) is half the gradient, and points outward. Let d be the direction to the
   laser, X the wall's point above a point of the view plane, and S = g . d, so that cos(theta) =
   S / |g|. Above the point that is v away in the view plane, the wall is at X + v + t d, where
       a t^2 + 2 b t + c = 0,  a = d . D d,  b = S + v . D d,  c = 2 g . v + v . D v,
       S' = sqrt(b^2 - a c),  t = -c / (b + S'),  g' = g + D (v + t d).
   With w = |g'|^2 / S'^2 = 1 / cos^2(theta), u = w - 1 = tan^2(theta), and the BRDF's A, B, s, m,
       G = A w^(5/2) exp(-u / s^2) + B w^(-(m + 1)/2).

   Bound. Let v be a complex vector in the view plane, |v| <= e. With h the part of D d in that
   plane, and g_p that of g, |b - S| <= e |h|,  |c| <= 2 e |g_p| + e^2, |S'^2 - S^2| <= delta = 2 S
   e |h| + e^2 |h|^2 + a |c|. If delta < S^2, S' is analytic, its real part is positive, and |S' -
   S| <= S - sqrt(S^2 - delta). Then |t| <= |c| / (2 S - |b - S| - |S' - S|), and z changes by |dz|
   <= e |z_p| + |t| |z . d|, z_p the part of the axis in the view plane. |g|^2 is R^2 on a sphere,
   and R^2 + beta^2 - 2 beta z on a paraboloid: it changes by at most eta = 2 beta |dz|. So |w' - w|
   <= (eta + w delta) / (S^2 - delta) = omega. With omega <= w/2, |G| is at most A (w + omega)^(5/2)
   exp((omega - u) / s^2) + B (w - omega)^(-(m + 1)/2) = G_max. Since G is analytic there, its
   Taylor polynomial of degree n in v differs from it by at most G_max q^(n+1) / (1 - q),  q = |v| /
   e, for real v (a power series in one variable along every line). */
#ifndef LRCSI_ROUND_SURFACE_H
#define LRCSI_ROUND_SURFACE_H

#include "view/view.h"

/* Lengths are scaled. */
typedef struct lrcsi_round_surface {
    const lrcs_part *part;
    double alpha, beta, gamma;
    double side;         /* 1: the outside; -1: the inside */
    double axis[3][3];   /* the view's axes x, y, and z times side, in the shape's frame */
    double origin[3];    /* that of the view, in the shape's frame */
    double view[3];      /* the shape's origin, in the view; z times side */
    double a;            /* of the equation for t */
    double in_plane;     /* |h| */
    double position_err; /* bound on the rounding error of a point's coordinates, but for the factor
                            1 / cos(theta) along d */
} lrcsi_round_surface;

/* For a part that is a round shape, placed without distortion. side: 1 the outside, -1 the inside.
 */
lrcsi_round_surface lrcsi_round_surface_make(const lrcsi_view *view, uint32_t part, int side);

/* A point of the wall. */
typedef struct lrcsi_round_point {
    double x[2];   /* in the view plane */
    double X[3];   /* in the shape's frame */
    double g[3];   /* half the gradient */
    double s;      /* S */
    double length; /* |g| */
} lrcsi_round_point;

/* The point of the quadric above a point of the view plane at which g . d is positive. Returns 0 if
   there is none. */
int lrcsi_round_point_make(const lrcsi_round_surface *surface, const double x[2],
                           lrcsi_round_point *point);

/* The height of a point along d: z of the view times side. */
double lrcsi_round_height(const lrcsi_round_surface *surface, const lrcsi_round_point *point);

/* Both terms of G above the point of the view plane that is v from a point of the wall, a bound on
   the rounding error of their sum, and u; all infinite if that bound is too large. */
typedef struct lrcsi_round_value {
    double glint, diffuse, error, u;
} lrcsi_round_value;
lrcsi_round_value lrcsi_round_value_make(const lrcsi_round_surface *surface, const lrcs_brdf *brdf,
                                         const lrcsi_round_point *point, const double v[2]);

/* G_max for complex displacements of at most e; infinite if the conditions above do not hold. */
double lrcsi_round_bound(const lrcsi_round_surface *surface, const lrcs_brdf *brdf,
                         const lrcsi_round_point *point, double e);

#endif
