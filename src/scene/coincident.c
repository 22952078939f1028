/* SPDX-License-Identifier: MIT */
/* Decides which coincident facets are redundant, and which two are opposite: of opposite winding,
   each seen instead of the other from one side. Call the facets on the same three points a group.
   When the laser sees the fronts of the facets of one winding, it sees the backs of those of the
   other. They are at equal distance; of equally distant facets the first front in order is seen,
   else the first back that reflects, else the first back (visibility/base/sample.h).

   A group with both windings shows a front to every direction (except edge-on, where nothing is
   seen). So only the first facet of each winding is ever seen: the two are opposite facets. The one
   that faces away is entirely hidden by the other, and hides nothing that the other does not hide.

   In a group with one winding, a facet is never seen if an earlier one reflects from its back, or
   if there is an earlier one and the facet itself does not reflect from its back. In both cases the
   earlier one hides everything that the facet hides.

   Facets of a curved shape are not redundant, because the visibility of the true shape may differ
   from theirs. */
#include "scene/coincident.h"

#include "base/work.h"

/* The facets of a group that may be seen, by winding, each or LRCS_NONE. */
typedef struct coincident_group {
    uint32_t edge;      /* the lowest of the group's edges */
    uint32_t first[2];  /* the first facet */
    uint32_t second[2]; /* the first that reflects from its back, if first[] does not */
} coincident_group;

static int may_coincide(const lrcs_prepared *p, uint32_t facet)
{
    return !p->skip[facet] && !(p->scene->part[p->scene->facet_part[facet]].bounds.reach > 0);
}

static int reflects_back(const lrcs_prepared *p, uint32_t facet)
{
    return lrcsi_prepared_material(p, facet)->two_sided != 0;
}

/* The welded vertex of a facet that is not on one of its edges. */
static uint32_t vertex_opposite_edge(const lrcs_prepared *p, uint32_t facet, uint32_t edge)
{
    uint32_t k = lrcsi_topology_corner_opposite(&p->topology, facet, edge);
    return p->topology.weld[p->scene->facet[facet].corner[k]];
}

/* Does any facet share its lowest edge with another one that may be in the same group? */
static int any_may_coincide(const lrcs_prepared *p)
{
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        uint32_t lowest = lrcsi_topology_lowest_edge(&p->topology, f);
        if (lowest == LRCS_NONE || p->topology.edge[lowest].uses == 1) {
            continue;
        }
        const lrcsi_edge_use *use = p->topology.use + p->topology.edge[lowest].first_use;
        uint32_t other = use[0].facet == f ? use[1].facet : use[0].facet;
        if (p->topology.edge[lowest].uses > 2 ||
            (lrcsi_topology_lowest_edge(&p->topology, other) == lowest &&
             vertex_opposite_edge(p, f, lowest) == vertex_opposite_edge(p, other, lowest))) {
            return 1;
        }
    }
    return 0;
}

/* Adds a facet to its group; facets are added in order. */
static void group_add(lrcs_prepared *p, coincident_group *group, uint32_t facet, uint32_t winding)
{
    uint32_t *first = &group->first[winding];
    uint32_t *second = &group->second[winding];
    uint32_t opposite = group->first[!winding];
    if (*first == LRCS_NONE) {
        *first = facet;
    } else if (opposite == LRCS_NONE && *second == LRCS_NONE && reflects_back(p, facet) &&
               !reflects_back(p, *first)) {
        *second = facet;
    } else {
        p->redundant[facet] = LRCSI_REDUNDANT;
        return;
    }
    if (opposite == LRCS_NONE) {
        return;
    }
    const uint32_t pair[2] = {facet, opposite};
    for (int k = 0; k < 2; k++) {
        p->redundant[pair[k]] = LRCSI_REDUNDANT_FROM_BEHIND;
        if (p->opposite) {
            p->opposite[pair[k]] = pair[!k];
        }
    }
    if (group->second[!winding] != LRCS_NONE) {
        p->redundant[group->second[!winding]] = LRCSI_REDUNDANT;
    }
}

/* Forms the groups. The facets of a group share three edges, so they are all found at the lowest of
   these, where they have the same opposite vertex: group[vertex] is the latest group with that
   vertex. Returns whether any facet has an opposite. */
static int groups_make(lrcs_prepared *p, coincident_group *group)
{
    const lrcsi_topology *t = &p->topology;
    int pairs = 0;
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        group[v].edge = LRCS_NONE;
    }
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const lrcsi_edge_use *use = t->use + t->edge[e].first_use;
        for (uint32_t i = 0; i < t->edge[e].uses && t->edge[e].uses > 1; i++) {
            if (lrcsi_topology_lowest_edge(&p->topology, use[i].facet) != e ||
                !may_coincide(p, use[i].facet)) {
                continue;
            }
            coincident_group *at = &group[vertex_opposite_edge(p, use[i].facet, e)];
            if (at->edge != e) {
                *at = (coincident_group){e, {LRCS_NONE, LRCS_NONE}, {LRCS_NONE, LRCS_NONE}};
            }
            group_add(p, at, use[i].facet, use[i].forward);
            pairs |= at->first[0] != LRCS_NONE && at->first[1] != LRCS_NONE;
        }
    }
    return pairs;
}

size_t lrcsi_coincident_need(uint32_t vertex_count, uint32_t facet_count)
{
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(uint32_t)),
                          lrcsi_work_bytes(vertex_count, sizeof(coincident_group)));
}

/* Most scenes have no coincident facets; a quick test finds that out. If some facets have
   opposites, the groups are formed a second time, to store them. */
int lrcsi_coincident_mark(lrcs_prepared *p, lrcs_work *work)
{
    uint32_t facets = p->scene->facet_count;
    size_t mark = work->used;
    p->opposite = NULL;
    if (!any_may_coincide(p)) {
        return LRCS_OK;
    }
    coincident_group *group = lrcsi_work_take(work, p->scene->vertex_count, sizeof *group);
    if (!group) {
        return LRCS_E_MEMORY;
    }
    int pairs = groups_make(p, group);
    work->used = mark;
    if (!pairs) {
        return LRCS_OK;
    }
    uint32_t *opposite = lrcsi_work_take(work, facets, sizeof *opposite);
    size_t end = work->used;
    group = lrcsi_work_take(work, p->scene->vertex_count, sizeof *group);
    if (!opposite || !group) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facets; f++) {
        opposite[f] = LRCS_NONE;
    }
    p->opposite = opposite;
    groups_make(p, group);
    work->used = end;
    return LRCS_OK;
}

/* --- contacts --------------------------------------------------------------------------------- */

/* The number of entries of the completed lists. */
static uint64_t count_entries(const lrcs_prepared *p)
{
    const lrcsi_intersections *t = &p->intersections;
    uint64_t count = 0;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        uint32_t times = p->opposite[f] != LRCS_NONE ? 2 : 1;
        for (uint32_t i = t->first[f]; i < t->first[f + 1]; i++) {
            count += (uint64_t)times * (p->opposite[t->entry[i].other] != LRCS_NONE ? 2 : 1);
        }
    }
    return count;
}

/* intersections.met of a facet, from that of the first facet of its pair. The two list their
   corners in different orders; their sides correspond if they are the same edge. */
static unsigned char met_of(const lrcs_prepared *p, uint32_t facet, uint32_t first)
{
    const uint32_t *edge = p->topology.facet_edge[facet].corner;
    const uint32_t *first_edge = p->topology.facet_edge[first].corner;
    unsigned met = p->intersections.met[first] & 1u;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            if (edge[k] == first_edge[i] && lrcsi_intersection_along(&p->intersections, first, i)) {
                met |= 2u << k;
            }
        }
    }
    return (unsigned char)met;
}

/* Completes the lists in place. It starts at the end, so that nothing is overwritten too early: no
   entry moves to a smaller index, and the second facet of a pair, which comes after the first, gets
   its copy before the list of the first moves. */
static void complete_lists(lrcs_prepared *p, uint32_t count)
{
    lrcsi_intersections *t = &p->intersections;
    for (uint32_t f = p->scene->facet_count; f-- > 0;) {
        uint32_t first = p->opposite[f] < f ? p->opposite[f] : f; /* of its pair, or f itself */
        uint32_t to = count;
        for (uint32_t i = t->first[first + 1]; i-- > t->first[first];) {
            lrcsi_intersection contact = t->entry[i];
            uint32_t opposite = p->opposite[contact.other];
            if (opposite != LRCS_NONE) {
                t->entry[--to] = (lrcsi_intersection){opposite, contact.kind};
            }
            t->entry[--to] = contact;
        }
        t->met[f] = met_of(p, f, first);
        t->first[f + 1] = count;
        count = to;
    }
}

int lrcsi_coincident_contacts(lrcs_prepared *p, lrcs_work *work)
{
    lrcsi_intersections *t = &p->intersections;
    if (!p->opposite) {
        return LRCS_OK;
    }
    uint64_t count = count_entries(p);
    if (count >= LRCS_NONE) {
        return LRCS_E_LIMIT;
    }
    work->used = (size_t)((unsigned char *)t->entry - work->bytes);
    if (!lrcsi_work_take(work, (size_t)count, sizeof *t->entry)) { /* extends the block in place */
        return LRCS_E_MEMORY;
    }
    complete_lists(p, (uint32_t)count);
    t->count = (uint32_t)count;
    return LRCS_OK;
}
