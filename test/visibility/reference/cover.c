/* SPDX-License-Identifier: MIT */
/* A line of sight through a facet, tested against the facets near it. All decisions are exact, but
   the position of the line is rounded: the caller keeps it far enough from everything that divides
   the facet.

   Suppose that a component hides the point of the sample and ends at no cut of the cell. Along any
   path in the cell, except at the cuts, the component continues (visibility/uniform/classify.h) and remains
   in front of the target: to pass behind the target it would have to intersect it. So it hides the
   whole cell.

   A line is first tested against the candidates in the target's frame, in doubles. Away from their
   sides the result is certain, and the required distance is in proportion to the target's size. If
   the line passes too near a side, all candidates are tested again at a nearby point in space,
   exactly: of two candidates that share a side, the line then meets exactly one. */
#include "visibility/reference/cover.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/base/sample.h"
#include "visibility/cells/contact.h"

#define U 0x1p-53

/* The depth order of a candidate relative to the target: one of these, or the index of the cut
   along which the two intersect. */
enum cover_order {
    ORDER_NEW = 0x7ffffff0, /* not determined yet */
    ORDER_FRONT,            /* nearer, on every line that meets both */
    ORDER_BEHIND,           /* farther, on every line that meets both */
    ORDER_PER_LINE,         /* decided separately on each line that meets both */
    ORDER_UNKNOWN           /* in contact along an unknown line */
};

size_t ref_cover_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_grid_facets_need(prepared),
                                 lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(REF_COVER_KEPT, sizeof(ref_cover_sides)));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(ref_cover_facet)));
}

int ref_cover_make(lrcsi_classification *classification, lrcs_work *work, ref_cover *cover)
{
    uint32_t count = classification->view->prepared->scene->facet_count;
    *cover = (ref_cover){.classification = classification};
    cover->listed = lrcsi_work_take_zero(work, count, sizeof *cover->listed);
    cover->candidate = lrcsi_work_take(work, count, sizeof *cover->candidate);
    cover->sides = lrcsi_work_take_zero(work, REF_COVER_KEPT, sizeof *cover->sides);
    return cover->listed && cover->candidate && cover->sides ? LRCS_OK : LRCS_E_MEMORY;
}

/* --- candidates ------------------------------------------------------------------------------- */

void ref_cover_start(ref_cover *cover, const lrcsi_target *target)
{
    const lrcsi_grid *facets = &cover->facets;
    lrcsi_view_box box = *lrcsi_boxes_facet(&facets->boxes, target->facet);
    lrcsi_grid_rect cells = lrcsi_grid_buckets(facets, &box);
    cover->count = 0;
    cover->searches++;
    cover->listed[target->facet] = cover->searches;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = facets->first[(size_t)y * facets->size + cells.x0];
        uint32_t end = facets->first[(size_t)y * facets->size + cells.x1];
        if (!lrcsi_meter_take(NULL, end - i)) {
            return;
        }
        for (; i < end; i++) {
            uint32_t other = facets->item[i];
            if (cover->listed[other] == cover->searches) {
                continue;
            }
            cover->listed[other] = cover->searches;
            const lrcsi_view_box *its = lrcsi_boxes_facet(&facets->boxes, other);
            if (!lrcsi_view_box_beside(its, &box) && !lrcsi_view_box_behind(its, &box)) {
                cover->candidate[cover->count++] =
                    (ref_cover_facet){.box = *its, .facet = other, .order = ORDER_NEW};
            }
        }
    }
}

/* The depth order of two facets, neither of which lies on one side of the other's plane. If they
   are in contact, the cut decides. If they are coplanar, the rules of precedence decide, and a
   facet without precedence has no cut. */
static uint32_t order_mixed(const ref_cuts *cuts, uint32_t other)
{
    const lrcsi_target *t = cuts->target;
    const lrcsi_intersections *intersections = &t->view->prepared->intersections;
    for (uint32_t i = 0; i < cuts->count; i++) {
        if (cuts->cut[i].other == other) {
            int kind = cuts->cut[i].kind;
            return kind == LRCSI_CONTACT_LINE      ? i
                   : kind == LRCSI_CONTACT_BEHIND  ? ORDER_BEHIND
                   : kind == LRCSI_CONTACT_UNKNOWN ? ORDER_UNKNOWN
                                                   : ORDER_FRONT;
        }
    }
    for (uint32_t i = intersections->first[t->facet]; i < intersections->first[t->facet + 1]; i++) {
        if (intersections->entry[i].other == other) {
            return ORDER_BEHIND;
        }
    }
    int order = lrcsi_sample_overlap_order(t->view, other, t->facet);
    return order > 0 ? ORDER_FRONT : order < 0 ? ORDER_BEHIND : ORDER_PER_LINE;
}

/* Returns ORDER_NEW if the meter is spent. */
static uint32_t order_of(const ref_cuts *cuts, uint32_t other)
{
    const lrcsi_target *t = cuts->target;
    uint32_t intersections = lrcsi_intersection_of(&t->view->prepared->intersections, t->facet);
    if (!lrcsi_meter_take(NULL, (uint64_t)1 + cuts->count + intersections)) {
        return ORDER_NEW;
    }
    int side = lrcsi_sample_side(t->view, other, t->facet);
    return side > 0 ? ORDER_FRONT : side < 0 ? ORDER_BEHIND : order_mixed(cuts, other);
}

/* --- one line --------------------------------------------------------------------------------- */

/* How a line is tested against the candidates. */
enum line_way {
    LINE_PLACED, /* at its position in the frame, if that is clear of all sides */
    LINE_EXACT,  /* at a nearby point in space, exactly */
    LINE_GUESSED /* at its rounded position */
};

typedef struct cover_line {
    const ref_cover *cover;
    const ref_cuts *cuts;
    uint32_t count; /* the first cuts of the list, which may divide the cell */
    int way;
    double at[2];       /* in the target's frame */
    lrcsi_view_box box; /* in the view; its depth is not used */
    double point[3];    /* in space */
    double err;         /* position error of the line in the frame */
} cover_line;

/* A candidate is far if the distance of its farthest corner exceeds this many times the sum of the
   target's reach and the distance of its nearest corner. */
#define FAR_CANDIDATE 64.0

/* The sides of a candidate in the frame, each with the bound that lrcsi_clip_side must exceed in
   magnitude for its sign to be certain.

   A corner at distance r has a position error of e = 10 u r. So the computed candidate differs from
   the true one by no more than the largest e. With d the target's diameter, the computed side of a
   line may be wrong only within 4 u (r + d) of the line. A point that is farther than the sum of
   both from a side is outside of the computed and of the true candidate; if it is that far inside
   all three sides, it is inside of both.

   If one corner is far away, this bound is too coarse. Then each side decides only on which side of
   its own line a point lies. Let T be the vector of the side from p to q, n the nearer of the two
   corners, and G the vector from n to the point. The error of T is 12 u (r_p + r_q), rounding
   included, and that of G is 12 u r_n + 2 u d. So the error of T x G is 12 u (r_p + r_q) |G| + (12
   u r_n + 2 u d) |T| in the 1-norm, and in addition that of its own rounding, 2 u |T| |G|, which is
   below 3 u (r_p + r_q) |G|. */
static void sides_place(const lrcsi_target *t, uint32_t facet, ref_cover_sides *c)
{
    double corner[3][2];
    double reach[3];
    double most = t->reach;
    double least = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        reach[k] = lrcsi_target_coordinates(t, lrcsi_target_corner(t->view, facet, k), corner[k]);
        most = lrcsi_max(most, reach[k]);
        least = lrcsi_min(least, reach[k]);
    }
    int far = most > FAR_CANDIDATE * (least + t->reach);
    for (int k = 0; k < 3; k++) {
        int next = k == 2 ? 0 : k + 1;
        int near = reach[k] <= reach[next] ? k : next;
        lrcsi_clip_line *side = &c->side[k];
        for (int i = 0; i < 2; i++) {
            side->at[i] = corner[near][i];
            side->to[i] = corner[next][i] - corner[k][i];
        }
        double length = fabs(side->to[0]) + fabs(side->to[1]);
        double gap = fabs(side->at[0]) + fabs(side->at[1]) + 1.5 * t->diameter;
        c->clear[k] =
            far ? 16 * U * ((reach[k] + reach[next]) * gap + (reach[near] + t->diameter) * length)
                : 24 * U * (most + t->diameter) * length;
    }
}

static const ref_cover_sides *sides_of(const cover_line *line, uint32_t facet)
{
    ref_cover_sides *sides = &line->cover->sides[facet % REF_COVER_KEPT];
    if (sides->facet != facet || sides->search != line->cover->searches) {
        sides_place(line->cuts->target, facet, sides);
        sides->facet = facet;
        sides->search = line->cover->searches;
    }
    return sides;
}

/* 1 if the line certainly meets the candidate, -1 if it certainly does not, 0 if it passes too near
   a side. */
static int line_meets_about(const cover_line *line, const ref_cover_facet *c)
{
    const ref_cover_sides *sides = sides_of(line, c->facet);
    int inside = 1;
    for (int k = 0; k < 3; k++) {
        double left = lrcsi_clip_side(&sides->side[k], line->at);
        double clear = line->way == LINE_GUESSED ? 0 : sides->clear[k];
        if (left < -clear) {
            return -1;
        }
        inside &= left > clear;
    }
    return inside;
}

/* The same for a needle, at the point with the barycentric coordinates line->at. Its position error
   is that of the frame (position_err); sides are decided in double-double. */
static int line_meets_finely(const cover_line *line, const ref_cover_facet *c)
{
    const lrcsi_target *t = line->cuts->target;
    int inside = 1;
    for (int k = 0; k < 3; k++) {
        const double *p = lrcsi_target_corner(t->view, c->facet, k);
        const double *q = lrcsi_target_corner(t->view, c->facet, (k + 1) % 3);
        double left = lrcsi_needle_side(t->needle, p, q, line->at, line->way == LINE_GUESSED);
        if (left < 0) {
            return -1;
        }
        inside &= left > 0;
    }
    return inside;
}

/* 1 if the line misses the candidate, or the candidate is behind the target. This excludes most
   candidates. */
static int line_misses(const cover_line *line, const ref_cover_facet *c)
{
    return lrcsi_view_box_beside(&line->box, &c->box) || c->order == ORDER_BEHIND;
}

/* 1 if the line meets the candidate, -1 if not, 0 if it must be tested in another way. */
static int line_meets(const cover_line *line, ref_cover_facet *c)
{
    if (line->way == LINE_EXACT) {
        return lrcsi_sample_covers(line->cuts->target->view, c->facet, line->point) ? 1 : -1;
    }
    int meets = line->cuts->target->needle ? line_meets_finely(line, c) : line_meets_about(line, c);
    return meets == 0 && line->way == LINE_GUESSED ? -1 : meets;
}

/* Does the candidate hide the target where the line meets it? 1 yes, -1 no, 0 unknown. Two facets
   that are not in contact have the same depth order wherever they overlap. */
static int line_hidden(const cover_line *line, ref_cover_facet *c)
{
    const lrcsi_target *t = line->cuts->target;
    if (c->order == ORDER_NEW) {
        c->order = order_of(line->cuts, c->facet);
    }
    if (c->order == ORDER_PER_LINE && line->way != LINE_PLACED) {
        int nearer = lrcsi_sample_nearer(t->view, c->facet, t->facet, line->point, 1);
        if (line->way == LINE_EXACT && nearer != 0) {
            c->order = nearer > 0 ? ORDER_FRONT : ORDER_BEHIND;
        }
        return nearer;
    }
    if (c->order < line->cuts->count) {
        const ref_cut *cut = &line->cuts->cut[c->order];
        double left = lrcsi_clip_side(&cut->line, line->at);
        double err = line->way == LINE_GUESSED ? 0 : cut->width + line->err;
        double clear = err * (fabs(cut->line.to[0]) + fabs(cut->line.to[1]));
        return left > clear ? 1 : left < -clear ? -1 : 0;
    }
    return c->order == ORDER_FRONT ? 1 : c->order == ORDER_BEHIND ? -1 : 0;
}

/* The point in space that represents a line. Its position error is 100 u of the reach
   (visibility/cells/target.h) and 8 u of the target's coordinates. This is too much for a needle. */
static void line_lift(cover_line *line)
{
    const lrcsi_target *t = line->cuts->target;
    double weight[3];
    double x[3];
    lrcsi_target_weights(t, line->at, weight);
    for (int k = 0; k < 3; k++) {
        line->point[k] = 0;
        for (int i = 0; i < 3; i++) {
            line->point[k] += weight[i] * lrcsi_prepared_corner(t->view->prepared, t->facet, i)[k];
        }
    }
    lrcsi_view_coordinates(t->view, line->point, x);
    line->box = lrcsi_view_box_about(t->view, x, lrcsi_view_point_err(x));
    line->err = t->needle ? HUGE_VAL : lrcsi_target_unproject_err(t);
}

/* The box of the line's position: the target's first corner plus an offset. In a needle the offset
   has the error of the needle's own corners, 10 u of their reach, that of rounding, 3 u, and that
   of the frame (position_err). */
static lrcsi_view_box line_box(const lrcsi_target *t, const double at[2])
{
    double first[3];
    double x[3];
    lrcsi_view_coordinates(t->view, t->origin, first);
    x[2] = first[2];
    double reach = t->needle ? t->needle->reach : t->reach;
    lrcsi_target_to_axes(t, at, x);
    x[0] += first[0];
    x[1] += first[1];
    return lrcsi_view_box_about(
        t->view, x, lrcsi_view_point_err(first) + (16 * U + 2 * t->position_err) * reach);
}

/* Of the components that hide a point, the one that ends at the fewest cuts. */
typedef struct cover_found {
    uint32_t component, ends;
} cover_found;

#define LINE_RETRY (-1)

/* Tests one more candidate. Returns the ref_cover_answer of all candidates so far, or LINE_RETRY if
   the line must be tested in another way. A candidate that hides the whole cell is moved to the
   front of the list. */
static int line_test(const cover_line *line, ref_cover *cover, ref_cover_facet *c, int answer,
                     cover_found *found)
{
    int meets = line_meets(line, c);
    int hidden = meets > 0 ? line_hidden(line, c) : -1;
    if (meets == 0 || (hidden == 0 && c->order == ORDER_PER_LINE && line->way == LINE_PLACED)) {
        return LINE_RETRY;
    }
    if (hidden <= 0) {
        return hidden == 0 && answer == REF_COVER_NONE ? REF_COVER_UNKNOWN : answer;
    }
    if (!lrcsi_meter_take(NULL, line->count)) {
        return REF_COVER_UNKNOWN;
    }
    uint32_t component = cover->classification->component[c->facet];
    uint32_t ends = ref_cuts_of(line->cuts, line->count, component);
    if (ends == 0) {
        ref_cover_facet first = cover->candidate[0];
        cover->candidate[0] = *c;
        *c = first;
        return REF_COVER_ALL;
    }
    if (ends < found->ends) {
        *found = (cover_found){component, ends};
    }
    return REF_COVER_SOME;
}

/* Tests all candidates, with the same result. The meter is charged afterwards, for the candidates
   that were tested. */
static int line_sample(const cover_line *line, ref_cover *cover, uint32_t *component)
{
    cover_found found = {*component, LRCS_NONE};
    int answer = REF_COVER_NONE;
    uint32_t tested = 0;
    while (tested < cover->count && answer != LINE_RETRY && answer != REF_COVER_ALL) {
        ref_cover_facet *c = &cover->candidate[tested++];
        answer = line_misses(line, c) ? answer : line_test(line, cover, c, answer, &found);
    }
    *component = found.component;
    return lrcsi_meter_take(NULL, tested) ? answer : REF_COVER_UNKNOWN;
}

int ref_cover_sample(ref_cover *cover, const ref_cuts *cuts, uint32_t count, ref_cover_place *place,
                     uint32_t *component)
{
    cover_line line = {.cover = cover,
                       .cuts = cuts,
                       .count = count,
                       .at = {place->at[0], place->at[1]},
                       .box = line_box(cuts->target, place->at),
                       .err = cuts->target->position_err};
    int answer = place->clear > 0 ? line_sample(&line, cover, component) : LINE_RETRY;
    if (answer == LINE_RETRY) {
        line_lift(&line);
        line.way = place->clear > line.err ? LINE_EXACT : LINE_GUESSED;
        answer = line_sample(&line, cover, component);
    }
    place->guess = line.way == LINE_GUESSED;
    return answer;
}
