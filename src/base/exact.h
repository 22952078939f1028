/* SPDX-License-Identifier: MIT */
/* Exact signs of determinants: a floating-point filter with a proved error bound first, then
   expansion arithmetic. Correct for every finite input whose products neither overflow nor
   underflow (coordinates zero, or between 2^-300 and 2^333, which exceeds 1e100); the engine scales
   its scene by a power of two so that coordinates are far inside this range. */
#ifndef LRCSI_EXACT_H
#define LRCSI_EXACT_H

#include "base/dd.h"

/* Sign (-1, 0, 1) of det(b - a, c - a, d), which is (b-a) x (c-a) . d: positive if a, b, c are in
   counter-clockwise order as seen with d pointing at the viewer. Exact. */
int lrcsi_exact_orient(const double a[3], const double b[3], const double c[3], const double d[3]);

/* Sign of det(b - a, c - a, p - a): positive if p lies on the side to which the normal
   (b-a) x (c-a) points, 0 if p lies in the plane. */
int lrcsi_exact_side(const double a[3], const double b[3], const double c[3], const double p[3]);

/* 1 if a, b, c are exactly collinear or coincide (a facet of zero area), else 0. */
int lrcsi_exact_collinear(const double a[3], const double b[3], const double c[3]);

/* (b - a) x (c - a) in double-double, relative error of each component at most 100 u^2, u = 2^-53:
   for slivers, whose normals in plain doubles can consist of rounding errors only. */
void lrcsi_exact_normal(const double a[3], const double b[3], const double c[3], double high[3],
                        double low[3]);

/* det(b - a, c - a, p - a), whose sign is lrcsi_exact_side; relative error at most 100 u^2. */
lrcsi_dd lrcsi_exact_height(const double a[3], const double b[3], const double c[3],
                            const double p[3]);

/* (b - a) x (c - a) . d, relative error at most 2 u: for facets that are nearly edge-on. */
double lrcsi_exact_dot(const double a[3], const double b[3], const double c[3], const double d[3]);

#endif
