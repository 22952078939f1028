/* SPDX-License-Identifier: MIT */
/* Finding event edges and the facets that they cross. Why this suffices stands in the header; what
   contested facets show of themselves is decided elsewhere. */
#include "visibility/contest.h"

#include "base/exact.h"
#include "base/join.h"
#include "base/work.h"
#include "visibility/sample.h"

/* --- event edges ------------------------------------------------------------------------------ */

enum edge_kind { EDGE_IDLE, EDGE_JOINS, EDGE_EVENT };

/* What an edge is in this view; where it joins two facets that continue each other, they are in
   pair. Facets that cannot hide anything do not count. */
static int edge_kind_of(const lrcsi_view *view, const lrcsi_edge *edge, uint32_t pair[2])
{
    const lrcsi_edge_use *use = view->prepared->topology.use + edge->first_use;
    uint32_t count = 0;
    uint32_t forward = 0;
    int facing = 0;
    for (uint32_t i = 0; i < edge->uses; i++) {
        if (lrcsi_grid_casts(view, use[i].facet)) {
            pair[count < 2 ? count : 1] = use[i].facet;
            count++;
            forward += use[i].forward;
            facing += view->facing[use[i].facet];
        }
    }
    return count == 0                                  ? EDGE_IDLE
           : count == 2 && forward == 1 && facing != 0 ? EDGE_JOINS
                                                       : EDGE_EVENT;
}

/* Lists the event edges and joins facets into sheets. */
static void contest_edges(lrcsi_contest *contest)
{
    const lrcsi_topology *topology = &contest->view->prepared->topology;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        uint32_t pair[2];
        int kind = edge_kind_of(contest->view, &topology->edge[e], pair);
        if (kind == EDGE_JOINS) {
            lrcsi_join(contest->sheet, pair[0], pair[1]);
        } else if (kind == EDGE_EVENT) {
            contest->event[contest->event_count++] = e;
        }
    }
}

/* Joins uniform facets into regions. */
static void contest_regions(lrcsi_contest *contest, const unsigned char *lone)
{
    const lrcsi_topology *topology = &contest->view->prepared->topology;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        uint32_t pair[2];
        if (edge_kind_of(contest->view, &topology->edge[e], pair) == EDGE_JOINS && !lone[pair[0]] &&
            !lone[pair[1]]) {
            lrcsi_join(contest->region, pair[0], pair[1]);
        }
    }
}

static uint32_t *contest_singles(const lrcsi_view *view, lrcs_work *work)
{
    uint32_t facets = view->prepared->scene->facet_count;
    uint32_t *single = lrcsi_work_take(work, facets, sizeof *single);
    for (uint32_t f = 0; f < facets && single; f++) {
        single[f] = f;
    }
    return single;
}

static void contest_roots(uint32_t *join, uint32_t facets)
{
    for (uint32_t f = 0; f < facets; f++) {
        join[f] = lrcsi_join_root(join, f);
    }
}

/* Room for as many events as there are edges, given back but for what they need. */
static int contest_events(lrcsi_contest *contest, lrcs_work *work)
{
    const lrcs_prepared *p = contest->view->prepared;
    size_t mark = work->used;
    contest->event = lrcsi_work_take(work, p->topology.edge_count, sizeof *contest->event);
    if (!contest->event) {
        return LRCS_E_MEMORY;
    }
    contest_edges(contest);
    contest_roots(contest->sheet, p->scene->facet_count);
    uint32_t count = contest->event_count;
    work->used = mark;
    contest->event = lrcsi_work_take(work, count, sizeof *contest->event);
    contest->seen = lrcsi_work_take_zero(work, count, sizeof *contest->seen);
    contest->crossing = lrcsi_work_take(work, count, sizeof *contest->crossing);
    if (!contest->event || !contest->seen || !contest->crossing) {
        return LRCS_E_MEMORY;
    }
    return lrcsi_grid_edges(contest->view, contest->event, count, work, &contest->grid);
}

/* --- crossings -------------------------------------------------------------------------------- */

/* An edge and a facet whose boxes lie apart beyond the view's error. */
static int boxes_apart(const lrcsi_view *view, const lrcsi_edge *edge, const double low[2],
                       const double high[2])
{
    const double *a = view->point[edge->low].x;
    const double *b = view->point[edge->high].x;
    double off = 2 * view->off;
    for (int k = 0; k < 2; k++) {
        if ((a[k] > high[k] + off && b[k] > high[k] + off) ||
            (a[k] < low[k] - off && b[k] < low[k] - off)) {
            return 1;
        }
    }
    return 0;
}

/* Does the segment p q cross the open inside of the facet, in projection? Two convex figures of
   the plane are apart just if some line along a side of either parts them. *along: it lies on the
   line of a side that parts them. */
static int segment_crosses(const lrcsi_view *view, uint32_t facet, const double *p, const double *q,
                           int *along)
{
    const double *corner[3];
    const double *d = view->direction;
    int facing = view->facing[facet];
    for (int k = 0; k < 3; k++) {
        corner[k] = lrcsi_prepared_corner(view->prepared, facet, k);
    }
    for (int k = 0; k < 3; k++) {
        const double *a = corner[k];
        const double *b = corner[(k + 1) % 3];
        int of_p = facing * lrcsi_exact_turn(a, b, p, d);
        int of_q = facing * lrcsi_exact_turn(a, b, q, d);
        if (of_p <= 0 && of_q <= 0) {
            *along = of_p == 0 && of_q == 0;
            return 0;
        }
    }
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        int side = lrcsi_exact_turn(p, q, corner[k], d);
        left |= side > 0;
        right |= side < 0;
    }
    return left && right;
}

/* Is some of the segment nearer the laser than the facet's plane? */
static int segment_nearer(const lrcsi_view *view, uint32_t facet, const double *p, const double *q)
{
    const double *a = lrcsi_prepared_corner(view->prepared, facet, 0);
    const double *b = lrcsi_prepared_corner(view->prepared, facet, 1);
    const double *c = lrcsi_prepared_corner(view->prepared, facet, 2);
    int facing = view->facing[facet];
    return facing * lrcsi_exact_side(a, b, c, p) > 0 || facing * lrcsi_exact_side(a, b, c, q) > 0;
}

static int edge_crosses(const lrcsi_view *view, uint32_t facet, uint32_t edge, const double low[2],
                        const double high[2], int *along)
{
    *along = 0;
    const lrcs_prepared *p = view->prepared;
    const uint32_t *own = p->topology.facet_edge[facet].corner;
    const lrcsi_edge *e = &p->topology.edge[edge];
    if (edge == own[0] || edge == own[1] || edge == own[2] || boxes_apart(view, e, low, high)) {
        return 0;
    }
    const double *a = p->vertex[e->low].x;
    const double *b = p->vertex[e->high].x;
    return segment_crosses(view, facet, a, b, along) && segment_nearer(view, facet, a, b);
}

/* At most `most` of them, so that one who only wants to know whether there are any can stop. */
static uint32_t contest_find(lrcsi_contest *contest, uint32_t facet, uint32_t most)
{
    const lrcsi_grid *grid = &contest->grid;
    double low[2];
    double high[2];
    lrcsi_grid_box(contest->view, contest->view->prepared->scene->facet[facet].corner, 3, low,
                   high);
    lrcsi_cells cells = lrcsi_grid_cells(grid, low, high);
    uint32_t count = 0;
    contest->asked++;
    contest->along = 0;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = grid->first[(size_t)y * grid->size + cells.x0];
        uint32_t end = grid->first[(size_t)y * grid->size + cells.x1];
        for (; i < end && count < most; i++) { /* a row's cells lie one behind the other */
            uint32_t event = grid->item[i];
            if (contest->seen[event] == contest->asked) {
                continue;
            }
            contest->seen[event] = contest->asked;
            int along;
            if (edge_crosses(contest->view, facet, contest->event[event], low, high, &along)) {
                contest->crossing[count++] = contest->event[event];
            }
            contest->along |= along;
        }
    }
    return count;
}

uint32_t lrcsi_contest_crossings(lrcsi_contest *contest, uint32_t facet)
{
    return contest_find(contest, facet, LRCS_NONE);
}

/* --- contacts --------------------------------------------------------------------------------- */

int lrcsi_contest_touch_hides(const lrcsi_view *view, uint32_t facet, const lrcsi_touch *touch)
{
    return lrcsi_grid_casts(view, touch->other) &&
           !(touch->kind == LRCSI_TOUCH_COPLANAR && lrcsi_sample_beats(view, facet, touch->other));
}

static int touch_contests(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_touches *touches = &view->prepared->touches;
    for (uint32_t i = touches->first[facet]; i < touches->first[facet + 1]; i++) {
        if (lrcsi_contest_touch_hides(view, facet, &touches->touch[i])) {
            return 1;
        }
    }
    return 0;
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcsi_contest_need(const lrcs_prepared *prepared)
{
    size_t edges = prepared->topology.edge_count;
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(3 * edges, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_grid_need(edges, 8 * edges + 8192));
    need = lrcsi_work_add(need, lrcsi_work_bytes(2 * facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(2 * facets, 1));
}

/* Which facets are contested, and which of the others are alone in their region. */
static void contest_decide(lrcsi_contest *c, unsigned char *lone)
{
    const lrcs_prepared *p = c->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (lrcsi_grid_casts(c->view, f)) {
            c->contested[f] = touch_contests(c->view, f) || contest_find(c, f, 1) > 0;
            c->contested_count += c->contested[f];
            lone[f] = c->contested[f] || c->along || p->touches.rim[f];
        }
    }
}

int lrcsi_contest_make(const lrcsi_view *view, lrcs_work *work, lrcsi_contest *contest)
{
    size_t mark = work->used;
    uint32_t count = view->prepared->scene->facet_count;
    lrcsi_contest c = {.view = view};
    c.contested = lrcsi_work_take_zero(work, count, 1);
    c.sheet = contest_singles(view, work);
    c.region = contest_singles(view, work);
    int status = c.contested && c.sheet && c.region ? contest_events(&c, work) : LRCS_E_MEMORY;
    size_t end = work->used;
    unsigned char *lone = status == LRCS_OK ? lrcsi_work_take_zero(work, count, 1) : NULL;
    if (!lone) {
        work->used = mark;
        return status == LRCS_OK ? LRCS_E_MEMORY : status;
    }
    contest_decide(&c, lone);
    contest_regions(&c, lone);
    contest_roots(c.region, count);
    work->used = end;
    *contest = c;
    return LRCS_OK;
}
