/* SPDX-License-Identifier: MIT */
/* The facets that may hide one facet, f, and the segments along which they begin or cease to hide
   it (visibility/cells/facet_cells.c). */
#ifndef LRCSI_FACET_CELLS_CANDIDATE_H
#define LRCSI_FACET_CELLS_CANDIDATE_H

#include "visibility/cells/facet_cells_state.h"

/* Lists the candidates: facets whose boxes overlap that of f and that are not entirely behind it or
   beyond one of its sides. 0 if the meter is spent. */
int lrcsi_facet_cells_candidates(lrcsi_facet_cells *cells);

/* The depth order, a lrcsi_candidate_order, of a candidate whose interior does not intersect that
   of f. */
int lrcsi_facet_cells_order(const lrcsi_facet_cells *cells, uint32_t other);

/* Adds the segments to the division, and finds the depth order of the facets that meet f. 0 if
   there is no room, or the meter is spent. */
int lrcsi_facet_cells_segments(lrcsi_facet_cells *cells);

#endif
