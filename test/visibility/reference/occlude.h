/* SPDX-License-Identifier: MIT */
/* What the laser sees of a facet, analytically: undecided facets fall into cells that nothing
   divides. As an area with bounds, and as disjoint convex pieces. */
#ifndef REF_OCCLUDE_H
#define REF_OCCLUDE_H

#include "visibility/reference/clip.h"
#include "visibility/reference/cover.h"
#include "visibility/reference/cut.h"
#include "visibility/visible.h"

/* A part of the facet that is yet to be done. */
typedef struct ref_occlude_cell {
    lrcsi_clip_polygon shape;
    uint32_t count; /* the cuts that may divide it are among the first so many of the list */
    int slice;      /* it was last relieved by a cut, not by halving, or should be */
    uint32_t depth; /* halvings in all */
    uint32_t cuts;  /* so many were made, or passed it by */
    double inset;   /* the widest of those */
    double at[2];   /* a place in it, */
    int lit;        /* where that is known to be visible */
    int sure;       /* all samples so far stood clear of what they tell of */
} ref_occlude_cell;

/* What serves all facets of a view, and the facet at hand. */
typedef struct ref_occluding {
    lrcsi_classification *classification;
    lrcs_work *work;
    ref_cover cover;
    unsigned char *uniform;    /* facet: what a uniform one shows, a lrcsi_query_answer */
    lrcsi_crossings crossings; /* of the facet, once they are needed */
    ref_occlude_cell *stack;   /* of `top` cells yet to be done */
    uint32_t top;

    size_t mark;              /* of the work area, before the facet */
    lrcsi_target target;      /* of an undecided facet; of others once a piece has been asked for */
    lrcsi_target frame;       /* the same in the frame in which it is divided */
    lrcsi_needle needle;      /* that of a needle */
    ref_cuts cuts;            /* what may divide it */
    lrcsi_clip_polygon piece; /* the piece last found */
    lrcsi_visible answer;     /* of a facet that is not undecided */
    int undecided;
    int whole;             /* all of it is visible, and no piece has been asked for yet */
    uint64_t cells;        /* that may yet be divided */
    uint64_t spare;        /* of these, for cells that cuts divide */
    double area;           /* visible so far */
    double uncertainty[2]; /* area of cells that could not be told: hidden, visible by a guess */
    double off;            /* by which the area may be wrong */
    double bent;           /* by which the pieces' area may be wrong beside */
} ref_occluding;

/* Bytes at most. */
size_t ref_occlude_need(const lrcs_prepared *prepared);

/* What serves all facets; it stays in the work area.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int ref_occlude_make(lrcsi_classification *classification, lrcs_work *work, ref_occluding *o);

/* One facet piece by piece: open it, ask for more until there are none, close it. Each `next` that
   returns 1 leaves one more of the disjoint convex pieces of what is visible in o->piece, in the
   frame of o->target (lrcsi_target_weights leads back to the facet). A facet that is visible whole
   comes as its own triangle; one of which nothing is known to be visible has no pieces. The pieces
   together differ from what is visible, both ways, by an area of at most high - low of the answer,
   and by the rounding of their corners: 20 u reach perimeter and o->bent.
   Status: LRCS_OK; LRCS_E_MEMORY. What is open takes some of the work area until it is closed; a
   facet that failed to open is closed. */
int ref_occlude_open(ref_occluding *o, uint32_t facet);
int ref_occlude_next(ref_occluding *o);
lrcsi_visible ref_occlude_close(ref_occluding *o);

/* Closes a facet of which only the area is wanted, and no piece has been asked for. */
lrcsi_visible ref_occlude_area(ref_occluding *o);

/* What a facet shows of which nothing is known. */
lrcsi_visible ref_occlude_unknown(const lrcsi_view *view, uint32_t facet);

/* Every facet: uniform ones by one exact sample, undecided ones cell by cell unless one component
   hides all of them. A facet whose cuts find no memory may show anything: *starved counts those.
   One that falls into more cells than the limit is bounded by what was reached. Status: LRCS_OK;
   LRCS_E_MEMORY; LRCS_E_LIMIT. Nothing stays in the work area. */
int ref_occlude_all(lrcsi_classification *classification, lrcs_work *work, lrcsi_visible *visible,
                    uint32_t *starved);

#endif
