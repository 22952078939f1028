/* SPDX-License-Identifier: MIT */
/* Decides which event edges have margins over one straight wall alone, and adds the areas of these
   to the facets that they meet. What that adds to sigma
   is decided in integrate/wall/tessellation.c. Terms and conditions are those of
   visibility/proximity/proximity_band.c; K, K' and k those of visibility/proximity/outline.h; w, N,
   (c) and (d) those of visibility/proximity/face_margin.c.

   P is a closed part with a straight wall: a cylinder, cone or frustum. Q is another part with an
   outline. An
   event edge of Q that belongs to a contour has the ends a and b, L apart in projection. The points
   x of the true wall and y of the facets that the map relates are in projection at most delta
   apart; k is increased to the reach of P if it is smaller, so that delta <= k. The margin of the
   edge is known on the wall if
   (a) the facets of P that face the laser and that N meets are all on the wall, and contain N in
       projection;
   (b) a plane separates Q, in front, from P, or at least from the points of P above N;
   (c) no event edge of a part other than Q comes within its slack of N in projection, unless its
       part is behind P; for P itself the slack is two reaches;
   (d) of Q, only such other event edges meet N as follow the edge, as in face_margin.c;
   (e) at these facets, (1) holds for no part that is neither in front of P nor behind it; the
       fractions of facets for which rounding leaves this or (b)
       open (part_order.c) count as gained and lost;
   (f) of one point of N beyond the edge, seen from the facets of Q, it is known whether the facet
       of the wall there is visible.
   (a) holds if N meets no other facet across the sides of those facets: N is convex, and a straight
   line from a point of it that such a facet contains to one that none contains would cross a side
   beyond which there is none.

   The conditions may hold for parts of an edge only: those between the gaps near which one of them
   does not. As in face_margin.c such a part counts as an edge, which the rest of the edge follows
   without a turn. Of the longest one the margin is used; a facet that is near another part of the
   edge keeps all of its band about the edge, in addition to what the margin attributes to it.

   If the point of (f) is visible, then, as in face_margin.c, the facets hide y in N if and only if
   its projection lies in K', and the true shapes hide x if and only if its projection lies in K:
   by (b) whether Q hides either depends on projections alone, and by (c) and (e) no other part
   hides anything there; P is convex, and hides none of its front. If the point is hidden, it is
   hidden by a part other than Q, and so is all of N, in truth and for the facets.

   If it is visible, what the true shapes leave visible of the wall exceeds what the facets leave by
   the points y in K' and not in K, less those in K and not in K'; and by those that are in K where
   x is not, less the reverse. The first are a margin along the edge, of which t0 <= t <= t1 is
   attributed to the facet that contains that part of the edge: its signed area follows from
   visibility/proximity/outline.c, 3. The second follow from the displacement of points. Beyond the
   ends of the edge, points are attributed as in face_margin.c, D being larger by sqrt(2) delta.

   Displacement. Let s be the depth of a point over t, and D_s and D_t the components of x - y along
   depth and along the edge, at most delta in size. They are continuous over the wall, since points
   of the ruling between two sectors are displaced radially; let each change by at most q times the
   distance of two points in projection, q <= 1/2 (wall_displacement.c). Over t, x is in K if and
   only if s + D_s(t, s) >= d(t + D_t(t, s)). Let D be the largest |d|, also for 2 k before and
   behind the edge, and e(t) the largest difference of d(t) and d within delta of t. Then x and y
   agree, unless s is between d(t) and d(t) - D_s(t, 0), but for (q (D + delta) + e(t)) / (1 - q) on
   either side of the latter. So the true shapes leave visible the integral of -D_s(t, 0) more, the
   component away from the facets of Q, but for an error. As K is convex, so is d: from -2 k to
   L + 2 k its variation is at most 4 D, and the integral of e(t) at most 8 delta D; over a part of
   the edge it is at most the length of that times delta times the slope of d, which is at most 2 D
   divided by the distance of that part, enlarged by delta, from -2 k and L + 2 k.
   Without q, or with a larger one, all that is known is that y is within sqrt(2) delta of the
   boundary of K in depth.

   A part of the margins, t0 <= t <= t1, may lie on other facets than the one to which it is
   attributed. It is found how many sectors away these are, because F of their patches may differ
   from its own by more, the farther they are; on one ruling F is the same. On another
   facet the same area in projection stands for cos / cos' times as much of the wall as on its own:
   where the margin may be on it, F sup |cos / cos' - 1| is an error, twice if F differs as well. */
#include "visibility/proximity/wall_margin.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/shape/tessellate.h"
#include "scene/neighbours.h"
#include "visibility/proximity/wall_displacement.h"
#include "visibility/uniform/query.h"

/* An edge whose margin meets more facets is not used: heuristic. */
#define MARGIN_FACETS_MAX (UINT32_C(1) << 17)
/* Nor one that may be near a facet with more pairs than this: a large facet that others intersect
   may have as many as these have facets. */
#define MARGIN_PAIRS_MAX 64u
/* Nor one whose margin may be on facets that are so much more oblique than those to which it is
   attributed. */
#define COS_RATIO_ERR_MAX 1.0
/* Nor one whose margin may be more sectors away: heuristic. */
#define MARGIN_SECTORS_MAX 32u
/* The largest q. */
#define DISPLACEMENT_SLOPE_MAX 0.5

/* What is left of the list of a facet's pairs: all; those that matter; those, but too many. */
enum { PAIRS_ALL, PAIRS_REDUCED, PAIRS_MANY };

struct lrcsi_margin_facet {
    uint32_t facet;
    int usable; /* 0: the other fields are not set */
    lrcsi_wall_patch patch;
    double lateral;  /* delta of the facet */
    double farthest; /* the largest delta of it and of the facets on which its part of the margins
                        may be */
    double near[2];  /* t of the facet's points near the edge, in projection */
    lrcsi_segment_part in, outer; /* the part of the edge in the facet; the same, enlarged by
                                     errors */
    double length_err;            /* the fraction of the edge that may belong to it or not */
    double cos_ratio_err;         /* bound on |cos / cos' - 1|, where its part of the margin may be
                                     on another facet: cos of its own incidence angle, cos' of that
                                     facet's */
    double neighbour_err;         /* a bound on the sum of this over such facets, times the length
                                     along the edge where the margin may be on them */
    uint32_t sectors;             /* how far these are from it */
};

static uint32_t margin_facets_most(const lrcs_prepared *p)
{
    return p->scene->facet_count < MARGIN_FACETS_MAX ? p->scene->facet_count : MARGIN_FACETS_MAX;
}

/* --- facets of a wall ------------------------------------------------------------------------- */

/* Notes the fraction of a facet for which its order with another part is not proved. */
static void unproved_add(lrcsi_wall_margins *job, uint32_t facet, uint32_t part, double unproved)
{
    if (unproved > 0 && lrcsi_part_set_add(&job->unproved[facet].parts, part)) {
        job->unproved[facet].fraction += unproved;
    }
}

/* Removes the pairs of a facet with parts that are in front of its own or behind it: of such parts
   (1) does not matter, but for the fractions that are left open. Returns 0 if the limit of steps is
   reached. */
static int pairs_reduce(lrcsi_wall_margins *job, uint32_t facet)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    uint32_t last = LRCS_NONE; /* the part of the pair before */
    uint32_t left = 0;
    int separated = 0;
    for (uint32_t *at = &job->first_pair[facet]; *at != LRCS_NONE;) {
        const uint32_t part = p->scene->facet_part[p->proximity.pair[*at].other];
        if (!lrcsi_meter_take(bands->meter, 1)) {
            return 0;
        }
        if (part != last) {
            double unproved = 0;
            separated = lrcsi_part_is_separated_in_front(&bands->orders, facet, part, &unproved) ||
                        lrcsi_part_is_behind(&bands->orders, facet, part, &unproved);
            unproved_add(job, facet, part, separated ? unproved : 0);
            last = part;
        }
        if (separated) {
            *at = job->next_pair[*at];
        } else {
            at = &job->next_pair[*at];
            left++;
        }
    }
    job->pairs[facet] = left > MARGIN_PAIRS_MAX ? PAIRS_MANY : PAIRS_REDUCED;
    return 1;
}

/* The part of an edge of which points are within `distance` of some of a slice, along the edge. */
static lrcsi_segment_part part_near(const lrcsi_edge_margin *m, const lrcsi_edge_rectangle *box,
                                    const lrcsi_slice *slice, double distance)
{
    lrcsi_segment_part part = {HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < slice->count; i++) {
        const double t =
            m->along[0] * (slice->x[i][0] - m->a[0]) + m->along[1] * (slice->x[i][1] - m->a[1]);
        part.from = lrcsi_min(part.from, (t - box->err - distance) / m->length);
        part.to = lrcsi_max(part.to, (t + box->err + distance) / m->length);
    }
    return slice->count > 0 && !box->has_sides ? (lrcsi_segment_part){0, 1} : part;
}

static const lrcsi_segment_part everywhere = {0, 1};

/* What of a slice of a facet, in the view, is within `slack` of the plane of another facet. */
static lrcsi_slice slice_near_plane(const lrcsi_view *view, const lrcsi_slice *slice,
                                    uint32_t other, double slack)
{
    const lrcs_prepared *p = view->prepared;
    const double *corner = view->point[p->scene->facet[other].corner[0]].x;
    const double wide = slack + 4 * lrcsi_edge_rectangle_facet_err(view, other);
    lrcsi_slice near = *slice;
    double n[3];
    for (int k = 0; k < 3; k++) {
        n[k] = lrcsi_vec3_dot(view->R[k], p->normal[other].high) / p->normal[other].length;
    }
    lrcsi_slice_cut_between(&near, n, corner, corner, wide);
    return near;
}

/* Adds the parts of an edge near which (1) is not excluded for the points of a facet in N: of those
   near the plane of a facet of another part. Where the other facet is within the slack of such a
   point, it is, in projection, within the slack of N. */
static void pairs_add_gaps(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet,
                           lrcsi_edge_gaps *gaps)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const uint32_t own = p->scene->facet_part[facet];
    if ((job->pairs[facet] == PAIRS_ALL && !pairs_reduce(job, facet)) ||
        job->pairs[facet] == PAIRS_MANY) {
        lrcsi_edge_gaps_add(gaps, everywhere);
        return;
    }
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(bands->view, facet, m->edge, m->width);
    const lrcsi_slice slice = lrcsi_edge_rectangle_slice(bands->view, facet, &box);
    for (uint32_t i = job->first_pair[facet]; i != LRCS_NONE; i = job->next_pair[i]) {
        const uint32_t other = p->proximity.pair[i].other;
        const double slack = lrcsi_proximity_slack(p, own, p->scene->facet_part[other]);
        const double wide = m->width + m->err + slack;
        const lrcsi_edge_rectangle other_box =
            lrcsi_edge_rectangle_make(bands->view, other, m->edge, wide);
        const lrcsi_slice other_slice = lrcsi_edge_rectangle_slice(bands->view, other, &other_box);
        const lrcsi_slice near = slice_near_plane(bands->view, &slice, other, slack);
        const lrcsi_segment_part at = part_near(m, &box, &near, m->width);
        lrcsi_segment_part gap = part_near(m, &other_box, &other_slice, wide);
        gap.from = lrcsi_max(gap.from, at.from);
        gap.to = lrcsi_min(gap.to, at.to);
        lrcsi_edge_gaps_add(gaps, lrcsi_meter_take(bands->meter, 1) ? gap : everywhere);
    }
}

/* The position of a facet on a straight wall. Returns 0 if it is not on one. */
static int facet_position(const lrcs_prepared *p, uint32_t facet, lrcsi_wall_patch *at)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    return part->rigid && part->bounds.reach > 0 && part->solid &&
           !lrcsi_proximity_on_round_wall(p, facet) &&
           lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet, at);
}

/* May a facet have margins? It is on a straight wall, and not seen edge-on to within rounding. */
static int facet_applies(const lrcsi_wall_margins *job, uint32_t facet)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    lrcsi_wall_patch at;
    return !p->skip[facet] && view->facing[facet] > 0 && lrcsi_view_casts(view, facet) &&
           lrcsi_view_incidence(view, facet).cos_theta >
               p->proximity.grazing_cos[p->scene->facet_part[facet]] + LRCSI_VIEW_COS_ERR &&
           facet_position(p, facet, &at);
}

/* delta of a facet. */
static double facet_lateral(const lrcsi_wall_margins *job, uint32_t facet)
{
    const lrcsi_view *view = job->bands->view;
    const lrcsi_displacement displacement = lrcsi_proximity_displacement(view->prepared, facet);
    return lrcsi_displacement_across(&displacement, view->unit);
}

/* How many sectors are two of them apart, if `around` go around the wall? */
static uint32_t sectors_apart(const lrcsi_wall_patch *a, const lrcsi_wall_patch *b, uint32_t around)
{
    const uint32_t apart = a->sector > b->sector ? a->sector - b->sector : b->sector - a->sector;
    return apart < around - apart ? apart : around - apart;
}

/* --- the facets that a margin meets ----------------------------------------------------------- */

/* Finds the part of the edge in a facet, between the lines of its sides. A side is no farther from
   its line than its ends are from their computed positions. */
static void margin_facet_cut(const lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                             lrcsi_margin_facet *one)
{
    const lrcsi_view *view = job->bands->view;
    const uint32_t *corner = view->prepared->scene->facet[one->facet].corner;
    const double err = m->err + lrcsi_edge_rectangle_facet_err(view, one->facet);
    lrcsi_segment_part inner = {0, 1};
    one->in = one->outer = inner;
    for (int k = 0; k < 3; k++) {
        const double *p = view->point[corner[k]].x;
        const double *q = view->point[corner[(k + 1) % 3]].x;
        const double side[2] = {q[0] - p[0], q[1] - p[1]};
        const double length = sqrt(side[0] * side[0] + side[1] * side[1]);
        double height[2]; /* of a and b, outside the side */
        for (int i = 0; i < 2; i++) {
            const double *x = i == 0 ? m->a : m->b;
            const double cross = side[0] * (x[1] - p[1]) - side[1] * (x[0] - p[0]);
            height[i] = length > 0 ? -cross / length : HUGE_VAL;
        }
        lrcsi_segment_part_limit(&one->in, height[0], height[1], 0);
        lrcsi_segment_part_limit(&inner, height[0], height[1], -err);
        lrcsi_segment_part_limit(&one->outer, height[0], height[1], err);
    }
    one->length_err =
        lrcsi_max(0, one->outer.to - one->outer.from) - lrcsi_max(0, inner.to - inner.from);
}

/* The distance in projection from the edge within which points may be visible for the true shapes
   and not for the facets, or the reverse. */
static double margin_facet_slack(const lrcsi_edge_margin *m, double lateral)
{
    return m->outline->k + LRCSI_ROOT_2_OUTWARD * lateral + m->err;
}

/* The planes for (b) are parallel to the edge. Across it, the first one is parallel to the view
   plane; the others fall away from the laser behind the edge, by the inverse of these slopes: where
   P begins at Q, or near it, only a plane along the side of Q that faces away leaves P behind Q. */
static const double plane_slopes[LRCSI_WALL_PLANES] = {0, 1, 8, 64, 512, 4096};

/* Makes such a plane, as high, along the direction to the laser, as it can be with all of Q on or
   above it. */
static lrcsi_wall_plane plane_below(const lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                                    double across)
{
    const lrcsi_view *view = job->bands->view;
    const lrcsi_body *body = job->bands->orders.body;
    lrcsi_wall_plane plane;
    const double slope = (m->b[2] - m->a[2]) / m->length;
    const double norm = sqrt(1 + slope * slope);
    const double size = sqrt(1 + across * across);
    const double *corner = view->prepared->vertex[m->edge->low].x;
    double down[3];
    plane.up[0] = (-slope * m->along[0] / norm - across * m->outward[0]) / size;
    plane.up[1] = (-slope * m->along[1] / norm - across * m->outward[1]) / size;
    plane.up[2] = 1 / (norm * size);
    for (int k = 0; k < 3; k++) {
        down[k] = -(plane.up[0] * view->R[0][k] + plane.up[1] * view->R[1][k] +
                    plane.up[2] * view->R[2][k]);
    }
    /* heights above the edge's end, the same in the view and in the scene */
    plane.level = lrcsi_vec3_dot(plane.up, m->a) - lrcsi_body_support_all(&body[m->part], down) +
                  lrcsi_vec3_dot(down, corner);
    plane.err = body[m->part].err + 4 * m->err + 64 * LRCSI_PROXIMITY_ERR;
    return plane;
}

/* Planes that lie so nearly along the direction to the laser that rounding may decide on which side
   of them that is are not used: their `up` has a component of this size along it, or less. */
#define PLANE_UP_MIN 0x1p-40

/* Is a slice of a facet, and the true wall there, below one of the planes? */
static int slice_is_below(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet,
                          const lrcsi_slice *slice)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    const double reach = p->proximity.reach[p->scene->facet_part[facet]];
    const double facet_err = lrcsi_edge_rectangle_facet_err(view, facet);
    int below = 0;
    for (int k = 0; k < LRCSI_WALL_PLANES && job->bands->orders.body && !below; k++) {
        const lrcsi_wall_plane *plane = &job->plane[k];
        if (k == job->plane_count) {
            job->plane[job->plane_count++] = plane_below(job, m, plane_slopes[k]);
        }
        const double slack = plane->err + reach + 4 * facet_err;
        below = plane->up[2] > PLANE_UP_MIN;
        for (int i = 0; i < slice->count; i++) {
            below = below && lrcsi_vec3_dot(plane->up, slice->x[i]) < plane->level - slack;
        }
    }
    return below;
}

/* What of the edge is so near to a facet, of which delta is given, that visibility there may differ
   between true shapes and facets. */
static lrcsi_segment_part margin_facet_near(const lrcsi_wall_margins *job,
                                            const lrcsi_edge_margin *m, uint32_t facet,
                                            double lateral)
{
    const lrcsi_view *view = job->bands->view;
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(view, facet, m->edge, margin_facet_slack(m, lateral));
    const lrcsi_slice slice = lrcsi_edge_rectangle_slice(view, facet, &box);
    return part_near(m, &box, &slice, 0);
}

/* Makes the data of a facet that N meets, or adds a gap if its part of the wall cannot be used. */
static void margin_facet_make(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet,
                              lrcsi_margin_facet *one, lrcsi_edge_gaps *gaps)
{
    const lrcsi_view *view = job->bands->view;
    double unproved = 0;
    *one = (lrcsi_margin_facet){.facet = facet};
    const int applies = facet_applies(job, facet);
    const int separated =
        applies && lrcsi_part_is_separated_in_front(&job->bands->orders, facet, m->part, &unproved);
    if (!separated) {
        const lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(view, facet, m->edge, m->width);
        const lrcsi_slice slice = lrcsi_edge_rectangle_slice(view, facet, &box);
        if (!applies || !slice_is_below(job, m, facet, &slice)) {
            lrcsi_edge_gaps_add(gaps, part_near(m, &box, &slice, m->width));
            return;
        }
    }
    pairs_add_gaps(job, m, facet, gaps);
    unproved_add(job, facet, m->part, separated ? unproved : 0);
    one->usable = 1;
    one->lateral = one->farthest = facet_lateral(job, facet);
    const lrcsi_segment_part near = margin_facet_near(job, m, facet, one->lateral);
    one->near[0] = near.from * m->length;
    one->near[1] = near.to * m->length;
    facet_position(view->prepared, facet, &one->patch);
    margin_facet_cut(job, m, one);
}

/* Continues the search across the sides of a facet that N meets, to the facets beyond them that
   face the laser. Adds a gap where there is none. */
static void margin_facets_spread(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                                 uint32_t facet, lrcsi_edge_gaps *gaps)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    const uint32_t *corner = p->scene->facet[facet].corner;
    const lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(view, facet, m->edge, m->width);
    for (int k = 0; k < 3; k++) {
        const uint32_t other = lrcsi_neighbour_in_part(p, facet, k);
        const double *from = view->point[corner[k]].x;
        const double *to = view->point[corner[(k + 1) % 3]].x;
        const lrcsi_segment_part side = lrcsi_edge_rectangle_part(&box, from, to);
        if (lrcsi_segment_part_is_empty(side) ||
            (other != LRCS_NONE && lrcsi_marked(&job->reached, other))) {
            continue;
        }
        if (other == LRCS_NONE || view->facing[other] <= 0) {
            lrcsi_slice line = {.count = 2};
            for (int i = 0; i < 2; i++) {
                line.x[0][i] = from[i] + side.from * (to[i] - from[i]);
                line.x[1][i] = from[i] + side.to * (to[i] - from[i]);
            }
            lrcsi_edge_gaps_add(gaps, part_near(m, &box, &line, m->width));
            continue;
        }
        job->reached.entry[other] = job->reached.number;
        if (job->facet_count == margin_facets_most(p)) {
            lrcsi_edge_gaps_add(gaps, everywhere);
        } else {
            job->facet[job->facet_count++].facet = other;
        }
    }
}

/* Finds all facets of P that N meets, from one of them on, and adds the parts of the edge for which
   (a), (b) or (e) does not hold. */
static void margin_facets_find(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet,
                               lrcsi_edge_gaps *gaps)
{
    lrcsi_marks_clear(&job->reached, job->bands->view->prepared->scene->facet_count);
    job->reached.entry[facet] = job->reached.number;
    job->facet[0].facet = facet;
    job->facet_count = 1;
    for (uint32_t i = 0; i < job->facet_count && !lrcsi_edge_gaps_are_all(gaps); i++) {
        if (!lrcsi_meter_take(job->bands->meter, 4)) {
            lrcsi_edge_gaps_add(gaps, everywhere);
        }
        const uint32_t f = job->facet[i].facet;
        margin_facet_make(job, m, f, &job->facet[i], gaps);
        margin_facets_spread(job, m, f, gaps);
    }
}

/* A number that grows with the position t on the edge, and is the same beyond its ends. */
static uint32_t margin_key(const lrcsi_edge_margin *m, double t)
{
    const double fraction = lrcsi_min(1, lrcsi_max(0, t / m->length));
    return (uint32_t)(fraction * 0x1p31);
}

/* Sorts the usable facets by where they begin to be near the edge. Returns their number. */
static uint32_t margin_facets_sort(lrcsi_wall_margins *job, const lrcsi_edge_margin *m)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < job->facet_count; i++) {
        const lrcsi_margin_facet *one = &job->facet[i];
        if (one->usable && one->near[0] <= one->near[1]) {
            job->order[count++] = (lrcsi_sort_item){margin_key(m, one->near[0]), i};
        }
    }
    lrcsi_sort_items(job->order, count);
    double most = -HUGE_VAL;
    for (uint32_t i = 0; i < count; i++) {
        most = lrcsi_max(most, job->facet[job->order[i].value].near[1]);
        job->end_max[i] = most;
    }
    return count;
}

/* How many of the sorted facets may begin to be near the edge at t or before? */
static uint32_t margin_facets_before(const lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                                     uint32_t count, double t)
{
    const uint32_t key = margin_key(m, t);
    uint32_t low = 0;
    for (uint32_t high = count; low < high;) {
        const uint32_t middle = low + (high - low) / 2;
        if (job->order[middle].key <= key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Finds on which other facets the margin that is attributed to a facet may lie: how far away these
   are, and how much more of their area a part of the view plane stands for. Adds a gap where that
   is too much. */
static void margin_facets_compare(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                                  lrcsi_edge_gaps *gaps)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t part = scene->facet_part[job->facet[0].facet];
    const uint32_t around = scene->part[part].divisions.around;
    const uint32_t count = margin_facets_sort(job, m);
    for (uint32_t i = 0; i < job->facet_count; i++) {
        lrcsi_margin_facet *one = &job->facet[i];
        if (!one->usable || lrcsi_segment_part_is_empty(one->outer)) {
            continue;
        }
        const double own = lrcsi_view_incidence(view, one->facet).cos_theta;
        const double from = one->outer.from * m->length - m->err;
        const double to = one->outer.to * m->length + m->err;
        uint32_t at = margin_facets_before(job, m, count, to);
        while (at > 0 && job->end_max[at - 1] >= from) {
            const lrcsi_margin_facet *other = &job->facet[job->order[--at].value];
            const double length = lrcsi_min(to, other->near[1]) - lrcsi_max(from, other->near[0]);
            if (other == one || !(length >= 0)) {
                continue;
            }
            if (!lrcsi_meter_take(job->bands->meter, 1)) {
                lrcsi_edge_gaps_add(gaps, everywhere);
                return;
            }
            const double cosine = lrcsi_view_incidence(view, other->facet).cos_theta;
            const double cos_ratio_err =
                fabs(own / cosine - 1) + 4 * LRCSI_VIEW_COS_ERR / lrcsi_min(own, cosine);
            const uint32_t apart = sectors_apart(&one->patch, &other->patch, around);
            one->sectors = apart > one->sectors ? apart : one->sectors;
            one->farthest = lrcsi_max(one->farthest, other->lateral);
            one->cos_ratio_err = lrcsi_max(one->cos_ratio_err, cos_ratio_err);
            one->neighbour_err += cos_ratio_err * length;
        }
        one->neighbour_err = lrcsi_min(one->neighbour_err, one->cos_ratio_err * (to - from));
        if (one->sectors > MARGIN_SECTORS_MAX || !(one->cos_ratio_err < COS_RATIO_ERR_MAX)) {
            lrcsi_edge_gaps_add(gaps, one->outer);
        }
    }
}

/* --- is the wall visible beside the edge? ----------------------------------------------------- */

/* The intersection of two parts. */
static lrcsi_segment_part part_common(lrcsi_segment_part one, lrcsi_segment_part two)
{
    return (lrcsi_segment_part){lrcsi_max(one.from, two.from), lrcsi_min(one.to, two.to)};
}

/* The length of the longest part of the edge in a facet and within `of`, as a fraction; in *middle
   the middle of that. */
static double longest_in_facet(const lrcsi_wall_margins *job, lrcsi_segment_part of, double *middle)
{
    double longest = 0;
    for (uint32_t i = 0; i < job->facet_count; i++) {
        const lrcsi_segment_part in = part_common(job->facet[i].in, of);
        if (job->facet[i].usable && in.to - in.from > longest) {
            longest = in.to - in.from;
            *middle = 0.5 * (in.from + in.to);
        }
    }
    return longest;
}

/* (f): an answer of visibility/uniform/query.h for the point half of w beyond the edge at the
   fraction t of its length. */
static int wall_visibility(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, double t)
{
    const lrcsi_view *view = job->bands->view;
    const lrcsi_classification *c = job->classification;
    double x[2];
    for (int i = 0; i < 2; i++) {
        x[i] = m->a[i] + t * (m->b[i] - m->a[i]) + 0.5 * m->width * m->outward[i];
    }
    for (uint32_t i = 0; i < job->facet_count && c->facets; i++) {
        double point[3];
        const uint32_t f = job->facet[i].facet;
        if (c->undecided[f] && facet_applies(job, f) && lrcsi_view_point_above(view, f, x, point)) {
            return lrcsi_query_point(c->facets, f, point, job->bands->meter);
        }
    }
    return LRCSI_QUERY_NO_ANSWER;
}

/* --- margins ---------------------------------------------------------------------------------- */

/* The part of the second margins on a facet, along the part of the edge in it, where the outline is
   no deeper than `deepest` (D). If no sign is known, of the strips that displacement adds and
   removes the larger one counts. */
static lrcsi_wall_displacement margin_displacement(const lrcsi_wall_margins *job,
                                                   const lrcsi_edge_margin *m, double deepest,
                                                   const lrcsi_margin_facet *one)
{
    const double lateral = one->farthest;
    const double part = lrcsi_max(0, one->outer.to - one->outer.from) * m->length;
    const double position_err =
        m->err + lrcsi_edge_rectangle_facet_err(job->bands->view, one->facet);
    lrcsi_wall_displacement found = {0, LRCSI_ROOT_2_OUTWARD * lateral * part, 0};
    lrcsi_wall_displacement along;
    double end[2][2];
    for (int i = 0; i < 2; i++) {
        const double ab = m->b[i] - m->a[i];
        end[0][i] = m->a[i] + one->in.from * ab;
        end[1][i] = m->a[i] + lrcsi_max(one->in.from, one->in.to) * ab;
    }
    if (!lrcsi_wall_displacement_make(job->bands, one->facet, end[0], end[1], position_err,
                                      m->outward, &along)) {
        return found;
    }
    const double q = (1 + one->cos_ratio_err) * along.slope;
    const double to_end = lrcsi_max(0, lrcsi_min(one->outer.from, 1 - one->outer.to)) * m->length +
                          2 * m->outline->k - lateral;
    const double variation = lateral * deepest * lrcsi_min(8, 2 * part / to_end);
    along.error += lateral * (one->length_err + m->direction_err) * m->length +
                   (part * q * (deepest + lateral) + variation) / (1 - q);
    return q <= DISPLACEMENT_SLOPE_MAX && along.error < found.error ? along : found;
}

/* Adds the part of the margins on a facet: its area, with the depths of the whole edge. The area is
   known to within: the bounds of outline.c and errors of positions; where the part of the edge in
   it ends; the points at the ends of the edge; what the same area of the view plane stands for on
   other facets; the displacement of points. */
static void margin_facet_add(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                             const lrcsi_outline_margin *margin, const double turn[2],
                             const lrcsi_margin_facet *one)
{
    const double depth = margin->depth;
    const double part = lrcsi_max(0, one->outer.to - one->outer.from) * m->length;
    const double k = m->outline->k + m->err;
    const double strip = LRCSI_ROOT_2_OUTWARD * one->farthest; /* the depth of the second ones */
    double ends = 0;
    if (one->near[0] < 2 * k) {
        ends += lrcsi_edge_margin_end(m, margin->end_depth[0] + strip, turn[0]);
    }
    if (one->near[1] > m->length - 2 * k) {
        ends += lrcsi_edge_margin_end(m, margin->end_depth[1] + strip, turn[1]);
    }
    const double deepest = lrcsi_max3(depth, margin->end_depth[0], margin->end_depth[1]) + m->err;
    const lrcsi_wall_displacement displaced = margin_displacement(job, m, deepest, one);
    lrcsi_wall_margin *to = &job->margin[one->facet];
    to->area += margin->area + displaced.area;
    to->sectors = one->sectors > to->sectors ? one->sectors : to->sectors;
    to->area_err += 4 * LRCSI_U * fabs(to->area); /* of the additions */
    to->area_max += (depth + strip) * part * LRCSI_OUTWARD_NANO;
    const double known =
        margin->error + 2 * m->err * margin->width + depth * one->length_err * m->length + ends;
    to->area_err += ((1 + one->cos_ratio_err) * (known + displaced.error) +
                     2 * (depth + strip) * one->neighbour_err) *
                    LRCSI_OUTWARD_NANO;
}

/* What of a facet belongs to a part of the edge. */
static lrcsi_margin_facet margin_facet_clip(const lrcsi_edge_margin *m, lrcsi_segment_part of,
                                            const lrcsi_margin_facet *whole)
{
    lrcsi_margin_facet one = *whole;
    one.in = part_common(one.in, of);
    one.outer = part_common(one.outer, of);
    if (of.from > 0) {
        one.near[0] = lrcsi_max(one.near[0], of.from * m->length);
    }
    if (of.to < 1) {
        one.near[1] = lrcsi_min(one.near[1], of.to * m->length);
    }
    return one;
}

/* Adds the margins of a free part of an edge, if they are known. */
static int margin_facets_add(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                             const lrcsi_edge_part *free)
{
    const int side = job->bands->events.side[m->event];
    const lrcsi_outline_margin whole =
        lrcsi_outline_margin_make(m->outline, m->a, m->b, side, 0, 1);
    if (!isfinite(whole.error)) {
        return 0;
    }
    for (uint32_t i = 0; i < job->facet_count; i++) {
        const lrcsi_margin_facet one = margin_facet_clip(m, free->of, &job->facet[i]);
        lrcsi_outline_margin margin = whole;
        if (!one.usable || !(one.near[0] <= one.near[1])) {
            continue;
        }
        if (!(one.in.from < one.in.to)) {
            margin.area = margin.error = margin.width = 0;
        } else if (one.in.from > 0 || one.in.to < 1) {
            const lrcsi_outline_margin part =
                lrcsi_outline_margin_make(m->outline, m->a, m->b, side, one.in.from, one.in.to);
            margin.area = part.area;
            margin.error = part.error;
            margin.width = part.width;
        }
        margin_facet_add(job, m, &margin, free->turn, &one);
    }
    return 1;
}

/* Makes the data of an event edge over a wall. Its k is at least delta. */
static int wall_edge_make(lrcsi_wall_margins *job, uint32_t event, uint32_t part,
                          lrcsi_edge_margin *m)
{
    const lrcsi_event_bands *bands = job->bands;
    job->outline = bands->orders.outline[bands->events.part[event]];
    job->outline.k = lrcsi_max(job->outline.k, bands->view->prepared->proximity.reach[part]);
    return lrcsi_edge_margin_make(bands, &job->outline, event, part, 0, m);
}

/* Examines an event edge over the wall of a facet that its N meets. Returns the part of it of which
   the margins are known: the longest free one over the wall. */
static lrcsi_segment_part event_examine(lrcsi_wall_margins *job, uint32_t facet, uint32_t event)
{
    static const lrcsi_segment_part unknown_part = {1, 0};
    lrcsi_event_bands *bands = job->bands;
    const uint32_t part = bands->view->prepared->scene->facet_part[facet];
    const lrcsi_margin_receiver receiver = {part, facet, NULL, 0};
    lrcsi_edge_margin m;
    lrcsi_edge_gaps gaps = {.count = 0};
    lrcsi_edge_part best = {.of = {1, 0}};
    double turn[2];
    double longest = 0;
    double middle = 0;
    if (!wall_edge_make(job, event, part, &m)) {
        return unknown_part;
    }
    job->plane_count = 0;
    margin_facets_find(job, &m, facet, &gaps);
    if (!lrcsi_edge_gaps_are_all(&gaps)) {
        margin_facets_compare(job, &m, &gaps);
    }
    if (!lrcsi_edge_gaps_are_all(&gaps)) {
        lrcsi_edge_margin_find_gaps(bands, &m, &receiver, &gaps, turn);
    }
    for (int i = 0; i <= gaps.count && !lrcsi_edge_gaps_are_all(&gaps); i++) {
        lrcsi_edge_part free;
        double at = 0;
        if (lrcsi_edge_margin_part(&m, &gaps, i, turn, &free) &&
            longest_in_facet(job, free.of, &at) > 0 && free.of.to - free.of.from > longest) {
            longest = free.of.to - free.of.from;
            best = free;
            middle = at;
        }
    }
    if (!(longest > 0)) {
        return unknown_part;
    }
    /* If N is hidden, there is no margin, and what is open stays in the fractions of bands. */
    const int visibility = wall_visibility(job, &m, middle);
    return visibility == LRCSI_QUERY_HIDDEN ||
                   (visibility == LRCSI_QUERY_VISIBLE && margin_facets_add(job, &m, &best))
               ? best.of
               : unknown_part;
}

int lrcsi_wall_margins_add(lrcsi_wall_margins *job, uint32_t facet, uint32_t event)
{
    const uint32_t part = job->bands->view->prepared->scene->facet_part[facet];
    lrcsi_wall_event *at = &job->event[event];
    lrcsi_edge_margin m;
    if ((at->part == part && lrcsi_segment_part_is_empty(at->known)) ||
        !facet_applies(job, facet)) {
        return 0;
    }
    if (at->part != part) {
        *at = (lrcsi_wall_event){part, event_examine(job, facet, event)};
    }
    if ((at->known.from <= 0 && at->known.to >= 1) || lrcsi_segment_part_is_empty(at->known) ||
        !wall_edge_make(job, event, part, &m)) {
        return !lrcsi_segment_part_is_empty(at->known);
    }
    const lrcsi_segment_part near = margin_facet_near(job, &m, facet, facet_lateral(job, facet));
    return (at->known.from <= 0 || near.from >= at->known.from) &&
           (at->known.to >= 1 || near.to <= at->known.to);
}

void lrcsi_wall_margins_finish(const lrcsi_wall_margins *job)
{
    const lrcsi_view *view = job->bands->view;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        lrcsi_wall_margin *margin = &job->margin[f];
        if (margin->area_max + margin->area_err > 0) {
            margin->area_err +=
                2 * job->unproved[f].fraction * lrcsi_view_projected(view, f) * LRCSI_OUTWARD_NANO;
        }
    }
}

size_t lrcsi_wall_margins_need(const lrcs_prepared *p)
{
    const size_t facets = p->scene->facet_count;
    size_t need = lrcsi_work_bytes(lrcsi_proximity_events_most(p), sizeof(lrcsi_wall_event));
    need =
        lrcsi_work_add(need, lrcsi_work_bytes(margin_facets_most(p), sizeof(lrcsi_margin_facet)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(margin_facets_most(p), sizeof(lrcsi_sort_item)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(margin_facets_most(p), sizeof(double)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->proximity.count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_wall_unproved)));
}

int lrcsi_wall_margins_make(lrcsi_event_bands *bands, const lrcsi_classification *classification,
                            lrcs_work *work, lrcsi_wall_margin *margin, lrcsi_wall_margins *job)
{
    const uint32_t facets = bands->view->prepared->scene->facet_count;
    const uint32_t most = margin_facets_most(bands->view->prepared);
    const lrcsi_proximity *proximity = &bands->view->prepared->proximity;
    *job = (lrcsi_wall_margins){.bands = bands, .classification = classification, .margin = margin};
    job->event = lrcsi_work_take(work, bands->events.count, sizeof *job->event);
    job->facet = lrcsi_work_take(work, most, sizeof *job->facet);
    job->order = lrcsi_work_take(work, most, sizeof *job->order);
    job->end_max = lrcsi_work_take(work, most, sizeof *job->end_max);
    job->reached.entry = lrcsi_work_take_zero(work, facets, sizeof *job->reached.entry);
    job->pairs = lrcsi_work_take_zero(work, facets, 1);
    job->unproved = lrcsi_work_take_zero(work, facets, sizeof *job->unproved);
    job->first_pair = lrcsi_work_take(work, facets, sizeof *job->first_pair);
    job->next_pair = lrcsi_work_take(work, proximity->count, sizeof *job->next_pair);
    if (!job->event || !job->facet || !job->order || !job->end_max || !job->reached.entry ||
        !job->pairs || !job->unproved || !job->first_pair || !job->next_pair) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < bands->events.count; i++) {
        job->event[i].part = LRCS_NONE;
    }
    for (uint32_t f = 0; f < facets; f++) {
        margin[f] = (lrcsi_wall_margin){.area = 0};
        job->first_pair[f] = LRCS_NONE;
    }
    for (uint32_t i = 0; i < proximity->count; i++) {
        uint32_t *first = &job->first_pair[proximity->pair[i].facet];
        job->next_pair[i] = *first;
        *first = i;
    }
    return LRCS_OK;
}
