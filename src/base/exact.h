/* SPDX-License-Identifier: MIT */
/* Signs of determinants, exact: a floating-point filter with a proved error bound first, then
   expansion arithmetic. Right for every finite input whose products neither overflow nor
   underflow (coordinates between 2^-300 and 2^300 in magnitude, or zero); the engine scales its
   scene by a power of two to be far inside. */
#ifndef LRCSI_EXACT_H
#define LRCSI_EXACT_H

#include "base/dd.h"

/* Sign (-1, 0, 1) of det(b - a, c - a, d): seen with d pointing at the eye, positive where
   a, b, c turn counter-clockwise. Exactly the sign of (b-a) x (c-a) . d. */
int lrcsi_exact_turn(const double a[3], const double b[3], const double c[3], const double d[3]);

/* Sign of det(b - a, c - a, p - a): positive where p lies on the side to which the normal
   (b-a) x (c-a) points, 0 on the plane. */
int lrcsi_exact_side(const double a[3], const double b[3], const double c[3], const double p[3]);

/* 1 where a, b, c are exactly collinear or coincide (a facet of no area), else 0. */
int lrcsi_exact_collinear(const double a[3], const double b[3], const double c[3]);

/* (b - a) x (c - a) in double-double, each component within 100 u^2 of itself, u = 2^-53: for
   slivers, whose normals drown in rounding. */
void lrcsi_exact_normal(const double a[3], const double b[3], const double c[3], double high[3],
                        double low[3]);

/* det(b - a, c - a, p - a), of which lrcsi_exact_side is the sign, within 100 u^2 of itself. */
lrcsi_dd lrcsi_exact_height(const double a[3], const double b[3], const double c[3],
                            const double p[3]);

/* (b - a) x (c - a) . d, within 2 u of itself: for facets all but edge-on. */
double lrcsi_exact_dot(const double a[3], const double b[3], const double c[3], const double d[3]);

#endif
