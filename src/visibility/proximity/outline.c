/* SPDX-License-Identifier: MIT */
/* Decides where a true solid is farthest in directions of the view plane, and from that how much
   area lies between its outline and an edge of its facets. Every area is enlarged by the errors of
   the points that it is computed from. Which points of which facets are concerned is decided in
   visibility/proximity/event_band.c.

   Q, B, S^, k, K, K' and delta are those of outline.h. A line along the direction to the laser that
   meets B or S^ also meets the true surface or the facets: it cannot both enter and leave through
   the same opening. The boundary of K' consists of contour edges of Q, because only there the
   number of facets of S^ that face the laser above a point can fall to 0; and of rim edges, except
   where the opening faces the laser as the wall beside it does, or both face away.

   1. In front of a plane. Let P be a plane, and B and S^ in front of it: no point of them is behind
   it by more than e, and some point of B is in front of it by h. Then Q hides a point x of P if its
   projection lies in K, unless it is within e diameter(B) / h of the outside of K; and x only then.
   The same holds for the facets and K'. Proof: let B+ be the part of B in front of P. What lies on
   the ray of x lies in front of P, so Q hides x if and only if x lies in the projection of B+. The
   straight line from a point of B behind P to the point that is h in front of P meets P after at
   most e / (e + h) of its length. []

   2. Along an edge. Consider a contour edge of length L, and coordinates in projection: t along the
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

   3. Signed area. The depth of the boundary of K is a convex function of t, where K reaches over
   the edge by 2 k at both ends. So it lies between the polygon and the tangents of 2, and its
   integral over any part of 0 <= t <= L between the integrals of these two.

   The points q_j are support points: those of B that are farthest in a direction of the view plane.
   Their tangents are perpendicular to that direction. Here these directions are turned from the
   edge's outward normal to either side until the point is 2 k beyond the end of the edge. */
#include "visibility/proximity/outline.h"

#include <math.h>

#include "base/outward.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "scene/proximity.h"
#include "view/separation.h"

/* The number of support points on either side of the one in the direction of the edge's normal.
   Heuristic: any number gives bounds, more of them narrower ones. */
#define POINTS_SIDE 4
/* The same for signed areas, of which the error falls with the square of this number: first the
   smaller one, and then, if it leaves more of the error than this, the larger one. */
#define MARGIN_POINTS_SIDE  8
#define MARGIN_POINTS_MOST  32
#define MARGIN_ERR_FRACTION 0x1p-10
/* Steps of the bisection for the largest slope; heuristic likewise. */
#define BISECTIONS 20
/* An edge that is shorter than this many Hausdorff distances is not used. Heuristic: the region
   about so short an edge, 4 k longer, is hardly smaller than the rectangle. */
#define LENGTH_MIN 8.0
/* Cosines larger than this have the sign that they seem to have: axes and directions are accurate
   to some 30 u. */
#define OPENING_COS_MIN 1e-6

lrcsi_outline lrcsi_outline_make(const lrcsi_view *view, uint32_t index)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    lrcsi_outline o = {.part = part};
    if (!part->rigid || !(part->bounds.reach > 0) || part->kind == LRCS_SHAPE_DISC ||
        lrcsi_proximity_openings(p, index) > 1) {
        return o;
    }
    lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    if (body.step > 0 && !body.level_zones) {
        return o; /* its vertices are not at the true heights */
    }
    double far = 0;
    o.known = 1;
    o.vertex_ratio = body.vertex_ratio;
    o.solid = lrcsi_body_solid(p, index);
    for (int k = 0; k < 3; k++) {
        o.origin[k] = ldexp(part->origin[k], -p->exponent);
        far += fabs(o.origin[k] - p->origin[k]) + fabs(o.origin[k]);
    }
    double x[3];
    lrcsi_view_coordinates(view, o.origin, x);
    for (int i = 0; i < 2; i++) {
        o.centre[i] = x[i];
        for (int k = 0; k < 3; k++) {
            o.axis[k][i] = lrcsi_vec3_dot(view->R[i], part->axis[k]);
        }
    }
    o.size = 2 * o.vertex_ratio * lrcsi_max(o.solid.radius, o.solid.radius2) + o.solid.length;
    o.k = p->proximity.hausdorff[index];
    o.err = 64 * LRCSI_U * (far + o.size) + ldexp(part->bounds.position_err, -p->exponent);
    return o;
}

/* The unit normal of a facet's plane, on its front. The narrow facets of a disc are turned by
   rounding far more than the disc: its normal is along the part's axis. Returns the error of the
   normal, for the true surface that the facet stands for. */
static double plane_normal(const lrcs_prepared *p, uint32_t facet, double n[3])
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    const lrcsi_normal *normal = &p->normal[facet];
    const int is_disc = part->bounds.reach > 0 && part->rigid && p->scene->facet_smooth[facet] == 0;
    const double side = lrcsi_vec3_dot(part->axis[2], normal->high) < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        n[k] = is_disc ? side * part->axis[2][k] : normal->high[k] / normal->length;
    }
    return is_disc ? 0 : part->bounds.normal_err;
}

/* The vertices of a solid of facets are those of the true one, stretched across the axis by
   vertex_ratio: so is its support. If the facet belongs to a curved part, the plane of its true
   surface differs from its own by the rounding of its corners. Both the true solid and that of the
   facets leave open a distance of e size / height; the first of the two changes x, the second y
   and the depth of y. */
int lrcsi_outline_in_front(const lrcsi_outline *o, const lrcsi_view *view, uint32_t facet,
                           double *err)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *own = &p->scene->part[p->scene->facet_part[facet]];
    double n[3];
    double from[3];
    const double normal_err = plane_normal(p, facet, n);
    lrcsi_vec3_between(lrcsi_prepared_corner(p, facet, 0), o->origin, from);
    double up[3];
    double down[3];
    for (int k = 0; k < 3; k++) {
        up[k] = lrcsi_vec3_dot(o->part->axis[k], n);
        down[k] = -up[k];
    }
    double at = lrcsi_vec3_dot(from, n);
    double far = fabs(from[0]) + fabs(from[1]) + fabs(from[2]) + o->size;
    double e = 2 * o->err + 64 * LRCSI_U * far;
    if (own->bounds.reach > 0) {
        e += normal_err * far + 2 * ldexp(own->bounds.position_err, -p->exponent);
    }
    double lowest[3];
    double highest[3];
    lrcsi_support_point(&o->solid, up, highest);
    lrcsi_support_point(&o->solid, down, lowest);
    double behind = lrcsi_vec3_dot(lowest, down);
    const double wider[3] = {o->vertex_ratio * down[0], o->vertex_ratio * down[1], down[2]};
    lrcsi_support_point(&o->solid, wider, lowest);
    behind = lrcsi_max(behind, lrcsi_vec3_dot(lowest, wider)) - at;
    double height = at + lrcsi_vec3_dot(highest, up) - e;
    *err = height > 0 ? 4 * e * (1 + o->size / height) : HUGE_VAL;
    return view->facing[facet] > 0 && behind <= e && *err <= 0.5 * o->k;
}

/* The opening is at z = 0, its normal along -z. */
int lrcsi_outline_inside(const lrcsi_outline *o, const lrcsi_view *view, int facing)
{
    double cosine = -lrcsi_vec3_dot(o->part->axis[2], view->unit);
    return (facing > 0 && cosine > OPENING_COS_MIN) || (facing < 0 && cosine < -OPENING_COS_MIN);
}

/* An edge of the part in projection: where it begins, the axes of the coordinates t and depth; the
   part of it over which areas are integrated. */
typedef struct outline_edge {
    const lrcsi_outline *outline;
    const double *a;
    double along[2], outward[2], length;
    double from, to;
} outline_edge;

/* A support point: coordinates t and depth, and the slope of its tangent. */
typedef struct outline_point {
    double t, depth, slope;
} outline_point;

/* The point of the true solid that is farthest in the direction outward + slope along of the view
   plane, in projection; the slope of its tangent is the same. */
static outline_point outline_point_at(const outline_edge *edge, double slope)
{
    const lrcsi_outline *o = edge->outline;
    const double w[2] = {edge->outward[0] + slope * edge->along[0],
                         edge->outward[1] + slope * edge->along[1]};
    double n[3];
    double x[3];
    double off[2];
    for (int k = 0; k < 3; k++) {
        n[k] = o->axis[k][0] * w[0] + o->axis[k][1] * w[1];
    }
    lrcsi_support_point(&o->solid, n, x);
    for (int i = 0; i < 2; i++) {
        off[i] = o->centre[i] + x[0] * o->axis[0][i] + x[1] * o->axis[1][i] + x[2] * o->axis[2][i];
        off[i] -= edge->a[i];
    }
    return (outline_point){edge->along[0] * off[0] + edge->along[1] * off[1],
                           -(edge->outward[0] * off[0] + edge->outward[1] * off[1]), slope};
}

/* The slope, 0 .. 1 towards the given side (1: towards b), at which the support point is as far as
   t along the edge; 1 if it is not that far for any of these. */
static double slope_reaching(const outline_edge *edge, int side, double t)
{
    double low = 0;
    double high = 1;
    if (side * outline_point_at(edge, 0).t >= side * t) {
        return 0;
    }
    for (int i = 0; i < BISECTIONS; i++) {
        /* Slopes range over many magnitudes: the first steps use the geometric mean, with 1e-6 in
           the place of 0. A heuristic: any slope serves, and a better one gives narrower bounds. */
        double middle = i < 8 ? sqrt(lrcsi_max(low, 1e-6) * high) : 0.5 * (low + high);
        if (side * outline_point_at(edge, side * middle).t >= side * t) {
            high = middle;
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
    if (!o->known || side == 0 || !(edge->length > LENGTH_MIN * o->k)) {
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
   these, or 0 (2); the integrals of these two over the edge (3). */
typedef struct outline_sums {
    double gain, loss, gain_depth, loss_depth, polygon, tangents;
} outline_sums;

/* Adds what lies between support points p and q. Returns 0 if the polygon is too steep. */
static int sums_add(const outline_edge *edge, const outline_point *p, const outline_point *q,
                    outline_sums *sums)
{
    const double beyond = 2 * edge->outline->k;
    const double low = lrcsi_max(p->t, -beyond);
    const double high = lrcsi_min(q->t, edge->length + beyond);
    if (!(high > low)) {
        return 1;
    }
    const double chord = (q->depth - p->depth) / (q->t - p->t);
    if (!(fabs(chord) <= 1)) { /* all tangents are less steep */
        return 0;
    }
    const double turn = q->slope - p->slope;
    double meet = turn > 0 ? (p->depth - p->slope * p->t - q->depth + q->slope * q->t) / turn : low;
    meet = lrcsi_min(high, lrcsi_max(low, meet));
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
        const double at_from = p->depth + chord * (from - p->t);
        const double at_to = p->depth + chord * (to - p->t);
        meet = lrcsi_min(to, lrcsi_max(from, meet));
        sums->gain += integral_positive(from, to, at_from, at_to);
        sums->gain_depth = lrcsi_max(sums->gain_depth, lrcsi_max(at_from, at_to));
        sums->polygon += 0.5 * (to - from) * (at_from + at_to);
        sums->tangents += (meet - from) * (p->depth + p->slope * (0.5 * (from + meet) - p->t));
        sums->tangents += (to - meet) * (q->depth + q->slope * (0.5 * (meet + to) - q->t));
    }
    return 1;
}

/* Adds up along the whole edge, with this many support points on either side of the one in the
   direction of its normal. Returns 0 if the outline ends there, or is too steep. */
static int outline_sums_make(const outline_edge *edge, int per_side, outline_sums *sums)
{
    const double beyond = 2 * edge->outline->k;
    const double before = slope_reaching(edge, -1, -beyond);
    const double after = slope_reaching(edge, 1, edge->length + beyond);
    outline_point last = outline_point_at(edge, -before);
    *sums = (outline_sums){.gain = 0};
    if (last.t > -beyond) {
        return 0;
    }
    for (int i = 1; i <= 2 * per_side; i++) {
        const double steps = (double)i / per_side - 1; /* -1 .. 1 */
        const outline_point next = outline_point_at(edge, steps * (steps < 0 ? before : after));
        if (!sums_add(edge, &last, &next, sums)) {
            return 0;
        }
        last = next;
    }
    return last.t >= edge->length + beyond;
}

/* More than sqrt(2) times the length along which the outline is followed. */
static double outline_width(const outline_edge *edge)
{
    return LRCSI_ROOT_2_OUTWARD * (edge->to - edge->from + 4 * edge->outline->k);
}

/* The error of depths along an edge from a to b. */
static double depth_err(const lrcsi_outline *o, const double a[3], const double b[3])
{
    return 4 * (o->err + lrcsi_view_point_err(a) + lrcsi_view_point_err(b));
}

lrcsi_outline_areas lrcsi_outline_areas_make(const lrcsi_outline *o, const double a[3],
                                             const double b[3], int side)
{
    outline_edge edge;
    outline_sums sums;
    if (!outline_edge_make(o, a, b, side, &edge) || !outline_sums_make(&edge, POINTS_SIDE, &sums)) {
        return (lrcsi_outline_areas){HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
    }
    const double width = outline_width(&edge);
    const double err = depth_err(o, a, b);
    return (lrcsi_outline_areas){(sums.gain + err * width) * LRCSI_OUTWARD_SUM,
                                 (sums.loss + err * width) * LRCSI_OUTWARD_SUM,
                                 (sums.gain_depth + err) * LRCSI_OUTWARD_SUM,
                                 (sums.loss_depth + err) * LRCSI_OUTWARD_SUM, width};
}

/* Half of what lies between the polygon and the tangents. */
static double sums_between(const outline_sums *sums)
{
    return 0.5 * lrcsi_max(0, sums->polygon - sums->tangents);
}

lrcsi_outline_margin lrcsi_outline_margin_make(const lrcsi_outline *o, const double a[3],
                                               const double b[3], int side, double from, double to)
{
    outline_edge edge;
    outline_sums sums;
    int known = outline_edge_make(o, a, b, side, &edge);
    edge.from = from * edge.length;
    edge.to = to * edge.length;
    if (!known || !outline_sums_make(&edge, MARGIN_POINTS_SIDE, &sums)) {
        return (lrcsi_outline_margin){0, HUGE_VAL, 0};
    }
    const double width = outline_width(&edge);
    const double err = depth_err(o, a, b) * width;
    outline_sums closer;
    if (sums_between(&sums) > lrcsi_max(err, MARGIN_ERR_FRACTION * (sums.gain + sums.loss)) &&
        outline_sums_make(&edge, MARGIN_POINTS_MOST, &closer)) {
        sums = closer;
    }
    return (lrcsi_outline_margin){0.5 * (sums.polygon + sums.tangents),
                                  (sums_between(&sums) + err) * LRCSI_OUTWARD_SUM, width};
}
