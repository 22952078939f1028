/* SPDX-License-Identifier: MIT */
/* Whether readings show a part of the BRDF at all. */
#ifndef LRCSI_FIT_PRESENCE_H
#define LRCSI_FIT_PRESENCE_H

#include "analysis/fit_solve.h"

/* Does a part, LRCS_FIT_A or LRCS_FIT_B, stand out of the noise? 1, or 0 where noise alone would
   lower the sum of squares as much in 1 of 20 cases or more.
   Given: without, the best fit whose amplitude of that part is 0; square, the sum of the best fit
   with it; kept, how many readings have weight; known: the weights are the inverses of the errors
   themselves, not up to a factor. Uses column[], rest[] and spare[]. */
int lrcsi_fit_presence(const lrcsi_fit_data *data, int part, const lrcsi_fit_spot *without,
                       double square, uint32_t kept, int known);

#endif
