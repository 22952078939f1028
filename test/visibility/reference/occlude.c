/* SPDX-License-Identifier: MIT */
/* Analytic visibility of undecided facets. A facet is divided into cells along its cuts
   (test/visibility/reference/cut.c) until nothing divides a cell; then one exact sample decides the
   whole cell (test/visibility/reference/cover.c). A sample of a cell that is still divided may show
   that one component hides the whole cell, whatever else divides it. If it shows no such component,
   it determines the component along whose edges the cell is cut next. So the cost grows with what
   is visible, not with what is hidden behind it. A cell with many cuts is halved first, because
   each cut meets few of the small cells.

   Error. In the facet's frame (visibility/cells/target.c) the corners have a position error of at most
   e = 10 u r, where r is the facet's reach: the rows of R are orthonormal to 4 u; a rounded
   difference, three products and two sums follow. Let p be the perimeter of the facet's projection
   and d its diameter. The error of the facet's own corners moves its boundary by e; the area error,
   2 e p, is charged once.

   Strips. A cell is cut along the line of a segment, or lies on one side of that line. Then the
   segment lies within its width w of the line, and the cell and all cells cut from it lie on one
   side of the line, except for a strip of width w (test/visibility/reference/cut.c). Let P be the
   position of a sample at a distance of c from the cell's sides, where c exceeds 2 w and the
   sample's own position error, and let x be any point of the cell. The straight path from x to P
   crosses the segment only if x lies within w of the line; P does not. The path has left that strip
   after at most 2 w / c of its length. So x lies no farther along the line from the segment than 2
   w / c times the cell's diameter, which is 2^20 w if the cell is not thin. The segment can
   therefore change the visibility only in a strip that is 2 w wide and as long as the segment's
   part in the cell plus FAR w. The area of this strip, or of the cell if that is smaller, is
   charged when the segment is removed from the cell's list; this accounts for all cells that are
   cut from the cell. In a thin cell the strip of each segment is charged along the whole cell.
   Everything else in the cell has the visibility of P. If one component hides the cell, the
   segments that still divide the cell do not divide that component.

   Undecided cells. If the sample of a cell is a guess, or the cell could not be divided further, it
   is undecided: the bounds include that all of it is visible and that all of it is hidden. The same
   holds for a cell that is left when the view's meter is spent; it counts as half visible.

   Divisions. A division puts two corners on sides of a piece, with an error of 5 u d. Both parts
   share these corners, so only the two sides are bent, which changes the area by 5 u d d' in a cell
   of diameter d'. The sum of areas has two more triangles, 7 u d'^2. Together this is below 8 u d
   q, where q is the cell's perimeter. The sum over all cells has an error of u d p for each.

   Needles. A needle in the view may be narrower than all these errors. It is processed in the frame
   of its barycentric coordinates (visibility/cells/target.h), in which it is as wide as long, and all of
   the above holds without change: its corners are exact except for the frame's position_err;
   segments are clipped to a box around it, with the errors that test/visibility/reference/cut.c
   states; samples are taken at points that are not rounded. Areas are counted in units of twice the
   area of the facet's projection, which has an error of its own. */
#include "visibility/reference/occlude.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/cells/cells.h"
#include "visibility/uniform/query.h"

#define U 0x1p-53

/* A cell with more cuts is halved, until halving removes less than a quarter of its cuts. */
#define LEAF_CUTS 12u
/* The largest number of halvings: a cell is then smaller than 2^-48 of its facet. */
#define MOST_DEPTH 48u
/* A cell is thin if its sample is nearer to a side than this fraction of the cell's perimeter. In
   other cells strips extend beyond the ends of segments by FAR widths. */
#define THIN 0x1p-20
#define FAR  0x1p22
/* If the sample of a cell is not certain, but the cell's area exceeds this many sample clearances
   times its perimeter, only its shape is unsuitable: the cell is halved. Half of all cells are
   reserved for cells with cuts. */
#define NARROW 64.0
/* A cell whose perimeter is below this many sample clearances is not divided; it is undecided. */
#define TINY_CLEARANCES 64.0
/* The largest number of waiting cells. Of the two parts of a cell, the one with the sample is
   processed first; the other can then use all the room. */
#define MOST_WAITING 256u
/* Undecided facets are processed together (visibility/cells/cells.h) if there are at least CELLS_LEAST of
   them, and if they are at least one in CELLS_SHARE of all facets: all facets are then sorted into
   blocks, which costs more than to clip a few of them. */
#define CELLS_LEAST 192u
#define CELLS_SHARE 32u
/* The largest number of cells of a facet: PARTS_MOST, and PARTS_A_CUT for each cut. */
#define PARTS_MOST  4096u
#define PARTS_A_CUT 256u

/* --- cells ------------------------------------------------------------------------------------ */

/* The distance from the sides of a cell of this inset that a sample must have for its answer to
   hold for the whole cell. */
static double sample_clearance(const ref_occluding *o, double inset)
{
    return 2 * inset + 16 * U * o->frame.diameter + 2 * o->frame.position_err;
}

/* The largest distance of the point of a sample from its nominal position. */
static double sample_err(const ref_occluding *o)
{
    return lrcsi_target_unproject_err(&o->frame) + o->frame.position_err;
}

/* Is the facet known to be visible at a position far enough from the cell's sides? */
static int cell_lit(const ref_occluding *o, const ref_occlude_cell *cell)
{
    return cell->lit && ref_clip_clear(&cell->shape, cell->at) >
                            sample_clearance(o, cell->inset) + sample_err(o);
}

/* Takes a sample of the cell. Returns a ref_cover_answer; cell->sure is 0 if it is a guess. */
static int cell_sample(ref_occluding *o, ref_occlude_cell *cell, uint32_t *component)
{
    if (cell_lit(o, cell)) {
        return REF_COVER_NONE;
    }
    ref_cover_place place;
    ref_clip_middle(&cell->shape, place.at);
    place.clear = ref_clip_clear(&cell->shape, place.at) - sample_clearance(o, cell->inset);
    int answer = ref_cover_sample(&o->cover, &o->cuts, cell->count, &place, component);
    cell->at[0] = place.at[0];
    cell->at[1] = place.at[1];
    cell->sure = !place.guess;
    cell->lit = answer == REF_COVER_NONE && cell->sure;
    return answer;
}

/* Charges a thin cell, decided by a sample, with the area of the strips beyond the ends of
   segments. */
static void cell_charge(ref_occluding *o, const ref_occlude_cell *cell, double area)
{
    double perimeter = lrcsi_clip_box_perimeter(&cell->shape);
    double clear = ref_clip_clear(&cell->shape, cell->at) - sample_err(o);
    if (!(clear > THIN * perimeter)) {
        o->area_err += lrcsi_min(area, cell->cuts * cell->inset * perimeter);
    }
}

/* Makes the cell the current piece. In a needle its corners are converted, with rounding, to the
   frame of the view axes. */
static void cell_piece(ref_occluding *o, const lrcsi_clip_polygon *shape)
{
    o->piece = *shape;
    if (o->frame.needle) {
        for (uint32_t i = 0; i < shape->count; i++) {
            lrcsi_target_to_axes(&o->frame, shape->corner[i], o->piece.corner[i]);
        }
        o->shape_err += 4 * U * o->target.reach * lrcsi_clip_box_perimeter(&o->piece);
    }
}

/* Adds a cell that is entirely visible. Returns 1 and makes it a piece, or 0 if its visibility is a
   guess. */
static int cell_show(ref_occluding *o, const ref_occlude_cell *cell, double area)
{
    cell_piece(o, &cell->shape);
    o->area_err += U * o->frame.diameter * o->frame.perimeter;
    o->area += area;
    o->uncertainty[1] += cell->sure ? 0 : area;
    return cell->sure;
}

/* Counts a cell as undecided because the meter is spent. */
static void cell_leave(ref_occluding *o, double area)
{
    o->area_err += U * o->frame.diameter * o->frame.perimeter;
    o->area += 0.5 * area;
    o->uncertainty[0] += 0.5 * area;
    o->uncertainty[1] += 0.5 * area;
}

/* Removes a cut from the cell's list and charges the area of its strip. */
static void cell_remove(ref_occluding *o, ref_occlude_cell *cell, uint32_t which, double area)
{
    uint32_t *list = o->cuts.list;
    uint32_t index = list[which];
    const ref_cut *cut = &o->cuts.cut[index];
    double length = ref_clip_within(&cell->shape, &cut->line, 2 * cut->width);
    o->area_err += lrcsi_min(area, 2 * cut->width * (length + FAR * cut->width));
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

/* Replaces a cell by its two parts on either side of a line; they are put on the stack, the part
   with the sample on top. Returns 0 if there is no room. */
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
    o->area_err += 8 * U * o->frame.diameter * lrcsi_clip_box_perimeter(&cell->shape);
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

/* The position in the list of the cut that passes nearest to the cell's sample, of those at which a
   component ends; of all cuts if no component is given, or if it ends at none of them. */
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

/* Cuts a cell along one of its cuts, which is removed from the lists of both parts. */
static int cell_cut(ref_occluding *o, const ref_occlude_cell *cell, uint32_t which, double area)
{
    ref_occlude_cell rest = *cell;
    const ref_cut *cut = &o->cuts.cut[o->cuts.list[which]];
    cell_remove(o, &rest, which, area);
    return cell_split(o, &rest, &cut->line);
}

/* Divides a cell that a component hides in part (LRCS_NONE: a part of the cell is visible). Returns
   0 if that is not possible, or if the cell is too small. */
static int cell_divide(ref_occluding *o, ref_occlude_cell *cell, uint32_t component, double area)
{
    int halves = cell->count > LEAF_CUTS && !cell->slice;
    if (lrcsi_clip_box_perimeter(&cell->shape) <
        TINY_CLEARANCES * sample_clearance(o, cell->inset)) {
        return 0;
    }
    return (halves && cell_halve(o, cell)) ||
           cell_cut(o, cell, cell_choose(o, cell, component), area) || cell_halve(o, cell);
}

/* Reduces the list to the cuts that may divide the cell; cuts beside the cell are charged and
   removed. */
static void cell_keep(ref_occluding *o, ref_occlude_cell *cell, double area)
{
    uint32_t before = cell->count;
    cell->count = ref_cuts_keep(&o->cuts, &cell->shape, cell->count);
    for (uint32_t i = cell->count; i-- > 0;) {
        const ref_cut *cut = &o->cuts.cut[o->cuts.list[i]];
        if (ref_clip_meets(&cell->shape, &cut->line, cut->width) == REF_CLIP_BESIDE) {
            cell_remove(o, cell, i, area);
        }
    }
    cell->slice ^= cell->depth > 0 && 4 * (size_t)cell->count > 3 * (size_t)before;
}

/* Processes one cell. Returns 1 if it yields a piece; otherwise the cell is hidden, divided or
   undecided. */
static int cell_process(ref_occluding *o, ref_occlude_cell *cell, double area)
{
    uint32_t component = LRCS_NONE;
    cell_keep(o, cell, area);
    int answer = cell_sample(o, cell, &component);
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
               area > NARROW * sample_clearance(o, cell->inset) *
                          lrcsi_clip_box_perimeter(&cell->shape) &&
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

/* Processes cells until one yields a piece, and returns 1; 0 if no cell is left. A cell reorders
   only its own part of the list, so that the other part of a divided cell, processed later, finds
   its cuts. The cuts of a cell are traversed four times. */
static int occlude_cells(ref_occluding *o)
{
    lrcsi_meter *meter = NULL;
    while (o->top > 0) {
        ref_occlude_cell cell = o->stack[--o->top];
        double area = lrcsi_clip_area(&cell.shape);
        if (!(area > 0)) {
            continue; /* no area, or less than the charged error of divisions */
        }
        if (!lrcsi_meter_take(meter, 1 + 4 * (uint64_t)cell.count)) {
            cell_leave(o, area);
        } else if (cell_process(o, &cell, area)) {
            return 1;
        }
    }
    return 0;
}

/* --- one facet -------------------------------------------------------------------------------- */

/* Prepares an undecided facet: the whole facet is its first cell. Candidates and cuts may be
   missing if the meter is spent; then no cell is processed. */
static int cells_open(ref_occluding *o, uint32_t facet)
{
    lrcsi_target_make(o->classification->view, facet, &o->target);
    lrcsi_target_refine(&o->target, &o->needle, &o->frame);
    o->area = o->uncertainty[0] = o->uncertainty[1] = o->area_err = 0;
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

static lrcsi_visible_area cells_area(const ref_occluding *o)
{
    lrcsi_incidence incidence = lrcsi_view_incidence(o->classification->view, o->frame.facet);
    double unit = o->frame.unit;
    double own = 20 * U * o->frame.reach + 32 * U * o->frame.diameter + 4 * o->frame.position_err;
    double error = unit * (own * o->frame.perimeter + o->area_err);
    double left = lrcsi_max(0, lrcsi_min(incidence.projected, unit * o->area));
    error += o->frame.needle ? incidence.error * incidence.projected : 0;
    return (lrcsi_visible_area){
        left, lrcsi_max(0, left - unit * o->uncertainty[1] - error),
        lrcsi_min(incidence.projected, left + unit * o->uncertainty[0] + error), 0, 0};
}

lrcsi_visible_area ref_occlude_unknown(const lrcsi_view *view, uint32_t facet)
{
    double whole = lrcsi_view_incidence(view, facet).projected;
    return (lrcsi_visible_area){0.5 * whole, 0, whole, 0, 0};
}

static lrcsi_visible_area answered_area(const ref_occluding *o, uint32_t facet)
{
    if (o->uniform[facet] == LRCSI_QUERY_HIDDEN) {
        return (lrcsi_visible_area){0, 0, 0, 0, 0};
    }
    if (o->uniform[facet] == LRCSI_QUERY_NO_ANSWER) {
        return ref_occlude_unknown(o->classification->view, facet);
    }
    double whole = lrcsi_view_incidence(o->classification->view, facet).projected;
    return (lrcsi_visible_area){whole, whole, whole, 0, 0};
}

int ref_occlude_open(ref_occluding *o, uint32_t facet)
{
    lrcsi_classification *classification = o->classification;
    o->mark = o->work->used;
    o->answer = (lrcsi_visible_area){0, 0, 0, 0, 0};
    o->target.facet = facet;
    o->undecided = o->whole = 0;
    o->top = 0;
    o->shape_err = 0;
    if (!lrcsi_view_casts(classification->view, facet)) {
        return LRCS_OK;
    }
    if (!classification->undecided[facet]) {
        o->answer = answered_area(o, facet);
        o->whole = o->answer.low > 0;
        return LRCS_OK;
    }
    o->undecided = !lrcsi_query_hidden_by_component(classification, &o->cover.facets, facet, NULL,
                                                    &o->crossings);
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

lrcsi_visible_area ref_occlude_close(ref_occluding *o)
{
    o->work->used = o->mark;
    return o->undecided ? cells_area(o) : o->answer;
}

lrcsi_visible_area ref_occlude_area(ref_occluding *o)
{
    while (occlude_cells(o)) {
    }
    return ref_occlude_close(o);
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Can undecided facets be processed together? There must be many facets, and none may approximate a
   curved surface: the tessellation error of such a facet, if it is hidden except for strips,
   exceeds the area of the strips (integrate/wall/tessellation.c), so each must be processed alone. */
static int can_process_together(const lrcs_prepared *prepared)
{
    return prepared->scene->facet_count >= CELLS_LEAST && !prepared->has_curved_shapes &&
           !prepared->convex;
}

size_t ref_occlude_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(ref_cover_need(prepared), lrcsi_work_bytes(facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(MOST_WAITING, sizeof(ref_occlude_cell)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
    size_t cuts = ref_cuts_need(prepared);
    size_t cells = can_process_together(prepared) ? lrcsi_cells_need(prepared) : 0;
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

int ref_occlude_all(lrcsi_classification *classification, lrcs_work *work,
                    lrcsi_visible_area *visible, uint32_t *too_little)
{
    const lrcsi_view *view = classification->view;
    size_t mark = work->used;
    ref_occluding o;
    int status = ref_occlude_make(classification, work, &o);
    *too_little = 0;
    if (status == LRCS_OK) {
        lrcsi_query_areas(view, o.uniform, visible);
    }
    /* 1. If many facets are undecided, all of them together, by cells of the view plane. */
    unsigned char *found = lrcsi_work_take_zero(work, view->prepared->scene->facet_count, 1);
    status = status == LRCS_OK && !found ? LRCS_E_MEMORY : status;
    if (status == LRCS_OK && classification->undecided_count >= CELLS_LEAST &&
        classification->undecided_count >= view->prepared->scene->facet_count / CELLS_SHARE &&
        can_process_together(view->prepared)) {
        lrcsi_cells_areas(classification, NULL, NULL, work, o.uniform, classification->undecided,
                          found, visible, NULL);
    }
    /* 2. Each facet that is still undecided, one at a time. */
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        int parted = classification->undecided[f] && !found[f];
        if (parted && ref_occlude_open(&o, f) == LRCS_OK) {
            visible[f] = ref_occlude_area(&o);
        } else if (parted || (o.uniform[f] == LRCSI_QUERY_NO_ANSWER && !found[f])) {
            visible[f] = ref_occlude_unknown(view, f);
            *too_little += (uint32_t)parted;
        }
    }
    work->used = mark;
    return status;
}
