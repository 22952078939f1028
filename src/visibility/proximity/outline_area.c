/* SPDX-License-Identifier: MIT */
/* Decides where a true solid is farthest in directions of the view plane, and from that how much
   area lies between its outline and an edge of its facets. Every area is enlarged by the errors of
   the points that it is computed from. Which points of which facets are concerned is decided in
   visibility/proximity/event_band.c. Terms are those of visibility/proximity/outline.c.

   1. Along an edge. Consider a contour edge of length L, and coordinates in projection: t along the
   edge, 0 .. L, and the depth, perpendicular to it, positive towards the facets of Q. Let y be a
   point of K' and x one outside K, or y a point outside K' and x one of K, at a distance of at most
   delta from each other, delta <= k. Then y is within k + delta of the boundary of K'. Let the edge
   be the one nearest to y; of a gain, on the side on which x leaves K, which matters only where K
   is thinner than delta.
   - Gain (y in K'): the nearest point of the boundary is on the edge, so 0 <= t <= L. Let q_j be
     points of the boundary of K, in order along it. Their polygon lies in K, so x is on the other
     side of it, and y no farther than delta from there: where the polygon's slope is at most 1,
     0 <= depth <= polygon(t) + sqrt(2) delta.
   - Loss (y outside K'): the nearest point may also be an end of the edge (y is outside one of the
     two edges there at least), so
     -2 k <= t <= L + 2 k. K lies within its tangents at the points q_j, so
     0 <= -depth <= -tangents(t) + sqrt(2) delta.
   The areas of these two regions are integrals over t of piecewise linear functions, and the
   largest depths are values of these at the ends of their pieces.

   2. Signed area. The depth of the boundary of K is a convex function of t, where K reaches over
   the edge by 2 k at both ends. So it lies between the polygon and the tangents of 1: its integral
   over any part of 0 <= t <= L lies between the integrals of these two, and its magnitude at any t
   is at most the larger one of theirs.
   Between two support points that lie, with all others between them, on one circle, the boundary of
   K is an affine image of an arc of angle theta. The area between it and its chord is the fraction
       r = (theta - sin theta) / (2 tan(theta/2) - sin theta)
   of the triangle that the chord forms with the two tangents, as for the arc itself. With x =
   theta/2, r = (x - sin x cos x) / (tan x sin^2 x) falls from 2/3 at 0: it is at least 2/3 -
   theta^2/24 for theta <= 0.5. It is exactly 2/3 on a parabola (Archimedes).

   The points q_j are support points: those of B that are farthest in a direction of the view plane.
   Their tangents are perpendicular to that direction. Here these directions are turned from the
   edge's outward normal to either side until the point is 2 k beyond the end of the edge.

   3. A solid that is cut by a plane P (outline.c, 1). In a direction w of the view plane B+ is
   farthest where B is, if that point is in front of P. Otherwise it is farthest on P: of the points
   where B+ is farthest, and the straight line from one of them to that point of B, some are on P,
   and no less far. Let n be the unit normal of P, and n . x = c on it. The farthest point on P is
   not farther than max {(w + s n) . x: x in B} - s c, for any s. As s grows, the support point of B
   in the direction w + s n passes from behind P to its front; the straight line between two such
   points contains a point of B on P. */
#include "visibility/proximity/outline_area.h"

#include <math.h>
#include <string.h>

#include "base/outward.h"
#include "base/vec3.h"

/* The number of support points along an edge for upper bounds of areas. Heuristic: any number gives
   bounds, more of them narrower ones. */
#define AREA_POINTS 9
/* The same for signed areas: first the smaller one, then more up to the larger one, until this
   fraction of the largest error is left. */
#define MARGIN_POINTS       5
#define MARGIN_POINTS_MOST  40
#define MARGIN_ERR_FRACTION 0x1p-13
/* Arcs of larger angles, rad, are treated as unknown curves. */
#define ARC_ANGLE_MAX 0.5
/* Steps of the bisection for the largest slope. It ends when the support point is known to this
   fraction of the edge's length, and depths to this fraction of the Hausdorff distance; heuristics
   likewise. */
#define BISECTIONS         20
#define REACHING_ERR       0x1p-6
#define REACHING_SLOPE_ERR 0x1p-4
/* Steps to find a support point on the plane that cuts a solid. */
#define CUT_STEPS 80
/* Beside an edge that is shorter than this many Hausdorff distances, upper bounds of areas are not
   found. Heuristic: the region about so short an edge, 4 k longer, is hardly smaller than the
   rectangle. */
#define LENGTH_MIN 8.0

/* An edge of the part in projection: where it begins, the axes of the coordinates t and depth; the
   part of it over which areas are integrated. */
typedef struct outline_edge {
    const lrcsi_outline *outline;
    const double *a;
    double along[2], outward[2], length;
    double from, to;
} outline_edge;

/* A support point: coordinates t and depth, and the slope of its tangent, on which the depth is
   less by at most `gap`; the direction in which it is farthest, and its position, in the frame of
   the part; its height above the plane that cuts the solid, 0 on it. */
typedef struct outline_point {
    double t, depth, slope, gap;
    double n[3], x[3];
    double height;
} outline_point;

static double height_above(const lrcsi_outline *o, const double x[3])
{
    return lrcsi_vec3_dot(o->up, x) - o->level;
}

/* Of a solid that is cut: the point on the plane that is farthest in a direction n, given the
   solid's support point behind the plane. Returns how much less far it is, at most, than the
   farthest one. */
static double section_point(const lrcsi_outline *o, const double n[3], double x[3])
{
    double behind[3] = {x[0], x[1], x[2]};
    double front[3] = {0, 0, 0};
    double most = HUGE_VAL; /* an upper bound of x . n */
    double low = 0;
    double high = 0; /* 0: no point in front is known yet */
    double next = sqrt(lrcsi_vec3_dot(n, n));
    double gap = HUGE_VAL;
    for (int i = 0; i < CUT_STEPS && gap > 4 * LRCSI_U * o->size; i++) {
        const double turned[3] = {n[0] + next * o->up[0], n[1] + next * o->up[1],
                                  n[2] + next * o->up[2]};
        double point[3];
        lrcsi_support_point(&o->solid, turned, point);
        const double height = height_above(o, point);
        most = lrcsi_min(most, lrcsi_vec3_dot(n, point) + next * height);
        if (height < 0) {
            low = next;
            memcpy(behind, point, sizeof behind);
        } else {
            high = next;
            memcpy(front, point, sizeof front);
        }
        if (high > 0) {
            const double h[2] = {height_above(o, behind), height_above(o, front)};
            const double part = h[0] / (h[0] - h[1]);
            for (int k = 0; k < 3; k++) {
                x[k] = behind[k] + part * (front[k] - behind[k]);
            }
            gap = lrcsi_max(0, most - lrcsi_vec3_dot(n, x));
        }
        next = high > 0 ? 0.5 * (low + high) : 2 * next;
    }
    return gap;
}

/* The point of the true solid that is farthest in the direction outward + slope along of the view
   plane, in projection; the slope of its tangent is the same. */
static outline_point outline_point_at(const outline_edge *edge, double slope)
{
    const lrcsi_outline *o = edge->outline;
    const double w[2] = {edge->outward[0] + slope * edge->along[0],
                         edge->outward[1] + slope * edge->along[1]};
    outline_point point = {.slope = slope};
    double off[2];
    for (int k = 0; k < 3; k++) {
        point.n[k] = o->axis[k][0] * w[0] + o->axis[k][1] * w[1];
    }
    lrcsi_support_point(&o->solid, point.n, point.x);
    if (o->is_cut) {
        point.height = height_above(o, point.x);
        if (point.height < 0) {
            point.gap = section_point(o, point.n, point.x);
            point.height = 0;
        }
    }
    for (int i = 0; i < 2; i++) {
        off[i] = o->centre[i] - edge->a[i];
        for (int k = 0; k < 3; k++) {
            off[i] += point.x[k] * o->axis[k][i];
        }
    }
    point.t = edge->along[0] * off[0] + edge->along[1] * off[1];
    point.depth = -(edge->outward[0] * off[0] + edge->outward[1] * off[1]);
    return point;
}

/* The slope, 0 .. 1 towards the given side (1: towards b), at which the support point is as far as
   t along the edge, and not much farther; 1 if it is not that far for any of these. */
static double slope_reaching(const outline_edge *edge, int side, double t)
{
    const double err = REACHING_ERR * edge->length;
    const double slope_err = REACHING_SLOPE_ERR * edge->outline->k / edge->length;
    double low = 0;
    double high = 1;
    double over = HUGE_VAL; /* how far the point is beyond t at the slope `high` */
    if (side * outline_point_at(edge, 0).t >= side * t) {
        return 0;
    }
    for (int i = 0; i < BISECTIONS && (over > err || high - low > slope_err); i++) {
        /* Slopes range over many magnitudes: the first steps use the geometric mean, with 1e-6 in
           the place of 0. A heuristic: any slope serves, and a better one gives narrower bounds. */
        double middle = i < 8 ? sqrt(lrcsi_max(low, 1e-6) * high) : 0.5 * (low + high);
        double beyond = side * (outline_point_at(edge, side * middle).t - t);
        if (beyond >= 0) {
            high = middle;
            over = beyond;
        } else {
            low = middle;
        }
    }
    return high;
}

/* The integral from t0 to t1 of max(0, v), v linear with these values at the ends. */
static double integral_positive(double t0, double t1, double v0, double v1)
{
    if (!(t1 > t0) || (v0 <= 0 && v1 <= 0)) {
        return 0;
    }
    if (v0 >= 0 && v1 >= 0) {
        return 0.5 * (t1 - t0) * (v0 + v1);
    }
    double v = lrcsi_max(v0, v1);
    return 0.5 * (t1 - t0) * v * (v / (v - lrcsi_min(v0, v1)));
}

/* The coordinates along an edge. Returns 0 if it cannot be used. */
static int outline_edge_make(const lrcsi_outline *o, const double a[3], const double b[3], int side,
                             outline_edge *edge)
{
    const double ab[2] = {b[0] - a[0], b[1] - a[1]};
    *edge = (outline_edge){.outline = o, .a = a};
    edge->length = sqrt(ab[0] * ab[0] + ab[1] * ab[1]);
    if (!o->known || side == 0 || !(edge->length > 0)) {
        return 0;
    }
    edge->along[0] = ab[0] / edge->length;
    edge->along[1] = ab[1] / edge->length;
    edge->outward[0] = side * edge->along[1];
    edge->outward[1] = -side * edge->along[0];
    edge->from = 0;
    edge->to = edge->length;
    return 1;
}

/* Along an edge: the areas between it and the polygon, and the tangents, and the largest depths of
   these, or 0 (2). */
typedef struct outline_sums {
    double gain, loss, gain_depth, loss_depth;
} outline_sums;

/* The signed area with its error, and the largest magnitudes of depths near the ends of the edge
   (3). */
typedef struct outline_signed {
    double area, error;
    double end_depth[2];
} outline_signed;

/* The larger of `most` and the largest magnitude between low and high of a linear function, given
   its value at t = at. */
static double linear_most(double at, double value, double slope, double low, double high,
                          double most)
{
    return low <= high ? lrcsi_max(most, lrcsi_max(fabs(value + slope * (low - at)),
                                                   fabs(value + slope * (high - at))))
                       : most;
}

/* What lies between support points p and q: the slope of the polygon, and where the two tangents
   intersect. */
typedef struct outline_piece {
    const outline_point *p, *q;
    double chord, meet;
} outline_piece;

/* The slope of the polygon is between those of the tangents: where rounding of nearly the same
   positions gives another, the nearest of these leaves the depths as accurate as they are. */
static outline_piece outline_piece_make(const outline_point *p, const outline_point *q)
{
    outline_piece piece = {p, q, p->slope, p->t};
    const double turn = q->slope - p->slope;
    if (q->t > p->t) {
        const double chord = (q->depth - p->depth) / (q->t - p->t);
        piece.chord = lrcsi_min(q->slope, lrcsi_max(p->slope, chord));
    }
    if (turn > 0) {
        const double meet = (p->depth - p->slope * p->t - q->depth + q->slope * q->t) / turn;
        piece.meet = lrcsi_min(q->t, lrcsi_max(p->t, meet));
    }
    return piece;
}

/* Adds the depths near the ends of the edge. */
static void ends_add(const outline_edge *edge, const outline_piece *piece, outline_signed *sums)
{
    const outline_point *p = piece->p;
    const outline_point *q = piece->q;
    for (int end = 0; end < 2; end++) {
        const double middle = end == 0 ? 0 : edge->length;
        const double low = lrcsi_max(p->t, middle - 2 * edge->outline->k);
        const double high = lrcsi_min(q->t, middle + 2 * edge->outline->k);
        const double meet = piece->meet;
        double most = sums->end_depth[end];
        most = linear_most(p->t, p->depth, piece->chord, low, high, most);
        most = linear_most(p->t, p->depth, p->slope, low, lrcsi_min(meet, high), most);
        most = linear_most(q->t, q->depth, q->slope, lrcsi_max(meet, low), high, most);
        sums->end_depth[end] = most;
    }
}

/* The angle of the arc between two support points; HUGE_VAL if it is not known. Of a solid that is
   cut, it must be in front of the plane: an arc is no farther from its chord than that is long. */
static double arc_angle(const lrcsi_outline *o, const outline_point *p, const outline_point *q)
{
    if (o->is_cut) {
        double chord[3];
        lrcsi_vec3_between(p->x, q->x, chord);
        const double square = lrcsi_vec3_dot(chord, chord);
        const double least = lrcsi_min(p->height, q->height);
        if (!(least > 0 && least * least > square)) {
            return HUGE_VAL;
        }
    }
    return lrcsi_support_arc(&o->solid, p->n, p->x, q->n, q->x);
}

/* The signed area over the given part of the edge, in the piece; its error. */
typedef struct piece_area {
    double area, error;
} piece_area;

/* The area of the polygon, less a fraction of what lies between polygon and tangents. */
static piece_area piece_area_make(const outline_edge *edge, const outline_piece *piece)
{
    const outline_point *p = piece->p;
    const outline_point *q = piece->q;
    const double from = lrcsi_max(p->t, edge->from);
    const double to = lrcsi_min(q->t, edge->to);
    if (!(to > from)) {
        return (piece_area){0, 0};
    }
    const double meet = lrcsi_min(to, lrcsi_max(from, piece->meet));
    const double polygon = (to - from) * (p->depth + piece->chord * (0.5 * (from + to) - p->t));
    const double tangents = (meet - from) * (p->depth + p->slope * (0.5 * (from + meet) - p->t)) +
                            (to - meet) * (q->depth + q->slope * (0.5 * (meet + to) - q->t));
    double fraction = 0.5;
    double fraction_err = 0.5;
    if (from == p->t && to == q->t) {
        const double angle = arc_angle(edge->outline, p, q);
        if (angle <= ARC_ANGLE_MAX) {
            fraction_err = angle * angle / 48;
            fraction = 2.0 / 3 - fraction_err;
        }
    }
    return (piece_area){polygon - fraction * (polygon - tangents),
                        fraction_err * lrcsi_max(0, polygon - tangents)};
}

/* Adds what lies between support points p and q. */
static void sums_add(const outline_edge *edge, const outline_point *p, const outline_point *q,
                     outline_sums *sums)
{
    const double beyond = 2 * edge->outline->k;
    const double low = lrcsi_max(p->t, -beyond);
    const double high = lrcsi_min(q->t, edge->length + beyond);
    if (!(high > low)) {
        return;
    }
    const outline_piece piece = outline_piece_make(p, q);
    const double meet = lrcsi_min(high, lrcsi_max(low, piece.meet));
    const double from_p[2] = {-(p->depth + p->slope * (low - p->t)),
                              -(p->depth + p->slope * (meet - p->t))};
    const double to_q[2] = {-(q->depth + q->slope * (meet - q->t)),
                            -(q->depth + q->slope * (high - q->t))};
    sums->loss += integral_positive(low, meet, from_p[0], from_p[1]);
    sums->loss += integral_positive(meet, high, to_q[0], to_q[1]);
    sums->loss_depth = lrcsi_max(sums->loss_depth, lrcsi_max(from_p[0], from_p[1]));
    sums->loss_depth = lrcsi_max(sums->loss_depth, lrcsi_max(to_q[0], to_q[1]));
    const double from = lrcsi_max(p->t, edge->from);
    const double to = lrcsi_min(q->t, edge->to);
    if (to > from) {
        const double at_from = p->depth + piece.chord * (from - p->t);
        const double at_to = p->depth + piece.chord * (to - p->t);
        sums->gain += integral_positive(from, to, at_from, at_to);
        sums->gain_depth = lrcsi_max(sums->gain_depth, lrcsi_max(at_from, at_to));
    }
}

/* Finds `count` support points along the whole edge, their slopes evenly spaced. Returns 0 if the
   outline ends before an end of the edge, or is too steep there. */
static int outline_points_make(const outline_edge *edge, int count, outline_point *point)
{
    const double beyond = 2 * edge->outline->k;
    const double before = -slope_reaching(edge, -1, -beyond);
    const double after = slope_reaching(edge, 1, edge->length + beyond);
    for (int i = 0; i < count; i++) {
        const double part = (double)i / (count - 1);
        point[i] = outline_point_at(edge, before * (1 - part) + after * part);
    }
    return point[0].t <= -beyond && point[count - 1].t >= edge->length + beyond;
}

static outline_sums outline_sums_make(const outline_edge *edge, const outline_point *point,
                                      int count)
{
    outline_sums sums = {.gain = 0};
    for (int i = 1; i < count; i++) {
        sums_add(edge, &point[i - 1], &point[i], &sums);
    }
    return sums;
}

static outline_signed outline_signed_make(const outline_edge *edge, const outline_point *point,
                                          int count)
{
    outline_signed sums = {.area = 0};
    for (int i = 1; i < count; i++) {
        const outline_piece piece = outline_piece_make(&point[i - 1], &point[i]);
        const piece_area area = piece_area_make(edge, &piece);
        sums.area += area.area;
        sums.error += area.error;
        ends_add(edge, &piece, &sums);
    }
    return sums;
}

/* Adds support points, each in the piece with the largest error of its area, at the mean of its two
   slopes, until the errors add up to `enough` or there are MARGIN_POINTS_MOST. Returns their
   number. Arcs that end at an end of the given part of the edge, or at a corner of the outline, are
   found in this way. */
static int outline_points_add(const outline_edge *edge, double enough, outline_point *point,
                              int count)
{
    double error[MARGIN_POINTS_MOST] = {0}; /* of the piece that begins at each point */
    for (int i = 0; i + 1 < count; i++) {
        const outline_piece piece = outline_piece_make(&point[i], &point[i + 1]);
        error[i] = piece_area_make(edge, &piece).error;
    }
    while (count < MARGIN_POINTS_MOST) {
        double sum = 0;
        int worst = 0;
        for (int i = 0; i + 1 < count; i++) {
            sum += error[i];
            worst = error[i] > error[worst] ? i : worst;
        }
        if (!(sum > enough)) {
            break;
        }
        for (int i = count; i > worst + 1; i--) {
            point[i] = point[i - 1];
            error[i] = error[i - 1];
        }
        count++;
        point[worst + 1] =
            outline_point_at(edge, 0.5 * (point[worst].slope + point[worst + 2].slope));
        for (int i = worst; i < worst + 2; i++) {
            const outline_piece piece = outline_piece_make(&point[i], &point[i + 1]);
            error[i] = piece_area_make(edge, &piece).error;
        }
    }
    return count;
}

/* More than sqrt(2) times the length along which the outline is followed. */
static double outline_width(const outline_edge *edge)
{
    return LRCSI_ROOT_2_OUTWARD * (edge->to - edge->from + 4 * edge->outline->k);
}

/* The error of depths along an edge from a to b, given support points. */
static double depth_err(const lrcsi_outline *o, const double a[3], const double b[3],
                        const outline_point *point, int count)
{
    double gap = 0;
    for (int i = 0; i < count; i++) {
        gap = lrcsi_max(gap, point[i].gap);
    }
    return 4 * (o->err + lrcsi_view_point_err(a) + lrcsi_view_point_err(b)) + gap;
}

lrcsi_outline_areas lrcsi_outline_areas_make(const lrcsi_outline *o, const double a[3],
                                             const double b[3], int side)
{
    outline_edge edge;
    outline_point point[AREA_POINTS];
    if (!outline_edge_make(o, a, b, side, &edge) || !(edge.length > LENGTH_MIN * o->k) ||
        !outline_points_make(&edge, AREA_POINTS, point)) {
        return (lrcsi_outline_areas){HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
    }
    const outline_sums sums = outline_sums_make(&edge, point, AREA_POINTS);
    const double width = outline_width(&edge);
    const double err = depth_err(o, a, b, point, AREA_POINTS);
    return (lrcsi_outline_areas){(sums.gain + err * width) * LRCSI_OUTWARD_SUM,
                                 (sums.loss + err * width) * LRCSI_OUTWARD_SUM,
                                 (sums.gain_depth + err) * LRCSI_OUTWARD_SUM,
                                 (sums.loss_depth + err) * LRCSI_OUTWARD_SUM, width};
}

lrcsi_outline_margin lrcsi_outline_margin_make(const lrcsi_outline *o, const double a[3],
                                               const double b[3], int side, double from, double to)
{
    outline_edge edge;
    outline_point point[MARGIN_POINTS_MOST];
    int known = outline_edge_make(o, a, b, side, &edge);
    edge.from = from * edge.length;
    edge.to = to * edge.length;
    if (known && o->is_exact) {
        return (lrcsi_outline_margin){.width = outline_width(&edge)};
    }
    if (!known || !outline_points_make(&edge, MARGIN_POINTS, point)) {
        return (lrcsi_outline_margin){.error = HUGE_VAL};
    }
    const double width = outline_width(&edge);
    outline_sums sums = outline_sums_make(&edge, point, MARGIN_POINTS);
    const double enough = lrcsi_max(depth_err(o, a, b, point, MARGIN_POINTS) * width,
                                    MARGIN_ERR_FRACTION * (sums.gain + sums.loss));
    const int count = outline_points_add(&edge, enough, point, MARGIN_POINTS);
    if (count > MARGIN_POINTS) {
        sums = outline_sums_make(&edge, point, count);
    }
    const double err_depth = depth_err(o, a, b, point, count);
    const double err = err_depth * width;
    const outline_signed found = outline_signed_make(&edge, point, count);
    return (lrcsi_outline_margin){found.area,
                                  (found.error + err) * LRCSI_OUTWARD_SUM,
                                  width,
                                  (sums.gain_depth + sums.loss_depth + 2 * err_depth) *
                                      LRCSI_OUTWARD_SUM,
                                  {(found.end_depth[0] + err_depth) * LRCSI_OUTWARD_SUM,
                                   (found.end_depth[1] + err_depth) * LRCSI_OUTWARD_SUM}};
}
