/* SPDX-License-Identifier: MIT */
/* Of facets on the same three points, those of the same winding face the same way from every
   direction, and those of the opposite winding then face away. In a tie the first front in order
   wins; if there is none, the first back that reflects, else the first back (visibility/sample.h).

   In a place with both windings, one winding shows its front from every direction (except edge-on,
   where nothing is seen). So only the first facet of each winding is ever seen: the two are the
   sides of one panel, each the `opposite` of the other. The one that faces away is hidden entirely
   by the other, and hides nothing that the other does not hide.

   In a place with one winding a facet is never seen if one before it reflects from its back, or if
   there is one before it and the facet itself does not; in both cases the one before hides all that
   it hides.

   If facets represent a curved shape, visibility of the true shape may differ: none of them is
   redundant here. */
#include "scene/coincident.h"

#include "base/work.h"

/* The facets of one place that may be seen, by winding. */
typedef struct facet_place {
    uint32_t edge;      /* the lowest of its edges; the third corner is the key */
    uint32_t first[2];  /* or LRCS_NONE */
    uint32_t second[2]; /* the first that reflects from its back, if the first of all does not */
} facet_place;

static int may_coincide(const lrcs_prepared *p, uint32_t facet)
{
    return !p->skip[facet] && !(p->scene->part[p->scene->facet_part[facet]].reach > 0);
}

static int reflects_back(const lrcs_prepared *p, uint32_t facet)
{
    return lrcsi_prepared_material(p, facet)->two_sided != 0;
}

static uint32_t lowest_edge(const lrcs_prepared *p, uint32_t facet)
{
    const uint32_t *side = p->topology.facet_edge[facet].corner;
    uint32_t low = side[0] < side[1] ? side[0] : side[1];
    return low < side[2] ? low : side[2];
}

/* The corner across from a facet's edge, welded. */
static uint32_t corner_across(const lrcs_prepared *p, uint32_t facet, uint32_t edge)
{
    const uint32_t *side = p->topology.facet_edge[facet].corner;
    const uint32_t *corner = p->scene->facet[facet].corner;
    return p->topology.weld[corner[side[0] == edge ? 2 : side[1] == edge ? 0 : 1]];
}

/* Does any facet share its lowest edge with another one that may be in the same place? */
static int any_may_coincide(const lrcs_prepared *p)
{
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        uint32_t lowest = lowest_edge(p, f);
        if (lowest == LRCS_NONE || p->topology.edge[lowest].uses == 1) {
            continue;
        }
        const lrcsi_edge_use *use = p->topology.use + p->topology.edge[lowest].first_use;
        uint32_t other = use[0].facet == f ? use[1].facet : use[0].facet;
        if (p->topology.edge[lowest].uses > 2 ||
            (lowest_edge(p, other) == lowest &&
             corner_across(p, f, lowest) == corner_across(p, other, lowest))) {
            return 1;
        }
    }
    return 0;
}

/* Adds a facet to its place; facets are added in order. */
static void place_add(lrcs_prepared *p, facet_place *place, uint32_t facet, uint32_t winding)
{
    uint32_t *first = &place->first[winding];
    uint32_t *second = &place->second[winding];
    uint32_t opposite = place->first[!winding];
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
    if (place->second[!winding] != LRCS_NONE) {
        p->redundant[place->second[!winding]] = LRCSI_REDUNDANT;
    }
}

/* Facets in one place share the same three edges. They are found at the lowest edge by the corner
   opposite it: place[corner] is the last one found there. Returns whether any facet has an
   opposite. */
static int mark_places(lrcs_prepared *p, facet_place *place)
{
    const lrcsi_topology *t = &p->topology;
    int pairs = 0;
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        place[v].edge = LRCS_NONE;
    }
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const lrcsi_edge_use *use = t->use + t->edge[e].first_use;
        for (uint32_t i = 0; i < t->edge[e].uses && t->edge[e].uses > 1; i++) {
            if (lowest_edge(p, use[i].facet) != e || !may_coincide(p, use[i].facet)) {
                continue;
            }
            facet_place *at = &place[corner_across(p, use[i].facet, e)];
            if (at->edge != e) {
                *at = (facet_place){e, {LRCS_NONE, LRCS_NONE}, {LRCS_NONE, LRCS_NONE}};
            }
            place_add(p, at, use[i].facet, use[i].forward);
            pairs |= at->first[0] != LRCS_NONE && at->first[1] != LRCS_NONE;
        }
    }
    return pairs;
}

size_t lrcsi_coincident_need(uint32_t vertex_count, uint32_t facet_count)
{
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(uint32_t)),
                          lrcsi_work_bytes(vertex_count, sizeof(facet_place)));
}

/* Most scenes have no coincident facets, which is quickly established. Places are visited again
   only if there are opposites to store. */
int lrcsi_coincident_mark(lrcs_prepared *p, lrcs_work *work)
{
    uint32_t facets = p->scene->facet_count;
    size_t mark = work->used;
    p->opposite = NULL;
    if (!any_may_coincide(p)) {
        return LRCS_OK;
    }
    facet_place *place = lrcsi_work_take(work, p->scene->vertex_count, sizeof *place);
    if (!place) {
        return LRCS_E_MEMORY;
    }
    int pairs = mark_places(p, place);
    work->used = mark;
    if (!pairs) {
        return LRCS_OK;
    }
    uint32_t *opposite = lrcsi_work_take(work, facets, sizeof *opposite);
    size_t end = work->used;
    place = lrcsi_work_take(work, p->scene->vertex_count, sizeof *place);
    work->used = end;
    if (!opposite || !place) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facets; f++) {
        opposite[f] = LRCS_NONE;
    }
    p->opposite = opposite;
    mark_places(p, place);
    return LRCS_OK;
}

/* --- contacts --------------------------------------------------------------------------------- */

/* The facet for which the contacts were computed instead of this one. */
static uint32_t first_of_pair(const lrcs_prepared *p, uint32_t facet)
{
    return p->opposite[facet] < facet ? p->opposite[facet] : facet;
}

/* The number of entries of the lists. */
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

/* intersections.met of a facet, from that of the facet for which it was computed. The two list
   their corners in different orders; their sides correspond if they are the same edge. */
static unsigned char met_of(const lrcs_prepared *p, uint32_t facet, uint32_t of)
{
    const uint32_t *edge = p->topology.facet_edge[facet].corner;
    const uint32_t *edge_of = p->topology.facet_edge[of].corner;
    unsigned met = p->intersections.met[of] & 1u;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            if (edge[k] == edge_of[i] && lrcsi_intersection_along(&p->intersections, of, i)) {
                met |= 2u << k;
            }
        }
    }
    return (unsigned char)met;
}

/* Copies the lists in place, from the end: no entry moves to a smaller index, and the list of the
   first facet of a pair has not moved when the second, which comes after it, gets a copy. */
static void spread_entries(lrcs_prepared *p, uint32_t count)
{
    lrcsi_intersections *t = &p->intersections;
    for (uint32_t f = p->scene->facet_count; f-- > 0;) {
        uint32_t of = first_of_pair(p, f);
        uint32_t to = count;
        for (uint32_t i = t->first[of + 1]; i-- > t->first[of];) {
            lrcsi_intersection contact = t->entry[i];
            uint32_t opposite = p->opposite[contact.other];
            if (opposite != LRCS_NONE) {
                t->entry[--to] = (lrcsi_intersection){opposite, contact.kind};
            }
            t->entry[--to] = contact;
        }
        t->met[f] = met_of(p, f, of);
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
    if (!lrcsi_work_take(work, (size_t)count, sizeof *t->entry)) { /* the same place, longer */
        return LRCS_E_MEMORY;
    }
    spread_entries(p, (uint32_t)count);
    t->count = (uint32_t)count;
    return LRCS_OK;
}
