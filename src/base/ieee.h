/* SPDX-License-Identifier: MIT */
/* The arithmetic that every proof assumes: IEEE 754 doubles, each operation rounded once, to
   nearest. Compiler options that violate it are rejected at compile time if they can be detected
   there, the others at run time. */
#ifndef LRCSI_IEEE_H
#define LRCSI_IEEE_H

#include <float.h>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||     \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "bounds are proved for IEEE 754 arithmetic: not with -ffast-math or what is part of it"
#endif

_Static_assert(sizeof 1.0 == sizeof(double),
               "constants are doubles: no -fsingle-precision-constant");
_Static_assert(FLT_RADIX == 2 && DBL_MANT_DIG == 53 && DBL_MAX_EXP == 1024, "doubles are IEEE 754");
_Static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1, "double operations round to double");

/* 1 if the arithmetic is as above: doubles round to nearest, products and sums are rounded
   separately, and subnormal numbers are kept; else 0. The rounding mode and flushing to zero are
   properties of the thread. */
int lrcsi_ieee_conforms(void);

#endif
