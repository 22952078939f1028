/* SPDX-License-Identifier: MIT */
/* Exact visibility in convex cells of the view plane. It finds areas with bounds; what facets show
   in pieces is found one by one (visibility/occlude.c).

   A cell is the convex hull of its corners, which are doubles. With it goes a list of the facets
   that may be seen in it, and a list of segments: its event edges and contacts.

   1. The view plane is divided into blocks (visibility/cells_block.h). Each begins as one cell
      (visibility/cells_open.h).
   2. One sample is taken in a cell, at a place P. From the facet nearest to the laser there, the
      surface around it is followed across edges that are no events, as far as the cell goes: the
      component (visibility/cells_cover.h, and why that is right).
   3. If an event or a contact of the component crosses the cell, the cell is cut along its line
      (visibility/cells_cut.h). If none does, the component covers the cell: facets and events
      behind it are dropped from the lists, for all that comes of the cell.
   4. If no event is left, nothing else is seen in the cell: areas are added up. If one is, the cell
      is cut along it.
   5. What errors put undecided along events is charged to the facets near them
      (visibility/cells_charge.h). A facet's area is told where its error is small enough.

   The area of a facet in a cell is off by the error of its sides times their length there, and by
   4 u b and the cell's drift times the perimeter of what it has there (visibility/cells_charge.c).
 */
#include "visibility/cells.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/cells_charge.h"
#include "visibility/cells_cover.h"
#include "visibility/cells_cut.h"
#include "visibility/cells_open.h"

/* Steps that a block may take: so many, for each facet and segment in it, and for each cell that is
   decided. Ordinary scenes take a tenth of this, or less. */
#define STEPS_LEAST   65536u
#define STEPS_EACH    4096u
#define STEPS_DECIDED 4096u
/* An area may be off by so much of itself, and of the square of the scene's extent. */
#define ACCURACY_OF_FACET 1e-12
#define ACCURACY_OF_SCENE 1e-15
/* So many facets to be clipped, times those that might hide them, are many: clipping each asks
   about all of them. */
#define MANY_LEFT 65536u
/* How much less accurate than clipping areas may be then. */
#define AS_CLIPPING 4
/* A facet with less of its diameter's square is a needle. */
#define NEEDLE 0x1p-18

/* --- one cell --------------------------------------------------------------------------------- */

/* Nothing can be decided about the cell. */
static void cells_leave(lrcsi_cells_work *c, const lrcsi_cells_cell *cell)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        c->found[c->facets[i]] |= LRCSI_CELLS_OPEN;
    }
}

/* Is a facet in the list whose area is wanted? */
static int cells_wanted(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = c->facets[i];
        if (c->open[f] && (c->found[f] & LRCSI_CELLS_OPEN) == 0) {
            return 1;
        }
    }
    return 0;
}

/* A facet is seen wherever it is in the cell. Of the cell's sides, and of its own, only what is in
   both boxes matters: a convex curve is no longer there than the box is around. */
static void facet_seen(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_sides *s, uint32_t facet)
{
    const lrcsi_cells_facet *f = &c->facet[facet];
    lrcsi_cells_found *area = &c->area[facet];
    lrcsi_clip_polygon piece = cell->shape;
    double w = f->off + s->g;
    double wide[2];
    for (int k = 0; k < 2; k++) {
        wide[k] =
            lrcsi_most(0, lrcsi_least(s->high[k], f->high[k]) - lrcsi_most(s->low[k], f->low[k])) +
            4 * w;
    }
    double around = wide[0] + wide[1];
    area->off += 2 * (cell->drift + 4 * LRCSI_U * c->reach) * around +
                 5 * LRCSI_U * (piece.count + 3) * wide[0] * wide[1];
    for (int k = 0; k < 3 && piece.count > 0; k++) {
        double range[2];
        lrcsi_box_range(s->low, s->high, f->side[k], range);
        if (range[0] < w) {
            lrcsi_line_range(&cell->shape, f->side[k], range);
        }
        if (range[0] < w) {
            area->off +=
                (f->line_off + 12 * LRCSI_U * c->reach) * lrcsi_least(f->length[k] + 4 * w, around);
            lrcsi_cells_shape_clip(&piece, f->side[k]);
        }
    }
    area->seen += piece.count >= 3 ? lrcsi_most(0, lrcsi_clip_area(&piece)) : 0;
}

/* All of the cell shows the component, or nothing where that has no facets. */
static void cells_decide(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                         const lrcsi_cells_sides *s, double uncertainty)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = c->facets[i];
        if (!c->open[f]) {
            continue;
        }
        int seen = c->components > 0 && c->joined[f] == c->look;
        c->found[f] |= seen ? LRCSI_CELLS_SEEN : LRCSI_CELLS_HIDDEN;
        c->area[f].uncertainty += uncertainty;
        if (seen) {
            facet_seen(c, cell, s, f);
        }
    }
}

enum { CHOOSE_OWN, CHOOSE_EDGES, CHOOSE_ANY };

/* Of the segments of a kind, the one whose line divides the cell most evenly, or NULL: the one with
   the most of the cell's width on that side of its line where less of it is. So cells shrink fast,
   and few are as long as narrow strips of facets are. */
static const lrcsi_cells_segment *cells_choose(const lrcsi_cells_work *c,
                                               const lrcsi_cells_cell *cell, int which)
{
    const lrcsi_cells_segment *best = NULL;
    double most = -HUGE_VAL;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[c->segments[i]];
        if (which == CHOOSE_ANY || (which == CHOOSE_EDGES && !e->contact) ||
            (which == CHOOSE_OWN && lrcsi_cells_owned(c, e))) {
            double range[2];
            lrcsi_line_range(&cell->shape, e->line, range);
            double less = lrcsi_least(-range[0], range[1]);
            best = less > most ? e : best;
            most = lrcsi_most(most, less);
        }
    }
    return best;
}

/* The nearest facet at the sample, there, and how far inside the cell that is. */
typedef struct cells_seen {
    uint32_t best;
    double at[2];
    double clear;
} cells_seen;

/* Drops what is behind surfaces that cover the cell. 1 if the component around the nearest facet
   does; else the segment of the component at which to cut, if it has one. *uncertainty: what any
   facet of a thin cell may be off by. */
static int cells_cover(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                       const cells_seen *seen, double *uncertainty, const lrcsi_cells_segment **cut)
{
    /* 1. A facet that covers the cell alone. */
    uint32_t screen = lrcsi_cells_screen(c, cell, s, seen->at);
    if (screen != LRCS_NONE) {
        lrcsi_cells_component_of(c, screen);
        *uncertainty = lrcsi_cells_thin(cell, s, seen->clear, cell->struck + c->borders, c->off);
        lrcsi_cells_drop(c, cell, s, screen == seen->best ? NULL : seen->at, *uncertainty);
        if (screen == seen->best) {
            return 1;
        }
        c->joined[screen] = 0;
    }
    /* 2. The component around the nearest facet. */
    int covers = lrcsi_cells_component(c, cell, s, seen->best);
    *cut = cells_choose(c, cell, CHOOSE_OWN);
    if (!covers || *cut) {
        return 0;
    }
    for (uint32_t i = 0; i < c->borders; i++) {
        lrcsi_cells_charge_border(c, cell, s, &c->border[i]);
    }
    *uncertainty = lrcsi_cells_thin(cell, s, seen->clear, cell->struck + c->borders, c->off);
    lrcsi_cells_drop(c, cell, s, NULL, *uncertainty);
    return 1;
}

/* Does one cell: it is decided (1), cut, or left. */
static int cells_do(lrcsi_cells_work *c, lrcsi_cells_cell *cell)
{
    lrcsi_cells_sides s;
    if (!cells_wanted(c, cell)) {
        return 0;
    }
    lrcsi_cells_sides_make(&cell->shape, lrcsi_cells_reach(c, cell), &s);
    lrcsi_cells_strike(c, cell, &s);
    c->components = 0;

    /* 1. A sample. */
    cells_seen seen = {.best = LRCS_NONE};
    int answer = lrcsi_cells_look(c, cell, &s, &seen.best, seen.at, &seen.clear);
    if (answer == LRCSI_CELLS_UNSURE && lrcsi_cells_charge_all(c, cell, &s)) {
        return 0;
    }

    /* 2. What is behind covers. */
    double uncertainty = 0;
    const lrcsi_cells_segment *cut = NULL;
    int told = answer == LRCSI_CELLS_FOUND ? cells_cover(c, cell, &s, &seen, &uncertainty, &cut)
                                           : answer == LRCSI_CELLS_NONE;

    /* 3. Decided, or cut. */
    if (!cut) {
        cut = cells_choose(c, cell, told ? CHOOSE_EDGES : CHOOSE_ANY);
        if (!cut && told) {
            cells_decide(c, cell, &s, cell->uncertainty + uncertainty);
            return 1;
        }
    }
    if (!cut || !lrcsi_cells_divide(c, cell, &s, cut)) {
        cells_leave(c, cell);
    }
    return 0;
}

/* --- one block -------------------------------------------------------------------------------- */

/* Facets of a block that is not done stay open. */
static void block_leave(lrcsi_cells_work *c, size_t block)
{
    for (uint32_t i = c->grid.facets.first[block]; i < c->grid.facets.first[block + 1]; i++) {
        c->found[c->grid.facets.item[i]] |= LRCSI_CELLS_OPEN;
    }
}

static int block_wanted(const lrcsi_cells_work *c, size_t block)
{
    for (uint32_t i = c->grid.facets.first[block]; i < c->grid.facets.first[block + 1]; i++) {
        if (c->open[c->grid.facets.item[i]]) {
            return 1;
        }
    }
    return 0;
}

static void block_do(lrcsi_cells_work *c, uint32_t x, uint32_t y)
{
    lrcsi_meter *meter = c->view->meter;
    size_t block = (size_t)y * c->grid.side + x;
    if (!block_wanted(c, block)) {
        return;
    }
    lrcsi_cells_cell cell = {.cuts = 0};
    c->reach = lrcsi_cells_grid_square(&c->grid, x, y, &cell.shape, c->frame.middle);
    c->frame.block = (uint32_t)block + 1;
    c->look++;
    if (!lrcsi_cells_open(c, block, &cell)) {
        block_leave(c, block);
        return;
    }
    /* Where that takes long and decides little, the rest is clipped facet by facet. */
    uint64_t most = STEPS_LEAST + STEPS_EACH * (uint64_t)(cell.facets + cell.segments);
    c->stack[0] = cell;
    c->top = 1;
    while (c->top > 0) {
        cell = lrcsi_cells_take(c);
        uint64_t steps = (uint64_t)1 + cell.facets + cell.segments;
        if (steps > most || !lrcsi_meter_take(meter, steps)) {
            block_leave(c, block);
            return;
        }
        most -= steps;
        most += cells_do(c, &cell) ? STEPS_DECIDED : 0;
    }
}

/* --- all blocks ------------------------------------------------------------------------------- */

static lrcsi_visible facet_decided(const lrcsi_cells_work *c, uint32_t facet, double whole,
                                   double *off)
{
    const lrcsi_cells_found *a = &c->area[facet];
    double seen = (c->found[facet] & LRCSI_CELLS_HIDDEN) == 0 ? whole
                  : (c->found[facet] & LRCSI_CELLS_SEEN) == 0 ? 0
                                                              : lrcsi_least(whole, a->seen);
    int mixed =
        (c->found[facet] & LRCSI_CELLS_SEEN) != 0 && (c->found[facet] & LRCSI_CELLS_HIDDEN) != 0;
    *off = a->uncertainty + (mixed ? a->off + 64 * LRCSI_U * a->seen : 0);
    return (lrcsi_visible){seen, lrcsi_most(0, seen - *off), lrcsi_least(whole, seen + *off), 0, 0};
}

/* That of the bulk of a scene. */
static double extent_of(const lrcs_prepared *p)
{
    return 2 * lrcsi_most(p->bulk[0], lrcsi_most(p->bulk[1], p->bulk[2]));
}

/* What a facet's area may be off by, so that it is told: what DESIGN.md promises; or, where too
   many would be left, four times what clipping the facet alone would charge at least
   (visibility/occlude.c): 52 u of its diameter times its perimeter, and for each cut a strip 128 u
   of the diameter wide. Needles, and what is larger than the bulk of the scene, are found better
   one by one. */
static double facet_accuracy(const lrcsi_cells_work *c, uint32_t facet, double projected,
                             int as_clipping)
{
    const uint32_t *corner = c->view->prepared->scene->facet[facet].corner;
    double diameter = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = c->view->point[corner[k]].x;
        const double *q = c->view->point[corner[(k + 1) % 3]].x;
        diameter = lrcsi_most(diameter, lrcsi_most(fabs(p[0] - q[0]), fabs(p[1] - q[1])));
    }
    double extent = extent_of(c->view->prepared);
    int ordinary = projected > NEEDLE * diameter * diameter && diameter < 2 * extent;
    double alone = LRCSI_U * diameter * (104 * diameter + 128 * c->area[facet].cut);
    alone = as_clipping ? AS_CLIPPING * alone : 0;
    return ACCURACY_OF_FACET * projected +
           (ordinary ? lrcsi_most(alone, ACCURACY_OF_SCENE * extent * extent) : 0);
}

/* Tells the areas that are accurate enough. Returns how many are not, though cells decided them. */
static uint32_t areas_tell(const lrcsi_cells_work *c, int as_clipping, lrcsi_visible *visible)
{
    uint32_t left = 0;
    for (uint32_t f = 0; f < c->view->prepared->scene->facet_count; f++) {
        if (!c->open[f] || (c->found[f] & LRCSI_CELLS_OPEN) != 0 || c->found[f] == 0) {
            continue;
        }
        double off;
        double projected = lrcsi_view_projected(c->view, f);
        lrcsi_visible area = facet_decided(c, f, projected, &off);
        if (off <= ACCURACY_OF_FACET * projected ||
            off <= facet_accuracy(c, f, projected, as_clipping)) {
            visible[f] = area;
            c->open[f] = 0;
        } else {
            left++;
        }
    }
    return left;
}

/* Segments for which lrcsi_cells_need has room: all edges and contacts may stand in one block.
   Where coplanar facets and rims add more than find room, facets are clipped one by one. */
static size_t segments_need(const lrcs_prepared *p)
{
    return (size_t)p->topology.edge_count + p->intersections.count;
}

size_t lrcsi_cells_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t segments = segments_need(prepared);
    size_t need = 2 * lrcsi_work_bytes(facets, 1);
    need = lrcsi_work_add(need, lrcsi_cells_grid_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_cells_facet)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_cells_found)));
    need = lrcsi_work_add(
        need, lrcsi_work_bytes(prepared->scene->vertex_count, sizeof(lrcsi_cells_point)));
    need = lrcsi_work_add(need, 6 * lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(segments, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(segments, sizeof(lrcsi_cells_segment)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELLS_BORDERS, sizeof(lrcsi_cells_border)));
    return lrcsi_work_add(need, lrcsi_work_bytes(LRCSI_CELLS_WAITING, sizeof(lrcsi_cells_cell)));
}

/* Takes what the view needs, and files its facets and events in blocks. 0 if there is not enough
   memory. */
static int cells_make(const lrcsi_classification *classification, lrcs_work *work,
                      lrcsi_cells_work *c)
{
    const lrcs_prepared *p = c->view->prepared;
    uint32_t count = p->scene->facet_count;
    c->found = lrcsi_work_take_zero(work, count, 1);
    c->kind = lrcsi_work_take_zero(work, count, 1);
    c->facet = lrcsi_work_take(work, count, sizeof *c->facet);
    c->area = lrcsi_work_take_zero(work, count, sizeof *c->area);
    c->listed = lrcsi_work_take_zero(work, count, sizeof *c->listed);
    c->met = lrcsi_work_take_zero(work, count, sizeof *c->met);
    c->joined = lrcsi_work_take_zero(work, count, sizeof *c->joined);
    c->frame.point = lrcsi_work_take_zero(work, p->scene->vertex_count, sizeof *c->frame.point);
    c->component = lrcsi_work_take(work, count, sizeof *c->component);
    c->hit = lrcsi_work_take(work, count, sizeof *c->hit);
    c->facets = lrcsi_work_take(work, count, sizeof *c->facets);
    c->border = lrcsi_work_take(work, LRCSI_CELLS_BORDERS, sizeof *c->border);
    c->stack = lrcsi_work_take(work, LRCSI_CELLS_WAITING, sizeof *c->stack);
    if (!c->found || !c->kind || !c->facet || !c->area || !c->listed || !c->met || !c->joined ||
        !c->frame.point || !c->component || !c->hit || !c->facets || !c->border || !c->stack ||
        !lrcsi_cells_grid_make(classification, work, &c->grid)) {
        return 0;
    }
    for (uint32_t f = 0; f < count; f++) {
        c->kind[f] =
            lrcsi_grid_casts(c->view, f) && lrcsi_cells_apart(c->view, f) ? LRCSI_CELLS_APART : 0;
    }
    size_t segments = lrcsi_cells_segments_most(c);
    c->segment_room = (uint32_t)segments;
    c->segments = lrcsi_work_take(work, segments, sizeof *c->segments);
    c->segment = lrcsi_work_take(work, segments, sizeof *c->segment);
    lrcsi_cells_frame_make(&c->frame);
    return segments < LRCS_NONE && c->segments && c->segment;
}

void lrcsi_cells_areas(const lrcsi_classification *classification, lrcs_work *work,
                       unsigned char *open, lrcsi_visible *visible)
{
    const lrcsi_view *view = classification->view;
    size_t mark = work->used;
    size_t peak = work->peak; /* nothing is missing where this finds no memory */
    lrcsi_cells_work c = {.view = view, .frame = {.view = view}, .open = open};
    c.trifle = 0x1p-10 * ACCURACY_OF_SCENE * extent_of(view->prepared) * extent_of(view->prepared);
    if (!view->prepared->convex && cells_make(classification, work, &c)) {
        for (uint32_t y = 0; y < c.grid.side; y++) {
            lrcsi_view_progress(view, LRCS_PROGRESS_VISIBILITY, y, c.grid.side);
            for (uint32_t x = 0; x < c.grid.side; x++) {
                block_do(&c, x, y);
            }
        }
        /* A few facets that are less accurate than is promised are clipped; of many, those of which
           clipping would tell much more. */
        uint64_t left = areas_tell(&c, 0, visible);
        if (left * view->prepared->scene->facet_count > MANY_LEFT) {
            areas_tell(&c, 1, visible);
        }
    } else {
        work->peak = peak;
    }
    work->used = mark;
}
