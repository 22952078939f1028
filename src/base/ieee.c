/* SPDX-License-Identifier: MIT */
/* Tests of the arithmetic: they decide whether the proofs hold in this build and this thread. */
#include "base/ieee.h"

/* Volatile, so that the compiler, whose arithmetic may differ, evaluates nothing of this. */
int lrcsi_ieee_conforms(void)
{
    volatile double one = 1;
    volatile double ulp = DBL_EPSILON;
    volatile double least = DBL_MIN;
    double x = one + ulp;
    double square = x * x;
    volatile double rounded = square;
    double lost = x * x - rounded; /* 2^-104 if the two are fused */
    double even = one + 0.5 * ulp; /* ties: down to 1, and up to 1 + 2 ulp */
    double odd = x + 0.5 * ulp;
    double below = least * 0.5;
    volatile double kept = below;
    return lost == 0 && even == 1 && odd == 1 + 2 * DBL_EPSILON && kept + kept == DBL_MIN;
}
