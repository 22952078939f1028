/* SPDX-License-Identifier: MIT */
/* How far a fit determines its parameters. */
#ifndef LRCSI_FIT_PROFILE_H
#define LRCSI_FIT_PROFILE_H

#include "optics/fit_solve.h"

/* The standard errors of a fit in its coordinates and their correlations, from the matrix of its
   columns; HUGE_VAL and 0 for a coordinate that does not enter, or only as others do.
   Given: noise, the standard deviation of a weighted residual. */
typedef struct lrcsi_fit_spread {
    double error[LRCS_FIT_PARAMETERS];
    double correlation[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS];
} lrcsi_fit_spread;
lrcsi_fit_spread lrcsi_fit_spread_make(const lrcsi_fit_data *data, const lrcsi_fit_spot *best,
                                       double noise);

/* The coordinates at which the sum of squares, least over the others, has grown by `rise`.
   Given: best, a local minimum; spread at it.
   Returned: limit[p][0] below and [p][1] above; -HUGE_VAL, HUGE_VAL where it grows by less all the
   way to the end of the search (0 is the end for A, B and log(1 + m), and is returned as 0).
   Status: 1; or 0 where a lower sum was met on the way: that spot is then in *best. */
int lrcsi_fit_profile(const lrcsi_fit_data *data, const lrcsi_fit_spread *spread, double rise,
                      lrcsi_fit_spot *best, double limit[LRCS_FIT_PARAMETERS][2]);

#endif
