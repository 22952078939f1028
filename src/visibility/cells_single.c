/* SPDX-License-Identifier: MIT */
/* The visible area and pieces of one facet, f, by cells that begin as its triangle. Only the
   visibility of f is decided, which takes less work per cell than the cells of a block do
   (visibility/cells.c).

   The candidates are the facets that may be in front of f. The segments are all lines at which the
   visibility of f can change: the event edges that cross the interior of f and are nearer than f,
   found exactly (visibility/crossing.h); the contacts of f; and the sides of facets in the plane of
   f that hide it. A sample finds which facets are in front of f at a point P of a cell. Let x be
   any other point of the cell.
     (1) If nothing is in front of f at P, and no segment is left in the cell, all of the cell is
   visible: nothing changes on the way from P to x.
     (2) If a facet is in front of f at P, consider its component: all facets connected with it by
   edges that are not events (visibility/classify.h). If no segment is left at which the component
   ends or meets f, the component continues on the way from P to x, and stays in front of f, because
   it would have to intersect f to pass behind it. So f is hidden in all of the cell.
     (3) Otherwise the cell is cut along a segment of the component that has the fewest segments
   left.

   A facet that intersects f may be behind f except in a strip no wider than its error. Within that
   strip it counts as in front of f. The strip can be long; it ends at event edges, which are
   segments like all others. Near the line of the contact it remains undecided whether the facet is
   in front.

   Error. Lines, strips and cells are those of visibility/cells_cut.c, in coordinates from a corner
   of f. The ends of segments have an error of 10 u R, where R is their distance from that corner,
   or the part of it that matters (visibility/target.h); those of contacts have 16 u R and a
   position error. Lines through them have 9 u R more: 32 u R bounds both. All statements hold in
   f's triangle as it is computed, whose area differs from that of f by at most the length of its
   sides times their error.

   A needle may be narrower than these errors. It is divided in barycentric coordinates instead
   (visibility/target.h), in which it is as wide as it is long: its corners are exact except for the
   frame's position error, segments are clipped to a box with coordinates of at most 3, and the side
   of another facet on which a point lies is computed in double-double. Areas are then in units of
   twice the projected area of f. */
#include "visibility/cells_single.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/range.h"
#include "base/work.h"
#include "view/side.h"
#include "visibility/cells_block.h"
#include "visibility/cells_cover.h"
#include "visibility/cells_cut.h"
#include "visibility/contact.h"
#include "visibility/sample.h"

/* Limit on the cells of a facet: a constant, and so many for each segment. */
#define CELLS_CONSTANT    4096u
#define CELLS_PER_SEGMENT 256u
/* The sides of a candidate need better error bounds if its farthest corner is more than this many
   times as far away as its nearest corner and the reach of f together. */
#define FAR_RATIO 64
/* A cell without room for a sample is halved if its area exceeds its perimeter times this many
   distances that a sample must keep from the border: then it is not too narrow for a sample. */
#define NARROW 64
/* It is not halved either if its area is at most this fraction of the area of f: all such cells
   together are then less than 1e-12 of it. */
#define MIN_HALVED 0x1p-52

/* The depth order of a facet against f: one of these, or the number of the segment in which the two
   intersect. */
enum single_order {
    ORDER_NOT_COMPUTED = 0x7ffffff0,
    ORDER_FRONT,    /* nearer, wherever a line meets both */
    ORDER_BEHIND,   /* farther */
    ORDER_DISJOINT, /* it lies beyond a side of f: not a candidate */
    ORDER_UNDECIDED /* they intersect along a line that could not be computed */
};

/* --- what a facet begins with ----------------------------------------------------------------- */

/* May a facet be in front of f? */
static int is_candidate(const lrcsi_cells_single *a, uint32_t other)
{
    return a->listed[other] == a->cells.stamp && a->order[other] != ORDER_DISJOINT;
}

/* The error of a segment in a needle's frame, given the error of its ends. The box reaches 3, so
   that 24 u of 4.5 bounds the rounding of the ends, of the line, and of the distance of a point of
   the needle from the line. An error that is large compared with the margin of the box around the
   needle says nothing: the segment may then be anywhere. */
static double needle_segment_err(double end_err)
{
    return end_err < 0.25 ? 192 * LRCSI_U + 2 * end_err : 4;
}

/* The sides of a facet in f's frame, each with an error: a point nearer than this to the line may
   be on either side of it. The error is 20 u R, where R is the largest distance of the facet's
   corners. For a facet that is narrow or extends far away this is too much. There the line of each
   side begins at n, the nearer of its ends p and q. The error of the side T is 12 u (r_p + r_q),
   rounding included; that of the vector G from n to the point is 12 u r_n + 2 u d, where d is the
   length of f. So T x G has an error of 12 u (r_p + r_q) |G| + (12 u r_n + 2 u d) |T| in the
   1-norm, and a rounding error of 2 u |T| |G|, which is below 3 u (r_p + r_q) |G|. */
static void sides_make(const lrcsi_cells_single *a, uint32_t other, lrcsi_cells_single_side side[3])
{
    const lrcsi_target *frame = &a->frame;
    double corner[3][2];
    double reach[3];
    double length[3];
    for (int k = 0; k < 3; k++) {
        const double *x = lrcsi_target_corner(a->cells.view, other, k);
        reach[k] = lrcsi_target_coordinates(frame, x, corner[k]);
    }
    for (int k = 0; k < 3; k++) {
        const double *to = corner[k == 2 ? 0 : k + 1];
        lrcsi_line_through(corner[k], to, side[k].line);
        length[k] = lrcsi_length_flat(to[0] - corner[k][0], to[1] - corner[k][1]);
    }
    double nearest = lrcsi_min(reach[0], lrcsi_min(reach[1], reach[2]));
    double farthest = lrcsi_max(reach[0], lrcsi_max(reach[1], reach[2]));
    double longest = lrcsi_max(length[0], lrcsi_max(length[1], length[2]));
    double err = 20 * LRCSI_U * farthest;
    double twice = (corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
                   (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]);
    int irregular = !(twice > 16 * err * (longest + 4 * err)) ||
                    farthest > FAR_RATIO * (nearest + frame->reach);
    for (int k = 0; k < 3; k++) {
        int next = k == 2 ? 0 : k + 1;
        int n = reach[k] <= reach[next] ? k : next;
        double gap = fabs(corner[n][0]) + fabs(corner[n][1]) + 1.5 * frame->diameter;
        side[k].err = err;
        if (irregular) {
            double *line = side[k].line;
            line[2] = -(line[0] * corner[n][0] + line[1] * corner[n][1]);
            side[k].err =
                16 * LRCSI_U *
                ((reach[k] + reach[next]) * (gap / length[k]) + reach[n] + frame->diameter);
        }
    }
}

/* The depth order of a facet whose interior does not intersect that of f: from their planes; if
   they are coplanar, from the rules of precedence; otherwise from where they overlap. */
static uint32_t order_of(const lrcsi_cells_single *a, uint32_t other)
{
    const lrcsi_view *view = a->cells.view;
    int order = lrcsi_sample_side(view, other, a->facet);
    if (order == 0) {
        const lrcsi_intersection *contact =
            lrcsi_intersection_find(&view->prepared->intersections, a->facet, other);
        order = contact && !lrcsi_intersection_hides(view, a->facet, contact)
                    ? -1
                    : lrcsi_sample_overlap_order(view, other, a->facet);
    }
    return order > 0 ? ORDER_FRONT : order < 0 ? ORDER_BEHIND : ORDER_UNDECIDED;
}

/* Does another facet lie entirely beyond one side of f? */
static int facet_apart(const lrcsi_cells_single *a, const lrcsi_view_side own[3], uint32_t other)
{
    const lrcsi_view *view = a->cells.view;
    const uint32_t *its = view->prepared->scene->facet[other].corner;
    int apart = 0;
    for (int k = 0; k < 3 && !apart; k++) {
        apart = 1;
        for (int i = 0; i < 3 && apart; i++) {
            const lrcsi_view_vertex *at = &view->point[its[i]];
            apart = view->facing[a->facet] * lrcsi_view_side_orient(&own[k], at->x, at->err) == -1;
        }
    }
    return apart;
}

/* Lists the candidates: facets whose boxes overlap that of f and that are not entirely behind it or
   beyond one of its sides. 0 if the meter is spent. */
static int list_candidates(lrcsi_cells_single *a)
{
    const lrcsi_grid *grid = &a->grid;
    lrcsi_cells_work *c = &a->cells;
    lrcsi_view_box box = *lrcsi_boxes_facet(&grid->boxes, a->facet);
    lrcsi_cells cells = lrcsi_grid_cells(grid, &box);
    const uint32_t *corner = c->view->prepared->scene->facet[a->facet].corner;
    lrcsi_view_side side[3];
    for (int k = 0; k < 3; k++) {
        side[k] = lrcsi_view_side_of(c->view, corner[k], corner[k == 2 ? 0 : k + 1]);
    }
    a->count = 0;
    a->listed[a->facet] = c->stamp;
    a->order[a->facet] = ORDER_DISJOINT;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, cells.x0, cells.x1);
        if (!lrcsi_meter_take(c->meter, items.to - items.from)) {
            return 0;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            uint32_t other = grid->item[i];
            const lrcsi_view_box *its = lrcsi_boxes_facet(&grid->boxes, other);
            if (a->listed[other] == c->stamp || lrcsi_view_box_beside(its, &box) ||
                lrcsi_view_box_behind(its, &box)) {
                continue;
            }
            a->listed[other] = c->stamp;
            a->order[other] = ORDER_DISJOINT;
            if (!facet_apart(a, side, other)) {
                int front = lrcsi_view_box_behind(&box, its);
                a->order[other] = front ? (uint32_t)ORDER_FRONT : (uint32_t)ORDER_NOT_COMPUTED;
                if (a->count < a->side_room) {
                    a->side[a->count][0].err = -1; /* not made yet */
                }
                a->candidate[a->count++] = other;
            }
        }
    }
    return 1;
}

static void segment_ends(lrcsi_cells_segment *e, const double (*end)[2])
{
    for (int n = 0; n < 2; n++) {
        e->end[n][0] = end[n][0];
        e->end[n][1] = end[n][1];
    }
    lrcsi_line_through(end[0], end[1], e->line);
    e->length = lrcsi_length_flat(end[1][0] - end[0][0], end[1][1] - end[0][1]);
    e->line_err = e->err;
}

/* Is neither of an edge's facets in front of f anywhere? */
static int edge_is_behind(lrcsi_cells_single *a, const uint32_t owner[2])
{
    int behind = 1;
    for (int i = 0; i < 2 && behind; i++) {
        if (owner[i] != LRCS_NONE && is_candidate(a, owner[i])) {
            uint32_t *order = &a->order[owner[i]];
            *order = *order == ORDER_NOT_COMPUTED ? order_of(a, owner[i]) : *order;
            behind = *order == ORDER_BEHIND;
        }
    }
    return behind;
}

/* Adds an edge, unless its facets are behind f. 0 if there is no room. */
static int add_single_edge(lrcsi_cells_single *a, uint32_t edge)
{
    lrcsi_cells_work *c = &a->cells;
    const lrcs_prepared *p = c->view->prepared;
    const lrcsi_edge *of = &p->topology.edge[edge];
    lrcsi_cells_segment *e = lrcsi_cells_edge(c, edge);
    if (!e) {
        return 0;
    }
    if (e->edge == LRCS_NONE && edge_is_behind(a, e->owner)) {
        c->segment_count--;
        return 1;
    }
    double end[2][2];
    const double *from = p->vertex[of->low].x;
    const double *to = p->vertex[of->high].x;
    if (a->frame.needle) {
        e->err = needle_segment_err(lrcsi_needle_segment(a->frame.needle, from, to, end));
    } else {
        const double away[2] = {lrcsi_target_coordinates(&a->frame, from, end[0]),
                                lrcsi_target_coordinates(&a->frame, to, end[1])};
        e->err = 32 * LRCSI_U * lrcsi_target_segment(&a->frame, end, away);
    }
    segment_ends(e, (const double(*)[2])end);
    return 1;
}

/* Finds the depth order of a facet that meets the interior of f, and adds the segments due to it. 0
   if there is no room. */
static int add_single_contact(lrcsi_cells_single *a, uint32_t other)
{
    lrcsi_cells_work *c = &a->cells;
    lrcsi_contact contact;
    int side = lrcsi_sample_side(c->view, other, a->facet);
    int kind = side < 0 ? LRCSI_CONTACT_POINT : lrcsi_contact_find(&a->frame, other, &contact);
    a->order[other] = side > 0 ? ORDER_FRONT : side < 0 ? ORDER_BEHIND : ORDER_NOT_COMPUTED;
    if (side == 0 && kind != LRCSI_CONTACT_POINT) {
        a->order[other] = kind == LRCSI_CONTACT_FLAT      ? (uint32_t)ORDER_FRONT
                          : kind == LRCSI_CONTACT_UNKNOWN ? (uint32_t)ORDER_UNDECIDED
                                                          : c->segment_count;
    }
    if (kind == LRCSI_CONTACT_POINT) {
        return 1;
    }
    if (kind == LRCSI_CONTACT_FLAT || kind == LRCSI_CONTACT_UNKNOWN) {
        int done = 1;
        for (int k = 0; k < 3 && done; k++) {
            done = add_single_edge(a, c->view->prepared->topology.facet_edge[other].corner[k]);
        }
        return done;
    }
    lrcsi_cells_segment *e = lrcsi_cells_segment_new(c);
    if (!e) {
        return 0;
    }
    e->err = a->frame.needle ? needle_segment_err(contact.corner_err + contact.position_err)
                             : 32 * LRCSI_U * contact.reach + contact.position_err;
    e->owner[0] = a->facet;
    e->owner[1] = other;
    e->contact = kind;
    segment_ends(e, (const double(*)[2])contact.end);
    return 1;
}

/* Lists the segments. 0 if there is no room, or the meter is spent. */
static int list_single_segments(lrcsi_cells_single *a, lrcsi_cells_cell *cell)
{
    lrcsi_cells_work *c = &a->cells;
    const lrcsi_intersections *intersections = &c->view->prepared->intersections;
    for (uint32_t i = intersections->first[a->facet]; i < intersections->first[a->facet + 1]; i++) {
        const lrcsi_intersection *contact = &intersections->entry[i];
        if (is_candidate(a, contact->other) &&
            lrcsi_intersection_hides(c->view, a->facet, contact) &&
            !add_single_contact(a, contact->other)) {
            return 0;
        }
    }
    lrcsi_crossings_find(&a->classification->search, a->facet, c->meter, &a->crossings);
    for (uint32_t i = 0; i < a->crossings.count; i++) {
        if (!add_single_edge(a, a->crossings.edge[i])) {
            return 0;
        }
    }
    lrcsi_cells_list_segments(c, cell);
    return lrcsi_meter_take(c->meter, (uint64_t)a->count + cell->segments);
}

/* Leaves an area undecided: it counts as half visible. */
static void leave_area_undecided(lrcsi_cells_single *a, double area)
{
    a->uncertainty[0] += 0.5 * area;
    a->uncertainty[1] += 0.5 * area;
}

/* Makes the record of f, the first cell, and the error along the sides of f. 0 if rounding may have
   reversed the triangle's orientation. */
static int make_first_cell(lrcsi_cells_single *a, lrcsi_cells_cell *cell)
{
    lrcsi_cells_work *c = &a->cells;
    lrcsi_cells_facet *f = &a->shape;
    const lrcsi_target *frame = &a->frame;
    double err = frame->needle ? frame->position_err + 8 * LRCSI_U : 20 * LRCSI_U * frame->reach;
    *f = (lrcsi_cells_facet){.err = err, .line_err = err, .number = a->facet};
    lrcsi_clip_triangle((const double(*)[2])frame->corner, &cell->shape);
    lrcsi_clip_box(&cell->shape, f->low, f->high);
    c->extent = lrcsi_max(lrcsi_max(-f->low[0], -f->low[1]), lrcsi_max(f->high[0], f->high[1]));
    for (int k = 0; k < 3; k++) {
        f->x[k] = frame->corner[k][0];
        f->y[k] = frame->corner[k][1];
        lrcsi_line_through(frame->corner[k], frame->corner[(k + 1) % 3], f->side[k]);
    }
    a->border_area = frame->perimeter * (err + 16 * LRCSI_U * c->extent);
    a->negligible = MIN_HALVED * lrcsi_clip_area(&cell->shape);
    cell->facet = c->facets;
    cell->facet[0] = 0;
    cell->facets = 1;
    return lrcsi_clip_area(&cell->shape) > 8 * err * frame->diameter;
}

void lrcsi_cells_single_open(lrcsi_cells_single *a, uint32_t facet)
{
    lrcsi_cells_work *c = &a->cells;
    lrcsi_cells_cell cell = {.cuts = 0};
    a->facet = facet;
    a->uncertainty[0] = a->uncertainty[1] = a->border_area = a->piece_err = 0;
    a->hidden = 0;
    a->wanted = 1;
    lrcsi_target_make(c->view, facet, &a->target);
    lrcsi_target_refine(&a->target, &a->needle, &a->frame);
    a->area = (lrcsi_cells_found){.visible = 0};
    a->moment = (lrcsi_moment){.error = 0};
    c->facet = &a->shape;
    c->area = &a->area;
    c->wanted = &a->wanted;
    c->segment_count = c->top = 0;
    c->stamp++;
    if (!make_first_cell(a, &cell) || !list_candidates(a) || !list_single_segments(a, &cell)) {
        leave_area_undecided(a, lrcsi_view_incidence(c->view, facet).projected / a->frame.unit);
        return;
    }
    a->cells_left = CELLS_CONSTANT + (uint64_t)CELLS_PER_SEGMENT * cell.segments;
    c->stack[0] = cell;
    c->top = 1;
}

/* --- surface components ------------------------------------------------------------------------
 */

/* Does a component end at a segment, or meet f there? */
static int component_ends(const lrcsi_cells_single *a, const lrcsi_cells_segment *e,
                          uint32_t component)
{
    const uint32_t *of = a->classification->component;
    return e->contact ? of[e->owner[1]] == component
                      : lrcsi_cells_segment_has(a->cells.view->prepared, e, of, component);
}

/* Chooses, of a cell's segments, the one whose line passes nearest to a point, so that both parts
   are of similar size. Given a component, only segments at which it ends count. Returns how many
   there are to choose from. */
static uint32_t choose_segment(const lrcsi_cells_single *a, const lrcsi_cells_cell *cell,
                               const double at[2], uint32_t component,
                               const lrcsi_cells_segment **best)
{
    uint32_t count = 0;
    double nearest = HUGE_VAL;
    *best = NULL;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &a->cells.segment[cell->segment[i]];
        if (component == LRCS_NONE || component_ends(a, e, component)) {
            double far = fabs(lrcsi_line_at(e->line, at[0], at[1]));
            count++;
            *best = far < nearest ? e : *best;
            nearest = lrcsi_min(far, nearest);
        }
    }
    return count;
}

/* --- samples ---------------------------------------------------------------------------------- */

/* How the facets at a sample are found: with error bounds, at its point of the frame; exactly, at a
   nearby point in space; or by the signs of rounded values, which is only a guess. */
enum single_test { TEST_BOUNDED, TEST_EXACT, TEST_GUESSED };

/* A sample in a cell. */
typedef struct single_sample {
    double at[2], clear;
    int test; /* an single_test */
    double point[3];
    double err;                     /* the distance in the view between `at` and `point` */
    double view[3];                 /* its coordinates in the view, except for the depth */
    double view_err;                /* their error, each */
    lrcsi_view_box box;             /* around it in the view; its depth does not count */
    uint32_t ends;                  /* of the components in front of f, the fewest segments of the
                                       cell at which one ends or meets f */
    const lrcsi_cells_segment *cut; /* one of these segments */
} single_sample;

/* Finds the sample's point in space from its barycentric coordinates; its coordinates are
   rounded. */
static void sample_unproject(const lrcsi_cells_single *a, single_sample *sample)
{
    const lrcs_prepared *p = a->cells.view->prepared;
    double weight[3];
    lrcsi_target_weights(&a->frame, sample->at, weight);
    for (int k = 0; k < 3; k++) {
        sample->point[k] = 0;
        for (int i = 0; i < 3; i++) {
            sample->point[k] += weight[i] * lrcsi_prepared_corner(p, a->facet, i)[k];
        }
    }
    sample->test = TEST_EXACT;
}

/* Places the sample in the view: f's first corner plus the vector from there. The vector has the
   error of f's own corners, 10 u of their reach, a rounding error of 3 u, and in a needle the
   frame's position error. */
static void sample_place(const lrcsi_cells_single *a, single_sample *sample)
{
    double first[3];
    lrcsi_view_coordinates(a->cells.view, a->target.origin, first);
    lrcsi_target_to_axes(&a->frame, sample->at, sample->view);
    sample->view[0] += first[0];
    sample->view[1] += first[1];
    sample->view[2] = first[2];
    sample->view_err = lrcsi_view_point_err(first) + sample->err +
                       (16 * LRCSI_U + 2 * a->frame.position_err) * a->target.reach;
    sample->box = lrcsi_view_box_about(a->cells.view, sample->view, sample->view_err);
}

/* Does the sample lie beyond a side of a facet, by view coordinates? */
static int sample_is_beyond(const lrcsi_cells_single *a, const single_sample *sample,
                            uint32_t other)
{
    const lrcsi_view *view = a->cells.view;
    const uint32_t *corner = view->prepared->scene->facet[other].corner;
    int beyond = 0;
    for (int k = 0; k < 3 && !beyond; k++) {
        lrcsi_view_side side = lrcsi_view_side_of(view, corner[k], corner[k == 2 ? 0 : k + 1]);
        beyond =
            view->facing[other] * lrcsi_view_side_orient(&side, sample->view, sample->view_err) ==
            -1;
    }
    return beyond;
}

/* The sides of a needle's candidate. */
static void needle_sides_make(const lrcsi_cells_single *a, uint32_t other,
                              lrcsi_cells_single_side side[3])
{
    for (int k = 0; k < 3; k++) {
        side[k].err =
            lrcsi_needle_line(a->frame.needle, lrcsi_target_corner(a->cells.view, other, k),
                              lrcsi_target_corner(a->cells.view, other, (k + 1) % 3), side[k].line);
    }
}

/* Does a candidate cover the sample? 1 certainly, -1 certainly not, 0 the sample is too near a
   side. The sides are computed when they are first needed, and kept as far as there is room. In a
   needle, whose points have the frame's position error, lines in plain doubles nearly always
   suffice. */
static int sides_cover(lrcsi_cells_single *a, const single_sample *sample, uint32_t candidate,
                       double tolerance)
{
    const lrcsi_needle *needle = a->frame.needle;
    const lrcsi_view *view = a->cells.view;
    uint32_t other = a->candidate[candidate];
    if (!needle && sample->test == TEST_EXACT) {
        return lrcsi_sample_covers(view, other, sample->point) ? 1 : -1;
    }
    lrcsi_cells_single_side made[3] = {{.err = -1}};
    lrcsi_cells_single_side *sides = candidate < a->side_room ? a->side[candidate] : made;
    if (sides[0].err < 0 && needle) {
        needle_sides_make(a, other, sides);
    } else if (sides[0].err < 0) {
        sides_make(a, other, sides);
    }
    int inside = 1;
    int guess = sample->test == TEST_GUESSED;
    for (int k = 0; k < 3; k++) {
        double left = lrcsi_line_at(sides[k].line, sample->at[0], sample->at[1]);
        double err = needle ? sides[k].err : guess ? 0 : sides[k].err + tolerance;
        if (needle && !(fabs(left) > err)) {
            left =
                lrcsi_needle_side(needle, lrcsi_target_corner(view, other, k),
                                  lrcsi_target_corner(view, other, (k + 1) % 3), sample->at, guess);
            err = 0;
        }
        if (left < -err) {
            return -1;
        }
        inside &= left > err;
    }
    return guess && !inside ? -1 : inside;
}

/* Does a candidate cover the sample? 1 certainly; -1 certainly not, or it is behind f; 0 the sample
   is too near a side. Boxes exclude most candidates. The depth order, which takes longest, is
   computed last. */
static int candidate_covers(lrcsi_cells_single *a, const single_sample *sample, uint32_t candidate,
                            double tolerance)
{
    uint32_t other = a->candidate[candidate];
    uint32_t *order = &a->order[other];
    if (*order == ORDER_BEHIND ||
        lrcsi_view_box_beside(&sample->box, lrcsi_boxes_facet(&a->grid.boxes, other))) {
        return -1;
    }
    int beyond = a->frame.needle && sample_is_beyond(a, sample, other);
    int covered = beyond ? -1 : sides_cover(a, sample, candidate, tolerance);
    if (covered >= 0 && *order == ORDER_NOT_COMPUTED) {
        *order = order_of(a, other);
    }
    return *order == ORDER_BEHIND ? -1 : covered;
}

/* Is a facet that covers the sample in front of f there? 1 yes, -1 no, 0 it cannot be decided: the
   sample is near the line in which they intersect. */
static int candidate_in_front(const lrcsi_cells_single *a, const single_sample *sample,
                              uint32_t other, double tolerance)
{
    uint32_t order = a->order[other];
    if (order < a->cells.segment_count) {
        const lrcsi_cells_segment *e = &a->cells.segment[order];
        double left = lrcsi_line_at(e->line, sample->at[0], sample->at[1]);
        double w = sample->test == TEST_GUESSED ? 0 : e->err + tolerance + sample->err;
        int side = left > w ? 1 : left < -w ? -1 : 0;
        return e->contact == LRCSI_CONTACT_LINE    ? side
               : e->contact == LRCSI_CONTACT_FRONT ? side * side
                                                   : -side * side;
    }
    return order == ORDER_FRONT ? 1 : order == ORDER_BEHIND ? -1 : 0;
}

/* Is f hidden at a sample? 1 yes, 0 no, -1 it cannot be decided. If it is hidden, sample->cut is
   a segment of the component with the fewest segments in the cell; a component with none ends the
   search. */
static int sample_is_hidden(lrcsi_cells_single *a, const lrcsi_cells_cell *cell,
                            const lrcsi_cells_sides *s, single_sample *sample)
{
    uint32_t last = LRCS_NONE;
    int answer = 0;
    sample->ends = LRCS_NONE;
    for (uint32_t i = 0; i < a->count && sample->ends > 0; i++) {
        uint32_t other = a->candidate[i];
        int covered = candidate_covers(a, sample, i, s->tolerance);
        int front = covered >= 0 ? candidate_in_front(a, sample, other, s->tolerance) : -1;
        uint32_t component = a->classification->component[other];
        if (front < 0 || (answer > 0 && component == last)) {
            continue;
        }
        if (front == 0 || covered == 0) {
            answer = answer > 0 ? answer : -1;
            continue;
        }
        const lrcsi_cells_segment *cut;
        uint32_t ends = choose_segment(a, cell, sample->at, component, &cut);
        if (ends < sample->ends) {
            sample->ends = ends;
            sample->cut = cut;
        }
        last = component;
        answer = 1;
    }
    return answer;
}

/* Takes samples in the cell until one is decided: 1, 0, or -1 as above. If none is decided, *guess
   is set. */
static int find_sample(lrcsi_cells_single *a, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_sides *s, single_sample *sample, int *guess)
{
    double margin = 4 * (cell->widest_strip + a->shape.err + s->tolerance);
    double unproject_err = lrcsi_target_unproject_err(&a->target);
    int answer = -1;
    for (int t = 0; t < LRCSI_CELLS_SAMPLES && answer < 0; t++) {
        *sample = (single_sample){.test = TEST_BOUNDED};
        lrcsi_cells_sample_point(cell, t, sample->at);
        sample->clear = lrcsi_cells_border_distance(s, sample->at);
        if (!(sample->clear > margin)) {
            continue;
        }
        sample_place(a, sample);
        answer = sample_is_hidden(a, cell, s, sample);
        if (answer < 0 && !a->frame.needle && sample->clear > margin + unproject_err) {
            sample_unproject(a, sample);
            sample->err = unproject_err;
            sample_place(a, sample);
            sample->clear -= unproject_err;
            answer = sample_is_hidden(a, cell, s, sample);
        }
    }
    if (answer < 0) {
        *sample = (single_sample){.test = TEST_GUESSED};
        lrcsi_cells_sample_point(cell, 0, sample->at);
        sample_unproject(a, sample);
        sample->test = TEST_GUESSED;
        sample_place(a, sample);
        *guess = sample_is_hidden(a, cell, s, sample) > 0;
    }
    return answer;
}

/* --- one cell --------------------------------------------------------------------------------- */

/* Returns the cell as a visible piece. The corners of a needle's piece are rounded to the frame
   along the view's axes. */
static void add_visible_piece(lrcsi_cells_single *a, const lrcsi_cells_cell *cell,
                              const lrcsi_cells_sides *s)
{
    lrcsi_cells_found *area = &a->area;
    a->piece = cell->shape;
    if (a->frame.needle) {
        for (uint32_t i = 0; i < cell->shape.count; i++) {
            lrcsi_target_to_axes(&a->frame, cell->shape.corner[i], a->piece.corner[i]);
        }
        a->piece_err += 4 * LRCSI_U * a->target.reach * lrcsi_clip_perimeter(&a->piece);
    }
    double(*corner)[2] = a->target.corner;
    const double centre[2] = {(corner[0][0] + corner[1][0] + corner[2][0]) / 3,
                              (corner[0][1] + corner[1][1] + corner[2][1]) / 3};
    double reach = lrcsi_clip_add_moment(&a->piece, centre, a->moment.first);
    a->moment.reach = lrcsi_max(a->moment.reach, reach);
    area->visible += lrcsi_max(0, lrcsi_clip_area(&cell->shape));
    area->visible_err += 4 * s->tolerance * s->perimeter + 5 * LRCSI_U * (cell->shape.count + 3) *
                                                               (s->high[0] - s->low[0]) *
                                                               (s->high[1] - s->low[1]);
}

/* Processes one cell. Returns 1 if it is a visible piece; else it is hidden, cut, or undecided. */
static int process_single_cell(lrcsi_cells_single *a, lrcsi_cells_cell *cell)
{
    lrcsi_cells_work *c = &a->cells;
    lrcsi_cells_sides s;
    single_sample sample;
    lrcsi_cells_sides_make(&cell->shape, lrcsi_cells_tolerance(c, cell), &s);
    lrcsi_cells_filter_segments(c, cell, &s);

    /* 1. A sample. */
    int guess = 0;
    int hidden = find_sample(a, cell, &s, &sample, &guess);
    if (hidden <= 0) {
        sample.ends = choose_segment(a, cell, sample.at, LRCS_NONE, &sample.cut);
    }

    /* 2. If no segment is left that matters, all of the cell is visible or hidden, as the sample.
     */
    if (hidden >= 0 && sample.ends == 0) {
        a->area.uncertainty +=
            cell->uncertainty +
            lrcsi_cells_thin_uncertainty(cell, &s, sample.clear, cell->removed, a->shape.err);
        a->hidden |= hidden;
        if (!hidden) {
            add_visible_piece(a, cell, &s);
        }
        return !hidden;
    }

    /* 3. Otherwise it is cut along a segment. Without one, it is halved unless it is narrow or
       negligible. */
    double narrow = NARROW * (cell->widest_strip + a->shape.err + s.tolerance) * s.perimeter;
    if (sample.cut ? !lrcsi_cells_divide(c, cell, &s, sample.cut)
                   : !(lrcsi_clip_area(&cell->shape) > lrcsi_max(a->negligible, narrow) &&
                       lrcsi_cells_halve(c, cell, &s))) {
        int seen = hidden < 0 ? !guess : !hidden;
        a->uncertainty[seen] += lrcsi_clip_area(&cell->shape);
    }
    return 0;
}

/* --- one facet -------------------------------------------------------------------------------- */

int lrcsi_cells_single_next(lrcsi_cells_single *a)
{
    lrcsi_cells_work *c = &a->cells;
    while (c->top > 0) {
        lrcsi_cells_cell cell = c->stack[--c->top];
        uint64_t steps = (uint64_t)1 + a->count + cell.segments;
        if (a->cells_left == 0 || !lrcsi_meter_take(c->meter, steps)) {
            leave_area_undecided(a, lrcsi_clip_area(&cell.shape));
            continue;
        }
        a->cells_left--;
        if (process_single_cell(a, &cell)) {
            return 1;
        }
    }
    return 0;
}

/* The pieces differ from the visible region by at most `err`, an area, all that is undecided, and
   the error of their corners and of the centroid, 10 u of the target's reach, along the perimeter.
   All of this is within `reach` of the centroid, or in the facet. If all of the facet is visible,
   its moment is 0. */
static void moment_close(lrcsi_cells_single *a, double err)
{
    const lrcsi_target *t = &a->target;
    double undecided = a->uncertainty[0] + a->uncertainty[1];
    double differs = err + undecided + 40 * LRCSI_U * t->reach * t->perimeter;
    double reach = lrcsi_max(a->moment.reach, t->diameter);
    if (a->frame.needle) {
        a->moment.error = HUGE_VAL;
    } else if (a->hidden || undecided > 0) {
        a->moment.error = reach * differs;
    } else {
        a->moment = (lrcsi_moment){.error = reach * differs};
    }
}

lrcsi_visible lrcsi_cells_single_close(lrcsi_cells_single *a)
{
    const lrcsi_cells_found *found = &a->area;
    lrcsi_incidence incidence = lrcsi_view_incidence(a->cells.view, a->facet);
    double whole = incidence.projected;
    double unit = a->frame.unit;
    double err = unit * (a->border_area + found->uncertainty + found->visible_err +
                         64 * LRCSI_U * (found->visible + a->uncertainty[1]));
    double seen = a->hidden || a->uncertainty[0] > 0
                      ? lrcsi_min(whole, unit * (found->visible + a->uncertainty[1]))
                      : whole;
    err += a->frame.needle ? incidence.error * whole : 0;
    moment_close(a, err);
    return (lrcsi_visible){seen, lrcsi_max(0, seen - unit * a->uncertainty[1] - err),
                           lrcsi_min(whole, seen + unit * a->uncertainty[0] + err), 0, 0};
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Room for the sides of so many candidates. */
#define MAX_SIDES 65536u
/* Room for the lists of facets of all cells: of f alone, in each on the stack and twice in the
 * last. */
#define FACET_LISTS (LRCSI_CELLS_STACK + 2)

static uint32_t sides_room(const lrcs_prepared *p)
{
    return p->scene->facet_count < MAX_SIDES ? p->scene->facet_count : MAX_SIDES;
}

/* Each event may cross a facet, and each of its contacts may add the three sides of a facet. */
static size_t max_segments(const lrcs_prepared *p, size_t events)
{
    size_t contacts = 0; /* the most that a facet has */
    for (uint32_t f = 0; p->intersections.count > 0 && f < p->scene->facet_count; f++) {
        size_t count = lrcsi_intersection_of(&p->intersections, f);
        contacts = count > contacts ? count : contacts;
    }
    return events + 3 * contacts;
}

size_t lrcsi_cells_single_need(const lrcs_prepared *p)
{
    size_t segments = max_segments(p, p->topology.edge_count);
    size_t need = lrcsi_work_bytes(sides_room(p), 3 * sizeof(lrcsi_cells_single_side));
    need = lrcsi_work_add(need, 3 * lrcsi_work_bytes(p->scene->facet_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need,
                          lrcsi_work_bytes(segments, LRCSI_CELLS_SEGMENT_LISTS * sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(segments, sizeof(lrcsi_cells_segment)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(FACET_LISTS, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_crossings_need(p));
    return lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELLS_STACK, sizeof(lrcsi_cells_cell)));
}

int lrcsi_cells_single_make(lrcsi_classification *classification, lrcsi_meter *meter,
                            const lrcsi_grid *grid, lrcs_work *work, lrcsi_cells_single *a)
{
    const lrcs_prepared *p = classification->view->prepared;
    uint32_t count = p->scene->facet_count;
    *a = (lrcsi_cells_single){
        .classification = classification, .grid = *grid, .side_room = sides_room(p)};
    lrcsi_cells_work c = {.view = classification->view, .meter = meter};
    c.segment_room = (uint32_t)max_segments(p, classification->events.count);
    a->side = lrcsi_work_take(work, a->side_room, sizeof *a->side);
    a->listed = lrcsi_work_take_zero(work, count, sizeof *a->listed);
    a->order = lrcsi_work_take(work, count, sizeof *a->order);
    a->candidate = lrcsi_work_take(work, count, sizeof *a->candidate);
    c.facets_room = FACET_LISTS;
    c.facets = lrcsi_work_take(work, c.facets_room, sizeof *c.facets);
    c.segments_room = LRCSI_CELLS_SEGMENT_LISTS * (size_t)c.segment_room;
    c.segments = lrcsi_work_take(work, c.segments_room, sizeof *c.segments);
    c.segment = lrcsi_work_take(work, c.segment_room, sizeof *c.segment);
    c.stack = lrcsi_work_take(work, LRCSI_CELLS_STACK, sizeof *c.stack);
    if (!a->side || !a->listed || !a->order || !a->candidate || !c.facets || !c.segments ||
        !c.segment || !c.stack) {
        return LRCS_E_MEMORY;
    }
    a->cells = c;
    return lrcsi_crossings_make(&classification->search, work, &a->crossings);
}
