/* SPDX-License-Identifier: MIT */
/* Quadratic functions over 0 .. 1, given by their values at 0, 1/2 and 1. */
#ifndef LRCSI_PARABOLA_H
#define LRCSI_PARABOLA_H

/* An upper bound of the integral of the positive part of sign times the function plus a shift; sign
   is 1 or -1. */
double lrcsi_parabola_positive(const double value[3], double sign, double shift);

#endif
