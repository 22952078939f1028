/* SPDX-License-Identifier: MIT */
/* Sorting edges into regular ones, with one facet, two that continue each other, or two pairs of
   coincident facets, and irregular ones. Which of them are contours depends on the direction and is
   not decided here. */
#include "scene/across.h"

#include "base/work.h"

/* An irregular edge has at least two sides. */
size_t lrcsi_across_need(uint32_t facet_count)
{
    size_t sides = 3 * (size_t)facet_count;
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(lrcs_facet)),
                          lrcsi_work_bytes(sides / 2, sizeof(uint32_t)));
}

/* What an edge is sorted by. */
typedef struct across_job {
    const lrcsi_topology *topology;
    const unsigned char *redundant;
    const uint32_t *opposite; /* or NULL */
} across_job;

/* The facets on an edge that count: their number, the first four of them, and how many of them
   traverse it forward. */
typedef struct across_edge {
    uint32_t count, forward;
    lrcsi_edge_use use[4];
} across_edge;

static across_edge across_edge_of(const across_job *job, uint32_t edge)
{
    const lrcsi_edge *e = &job->topology->edge[edge];
    const lrcsi_edge_use *use = job->topology->use + e->first_use;
    across_edge all = {0, 0, {{0, 0}}};
    for (uint32_t i = 0; i < e->uses; i++) {
        if (job->redundant[use[i].facet] != LRCSI_REDUNDANT) {
            all.use[all.count < 4 ? all.count : 3] = use[i];
            all.forward += use[i].forward;
            all.count++;
        }
    }
    return all;
}

/* Stores which facet lies across the side of a facet on an edge. */
static void across_set(const across_job *job, lrcsi_across *a, uint32_t facet, uint32_t edge,
                       uint32_t other)
{
    const uint32_t *side = job->topology->facet_edge[facet].corner;
    a->facet[facet].corner[side[0] == edge ? 0 : side[1] == edge ? 1 : 2] = other;
}

/* Two pairs of coincident facets: across the edge, each facet is followed by the one of the other
   pair that traverses the edge in the opposite sense. The two facets of a pair traverse it in
   opposite senses. */
static int across_set_pairs(const across_job *job, lrcsi_across *a, uint32_t edge,
                            const across_edge *all)
{
    const lrcsi_edge_use *use = all->use;
    if (!job->opposite) {
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        int paired = 0;
        for (int j = 0; j < 4; j++) {
            paired |= job->opposite[use[i].facet] == use[j].facet;
        }
        if (!paired) {
            return 0;
        }
    }
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            if (use[i].forward != use[j].forward && job->opposite[use[i].facet] != use[j].facet) {
                across_set(job, a, use[i].facet, edge, use[j].facet);
            }
        }
    }
    return 1;
}

/* Most edges have two facets. */
static void across_edges(const across_job *job, uint32_t facet_count, lrcsi_across *a)
{
    for (uint32_t e = 0; e < job->topology->edge_count; e++) {
        const lrcsi_edge_use *use = job->topology->use + job->topology->edge[e].first_use;
        if (job->topology->edge[e].uses == 2 && use[0].forward != use[1].forward &&
            job->redundant[use[0].facet] != LRCSI_REDUNDANT &&
            job->redundant[use[1].facet] != LRCSI_REDUNDANT) {
            across_set(job, a, use[0].facet, e, use[1].facet);
            across_set(job, a, use[1].facet, e, use[0].facet);
            continue;
        }
        across_edge all = across_edge_of(job, e);
        if (all.count == 1) {
            across_set(job, a, all.use[0].facet, e, facet_count);
        } else if (all.count == 2 && all.forward == 1) {
            across_set(job, a, all.use[0].facet, e, all.use[1].facet);
            across_set(job, a, all.use[1].facet, e, all.use[0].facet);
        } else if (all.count != 0 && !(all.count == 4 && across_set_pairs(job, a, e, &all))) {
            a->irregular[a->irregular_count++] = e;
        }
    }
}

int lrcsi_across_make(const lrcsi_topology *topology, uint32_t facet_count,
                      const unsigned char *redundant, const uint32_t *opposite, lrcs_work *work,
                      lrcsi_across *across)
{
    size_t mark = work->used;
    across_job job = {topology, redundant, opposite};
    lrcsi_across a = {.irregular_count = 0};
    a.facet = lrcsi_work_take(work, facet_count, sizeof *a.facet);
    size_t end = work->used;
    a.irregular = lrcsi_work_take(work, 3 * (size_t)facet_count / 2, sizeof *a.irregular);
    if (!a.facet || !a.irregular) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        a.facet[f] = (lrcs_facet){{f, f, f}};
    }
    across_edges(&job, facet_count, &a);
    work->used = end; /* the irregular edges are already stored here */
    a.irregular = lrcsi_work_take(work, a.irregular_count, sizeof *a.irregular);
    *across = a;
    return LRCS_OK;
}
