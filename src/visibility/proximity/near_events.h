/* SPDX-License-Identifier: MIT */
/* The event edges near each facet: listed from the grid for the facets of a meshlet together, then
   for each facet from that list. */
#ifndef LRCSI_NEAR_EVENTS_H
#define LRCSI_NEAR_EVENTS_H

#include "visibility/index/marks.h"
#include "visibility/proximity/event_band.h"

typedef struct lrcsi_near_events {
    const lrcsi_event_bands *bands;
    lrcsi_marks considered; /* events: those that the search for the meshlet has met */
    uint32_t *meshlet;      /* events near a facet of the meshlet */
    uint32_t meshlet_count;
    int complete;     /* 0: the limit of steps was reached */
    uint32_t *listed; /* events near the facet */
    uint32_t count;
} lrcsi_near_events;

/* Upper bound of the bytes for it. It stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
size_t lrcsi_near_events_need(const lrcs_prepared *prepared);
int lrcsi_near_events_make(const lrcsi_event_bands *bands, lrcs_work *work,
                           lrcsi_near_events *near);

/* Lists the event edges near some facets of a meshlet. */
void lrcsi_near_events_of_meshlet(lrcsi_near_events *near, const uint32_t *facet, uint32_t count);

/* Lists those near one of these facets, in listed[0..count). Given: its search. Those of its own
   part are left out unless the laser sees its inside (event_band.c, 3). Returns 0 if the limit of
   steps is reached, now or for the meshlet. */
int lrcsi_near_events_of_facet(lrcsi_near_events *near, uint32_t facet,
                               const lrcsi_band_search *where);

#endif
