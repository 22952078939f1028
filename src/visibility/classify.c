/* SPDX-License-Identifier: MIT */
/* Finds the event edges that cross a facet, and classifies all facets. The header explains why this
   suffices. How much of an undecided facet is visible is decided elsewhere. */
#include "visibility/classify.h"

#include <math.h>
#include <string.h>

#include "base/exact.h"
#include "base/sort.h"
#include "base/vec3.h"
#include "base/work.h"
#include "view/side.h"
#include "visibility/sample.h"

/* To decide whether any event crosses a facet, at most MAX_LISTED listed events are examined, and
   at most MAX_TESTED of those whose boxes meet the facet's box. One facet in 100,000 of real models
   needs more. If facets are long and narrow or lie in a stack, a grid separates little: without a
   limit the search would take quadratic time. If the limit is reached, the facet counts as
   undecided, which is never wrong. */
#define MAX_LISTED 4096u
#define MAX_TESTED 512u
/* If a facet is in at least so many rows and columns of the grid, each row is limited to the cells
   between its sides: long facets across the grid meet few of the cells of their boxes. */
#define MIN_ROWS 3
/* The largest number of rows and listed events that are examined to decide whether any event may
   cross a run. */
#define RUN_STEPS 1024u

/* --- crossings -------------------------------------------------------------------------------- */

/* The orientation of vertices a, b, c in the view: 1 counter-clockwise, -1 clockwise, 0 collinear.
   From view coordinates if their error allows it, otherwise exactly. The vertex with the largest
   error is never the origin of both differences, whose errors it would enlarge. The error bound is
   that of view/side.h. */
static int vertex_turn(const lrcsi_view *view, uint32_t a, uint32_t b, uint32_t c)
{
    if (c == a || c == b) {
        return 0;
    }
    double err[3] = {view->point[a].err, view->point[b].err, view->point[c].err};
    if (err[0] > err[1] + err[2]) {
        uint32_t far = a;
        double far_err = err[0];
        a = b;
        b = c;
        c = far;
        err[0] = err[1];
        err[1] = err[2];
        err[2] = far_err;
    }
    const double *at = view->point[a].x;
    const double p[2] = {view->point[b].x[0] - at[0], view->point[b].x[1] - at[1]};
    const double q[2] = {view->point[c].x[0] - at[0], view->point[c].x[1] - at[1]};
    double turn = p[0] * q[1] - p[1] * q[0];
    double e = err[0] + err[1];
    double f = err[0] + err[2];
    if (fabs(turn) >
        1.5 * (e * (fabs(q[0]) + fabs(q[1]) + 2 * f) + f * (fabs(p[0]) + fabs(p[1])))) {
        return turn > 0 ? 1 : -1;
    }
    const lrcs_point *v = view->prepared->vertex;
    return lrcsi_exact_orient(v[a].x, v[b].x, v[c].x, view->direction);
}

/* Does the segment p q cross the interior of the facet in projection? From view coordinates: 1 yes,
   0 no, or LRCSI_VIEW_UNDECIDED. Two convex figures of the plane are disjoint if and only if a line
   along a side of one of them separates them.

   Let a, b, c and s be the vectors from p to the corners and to q; if the facet faces away, the
   plane is reflected, so that the corners are counter-clockwise. Corner a lies to the left of p q
   by s x a, p to the left of side a b by a x b, and q by (b - a) x (s - a) = a x b + s x a - s x b.
   Each vector has an error of at most e in each coordinate (lrcsi_view_point_err). Let `size` be
   the sum of their 1-norms. A product v x w has an error of e (|v| + |w|) + 2 e^2, and by rounding
   of 2 u |v| |w|, which is below e |w| / 5, because e is at least 10 u |v|. So a sum of three has
   an error of 2.4 e size + 6 e^2, and adding them costs 2 u of their sum, below 0.4 e size. */
static int segment_crosses_plainly(const lrcsi_view *view, uint32_t facet, uint32_t p, uint32_t q)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double mirror = view->facing[facet];
    const lrcsi_view_vertex *from = &view->point[p];
    const lrcsi_view_vertex *to = &view->point[q];
    const lrcsi_view_vertex *i = &view->point[corner[0]];
    const lrcsi_view_vertex *j = &view->point[corner[1]];
    const lrcsi_view_vertex *k = &view->point[corner[2]];
    const double a[2] = {i->x[0] - from->x[0], mirror * (i->x[1] - from->x[1])};
    const double b[2] = {j->x[0] - from->x[0], mirror * (j->x[1] - from->x[1])};
    const double c[2] = {k->x[0] - from->x[0], mirror * (k->x[1] - from->x[1])};
    const double s[2] = {to->x[0] - from->x[0], mirror * (to->x[1] - from->x[1])};
    const double size = fabs(a[0]) + fabs(a[1]) + fabs(b[0]) + fabs(b[1]) + fabs(c[0]) +
                        fabs(c[1]) + fabs(s[0]) + fabs(s[1]);
    const double err = from->err + lrcsi_max(lrcsi_max(i->err, j->err), lrcsi_max(k->err, to->err));
    const double turn_err = 4 * err * (size + 2 * err);
    const double sa = lrcsi_vec2_cross(s, a);
    const double sb = lrcsi_vec2_cross(s, b);
    const double sc = lrcsi_vec2_cross(s, c);
    const double ab = lrcsi_vec2_cross(a, b);
    const double bc = lrcsi_vec2_cross(b, c);
    const double ca = lrcsi_vec2_cross(c, a);
    /* How far to the left of each side p or q lies, whichever is farther; the least of these. */
    const double inside =
        lrcsi_min(lrcsi_max(ab, ab + (sa - sb)),
                  lrcsi_min(lrcsi_max(bc, bc + (sb - sc)), lrcsi_max(ca, ca + (sc - sa))));
    const double most = lrcsi_max(sa, lrcsi_max(sb, sc));
    const double least = lrcsi_min(sa, lrcsi_min(sb, sc));
    if (inside < -turn_err || most < -turn_err || least > turn_err) {
        return 0;
    }
    return inside > turn_err && most > turn_err && least < -turn_err ? 1 : LRCSI_VIEW_UNDECIDED;
}

/* The same, decided exactly. *along is set if the segment may run along a side: if it lies on the
   line of a side that separates them, and view coordinates do not show them apart. */
static int segment_crosses(const lrcsi_view *view, uint32_t facet, uint32_t p, uint32_t q,
                           int *along)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    int crosses = segment_crosses_plainly(view, facet, p, q);
    if (crosses != LRCSI_VIEW_UNDECIDED) {
        return crosses;
    }
    for (int k = 0; k < 3; k++) {
        uint32_t a = corner[k];
        uint32_t b = corner[k == 2 ? 0 : k + 1];
        int of_p = view->facing[facet] * vertex_turn(view, a, b, p);
        int of_q = of_p == 1 ? 1 : view->facing[facet] * vertex_turn(view, a, b, q);
        if (of_p <= 0 && of_q <= 0) {
            *along |= of_p == 0 && of_q == 0;
            return 0;
        }
    }
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        int side = vertex_turn(view, p, q, corner[k]);
        left |= side > 0;
        right |= side < 0;
    }
    return left && right;
}

/* Is a vertex nearer to the laser than the facet's plane? The facet's own vertices are not. */
static int vertex_nearer(const lrcsi_view *view, uint32_t facet, uint32_t vertex)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    return vertex != corner[0] && vertex != corner[1] && vertex != corner[2] &&
           lrcsi_sample_above(view, facet, view->prepared->vertex[vertex].x) > 0;
}

static int edge_crosses(const lrcsi_view *view, uint32_t facet, uint32_t edge, int *along)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *own = p->topology.facet_edge[facet].corner;
    const lrcsi_edge *e = &p->topology.edge[edge];
    if (edge == own[0] || edge == own[1] || edge == own[2]) {
        return 0;
    }
    int beside = 0; /* it lies on the line of a side that separates it from the facet */
    int crosses = segment_crosses(view, facet, e->low, e->high, &beside);
    if (!(crosses || beside) ||
        !(vertex_nearer(view, facet, e->low) || vertex_nearer(view, facet, e->high))) {
        return 0;
    }
    *along |= beside;
    return crosses;
}

/* The number of steps, of those wanted, that the meter allows. */
static uint32_t steps_allowed(const lrcsi_meter *meter, uint32_t steps)
{
    uint64_t left = meter ? (meter->spent ? 0 : meter->limit - meter->taken) : steps;
    return left < steps ? (uint32_t)left : steps;
}

/* Does a facet of the component have this edge? */
static int component_has_edge(const lrcsi_classification *c, uint32_t edge, uint32_t component)
{
    return lrcsi_topology_edge_has(&c->view->prepared->topology, edge, c->component, component);
}

/* The cells of the grid that a facet may meet. */
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
    cells->slanted = all.x1 - all.x0 >= MIN_ROWS && all.y1 - all.y0 >= MIN_ROWS;
    if (cells->slanted) {
        lrcsi_grid_sides(grid, grid->view->prepared->scene->facet[facet].corner, 3, 0, cells->side);
    }
}

/* Finds at most `most` event edges, of a component or (LRCS_NONE) of any, that cross the facet and
   are nearer than it somewhere. Examines at most *steps listed events, and MAX_TESTED of those
   whose boxes meet the facet's box; returns in *steps how many more it could have examined.
   LRCS_NONE: no limit. It also finds fewer if the meter is spent. An event whose box is beside the
   facet's box does not cross the facet. A cell lists events in the order of their nearest points:
   after the first one that lies behind all of the facet, no other is nearer than the facet. Steps
   are counted in a register and charged at the end. */
static uint32_t crossings_find(lrcsi_classification *classification, uint32_t facet,
                               uint32_t component, uint32_t most, uint32_t *steps,
                               lrcsi_meter *meter)
{
    const lrcsi_view *view = classification->view;
    const lrcsi_grid *grid = &classification->grid;
    const lrcsi_view_box box = *lrcsi_boxes_facet(&classification->boxes, facet);
    facet_cells cells;
    const uint32_t allowed = steps_allowed(meter, *steps);
    const uint32_t search = ++classification->searches;
    uint32_t left = allowed;
    uint32_t tests_left = *steps == LRCS_NONE ? LRCS_NONE : MAX_TESTED;
    uint32_t count = 0;
    int more = 0; /* an event was not examined because a limit was reached */
    classification->event_along_side = 0;
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
                more = tests_left == 0;
                if (more) {
                    break;
                }
                tests_left--;
                int again = event->last_search == search;
                event->last_search = search;
                if (again || (component != LRCS_NONE &&
                              !component_has_edge(classification, event->edge, component))) {
                    continue;
                }
                if (edge_crosses(view, facet, event->edge, &classification->event_along_side)) {
                    classification->crossing[count++] = event->edge;
                }
            }
        }
    }
    lrcsi_meter_take(meter, allowed - left);
    *steps -= *steps != LRCS_NONE ? allowed - left : 0;
    if (tests_left == 0) {
        *steps = 0;
    } else if (more && *steps != 0) {
        lrcsi_meter_take(meter, 1); /* none is left: this marks the meter as spent */
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
                             const lrcsi_intersection *contact)
{
    return lrcsi_view_casts(view, contact->other) &&
           !(contact->kind == LRCSI_INTERSECTION_COPLANAR &&
             lrcsi_sample_has_precedence(view, facet, contact->other));
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

/* The largest number of entries in the grid of events. */
static size_t max_event_entries(const lrcs_prepared *prepared)
{
    return 8 * (size_t)prepared->topology.edge_count;
}

/* A sort key that puts the largest float first: the z nearest to the laser. */
static uint64_t depth_key(float z)
{
    uint32_t bits;
    memcpy(&bits, &z, sizeof bits);
    return bits >> 31 ? bits : ~bits & 0x7fffffff;
}

/* Sorts the events by their nearest points. Uses 20 bytes per event temporarily; the grid made
   afterwards may take 32 (max_event_entries), so that the total need does not grow. */
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
        const lrcsi_view_vertex *p = &view->point[edge->low];
        const lrcsi_view_vertex *q = &view->point[edge->high];
        double high = lrcsi_max(p->x[2] + p->err, q->x[2] + q->err);
        key[i] = depth_key(lrcsi_view_box_float(high * view->scale)); /* as in their boxes */
    }
    lrcsi_sort_pairs(key, c->events.edge, key_spare, spare, count);
    work->used = mark;
    return LRCS_OK;
}

/* Sorts the events and makes their boxes. */
static int events_make_boxes(lrcsi_classification *c, lrcs_work *work)
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

/* The corners in the view of the facets of a run that can hide others. */
typedef struct run_corners {
    uint32_t count; /* 0: not gathered yet */
    double err;     /* no coordinate of any of them has a larger error */
    double x[3 * LRCSI_RUN], y[3 * LRCSI_RUN];
} run_corners;

/* Leaves out the corners that a facet shares with the one before it: most of them. */
static void run_gather(const lrcsi_classification *c, uint32_t run, run_corners *corners)
{
    const lrcs_scene *scene = c->view->prepared->scene;
    const uint32_t end = lrcsi_run_end(run * LRCSI_RUN, scene->facet_count);
    uint32_t before[3] = {LRCS_NONE, LRCS_NONE, LRCS_NONE};
    uint32_t count = 0;
    corners->err = 0;
    for (uint32_t f = run * LRCSI_RUN; f < end; f++) {
        if (c->joinable[f] == 0) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const uint32_t v = scene->facet[f].corner[k];
            const lrcsi_view_vertex *at = &c->view->point[v];
            corners->x[count] = at->x[0];
            corners->y[count] = at->x[1];
            corners->err = lrcsi_max(corners->err, at->err);
            count += v != before[0] && v != before[1] && v != before[2];
        }
        memcpy(before, scene->facet[f].corner, sizeof before);
    }
    corners->count = count;
}

/* Do all corners lie strictly on one side of the line of an event edge, so that it neither crosses
   a facet of the run nor runs along a side? The error of each turn is that of
   lrcsi_view_side_orient, which increases with the distance and with the error of the point: the
   largest of both bound the errors of all turns. */
static int event_beside_run(const lrcsi_view *view, const run_corners *corners, uint32_t edge)
{
    const lrcsi_edge *e = &view->prepared->topology.edge[edge];
    const lrcsi_view_side line = lrcsi_view_side_of(view, e->low, e->high);
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    double distance = 0;
    for (uint32_t i = 0; i < corners->count; i++) {
        double x = corners->x[i] - line.at[0];
        double y = corners->y[i] - line.at[1];
        double turn = line.to[0] * y - line.to[1] * x;
        least = lrcsi_min(least, turn);
        most = lrcsi_max(most, turn);
        distance = lrcsi_max(distance, fabs(x) + fabs(y));
    }
    double err = line.at_err + corners->err;
    double turn_err = 1.5 * (line.to_err * (distance + 2 * err) + err * line.length);
    return least > turn_err || most < -turn_err;
}

/* Is it proved that no event edge crosses any facet of a run, nor runs along a side of one in front
   of it? The cells of most runs far from events list nothing, which takes one step per row to see.
   An event that is not behind the run is beside it if their boxes are disjoint, or else if all of
   the run lies on one side of the event's line: most of those near a long straight contour do.
   Returns 0 if this takes more steps than testing the facets of the run. */
static int run_clear(lrcsi_classification *c, uint32_t run, lrcsi_meter *meter)
{
    const lrcsi_grid *grid = &c->grid;
    const lrcsi_view_box box = c->boxes.run[run];
    const uint32_t search = ++c->searches;
    lrcsi_cells cells = lrcsi_grid_cells(grid, &box);
    uint32_t steps = RUN_STEPS;
    run_corners corners;
    corners.count = 0;
    corners.err = 0;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        const lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, cells.x0, cells.x1);
        const uint32_t listed = items.to - items.from;
        if (1 + listed > steps) {
            return 0;
        }
        steps -= 1 + listed;
        for (uint32_t i = items.from; i < items.to; i++) {
            lrcsi_event_box *event = &c->event[grid->item[i]];
            if (lrcsi_view_box_behind(&event->box, &box) ||
                lrcsi_view_box_beside(&event->box, &box) || event->last_search == search) {
                continue;
            }
            if (corners.count == 0) {
                run_gather(c, run, &corners);
            }
            if (!event_beside_run(c->view, &corners, event->edge)) {
                (void)lrcsi_meter_take(meter, 1 + i - items.from);
                return 0;
            }
            event->last_search = search;
        }
        if (!lrcsi_meter_take(meter, listed)) {
            return 0;
        }
    }
    return 1;
}

/* Do these cells list any event? */
static int cells_list_events(const lrcsi_grid *grid, lrcsi_cells cells)
{
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, cells.x0, cells.x1);
        if (items.from != items.to) {
            return 1;
        }
    }
    return 0;
}

/* Decides whether a facet is undecided; and if not, whether it is the only one of its region. */
static void facet_decide(lrcsi_classification *c, uint32_t f, lrcsi_meter *meter)
{
    uint32_t steps = MAX_LISTED;
    c->event_along_side = 0;
    c->undecided[f] =
        intersection_divides(c->view, f) ||
        (cells_list_events(&c->grid, lrcsi_grid_cells(&c->grid, lrcsi_boxes_facet(&c->boxes, f))) &&
         crossings_find(c, f, LRCS_NONE, 1, &steps, meter) > 0) ||
        steps == 0 || lrcsi_meter_spent(meter);
    c->undecided_count += c->undecided[f];
    if (c->undecided[f] || c->event_along_side || c->view->prepared->intersections.met[f]) {
        c->joinable[f] = 0;
    }
}

/* Decides which facets are undecided: none of a run without contacts that no event can cross; in
   other runs each facet is tested. If the facets to be tested are large, the grid of events is made
   again with larger cells. */
static int facets_decide(lrcsi_classification *c, lrcsi_meter *meter, lrcs_work *work)
{
    const lrcs_prepared *p = c->view->prepared;
    size_t mark = work->used;
    int status =
        lrcsi_grid_edges(c->events.edge, c->events.count, max_event_entries(p), work, &c->grid);
    for (uint32_t r = 0; r < p->runs.count && status == LRCS_OK; r++) {
        if (c->boxes.state[r] == LRCSI_BOXES_RUN &&
            (p->runs.run[r].has_contacts || !run_clear(c, r, meter))) {
            lrcsi_boxes_open(&c->boxes, r);
        }
    }
    if (status == LRCS_OK && lrcsi_grid_fit(&c->grid, &c->boxes)) {
        work->used = mark;
        status =
            lrcsi_grid_edges(c->events.edge, c->events.count, max_event_entries(p), work, &c->grid);
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

/* The direction in which each facet faces if it can hide others (lrcsi_view_casts), otherwise 0;
   zeros after the last one. Run by run, without branches: compilers vectorise the inner loop. */
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
            signed char limit = facing[i] > 0 ? LRCSI_REDUNDANT : back;
            cast[start + i] = redundant[i] < limit ? facing[i] : 0;
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
    return lrcsi_work_add(need, lrcsi_grid_need(facets, max_event_entries(prepared)));
}

/* The grid of events has about one cell for every facet that can hide others: then most facets meet
   no cell that lists an event, and need no further test. Called: lrcsi_boxes_make,
   lrcsi_events_make, events_make_boxes, lrcsi_events_join (components), facets_decide. */
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
    status = status == LRCS_OK ? events_make_boxes(&c, work) : status;
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
