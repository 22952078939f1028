/* SPDX-License-Identifier: MIT */
/* Whether the readings show that a term of the BRDF, glint or diffuse, exists. */
#ifndef LRCSI_FIT_PRESENCE_H
#define LRCSI_FIT_PRESENCE_H

#include "analysis/fit_solve.h"

/* 1 if a term, LRCS_FIT_A or LRCS_FIT_B, is significant; 0 if noise alone would lower the sum of
   squares as much in 1 of 20 cases or more. Given: without, the best fit in which the amplitude of
   that term is 0; square, the sum of squares of the best fit with it; kept, the number of readings
   with a weight above 0; known, 1 if the weights are the inverses of the errors themselves, 0 if
   only up to a factor. Uses column[], residual[] and spare[]. */
int lrcsi_fit_presence(lrcsi_fit_data *data, int term, const lrcsi_fit_parameters *without,
                       double square, uint32_t kept, int known);

#endif
