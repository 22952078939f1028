/* SPDX-License-Identifier: MIT */
/* Exponential and logarithm from + - * / alone: the same bits on every machine and at every level
   of optimisation, with proved errors. u = 2^-53. The forms for lanes are free of branches, so that
   compilers handle several at once; their trip count is a constant for that. */
#ifndef LRCSI_ELEMENTARY_H
#define LRCSI_ELEMENTARY_H

#include "base/dd.h"

/* Relative errors, in units of u. Proofs beside the code. */
#define LRCSI_EXP_ERROR       2.0 /* lrcsi_exp down to 2^-1000, lrcsi_exp_lanes */
#define LRCSI_EXP_DD_ERROR    3.0 /* lrcsi_exp_dd down to 2^-1000 */
#define LRCSI_LOG_ERROR       0.15
#define LRCSI_LOG1P_ERROR     1.15 /* and at most LRCSI_LOG_ERROR beside u^2, absolute */
#define LRCSI_LOG_LANES_ERROR 6.0

/* e^x for any x but a NaN: 0 below -746, infinity from 709.79 on. Below 2^-1000 it is good to 5 u
   and 2^-1073. */
double lrcsi_exp(double x);

/* e^(x.hi + x.lo). */
double lrcsi_exp_dd(lrcsi_dd x);

/* log(x) for 0 < x, finite. */
lrcsi_dd lrcsi_log(double x);

/* log(1 + u) for u >= 0, finite. */
lrcsi_dd lrcsi_log1p(double u);

/* e^(y log) for y >= 0 or below: 0 and infinity where it leaves the doubles. Relative error, in
   units of u: LRCSI_EXP_DD_ERROR, and that of the logarithm times |y log|. */
double lrcsi_power(lrcsi_dd log, double y);

/* How many numbers the forms for lanes take. */
#define LRCSI_LANES 32

/* out = e^x for |x| <= 700. */
void lrcsi_exp_lanes(const double x[LRCSI_LANES], double out[restrict LRCSI_LANES]);

/* out = log(x) for 2^-1000 <= x <= 2^1000. */
void lrcsi_log_lanes(const double x[LRCSI_LANES], double out[restrict LRCSI_LANES]);

#endif
