/* SPDX-License-Identifier: MIT */
/* Double-double arithmetic (Dekker 1971, Knuth TAOCP 2): an unevaluated sum hi + lo with
   |lo| <= ulp(hi)/2. The error bound of each operation is stated beside it, u = 2^-53. No fma is
   used, so results have the same bits on every machine. The functions are inline because visibility
   and normals consist mostly of them. */
#ifndef LRCSI_DD_H
#define LRCSI_DD_H

#include "base/ieee.h"

typedef struct lrcsi_dd {
    double hi, lo;
} lrcsi_dd;

/* a + b exactly. */
static inline lrcsi_dd lrcsi_dd_two_sum(double a, double b)
{
    double s = a + b;
    double t = s - a;
    return (lrcsi_dd){s, (a - (s - t)) + (b - t)};
}

/* a + b exactly, for |a| >= |b| or a = 0. */
static inline lrcsi_dd lrcsi_dd_quick_sum(double a, double b)
{
    double s = a + b;
    return (lrcsi_dd){s, b - (s - a)};
}

/* a * b exactly, barring overflow (|a|, |b| < 2^996) and underflow. Veltkamp's split. */
static inline lrcsi_dd lrcsi_dd_two_product(double a, double b)
{
    double p = a * b;
    double ca = 134217729.0 * a;
    double cb = 134217729.0 * b;
    double ah = ca - (ca - a);
    double bh = cb - (cb - b);
    double al = a - ah;
    double bl = b - bh;
    return (lrcsi_dd){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

/* Relative error at most 3 u^2 (Joldes, Muller, Popescu 2017, AccurateDWPlusDW). */
static inline lrcsi_dd lrcsi_dd_add(lrcsi_dd a, lrcsi_dd b)
{
    lrcsi_dd s = lrcsi_dd_two_sum(a.hi, b.hi);
    lrcsi_dd t = lrcsi_dd_two_sum(a.lo, b.lo);
    lrcsi_dd v = lrcsi_dd_quick_sum(s.hi, s.lo + t.hi);
    return lrcsi_dd_quick_sum(v.hi, t.lo + v.lo);
}

static inline lrcsi_dd lrcsi_dd_negate(lrcsi_dd a)
{
    return (lrcsi_dd){-a.hi, -a.lo};
}

static inline lrcsi_dd lrcsi_dd_sub(lrcsi_dd a, lrcsi_dd b)
{
    return lrcsi_dd_add(a, lrcsi_dd_negate(b));
}

/* Relative error at most 7 u^2 (the same source, DWTimesDW1). */
static inline lrcsi_dd lrcsi_dd_mul(lrcsi_dd a, lrcsi_dd b)
{
    lrcsi_dd p = lrcsi_dd_two_product(a.hi, b.hi);
    return lrcsi_dd_quick_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* The same for a plain double factor. */
static inline lrcsi_dd lrcsi_dd_scale(lrcsi_dd a, double b)
{
    lrcsi_dd p = lrcsi_dd_two_product(a.hi, b);
    return lrcsi_dd_quick_sum(p.hi, p.lo + a.lo * b);
}

/* a / b: relative error at most 20 u^2 (the same source, DWDivDW2: 15 u^2 + 56 u^3). */
static inline lrcsi_dd lrcsi_dd_div(lrcsi_dd a, lrcsi_dd b)
{
    double q = a.hi / b.hi;
    lrcsi_dd remainder = lrcsi_dd_sub(a, lrcsi_dd_scale(b, q));
    return lrcsi_dd_quick_sum(q, remainder.hi / b.hi);
}

static inline double lrcsi_dd_value(lrcsi_dd a)
{
    return a.hi + a.lo;
}

#endif
