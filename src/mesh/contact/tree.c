/* SPDX-License-Identifier: MIT */
/* Builds the tree. Facets are sorted along a Morton curve (Morton 1966); nodes have the boxes of
   eight consecutive ones, then of eight nodes, and so on. The order affects only speed.

   The curve has about as many cells on a surface as there are facets. If many centres
   nevertheless share a cell, because a few others are far away, these facets are sorted again along
   a curve through their own box, and so on: every cluster gets its own scale. A facet with an apex
   is sorted by the apex first, and among the facets of the apex by its centre. Each time the box
   shrinks by at least a factor of 2^MORTON_MIN - 1, and differences of coordinates lie between
   2^1 and 2^-352 (base/exact.c): at most 45 times by apexes and 45 by centres. Facets with the same
   centre stay together. */
#include "mesh/contact/tree.h"

#include <string.h>

#include "base/ieee.h"
#include "base/sort.h"
#include "base/work.h"

enum { TREE_LANES = LRCSI_TREE_LANES };

/* Bits of a cell's number along each axis. */
enum { MORTON_MIN = 8, MORTON_MAX = 21 };

/* More facets than this in one cell are sorted again; the largest number of nested curves. */
enum { CELL_FACETS = 64, SCALES = 96 };

/* ---- the order ---- */

/* The lowest 21 bits, with two zero bits inserted before each. */
static uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 32) & UINT64_C(0x001f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x001f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    x = (x | x << 2) & UINT64_C(0x1249249249249249);
    return x;
}

/* Facets being ordered. */
typedef struct tree_sort {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    const uint32_t *apex; /* or NULL */
    lrcs_point *centre;   /* of those at the same places of order[] */
    uint32_t *order, *order_spare;
    uint64_t *key, *key_spare;
} tree_sort;

/* Twice the centre of a facet's box, or twice its apex. */
static inline lrcs_point facet_centre(const tree_sort *s, const uint32_t *apex, uint32_t place)
{
    uint32_t f = s->order[place];
    const uint32_t *corner = s->facet[f].corner;
    int at_apex = apex && apex[f] != LRCS_NONE;
    const double *a = s->vertex[at_apex ? apex[f] : corner[0]].x;
    const double *b = s->vertex[at_apex ? apex[f] : corner[1]].x;
    const double *c = s->vertex[at_apex ? apex[f] : corner[2]].x;
    lrcs_point centre;
    for (int k = 0; k < 3; k++) {
        centre.x[k] =
            lrcsi_min(lrcsi_min(a[k], b[k]), c[k]) + lrcsi_max(lrcsi_max(a[k], b[k]), c[k]);
    }
    return centre;
}

/* Sorts places first .. end along a curve through the box of their centres; returns 0, and does
   nothing, if that box is a point. */
static int sort_along_curve(const tree_sort *s, const uint32_t *apex, uint32_t first, uint32_t end)
{
    lrcsi_box all = lrcsi_box_empty();
    for (uint32_t i = first; i < end; i++) {
        s->centre[i] = facet_centre(s, apex, i);
        lrcsi_box_add(&all, s->centre[i].x);
    }
    double side = lrcsi_box_side(&all);
    if (!(side > 0.0)) {
        return 0;
    }
    int bits = MORTON_MIN;
    while (bits < MORTON_MAX && (UINT64_C(1) << 2 * bits) < end - first) {
        bits++;
    }
    const double scale = (double)((UINT64_C(1) << bits) - 1) / side;
    for (uint32_t i = first; i < end; i++) {
        uint64_t key = 0;
        for (int k = 0; k < 3; k++) {
            double cell = (s->centre[i].x[k] - all.low[k]) * scale; /* 0 .. cells, and rounding */
            key |= spread_bits((uint64_t)cell) << k;
        }
        s->key[i] = key;
    }
    lrcsi_sort_pairs(s->key + first, s->order + first, s->key_spare, s->order_spare, end - first);
    return 1;
}

/* Sorts all places along one curve, then along another one for all that share a cell or an apex. */
static void sort_places(const tree_sort *s, uint32_t count)
{
    uint32_t end[SCALES] = {count};
    int scales = 1;
    uint32_t first = 0;
    memset(s->key, 0, count * sizeof *s->key);
    while (first < count) {
        while (first == end[scales - 1]) {
            scales--;
        }
        uint32_t next = first + 1;
        while (next < end[scales - 1] && s->key[next] == s->key[first]) {
            next++;
        }
        if (next - first > CELL_FACETS && scales < SCALES &&
            (sort_along_curve(s, s->apex, first, next) ||
             (s->apex && sort_along_curve(s, NULL, first, next)))) {
            end[scales++] = next;
        } else {
            first = next;
        }
    }
}

/* ---- the tree ---- */

static uint32_t nodes_for(uint32_t count)
{
    return count / TREE_LANES + (count % TREE_LANES != 0);
}

/* Allocates a tree over tree->count facets. */
static int take_levels(lrcs_work *work, lrcsi_tree *tree)
{
    uint32_t below = tree->count;
    while (below > 1 || (below == 1 && tree->levels == 0)) {
        int l = tree->levels++;
        below = nodes_for(below);
        tree->nodes[l] = below;
        tree->node[l] = lrcsi_work_take(work, below, sizeof *tree->node[l]);
        tree->label[l] = lrcsi_work_take(work, below, sizeof *tree->label[l]);
        tree->slabs[l] = lrcsi_work_take(work, l > 0 ? below : 0, sizeof *tree->slabs[l]);
        tree->capsules[l] = lrcsi_work_take(work, l > 0 ? below : 0, sizeof *tree->capsules[l]);
        tree->cone[l] = lrcsi_work_take(work, below, sizeof *tree->cone[l]);
        if (!tree->node[l] || !tree->label[l] || !tree->slabs[l] || !tree->capsules[l] ||
            !tree->cone[l]) {
            return LRCS_E_MEMORY;
        }
    }
    return LRCS_OK;
}

/* -0 becomes 0. */
static void put_box(lrcsi_tree_node *node, uint32_t lane, const lrcsi_box *box)
{
    for (int k = 0; k < 3; k++) {
        node->low[k][lane] = box->low[k] + 0.0;
        node->high[k][lane] = box->high[k] + 0.0;
    }
}

/* Fills node b of level 0: the boxes of its facets, and their common label. */
static void fill_leaf(const tree_sort *s, const uint32_t *label, const lrcsi_tree *tree, uint32_t b)
{
    lrcsi_tree_node *node = &tree->node[0][b];
    uint32_t first = b * TREE_LANES;
    uint32_t common = label ? label[s->order[first]] : LRCS_NONE;
    for (uint32_t lane = 0; lane < TREE_LANES; lane++) {
        lrcsi_box box = lrcsi_box_empty();
        if (lane < tree->count - first) {
            uint32_t f = s->order[first + lane];
            box = lrcsi_box_of(s->vertex, &s->facet[f]);
            common = label && label[f] == common ? common : LRCS_NONE;
        }
        put_box(node, lane, &box);
    }
    tree->label[0][b] = common;
}

/* The box around all of a node's boxes. */
static lrcsi_box node_box(const lrcsi_tree_node *node)
{
    lrcsi_box box;
    for (int k = 0; k < 3; k++) {
        double low = node->low[k][0];
        double high = node->high[k][0];
        for (int lane = 1; lane < TREE_LANES; lane++) {
            low = node->low[k][lane] < low ? node->low[k][lane] : low;
            high = node->high[k][lane] > high ? node->high[k][lane] : high;
        }
        box.low[k] = low;
        box.high[k] = high;
    }
    return box;
}

/* Fills node b of a level above from the nodes below it. */
static void fill_node(const lrcsi_tree *tree, int level, uint32_t b)
{
    uint32_t first = b * TREE_LANES;
    uint32_t common = tree->label[level - 1][first];
    for (uint32_t lane = 0; lane < TREE_LANES; lane++) {
        lrcsi_box box = lrcsi_box_empty();
        if (lane < tree->nodes[level - 1] - first) {
            box = node_box(&tree->node[level - 1][first + lane]);
            common = tree->label[level - 1][first + lane] == common ? common : LRCS_NONE;
        }
        put_box(&tree->node[level][b], lane, &box);
    }
    tree->label[level][b] = common;
}

size_t lrcsi_tree_need(uint32_t facet_count)
{
    size_t scratch = lrcsi_work_add(lrcsi_work_blocks(2, facet_count, sizeof(uint64_t)),
                                    lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    scratch = lrcsi_work_add(scratch, lrcsi_work_bytes(facet_count, sizeof(lrcs_point)));
    size_t boxes = 0;
    uint32_t below = facet_count;
    for (int l = 0; l < LRCSI_TREE_LEVELS; l++) {
        below = nodes_for(below);
        boxes = lrcsi_work_add(boxes, lrcsi_work_bytes(below, sizeof(lrcsi_tree_node)));
        boxes = lrcsi_work_add(boxes, lrcsi_work_bytes(below, sizeof(uint32_t)));
        boxes =
            lrcsi_work_add(boxes, lrcsi_work_bytes(l > 0 ? below : 0, sizeof(lrcsi_tree_slabs)));
        boxes =
            lrcsi_work_add(boxes, lrcsi_work_bytes(l > 0 ? below : 0, sizeof(lrcsi_tree_capsules)));
        boxes = lrcsi_work_add(boxes, lrcsi_work_bytes(below, sizeof(lrcsi_tree_cone)));
    }
    return lrcsi_work_add(lrcsi_work_bytes(facet_count, sizeof(uint32_t)),
                          scratch > boxes ? scratch : boxes);
}

int lrcsi_tree_make(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                    const unsigned char *skip, const uint32_t *label, int apexes, lrcs_work *work,
                    lrcsi_tree *tree)
{
    size_t mark = work->used;
    lrcsi_tree made = {.order = lrcsi_work_take(work, facet_count, sizeof *made.order)};
    size_t kept = work->used;
    tree_sort s = {
        .vertex = vertex, .facet = facet, .apex = apexes ? label : NULL, .order = made.order};
    s.key = lrcsi_work_take(work, facet_count, sizeof *s.key);
    s.key_spare = lrcsi_work_take(work, facet_count, sizeof *s.key_spare);
    s.order_spare = lrcsi_work_take(work, facet_count, sizeof *s.order_spare);
    s.centre = lrcsi_work_take(work, facet_count, sizeof *s.centre);
    work->used = kept;
    int status = LRCS_E_MEMORY;
    if (s.order && s.key && s.key_spare && s.order_spare && s.centre) {
        for (uint32_t f = 0; f < facet_count; f++) {
            if (!skip || !skip[f]) {
                made.order[made.count++] = f;
            }
        }
        sort_places(&s, made.count);
        status = take_levels(work, &made);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    for (int level = 0; level < made.levels; level++) {
        for (uint32_t b = 0; b < made.nodes[level]; b++) {
            if (level == 0) {
                fill_leaf(&s, label, &made, b);
            } else {
                fill_node(&made, level, b);
            }
        }
    }
    *tree = made;
    return LRCS_OK;
}
