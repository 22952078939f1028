/* SPDX-License-Identifier: MIT */
/* The facets that may hide one facet, f, and the segments along which they begin or cease to hide
   it (visibility/cells_single.c). */
#ifndef LRCSI_CELLS_SINGLE_CANDIDATE_H
#define LRCSI_CELLS_SINGLE_CANDIDATE_H

#include "visibility/cells_single_state.h"

/* Lists the candidates: facets whose boxes overlap that of f and that are not entirely behind it or
   beyond one of its sides. 0 if the meter is spent. */
int lrcsi_cells_single_candidates(lrcsi_cells_single *a);

/* The depth order, a lrcsi_candidate_order, of a candidate whose interior does not intersect that
 * of f.
 */
int lrcsi_cells_single_order(const lrcsi_cells_single *a, uint32_t other);

/* Adds the segments to the division, and finds the depth order of the facets that meet f. 0 if
   there is no room, or the meter is spent. */
int lrcsi_cells_single_segments(lrcsi_cells_single *a);

#endif
