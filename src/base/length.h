/* SPDX-License-Identifier: MIT */
/* The length of a vector, also where its square underflows. Not hypot, which rounds as each libm
   likes: these are the same bits on every machine. */
#ifndef LRCSI_LENGTH_H
#define LRCSI_LENGTH_H

#include <math.h>

/* Relative error at most 3 u, u = 2^-53, for components at most 2^500 whose largest is above
   2^-950. Below 2^-450, where squares lose bits, it works on them times 2^500. */
static inline double lrcsi_length(const double v[3])
{
    double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (square > 0x1p-900) {
        return sqrt(square);
    }
    const double w[3] = {v[0] * 0x1p500, v[1] * 0x1p500, v[2] * 0x1p500};
    return sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * 0x1p-500;
}

/* The same of a vector in the plane. */
static inline double lrcsi_length_flat(double x, double y)
{
    const double v[3] = {x, y, 0};
    return lrcsi_length(v);
}

#endif
