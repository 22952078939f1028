/* SPDX-License-Identifier: MIT */
/* A tree of boxes over facets, for finding the few that can meet a given one. It proposes
   candidates and decides nothing: it never leaves out a facet that meets the one asked about in
   more than a corner that both have. */
#ifndef LRCSI_TREE_H
#define LRCSI_TREE_H

#include <lrcs/mesh.h>

typedef struct lrcsi_box {
    double low[3], high[3];
} lrcsi_box;

/* What bounds all facets below a node: a box, and a slab across their mean normal (long facets
   at an angle to the axes fill a box badly). Every corner x has low <= direction . x <= high. */
typedef struct lrcsi_tree_node {
    lrcsi_box box; /* of all corners but the hub */
    double direction[3], low, high;
    uint32_t hub;   /* a vertex that all of them have, or LRCS_NONE */
    uint32_t group; /* that all of them are of, or LRCS_NONE */
} lrcsi_tree_node;

/* A complete binary tree: the children of node i are 2 i and 2 i + 1, the root is node 1. */
typedef struct lrcsi_tree {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    uint32_t count;        /* facets in it */
    uint32_t leaves;       /* a power of two; leaf l is node leaves + l */
    uint32_t *order;       /* the facets, along a Morton curve */
    lrcsi_box *box;        /* their boxes, in that order */
    lrcsi_tree_node *node; /* 2 leaves, the first unused; empty ones have low > high */
} lrcsi_tree;

/* Two planes through a corner of a facet that have the rest of it above, one along either side:
   above is where m . (x - corner) is positive. */
typedef struct lrcsi_tree_fan {
    double m[2][3];
    int known[2]; /* 0: none was found */
    int made;     /* 0: not yet looked for */
} lrcsi_tree_fan;

/* One walk over the facets whose boxes meet that of a facet and are not proved to lie strictly to
   one side of its plane, or it to one side of their slab, or to have but a corner in common with
   it. */
typedef struct lrcsi_tree_walk {
    const lrcsi_tree *tree;
    lrcsi_box box;
    const double *corner[3];
    uint32_t own[3];             /* the corners; LRCS_NONE in a walk within a distance */
    lrcsi_tree_fan fan[3];       /* at each corner */
    double normal[3], weight[3]; /* of its plane; weight bounds the normal's error */
    double slack, slack_plane;   /* how near a candidate must come; the same times |normal| */
    uint32_t without;            /* a group of which no candidate is wanted, or LRCS_NONE */
    uint32_t node;               /* 0: at the end */
    uint32_t at, end;            /* within a leaf: places in order[] */
} lrcsi_tree_walk;

/* Upper bound of what lrcsi_tree_make takes; what it returns stays in the work area. */
size_t lrcsi_tree_need(uint32_t facet_count);

/* Facets marked in `skip` (which may be NULL) are left out; group[facet] (or NULL: none) is what
   walks may do without. Vertices and facets must outlive the tree.
   Status: LRCS_OK; LRCS_E_MEMORY. O(n log n). */
int lrcsi_tree_make(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                    const unsigned char *skip, const uint32_t *group, lrcs_work *work,
                    lrcsi_tree *tree);

/* Starts a walk around facet order[place], among those after it: each pair comes up once. */
lrcsi_tree_walk lrcsi_tree_after(const lrcsi_tree *tree, uint32_t place);

/* A walk among all facets, for those that come within a distance of one, in the tree or not; those
   at its corners too; those of a group (LRCS_NONE: of none) left out where whole nodes are of
   it. */
lrcsi_tree_walk lrcsi_tree_within(const lrcsi_tree *tree, lrcs_facet facet, double distance,
                                  uint32_t without);

/* The next candidate, each once, or LRCS_NONE at the end. */
uint32_t lrcsi_tree_next(lrcsi_tree_walk *walk);

/* 1 where a candidate is proved to have but a corner in common with the walk's facet. */
int lrcsi_tree_corner(lrcsi_tree_walk *walk, uint32_t candidate);

#endif
