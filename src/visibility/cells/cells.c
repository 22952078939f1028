/* SPDX-License-Identifier: MIT */
/* Exact visibility of all undecided facets together, in convex cells of the view plane: for each
   facet a visible area with bounds. The visible pieces are not found here:
   visibility/cells/facet_cells.c finds them, one facet at a time.

   A cell is the convex hull of its corners, which are doubles. It has a list of the facets that may
   be visible in it, and a list of segments: event edges and contacts.

   Called, in this order:
   1. lrcsi_block_grid_make divides the view plane into blocks; lrcsi_blocks_begin makes the first
      cell of a block.
   2. lrcsi_cells_filter_segments removes segments from a cell's list that do not meet the cell.
   3. lrcsi_cells_sample_take takes a sample at a point P of the cell: it finds the facet nearest to
      the laser there. lrcsi_cells_surface_find finds the component of that facet: it follows the
      surface across edges that are not events (proof: visibility/cells/cells_cover.c). After a cut
      of a cell that a component covers, the part with P keeps both.
   4. If no event edge of the component crosses the cell, the component covers it: lrcsi_cells_cull
      removes the facets and events behind it from the lists, for this cell and all that are cut
      from it. So does a single facet that covers the cell (lrcsi_cells_surface_occluder). If an
      event edge or a contact of the component crosses the cell, lrcsi_cells_divide cuts the cell
      along its line.
   5. If no event edge is left, nothing but the component is visible in the cell, and its areas are
      added up. If one is left, the cell is cut along it.
   6. Area that rounding leaves undecided along events is charged to the facets near them
      (visibility/cells/cells_cut.c; at the border of blocks: lrcsi_cells_charge_border; of cells
      that are given up: lrcsi_cells_charge_all). An area is reported where its error is small
      enough; other facets are left to visibility/cells/facet_cells.c.

   Error of a facet's area in a cell: the error of the facet's sides times their length in the cell,
   and 4 u b and the cell's shape error times the perimeter of its part there (b: the largest
   coordinate in the block; shape error: visibility/cells/cells_cut.c). */
#include "visibility/cells/cells.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/cells/cells_block.h"
#include "visibility/cells/cells_cover.h"
#include "visibility/cells/cells_cut.h"

/* Limit on the steps of a block: a constant, and so many for each facet and segment in it and for
   each cell decided. Heuristic: ordinary scenes take a tenth of this, or less. */
#define STEPS_CONSTANT 65536u
#define STEPS_PER_ITEM 4096u
#define STEPS_PER_CELL 4096u
/* A cell without a segment is halved if its area is at most so many times chargeable: near a
   contact of a facet that is almost edge-on, samples farther from the contact decide. Heuristic:
   the facets of a larger cell are processed alone. */
#define MAX_HALVED 0x1p11
/* Accepted error of an area, relative to the facet's projected area and to the square of the
   scene's extent. */
#define ACCURACY_OF_FACET 1e-12
#define ACCURACY_OF_SCENE 1e-15
/* Heuristics: if the number of facets that remain to be processed alone, times that of all facets,
   exceeds MANY_LEFT, errors of up to SINGLE_FACTOR times those of a facet processed alone are
   accepted: a facet alone is compared with every facet that might hide it. In a scene with curved
   shapes it is CURVED_FACTOR, because there most shadows differ from the true ones by far more; so
   there errors of up to CURVED_ACCURACY of the projected area are accepted too, and of a facet that
   represents a curved surface those of up to REACH_FRACTION of the area that it has within its
   part's reach of a line along it. */
#define MANY_LEFT       65536u
#define SINGLE_FACTOR   4
#define CURVED_FACTOR   16
#define CURVED_ACCURACY 2e-10
#define REACH_FRACTION  0x1p-9
/* In a scene with curved shapes, cells of so many times the negligible area are chargeable: where
   long, narrow facets meet, thousands of cells are undecided, and the facets that a single one is
   charged to are accurate enough all the same. */
#define CURVED_CHARGEABLE 0x1p12
/* A facet counts as a needle here if its projected area is less than this, relative to its diameter
   squared. Heuristic: those that are needles to visibility/cells/target.c, and some that are wider.
   */
#define MAX_NEEDLE_AREA 0x1p-18

/* Room for the facet lists of all cells on the stack: so many times all facets. Ordinary scenes
   take twice those of a block, a stack of 800 plates 9 times its facets. */
#define BLOCK_FACET_LISTS 16u

/* The areas of a view while they are found. */
typedef struct cells_job {
    lrcsi_blocks blocks;
    lrcsi_moment *moment; /* facet: of its visible region; NULL: not wanted */
    double *reach;        /* facet: the largest distance from its centroid of what is visible, for
                             the error of its moment; NULL if that is not wanted */
    /* Of the current cell; here so that their arrays are allocated once: */
    lrcsi_cells_sample sample;
    lrcsi_cells_surface surface;
} cells_job;

/* --- one cell --------------------------------------------------------------------------------- */

/* Does the cell list a facet whose area is wanted, and not left undecided elsewhere? */
static int cell_is_wanted(const cells_job *job, const lrcsi_cell *cell)
{
    const lrcsi_blocks *b = &job->blocks;
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t f = cell->facet[i];
        if (b->division.wanted[f] && (b->record_finding[f] & LRCSI_FINDING_UNDECIDED) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Adds a visible piece of a facet to its moment. The facet's centroid is known to within the error
   of its vertices, which moves the moment by that times the area of the piece. */
static void add_visible_moment(lrcsi_moment *moment, double *reach, const lrcsi_cells_facet *f,
                               const lrcsi_clip_polygon *piece)
{
    const double centre[2] = {(f->x[0] + f->x[1] + f->x[2]) / 3, (f->y[0] + f->y[1] + f->y[2]) / 3};
    double size = lrcsi_max(f->high[0] - f->low[0], f->high[1] - f->low[1]);
    double farthest = lrcsi_clip_add_moment(piece, centre, moment);
    *reach = lrcsi_max3(*reach, farthest, size);
    moment->error += (2 * f->err + 4 * LRCSI_U * size) * lrcsi_max(0, lrcsi_clip_area(piece));
}

/* Adds the facet's area in a cell in which it is visible. Of the sides of the cell and of the facet
   only the parts in both bounding boxes matter; a convex curve in a box is no longer than the box's
   perimeter. */
static void add_visible_area(cells_job *job, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                             uint32_t facet)
{
    lrcsi_division *d = &job->blocks.division;
    const lrcsi_cells_facet *f = &d->facet[facet];
    lrcsi_cell_area *area = &d->area[facet];
    lrcsi_clip_polygon piece;
    lrcsi_clip_copy(&cell->shape, &piece);
    double w = f->err + s->tolerance;
    double wide[2];
    for (int k = 0; k < 2; k++) {
        wide[k] =
            lrcsi_max(0, lrcsi_min(s->high[k], f->high[k]) - lrcsi_max(s->low[k], f->low[k])) +
            4 * w;
    }
    double around = wide[0] + wide[1];
    area->visible_err += 2 * (cell->shape_err + 4 * LRCSI_U * d->extent) * around +
                         5 * LRCSI_U * (piece.count + 3) * wide[0] * wide[1];
    for (int k = 0; k < 3 && piece.count > 0; k++) {
        double range[2];
        lrcsi_box_range(s->low, s->high, f->side[k], range);
        if (range[0] < w) {
            lrcsi_line_range(&cell->shape, f->side[k], range);
        }
        if (range[0] < w) {
            area->visible_err +=
                (f->line_err + 12 * LRCSI_U * d->extent) * lrcsi_min(f->length[k] + 4 * w, around);
            if (!lrcsi_clip_keep_left(&piece, f->side[k])) { /* any of the piece may be visible */
                area->visible_err += lrcsi_clip_area(&piece);
            }
        }
    }
    if (piece.count >= 3) {
        lrcsi_sum_add(&area->visible, lrcsi_max(0, lrcsi_clip_area(&piece)));
    }
    if (job->moment && piece.count >= 3) {
        add_visible_moment(&job->moment[f->facet], &job->reach[f->facet], f, &piece);
    }
}

/* Decides a cell: the facets of the surface are visible in it, all others hidden. surface NULL:
   all facets are hidden. */
static void decide_cell(cells_job *job, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                        const lrcsi_cells_surface *surface, double uncertainty)
{
    lrcsi_blocks *b = &job->blocks;
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t f = cell->facet[i];
        if (!b->division.wanted[f]) {
            continue;
        }
        int visible = surface && lrcsi_marked(&surface->foreground, f);
        b->record_finding[f] |= visible ? LRCSI_FINDING_VISIBLE : LRCSI_FINDING_HIDDEN;
        b->division.area[f].uncertainty += uncertainty;
        if (visible) {
            add_visible_area(job, cell, s, f);
        }
    }
}

/* The segments that a cell may be cut along. */
enum cut_choice { CUT_FOREGROUND, CUT_EDGES, CUT_ANY };

/* The segment whose line divides the cell best, or NULL: of the segments of the foreground, of
   edges, or of all. The score is the cell's width on the narrower side of the line, times the root
   of the segment's extent in the cell. So cells shrink fast, few become long and narrow, and few
   are cut where nothing changes. */
static const lrcsi_cells_segment *choose_cut(const lrcsi_division *d, const lrcsi_cell *cell,
                                             const lrcsi_clip_sides *s, int choice,
                                             const lrcsi_cells_surface *surface)
{
    const lrcsi_cells_segment *best = NULL;
    double best_score = -HUGE_VAL;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        const lrcsi_cells_segment *e = &d->segment[cell->segment[i]];
        if (choice == CUT_ANY || (choice == CUT_EDGES && !e->contact) ||
            (choice == CUT_FOREGROUND &&
             lrcsi_division_segment_marked(d, e, &surface->foreground))) {
            double range[2];
            double extent = 0;
            for (int k = 0; k < 2; k++) {
                extent += lrcsi_min(s->high[k], lrcsi_max(e->end[0][k], e->end[1][k])) -
                          lrcsi_max(s->low[k], lrcsi_min(e->end[0][k], e->end[1][k]));
            }
            lrcsi_line_range(&cell->shape, e->line, range);
            double score = lrcsi_min(-range[0], range[1]) * sqrt(lrcsi_max(0, extent));
            best = score > best_score ? e : best;
            best_score = lrcsi_max(best_score, score);
        }
    }
    return best;
}

/* Adds a lrcsi_finding to what was found of each facet in a cell. */
static void add_finding(lrcsi_blocks *b, const lrcsi_cell *cell, int finding)
{
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        b->record_finding[cell->facet[i]] |= (unsigned char)finding;
    }
}

/* Processes one cell. Returns 1 if it is decided; otherwise it is cut, or left undecided. */
static int process_cell(cells_job *job, lrcsi_cell *cell)
{
    lrcsi_blocks *b = &job->blocks;
    lrcsi_division *d = &b->division;
    lrcsi_cells_sample *sample = &job->sample;
    lrcsi_cells_surface *surface = &job->surface;
    lrcsi_clip_sides s;
    if (!cell_is_wanted(job, cell)) {
        return 0;
    }
    lrcsi_clip_sides_make(&cell->shape, lrcsi_division_tolerance(d, cell), &s);
    lrcsi_cells_filter_segments(d, cell, &s);

    /* 1. Take a sample, unless that of the cell before, which was covered, serves for this part. */
    int kept = cell->keeps_sample && lrcsi_cells_sample_keep(d, cell, &s, sample);
    if (kept) {
        lrcsi_cells_surface_keep(d, cell, surface);
    } else {
        lrcsi_cells_sample_take(d, cell, &s, sample);
    }
    if (sample->outcome == LRCSI_SAMPLE_UNSURE && lrcsi_cells_charge_all(d, cell, &s)) {
        add_finding(b, cell, LRCSI_FINDING_CHARGED);
        return 0;
    }

    /* 2. Does the component around the nearest facet cover the cell? If not, cut along one of its
       segments. */
    const lrcsi_cells_segment *cut = NULL;
    int found = sample->outcome == LRCSI_SAMPLE_FOUND;
    int covers = kept || (found && lrcsi_cells_surface_find(d, cell, &s, sample,
                                                            LRCSI_SURFACE_LISTED, surface));
    if (found && !covers) {
        cut = choose_cut(d, cell, &s, CUT_FOREGROUND, surface);
    }
    if (found && !covers && !cut) {
        covers = lrcsi_cells_surface_find(d, cell, &s, sample, LRCSI_SURFACE_IN_CELL, surface);
        cut = covers ? NULL : choose_cut(d, cell, &s, CUT_FOREGROUND, surface);
    }

    /* 3. Remove what is behind the component, if it covers the cell, or else behind a single facet
       that covers it. The component alone is visible if no contact of it crosses the cell. */
    double thin = 0; /* the error of the area of any facet, if the cell is thin */
    if (covers || (found && lrcsi_cells_surface_occluder(d, cell, &s, sample, surface))) {
        for (uint32_t i = 0; i < surface->border_count; i++) {
            lrcsi_cells_charge_border(d, cell, &s, &surface->border[i]);
        }
        thin = lrcsi_cells_thin_uncertainty(cell, &s, sample->border_distance,
                                            cell->removed + surface->border_count, d->facet_err);
        if (!covers || cell->segment_count > 0) { /* else it is decided */
            lrcsi_cells_cull(b, cell, &s, surface, thin, sample);
        }
    }
    if (covers) {
        cut = choose_cut(d, cell, &s, CUT_FOREGROUND, surface);
    }

    /* 4. Decide the cell if no event edge is left in it, or cut it. If it has no segment, and no
       sample tells which facet is nearest, it is halved if it is small. */
    int alone = sample->outcome == LRCSI_SAMPLE_EMPTY || (covers && !cut);
    if (!cut) {
        cut = choose_cut(d, cell, &s, alone ? CUT_EDGES : CUT_ANY, NULL);
        if (!cut && alone) {
            decide_cell(job, cell, &s, covers ? surface : NULL, cell->uncertainty + thin);
            return 1;
        }
    }
    const int divided =
        cut ? lrcsi_cells_divide(d, cell, &s, cut, covers && thin == 0 ? sample->at : NULL)
            : sample->outcome == LRCSI_SAMPLE_UNSURE &&
                  lrcsi_clip_area(&cell->shape) <= MAX_HALVED * d->chargeable &&
                  lrcsi_cells_halve(d, cell, &s);
    if (!divided) {
        add_finding(b, cell, LRCSI_FINDING_UNDECIDED);
    }
    return 0;
}

/* --- one block -------------------------------------------------------------------------------- */

/* Leaves all facets of a block undecided. */
static void leave_block_undecided(lrcsi_blocks *b, size_t block)
{
    const lrcsi_block_lists *facets = &b->grid.facets;
    uint32_t count = facets->first[block + 1] - facets->first[block];
    for (uint32_t record = 1; record <= count; record++) {
        b->record_finding[record] |= LRCSI_FINDING_UNDECIDED;
    }
}

static int block_is_wanted(const lrcsi_blocks *b, size_t block)
{
    const lrcsi_block_lists *facets = &b->grid.facets;
    for (uint32_t i = facets->first[block]; i < facets->first[block + 1]; i++) {
        if (b->wanted[facets->item[i]]) {
            return 1;
        }
    }
    return 0;
}

/* Processes the cells of a block. Returns 0 if that takes long and decides little, or the meter is
   spent. */
static int process_cells(cells_job *job)
{
    lrcsi_division *d = &job->blocks.division;
    const lrcsi_cell *first = &d->stack[0];
    uint64_t steps_left =
        STEPS_CONSTANT + STEPS_PER_ITEM * (uint64_t)(first->facet_count + first->segment_count);
    while (d->stack_count > 0) {
        lrcsi_cell cell;
        lrcsi_cell_copy(&d->stack[--d->stack_count], &cell);
        uint64_t steps = (uint64_t)1 + cell.facet_count + cell.segment_count;
        if (steps > steps_left || !lrcsi_meter_take(d->meter, steps)) {
            return 0;
        }
        steps_left -= steps;
        steps_left += process_cell(job, &cell) ? STEPS_PER_CELL : 0;
    }
    return 1;
}

static void process_block(cells_job *job, uint32_t x, uint32_t y)
{
    lrcsi_blocks *b = &job->blocks;
    lrcsi_division *d = &b->division;
    size_t block = (size_t)y * b->grid.size + x;
    if (!block_is_wanted(b, block)) {
        return;
    }
    lrcsi_cell cell = {.cuts = 0};
    d->extent = lrcsi_block_grid_square(&b->grid, x, y, &cell.shape, b->frame.middle);
    b->frame.block = (uint32_t)block + 1;
    if (!lrcsi_blocks_begin(b, block, &cell) || !process_cells(job)) {
        leave_block_undecided(b, block); /* its facets are processed one by one instead */
    }
    lrcsi_blocks_end(b, block);
}

/* --- all blocks ------------------------------------------------------------------------------- */

/* The extent of the bulk of a scene. */
static double extent_of(const lrcs_prepared *p)
{
    return 2 * lrcsi_max3(p->bulk[0], p->bulk[1], p->bulk[2]);
}

/* The largest error at which a facet's area is accepted. It is the sum of two terms: 1e-12 of the
   projected area; and 1e-15 of the squared extent or, if as_single and if that is more,
   SINGLE_FACTOR or CURVED_FACTOR times the least error of the facet processed alone
   (visibility/cells/facet_cells.c): 52 u of its diameter times its perimeter, and for each cut a
   strip 128 u of the diameter wide. If as_single in a scene with curved shapes, the first term is
   CURVED_ACCURACY of the projected area, and the second at least REACH_FRACTION of the reach of the
   facet's part times the diameter. Needles, and facets with a diameter of twice the extent or more,
   are much more accurate alone: for these there is only the first term, unless they represent a
   curved surface, from which they differ by far more. */
static double facet_accuracy(const lrcsi_blocks *b, uint32_t facet, double projected, int as_single)
{
    const lrcsi_view *view = b->division.view;
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t *corner = scene->facet[facet].corner;
    const double *reaches = view->prepared->proximity.reach; /* NULL: no part is curved */
    const double reach = reaches ? reaches[scene->facet_part[facet]] : 0;
    double diameter = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = view->point[corner[k]].x;
        const double *q = view->point[corner[(k + 1) % 3]].x;
        diameter = lrcsi_max3(diameter, fabs(p[0] - q[0]), fabs(p[1] - q[1]));
    }
    double extent = extent_of(view->prepared);
    double of_facet = ACCURACY_OF_FACET * projected;
    double of_scene = ACCURACY_OF_SCENE * extent * extent;
    if (as_single) {
        double alone = LRCSI_U * diameter * (104 * diameter + 128 * b->area[facet].strip_length);
        alone *= reaches ? CURVED_FACTOR : SINGLE_FACTOR;
        of_scene = lrcsi_max3(of_scene, alone, REACH_FRACTION * reach * diameter);
        of_facet = reaches ? CURVED_ACCURACY * projected : of_facet;
    }
    int ordinary = scene->part[scene->facet_part[facet]].bounds.reach > 0 ||
                   (projected > MAX_NEEDLE_AREA * diameter * diameter && diameter < 2 * extent);
    return of_facet + (ordinary ? of_scene : 0);
}

/* Finishes the moment of a facet whose area is reported. What was added, of area `sum`, differs
   from the visible region by at most `err`, an area, which includes the rounding errors of areas;
   those of distances from the centroid, at most `reach`, are below 64 u of it. If the facet is not
   partly visible, only what may be hidden, or visible, moves the moment from 0. */
static void moment_report(lrcsi_moment *moment, double reach, double sum, int partly, double err)
{
    if (partly) {
        moment->error += 64 * LRCSI_U * sum * reach;
    } else {
        *moment = (lrcsi_moment){.error = 0};
    }
    moment->area_err = err;
}

/* Reports the areas that are accurate enough and not found yet. Returns the number of facets that
   the cells decided, but less accurately. */
static uint32_t areas_report(cells_job *job, int as_single, unsigned char *found,
                             lrcsi_visible_area *visible)
{
    const lrcsi_blocks *b = &job->blocks;
    const lrcsi_view *view = b->division.view;
    uint32_t left = 0;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        int finding = b->finding[f];
        if (!b->wanted[f] || found[f] || (finding & LRCSI_FINDING_UNDECIDED) != 0 || finding == 0) {
            continue;
        }
        const lrcsi_cell_area *a = &b->area[f];
        double whole = lrcsi_view_projected(view, f);
        int some_visible = (finding & LRCSI_FINDING_VISIBLE) != 0;
        int some_hidden = (finding & LRCSI_FINDING_HIDDEN) != 0;
        double sum = lrcsi_sum_value(&a->visible);
        double area = !some_hidden ? whole : !some_visible ? 0 : lrcsi_min(whole, sum);
        double err = a->uncertainty;
        err += some_visible && some_hidden ? a->visible_err + 64 * LRCSI_U * sum : 0;
        err *= LRCSI_OUTWARD_MICRO; /* of the sums over cells */
        if (err <= ACCURACY_OF_FACET * whole || err <= facet_accuracy(b, f, whole, as_single)) {
            visible[f] = (lrcsi_visible_area){area, lrcsi_max(0, area - err),
                                              lrcsi_min(whole, area + err), 0, 0};
            found[f] = 1;
            if (job->moment) {
                moment_report(&job->moment[f], job->reach[f], sum, some_visible && some_hidden,
                              err);
            }
        } else {
            left++;
        }
    }
    return left;
}

/* All edges and contacts may be in one block. Coplanar facets and edges along which others meet can
   add more: if there is no room for these, facets are processed one by one. */
size_t lrcsi_cells_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t segments = (size_t)prepared->topology.edge_count + prepared->intersections.count;
    size_t vertices = prepared->scene->vertex_count;
    size_t records = facets + 1;
    size_t need = lrcsi_work_add(lrcsi_work_blocks(2, facets, 1), lrcsi_work_blocks(2, records, 1));
    need = lrcsi_work_add(need, prepared->proximity.reach ? lrcsi_work_bytes(facets, sizeof(double))
                                                          : 0); /* moments are wanted only there */
    need = lrcsi_work_add(need, lrcsi_block_grid_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(records, sizeof(lrcsi_cells_facet)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(records, sizeof(lrcsi_cell_area)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_cell_area)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertices, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertices, sizeof(lrcsi_cells_point)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(6, records, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, BLOCK_FACET_LISTS * sizeof(uint32_t)));
    need = lrcsi_work_add(need,
                          lrcsi_work_bytes(segments, LRCSI_CELL_SEGMENT_LISTS * sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(segments, sizeof(lrcsi_cells_segment)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_SURFACE_BORDERS, sizeof(lrcsi_cell_border)));
    return lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELL_STACK, sizeof(lrcsi_cell)));
}

/* Allocates the arrays by facet, and those whose sizes do not depend on the blocks. 0 if the memory
   does not suffice. */
static int allocate_facets(lrcs_work *work, cells_job *job)
{
    lrcsi_blocks *b = &job->blocks;
    lrcsi_division *d = &b->division;
    const lrcs_scene *scene = d->view->prepared->scene;
    uint32_t count = scene->facet_count;
    job->reach = job->moment ? lrcsi_work_take_zero(work, count, sizeof *job->reach) : NULL;
    b->finding = lrcsi_work_take_zero(work, count, 1);
    b->coplanar = lrcsi_work_take_zero(work, count, 1);
    b->area = lrcsi_work_take_zero(work, count, sizeof *b->area);
    d->record = lrcsi_work_take_zero(work, count, sizeof *d->record);
    b->frame.made = lrcsi_work_take_zero(work, scene->vertex_count, 1);
    b->frame.point = lrcsi_work_take(work, scene->vertex_count, sizeof *b->frame.point);
    d->facet_lists_room = BLOCK_FACET_LISTS * (size_t)count;
    d->facet_lists = lrcsi_work_take(work, d->facet_lists_room, sizeof *d->facet_lists);
    job->surface.border = lrcsi_work_take(work, LRCSI_SURFACE_BORDERS, sizeof *job->surface.border);
    d->stack = lrcsi_work_take(work, LRCSI_CELL_STACK, sizeof *d->stack);
    return (!job->moment || job->reach) && b->finding && b->coplanar && b->area && d->record &&
           b->frame.made && b->frame.point && d->facet_lists && job->surface.border && d->stack;
}

/* Allocates the arrays by record and those of segments, for the largest block. */
static int allocate_records(lrcs_work *work, cells_job *job)
{
    lrcsi_blocks *b = &job->blocks;
    lrcsi_division *d = &b->division;
    lrcsi_cells_sample *sample = &job->sample;
    lrcsi_cells_surface *surface = &job->surface;
    size_t facets;
    size_t segments;
    lrcsi_blocks_max_lists(b, &facets, &segments);
    size_t records = facets + 1;
    d->record_room = (uint32_t)records;
    d->segment_room = (uint32_t)segments;
    d->segment_lists_room = LRCSI_CELL_SEGMENT_LISTS * segments;
    d->facet = lrcsi_work_take(work, records, sizeof *d->facet);
    d->area = lrcsi_work_take(work, records, sizeof *d->area);
    d->wanted = lrcsi_work_take(work, records, 1);
    b->record_finding = lrcsi_work_take(work, records, 1);
    sample->listed.entry = lrcsi_work_take_zero(work, records, sizeof(uint32_t));
    sample->covers = lrcsi_work_take_zero(work, records, sizeof *sample->covers);
    sample->hit = lrcsi_work_take(work, records, sizeof *sample->hit);
    surface->foreground.entry = lrcsi_work_take_zero(work, records, sizeof(uint32_t));
    surface->adjoining.entry = lrcsi_work_take_zero(work, records, sizeof(uint32_t));
    surface->facet = lrcsi_work_take(work, records, sizeof *surface->facet);
    d->segment_lists = lrcsi_work_take(work, d->segment_lists_room, sizeof *d->segment_lists);
    d->segment = lrcsi_work_take(work, segments, sizeof *d->segment);
    return segments < LRCS_NONE && d->facet && d->area && d->wanted && b->record_finding &&
           sample->listed.entry && sample->covers && sample->hit && surface->foreground.entry &&
           surface->adjoining.entry && surface->facet && d->segment_lists && d->segment;
}

/* Lists the facets and events of a view in blocks, and allocates the arrays. 0 if the memory does
   not suffice. */
static int cells_allocate(const lrcsi_classification *classification, const unsigned char *answer,
                          lrcs_work *work, cells_job *job)
{
    lrcsi_blocks *b = &job->blocks;
    const lrcsi_view *view = b->division.view;
    if (!allocate_facets(work, job) ||
        !lrcsi_block_grid_make(classification, answer, work, &b->grid)) {
        return 0;
    }
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        b->coplanar[f] = lrcsi_view_casts(view, f) && lrcsi_cells_has_coplanar(view, f);
    }
    lrcsi_cells_frame_make(&b->frame);
    return allocate_records(work, job);
}

void lrcsi_cells_areas(const lrcsi_classification *classification, lrcsi_meter *meter,
                       lrcs_progress *progress, lrcs_work *work, const unsigned char *answer,
                       const unsigned char *wanted, unsigned char *found,
                       lrcsi_visible_area *visible, lrcsi_moment *moment)
{
    const lrcsi_view *view = classification->view;
    size_t mark = work->used;
    size_t peak = work->peak; /* restored if memory does not suffice: it is no failure then */
    double extent = extent_of(view->prepared);
    double negligible = 0x1p-10 * ACCURACY_OF_SCENE * extent * extent;
    double chargeable = (view->prepared->proximity.reach ? CURVED_CHARGEABLE : 1) * negligible;
    cells_job job = {.moment = moment};
    job.blocks.frame.view = view;
    job.blocks.wanted = wanted;
    job.blocks.division = (lrcsi_division){
        .view = view, .meter = meter, .negligible = negligible, .chargeable = chargeable};
    memset(found, 0, view->prepared->scene->facet_count);
    if (cells_allocate(classification, answer, work, &job)) {
        uint32_t size = job.blocks.grid.size;
        for (uint32_t y = 0; y < size; y++) {
            lrcsi_progress_report(progress, LRCS_PROGRESS_VISIBILITY, y, size);
            for (uint32_t x = 0; x < size; x++) {
                process_block(&job, x, y);
            }
        }
        /* Facets whose areas are not accurate enough are processed alone; if they are many, only
           those that are much more accurate alone. */
        uint64_t left = areas_report(&job, 0, found, visible);
        if (left * view->prepared->scene->facet_count > MANY_LEFT) {
            areas_report(&job, 1, found, visible);
        }
    } else {
        work->peak = peak;
    }
    work->used = mark;
}
