/* SPDX-License-Identifier: MIT */
/* Decides which event edges have margins over one straight wall alone, and adds the areas of these
   to the facets that they meet. What that adds to sigma is decided in
   integrate/wall/tessellation.c. Terms and conditions are those of
   visibility/proximity/proximity_band.c; K, K' and k those of visibility/proximity/outline.h; w, N,
   (c) and (d) those of visibility/proximity/face_margin.c.

   P is a closed part with a straight wall: a cylinder, cone or frustum. Q is another part with an
   outline. An event edge of Q that belongs to a contour has the ends a and b, L apart in
   projection. The points x of the true wall and y of the facets that the map relates are in
   projection at most delta apart; k is increased to the reach of P if it is smaller, so that
   delta <= k. The margin of the edge is known on the wall if
   (a) the facets of P that face the laser and that N meets are all on the wall, and contain N in
       projection;
   (b) a plane separates Q, in front, from P, or at least from the points of P above N;
   (c) no event edge of a part other than Q comes within its slack of N in projection, unless its
       part is behind P; for P itself the slack is two reaches;
   (d) of Q, only such other event edges meet N as follow the edge, as in face_margin.c;
   (e) at these facets, (1) holds for no part that is neither in front of P nor behind it; the
       fractions of facets for which rounding leaves this or (b) open (part_order.c) count as gained
       and lost;
   (f) of one point of N beyond the edge, seen from the facets of Q, it is known whether the facet
       of the wall there is visible.
   (a) holds if N meets no other facet across the sides of those facets: N is convex, and a straight
   line from a point of it that such a facet contains to one that none contains would cross a side
   beyond which there is none.

   The conditions may hold for parts of an edge only: those between the gaps near which one of them
   does not. As in face_margin.c such a part counts as an edge, which the rest of the edge follows
   without a turn. A facet that is near a gap keeps all of its band about the edge, in addition to
   what the margins attribute to it.

   Q may also be a box or a plate. Then K' is K, and the first margin below is empty; but the edge
   ends at corners, where nothing is known: w is a gap at both ends.

   If the point of (f) is visible, then, as in face_margin.c, the facets hide y in N if and only if
   its projection lies in K', and the true shapes hide x if and only if its projection lies in K:
   by (b) whether Q hides either depends on projections alone, and by (c) and (e) no other part
   hides anything there; P is convex, and hides none of its front. If the point is hidden, it is
   hidden by a part other than Q, and so is all of N, in truth and for the facets.

   If it is visible, what the true shapes leave visible of the wall exceeds what the facets leave by
   the points y in K' and not in K, less those in K and not in K'; and by those that are in K where
   x is not, less the reverse. The first are a margin along the edge, of which t0 <= t <= t1 is
   attributed to the facet that contains that part of the edge: its signed area follows from
   visibility/proximity/outline_area.c, 2. The second follow from the displacement of points. Beyond
   the ends of the edge, points are attributed as in face_margin.c, D being larger by sqrt(2) delta.

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
#include "base/work.h"
#include "visibility/proximity/wall_displacement.h"
#include "visibility/uniform/query.h"

/* The largest q. */
#define DISPLACEMENT_SLOPE_MAX 0.5
/* The edges of boxes and plates have margins only on walls with at least so many sectors: on
   coarser ones the bands of event_band.c, 7, are narrower than the errors of margins. Heuristic. */
#define EXACT_SECTORS_MIN 128u

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
    for (uint32_t i = 0; i < job->facets.count; i++) {
        const lrcsi_segment_part in = part_common(job->facets.facet[i].in, of);
        if (job->facets.facet[i].usable && in.to - in.from > longest) {
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
    for (uint32_t i = 0; i < job->facets.count && c->facets; i++) {
        double point[3];
        const uint32_t f = job->facets.facet[i].facet;
        if (c->undecided[f] && lrcsi_margin_facet_applies(view, f) &&
            lrcsi_view_point_above(view, f, x, point)) {
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
    const double strip = LRCSI_ROOT_2_OUTWARD * lateral * part;
    lrcsi_wall_displacement found = {0, strip, strip, 0};
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
    const double open = lateral * (one->length_err + m->direction_err) * m->length +
                        (part * q * (deepest + lateral) + variation) / (1 - q);
    along.error += open;
    along.size = lrcsi_min(strip, along.size + open);
    return q <= DISPLACEMENT_SLOPE_MAX && along.error < found.error ? along : found;
}

/* Adds the part of the margins on a facet: its area, with the depths of the whole edge. The area is
   known to within: the bounds of outline_area.c and errors of positions; where the part of the edge
   in it ends; the points at the ends of the edge; what the same area of the view plane stands for
   on other facets; the displacement of points. */
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
    to->area_max += (depth * part + displaced.size) * LRCSI_OUTWARD_NANO;
    to->area_far += (depth + strip) * one->neighbour_length * LRCSI_OUTWARD_NANO;
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
    for (uint32_t i = 0; i < job->facets.count; i++) {
        const lrcsi_margin_facet one = margin_facet_clip(m, free->of, &job->facets.facet[i]);
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
    const uint32_t other = bands->events.part[event];
    const double reach = bands->view->prepared->proximity.reach[part];
    const uint32_t sectors = bands->view->prepared->scene->part[part].divisions.around;
    job->outline = bands->orders.outline[other];
    job->outline.k = lrcsi_max(job->outline.k, reach);
    if (!job->outline.known && sectors >= EXACT_SECTORS_MIN) {
        job->outline = lrcsi_outline_make_exact(bands->view, other, reach);
    }
    return lrcsi_edge_margin_make(bands, &job->outline, event, part, 0, m);
}

/* Are the margins of a free part of an edge known? If so, adds them. If N is hidden, there are
   none, and what is open stays in the fractions of bands. */
static int part_examine(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                        const lrcsi_edge_part *free)
{
    double middle = 0;
    if (!(longest_in_facet(job, free->of, &middle) > 0)) {
        return 0;
    }
    const int visibility = wall_visibility(job, m, middle);
    return visibility == LRCSI_QUERY_HIDDEN ||
           (visibility == LRCSI_QUERY_VISIBLE && margin_facets_add(job, m, free));
}

/* Examines an event edge over the wall of a facet that its N meets. */
static lrcsi_wall_event event_examine(lrcsi_wall_margins *job, uint32_t facet, uint32_t event)
{
    lrcsi_event_bands *bands = job->bands;
    const uint32_t part = bands->view->prepared->scene->facet_part[facet];
    const lrcsi_margin_receiver receiver = {part, facet, NULL, 0};
    lrcsi_edge_margin m;
    lrcsi_edge_gaps gaps = {.count = 0};
    lrcsi_wall_event found = {.part = part};
    double turn[2];
    if (!wall_edge_make(job, event, part, &m)) {
        return found;
    }
    lrcsi_margin_facets_find(&job->facets, &m, facet, &gaps);
    if (!lrcsi_edge_gaps_are_all(&gaps)) {
        lrcsi_edge_margin_find_gaps(bands, &m, &receiver, &gaps, turn);
    }
    if (lrcsi_edge_gaps_are_all(&gaps)) {
        return found;
    }
    for (int end = 0; end < 2 && m.outline->is_exact; end++) { /* the edge ends at a corner */
        lrcsi_edge_margin_add_end_gap(&m, end, &gaps);
    }
    for (int i = 0; i <= gaps.count && found.count < LRCSI_WALL_PARTS; i++) {
        lrcsi_edge_part free;
        if (lrcsi_edge_margin_part(&m, &gaps, i, turn, &free) && part_examine(job, &m, &free)) {
            found.known[found.count++] = free.of;
        }
    }
    return found;
}

/* Are the margins of an edge known wherever it is near a facet? */
static int known_near(lrcsi_wall_margins *job, const lrcsi_wall_event *at, uint32_t facet,
                      uint32_t event)
{
    lrcsi_edge_margin m;
    if (at->count == 0 || (at->known[0].from <= 0 && at->known[0].to >= 1) ||
        !wall_edge_make(job, event, at->part, &m)) {
        return at->count > 0;
    }
    const lrcsi_segment_part near = lrcsi_margin_facet_near(job->bands->view, &m, facet);
    int known = 0;
    for (int i = 0; i < at->count && !known; i++) {
        known = (at->known[i].from <= 0 || near.from >= at->known[i].from) &&
                (at->known[i].to >= 1 || near.to <= at->known[i].to);
    }
    return known;
}

int lrcsi_wall_margins_add(lrcsi_wall_margins *job, uint32_t facet, uint32_t event)
{
    const uint32_t part = job->bands->view->prepared->scene->facet_part[facet];
    lrcsi_wall_event *at = &job->event[event];
    if ((at->part == part && at->count == 0) ||
        !lrcsi_margin_facet_applies(job->bands->view, facet)) {
        return 0;
    }
    if (at->part != part) {
        *at = event_examine(job, facet, event);
    }
    return known_near(job, at, facet, event);
}

void lrcsi_wall_margins_finish(const lrcsi_wall_margins *job)
{
    const lrcsi_view *view = job->bands->view;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        lrcsi_wall_margin *margin = &job->margin[f];
        if (margin->area_max + margin->area_err > 0) {
            margin->area_err += 2 * job->facets.unproved[f].fraction *
                                lrcsi_view_projected(view, f) * LRCSI_OUTWARD_NANO;
        }
    }
}

size_t lrcsi_wall_margins_need(const lrcs_prepared *p)
{
    return lrcsi_work_add(
        lrcsi_work_bytes(lrcsi_proximity_events_most(p), sizeof(lrcsi_wall_event)),
        lrcsi_margin_facets_need(p));
}

int lrcsi_wall_margins_make(lrcsi_event_bands *bands, const lrcsi_classification *classification,
                            lrcs_work *work, lrcsi_wall_margin *margin, lrcsi_wall_margins *job)
{
    const uint32_t facets = bands->view->prepared->scene->facet_count;
    *job = (lrcsi_wall_margins){.bands = bands, .classification = classification, .margin = margin};
    job->event = lrcsi_work_take(work, bands->events.count, sizeof *job->event);
    if (!job->event || lrcsi_margin_facets_make(bands, work, &job->facets) != LRCS_OK) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < bands->events.count; i++) {
        job->event[i].part = LRCS_NONE;
    }
    for (uint32_t f = 0; f < facets; f++) {
        margin[f] = (lrcsi_wall_margin){.area = 0};
    }
    return LRCS_OK;
}
