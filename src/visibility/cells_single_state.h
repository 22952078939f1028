/* SPDX-License-Identifier: MIT */
/* The data that the modules share which find what is visible of one facet, f
   (visibility/cells_single.c). */
#ifndef LRCSI_CELLS_SINGLE_STATE_H
#define LRCSI_CELLS_SINGLE_STATE_H

#include "visibility/cells_state.h"
#include "visibility/target.h"

/* A line: the distance from it is a x + b y + c, with an error of at most err. */
typedef struct lrcsi_cells_single_side {
    double line[3], err;
} lrcsi_cells_single_side;

typedef struct lrcsi_cells_single {
    /* Given: */
    lrcsi_classification *classification;
    lrcsi_grid grid; /* of facets */

    /* The current facet, f: */
    uint32_t facet;
    lrcsi_target target;     /* the frame of f along the axes of the view */
    lrcsi_target frame;      /* the frame of the cells: the same, or that of a needle */
    lrcsi_needle needle;     /* used if f is a needle */
    lrcsi_cells_facet shape; /* f in its frame */
    lrcsi_cells_work cells;  /* data that cells share, here with f as the only facet */
    unsigned char wanted;    /* cells.wanted: 1 */
    uint64_t cells_left;     /* the number of cells that may still be processed */
    double negligible;       /* undecided area too small to be divided further */

    /* What may hide f: */
    uint32_t *candidate; /* facets */
    uint32_t count;
    lrcsi_cells_single_side (*side)[3]; /* sides of the first side_room candidates */
    uint32_t side_room;
    uint32_t *listed;          /* facet: the search that last listed it */
    uint32_t *order;           /* facet that was listed: its lrcsi_candidate_order against f, or the
                                  number of a segment */
    lrcsi_crossings crossings; /* of f, once they are needed */

    /* Found of f: */
    lrcsi_clip_polygon piece; /* the piece last found */
    lrcsi_cell_area area;     /* the areas found so far */
    lrcsi_moment moment;      /* of the pieces; after `close` of the visible region */
    double border_area;       /* area within the error of the sides of f */
    double piece_err;         /* additional error of the area of a needle's pieces */
    double perhaps_hidden;    /* undecided area that is more likely to be hidden */
    double perhaps_visible;   /* the rest of the undecided area */
    int hidden;               /* 1 if some of f is hidden */
} lrcsi_cells_single;

/* The depth order of a facet against f: one of these, or the number of the segment in which the two
   intersect. */
enum lrcsi_candidate_order {
    LRCSI_ORDER_NOT_COMPUTED = 0x7ffffff0,
    LRCSI_ORDER_FRONT,    /* nearer, wherever a line meets both */
    LRCSI_ORDER_BEHIND,   /* farther */
    LRCSI_ORDER_DISJOINT, /* it lies beyond a side of f: not a candidate */
    LRCSI_ORDER_UNDECIDED /* they intersect along a line that could not be computed */
};

#endif
