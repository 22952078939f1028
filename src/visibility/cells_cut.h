/* SPDX-License-Identifier: MIT */
/* Cells are cut along lines, and rid of segments that do not meet them (visibility/cells.c). */
#ifndef LRCSI_CELLS_CUT_H
#define LRCSI_CELLS_CUT_H

#include "visibility/cells_state.h"

/* Strikes segments that are apart from the cell, or only at its border, which is charged. */
void lrcsi_cells_strike(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s);

/* Divides a cell along the line of a segment, which is struck, and its strip charged; a cell with
   many corners is halved instead. The part on the left comes next, the one on the right waits. 0 if
   there is no room. */
int lrcsi_cells_divide(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_sides *s, const lrcsi_cells_segment *along);

/* Divides a cell across the longer side of its box, likewise. */
int lrcsi_cells_halve(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                      const lrcsi_cells_sides *s);

/* The cell that comes next, with what belongs to it if it has waited. */
lrcsi_cells_cell lrcsi_cells_take(lrcsi_cells_work *c);

#endif
