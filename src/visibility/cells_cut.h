/* SPDX-License-Identifier: MIT */
/* Cutting cells along lines, and removing segments that do not meet a cell from its list
   (visibility/cells.c). */
#ifndef LRCSI_CELLS_CUT_H
#define LRCSI_CELLS_CUT_H

#include "visibility/cells_state.h"

/* Removes segments from the cell's list that do not meet the cell, and those that are only at its
   border; the strips of the latter are charged. */
void lrcsi_cells_strike(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s);

/* Divides a cell along the line of a segment, which is removed from the list, and its strip
   charged; a cell with many corners is halved instead. The left part is taken next, the right part
   waits. 0 if there is no room. */
int lrcsi_cells_divide(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_sides *s, const lrcsi_cells_segment *along);

/* Halves a cell across the longer side of its box. 0 if there is no room. */
int lrcsi_cells_halve(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                      const lrcsi_cells_sides *s);

/* Takes the next cell. If it has waited, selects the entries of its lists. */
lrcsi_cells_cell lrcsi_cells_take(lrcsi_cells_work *c);

#endif
