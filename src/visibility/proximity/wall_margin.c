/* SPDX-License-Identifier: MIT */
/* Decides which event edges have margins over one straight wall alone, and adds the areas of these
   to the facets that they meet. What that adds to sigma
   is decided in integrate/wall/tessellation.c. Terms and conditions are those of
   visibility/proximity/proximity_band.c; K, K' and k those of visibility/proximity/outline.h; w, N,
   (c) and (d) those of visibility/proximity/face_margin.c.

   P is a closed part with a straight wall: a cylinder, cone or frustum. Q is another part with an
   outline. An
   event edge of Q that belongs to a contour has the ends a and b, L apart in projection. The points
   x of the true wall and y of the facets that the map relates are in projection at most delta <= k
   apart. The margin of the edge is known on the wall if
   (a) the facets of P that face the laser and that N meets are all on the wall, and contain N in
       projection;
   (b) a plane separates Q, in front, from P;
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

   If the point of (f) is visible, then, as in face_margin.c, the facets hide y in N if and only if
   its projection lies in K', and the true shapes hide x if and only if its projection lies in K:
   by (b) whether Q hides either depends on projections alone, and by (c) and (e) no other part
   hides anything there; P is convex, and hides none of its front. If the point is hidden, it is
   hidden by a part other than Q, and so is all of N, in truth and for the facets.

   If it is visible, what the true shapes leave visible of the wall exceeds what the facets leave by
   the points y in K' and not in K, less those in K and not in K'; and by those that are in K where
   x is not, less the reverse. The first are a margin along the edge, of which t0 <= t <= t1 is
   attributed to the facet that contains that part of the edge: its signed area follows from
   visibility/proximity/outline.c, 3. The second are within sqrt(2) delta of the boundary of K in
   depth: of each facet no more than that times the length of the edge along which the facet is
   near. Beyond the ends of the edge, points are attributed as in face_margin.c, D being larger by
   sqrt(2) delta.

   A part of the margin, t0 <= t <= t1, may lie on facets next to the one to which it is attributed.
   It is tested that these are within one row and one sector of it, so that F of their patches is
   not far from its own. On another
   facet the same area in projection stands for cos / cos' times as much of the wall as on its own:
   where the margin may be on it, F sup |cos / cos' - 1| is an error, twice if F differs as well. */
#include "visibility/proximity/wall_margin.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/shape/tessellate.h"
#include "scene/neighbours.h"
#include "visibility/uniform/query.h"

/* An edge whose margin meets more facets is not used: heuristic. */
#define MARGIN_FACETS_MAX 1024u
/* Nor one that may be near a facet with more pairs than this: a large facet that others intersect
   may have as many as these have facets. */
#define MARGIN_PAIRS_MAX 64u
/* Nor one whose margin may be on facets that are so much more oblique than those to which it is
   attributed. */
#define COS_RATIO_ERR_MAX 1.0

/* What is left of the list of a facet's pairs: all; those that matter; those, but too many. */
enum { PAIRS_ALL, PAIRS_REDUCED, PAIRS_MANY };

struct lrcsi_margin_facet {
    uint32_t facet;
    lrcsi_wall_patch patch;
    double lateral;               /* delta */
    double near[2];               /* t of the facet's points near the edge, in projection */
    lrcsi_segment_part in, outer; /* the part of the edge in the facet; the same, enlarged by
                                     errors */
    double length_err;            /* the fraction of the edge that may belong to it or not */
    double cos_ratio_err;         /* bound on |cos / cos' - 1|, where its part of the margin may be
                                     on another facet: cos of its own incidence angle, cos' of that
                                     facet's */
    double neighbour_err;         /* the sum of this over such facets, times the length along the
                                     edge where the margin may be on them */
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

/* Is (1) excluded for the points of a facet that are in N? A facet of another part within the slack
   of such a point is, in projection, within the slack of N. */
static int facet_is_apart(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const uint32_t own = p->scene->facet_part[facet];
    int apart = (job->pairs[facet] != PAIRS_ALL || pairs_reduce(job, facet)) &&
                job->pairs[facet] != PAIRS_MANY;
    for (uint32_t i = job->first_pair[facet]; i != LRCS_NONE && apart; i = job->next_pair[i]) {
        const uint32_t other = p->proximity.pair[i].other;
        const double slack =
            m->width + m->err + lrcsi_proximity_slack(p, own, p->scene->facet_part[other]);
        const lrcsi_edge_rectangle box =
            lrcsi_edge_rectangle_make(bands->view, other, m->edge, slack);
        apart = lrcsi_meter_take(bands->meter, 1) &&
                lrcsi_edge_rectangle_slice(bands->view, other, &box).count == 0;
    }
    return apart;
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

/* Are two sectors the same or next to each other? */
static int is_next_to(const lrcsi_wall_patch *a, const lrcsi_wall_patch *b, uint32_t around)
{
    const uint32_t rows = a->row > b->row ? a->row - b->row : b->row - a->row;
    const uint32_t apart = a->sector > b->sector ? a->sector - b->sector : b->sector - a->sector;
    return a->mirrored == b->mirrored && rows <= 1 && (apart <= 1 || apart + 1 >= around);
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

/* Makes the data of a facet. Returns 0 if its part of the wall cannot be used. */
static int margin_facet_make(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet,
                             lrcsi_margin_facet *one)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    double unproved = 0;
    *one = (lrcsi_margin_facet){.facet = facet, .lateral = facet_lateral(job, facet)};
    if (!facet_applies(job, facet) || !facet_is_apart(job, m, facet) ||
        !(one->lateral <= m->outline->k) ||
        !lrcsi_part_is_separated_in_front(&job->bands->orders, facet, m->part, &unproved)) {
        return 0;
    }
    unproved_add(job, facet, m->part, unproved);
    facet_position(p, facet, &one->patch);
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(view, facet, m->edge, margin_facet_slack(m, one->lateral));
    const lrcsi_slice slice = lrcsi_edge_rectangle_slice(view, facet, &box);
    one->near[0] = HUGE_VAL;
    one->near[1] = -HUGE_VAL;
    for (int i = 0; i < slice.count; i++) {
        const double t =
            m->along[0] * (slice.x[i][0] - m->a[0]) + m->along[1] * (slice.x[i][1] - m->a[1]);
        one->near[0] = lrcsi_min(one->near[0], t - box.err);
        one->near[1] = lrcsi_max(one->near[1], t + box.err);
    }
    margin_facet_cut(job, m, one);
    return box.has_sides;
}

/* Finds all facets that N meets, from one of them on. Returns 0 if (a), (b) or (e) does not hold.
   */
static int margin_facets_find(lrcsi_wall_margins *job, const lrcsi_edge_margin *m, uint32_t facet)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    lrcsi_marks_clear(&job->reached, p->scene->facet_count);
    job->reached.entry[facet] = job->reached.number;
    job->facet_count = 0;
    if (!margin_facet_make(job, m, facet, &job->facet[job->facet_count++])) {
        return 0;
    }
    for (uint32_t i = 0; i < job->facet_count; i++) {
        const uint32_t f = job->facet[i].facet;
        const uint32_t *corner = p->scene->facet[f].corner;
        const lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(view, f, m->edge, m->width);
        if (!lrcsi_meter_take(job->bands->meter, 4)) {
            return 0;
        }
        for (int k = 0; k < 3; k++) {
            const uint32_t other = lrcsi_neighbour_in_part(p, f, k);
            if (lrcsi_segment_part_is_empty(lrcsi_edge_rectangle_part(
                    &box, view->point[corner[k]].x, view->point[corner[(k + 1) % 3]].x))) {
                continue;
            }
            if (other == LRCS_NONE) {
                return 0; /* a border */
            }
            if (lrcsi_marked(&job->reached, other)) {
                continue;
            }
            job->reached.entry[other] = job->reached.number;
            if (job->facet_count == margin_facets_most(p) ||
                !margin_facet_make(job, m, other, &job->facet[job->facet_count++])) {
                return 0;
            }
        }
    }
    return 1;
}

/* Are the patches above each part of the margin next to the facet to which it is attributed? Also
   finds how much more of their area a part of the view plane stands for. */
static int margin_facets_are_local(const lrcsi_wall_margins *job, const lrcsi_edge_margin *m)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t part = scene->facet_part[job->facet[0].facet];
    const uint32_t around = scene->part[part].divisions.around;
    int local =
        lrcsi_meter_take(job->bands->meter, (uint64_t)job->facet_count * job->facet_count / 16);
    for (uint32_t i = 0; i < job->facet_count && local; i++) {
        lrcsi_margin_facet *one = &job->facet[i];
        const double own = lrcsi_view_incidence(view, one->facet).cos_theta;
        const double from = one->outer.from * m->length - m->err;
        const double to = one->outer.to * m->length + m->err;
        for (uint32_t k = 0;
             k < job->facet_count && local && !lrcsi_segment_part_is_empty(one->outer); k++) {
            const lrcsi_margin_facet *other = &job->facet[k];
            const double length = lrcsi_min(to, other->near[1]) - lrcsi_max(from, other->near[0]);
            if (k == i || !(length >= 0)) {
                continue;
            }
            const double cosine = lrcsi_view_incidence(view, other->facet).cos_theta;
            const double cos_ratio_err =
                fabs(own / cosine - 1) + 4 * LRCSI_VIEW_COS_ERR / lrcsi_min(own, cosine);
            one->cos_ratio_err = lrcsi_max(one->cos_ratio_err, cos_ratio_err);
            one->neighbour_err += cos_ratio_err * length;
            local =
                is_next_to(&one->patch, &other->patch, around) && cos_ratio_err < COS_RATIO_ERR_MAX;
        }
    }
    return local;
}

/* --- is the wall visible beside the edge? ----------------------------------------------------- */

/* Makes the grid for queries, if there is memory for it. */
static void wall_facets_make(lrcsi_wall_margins *job)
{
    const lrcs_scene *scene = job->bands->view->prepared->scene;
    lrcsi_classification *c = job->classification;
    job->facets_tried = 1;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        job->reader[f] = c->undecided[f] && facet_applies(job, f);
    }
    const lrcsi_grid_readers readers = {.undecided = job->reader};
    job->facets_made = lrcsi_grid_facets(&c->search.grid, &c->search.boxes, &readers, job->work,
                                         &job->facets) == LRCS_OK;
}

/* (f): an answer of visibility/uniform/query.h for a point half of w beyond the edge. */
static int wall_visibility(lrcsi_wall_margins *job, const lrcsi_edge_margin *m)
{
    const lrcsi_view *view = job->bands->view;
    double longest = 0;
    double t = 0.5;
    double x[2];
    if (!job->facets_tried) {
        wall_facets_make(job);
    }
    for (uint32_t i = 0; i < job->facet_count; i++) {
        const lrcsi_margin_facet *one = &job->facet[i];
        if (one->in.to - one->in.from > longest) {
            longest = one->in.to - one->in.from;
            t = 0.5 * (one->in.from + one->in.to);
        }
    }
    for (int i = 0; i < 2; i++) {
        x[i] = m->a[i] + t * (m->b[i] - m->a[i]) + 0.5 * m->width * m->outward[i];
    }
    for (uint32_t i = 0; i < job->facet_count && job->facets_made; i++) {
        double point[3];
        const uint32_t f = job->facet[i].facet;
        if (job->reader[f] && lrcsi_view_point_above(view, f, x, point)) {
            return lrcsi_query_point(&job->facets, f, point, job->bands->meter);
        }
    }
    return LRCSI_QUERY_NO_ANSWER;
}

/* --- margins ---------------------------------------------------------------------------------- */

/* Adds the part of the margins on a facet: its area, with the depths of the whole edge. The area is
   known to within: the bounds of outline.c and errors of positions; where the part of the edge in
   it ends; the points at the ends of the edge; what the same area of the view plane stands for on
   other facets; the displacement of points. The strips that displacement adds and removes have
   opposite signs: the larger one counts. */
static void margin_facet_add(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                             const lrcsi_outline_margin *margin, const double turn[2],
                             const lrcsi_margin_facet *one)
{
    const double depth = margin->depth;
    const double part = lrcsi_max(0, one->outer.to - one->outer.from);
    const double near = lrcsi_max(0, one->near[1] - one->near[0]);
    const double k = m->outline->k + m->err;
    const double wider = LRCSI_ROOT_2_OUTWARD * one->lateral;
    double ends = 0;
    if (one->near[0] < 2 * k) {
        ends += lrcsi_edge_margin_end(m, margin->end_depth[0] + wider, turn[0]);
    }
    if (one->near[1] > m->length - 2 * k) {
        ends += lrcsi_edge_margin_end(m, margin->end_depth[1] + wider, turn[1]);
    }
    lrcsi_wall_margin *to = &job->margin[one->facet];
    to->area += margin->area;
    to->area_err += 2 * LRCSI_U * fabs(to->area); /* of the addition */
    to->area_max += depth * part * m->length * LRCSI_OUTWARD_NANO;
    const double known =
        margin->error + 2 * m->err * margin->width + depth * one->length_err * m->length + ends;
    to->area_err += ((1 + one->cos_ratio_err) * known + 2 * depth * one->neighbour_err +
                     LRCSI_ROOT_2_OUTWARD * one->lateral * near) *
                    LRCSI_OUTWARD_NANO;
}

/* Adds the margins of an edge, if all of them are known. */
static int margin_facets_add(lrcsi_wall_margins *job, const lrcsi_edge_margin *m,
                             const double turn[2])
{
    const int side = job->bands->events.side[m->event];
    const lrcsi_outline_margin whole =
        lrcsi_outline_margin_make(m->outline, m->a, m->b, side, 0, 1);
    if (!isfinite(whole.error)) {
        return 0;
    }
    for (uint32_t i = 0; i < job->facet_count; i++) {
        const lrcsi_margin_facet *one = &job->facet[i];
        lrcsi_outline_margin margin = whole;
        if (!(one->in.from < one->in.to)) {
            margin.area = margin.error = margin.width = 0;
        } else if (one->in.from > 0 || one->in.to < 1) {
            const lrcsi_outline_margin part =
                lrcsi_outline_margin_make(m->outline, m->a, m->b, side, one->in.from, one->in.to);
            margin.area = part.area;
            margin.error = part.error;
            margin.width = part.width;
        }
        margin_facet_add(job, m, &margin, turn, one);
    }
    return 1;
}

/* Examines an event edge over the wall of a facet that its N meets. */
static int event_examine(lrcsi_wall_margins *job, uint32_t facet, uint32_t event)
{
    lrcsi_event_bands *bands = job->bands;
    const uint32_t part = bands->view->prepared->scene->facet_part[facet];
    const lrcsi_margin_receiver receiver = {part, facet, NULL, 0};
    lrcsi_edge_margin m;
    lrcsi_edge_gaps gaps = {.count = 0};
    double turn[2];
    if (!lrcsi_edge_margin_make(bands, event, part, 0, &m) || !margin_facets_find(job, &m, facet) ||
        !margin_facets_are_local(job, &m)) {
        return 0;
    }
    lrcsi_edge_margin_find_gaps(bands, &m, &receiver, &gaps, turn);
    if (gaps.count > 0) {
        return 0;
    }
    /* If N is hidden, there is no margin, and what is open stays in the fractions of bands. */
    const int visibility = wall_visibility(job, &m);
    return visibility == LRCSI_QUERY_HIDDEN ||
           (visibility == LRCSI_QUERY_VISIBLE && margin_facets_add(job, &m, turn));
}

int lrcsi_wall_margins_add(lrcsi_wall_margins *job, uint32_t facet, uint32_t event)
{
    const uint32_t part = job->bands->view->prepared->scene->facet_part[facet];
    lrcsi_wall_event *at = &job->event[event];
    if ((at->part == part && !at->known) || !facet_applies(job, facet) ||
        !(facet_lateral(job, facet) <=
          job->bands->orders.outline[job->bands->events.part[event]].k)) {
        return 0;
    }
    if (at->part != part) {
        *at = (lrcsi_wall_event){part, event_examine(job, facet, event)};
    }
    return at->known;
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
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->proximity.count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_wall_unproved)));
    return lrcsi_work_add(need, lrcsi_grid_facets_need(p));
}

int lrcsi_wall_margins_make(lrcsi_event_bands *bands, lrcsi_classification *classification,
                            lrcs_work *work, lrcsi_wall_margin *margin, lrcsi_wall_margins *job)
{
    const uint32_t facets = bands->view->prepared->scene->facet_count;
    const lrcsi_proximity *proximity = &bands->view->prepared->proximity;
    *job = (lrcsi_wall_margins){
        .bands = bands, .classification = classification, .work = work, .margin = margin};
    job->event = lrcsi_work_take(work, bands->events.count, sizeof *job->event);
    job->facet =
        lrcsi_work_take(work, margin_facets_most(bands->view->prepared), sizeof *job->facet);
    job->reached.entry = lrcsi_work_take_zero(work, facets, sizeof *job->reached.entry);
    job->reader = lrcsi_work_take(work, facets, 1);
    job->pairs = lrcsi_work_take_zero(work, facets, 1);
    job->unproved = lrcsi_work_take_zero(work, facets, sizeof *job->unproved);
    job->first_pair = lrcsi_work_take(work, facets, sizeof *job->first_pair);
    job->next_pair = lrcsi_work_take(work, proximity->count, sizeof *job->next_pair);
    if (!job->event || !job->facet || !job->reached.entry || !job->reader || !job->pairs ||
        !job->unproved || !job->first_pair || !job->next_pair) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < bands->events.count; i++) {
        job->event[i] = (lrcsi_wall_event){LRCS_NONE, 0};
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
