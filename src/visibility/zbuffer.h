/* SPDX-License-Identifier: MIT */
/* Visible areas from a raster: exact where all of a facet is seen or hidden, else from samples,
   with proved bounds and a likely error.

   Definitions. A pixel is a closed square of the view plane. An event is a segment in space across
   which the nearest surface may change: an event edge (visibility/event.h), an edge inside of which
   a corner of another facet lies (mesh/touch.h), the segment in which two facets meet, one of which
   touches the inside of the other, or an edge of a coplanar facet that overlaps another. Only
   facets that cast count. An event is visible at a point of it where no facet is strictly nearer.

   Claim 1. If a pixel P meets no visible event, every facet is visible in all of P that it covers,
   or in nothing of it. Proof: let facet f be visible at one point of P and hidden at another. The
   part of f in P is convex: go from one to the other within it, on a path in general position
   (through no vertex, and through no point where segments cross in projection). Where f gets
   hidden, at q, some facet x comes to be nearer. (a) x begins at q, at an edge: nearer than f, or
   as near. If x does not continue there, or turns back, that is an event edge. If x continues as y,
   facing the same way, y is on the path before q and not nearer than f: so the edge is in f's plane
   at q; where y or x is coplanar with f the edge is an event by definition, else both meet the
   inside of f, and that segment is an event. (b) x passes through f at q: they meet there in a
   segment, which is an event. In each case the event is as near as f at q, or nearer, and f is the
   nearest before q: if something nearer than the event stood at q, it would have hidden f before q,
   or be such an x itself. So P meets a visible event. []

   Claim 2. If P meets no visible event, facets that share an edge which is no event are both
   visible in P or both hidden where the edge passes through the inside of P. Proof: as above,
   across a general point q of the edge: f before it, g behind it. If x hides g beyond q, but not f
   before, then as in (a) and (b), or x continues as y and the edge between them passes through q:
   in general position the two edges lie in one line. If they are one edge, it has more than two
   facets, and is an event. Else an end of one lies inside the other, which thereby is an event. []

   Claim 3. Let the sample of P be owned by a facet, nearer than depth t there; let all events in P
   be farther than t; and let no facet pass through the depth t within P. Then P meets no visible
   event. Proof: go from the sample to a visible event of P, along a straight line in general
   position, as far as the first visible event. Until then the nearest surface goes on without a
   jump (a jump is a visible event), so its depth is never t: it stays nearer. So then is that
   event, as near as the surface up to it, or nearer. []

   Claim 4. If one facet covers all of P, and all events in P are farther than all of that facet in
   P, then P meets no visible event; and facets farther than all of it in P are hidden there,
   whatever the events.

   Claim 5. What shows of a facet f in P changes only across events over the inside of f: so not
   where all events in P are sides of f. Proof: q in claim 1 lies on the event and inside f. []

   So the events are drawn into the pixels that they may touch, each with the nearest depth that it
   may have there (float, rounded to the laser). A pixel is mixed unless it has no event or claim 3,
   with t midway between the sample and the nearest event, or claim 4 clears it; a facet takes it as
   not mixed also where claim 5 clears it. A facet that touches no mixed pixel is visible or hidden
   as one: any sample that it covers tells, and where it covers none, facets across its sides (claim
   2), or a t (what is farther than t is hidden in P). It keeps its exact area. Of the others, what
   lies in mixed pixels is in doubt, and what lies in pixels of which nothing tells. */
#ifndef LRCSI_ZBUFFER_H
#define LRCSI_ZBUFFER_H

#include "visibility/visible.h"

/* What a run tells beside the areas. */
typedef struct lrcsi_zbuffer {
    uint32_t partial; /* facets whose areas are not exact */
    int undecided;    /* 1 where some depth could not be told */
} lrcsi_zbuffer;

/* Bytes at most. */
size_t lrcsi_zbuffer_need(const lrcs_prepared *prepared, uint32_t size);

/* Finds visible[facet_count] from size x size samples. Given: answer[facet_count], what exact
   queries tell of facets (a lrcsi_query_answer; visibility/query.h), or NULL: it serves facets that
   samples leave in doubt. Status: LRCS_OK; LRCS_E_MEMORY. Nothing stays in the work area. */
int lrcsi_zbuffer_make(const lrcsi_view *view, uint32_t size, const unsigned char *answer,
                       lrcs_work *work, lrcsi_visible *visible, lrcsi_zbuffer *zbuffer);

#endif
