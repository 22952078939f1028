/* SPDX-License-Identifier: MIT */
/* Lists event edges part by part: an edge that two parts share may be one for either, or for both.
   What they change is not decided here (visibility/proximity/proximity_band.c). */
#include "visibility/proximity/proximity_events.h"

#include "base/work.h"
#include "visibility/index/event.h"

/* The number of buckets of the grid for each event edge: the many short edges of a rim lie in few
   of them. Heuristic: any grid finds the same. */
#define EVENT_BUCKETS 4u
/* Room for the entries of edges in buckets; with more, buckets are made larger. */
#define EVENT_ENTRIES 8u

/* Is an edge a rim of the part, or has it a facet that counts: one that is not edge-on and, if the
   part is closed, faces the laser (visibility/proximity/proximity_band.c, 1.a)? Given: its facets
   of that part. */
static int edge_matters(const lrcs_part *part, const lrcsi_edge_facets *on)
{
    return lrcsi_edge_is_rim(on) || (part->solid ? on->fronts : on->left + on->right) > 0;
}

/* Lists all events, each pair once; only counts them if events->edge is NULL. */
static void list_events(const lrcsi_view *view, lrcsi_proximity_events *events)
{
    const lrcsi_topology *topology = &view->prepared->topology;
    const uint32_t *facet_part = view->prepared->scene->facet_part;
    events->count = 0;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        const lrcsi_edge *edge = &topology->edge[e];
        const lrcsi_edge_use *use = topology->use + edge->first_use;
        for (uint32_t i = 0; i < edge->uses; i++) {
            uint32_t part = facet_part[use[i].facet];
            lrcsi_edge_facets on;
            int met = 0;
            for (uint32_t k = 0; k < i && !met; k++) {
                met = facet_part[use[k].facet] == part;
            }
            if (met || lrcsi_edge_kind_of(view, e, part, &on) != LRCSI_EDGE_EVENT ||
                !edge_matters(&view->prepared->scene->part[part], &on)) {
                continue;
            }
            if (events->edge) {
                events->edge[events->count] = e;
                events->part[events->count] = part;
                events->side[events->count] = (signed char)((on.left > 0) - (on.right > 0));
            }
            events->count++;
        }
    }
}

/* Pairs of an edge and a part that has a facet on it. */
size_t lrcsi_proximity_events_most(const lrcs_prepared *p)
{
    const lrcsi_topology *topology = &p->topology;
    const uint32_t *part = p->scene->facet_part;
    size_t count = topology->edge_count;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        const lrcsi_edge_use *use = topology->use + topology->edge[e].first_use;
        for (uint32_t i = 1; i < topology->edge[e].uses; i++) {
            count += part[use[i].facet] != part[use[i - 1].facet];
        }
    }
    return count;
}

size_t lrcsi_proximity_events_need(size_t count)
{
    size_t need =
        lrcsi_work_add(lrcsi_work_blocks(2, count, sizeof(uint32_t)), lrcsi_work_bytes(count, 1));
    return lrcsi_work_add(need, lrcsi_grid_need(EVENT_BUCKETS * count, EVENT_ENTRIES * count));
}

int lrcsi_proximity_events_make(const lrcsi_view *view, lrcs_work *work,
                                lrcsi_proximity_events *events)
{
    *events = (lrcsi_proximity_events){.count = 0};
    list_events(view, events);
    uint32_t *edge = lrcsi_work_take(work, events->count, sizeof *edge);
    events->part = lrcsi_work_take(work, events->count, sizeof *events->part);
    events->side = lrcsi_work_take(work, events->count, sizeof *events->side);
    if (!edge || !events->part || !events->side) {
        return LRCS_E_MEMORY;
    }
    events->edge = edge;
    list_events(view, events);
    events->grid = lrcsi_grid_empty(view, EVENT_BUCKETS * events->count);
    return lrcsi_grid_edges(events->edge, events->count, EVENT_ENTRIES * (uint64_t)events->count,
                            work, &events->grid);
}
