/* SPDX-License-Identifier: MIT */
/* Decides how far from an event edge the visibility of the true shapes may differ from that of
   their facets, and cuts a facet accordingly. Nothing is decided exactly: every distance is
   increased by the errors of the positions between which it is measured. How bands add up is
   decided in visibility/proximity/proximity_band.c. The letters, the conditions (1) and (2), and
   the steps a to e are those of its proof 1.

   1. Distance in projection. In the distance of (2) from y, a bound on the component of x - y
   perpendicular to d may replace e_P, unless Q is open and k_Q > 0. On the curved wall of a shape
   that is placed without distortion, the map moves points by known distances from or towards the
   axis, along it, and tangentially (its bounds.displacement). The bound is the sum of the three, of
   which the first two are multiplied by the sines of the angles between these directions and d. To
   the sides of an event edge only the component of x - y perpendicular to the edge counts, since
   the paths below cross the line of the edge only if that component and k_Q together reach it; at
   the ends of the edge the whole bound counts.
   Proof: it suffices to take for z the points x + v, |v| <= k_Q, and the straight paths from y to
   them. In step b, the point s hides one of these z. In c, x is one of them. In d, if S hides all
   of them, the ball of radius k_Q about x lies within k_Q of V; so x lies in V, and Q, without
   openings, hides x. []

   2. Gain and loss. An event edge is near if (2) holds for it. It is one-sided if all facets of Q
   on it lie on the same side of it in projection, its inner side; the other side is its outer side.
   Let a point move from y straight to one of the z, and let n be the number of facets of Q on its
   ray. Unless (1) holds or a near edge is not one-sided, n rises from 0 only where the ray crosses
   a near edge from its outer to its inner side, and falls to 0 only where it crosses one from its
   inner to its outer side. It crosses the line of an edge at most once.
   - Loss: Q hides x, but its facets do not hide y. Then (1) holds, or a near edge is not one-sided,
     or y is on the outer side of a near edge. Proof: n rises from 0 on the path to the z of step b.
   - Gain: the facets of Q hide y, but Q does not hide x. If Q is not open or k_Q = 0, (1) holds, or
     a near edge is not one-sided, or y is on the inner side of a near edge. Proof: otherwise n
     never falls to 0, so S hides all z, and Q hides x. The same is true if Q has one opening and x
     is not in B: the ray of x enters B and leaves it, and passes the opening only once. For any
     other Q, gain is possible on both sides.

   3. Own part. A part never hides those of its own points that face the laser: they are the upper
   side of its B. The inside of an open part, where it reflects (two-sided), is the lower side of B,
   seen through an opening: the part does not hide x if and only if the projection of x lies in the
   projected opening of W, and likewise y for S. Projected openings of W and S are convex and within
   e of each other. So x and y agree, unless y is in projection within 2 e of a rim beyond which the
   wall faces the laser, or may face it.

   4. Parts in front. Where a Q with at most one opening is in front of the plane of a flat facet,
   or a plane separates it from P behind it (visibility/proximity/part_order.c), (1) need not be
   considered, and y is gained or lost along the event edge of Q that is nearest to it in
   projection, however far behind y that is: the contour of the facets may lie far below the true
   one, and what Q hides depends on projections alone. It is gained or lost only within the region
   of outline_area.c, 1. In it delta is the distance in projection of x from y, and for the plane of
   a facet the error of outline.c, 1, as well. So of the rectangle along each edge only what is
   within the region's depths counts, and at most the area of the region. The edge itself remains in
   its band, with more than sqrt(2) delta and the errors of positions on either side, because no
   depth is negative: so it crosses no facet that meets no band.

   5. Aligned points. Let x now be the point of the true surface whose projection is that of
   y, so that both lie on a line along d, at a distance of at most 180 e_P. Let every other part Q
   be in front of P or behind it (part_order.c, 1), or have no facet within 192 slacks of the facet
   of y (scene/proximity.h). Then (1) need not be considered, and Q hides x if and only if its
   facets hide y, unless an event edge of Q is, in projection, within r' of both and, if Q is not in
   front of P, not 384 slacks behind y, where r' is k_Q or, if Q is open, 2 k_Q: the slack for e_P =
   0.
   Proof:
   - If Q is behind P, it hides neither.
   - If Q is in front of P, all of Q is nearer than x and y. The number of facets of Q on the ray of
     a point z changes only where the projection of z crosses an event edge. So the steps b to e
     hold for x in place of y with e_P = 0; in e a path that stays on W ends in front of x, so
     that it reaches a rim.
   - Otherwise no facet of Q is within r' of x, or between x and y, since both are within 180 e_P +
     r' <= 192 slacks of y. So the facets of Q hide y if and only if they hide x, and what
     proximity_band.c proves in 1 holds for x in place of y with e_P = 0. What 2 and 4 say of gain
     and loss holds as well, with delta = 0. []
   A part of a facet's side is free if every event edge of other parts that may matter is farther
   than r' + 2 e_P from it in projection. Then all points of the true surface whose projections are
   within 2 e_P of it, and that are within 180 e_P of the facet, are visible, and so are the points
   of the facet there; or all of them are hidden. The proof is the same.
   On the inside of an open part the part itself may hide points, by 3: x unless its projection lies
   in the projected opening of W, and y unless it lies in that of S. These openings differ within
   k_P of the rims in 3 only. The fractions of aligned points do not contain what they differ by
   (integrate/wall/round_rim.h adds it), but a side is not free if such a rim is within k_P + 2 e_P
   of it in projection.
   These fractions are of the facet's projected area. They are used for facets on round walls of
   which the laser may see the outside or the inside (integrate/wall/round_pieces.h).

   6. Flat faces. Let U be the polygon of a flat face of P (visibility/proximity/face_margin.h) and
   V the true face, a disc of the same area in the same plane. With v = 1 where a point of V is
   visible, and w = 1 where one of U is, on facets, the true shapes leave visible, in projection,
       Int_V v - Int_U w = Int_(U and V) (v - w) + Int_(V without U) v - Int_(U without V) w
   more. In the first integral points are aligned, and in the same place to within rounding: so 5
   holds without a condition on the order of parts, except that (1) remains, within r' and the
   rounding of places, for facets of Q that are not in front or behind; 1.f of proximity_band.c
   tells on which side. It is at most the sum of the fractions of aligned points; along an event
   edge it may instead be known together for the whole face, because each point is attributed to
   the nearest event edge of Q only (4): between the loss and the gain of outline_area.c or, where
   nothing else is near, with its sign. The other two integrals are over regions along the sides
   of U, no wider than e_P, where V exceeds the side or falls short of it. For each side the
   areas of both are equal, by symmetry. If the side is free and farther than the slack of P and
   Q and 4 e_P from all facets of Q that are not in front or behind, but for parts that pierce
   the face, then v = w is constant there, and the two integrals cancel: for a Q that is open and
   neither in front nor behind this is not proved, and faces are not used if such a Q comes
   within its slack of them in projection. Along any other side they differ by at most the area
   of either region, below twice the side's length times e_P.

   7. Signs of displacements. Let Q be exact, k_Q = 0, and P have a straight wall, placed without
   distortion. With the symbols of mesh/shape/revolution_reach.c, on a sector with h, kappa and the
   true radius rho the map takes y = rho kappa (1, v tan h), -1 <= v <= 1, in the directions radial
   and around, to x = rho (cos vh, sin vh), at the same height. So x is farther out than y where cos
   vh > kappa, by at most rho (1 - kappa), and farther in elsewhere, by at most rho (kappa - cos h);
   about equal areas of the sector are displaced in either direction. In 2 the path is straight,
   from y to x, and it crosses the line of the edge from the inner to the outer side only if the
   component of x - y along the outward normal m of the edge in projection is positive and at least
   the depth of y. So y is gained only where that holds, and lost only where it holds of the inward
   normal. With T a bound on what the other components and rounding add to it, that is where (cos vh
   - kappa) (radial . m) > -T / rho. As y . radial = rho kappa and y . around = rho kappa v tan h
   from a point of the axis, |v| = c in two planes through the axis. For each v one of the two is
   possible: so beside each point of the edge the band contains the facet on its inner or on its
   outer side, and a path over facets that crosses the edge meets it. */
#include "visibility/proximity/event_band.h"

#include <math.h>

#include "base/degrees.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/shape/revolution.h"
#include "visibility/index/event.h"

/* The projected areas of facets with a larger cosine than this are accurate to
   LRCSI_VIEW_COS_ERR, relative: 30 u / 1e-4 is below 1e-10. */
#define COS_MIN 1e-4

static uint32_t facet_part(const lrcsi_event_bands *bands, uint32_t facet)
{
    return bands->view->prepared->scene->facet_part[facet];
}

/* 1 if an event edge is a rim of its part whose wall faces the laser, or may face it; also 1 if the
   limit of steps is reached. */
static int rim_may_face(const lrcsi_event_bands *bands, uint32_t event)
{
    const lrcsi_view *view = bands->view;
    const lrcs_prepared *p = view->prepared;
    const uint32_t part = bands->events.part[event];
    const uint32_t edge = bands->events.edge[event];
    if (!lrcsi_meter_take(bands->meter, p->topology.edge[edge].uses)) {
        return 1;
    }
    const lrcsi_edge_facets on = lrcsi_edge_facets_of(view, edge, part);
    return lrcsi_edge_is_rim(&on) &&
           lrcsi_view_may_face(view, on.facet[0], p->scene->part[part].bounds.patch.turn);
}

/* The distance in projection within which an event edge may change what is visible of a facet,
   unless it is behind the facet; 0 if it cannot. In the facet's own part only the rims of openings
   can. */
static double event_slack(const lrcsi_event_bands *bands, uint32_t facet, uint32_t event,
                          int correspondence, double lateral)
{
    const lrcs_prepared *p = bands->view->prepared;
    uint32_t part = facet_part(bands, facet);
    if (correspondence == LRCSI_ALIGNED) {
        return bands->events.part[event] == part
                   ? 0
                   : lrcsi_proximity_slack_aligned(p, bands->events.part[event]);
    }
    if (bands->events.part[event] == part) {
        return rim_may_face(bands, event) ? 2 * p->proximity.reach[part] : 0;
    }
    return lrcsi_proximity_slack_across(p, part, bands->events.part[event], lateral);
}

/* How far from a facet in projection event edges matter, of parts with this Hausdorff distance. A
   slack is at most e_P + 2 k_Q or 2 e_P, and 2 e_P + 2 k_Q at the sides of a facet; the error of an
   order is at most k_Q / 2. */
static double largest_slack(double reach, double hausdorff)
{
    return 2 * reach + 3 * hausdorff + 2 * LRCSI_PROXIMITY_ERR;
}

lrcsi_band_search lrcsi_band_search_make(const lrcsi_event_bands *bands, uint32_t facet)
{
    const lrcsi_proximity *proximity = &bands->view->prepared->proximity;
    const double reach = proximity->reach[facet_part(bands, facet)];
    const double near = largest_slack(reach, proximity->max_hausdorff);
    return (lrcsi_band_search){lrcsi_edge_search_make(bands->view, facet, near), reach};
}

lrcsi_band_search lrcsi_band_search_around(const lrcsi_event_bands *bands, const uint32_t *facet,
                                           uint32_t count, lrcsi_grid_walk *walk)
{
    const lrcsi_proximity *proximity = &bands->view->prepared->proximity;
    lrcsi_band_search search = {.reach = 0};
    for (uint32_t i = 0; i < count; i++) {
        search.reach = lrcsi_max(search.reach, proximity->reach[facet_part(bands, facet[i])]);
    }
    search.edges =
        lrcsi_edge_search_around(bands->view, &bands->events.grid, facet, count,
                                 largest_slack(search.reach, proximity->max_hausdorff), walk);
    return search;
}

int lrcsi_band_excludes(const lrcsi_event_bands *bands, const lrcsi_band_search *where,
                        uint32_t event, int *line)
{
    const lrcsi_view *view = bands->view;
    const lrcs_prepared *p = view->prepared;
    const lrcsi_edge *edge = &p->topology.edge[bands->events.edge[event]];
    const double hausdorff = p->proximity.hausdorff[bands->events.part[event]];
    return lrcsi_edge_search_excludes(&where->edges, view->point[edge->low].x,
                                      view->point[edge->high].x,
                                      largest_slack(where->reach, hausdorff), line);
}

int lrcsi_band_sees_inside(const lrcsi_event_bands *bands, uint32_t facet)
{
    return bands->view->facing[facet] < 0 &&
           !bands->view->prepared->scene->part[facet_part(bands, facet)].solid;
}

/* Heights along the axis are not displaced: the bound of that component is one on rounding. The
   error of the origin in the view is added to it. */
static lrcsi_band_sector band_sector_make(const lrcsi_view *view, uint32_t facet,
                                          const lrcsi_displacement *displacement)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    lrcsi_band_sector sector = {.known = 1, .half = body.half, .rounding = displacement->bound[1]};
    double sine;
    double origin[3];
    lrcsi_degrees_sincos_plain(180.0 / body.around, &sine, &sector.cosine);
    sector.tangent = sine / sector.cosine;
    sector.kappa = body.vertex_ratio * sector.cosine;
    for (int k = 0; k < 3; k++) {
        origin[k] = ldexp(part->origin[k], -p->exponent);
    }
    lrcsi_view_coordinates(view, origin, sector.origin);
    sector.rounding += LRCSI_EDGE_RECTANGLE_ERR * lrcsi_view_point_err(sector.origin);
    for (int i = 0; i < 3; i++) {
        sector.radial[i] = lrcsi_vec3_dot(view->R[i], displacement->direction[0]);
        sector.around[i] = lrcsi_vec3_dot(view->R[i], displacement->direction[2]);
    }
    return sector;
}

lrcsi_band_facet lrcsi_band_facet_make(const lrcsi_event_bands *bands, uint32_t facet,
                                       const lrcsi_edge_search *where)
{
    lrcsi_band_facet at = {.facet = facet,
                           .where = where,
                           .inside = lrcsi_band_sees_inside(bands, facet),
                           .displacement =
                               lrcsi_proximity_displacement(bands->view->prepared, facet)};
    at.lateral = lrcsi_displacement_across(&at.displacement, bands->view->unit);
    if (at.displacement.known && lrcsi_proximity_has_rows(bands->view->prepared, facet)) {
        at.sector = band_sector_make(bands->view, facet, &at.displacement);
    }
    return at;
}

/* Is gain possible only on the inner side of a part's event edges? It is for parts without openings
   or without reach, and for parts with one opening if their boxes do not contain points of the
   facet's patch. */
static int gain_is_inside(const lrcsi_event_bands *bands, const lrcsi_band_facet *at, uint32_t part)
{
    const lrcs_prepared *p = bands->view->prepared;
    const lrcsi_box *box = &bands->box[part];
    int openings = p->proximity.reach[part] > 0 ? lrcsi_proximity_openings(p, part) : 0;
    int apart = 0;
    for (int k = 0; k < 3; k++) {
        apart |= at->where->low[k] > box->high[k] || at->where->high[k] < box->low[k];
    }
    return openings == 0 || (openings == 1 && apart);
}

int lrcsi_event_rim_is_inside(const lrcsi_event_bands *bands, uint32_t event)
{
    const uint32_t part = bands->events.part[event];
    const lrcsi_outline *outline = &bands->orders.outline[part];
    const lrcsi_edge_facets on = lrcsi_edge_facets_of(bands->view, bands->events.edge[event], part);
    return outline->known && lrcsi_edge_is_rim(&on) &&
           lrcsi_outline_inside(outline, bands->view, bands->view->facing[on.facet[0]]);
}

static lrcsi_outline_areas event_areas(const lrcsi_event_bands *bands, uint32_t event)
{
    const lrcsi_view *view = bands->view;
    const lrcsi_edge *edge = &view->prepared->topology.edge[bands->events.edge[event]];
    const lrcsi_outline *outline = &bands->orders.outline[bands->events.part[event]];
    return lrcsi_event_rim_is_inside(bands, event)
               ? (lrcsi_outline_areas){0, 0, 0, 0, 0}
               : lrcsi_outline_areas_make(outline, view->point[edge->low].x,
                                          view->point[edge->high].x, bands->events.side[event]);
}

/* The region along an event edge in which something of a facet, behind the event's part, can be
   gained or lost; infinite if nothing is known. delta: as in visibility/proximity/outline.h. */
static lrcsi_outline_areas outline_region(const lrcsi_event_bands *bands, uint32_t event,
                                          double delta)
{
    const lrcsi_outline *outline = &bands->orders.outline[bands->events.part[event]];
    lrcsi_outline_areas region = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
    if (delta <= outline->k) {
        region = bands->areas[event];
        region.gain += region.width * delta;
        region.loss += region.width * delta;
        region.gain_depth += LRCSI_ROOT_2_OUTWARD * delta;
        region.loss_depth += LRCSI_ROOT_2_OUTWARD * delta;
    }
    return region;
}

/* The fraction of a facet that an area in projection is; infinite if the facet is too oblique. */
static double fraction_of(const lrcsi_view *view, uint32_t facet, double area)
{
    const double projected = lrcsi_view_projected(view, facet);
    const double whole = 0.5 * view->prepared->normal[facet].length;
    return projected > COS_MIN * whole ? area / projected * (1 + LRCSI_VIEW_COS_ERR) : HUGE_VAL;
}

/* Is an event edge of another part so far behind a facet that it does not matter? Where points are
   aligned, no edge of a part in front of the facet's is: 5. */
static int event_is_behind(lrcsi_event_bands *bands, uint32_t facet, uint32_t event, int is_aligned)
{
    const lrcs_prepared *p = bands->view->prepared;
    const uint32_t part = bands->events.part[event];
    const double slack = (is_aligned ? LRCSI_PROXIMITY_NEAR : 1) *
                         lrcsi_proximity_slack(p, facet_part(bands, facet), part);
    double unproved;
    return lrcsi_edge_rectangle_behind(bands->view, facet,
                                       &p->topology.edge[bands->events.edge[event]], slack) &&
           !(is_aligned &&
             lrcsi_part_is_separated_in_front(&bands->orders, facet, part, &unproved));
}

/* The rectangle about an event edge near a facet. slack: event_slack of the displacement across the
   line of sight, `wider` included, which counts at the ends of the edge. To its sides only the
   component perpendicular to the edge counts. */
static lrcsi_edge_rectangle event_rectangle(const lrcsi_event_bands *bands,
                                            const lrcsi_band_facet *at, uint32_t event,
                                            int correspondence, double slack, double wider)
{
    const lrcsi_topology *topology = &bands->view->prepared->topology;
    lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(
        bands->view, at->facet, &topology->edge[bands->events.edge[event]], slack);
    if (box.has_sides && correspondence == LRCSI_MAPPED) {
        double across = lrcsi_displacement_along(&at->displacement, box.across) +
                        box.rotation_err * at->lateral;
        across =
            event_slack(bands, at->facet, event, LRCSI_MAPPED, lrcsi_min(across, at->lateral)) +
            wider;
        box.half_width = lrcsi_min(across, slack) + box.err;
    }
    return box;
}

/* What of a slice is gained or lost because x is displaced from y along an outward normal of the
   edge in projection, or an inward one. */
typedef struct signed_region {
    double radius[2]; /* the least and the largest rho in the slice */
    double slope;     /* the component of `radial` along that normal */
    double other;     /* T */
} signed_region;

/* Makes it for the normal that is outward (1) or inward (-1). Given: the rectangle about the edge,
   a slice, the side of the edge's facets. Returns 0 if no sign is known. */
static int signed_region_make(const lrcsi_band_facet *at, const lrcsi_edge_rectangle *box,
                              const lrcsi_slice *slice, int side, int outward,
                              signed_region *region)
{
    const lrcsi_band_sector *s = &at->sector;
    const lrcsi_displacement *d = &at->displacement;
    const double sign = (box->reverse ? 1 : -1) * side * outward; /* `across` is to the left */
    *region = (signed_region){.radius = {HUGE_VAL, 0}};
    if (!s->known || !box->has_sides || !(s->kappa > 0.5)) {
        return 0;
    }
    for (int i = 0; i < slice->count; i++) {
        double from[3];
        lrcsi_vec3_between(s->origin, slice->x[i], from);
        lrcsi_range_extend(lrcsi_vec3_dot(from, s->radial) / s->kappa, &region->radius[0],
                           &region->radius[1]);
    }
    region->radius[0] -= 2 * (s->rounding + box->err);
    region->radius[1] += 2 * (s->rounding + box->err);
    region->slope = sign * lrcsi_vec3_dot(d->direction[0], box->across);
    region->other = d->bound[2] * (fabs(lrcsi_vec3_dot(d->direction[2], box->across)) + 1e-12) +
                    2 * s->rounding + (box->rotation_err + 1e-12) * d->reach + LRCSI_PROXIMITY_ERR;
    return region->radius[0] > 0 && fabs(region->slope) > 1e-6;
}

/* Keeps what of a slice has v <= c (side 1), or v >= -c (side -1). */
static void slice_cut_azimuth(const lrcsi_band_sector *s, int side, double c, double err,
                              lrcsi_slice *slice)
{
    double n[3];
    for (int i = 0; i < 3; i++) {
        n[i] = side * s->around[i] - c * s->tangent * s->radial[i];
    }
    lrcsi_slice_cut(slice, n, s->origin, err);
}

/* The fraction of a facet in a slice where x is displaced along the normal of the region, and no
   deeper beside the edge than by that: where x is farther out than y, |v| is at most some c;
   elsewhere it is at least c. These follow from q = 1 - cos vh, for which with |v| <= 1
   (vh)^2 / 2 (1 - h^2 / 12) <= q <= (vh)^2 / 2. depth_side: as for lrcsi_edge_rectangle_limit. */
static double signed_fraction(const lrcsi_band_facet *at, const lrcsi_edge_rectangle *box,
                              const signed_region *region, lrcsi_slice slice, int depth_side,
                              double whole, double longest)
{
    const lrcsi_band_sector *s = &at->sector;
    const double outward = 1 - s->kappa; /* at v = 0, divided by rho */
    const double slope = fabs(region->slope);
    const double tau = region->other / (region->radius[0] * slope) + LRCSI_REVOLUTION_SLACK;
    const double err = 2 * (s->rounding + box->err);
    const int is_out = region->slope > 0;
    const double most = (is_out ? outward : s->kappa - s->cosine) + LRCSI_REVOLUTION_SLACK;
    const double depth = (region->radius[1] * most * slope + region->other) * LRCSI_OUTWARD_NANO;
    slice = lrcsi_edge_rectangle_limit(slice, box, depth_side, depth);
    if (is_out) {
        const double square = 2 * lrcsi_max(0, outward + tau) / (1 - s->half * s->half / 12);
        const double c = lrcsi_min(1, sqrt(square) / s->half * LRCSI_OUTWARD_NANO);
        slice_cut_azimuth(s, 1, c, err, &slice);
        slice_cut_azimuth(s, -1, c, err, &slice);
        return lrcsi_slice_fraction(&slice, whole, longest);
    }
    const double c = sqrt(2 * lrcsi_max(0, outward - tau)) / s->half / LRCSI_OUTWARD_NANO;
    lrcsi_slice low = slice;
    slice_cut_azimuth(s, 1, -c, err, &low); /* v <= -c */
    slice_cut_azimuth(s, -1, -c, err, &slice);
    return lrcsi_min(1, lrcsi_slice_fraction(&low, whole, longest) +
                            lrcsi_slice_fraction(&slice, whole, longest));
}

/* Finds the fractions near an event edge:
   1. none if it is an edge of the facet's own part, of which the laser sees no inside;
   2. none but what a proof leaves open if its part is behind the facet's;
   3. what of the facet lies in the rectangle about the edge, unless the edge is behind it, and its
      part not in front;
   4. of that, where the part is in front of the facet, what is within the depths of the region
      between the outlines;
   5. all of that as gain and loss where the part lies on both sides of the edge; else what is on
      the inner side as gain, on the outer side as loss;
   6. but no more than the areas of the region, and of exact parts
   7. only where points of a straight wall are displaced in the direction of gain, or of loss.
   Returns 0 if there are none. */
int lrcsi_event_band_make(lrcsi_event_bands *bands, const lrcsi_band_facet *at, uint32_t event,
                          int correspondence, lrcsi_event_band *f)
{
    const uint32_t facet = at->facet;
    const lrcs_prepared *p = bands->view->prepared;
    int is_own = bands->events.part[event] == facet_part(bands, facet);
    int side = is_own ? 0 : bands->events.side[event];
    *f = (lrcsi_event_band){.unproved = 0};
    if (is_own && !at->inside) {
        return 0; /* 1 */
    }
    double slack = event_slack(bands, facet, event, correspondence, at->lateral);
    double err = 0;
    if (!(slack > 0)) {
        return 0;
    }
    if (!is_own && lrcsi_part_is_behind(&bands->orders, facet, bands->events.part[event],
                                        &f->unproved)) { /* 2 */
        return f->unproved > 0;
    }
    int in_front = !is_own && lrcsi_part_is_in_front(&bands->orders, facet,
                                                     bands->events.part[event], &err, &f->unproved);
    slack += err;
    lrcsi_edge_rectangle box =
        event_rectangle(bands, at, event, correspondence, slack, err); /* 3 */
    lrcsi_slice slice = lrcsi_edge_rectangle_slice(bands->view, facet, &box);
    if (slice.count == 0 ||
        (!is_own && !in_front &&
         event_is_behind(bands, facet, event, correspondence == LRCSI_ALIGNED))) {
        return 0;
    }
    const uint32_t *vertex = p->scene->facet[facet].corner;
    const double *const corner[3] = {bands->view->point[vertex[0]].x,
                                     bands->view->point[vertex[1]].x,
                                     bands->view->point[vertex[2]].x};
    double whole = 0.5 * p->normal[facet].length;
    double longest = lrcsi_proximity_longest(p, facet);
    lrcsi_outline_areas region = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
    if (in_front && side != 0) { /* 4 */
        const double delta = (correspondence == LRCSI_ALIGNED ? 0 : at->lateral) + err;
        region = outline_region(bands, event, delta);
        slice = lrcsi_edge_rectangle_limit(slice, &box, side, region.gain_depth);
        slice = lrcsi_edge_rectangle_limit(slice, &box, -side, region.loss_depth);
        if (slice.count == 0) {
            return f->unproved > 0;
        }
    } else {
        f->unproved = 0;
    }
    f->rows = lrcsi_proximity_rows(p, facet, corner, &slice); /* 5 */
    f->area = f->gain = f->loss = lrcsi_slice_fraction(&slice, whole, longest);
    if (side == 0) {
        return 1;
    }
    lrcsi_slice outer = lrcsi_edge_rectangle_limit(slice, &box, side, 0);
    lrcsi_slice inner = lrcsi_edge_rectangle_limit(slice, &box, -side, 0);
    if (isfinite(region.gain_depth) || gain_is_inside(bands, at, bands->events.part[event])) {
        f->gain = lrcsi_slice_fraction(&inner, whole, longest);
    }
    f->loss = lrcsi_slice_fraction(&outer, whole, longest);
    if (correspondence == LRCSI_MAPPED && p->proximity.hausdorff[bands->events.part[event]] == 0) {
        signed_region sign; /* 7 */
        if (signed_region_make(at, &box, &inner, side, 1, &sign)) {
            f->gain =
                lrcsi_min(f->gain, signed_fraction(at, &box, &sign, inner, side, whole, longest));
        }
        if (signed_region_make(at, &box, &outer, side, -1, &sign)) {
            f->loss =
                lrcsi_min(f->loss, signed_fraction(at, &box, &sign, outer, -side, whole, longest));
        }
        f->area = lrcsi_min(f->area, f->gain + f->loss);
    }
    if (isfinite(region.gain)) { /* 6 */
        const double gain = fraction_of(bands->view, facet, region.gain);
        const double loss = fraction_of(bands->view, facet, region.loss);
        f->area = lrcsi_min(f->area, gain + loss);
        f->gain = lrcsi_min(f->gain, gain);
        f->loss = lrcsi_min(f->loss, loss);
    }
    return 1;
}

/* The rectangle in which a side is not free because of an event edge. Returns 0 if the edge does
   not matter. */
static int side_rectangle(lrcsi_event_bands *bands, const lrcsi_band_facet *at, uint32_t event,
                          lrcsi_edge_rectangle *box)
{
    const uint32_t facet = at->facet;
    const lrcs_prepared *p = bands->view->prepared;
    const lrcsi_edge *edge = &p->topology.edge[bands->events.edge[event]];
    const uint32_t own = facet_part(bands, facet);
    const uint32_t part = bands->events.part[event];
    double slack = lrcsi_proximity_slack_aligned(p, part);
    double unproved;
    if (part == own) {
        if (!at->inside || !rim_may_face(bands, event)) {
            return 0;
        }
        slack = p->proximity.hausdorff[own] + LRCSI_PROXIMITY_ERR;
    } else if (lrcsi_part_is_behind(&bands->orders, facet, part, &unproved) ||
               event_is_behind(bands, facet, event, 1)) {
        return 0;
    }
    *box = lrcsi_edge_rectangle_make(bands->view, facet, edge, slack + 2 * p->proximity.reach[own]);
    return 1;
}

/* Extends the part of a facet's side from corner k by what of it is in a rectangle. */
static void side_extend(const lrcsi_view *view, uint32_t facet, int k,
                        const lrcsi_edge_rectangle *box, lrcsi_segment_part *near)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const lrcsi_segment_part part = lrcsi_edge_rectangle_part(box, view->point[corner[k]].x,
                                                              view->point[corner[(k + 1) % 3]].x);
    if (!lrcsi_segment_part_is_empty(part)) {
        near->from = lrcsi_min(near->from, part.from);
        near->to = lrcsi_max(near->to, part.to);
    }
}

void lrcsi_event_sides(lrcsi_event_bands *bands, const lrcsi_band_facet *at, uint32_t event,
                       lrcsi_near_sides *near)
{
    lrcsi_edge_rectangle box;
    for (int k = 0; k < 3 && side_rectangle(bands, at, event, &box); k++) {
        side_extend(bands->view, at->facet, k, &box, &near->side[k]);
    }
}

/* Extends the parts of the sides on rims of the facet's part by what of them is in a rectangle. */
static void rims_extend(const lrcsi_event_bands *bands, uint32_t part, const uint32_t *listed,
                        uint32_t count, const lrcsi_edge_rectangle *box, lrcsi_segment_part *near)
{
    const lrcsi_topology *topology = &bands->view->prepared->topology;
    for (uint32_t i = 0; i < count; i++) {
        if (bands->events.part[listed[i]] != part || !rim_may_face(bands, listed[i])) {
            continue;
        }
        const uint32_t edge = bands->events.edge[listed[i]];
        const uint32_t facet = lrcsi_edge_facets_of(bands->view, edge, part).facet[0];
        for (int k = 0; k < 3; k++) {
            if (topology->facet_edge[facet].corner[k] == edge) {
                side_extend(bands->view, facet, k, box, &near[facet]);
            }
        }
    }
}

void lrcsi_event_rims(lrcsi_event_bands *bands, const lrcsi_band_facet *at, const uint32_t *listed,
                      uint32_t count, lrcsi_segment_part *near)
{
    const uint32_t own = facet_part(bands, at->facet);
    lrcsi_edge_rectangle box;
    int rims = 0;
    for (uint32_t i = 0; i < count && at->inside; i++) {
        rims += bands->events.part[listed[i]] == own;
    }
    for (uint32_t i = 0; i < count && rims > 0; i++) {
        if (bands->events.part[listed[i]] != own && side_rectangle(bands, at, listed[i], &box)) {
            rims_extend(bands, own, listed, count, &box, near);
        }
    }
}

/* The boxes of the facets of parts. They are not enlarged by the parts' reach: the boxes
   that they are compared with are enlarged (lrcsi_edge_search_make). */
static void make_part_boxes(const lrcsi_view *view, lrcsi_box *box)
{
    const lrcs_prepared *p = view->prepared;
    for (uint32_t i = 0; i < p->scene->part_count; i++) {
        box[i] = lrcsi_box_empty();
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        uint32_t part = p->scene->facet_part[f];
        if (!p->skip[f]) {
            double low[3];
            double high[3];
            lrcsi_view_bounds(view, p->scene->facet[f].corner, 3, low, high);
            lrcsi_box_add(&box[part], low);
            lrcsi_box_add(&box[part], high);
        }
    }
}

size_t lrcsi_event_bands_need(const lrcs_prepared *p)
{
    size_t edges = lrcsi_proximity_events_most(p);
    size_t need = lrcsi_work_bytes(p->scene->part_count, sizeof(lrcsi_box));
    need = lrcsi_work_add(need, lrcsi_part_orders_need(p));
    need = lrcsi_work_add(need, lrcsi_proximity_events_need(edges));
    return lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(lrcsi_outline_areas)));
}

/* It makes 1. the boxes of parts; 2. their outlines and convex bodies; 3. their event edges, in a
   grid; 4. the areas between outlines along them. */
int lrcsi_event_bands_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                           lrcsi_event_bands *bands)
{
    const uint32_t parts = view->prepared->scene->part_count;
    *bands = (lrcsi_event_bands){.view = view, .meter = meter};
    bands->box = lrcsi_work_take(work, parts, sizeof *bands->box);
    if (!bands->box) {
        return LRCS_E_MEMORY;
    }
    make_part_boxes(view, bands->box);
    int status = lrcsi_part_orders_make(view, work, &bands->orders);
    status = status == LRCS_OK ? lrcsi_proximity_events_make(view, work, &bands->events) : status;
    if (status != LRCS_OK) {
        return status;
    }
    bands->areas = lrcsi_work_take(work, bands->events.count, sizeof *bands->areas);
    for (uint32_t i = 0; i < bands->events.count && bands->areas; i++) {
        bands->areas[i] = event_areas(bands, i);
    }
    return bands->areas ? LRCS_OK : LRCS_E_MEMORY;
}
