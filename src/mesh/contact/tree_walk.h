/* SPDX-License-Identifier: MIT */
/* Traversals of a tree of facets: all facets near a box, and all pairs of leaves. */
#ifndef LRCSI_TREE_WALK_H
#define LRCSI_TREE_WALK_H

#include "mesh/contact/tree.h"

/* A traversal that finds the boxes of one level that intersect a given box. `mask` has a bit for
   each lane of a level that is still to be visited. */
typedef struct lrcsi_tree_walk {
    const lrcsi_tree *tree;
    lrcsi_box box;
    uint32_t without;            /* nodes with this label are left out; LRCS_NONE: none */
    uint64_t also_without;       /* and those with label i < 64 if bit i is set: none at the start;
                                    bits may be set during the traversal */
    int last, level;             /* the level whose boxes are sought; the current level */
    uint32_t leaf;               /* the leaf whose slab is compared too, or LRCS_NONE */
    uint32_t apart;              /* number of nodes that slabs or capsules have left out */
    lrcsi_tree_capsule capsule;  /* compared with those of nodes; radius 0: none is */
    const lrcsi_tree_cone *cone; /* the leaf's cone if cones are compared too, else NULL; */
    uint32_t apex;               /* then the leaf's label, the vertex of the cones */
    uint32_t at[LRCSI_TREE_LEVELS];
    unsigned mask[LRCSI_TREE_LEVELS];
} lrcsi_tree_walk;

/* Starts a traversal of the places of all facets whose boxes intersect `box`. Facets of the label
   `without` (LRCS_NONE: none) may be left out. */
lrcsi_tree_walk lrcsi_tree_within(const lrcsi_tree *tree, const lrcsi_box *box, uint32_t without);

/* Starts a traversal of the nodes of level 0 that come after `leaf`, intersect its box, and do not
   have its label. Over all leaves, and with the pairs within leaves, every pair of facets whose
   boxes intersect occurs once, except some pairs of one label. */
lrcsi_tree_walk lrcsi_tree_after(const lrcsi_tree *tree, uint32_t leaf);

/* From here on a traversal leaves out the nodes that slabs separate from the leaf (see
   mesh/contact/tree_bounds.h); this pays for leaves whose boxes intersect many others. */
void lrcsi_tree_narrow_by_slabs(lrcsi_tree_walk *walk, uint32_t leaf);

/* From here on a traversal leaves out the nodes whose capsules are apart from this one
   (mesh/contact/tree_capsule.h). It contains what the nodes are to meet; if they are only to be
   near, its radius includes that distance. */
void lrcsi_tree_narrow_by_capsule(lrcsi_tree_walk *walk, const lrcsi_tree_capsule *capsule);

/* From here on the traversal of a leaf that has a vertex as label leaves out the nodes of the same
   label whose cones have nothing but that vertex in common with the leaf's. */
void lrcsi_tree_narrow_by_cones(lrcsi_tree_walk *walk, uint32_t leaf);

/* The next place or node, or LRCS_NONE at the end. */
uint32_t lrcsi_tree_next(lrcsi_tree_walk *walk);

#endif
