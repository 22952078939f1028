/* SPDX-License-Identifier: MIT */
/* Event edges: those whose facets do not continue each other in a view, that is, not exactly two,
   one on each side of the edge in projection (contours, rims, and edges of three or more facets).
   Facets that cannot hide anything do not count. */
#ifndef LRCSI_EVENT_H
#define LRCSI_EVENT_H

#include "view/view.h"

typedef struct lrcsi_events {
    uint32_t *edge; /* topology edges, ascending */
    uint32_t count;
} lrcsi_events;

size_t lrcsi_events_need(const lrcs_prepared *prepared);

/* Given cast[facet]: which way it faces where it can hide something, else 0; one more 0 at the end.
   Status: LRCS_OK; LRCS_E_MEMORY. The result stays in the work area. */
int lrcsi_events_make(const lrcsi_view *view, const signed char *cast, lrcs_work *work,
                      lrcsi_events *events);

/* Joins facets into groups (base/join.h) across the edges that are no event edges. Given
   joinable[facet]: like cast, but 0 too for a facet that is to stay alone. */
void lrcsi_events_join(const lrcsi_view *view, const signed char *joinable, uint32_t *group);

#endif
