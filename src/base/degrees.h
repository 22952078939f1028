/* SPDX-License-Identifier: MIT */
/* Sine and cosine of an angle in degrees, which is taken as exact: 90 is exactly 90. Uses only
   + - * / and exact remainders: the same bits on every machine. */
#ifndef LRCSI_DEGREES_H
#define LRCSI_DEGREES_H

#include "base/dd.h"

/* Given: deg, finite.
   Returned: each within 0.51 ulp (or 2^-1074); exactly 0, 0.5 and +-1 if these are the exact
   values; zeros are +0. */
void lrcsi_degrees_sincos(double deg, double *sine, double *cosine);

/* The same for the exact sum deg + addend, |deg| + |addend| < 2^1000, in double-double: relative
   error at most 2^-96 each, so that sums of angles lose no accuracy near a multiple of 90. A sine
   or cosine below 2^-960 has a relative error up to 2^-53. */
void lrcsi_degrees_sincos_dd(double deg, double addend, lrcsi_dd *sine, lrcsi_dd *cosine);

/* Of deg, in plain doubles, in a tenth of the time: absolute error at most 2^-50 each; zeros have
   either sign. */
void lrcsi_degrees_sincos_plain(double deg, double *sine, double *cosine);

#endif
