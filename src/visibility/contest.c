/* SPDX-License-Identifier: MIT */
/* Finding event edges and the facets that they cross. Why this suffices stands in the header; what
   contested facets show of themselves is decided elsewhere. */
#include "visibility/contest.h"

#include <math.h>
#include <string.h>

#include "base/exact.h"
#include "base/work.h"
#include "visibility/sample.h"

/* --- crossings -------------------------------------------------------------------------------- */

/* A facet that asks which event edges cross it, and its box, widened by the view's error and by
   what the edges' boxes are rounded. */
typedef struct contest_ask {
    uint32_t facet;
    int facing;
    const uint32_t *corner;
    double low[2], high[2];
    double far; /* no point of it is farther from the laser: z */
} contest_ask;

static contest_ask contest_ask_of(const lrcsi_view *view, uint32_t facet)
{
    contest_ask ask = {.facet = facet,
                       .facing = view->facing[facet],
                       .corner = view->prepared->scene->facet[facet].corner};
    /* of floats below 2 radii in magnitude: 2^-23 radii */
    double wide = 2 * view->off + 0x1p-23 * view->prepared->radius;
    lrcsi_grid_box(view, ask.corner, 3, ask.low, ask.high);
    for (int k = 0; k < 2; k++) {
        ask.low[k] -= wide;
        ask.high[k] += wide;
    }
    double near;
    lrcsi_grid_depth(view, facet, &ask.far, &near);
    ask.far -= wide;
    return ask;
}

/* Which way vertices a, b, c turn: from view coordinates where their error allows, else exactly.
   With e for that error: differences are off by 2.2 e, rounding included (e is 32 u of the reach),
   and so p x q by 2.2 e (|p| + |q| + 4.4 e) in the 1-norm, and by 3 u of its products, which are
   below 4 reaches times |p|: another 0.4 e |p|. */
static int vertex_turn(const lrcsi_view *view, uint32_t a, uint32_t b, uint32_t c)
{
    if (c == a || c == b) {
        return 0;
    }
    const double *at = view->point[a].x;
    const double p[2] = {view->point[b].x[0] - at[0], view->point[b].x[1] - at[1]};
    const double q[2] = {view->point[c].x[0] - at[0], view->point[c].x[1] - at[1]};
    double turn = p[0] * q[1] - p[1] * q[0];
    double size = fabs(p[0]) + fabs(p[1]) + fabs(q[0]) + fabs(q[1]);
    if (fabs(turn) > 4 * view->off * (size + 4 * view->off)) {
        return turn > 0 ? 1 : -1;
    }
    const lrcs_point *v = view->prepared->vertex;
    return lrcsi_exact_turn(v[a].x, v[b].x, v[c].x, view->direction);
}

/* Does the segment p q cross the open inside of the facet, in projection? Two convex figures of
   the plane are apart just if some line along a side of either parts them. *along: it lies on the
   line of a side that parts them. */
static int segment_crosses(const lrcsi_view *view, const contest_ask *ask, uint32_t p, uint32_t q,
                           int *along)
{
    for (int k = 0; k < 3; k++) {
        uint32_t a = ask->corner[k];
        uint32_t b = ask->corner[(k + 1) % 3];
        int of_p = ask->facing * vertex_turn(view, a, b, p);
        int of_q = ask->facing * vertex_turn(view, a, b, q);
        if (of_p <= 0 && of_q <= 0) {
            *along |= of_p == 0 && of_q == 0;
            return 0;
        }
    }
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        int side = vertex_turn(view, p, q, ask->corner[k]);
        left |= side > 0;
        right |= side < 0;
    }
    return left && right;
}

/* Is the vertex nearer the laser than the facet's plane? The facet's own are not. */
static int vertex_nearer(const lrcsi_view *view, const contest_ask *ask, uint32_t vertex)
{
    return vertex != ask->corner[0] && vertex != ask->corner[1] && vertex != ask->corner[2] &&
           lrcsi_sample_above(view, ask->facet, view->prepared->vertex[vertex].x) > 0;
}

static int edge_crosses(const lrcsi_view *view, const contest_ask *ask, uint32_t edge, int *along)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *own = p->topology.facet_edge[ask->facet].corner;
    const lrcsi_edge *e = &p->topology.edge[edge];
    if (edge == own[0] || edge == own[1] || edge == own[2]) {
        return 0;
    }
    return (vertex_nearer(view, ask, e->low) || vertex_nearer(view, ask, e->high)) &&
           segment_crosses(view, ask, e->low, e->high, along);
}

/* The boxes of the event and of the facet lie apart beyond the view's error, in the view or in
   depth: an edge that is farther than all of the facet is not nearer where it passes over it. */
static int boxes_apart(const lrcsi_contest_edge *event, const contest_ask *ask)
{
    return (double)event->near < ask->far || (double)event->low[0] > ask->high[0] ||
           (double)event->high[0] < ask->low[0] || (double)event->low[1] > ask->high[1] ||
           (double)event->high[1] < ask->low[1];
}

/* At most `most` of them, so that one who only wants to know whether there are any can stop. Fewer
   where the meter is spent. */
static uint32_t contest_find(lrcsi_contest *contest, uint32_t facet, uint32_t most)
{
    const lrcsi_grid *grid = &contest->grid;
    contest_ask ask = contest_ask_of(contest->view, facet);
    lrcsi_cells cells = contest->cells[facet];
    uint32_t count = 0;
    contest->asked++;
    contest->along = 0;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = grid->first[(size_t)y * grid->size + cells.x0];
        uint32_t end = grid->first[(size_t)y * grid->size + cells.x1];
        if (!lrcsi_meter_take(contest->view->meter, end - i)) {
            break;
        }
        for (; i < end && count < most; i++) { /* a row's cells lie one behind the other */
            lrcsi_contest_edge *event = &contest->event[grid->item[i]];
            if (boxes_apart(event, &ask) || event->asked == contest->asked) {
                continue;
            }
            event->asked = contest->asked;
            if (edge_crosses(contest->view, &ask, event->edge, &contest->along)) {
                contest->crossing[count++] = event->edge;
            }
        }
    }
    return count;
}

uint32_t lrcsi_contest_crossings(lrcsi_contest *contest, uint32_t facet)
{
    if (contest->crossed != facet) {
        contest->crossings = contest_find(contest, facet, LRCS_NONE);
        contest->crossed = lrcsi_meter_spent(contest->view->meter) ? LRCS_NONE : facet;
    }
    return contest->crossings;
}

void lrcsi_contest_recall(lrcsi_contest *contest, uint32_t facet, const uint32_t *crossing,
                          uint32_t count)
{
    memcpy(contest->crossing, crossing, count * sizeof *crossing);
    contest->crossings = count;
    contest->crossed = facet;
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

/* How many events their grid lists at most. */
static size_t events_most(const lrcs_prepared *prepared)
{
    return 8 * (size_t)prepared->topology.edge_count;
}

/* Events where they lie, and their grid. */
static int contest_events(lrcsi_contest *c, lrcs_work *work)
{
    const lrcsi_view *view = c->view;
    uint32_t count = c->events.count;
    c->event = lrcsi_work_take(work, count, sizeof *c->event);
    c->crossing = lrcsi_work_take(work, count, sizeof *c->crossing);
    if (!c->event || !c->crossing) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        lrcsi_contest_edge *event = &c->event[i];
        const lrcsi_edge *edge = &view->prepared->topology.edge[c->events.edge[i]];
        double low[2];
        double high[2];
        lrcsi_grid_box(view, (const uint32_t[2]){edge->low, edge->high}, 2, low, high);
        *event = (lrcsi_contest_edge){
            {(float)low[0], (float)low[1]},
            {(float)high[0], (float)high[1]},
            (float)lrcsi_most(view->point[edge->low].x[2], view->point[edge->high].x[2]),
            c->events.edge[i],
            0};
    }
    return lrcsi_grid_edges(c->events.edge, count, events_most(view->prepared), work, &c->grid,
                            c->cells);
}

/* Which way the facets face that can hide something, and which cells they touch. */
static void contest_cast(lrcsi_contest *c)
{
    const lrcsi_view *view = c->view;
    uint32_t count = view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        c->kin[f] = 0;
        if (lrcsi_grid_casts(view, f)) {
            double low[2];
            double high[2];
            lrcsi_grid_box(view, view->prepared->scene->facet[f].corner, 3, low, high);
            c->cells[f] = lrcsi_grid_cells(&c->grid, low, high);
            c->kin[f] = view->facing[f];
        }
    }
    c->kin[count] = 0;
    lrcsi_grid_fit(&c->grid, c->cells);
}

/* Which facets are contested, and which of the others are alone in their region. */
static void contest_decide(lrcsi_contest *c)
{
    const lrcs_prepared *p = c->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (c->kin[f] != 0) {
            c->along = 0;
            c->contested[f] =
                touch_contests(c->view, f) ||
                (lrcsi_grid_any(&c->grid, c->cells[f]) && contest_find(c, f, 1) > 0) ||
                lrcsi_meter_spent(c->view->meter);
            c->contested_count += c->contested[f];
            if (c->contested[f] || c->along || p->touches.rim[f]) {
                c->kin[f] = 0;
            }
        }
    }
}

void lrcsi_contest_regions(const lrcsi_contest *contest)
{
    lrcsi_events_join(contest->view, contest->kin, contest->region);
}

size_t lrcsi_contest_need(const lrcs_prepared *prepared)
{
    size_t edges = prepared->topology.edge_count;
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_work_bytes(facets + 1, 1), lrcsi_work_bytes(facets, 1));
    need = lrcsi_work_add(need, 2 * lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_cells)));
    need = lrcsi_work_add(need, lrcsi_events_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(lrcsi_contest_edge)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_grid_need(facets, events_most(prepared)));
}

/* Grids have a cell or so for every facet that faces either way, unless facets are large: then most
   facets meet no event's cell, and need no further look. */
int lrcsi_contest_make(const lrcsi_view *view, lrcs_work *work, lrcsi_contest *contest)
{
    size_t mark = work->used;
    uint32_t count = view->prepared->scene->facet_count;
    lrcsi_contest c = {.view = view, .crossed = LRCS_NONE};
    c.grid = lrcsi_grid_empty(view, view->front + view->back);
    c.contested = lrcsi_work_take_zero(work, count, 1);
    c.kin = lrcsi_work_take(work, (size_t)count + 1, 1);
    c.sheet = lrcsi_work_take(work, count, sizeof *c.sheet);
    c.region = lrcsi_work_take(work, count, sizeof *c.region);
    c.cells = lrcsi_work_take(work, count, sizeof *c.cells);
    int status = LRCS_E_MEMORY;
    if (c.contested && c.kin && c.sheet && c.region && c.cells) {
        contest_cast(&c);
        status = lrcsi_events_make(view, c.kin, work, &c.events);
        status = status == LRCS_OK ? contest_events(&c, work) : status;
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    lrcsi_events_join(view, c.kin, c.sheet);
    contest_decide(&c);
    *contest = c;
    return LRCS_OK;
}
