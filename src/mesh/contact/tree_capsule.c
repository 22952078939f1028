/* SPDX-License-Identifier: MIT */
/* Capsules around the facets of a node, and the proof that two of them are apart.

   A capsule contains all points within its radius r of its segment. That of a leaf contains the
   corners of its facets; that of a node above contains, for both ends of each segment below, the
   ball about that end of the radius of its capsule. Then it contains those capsules, because the
   distance from its segment is a convex function: along a segment it is largest at an end. Its
   direction is the sum of the longest sides, or of the segments below, all on one side. If its
   segment is so short that products might underflow, or a point, r is infinite: the capsule bounds
   nothing.

   Errors. Let S be the largest |x| + |y| + |z| of the points, v the vector along the stored
   segment, f that from its first end to a point. The distance of the point from the line, |v x f| /
   |v|, has an error of at most 16 u S, and the length by which it is beyond an end, from v . f, one
   of at most 20 u S: their sum bounds the distance from the segment, and CAPSULE_ERR S both errors.
   If |v|^2 exceeds LEAST_LENGTH, what underflows in |v x f|^2 adds less than u S.

   Two capsules are apart if there is a vector n such that n . x is larger on all of one segment
   than on all of the other, by more than |n| times the sum of the radii. If there is any, the
   vector between the nearest points of both segments is one. The proof holds for whatever vector
   it is made with, so the errors of that one do not matter. Errors of the heights: x - a, from the
   first end a of one segment, has an error of u in each component, and its product with n one of
   at most 5 u |n| |x - a|; HEIGHT_ERR times the sum of the three lengths bounds them together. If
   |n|^2 exceeds LEAST_NORMAL, what underflows adds less than that. */
#include "mesh/contact/tree_capsule.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"

enum { CAPSULE_LANES = LRCSI_TREE_LANES, CAPSULE_POINTS = 3 * CAPSULE_LANES };

#define CAPSULE_ERR  (64.0 * LRCSI_U)
#define HEIGHT_ERR   (16.0 * LRCSI_U)
#define LEAST_LENGTH 0x1p-450 /* squared, of a segment */
#define LEAST_NORMAL 0x1p-900 /* squared, of a vector between two */

/* Balls that a capsule is to contain. */
typedef struct capsule_balls {
    const double *centre[CAPSULE_POINTS];
    double radius[CAPSULE_POINTS];
    int count;
} capsule_balls;

/* Adds a vector to a direction, or its opposite, whichever is on the direction's side. */
static void add_direction(const double v[3], double direction[3])
{
    const double sign = lrcsi_vec3_dot(v, direction) < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 3; k++) {
        direction[k] += sign * v[k];
    }
}

/* Adds a ball's centre and radius. */
static void balls_add(capsule_balls *balls, const double *centre, double radius)
{
    balls->centre[balls->count] = centre;
    balls->radius[balls->count++] = radius;
}

/* Places the segment: along `direction`, through the middle of the points' extents perpendicular to
   it, from the first to the last of them. */
static void segment_place(const capsule_balls *balls, const double direction[3],
                          lrcsi_tree_capsule *capsule)
{
    lrcsi_box across = lrcsi_box_empty();
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int i = 0; i < balls->count; i++) {
        const double *x = balls->centre[i];
        const double along = lrcsi_vec3_dot(direction, x);
        const double from_line[3] = {x[0] - along * direction[0], x[1] - along * direction[1],
                                     x[2] - along * direction[2]};
        lrcsi_box_add(&across, from_line);
        lrcsi_range_extend(along, &low, &high);
    }
    double middle[3];
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (across.low[k] + across.high[k]);
    }
    /* Each of its coordinates may come from another point: it need not be perpendicular yet. */
    const double along = lrcsi_vec3_dot(direction, middle);
    for (int k = 0; k < 3; k++) {
        capsule->end[0][k] = middle[k] + (low - along) * direction[k];
        capsule->end[1][k] = middle[k] + (high - along) * direction[k];
    }
}

/* The capsule along a direction around balls. */
static lrcsi_tree_capsule capsule_make(const capsule_balls *balls, double direction[3])
{
    lrcsi_tree_capsule capsule = {.radius = 0.0};
    const int found = lrcsi_length_normalise(direction);
    double size = 0.0;
    double v[3];
    segment_place(balls, direction, &capsule);
    lrcsi_vec3_between(capsule.end[0], capsule.end[1], v);
    const double square = lrcsi_vec3_dot(v, v);
    if (!found || !(square > LEAST_LENGTH)) {
        capsule.radius = HUGE_VAL;
        return capsule;
    }
    for (int i = 0; i < balls->count; i++) {
        const double *x = balls->centre[i];
        double from_end[3];
        double product[3];
        lrcsi_vec3_between(capsule.end[0], x, from_end);
        lrcsi_vec3_cross(v, from_end, product);
        const double along = lrcsi_vec3_dot(v, from_end);
        const double beyond = lrcsi_max3(0.0, -along, along - square) / sqrt(square);
        const double distance = sqrt(lrcsi_vec3_dot(product, product) / square);
        capsule.radius = lrcsi_max(capsule.radius, distance + beyond + balls->radius[i]);
        size = lrcsi_max(size, (fabs(x[0]) + fabs(x[1])) + fabs(x[2]));
    }
    capsule.radius = capsule.radius * LRCSI_OUTWARD_NANO + CAPSULE_ERR * size;
    return capsule;
}

/* Adds the corners of a facet, and its longest side to a direction. */
static void balls_add_facet(const lrcs_point *vertex, const lrcs_facet *facet, capsule_balls *balls,
                            double direction[3])
{
    double longest[3] = {0.0, 0.0, 0.0};
    double most = 0.0;
    for (int k = 0; k < 3; k++) {
        const double *a = vertex[facet->corner[k]].x;
        double side[3];
        lrcsi_vec3_between(a, vertex[facet->corner[(k + 1) % 3]].x, side);
        const double square = lrcsi_vec3_dot(side, side);
        if (square > most) {
            most = square;
            for (int i = 0; i < 3; i++) {
                longest[i] = side[i];
            }
        }
        balls_add(balls, a, 0.0);
    }
    add_direction(longest, direction);
}

static lrcsi_tree_capsule leaf_capsule(const lrcs_point *vertex, const lrcs_facet *facet,
                                       const lrcsi_tree *tree, uint32_t leaf)
{
    capsule_balls balls = {.count = 0};
    double direction[3] = {0.0, 0.0, 0.0};
    const uint32_t first = leaf * CAPSULE_LANES;
    for (uint32_t i = first; i < first + CAPSULE_LANES && i < tree->count; i++) {
        balls_add_facet(vertex, &facet[tree->order[i]], &balls, direction);
    }
    return capsule_make(&balls, direction);
}

lrcsi_tree_capsule lrcsi_tree_lane_capsule(const lrcsi_tree *tree, int level, uint32_t b,
                                           uint32_t lane)
{
    const lrcsi_tree_capsules *capsules = &tree->capsules[level][b];
    lrcsi_tree_capsule capsule;
    for (int k = 0; k < 3; k++) {
        capsule.end[0][k] = capsules->end[0][k][lane];
        capsule.end[1][k] = capsules->end[1][k][lane];
    }
    capsule.radius = capsules->radius[lane];
    return capsule;
}

/* The capsule of a node above the leaves. */
static lrcsi_tree_capsule node_capsule(const lrcsi_tree *tree, int level, uint32_t b)
{
    lrcsi_tree_capsule below[CAPSULE_LANES];
    capsule_balls balls = {.count = 0};
    double direction[3] = {0.0, 0.0, 0.0};
    const uint32_t left = tree->nodes[level - 1] - b * CAPSULE_LANES;
    for (uint32_t i = 0; i < CAPSULE_LANES && i < left; i++) {
        double v[3];
        below[i] = lrcsi_tree_lane_capsule(tree, level, b, i);
        lrcsi_vec3_between(below[i].end[0], below[i].end[1], v);
        add_direction(v, direction);
        balls_add(&balls, below[i].end[0], below[i].radius);
        balls_add(&balls, below[i].end[1], below[i].radius);
    }
    return capsule_make(&balls, direction);
}

void lrcsi_tree_fill_capsules(const lrcs_point *vertex, const lrcs_facet *facet, lrcsi_tree *tree)
{
    for (int level = 0; level < tree->levels - 1; level++) {
        for (uint32_t b = 0; b < tree->nodes[level]; b++) {
            const lrcsi_tree_capsule capsule =
                level == 0 ? leaf_capsule(vertex, facet, tree, b) : node_capsule(tree, level, b);
            lrcsi_tree_capsules *to = &tree->capsules[level + 1][b / CAPSULE_LANES];
            for (int k = 0; k < 3; k++) {
                to->end[0][k][b % CAPSULE_LANES] = capsule.end[0][k];
                to->end[1][k][b % CAPSULE_LANES] = capsule.end[1][k];
            }
            to->radius[b % CAPSULE_LANES] = capsule.radius;
        }
    }
    tree->has_capsules = 1;
}

/* Roughly the vector between the points of two segments that are nearest to each other (Ericson,
   Real-Time Collision Detection, 2005, 5.1.9). Given: the vectors along both, and between their
   first ends. */
static void nearest_vector(const double v[3], const double w[3], const double between[3],
                           double n[3])
{
    const double vv = lrcsi_vec3_dot(v, v);
    const double ww = lrcsi_vec3_dot(w, w);
    const double vw = lrcsi_vec3_dot(v, w);
    const double v_between = lrcsi_vec3_dot(v, between);
    const double w_between = lrcsi_vec3_dot(w, between);
    const double det = vv * ww - vw * vw;
    double s = det > 0.0 ? lrcsi_clamp_unit((v_between * ww - vw * w_between) / det) : 0.0;
    const double t = lrcsi_clamp_unit((vw * s - w_between) / ww);
    s = lrcsi_clamp_unit((v_between + vw * t) / vv);
    for (int k = 0; k < 3; k++) {
        n[k] = between[k] + t * w[k] - s * v[k];
    }
}

int lrcsi_tree_capsules_apart(const lrcsi_tree_capsule *a, const lrcsi_tree_capsule *b)
{
    double v[3];
    double w[3];
    double between[3];
    double last[3]; /* from the first end of a to the last of b */
    double n[3];
    if (!(a->radius + b->radius < HUGE_VAL)) {
        return 0;
    }
    lrcsi_vec3_between(a->end[0], a->end[1], v);
    lrcsi_vec3_between(b->end[0], b->end[1], w);
    lrcsi_vec3_between(a->end[0], b->end[0], between);
    lrcsi_vec3_between(a->end[0], b->end[1], last);
    nearest_vector(v, w, between, n);
    const double square = lrcsi_vec3_dot(n, n);
    const double far = lrcsi_max(0.0, lrcsi_vec3_dot(n, v));
    const double near = lrcsi_min(lrcsi_vec3_dot(n, between), lrcsi_vec3_dot(n, last));
    const double size = sqrt(lrcsi_vec3_dot(v, v)) + sqrt(lrcsi_vec3_dot(between, between)) +
                        sqrt(lrcsi_vec3_dot(last, last));
    const double needed = a->radius + b->radius + HEIGHT_ERR * size;
    return square > LEAST_NORMAL && near - far > needed * sqrt(square) * LRCSI_OUTWARD_NANO;
}
