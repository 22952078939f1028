/* SPDX-License-Identifier: MIT */
/* Which readings a fit uses, how large their errors are taken to be, and a minimization that bounds
   the influence of single readings. */
#ifndef LRCSI_FIT_ROBUST_H
#define LRCSI_FIT_ROBUST_H

#include "analysis/fit_solve.h"

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
