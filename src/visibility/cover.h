/* SPDX-License-Identifier: MIT */
/* What stands in front of a point of a contested facet: one exact sample, and whether it tells of
   all of a cell around the point. */
#ifndef LRCSI_COVER_H
#define LRCSI_COVER_H

#include "visibility/cut.h"
#include "visibility/query.h"

enum lrcsi_cover_answer {
    LRCSI_COVER_NONE,   /* nothing hides the point */
    LRCSI_COVER_ALL,    /* a sheet hides it that ends nowhere in the cell: it hides all of that */
    LRCSI_COVER_SOME,   /* only sheets hide it that may end in the cell */
    LRCSI_COVER_UNKNOWN /* it cannot be told, or the view's meter is spent */
};

/* A facet that may hide some of the target. */
typedef struct lrcsi_cover_facet {
    lrcsi_view_box box;
    uint32_t facet;
    uint32_t order; /* against the target's plane */
} lrcsi_cover_facet;

/* The sides of a candidate in the target's frame, kept for lines to come. */
typedef struct lrcsi_cover_sides {
    uint32_t facet, ask; /* whose they are, in which search */
    lrcsi_clip_line side[3];
    double clear[3]; /* how far lrcsi_clip_side may be off of each */
} lrcsi_cover_sides;

/* So many are kept at a time, each in the place that its facet's number tells. */
#define LRCSI_COVER_KEPT 1024u

typedef struct lrcsi_cover {
    lrcsi_contest *contest;
    lrcsi_grid facets;
    uint32_t *asked; /* facet: the search for candidates that last met it */
    uint32_t asks;   /* searches so far */
    lrcsi_cover_facet *candidate;
    uint32_t count;
    lrcsi_cover_sides *sides;
} lrcsi_cover;

/* Bytes at most, with those of the grid. */
size_t lrcsi_cover_need(const lrcs_prepared *prepared);

/* What serves all facets of a view, but for the grid of facets, which is the caller's to make; it
   stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_cover_make(lrcsi_contest *contest, lrcs_work *work, lrcsi_cover *cover);

/* Lists what may hide some of a facet that casts: not all of it where the view's meter is spent. */
void lrcsi_cover_start(lrcsi_cover *cover, const lrcsi_target *target);

/* A place of the target's frame at which to ask. */
typedef struct lrcsi_cover_place {
    double at[2];
    double clear; /* the answer holds, or is wanted, as far around it */
    int guess;    /* out: the answer may be wrong, or is of a place farther off */
} lrcsi_cover_place;

/* Asks at a place near which a cell may be divided by list[0 .. count) of the cuts alone. A
   lrcsi_cover_answer; where it is SOME, *sheet is that with the fewest of them. */
int lrcsi_cover_sample(lrcsi_cover *cover, const lrcsi_cuts *cuts, uint32_t count,
                       lrcsi_cover_place *place, uint32_t *sheet);

#endif
