/* SPDX-License-Identifier: MIT */
/* Who is asked how: uniform facets once a region, contested ones that one sheet hides at once, all
   others in cells of the view plane, together or one by one. */
#include "visibility/occlude.h"

#include "base/work.h"
#include "visibility/cells.h"
#include "visibility/query.h"

/* So many undecided facets, or more, are done together (visibility/cells.h), if they are one of so
   many facets at least: all facets are sorted into the blocks for that, which costs more than to
   do a few of them. */
#define CELLS_LEAST 192u
#define CELLS_SHARE 32u

/* --- one facet -------------------------------------------------------------------------------- */

static lrcsi_visible answered_area(const lrcsi_occluding *o, uint32_t facet)
{
    double whole = lrcsi_view_tilt(o->contest->view, facet).projected;
    int answer = o->uniform[facet];
    double low = answer == LRCSI_QUERY_VISIBLE ? whole : 0;
    double high = answer == LRCSI_QUERY_HIDDEN ? 0 : whole;
    return (lrcsi_visible){0.5 * (low + high), low, high, 0, 0};
}

void lrcsi_occlude_open(lrcsi_occluding *o, uint32_t facet)
{
    lrcsi_contest *contest = o->contest;
    o->answer = (lrcsi_visible){0, 0, 0, 0, 0};
    o->alone.facet = o->alone.target.facet = facet;
    o->contested = o->whole = 0;
    if (!lrcsi_grid_casts(contest->view, facet)) {
        return;
    }
    if (!contest->contested[facet]) {
        o->answer = answered_area(o, facet);
        o->whole = o->answer.low > 0;
    } else if (!lrcsi_query_screened(contest, &o->alone.grid, facet)) {
        o->contested = 1;
        lrcsi_alone_open(&o->alone, facet);
    }
}

int lrcsi_occlude_next(lrcsi_occluding *o)
{
    if (!o->whole) {
        return o->contested && lrcsi_alone_next(&o->alone);
    }
    o->whole = 0;
    lrcsi_target_make(o->contest->view, o->alone.facet, &o->alone.target);
    lrcsi_clip_triangle((const double(*)[2])o->alone.target.corner, &o->alone.piece);
    return 1;
}

lrcsi_visible lrcsi_occlude_close(lrcsi_occluding *o)
{
    return o->contested ? lrcsi_alone_close(&o->alone) : o->answer;
}

lrcsi_visible lrcsi_occlude_area(lrcsi_occluding *o)
{
    while (o->contested && lrcsi_alone_next(&o->alone)) {
    }
    return lrcsi_occlude_close(o);
}

/* --- all facets ------------------------------------------------------------------------------- */

/* May undecided facets be done together? */
static int cells_serve(const lrcs_prepared *prepared)
{
    return prepared->scene->facet_count >= CELLS_LEAST && !prepared->convex;
}

size_t lrcsi_occlude_need(const lrcs_prepared *prepared)
{
    size_t facets = lrcsi_work_bytes(prepared->scene->facet_count, 1);
    size_t need = lrcsi_work_add(lrcsi_grid_facets_need(prepared), facets);
    need = lrcsi_work_add(need, lrcsi_alone_need(prepared));
    size_t cells = cells_serve(prepared) ? lrcsi_cells_need(prepared) : 0;
    return lrcsi_work_add(facets, need > cells ? need : cells);
}

int lrcsi_occlude_make(lrcsi_contest *contest, lrcs_work *work, lrcsi_occluding *o)
{
    size_t mark = work->used;
    *o = (lrcsi_occluding){.contest = contest};
    o->uniform = lrcsi_work_take(work, contest->view->prepared->scene->facet_count, 1);
    lrcsi_grid facets;
    int status =
        o->uniform ? lrcsi_query_uniform(contest, work, &facets, o->uniform) : LRCS_E_MEMORY;
    status = status == LRCS_OK ? lrcsi_alone_make(contest, &facets, work, &o->alone) : status;
    if (status != LRCS_OK) {
        work->used = mark;
    }
    return status;
}

int lrcsi_occlude_all(lrcsi_contest *contest, lrcs_work *work, lrcsi_visible *visible)
{
    const lrcsi_view *view = contest->view;
    uint32_t facets = view->prepared->scene->facet_count;
    size_t mark = work->used;
    lrcsi_occluding o;
    unsigned char *open = lrcsi_work_take(work, facets, 1);
    for (uint32_t f = 0; f < facets && open; f++) {
        open[f] = contest->contested[f] && lrcsi_grid_casts(view, f);
    }
    /* 1. Many undecided facets all together, by cells of the view plane. */
    if (open && contest->contested_count >= CELLS_LEAST &&
        contest->contested_count >= facets / CELLS_SHARE && cells_serve(view->prepared)) {
        lrcsi_cells_areas(contest, work, open, visible);
    }
    /* 2. One by one what that left open, and what is not contested. */
    int status = open ? lrcsi_occlude_make(contest, work, &o) : LRCS_E_MEMORY;
    for (uint32_t f = 0; f < facets && status == LRCS_OK; f++) {
        if (open[f] || !contest->contested[f]) {
            lrcsi_occlude_open(&o, f);
            visible[f] = lrcsi_occlude_area(&o);
        }
    }
    work->used = mark;
    return status;
}
