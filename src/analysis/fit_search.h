/* SPDX-License-Identifier: MIT */
/* The starting points of a fit, and the readings that it uses. */
#ifndef LRCSI_FIT_SEARCH_H
#define LRCSI_FIT_SEARCH_H

#include "analysis/fit_solve.h"

#define LRCSI_FIT_STARTS 8u

/* Starting points: the local minima of the sum of |y - f| * inverse over a grid of s and m, the
   smallest first. Uses weight[], column[] and residual[]. Returns their number, 1 ..
   LRCSI_FIT_STARTS.
 */
uint32_t lrcsi_fit_search(lrcsi_fit_data *data, lrcsi_fit_parameters start[LRCSI_FIT_STARTS]);

/* Computes the expected errors of readings at a parameter vector into inverse[]. Does nothing if
   they do not depend on it, or if the fit there is negligible compared with the readings. */
void lrcsi_fit_noise(lrcsi_fit_data *data, int noise, const lrcsi_fit_parameters *parameters);

/* Minimizes from a starting point with Huber's weights, which bound the influence of single
   readings. Returns the sum of |y - f| * inverse at the minimum. */
double lrcsi_fit_huber(lrcsi_fit_data *data, int noise, lrcsi_fit_parameters *parameters);

/* Sets the weight of readings that are too far from the fit to 0, and restores that of all others.
   Returns 1 if this changed which readings are kept, else 0. */
int lrcsi_fit_trim(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters);

#endif
