/* SPDX-License-Identifier: MIT */
/* Compensated summation in a fixed order (Neumaier 1974): the error of the total is at most
   u |total| + 3 n^2 u^2 sum |x_i|, u = 2^-53, for n terms (n u < 1/4). */
#ifndef LRCSI_SUM_H
#define LRCSI_SUM_H

#include <math.h>

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

#endif
