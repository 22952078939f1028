/* SPDX-License-Identifier: MIT */
/* Which facets share which points and edges, decided by bitwise equal positions (-0 equals 0) and
   not by the indices of the file. Degenerate facets (area exactly zero) are left out. */
#ifndef LRCSI_TOPOLOGY_H
#define LRCSI_TOPOLOGY_H

#include <lrcs/mesh.h>

/* An undirected edge between two welded points, low < high, and the facets on it. */
typedef struct lrcsi_edge {
    uint32_t low, high; /* indices of representative vertices, which have the positions */
    uint32_t first_use; /* into use[] */
    uint32_t uses;      /* number of facets that share it */
} lrcsi_edge;

/* One facet's side on an edge. There are fewer than 2^31 facets. */
typedef struct lrcsi_edge_use {
    uint32_t facet : 31;
    uint32_t forward : 1; /* 1: the facet traverses it from low to high, 0: from high to low */
} lrcsi_edge_use;

typedef struct lrcsi_topology {
    uint32_t *weld; /* vertex -> representative: the lowest vertex index at that position */
    unsigned char *degenerate; /* facet -> 1 if its area is exactly zero */
    lrcsi_edge *edge;          /* sorted by (low, high) */
    lrcsi_edge_use *use;       /* grouped by edge; within one, by facet */
    lrcs_facet *facet_edge;    /* facet -> its edges (corner[k]: the side from corner k to k + 1);
                                  LRCS_NONE if it is degenerate */
    uint32_t edge_count;
} lrcsi_topology;

/* Upper bounds of what lrcsi_topology_make takes, and of what it returns, which stays in the work
   area. */
size_t lrcsi_topology_need(uint32_t vertex_count, uint32_t facet_count);
size_t lrcsi_topology_kept(uint32_t vertex_count, uint32_t facet_count);

/* Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (3 facet_count above 2^32 - 2). Linear time, except
   for a logarithm if one vertex has many edges. */
int lrcsi_topology_make(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                        uint32_t facet_count, lrcs_work *work, lrcsi_topology *topology);

/* The side of a facet, 0 to 2, that is one of its edges. */
static inline uint32_t lrcsi_topology_side(const lrcsi_topology *t, uint32_t facet, uint32_t edge)
{
    const uint32_t *side = t->facet_edge[facet].corner;
    return side[0] == edge ? 0 : side[1] == edge ? 1 : 2;
}

/* The corner of a facet, 0 to 2, opposite one of its edges. */
static inline uint32_t lrcsi_topology_corner_opposite(const lrcsi_topology *t, uint32_t facet,
                                                      uint32_t edge)
{
    return (lrcsi_topology_side(t, facet, edge) + 2) % 3;
}

/* The lowest of a facet's edges; LRCS_NONE if it is degenerate. Two facets are coincident, on the
   same three points, if and only if they have the same lowest edge and the same point opposite
   it. */
static inline uint32_t lrcsi_topology_lowest_edge(const lrcsi_topology *t, uint32_t facet)
{
    const uint32_t *side = t->facet_edge[facet].corner;
    uint32_t low = side[0] < side[1] ? side[0] : side[1];
    return low < side[2] ? low : side[2];
}

/* Is mark[facet] this value for any facet of an edge? */
static inline int lrcsi_topology_edge_has(const lrcsi_topology *t, uint32_t edge,
                                          const uint32_t *mark, uint32_t value)
{
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    for (uint32_t i = 0; i < t->edge[edge].uses; i++) {
        if (mark[use[i].facet] == value) {
            return 1;
        }
    }
    return 0;
}

#endif
