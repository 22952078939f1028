/* SPDX-License-Identifier: MIT */
/* What is visible of one facet, f, as an area with bounds and as disjoint convex pieces, by cells
   of the view plane. The first cell is the facet's triangle. */
#ifndef LRCSI_CELLS_SINGLE_H
#define LRCSI_CELLS_SINGLE_H

#include "visibility/cells_state.h"
#include "visibility/target.h"
#include "visibility/visible.h"

/* A line: the distance from it is a x + b y + c, with an error of at most err. */
typedef struct lrcsi_cells_single_side {
    double line[3], err;
} lrcsi_cells_single_side;

typedef struct lrcsi_cells_single {
    lrcsi_classification *classification;
    lrcsi_grid grid;                    /* of facets */
    lrcsi_cells_work cells;             /* data that cells share, here with f as the only facet */
    lrcsi_cells_facet shape;            /* f in its frame */
    lrcsi_cells_found area;             /* the areas of f found so far */
    unsigned char wanted;               /* cells.wanted: 1 */
    uint32_t *candidate;                /* facets that may hide f */
    uint32_t count;                     /* of candidates */
    lrcsi_cells_single_side (*side)[3]; /* sides of the first side_room candidates */
    uint32_t side_room;
    uint32_t *listed; /* facet: the search that last listed it */
    uint32_t *order;  /* facet that was listed: its depth order against f (cells_single.c) */
    lrcsi_crossings crossings; /* of f, once they are needed */
    uint32_t facet;
    lrcsi_target target;      /* the frame of f along the axes of the view */
    lrcsi_target frame;       /* the frame of the cells: the same, or that of a needle */
    lrcsi_needle needle;      /* used if f is a needle */
    lrcsi_clip_polygon piece; /* the piece last found */
    uint64_t cells_left;      /* the number of cells that may still be processed */
    double negligible;        /* undecided area too small to be divided further */
    double border_area;       /* area within the error of the sides of f */
    double piece_err;         /* additional error of the area of a needle's pieces */
    lrcsi_moment moment;      /* of the pieces; after `close` of the visible region */
    double uncertainty[2];    /* undecided area: [0] probably hidden, [1] probably visible */
    int hidden;               /* 1 if some of f is hidden */
} lrcsi_cells_single;

/* Bytes at most. */
size_t lrcsi_cells_single_need(const lrcs_prepared *prepared);

/* Makes the data for all facets of a view; they stay in the work area. Given: a grid of facets
   whose lists are complete in the cells of every facet that will be opened. Status: LRCS_OK;
   LRCS_E_MEMORY. */
int lrcsi_cells_single_make(lrcsi_classification *classification, lrcsi_meter *meter,
                            const lrcsi_grid *grid, lrcs_work *work, lrcsi_cells_single *a);

/* One facet that can hide others (lrcsi_view_casts), piece by piece: call open, then next until
   it returns 0, then close. Each `next` that returns 1 leaves one piece of the visible region in
   a->piece, in the frame of a->target; `close` returns the area, and leaves the moment in
   a->moment; that of a needle is not known. */
void lrcsi_cells_single_open(lrcsi_cells_single *a, uint32_t facet);
int lrcsi_cells_single_next(lrcsi_cells_single *a);
lrcsi_visible lrcsi_cells_single_close(lrcsi_cells_single *a);

#endif
