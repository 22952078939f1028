/* SPDX-License-Identifier: MIT */
/* What is visible of one facet, f, as an area with bounds and as disjoint convex pieces, by cells
   of the view plane. The first cell is the facet's triangle. */
#ifndef LRCSI_FACET_CELLS_H
#define LRCSI_FACET_CELLS_H

#include "visibility/cells/facet_cells_state.h"

/* Bytes at most. */
size_t lrcsi_facet_cells_need(const lrcs_prepared *prepared);

/* Makes the data for all facets of a view; they stay in the work area. Given: a grid of facets
   whose lists are complete in the buckets of every facet that will be opened. Status: LRCS_OK;
   LRCS_E_MEMORY. */
int lrcsi_facet_cells_make(lrcsi_classification *classification, lrcsi_meter *meter,
                           const lrcsi_grid *grid, lrcs_work *work, lrcsi_facet_cells *cells);

/* One facet that can hide others (lrcsi_view_casts), piece by piece: call open, then next until
   it returns 0, then close. Each `next` that returns 1 leaves one piece of the visible region in
   cells->piece, in the frame of cells->target; `close` returns the area, and leaves the moment in
   cells->moment; that of a needle is not known. */
void lrcsi_facet_cells_open(lrcsi_facet_cells *cells, uint32_t facet);
int lrcsi_facet_cells_next(lrcsi_facet_cells *cells);
lrcsi_visible_area lrcsi_facet_cells_close(lrcsi_facet_cells *cells);

#endif
