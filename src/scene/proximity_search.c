/* SPDX-License-Identifier: MIT */
/* Searches the tree of facets, for a leaf of it at a time. It does not decide how near is near
   enough (scene/proximity.c). */
#include "scene/proximity_search.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/contact/tree_capsule.h"
#include "mesh/contact/tree_walk.h"
#include "scene/proximity.h"
#include "scene/proximity_contact.h"
#include "scene/proximity_pair.h"

/* A fraction as a float, rounded up. */
static float fraction_float(double fraction)
{
    return (float)lrcsi_min(1, fraction * LRCSI_OUTWARD_FLOAT);
}

/* Pairs are allocated so many at a time, and must be contiguous. */
enum { PAIRS_TAKEN = 4 };
_Static_assert(PAIRS_TAKEN * sizeof(lrcsi_proximity_pair) % LRCS_WORK_ALIGN == 0,
               "no gaps between pairs");

/* How far from the plane of a facet of another part points of a facet matter, at most its slack:
   visibility/proximity/proximity_band.c, 1.f. */
static double slack_along(const lrcs_prepared *p, uint32_t other, double slack,
                          const lrcsi_displacement *displacement)
{
    const uint32_t part = p->scene->facet_part[other];
    const double theirs = p->proximity.hausdorff[part];
    double n[3];
    lrcsi_prepared_unit_normal(p, other, n);
    return theirs > 0 && lrcsi_proximity_openings(p, part) > 0
               ? slack
               : lrcsi_min(slack, lrcsi_displacement_along(displacement, n) + theirs +
                                      LRCSI_PROXIMITY_ERR);
}

/* Adds a pair if part of the facet is within the slack of the other. Given: how far the facet's
   points are displaced. */
static int proximity_add(lrcs_prepared *p, uint32_t facet, uint32_t other, double slack,
                         const lrcsi_contact_wall *wall, lrcs_work *work)
{
    lrcsi_proximity *proximity = &p->proximity;
    const double along = slack_along(p, other, slack, &wall->displacement);
    const lrcsi_slice slice = lrcsi_proximity_slice(p, facet, other, slack, along);
    if (slice.count == 0) {
        return LRCS_OK;
    }
    const double *const corner[3] = {lrcsi_prepared_corner(p, facet, 0),
                                     lrcsi_prepared_corner(p, facet, 1),
                                     lrcsi_prepared_corner(p, facet, 2)};
    const lrcsi_sides_fraction of = lrcsi_proximity_slice_fractions(p, facet, &slice, other);
    const lrcsi_row_range rows = lrcsi_proximity_rows(p, facet, corner, &slice);
    if (!(of.front > 0 || of.back > 0)) {
        return LRCS_OK;
    }
    if (proximity->count % PAIRS_TAKEN == 0) {
        lrcsi_proximity_pair *more = lrcsi_work_take(work, PAIRS_TAKEN, sizeof *more);
        if (!more) {
            return LRCS_E_MEMORY;
        }
        proximity->pair = proximity->pair ? proximity->pair : more;
    }
    lrcsi_contact_fractions contact;
    if (!lrcsi_contact_fractions_make(p, wall, facet, other, slack, along, &slice, &contact)) {
        contact = (lrcsi_contact_fractions){of.back, of.front};
    }
    proximity->pair[proximity->count++] =
        (lrcsi_proximity_pair){facet,
                               other,
                               fraction_float(of.front),
                               fraction_float(of.back),
                               (float)(rows.low * (2 - LRCSI_OUTWARD_FLOAT)),
                               fraction_float(rows.high),
                               fraction_float(lrcsi_min(contact.gain, of.back)),
                               fraction_float(lrcsi_min(contact.loss, of.front))};
    return LRCS_OK;
}

/* If the box of a leaf of the tree is near those of more than MANY_NEAR facets, the nodes that are
   left are also compared with the leaf by capsules (mesh/contact/tree_capsule.h); if these separate
   at least NEAR_NODES_APART nodes from it, so are those of the next leaf, from the start. The
   capsules of the tree are filled once leaves have met CAPSULES_COST times as many others as there
   are leaves: heuristics. */
enum { MANY_NEAR = 32, NEAR_NODES_APART = 4, CAPSULES_COST = 2 };

/* The search for pairs, one leaf of the tree after the other. */
typedef struct pair_search {
    lrcsi_tree tree;
    uint64_t excess;  /* facets that were met beyond the first MANY_NEAR of a leaf, in all */
    int capsules_pay; /* capsules separated at least NEAR_NODES_APART nodes from the last leaf */
} pair_search;

enum { PAIR_LANES = LRCSI_TREE_LANES };

/* The facets of curved parts in a leaf. */
typedef struct pair_leaf {
    unsigned lanes;                      /* theirs */
    lrcsi_box box;                       /* around them */
    double reach;                        /* the largest of their parts */
    lrcsi_contact_wall wall[PAIR_LANES]; /* how their points are displaced */
} pair_leaf;

static uint32_t lane_facet(const lrcsi_tree *tree, uint32_t leaf, uint32_t lane)
{
    return tree->order[leaf * PAIR_LANES + lane];
}

static pair_leaf pair_leaf_make(const lrcs_prepared *p, const lrcsi_tree *tree, uint32_t leaf)
{
    pair_leaf of = {.lanes = 0, .box = lrcsi_box_empty()};
    const uint32_t left = tree->count - leaf * PAIR_LANES;
    for (uint32_t lane = 0; lane < PAIR_LANES && lane < left; lane++) {
        const uint32_t facet = lane_facet(tree, leaf, lane);
        const double reach = p->proximity.reach[p->scene->facet_part[facet]];
        if (reach > 0) {
            const lrcsi_box box = lrcsi_tree_box(&tree->node[0][leaf], lane);
            lrcsi_box_add(&of.box, box.low);
            lrcsi_box_add(&of.box, box.high);
            of.lanes |= 1u << lane;
            of.reach = lrcsi_max(of.reach, reach);
            of.wall[lane] = lrcsi_contact_wall_make(p, facet);
        }
    }
    return of;
}

/* A box that contains what is within a distance of another. */
static lrcsi_box box_within(const lrcsi_box *box, double distance)
{
    lrcsi_box wide = *box;
    for (int k = 0; k < 3; k++) {
        wide.low[k] -= distance;
        wide.high[k] += distance;
    }
    return wide;
}

/* The distance between two boxes along the axis where it is largest; negative if they overlap. */
static double boxes_gap(const lrcsi_box *a, const lrcsi_box *b)
{
    double gap = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        gap = lrcsi_max3(gap, a->low[k] - b->high[k], b->low[k] - a->high[k]);
    }
    return gap;
}

/* Adds the pairs of a facet of a curved part and another one of another part, in both orders. If
   both parts are curved, only the order in which this facet comes first is added here: the other
   order is added for the other facet. Given: the gap between their boxes, and the displacement of
   the first one's points. */
static int pairs_of_two(lrcs_prepared *p, uint32_t facet, uint32_t other, double gap,
                        const lrcsi_contact_wall *wall, lrcs_work *work)
{
    const lrcsi_contact_wall none = {.known = 1};
    const uint32_t *part = p->scene->facet_part;
    const double slack = lrcsi_proximity_slack(p, part[facet], part[other]);
    int status = gap <= slack ? proximity_add(p, facet, other, slack, wall, work) : LRCS_OK;
    if (status == LRCS_OK && p->proximity.reach[part[other]] == 0) {
        const double back = lrcsi_proximity_slack(p, part[other], part[facet]);
        status = gap <= back ? proximity_add(p, other, facet, back, &none, work) : LRCS_OK;
    }
    return status;
}

/* From here on compares nodes with the capsule of a leaf, `within` wider. */
static void narrow_search(const lrcsi_tree *tree, uint32_t leaf, double within,
                          lrcsi_tree_walk *walk)
{
    if (tree->levels > 1) {
        lrcsi_tree_capsule capsule =
            lrcsi_tree_lane_capsule(tree, 1, leaf / PAIR_LANES, leaf % PAIR_LANES);
        capsule.radius += within;
        lrcsi_tree_narrow_by_capsule(walk, &capsule);
    }
}

/* Adds the pairs of the facets of curved parts in a leaf and those of other parts. */
static int pairs_of_leaf(lrcs_prepared *p, uint32_t leaf, const pair_leaf *of, pair_search *search,
                         lrcs_work *work)
{
    lrcsi_tree *tree = &search->tree;
    const uint32_t *part = p->scene->facet_part;
    const double within = 2 * (of->reach + p->proximity.max_hausdorff) + LRCSI_PROXIMITY_ERR;
    const lrcsi_box wide = box_within(&of->box, within);
    lrcsi_tree_walk walk = lrcsi_tree_within(tree, &wide, tree->label[0][leaf]);
    int status = LRCS_OK;
    uint32_t at;
    if (search->capsules_pay) {
        narrow_search(tree, leaf, within, &walk);
    }
    for (uint32_t met = 0; status == LRCS_OK && (at = lrcsi_tree_next(&walk)) != LRCS_NONE; met++) {
        search->excess += met >= MANY_NEAR;
        if (!tree->has_capsules && search->excess > (uint64_t)CAPSULES_COST * tree->nodes[0]) {
            lrcsi_tree_fill_capsules(p->vertex, p->scene->facet, tree);
        }
        if (tree->has_capsules && met == MANY_NEAR && !search->capsules_pay) {
            narrow_search(tree, leaf, within, &walk);
        }
        const uint32_t other = tree->order[at];
        const lrcsi_box other_box =
            lrcsi_tree_box(&tree->node[0][at / PAIR_LANES], at % PAIR_LANES);
        const lrcsi_box near = box_within(&other_box, within);
        unsigned lanes = of->lanes & lrcsi_tree_meets(&tree->node[0][leaf], &near);
        for (; lanes != 0 && status == LRCS_OK; lanes &= lanes - 1) {
            const uint32_t lane = lrcsi_tree_lane(lanes);
            const uint32_t facet = lane_facet(tree, leaf, lane);
            if (part[other] != part[facet]) {
                const lrcsi_box box = lrcsi_tree_box(&tree->node[0][leaf], lane);
                status = pairs_of_two(p, facet, other, boxes_gap(&box, &other_box), &of->wall[lane],
                                      work);
            }
        }
    }
    search->capsules_pay = walk.apart >= NEAR_NODES_APART;
    return status;
}

/* How far a facet of a part is from others that it is near, at most. */
static double near_distance(const lrcs_prepared *p, double reach)
{
    const double most = lrcsi_max(reach, p->proximity.max_hausdorff);
    return LRCSI_PROXIMITY_NEAR * (p->proximity.max_hausdorff + most + 2 * LRCSI_PROXIMITY_ERR);
}

/* Notes which other parts a facet with the given box is near. Of each part that it is near, only
   facets in nodes together with those of other parts are met after the first one. */
static void near_find(lrcs_prepared *p, uint32_t facet, const lrcsi_box *box,
                      const lrcsi_tree *tree)
{
    const uint32_t *part = p->scene->facet_part;
    const lrcsi_box wide = box_within(box, near_distance(p, p->proximity.reach[part[facet]]));
    lrcsi_tree_walk walk = lrcsi_tree_within(tree, &wide, part[facet]);
    lrcsi_part_set *near = &p->proximity.near[facet];
    for (uint32_t at; (at = lrcsi_tree_next(&walk)) != LRCS_NONE;) {
        const uint32_t other = tree->order[at];
        const lrcsi_part_set set = lrcsi_part_set_of(part[other]);
        if (part[other] == part[facet] || (*near & set) != 0) {
            continue;
        }
        const double distance =
            LRCSI_PROXIMITY_NEAR * lrcsi_proximity_slack(p, part[facet], part[other]);
        const lrcsi_box other_box = lrcsi_box_of(p->vertex, &p->scene->facet[other]);
        if (boxes_gap(box, &other_box) <= distance &&
            lrcsi_proximity_slice(p, facet, other, distance, distance).count > 0) {
            *near |= set;
            walk.also_without |= part[other] < LRCSI_PART_SET_SINGLE ? set : 0;
        }
    }
}

/* Finds what the facets on round walls in a leaf are near: nothing, if no other part is near their
   box. */
static void near_of_leaf(lrcs_prepared *p, uint32_t leaf, const pair_leaf *of,
                         const lrcsi_tree *tree)
{
    const lrcsi_box wide = box_within(&of->box, near_distance(p, of->reach));
    lrcsi_tree_walk walk = lrcsi_tree_within(tree, &wide, tree->label[0][leaf]);
    if (lrcsi_tree_next(&walk) == LRCS_NONE) {
        return;
    }
    for (unsigned lanes = of->lanes; lanes != 0; lanes &= lanes - 1) {
        const uint32_t lane = lrcsi_tree_lane(lanes);
        const uint32_t facet = lane_facet(tree, leaf, lane);
        if (lrcsi_proximity_on_round_wall(p, facet)) {
            const lrcsi_box box = lrcsi_tree_box(&tree->node[0][leaf], lane);
            near_find(p, facet, &box, tree);
        }
    }
}

/* Their list grows above the tree in the work area, and is moved to the place of
   the tree at the end. */
int lrcsi_proximity_search(lrcs_prepared *p, lrcs_work *work)
{
    lrcsi_proximity *proximity = &p->proximity;
    const lrcs_scene *scene = p->scene;
    pair_search search = {.excess = 0};
    size_t mark = work->used;
    int status = lrcsi_tree_make(p->vertex, scene->facet, scene->facet_count, p->skip,
                                 scene->facet_part, 0, work, &search.tree);
    for (uint32_t leaf = 0; status == LRCS_OK && leaf < search.tree.nodes[0]; leaf++) {
        const pair_leaf of = pair_leaf_make(p, &search.tree, leaf);
        if (of.lanes != 0) {
            status = pairs_of_leaf(p, leaf, &of, &search, work);
            near_of_leaf(p, leaf, &of, &search.tree);
        }
    }
    work->used = mark;
    if (status == LRCS_OK) {
        const lrcsi_proximity_pair *above = proximity->pair;
        proximity->pair = lrcsi_work_take(work, proximity->count, sizeof *proximity->pair);
        status = proximity->pair ? LRCS_OK : LRCS_E_MEMORY;
        for (size_t i = 0; i < proximity->count && status == LRCS_OK; i++) {
            proximity->pair[i] = above[i];
        }
    }
    return status;
}
