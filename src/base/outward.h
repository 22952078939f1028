/* SPDX-License-Identifier: MIT */
/* Factors that round bounds outward. A bound is computed from given numbers by differences of two
   of them, and from what is then not negative by sums, products, quotients and square roots. Each
   operation may round it down: multiplied by one of these factors, the bound is at least what exact
   arithmetic gives.

   An exact result is at most (1 + u) times the rounded one. So after m roundings in sequence the
   exact bound is at most (1 + u)^m times the computed one, b, and the rounded product of b with a
   factor is at least factor b / (1 + u). 1 + n u is at least (1 + u)^(m + 1) for m <= n - 2, n <=
   2^26. For n = 2 one rounding is covered as well: 2 u b is at least the distance from b to the
   next larger number, and the product is not below that. */
#ifndef LRCSI_OUTWARD_H
#define LRCSI_OUTWARD_H

#include "base/constant.h"

/* For n - 2 roundings; n even, so that the factor itself is exact. */
#define LRCSI_OUTWARD(n) (1 + (n)*LRCSI_U)

/* For 2^12 roundings: sums of many terms. */
#define LRCSI_OUTWARD_SUM (1 + 0x1p-40)

/* For 2^22 roundings, or factors that are off by up to 4e-10: products with computed sines, say. */
#define LRCSI_OUTWARD_NANO (1 + 1e-9)

/* For 2^32 roundings, or factors that are off by up to 4e-7: where a bound is generous anyway, so
   that errors of second order need not be followed. */
#define LRCSI_OUTWARD_MICRO (1 + 1e-6)

/* More than the square roots of 2 and 3. */
#define LRCSI_ROOT_2_OUTWARD 1.4143
#define LRCSI_ROOT_3_OUTWARD 1.7321

/* For the rounding of a positive number to float, by at most 2^-24 of it. */
#define LRCSI_OUTWARD_FLOAT (1 + 0x1p-22)

#endif
