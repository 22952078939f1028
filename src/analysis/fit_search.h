/* SPDX-License-Identifier: MIT */
/* Where a fit starts, and which readings it stands on. */
#ifndef LRCSI_FIT_SEARCH_H
#define LRCSI_FIT_SEARCH_H

#include "analysis/fit_solve.h"

#define LRCSI_FIT_STARTS 8u

/* Starting points: the local minima of the sum of |y - f| * inverse over a grid of s and m, the
   least first. Uses weight[], column[] and rest[]. Returns how many, 1 .. LRCSI_FIT_STARTS. */
uint32_t lrcsi_fit_search(const lrcsi_fit_data *data, lrcsi_fit_spot start[LRCSI_FIT_STARTS]);

/* The errors that readings are expected to have at a spot, into inverse[]; nothing where they do
   not depend on it, or the spot is nothing to the readings. */
void lrcsi_fit_noise(const lrcsi_fit_data *data, int noise, const lrcsi_fit_spot *spot);

/* Descends from a start with Huber's weights, so that single readings pull with a bounded force.
   Returns the sum of |y - f| * inverse there. */
double lrcsi_fit_soften(const lrcsi_fit_data *data, int noise, lrcsi_fit_spot *spot);

/* Gives the readings that lie too far from the fit at a spot no weight, and all others theirs.
   Returns whether that changed which are kept. */
int lrcsi_fit_trim(const lrcsi_fit_data *data, const lrcsi_fit_spot *spot);

#endif
