/* SPDX-License-Identifier: MIT */
/* Analytic visibility of undecided facets. The facet is cut into cells along what may divide it
   (visibility/cut.c) until nothing divides a cell: then one exact sample tells all of it
   (visibility/cover.c). A sample taken on the way may tell that one component hides all of a cell,
   whatever else divides it, and where not, along which component's edges to cut. So the work grows
   with what is visible, not with what is hidden behind it. A cell that many divide is halved first:
   they meet few of the small ones.

   Error. In the facet's frame (visibility/target.c) corners are off by at most e = 10 u r, r the
   facet's reach: R's rows are orthonormal to 4 u; a rounded difference, three products and two
   sums. Let p be the perimeter of the facet's projection, d its diameter. Its own corners move its
   rim by e: 2 e p, charged once.

   A cell is cut along the line of a segment, or lies on one side of it; then the segment lies
   within its width w of the line, and the cell, and all that come of it, on one side but for w
   (visibility/cut.c). Let P be the place of a sample, clear of the cell's sides by c > 2 w and what
   it may be off itself, and x any point of the cell. The way straight from x to P crosses the
   segment only if x lies in its strip, within w of the line: P does not. Then it is out of the
   strip after 2 w / c of its length, so that x lies no farther along the line beyond the segment
   than 2 w / c of the cell's diameter: 2^20 w, where the cell is not thin. So what the segment may
   change is in a strip 2 w wide and as long as the segment's part there and FAR w; that, or the
   cell's area if less, is charged as the segment is struck from the cell's list, and serves all
   cells that come of it. In a thin cell the whole strip of each is charged. Everything else of a
   cell is seen as P is: what still divides the cell where one component hides it does not divide
   that component.

   A cell of which the sample is a guess, or that could not be divided further, counts as undecided:
   the bounds let all of it be visible, or hidden. So does one that is left when the view's meter is
   spent, as half visible.

   A split puts two corners on the sides of a piece to within 5 u d. Both parts share them, so that
   only the two sides bend, by 5 u d d' of area in a cell of diameter d'; and there are two more
   triangles to sum areas from, 7 u d'^2: together below 8 u d q, q the cell's perimeter. Adding up
   the cells costs u d p each.

   A needle in the view may be no wider than all this. It is done in the frame of its shares
   (visibility/target.h), where it is as wide as long, and all of the above holds as it stands: its
   corners are exact but for the frame's slip, segments come clipped to a box around it, and are off
   as visibility/cut.c tells; samples are taken at points that are not rounded. Areas are counted in
   units of twice the facet's projection, which is off by its own error. */
#include "visibility/reference/occlude.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/cells.h"
#include "visibility/query.h"

#define U 0x1p-53

/* Cells that more cuts divide are halved, until that does not relieve one of a quarter of them. */
#define LEAF_CUTS 12u
/* Halvings at most: a cell is then below 2^-48 of its facet. */
#define MOST_DEPTH 48u
/* A cell is thin whose sample stands nearer to a side than this of its perimeter; in others strips
   reach FAR widths beyond the ends of segments. */
#define THIN 0x1p-20
#define FAR  0x1p22
/* A cell without place for a sample whose area is more than so many margins wide is only odd in
   shape: it is halved, but half of all cells are for those that cuts divide. */
#define NARROW 64.0
/* A cell no larger than so many margins is left undecided. */
#define TINY_MARGINS 64.0
/* Cells that wait at most. Of two, that with the sample comes first: the other has all the room. */
#define MOST_WAITING 256u
/* So many undecided facets, or more, are done together (visibility/cells.h), if they are one of so
   many facets at least: all facets are sorted into the blocks for that, which costs more than to
   clip a few of them. */
#define CELLS_LEAST 192u
#define CELLS_SHARE 32u
/* Cells that a facet may be cut into: so many, and so many a cut. */
#define PARTS_MOST  4096u
#define PARTS_A_CUT 256u

/* --- cells ------------------------------------------------------------------------------------ */

/* How far a place must lie within a cell of such an inset to stand for it. */
static double cell_margin(const ref_occluding *o, double inset)
{
    return 2 * inset + 16 * U * o->frame.diameter + 2 * o->frame.position_err;
}

/* How far the point of a sample may be from its place. */
static double cell_off(const ref_occluding *o)
{
    return lrcsi_target_unproject_err(&o->frame) + o->frame.position_err;
}

/* Is the cell known to be visible at a place that stands clear within it? */
static int cell_lit(const ref_occluding *o, const ref_occlude_cell *cell)
{
    return cell->lit &&
           ref_clip_clear(&cell->shape, cell->at) > cell_margin(o, cell->inset) + cell_off(o);
}

/* What is known of a cell at a place in it, a ref_cover_answer; where that is a guess, it is not
   sure. */
static int cell_look(ref_occluding *o, ref_occlude_cell *cell, uint32_t *component)
{
    if (cell_lit(o, cell)) {
        return REF_COVER_NONE;
    }
    ref_cover_place place;
    ref_clip_middle(&cell->shape, place.at);
    place.clear = ref_clip_clear(&cell->shape, place.at) - cell_margin(o, cell->inset);
    int answer = ref_cover_sample(&o->cover, &o->cuts, cell->count, &place, component);
    cell->at[0] = place.at[0];
    cell->at[1] = place.at[1];
    cell->sure = !place.guess;
    cell->lit = answer == REF_COVER_NONE && cell->sure;
    return answer;
}

/* Charges a cell that is told by a sample with what the strips beyond the ends of segments may
   cost, if it is thin. */
static void cell_charge(ref_occluding *o, const ref_occlude_cell *cell, double area)
{
    double perimeter = lrcsi_clip_box_perimeter(&cell->shape);
    double clear = ref_clip_clear(&cell->shape, cell->at) - cell_off(o);
    if (!(clear > THIN * perimeter)) {
        o->off += lrcsi_min(area, cell->cuts * cell->inset * perimeter);
    }
}

/* The cell as a piece. In a needle its corners are rounded to the frame of the view axes. */
static void cell_piece(ref_occluding *o, const lrcsi_clip_polygon *shape)
{
    o->piece = *shape;
    if (o->frame.needle) {
        for (uint32_t i = 0; i < shape->count; i++) {
            lrcsi_target_to_axes(&o->frame, shape->corner[i], o->piece.corner[i]);
        }
        o->bent += 4 * U * o->target.reach * lrcsi_clip_box_perimeter(&o->piece);
    }
}

/* All of the cell is visible: a piece, unless that is a guess: 1 or 0. */
static int cell_show(ref_occluding *o, const ref_occlude_cell *cell, double area)
{
    cell_piece(o, &cell->shape);
    o->off += U * o->frame.diameter * o->frame.perimeter;
    o->area += area;
    o->uncertainty[1] += cell->sure ? 0 : area;
    return cell->sure;
}

/* No steps are left for the cell. */
static void cell_leave(ref_occluding *o, double area)
{
    o->off += U * o->frame.diameter * o->frame.perimeter;
    o->area += 0.5 * area;
    o->uncertainty[0] += 0.5 * area;
    o->uncertainty[1] += 0.5 * area;
}

/* Strikes a cut from the cell's list, and charges its strip. */
static void cell_drop(ref_occluding *o, ref_occlude_cell *cell, uint32_t which, double area)
{
    uint32_t *list = o->cuts.list;
    uint32_t index = list[which];
    const ref_cut *cut = &o->cuts.cut[index];
    double length = ref_clip_within(&cell->shape, &cut->line, 2 * cut->width);
    o->off += lrcsi_min(area, 2 * cut->width * (length + FAR * cut->width));
    cell->count--;
    list[which] = list[cell->count];
    list[cell->count] = index;
    cell->cuts++;
    cell->inset = lrcsi_max(cell->inset, cut->width);
}

/* Puts a part of a cell on the stack. */
static void cell_push(ref_occluding *o, const ref_occlude_cell *cell,
                      const lrcsi_clip_polygon *shape, int lit)
{
    if (shape->count >= 3) {
        ref_occlude_cell *part = &o->stack[o->top++];
        *part = *cell;
        part->shape = *shape;
        part->lit = lit;
    }
}

/* Puts both sides of a line through a cell on the stack in its stead, that with the sample on top.
   0 where there is no room. */
static int cell_split(ref_occluding *o, const ref_occlude_cell *cell, const lrcsi_clip_line *line)
{
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    if (o->cells == 0 || o->top + 2 > MOST_WAITING ||
        !ref_clip_split(&cell->shape, line, &left, &right)) {
        return 0;
    }
    int on_left = lrcsi_clip_side(line, cell->at) > 0;
    o->cells--;
    o->off += 8 * U * o->frame.diameter * lrcsi_clip_box_perimeter(&cell->shape);
    cell_push(o, cell, on_left ? &right : &left, 0);
    cell_push(o, cell, on_left ? &left : &right, cell->lit);
    return 1;
}

static int cell_halve(ref_occluding *o, ref_occlude_cell *cell)
{
    lrcsi_clip_line line = ref_clip_halving(&cell->shape);
    cell->depth++;
    return cell->depth <= MOST_DEPTH && cell_split(o, cell, &line);
}

/* Where in the list the cut stands that passes nearest to the cell's place, of those at which a
   component ends; of all where there is no component, or none is its own. */
static uint32_t cell_choose(const ref_occluding *o, const ref_occlude_cell *cell,
                            uint32_t component)
{
    uint32_t best = 0;
    double nearest = HUGE_VAL;
    for (uint32_t i = 0; i < cell->count; i++) {
        const ref_cut *cut = &o->cuts.cut[o->cuts.list[i]];
        if (component == LRCS_NONE || ref_cut_ends(cut, component)) {
            double far = fabs(lrcsi_clip_side(&cut->line, cell->at)) /
                         (fabs(cut->line.to[0]) + fabs(cut->line.to[1]));
            best = far < nearest ? i : best;
            nearest = lrcsi_min(far, nearest);
        }
    }
    return best;
}

/* Cuts a cell along one of its cuts, which its parts are rid of. */
static int cell_cut(ref_occluding *o, const ref_occlude_cell *cell, uint32_t which, double area)
{
    ref_occlude_cell rest = *cell;
    const ref_cut *cut = &o->cuts.cut[o->cuts.list[which]];
    cell_drop(o, &rest, which, area);
    return cell_split(o, &rest, &cut->line);
}

/* Divides a cell that a component hides in part (LRCS_NONE: of which some is visible). 0 where that
   is not possible, or the cell is too small to be worth it. */
static int cell_divide(ref_occluding *o, ref_occlude_cell *cell, uint32_t component, double area)
{
    int halves = cell->count > LEAF_CUTS && !cell->slice;
    if (lrcsi_clip_box_perimeter(&cell->shape) < TINY_MARGINS * cell_margin(o, cell->inset)) {
        return 0;
    }
    return (halves && cell_halve(o, cell)) ||
           cell_cut(o, cell, cell_choose(o, cell, component), area) || cell_halve(o, cell);
}

/* Narrows the list to what may divide the cell; what passes beside it is charged and dropped. */
static void cell_keep(ref_occluding *o, ref_occlude_cell *cell, double area)
{
    uint32_t before = cell->count;
    cell->count = ref_cuts_keep(&o->cuts, &cell->shape, cell->count);
    for (uint32_t i = cell->count; i-- > 0;) {
        const ref_cut *cut = &o->cuts.cut[o->cuts.list[i]];
        if (ref_clip_meets(&cell->shape, &cut->line, cut->width) == REF_CLIP_BESIDE) {
            cell_drop(o, cell, i, area);
        }
    }
    cell->slice ^= cell->depth > 0 && 4 * (size_t)cell->count > 3 * (size_t)before;
}

/* Does one cell: 1 where it has shown a piece. Else it is hidden, divided, or undecided. */
static int cell_do(ref_occluding *o, ref_occlude_cell *cell, double area)
{
    uint32_t component = LRCS_NONE;
    cell_keep(o, cell, area);
    int answer = cell_look(o, cell, &component);
    if (answer == REF_COVER_ALL && cell->sure) {
        cell_charge(o, cell, area);
        return 0;
    }
    if (cell->count > 0 && answer != REF_COVER_ALL) {
        if (cell_divide(o, cell, component, area)) {
            return 0;
        }
        cell->sure = 0;
    } else if (!cell->sure && o->cells > o->spare &&
               area >
                   NARROW * cell_margin(o, cell->inset) * lrcsi_clip_box_perimeter(&cell->shape) &&
               cell_halve(o, cell)) {
        return 0;
    }
    if (answer == REF_COVER_NONE) {
        cell_charge(o, cell, area);
        return cell_show(o, cell, area);
    }
    o->uncertainty[0] += area;
    return 0;
}

/* Does one cell after the other until one has shown a piece: 1; 0 where no cell is left. Cells
   reorder only what is theirs of the list, so that a sibling done later finds its cuts. A cell's
   cuts are gone through four times. */
static int occlude_cells(ref_occluding *o)
{
    lrcsi_meter *meter = NULL;
    while (o->top > 0) {
        ref_occlude_cell cell = o->stack[--o->top];
        double area = lrcsi_clip_area(&cell.shape);
        if (!(area > 0)) {
            continue; /* no area, or less than the splits' error already holds: nothing */
        }
        if (!lrcsi_meter_take(meter, 1 + 4 * (uint64_t)cell.count)) {
            cell_leave(o, area);
        } else if (cell_do(o, &cell, area)) {
            return 1;
        }
    }
    return 0;
}

/* --- one facet -------------------------------------------------------------------------------- */

/* Readies an undecided facet: all of it as the first cell. Candidates and cuts may be missing where
   the meter is spent: then none of it is done. */
static int cells_open(ref_occluding *o, uint32_t facet)
{
    lrcsi_target_make(o->classification->view, facet, &o->target);
    lrcsi_target_refine(&o->target, &o->needle, &o->frame);
    o->area = o->uncertainty[0] = o->uncertainty[1] = o->off = 0;
    int status = ref_cuts_make(o->classification, &o->frame, o->work, &o->crossings, &o->cuts);
    if (status == LRCS_OK) {
        ref_cover_start(&o->cover, &o->target);
        o->cells = PARTS_MOST + (uint64_t)PARTS_A_CUT * o->cuts.count;
        o->spare = o->cells / 2;
        o->stack[0] = (ref_occlude_cell){.count = o->cuts.count};
        lrcsi_clip_triangle((const double(*)[2])o->frame.corner, &o->stack[0].shape);
        o->top = 1;
    }
    return status;
}

static lrcsi_visible cells_area(const ref_occluding *o)
{
    lrcsi_incidence incidence = lrcsi_view_incidence(o->classification->view, o->frame.facet);
    double unit = o->frame.unit;
    double own = 20 * U * o->frame.reach + 32 * U * o->frame.diameter + 4 * o->frame.position_err;
    double error = unit * (own * o->frame.perimeter + o->off);
    double left = lrcsi_max(0, lrcsi_min(incidence.projected, unit * o->area));
    error += o->frame.needle ? incidence.error * incidence.projected : 0;
    return (lrcsi_visible){left, lrcsi_max(0, left - unit * o->uncertainty[1] - error),
                           lrcsi_min(incidence.projected, left + unit * o->uncertainty[0] + error),
                           0, 0};
}

lrcsi_visible ref_occlude_unknown(const lrcsi_view *view, uint32_t facet)
{
    double whole = lrcsi_view_incidence(view, facet).projected;
    return (lrcsi_visible){0.5 * whole, 0, whole, 0, 0};
}

static lrcsi_visible answered_area(const ref_occluding *o, uint32_t facet)
{
    if (o->uniform[facet] == LRCSI_QUERY_HIDDEN) {
        return (lrcsi_visible){0, 0, 0, 0, 0};
    }
    if (o->uniform[facet] == LRCSI_QUERY_UNDECIDED) {
        return ref_occlude_unknown(o->classification->view, facet);
    }
    double whole = lrcsi_view_incidence(o->classification->view, facet).projected;
    return (lrcsi_visible){whole, whole, whole, 0, 0};
}

int ref_occlude_open(ref_occluding *o, uint32_t facet)
{
    lrcsi_classification *classification = o->classification;
    o->mark = o->work->used;
    o->answer = (lrcsi_visible){0, 0, 0, 0, 0};
    o->target.facet = facet;
    o->undecided = o->whole = 0;
    o->top = 0;
    o->bent = 0;
    if (!lrcsi_view_casts(classification->view, facet)) {
        return LRCS_OK;
    }
    if (!classification->undecided[facet]) {
        o->answer = answered_area(o, facet);
        o->whole = o->answer.low > 0;
        return LRCS_OK;
    }
    o->undecided =
        !lrcsi_query_screened(classification, &o->cover.facets, facet, NULL, &o->crossings);
    int status = o->undecided ? cells_open(o, facet) : LRCS_OK;
    if (status != LRCS_OK) {
        o->work->used = o->mark;
    }
    return status;
}

int ref_occlude_next(ref_occluding *o)
{
    if (!o->whole) {
        return occlude_cells(o);
    }
    o->whole = 0;
    lrcsi_target_make(o->classification->view, o->target.facet, &o->target);
    lrcsi_clip_triangle((const double(*)[2])o->target.corner, &o->piece);
    return 1;
}

lrcsi_visible ref_occlude_close(ref_occluding *o)
{
    o->work->used = o->mark;
    return o->undecided ? cells_area(o) : o->answer;
}

lrcsi_visible ref_occlude_area(ref_occluding *o)
{
    while (occlude_cells(o)) {
    }
    return ref_occlude_close(o);
}

/* --- all facets ------------------------------------------------------------------------------- */

/* May undecided facets be done together? There must be many; and none may stand for a curved
   surface: one that is hidden but for strips then costs more than its strips
   (integrate/tessellation.c), so that each must be asked. */
static int cells_serve(const lrcs_prepared *prepared)
{
    return prepared->scene->facet_count >= CELLS_LEAST && !prepared->curved && !prepared->convex;
}

size_t ref_occlude_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(ref_cover_need(prepared), lrcsi_work_bytes(facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(MOST_WAITING, sizeof(ref_occlude_cell)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
    size_t cuts = ref_cuts_need(prepared);
    size_t cells = cells_serve(prepared) ? lrcsi_cells_need(prepared) : 0;
    return lrcsi_work_add(need, cuts > cells ? cuts : cells);
}

int ref_occlude_make(lrcsi_classification *classification, lrcs_work *work, ref_occluding *o)
{
    size_t mark = work->used;
    *o = (ref_occluding){.classification = classification, .work = work};
    o->uniform = lrcsi_work_take(work, classification->view->prepared->scene->facet_count, 1);
    o->stack = lrcsi_work_take(work, MOST_WAITING, sizeof *o->stack);
    int status =
        o->uniform && o->stack ? ref_cover_make(classification, work, &o->cover) : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        status = lrcsi_query_uniform(classification, NULL, work, &o->cover.facets, o->uniform);
    }
    if (status == LRCS_OK) {
        status = lrcsi_crossings_make(&classification->search, work, &o->crossings);
    }
    if (status != LRCS_OK) {
        work->used = mark;
    }
    return status;
}

int ref_occlude_all(lrcsi_classification *classification, lrcs_work *work, lrcsi_visible *visible,
                    uint32_t *starved)
{
    const lrcsi_view *view = classification->view;
    size_t mark = work->used;
    ref_occluding o;
    int status = ref_occlude_make(classification, work, &o);
    *starved = 0;
    if (status == LRCS_OK) {
        lrcsi_visible_answered(view, o.uniform, visible);
    }
    /* 1. Many undecided facets all together, by cells of the view plane. */
    unsigned char *found = lrcsi_work_take_zero(work, view->prepared->scene->facet_count, 1);
    status = status == LRCS_OK && !found ? LRCS_E_MEMORY : status;
    if (status == LRCS_OK && classification->undecided_count >= CELLS_LEAST &&
        classification->undecided_count >= view->prepared->scene->facet_count / CELLS_SHARE &&
        cells_serve(view->prepared)) {
        lrcsi_cells_areas(classification, NULL, work, o.uniform, classification->undecided, found,
                          visible, NULL);
    }
    /* 2. One by one what that left open. */
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        int parted = classification->undecided[f] && !found[f];
        if (parted && ref_occlude_open(&o, f) == LRCS_OK) {
            visible[f] = ref_occlude_area(&o);
        } else if (parted || (o.uniform[f] == LRCSI_QUERY_UNDECIDED && !found[f])) {
            visible[f] = ref_occlude_unknown(view, f);
            *starved += (uint32_t)parted;
        }
    }
    work->used = mark;
    return status;
}
