/* SPDX-License-Identifier: MIT */
/* Capsules around long facets. The facets of a wall or of a disc that is finely divided are long
   and narrow; their boxes, unless they are parallel to an axis, intersect most others, while most
   of the facets pass each other at a distance. */
#ifndef LRCSI_TREE_CAPSULE_H
#define LRCSI_TREE_CAPSULE_H

#include "mesh/contact/tree.h"

/* Fills the capsules of a tree, from the vertices and facets that it was made from. Work: linear.
 */
void lrcsi_tree_fill_capsules(const lrcs_point *vertex, const lrcs_facet *facet, lrcsi_tree *tree);

/* The capsule of a lane of node b of `level`, which is at least 1. */
lrcsi_tree_capsule lrcsi_tree_lane_capsule(const lrcsi_tree *tree, int level, uint32_t b,
                                           uint32_t lane);

/* Are two capsules proved to be disjoint, because their segments are farther apart than the sum of
   their radii? */
int lrcsi_tree_capsules_apart(const lrcsi_tree_capsule *a, const lrcsi_tree_capsule *b);

#endif
