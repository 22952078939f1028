/* SPDX-License-Identifier: MIT */
/* Which facets are entirely visible or entirely hidden, and which may be visible in part.

   Consider a path over the interior of a facet i. The number of surfaces in front of i can change
   along it only where the path, in projection, crosses
     (1) an event edge (visibility/event.h) that is nearer than i; or
     (2) a point where another facet meets the interior of i in space (mesh/contact/intersection.h).
   A coplanar facet over which i has precedence hides nothing. A facet that nothing of this kind
   crosses is uniform: one exact sample decides whether all of it is visible. The others are
   undecided, and so are facets near so many events that these are not all tested. All tests are
   exact, so what is stated of a uniform facet is certain.

   Two uniform facets are both visible or both hidden if they share an edge that is not an event
   edge, if no nearer event edge runs along it in projection, and if nothing else meets it in space:
   a path from one into the other, through a point of the shared edge, crosses neither (1) nor (2).
   They form regions, and one sample decides for a whole region.

   Edges that are not event edges connect facets to components, which end at event edges only. If a
   component is in front of one point of facet i, none of its event edges crosses i in front of it,
   and none of its facets meets the interior of i, the component is in front of all of i. Then i is
   hidden, even if other event edges leave it undecided (visibility/query.h). */
#ifndef LRCSI_CLASSIFY_H
#define LRCSI_CLASSIFY_H

#include "base/meter.h"
#include "visibility/event.h"
#include "visibility/grid.h"

/* The box of an event edge in the view, and the last search that tested it. */
typedef struct lrcsi_event_box {
    lrcsi_view_box box;
    uint32_t edge;
    uint32_t last_search;
} lrcsi_event_box;

typedef struct lrcsi_classification {
    const lrcsi_view *view;
    lrcsi_events events;
    lrcsi_event_box *event; /* one for each event */
    lrcsi_grid grid;        /* of events */
    lrcsi_boxes boxes;      /* of facets: of undecided ones, and of others that were tested */
    uint32_t searches;      /* scratch: the number of searches so far */
    int event_along_side;   /* scratch: the last search met an event along a side of the facet */
    uint32_t *crossing;     /* scratch: the `crossings` event edges that cross facet `crossed` */
    uint32_t crossed, crossings;
    uint32_t
        *component;   /* facet: the first facet of its component; itself if it can hide nothing */
    uint32_t *region; /* facet: the first facet of its region of uniform facets, once
                         lrcsi_classify_regions has been called */
    signed char *joinable; /* facet: its facing if it is uniform and nothing runs along its sides,
                              otherwise 0; before facets are decided, its facing if it can hide
                              others */
    unsigned char *undecided; /* facet: 1 undecided; 0 uniform, or it has no area in this view */
    uint32_t undecided_count;
} lrcsi_classification;

/* Bytes at most. */
size_t lrcsi_classify_need(const lrcs_prepared *prepared);

/* Classifies every facet that can hide others. Once the meter is spent, all remaining facets count
   as undecided. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. The result stays in the work area. */
int lrcsi_classify_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_classification *classification);

/* Makes classification->region. */
void lrcsi_classify_regions(const lrcsi_classification *classification);

/* Finds the event edges that cross the interior of a facet and are nearer than it somewhere.
   Returns how many there are; classification->crossing lists them as topology edges. They are kept
   until another facet is searched. Some may be missing if the meter is spent; NULL: no limit. */
uint32_t lrcsi_classify_crossings(lrcsi_classification *classification, uint32_t facet,
                                  lrcsi_meter *meter);

/* Does an event edge of a component cross a facet, nearer than it somewhere? Returns 1 too if the
   meter is spent. Cheaper than finding all crossings first. */
int lrcsi_classify_crossed_by(lrcsi_classification *classification, uint32_t facet,
                              uint32_t component, lrcsi_meter *meter);

/* Can the other facet of a contact hide a part of the facet? */
int lrcsi_intersection_hides(const lrcsi_view *view, uint32_t facet,
                             const lrcsi_intersection *contact);

#endif
