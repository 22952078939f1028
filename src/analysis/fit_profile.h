/* SPDX-License-Identifier: MIT */
/* How far a fit determines its parameters. */
#ifndef LRCSI_FIT_PROFILE_H
#define LRCSI_FIT_PROFILE_H

#include "analysis/fit_solve.h"

/* The standard errors of a fit in its coordinates and their correlations, from the matrix of its
   columns; HUGE_VAL and 0 for a coordinate that does not enter, or only as others do.
   Given: fixed, the coordinates (bits 1 << index) that are not the fit's; noise, the standard
   deviation of a weighted residual. */
typedef struct lrcsi_fit_spread {
    double error[LRCS_FIT_PARAMETERS];
    double correlation[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS];
} lrcsi_fit_spread;
lrcsi_fit_spread lrcsi_fit_spread_make(const lrcsi_fit_data *data, unsigned fixed,
                                       const lrcsi_fit_spot *best, double noise);

/* The coordinates at which the sum of squares, least over the others, exceeds that at `best` by
   `rise`.
   Given: best, the least that is reported; whole, the least of all, which is that or lower; spread
   at best.
   Returned: limit[p][0] below and [p][1] above; -HUGE_VAL, HUGE_VAL where the sum exceeds it
   nowhere to the end of the search (but for A, B and log(1 + m) that end is 0 below, and 0 is
   returned).
   Status: 1; or 0 where a sum below `whole` was met on the way: that spot is then in *whole. */
int lrcsi_fit_profile(const lrcsi_fit_data *data, const lrcsi_fit_spread *spread, double rise,
                      const lrcsi_fit_spot *best, lrcsi_fit_spot *whole,
                      double limit[LRCS_FIT_PARAMETERS][2]);

#endif
