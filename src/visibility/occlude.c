/* SPDX-License-Identifier: MIT */
/* Analytic visibility of contested facets. The facet is halved until few occluders overlap a cell;
   a cell that one of them covers is hidden, one that none overlaps is visible, and from the others
   the few are cut out. So the work grows with the occluders near by, not with their square.

   Error. In the facet's frame (visibility/occluder.c) corners are off by at most e = 10 u r, r
   the largest distance in space of the corners at hand from the facet's first one: R's rows are
   orthonormal to 4 u; a rounded difference, three products and two sums. Let p be the perimeter
   of the facet's projection, d its diameter, 2 d <= p. The facet's own corners move its rim by
   e: 2 e p, charged once. The region that an occluder hides is cut by the lines through its own
   computed corners: their hull and the true one lie within e of each other, and differ by 2 e p
   at most; deciding in doubles on which side of a line a point lies, wrong within 4 u (r + d) of
   it, adds 4 u (r + d) p for each of four sides; a cut left out for want of a direction
   (visibility/occluder.c) adds 32 u r d, at most 16 u r p. Together 52 u (r + d) p. The cut by
   the facet's plane ends on the occluder's sides; how far those ends may slip is added to the
   rim. A split of a piece puts one corner on a line to within 8 u d, and both parts share it: 8
   u d p. A cell that could not be finished counts whole. */
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
/* Occluders that may all meet in a point. */
#define FAN_MOST ((size_t)1 << 16)
/* Halvings at most: a cell is then below 2^-48 of its facet. */
#define MOST_DEPTH 48u

/* A cell yet to be done: a piece of the facet and the occluders that its parent kept. */
typedef struct occlude_cell {
    lrcsi_clip_polygon shape;
    uint32_t first, count; /* in list */
    uint32_t stale, depth;
} occlude_cell;

/* One facet at work. */
typedef struct occlude_job {
    lrcsi_target target;
    lrcsi_occluder *occluder;
    uint32_t count;
    uint32_t *list; /* occluders by cell, one behind the other */
    size_t room;    /* of list */
    lrcsi_clip *clip;
    double area;  /* visible so far */
    double doubt; /* area of cells that could not be finished */
    double splits;
} occlude_job;

/* What lives as long as the run. */
typedef struct occlude_scratch {
    lrcsi_grid facets;
    lrcsi_clip clip;
    uint32_t *asked;     /* facet: the target + 1 that last met it */
    uint32_t *candidate; /* facets that hide some of the target */
} occlude_scratch;

/* --- cells ------------------------------------------------------------------------------------ */

/* Files those of the cell's occluders that overlap its shape behind their list. Returns how many;
   LRCS_NONE where one of them covers the shape. */
static uint32_t cell_keep(occlude_job *job, const occlude_cell *cell)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->count; i++) {
        uint32_t index = job->list[cell->first + i];
        int overlap = lrcsi_clip_overlap(&cell->shape, &job->occluder[index].region);
        if (overlap == LRCSI_CLIP_COVERED) {
            return LRCS_NONE;
        }
        if (overlap == LRCSI_CLIP_SOME) {
            job->list[cell->first + cell->count + kept++] = index;
        }
    }
    return kept;
}

/* Cuts the kept occluders out of the cell. 0 where it fell into too many pieces. */
static int cell_cut(occlude_job *job, const occlude_cell *cell, uint32_t kept)
{
    lrcsi_clip_start(job->clip, &cell->shape);
    int fits = 1;
    for (uint32_t i = 0; i < kept && fits; i++) {
        uint32_t index = job->list[cell->first + cell->count + i];
        fits = lrcsi_clip_subtract(job->clip, &job->occluder[index].region);
    }
    job->splits += job->clip->splits;
    job->area += fits ? lrcsi_clip_area(job->clip) : 0;
    return fits;
}

/* Puts both halves of a cell on the stack in its stead. */
static void cell_halve(occlude_job *job, const occlude_cell *cell, uint32_t kept,
                       occlude_cell *stack, uint32_t *top)
{
    occlude_cell half = {.first = cell->first + cell->count, .count = kept};
    half.depth = cell->depth + 1;
    half.stale = 4 * (size_t)kept > 3 * (size_t)cell->count ? cell->stale + 1 : 0;
    lrcsi_clip_polygon other;
    lrcsi_clip_halve(&cell->shape, &half.shape, &other);
    job->splits += 1;
    stack[(*top)++] = half;
    half.shape = other;
    stack[(*top)++] = half;
}

/* Each cell's list stands behind its parent's; a sibling done later overwrites it. */
static void occlude_cells(occlude_job *job)
{
    occlude_cell stack[MOST_DEPTH + 2];
    uint32_t top = 1;
    stack[0] = (occlude_cell){.first = 0, .count = job->count};
    lrcsi_clip_triangle((const double(*)[2])job->target.corner, &stack[0].shape);
    while (top > 0) {
        occlude_cell cell = stack[--top];
        if (cell.shape.count < 3 || !(lrcsi_clip_polygon_area(&cell.shape) > 0)) {
            continue; /* no area, or less than the splits' error already holds */
        }
        uint32_t kept = cell_keep(job, &cell);
        if (kept == LRCS_NONE) {
            continue;
        }
        int leaf = kept <= LEAF_OCCLUDERS || cell.stale >= LEAF_STALE;
        if (leaf && cell_cut(job, &cell, kept)) {
            continue;
        }
        size_t end = (size_t)cell.first + cell.count + kept;
        if (cell.depth < MOST_DEPTH && end + kept <= job->room) {
            cell_halve(job, &cell, kept, stack, &top);
        } else {
            job->doubt += lrcsi_clip_polygon_area(&cell.shape);
        }
    }
}

/* --- one facet -------------------------------------------------------------------------------- */

/* The facets near the target that may hide some of it, each once. */
static uint32_t occlude_candidates(const lrcsi_target *target, occlude_scratch *scratch)
{
    const lrcsi_grid *facets = &scratch->facets;
    double low[2];
    double high[2];
    lrcsi_grid_box(target->view, target->view->prepared->scene->facet[target->facet].corner, 3, low,
                   high);
    lrcsi_cells cells = lrcsi_grid_cells(facets, low, high);
    uint32_t count = 0;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = facets->first[(size_t)y * facets->size + cells.x0];
        uint32_t end = facets->first[(size_t)y * facets->size + cells.x1];
        for (; i < end; i++) {
            uint32_t other = facets->item[i];
            if (other != target->facet && scratch->asked[other] != target->facet + 1) {
                scratch->asked[other] = target->facet + 1;
                scratch->candidate[count++] = other;
            }
        }
    }
    return count;
}

/* Room for the cells' lists. Many slivers that meet in a point, as a cap's do, are kept by cell
   after cell around it, down to the last halving. */
static size_t list_room(size_t occluders)
{
    return 8 * occluders + 56 * (occluders < FAN_MOST ? occluders : FAN_MOST) + 1024;
}

/* The regions that they hide. The count is LRCS_NONE where one of them hides all of the target. */
static int occlude_regions(occlude_job *job, const uint32_t *candidate, uint32_t count,
                           lrcs_work *work, double *error)
{
    job->occluder = lrcsi_work_take(work, count, sizeof *job->occluder);
    if (!job->occluder) {
        return LRCS_E_MEMORY;
    }
    lrcsi_clip_polygon whole;
    lrcsi_clip_triangle((const double(*)[2])job->target.corner, &whole);
    for (uint32_t i = 0; i < count; i++) {
        lrcsi_occluder *occluder = &job->occluder[job->count];
        int hides = lrcsi_occluder_make(&job->target, candidate[i], occluder);
        *error += occluder->error;
        if (!hides) {
            continue;
        }
        if (lrcsi_clip_overlap(&whole, &occluder->region) == LRCSI_CLIP_COVERED) {
            *error = occluder->error;
            job->count = LRCS_NONE;
            return LRCS_OK;
        }
        job->count++;
    }
    job->room = list_room(job->count);
    job->list = lrcsi_work_take(work, job->room, sizeof *job->list);
    for (uint32_t i = 0; i < job->count && job->list; i++) {
        job->list[i] = i;
    }
    return job->list ? LRCS_OK : LRCS_E_MEMORY;
}

static int occlude_contested(const lrcsi_view *view, uint32_t facet, occlude_scratch *scratch,
                             lrcs_work *work, lrcsi_visible *visible)
{
    size_t mark = work->used;
    occlude_job job = {.clip = &scratch->clip};
    lrcsi_target_make(view, facet, &job.target);
    uint32_t candidates = occlude_candidates(&job.target, scratch);
    double rims = 0;
    int status = occlude_regions(&job, scratch->candidate, candidates, work, &rims);
    if (status == LRCS_OK) {
        if (job.count != LRCS_NONE) {
            occlude_cells(&job);
        }
        double whole = lrcsi_view_tilt(view, facet).projected;
        double d = job.target.diameter;
        double own = 20 * U * job.target.reach;
        double error = (rims + own + 8 * U * d * (job.splits + 4)) * job.target.perimeter;
        double left = lrcsi_most(0, lrcsi_least(whole, job.area));
        visible->area = left;
        visible->low = lrcsi_most(0, left - error);
        visible->high = lrcsi_least(whole, left + job.doubt + error);
        if (!isfinite(error)) {
            *visible = (lrcsi_visible){left, 0, whole, 0};
        }
    }
    work->used = mark;
    return status;
}

static lrcsi_visible occlude_uniform(const lrcsi_view *view, uint32_t facet,
                                     const lrcsi_grid *facets)
{
    double whole = lrcsi_view_tilt(view, facet).projected;
    switch (lrcsi_query_facet(facets, facet)) {
    case LRCSI_QUERY_HIDDEN:
        return (lrcsi_visible){0, 0, 0, 0};
    case LRCSI_QUERY_VISIBLE:
        return (lrcsi_visible){whole, whole, whole, 0};
    default:
        return (lrcsi_visible){0.5 * whole, 0, whole, 0};
    }
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcsi_occlude_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_clip_need(), lrcsi_grid_facets_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 2 * sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_occluder)));
    return lrcsi_work_add(need, lrcsi_work_bytes(list_room(facets) + 1024, sizeof(uint32_t)));
}

static int occlude_start(const lrcsi_view *view, lrcs_work *work, occlude_scratch *scratch)
{
    uint32_t count = view->prepared->scene->facet_count;
    scratch->asked = lrcsi_work_take_zero(work, count, sizeof *scratch->asked);
    scratch->candidate = lrcsi_work_take(work, count, sizeof *scratch->candidate);
    if (!scratch->asked || !scratch->candidate ||
        lrcsi_clip_make(work, &scratch->clip) != LRCS_OK) {
        return LRCS_E_MEMORY;
    }
    return lrcsi_grid_facets(view, work, &scratch->facets);
}

int lrcsi_occlude_all(lrcsi_contest *contest, lrcs_work *work, lrcsi_visible *visible)
{
    const lrcsi_view *view = contest->view;
    size_t mark = work->used;
    occlude_scratch scratch;
    int status = occlude_start(view, work, &scratch);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        visible[f] = (lrcsi_visible){0, 0, 0, 0};
        if (!lrcsi_grid_casts(view, f)) {
            continue;
        }
        if (contest->contested[f] && !lrcsi_query_screened(contest, &scratch.facets, f)) {
            status = occlude_contested(view, f, &scratch, work, &visible[f]);
        } else if (!contest->contested[f]) {
            visible[f] = occlude_uniform(view, f, &scratch.facets);
        }
    }
    work->used = mark;
    return status;
}
