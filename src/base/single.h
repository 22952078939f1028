/* SPDX-License-Identifier: MIT */
/* Arithmetic in float or double, chosen as it runs. The sum, difference, product, quotient or root
   of floats, computed in double and then rounded to float, is the float operation's own result: a
   double has twice the bits of a float and two more, so that rounding twice rounds once (S. A.
   Figueroa, ACM SIGNUM Newsletter 30, 1995). So it is where the result is subnormal: sums and
   products are exact in double, and a quotient of floats that is no midpoint of two of them is
   farther from it than a double's rounding. */
#ifndef LRCSI_SINGLE_H
#define LRCSI_SINGLE_H

#include <float.h>

_Static_assert(FLT_RADIX == 2 && FLT_MANT_DIG == 24 && DBL_MANT_DIG == 53, "IEC 60559");

/* The result of one operation, rounded to float where `single`. */
static inline double lrcsi_single(int single, double x)
{
    return single ? (double)(float)x : x;
}

#endif
