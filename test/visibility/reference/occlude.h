/* SPDX-License-Identifier: MIT */
/* The part of a facet that the laser sees, found analytically: an undecided facet is divided into
   cells until nothing divides a cell further. The result is an area with bounds, or disjoint convex
   pieces. */
#ifndef REF_OCCLUDE_H
#define REF_OCCLUDE_H

#include "visibility/raster/visible.h"
#include "visibility/reference/clip.h"
#include "visibility/reference/cover.h"
#include "visibility/reference/cut.h"

/* A cell: a part of the facet that waits to be processed. */
typedef struct ref_occlude_cell {
    lrcsi_clip_polygon shape;
    uint32_t count; /* only the first `count` cuts of the list can divide it */
    int slice;      /* 1 to divide it along a cut next, 0 to halve it if it has many cuts */
    uint32_t depth; /* the number of halvings so far */
    uint32_t cuts;  /* the number of cuts removed from its list: cut along, or beside it */
    double inset;   /* the largest width of those */
    double at[2];   /* the position of a sample in it */
    int lit;        /* 1 if the facet is known to be visible there */
    int sure;       /* 1 if the answer of its sample is certain */
} ref_occlude_cell;

/* What all facets of a view share, and the current facet. */
typedef struct ref_occluding {
    lrcsi_classification *classification;
    lrcs_work *work;
    ref_cover cover;
    unsigned char *uniform;    /* facet: the visibility of a uniform one, a lrcsi_query_answer */
    lrcsi_crossings crossings; /* of the facet, once they are needed */
    ref_occlude_cell *stack;   /* `top` cells that wait to be processed */
    uint32_t top;

    size_t mark;         /* of the work area, before the facet */
    lrcsi_target target; /* of an undecided facet; of another facet, once a piece was requested */
    lrcsi_target frame;  /* the same, in the frame in which it is divided */
    lrcsi_needle needle; /* its frame, if it is a needle */
    ref_cuts cuts;       /* what may divide it */
    lrcsi_clip_polygon piece;  /* the last piece found */
    lrcsi_visible_area answer; /* of a facet that is not undecided */
    int undecided;
    int whole;             /* 1 if all of it is visible, and no piece has been requested yet */
    uint64_t cells;        /* the number of cells that may still be divided */
    uint64_t spare;        /* the number of these that are reserved for cells with cuts */
    double area;           /* visible so far */
    double uncertainty[2]; /* area of undecided cells: counted as hidden, counted as visible */
    double area_err;       /* error bound of the area */
    double shape_err;      /* additional error bound of the pieces' area */
} ref_occluding;

/* Bytes at most. */
size_t ref_occlude_need(const lrcs_prepared *prepared);

/* Allocates what all facets share; it stays in the work area.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int ref_occlude_make(lrcsi_classification *classification, lrcs_work *work, ref_occluding *o);

/* The visible pieces of one facet: open it, call `next` until it returns 0, close it. Each `next`
   that returns 1 leaves one of the disjoint convex visible pieces in o->piece, in the frame of
   o->target (lrcsi_target_weights converts back to the facet). An entirely visible facet is
   returned as its own triangle; a facet with no part known to be visible has no pieces. The union
   of the pieces differs from the visible part, in both directions, by an area of at most high - low
   of the answer, plus the rounding of their corners: 20 u reach perimeter and o->shape_err.
   Status: LRCS_OK; LRCS_E_MEMORY. An open facet occupies a part of the work area until it is
   closed; a facet that failed to open is closed. */
int ref_occlude_open(ref_occluding *o, uint32_t facet);
int ref_occlude_next(ref_occluding *o);
lrcsi_visible_area ref_occlude_close(ref_occluding *o);

/* The area of an open facet, if no piece has been requested. Closes the facet. */
lrcsi_visible_area ref_occlude_area(ref_occluding *o);

/* The area of a facet of which nothing is known, with its bounds. */
lrcsi_visible_area ref_occlude_unknown(const lrcsi_view *view, uint32_t facet);

/* The visible areas of all facets: of uniform facets from one exact sample, of undecided facets
   cell by cell, unless one component hides the whole facet. A facet for whose cuts there is not
   enough memory is bounded by 0 and its whole area; *too_little counts those. If a facet needs more
   cells than the limit, its bounds follow from the cells that were processed. Status: LRCS_OK;
   LRCS_E_MEMORY; LRCS_E_LIMIT. Nothing stays in the work area. */
int ref_occlude_all(lrcsi_classification *classification, lrcs_work *work,
                    lrcsi_visible_area *visible, uint32_t *too_little);

#endif
