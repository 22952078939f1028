/* SPDX-License-Identifier: MIT */
/* The smaller and the larger of two numbers, neither of them a NaN: fmin and fmax without calls
   into libm in the innermost loops. */
#ifndef LRCSI_RANGE_H
#define LRCSI_RANGE_H

#include "base/ieee.h"

static inline double lrcsi_min(double a, double b)
{
    return a < b ? a : b;
}

static inline double lrcsi_max(double a, double b)
{
    return a > b ? a : b;
}

/* x, but at least 0 and at most 1. */
static inline double lrcsi_clamp_unit(double x)
{
    return lrcsi_max(0.0, lrcsi_min(1.0, x));
}

/* Extends the range low .. high to contain x. */
static inline void lrcsi_range_extend(double x, double *low, double *high)
{
    *low = lrcsi_min(*low, x);
    *high = lrcsi_max(*high, x);
}

/* The smallest and the largest of three. */
static inline double lrcsi_min3(double a, double b, double c)
{
    return lrcsi_min(a, lrcsi_min(b, c));
}

static inline double lrcsi_max3(double a, double b, double c)
{
    return lrcsi_max(a, lrcsi_max(b, c));
}

#endif
