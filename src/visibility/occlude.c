/* SPDX-License-Identifier: MIT */
/* Which computation finds the visible area of a facet: one exact sample per region for uniform
   facets; a proof that one component hides it, for some undecided facets; cells of the view plane
   for all others, together or one by one. */
#include "visibility/occlude.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/cells/cells.h"
#include "visibility/uniform/query.h"

/* In scenes with fewer facets, undecided facets are processed one by one: it saves the memory for
   processing them together. */
#define MIN_FACETS 192u
/* Facets are processed together (visibility/cells/cells.h) if processing them one by one would take
   more pairs of a facet and an event (one_by_one_is_slow) than this for each facet that can hide
   others: all of these are sorted into blocks then. Heuristic: where the two take about the same
   time, measured on spacecraft models, satellites and the demo. */
#define PAIRS_PER_CASTER 4096.0

/* --- one facet -------------------------------------------------------------------------------- */

static lrcsi_visible_area uniform_area(const lrcsi_occlusion *o, uint32_t facet)
{
    double whole = lrcsi_view_incidence(o->classification->view, facet).projected;
    int answer = o->answer[facet];
    double low = answer == LRCSI_QUERY_VISIBLE ? whole : 0;
    double high = answer == LRCSI_QUERY_HIDDEN ? 0 : whole;
    return (lrcsi_visible_area){0.5 * (low + high), low, high, 0, 0};
}

int lrcsi_occlude_open(lrcsi_occlusion *o, uint32_t facet)
{
    lrcsi_classification *classification = o->classification;
    o->area = lrcsi_visible_area_exact(0);
    o->single.facet = o->single.target.facet = facet;
    o->single.target.reach = o->single.target.perimeter = o->single.piece_err = 0;
    o->undecided = o->whole = 0;
    if (!lrcsi_view_casts(classification->view, facet)) {
        return 0;
    }
    if (!classification->undecided[facet]) {
        o->area = uniform_area(o, facet);
        o->whole = o->area.low > 0;
        if (o->whole) {
            lrcsi_target_make(classification->view, facet, &o->single.target);
        }
    } else if (!lrcsi_query_hidden_by_component(classification, &o->facets, facet, o->meter,
                                                &o->single.crossings)) {
        o->undecided = 1;
        lrcsi_facet_cells_open(&o->single, facet);
    }
    return o->undecided;
}

int lrcsi_occlude_next(lrcsi_occlusion *o)
{
    if (!o->whole) {
        return o->undecided && lrcsi_facet_cells_next(&o->single);
    }
    o->whole = 0;
    lrcsi_clip_triangle((const double(*)[2])o->single.target.corner, &o->single.piece);
    return 1;
}

lrcsi_visible_area lrcsi_occlude_close(lrcsi_occlusion *o)
{
    return o->undecided ? lrcsi_facet_cells_close(&o->single) : o->area;
}

lrcsi_visible_area lrcsi_occlude_area(lrcsi_occlusion *o)
{
    while (o->undecided && lrcsi_facet_cells_next(&o->single)) {
    }
    return lrcsi_occlude_close(o);
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Can undecided facets be processed together? Not in a convex solid, where there are none unless a
   search is requested: it saves their memory. */
static int can_process_together(const lrcs_prepared *prepared)
{
    return prepared->scene->facet_count >= MIN_FACETS && !(prepared->convex && prepared->solid);
}

/* Would it take long to process the undecided facets one by one? Each is cut at most along the
   events near it, and each of its cells is compared at most with the facets near it: the work is
   counted as the product of the two, which the lists of buckets give approximately. Counting it
   takes one step for each row of buckets. */
static int one_by_one_is_slow(const lrcsi_occlusion *o)
{
    const lrcsi_classification *c = o->classification;
    const uint32_t count = c->view->prepared->scene->facet_count;
    const double most = PAIRS_PER_CASTER * c->casters;
    double pairs = 0;
    for (uint32_t f = 0; pairs <= most && (f = lrcsi_marks_next(c->undecided, f, count, 1)) < count;
         f++) {
        const lrcsi_view_box *box = lrcsi_boxes_facet(&o->facets.boxes, f);
        const lrcsi_grid_rect facets = lrcsi_grid_buckets(&o->facets, box);
        const lrcsi_grid_rect events = lrcsi_grid_buckets(&c->search.grid, box);
        const uint32_t rows = (uint32_t)(facets.y1 - facets.y0) + (uint32_t)(events.y1 - events.y0);
        if (!lrcsi_meter_take(o->meter, rows)) {
            return 0;
        }
        pairs += lrcsi_min(c->casters, lrcsi_grid_listed(&o->facets, facets)) *
                 lrcsi_min(c->events.count, lrcsi_grid_listed(&c->search.grid, events));
    }
    return pairs > most;
}

size_t lrcsi_occlude_need(const lrcs_prepared *prepared)
{
    size_t need = lrcsi_work_blocks(2, prepared->scene->facet_count, 1);
    size_t single = lrcsi_facet_cells_need(prepared);
    size_t cells = can_process_together(prepared) ? lrcsi_cells_need(prepared) : 0;
    need = lrcsi_work_add(need, lrcsi_query_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(1, sizeof(lrcsi_occlusion)));
    return lrcsi_work_add(need, single > cells ? single : cells);
}

/* Everything except the memory for single facets. */
static int occlude_begin(lrcsi_classification *classification, lrcsi_meter *meter, lrcs_work *work,
                         lrcsi_occlusion *o)
{
    memset(o, 0, sizeof *o); /* not a compound literal, which takes as much of the stack again */
    o->classification = classification;
    o->meter = meter;
    o->answer = lrcsi_work_take(work, classification->view->prepared->scene->facet_count, 1);
    return o->answer ? lrcsi_query_uniform(classification, meter, work, &o->facets, o->answer)
                     : LRCS_E_MEMORY;
}

int lrcsi_occlude_make(lrcsi_classification *classification, lrcsi_meter *meter, lrcs_work *work,
                       lrcsi_occlusion **o)
{
    size_t mark = work->used;
    lrcsi_occlusion *made = lrcsi_work_take(work, 1, sizeof *made);
    int status = made ? occlude_begin(classification, meter, work, made) : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        status = lrcsi_facet_cells_make(classification, meter, &made->facets, work, &made->single);
    }
    if (status == LRCS_OK) {
        *o = made;
    } else {
        work->used = mark;
    }
    return status;
}

/* 1. Queries of uniform facets. 2. Undecided facets together, if that is likely to be faster.
   3. One by one, those of which no area was found. 4. Returns the answers, moved to the beginning
   of the work area used here, or the areas of all facets. */
int lrcsi_occlude_all(lrcsi_classification *classification, lrcsi_meter *meter,
                      lrcs_progress *progress, lrcs_work *work, const unsigned char **answer,
                      lrcsi_visible_area *visible, lrcsi_moment *moment)
{
    const lrcsi_view *view = classification->view;
    const lrcs_prepared *p = view->prepared;
    uint32_t count = p->scene->facet_count;
    uint32_t left = classification->undecided_count; /* undecided facets without an area */
    size_t mark = work->used;
    lrcsi_occlusion o;
    int status = occlude_begin(classification, meter, work, &o);
    unsigned char *found = lrcsi_work_take_zero(work, count, 1); /* facet: visible[] is its area */
    status = status == LRCS_OK && !found ? LRCS_E_MEMORY : status;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    for (uint32_t f = 0; moment && f < count; f++) {
        moment[f] = (lrcsi_moment){.error = 0};
    }
    for (uint32_t f = 0; (f = lrcsi_marks_next(o.answer, f, count, LRCSI_QUERY_NO_ANSWER)) < count;
         f++) {
        if (!classification->undecided[f]) {
            visible[f] = uniform_area(&o, f); /* its query gave no answer */
            if (moment) {
                moment[f].error = HUGE_VAL;
            }
        }
    }
    if (can_process_together(p) && one_by_one_is_slow(&o)) {
        lrcsi_cells_areas(classification, meter, progress, work, o.answer,
                          classification->undecided, found, visible, moment);
        for (uint32_t f = 0; f < count; f++) {
            left -= found[f];
        }
    }
    if (left > 0) {
        status = lrcsi_facet_cells_make(classification, meter, &o.facets, work, &o.single);
    }
    for (uint32_t f = status == LRCS_OK && left > 0 ? 0 : count;
         (f = lrcsi_marks_next(classification->undecided, f, count, 1)) < count; f++) {
        if (found[f]) {
            continue;
        }
        lrcsi_progress_report(progress, LRCS_PROGRESS_VISIBILITY, f, count);
        const int in_cells = lrcsi_occlude_open(&o, f);
        visible[f] = lrcsi_occlude_area(&o);
        if (moment) {
            moment[f] = in_cells ? o.single.moment : (lrcsi_moment){.error = 0};
        }
        if (visible[f].high == 0) {
            o.answer[f] = LRCSI_QUERY_HIDDEN;
        }
    }
    work->used = mark;
    if (status == LRCS_OK && answer) {
        *answer = memmove(lrcsi_work_take(work, count, 1), o.answer, count);
    } else if (status == LRCS_OK) {
        lrcsi_query_areas(view, o.answer, visible);
    }
    return status;
}
