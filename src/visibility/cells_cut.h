/* SPDX-License-Identifier: MIT */
/* Cells are cut along lines, and rid of segments that do not meet them (visibility/cells.c). */
#ifndef LRCSI_CELLS_CUT_H
#define LRCSI_CELLS_CUT_H

#include "visibility/cells_state.h"

/* Strikes segments that are apart from the cell, or only at its border, which is charged. */
void lrcsi_cells_strike(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s);

/* Cuts a cell along a line, that of a segment where one is told: it is struck, and its strip
   charged. The part on the left comes next, the one on the right waits. 0 where there is no room.
 */
int lrcsi_cells_cut(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                    const double line[3], const lrcsi_cells_segment *along);

/* Cuts a cell across the longer side of its box. */
int lrcsi_cells_halve(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                      const lrcsi_cells_sides *s);

/* Finds what belongs to a cell that has waited. */
void lrcsi_cells_settle(lrcsi_cells_work *c, lrcsi_cells_cell *cell);

#endif
