/* SPDX-License-Identifier: MIT */
/* What stands in front of a point of an undecided facet: one exact sample, and whether it tells of
   all of a cell around the point. */
#ifndef REF_COVER_H
#define REF_COVER_H

#include "visibility/query.h"
#include "visibility/reference/cut.h"

enum ref_cover_answer {
    REF_COVER_NONE,   /* nothing hides the point */
    REF_COVER_ALL,    /* a component hides it that ends nowhere in the cell: it hides all of that */
    REF_COVER_SOME,   /* only components hide it that may end in the cell */
    REF_COVER_UNKNOWN /* it cannot be told, or the view's meter is spent */
};

/* A facet that may hide some of the target. */
typedef struct ref_cover_facet {
    lrcsi_view_box box;
    uint32_t facet;
    uint32_t order; /* against the target's plane */
} ref_cover_facet;

/* The sides of a candidate in the target's frame, kept for lines to come. */
typedef struct ref_cover_sides {
    uint32_t facet, ask; /* whose they are, in which search */
    lrcsi_clip_line side[3];
    double clear[3]; /* how far lrcsi_clip_side may be off of each */
} ref_cover_sides;

/* So many are kept at a time, each in the place that its facet's number tells. */
#define REF_COVER_KEPT 1024u

typedef struct ref_cover {
    lrcsi_classification *classification;
    lrcsi_grid facets;
    uint32_t *asked; /* facet: the search for candidates that last met it */
    uint32_t asks;   /* searches so far */
    ref_cover_facet *candidate;
    uint32_t count;
    ref_cover_sides *sides;
} ref_cover;

/* Bytes at most, with those of the grid. */
size_t ref_cover_need(const lrcs_prepared *prepared);

/* What serves all facets of a view, but for the grid of facets, which is the caller's to make; it
   stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int ref_cover_make(lrcsi_classification *classification, lrcs_work *work, ref_cover *cover);

/* Lists what may hide some of a facet that casts: not all of it where the view's meter is spent. */
void ref_cover_start(ref_cover *cover, const lrcsi_target *target);

/* A place of the target's frame at which to ask. */
typedef struct ref_cover_place {
    double at[2];
    double clear; /* the answer holds, or is wanted, as far around it */
    int guess;    /* out: the answer may be wrong, or is of a place farther off */
} ref_cover_place;

/* Asks at a place near which a cell may be divided by list[0 .. count) of the cuts alone. A
   ref_cover_answer; where it is SOME, *component is that with the fewest of them. */
int ref_cover_sample(ref_cover *cover, const ref_cuts *cuts, uint32_t count, ref_cover_place *place,
                     uint32_t *component);

#endif
