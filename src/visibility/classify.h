/* SPDX-License-Identifier: MIT */
/* Which facets are seen wholly or not at all, and which only in part.

   Along a path over the inside of a facet i, the number of surfaces in front of it can change only
   where the path crosses, in projection,
     (1) an event edge (visibility/event.h) nearer than i; or
     (2) a point where another facet touches the inside of i itself (mesh/intersection.h); a
   coplanar facet that i beats hides nothing. A facet that meets neither is uniform: one exact
   sample tells whether all of it is visible. The others are undecided, and so are facets that many
   events might cross but are not asked whether they do. All decisions are exact, so a uniform facet
   is certain.

   Uniform facets are seen alike where they share an edge that is no event edge, along which no
   nearer event edge lies in projection, and which nothing else meets in space: a path from one
   into the other, through a point of the shared edge where nothing else is, meets neither (1) nor
   (2). They form regions, of which one sample tells all.

   Edges that are no event edges join facets into components, which end at event edges only. A
   component in front of one point of facet i, none of whose edges crosses i nearer than it and none
   of whose facets touches its inside, is in front of all of it: then i is hidden, however undecided
   (visibility/query.h). */
#ifndef LRCSI_CLASSIFY_H
#define LRCSI_CLASSIFY_H

#include "base/meter.h"
#include "visibility/event.h"
#include "visibility/grid.h"

/* An event edge's box in the view, and who asked about it last. */
typedef struct lrcsi_event_box {
    lrcsi_view_box box;
    uint32_t edge;
    uint32_t asked;
} lrcsi_event_box;

typedef struct lrcsi_classification {
    const lrcsi_view *view;
    lrcsi_events events;
    lrcsi_event_box *event; /* one for each */
    lrcsi_grid grid;        /* of events */
    lrcsi_boxes boxes;      /* of facets: of undecided ones, and of others that were asked about */
    uint32_t asked;         /* scratch: searches so far */
    int along;              /* scratch: the last search met an event along a side of the facet */
    uint32_t *crossing;     /* scratch: what crosses facet `crossed`, `crossings` of them */
    uint32_t crossed, crossings;
    uint32_t *component; /* facet -> its component, named by its first facet; itself if it casts
                            nothing */
    uint32_t *region; /* facet -> the region of uniform facets that it is in, likewise named, once
                         lrcsi_classify_regions has been called */
    signed char *joinable; /* facet: its facing if it can hide others, else 0: neighbours that face
                              alike join one component */
    unsigned char *undecided; /* facet: 1 undecided; 0 uniform, or of no area in this view */
    uint32_t undecided_count;
} lrcsi_classification;

/* Bytes at most. */
size_t lrcsi_classify_need(const lrcs_prepared *prepared);

/* Decides every facet that faces either way (front ones only where back sides are never seen). Once
   the meter is spent all others count as undecided.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. The result stays in the work area. */
int lrcsi_classify_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_classification *classification);

/* Names the regions. */
void lrcsi_classify_regions(const lrcsi_classification *classification);

/* The event edges that cross the inside of a facet, nearer than it somewhere: their count; the
   topology edges are then in classification->crossing. The facet last asked about costs no search.
   Where the meter is spent some may be missing; NULL: there is no limit. */
uint32_t lrcsi_classify_crossings(lrcsi_classification *classification, uint32_t facet,
                                  lrcsi_meter *meter);

/* Does an event edge of a component cross a facet, nearer than it somewhere? Where the meter is
   spent, perhaps. Asked first, this is cheaper than all crossings. */
int lrcsi_classify_crossed_by(lrcsi_classification *classification, uint32_t facet,
                              uint32_t component, lrcsi_meter *meter);

/* Can the facet of a contact hide some of the facet that it touches? */
int lrcsi_intersection_hides(const lrcsi_view *view, uint32_t facet,
                             const lrcsi_intersection *touch);

#endif
