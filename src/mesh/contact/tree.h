/* SPDX-License-Identifier: MIT */
/* A bounding volume hierarchy over facets: boxes in nodes of eight, in levels. It finds the facets
   whose boxes intersect, and decides nothing else. */
#ifndef LRCSI_TREE_H
#define LRCSI_TREE_H

#include <lrcs/mesh.h>

#include "base/bits.h"
#include "mesh/box.h"

/* Boxes per node, and the largest number of levels (for 2^32 facets). */
enum { LRCSI_TREE_LANES = 8, LRCSI_TREE_LEVELS = 11 };

/* Eight boxes in structure of arrays; lanes without one have low > high. */
typedef struct lrcsi_tree_node {
    _Alignas(16) double low[3][LRCSI_TREE_LANES];
    double high[3][LRCSI_TREE_LANES];
} lrcsi_tree_node;

/* Slabs that bound the contents of the eight boxes: low <= direction . x <= high for every corner
   x. The direction is the mean normal, of length 1, or 0 if there is none. They serve parallel
   layers at an angle to the axes, whose boxes are mostly empty. */
typedef struct lrcsi_tree_slabs {
    double direction[3][LRCSI_TREE_LANES], low[LRCSI_TREE_LANES], high[LRCSI_TREE_LANES];
} lrcsi_tree_slabs;

/* The slab of one node. */
typedef struct lrcsi_tree_slab {
    double direction[3], low, high;
    double size; /* the largest |x| + |y| + |z| of the corners */
} lrcsi_tree_slab;

/* All points within `radius` of a segment. If the radius is infinite, it bounds nothing. */
typedef struct lrcsi_tree_capsule {
    double end[2][3], radius;
} lrcsi_tree_capsule;

/* Capsules that contain the contents of the eight boxes. */
typedef struct lrcsi_tree_capsules {
    double end[2][3][LRCSI_TREE_LANES], radius[LRCSI_TREE_LANES];
} lrcsi_tree_capsules;

/* A cone that contains a node of facets with a common vertex, seen from that vertex: for every
   other corner x, axis . (x - vertex) / |x - vertex| >= cosine. The axis has length 1. A cosine of
   0 or less bounds nothing. */
typedef struct lrcsi_tree_cone {
    double axis[3], cosine;
} lrcsi_tree_cone;

/* A facet's place is its position in order[]; neighbours in space mostly have places close to each
   other. Level 0 has the facets' boxes, by place, and level l the boxes of level l - 1's nodes, up
   to the last level, which has one node. */
typedef struct lrcsi_tree {
    uint32_t count;  /* facets in it */
    uint32_t *order; /* place -> facet */
    int levels;      /* 0 if there are no facets */
    uint32_t nodes[LRCSI_TREE_LEVELS];
    lrcsi_tree_node *node[LRCSI_TREE_LEVELS];
    uint32_t *label[LRCSI_TREE_LEVELS]; /* of each node: that of all facets below, or LRCS_NONE */
    lrcsi_tree_slabs *slabs[LRCSI_TREE_LEVELS];       /* from level 1 on: of the nodes below */
    int has_slabs;                                    /* 0: not yet filled */
    lrcsi_tree_capsules *capsules[LRCSI_TREE_LEVELS]; /* from level 1 on, likewise */
    int has_capsules;                                 /* 0: not yet filled */
    lrcsi_tree_cone *cone[LRCSI_TREE_LEVELS];         /* of each node that has a label, if filled */
} lrcsi_tree;

/* A lane's box. */
static inline lrcsi_box lrcsi_tree_box(const lrcsi_tree_node *node, uint32_t lane)
{
    return (lrcsi_box){{node->low[0][lane], node->low[1][lane], node->low[2][lane]},
                       {node->high[0][lane], node->high[1][lane], node->high[2][lane]}};
}

/* The lanes of a node whose boxes intersect `box` (closed, finite, no end of it -0), as bits.
   Boxes are disjoint if along some axis one ends before the other starts: if a difference of their
   ends is negative. A rounded difference has the sign of the exact one (subnormal numbers are kept,
   base/ieee.h), and equal ends differ by +0, as none is -0. The sign bits of the six differences
   are combined lane by lane, which compilers vectorize. They do not vectorize comparisons, which
   might trap. */
static inline unsigned lrcsi_tree_meets(const lrcsi_tree_node *node, const lrcsi_box *box)
{
    static const uint64_t lane_bit[LRCSI_TREE_LANES] = {1, 2, 4, 8, 16, 32, 64, 128};
    const double lx = box->low[0];
    const double ly = box->low[1];
    const double lz = box->low[2];
    const double hx = box->high[0];
    const double hy = box->high[1];
    const double hz = box->high[2];
    uint64_t meets = 0;
    for (int k = 0; k < LRCSI_TREE_LANES; k++) {
        uint64_t apart =
            lrcsi_bits_of(hx - node->low[0][k]) | lrcsi_bits_of(hy - node->low[1][k]) |
            lrcsi_bits_of(hz - node->low[2][k]) | lrcsi_bits_of(node->high[0][k] - lx) |
            lrcsi_bits_of(node->high[1][k] - ly) | lrcsi_bits_of(node->high[2][k] - lz);
        meets |= ((apart >> 63) - 1) & lane_bit[k];
    }
    return (unsigned)meets;
}

/* The number of the lowest bit of a mask that is not 0. */
static inline uint32_t lrcsi_tree_lane(unsigned mask)
{
    unsigned bit = mask & (0u - mask);
    return (uint32_t)((bit & 0xaau) != 0) | (uint32_t)((bit & 0xccu) != 0) << 1 |
           (uint32_t)((bit & 0xf0u) != 0) << 2;
}

/* Upper bound of what lrcsi_tree_make takes; what it returns stays in the work area. */
size_t lrcsi_tree_need(uint32_t facet_count);

/* Facets marked in `skip` (which may be NULL) are left out. label[facet] (NULL: LRCS_NONE for all):
   traversals can leave out all facets of a label. If `apexes` is 1, the label is a vertex, and the
   facet is sorted by the position of that vertex, so that facets of one label are consecutive.
   Status: LRCS_OK; LRCS_E_MEMORY. Work: linear; at most 90 times that for nested clusters, each on
   a much finer scale than the one around it. */
int lrcsi_tree_make(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                    const unsigned char *skip, const uint32_t *label, int apexes, lrcs_work *work,
                    lrcsi_tree *tree);

#endif
