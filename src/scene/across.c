/* SPDX-License-Identifier: MIT */
/* Sorting edges into plain ones, on which one facet stands or two that continue each other, and odd
   ones. Which of them are contours is decided anew for every direction. */
#include "scene/across.h"

#include "base/work.h"

/* An odd edge takes up two sides or more. */
size_t lrcsi_across_need(uint32_t facet_count)
{
    size_t sides = 3 * (size_t)facet_count;
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(lrcs_facet)),
                          lrcsi_work_bytes(sides / 2, sizeof(uint32_t)));
}

/* The live facets on an edge: how many, the first of them, one other, and how many run it
   forward. */
typedef struct across_edge {
    uint32_t count, first, other, forward;
} across_edge;

static across_edge across_edge_of(const lrcsi_topology *t, uint32_t edge, const unsigned char *skip)
{
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    across_edge all = {0, LRCS_NONE, LRCS_NONE, 0};
    for (uint32_t i = 0; i < t->edge[edge].uses; i++) {
        if (!skip[use[i].facet]) {
            *(all.count == 0 ? &all.first : &all.other) = use[i].facet;
            all.forward += use[i].forward;
            all.count++;
        }
    }
    return all;
}

static void across_set(const lrcsi_topology *t, lrcsi_across *a, uint32_t facet, uint32_t edge,
                       uint32_t other)
{
    for (int k = 0; k < 3; k++) {
        if (t->facet_edge[facet].corner[k] == edge) {
            a->facet[facet].corner[k] = other;
        }
    }
}

static void across_edges(const lrcsi_topology *t, uint32_t facet_count, const unsigned char *skip,
                         lrcsi_across *a)
{
    for (uint32_t e = 0; e < t->edge_count; e++) {
        across_edge all = across_edge_of(t, e, skip);
        if (all.count == 1) {
            across_set(t, a, all.first, e, facet_count);
        } else if (all.count == 2 && all.forward == 1) {
            across_set(t, a, all.first, e, all.other);
            across_set(t, a, all.other, e, all.first);
        } else if (all.count != 0) {
            a->odd[a->odd_count++] = e;
        }
    }
}

int lrcsi_across_make(const lrcsi_topology *topology, uint32_t facet_count,
                      const unsigned char *skip, lrcs_work *work, lrcsi_across *across)
{
    size_t mark = work->used;
    lrcsi_across a = {.odd_count = 0};
    a.facet = lrcsi_work_take(work, facet_count, sizeof *a.facet);
    size_t end = work->used;
    a.odd = lrcsi_work_take(work, 3 * (size_t)facet_count / 2, sizeof *a.odd);
    if (!a.facet || !a.odd) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        a.facet[f] = (lrcs_facet){{f, f, f}};
    }
    across_edges(topology, facet_count, skip, &a);
    work->used = end; /* what odd edges there are lie where they were filed */
    a.odd = lrcsi_work_take(work, a.odd_count, sizeof *a.odd);
    *across = a;
    return LRCS_OK;
}
