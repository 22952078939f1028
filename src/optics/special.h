/* SPDX-License-Identifier: MIT */
/* The special functions that closed forms and statistics need. */
#ifndef LRCSI_SPECIAL_H
#define LRCSI_SPECIAL_H

#include <stdint.h>

/* exp(x^2) erfc(x) for x >= 0, infinity included: relative error at most 12 * 2^-53, given exp and
   erfc within 4 units of it. */
double lrcsi_special_erfcx(double x);

/* integral of cos^nu over a half turn, sqrt(pi) Gamma((nu+1)/2) / Gamma((nu+2)/2), for nu >= 0:
   relative error at most 48 * 2^-53. */
double lrcsi_special_cosine_power(double nu);

/* The two-sided 95 % quantile t of Student's distribution with `freedom` degrees of freedom
   (|t| is exceeded in 1 of 20 cases): relative error at most 1e-5; infinite for 0. UINT32_MAX gives
   that of the normal distribution. */
double lrcsi_special_student(uint32_t freedom);

#endif
