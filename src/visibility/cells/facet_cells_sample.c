/* SPDX-License-Identifier: MIT */
/* Is one facet, f, hidden at a sample in a cell, and by which surface component? Also, along which
   segment the cell is best cut. What follows for the cell is decided in
   visibility/cells/facet_cells.c. */
#include "visibility/cells/facet_cells_sample.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/range.h"
#include "view/side.h"
#include "visibility/base/sample.h"
#include "visibility/cells/cells_cover.h"
#include "visibility/cells/contact.h"
#include "visibility/cells/facet_cells_candidate.h"

/* The sides of a candidate need better error bounds if its farthest corner is more than this many
   times as far away as its nearest corner and the reach of f together. Heuristic: both bounds hold
   in any case. */
#define FAR_RATIO 64

/* The segment of a cell along which a component ends or meets f, or any segment if it is LRCS_NONE,
   whose line is nearest to the point `at`: *best, NULL if there is none. Returns how many there
   are. A component is a set of marks: the entries of its facets in component[] are its number. */
static uint32_t component_cut(const lrcsi_facet_cells *cells, const lrcsi_cell *cell,
                              const double at[2], uint32_t component,
                              const lrcsi_cells_segment **best)
{
    const lrcsi_marks of_component = {cells->classification->component, component};
    uint32_t count = 0;
    double nearest = HUGE_VAL;
    *best = NULL;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        const lrcsi_cells_segment *e = &cells->division.segment[cell->segment[i]];
        int matters = component == LRCS_NONE ? 1
                      : e->contact
                          ? lrcsi_marked(&of_component, e->owner[1])
                          : lrcsi_division_segment_marked(&cells->division, e, &of_component);
        if (matters) {
            double far = fabs(lrcsi_line_at(e->line, at[0], at[1]));
            count++;
            *best = far < nearest ? e : *best;
            nearest = lrcsi_min(far, nearest);
        }
    }
    return count;
}

/* --- samples ---------------------------------------------------------------------------------- */

/* Finds the sample's point in space from its barycentric coordinates; its coordinates are
   rounded. */
static void sample_unproject(const lrcsi_facet_cells *cells, lrcsi_facet_cells_sample *sample)
{
    const lrcs_prepared *p = cells->division.view->prepared;
    double weight[3];
    lrcsi_target_weights(&cells->frame, sample->at, weight);
    for (int k = 0; k < 3; k++) {
        sample->point[k] = 0;
        for (int i = 0; i < 3; i++) {
            sample->point[k] += weight[i] * lrcsi_prepared_corner(p, cells->facet, i)[k];
        }
    }
    sample->test = LRCSI_TEST_EXACT;
}

/* Places the sample in the view: f's first corner plus the vector from there. The vector has the
   error of f's own corners, 10 u of their reach, a rounding error of 3 u, and in a needle the
   frame's position error. */
static void sample_place(const lrcsi_facet_cells *cells, lrcsi_facet_cells_sample *sample)
{
    double first[3];
    lrcsi_view_coordinates(cells->division.view, cells->target.origin, first);
    lrcsi_target_to_axes(&cells->frame, sample->at, sample->view);
    sample->view[0] += first[0];
    sample->view[1] += first[1];
    sample->view[2] = first[2];
    sample->view_err = lrcsi_view_point_err(first) + sample->err +
                       (16 * LRCSI_U + 2 * cells->frame.position_err) * cells->target.reach;
    sample->box = lrcsi_view_box_about(cells->division.view, sample->view, sample->view_err);
}

/* Does the sample lie beyond a side of a facet, by view coordinates? */
static int sample_is_beyond(const lrcsi_facet_cells *cells, const lrcsi_facet_cells_sample *sample,
                            uint32_t other)
{
    const lrcsi_view *view = cells->division.view;
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

/* The sides of a facet in f's frame, each with an error: a point nearer than this to the line may
   be on either side of it. The error is 20 u R, where R is the largest distance of the facet's
   corners. For a facet that is narrow or extends far away this is too much. There the line of each
   side begins at n, the nearer of its ends p and q. The error of the side T is 12 u (r_p + r_q),
   rounding included; that of the vector G from n to the point is 12 u r_n + 2 u d, where d is the
   length of f. So T x G has an error of 12 u (r_p + r_q) |G| + (12 u r_n + 2 u d) |T| in the
   1-norm, and a rounding error of 2 u |T| |G|, which is below 3 u (r_p + r_q) |G|. */
static void sides_make(const lrcsi_facet_cells *cells, uint32_t other,
                       lrcsi_facet_cells_side side[3])
{
    const lrcsi_target *frame = &cells->frame;
    const lrcsi_view *view = cells->division.view;
    double corner[3][2];
    double reach[3];
    double length[3];
    for (int k = 0; k < 3 && frame->needle; k++) {
        const double *from = lrcsi_target_corner(view, other, k);
        const double *to = lrcsi_target_corner(view, other, (k + 1) % 3);
        side[k].err = lrcsi_needle_line(frame->needle, from, to, side[k].line);
    }
    if (frame->needle) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        const double *x = lrcsi_target_corner(view, other, k);
        reach[k] = lrcsi_target_coordinates(frame, x, corner[k]);
    }
    for (int k = 0; k < 3; k++) {
        const double *to = corner[k == 2 ? 0 : k + 1];
        lrcsi_line_through(corner[k], to, side[k].line);
        length[k] = lrcsi_length_flat(to[0] - corner[k][0], to[1] - corner[k][1]);
    }
    double nearest = lrcsi_min3(reach[0], reach[1], reach[2]);
    double farthest = lrcsi_max3(reach[0], reach[1], reach[2]);
    double longest = lrcsi_max3(length[0], length[1], length[2]);
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

/* Does a candidate cover the sample? 1 certainly, -1 certainly not, 0 the sample is too near a
   side. The sides are computed when they are first needed (sides[0].err < 0). In a needle, whose
   points have the frame's position error, lines in plain doubles nearly always suffice. */
static int sides_cover(lrcsi_facet_cells *cells, const lrcsi_facet_cells_sample *sample,
                       uint32_t other, lrcsi_facet_cells_side sides[3], double tolerance)
{
    const lrcsi_needle *needle = cells->frame.needle;
    const lrcsi_view *view = cells->division.view;
    if (sample->test == LRCSI_TEST_EXACT) { /* not in a needle */
        return lrcsi_sample_covers(view, other, sample->point) ? 1 : -1;
    }
    if (sides[0].err < 0) {
        sides_make(cells, other, sides);
    }
    int inside = 1;
    int guess = sample->test == LRCSI_TEST_GUESSED;
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

/* Is a facet that covers the sample in front of f there? 1 yes, -1 no, 0 it cannot be decided: the
   sample is near the line in which they intersect. */
static int candidate_in_front(const lrcsi_facet_cells *cells,
                              const lrcsi_facet_cells_sample *sample, uint32_t other,
                              double tolerance)
{
    int order = cells->order[other];
    if (order == LRCSI_ORDER_CONTACT) {
        const lrcsi_cells_segment *e = &cells->division.segment[cells->contact[other]];
        double left = lrcsi_line_at(e->line, sample->at[0], sample->at[1]);
        double w = sample->test == LRCSI_TEST_GUESSED ? 0 : e->err + tolerance + sample->err;
        int side = left > w ? 1 : left < -w ? -1 : 0;
        return e->contact == LRCSI_CONTACT_LINE    ? side
               : e->contact == LRCSI_CONTACT_FRONT ? side * side
                                                   : -side * side;
    }
    return order == LRCSI_ORDER_FRONT ? 1 : order == LRCSI_ORDER_BEHIND ? -1 : 0;
}

/* Is f hidden at a sample, as far as it is known? */
typedef struct sample_answer {
    int hidden;    /* 1 yes, 0 no, -1 it cannot be decided */
    uint32_t last; /* the component last found in front of f; LRCS_NONE: none */
} sample_answer;

/* Includes one candidate in the answer. `sides`: where its sides are kept; NULL: they are not.
   Boxes exclude most candidates, and view coordinates most of those whose sides in f's frame would
   have to be computed for this sample. The depth order, which takes longest, is computed last. */
static void sample_compare(lrcsi_facet_cells *cells, const lrcsi_cell *cell, double tolerance,
                           uint32_t other, lrcsi_facet_cells_side sides[3],
                           lrcsi_facet_cells_sample *sample, sample_answer *answer)
{
    uint32_t component = cells->classification->component[other];
    unsigned char *order = &cells->order[other];
    if (*order == LRCSI_ORDER_BEHIND ||
        lrcsi_view_box_beside(&sample->box, lrcsi_boxes_facet(&cells->grid.boxes, other)) ||
        ((cells->frame.needle || !sides) && sample_is_beyond(cells, sample, other))) {
        return;
    }
    lrcsi_facet_cells_side not_kept[3] = {{.err = -1}};
    int covered = sides_cover(cells, sample, other, sides ? sides : not_kept, tolerance);
    if (covered >= 0 && *order == LRCSI_ORDER_NOT_COMPUTED) {
        *order = (unsigned char)lrcsi_facet_cells_order(cells, other);
    }
    int front = covered >= 0 ? candidate_in_front(cells, sample, other, tolerance) : -1;
    if (front < 0 || (answer->hidden > 0 && component == answer->last)) {
        return;
    }
    if (front == 0 || covered == 0) {
        answer->hidden = answer->hidden > 0 ? answer->hidden : -1;
        return;
    }
    const lrcsi_cells_segment *cut;
    uint32_t ends = component_cut(cells, cell, sample->at, component, &cut);
    if (ends < sample->ends) {
        sample->ends = ends;
        sample->cut = cut;
    }
    *answer = (sample_answer){1, component};
}

/* Is f hidden at a sample? 1 yes, 0 no, -1 it cannot be decided, or the meter is spent. If it is
   hidden, sample->cut is a segment of the component with the fewest segments in the cell; a
   component with none ends the search. A large facet may have many candidates, but few at any
   point: if there are more than those of which the sides are kept, only those that the grid lists
   at the sample are compared, unless they are even more. What covers the sample is listed: the
   sample lies in f and in its own box, and the lists of the buckets of f's box are complete. */
static int sample_is_hidden(lrcsi_facet_cells *cells, const lrcsi_cell *cell, double tolerance,
                            lrcsi_facet_cells_sample *sample)
{
    const lrcsi_grid *grid = &cells->grid;
    lrcsi_grid_rect buckets = lrcsi_grid_buckets(grid, &sample->box);
    lrcsi_meter *meter = cells->division.meter;
    const uint32_t all = cells->candidate_count;
    uint32_t listed = LRCS_NONE;
    sample_answer answer = {0, LRCS_NONE};
    sample->ends = LRCS_NONE;
    if (all > cells->side_room && lrcsi_meter_take(meter, buckets.y1 - buckets.y0)) {
        listed = lrcsi_grid_listed(grid, buckets);
    }
    if (!lrcsi_meter_take(meter, listed < all ? listed : all)) {
        return -1;
    }
    for (uint32_t i = 0; i < all && listed >= all && sample->ends > 0; i++) {
        sample_compare(cells, cell, tolerance, cells->candidate[i],
                       i < cells->side_room ? cells->side[i] : NULL, sample, &answer);
    }
    for (lrcsi_grid_items items; listed < all && lrcsi_grid_next_row(grid, &buckets, &items);) {
        for (uint32_t i = items.from; i < items.to && sample->ends > 0; i++) {
            if (lrcsi_facet_cells_is_candidate(cells, grid->item[i])) {
                sample_compare(cells, cell, tolerance, grid->item[i], NULL, sample, &answer);
            }
        }
    }
    return answer.hidden;
}

void lrcsi_facet_cells_sample_take(lrcsi_facet_cells *cells, const lrcsi_cell *cell,
                                   const lrcsi_clip_sides *s, lrcsi_facet_cells_sample *sample)
{
    double margin = 4 * (cell->widest_strip + cells->division.facet_err + s->tolerance);
    double unproject_err = lrcsi_target_unproject_err(&cells->target);
    int hidden = -1;
    for (int t = 0; t < LRCSI_SAMPLES && hidden < 0; t++) {
        *sample = (lrcsi_facet_cells_sample){.test = LRCSI_TEST_BOUNDED};
        lrcsi_cells_sample_point(cell, t, sample->at);
        sample->border_distance = lrcsi_clip_border_distance(s, sample->at);
        if (!(sample->border_distance > margin)) {
            continue;
        }
        sample_place(cells, sample);
        hidden = sample_is_hidden(cells, cell, s->tolerance, sample);
        if (hidden < 0 && !cells->frame.needle &&
            sample->border_distance > margin + unproject_err) {
            sample_unproject(cells, sample);
            sample->err = unproject_err;
            sample_place(cells, sample);
            sample->border_distance -= unproject_err;
            hidden = sample_is_hidden(cells, cell, s->tolerance, sample);
        }
    }
    int guess = hidden;
    if (hidden < 0) {
        *sample = (lrcsi_facet_cells_sample){.test = LRCSI_TEST_GUESSED};
        lrcsi_cells_sample_point(cell, 0, sample->at);
        sample_place(cells, sample);
        guess = sample_is_hidden(cells, cell, s->tolerance, sample) > 0;
    }
    sample->hidden = hidden;
    sample->guess = guess;
    if (hidden <= 0) {
        sample->ends = component_cut(cells, cell, sample->at, LRCS_NONE, &sample->cut);
    }
}
