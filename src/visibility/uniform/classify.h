/* SPDX-License-Identifier: MIT */
/* Which facets are entirely visible or entirely hidden, and which may be visible in part.

   Consider a path over the interior of a facet i. The number of surfaces in front of i can change
   along it only where the path, in projection, crosses
     (1) an event edge (visibility/index/event.h) that is nearer than i; or
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
   hidden, even if other event edges leave it undecided (visibility/uniform/query.h). */
#ifndef LRCSI_CLASSIFY_H
#define LRCSI_CLASSIFY_H

#include "visibility/index/event.h"
#include "visibility/uniform/crossing.h"

typedef struct lrcsi_classification {
    const lrcsi_view *view;
    lrcsi_events events; /* nearest first, by their boxes */
    lrcsi_event_search
        search;        /* has the boxes of undecided facets, and of others that were tested */
    signed char *cast; /* facet: its facing if it can hide others, otherwise 0 */
    uint32_t
        *component; /* facet: the first facet of its component; itself if it can hide nothing */
    unsigned char *undecided; /* facet: 1 undecided; 0 uniform, or it has no area in this view */
    uint32_t undecided_count;
    signed char *joinable; /* facet: its facing if it is uniform and nothing runs along its sides,
                              otherwise 0 */
} lrcsi_classification;

/* Bytes at most. */
size_t lrcsi_classify_need(const lrcs_prepared *prepared);

/* Classifies every facet that can hide others. Once the meter is spent, all remaining facets count
   as undecided. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. The result stays in the work area. */
int lrcsi_classify_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_classification *classification);

/* Finds regions of uniform facets: region[f] is the first facet of that of facet f; there are
   lrcsi_meshlets_room entries. */
void lrcsi_classify_regions(const lrcsi_classification *classification, uint32_t *region);

#endif
