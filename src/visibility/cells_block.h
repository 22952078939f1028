/* SPDX-License-Identifier: MIT */
/* The blocks of the view plane, and the cell that each begins as: its facets, and its segments
   (visibility/cells.c). */
#ifndef LRCSI_CELLS_BLOCK_H
#define LRCSI_CELLS_BLOCK_H

#include "visibility/cells_state.h"

/* Bytes at most. */
size_t lrcsi_block_grid_need(const lrcs_prepared *prepared);

/* Makes the blocks, and lists in each the event edges and the facets that can hide others, except
   those that are proved to be hidden (visibility/cells_cover.c). 0 if memory does not suffice, or
   if the lists are too long. */
int lrcsi_block_grid_make(const lrcsi_classification *classification, const unsigned char *answer,
                          lrcs_work *work, lrcsi_block_grid *c);

/* The square of a block, relative to its middle. Returns the largest coordinate. */
double lrcsi_block_grid_square(const lrcsi_block_grid *c, uint32_t x, uint32_t y,
                               lrcsi_clip_polygon *shape, double middle[2]);

/* Adds a segment, or one with the facets of an edge; the caller sets its other fields. NULL if
   there is no room. */
lrcsi_cells_segment *lrcsi_cells_segment_new(lrcsi_cells_work *c);
lrcsi_cells_segment *lrcsi_cells_edge(lrcsi_cells_work *c, uint32_t edge);

/* Lists all segments in a cell, the first. */
void lrcsi_cells_list_segments(const lrcsi_cells_work *c, lrcsi_cell *cell);

/* The largest number of segments of a block, at most. Given: c->view, grid, kind. */
size_t lrcsi_cells_max_segments(const lrcsi_cells_work *c);

/* Lists the facets and segments of a block and makes their records. 0 if there is no room. */
int lrcsi_cells_begin(lrcsi_cells_work *c, size_t block, lrcsi_cell *cell);

#endif
