/* SPDX-License-Identifier: MIT */
/* Exponential and logarithm, computed with + - * / only: the same bits on every machine and at
   every optimisation level, with proved error bounds. u = 2^-53. The functions for several lanes
   have no branches and a constant trip count, so that compilers can vectorize them. */
#ifndef LRCSI_ELEMENTARY_H
#define LRCSI_ELEMENTARY_H

#include "base/dd.h"

/* Relative errors, in units of u. Proofs beside the code. */
#define LRCSI_EXP_ERROR       2.0 /* lrcsi_exp down to 2^-1000, lrcsi_exp_lanes */
#define LRCSI_EXP_DD_ERROR    3.0 /* lrcsi_exp_dd down to 2^-1000 */
#define LRCSI_LOG_ERROR       0.15
#define LRCSI_LOG1P_ERROR     1.15 /* and at most LRCSI_LOG_ERROR plus an absolute u^2 */
#define LRCSI_LOG_LANES_ERROR 6.0

/* e^x for every x except NaN: 0 below -746, infinity from 709.79 on. Results below 2^-1000 are
   accurate to 5 u relative plus 2^-1073 absolute. */
double lrcsi_exp(double x);

/* e^(x.hi + x.lo). */
double lrcsi_exp_dd(lrcsi_dd x);

/* log(x) for 0 < x, finite. */
lrcsi_dd lrcsi_log(double x);

/* log(1 + u) for u >= 0, finite. */
lrcsi_dd lrcsi_log1p(double u);

/* e^(y log) for y of either sign; 0 on underflow, infinity on overflow. Relative error, in units of
   u: LRCSI_EXP_DD_ERROR, plus that of the logarithm times |y log|. */
double lrcsi_power(lrcsi_dd log, double y);

/* The number of lanes: the array length of the functions below. */
#define LRCSI_LANES 32

/* out = e^x for |x| <= 700. */
void lrcsi_exp_lanes(const double x[LRCSI_LANES], double out[restrict LRCSI_LANES]);

/* out = log(x) for 2^-1000 <= x <= 2^1000. */
void lrcsi_log_lanes(const double x[LRCSI_LANES], double out[restrict LRCSI_LANES]);

#endif
