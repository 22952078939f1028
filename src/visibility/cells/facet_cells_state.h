/* SPDX-License-Identifier: MIT */
/* The data that the modules share which find what is visible of one facet, f
   (visibility/cells/facet_cells.c). */
#ifndef LRCSI_FACET_CELLS_STATE_H
#define LRCSI_FACET_CELLS_STATE_H

#include "visibility/base/visible_area.h"
#include "visibility/cells/cells_division.h"
#include "visibility/cells/target.h"
#include "visibility/uniform/classify.h"

/* A line: the distance from it is a x + b y + c, with an error of at most err. */
typedef struct lrcsi_facet_cells_side {
    double line[3], err;
} lrcsi_facet_cells_side;

/* The depth order of a facet against f. */
enum lrcsi_candidate_order {
    LRCSI_ORDER_NOT_COMPUTED,
    LRCSI_ORDER_FRONT,     /* nearer, wherever a line meets both */
    LRCSI_ORDER_BEHIND,    /* farther */
    LRCSI_ORDER_CONTACT,   /* the two intersect along a segment */
    LRCSI_ORDER_UNDECIDED, /* they intersect along a line that could not be computed */
    LRCSI_ORDER_DISJOINT   /* it lies beyond a side of f: not a candidate */
};

typedef struct lrcsi_facet_cells {
    /* Given: */
    lrcsi_classification *classification;
    lrcsi_grid grid; /* of facets */

    /* The current facet, f: */
    uint32_t facet;
    lrcsi_target target;     /* the frame of f along the axes of the view */
    lrcsi_target frame;      /* the frame of the cells: the same, or that of a needle */
    lrcsi_needle needle;     /* used if f is a needle */
    lrcsi_cells_facet shape; /* f in its frame */
    lrcsi_cell_area area;    /* the areas found so far */
    unsigned char wanted;    /* 1 */
    lrcsi_division division; /* of f's triangle; `shape`, `area` and `wanted` are those of its only
                                facet, 0 */
    uint64_t cells_left;     /* the number of cells that may still be processed */
    double halved_area;      /* only a cell with a larger area is halved */

    /* What may hide f: */
    uint32_t *candidate, candidate_count;
    lrcsi_facet_cells_side (*side)[3]; /* sides of the first side_room candidates */
    uint32_t side_room;
    lrcsi_marks listed;        /* facets that the search for candidates has come to */
    unsigned char *order;      /* listed facet: its lrcsi_candidate_order */
    uint32_t *contact;         /* facet with the order CONTACT: the number of that segment */
    lrcsi_crossings crossings; /* of f, once they are needed */

    /* Found of f: */
    lrcsi_clip_polygon piece; /* the piece last found */
    lrcsi_moment moment;      /* of the pieces; after `close` of the visible region */
    double reach;             /* the largest distance of the pieces from the centroid of f */
    double border_area;       /* area within the error of the sides of f */
    double piece_err;         /* additional error of the area of a needle's pieces */
    double perhaps_hidden;    /* undecided area that is more likely to be hidden */
    double perhaps_visible;   /* the rest of the undecided area */
    int hidden;               /* 1 if some of f is hidden */
} lrcsi_facet_cells;

/* May a facet be in front of f? */
static inline int lrcsi_facet_cells_is_candidate(const lrcsi_facet_cells *cells, uint32_t other)
{
    return lrcsi_marked(&cells->listed, other) && cells->order[other] != LRCSI_ORDER_DISJOINT;
}

#endif
