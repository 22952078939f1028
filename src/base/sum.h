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
#define LRCSI_SUM_LANES 8

typedef struct lrcsi_sum_lanes {
    double high[LRCSI_SUM_LANES], low[LRCSI_SUM_LANES];
} lrcsi_sum_lanes;

static inline void lrcsi_sum_lanes_add(lrcsi_sum_lanes *restrict sum, const double *restrict x)
{
    lrcsi_sum_lanes s = *sum;
    for (int i = 0; i < LRCSI_LANES; i += LRCSI_SUM_LANES) {
        for (int k = 0; k < LRCSI_SUM_LANES; k++) {
            lrcsi_dd next = lrcsi_dd_two_sum(s.high[k], x[i + k]);
            s.high[k] = next.hi;
            s.low[k] += next.lo;
        }
    }
    *sum = s;
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
