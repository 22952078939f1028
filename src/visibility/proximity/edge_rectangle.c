/* SPDX-License-Identifier: MIT */
/* Cuts facets with rectangles about event edges. It does not decide how wide these have to be
   (visibility/proximity/event_band.c). */
#include "visibility/proximity/edge_rectangle.h"

#include <math.h>

#include "base/range.h"

double lrcsi_edge_rectangle_facet_err(const lrcsi_view *view, uint32_t facet)
{
    return LRCSI_EDGE_RECTANGLE_ERR * lrcsi_view_facet_err(view, facet);
}

/* The error of the edge's position at parameter t (0 .. 1) is linear in t. A point of the edge near
   the facet is no farther from a than the facet's farthest corner plus the slack and the errors:
   t length is at most that. So the error of end b is multiplied by t. The errors of both ends turn
   the edge by at most an angle of 2 (first + last) / length. */
lrcsi_edge_rectangle lrcsi_edge_rectangle_make(const lrcsi_view *view, uint32_t facet,
                                               const lrcsi_edge *edge, double slack)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    lrcsi_edge_rectangle box = {.a = view->point[edge->low].x, .b = view->point[edge->high].x};
    if (lrcsi_view_point_err(box.a) > lrcsi_view_point_err(box.b)) {
        box.a = view->point[edge->high].x;
        box.b = view->point[edge->low].x;
        box.reverse = 1;
    }
    box.along[0] = box.b[0] - box.a[0];
    box.along[1] = box.b[1] - box.a[1];
    double length = sqrt(box.along[0] * box.along[0] + box.along[1] * box.along[1]);
    double first = LRCSI_EDGE_RECTANGLE_ERR * lrcsi_view_point_err(box.a);
    double last = LRCSI_EDGE_RECTANGLE_ERR * lrcsi_view_point_err(box.b);
    double far = 0;
    for (int k = 0; k < 3; k++) {
        const double *x = view->point[corner[k]].x;
        far = lrcsi_max(far, fabs(x[0] - box.a[0]) + fabs(x[1] - box.a[1]));
    }
    box.err = lrcsi_edge_rectangle_facet_err(view, facet) + first;
    box.before = slack + box.err;
    box.beyond = box.before + last;
    box.has_sides = length > 2 * (first + last);
    if (box.has_sides) {
        box.along[0] /= length;
        box.along[1] /= length;
        for (int k = 0; k < 3; k++) {
            box.across[k] = box.along[0] * view->R[1][k] - box.along[1] * view->R[0][k];
        }
        box.rotation_err = 2 * (first + last) / length;
        box.err += last * lrcsi_min(1, 2 * (far + box.before) / length);
        box.half_width = slack + box.err;
    } else {
        box.along[0] = 1;
        box.along[1] = 0;
        box.beyond += length;
        box.half_width = box.before = box.beyond;
        box.err = box.beyond;
    }
    return box;
}

void lrcsi_segment_part_limit(lrcsi_segment_part *part, double first, double last, double limit)
{
    if (first > limit && last > limit) {
        *part = (lrcsi_segment_part){1, 0};
    } else if (last > limit) {
        part->to = lrcsi_min(part->to, (limit - first) / (last - first));
    } else if (first > limit) {
        part->from = lrcsi_max(part->from, (first - limit) / (first - last));
    }
}

/* The rounding errors of the fractions move their points by a few u of the segment's and the
   limit's sizes, which the box's errors contain. */
lrcsi_segment_part lrcsi_edge_rectangle_part(const lrcsi_edge_rectangle *box, const double p[3],
                                             const double q[3])
{
    const double *const end[2] = {p, q};
    double across[2];
    double back[2];   /* how far before a */
    double beyond[2]; /* how far beyond b */
    for (int k = 0; k < 2; k++) {
        const double from_a[2] = {end[k][0] - box->a[0], end[k][1] - box->a[1]};
        const double from_b[2] = {end[k][0] - box->b[0], end[k][1] - box->b[1]};
        across[k] = box->along[0] * from_a[1] - box->along[1] * from_a[0];
        back[k] = -(box->along[0] * from_a[0] + box->along[1] * from_a[1]);
        beyond[k] = box->along[0] * from_b[0] + box->along[1] * from_b[1];
    }
    lrcsi_segment_part part = {0, 1};
    lrcsi_segment_part_limit(&part, across[0], across[1], box->half_width);
    lrcsi_segment_part_limit(&part, -across[0], -across[1], box->half_width);
    lrcsi_segment_part_limit(&part, back[0], back[1], box->before);
    lrcsi_segment_part_limit(&part, beyond[0], beyond[1], box->beyond);
    return part;
}

/* Do all corners of a facet lie beyond one side of the rectangle about an edge? */
static int corners_apart(const double *const point[3], const lrcsi_edge_rectangle *box)
{
    int left = 0;
    int right = 0;
    int before = 0;
    int beyond = 0;
    for (int k = 0; k < 3; k++) {
        const double *x = point[k];
        const double from_a[2] = {x[0] - box->a[0], x[1] - box->a[1]};
        const double from_b[2] = {x[0] - box->b[0], x[1] - box->b[1]};
        double across = box->along[0] * from_a[1] - box->along[1] * from_a[0];
        left += across > box->half_width;
        right += across < -box->half_width;
        before += box->along[0] * from_a[0] + box->along[1] * from_a[1] < -box->before;
        beyond += box->along[0] * from_b[0] + box->along[1] * from_b[1] > box->beyond;
    }
    return left == 3 || right == 3 || before == 3 || beyond == 3;
}

lrcsi_slice lrcsi_edge_rectangle_slice(const lrcsi_view *view, uint32_t facet,
                                       const lrcsi_edge_rectangle *box)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double *const point[3] = {view->point[corner[0]].x, view->point[corner[1]].x,
                                    view->point[corner[2]].x};
    lrcsi_slice slice = {.count = 0};
    if (corners_apart(point, box)) {
        return slice;
    }
    const double *along = box->along;
    const double left[3] = {-along[1], along[0], 0};
    const double back[3] = {-along[0], -along[1], 0};
    slice = lrcsi_slice_start(point[0], point[1], point[2]);
    lrcsi_slice_cut_between(&slice, left, box->a, box->a, box->half_width);
    lrcsi_slice_cut(&slice, along, box->b, box->beyond);
    lrcsi_slice_cut(&slice, back, box->a, box->before);
    return slice;
}

lrcsi_slice lrcsi_edge_rectangle_limit(lrcsi_slice slice, const lrcsi_edge_rectangle *box, int side,
                                       double depth)
{
    const double inward = box->reverse ? -side : side;
    const double into[3] = {-inward * box->along[1], inward * box->along[0], 0};
    lrcsi_slice_cut(&slice, into, box->a, depth + box->err);
    return slice;
}

/* The errors of a facet's plane and of an edge. */
static double heights_err(const lrcsi_view *view, uint32_t facet, const lrcsi_edge *edge)
{
    return lrcsi_edge_rectangle_facet_err(view, facet) +
           LRCSI_EDGE_RECTANGLE_ERR * view->point[edge->low].err +
           LRCSI_EDGE_RECTANGLE_ERR * view->point[edge->high].err;
}

/* Is part of an edge so far behind a facet's plane? Let q be a point of it and y one of the plane,
   at most `slack` apart in projection, q - y = w - t d with |w| <= slack and w perpendicular to d,
   and n the facet's unit normal, n . d > 0. If both ends of the part are more than 3 slack below
   the plane, 3 slack < -n . (q - y) = t n . d - n . w <= t + slack, so t > 2 slack: q is at least
   2 slack behind y. */
static int part_behind(const lrcsi_view *view, uint32_t facet, const lrcsi_edge *edge, double slack,
                       lrcsi_segment_part part)
{
    const lrcs_prepared *p = view->prepared;
    const lrcsi_normal *n = &p->normal[facet];
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    const uint32_t end[2] = {edge->low, edge->high};
    double height[2] = {0, 0}; /* of the edge's ends, times n->length */
    const double err = heights_err(view, facet, edge);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            height[i] += view->facing[facet] * n->high[k] * (p->vertex[end[i]].x[k] - a[k]);
        }
    }
    const double from = (1 - part.from) * height[0] + part.from * height[1];
    const double to = (1 - part.to) * height[0] + part.to * height[1];
    return view->facing[facet] != 0 && lrcsi_max(from, to) < -(3 * slack + err) * n->length;
}

int lrcsi_edge_rectangle_behind_plane(const lrcsi_view *view, uint32_t facet,
                                      const lrcsi_edge *edge, double slack)
{
    return part_behind(view, facet, edge, slack, (lrcsi_segment_part){0, 1});
}

/* The part of an edge beside which a facet is in projection, and what is within a distance of that:
   all of it if the edge is short. */
static lrcsi_segment_part part_beside(const lrcsi_view *view, uint32_t facet,
                                      const lrcsi_edge *edge, double distance)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double *p = view->point[edge->low].x;
    const double *q = view->point[edge->high].x;
    const double ab[2] = {q[0] - p[0], q[1] - p[1]};
    const double square = ab[0] * ab[0] + ab[1] * ab[1];
    const double wide = distance / sqrt(square);
    lrcsi_segment_part part = {HUGE_VAL, -HUGE_VAL};
    if (!(wide < 0.5)) {
        return (lrcsi_segment_part){0, 1};
    }
    for (int k = 0; k < 3; k++) {
        const double *x = view->point[corner[k]].x;
        const double t = ((x[0] - p[0]) * ab[0] + (x[1] - p[1]) * ab[1]) / square;
        lrcsi_range_extend(t, &part.from, &part.to);
    }
    part.from = lrcsi_min(1, lrcsi_max(0, part.from - wide));
    part.to = lrcsi_min(1, lrcsi_max(0, part.to + wide));
    return part;
}

int lrcsi_edge_rectangle_behind(const lrcsi_view *view, uint32_t facet, const lrcsi_edge *edge,
                                double slack)
{
    const double distance = 2 * (slack + heights_err(view, facet, edge));
    return part_behind(view, facet, edge, slack, part_beside(view, facet, edge, distance));
}
