/* SPDX-License-Identifier: MIT */
/* Boxes over facets in the order of a Morton curve (Morton 1966), a complete binary tree on top.
   Where the curve runs decides speed alone. Sizes may be as uneven as they like: a large facet
   enlarges only the nodes above it.

   Plane test. With n the computed normal of the facet at origin a and w_k = |p_i q_j| + |p_j q_i|,
   each component of n errs by at most 5 u w_k (u = 2^-53; see base/exact.c), a difference x - a by
   u of itself, and the sum of three products by 3 u of its terms, so that for x in a box
       n . (x - a) > e,   e = 10 u sum w_k max |x_k - a_k|,
   at the corner where the computed value is least proves that the whole box lies above the
   plane; |n_k| <= (1 + 4u) w_k covers the last two.

   Slab test. The direction d of a node is the rounded sum of its facets' normals, taken as it is;
   d . x errs by 3 u sum |d_k x_k|, and widening the result by e rounds once more: e = 6 u of that
   sum serves. */
#include "mesh/tree.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "base/work.h"

enum { LEAF_FACETS = 4, MORTON_BITS = 21 };

#define PLANE_FILTER (10.0 * 0x1p-53)
#define SLAB_FILTER  (6.0 * 0x1p-53)
/* Covers the rounding of a distance's products with a direction's components, summed as |n|_1. */
#define WITHIN_MARGIN (1.0 + 1e-9)

static lrcsi_box empty_box(void)
{
    return (lrcsi_box){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static void grow_box(lrcsi_box *box, const double low[3], const double high[3])
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = low[k] < box->low[k] ? low[k] : box->low[k];
        box->high[k] = high[k] > box->high[k] ? high[k] : box->high[k];
    }
}

static lrcsi_box facet_box(const lrcs_point *vertex, const lrcs_facet *facet)
{
    lrcsi_box box = empty_box();
    for (int c = 0; c < 3; c++) {
        const double *x = vertex[facet->corner[c]].x;
        grow_box(&box, x, x);
    }
    return box;
}

/* Two zero bits before each of the lowest 21. */
static uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 32) & UINT64_C(0x001f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x001f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    x = (x | x << 2) & UINT64_C(0x1249249249249249);
    return x;
}

/* The place of a box's centre on the curve through `all`, whose longest side is `side`. */
static uint64_t morton_key(const lrcsi_box *box, const lrcsi_box *all, double side)
{
    const double cells = (double)((1u << MORTON_BITS) - 1);
    uint64_t key = 0;
    for (int k = 0; k < 3; k++) {
        double centre = 0.5 * (box->low[k] - all->low[k]) + 0.5 * (box->high[k] - all->low[k]);
        double cell = side > 0.0 ? centre / side * cells : 0.0;
        cell = cell > 0.0 ? cell : 0.0;
        key |= spread_bits((uint64_t)(cell < cells ? cell : cells)) << k;
    }
    return key;
}

static double longest_side(const lrcsi_box *box)
{
    double side = 0.0;
    for (int k = 0; k < 3; k++) {
        side = fmax(side, box->high[k] - box->low[k]);
    }
    return side;
}

static uint32_t leaves_for(uint32_t count)
{
    uint32_t leaves = 1;
    while (leaves < count / LEAF_FACETS + 1) {
        leaves *= 2;
    }
    return leaves;
}

/* The normal of a facet, and for each component the sum of its two terms' magnitudes. */
static void facet_normal(const double *const corner[3], double normal[3], double weight[3])
{
    const double *a = corner[0];
    const double *b = corner[1];
    const double *c = corner[2];
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        double plus = (b[i] - a[i]) * (c[j] - a[j]);
        double minus = (b[j] - a[j]) * (c[i] - a[i]);
        normal[k] = plus - minus;
        weight[k] = fabs(plus) + fabs(minus);
    }
}

/* Widens low .. high by the corners' places along a direction. */
static void widen_slab(const double *const corner[3], const double direction[3], double *low,
                       double *high)
{
    for (int c = 0; c < 3; c++) {
        double place = 0.0;
        double error = 0.0;
        for (int k = 0; k < 3; k++) {
            double term = direction[k] * corner[c][k];
            place += term;
            error += fabs(term);
        }
        error *= SLAB_FILTER;
        *low = place - error < *low ? place - error : *low;
        *high = place + error > *high ? place + error : *high;
    }
}

static void facet_corners(const lrcs_point *vertex, const lrcs_facet *facet,
                          const double *corner[3])
{
    for (int c = 0; c < 3; c++) {
        corner[c] = vertex[facet->corner[c]].x;
    }
}

/* Boxes and directions of leaves from their facets, then of nodes from their children. */
static void fill_nodes(const lrcsi_tree *tree, const lrcs_point *vertex, const lrcs_facet *facet)
{
    for (uint32_t i = 0; i < 2 * tree->leaves; i++) {
        tree->node[i] = (lrcsi_tree_node){empty_box(), {0, 0, 0}, HUGE_VAL, -HUGE_VAL};
    }
    for (uint32_t i = 0; i < tree->count; i++) {
        lrcsi_tree_node *leaf = &tree->node[tree->leaves + i / LEAF_FACETS];
        const double *corner[3];
        double normal[3];
        double weight[3];
        facet_corners(vertex, &facet[tree->order[i]], corner);
        facet_normal(corner, normal, weight);
        for (int k = 0; k < 3; k++) {
            leaf->direction[k] += normal[k];
        }
        grow_box(&leaf->box, tree->box[i].low, tree->box[i].high);
    }
    for (uint32_t i = 2 * tree->leaves - 1; i > 1; i--) {
        grow_box(&tree->node[i / 2].box, tree->node[i].box.low, tree->node[i].box.high);
        for (int k = 0; k < 3; k++) {
            tree->node[i / 2].direction[k] += tree->node[i].direction[k];
        }
    }
}

/* Slabs of all nodes, once their directions are known. */
static void fill_slabs(const lrcsi_tree *tree, const lrcs_point *vertex, const lrcs_facet *facet)
{
    for (uint32_t i = 0; i < tree->count; i++) {
        const double *corner[3];
        facet_corners(vertex, &facet[tree->order[i]], corner);
        for (uint32_t n = tree->leaves + i / LEAF_FACETS; n > 0; n /= 2) {
            lrcsi_tree_node *node = &tree->node[n];
            widen_slab(corner, node->direction, &node->low, &node->high);
        }
    }
}

/* Orders the facets already listed in order[]. */
static int sort_along_curve(const lrcs_point *vertex, const lrcs_facet *facet, lrcs_work *work,
                            const lrcsi_tree *tree)
{
    size_t mark = work->used;
    uint64_t *key = lrcsi_work_take(work, tree->count, sizeof *key);
    uint64_t *key_spare = lrcsi_work_take(work, tree->count, sizeof *key);
    uint32_t *order_spare = lrcsi_work_take(work, tree->count, sizeof *order_spare);
    work->used = mark;
    if (!key || !key_spare || !order_spare) {
        return LRCS_E_MEMORY;
    }
    lrcsi_box all = empty_box();
    for (uint32_t i = 0; i < tree->count; i++) {
        lrcsi_box box = facet_box(vertex, &facet[tree->order[i]]);
        grow_box(&all, box.low, box.high);
    }
    double side = longest_side(&all);
    for (uint32_t i = 0; i < tree->count; i++) {
        lrcsi_box box = facet_box(vertex, &facet[tree->order[i]]);
        key[i] = morton_key(&box, &all, side);
    }
    lrcsi_sort_pairs(key, tree->order, key_spare, order_spare, tree->count);
    return LRCS_OK;
}

size_t lrcsi_tree_need(uint32_t facet_count)
{
    size_t scratch = lrcsi_work_add(2 * lrcsi_work_bytes(facet_count, sizeof(uint64_t)),
                                    lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    size_t boxes = lrcsi_work_add(
        lrcsi_work_bytes(facet_count, sizeof(lrcsi_box)),
        lrcsi_work_bytes((size_t)2 * leaves_for(facet_count), sizeof(lrcsi_tree_node)));
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(uint32_t)),
                          scratch > boxes ? scratch : boxes);
}

int lrcsi_tree_make(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                    const unsigned char *skip, lrcs_work *work, lrcsi_tree *tree)
{
    size_t mark = work->used;
    lrcsi_tree made = {0, 1, NULL, NULL, NULL};
    made.order = lrcsi_work_take(work, facet_count, sizeof *made.order);
    for (uint32_t f = 0; f < facet_count && made.order; f++) {
        if (!skip || !skip[f]) {
            made.order[made.count++] = f;
        }
    }
    if (!made.order || sort_along_curve(vertex, facet, work, &made) != LRCS_OK) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    made.leaves = leaves_for(made.count);
    made.box = lrcsi_work_take(work, made.count, sizeof *made.box);
    made.node = lrcsi_work_take(work, (size_t)2 * made.leaves, sizeof *made.node);
    if (!made.box || !made.node) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < made.count; i++) {
        made.box[i] = facet_box(vertex, &facet[made.order[i]]);
    }
    fill_nodes(&made, vertex, facet);
    fill_slabs(&made, vertex, facet);
    *tree = made;
    return LRCS_OK;
}

lrcsi_tree_walk lrcsi_tree_around(const lrcsi_tree *tree, const lrcs_point *vertex,
                                  lrcs_facet facet)
{
    lrcsi_tree_walk walk = {.tree = tree, .box = facet_box(vertex, &facet), .node = 1};
    facet_corners(vertex, &facet, walk.corner);
    facet_normal(walk.corner, walk.normal, walk.weight);
    return walk;
}

lrcsi_tree_walk lrcsi_tree_within(const lrcsi_tree *tree, const lrcs_point *vertex,
                                  lrcs_facet facet, double distance)
{
    lrcsi_tree_walk walk = lrcsi_tree_around(tree, vertex, facet);
    const double *n = walk.normal;
    walk.slack = distance * WITHIN_MARGIN;
    walk.slack_plane = walk.slack * (fabs(n[0]) + fabs(n[1]) + fabs(n[2]));
    for (int k = 0; k < 3; k++) {
        walk.box.low[k] -= walk.slack;
        walk.box.high[k] += walk.slack;
    }
    return walk;
}

/* 1 where the plane test proves the box to lie strictly above or below. */
static int box_is_off_plane(const lrcsi_tree_walk *w, const lrcsi_box *box)
{
    double least = 0.0;
    double most = 0.0;
    double error = 0.0;
    for (int k = 0; k < 3; k++) {
        double low = box->low[k] - w->corner[0][k];
        double high = box->high[k] - w->corner[0][k];
        double at_low = w->normal[k] * low;
        double at_high = w->normal[k] * high;
        least += at_low < at_high ? at_low : at_high;
        most += at_low < at_high ? at_high : at_low;
        error += w->weight[k] * (fabs(low) > fabs(high) ? fabs(low) : fabs(high));
    }
    error = PLANE_FILTER * error + w->slack_plane;
    return least > error || most < -error;
}

static int box_is_candidate(const lrcsi_tree_walk *w, const lrcsi_box *box)
{
    for (int k = 0; k < 3; k++) {
        if (box->low[k] > w->box.high[k] || box->high[k] < w->box.low[k]) {
            return 0;
        }
    }
    return !box_is_off_plane(w, box);
}

static int node_is_candidate(const lrcsi_tree_walk *w, const lrcsi_tree_node *node)
{
    if (!box_is_candidate(w, &node->box)) {
        return 0;
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    widen_slab(w->corner, node->direction, &low, &high);
    const double *d = node->direction;
    double slack = w->slack * (fabs(d[0]) + fabs(d[1]) + fabs(d[2]));
    return low - slack <= node->high && high + slack >= node->low;
}

/* The node after this one and all below it, from left to right, or 0. */
static uint32_t node_after(uint32_t node)
{
    while (node & 1) {
        node >>= 1;
    }
    return node ? node + 1 : 0;
}

/* Moves to the facets of the next leaf that holds candidates; 0 at the end. */
static int next_leaf(lrcsi_tree_walk *w)
{
    const lrcsi_tree *tree = w->tree;
    while (w->node) {
        uint32_t node = w->node;
        int candidate = node_is_candidate(w, &tree->node[node]);
        if (candidate && node < tree->leaves) {
            w->node = 2 * node;
            continue;
        }
        w->node = node_after(node);
        if (candidate) {
            w->at = (node - tree->leaves) * LEAF_FACETS;
            w->end = tree->count - w->at < LEAF_FACETS ? tree->count : w->at + LEAF_FACETS;
            return 1;
        }
    }
    return 0;
}

uint32_t lrcsi_tree_next(lrcsi_tree_walk *walk)
{
    do {
        while (walk->at < walk->end) {
            uint32_t i = walk->at++;
            if (box_is_candidate(walk, &walk->tree->box[i])) {
                return walk->tree->order[i];
            }
        }
    } while (next_leaf(walk));
    return LRCS_NONE;
}
