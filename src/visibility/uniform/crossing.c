/* SPDX-License-Identifier: MIT */
/* Which event edges cross a facet in front of it: found in the grid of events, each tested exactly.
   What follows for the facet is decided elsewhere. */
#include "visibility/uniform/crossing.h"

#include <math.h>

#include "base/exact.h"
#include "base/vec3.h"
#include "base/work.h"
#include "view/side.h"
#include "visibility/base/sample.h"
#include "visibility/index/edge_search.h"

/* To find the candidates of a meshlet, or to decide whether any event crosses a facet of a meshlet
   with more candidates, at most MAX_LISTED listed events are examined; and at most MAX_TESTED of
   those whose boxes meet the facet's box. One facet in 100,000 of real models needs more. If facets
   are long and narrow or lie in a stack, a grid separates little: without a limit the search would
   take quadratic time. If the limit is reached, the facet counts as undecided, which is never
   wrong: both limits are heuristic. So is MANY_EXAMINED: if more events than that were examined for
   a facet, the candidates of its meshlet are sought, which replaces searching for each of the
   others. */
#define MAX_LISTED    4096u
#define MAX_TESTED    512u
#define MANY_EXAMINED 128u

/* --- one event edge --------------------------------------------------------------------------- */

/* The orientation of vertices a, b, c in the view: 1 counter-clockwise, -1 clockwise, 0 collinear.
   From view coordinates if their error allows it, otherwise exactly. The vertex with the largest
   error is never the origin of both differences, whose errors it would enlarge. */
static int vertex_orientation(const lrcsi_view *view, uint32_t a, uint32_t b, uint32_t c)
{
    if (c == a || c == b) {
        return 0;
    }
    if (view->point[a].err > view->point[b].err + view->point[c].err) {
        const uint32_t far = a;
        a = b;
        b = c;
        c = far;
    }
    const lrcsi_view_side line = lrcsi_view_side_of(view, a, b);
    const int side = lrcsi_view_side_orient(&line, view->point[c].x, view->point[c].err);
    if (side != LRCSI_VIEW_UNDECIDED) {
        return side;
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
static int segment_crosses_filtered(const lrcsi_view *view, uint32_t facet, uint32_t p, uint32_t q)
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
    const double err = from->err + lrcsi_max3(lrcsi_max(i->err, j->err), k->err, to->err);
    const double cross_err = 4 * err * (size + 2 * err);
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
    const double most = lrcsi_max3(sa, sb, sc);
    const double least = lrcsi_min3(sa, sb, sc);
    if (inside < -cross_err || most < -cross_err || least > cross_err) {
        return 0;
    }
    return inside > cross_err && most > cross_err && least < -cross_err ? 1 : LRCSI_VIEW_UNDECIDED;
}

/* The same, decided exactly. *along is set if the segment may run along a side: if it lies on the
   line of a side that separates them, and view coordinates do not show them apart. */
static int segment_crosses(const lrcsi_view *view, uint32_t facet, uint32_t p, uint32_t q,
                           int *along)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    int crosses = segment_crosses_filtered(view, facet, p, q);
    if (crosses != LRCSI_VIEW_UNDECIDED) {
        return crosses;
    }
    for (int k = 0; k < 3; k++) {
        uint32_t a = corner[k];
        uint32_t b = corner[k == 2 ? 0 : k + 1];
        int of_p = view->facing[facet] * vertex_orientation(view, a, b, p);
        int of_q = of_p == 1 ? 1 : view->facing[facet] * vertex_orientation(view, a, b, q);
        if (of_p <= 0 && of_q <= 0) {
            *along |= of_p == 0 && of_q == 0;
            return 0;
        }
    }
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        int side = vertex_orientation(view, p, q, corner[k]);
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

/* --- all event edges -------------------------------------------------------------------------- */

/* What a search looks for, and what it finds. */
typedef struct crossing_query {
    uint32_t facet;
    uint32_t component; /* only edges of this component count; LRCS_NONE: all */
    uint32_t most;      /* the search ends after so many crossings */
    int is_limited;     /* at most MAX_LISTED listed events are examined, and MAX_TESTED tested */
    uint32_t *edge;     /* room for the crossings; NULL: they are only counted */
    uint32_t count;     /* found: how many they are */
    uint32_t examined;  /* found: how many listed events were examined */
    int along_side;     /* found: an event edge in front of the facet runs along one of its sides */
    int limit_reached;  /* found: nothing more could have been examined */
} crossing_query;

/* Searches the buckets of the grid that the facet may meet. Finds fewer crossings if a limit is
   reached or the meter is spent. An event whose box is beside the facet's box does not cross the
   facet. A bucket lists events in the order of their nearest points: after the first one that lies
   behind all of the facet, no other is nearer than the facet. Steps are counted in a register and
   charged at the end. */
static void crossings_search(lrcsi_event_search *search, crossing_query *query, lrcsi_meter *meter)
{
    const lrcsi_view *view = search->view;
    const lrcsi_topology *topology = &view->prepared->topology;
    const lrcsi_grid *grid = &search->grid;
    const uint32_t facet = query->facet;
    const uint32_t component = query->component;
    const lrcsi_view_box box = *lrcsi_boxes_facet(&search->boxes, facet);
    const uint32_t limit = query->is_limited ? MAX_LISTED : LRCS_NONE;
    const uint64_t metered = lrcsi_meter_left(meter);
    const uint32_t allowed = metered < limit ? (uint32_t)metered : limit;
    const uint32_t mark = lrcsi_event_search_begin(search);
    uint32_t left = allowed;
    uint32_t tests_left = query->is_limited ? MAX_TESTED : LRCS_NONE;
    uint32_t count = 0;
    int more = 0; /* an event was not examined because a limit was reached */
    lrcsi_grid_walk walk;
    lrcsi_grid_row row;
    lrcsi_grid_walk_facet(grid, &box, facet, &walk);
    while (!more && count < query->most && lrcsi_grid_walk_next(&walk, &row)) {
        for (uint32_t x = row.x0; x < row.x1 && !more && count < query->most; x++) {
            const lrcsi_grid_items bucket = lrcsi_grid_row_items(grid, row.y, x, x + 1);
            for (uint32_t i = bucket.from; i < bucket.to && count < query->most; i++) {
                lrcsi_event_box *event = &search->event[grid->item[i]];
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
                const int again = event->last_search == mark;
                event->last_search = mark;
                if (again || (component != LRCS_NONE &&
                              !lrcsi_topology_edge_has(topology, event->edge, search->component,
                                                       component))) {
                    continue;
                }
                if (edge_crosses(view, facet, event->edge, &query->along_side)) {
                    if (query->edge) {
                        query->edge[count] = event->edge;
                    }
                    count++;
                }
            }
        }
    }
    const uint32_t examined = allowed - left;
    lrcsi_meter_take(meter, examined);
    query->count = count;
    query->examined = examined;
    query->limit_reached = query->is_limited && (tests_left == 0 || examined == limit);
    if (more && !query->limit_reached) {
        lrcsi_meter_take(meter, 1); /* none is left: this marks the meter as spent */
    }
}

/* Adds the events in a bucket that may cross the facets in a rectangle; their meshlet has this box.
   Returns how many it examined. */
static uint32_t bucket_candidates(lrcsi_event_search *search, lrcsi_grid_items bucket,
                                  const lrcsi_view_box *box, const lrcsi_edge_search *around,
                                  int *line, lrcsi_crossing_candidates *candidates)
{
    const lrcsi_view *view = search->view;
    uint32_t i = bucket.from;
    for (; i < bucket.to && candidates->state == LRCSI_CANDIDATES_KNOWN; i++) {
        const uint32_t index = search->grid.item[i];
        lrcsi_event_box *event = &search->event[index];
        if (lrcsi_view_box_behind(&event->box, box)) {
            break; /* so are all after it */
        }
        if (lrcsi_view_box_beside(&event->box, box) || event->last_search == search->searches) {
            continue;
        }
        event->last_search = search->searches;
        const lrcsi_edge *edge = &view->prepared->topology.edge[event->edge];
        if (lrcsi_edge_search_excludes(around, view->point[edge->low].x, view->point[edge->high].x,
                                       0, line)) {
            continue;
        }
        if (candidates->count == LRCSI_CROSSING_CANDIDATES) {
            candidates->state = LRCSI_CANDIDATES_UNKNOWN;
        } else {
            candidates->event[candidates->count++] = index;
        }
    }
    return i - bucket.from;
}

/* Finds the candidates of a meshlet. */
static void candidates_find(lrcsi_event_search *search, uint32_t meshlet, lrcsi_meter *meter,
                            lrcsi_crossing_candidates *candidates)
{
    const lrcsi_view *view = search->view;
    const uint32_t start = meshlet * LRCSI_MESHLET_FACETS;
    const uint32_t end = lrcsi_meshlet_end(start, view->prepared->scene->facet_count);
    uint32_t facet[LRCSI_MESHLET_FACETS];
    uint32_t facets = 0;
    for (uint32_t f = start; f < end; f++) {
        facet[facets] = f;
        facets += lrcsi_view_casts(view, f) != 0;
    }
    lrcsi_grid_walk walk;
    lrcsi_grid_row row;
    const lrcsi_edge_search around =
        lrcsi_edge_search_around(view, &search->grid, facet, facets, 0, &walk);
    const lrcsi_view_box *box = &search->boxes.meshlet[meshlet];
    uint32_t examined = 0;
    int line = 0;
    candidates->count = 0;
    candidates->state = LRCSI_CANDIDATES_KNOWN;
    (void)lrcsi_event_search_begin(search);
    while (candidates->state == LRCSI_CANDIDATES_KNOWN && lrcsi_grid_walk_next(&walk, &row)) {
        for (uint32_t x = row.x0; x < row.x1 && examined <= MAX_LISTED; x++) {
            const lrcsi_grid_items bucket = lrcsi_grid_row_items(&search->grid, row.y, x, x + 1);
            examined += bucket_candidates(search, bucket, box, &around, &line, candidates);
        }
        candidates->state = examined <= MAX_LISTED ? candidates->state : LRCSI_CANDIDATES_UNKNOWN;
    }
    if (!lrcsi_meter_take(meter, examined)) {
        candidates->state = LRCSI_CANDIDATES_UNKNOWN;
    }
}

/* Tests the candidates in place of the events in the grid. */
static void candidates_search(lrcsi_event_search *search,
                              const lrcsi_crossing_candidates *candidates, crossing_query *query,
                              lrcsi_meter *meter)
{
    const lrcsi_view_box box = *lrcsi_boxes_facet(&search->boxes, query->facet);
    if (!lrcsi_meter_take(meter, candidates->count)) {
        return;
    }
    for (uint32_t i = 0; i < candidates->count && query->count < query->most; i++) {
        const lrcsi_event_box *event = &search->event[candidates->event[i]];
        query->count += !lrcsi_view_box_behind(&event->box, &box) &&
                        !lrcsi_view_box_beside(&event->box, &box) &&
                        edge_crosses(search->view, query->facet, event->edge, &query->along_side);
    }
}

int lrcsi_crossings_possible(lrcsi_event_search *search, uint32_t facet, lrcsi_meter *meter,
                             lrcsi_crossing_candidates *candidates, int *along_side)
{
    crossing_query query = {.facet = facet, .component = LRCS_NONE, .most = 1, .is_limited = 1};
    if (candidates->state == LRCSI_CANDIDATES_NOT_SOUGHT && candidates->examined > MANY_EXAMINED) {
        candidates_find(search, facet / LRCSI_MESHLET_FACETS, meter, candidates);
    }
    if (candidates->state == LRCSI_CANDIDATES_KNOWN) {
        candidates_search(search, candidates, &query, meter);
    } else if (lrcsi_grid_has_items(
                   &search->grid,
                   lrcsi_grid_buckets(&search->grid, lrcsi_boxes_facet(&search->boxes, facet)))) {
        crossings_search(search, &query, meter);
        candidates->examined = query.examined;
    }
    *along_side = query.along_side;
    return query.count > 0 || query.limit_reached || lrcsi_meter_spent(meter);
}

size_t lrcsi_crossings_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_bytes(prepared->topology.edge_count, sizeof(uint32_t));
}

int lrcsi_crossings_make(const lrcsi_event_search *search, lrcs_work *work,
                         lrcsi_crossings *crossings)
{
    *crossings = (lrcsi_crossings){.facet = LRCS_NONE};
    crossings->edge = lrcsi_work_take(work, search->events, sizeof *crossings->edge);
    return crossings->edge ? LRCS_OK : LRCS_E_MEMORY;
}

void lrcsi_crossings_find(lrcsi_event_search *search, uint32_t facet, lrcsi_meter *meter,
                          lrcsi_crossings *crossings)
{
    if (crossings->facet != facet) {
        crossing_query query = {
            .facet = facet, .component = LRCS_NONE, .most = LRCS_NONE, .edge = crossings->edge};
        crossings_search(search, &query, meter);
        crossings->count = query.count;
        crossings->facet = lrcsi_meter_spent(meter) ? LRCS_NONE : facet;
    }
}

int lrcsi_crossings_of_component(lrcsi_event_search *search, uint32_t facet, uint32_t component,
                                 lrcsi_meter *meter, const lrcsi_crossings *known)
{
    const lrcsi_topology *topology = &search->view->prepared->topology;
    if (known->facet != facet) {
        crossing_query query = {.facet = facet, .component = component, .most = 1};
        crossings_search(search, &query, meter);
        return query.count > 0 || lrcsi_meter_spent(meter);
    }
    for (uint32_t i = 0; i < known->count; i++) {
        if (lrcsi_topology_edge_has(topology, known->edge[i], search->component, component)) {
            return 1;
        }
    }
    return 0;
}
