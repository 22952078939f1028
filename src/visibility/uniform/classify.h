/* SPDX-License-Identifier: MIT */
/* Which facets are uniform: entirely visible or entirely hidden, so that one exact sample decides
   all of it; and which are undecided, because they may be visible in part. Two more facts let one
   sample decide more than one facet:
   - uniform facets connected across edges form regions that are all visible or all hidden;
   - facets connected across edges that are not event edges form surface components. One that is in
     front of a point of a facet, and that neither ends in front of the facet nor meets its
     interior, hides all of it (visibility/uniform/query.h). */
#ifndef LRCSI_CLASSIFY_H
#define LRCSI_CLASSIFY_H

#include "visibility/index/event.h"
#include "visibility/uniform/crossing.h"

typedef struct lrcsi_classification {
    const lrcsi_view *view;
    uint32_t casters;          /* the number of facets that can hide others */
    lrcsi_events events;       /* nearest first, by their boxes */
    lrcsi_event_search search; /* with the boxes of undecided facets, and of others that were
                                  tested */
    uint32_t *component;       /* facet: the first facet of its component; itself if it can hide
                                  nothing */
    unsigned char *undecided;  /* facet: 1 undecided; 0 uniform, or it has no area in this view */
    uint32_t undecided_count;
    lrcsi_facet_signs joinable; /* facet: as view->cast, but 0 if it is undecided, or if something
                                   runs along one of its sides. Groups of such facets
                                   (lrcsi_events_join) are the regions of uniform facets */
    const lrcsi_grid *facets;   /* of all facets that can hide others; NULL if it is not made */
} lrcsi_classification;

/* Bytes at most. */
size_t lrcsi_classify_need(const lrcs_prepared *prepared);

/* Classifies every facet that can hide others. Once the meter is spent, all remaining facets count
   as undecided. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. The result stays in the work area. */
int lrcsi_classify_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_classification *classification);

/* Makes the grid of all facets that can hide others, for several users; otherwise each makes the
   part that it needs. It stays in the work area, and is not made if that has no room for it. */
size_t lrcsi_classify_facets_need(const lrcs_prepared *prepared);
void lrcsi_classify_facets(lrcsi_classification *classification, lrcs_work *work);

#endif
