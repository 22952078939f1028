/* SPDX-License-Identifier: MIT */
/* What the laser sees of every facet, analytically: as areas with bounds, and facet by facet as
   disjoint convex pieces. */
#ifndef LRCSI_OCCLUDE_H
#define LRCSI_OCCLUDE_H

#include "visibility/cells_alone.h"

/* What serves all facets of a view, and the facet at hand. */
typedef struct lrcsi_occluding {
    lrcsi_classification *classification;
    lrcsi_grid facets;
    unsigned char *uniform; /* facet: what a uniform one shows, a lrcsi_query_answer */
    lrcsi_alone alone;      /* target and piece of the facet at hand */
    lrcsi_visible answer;   /* of a facet that is not undecided */
    int undecided;
    int whole; /* all of it is visible, and no piece has been asked for yet */
} lrcsi_occluding;

/* Bytes at most. */
size_t lrcsi_occlude_need(const lrcs_prepared *prepared);

/* What serves all facets; it stays in the work area.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_occlude_make(lrcsi_classification *classification, lrcs_work *work, lrcsi_occluding *o);

/* One facet piece by piece: open it, ask for more until there are none, close it. Each `next` that
   returns 1 leaves one more of the disjoint convex pieces of what is visible in o->alone.piece, in
   the frame of o->alone.target (lrcsi_target_weights leads back to the facet). A facet that is
   visible whole comes as its own triangle; one of which nothing is known to be visible has no
   pieces. The pieces together differ from what is visible, both ways, by an area of at most high -
   low of the answer, and by the rounding of their corners: 20 u reach perimeter. */
void lrcsi_occlude_open(lrcsi_occluding *o, uint32_t facet);
int lrcsi_occlude_next(lrcsi_occluding *o);
lrcsi_visible lrcsi_occlude_close(lrcsi_occluding *o);

/* Closes a facet of which only the area is wanted, and no piece has been asked for. */
lrcsi_visible lrcsi_occlude_area(lrcsi_occluding *o);

/* Every facet: uniform ones by one exact sample; undecided ones all together where they are many
   (visibility/cells.h), else one by one. One that falls into more cells than the limit is bounded
   by what was reached.
   Returned: *answer, unless answer is NULL: facet -> LRCSI_QUERY_HIDDEN or _VISIBLE where it shows
   nothing or all of itself, which is exact then; else LRCSI_QUERY_UNDECIDED, and visible[facet] is
   its area. So most of visible[] is never touched. With answer NULL visible[] has the areas of all.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. Only *answer stays in the work area. */
int lrcsi_occlude_all(lrcsi_classification *classification, lrcs_work *work,
                      const unsigned char **answer, lrcsi_visible *visible);

#endif
