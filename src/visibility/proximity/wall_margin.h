/* SPDX-License-Identifier: MIT */
/* Straight walls behind the outlines of true curved shapes and of their facets: in the margins
   along event edges where nothing else is near, how much more of each facet the true shapes leave
   visible than the facets do. */
#ifndef LRCSI_WALL_MARGIN_H
#define LRCSI_WALL_MARGIN_H

#include "visibility/proximity/margin_facets.h"
#include "visibility/uniform/classify.h"

/* Of a facet. Areas are in projection, scaled. */
typedef struct lrcsi_wall_margin {
    double area;     /* what the true shapes leave visible, less what their facets leave */
    double area_max; /* bound on the area in the margins: F may vary over it */
    double area_far; /* the same of those that may be on other facets */
    double area_err; /* bound on the error of `area`, which is attributed to the facet: a part of it
                        may be on other facets */
    uint32_t sectors;  /* so many sectors away from the facet's own these may be, at most */
    double gain, loss; /* the fractions of lrcsi_proximity_band beside these margins */
} lrcsi_wall_margin;

/* What is known of an event edge over a wall. More parts are not kept: heuristic. */
#define LRCSI_WALL_PARTS 4
typedef struct lrcsi_wall_event {
    uint32_t part; /* whose wall was examined last; LRCS_NONE: none was */
    int count;     /* so many parts of the edge are known: their margins are */
    lrcsi_segment_part known[LRCSI_WALL_PARTS];
} lrcsi_wall_event;

/* The search for margins, facet by facet. */
typedef struct lrcsi_wall_margins {
    lrcsi_event_bands *bands;
    const lrcsi_classification *classification;
    lrcsi_wall_margin *margin;  /* facet: to be filled */
    lrcsi_wall_event *event;    /* event */
    lrcsi_margin_facets facets; /* those of the edge under examination */
    lrcsi_outline outline;      /* of this edge; its k is at least delta */
} lrcsi_wall_margins;

/* Scratch memory for it. */
size_t lrcsi_wall_margins_need(const lrcs_prepared *prepared);

/* Begins the search, given room for the margins of all facets, which become 0. It stays in the work
   area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_wall_margins_make(lrcsi_event_bands *bands, const lrcsi_classification *classification,
                            lrcs_work *work, lrcsi_wall_margin *margin,
                            lrcsi_wall_margins *margins);

/* Adds the margins of an event edge to the facets of the wall on which a facet near it lies, unless
   that was done before. Returns 1 if they are known wherever the edge is near this facet. Facets
   must be given part by part: of each event only the last part is remembered, and its margins would
   be added twice. */
int lrcsi_wall_margins_add(lrcsi_wall_margins *margins, uint32_t facet, uint32_t event);

/* Ends the search: adds what proofs of order leave open of the facets with margins to their error.
   */
void lrcsi_wall_margins_finish(const lrcsi_wall_margins *margins);

#endif
