/* SPDX-License-Identifier: MIT */
/* How well a fit determines its parameters: standard errors and profile limits. */
#ifndef LRCSI_FIT_PROFILE_H
#define LRCSI_FIT_PROFILE_H

#include "analysis/fit_solve.h"

/* The standard errors of a fit in its coordinates and their correlations, from the matrix of its
   columns; HUGE_VAL and 0 for a coordinate whose column is zero or linearly dependent on others.
   Given: fixed, the coordinates (bits 1 << index) that are not the fit's; noise, the standard
   deviation of a weighted residual. */
typedef struct lrcsi_fit_spread {
    double error[LRCS_FIT_PARAMETERS];
    double correlation[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS];
} lrcsi_fit_spread;
lrcsi_fit_spread lrcsi_fit_spread_make(lrcsi_fit_data *data, unsigned fixed,
                                       const lrcsi_fit_parameters *best, double noise);

/* Profile limits: the values of each coordinate at which the sum of squares, minimized over the
   other coordinates, exceeds that at `best` by `rise`.
   Given: best, the minimum that is reported; full, the minimum over all coordinates, which is at
   most that; spread at best.
   Returned: limit[p][0] below and [p][1] above; -HUGE_VAL or HUGE_VAL if the sum does not exceed it
   anywhere in the search range (for A, B and log(1 + m) the range ends at 0 below, and 0 is
   returned).
   Status: 1; or 0 if a sum below `full` was found: *full is then that parameter vector. */
int lrcsi_fit_profile(lrcsi_fit_data *data, const lrcsi_fit_spread *spread, double rise,
                      const lrcsi_fit_parameters *best, lrcsi_fit_parameters *full,
                      double limit[LRCS_FIT_PARAMETERS][2]);

#endif
