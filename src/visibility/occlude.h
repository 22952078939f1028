/* SPDX-License-Identifier: MIT */
/* What the laser sees of every facet, analytically: as areas with bounds, and facet by facet as
   disjoint convex pieces. */
#ifndef LRCSI_OCCLUDE_H
#define LRCSI_OCCLUDE_H

#include "base/progress.h"
#include "visibility/cells/facet_cells.h"

/* Data for all facets of a view, and the current facet. */
typedef struct lrcsi_occlusion {
    lrcsi_classification *classification;
    lrcsi_meter *meter;
    lrcsi_grid facets;     /* those that can hide others */
    unsigned char *answer; /* facet: a lrcsi_query_answer; NO_ANSWER for undecided ones */
    /* The current facet: */
    lrcsi_facet_cells single; /* its target, its piece, and, if it is undecided, its cells */
    int undecided;            /* its pieces are found cell by cell; otherwise all of it is visible
                                 or hidden */
    lrcsi_visible_area area;  /* its area, unless it is undecided */
    int whole;                /* all of it is visible, and its piece has not been returned yet */
} lrcsi_occlusion;

/* Bytes at most. */
size_t lrcsi_occlude_need(const lrcs_prepared *prepared);

/* Makes the data for all facets. They stay in the work area, and so does *o itself, which is too
   large for the stack. Steps are taken from the meter; NULL: no limit.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_occlude_make(lrcsi_classification *classification, lrcsi_meter *meter, lrcs_work *work,
                       lrcsi_occlusion **o);

/* One facet piece by piece: call open, then next until it returns 0, then close. `open` returns 1
   if the pieces are found cell by cell, 0 if all or nothing of the facet is visible. Each `next`
   that returns 1 leaves one of the disjoint convex pieces of the visible region in o->single.piece,
   in the frame of o->single.target, which `open` has made if there may be pieces
   (lrcsi_target_weights leads back to the facet). An entirely visible facet is one piece, its own
   triangle; a facet of which nothing is known to be visible has no pieces. The area in which the
   union of the pieces differs from the visible region is at most
       high - low + lrcsi_occlude_piece_err,
   where high and low are those of the returned area, and the last term, valid once `next` has
   returned 0, is due to the rounding of the corners, 20 u reach perimeter with those of
   o->single.target, and to what cells leave out (o->single.piece_err). Without pieces it is 0. */
static inline double lrcsi_occlude_piece_err(const lrcsi_occlusion *o)
{
    return 20 * LRCSI_U * o->single.target.reach * o->single.target.perimeter + o->single.piece_err;
}
int lrcsi_occlude_open(lrcsi_occlusion *o, uint32_t facet);
int lrcsi_occlude_next(lrcsi_occlusion *o);
lrcsi_visible_area lrcsi_occlude_close(lrcsi_occlusion *o);

/* Closes a facet whose pieces are not needed, only its area; to be called right after open. */
lrcsi_visible_area lrcsi_occlude_area(lrcsi_occlusion *o);

/* All facets: uniform ones by one exact sample; undecided ones together (visibility/cells/cells.h),
   or one by one if that is likely to be faster. If the limit on cells is reached, the bounds of the
   areas include what is still open.
   Returned: *answer, unless answer is NULL: by facet, LRCSI_QUERY_HIDDEN or _VISIBLE if nothing or
   all of it is visible (exact); otherwise LRCSI_QUERY_NO_ANSWER, and visible[facet] is its area.
   Thus most of visible[] is never written. With answer NULL, visible[] has the areas of all facets.
   Unless NULL, moment[] has the moments of all facets.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. Only *answer stays in the work area. */
int lrcsi_occlude_all(lrcsi_classification *classification, lrcsi_meter *meter,
                      lrcs_progress *progress, lrcs_work *work, const unsigned char **answer,
                      lrcsi_visible_area *visible, lrcsi_moment *moment);

#endif
