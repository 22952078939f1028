/* SPDX-License-Identifier: MIT */
/* Exact visibility of all undecided facets together, in convex cells of the view plane: for each
   facet a visible area with bounds. The visible pieces are not found here:
   visibility/cells_single.c finds them, one facet at a time.

   A cell is the convex hull of its corners, which are doubles. It has a list of the facets that may
   be visible in it, and a list of segments: event edges and contacts.

   Called, in this order:
   1. lrcsi_cells_grid_make divides the view plane into blocks; lrcsi_cells_begin makes the first
      cell of a block.
   2. lrcsi_cells_filter_segments removes segments from a cell's list that do not meet the cell.
   3. lrcsi_cells_nearest takes a sample at a point P of the cell: it finds the facet nearest to the
      laser there. lrcsi_cells_component finds the component of that facet: it follows the surface
      across edges that are not events (proof: visibility/cells_cover.c).
   4. If no event edge of the component crosses the cell, the component covers it: lrcsi_cells_cull
      removes the facets and events behind it from the lists, for this cell and all that are cut
      from it. So does a single facet that covers the cell (lrcsi_cells_find_occluder). If an event
      edge or a contact of the component crosses the cell, lrcsi_cells_divide cuts the cell along
   its line.
   5. If no event edge is left, nothing but the component is visible in the cell, and its areas are
      added up. If one is left, the cell is cut along it.
   6. Area that rounding leaves undecided along events is charged to the facets near them
      (visibility/cells_cut.c; at the border of blocks: lrcsi_cells_charge_border; of cells that are
      given up: lrcsi_cells_charge_all). An area is reported where its error is small enough; other
   facets are left to visibility/cells_single.c.

   Error of a facet's area in a cell: the error of the facet's sides times their length in the cell,
   and 4 u b and the cell's shape error times the perimeter of its part there (b: the largest
   coordinate in the block; shape error: visibility/cells_cut.c). */
#include "visibility/cells.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/cells_block.h"
#include "visibility/cells_cover.h"
#include "visibility/cells_cut.h"

/* Limit on the steps of a block: a constant, and so many for each facet and segment in it and for
   each cell decided. Ordinary scenes take a tenth of this, or less. */
#define STEPS_CONSTANT 65536u
#define STEPS_PER_ITEM 4096u
#define STEPS_PER_CELL 4096u
/* Accepted error of an area, relative to the facet's projected area and to the square of the
   scene's extent. */
#define ACCURACY_OF_FACET 1e-12
#define ACCURACY_OF_SCENE 1e-15
/* If the number of facets that remain to be processed alone, times that of all facets, exceeds
   MANY_LEFT, errors of up to SINGLE_FACTOR times those of a facet processed alone are accepted: a
   facet alone is compared with every facet that might hide it. */
#define MANY_LEFT     65536u
#define SINGLE_FACTOR 4
/* A facet is a needle if its projected area is less than this, relative to its diameter squared. */
#define MAX_NEEDLE_AREA 0x1p-18

/* --- one cell --------------------------------------------------------------------------------- */

/* Does the cell list a facet whose area is wanted, and not left undecided elsewhere? */
static int cell_is_wanted(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = cell->facet[i];
        if (c->wanted[f] && (c->state[f] & LRCSI_CELLS_UNDECIDED) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Adds a visible piece of a facet to its moment. The facet's centroid is known to within the error
   of its vertices, which moves the moment by that times the area of the piece. */
static void add_visible_moment(lrcsi_moment *moment, const lrcsi_cells_facet *f,
                               const lrcsi_clip_polygon *piece)
{
    const double centre[2] = {(f->x[0] + f->x[1] + f->x[2]) / 3, (f->y[0] + f->y[1] + f->y[2]) / 3};
    double size = lrcsi_max(f->high[0] - f->low[0], f->high[1] - f->low[1]);
    double reach = lrcsi_clip_add_moment(piece, centre, moment->first);
    moment->reach = lrcsi_max3(moment->reach, reach, size);
    moment->error += (2 * f->err + 4 * LRCSI_U * size) * lrcsi_max(0, lrcsi_clip_area(piece));
}

/* Adds the facet's area in a cell in which it is visible. Of the sides of the cell and of the facet
   only the parts in both bounding boxes matter; a convex curve in a box is no longer than the box's
   perimeter. */
static void add_visible_area(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                             const lrcsi_cells_sides *s, uint32_t facet)
{
    const lrcsi_cells_facet *f = &c->facet[facet];
    lrcsi_cells_found *area = &c->area[facet];
    lrcsi_clip_polygon piece = cell->shape;
    double w = f->err + s->tolerance;
    double wide[2];
    for (int k = 0; k < 2; k++) {
        wide[k] =
            lrcsi_max(0, lrcsi_min(s->high[k], f->high[k]) - lrcsi_max(s->low[k], f->low[k])) +
            4 * w;
    }
    double around = wide[0] + wide[1];
    area->visible_err += 2 * (cell->shape_err + 4 * LRCSI_U * c->extent) * around +
                         5 * LRCSI_U * (piece.count + 3) * wide[0] * wide[1];
    for (int k = 0; k < 3 && piece.count > 0; k++) {
        double range[2];
        lrcsi_box_range(s->low, s->high, f->side[k], range);
        if (range[0] < w) {
            lrcsi_line_range(&cell->shape, f->side[k], range);
        }
        if (range[0] < w) {
            area->visible_err +=
                (f->line_err + 12 * LRCSI_U * c->extent) * lrcsi_min(f->length[k] + 4 * w, around);
            if (!lrcsi_clip_keep_left(&piece, f->side[k])) { /* any of the piece may be visible */
                area->visible_err += lrcsi_clip_area(&piece);
            }
        }
    }
    area->visible += piece.count >= 3 ? lrcsi_max(0, lrcsi_clip_area(&piece)) : 0;
    if (c->moment && piece.count >= 3) {
        add_visible_moment(&c->moment[facet], f, &piece);
    }
}

/* Decides a cell: the facets of the component are visible in it, all others hidden. */
static void decide_cell(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                        const lrcsi_cells_sides *s, double uncertainty)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = cell->facet[i];
        if (!c->wanted[f]) {
            continue;
        }
        int visible = c->components > 0 && c->in_component[f] == c->stamp;
        c->state[f] |= visible ? LRCSI_CELLS_VISIBLE : LRCSI_CELLS_HIDDEN;
        c->area[f].uncertainty += uncertainty;
        if (visible) {
            add_visible_area(c, cell, s, f);
        }
    }
}

enum { CHOOSE_COMPONENT, CHOOSE_EDGES, CHOOSE_ANY };

/* The segment whose line divides the cell best, or NULL: of the component's segments, of edges, or
   of all. The score is the cell's width on the narrower side of the line, times the root of the
   segment's extent in the cell. So cells shrink fast, few become long and narrow, and few are cut
   where nothing changes. */
static const lrcsi_cells_segment *choose_cut(const lrcsi_cells_work *c,
                                             const lrcsi_cells_cell *cell,
                                             const lrcsi_cells_sides *s, int which)
{
    const lrcsi_cells_segment *best = NULL;
    double best_score = -HUGE_VAL;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[cell->segment[i]];
        if (which == CHOOSE_ANY || (which == CHOOSE_EDGES && !e->contact) ||
            (which == CHOOSE_COMPONENT && lrcsi_cells_of_component(c, e))) {
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

/* Processes one cell. Returns 1 if it is decided; otherwise it is cut, or left undecided. */
static int process_cell(lrcsi_cells_work *c, lrcsi_cells_cell *cell)
{
    lrcsi_cells_sides s;
    if (!cell_is_wanted(c, cell)) {
        return 0;
    }
    lrcsi_cells_sides_make(&cell->shape, lrcsi_cells_tolerance(c, cell), &s);
    lrcsi_cells_filter_segments(c, cell, &s);
    c->components = 0;

    /* 1. Take a sample: the facet nearest to the laser, the point, its distance from the border. */
    uint32_t nearest = LRCS_NONE;
    double at[2];
    double clear = 0;
    int sample = lrcsi_cells_nearest(c, cell, &s, &nearest, at, &clear);
    if (sample == LRCSI_CELLS_UNSURE && lrcsi_cells_charge_all(c, cell, &s)) {
        return 0;
    }

    /* 2. Does the component around the nearest facet cover the cell? If not, cut along one of its
       segments. */
    const lrcsi_cells_segment *cut = NULL;
    int covers = 0;
    for (int within = 0; within < 2 && sample == LRCSI_CELLS_FOUND && !covers && !cut; within++) {
        covers = lrcsi_cells_component(c, cell, &s, nearest, within);
        cut = covers ? NULL : choose_cut(c, cell, &s, CHOOSE_COMPONENT);
    }

    /* 3. Remove what is behind the component, if it covers the cell, or else behind a single facet
       that covers it. The component alone is visible if no contact of it crosses the cell. */
    double thin = 0; /* the error of the area of any facet, if the cell is thin */
    if (covers || (sample == LRCSI_CELLS_FOUND && lrcsi_cells_find_occluder(c, cell, &s, at))) {
        for (uint32_t i = 0; i < c->borders; i++) {
            lrcsi_cells_charge_border(c, cell, &s, &c->border[i]);
        }
        thin =
            lrcsi_cells_thin_uncertainty(cell, &s, clear, cell->removed + c->borders, c->facet_err);
        lrcsi_cells_cull(c, cell, &s, covers ? NULL : at, thin);
    }
    if (covers) {
        cut = choose_cut(c, cell, &s, CHOOSE_COMPONENT);
    }

    /* 4. Decide the cell if no event edge is left in it, or cut it. */
    int alone = sample == LRCSI_CELLS_NONE || (covers && !cut);
    if (!cut) {
        cut = choose_cut(c, cell, &s, alone ? CHOOSE_EDGES : CHOOSE_ANY);
        if (!cut && alone) {
            decide_cell(c, cell, &s, cell->uncertainty + thin);
            return 1;
        }
    }
    if (!cut || !lrcsi_cells_divide(c, cell, &s, cut)) {
        for (uint32_t i = 0; i < cell->facets; i++) {
            c->state[cell->facet[i]] |= LRCSI_CELLS_UNDECIDED;
        }
    }
    return 0;
}

/* --- one block -------------------------------------------------------------------------------- */

/* Leaves all facets of a block undecided. */
static void leave_block_undecided(lrcsi_cells_work *c, size_t block)
{
    for (uint32_t i = c->grid.facets.first[block]; i < c->grid.facets.first[block + 1]; i++) {
        c->state[c->grid.facets.item[i]] |= LRCSI_CELLS_UNDECIDED;
    }
}

static int block_is_wanted(const lrcsi_cells_work *c, size_t block)
{
    for (uint32_t i = c->grid.facets.first[block]; i < c->grid.facets.first[block + 1]; i++) {
        if (c->wanted[c->grid.facets.item[i]]) {
            return 1;
        }
    }
    return 0;
}

static void process_block(lrcsi_cells_work *c, uint32_t x, uint32_t y)
{
    size_t block = (size_t)y * c->grid.side + x;
    if (!block_is_wanted(c, block)) {
        return;
    }
    lrcsi_cells_cell cell = {.cuts = 0};
    c->extent = lrcsi_cells_grid_square(&c->grid, x, y, &cell.shape, c->frame.middle);
    c->frame.block = (uint32_t)block + 1;
    c->stamp++;
    if (!lrcsi_cells_begin(c, block, &cell)) {
        leave_block_undecided(c, block);
        return;
    }
    /* If this takes long and decides little, the facets are processed one by one instead. */
    uint64_t steps_left = STEPS_CONSTANT + STEPS_PER_ITEM * (uint64_t)(cell.facets + cell.segments);
    c->stack[0] = cell;
    c->top = 1;
    while (c->top > 0) {
        cell = c->stack[--c->top];
        uint64_t steps = (uint64_t)1 + cell.facets + cell.segments;
        if (steps > steps_left || !lrcsi_meter_take(c->meter, steps)) {
            leave_block_undecided(c, block);
            return;
        }
        steps_left -= steps;
        steps_left += process_cell(c, &cell) ? STEPS_PER_CELL : 0;
    }
}

/* --- all blocks ------------------------------------------------------------------------------- */

/* The extent of the bulk of a scene. */
static double extent_of(const lrcs_prepared *p)
{
    return 2 * lrcsi_max3(p->bulk[0], p->bulk[1], p->bulk[2]);
}

/* The largest error at which a facet's area is accepted: 1e-12 of the area or 1e-15 of the squared
   extent; or, if as_single, SINGLE_FACTOR times the least error of the facet processed alone
   (visibility/cells_single.c): 52 u of its diameter times its perimeter, and for each cut a strip
   128 u of the diameter wide. Needles, and facets larger than the bulk of the scene, are much more
   accurate alone: for these only the first limit applies, unless they represent a curved surface,
   from which they differ by far more. */
static double facet_accuracy(const lrcsi_cells_work *c, uint32_t facet, double projected,
                             int as_single)
{
    const uint32_t *corner = c->view->prepared->scene->facet[facet].corner;
    double diameter = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = c->view->point[corner[k]].x;
        const double *q = c->view->point[corner[(k + 1) % 3]].x;
        diameter = lrcsi_max3(diameter, fabs(p[0] - q[0]), fabs(p[1] - q[1]));
    }
    double extent = extent_of(c->view->prepared);
    const lrcs_scene *scene = c->view->prepared->scene;
    int ordinary = scene->part[scene->facet_part[facet]].bounds.reach > 0 ||
                   (projected > MAX_NEEDLE_AREA * diameter * diameter && diameter < 2 * extent);
    double alone = LRCSI_U * diameter * (104 * diameter + 128 * c->area[facet].strip_length);
    alone = as_single ? SINGLE_FACTOR * alone : 0;
    return ACCURACY_OF_FACET * projected +
           (ordinary ? lrcsi_max(alone, ACCURACY_OF_SCENE * extent * extent) : 0);
}

/* Finishes the moment of a facet whose area is reported. What was added differs from the visible
   region by at most `err`, an area, and the rounding error of an area, times the distance from the
   centroid, bounds that of a moment (lrcsi_clip_add_moment). If the facet is not partly visible,
   only what may be hidden, or visible, moves the moment from 0; its points are no farther from the
   centroid than the largest difference of coordinates. */
static void moment_report(const lrcsi_cells_work *c, uint32_t facet, int partly, double err)
{
    lrcsi_moment *moment = &c->moment[facet];
    if (partly) {
        moment->error += moment->reach * err;
    } else {
        double low[3];
        double high[3];
        lrcsi_view_bounds(c->view, c->view->prepared->scene->facet[facet].corner, 3, low, high);
        *moment = (lrcsi_moment){.error = err * lrcsi_max(high[0] - low[0], high[1] - low[1]) *
                                          (1 + 4 * LRCSI_U)};
    }
}

/* Reports the areas that are accurate enough and not found yet. Returns the number of facets that
   the cells decided, but less accurately. */
static uint32_t areas_report(const lrcsi_cells_work *c, int as_single, unsigned char *found,
                             lrcsi_visible *visible)
{
    uint32_t left = 0;
    for (uint32_t f = 0; f < c->view->prepared->scene->facet_count; f++) {
        if (!c->wanted[f] || found[f] || (c->state[f] & LRCSI_CELLS_UNDECIDED) != 0 ||
            c->state[f] == 0) {
            continue;
        }
        const lrcsi_cells_found *a = &c->area[f];
        double whole = lrcsi_view_projected(c->view, f);
        int some_visible = (c->state[f] & LRCSI_CELLS_VISIBLE) != 0;
        int some_hidden = (c->state[f] & LRCSI_CELLS_HIDDEN) != 0;
        double area = !some_hidden ? whole : !some_visible ? 0 : lrcsi_min(whole, a->visible);
        double err = a->uncertainty;
        err += some_visible && some_hidden ? a->visible_err + 64 * LRCSI_U * a->visible : 0;
        if (err <= ACCURACY_OF_FACET * whole || err <= facet_accuracy(c, f, whole, as_single)) {
            visible[f] =
                (lrcsi_visible){area, lrcsi_max(0, area - err), lrcsi_min(whole, area + err), 0, 0};
            found[f] = 1;
            if (c->moment) {
                moment_report(c, f, some_visible && some_hidden, err);
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
    size_t need = lrcsi_work_blocks(2, facets, 1);
    need = lrcsi_work_add(need, lrcsi_cells_grid_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_cells_facet)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_cells_found)));
    need = lrcsi_work_add(
        need, lrcsi_work_bytes(prepared->scene->vertex_count, sizeof(lrcsi_cells_point)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(6, facets, sizeof(uint32_t)));
    need =
        lrcsi_work_add(need, lrcsi_work_bytes(facets, LRCSI_CELLS_FACET_LISTS * sizeof(uint32_t)));
    need = lrcsi_work_add(need,
                          lrcsi_work_bytes(segments, LRCSI_CELLS_SEGMENT_LISTS * sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(segments, sizeof(lrcsi_cells_segment)));
    need =
        lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELLS_MAX_BORDERS, sizeof(lrcsi_cells_border)));
    return lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELLS_STACK, sizeof(lrcsi_cells_cell)));
}

/* Allocates the arrays of a view, and lists its facets and events in blocks. 0 if the memory does
   not suffice. */
static int cells_allocate(const lrcsi_classification *classification, const unsigned char *answer,
                          lrcs_work *work, lrcsi_cells_work *c)
{
    const lrcs_prepared *p = c->view->prepared;
    uint32_t count = p->scene->facet_count;
    c->state = lrcsi_work_take_zero(work, count, 1);
    c->kind = lrcsi_work_take_zero(work, count, 1);
    c->facet = lrcsi_work_take(work, count, sizeof *c->facet);
    c->area = lrcsi_work_take_zero(work, count, sizeof *c->area);
    c->listed = lrcsi_work_take_zero(work, count, sizeof *c->listed);
    c->covers = lrcsi_work_take_zero(work, count, sizeof *c->covers);
    c->in_component = lrcsi_work_take_zero(work, count, sizeof *c->in_component);
    c->contacts = lrcsi_work_take_zero(work, count, sizeof *c->contacts);
    c->frame.point = lrcsi_work_take_zero(work, p->scene->vertex_count, sizeof *c->frame.point);
    c->component = lrcsi_work_take(work, count, sizeof *c->component);
    c->hit = lrcsi_work_take(work, count, sizeof *c->hit);
    c->facets_room = LRCSI_CELLS_FACET_LISTS * (size_t)count;
    c->facets = lrcsi_work_take(work, c->facets_room, sizeof *c->facets);
    c->border = lrcsi_work_take(work, LRCSI_CELLS_MAX_BORDERS, sizeof *c->border);
    c->stack = lrcsi_work_take(work, LRCSI_CELLS_STACK, sizeof *c->stack);
    if (!c->state || !c->kind || !c->facet || !c->area || !c->listed || !c->covers ||
        !c->in_component || !c->contacts || !c->frame.point || !c->component || !c->hit ||
        !c->facets || !c->border || !c->stack ||
        !lrcsi_cells_grid_make(classification, answer, work, &c->grid)) {
        return 0;
    }
    for (uint32_t f = 0; f < count; f++) {
        c->kind[f] = lrcsi_view_casts(c->view, f) && lrcsi_cells_has_coplanar(c->view, f)
                         ? LRCSI_CELLS_COPLANAR
                         : 0;
    }
    size_t segments = lrcsi_cells_max_segments(c);
    c->segment_room = (uint32_t)segments;
    c->segments_room = LRCSI_CELLS_SEGMENT_LISTS * segments;
    c->segments = lrcsi_work_take(work, c->segments_room, sizeof *c->segments);
    c->segment = lrcsi_work_take(work, segments, sizeof *c->segment);
    lrcsi_cells_frame_make(&c->frame);
    return segments < LRCS_NONE && c->segments && c->segment;
}

void lrcsi_cells_areas(const lrcsi_classification *classification, lrcsi_meter *meter,
                       lrcs_work *work, const unsigned char *answer, const unsigned char *wanted,
                       unsigned char *found, lrcsi_visible *visible, lrcsi_moment *moment)
{
    const lrcsi_view *view = classification->view;
    size_t mark = work->used;
    size_t peak = work->peak; /* restored if memory does not suffice: it is no failure then */
    lrcsi_cells_work c = {
        .view = view, .meter = meter, .frame = {.view = view}, .wanted = wanted, .moment = moment};
    memset(found, 0, view->prepared->scene->facet_count);
    c.negligible =
        0x1p-10 * ACCURACY_OF_SCENE * extent_of(view->prepared) * extent_of(view->prepared);
    if (cells_allocate(classification, answer, work, &c)) {
        for (uint32_t y = 0; y < c.grid.side; y++) {
            lrcsi_view_progress(view, LRCS_PROGRESS_VISIBILITY, y, c.grid.side);
            for (uint32_t x = 0; x < c.grid.side; x++) {
                process_block(&c, x, y);
            }
        }
        /* Facets whose areas are not accurate enough are processed alone; if they are many, only
           those that are much more accurate alone. */
        uint64_t left = areas_report(&c, 0, found, visible);
        if (left * view->prepared->scene->facet_count > MANY_LEFT) {
            areas_report(&c, 1, found, visible);
        }
    } else {
        work->peak = peak;
    }
    work->used = mark;
}
