/* SPDX-License-Identifier: MIT */
/* The two special functions that closed forms need. */
#ifndef LRCSI_SPECIAL_H
#define LRCSI_SPECIAL_H

/* exp(x^2) erfc(x) for x >= 0, infinity included: relative error at most 12 * 2^-53, given exp and
   erfc within 4 units of it. */
double lrcsi_special_erfcx(double x);

/* integral of cos^nu over a half turn, sqrt(pi) Gamma((nu+1)/2) / Gamma((nu+2)/2), for nu >= 0:
   relative error at most 48 * 2^-53. */
double lrcsi_special_cosine_power(double nu);

#endif
