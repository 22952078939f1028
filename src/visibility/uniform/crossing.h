/* SPDX-License-Identifier: MIT */
/* The event edges of a view (visibility/index/event.h) that cross a facet: in projection they run
   through its interior, and somewhere they are nearer than it. */
#ifndef LRCSI_CROSSING_H
#define LRCSI_CROSSING_H

#include "base/meter.h"
#include "visibility/index/grid.h"

/* The box of an event edge in the view, and the number of the last search that tested it. */
typedef struct lrcsi_event_box {
    lrcsi_view_box box;
    uint32_t edge;
    uint32_t last_search;
} lrcsi_event_box;

/* What searches for crossings read, and their marks: the only thing that a search changes. */
typedef struct lrcsi_event_search {
    const lrcsi_view *view;
    const uint32_t *component; /* facet: the first facet of its component */
    lrcsi_boxes boxes;      /* of facets; those of facets that are searched must have been opened */
    lrcsi_grid grid;        /* of events */
    uint32_t events;        /* how many there are */
    lrcsi_event_box *event; /* one for each event; nearest first */
    uint32_t searches;      /* how many there were; begins again at 1 after 2^32 - 1 */
} lrcsi_event_search;

/* Begins a search, and returns its number, which is the last of no event. When numbers begin again,
   the last search of all events becomes 0, which is the number of none. */
static inline uint32_t lrcsi_event_search_begin(lrcsi_event_search *search)
{
    if (search->searches == UINT32_MAX) {
        for (uint32_t i = 0; i < search->events; i++) {
            search->event[i].last_search = 0;
        }
        search->searches = 0;
    }
    return ++search->searches;
}

/* The event edges that cross one facet. */
typedef struct lrcsi_crossings {
    uint32_t facet; /* whose they are; LRCS_NONE: none was searched, or some may be missing, because
                       the meter was spent */
    uint32_t count;
    uint32_t *edge; /* topology edges; room for all events */
} lrcsi_crossings;

/* Bytes at most. */
size_t lrcsi_crossings_need(const lrcs_prepared *prepared);

/* Makes room for the crossings of any facet, and has those of none. Status: LRCS_OK; LRCS_E_MEMORY.
   The room stays in the work area. */
int lrcsi_crossings_make(const lrcsi_event_search *search, lrcs_work *work,
                         lrcsi_crossings *crossings);

enum lrcsi_candidates_state {
    LRCSI_CANDIDATES_NOT_SOUGHT,
    LRCSI_CANDIDATES_KNOWN,
    LRCSI_CANDIDATES_UNKNOWN /* not all were found, because a limit was reached */
};

/* The events that may cross a facet of a meshlet, or run along a side of one. They are sought once
   the search for one of its facets has examined many events. */
#define LRCSI_CROSSING_CANDIDATES 256u
typedef struct lrcsi_crossing_candidates {
    int state;         /* a lrcsi_candidates_state */
    uint32_t examined; /* events examined for the last facet */
    uint32_t count;
    uint32_t event[LRCSI_CROSSING_CANDIDATES];
} lrcsi_crossing_candidates;

/* May any event edge cross a facet? Returns 1 too if a limit is reached, or if the meter is spent.
   Also returned: *along_side, 1 if an event edge in front of the facet may run along one of its
   sides. Given, and changed: the candidates of its meshlet, with `state` and `examined` 0 at first;
   the meshlet must have been opened. */
int lrcsi_crossings_possible(lrcsi_event_search *search, uint32_t facet, lrcsi_meter *meter,
                             lrcsi_crossing_candidates *candidates, int *along_side);

/* Finds the crossings of a facet, unless they are there already. Some may be missing if the meter
   is spent; NULL: no limit. */
void lrcsi_crossings_find(lrcsi_event_search *search, uint32_t facet, lrcsi_meter *meter,
                          lrcsi_crossings *crossings);

/* Does an event edge of a component cross a facet? Returns 1 too if the meter is spent. If the
   crossings of the facet are known, it is found among them; otherwise the search ends at the first
   one, which is cheaper than to find all. */
int lrcsi_crossings_of_component(lrcsi_event_search *search, uint32_t facet, uint32_t component,
                                 lrcsi_meter *meter, const lrcsi_crossings *known);

#endif
