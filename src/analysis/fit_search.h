/* SPDX-License-Identifier: MIT */
/* The starting points of a fit. */
#ifndef LRCSI_FIT_SEARCH_H
#define LRCSI_FIT_SEARCH_H

#include "analysis/fit_solve.h"

#define LRCSI_FIT_STARTS 8u

/* Starting points: the local minima of the sum of |y - f| * inverse over a grid of s and m, the
   smallest first. Uses weight[], column[] and residual[]. Returns their number: from 1 to
   LRCSI_FIT_STARTS. */
uint32_t lrcsi_fit_search(lrcsi_fit_data *data, lrcsi_fit_parameters start[LRCSI_FIT_STARTS]);

#endif
