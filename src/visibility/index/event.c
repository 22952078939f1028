/* SPDX-License-Identifier: MIT */
/* Which edges are event edges in a view and which join two facets of one surface, from the
   directions in which their facets face. What event edges cross is decided elsewhere. */
#include "visibility/index/event.h"

#include <string.h>

#include "base/disjoint.h"
#include "base/work.h"
#include "visibility/index/marks.h"

/* --- one edge --------------------------------------------------------------------------------- */

/* Two facets lie on opposite sides of an edge if and only if they traverse it in opposite
   directions and face the same way, or in the same direction and face opposite ways (as where the
   winding of a surface changes). */
int lrcsi_edge_kind_of(const lrcsi_view *view, uint32_t edge, uint32_t part,
                       lrcsi_edge_facets *facets)
{
    *facets = lrcsi_edge_facets_of(view, edge, part);
    int opposite = facets->left == 1 && facets->right == 1 && facets->count == 2;
    int continues = part == LRCS_NONE || facets->forward == 1;
    return facets->count == 0      ? LRCSI_EDGE_UNUSED
           : opposite && continues ? LRCSI_EDGE_JOINS
                                   : LRCSI_EDGE_EVENT;
}

/* --- all edges -------------------------------------------------------------------------------- */

/* Do all facets of the meshlets around a meshlet have the same sign as all of its own facets? */
static int meshlet_surrounded(const lrcs_prepared *p, const lrcsi_facet_signs *cast,
                              uint32_t meshlet)
{
    const signed char own = cast->meshlet[meshlet];
    for (uint32_t i = p->meshlets.first_link[meshlet]; i < p->meshlets.first_link[meshlet + 1];
         i++) {
        uint32_t other = p->meshlets.link[i];
        if ((other == LRCS_NONE ? 0 : cast->meshlet[other]) != own) {
            return 0;
        }
    }
    return 1;
}

/* Marks events among the plain edges: those of facets of which at least one can hide others, and
   that do not continue each other. A meshlet whose facets all have the same sign as those around
   it has none. */
static void mark_plain(const lrcs_prepared *p, const lrcsi_facet_signs *signs, unsigned char *mark)
{
    const signed char *cast = signs->facet;
    uint32_t count = p->scene->facet_count;
    for (uint32_t m = 0; m < p->meshlets.count; m++) {
        uint32_t start = m * LRCSI_MESHLET_FACETS;
        uint32_t end = lrcsi_meshlet_end(start, count);
        int alike = signs->meshlet[m] != LRCSI_MESHLET_MIXED;
        for (uint32_t f = start; f < end && !alike; f++) {
            for (int k = 0; k < 3; k++) {
                uint32_t other = p->neighbours.facet[f].corner[k];
                if (other >= start && other < end && cast[f] != 0 &&
                    !lrcsi_event_continues(cast[f], cast[other])) {
                    mark[p->topology.facet_edge[f].corner[k]] = 1;
                }
            }
        }
        if (alike && meshlet_surrounded(p, signs, m)) {
            continue;
        }
        for (uint32_t i = p->meshlets.meshlet[m].first_side;
             i < p->meshlets.meshlet[m + 1].first_side; i++) {
            const lrcsi_meshlet_side *side = &p->meshlets.side[i];
            if ((cast[side->facet] | cast[side->other]) != 0 &&
                !lrcsi_event_continues(cast[side->facet], cast[side->other])) {
                mark[side->edge] = 1;
            }
        }
    }
}

size_t lrcsi_events_need(const lrcs_prepared *prepared)
{
    const size_t edges = prepared->topology.edge_count;
    return lrcsi_work_add(lrcsi_work_bytes(edges, 1), lrcsi_work_bytes(edges, sizeof(uint32_t)));
}

/* 1. Takes room for as many events as there are edges. 2. Marks events among plain edges, then
   among irregular ones. 3. Lists the marked edges, and returns the room that is not needed. */
int lrcsi_events_make(const lrcsi_view *view, lrcs_work *work, lrcsi_events *events)
{
    const lrcs_prepared *p = view->prepared;
    const lrcsi_neighbours *neighbours = &p->neighbours;
    size_t start = work->used;
    const uint32_t count = p->topology.edge_count;
    unsigned char *mark = lrcsi_work_take_zero(work, count, 1); /* edge: 1 if it is an event */
    size_t end = work->used;
    uint32_t *edge = lrcsi_work_take(work, count, sizeof *edge);
    if (!mark || !edge) {
        work->used = start;
        return LRCS_E_MEMORY;
    }
    mark_plain(p, &view->cast, mark);
    for (uint32_t i = 0; i < neighbours->irregular_count; i++) {
        lrcsi_edge_facets on;
        if (lrcsi_edge_kind_of(view, neighbours->irregular[i], LRCS_NONE, &on) ==
            LRCSI_EDGE_EVENT) {
            mark[neighbours->irregular[i]] = 1;
        }
    }
    events->count = 0;
    for (uint32_t e = 0; (e = lrcsi_marks_next(mark, e, count, 1)) < count; e++) {
        edge[events->count++] = e;
    }
    work->used = end;
    events->edge = lrcsi_work_take(work, events->count, sizeof *edge);
    return LRCS_OK;
}

/* --- groups ----------------------------------------------------------------------------------- */

/* The entry of a facet in group[]: in a meshlet whose facets are all joined, that of the first one.
 */
static inline uint32_t group_entry(const lrcs_prepared *p, const lrcsi_facet_signs *joinable,
                                   uint32_t facet)
{
    uint32_t meshlet = facet / LRCSI_MESHLET_FACETS;
    return lrcsi_events_joined(p, joinable, meshlet) == LRCSI_JOINED_ALL
               ? meshlet * LRCSI_MESHLET_FACETS
               : facet;
}

/* Sets group[facet] to the first facet of its group. Groups are named by their first facets, which
   are in this meshlet or in earlier meshlets that are finished already. */
static void groups_name(const lrcs_prepared *p, const lrcsi_facet_signs *joinable, uint32_t *group)
{
    uint32_t count = p->scene->facet_count;
    for (uint32_t m = 0; m < p->meshlets.count; m++) {
        uint32_t start = m * LRCSI_MESHLET_FACETS;
        int joined = lrcsi_events_joined(p, joinable, m);
        if (joined == LRCSI_JOINED_SOME) {
            for (uint32_t f = start; f < lrcsi_meshlet_end(start, count); f++) {
                group[f] = group[group[f]];
            }
            continue;
        }
        uint32_t step = joined == LRCSI_JOINED_NONE;
        uint32_t root = group[group[start]];
        for (uint32_t i = 0; i < LRCSI_MESHLET_FACETS; i++) {
            group[start + i] = root + step * i;
        }
    }
}

/* 1. Meshlet by meshlet, joins the facets of a meshlet among themselves, and then to earlier
   meshlets, while they are in the cache. The groups do not depend on the order. A meshlet that is
   joined as a whole is represented by its first facet. It is joined to the meshlets to which its
   sides lead; side by side only if one of these is joined in part. 2. Joins facets across irregular
   edges. 3. Names the groups. */
void lrcsi_events_join(const lrcsi_view *view, const lrcsi_facet_signs *joinable, uint32_t *group)
{
    const signed char *sign = joinable->facet;
    const lrcs_prepared *p = view->prepared;
    const lrcsi_meshlets *meshlets = &p->meshlets;
    for (uint32_t m = 0; m < meshlets->count; m++) {
        const uint32_t start = m * LRCSI_MESHLET_FACETS;
        const uint32_t end = lrcsi_meshlet_end(start, p->scene->facet_count);
        const int joined = lrcsi_events_joined(p, joinable, m);
        const int alike = joinable->meshlet[m] != LRCSI_MESHLET_MIXED;
        int by_sides = joined == LRCSI_JOINED_SOME;
        group[start] = start;
        for (uint32_t f = start; f < end && joined == LRCSI_JOINED_SOME; f++) {
            group[f] = alike ? start + meshlets->first[f] : f;
            for (int k = 0; k < 3 && !alike && sign[f] != 0; k++) {
                uint32_t other = p->neighbours.facet[f].corner[k];
                if (other >= start && other < f && sign[other] == sign[f]) {
                    lrcsi_disjoint_union(group, other, f);
                }
            }
        }
        for (uint32_t i = meshlets->first_link[m];
             i < meshlets->first_link[m + 1] && joined == LRCSI_JOINED_ALL && !by_sides; i++) {
            uint32_t other = meshlets->link[i];
            int its = other < m ? lrcsi_events_joined(p, joinable, other) : LRCSI_JOINED_NONE;
            by_sides = its == LRCSI_JOINED_SOME;
            if (its == LRCSI_JOINED_ALL && joinable->meshlet[other] == joinable->meshlet[m]) {
                lrcsi_disjoint_union(group, other * LRCSI_MESHLET_FACETS, start);
            }
        }
        for (uint32_t i = meshlets->meshlet[m].first_side;
             by_sides && i < meshlets->meshlet[m + 1].first_side; i++) {
            const lrcsi_meshlet_side *side = &meshlets->side[i];
            if (side->other < side->facet && sign[side->facet] != 0 &&
                sign[side->other] == sign[side->facet]) {
                lrcsi_disjoint_union(group, group_entry(p, joinable, side->other),
                                     group_entry(p, joinable, side->facet));
            }
        }
    }
    for (uint32_t i = 0; i < p->neighbours.irregular_count; i++) {
        lrcsi_edge_facets on;
        if (lrcsi_edge_kind_of(view, p->neighbours.irregular[i], LRCS_NONE, &on) ==
                LRCSI_EDGE_JOINS &&
            sign[on.facet[0]] != 0 && sign[on.facet[1]] != 0) {
            lrcsi_disjoint_union(group, group_entry(p, joinable, on.facet[0]),
                                 group_entry(p, joinable, on.facet[1]));
        }
    }
    groups_name(p, joinable, group);
}
