/* SPDX-License-Identifier: MIT */
/* Classifies edges. An edge is regular if it has one facet, two facets that traverse it in opposite
   senses, or two pairs of coincident facets; all other edges are irregular. Which edges are
   contours depends on the direction and is not decided here. */
#include "scene/neighbours.h"

#include "base/work.h"

/* An irregular edge has at least two sides. */
size_t lrcsi_neighbours_need(uint32_t facet_count)
{
    size_t sides = 3 * (size_t)facet_count;
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(lrcs_facet)),
                          lrcsi_work_bytes(sides / 2, sizeof(uint32_t)));
}

/* What determines the class of an edge. */
typedef struct neighbours_job {
    const lrcsi_topology *topology;
    const unsigned char *redundant;
    const uint32_t *opposite; /* or NULL */
} neighbours_job;

/* The facets on an edge that are not always redundant: their number, the first four of them, and
   how many of them traverse the edge forward. */
typedef struct edge_facets {
    uint32_t count, forward;
    lrcsi_edge_use use[4];
} edge_facets;

static edge_facets edge_facets_of(const neighbours_job *job, uint32_t edge)
{
    const lrcsi_edge *e = &job->topology->edge[edge];
    const lrcsi_edge_use *use = job->topology->use + e->first_use;
    edge_facets all = {0, 0, {{0, 0}}};
    for (uint32_t i = 0; i < e->uses; i++) {
        if (job->redundant[use[i].facet] != LRCSI_REDUNDANT) {
            all.use[all.count < 4 ? all.count : 3] = use[i];
            all.forward += use[i].forward;
            all.count++;
        }
    }
    return all;
}

/* Stores `other` as the neighbour of a facet across an edge. */
static void set_neighbour(const neighbours_job *job, lrcsi_neighbours *a, uint32_t facet,
                          uint32_t edge, uint32_t other)
{
    a->facet[facet].corner[lrcsi_topology_side(job->topology, facet, edge)] = other;
}

/* Stores the neighbours at an edge of two pairs of coincident facets: for each facet, the facet of
   the other pair that traverses the edge in the opposite sense (the facets of one pair also
   traverse it in opposite senses). Returns 0, and stores nothing, if the four facets are not two
   such pairs. */
static int set_pair_neighbours(const neighbours_job *job, lrcsi_neighbours *a, uint32_t edge,
                               const edge_facets *all)
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
                set_neighbour(job, a, use[i].facet, edge, use[j].facet);
            }
        }
    }
    return 1;
}

/* Classifies every edge. The first case is only a shortcut: most edges have two facets. */
static void edges_classify(const neighbours_job *job, uint32_t facet_count, lrcsi_neighbours *a)
{
    for (uint32_t e = 0; e < job->topology->edge_count; e++) {
        const lrcsi_edge_use *use = job->topology->use + job->topology->edge[e].first_use;
        if (job->topology->edge[e].uses == 2 && use[0].forward != use[1].forward &&
            job->redundant[use[0].facet] != LRCSI_REDUNDANT &&
            job->redundant[use[1].facet] != LRCSI_REDUNDANT) {
            set_neighbour(job, a, use[0].facet, e, use[1].facet);
            set_neighbour(job, a, use[1].facet, e, use[0].facet);
            continue;
        }
        edge_facets all = edge_facets_of(job, e);
        if (all.count == 1) {
            set_neighbour(job, a, all.use[0].facet, e, facet_count);
        } else if (all.count == 2 && all.forward == 1) {
            set_neighbour(job, a, all.use[0].facet, e, all.use[1].facet);
            set_neighbour(job, a, all.use[1].facet, e, all.use[0].facet);
        } else if (all.count != 0 && !(all.count == 4 && set_pair_neighbours(job, a, e, &all))) {
            a->irregular[a->irregular_count++] = e;
        }
    }
}

int lrcsi_neighbours_make(const lrcsi_topology *topology, uint32_t facet_count,
                          const unsigned char *redundant, const uint32_t *opposite, lrcs_work *work,
                          lrcsi_neighbours *neighbours)
{
    size_t mark = work->used;
    neighbours_job job = {topology, redundant, opposite};
    lrcsi_neighbours a = {.irregular_count = 0};
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
    edges_classify(&job, facet_count, &a);
    work->used = end; /* takes the same memory again, as long as the list turned out to be */
    a.irregular = lrcsi_work_take(work, a.irregular_count, sizeof *a.irregular);
    *neighbours = a;
    return LRCS_OK;
}
