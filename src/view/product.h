/* SPDX-License-Identifier: MIT */
/* Scalar and vector products of a double-double vector and an exact one, accurate to little more
   than one rounding. Inline, because every facet of a view needs four. */
#ifndef LRCSI_PRODUCT_H
#define LRCSI_PRODUCT_H

#include "base/dd.h"

/* N . d, where N is high + low. Products and sums are split into rounded values and their errors,
   and only the sum of these errors is rounded. With P = sum |N_k d_k|, at most |N| |d|, that loses
       3 u^2 P in the three terms error + low d, each at most 2 u P;
       4 u^2 P in their sum;
       2 u^2 P in the sum of the errors of the two sums;
       4 u^2 P in the sum of both.
   The error is at most N's own times |d|, 14 u^2 |N| |d|, and the last rounding, u |N . d|. */
static inline double lrcsi_product_dot(const double *high, const double *low, const double *d)
{
    lrcsi_dd x = lrcsi_dd_two_product(high[0], d[0]);
    lrcsi_dd y = lrcsi_dd_two_product(high[1], d[1]);
    lrcsi_dd z = lrcsi_dd_two_product(high[2], d[2]);
    lrcsi_dd xy = lrcsi_dd_two_sum(x.hi, y.hi);
    lrcsi_dd xyz = lrcsi_dd_two_sum(xy.hi, z.hi);
    double lost = ((x.lo + low[0] * d[0]) + (y.lo + low[1] * d[1])) + (z.lo + low[2] * d[2]);
    return xyz.hi + (lost + (xy.lo + xyz.lo));
}

/* N_i d_j - N_j d_i in the same way. With Q = |N_i d_j| + |N_j d_i|, the sum of the errors of the
   two products and of their difference loses 3 u^2 Q, the terms with low 2 u^2 Q, and their sum 3
   u^2 Q: together 8 u^2 Q, and the last rounding. The three Q of N x d are at most sqrt(2) |N| |d|
   in norm: the error of |N x d| is at most N's own times |d|, 12 u^2 |N| |d|, and 3.5 u |N x d| for
   the last roundings and that of the norm. */
static inline double lrcsi_product_cross(const double *high, const double *low, const double *d,
                                         int i, int j)
{
    lrcsi_dd p = lrcsi_dd_two_product(high[i], d[j]);
    lrcsi_dd q = lrcsi_dd_two_product(high[j], d[i]);
    lrcsi_dd s = lrcsi_dd_two_sum(p.hi, -q.hi);
    return s.hi + (((p.lo - q.lo) + s.lo) + (low[i] * d[j] - low[j] * d[i]));
}

#endif
