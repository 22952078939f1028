/* SPDX-License-Identifier: MIT */
/* Traversals of the tree: which nodes are visited, in which order, and which are left out because a
   label, slabs, cones or capsules allow it. */
#include "mesh/contact/tree_walk.h"

#include "mesh/contact/tree_bounds.h"
#include "mesh/contact/tree_capsule.h"

enum { WALK_LANES = LRCSI_TREE_LANES };

/* Is a lane proved to be apart from the leaf, by slabs, or from the capsule? */
static int is_apart(const lrcsi_tree_walk *w, int level, uint32_t lane)
{
    if (w->leaf != LRCS_NONE &&
        lrcsi_tree_slabs_apart(w->tree, w->leaf, level, w->at[level], lane)) {
        return 1;
    }
    if (!(w->capsule.radius > 0.0)) {
        return 0;
    }
    const lrcsi_tree_capsule other = lrcsi_tree_lane_capsule(w->tree, level, w->at[level], lane);
    return lrcsi_tree_capsules_apart(&w->capsule, &other);
}

/* The lanes of a mask that are not proved to be apart. Lanes of level 0, which are facets, have
   neither slabs nor capsules. */
static unsigned narrowed(lrcsi_tree_walk *w, int level, unsigned mask)
{
    unsigned left = mask;
    if (level == 0 || (w->leaf == LRCS_NONE && !(w->capsule.radius > 0.0))) {
        return mask;
    }
    for (; mask != 0; mask &= mask - 1) {
        const uint32_t lane = lrcsi_tree_lane(mask);
        if (is_apart(w, level, lane)) {
            left &= ~(1u << lane);
            w->apart++;
        }
    }
    return left;
}

/* Narrows what is still to be visited. */
static void narrow_rest(lrcsi_tree_walk *w)
{
    for (int level = w->level; level < w->tree->levels; level++) {
        w->mask[level] = narrowed(w, level, w->mask[level]);
    }
}

lrcsi_tree_walk lrcsi_tree_within(const lrcsi_tree *tree, const lrcsi_box *box, uint32_t without)
{
    lrcsi_tree_walk walk = {
        .tree = tree, .without = without, .level = tree->levels, .leaf = LRCS_NONE};
    for (int k = 0; k < 3; k++) { /* -0 becomes 0 */
        walk.box.low[k] = box->low[k] + 0.0;
        walk.box.high[k] = box->high[k] + 0.0;
    }
    if (tree->levels > 0) {
        walk.level = tree->levels - 1;
        walk.mask[walk.level] = lrcsi_tree_meets(&tree->node[walk.level][0], &walk.box);
    }
    return walk;
}

/* On each level above the leaf, the lanes after the one that contains it. */
lrcsi_tree_walk lrcsi_tree_after(const lrcsi_tree *tree, uint32_t leaf)
{
    lrcsi_tree_walk walk = {.tree = tree, .last = 1, .level = 1, .leaf = LRCS_NONE};
    uint32_t at = leaf;
    walk.without = tree->label[0][leaf];
    if (tree->levels > 1) {
        walk.box = lrcsi_tree_box(&tree->node[1][leaf / WALK_LANES], leaf % WALK_LANES);
    }
    for (int level = 1; level < tree->levels; level++) {
        unsigned after = ~0u << 1 << at % WALK_LANES;
        at /= WALK_LANES;
        walk.at[level] = at;
        walk.mask[level] = lrcsi_tree_meets(&tree->node[level][at], &walk.box) & after;
    }
    return walk;
}

void lrcsi_tree_narrow_by_slabs(lrcsi_tree_walk *w, uint32_t leaf)
{
    w->leaf = leaf;
    narrow_rest(w);
}

void lrcsi_tree_narrow_by_capsule(lrcsi_tree_walk *w, const lrcsi_tree_capsule *capsule)
{
    w->capsule = *capsule;
    narrow_rest(w);
}

void lrcsi_tree_narrow_by_cones(lrcsi_tree_walk *w, uint32_t leaf)
{
    w->apex = w->tree->label[0][leaf];
    w->cone = &w->tree->cone[0][leaf];
}

/* Are nodes with this label left out? LRCS_NONE: the facets of the node do not have one label. */
static int label_is_left_out(const lrcsi_tree_walk *w, uint32_t label)
{
    return label != LRCS_NONE &&
           (label == w->without || (label < 64 && (w->also_without >> label & 1) != 0));
}

uint32_t lrcsi_tree_next(lrcsi_tree_walk *w)
{
    const lrcsi_tree *tree = w->tree;
    while (w->level < tree->levels) {
        int level = w->level;
        if (w->mask[level] == 0) {
            w->level++;
            continue;
        }
        uint32_t child = w->at[level] * WALK_LANES + lrcsi_tree_lane(w->mask[level]);
        w->mask[level] &= w->mask[level] - 1;
        if (level > 0 && label_is_left_out(w, tree->label[level - 1][child])) {
            continue;
        }
        if (level > 0 && w->cone && tree->label[level - 1][child] == w->apex &&
            lrcsi_tree_cones_apart(w->cone, &tree->cone[level - 1][child])) {
            continue;
        }
        if (level == w->last) {
            return child;
        }
        w->level = level - 1;
        w->at[level - 1] = child;
        w->mask[level - 1] = lrcsi_tree_meets(&tree->node[level - 1][child], &w->box);
        w->mask[level - 1] = narrowed(w, level - 1, w->mask[level - 1]);
    }
    return LRCS_NONE;
}
