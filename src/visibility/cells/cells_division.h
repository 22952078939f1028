/* SPDX-License-Identifier: MIT */
/* A part of the view plane that is being divided into cells: a block (visibility/cells/cells.c) or
   the triangle of one facet (visibility/cells/facet_cells.c). */
#ifndef LRCSI_CELLS_DIVISION_H
#define LRCSI_CELLS_DIVISION_H

#include <stddef.h>
#include <string.h>

#include "base/constant.h"
#include "base/meter.h"
#include "base/sum.h"
#include "visibility/cells/cells_facet.h"

/* The largest number of cuts from a division to a cell, and of cells on the stack. */
#define LRCSI_CELL_MAX_CUTS 200u
#define LRCSI_CELL_STACK    (LRCSI_CELL_MAX_CUTS + 2)
/* Room for the segment lists of all cells on the stack: so many times all segments of a division.
   Ordinary scenes take twice, a stack of 800 plates 6 times. A cell for whose parts there is no
   room is left undecided. */
#define LRCSI_CELL_SEGMENT_LISTS 8u

/* A part of the view plane that is not decided yet, with lists of its facets and segments. A cut
   makes two cells: the left one is processed first, with all that are cut from it, while the right
   one waits on the stack. The lists of the right one take the place of those of the cell that was
   cut; behind them follow those of the left one. */
typedef struct lrcsi_cell {
    uint32_t *facet, *segment; /* numbers of records of the division, in the division's lists */
    uint32_t facet_count, segment_count;
    int keeps_sample;    /* 1: the sample taken in the cell that was cut is in this part */
    uint32_t cuts;       /* since the division began */
    uint32_t removed;    /* segments removed from the list since then */
    double shape_err;    /* the distance from the cell of a point that belongs to it, at most */
    double uncertainty;  /* area not charged yet, by which that of any facet may be wrong */
    double widest_strip; /* of a segment removed from the list */
    double cut_line[3];  /* of the last cut; positive in the cell */
    lrcsi_clip_polygon shape; /* the last member (lrcsi_cell_copy) */
} lrcsi_cell;

/* A copy of a cell; of its shape, only the corners that there are. */
static inline void lrcsi_cell_copy(const lrcsi_cell *from, lrcsi_cell *to)
{
    memcpy(to, from, offsetof(lrcsi_cell, shape));
    lrcsi_clip_copy(&from->shape, &to->shape);
}

/* Areas of a facet. */
typedef struct lrcsi_cell_area {
    lrcsi_sum visible; /* in cells in which it is visible */
    double visible_err;
    double uncertainty;  /* in strips in which its visibility is undecided */
    double strip_length; /* of those strips */
} lrcsi_cell_area;

/* A segment at the border of a cell: its line, first end and length, and where it is near the cell.
 */
typedef struct lrcsi_cell_border {
    double line[3], start[2];
    double length;
    lrcsi_clip_interval interval;
} lrcsi_cell_border;

/* What is being divided: its facets and segments, and the cells of it that are not decided yet. */
typedef struct lrcsi_division {
    const lrcsi_view *view;
    lrcsi_meter *meter; /* limit on steps; NULL: none */

    /* Records of facets and segments, which cells list by their numbers: */
    lrcsi_cells_facet *facet;
    uint32_t *record;     /* facet of the scene: the number of its record, by which segments name
                             it; 0: it has none. NULL: segments name facets by their numbers */
    uint32_t record_room; /* numbers of records, with 0 */
    lrcsi_cells_segment *segment;
    uint32_t segment_count, segment_room;
    double extent;    /* the largest coordinate */
    double facet_err; /* the largest position error of a facet */

    /* Areas: */
    unsigned char *wanted; /* record: 1 if its area is wanted */
    lrcsi_cell_area *area; /* record */
    double negligible;     /* an undecided area that is charged without computing it more closely */
    double chargeable;     /* the largest area of an undecided cell that is charged whole */

    /* The cells that wait, and the room for their lists: */
    lrcsi_cell *stack;
    uint32_t stack_count;
    uint32_t *facet_lists, *segment_lists;
    size_t facet_lists_room, segment_lists_room;
} lrcsi_division;

/* Statements about a cell hold for all points within this distance of it, as computed: its shape
   error, and 16 u of the largest coordinate for distances from lines. */
static inline double lrcsi_division_tolerance(const lrcsi_division *d, const lrcsi_cell *cell)
{
    return 16 * LRCSI_U * d->extent + cell->shape_err;
}

/* Adds a segment, or one with the facets of an edge; the caller sets its other fields. NULL if
   there is no room. */
lrcsi_cells_segment *lrcsi_division_segment(lrcsi_division *d);
lrcsi_cells_segment *lrcsi_division_edge(lrcsi_division *d, uint32_t edge);

/* The number by which segments name a facet of the scene, or LRCS_NONE. */
static inline uint32_t lrcsi_division_owner(const lrcsi_division *d, uint32_t facet)
{
    return d->record && facet != LRCS_NONE ? d->record[facet] : facet;
}

/* Is any of the facets of an edge of the scene marked, by the numbers of owners? */
int lrcsi_division_edge_marked(const lrcsi_division *d, uint32_t edge, const lrcsi_marks *marks);

/* Is any facet of a segment, an edge or a contact, marked? */
static inline int lrcsi_division_segment_marked(const lrcsi_division *d,
                                                const lrcsi_cells_segment *e,
                                                const lrcsi_marks *marks)
{
    return lrcsi_marked(marks, e->owner[0]) ||
           (e->owner[1] != LRCS_NONE && lrcsi_marked(marks, e->owner[1])) ||
           (e->edge != LRCS_NONE && lrcsi_division_edge_marked(d, e->edge, marks));
}

/* Makes a cell that lists all segments the only one that waits. */
void lrcsi_division_start(lrcsi_division *d, lrcsi_cell *cell);

#endif
