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

   Fan test. A facet F = v b c, and facets T that have the corner v too. For any vector m with
   m . (b - v) > 0 and m . (c - v) > 0, and m . (x - v) < 0 for the other corners x of T, F lies
   above the plane through v and T below it, so that v is all they have in common. Thus m need not
   be accurate; the signs must be right. Differences, products and sums round 4 times: 10 u of the
   sum of magnitudes is above the error. Components of m are zero or 2^-100 .. 1, so that nothing
   underflows. A box is below where its highest corner is. So the facets about the tip of a cone or
   the middle of a disc, whose boxes all meet, do not all become candidates of each other.

   Slab test. The direction d of a node is the rounded sum of its facets' normals, taken as it is;
   d . x errs by 3 u sum |d_k x_k|, and widening the result by e rounds once more: e = 6 u of that
   sum serves. */
#include "mesh/tree.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "base/work.h"

enum { LEAF_FACETS = 8, MORTON_BITS = 21 };

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

/* Behind the last place of a leaf that is not empty. */
static uint32_t leaf_end(const lrcsi_tree *tree, uint32_t leaf)
{
    uint32_t first = leaf * LEAF_FACETS;
    return tree->count - first < LEAF_FACETS ? tree->count : first + LEAF_FACETS;
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

/* ---- what the facets below a node have in common ---- */

static int node_is_empty(const lrcsi_tree_node *node)
{
    return node->box.low[0] > node->box.high[0];
}

/* All of a node's box. */
static lrcsi_box node_box(const lrcsi_tree *tree, const lrcsi_tree_node *node)
{
    lrcsi_box box = node->box;
    if (node->hub != LRCS_NONE) {
        const double *x = tree->vertex[node->hub].x;
        grow_box(&box, x, x);
    }
    return box;
}

/* Has a facet the corner v, and another one? */
static int facet_is_about(const lrcs_facet *facet, uint32_t v)
{
    const uint32_t *c = facet->corner;
    return (c[0] == v || c[1] == v || c[2] == v) && (c[0] != v || c[1] != v || c[2] != v);
}

/* A corner of all the facets order[first .. end), or LRCS_NONE. */
static uint32_t common_corner(const lrcsi_tree *tree, uint32_t first, uint32_t end)
{
    for (int k = 0; k < 3; k++) {
        uint32_t v = tree->facet[tree->order[first]].corner[k];
        uint32_t i = first;
        while (i < end && facet_is_about(&tree->facet[tree->order[i]], v)) {
            i++;
        }
        if (i == end) {
            return v;
        }
    }
    return LRCS_NONE;
}

static void fill_leaf(const lrcsi_tree *tree, uint32_t leaf, const uint32_t *group)
{
    lrcsi_tree_node *node = &tree->node[tree->leaves + leaf];
    uint32_t first = leaf * LEAF_FACETS;
    uint32_t end = leaf_end(tree, leaf);
    node->hub = common_corner(tree, first, end);
    node->group = group ? group[tree->order[first]] : LRCS_NONE;
    for (uint32_t i = first; i < end; i++) {
        const lrcs_facet *facet = &tree->facet[tree->order[i]];
        const double *corner[3];
        double normal[3];
        double weight[3];
        facet_corners(tree->vertex, facet, corner);
        facet_normal(corner, normal, weight);
        for (int k = 0; k < 3; k++) {
            node->direction[k] += normal[k];
            if (facet->corner[k] != node->hub) {
                grow_box(&node->box, corner[k], corner[k]);
            }
        }
        if (group && group[tree->order[i]] != node->group) {
            node->group = LRCS_NONE;
        }
    }
}

/* A node from its children, of which the right one may be empty. */
static void fill_parent(const lrcsi_tree *tree, uint32_t parent)
{
    lrcsi_tree_node *node = &tree->node[parent];
    const lrcsi_tree_node *left = &tree->node[2 * (size_t)parent];
    const lrcsi_tree_node *right = left + 1;
    int alone = node_is_empty(right);
    node->hub = alone || left->hub == right->hub ? left->hub : LRCS_NONE;
    node->group = alone || left->group == right->group ? left->group : LRCS_NONE;
    for (const lrcsi_tree_node *child = left; child <= right; child++) {
        lrcsi_box box = node->hub == LRCS_NONE ? node_box(tree, child) : child->box;
        grow_box(&node->box, box.low, box.high);
        for (int k = 0; k < 3; k++) {
            node->direction[k] += child->direction[k];
        }
    }
}

static void fill_nodes(const lrcsi_tree *tree, const uint32_t *group)
{
    for (uint32_t i = 0; i < 2 * tree->leaves; i++) {
        tree->node[i] =
            (lrcsi_tree_node){empty_box(), {0, 0, 0}, HUGE_VAL, -HUGE_VAL, LRCS_NONE, LRCS_NONE};
    }
    for (uint32_t leaf = 0; leaf * LEAF_FACETS < tree->count; leaf++) {
        fill_leaf(tree, leaf, group);
    }
    for (uint32_t i = tree->leaves - 1; i > 0; i--) {
        fill_parent(tree, i);
    }
}

/* Slabs of all nodes, once their directions are known. */
static void fill_slabs(const lrcsi_tree *tree)
{
    for (uint32_t i = 0; i < tree->count; i++) {
        const double *corner[3];
        facet_corners(tree->vertex, &tree->facet[tree->order[i]], corner);
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
                    const unsigned char *skip, const uint32_t *group, lrcs_work *work,
                    lrcsi_tree *tree)
{
    size_t mark = work->used;
    lrcsi_tree made = {.vertex = vertex, .facet = facet};
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
    fill_nodes(&made, group);
    fill_slabs(&made);
    *tree = made;
    return LRCS_OK;
}

/* ---- facets that have a corner in common ---- */

/* m . (x - corner) is surely negative; with m turned round, surely positive. */
static int is_below(const double m[3], const double corner[3], const double x[3], double turn)
{
    double height = 0.0;
    double error = 0.0;
    for (int k = 0; k < 3; k++) {
        double term = m[k] * (x[k] - corner[k]);
        height += term;
        error += fabs(term);
    }
    return turn * height < -PLANE_FILTER * error;
}

/* Tilted by this about the corner, a plane along a side has all of the side above it. */
#define FAN_TILT 0x1p-20

/* The plane at corner v of facet v b c along the side to b, across the facet's plane. Returns 0
   where it is not proved to lie below the facet. */
static int fan_plane(const double *v, const double *b, const double *c, const double normal[3],
                     double m[3])
{
    double along[3];
    double inward = 0.0;
    for (int k = 0; k < 3; k++) {
        along[k] = b[k] - v[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        m[k] = normal[i] * along[j] - normal[j] * along[i];
        inward += m[k] * (c[k] - v[k]);
    }
    double length = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    double size = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (int k = 0; k < 3; k++) {
        m[k] = (inward < 0.0 ? -m[k] : m[k]) / size + FAN_TILT * along[k] / length;
        m[k] = fabs(m[k]) < 0x1p-100 ? 0.0 : m[k];
    }
    return is_below(m, v, b, -1.0) && is_below(m, v, c, -1.0);
}

/* The planes at the walk's corner k. */
static const lrcsi_tree_fan *fan_at(lrcsi_tree_walk *w, int k)
{
    lrcsi_tree_fan *fan = &w->fan[k];
    const double *v = w->corner[k];
    const double *next = w->corner[(k + 1) % 3];
    const double *last = w->corner[(k + 2) % 3];
    if (!fan->made) {
        fan->made = 1;
        fan->known[0] = fan_plane(v, next, last, w->normal, fan->m[0]);
        fan->known[1] = fan_plane(v, last, next, w->normal, fan->m[1]);
    }
    return fan;
}

/* Have all facets of a node but its hub in common with the walk's? */
static int hub_is_all(lrcsi_tree_walk *w, const lrcsi_tree_node *node)
{
    int k = 0;
    while (k < 3 && w->own[k] != node->hub) {
        k++;
    }
    const lrcsi_tree_fan *fan = k < 3 ? fan_at(w, k) : NULL;
    for (int side = 0; side < 2 && fan; side++) {
        double highest[3];
        for (int i = 0; i < 3; i++) {
            highest[i] = fan->m[side][i] > 0.0 ? node->box.high[i] : node->box.low[i];
        }
        if (fan->known[side] && is_below(fan->m[side], w->corner[k], highest, 1.0)) {
            return 1;
        }
    }
    return 0;
}

int lrcsi_tree_corner(lrcsi_tree_walk *w, uint32_t candidate)
{
    const uint32_t *c = w->tree->facet[candidate].corner;
    int shared = 0;
    int own = 0;
    int its = 0;
    for (int i = 0; i < 9; i++) {
        if (w->own[i / 3] == c[i % 3]) {
            own = i / 3;
            its = i % 3;
            shared++;
        }
    }
    const lrcsi_tree_fan *fan = shared == 1 ? fan_at(w, own) : NULL;
    for (int side = 0; side < 2 && fan; side++) {
        const double *v = w->corner[own];
        if (fan->known[side] &&
            is_below(fan->m[side], v, w->tree->vertex[c[(its + 1) % 3]].x, 1.0) &&
            is_below(fan->m[side], v, w->tree->vertex[c[(its + 2) % 3]].x, 1.0)) {
            return 1;
        }
    }
    return 0;
}

/* The node after this one and all below it, from left to right, or 0. */
static uint32_t node_after(uint32_t node)
{
    while (node & 1) {
        node >>= 1;
    }
    return node ? node + 1 : 0;
}

static lrcsi_tree_walk walk_start(const lrcsi_tree *tree, lrcs_facet facet)
{
    lrcsi_tree_walk walk = {.tree = tree, .without = LRCS_NONE, .node = 1};
    walk.box = facet_box(tree->vertex, &facet);
    facet_corners(tree->vertex, &facet, walk.corner);
    facet_normal(walk.corner, walk.normal, walk.weight);
    for (int k = 0; k < 3; k++) {
        walk.own[k] = facet.corner[k];
    }
    return walk;
}

lrcsi_tree_walk lrcsi_tree_after(const lrcsi_tree *tree, uint32_t place)
{
    lrcsi_tree_walk walk = walk_start(tree, tree->facet[tree->order[place]]);
    uint32_t leaf = place / LEAF_FACETS;
    walk.at = place + 1;
    walk.end = leaf_end(tree, leaf);
    walk.node = node_after(tree->leaves + leaf);
    return walk;
}

lrcsi_tree_walk lrcsi_tree_within(const lrcsi_tree *tree, lrcs_facet facet, double distance,
                                  uint32_t without)
{
    lrcsi_tree_walk walk = walk_start(tree, facet);
    const double *n = walk.normal;
    walk.without = without;
    walk.slack = distance * WITHIN_MARGIN;
    walk.slack_plane = walk.slack * (fabs(n[0]) + fabs(n[1]) + fabs(n[2]));
    for (int k = 0; k < 3; k++) {
        walk.own[k] = LRCS_NONE;
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

static int node_is_candidate(lrcsi_tree_walk *w, const lrcsi_tree_node *node)
{
    if (node->group == w->without && node->group != LRCS_NONE) {
        return 0;
    }
    if (node->hub == LRCS_NONE) {
        if (!box_is_candidate(w, &node->box)) {
            return 0;
        }
    } else {
        lrcsi_box box = node_box(w->tree, node);
        if (!box_is_candidate(w, &box) || hub_is_all(w, node)) {
            return 0;
        }
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    widen_slab(w->corner, node->direction, &low, &high);
    const double *d = node->direction;
    double slack = w->slack * (fabs(d[0]) + fabs(d[1]) + fabs(d[2]));
    return low - slack <= node->high && high + slack >= node->low;
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
            w->end = leaf_end(tree, node - tree->leaves);
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
