/* SPDX-License-Identifier: MIT */
/* The area that stays undecided along segments, charged to the facets that it may belong to
   (visibility/cells.c). */
#ifndef LRCSI_CELLS_CHARGE_H
#define LRCSI_CELLS_CHARGE_H

#include "visibility/cells_state.h"

/* A cell is thin if the distance of its sample from the border is below this part of the cell's
   perimeter. */
#define LRCSI_CELLS_THIN 0x1p-32

/* The strip along a segment at which a cell is cut: its width on either side, and its ends as
   distances from the segment's first end. */
typedef struct lrcsi_cells_strip {
    const lrcsi_cells_segment *along; /* or NULL: then there is none */
    double width, from, to;
    double g; /* of the cell that is cut */
} lrcsi_cells_strip;

/* Charges the undecided area of a segment at the border to the facets near it: to each no more than
   the area of the strip along the facet's length. A negligible area is charged to all facets of the
   list later. */
void lrcsi_cells_charge_border(lrcsi_cells_work *c, lrcsi_cells_cell *cell,
                               const lrcsi_cells_sides *s, const lrcsi_cells_border *e);

/* Charges a facet that is still open for its part of the strip of a cut. Its corners have distances
   from the line between `low` and `high`, as computed. */
void lrcsi_cells_charge_cut(lrcsi_cells_work *c, uint32_t index, double low, double high,
                            const lrcsi_cells_strip *strip);

/* The undecided area in a thin cell, to be charged to every facet in it: that of the strips of so
   many segments, whose lines have errors of at most `off`, along the whole cell. 0 if the cell is
   not thin. */
double lrcsi_cells_thin(const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s, double clear,
                        uint32_t segments, double off);

/* Charges the whole area of a cell that has no room for a sample, if it is a sliver. 0 if not. */
int lrcsi_cells_charge_all(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                           const lrcsi_cells_sides *s);

#endif
