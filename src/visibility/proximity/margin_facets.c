/* SPDX-License-Identifier: MIT */
/* Finds the facets of a wall that the margin of an event edge meets, from one of them to its
   neighbours, and the parts of the edge for which conditions (a), (b) and (e) of
   visibility/proximity/wall_margin.c do not hold; its terms are used here. What the true shapes
   leave visible in the margin is decided there. */
#include "visibility/proximity/margin_facets.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "scene/neighbours.h"

/* An edge whose margin meets more facets is not used: heuristic. */
#define MARGIN_FACETS_MAX (UINT32_C(1) << 17)
/* Nor the part of one that may be near a facet with more pairs than this: a large facet that others
   intersect may have as many as these have facets. */
#define MARGIN_PAIRS_MAX 64u
/* Nor one whose margin may be on facets that are so much more oblique than those to which it is
   attributed. */
#define COS_RATIO_ERR_MAX 1.0
/* Nor one whose margin may be more sectors away: heuristic. */
#define MARGIN_SECTORS_MAX 32u

/* What is left of the list of a facet's pairs: all; those that matter; those, but too many. */
enum { PAIRS_ALL, PAIRS_REDUCED, PAIRS_MANY };

static uint32_t facets_most(const lrcs_prepared *p)
{
    return p->scene->facet_count < MARGIN_FACETS_MAX ? p->scene->facet_count : MARGIN_FACETS_MAX;
}

/* --- facets of a wall ------------------------------------------------------------------------- */

/* Notes the fraction of a facet for which its order with another part is not proved. */
static void unproved_add(lrcsi_margin_facets *all, uint32_t facet, uint32_t part, double unproved)
{
    if (unproved > 0 && lrcsi_part_set_add(&all->unproved[facet].parts, part)) {
        all->unproved[facet].fraction += unproved;
    }
}

/* Removes the pairs of a facet with parts that are in front of its own or behind it: of such parts
   (1) does not matter, but for the fractions that are left open. Returns 0 if the limit of steps is
   reached. */
static int pairs_reduce(lrcsi_margin_facets *all, uint32_t facet)
{
    lrcsi_event_bands *bands = all->bands;
    const lrcs_prepared *p = bands->view->prepared;
    uint32_t last = LRCS_NONE; /* the part of the pair before */
    uint32_t left = 0;
    int separated = 0;
    for (uint32_t *at = &all->first_pair[facet]; *at != LRCS_NONE;) {
        const uint32_t part = p->scene->facet_part[p->proximity.pair[*at].other];
        if (!lrcsi_meter_take(bands->meter, 1)) {
            return 0;
        }
        if (part != last) {
            double unproved = 0;
            separated = lrcsi_part_is_separated_in_front(&bands->orders, facet, part, &unproved) ||
                        lrcsi_part_is_behind(&bands->orders, facet, part, &unproved);
            unproved_add(all, facet, part, separated ? unproved : 0);
            last = part;
        }
        if (separated) {
            *at = all->next_pair[*at];
        } else {
            at = &all->next_pair[*at];
            left++;
        }
    }
    all->pairs[facet] = left > MARGIN_PAIRS_MAX ? PAIRS_MANY : PAIRS_REDUCED;
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
static void pairs_add_gaps(lrcsi_margin_facets *all, const lrcsi_edge_margin *m, uint32_t facet,
                           lrcsi_edge_gaps *gaps)
{
    lrcsi_event_bands *bands = all->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const uint32_t own = p->scene->facet_part[facet];
    if (all->pairs[facet] == PAIRS_ALL && !pairs_reduce(all, facet)) {
        lrcsi_edge_gaps_add(gaps, everywhere);
        return;
    }
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(bands->view, facet, m->edge, m->width);
    const lrcsi_slice slice = lrcsi_edge_rectangle_slice(bands->view, facet, &box);
    if (all->pairs[facet] == PAIRS_MANY) {
        lrcsi_edge_gaps_add(gaps, part_near(m, &box, &slice, m->width));
        return;
    }
    for (uint32_t i = all->first_pair[facet]; i != LRCS_NONE; i = all->next_pair[i]) {
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

int lrcsi_margin_facet_applies(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    lrcsi_wall_patch at;
    return !p->skip[facet] && view->facing[facet] > 0 && lrcsi_view_casts(view, facet) &&
           lrcsi_view_incidence(view, facet).cos_theta >
               p->proximity.grazing_cos[p->scene->facet_part[facet]] + LRCSI_VIEW_COS_ERR &&
           facet_position(p, facet, &at);
}

/* delta of a facet. */
static double facet_lateral(const lrcsi_view *view, uint32_t facet)
{
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
static void facet_cut(const lrcsi_view *view, const lrcsi_edge_margin *m, lrcsi_margin_facet *one)
{
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
static double facet_slack(const lrcsi_edge_margin *m, double lateral)
{
    return m->outline->k + LRCSI_ROOT_2_OUTWARD * lateral + m->err;
}

/* The planes for (b) are parallel to the edge. Across it, the first one is parallel to the view
   plane; the others fall away from the laser behind the edge, by the inverse of these slopes: where
   P begins at Q, or near it, only a plane along the side of Q that faces away leaves P behind Q. */
static const double plane_slopes[LRCSI_MARGIN_PLANES] = {0, 1, 8, 64, 512, 4096};

/* Makes such a plane, as high, along the direction to the laser, as it can be with all of Q on or
   above it. */
static lrcsi_margin_plane plane_below(const lrcsi_margin_facets *all, const lrcsi_edge_margin *m,
                                      double across)
{
    const lrcsi_view *view = all->bands->view;
    const lrcsi_body *body = all->bands->orders.body;
    lrcsi_margin_plane plane;
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
static int slice_is_below(lrcsi_margin_facets *all, const lrcsi_edge_margin *m, uint32_t facet,
                          const lrcsi_slice *slice)
{
    const lrcsi_view *view = all->bands->view;
    const lrcs_prepared *p = view->prepared;
    const double reach = p->proximity.reach[p->scene->facet_part[facet]];
    const double facet_err = lrcsi_edge_rectangle_facet_err(view, facet);
    int below = 0;
    for (int k = 0; k < LRCSI_MARGIN_PLANES && all->bands->orders.body && !below; k++) {
        const lrcsi_margin_plane *plane = &all->plane[k];
        if (k == all->plane_count) {
            all->plane[all->plane_count++] = plane_below(all, m, plane_slopes[k]);
        }
        const double slack = plane->err + reach + 4 * facet_err;
        below = plane->up[2] > PLANE_UP_MIN;
        for (int i = 0; i < slice->count; i++) {
            below = below && lrcsi_vec3_dot(plane->up, slice->x[i]) < plane->level - slack;
        }
    }
    return below;
}

/* The same as lrcsi_margin_facet_near, given delta of the facet. */
static lrcsi_segment_part facet_near(const lrcsi_view *view, const lrcsi_edge_margin *m,
                                     uint32_t facet, double lateral)
{
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(view, facet, m->edge, facet_slack(m, lateral));
    const lrcsi_slice slice = lrcsi_edge_rectangle_slice(view, facet, &box);
    return part_near(m, &box, &slice, 0);
}

lrcsi_segment_part lrcsi_margin_facet_near(const lrcsi_view *view, const lrcsi_edge_margin *m,
                                           uint32_t facet)
{
    return facet_near(view, m, facet, facet_lateral(view, facet));
}

/* Makes the data of a facet that N meets, or adds a gap if its part of the wall cannot be used. */
static void facet_make(lrcsi_margin_facets *all, const lrcsi_edge_margin *m, uint32_t facet,
                       lrcsi_margin_facet *one, lrcsi_edge_gaps *gaps)
{
    const lrcsi_view *view = all->bands->view;
    double unproved = 0;
    *one = (lrcsi_margin_facet){.facet = facet};
    const int applies = lrcsi_margin_facet_applies(view, facet);
    const int separated =
        applies && lrcsi_part_is_separated_in_front(&all->bands->orders, facet, m->part, &unproved);
    if (!separated) {
        const lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(view, facet, m->edge, m->width);
        const lrcsi_slice slice = lrcsi_edge_rectangle_slice(view, facet, &box);
        if (!applies || !slice_is_below(all, m, facet, &slice)) {
            lrcsi_edge_gaps_add(gaps, part_near(m, &box, &slice, m->width));
            return;
        }
    }
    pairs_add_gaps(all, m, facet, gaps);
    unproved_add(all, facet, m->part, separated ? unproved : 0);
    one->usable = 1;
    one->lateral = one->farthest = facet_lateral(view, facet);
    const lrcsi_segment_part near = facet_near(view, m, facet, one->lateral);
    one->near[0] = near.from * m->length;
    one->near[1] = near.to * m->length;
    facet_position(view->prepared, facet, &one->patch);
    facet_cut(view, m, one);
}

/* Continues the search across the sides of a facet that N meets, to the facets beyond them that
   face the laser. Adds a gap where there is none. */
static void facets_spread(lrcsi_margin_facets *all, const lrcsi_edge_margin *m, uint32_t facet,
                          lrcsi_edge_gaps *gaps)
{
    const lrcsi_view *view = all->bands->view;
    const lrcs_prepared *p = view->prepared;
    const uint32_t *corner = p->scene->facet[facet].corner;
    const lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(view, facet, m->edge, m->width);
    for (int k = 0; k < 3; k++) {
        const uint32_t other = lrcsi_neighbour_in_part(p, facet, k);
        const double *from = view->point[corner[k]].x;
        const double *to = view->point[corner[(k + 1) % 3]].x;
        const lrcsi_segment_part side = lrcsi_edge_rectangle_part(&box, from, to);
        if (lrcsi_segment_part_is_empty(side) ||
            (other != LRCS_NONE && lrcsi_marked(&all->reached, other))) {
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
        all->reached.entry[other] = all->reached.number;
        if (all->count == facets_most(p)) {
            lrcsi_edge_gaps_add(gaps, everywhere);
        } else {
            all->facet[all->count++].facet = other;
        }
    }
}

/* A number that grows with the position t on the edge, and is the same beyond its ends. */
static uint32_t edge_key(const lrcsi_edge_margin *m, double t)
{
    const double fraction = lrcsi_min(1, lrcsi_max(0, t / m->length));
    return (uint32_t)(fraction * 0x1p31);
}

/* Sorts the usable facets by where they begin to be near the edge. Returns their number. */
static uint32_t facets_sort(lrcsi_margin_facets *all, const lrcsi_edge_margin *m)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const lrcsi_margin_facet *one = &all->facet[i];
        if (one->usable && one->near[0] <= one->near[1]) {
            all->order[count++] = (lrcsi_sort_item){edge_key(m, one->near[0]), i};
        }
    }
    lrcsi_sort_items(all->order, count);
    double most = -HUGE_VAL;
    for (uint32_t i = 0; i < count; i++) {
        most = lrcsi_max(most, all->facet[all->order[i].value].near[1]);
        all->end_max[i] = most;
    }
    return count;
}

/* How many of the sorted facets may begin to be near the edge at t or before? */
static uint32_t facets_before(const lrcsi_margin_facets *all, const lrcsi_edge_margin *m,
                              uint32_t count, double t)
{
    const uint32_t key = edge_key(m, t);
    uint32_t low = 0;
    for (uint32_t high = count; low < high;) {
        const uint32_t middle = low + (high - low) / 2;
        if (all->order[middle].key <= key) {
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
static void facets_compare(lrcsi_margin_facets *all, const lrcsi_edge_margin *m,
                           lrcsi_edge_gaps *gaps)
{
    const lrcsi_view *view = all->bands->view;
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t part = scene->facet_part[all->facet[0].facet];
    const uint32_t around = scene->part[part].divisions.around;
    const uint32_t count = facets_sort(all, m);
    for (uint32_t i = 0; i < all->count; i++) {
        lrcsi_margin_facet *one = &all->facet[i];
        if (!one->usable || lrcsi_segment_part_is_empty(one->outer)) {
            continue;
        }
        const double own = lrcsi_view_incidence(view, one->facet).cos_theta;
        const double from = one->outer.from * m->length - m->err;
        const double to = one->outer.to * m->length + m->err;
        uint32_t at = facets_before(all, m, count, to);
        while (at > 0 && all->end_max[at - 1] >= from) {
            const lrcsi_margin_facet *other = &all->facet[all->order[--at].value];
            const double length = lrcsi_min(to, other->near[1]) - lrcsi_max(from, other->near[0]);
            if (other == one || !(length >= 0)) {
                continue;
            }
            if (!lrcsi_meter_take(all->bands->meter, 1)) {
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
            one->neighbour_length += length;
        }
        one->neighbour_length = lrcsi_min(one->neighbour_length, to - from);
        one->neighbour_err = lrcsi_min(one->neighbour_err, one->cos_ratio_err * (to - from));
        if (one->sectors > MARGIN_SECTORS_MAX || !(one->cos_ratio_err < COS_RATIO_ERR_MAX)) {
            lrcsi_edge_gaps_add(gaps, one->outer);
        }
    }
}

void lrcsi_margin_facets_find(lrcsi_margin_facets *all, const lrcsi_edge_margin *m, uint32_t facet,
                              lrcsi_edge_gaps *gaps)
{
    all->plane_count = 0;
    lrcsi_marks_clear(&all->reached, all->bands->view->prepared->scene->facet_count);
    all->reached.entry[facet] = all->reached.number;
    all->facet[0].facet = facet;
    all->count = 1;
    for (uint32_t i = 0; i < all->count && !lrcsi_edge_gaps_are_all(gaps); i++) {
        if (!lrcsi_meter_take(all->bands->meter, 4)) {
            lrcsi_edge_gaps_add(gaps, everywhere);
        }
        const uint32_t f = all->facet[i].facet;
        facet_make(all, m, f, &all->facet[i], gaps);
        facets_spread(all, m, f, gaps);
    }
    if (!lrcsi_edge_gaps_are_all(gaps)) {
        facets_compare(all, m, gaps);
    }
}

size_t lrcsi_margin_facets_need(const lrcs_prepared *p)
{
    const size_t facets = p->scene->facet_count;
    size_t need = lrcsi_work_bytes(facets_most(p), sizeof(lrcsi_margin_facet));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets_most(p), sizeof(lrcsi_sort_item)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets_most(p), sizeof(double)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->proximity.count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_margin_unproved)));
}

int lrcsi_margin_facets_make(lrcsi_event_bands *bands, lrcs_work *work, lrcsi_margin_facets *all)
{
    const uint32_t facets = bands->view->prepared->scene->facet_count;
    const uint32_t most = facets_most(bands->view->prepared);
    const lrcsi_proximity *proximity = &bands->view->prepared->proximity;
    *all = (lrcsi_margin_facets){.bands = bands};
    all->facet = lrcsi_work_take(work, most, sizeof *all->facet);
    all->order = lrcsi_work_take(work, most, sizeof *all->order);
    all->end_max = lrcsi_work_take(work, most, sizeof *all->end_max);
    all->reached.entry = lrcsi_work_take_zero(work, facets, sizeof *all->reached.entry);
    all->pairs = lrcsi_work_take_zero(work, facets, 1);
    all->unproved = lrcsi_work_take_zero(work, facets, sizeof *all->unproved);
    all->first_pair = lrcsi_work_take(work, facets, sizeof *all->first_pair);
    all->next_pair = lrcsi_work_take(work, proximity->count, sizeof *all->next_pair);
    if (!all->facet || !all->order || !all->end_max || !all->reached.entry || !all->pairs ||
        !all->unproved || !all->first_pair || !all->next_pair) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facets; f++) {
        all->first_pair[f] = LRCS_NONE;
    }
    for (uint32_t i = 0; i < proximity->count; i++) {
        uint32_t *first = &all->first_pair[proximity->pair[i].facet];
        all->next_pair[i] = *first;
        *first = i;
    }
    return LRCS_OK;
}
