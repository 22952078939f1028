/* SPDX-License-Identifier: MIT */
/* Exact decisions along one line of sight. Which facets are candidates, and where the lines of
   sight run, is decided elsewhere. */
#include "visibility/sample.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/exact.h"

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
    int side = lrcsi_exact_turn(p, q, point, d);
    int axis = sample_axis(d);
    for (int k = 1; k <= 2 && side == 0; k++) {
        double moved[3] = {p[0], p[1], p[2]};
        moved[(axis + k) % 3] += 2;
        side = sense * lrcsi_exact_turn(p, q, moved, d);
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

int lrcsi_sample_beats(const lrcsi_view *view, uint32_t winner, uint32_t loser)
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

static int sample_coplanar(const lrcsi_view *view, uint32_t i, uint32_t j)
{
    const double *a = lrcsi_prepared_corner(view->prepared, i, 0);
    const double *b = lrcsi_prepared_corner(view->prepared, i, 1);
    const double *c = lrcsi_prepared_corner(view->prepared, i, 2);
    for (int k = 0; k < 3; k++) {
        if (lrcsi_exact_side(a, b, c, lrcsi_prepared_corner(view->prepared, j, k)) != 0) {
            return 0;
        }
    }
    return 1;
}

/* The height of the facet's plane above `point` along the direction, as a fraction: the numerator
   is N . (a - point), the denominator N . d, both times the facing, so that the denominator is
   positive. */
typedef struct sample_height {
    lrcsi_dd top, bottom;
    double top_off, bottom_off; /* error bounds */
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
        h.top = lrcsi_dd_add(h.top, lrcsi_dd_mul(normal, gap));
        h.bottom = lrcsi_dd_add(h.bottom, lrcsi_dd_scale(normal, view->direction[k]));
        square += gap.hi * gap.hi;
    }
    double off = 32 * LRCSI_U * LRCSI_U * n->length + n->error;
    h.top_off = off * sqrt(square);
    h.bottom_off = off * view->length;
    return h;
}

/* If all corners of `first` lie on one side of the plane of `second`, or on it, so does the point
   of `first` that the line meets: 1 if first is nearer, -1 if second is. 0 if corners lie on both
   sides. Exact. */
static int sample_side(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    int most = 0;
    int least = 0;
    for (int k = 0; k < 3; k++) {
        int side = view->facing[second] *
                   lrcsi_exact_side(lrcsi_prepared_corner(view->prepared, second, 0),
                                    lrcsi_prepared_corner(view->prepared, second, 1),
                                    lrcsi_prepared_corner(view->prepared, second, 2),
                                    lrcsi_prepared_corner(view->prepared, first, k));
        most = side > most ? side : most;
        least = side < least ? side : least;
    }
    return most + least;
}

/* 1 if, in the view, the point `ray` lies within the angle of the facet at its corner `at`. */
static int angle_holds(const lrcsi_view *view, uint32_t facet, int at, const double *ray)
{
    const double *corner[3];
    for (int k = 0; k < 3; k++) {
        corner[k] = lrcsi_prepared_corner(view->prepared, facet, (at + k) % 3);
    }
    return view->facing[facet] * lrcsi_exact_turn(corner[0], corner[1], ray, view->direction) >=
               0 &&
           view->facing[facet] * lrcsi_exact_turn(corner[2], corner[0], ray, view->direction) >= 0;
}

/* Corner `i` of the first facet and corner `j` of the second are the same point. If a side of the
   first that starts there runs within the second's angle: which facet is nearer along it. Otherwise
   0. */
static int sample_sides_at(const lrcsi_view *view, uint32_t first, int i, uint32_t second, int j)
{
    for (int k = 1; k <= 2; k++) {
        const double *ray = lrcsi_prepared_corner(view->prepared, first, (i + k) % 3);
        if (angle_holds(view, second, j, ray)) {
            return view->facing[second] *
                   lrcsi_exact_side(lrcsi_prepared_corner(view->prepared, second, 0),
                                    lrcsi_prepared_corner(view->prepared, second, 1),
                                    lrcsi_prepared_corner(view->prepared, second, 2), ray);
        }
    }
    return 0;
}

static int points_agree(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* For two facets that have one corner in common, do not intersect elsewhere, and each have corners
   on both sides of the other's plane: 1 if first is nearer on every line that meets both, -1 if
   second is; 0 if they have no corner in common. The region of the view that both cover is convex
   and contains the corner. Their heights differ everywhere else in it, so the same facet is nearer
   everywhere. At the corner the region is bounded by a side of one facet that lies within the angle
   of the other: along that side the order is decided. Exact. */
static int sample_corner(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    for (int n = 0; n < 9; n++) {
        int i = n / 3;
        int j = n % 3;
        if (points_agree(lrcsi_prepared_corner(view->prepared, first, i),
                         lrcsi_prepared_corner(view->prepared, second, j))) {
            int side = sample_sides_at(view, first, i, second, j);
            return side != 0 ? side : -sample_sides_at(view, second, j, first, i);
        }
    }
    return 0;
}

/* For two facets that intersect, and a line of sight that meets their intersection as closely as
   can be decided: which is nearer beside the line, in the direction in which it counts as moved.
   Along axis k, heights fall by N_k / (N . d). The answer may be wrong if the line does not meet
   the intersection exactly. No bound depends on it: both facets are then undecided, and the pixel
   counts as mixed (visibility/visible.c). */
static int sample_steeper(const lrcsi_view *view, uint32_t first, uint32_t second, int sense,
                          lrcsi_dd first_bottom, lrcsi_dd second_bottom)
{
    const lrcsi_normal *f = &view->prepared->normal[first];
    const lrcsi_normal *s = &view->prepared->normal[second];
    int axis = sample_axis(view->direction);
    for (int k = 1; k <= 2; k++) {
        int e = (axis + k) % 3;
        lrcsi_dd left = lrcsi_dd_mul((lrcsi_dd){f->high[e], f->low[e]}, second_bottom);
        lrcsi_dd right = lrcsi_dd_mul((lrcsi_dd){s->high[e], s->low[e]}, first_bottom);
        double fall = view->facing[first] * lrcsi_dd_value(left) -
                      view->facing[second] * lrcsi_dd_value(right);
        if (fall != 0) {
            return fall < 0 ? sense : -sense;
        }
    }
    return 0;
}

int lrcsi_sample_order(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    if (sample_coplanar(view, first, second)) {
        return lrcsi_sample_beats(view, first, second) ? 1 : -1;
    }
    int side = sample_side(view, first, second);
    return side != 0 ? side : -sample_side(view, second, first);
}

int lrcsi_sample_nearer(const lrcsi_view *view, uint32_t first, uint32_t second,
                        const double point[3], int sense)
{
    sample_height f = sample_height_of(view, first, point);
    sample_height s = sample_height_of(view, second, point);
    lrcsi_dd left = lrcsi_dd_mul(f.top, s.bottom);
    lrcsi_dd right = lrcsi_dd_mul(s.top, f.bottom);
    double difference = lrcsi_dd_value(lrcsi_dd_sub(left, right));
    double off = f.top_off * fabs(s.bottom.hi) + s.bottom_off * fabs(f.top.hi) +
                 s.top_off * fabs(f.bottom.hi) + f.bottom_off * fabs(s.top.hi) +
                 f.top_off * s.bottom_off + s.top_off * f.bottom_off +
                 16 * LRCSI_U * LRCSI_U * (fabs(left.hi) + fabs(right.hi));
    if (fabs(difference) > 1.01 * off) {
        return difference > 0 ? 1 : -1;
    }
    int order = lrcsi_sample_order(view, first, second);
    if (order != 0) {
        return order;
    }
    const lrcs_scene *scene = view->prepared->scene;
    return lrcsi_intersection_pair(view->prepared->vertex, scene->facet[first],
                                   scene->facet[second]) == LRCSI_INTERSECTION_CROSS
               ? sample_steeper(view, first, second, sense, f.bottom, s.bottom)
               : sample_corner(view, first, second);
}
