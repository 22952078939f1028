/* SPDX-License-Identifier: MIT */
/* Slabs and cones that bound the facets of nodes, and proofs that they separate two nodes whose
   boxes intersect. When a traversal compares them is decided elsewhere (tree_walk.c,
   intersection.c).

   Slabs. A leaf A and a node B are compared along the direction d of A. For x in B, with
   e = d - d_B,
       d . x = d_B . x + e . x,
   the first bounded by B's own slab, the second by B's box. If the mean normals of A and B are
   almost equal, e is almost 0, and thin layers are separated however wide they are. The slab of
   each is also compared with the box of the other. Errors: |d_k|, |d_Bk| <= 1; let W be the sum of
   the boxes' largest |x_k|. Slabs are sums of three products, within 4 u W; e has an error of u
   |e_k| <= 2 u, its products and four sums round by less than 20 u W in all: 64 u W covers both
   sides.

   Cones. Let v be a corner of every facet in two nodes, and let the directions from v to their
   other corners lie within alpha of an axis a in the one, within beta of b in the other, both less
   than 90 degrees. Seen from v, a facet is an arc between two such directions, and lies within
   alpha too, because such small caps are convex. So if the angle between a and b exceeds alpha +
   beta, that is if a . b < cos(alpha + beta) = cos(alpha) cos(beta) - sin(alpha) sin(beta), facets
   of one node meet those of the other in v only. Errors, u = 2^-53: axes and directions have
   errors of 6 u, so that cosines computed from them have errors of 16 u; CONE_MARGIN, 512 u, covers
   each. A stored cosine counts as exact; the sine, the root of (1 - c) (1 + c), then has an error
   of 3 u. */
#include "mesh/contact/tree_bounds.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/range.h"
#include "base/vec3.h"

enum { BOUNDS_LANES = LRCSI_TREE_LANES };

/* See above: 64 u. */
#define SLAB_FILTER (64.0 * LRCSI_U)
#define CONE_MARGIN 0x1p-44

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

/* The direction of a node's slab: the mean of its facets' normals, or above level 0 of the
   directions below it, all on one side; of length 1, or 0 if there is none. */
static void mean_direction(const lrcs_point *vertex, const lrcs_facet *facet,
                           const lrcsi_tree *tree, int level, uint32_t b, double d[3])
{
    uint32_t first = b * BOUNDS_LANES;
    uint32_t left = (level == 0 ? tree->count : tree->nodes[level - 1]) - first;
    d[0] = d[1] = d[2] = 0.0;
    for (uint32_t i = 0; i < BOUNDS_LANES && i < left; i++) {
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

/* The slab of a node of `level`. */
static lrcsi_tree_slab node_slab(const lrcs_point *vertex, const lrcs_facet *facet,
                                 const lrcsi_tree *tree, int level, uint32_t b)
{
    lrcsi_tree_slab slab = {{0.0, 0.0, 0.0}, HUGE_VAL, -HUGE_VAL, 0.0};
    uint32_t size = BOUNDS_LANES; /* places in the node */
    for (int l = 0; l < level; l++) {
        size *= BOUNDS_LANES;
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
    return node_slab(vertex, facet, tree, 0, leaf);
}

/* Slabs of the nodes of each level, each of which is a lane of the level above. */
void lrcsi_tree_fill_slabs(const lrcs_point *vertex, const lrcs_facet *facet, lrcsi_tree *tree)
{
    for (int level = 0; level < tree->levels - 1; level++) {
        for (uint32_t b = 0; b < tree->nodes[level]; b++) {
            lrcsi_tree_slabs *slabs = &tree->slabs[level + 1][b / BOUNDS_LANES];
            lrcsi_tree_slab slab = node_slab(vertex, facet, tree, level, b);
            for (int k = 0; k < 3; k++) {
                slabs->direction[k][b % BOUNDS_LANES] = slab.direction[k];
            }
            slabs->low[b % BOUNDS_LANES] = slab.low;
            slabs->high[b % BOUNDS_LANES] = slab.high;
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

/* By both slabs, along the leaf's direction, or by the slab of one and the box of the other. */
int lrcsi_tree_slabs_apart(const lrcsi_tree *tree, uint32_t leaf, int level, uint32_t b,
                           uint32_t lane)
{
    const lrcsi_tree_slabs *slabs = &tree->slabs[level][b];
    const lrcsi_tree_slabs *own = &tree->slabs[1][leaf / BOUNDS_LANES];
    uint32_t at = leaf % BOUNDS_LANES;
    lrcsi_box box = lrcsi_tree_box(&tree->node[level][b], lane);
    lrcsi_box own_box = lrcsi_tree_box(&tree->node[1][leaf / BOUNDS_LANES], at);
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

/* ---- cones ---- */

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
        lrcsi_length_normalise(direction[n]);
    }
}

/* The cone of a leaf about the vertex that is its label. */
static lrcsi_tree_cone leaf_cone(const lrcs_point *vertex, const lrcs_facet *facet,
                                 const lrcsi_tree *tree, uint32_t b)
{
    const double *from = vertex[tree->label[0][b]].x;
    uint32_t first = b * BOUNDS_LANES;
    uint32_t count = tree->count - first < BOUNDS_LANES ? tree->count - first : BOUNDS_LANES;
    double direction[BOUNDS_LANES][2][3];
    lrcsi_tree_cone cone = {{0, 0, 0}, 1.0};
    for (uint32_t i = 0; i < count; i++) {
        facet_directions(vertex, &facet[tree->order[first + i]], from, direction[i]);
        for (int k = 0; k < 3; k++) {
            cone.axis[k] += direction[i][0][k] + direction[i][1][k];
        }
    }
    int found = lrcsi_length_normalise(cone.axis);
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

/* The cone around those of a node's lanes, all of which have one label. */
static lrcsi_tree_cone node_cone(const lrcsi_tree *tree, int level, uint32_t b)
{
    uint32_t first = b * BOUNDS_LANES;
    uint32_t left = tree->nodes[level - 1] - first;
    uint32_t count = left < BOUNDS_LANES ? left : BOUNDS_LANES;
    const lrcsi_tree_cone *below = tree->cone[level - 1] + first;
    lrcsi_tree_cone cone = {{0, 0, 0}, 1.0};
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            cone.axis[k] += below[i].axis[k];
        }
    }
    int found = lrcsi_length_normalise(cone.axis);
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
        for (uint32_t b = 0; b < tree->nodes[level]; b++) {
            uint32_t label = tree->label[level][b];
            if (label != LRCS_NONE && !proved[label]) {
                tree->cone[level][b] =
                    level == 0 ? leaf_cone(vertex, facet, tree, b) : node_cone(tree, level, b);
            }
        }
    }
}

int lrcsi_tree_cones_apart(const lrcsi_tree_cone *a, const lrcsi_tree_cone *b)
{
    return a->cosine > 0.0 && b->cosine > 0.0 &&
           lrcsi_vec3_dot(a->axis, b->axis) + CONE_MARGIN <
               a->cosine * b->cosine - cone_sine(a) * cone_sine(b);
}
