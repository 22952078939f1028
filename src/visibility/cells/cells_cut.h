/* SPDX-License-Identifier: MIT */
/* Cutting cells along lines, removing segments that do not meet a cell from its list, and charging
   the undecided area along both to facets (visibility/cells/cells.c). */
#ifndef LRCSI_CELLS_CUT_H
#define LRCSI_CELLS_CUT_H

#include "visibility/cells/cells_division.h"

/* Removes segments from the cell's list that do not meet the cell, and those that are only at its
   border; the strips of the latter are charged. */
void lrcsi_cells_filter_segments(lrcsi_division *d, lrcsi_cell *cell, const lrcsi_clip_sides *s);

/* Divides a cell along the line of a segment, which is removed from the list, and its strip
   charged; a cell with many corners is halved instead. The left part is processed next, the right
   part waits. If a sample is given, the left part is the one that it is in, and keeps it. 0 if
   there is no room. */
int lrcsi_cells_divide(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                       const lrcsi_cells_segment *along, const double sample[2]);

/* Halves a cell across the longer side of its box. 0 if there is no room. */
int lrcsi_cells_halve(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s);

/* Charges the strip of a segment at the border of a cell to the facets near it. */
void lrcsi_cells_charge_border(lrcsi_division *d, lrcsi_cell *cell, const lrcsi_clip_sides *s,
                               const lrcsi_cell_border *e);

/* The undecided area in a thin cell, to be charged to every facet in it: that of the strips of so
   many segments along the whole cell, whose lines have errors of at most line_err. 0 if the cell is
   not thin. Given: the distance of the sample from the border. */
double lrcsi_cells_thin_uncertainty(const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                                    double border_distance, uint32_t segments, double line_err);

/* Charges the whole area of a cell in which no sample decides, if it is narrow or chargeable. 0 if
   not. */
int lrcsi_cells_charge_all(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s);

#endif
