/* SPDX-License-Identifier: MIT */
/* What is visible of one facet: cells of the view plane that begin as its triangle. As an area with
   bounds, and as disjoint convex pieces. */
#ifndef LRCSI_CELLS_ALONE_H
#define LRCSI_CELLS_ALONE_H

#include "visibility/cells_state.h"
#include "visibility/target.h"
#include "visibility/visible.h"

/* A line, the distance from it being a x + b y + c, and how far that may be off. */
typedef struct lrcsi_alone_side {
    double line[3], clear;
} lrcsi_alone_side;

typedef struct lrcsi_alone {
    lrcsi_classification *classification;
    lrcsi_grid grid;             /* of facets */
    lrcsi_cells_work cells;      /* of one facet, in its frame: the one at hand, f; of that */
    lrcsi_cells_facet shape;     /* its sides, */
    lrcsi_cells_found area;      /* what is found, */
    unsigned char open;          /* 1, */
    uint32_t number;             /* and 0, its number in `cells` */
    uint32_t *candidate;         /* facets that may hide it, */
    uint32_t count;              /* so many */
    lrcsi_alone_side (*side)[3]; /* sides of the first side_room candidates */
    uint32_t side_room;
    uint32_t *met;   /* facet: the search that last met it */
    uint32_t *order; /* facet that was met: how they stand to each other */
    uint32_t facet;
    lrcsi_target target;      /* its frame */
    lrcsi_target frame;       /* the same in which it is divided */
    lrcsi_needle needle;      /* that of a needle */
    lrcsi_clip_polygon piece; /* the piece last found */
    uint64_t parts;           /* that it may yet be cut into */
    double rim;               /* area within the error of its sides */
    double bent;              /* by which the area of a needle's pieces may be wrong beside */
    double uncertainty[2];    /* area that could not be decided: hidden, visible by a guess */
    int hidden;               /* some of it is */
} lrcsi_alone;

/* Bytes at most. */
size_t lrcsi_alone_need(const lrcs_prepared *prepared);

/* What serves all facets of a view; it stays in the work area. Given: a grid of facets that lists
   all that stand where any facet does which is to be opened. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_alone_make(lrcsi_classification *classification, const lrcsi_grid *grid, lrcs_work *work,
                     lrcsi_alone *a);

/* Readies a facet that casts. Each `next` that returns 1 then leaves one more of the pieces of what
   is visible in a->piece, in the frame of a->target; `close` tells the area. */
void lrcsi_alone_open(lrcsi_alone *a, uint32_t facet);
int lrcsi_alone_next(lrcsi_alone *a);
lrcsi_visible lrcsi_alone_close(lrcsi_alone *a);

#endif
