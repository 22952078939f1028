/* SPDX-License-Identifier: MIT */
/* Event edges of a view: all edges except those with exactly two facets, one on each side of the
   edge in projection. They are contour edges, boundary edges, and edges of three or more facets.
   Facets that cannot hide anything do not count. */
#ifndef LRCSI_EVENT_H
#define LRCSI_EVENT_H

#include "scene/meshlets.h"
#include "view/view.h"

typedef struct lrcsi_events {
    uint32_t *edge; /* topology edges, ascending */
    uint32_t count;
} lrcsi_events;

/* The facets on an edge: those that can hide something in the view or, of one part, all live
   ones. */
typedef struct lrcsi_edge_facets {
    uint32_t count;
    uint32_t facet[2];    /* the first two of them; LRCS_NONE for those that do not exist */
    uint32_t forward;     /* how many traverse the edge from low to high */
    uint32_t left, right; /* how many lie to the left of it in projection, looking from low to high,
                             and how many to the right; the others are edge-on */
    uint32_t fronts;      /* how many face the laser */
} lrcsi_edge_facets;

/* part: LRCS_NONE, or a part of the scene. A facet lies to the left of its side in projection if it
   faces the laser, otherwise to the right. */
static inline lrcsi_edge_facets lrcsi_edge_facets_of(const lrcsi_view *view, uint32_t edge,
                                                     uint32_t part)
{
    const lrcs_prepared *p = view->prepared;
    const lrcsi_topology *t = &p->topology;
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    lrcsi_edge_facets on = {.facet = {LRCS_NONE, LRCS_NONE}};
    for (uint32_t i = 0; i < t->edge[edge].uses; i++) {
        uint32_t f = use[i].facet;
        if (part == LRCS_NONE ? lrcsi_view_casts(view, f)
                              : p->scene->facet_part[f] == part && !p->skip[f]) {
            int side = use[i].forward ? view->facing[f] : -view->facing[f];
            if (on.count < 2) {
                on.facet[on.count] = f;
            }
            on.count++;
            on.forward += use[i].forward;
            on.left += side > 0;
            on.right += side < 0;
            on.fronts += view->facing[f] > 0;
        }
    }
    return on;
}

/* Does the edge bound a part, given its facets of that part: a rim? */
static inline int lrcsi_edge_is_rim(const lrcsi_edge_facets *on)
{
    return on->count == 1;
}

/* Do two facets continue each other in the view across a plain edge (scene/neighbours.h), so that
   it is no event edge? Given: of each the direction in which it faces if it can hide something,
   otherwise 0. */
static inline int lrcsi_event_continues(int cast, int other)
{
    return cast != 0 && other == cast;
}

enum lrcsi_edge_kind {
    LRCSI_EDGE_UNUSED, /* none of its facets can hide anything */
    LRCSI_EDGE_JOINS,  /* exactly two can, on opposite sides of it in projection */
    LRCSI_EDGE_EVENT
};

/* The kind of an edge with any number of facets, and these. part: as above; the other parts are
   ignored. Its facets count whether or not they can hide anything, and two facets are joined only
   if their winding is consistent and they are not edge-on: the true surface of the part continues
   from one to the other. */
int lrcsi_edge_kind_of(const lrcsi_view *view, uint32_t edge, uint32_t part,
                       lrcsi_edge_facets *facets);

size_t lrcsi_events_need(const lrcs_prepared *prepared);

/* Returned: events, which stay in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_events_make(const lrcsi_view *view, lrcs_work *work, lrcsi_events *events);

/* What lrcsi_events_join does with the facets of a meshlet. */
enum lrcsi_join {
    LRCSI_JOINED_NONE, /* joins none of them */
    LRCSI_JOINED_ALL,  /* joins all of them into one group */
    LRCSI_JOINED_SOME  /* joins some, all or none, which is not known in advance */
};

static inline int lrcsi_events_joined(const lrcs_prepared *p, const lrcsi_facet_signs *joinable,
                                      uint32_t meshlet)
{
    const int sign = joinable->meshlet[meshlet];
    return sign == 0                                                   ? LRCSI_JOINED_NONE
           : sign != LRCSI_MESHLET_MIXED && p->meshlets.whole[meshlet] ? LRCSI_JOINED_ALL
                                                                       : LRCSI_JOINED_SOME;
}

/* Joins facets into groups (base/disjoint.h) across all edges that are not event edges.
   Given: joinable, as view->cast, but also 0 for facets that are not to be joined. Returned: the
   first facet of each facet's group; group[] has lrcsi_meshlets_room entries. */
void lrcsi_events_join(const lrcsi_view *view, const lrcsi_facet_signs *joinable, uint32_t *group);

#endif
