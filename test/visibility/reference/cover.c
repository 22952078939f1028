/* SPDX-License-Identifier: MIT */
/* One line of sight through a facet, against the facets near it. All decisions are exact but the
   place of the line, which is the caller's to keep away from what divides.

   Let a component hide the point, and none of the events of a cell be one where it ends. Along any
   path in the cell, apart from the cuts, the component goes on (visibility/classify.h) and stays in
   front: to pass behind it would have to touch the target. So it hides all of the cell.

   A line is held against candidates in the frame first, in doubles: away from their sides that is
   sure, and good to the target's own size. Where it passes too near a side, all of them are asked
   again, exactly, at a point in space nearby: so that of two that share the side it meets one. */
#include "visibility/reference/cover.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/contact.h"
#include "visibility/sample.h"

#define U 0x1p-53

/* A candidate against the target: one of these, or the number of the cut in which they touch. */
enum cover_order {
    ORDER_NEW = 0x7ffffff0, /* not looked at yet */
    ORDER_FRONT,            /* nearer, wherever a line meets both */
    ORDER_BEHIND,           /* farther */
    ORDER_ASKED,            /* cannot be told but on a line that meets both */
    ORDER_UNKNOWN           /* touches, in a line that is not known */
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
    cover->asked = lrcsi_work_take_zero(work, count, sizeof *cover->asked);
    cover->candidate = lrcsi_work_take(work, count, sizeof *cover->candidate);
    cover->sides = lrcsi_work_take_zero(work, REF_COVER_KEPT, sizeof *cover->sides);
    return cover->asked && cover->candidate && cover->sides ? LRCS_OK : LRCS_E_MEMORY;
}

/* --- candidates ------------------------------------------------------------------------------- */

void ref_cover_start(ref_cover *cover, const lrcsi_target *target)
{
    const lrcsi_grid *facets = &cover->facets;
    lrcsi_view_box box = *lrcsi_boxes_facet(&facets->boxes, target->facet);
    lrcsi_grid_rect cells = lrcsi_grid_cells(facets, &box);
    cover->count = 0;
    cover->asks++;
    cover->asked[target->facet] = cover->asks;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = facets->first[(size_t)y * facets->size + cells.x0];
        uint32_t end = facets->first[(size_t)y * facets->size + cells.x1];
        if (!lrcsi_meter_take(NULL, end - i)) {
            return;
        }
        for (; i < end; i++) {
            uint32_t other = facets->item[i];
            if (cover->asked[other] == cover->asks) {
                continue;
            }
            cover->asked[other] = cover->asks;
            const lrcsi_view_box *its = lrcsi_boxes_facet(&facets->boxes, other);
            if (!lrcsi_view_box_beside(its, &box) && !lrcsi_view_box_behind(its, &box)) {
                cover->candidate[cover->count++] =
                    (ref_cover_facet){.box = *its, .facet = other, .order = ORDER_NEW};
            }
        }
    }
}

/* The order of two facets neither of which lies on one side of the other's plane. Of those that
   touch, the cut tells; in one plane the rules of precedence decide, and one that is beaten has no
   cut. */
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
    return order > 0 ? ORDER_FRONT : order < 0 ? ORDER_BEHIND : ORDER_ASKED;
}

/* ORDER_NEW where the meter is spent. */
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

/* How a line is held against the candidates. */
enum line_way {
    LINE_PLACED, /* as its place in the frame, where that is clear of all sides */
    LINE_EXACT,  /* as a point in space near that, exactly */
    LINE_GUESSED /* as its place, rounded */
};

typedef struct cover_line {
    const ref_cover *cover;
    const ref_cuts *cuts;
    uint32_t count; /* of their list, that may divide what the line stands for */
    int way;
    double at[2];       /* in the target's frame */
    lrcsi_view_box box; /* in the view; its depth does not count */
    double point[3];    /* in space */
    double off;         /* by which that may be elsewhere in the frame */
} cover_line;

/* A candidate this many times as far as the target is long and its nearest corner is away counts as
   far. */
#define FAR_CANDIDATE 64.0

/* Sides in the frame, with how near to one a place must be that its side of it is not sure.

   A corner at distance r is off by e = 10 u r. So the candidate as computed is the true one but for
   the largest e, the side of a line is told wrong within 4 u (r + d) of it, d the target's
   diameter, and a place that is farther than both from a side is out of both, or in both if it is
   so far inside all three.

   Where one corner is far away that would be too coarse. There each side tells which side of its
   own line a place is on. Let T be the side from p to q, n the nearer of the two, G the place as
   seen from n. T is off by 12 u (r_p + r_q), rounding included, G by 12 u r_n + 2 u d, so T x G by
   12 u (r_p + r_q) |G| + (12 u r_n + 2 u d) |T| in the 1-norm, and by its own rounding, 2 u |T|
   |G|, below 3 u (r_p + r_q) |G|. */
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
    if (sides->facet != facet || sides->ask != line->cover->asks) {
        sides_place(line->cuts->target, facet, sides);
        sides->facet = facet;
        sides->ask = line->cover->asks;
    }
    return sides;
}

/* 1 the line surely meets the candidate, -1 surely not, 0 it passes too near a side. */
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

/* The same in a needle, at the point that has these shares: it is off its place by the frame's
   slip, and sides are told in double-double. */
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

/* Does the line pass the candidate by, or is that one behind? Most are told so. */
static int line_misses(const cover_line *line, const ref_cover_facet *c)
{
    return lrcsi_view_box_beside(&line->box, &c->box) || c->order == ORDER_BEHIND;
}

/* 1 the line meets the candidate, -1 not, 0 it must be asked another way. */
static int line_meets(const cover_line *line, ref_cover_facet *c)
{
    if (line->way == LINE_EXACT) {
        return lrcsi_sample_covers(line->cuts->target->view, c->facet, line->point) ? 1 : -1;
    }
    int meets = line->cuts->target->needle ? line_meets_finely(line, c) : line_meets_about(line, c);
    return meets == 0 && line->way == LINE_GUESSED ? -1 : meets;
}

/* Is the target hidden where the line meets the candidate? 1 yes, -1 no, 0 unknown. Two facets that
   do not touch keep their order wherever they overlap. */
static int line_hidden(const cover_line *line, ref_cover_facet *c)
{
    const lrcsi_target *t = line->cuts->target;
    if (c->order == ORDER_NEW) {
        c->order = order_of(line->cuts, c->facet);
    }
    if (c->order == ORDER_ASKED && line->way != LINE_PLACED) {
        int nearer = lrcsi_sample_nearer(t->view, c->facet, t->facet, line->point, 1);
        if (line->way == LINE_EXACT && nearer != 0) {
            c->order = nearer > 0 ? ORDER_FRONT : ORDER_BEHIND;
        }
        return nearer;
    }
    if (c->order < line->cuts->count) {
        const ref_cut *cut = &line->cuts->cut[c->order];
        double left = lrcsi_clip_side(&cut->line, line->at);
        double off = line->way == LINE_GUESSED ? 0 : cut->width + line->off;
        double clear = off * (fabs(cut->line.to[0]) + fabs(cut->line.to[1]));
        return left > clear ? 1 : left < -clear ? -1 : 0;
    }
    return c->order == ORDER_FRONT ? 1 : c->order == ORDER_BEHIND ? -1 : 0;
}

/* The point that stands for a line in space. It is off by 100 u of the reach (visibility/target.h),
   and by 8 u of the target's coordinates; in a needle that is too much. */
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
    line->off = t->needle ? HUGE_VAL : lrcsi_target_unproject_err(t);
}

/* The line as its place: the target's first corner and the way from there, which in a needle is off
   by its own corners, 10 u of their reach, by rounding, 3 u, and by the frame's slip. */
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

#define LINE_AGAIN (-1)

/* One candidate more: what is known then, a ref_cover_answer, or LINE_AGAIN where the line must
   be asked another way. One that hides all of a cell comes to stand first. */
static int line_ask(const cover_line *line, ref_cover *cover, ref_cover_facet *c, int answer,
                    cover_found *found)
{
    int meets = line_meets(line, c);
    int hidden = meets > 0 ? line_hidden(line, c) : -1;
    if (meets == 0 || (hidden == 0 && c->order == ORDER_ASKED && line->way == LINE_PLACED)) {
        return LINE_AGAIN;
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

/* What hides the target on a line, likewise. Candidates are counted once they have been asked. */
static int line_tells(const cover_line *line, ref_cover *cover, uint32_t *component)
{
    cover_found found = {*component, LRCS_NONE};
    int answer = REF_COVER_NONE;
    uint32_t asked = 0;
    while (asked < cover->count && answer != LINE_AGAIN && answer != REF_COVER_ALL) {
        ref_cover_facet *c = &cover->candidate[asked++];
        answer = line_misses(line, c) ? answer : line_ask(line, cover, c, answer, &found);
    }
    *component = found.component;
    return lrcsi_meter_take(NULL, asked) ? answer : REF_COVER_UNKNOWN;
}

int ref_cover_sample(ref_cover *cover, const ref_cuts *cuts, uint32_t count, ref_cover_place *place,
                     uint32_t *component)
{
    cover_line line = {.cover = cover,
                       .cuts = cuts,
                       .count = count,
                       .at = {place->at[0], place->at[1]},
                       .box = line_box(cuts->target, place->at),
                       .off = cuts->target->position_err};
    int answer = place->clear > 0 ? line_tells(&line, cover, component) : LINE_AGAIN;
    if (answer == LINE_AGAIN) {
        line_lift(&line);
        line.way = place->clear > line.off ? LINE_EXACT : LINE_GUESSED;
        answer = line_tells(&line, cover, component);
    }
    place->guess = line.way == LINE_GUESSED;
    return answer;
}
