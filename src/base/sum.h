/* SPDX-License-Identifier: MIT */
/* Compensated summation in a fixed order (Neumaier 1974): the error of the total is at most
   u |total| + 3 n^2 u^2 sum |x_i|, u = 2^-53, for n terms (n u < 1/4). */
#ifndef LRCSI_SUM_H
#define LRCSI_SUM_H

#include <math.h>

#include "base/dd.h"
#include "base/elementary.h"

typedef struct lrcsi_sum {
    double high, low;
} lrcsi_sum;

static inline void lrcsi_sum_add(lrcsi_sum *sum, double x)
{
    double total = sum->high + x;
    double lost = fabs(sum->high) >= fabs(x) ? (sum->high - total) + x : (x - total) + sum->high;
    sum->high = total;
    sum->low += lost;
}

static inline double lrcsi_sum_value(const lrcsi_sum *sum)
{
    return sum->high + sum->low;
}

/* The same in lanes, eight sums side by side: the same bits however many of them a machine adds at
   once. The error is as above. */
#define LRCSI_SUM_LANES (LRCSI_LANES / 4)

typedef struct lrcsi_sum_lanes {
    double high[LRCSI_SUM_LANES], low[LRCSI_SUM_LANES];
} lrcsi_sum_lanes;

/* Adds x[LRCSI_LANES], of which lane k takes every LRCSI_SUM_LANES-th from x[k] on. A lane takes
   all of its terms at once, so that its sum can stay in registers. */
static inline void lrcsi_sum_lanes_add(lrcsi_sum_lanes *restrict sum, const double *restrict x)
{
    for (int k = 0; k < LRCSI_SUM_LANES; k++) {
        lrcsi_dd a = lrcsi_dd_two_sum(sum->high[k], x[k]);
        lrcsi_dd b = lrcsi_dd_two_sum(a.hi, x[k + LRCSI_SUM_LANES]);
        lrcsi_dd c = lrcsi_dd_two_sum(b.hi, x[k + 2 * LRCSI_SUM_LANES]);
        lrcsi_dd d = lrcsi_dd_two_sum(c.hi, x[k + 3 * LRCSI_SUM_LANES]);
        sum->high[k] = d.hi;
        sum->low[k] = (((sum->low[k] + a.lo) + b.lo) + c.lo) + d.lo;
    }
}

/* The same without compensation, for bounds. */
static inline void lrcsi_lanes_add(double *restrict sum, const double *restrict x)
{
    for (int k = 0; k < LRCSI_SUM_LANES; k++) {
        sum[k] = (((sum[k] + x[k]) + x[k + LRCSI_SUM_LANES]) + x[k + 2 * LRCSI_SUM_LANES]) +
                 x[k + 3 * LRCSI_SUM_LANES];
    }
}

/* Adds them all to *sum. */
static inline void lrcsi_sum_lanes_join(lrcsi_sum *sum, const lrcsi_sum_lanes *lanes)
{
    for (int k = 0; k < LRCSI_SUM_LANES; k++) {
        lrcsi_sum_add(sum, lanes->high[k]);
        lrcsi_sum_add(sum, lanes->low[k]);
    }
}

#endif
