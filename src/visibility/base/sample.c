/* SPDX-License-Identifier: MIT */
/* Exact decisions along one line of sight. Which facets are candidates, and where the lines of
   sight run, is decided elsewhere. */
#include "visibility/base/sample.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/exact.h"

/* More than a few products can lose to underflow: 2^-1075 each. */
#define UNDERFLOW 0x1p-1000

/* The axis along which the direction has its largest component. The other two axes, projected along
   the direction, span the view plane. */
static int sample_axis(const double *d)
{
    int axis = fabs(d[1]) > fabs(d[0]) ? 1 : 0;
    return fabs(d[2]) > fabs(d[axis]) ? 2 : axis;
}

/* The side of edge p -> q on which the line lies: 1 left, -1 right; 0 only if the edge is parallel
   to the direction. If the line meets the edge, it counts as moved along a fixed axis e, and if
   that is parallel to the edge in the view, along a second one. The sign is then that of det(q - p,
   e, d), computed exactly with p moved by 2 along the axis: coordinates are below 1, so that the
   rounded move is still a positive multiple of the axis. */
static int sample_edge_side(const double *p, const double *q, const double *point, int sense,
                            const double *d)
{
    int side = lrcsi_exact_orient(p, q, point, d);
    int axis = sample_axis(d);
    for (int k = 1; k <= 2 && side == 0; k++) {
        double moved[3] = {p[0], p[1], p[2]};
        moved[(axis + k) % 3] += 2;
        side = sense * lrcsi_exact_orient(p, q, moved, d);
    }
    return side;
}

int lrcsi_sample_covers(const lrcsi_view *view, uint32_t facet, const double point[3])
{
    return lrcsi_sample_covers_towards(view, facet, point, 1);
}

int lrcsi_sample_covers_towards(const lrcsi_view *view, uint32_t facet, const double point[3],
                                int sense)
{
    for (int k = 0; k < 3; k++) {
        const double *p = lrcsi_prepared_corner(view->prepared, facet, k);
        const double *q = lrcsi_prepared_corner(view->prepared, facet, (k + 1) % 3);
        if (sample_edge_side(p, q, point, sense, view->direction) != view->facing[facet]) {
            return 0;
        }
    }
    return 1;
}

/* From the normal if its error allows it, else exactly. Errors: the normal's low part, which is
   left out, the difference, the product and two sums, 5 u of the terms; the normal's own error
   times the length of the difference, which is below 4; and underflow in the products, less than
   UNDERFLOW. */
int lrcsi_sample_above(const lrcsi_view *view, uint32_t facet, const double point[3])
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    const double *a = lrcsi_prepared_corner(view->prepared, facet, 0);
    double dot = 0;
    double size = 0;
    for (int k = 0; k < 3; k++) {
        double term = n->high[k] * (point[k] - a[k]);
        dot += term;
        size += fabs(term);
    }
    if (fabs(dot) > 8 * LRCSI_U * size + 8 * n->error + UNDERFLOW) {
        return (dot > 0) == (view->facing[facet] > 0) ? 1 : -1;
    }
    return view->facing[facet] *
           lrcsi_exact_side(a, lrcsi_prepared_corner(view->prepared, facet, 1),
                            lrcsi_prepared_corner(view->prepared, facet, 2), point);
}

int lrcsi_sample_has_precedence(const lrcsi_view *view, uint32_t winner, uint32_t loser)
{
    if (view->facing[winner] != view->facing[loser]) {
        return view->facing[winner] > view->facing[loser];
    }
    if (view->facing[winner] < 0) {
        int reflects = lrcsi_view_reflects(view, winner);
        int other = lrcsi_view_reflects(view, loser);
        if (reflects != other) {
            return reflects;
        }
    }
    return winner < loser;
}

int lrcsi_sample_contact_hides(const lrcsi_view *view, uint32_t facet,
                               const lrcsi_intersection *contact)
{
    return lrcsi_view_casts(view, contact->other) &&
           !(contact->kind == LRCSI_INTERSECTION_COPLANAR &&
             lrcsi_sample_has_precedence(view, facet, contact->other));
}

/* 1 if all corners of `other` lie in front of the facet's plane or on it, -1 if behind or on it; 0
   otherwise, and if all lie on it. */
static int plane_side(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    int front = 0;
    int behind = 0;
    for (int k = 0; k < 3 && !(front && behind); k++) {
        int sign = lrcsi_sample_above(view, facet, lrcsi_prepared_corner(view->prepared, other, k));
        front |= sign > 0;
        behind |= sign < 0;
    }
    return front - behind;
}

int lrcsi_sample_side(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    int side = plane_side(view, second, first);
    return side != 0 ? side : -plane_side(view, first, second);
}

int lrcsi_sample_order(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    int side = lrcsi_sample_side(view, first, second);
    for (int k = 0; k < 3 && side == 0; k++) {
        const double *corner = lrcsi_prepared_corner(view->prepared, second, k);
        if (lrcsi_sample_above(view, first, corner) != 0) {
            return 0; /* they are not in one plane */
        }
    }
    return side != 0 ? side : lrcsi_sample_has_precedence(view, first, second) ? 1 : -1;
}

/* Where side p q of one facet and side r s of another cross in projection: 1 if p q is nearer
   there, -1 if r s is; 0 if they do not cross, or intersect in space. */
static int sides_order(const lrcsi_view *view, const double *p, const double *q, const double *r,
                       const double *s)
{
    const double *d = view->direction;
    int left = lrcsi_exact_orient(p, q, s, d);
    if (left * lrcsi_exact_orient(p, q, r, d) >= 0 ||
        lrcsi_exact_orient(r, s, p, d) * lrcsi_exact_orient(r, s, q, d) >= 0) {
        return 0;
    }
    return left * lrcsi_exact_side(p, q, r, s);
}

/* Does a facet, including its sides, cover a point in projection? */
static int covers_closed(const lrcsi_view *view, uint32_t facet, const double point[3])
{
    int covers = 1;
    for (int k = 0; k < 3 && covers; k++) {
        const double *p = lrcsi_prepared_corner(view->prepared, facet, k);
        const double *q = lrcsi_prepared_corner(view->prepared, facet, (k + 1) % 3);
        covers = view->facing[facet] * lrcsi_exact_orient(p, q, point, view->direction) >= 0;
    }
    return covers;
}

/* The region that both cover is a convex polygon. Each of its corners is a crossing of two sides,
   or a corner of one facet that the other covers. The facets do not intersect, so their order is
   the same everywhere in the region where their heights differ; and unless they lie in one plane,
   the heights differ at one of the region's corners. */
int lrcsi_sample_overlap_order(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    const lrcs_prepared *p = view->prepared;
    int order = 0;
    for (int n = 0; n < 9 && order == 0; n++) {
        order = sides_order(view, lrcsi_prepared_corner(p, first, n / 3),
                            lrcsi_prepared_corner(p, first, (n / 3 + 1) % 3),
                            lrcsi_prepared_corner(p, second, n % 3),
                            lrcsi_prepared_corner(p, second, (n + 1) % 3));
    }
    for (int k = 0; k < 3 && order == 0; k++) {
        const double *corner = lrcsi_prepared_corner(p, first, k);
        order = covers_closed(view, second, corner) ? lrcsi_sample_above(view, second, corner) : 0;
    }
    for (int k = 0; k < 3 && order == 0; k++) {
        const double *corner = lrcsi_prepared_corner(p, second, k);
        order = covers_closed(view, first, corner) ? -lrcsi_sample_above(view, first, corner) : 0;
    }
    return order;
}

/* The height of the facet's plane above `point` along the direction, as a fraction: the numerator
   is N . (a - point), the denominator N . d, both times the facing, so that the denominator is
   positive. */
typedef struct sample_height {
    lrcsi_dd numerator, denominator;
    double numerator_err, denominator_err; /* error bounds */
} sample_height;

/* The error of each term: the difference is exact as a pair, its product with N has an error of
   7 u^2, each sum one of 3 u^2. With N's own error the total is at most
   16 u^2 |N| |a - point| sqrt(3) + error |a - point|. */
static sample_height sample_height_of(const lrcsi_view *view, uint32_t facet, const double *point)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    const double *a = lrcsi_prepared_corner(view->prepared, facet, 0);
    sample_height h = {{0, 0}, {0, 0}, 0, 0};
    double square = 0;
    for (int k = 0; k < 3; k++) {
        lrcsi_dd normal = {n->high[k] * view->facing[facet], n->low[k] * view->facing[facet]};
        lrcsi_dd gap = lrcsi_dd_two_sum(a[k], -point[k]);
        h.numerator = lrcsi_dd_add(h.numerator, lrcsi_dd_mul(normal, gap));
        h.denominator = lrcsi_dd_add(h.denominator, lrcsi_dd_scale(normal, view->direction[k]));
        square += gap.hi * gap.hi;
    }
    double err = 32 * LRCSI_U * LRCSI_U * n->length + n->error;
    h.numerator_err = err * sqrt(square);
    h.denominator_err = err * view->length;
    return h;
}

/* For two facets that intersect, and a line of sight that passes too close to their intersection
   for a decision: which is nearer if the line is moved as in lrcsi_sample_covers_towards. Along
   axis k, heights fall by N_k / (N . d). The answer may be wrong if the line does not meet the
   intersection exactly. No bound depends on it: both facets are then undecided, and the pixel
   counts as mixed (visibility/raster/visible.c). */
static int sample_steeper(const lrcsi_view *view, uint32_t first, uint32_t second, int sense,
                          lrcsi_dd first_denominator, lrcsi_dd second_denominator)
{
    const lrcsi_normal *f = &view->prepared->normal[first];
    const lrcsi_normal *s = &view->prepared->normal[second];
    int axis = sample_axis(view->direction);
    for (int k = 1; k <= 2; k++) {
        int e = (axis + k) % 3;
        lrcsi_dd left = lrcsi_dd_mul((lrcsi_dd){f->high[e], f->low[e]}, second_denominator);
        lrcsi_dd right = lrcsi_dd_mul((lrcsi_dd){s->high[e], s->low[e]}, first_denominator);
        double fall = view->facing[first] * lrcsi_dd_value(left) -
                      view->facing[second] * lrcsi_dd_value(right);
        if (fall != 0) {
            return fall < 0 ? sense : -sense;
        }
    }
    return 0;
}

int lrcsi_sample_nearer(const lrcsi_view *view, uint32_t first, uint32_t second,
                        const double point[3], int sense)
{
    sample_height f = sample_height_of(view, first, point);
    sample_height s = sample_height_of(view, second, point);
    lrcsi_dd left = lrcsi_dd_mul(f.numerator, s.denominator);
    lrcsi_dd right = lrcsi_dd_mul(s.numerator, f.denominator);
    double difference = lrcsi_dd_value(lrcsi_dd_sub(left, right));
    double err =
        f.numerator_err * fabs(s.denominator.hi) + s.denominator_err * fabs(f.numerator.hi) +
        s.numerator_err * fabs(f.denominator.hi) + f.denominator_err * fabs(s.numerator.hi) +
        f.numerator_err * s.denominator_err + s.numerator_err * f.denominator_err +
        16 * LRCSI_U * LRCSI_U * (fabs(left.hi) + fabs(right.hi));
    if (fabs(difference) > 1.01 * err) {
        return difference > 0 ? 1 : -1;
    }
    int order = lrcsi_sample_order(view, first, second);
    if (order != 0) {
        return order;
    }
    const lrcs_scene *scene = view->prepared->scene;
    return lrcsi_intersection_pair(view->prepared->vertex, scene->facet[first],
                                   scene->facet[second]) == LRCSI_INTERSECTION_CROSS
               ? sample_steeper(view, first, second, sense, f.denominator, s.denominator)
               : lrcsi_sample_overlap_order(view, first, second);
}
