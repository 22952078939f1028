/* SPDX-License-Identifier: MIT */
/* f_r cos^2, the integrand of Eq. 2 per unit of surface, with separate glint and diffuse terms,
   from tan^2(theta); and bounds of its deviation over a cone of normals. */
#ifndef LRCSI_REFLECT_H
#define LRCSI_REFLECT_H

#include <lrcs/brdf.h>
#include <lrcs/shape.h>

typedef struct lrcsi_reflection {
    double glint, diffuse; /* f_r cos^2, 1/sr */
    double error;          /* bound on the absolute error of glint + diffuse, from rounding here and
                              from the relative error of the given tan2 */
} lrcsi_reflection;

/* Given: tan2 = tan^2(theta) >= 0 (infinity allowed: edge-on, both terms 0) with relative error
   at most tan2_err. Both terms are finite for every brdf in its domain; if the glint
   exceeds the largest double it is that double, and error is infinite.
   Notes: 1. The only libm function called is sqrt: the same bits on every machine.
   2. Cost: one exponential, and one power except for m = 0, 1/2, 1 and 2; a term of amplitude 0
   costs nothing. */
lrcsi_reflection lrcsi_reflect(const lrcs_brdf *brdf, double tan2, double tan2_err);

/* The root of the largest value of a glint of amplitude 1, w^2 exp(-u / s^2) with w = 1 + u, over
   all u >= 0: its peak is at w = 2 s^2 if that exceeds 1, else at u = 0. */
double lrcsi_reflect_glint_root(double s);

/* Bound on the flat-facet error of a curved patch, per unit of facet area:
     | integral over the patch of F dA / (facet area)  -  F(facet normal) |,
   F(n) = f_r cos^2 if n . s_hat > 0, else 0 (the 4 pi is the caller's).
   Given: brdf; the facet normal's cos and tan^2 to s_hat (cos <= 0: it faces away, though part of
   the patch may not); the bounds of the patch. Proved; 0 for a flat patch (all four numbers 0). */
double lrcsi_reflect_deviation(const lrcs_brdf *brdf, double cos_theta, double tan2,
                               const lrcs_patch_bounds *bounds);

/* The variation of F over a patch, for patches that are only partly visible. All fields except
   `value` are upper bounds. */
typedef struct lrcsi_deviation {
    double whole;  /* lrcsi_reflect_deviation; also if F counts on both sides, by |cos(theta)| */
    double point;  /* |F - F(facet normal)| at any point of the patch */
    double region; /* |integral of F - F(facet normal) over any region of the patch| / facet area */
    double value;  /* F(facet normal) */
    double value_max; /* F at any point of the patch */
    double second; /* the second derivative of F at any normal of the patch, or between them, along
                      any great circle */
} lrcsi_deviation;

/* The same for any patch. For a flat one `whole`, `point` and `region` may be of the
   size of rounding errors instead of 0. */
lrcsi_deviation lrcsi_deviation_make(const lrcs_brdf *brdf, double cos_theta, double tan2,
                                     const lrcs_patch_bounds *bounds);

/* Proved upper bounds of the two terms of f_r cos (not cos^2) over all normals within `turn` of a
   normal at angle theta to s_hat, both in rad, theta <= pi. `error` is 0.
   Notes: 1. Infinite only if f_r itself is near the largest double. */
lrcsi_reflection lrcsi_reflect_bound(const lrcs_brdf *brdf, double theta, double turn);

#endif
