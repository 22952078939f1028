/* SPDX-License-Identifier: MIT */
/* Facets are sorted along a Morton curve (Morton 1966); boxes of eight consecutive ones, then of
   eight blocks, and so on. The order affects only speed.

      The curve has about as many cells on a surface as there are facets. If many centres
   nevertheless share a cell, because a few others are far away, these facets are sorted again along
   a curve through their own box, and so on: every cluster gets its own scale. A facet with an apex
   is sorted by the apex first, and among the facets of the apex by its centre. Each time the box
   shrinks by at least a factor of 2^MORTON_MIN - 1, and differences of coordinates lie between
   2^1 and 2^-352 (base/exact.c): at most 45 times by apexes and 45 by centres. Facets with the same
   centre stay together.

   Slabs. A leaf A and a block B are compared along the direction d of A. For x in B, with
   e = d - d_B,
       d . x = d_B . x + e . x,
   the first bounded by B's own slab, the second by B's box. If the mean normals of A and B are
   almost equal, e is almost 0, and thin layers are separated however wide they are. The slab of
   each is also compared with the box of the other. Errors: |d_k|, |d_Bk| <= 1; let W be the sum of
   the boxes' largest |x_k|. Slabs are sums of three products, within 4 u W; e has an error of u
   |e_k| <= 2 u, its products and four sums round by less than 20 u W in all: 64 u W covers both
   sides.

   Cones. Let v be a corner of every facet in two blocks, and let the directions from v to their
   other corners lie within alpha of an axis a in the one, within beta of b in the other, both less
   than 90 degrees. Seen from v, a facet is an arc between two such directions, and lies within
   alpha too, because such small caps are convex. So if the angle between a and b exceeds alpha +
   beta, that is if a . b < cos(alpha + beta) = cos(alpha) cos(beta) - sin(alpha) sin(beta), facets
   of one block meet those of the other in v only. Errors, u = 2^-53: axes and directions have
   errors of 6 u, so that cosines computed from them have errors of 16 u; CONE_MARGIN, 512 u, covers
   each. A stored cosine counts as exact; the sine, the root of (1 - c) (1 + c), then has an error
   of 3 u.
 */
#include "mesh/tree.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/ieee.h"
#include "base/length.h"
#include "base/range.h"
#include "base/sort.h"
#include "base/vec3.h"
#include "base/work.h"

enum { TREE_LANES = LRCSI_TREE_LANES };

/* Bits of a cell's number along each axis. */
enum { MORTON_MIN = 8, MORTON_MAX = 21 };

/* More facets than this in one cell are sorted again; the largest number of nested curves. */
enum { CELL_FACETS = 64, SCALES = 96 };

/* See above: 64 u. */
#define SLAB_FILTER (64.0 * LRCSI_U)
#define CONE_MARGIN 0x1p-44

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

static uint32_t blocks_for(uint32_t count)
{
    return count / TREE_LANES + (count % TREE_LANES != 0);
}

/* Allocates a tree over tree->count facets. */
static int take_levels(lrcs_work *work, lrcsi_tree *tree)
{
    uint32_t below = tree->count;
    while (below > 1 || (below == 1 && tree->levels == 0)) {
        int l = tree->levels++;
        below = blocks_for(below);
        tree->blocks[l] = below;
        tree->block[l] = lrcsi_work_take(work, below, sizeof *tree->block[l]);
        tree->label[l] = lrcsi_work_take(work, below, sizeof *tree->label[l]);
        tree->slabs[l] = lrcsi_work_take(work, l > 0 ? below : 0, sizeof *tree->slabs[l]);
        tree->cone[l] = lrcsi_work_take(work, below, sizeof *tree->cone[l]);
        if (!tree->block[l] || !tree->label[l] || !tree->slabs[l] || !tree->cone[l]) {
            return LRCS_E_MEMORY;
        }
    }
    return LRCS_OK;
}

/* -0 becomes 0. */
static void put_box(lrcsi_tree_block *block, uint32_t lane, const lrcsi_box *box)
{
    for (int k = 0; k < 3; k++) {
        block->low[k][lane] = box->low[k] + 0.0;
        block->high[k][lane] = box->high[k] + 0.0;
    }
}

/* Fills block b of level 0: the boxes of its facets, and their common label. */
static void fill_leaf(const tree_sort *s, const uint32_t *label, const lrcsi_tree *tree, uint32_t b)
{
    lrcsi_tree_block *block = &tree->block[0][b];
    uint32_t first = b * TREE_LANES;
    uint32_t common = label ? label[s->order[first]] : LRCS_NONE;
    for (uint32_t lane = 0; lane < TREE_LANES; lane++) {
        lrcsi_box box = lrcsi_box_empty();
        if (lane < tree->count - first) {
            uint32_t f = s->order[first + lane];
            box = lrcsi_box_of(s->vertex, &s->facet[f]);
            common = label && label[f] == common ? common : LRCS_NONE;
        }
        put_box(block, lane, &box);
    }
    tree->label[0][b] = common;
}

/* The box around all of a block's boxes. */
static lrcsi_box block_box(const lrcsi_tree_block *block)
{
    lrcsi_box box;
    for (int k = 0; k < 3; k++) {
        double low = block->low[k][0];
        double high = block->high[k][0];
        for (int lane = 1; lane < TREE_LANES; lane++) {
            low = block->low[k][lane] < low ? block->low[k][lane] : low;
            high = block->high[k][lane] > high ? block->high[k][lane] : high;
        }
        box.low[k] = low;
        box.high[k] = high;
    }
    return box;
}

/* Fills block b of a level above from the blocks below it. */
static void fill_block(const lrcsi_tree *tree, int level, uint32_t b)
{
    uint32_t first = b * TREE_LANES;
    uint32_t common = tree->label[level - 1][first];
    for (uint32_t lane = 0; lane < TREE_LANES; lane++) {
        lrcsi_box box = lrcsi_box_empty();
        if (lane < tree->blocks[level - 1] - first) {
            box = block_box(&tree->block[level - 1][first + lane]);
            common = tree->label[level - 1][first + lane] == common ? common : LRCS_NONE;
        }
        put_box(&tree->block[level][b], lane, &box);
    }
    tree->label[level][b] = common;
}

size_t lrcsi_tree_need(uint32_t facet_count)
{
    size_t scratch = lrcsi_work_add(2 * lrcsi_work_bytes(facet_count, sizeof(uint64_t)),
                                    lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    scratch = lrcsi_work_add(scratch, lrcsi_work_bytes(facet_count, sizeof(lrcs_point)));
    size_t boxes = 0;
    uint32_t below = facet_count;
    for (int l = 0; l < LRCSI_TREE_LEVELS; l++) {
        below = blocks_for(below);
        boxes = lrcsi_work_add(boxes, lrcsi_work_bytes(below, sizeof(lrcsi_tree_block)));
        boxes = lrcsi_work_add(boxes, lrcsi_work_bytes(below, sizeof(uint32_t)));
        boxes =
            lrcsi_work_add(boxes, lrcsi_work_bytes(l > 0 ? below : 0, sizeof(lrcsi_tree_slabs)));
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
        for (uint32_t b = 0; b < made.blocks[level]; b++) {
            if (level == 0) {
                fill_leaf(&s, label, &made, b);
            } else {
                fill_block(&made, level, b);
            }
        }
    }
    *tree = made;
    return LRCS_OK;
}

/* ---- slabs ---- */

/* Adds to a direction the normal of a facet or its opposite, whichever is on the direction's side,
   scaled so that the largest component is 1. */
static void add_normal(const lrcs_point *vertex, const lrcs_facet *facet, double direction[3])
{
    double n[3];
    lrcsi_vec3_normal(vertex[facet->corner[0]].x, vertex[facet->corner[1]].x,
                      vertex[facet->corner[2]].x, n);
    double along = lrcsi_vec3_dot(n, direction);
    double largest = lrcsi_max(fabs(n[0]), lrcsi_max(fabs(n[1]), fabs(n[2])));
    double scale = largest > 0x1p-1000 ? (along < 0.0 ? -1.0 : 1.0) / largest : 0.0;
    for (int k = 0; k < 3; k++) {
        direction[k] += n[k] * scale;
    }
}

/* The direction of a block's slab: the mean of its facets' normals, or above level 0 of the
   directions below it, all on one side; of length 1, or 0 if there is none. */
static void mean_direction(const lrcs_point *vertex, const lrcs_facet *facet,
                           const lrcsi_tree *tree, int level, uint32_t b, double d[3])
{
    uint32_t first = b * TREE_LANES;
    uint32_t left = (level == 0 ? tree->count : tree->blocks[level - 1]) - first;
    d[0] = d[1] = d[2] = 0.0;
    for (uint32_t i = 0; i < TREE_LANES && i < left; i++) {
        if (level == 0) {
            add_normal(vertex, &facet[tree->order[first + i]], d);
        } else {
            const lrcsi_tree_slabs *below = &tree->slabs[level][b];
            const double n[3] = {below->direction[0][i], below->direction[1][i],
                                 below->direction[2][i]};
            double sign = lrcsi_vec3_dot(n, d) < 0.0 ? -1.0 : 1.0;
            for (int k = 0; k < 3; k++) {
                d[k] += sign * n[k];
            }
        }
    }
    double size = sqrt(lrcsi_vec3_dot(d, d));
    int sign = d[0] + d[1] + d[2] < 0.0 ? -1 : 1; /* layers of either winding have one direction */
    for (int k = 0; k < 3; k++) {
        d[k] = size > 0.0 ? sign * fmax(-1.0, fmin(1.0, d[k] / size)) : 0.0;
    }
}

/* The slab of a block of `level`. */
static lrcsi_tree_slab block_slab(const lrcs_point *vertex, const lrcs_facet *facet,
                                  const lrcsi_tree *tree, int level, uint32_t b)
{
    lrcsi_tree_slab slab = {{0.0, 0.0, 0.0}, HUGE_VAL, -HUGE_VAL, 0.0};
    uint32_t size = TREE_LANES; /* places in the block */
    for (int l = 0; l < level; l++) {
        size *= TREE_LANES;
    }
    uint32_t first = b * size;
    uint32_t end = tree->count - first < size ? tree->count : first + size;
    mean_direction(vertex, facet, tree, level, b, slab.direction);
    for (uint32_t i = first; i < end; i++) {
        const uint32_t *corner = facet[tree->order[i]].corner;
        for (int c = 0; c < 3; c++) {
            const double *x = vertex[corner[c]].x;
            double place = lrcsi_vec3_dot(slab.direction, x);
            slab.low = lrcsi_min(slab.low, place);
            slab.high = lrcsi_max(slab.high, place);
            slab.size = lrcsi_max(slab.size, (fabs(x[0]) + fabs(x[1])) + fabs(x[2]));
        }
    }
    return slab;
}

lrcsi_tree_slab lrcsi_tree_leaf_slab(const lrcs_point *vertex, const lrcs_facet *facet,
                                     const lrcsi_tree *tree, uint32_t leaf)
{
    return block_slab(vertex, facet, tree, 0, leaf);
}

/* Slabs of the blocks of each level, each of which is a lane of the level above. */
void lrcsi_tree_fill_slabs(const lrcs_point *vertex, const lrcs_facet *facet, lrcsi_tree *tree)
{
    for (int level = 0; level < tree->levels - 1; level++) {
        for (uint32_t b = 0; b < tree->blocks[level]; b++) {
            lrcsi_tree_slabs *slabs = &tree->slabs[level + 1][b / TREE_LANES];
            lrcsi_tree_slab slab = block_slab(vertex, facet, tree, level, b);
            for (int k = 0; k < 3; k++) {
                slabs->direction[k][b % TREE_LANES] = slab.direction[k];
            }
            slabs->low[b % TREE_LANES] = slab.low;
            slabs->high[b % TREE_LANES] = slab.high;
        }
    }
    tree->has_slabs = 1;
}

/* Extends a slab by the range of e . x over a box: bounds along a direction that differs by e from
   the slab's. */
static void slab_range(const lrcsi_box *box, const double e[3], double *low, double *high)
{
    for (int k = 0; k < 3; k++) {
        double at_low = e[k] * box->low[k];
        double at_high = e[k] * box->high[k];
        *low += at_low < at_high ? at_low : at_high;
        *high += at_low < at_high ? at_high : at_low;
    }
}

/* Is a lane of a block proved to be disjoint from a leaf: by both slabs, along the leaf's
   direction, or by the slab of one and the box of the other? */
static int slab_is_apart(const lrcsi_tree *tree, uint32_t leaf, int level, uint32_t b,
                         uint32_t lane)
{
    const lrcsi_tree_slabs *slabs = &tree->slabs[level][b];
    const lrcsi_tree_slabs *own = &tree->slabs[1][leaf / TREE_LANES];
    uint32_t at = leaf % TREE_LANES;
    lrcsi_box box = lrcsi_tree_box(&tree->block[level][b], lane);
    lrcsi_box own_box = lrcsi_tree_box(&tree->block[1][leaf / TREE_LANES], at);
    double along[3];
    double own_along[3];
    double difference[3];
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
        along[k] = slabs->direction[k][lane];
        own_along[k] = own->direction[k][at];
        difference[k] = own_along[k] - along[k];
        size += fmax(fabs(box.low[k]), fabs(box.high[k])) +
                fmax(fabs(own_box.low[k]), fabs(own_box.high[k]));
    }
    double low[3] = {slabs->low[lane], 0.0, 0.0};
    double high[3] = {slabs->high[lane], 0.0, 0.0};
    slab_range(&box, difference, &low[0], &high[0]);
    slab_range(&box, own_along, &low[1], &high[1]);
    slab_range(&own_box, along, &low[2], &high[2]);
    double error = SLAB_FILTER * size;
    return fmax(low[0], low[1]) - error > own->high[at] ||
           fmin(high[0], high[1]) + error < own->low[at] || low[2] - error > slabs->high[lane] ||
           high[2] + error < slabs->low[lane];
}

/* The lanes of a mask that slabs do not prove to be disjoint from the leaf. */
static unsigned narrowed(lrcsi_tree_walk *w, int level, unsigned mask)
{
    unsigned left = mask;
    for (; mask != 0; mask &= mask - 1) {
        uint32_t lane = lrcsi_tree_lane(mask);
        if (slab_is_apart(w->tree, w->leaf, level, w->at[level], lane)) {
            left &= ~(1u << lane);
            w->apart++;
        }
    }
    return left;
}

/* ---- cones ---- */

/* Scales to length 1; returns 0 if the length is 0. */
static int normalise(double v[3])
{
    double size = lrcsi_length(v);
    for (int k = 0; k < 3 && size > 0.0; k++) {
        v[k] /= size;
    }
    return size > 0.0;
}

/* The directions from a vertex to the two other corners of a facet that has it. */
static void facet_directions(const lrcs_point *vertex, const lrcs_facet *facet, const double *from,
                             double direction[2][3])
{
    int at = 0;
    while (at < 2 && !(vertex[facet->corner[at]].x[0] == from[0] &&
                       vertex[facet->corner[at]].x[1] == from[1] &&
                       vertex[facet->corner[at]].x[2] == from[2])) {
        at++;
    }
    for (int n = 0; n < 2; n++) {
        const double *x = vertex[facet->corner[(at + 1 + n) % 3]].x;
        for (int k = 0; k < 3; k++) {
            direction[n][k] = x[k] - from[k];
        }
        normalise(direction[n]);
    }
}

/* The cone of a leaf about the vertex that is its label. */
static lrcsi_tree_cone leaf_cone(const lrcs_point *vertex, const lrcs_facet *facet,
                                 const lrcsi_tree *tree, uint32_t b)
{
    const double *from = vertex[tree->label[0][b]].x;
    uint32_t first = b * TREE_LANES;
    uint32_t count = tree->count - first < TREE_LANES ? tree->count - first : TREE_LANES;
    double direction[TREE_LANES][2][3];
    lrcsi_tree_cone cone = {{0, 0, 0}, 1.0};
    for (uint32_t i = 0; i < count; i++) {
        facet_directions(vertex, &facet[tree->order[first + i]], from, direction[i]);
        for (int k = 0; k < 3; k++) {
            cone.axis[k] += direction[i][0][k] + direction[i][1][k];
        }
    }
    int found = normalise(cone.axis);
    for (uint32_t i = 0; i < count; i++) {
        for (int n = 0; n < 2; n++) {
            cone.cosine = fmin(cone.cosine, lrcsi_vec3_dot(cone.axis, direction[i][n]));
        }
    }
    cone.cosine = found ? cone.cosine - CONE_MARGIN : -1.0;
    return cone;
}

static double cone_sine(const lrcsi_tree_cone *cone)
{
    return sqrt((1.0 - cone->cosine) * (1.0 + cone->cosine));
}

/* The cone around those of a block's lanes, all of which have one label. */
static lrcsi_tree_cone block_cone(const lrcsi_tree *tree, int level, uint32_t b)
{
    uint32_t first = b * TREE_LANES;
    uint32_t left = tree->blocks[level - 1] - first;
    uint32_t count = left < TREE_LANES ? left : TREE_LANES;
    const lrcsi_tree_cone *below = tree->cone[level - 1] + first;
    lrcsi_tree_cone cone = {{0, 0, 0}, 1.0};
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            cone.axis[k] += below[i].axis[k];
        }
    }
    int found = normalise(cone.axis);
    for (uint32_t i = 0; i < count; i++) {
        double c = fmin(1.0, lrcsi_vec3_dot(cone.axis, below[i].axis)) - CONE_MARGIN;
        double all = -1.0;
        if (c > 0.0 && below[i].cosine > 0.0) {
            all = c * below[i].cosine - sqrt((1.0 - c) * (1.0 + c)) * cone_sine(&below[i]);
        }
        cone.cosine = fmin(cone.cosine, all - CONE_MARGIN);
    }
    cone.cosine = found ? cone.cosine : -1.0;
    return cone;
}

void lrcsi_tree_fill_cones(const lrcs_point *vertex, const lrcs_facet *facet,
                           const unsigned char *proved, lrcsi_tree *tree)
{
    for (int level = 0; level < tree->levels; level++) {
        for (uint32_t b = 0; b < tree->blocks[level]; b++) {
            uint32_t label = tree->label[level][b];
            if (label != LRCS_NONE && !proved[label]) {
                tree->cone[level][b] =
                    level == 0 ? leaf_cone(vertex, facet, tree, b) : block_cone(tree, level, b);
            }
        }
    }
}

/* Are two cones about one vertex proved to have nothing else in common? */
static int cones_are_apart(const lrcsi_tree_cone *a, const lrcsi_tree_cone *b)
{
    return a->cosine > 0.0 && b->cosine > 0.0 &&
           lrcsi_vec3_dot(a->axis, b->axis) + CONE_MARGIN <
               a->cosine * b->cosine - cone_sine(a) * cone_sine(b);
}

/* ---- walks ---- */

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
        walk.mask[walk.level] = lrcsi_tree_meets(&tree->block[walk.level][0], &walk.box);
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
        walk.box = lrcsi_tree_box(&tree->block[1][leaf / TREE_LANES], leaf % TREE_LANES);
    }
    for (int level = 1; level < tree->levels; level++) {
        unsigned after = ~0u << 1 << at % TREE_LANES;
        at /= TREE_LANES;
        walk.at[level] = at;
        walk.mask[level] = lrcsi_tree_meets(&tree->block[level][at], &walk.box) & after;
    }
    return walk;
}

void lrcsi_tree_narrow_by_slabs(lrcsi_tree_walk *w, uint32_t leaf)
{
    w->leaf = leaf;
    for (int level = w->level; level < w->tree->levels; level++) {
        w->mask[level] = narrowed(w, level, w->mask[level]);
    }
}

void lrcsi_tree_narrow_by_cones(lrcsi_tree_walk *w, uint32_t leaf)
{
    w->apex = w->tree->label[0][leaf];
    w->cone = &w->tree->cone[0][leaf];
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
        uint32_t child = w->at[level] * TREE_LANES + lrcsi_tree_lane(w->mask[level]);
        w->mask[level] &= w->mask[level] - 1;
        if (level > 0 && w->without != LRCS_NONE && tree->label[level - 1][child] == w->without) {
            continue;
        }
        if (level > 0 && w->cone && tree->label[level - 1][child] == w->apex &&
            cones_are_apart(w->cone, &tree->cone[level - 1][child])) {
            continue;
        }
        if (level == w->last) {
            return child;
        }
        w->level = level - 1;
        w->at[level - 1] = child;
        w->mask[level - 1] = lrcsi_tree_meets(&tree->block[level - 1][child], &w->box);
        if (w->leaf != LRCS_NONE) {
            w->mask[level - 1] = narrowed(w, level - 1, w->mask[level - 1]);
        }
    }
    return LRCS_NONE;
}
