/* SPDX-License-Identifier: MIT */
/* Arithmetic in float or double, chosen at run time. The sum, difference, product, quotient or
   square root of floats, computed in double and then rounded to float, equals the result of the
   float operation: a double has at least twice the bits of a float plus two, so that double
   rounding is innocuous (S. A. Figueroa, ACM SIGNUM Newsletter 30, 1995). This also holds for
   subnormal results: sums and products are exact in double, and a quotient of floats that is not
   the midpoint of two floats is farther from every midpoint than the rounding error of a double. */
#ifndef LRCSI_SINGLE_H
#define LRCSI_SINGLE_H

#include <float.h>

_Static_assert(FLT_RADIX == 2 && FLT_MANT_DIG == 24 && DBL_MANT_DIG == 53, "IEC 60559");

/* The result of one operation, rounded to float if `single`. */
static inline double lrcsi_single(int single, double x)
{
    return single ? (double)(float)x : x;
}

#endif
