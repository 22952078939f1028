/* SPDX-License-Identifier: MIT */
/* The cell that a block begins as: its facets, and its segments (visibility/cells.c). */
#ifndef LRCSI_CELLS_OPEN_H
#define LRCSI_CELLS_OPEN_H

#include "visibility/cells_state.h"

/* A new segment; of an edge, whose facets are told. NULL if there is no room. */
lrcsi_cells_segment *lrcsi_cells_segment_new(lrcsi_cells_work *c);
lrcsi_cells_segment *lrcsi_cells_edge(lrcsi_cells_work *c, uint32_t edge);

/* Segments that the fullest block may have at most. Given: c->view, grid, kind. */
size_t lrcsi_cells_segments_most(const lrcsi_cells_work *c);

/* Lists what a block has, and makes the records. 0 if there is no room. */
int lrcsi_cells_open(lrcsi_cells_work *c, size_t block, lrcsi_cells_cell *cell);

#endif
