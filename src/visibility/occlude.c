/* SPDX-License-Identifier: MIT */
/* Analytic visibility of contested facets. The facet is halved until few occluders overlap a cell;
   of a cell that nothing divides (visibility/calm.h) one sample tells all; one that an occluder
   covers is hidden, one that none overlaps is visible, and from the others the few are cut out. So
   the work grows with the occluders near the edges of shadows, not with the square of all.

   Error. In the facet's frame (visibility/target.c) corners are off by at most e = 10 u r, r the
   largest distance in space of the corners at hand from the facet's first one: R's rows are
   orthonormal to 4 u; a rounded difference, three products and two sums. Let p be the perimeter
   of the facet's projection, d its diameter, 2 d <= p. The facet's own corners move its rim by
   e: 2 e p, charged once.

   The region that an occluder hides is cut by the lines through its own computed corners. Their
   hull and the true one lie within e of each other; deciding in doubles on which side of a line a
   point lies is wrong within w = 4 u (r + d) of it; a cut left out for want of a direction
   (visibility/occluder.c) is a strip 32 u r wide. So what is hidden as computed and what is in
   truth differ, within a convex cell of perimeter q, by at most 2 e q + 4 w q + 16 u r q, less than
   56 u (r + d) q; and all over by as much with the region's own outline for q, where it is wide
   enough for its lines to end where it does. The cut by the facet's plane ends on the occluder's
   sides; how far those ends may slip is added to the rim. And in a cell nothing can be wrong by
   more than its area. So an occluder is charged with the least of three: the sum over the cells
   where it could matter, of the lesser of rim q and their area; rim times outline; rim p. In a
   cell that lies surely apart from it, or surely behind it, it is not charged, nor are the others
   where one surely covers all.

   A split puts two corners on the sides of a piece to within 5 u d. Both parts share them, so that
   only the two sides bend, by 5 u d d' of area in a cell of diameter d'; and there are two more
   triangles to sum areas from, 7 u d'^2: together below 8 u d q. Adding up the cells costs u d p
   each. A cell that could not be finished counts whole. */
#include "visibility/occlude.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/occluder.h"
#include "visibility/query.h"

#define U 0x1p-53

/* Cells with this many occluders are cut, not halved; nor are cells that this many halvings in a
   row have not relieved of a quarter of them. */
#define LEAF_OCCLUDERS 8u
#define LEAF_STALE     6u
/* Halvings at most: a cell is then below 2^-48 of its facet. */
#define MOST_DEPTH 48u

/* --- cells ------------------------------------------------------------------------------------ */

static double split_error(const lrcsi_occluding *o, const lrcsi_clip_polygon *shape)
{
    return 8 * U * o->target.diameter * lrcsi_clip_polygon_perimeter(shape);
}

/* Charges an occluder with what it may be wrong by in a cell; its area is off as if by a split. */
static void cell_charge(const lrcsi_occluding *o, uint32_t index, const lrcsi_clip_polygon *shape,
                        double area)
{
    lrcsi_occluder *occluder = &o->occluder[index];
    double rim = occluder->error * lrcsi_clip_polygon_perimeter(shape);
    occluder->charged += lrcsi_least(rim, area + split_error(o, shape));
}

/* Files those of the cell's occluders that may overlap its shape behind their list. Returns how
   many; LRCS_NONE where one of them covers the shape. */
static uint32_t cell_keep(lrcsi_occluding *o, const lrcsi_occlude_cell *cell, double area)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->count; i++) {
        uint32_t index = o->list[cell->first + i];
        int overlap = lrcsi_clip_overlap(&cell->shape, &o->occluder[index].region);
        if (overlap == LRCSI_CLIP_COVERED) {
            cell_charge(o, index, &cell->shape, area);
        }
        if (overlap == LRCSI_CLIP_COVERED || overlap == LRCSI_CLIP_BURIED) {
            return LRCS_NONE;
        }
        if (overlap == LRCSI_CLIP_SOME) {
            o->list[cell->first + cell->count + kept++] = index;
        }
    }
    return kept;
}

/* Cuts the kept occluders out of the cell. 0 where it fell into too many pieces. */
static int cell_cut(lrcsi_occluding *o, const lrcsi_occlude_cell *cell, uint32_t kept, double area)
{
    const uint32_t *list = o->list + cell->first + cell->count;
    lrcsi_clip_start(&o->clip, &cell->shape);
    for (uint32_t i = 0; i < kept; i++) {
        if (!lrcsi_clip_subtract(&o->clip, &o->occluder[list[i]].region)) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < kept; i++) {
        cell_charge(o, list[i], &cell->shape, area);
    }
    o->off += o->clip.splits * split_error(o, &cell->shape) +
              U * o->target.diameter * o->target.perimeter;
    o->area += lrcsi_clip_area(&o->clip);
    return 1;
}

/* Where the list of a cell's halves stands: its own, where it has kept all of that. */
static uint32_t cell_list(const lrcsi_occlude_cell *cell, uint32_t kept)
{
    return kept == cell->count ? cell->first : cell->first + cell->count;
}

/* Puts both halves of a cell on the stack in its stead. */
static void cell_halve(lrcsi_occluding *o, const lrcsi_occlude_cell *cell, uint32_t kept)
{
    lrcsi_occlude_cell half = {.first = cell_list(cell, kept), .count = kept};
    half.depth = cell->depth + 1;
    half.edge_first = cell->edge_first;
    half.edge_count = cell->edge_count;
    half.stale = 4 * (size_t)kept > 3 * (size_t)cell->count ? cell->stale + 1 : 0;
    lrcsi_clip_polygon other;
    lrcsi_clip_halve(&cell->shape, &half.shape, &other);
    o->off += split_error(o, &cell->shape);
    o->stack[o->top++] = half;
    half.shape = other;
    o->stack[o->top++] = half;
}

/* Narrows the list of what may divide the cell. What the cell shows where nothing does, a
   lrcsi_query_answer; undecided elsewhere. */
static int cell_calm(lrcsi_occluding *o, lrcsi_occlude_cell *cell)
{
    if (cell->edge_count == LRCS_NONE) {
        return LRCSI_QUERY_UNDECIDED;
    }
    uint32_t kept = lrcsi_calm_keep(&o->calm, &cell->shape, cell->edge_first, cell->edge_count);
    cell->edge_first += kept == cell->edge_count ? 0 : cell->edge_count;
    cell->edge_count = kept;
    return kept == 0 ? lrcsi_calm_answer(&o->calm, &o->facets, &cell->shape)
                     : LRCSI_QUERY_UNDECIDED;
}

/* All of the cell is visible: its one piece. */
static void cell_show(lrcsi_occluding *o, const lrcsi_occlude_cell *cell, double area)
{
    lrcsi_clip_start(&o->clip, &cell->shape);
    o->off += U * o->target.diameter * o->target.perimeter;
    o->area += area;
}

/* Does one cell after the other until one has shown pieces: 1; 0 where no cell is left. Each
   cell's list stands behind its parent's, or is that; a sibling done later overwrites it. */
static int occlude_cells(lrcsi_occluding *o)
{
    while (o->top > 0) {
        lrcsi_occlude_cell cell = o->stack[--o->top];
        double area = cell.shape.count < 3 ? 0 : lrcsi_clip_polygon_area(&cell.shape);
        if (!(area > 0)) {
            continue; /* no area, or less than the splits' error already holds */
        }
        int shows = cell_calm(o, &cell);
        if (shows == LRCSI_QUERY_VISIBLE) {
            cell_show(o, &cell, area);
            return 1;
        }
        uint32_t kept = shows == LRCSI_QUERY_HIDDEN ? LRCS_NONE : cell_keep(o, &cell, area);
        if (kept == LRCS_NONE) {
            continue;
        }
        int leaf = kept <= LEAF_OCCLUDERS || cell.stale >= LEAF_STALE;
        if (leaf && cell_cut(o, &cell, kept, area)) {
            return 1;
        }
        size_t end = (size_t)cell_list(&cell, kept) + kept;
        if (cell.depth < MOST_DEPTH && end + kept <= o->room) {
            cell_halve(o, &cell, kept);
        } else {
            o->doubt += area;
        }
    }
    return 0;
}

/* --- one facet -------------------------------------------------------------------------------- */

/* The facets near the target that may hide some of it, each once. */
static uint32_t occlude_candidates(lrcsi_occluding *o)
{
    const lrcsi_target *target = &o->target;
    const lrcsi_grid *facets = &o->facets;
    double low[2];
    double high[2];
    lrcsi_grid_box(target->view, target->view->prepared->scene->facet[target->facet].corner, 3, low,
                   high);
    lrcsi_cells cells = lrcsi_grid_cells(facets, low, high);
    uint32_t count = 0;
    o->asks++;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = facets->first[(size_t)y * facets->size + cells.x0];
        uint32_t end = facets->first[(size_t)y * facets->size + cells.x1];
        for (; i < end; i++) {
            uint32_t other = facets->item[i];
            if (other != target->facet && o->asked[other] != o->asks) {
                o->asked[other] = o->asks;
                o->candidate[count++] = other;
            }
        }
    }
    return count;
}

/* What an occluder may be wrong by all over the facet. */
static double occluder_most(const lrcsi_occluding *o, const lrcsi_occluder *occluder)
{
    return occluder->error * lrcsi_least(occluder->outline, o->target.perimeter);
}

/* The regions that the candidates hide. 1; 0 where one of them hides all of the target. */
static int occlude_regions(lrcsi_occluding *o, uint32_t candidates)
{
    lrcsi_clip_polygon whole;
    lrcsi_clip_triangle((const double(*)[2])o->target.corner, &whole);
    o->count = 0;
    for (uint32_t i = 0; i < candidates; i++) {
        lrcsi_occluder *occluder = &o->occluder[o->count];
        if (!lrcsi_occluder_make(&o->target, o->candidate[i], occluder)) {
            o->off += occluder->error > 0 ? occluder_most(o, occluder) : 0;
            continue;
        }
        int overlap = lrcsi_clip_overlap(&whole, &occluder->region);
        if (overlap == LRCSI_CLIP_COVERED || overlap == LRCSI_CLIP_BURIED) {
            o->off = overlap == LRCSI_CLIP_COVERED ? occluder_most(o, occluder) : 0;
            o->count = 0;
            return 0;
        }
        o->count++;
    }
    return 1;
}

/* Readies a contested facet: its occluders, and all of it as the first cell. */
static int contested_open(lrcsi_occluding *o, uint32_t facet)
{
    lrcsi_target_make(o->contest->view, facet, &o->target);
    uint32_t candidates = occlude_candidates(o);
    o->area = o->doubt = o->off = 0;
    o->occluder = lrcsi_work_take(o->work, candidates, sizeof *o->occluder);
    if (!o->occluder) {
        return LRCS_E_MEMORY;
    }
    int some = occlude_regions(o, candidates);
    o->room = 8 * (size_t)o->count + 1024;
    o->list = lrcsi_work_take(o->work, o->room, sizeof *o->list);
    if (!o->list) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < o->count; i++) {
        o->list[i] = i;
    }
    if (some) {
        uint32_t edges = lrcsi_calm_start(&o->calm, o->contest, &o->target);
        o->stack[0] = (lrcsi_occlude_cell){.count = o->count, .edge_count = edges};
        lrcsi_clip_triangle((const double(*)[2])o->target.corner, &o->stack[0].shape);
        o->top = 1;
    }
    return LRCS_OK;
}

static lrcsi_visible clipped_area(const lrcsi_occluding *o)
{
    double whole = lrcsi_view_tilt(o->contest->view, o->target.facet).projected;
    double own = 20 * U * o->target.reach + 32 * U * o->target.diameter;
    double error = own * o->target.perimeter + o->off;
    for (uint32_t i = 0; i < o->count; i++) {
        error += lrcsi_least(o->occluder[i].charged, occluder_most(o, &o->occluder[i]));
    }
    double left = lrcsi_most(0, lrcsi_least(whole, o->area));
    if (!isfinite(error)) {
        return (lrcsi_visible){left, 0, whole, 0, 0};
    }
    return (lrcsi_visible){left, lrcsi_most(0, left - error),
                           lrcsi_least(whole, left + o->doubt + error), 0, 0};
}

lrcsi_visible lrcsi_occlude_unknown(const lrcsi_view *view, uint32_t facet)
{
    double whole = lrcsi_view_tilt(view, facet).projected;
    return (lrcsi_visible){0.5 * whole, 0, whole, 0, 0};
}

static lrcsi_visible answered_area(const lrcsi_occluding *o, uint32_t facet)
{
    double whole = lrcsi_view_tilt(o->contest->view, facet).projected;
    switch (o->uniform[facet]) {
    case LRCSI_QUERY_HIDDEN:
        return (lrcsi_visible){0, 0, 0, 0, 0};
    case LRCSI_QUERY_VISIBLE:
        return (lrcsi_visible){whole, whole, whole, 0, 0};
    default:
        return lrcsi_occlude_unknown(o->contest->view, facet);
    }
}

int lrcsi_occlude_open(lrcsi_occluding *o, uint32_t facet)
{
    lrcsi_contest *contest = o->contest;
    o->mark = o->work->used;
    o->answer = (lrcsi_visible){0, 0, 0, 0, 0};
    o->target.facet = facet;
    o->contested = o->whole = 0;
    o->top = 0;
    if (!lrcsi_grid_casts(contest->view, facet)) {
        return LRCS_OK;
    }
    if (!contest->contested[facet]) {
        o->answer = answered_area(o, facet);
        o->whole = o->answer.low > 0;
        return LRCS_OK;
    }
    o->contested = !lrcsi_query_screened(contest, &o->facets, facet);
    int status = o->contested ? contested_open(o, facet) : LRCS_OK;
    if (status != LRCS_OK) {
        o->work->used = o->mark;
    }
    return status;
}

int lrcsi_occlude_next(lrcsi_occluding *o)
{
    lrcsi_clip_polygon triangle;
    if (!o->whole) {
        return occlude_cells(o);
    }
    o->whole = 0;
    lrcsi_target_make(o->contest->view, o->target.facet, &o->target);
    lrcsi_clip_triangle((const double(*)[2])o->target.corner, &triangle);
    lrcsi_clip_start(&o->clip, &triangle);
    return 1;
}

lrcsi_visible lrcsi_occlude_close(lrcsi_occluding *o)
{
    o->work->used = o->mark;
    return o->contested ? clipped_area(o) : o->answer;
}

lrcsi_visible lrcsi_occlude_area(lrcsi_occluding *o)
{
    while (occlude_cells(o)) {
    }
    return lrcsi_occlude_close(o);
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcsi_occlude_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_clip_need(), lrcsi_grid_facets_need(prepared));
    need = lrcsi_work_add(need, lrcsi_calm_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(MOST_DEPTH + 2, sizeof(lrcsi_occlude_cell)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 2 * sizeof(uint32_t) + 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_occluder)));
    return lrcsi_work_add(need, lrcsi_work_bytes(8 * facets + 2048, sizeof(uint32_t)));
}

int lrcsi_occlude_make(lrcsi_contest *contest, lrcs_work *work, lrcsi_occluding *o)
{
    uint32_t count = contest->view->prepared->scene->facet_count;
    size_t mark = work->used;
    *o = (lrcsi_occluding){.contest = contest, .work = work};
    o->uniform = lrcsi_work_take(work, count, 1);
    o->asked = lrcsi_work_take_zero(work, count, sizeof *o->asked);
    o->candidate = lrcsi_work_take(work, count, sizeof *o->candidate);
    o->stack = lrcsi_work_take(work, MOST_DEPTH + 2, sizeof *o->stack);
    int status = LRCS_E_MEMORY;
    if (o->uniform && o->asked && o->candidate && o->stack &&
        lrcsi_clip_make(work, &o->clip) == LRCS_OK &&
        lrcsi_calm_make(contest->view->prepared, work, &o->calm) == LRCS_OK) {
        status = lrcsi_query_uniform(contest, work, &o->facets, o->uniform);
    }
    if (status != LRCS_OK) {
        work->used = mark;
    }
    return status;
}

int lrcsi_occlude_all(lrcsi_contest *contest, lrcs_work *work, lrcsi_visible *visible,
                      uint32_t *starved)
{
    const lrcsi_view *view = contest->view;
    size_t mark = work->used;
    lrcsi_occluding o;
    int status = lrcsi_occlude_make(contest, work, &o);
    *starved = 0;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        if (lrcsi_occlude_open(&o, f) == LRCS_OK) {
            visible[f] = lrcsi_occlude_area(&o);
        } else {
            visible[f] = lrcsi_occlude_unknown(view, f);
            ++*starved;
        }
    }
    work->used = mark;
    return status;
}
