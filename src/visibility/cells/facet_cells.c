/* SPDX-License-Identifier: MIT */
/* The visible area and pieces of one facet, f, by cells that begin as its triangle. Only the
   visibility of f is decided, which takes less work per cell than the cells of a block do
   (visibility/cells/cells.c).

   The candidates are the facets that may be in front of f. The segments are all lines at which the
   visibility of f can change: the event edges that cross the interior of f and are nearer than f,
   found exactly (visibility/uniform/crossing.h); the contacts of f; and the sides of facets in the
   plane of f that hide it (visibility/cells/facet_cells_candidate.c). A sample finds which facets
   are in front of f at a point P of a cell (visibility/cells/facet_cells_sample.c). Let x be any
   other point of the cell.

   (1) If nothing is in front of f at P, and no segment is left in the cell, all of the cell is
   visible: nothing changes on the way from P to x.

   (2) If a facet is in front of f at P, consider its component: all facets connected with it by
   edges that are not events (visibility/uniform/classify.h). If no segment is left at which the
   component ends or meets f, the component continues on the way from P to x, and stays in front of
   f, because it would have to intersect f to pass behind it. So f is hidden in all of the cell.

   (3) Otherwise the cell is cut along a segment of the component that has the fewest segments left.

   A facet that intersects f may be behind f except in a strip no wider than its error. Within that
   strip it counts as in front of f. The strip can be long; it ends at event edges, which are
   segments like all others. Near the line of the contact it remains undecided whether the facet is
   in front.

   Error. Lines, strips and cells are those of visibility/cells/cells_cut.c, in coordinates from a
   corner of f. The ends of segments have an error of 10 u R, where R is their distance from that
   corner, or the part of it that matters (visibility/cells/target.h); those of contacts have 16 u R
   and a position error. Lines through them have 9 u R more: 32 u R bounds both. All statements hold
   in f's triangle as it is computed, whose area differs from that of f by at most the length of its
   sides times their error.

   A needle may be narrower than these errors. It is divided in barycentric coordinates instead
   (visibility/cells/target.h), in which it is as wide as it is long: its corners are exact except
   for the frame's position error, segments are clipped to the box -1 .. 2, and the side of another
   facet on which a point lies is computed in double-double. Areas are then in units of twice the
   projected area of f. */
#include "visibility/cells/facet_cells.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/cells/cells_cut.h"
#include "visibility/cells/facet_cells_candidate.h"
#include "visibility/cells/facet_cells_sample.h"

/* Limit on the cells of a facet: a constant, and so many for each segment. Heuristic: what is left
   is counted as undecided. */
#define CELLS_CONSTANT    4096u
#define CELLS_PER_SEGMENT 256u
/* A cell without room for a sample is halved if its area exceeds its perimeter times this many
   distances that a sample must keep from the border: then it is not too narrow for a sample. This
   and the next are heuristic: a cell that is not halved stays undecided. */
#define NARROW 64
/* It is not halved either if its area is at most this fraction of the area of f: 4096 such cells,
   more than a facet ordinarily has, are then less than 1e-12 of it. */
#define MIN_HALVED 0x1p-52

/* --- the first cell --------------------------------------------------------------------------- */

/* Leaves an area undecided: it counts as half visible. */
static void leave_area_undecided(lrcsi_facet_cells *cells, double area)
{
    cells->perhaps_hidden += 0.5 * area;
    cells->perhaps_visible += 0.5 * area;
}

/* 1. Makes the frame of f. 2. Makes the record of f, the first cell, and the error along the sides
   of f. 3. Lists what may hide f, unless rounding may have reversed the triangle's orientation. */
void lrcsi_facet_cells_open(lrcsi_facet_cells *cells, uint32_t facet)
{
    lrcsi_division *d = &cells->division;
    const lrcsi_target *frame = &cells->frame;
    lrcsi_cells_facet *f = &cells->shape;
    lrcsi_cell cell = {.cuts = 0};
    cells->facet = facet;
    lrcsi_target_make(d->view, facet, &cells->target);
    lrcsi_target_refine(&cells->target, &cells->needle, &cells->frame);

    double err = frame->needle ? frame->position_err + 8 * LRCSI_U : 20 * LRCSI_U * frame->reach;
    *f = (lrcsi_cells_facet){.err = err, .line_err = err, .facet = facet};
    lrcsi_clip_triangle((const double(*)[2])frame->corner, &cell.shape);
    lrcsi_clip_box(&cell.shape, f->low, f->high);
    for (int k = 0; k < 3; k++) {
        f->x[k] = frame->corner[k][0];
        f->y[k] = frame->corner[k][1];
        lrcsi_line_through(frame->corner[k], frame->corner[(k + 1) % 3], f->side[k]);
    }
    cells->wanted = 1;
    cells->area = (lrcsi_cell_area){.visible_err = 0};
    d->facet = f;
    d->area = &cells->area;
    d->wanted = &cells->wanted;
    d->facet_err = err;
    d->extent = lrcsi_max3(lrcsi_max(-f->low[0], -f->low[1]), f->high[0], f->high[1]);
    d->segment_count = d->stack_count = 0;
    cell.facet = d->facet_lists;
    cell.facet[0] = 0;
    cell.facet_count = 1;
    cells->moment = (lrcsi_moment){.error = 0};
    cells->reach = 0;
    cells->perhaps_hidden = cells->perhaps_visible = cells->piece_err = 0;
    cells->hidden = 0;
    cells->border_area = frame->perimeter * (err + 16 * LRCSI_U * d->extent);
    cells->halved_area = MIN_HALVED * lrcsi_clip_area(&cell.shape);

    if (!(lrcsi_clip_area(&cell.shape) > 8 * err * frame->diameter) ||
        !lrcsi_facet_cells_candidates(cells) || !lrcsi_facet_cells_segments(cells)) {
        leave_area_undecided(cells, lrcsi_view_incidence(d->view, facet).projected / frame->unit);
        return;
    }
    lrcsi_division_start(d, &cell);
    cells->cells_left = CELLS_CONSTANT + (uint64_t)CELLS_PER_SEGMENT * cell.segment_count;
}

/* --- one cell --------------------------------------------------------------------------------- */

/* The area of a cell that is left undecided. Adds its error, and what is uncertain near the cell.
   */
static double undecided_area(lrcsi_facet_cells *cells, const lrcsi_cell *cell)
{
    double low[2];
    double high[2];
    lrcsi_clip_box(&cell->shape, low, high);
    const double wide = high[0] - low[0];
    const double tall = high[1] - low[1];
    cells->area.uncertainty +=
        cell->uncertainty + 4 * lrcsi_division_tolerance(&cells->division, cell) * (wide + tall) +
        5 * LRCSI_U * (cell->shape.count + 3) * wide * tall;
    return lrcsi_max(0, lrcsi_clip_area(&cell->shape));
}

/* Returns the cell as a visible piece. The corners of a needle's piece are rounded to the frame
   along the view's axes. */
static void add_visible_piece(lrcsi_facet_cells *cells, const lrcsi_cell *cell,
                              const lrcsi_clip_sides *s)
{
    lrcsi_cell_area *area = &cells->area;
    cells->piece = cell->shape;
    if (cells->frame.needle) {
        for (uint32_t i = 0; i < cell->shape.count; i++) {
            lrcsi_target_to_axes(&cells->frame, cell->shape.corner[i], cells->piece.corner[i]);
        }
        cells->piece_err +=
            4 * LRCSI_U * cells->target.reach * lrcsi_clip_box_perimeter(&cells->piece);
    }
    double(*corner)[2] = cells->target.corner;
    const double centre[2] = {(corner[0][0] + corner[1][0] + corner[2][0]) / 3,
                              (corner[0][1] + corner[1][1] + corner[2][1]) / 3};
    double reach = lrcsi_clip_add_moment(&cells->piece, centre, &cells->moment);
    cells->reach = lrcsi_max(cells->reach, reach);
    lrcsi_sum_add(&area->visible, lrcsi_max(0, lrcsi_clip_area(&cell->shape)));
    area->visible_err += 4 * s->tolerance * s->perimeter + 5 * LRCSI_U * (cell->shape.count + 3) *
                                                               (s->high[0] - s->low[0]) *
                                                               (s->high[1] - s->low[1]);
}

/* Processes one cell. Returns 1 if it is a visible piece; else it is hidden, cut, or undecided. */
static int process_facet_cell(lrcsi_facet_cells *cells, lrcsi_cell *cell)
{
    lrcsi_division *d = &cells->division;
    lrcsi_clip_sides s;
    lrcsi_facet_cells_sample sample;
    lrcsi_clip_sides_make(&cell->shape, lrcsi_division_tolerance(d, cell), &s);
    lrcsi_cells_filter_segments(d, cell, &s);

    /* 1. A sample. */
    lrcsi_facet_cells_sample_take(cells, cell, &s, &sample);

    /* 2. If no segment is left that matters, all of the cell is visible or hidden, as the sample.
     */
    if (sample.hidden >= 0 && sample.ends == 0) {
        cells->area.uncertainty +=
            cell->uncertainty + lrcsi_cells_thin_uncertainty(cell, &s, sample.border_distance,
                                                             cell->removed, d->facet_err);
        cells->hidden |= sample.hidden;
        if (!sample.hidden) {
            add_visible_piece(cells, cell, &s);
        }
        return !sample.hidden;
    }

    /* 3. Otherwise it is cut along a segment. Without one, it is halved unless it is narrow or
       negligible. */
    double narrow = NARROW * (cell->widest_strip + d->facet_err + s.tolerance) * s.perimeter;
    if (sample.cut ? !lrcsi_cells_divide(d, cell, &s, sample.cut, NULL)
                   : !(lrcsi_clip_area(&cell->shape) > lrcsi_max(cells->halved_area, narrow) &&
                       lrcsi_cells_halve(d, cell, &s))) {
        double *perhaps = sample.guess ? &cells->perhaps_hidden : &cells->perhaps_visible;
        *perhaps += undecided_area(cells, cell);
    }
    return 0;
}

/* --- one facet -------------------------------------------------------------------------------- */

int lrcsi_facet_cells_next(lrcsi_facet_cells *cells)
{
    lrcsi_division *d = &cells->division;
    while (d->stack_count > 0) {
        lrcsi_cell cell;
        lrcsi_cell_copy(&d->stack[--d->stack_count], &cell);
        uint64_t steps = (uint64_t)1 + cell.segment_count; /* samples count theirs */
        if (cells->cells_left == 0 || !lrcsi_meter_take(d->meter, steps)) {
            leave_area_undecided(cells, undecided_area(cells, &cell));
            continue;
        }
        cells->cells_left--;
        if (process_facet_cell(cells, &cell)) {
            return 1;
        }
    }
    return 0;
}

/* The pieces, of area `sum`, differ from the visible region by at most `err`, an area, which
   includes the rounding errors of areas, all that is undecided, and the error of their corners and
   of the centroid, 10 u of the target's reach, along the perimeter. The rounding errors of
   distances from the centroid are below 64 u of `reach`, and its error moves the moment by that
   times the area. If all of the facet is visible, its moment is 0. */
static void moment_close(lrcsi_facet_cells *cells, double sum, double err)
{
    const lrcsi_target *t = &cells->target;
    double undecided = (cells->perhaps_hidden + cells->perhaps_visible) * LRCSI_OUTWARD_MICRO;
    if (cells->frame.needle) {
        cells->moment.error = HUGE_VAL;
    } else if (!(cells->hidden || undecided > 0)) {
        cells->moment = (lrcsi_moment){.error = 0};
    }
    cells->moment.area_err = err + undecided + 40 * LRCSI_U * t->reach * t->perimeter;
    cells->moment.error += 64 * LRCSI_U * sum * (lrcsi_max(cells->reach, t->diameter) + t->reach);
}

lrcsi_visible_area lrcsi_facet_cells_close(lrcsi_facet_cells *cells)
{
    const lrcsi_cell_area *found = &cells->area;
    lrcsi_incidence incidence = lrcsi_view_incidence(cells->division.view, cells->facet);
    double whole = incidence.projected;
    double unit = cells->frame.unit;
    double perhaps_hidden = cells->perhaps_hidden * LRCSI_OUTWARD_MICRO; /* of sums over cells */
    double perhaps_visible = cells->perhaps_visible * LRCSI_OUTWARD_MICRO;
    double sum = lrcsi_sum_value(&found->visible) + perhaps_visible;
    double err = cells->border_area + found->uncertainty + found->visible_err + 64 * LRCSI_U * sum;
    err *= unit * LRCSI_OUTWARD_MICRO;
    double visible = cells->hidden || perhaps_hidden > 0 ? lrcsi_min(whole, unit * sum) : whole;
    err += cells->frame.needle ? incidence.error * whole : 0;
    moment_close(cells, unit * sum, err);
    return (lrcsi_visible_area){visible, lrcsi_max(0, visible - unit * perhaps_visible - err),
                                lrcsi_min(whole, visible + unit * perhaps_hidden + err), 0, 0};
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Room for the sides of so many candidates; those of others are computed anew each time. Heuristic:
   most facets have fewer. */
#define MAX_SIDES 256u
/* Room for the lists of facets of all cells: of f alone, in each on the stack and twice in the
   last. */
#define SINGLE_FACET_LISTS (LRCSI_CELL_STACK + 2)

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

size_t lrcsi_facet_cells_need(const lrcs_prepared *p)
{
    size_t segments = max_segments(p, p->topology.edge_count);
    size_t need = lrcsi_work_bytes(sides_room(p), 3 * sizeof(lrcsi_facet_cells_side));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_blocks(3, p->scene->facet_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need,
                          lrcsi_work_bytes(segments, LRCSI_CELL_SEGMENT_LISTS * sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(segments, sizeof(lrcsi_cells_segment)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(SINGLE_FACET_LISTS, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_crossings_need(p));
    return lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELL_STACK, sizeof(lrcsi_cell)));
}

int lrcsi_facet_cells_make(lrcsi_classification *classification, lrcsi_meter *meter,
                           const lrcsi_grid *grid, lrcs_work *work, lrcsi_facet_cells *cells)
{
    const lrcs_prepared *p = classification->view->prepared;
    uint32_t count = p->scene->facet_count;
    lrcsi_division *d = &cells->division;
    *cells = (lrcsi_facet_cells){
        .classification = classification, .grid = *grid, .side_room = sides_room(p)};
    d->view = classification->view;
    d->meter = meter;
    d->segment_room = (uint32_t)max_segments(p, classification->events.count);
    d->facet_lists_room = SINGLE_FACET_LISTS;
    d->segment_lists_room = LRCSI_CELL_SEGMENT_LISTS * (size_t)d->segment_room;
    cells->side = lrcsi_work_take(work, cells->side_room, sizeof *cells->side);
    cells->listed.entry = lrcsi_work_take_zero(work, count, sizeof(uint32_t));
    cells->order = lrcsi_work_take(work, count, 1);
    cells->contact = lrcsi_work_take(work, count, sizeof *cells->contact);
    cells->candidate = lrcsi_work_take(work, count, sizeof *cells->candidate);
    d->facet_lists = lrcsi_work_take(work, d->facet_lists_room, sizeof *d->facet_lists);
    d->segment_lists = lrcsi_work_take(work, d->segment_lists_room, sizeof *d->segment_lists);
    d->segment = lrcsi_work_take(work, d->segment_room, sizeof *d->segment);
    d->stack = lrcsi_work_take(work, LRCSI_CELL_STACK, sizeof *d->stack);
    if (!cells->side || !cells->listed.entry || !cells->order || !cells->contact ||
        !cells->candidate || !d->facet_lists || !d->segment_lists || !d->segment || !d->stack) {
        return LRCS_E_MEMORY;
    }
    return lrcsi_crossings_make(&classification->search, work, &cells->crossings);
}
