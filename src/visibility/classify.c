/* SPDX-License-Identifier: MIT */
/* Finding event edges and the facets that they cross. Why this suffices stands in the header; what
   undecided facets show of themselves is decided elsewhere. */
#include "visibility/classify.h"

#include <math.h>
#include <string.h>

#include "base/exact.h"
#include "base/sort.h"
#include "base/work.h"
#include "view/side.h"
#include "visibility/sample.h"

/* How many listed events are examined at most to tell whether any crosses a facet, and how many of
   them whose boxes meet the facet's. One facet in 100,000 of real models needs more. Where facets
   are long and narrow, or stand in a stack, a grid separates little: without a limit the search
   would take quadratic time. A facet that is still undecided then counts as undecided, which is
   never wrong. Most events listed near needles about one tip stand beside them. */
#define MOST_LISTED 4096u
#define MOST_ASKED  512u
/* Of a facet in so many rows and columns of the grid or more, each row is limited to the cells
   between its sides: long facets across the grid touch few of the cells of their boxes. */
#define SLANTED 3
/* How many rows, cells, and listed events are examined at most to tell whether any event may cross
   a run. */
#define RUN_STEPS 1024u

/* --- crossings -------------------------------------------------------------------------------- */

/* A facet that asks which event edges cross it. */
typedef struct crossing_ask {
    uint32_t facet;
    int facing;
    const uint32_t *corner;
    lrcsi_view_side side[3]; /* from corner k to k + 1 */
} crossing_ask;

/* Which way vertices a, b, c turn: from view coordinates where their error allows, else exactly. Of
   three vertices that far away is not taken as the one from which both others are seen: it would
   blur what the others tell. The bound is that of view/side.h. */
static int vertex_turn(const lrcsi_view *view, uint32_t a, uint32_t b, uint32_t c)
{
    if (c == a || c == b) {
        return 0;
    }
    double off[3] = {lrcsi_view_point_err(view->point[a].x), lrcsi_view_point_err(view->point[b].x),
                     lrcsi_view_point_err(view->point[c].x)};
    if (off[0] > off[1] + off[2]) {
        uint32_t far = a;
        double far_off = off[0];
        a = b;
        b = c;
        c = far;
        off[0] = off[1];
        off[1] = off[2];
        off[2] = far_off;
    }
    const double *at = view->point[a].x;
    const double p[2] = {view->point[b].x[0] - at[0], view->point[b].x[1] - at[1]};
    const double q[2] = {view->point[c].x[0] - at[0], view->point[c].x[1] - at[1]};
    double turn = p[0] * q[1] - p[1] * q[0];
    double e = off[0] + off[1];
    double f = off[0] + off[2];
    if (fabs(turn) >
        1.5 * (e * (fabs(q[0]) + fabs(q[1]) + 2 * f) + f * (fabs(p[0]) + fabs(p[1])))) {
        return turn > 0 ? 1 : -1;
    }
    const lrcs_point *v = view->prepared->vertex;
    return lrcsi_exact_turn(v[a].x, v[b].x, v[c].x, view->direction);
}

/* Does the segment p q cross the open inside of the facet, in projection? Two convex figures of
   the plane are apart if and only if some line along a side of either parts them. *along: it lies
   on the line of a side that parts them. */
static int segment_crosses(const lrcsi_view *view, const crossing_ask *ask, uint32_t p, uint32_t q,
                           int *along)
{
    const double *x = view->point[p].x;
    const double *y = view->point[q].x;
    double x_err = lrcsi_view_point_err(x);
    double y_err = lrcsi_view_point_err(y);
    for (int k = 0; k < 3; k++) {
        uint32_t a = ask->corner[k];
        uint32_t b = ask->corner[(k + 1) % 3];
        int of_p = ask->facing * lrcsi_view_side_turn(&ask->side[k], x, x_err);
        int of_q = ask->facing * lrcsi_view_side_turn(&ask->side[k], y, y_err);
        if (of_p == 1 || of_q == 1) {
            continue;
        }
        of_p = of_p == -1 ? -1 : ask->facing * vertex_turn(view, a, b, p);
        of_q = of_q == -1 ? -1 : ask->facing * vertex_turn(view, a, b, q);
        if (of_p <= 0 && of_q <= 0) {
            *along |= of_p == 0 && of_q == 0;
            return 0;
        }
    }
    const lrcsi_view_side line = lrcsi_view_side_of(view, p, q);
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        const double *corner = view->point[ask->corner[k]].x;
        int side = lrcsi_view_side_turn(&line, corner, ask->side[k].at_err);
        side = side != LRCSI_VIEW_UNSURE ? side : vertex_turn(view, p, q, ask->corner[k]);
        left |= side > 0;
        right |= side < 0;
    }
    return left && right;
}

/* Is the vertex nearer the laser than the facet's plane? The facet's own are not. */
static int vertex_nearer(const lrcsi_view *view, const crossing_ask *ask, uint32_t vertex)
{
    return vertex != ask->corner[0] && vertex != ask->corner[1] && vertex != ask->corner[2] &&
           lrcsi_sample_above(view, ask->facet, view->prepared->vertex[vertex].x) > 0;
}

static int edge_crosses(const lrcsi_view *view, const crossing_ask *ask, uint32_t edge, int *along)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *own = p->topology.facet_edge[ask->facet].corner;
    const lrcsi_edge *e = &p->topology.edge[edge];
    if (edge == own[0] || edge == own[1] || edge == own[2]) {
        return 0;
    }
    int beside = 0; /* on the line of a side that separates them */
    int crosses = segment_crosses(view, ask, e->low, e->high, &beside);
    if (!(crosses || beside) ||
        !(vertex_nearer(view, ask, e->low) || vertex_nearer(view, ask, e->high))) {
        return 0;
    }
    *along |= beside;
    return crosses;
}

static crossing_ask crossing_ask_of(const lrcsi_view *view, uint32_t facet)
{
    crossing_ask ask = {.facet = facet, .facing = view->facing[facet]};
    ask.corner = view->prepared->scene->facet[facet].corner;
    for (int k = 0; k < 3; k++) {
        ask.side[k] = lrcsi_view_side_of(view, ask.corner[k], ask.corner[(k + 1) % 3]);
    }
    return ask;
}

/* How many of so many steps the meter allows. */
static uint32_t steps_allowed(const lrcsi_meter *meter, uint32_t steps)
{
    uint64_t left = meter ? (meter->spent ? 0 : meter->most - meter->taken) : steps;
    return left < steps ? (uint32_t)left : steps;
}

/* Does a facet of the component have this edge? */
static int component_has_edge(const lrcsi_classification *c, uint32_t edge, uint32_t component)
{
    const lrcsi_topology *t = &c->view->prepared->topology;
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    for (uint32_t k = 0; k < t->edge[edge].uses; k++) {
        if (c->component[use[k].facet] == component) {
            return 1;
        }
    }
    return 0;
}

/* The cells of the grid that a facet touches. */
typedef struct facet_cells {
    lrcsi_cells all;
    int slanted; /* rows are limited to the cells between the sides */
    lrcsi_strip_segment side[3];
} facet_cells;

static void facet_cells_make(const lrcsi_grid *grid, uint32_t facet, const lrcsi_view_box *box,
                             facet_cells *cells)
{
    const lrcsi_cells all = lrcsi_grid_cells(grid, box);
    cells->all = all;
    cells->slanted = all.x1 - all.x0 >= SLANTED && all.y1 - all.y0 >= SLANTED;
    if (cells->slanted) {
        lrcsi_grid_sides(grid, grid->view->prepared->scene->facet[facet].corner, 3, 0, cells->side);
    }
}

/* Finds at most `most` of them: one suffices to know that there are any. Examines at most *steps
   listed events, MOST_ASKED of them with boxes that meet the facet's, and leaves in *steps how many
   more it might have examined; LRCS_NONE: any number.
   Finds fewer also where the meter is spent. Events whose box lies beside the facet's do not cross
   it. A cell lists events in the order of their nearest points: after the first one that lies
   behind all of the facet, no other comes nearer than the facet. Steps are counted in a register
   and charged at the end. */
static uint32_t crossings_find(lrcsi_classification *classification, uint32_t facet,
                               uint32_t component, uint32_t most, uint32_t *steps,
                               lrcsi_meter *meter)
{
    const lrcsi_view *view = classification->view;
    const lrcsi_grid *grid = &classification->grid;
    crossing_ask ask = {.corner = NULL}; /* made when it is first needed */
    const lrcsi_view_box box = *lrcsi_boxes_facet(&classification->boxes, facet);
    facet_cells cells;
    const uint32_t allowed = steps_allowed(meter, *steps);
    const uint32_t asked = ++classification->asked;
    uint32_t left = allowed;
    uint32_t near = *steps == LRCS_NONE ? LRCS_NONE : MOST_ASKED;
    uint32_t count = 0;
    int more = 0; /* an event was left out for want of steps */
    classification->along = 0;
    facet_cells_make(grid, facet, &box, &cells);
    for (uint32_t y = cells.all.y0; y < cells.all.y1 && !more; y++) {
        const uint32_t *row = grid->first + (size_t)y * grid->size;
        const lrcsi_cells range =
            cells.slanted ? lrcsi_grid_row(grid, cells.side, 3, y) : cells.all;
        for (uint32_t x = range.x0; x < range.x1 && !more; x++) {
            for (uint32_t i = row[x]; i < row[x + 1] && count < most; i++) {
                lrcsi_event_box *event = &classification->event[grid->item[i]];
                more = left == 0;
                if (more) {
                    break;
                }
                left--;
                if (lrcsi_view_box_behind(&event->box, &box)) {
                    break;
                }
                if (lrcsi_view_box_beside(&event->box, &box)) {
                    continue;
                }
                more = near == 0;
                if (more) {
                    break;
                }
                near--;
                int again = event->asked == asked;
                event->asked = asked;
                if (again || (component != LRCS_NONE &&
                              !component_has_edge(classification, event->edge, component))) {
                    continue;
                }
                if (!ask.corner) {
                    ask = crossing_ask_of(view, facet);
                }
                if (edge_crosses(view, &ask, event->edge, &classification->along)) {
                    classification->crossing[count++] = event->edge;
                }
            }
        }
    }
    lrcsi_meter_take(meter, allowed - left);
    *steps -= *steps != LRCS_NONE ? allowed - left : 0;
    if (near == 0) {
        *steps = 0;
    } else if (more && *steps != 0) {
        lrcsi_meter_take(meter, 1); /* there is none left: it is spent */
    }
    return count;
}

uint32_t lrcsi_classify_crossings(lrcsi_classification *classification, uint32_t facet,
                                  lrcsi_meter *meter)
{
    if (classification->crossed != facet) {
        uint32_t steps = LRCS_NONE; /* no limit */
        classification->crossings =
            crossings_find(classification, facet, LRCS_NONE, LRCS_NONE, &steps, meter);
        classification->crossed = lrcsi_meter_spent(meter) ? LRCS_NONE : facet;
    }
    return classification->crossings;
}

int lrcsi_classify_crossed_by(lrcsi_classification *classification, uint32_t facet,
                              uint32_t component, lrcsi_meter *meter)
{
    uint32_t steps = LRCS_NONE; /* no limit */
    if (classification->crossed == facet) {
        for (uint32_t i = 0; i < classification->crossings; i++) {
            if (component_has_edge(classification, classification->crossing[i], component)) {
                return 1;
            }
        }
        return 0;
    }
    classification->crossed = LRCS_NONE;
    return crossings_find(classification, facet, component, 1, &steps, meter) > 0 ||
           lrcsi_meter_spent(meter);
}

/* --- contacts --------------------------------------------------------------------------------- */

int lrcsi_intersection_hides(const lrcsi_view *view, uint32_t facet,
                             const lrcsi_intersection *touch)
{
    return lrcsi_view_casts(view, touch->other) && !(touch->kind == LRCSI_INTERSECTION_COPLANAR &&
                                                     lrcsi_sample_beats(view, facet, touch->other));
}

static int intersection_divides(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        if (lrcsi_intersection_hides(view, facet, &intersections->entry[i])) {
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

/* Orders floats from the largest to the least: z nearest to the laser comes first. */
static uint64_t depth_key(float z)
{
    uint32_t bits;
    memcpy(&bits, &z, sizeof bits);
    return bits >> 31 ? bits : ~bits & 0x7fffffff;
}

/* Sorts the events by their nearest points. Takes 20 bytes an event for the time being; the grid
   made afterwards may take 32 (events_most), so that the need does not grow. */
static int events_sort(lrcsi_classification *c, lrcs_work *work)
{
    size_t mark = work->used;
    const lrcsi_view *view = c->view;
    uint32_t count = c->events.count;
    uint64_t *key = lrcsi_work_take(work, count, sizeof *key);
    uint64_t *key_spare = lrcsi_work_take(work, count, sizeof *key_spare);
    uint32_t *spare = lrcsi_work_take(work, count, sizeof *spare);
    if (!key || !key_spare || !spare) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const lrcsi_edge *edge = &view->prepared->topology.edge[c->events.edge[i]];
        const double *p = view->point[edge->low].x;
        const double *q = view->point[edge->high].x;
        double high = lrcsi_max(p[2] + lrcsi_view_point_err(p), q[2] + lrcsi_view_point_err(q));
        key[i] = depth_key(lrcsi_view_box_float(high * view->scale)); /* as in their boxes */
    }
    lrcsi_sort_pairs(key, c->events.edge, key_spare, spare, count);
    work->used = mark;
    return LRCS_OK;
}

/* Events where they lie, and their grid. */
static int events_file(lrcsi_classification *c, lrcs_work *work)
{
    const lrcsi_view *view = c->view;
    uint32_t count = c->events.count;
    if (events_sort(c, work) != LRCS_OK) {
        return LRCS_E_MEMORY;
    }
    c->event = lrcsi_work_take(work, count, sizeof *c->event);
    c->crossing = lrcsi_work_take(work, count, sizeof *c->crossing);
    if (!c->event || !c->crossing) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        lrcsi_event_box *event = &c->event[i];
        const lrcsi_edge *edge = &view->prepared->topology.edge[c->events.edge[i]];
        const uint32_t ends[2] = {edge->low, edge->high};
        *event = (lrcsi_event_box){lrcsi_view_box_of(view, ends, 2), c->events.edge[i], 0};
    }
    return LRCS_OK;
}

/* Can no event edge cross any facet of a run? Most runs far from events lie in rows of the grid
   whose cells list nothing, and are proved clear in one step a row. Gives up, and returns 0, where
   this takes more steps than asking the run's facets would. */
static int run_clear(const lrcsi_classification *c, uint32_t run, lrcsi_meter *meter)
{
    const lrcsi_grid *grid = &c->grid;
    const lrcsi_view_box box = c->boxes.run[run];
    lrcsi_cells cells = lrcsi_grid_cells(grid, &box);
    uint32_t steps = RUN_STEPS;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        const uint32_t *row = grid->first + (size_t)y * grid->size;
        uint32_t end = row[cells.x0] == row[cells.x1] ? cells.x0 : cells.x1;
        uint32_t row_steps = 1 + end - cells.x0;
        if (row_steps > steps) {
            return 0;
        }
        steps -= row_steps;
        for (uint32_t x = cells.x0; x < end; x++) {
            for (uint32_t i = row[x]; i < row[x + 1]; i++) {
                const lrcsi_view_box *event = &c->event[grid->item[i]].box;
                if (steps-- == 0 || !lrcsi_meter_take(meter, 1)) {
                    return 0;
                }
                if (lrcsi_view_box_behind(event, &box)) {
                    break;
                }
                if (!lrcsi_view_box_beside(event, &box)) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

/* Whether a facet is undecided; and if not, whether it is alone in its region. */
static void facet_decide(lrcsi_classification *c, uint32_t f, lrcsi_meter *meter)
{
    uint32_t steps = MOST_LISTED;
    c->along = 0;
    c->undecided[f] =
        intersection_divides(c->view, f) ||
        (lrcsi_grid_any(&c->grid, lrcsi_grid_cells(&c->grid, lrcsi_boxes_facet(&c->boxes, f))) &&
         crossings_find(c, f, LRCS_NONE, 1, &steps, meter) > 0) ||
        steps == 0 || lrcsi_meter_spent(meter);
    c->undecided_count += c->undecided[f];
    if (c->undecided[f] || c->along || c->view->prepared->intersections.met[f]) {
        c->joinable[f] = 0;
    }
}

/* Which facets are undecided: none of a run that meets no contact and that no event may cross; of
   others each is asked. The grid of events then has no more cells than serve those. */
static int facets_decide(lrcsi_classification *c, lrcsi_meter *meter, lrcs_work *work)
{
    const lrcs_prepared *p = c->view->prepared;
    size_t mark = work->used;
    int status = lrcsi_grid_edges(c->events.edge, c->events.count, events_most(p), work, &c->grid);
    for (uint32_t r = 0; r < p->runs.count && status == LRCS_OK; r++) {
        if (c->boxes.state[r] == LRCSI_BOXES_RUN &&
            (p->runs.run[r].has_contacts || !run_clear(c, r, meter))) {
            lrcsi_boxes_open(&c->boxes, r);
        }
    }
    if (status == LRCS_OK && lrcsi_grid_fit(&c->grid, &c->boxes)) {
        work->used = mark;
        status = lrcsi_grid_edges(c->events.edge, c->events.count, events_most(p), work, &c->grid);
    }
    for (uint32_t r = 0; r < p->runs.count && status == LRCS_OK; r++) {
        uint32_t end = lrcsi_run_end(r * LRCSI_RUN, p->scene->facet_count);
        for (uint32_t f = r * LRCSI_RUN; f < end && c->boxes.state[r] == LRCSI_BOXES_FACETS; f++) {
            if (c->joinable[f] != 0) {
                facet_decide(c, f, meter);
            }
        }
    }
    return status;
}

void lrcsi_classify_regions(const lrcsi_classification *classification)
{
    lrcsi_events_join(classification->view, classification->joinable, classification->region);
}

/* The direction in which each facet faces if it casts (lrcsi_view_casts), otherwise 0; zeros behind
   the last one. Run by run, without branches: compilers vectorise the inner loop. */
static void facets_cast(const lrcsi_view *view, signed char *cast)
{
    const signed char back = view->backs.cast ? LRCSI_REDUNDANT_FROM_BEHIND : LRCSI_NOT_REDUNDANT;
    uint32_t count = view->prepared->scene->facet_count;
    for (uint32_t start = 0; start < count; start += LRCSI_RUN) {
        size_t facets = lrcsi_run_end(start, count) - start;
        signed char facing[LRCSI_RUN] = {0};
        signed char redundant[LRCSI_RUN] = {0};
        memcpy(facing, view->facing + start, facets);
        memcpy(redundant, view->prepared->redundant + start, facets);
        for (uint32_t i = 0; i < LRCSI_RUN; i++) {
            signed char least = facing[i] > 0 ? LRCSI_REDUNDANT : back;
            cast[start + i] = redundant[i] < least ? facing[i] : 0;
        }
    }
    cast[lrcsi_runs_room(count)] = 0;
}

size_t lrcsi_classify_need(const lrcs_prepared *prepared)
{
    size_t edges = prepared->topology.edge_count;
    size_t facets = prepared->scene->facet_count;
    size_t room = lrcsi_runs_room(prepared->scene->facet_count);
    size_t need = lrcsi_work_add(lrcsi_work_bytes(room + 1, 1), lrcsi_work_bytes(facets, 1));
    need = lrcsi_work_add(need, 2 * lrcsi_work_bytes(room, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_boxes_need(prepared));
    need = lrcsi_work_add(need, lrcsi_events_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(lrcsi_event_box)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_grid_need(facets, events_most(prepared)));
}

/* Grids have a cell or so for every facet that may cast, unless facets are large: then most facets
   meet no event's cell, and need no further look. */
int lrcsi_classify_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_classification *classification)
{
    size_t mark = work->used;
    uint32_t count = view->prepared->scene->facet_count;
    lrcsi_classification c = {.view = view, .crossed = LRCS_NONE};
    c.grid = lrcsi_grid_empty(view, view->front + (view->backs.cast ? view->back : 0));
    c.undecided = lrcsi_work_take_zero(work, count, 1);
    c.joinable = lrcsi_work_take(work, lrcsi_runs_room(count) + 1, 1);
    c.component = lrcsi_work_take(work, lrcsi_runs_room(count), sizeof *c.component);
    c.region = lrcsi_work_take(work, lrcsi_runs_room(count), sizeof *c.region);
    int status = c.undecided && c.joinable && c.component && c.region ? LRCS_OK : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        facets_cast(view, c.joinable);
        status = lrcsi_boxes_make(view, c.joinable, work, &c.boxes);
    }
    status = status == LRCS_OK ? lrcsi_events_make(view, c.joinable, work, &c.events) : status;
    status = status == LRCS_OK ? events_file(&c, work) : status;
    if (status == LRCS_OK) {
        lrcsi_events_join(view, c.joinable, c.component);
        status = facets_decide(&c, meter, work);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *classification = c;
    return LRCS_OK;
}
