/* SPDX-License-Identifier: MIT */
/* The length of a vector, even if its square underflows. hypot is not used because its rounding
   depends on libm: these functions return the same bits on every machine. */
#ifndef LRCSI_LENGTH_H
#define LRCSI_LENGTH_H

#include <math.h>

#include "base/dd.h"

/* Relative error at most 3 u, u = 2^-53, for components of at most 2^500 whose largest exceeds
   2^-950. Below 2^-450, where squares lose bits, the components are scaled by 2^500. */
static inline double lrcsi_length(const double v[3])
{
    double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (square > 0x1p-900) {
        return sqrt(square);
    }
    const double w[3] = {v[0] * 0x1p500, v[1] * 0x1p500, v[2] * 0x1p500};
    return sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * 0x1p-500;
}

/* Divides v by its length, in the same domain: each component has a relative error of at most 4 u.
   Returns 0 if the length is 0, and leaves v unchanged. */
static inline int lrcsi_length_normalise(double v[3])
{
    double length = lrcsi_length(v);
    for (int k = 0; k < 3 && length > 0.0; k++) {
        v[k] /= length;
    }
    return length > 0.0;
}

/* The longest side of a triangle, |x| in plain doubles. */
static inline double lrcsi_length_longest_side(const double a[3], const double b[3],
                                               const double c[3])
{
    const double *const corner[4] = {a, b, c, a};
    double longest = 0.0;
    for (int k = 0; k < 3; k++) {
        double square = 0.0;
        for (int i = 0; i < 3; i++) {
            double d = corner[k + 1][i] - corner[k][i];
            square += d * d;
        }
        longest = square > longest ? square : longest;
    }
    return sqrt(longest);
}

/* The same for a vector in the plane. */
static inline double lrcsi_length_flat(double x, double y)
{
    const double v[3] = {x, y, 0};
    return lrcsi_length(v);
}

/* 1/|v|, as y (1 + half) to 2^-98, and |v|, rounded once. */
typedef struct lrcsi_inverse {
    double y, half, length;
} lrcsi_inverse;

/* Given: v = high + low, |v| in 2^-450 .. 2^100, and `plain`, |v| in plain doubles, accurate to 4
   u. |v|^2 is computed to 12 u^2: the rounding errors of products and sums are themselves summed in
   plain doubles. y = 1/|v| is accurate to 5 u; r = 1 - y^2 |v|^2, below 11 u, to 30 u^2;
   y (1 + r/2) has a remainder of 3/8 r^2, and |v| = y |v|^2 (1 + r/2). There is no square root and
   no branch, so that compilers can vectorize it. */
static inline lrcsi_inverse lrcsi_length_inverse(const double high[3], const double low[3],
                                                 double plain)
{
    lrcsi_dd xx = lrcsi_dd_two_product(high[0], high[0]);
    lrcsi_dd yy = lrcsi_dd_two_product(high[1], high[1]);
    lrcsi_dd zz = lrcsi_dd_two_product(high[2], high[2]);
    lrcsi_dd xy = lrcsi_dd_two_sum(xx.hi, yy.hi);
    lrcsi_dd xyz = lrcsi_dd_two_sum(xy.hi, zz.hi);
    double cross = 2 * ((high[0] * low[0] + high[1] * low[1]) + high[2] * low[2]);
    double low_sum = (((xx.lo + yy.lo) + zz.lo) + (xy.lo + xyz.lo)) + cross;
    double y = 1 / plain;
    lrcsi_dd length = lrcsi_dd_two_product(y, xyz.hi);
    length.lo += y * low_sum;
    lrcsi_dd one = lrcsi_dd_two_product(y, length.hi);
    double half = 0.5 * (((1 - one.hi) - one.lo) - y * length.lo);
    return (lrcsi_inverse){y, half, length.hi + (length.lo + length.hi * half)};
}

/* (high + low) / |v| as an unevaluated sum, accurate to 2^-97. */
static inline lrcsi_dd lrcsi_inverse_times(const lrcsi_inverse *inverse, double high, double low)
{
    lrcsi_dd p = lrcsi_dd_two_product(high, inverse->y);
    return lrcsi_dd_quick_sum(p.hi, p.lo + (low * inverse->y + p.hi * inverse->half));
}

#endif
