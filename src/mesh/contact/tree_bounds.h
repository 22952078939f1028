/* SPDX-License-Identifier: MIT */
/* Tighter bounds than boxes: slabs for parallel layers at an angle to the axes, cones for facets
   about one vertex. */
#ifndef LRCSI_TREE_BOUNDS_H
#define LRCSI_TREE_BOUNDS_H

#include "mesh/contact/tree.h"

/* Fills the slabs of a tree, from the vertices and facets that it was made from. The slab of a
   single leaf needs no others to be filled. */
void lrcsi_tree_fill_slabs(const lrcs_point *vertex, const lrcs_facet *facet, lrcsi_tree *tree);
lrcsi_tree_slab lrcsi_tree_leaf_slab(const lrcs_point *vertex, const lrcs_facet *facet,
                                     const lrcsi_tree *tree, uint32_t leaf);

/* Is what a lane of node b of `level` contains proved to be disjoint from a leaf? */
int lrcsi_tree_slabs_apart(const lrcsi_tree *tree, uint32_t leaf, int level, uint32_t b,
                           uint32_t lane);

/* Fills the cones of nodes that have a vertex as label, unless proved[label]: of fans that are not
   proved (mesh/contact/fan.h), all of whose boxes intersect. */
void lrcsi_tree_fill_cones(const lrcs_point *vertex, const lrcs_facet *facet,
                           const unsigned char *proved, lrcsi_tree *tree);

/* Are two cones about one vertex proved to have nothing else in common? */
int lrcsi_tree_cones_apart(const lrcsi_tree_cone *a, const lrcsi_tree_cone *b);

#endif
