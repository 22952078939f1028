/* SPDX-License-Identifier: MIT */
/* The bits of doubles: selections without comparisons of doubles, which would keep gcc from
   handling several numbers at once. */
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

/* All ones where the sign of x is minus, else zero. */
static inline uint64_t lrcsi_bits_negative(double x)
{
    return ~((lrcsi_bits_of(x) >> 63) - 1);
}

/* x, or 0 where the mask is zero. */
static inline double lrcsi_bits_masked(double x, uint64_t mask)
{
    return lrcsi_bits_double(lrcsi_bits_of(x) & mask);
}

#endif
