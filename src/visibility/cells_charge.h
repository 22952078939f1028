/* SPDX-License-Identifier: MIT */
/* Area undecided along segments, charged to the facets that it may belong to (visibility/cells.c).
 */
#ifndef LRCSI_CELLS_CHARGE_H
#define LRCSI_CELLS_CHARGE_H

#include "visibility/cells_state.h"

/* The clearance of a sample in a cell that is not thin, of the perimeter. */
#define LRCSI_CELLS_THIN 0x1p-32

/* The strip along a segment at which a cell is cut, so wide on both sides. Distances along it from
   its first end. */
typedef struct lrcsi_cells_strip {
    const lrcsi_cells_segment *along; /* or NULL: then there is none */
    double width, from, to;
    double g; /* of the cell that is cut */
} lrcsi_cells_strip;

/* Charges what a segment at the border puts undecided to the facets that come near: no more than
   the strip has along the length of the facet. What is next to nothing goes to all of them, later.
 */
void lrcsi_cells_charge_border(lrcsi_cells_work *c, lrcsi_cells_cell *cell,
                               const lrcsi_cells_sides *s, const lrcsi_cells_border *e);

/* Charges a facet that is still open for its part of the strip of a cut. Its corners have distances
   from the line between `low` and `high`, as computed. */
void lrcsi_cells_charge_cut(lrcsi_cells_work *c, uint32_t index, double low, double high,
                            const lrcsi_cells_strip *strip);

/* What strips beyond the ends of so many segments, whose lines are off by at most `off`, may cost
   in a cell whose sample is near to a side: it is thin. Any facet in it may be off by that. */
double lrcsi_cells_thin(const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s, double clear,
                        uint32_t segments, double off);

/* Charges all of a cell that has no room for a sample, where it is a sliver; 0 if it is none. */
int lrcsi_cells_charge_all(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                           const lrcsi_cells_sides *s);

#endif
