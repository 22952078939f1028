/* SPDX-License-Identifier: MIT */
/* The event edges of every part of a view, in a grid: pairs of an edge and a part for which it is
   one. */
#ifndef LRCSI_PROXIMITY_EVENTS_H
#define LRCSI_PROXIMITY_EVENTS_H

#include "visibility/index/grid.h"

typedef struct lrcsi_proximity_events {
    uint32_t *edge, *part; /* event: its topology edge, its part */
    signed char *side;     /* event: on which side of it, from low to high, the part's facets lie: 1
                              left, -1 right, 0 both or not known */
    uint32_t count;
    lrcsi_grid grid; /* its items are events */
} lrcsi_proximity_events;

/* An upper bound of the number of events; the bytes for so many. */
size_t lrcsi_proximity_events_most(const lrcs_prepared *prepared);
size_t lrcsi_proximity_events_need(size_t count);

/* They stay in the work area. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_proximity_events_make(const lrcsi_view *view, lrcs_work *work,
                                lrcsi_proximity_events *events);

#endif
