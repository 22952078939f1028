/* SPDX-License-Identifier: MIT */
/* Bit patterns of doubles: branch-free selections. Comparisons of doubles would prevent gcc from
   vectorizing the loops that use them. */
#ifndef LRCSI_BITS_H
#define LRCSI_BITS_H

#include <stdint.h>
#include <string.h>

static inline uint64_t lrcsi_bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double lrcsi_bits_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* All ones if the sign bit of x is set, else zero. */
static inline uint64_t lrcsi_bits_negative(double x)
{
    return ~((lrcsi_bits_of(x) >> 63) - 1);
}

/* x if the mask is all ones, 0 if it is zero. */
static inline double lrcsi_bits_masked(double x, uint64_t mask)
{
    return lrcsi_bits_double(lrcsi_bits_of(x) & mask);
}

#endif
