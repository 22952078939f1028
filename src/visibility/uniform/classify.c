/* SPDX-License-Identifier: MIT */
/* Classifies all facets: which are undecided, and which of the others form regions. Which event
   edges cross a facet is decided in visibility/uniform/crossing.c; how much of an undecided facet
   is visible, elsewhere.

   Consider a path over the interior of a facet i. The number of surfaces in front of i can change
   along it only where the path, in projection, crosses
     (1) an event edge (visibility/index/event.h) that is nearer than i; or
     (2) a point where another facet meets the interior of i in space (mesh/contact/intersection.h).
   A coplanar facet over which i has precedence hides nothing. A facet that nothing of this kind
   crosses is uniform: one exact sample decides whether all of it is visible. The others are
   undecided, and so are facets near so many events that these are not all tested. All tests are
   exact, so what is stated of a uniform facet is certain.

   Two uniform facets are both visible or both hidden if they share an edge that is not an event
   edge, if no nearer event edge runs along it in projection, and if nothing else meets it in space:
   a path from one into the other, through a point of the shared edge, crosses neither (1) nor (2).
   They form regions, and one sample decides for a whole region.

   Edges that are not event edges connect facets to components, which end at event edges only. If a
   component is in front of one point of facet i, none of its event edges crosses i in front of it,
   and none of its facets meets the interior of i, the component is in front of all of i. Then i is
   hidden, even if other event edges leave it undecided (visibility/uniform/query.h). */
#include "visibility/uniform/classify.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "base/work.h"
#include "view/side.h"
#include "visibility/base/sample.h"

/* The largest number of rows and listed events that are examined to decide whether any event may
   cross a meshlet. Heuristic: facets are tested one by one if more would have to be. */
#define MESHLET_STEPS 1024u

/* --- contacts --------------------------------------------------------------------------------- */

/* Can any contact of a facet hide a part of it? */
static int intersection_divides(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        if (lrcsi_sample_contact_hides(view, facet, &intersections->entry[i])) {
            return 1;
        }
    }
    return 0;
}

/* --- events ----------------------------------------------------------------------------------- */

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

/* 1. Sorts the events by their nearest points, as in their boxes. This uses 20 bytes per event
   temporarily; the grid made afterwards may take 32 (max_event_entries), so that the total need
   does not grow. 2. Makes their boxes. */
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
        const uint32_t ends[2] = {edge->low, edge->high};
        key[i] = depth_key(lrcsi_view_box_of(view, ends, 2).high[2]);
    }
    lrcsi_sort_pairs(key, c->events.edge, key_spare, spare, count);
    work->used = mark;
    c->search.events = count;
    c->search.event = lrcsi_work_take(work, count, sizeof *c->search.event);
    for (uint32_t i = 0; i < count && c->search.event; i++) {
        const lrcsi_edge *edge = &view->prepared->topology.edge[c->events.edge[i]];
        const uint32_t ends[2] = {edge->low, edge->high};
        c->search.event[i] =
            (lrcsi_event_box){lrcsi_view_box_of(view, ends, 2), c->events.edge[i], 0};
    }
    return c->search.event ? LRCS_OK : LRCS_E_MEMORY;
}

/* --- meshlets --------------------------------------------------------------------------------- */

/* The box of a meshlet in scene coordinates: where its middle is in the view, and half its
   sides. */
typedef struct meshlet_box {
    int known;
    double middle[3], err; /* err: of each coordinate */
    double half[3];
} meshlet_box;

static void meshlet_measure(const lrcsi_view *view, uint32_t meshlet, meshlet_box *box)
{
    double middle[3];
    lrcsi_meshlet_middle(&view->prepared->meshlets.meshlet[meshlet], middle, box->half);
    lrcsi_view_coordinates(view, middle, box->middle);
    box->err = lrcsi_view_point_err(box->middle);
    box->known = 1;
}

/* Does a meshlet lie strictly on one side of the line of an event edge, so that the edge neither
   crosses a facet of it nor runs along a side? Let t be the direction of the line, with an error of
   e >= 10 u |t| in each coordinate, m the middle of the box, and h half its sides. A point m + d
   lies to the left of the line by the cross product of t and m, plus w . d, where
   w = t_x R_1 - t_y R_0 and |w . d| <= sum |w_k| h_k. The error of w_k is 2 e due to t, since
   |R_1k| + |R_0k| is at most 2, and 0.8 e due to the rows, whose error is 4 u, and to three
   roundings. That of the sum is then 3.4 e sum h, rounding included. Twice the error of the cross
   product, computed for a distance that is 2 sum h larger, exceeds its own error by 6 e sum h. */
static int event_beside_meshlet(const lrcsi_view *view, const meshlet_box *box, uint32_t edge)
{
    const lrcsi_edge *e = &view->prepared->topology.edge[edge];
    const lrcsi_view_side line = lrcsi_view_side_of(view, e->low, e->high);
    const double *t = line.to;
    const double x = box->middle[0] - line.at[0];
    const double y = box->middle[1] - line.at[1];
    const double cross = t[0] * y - t[1] * x;
    double distance = fabs(x) + fabs(y);
    double extent = 0;
    for (int k = 0; k < 3; k++) {
        extent += fabs(t[0] * view->R[1][k] - t[1] * view->R[0][k]) * box->half[k];
        distance += 2 * box->half[k];
    }
    return fabs(cross) > extent + 2 * lrcsi_view_cross_err(line.length, line.to_err, distance,
                                                           line.at_err + box->err);
}

/* Is it proved that no event edge crosses any facet of a meshlet, nor runs along a side of one in
   front of it? The buckets of most meshlets far from events list nothing, which takes one step per
   row to see. An event that is not behind the meshlet is beside it if their boxes are disjoint, or
   else if all of the meshlet lies on one side of the event's line: most of those near a long
   straight contour do. Returns 0 if this takes more steps than testing the facets of the meshlet.
 */
static int meshlet_has_no_events(lrcsi_classification *c, uint32_t meshlet, lrcsi_meter *meter)
{
    const lrcsi_grid *grid = &c->search.grid;
    const lrcsi_view_box box = c->search.boxes.meshlet[meshlet];
    const uint32_t search = lrcsi_event_search_begin(&c->search);
    lrcsi_grid_rect buckets = lrcsi_grid_buckets(grid, &box);
    uint32_t steps = MESHLET_STEPS;
    meshlet_box around = {.known = 0};
    lrcsi_grid_items items;
    while (lrcsi_grid_next_row(grid, &buckets, &items)) {
        const uint32_t listed = items.to - items.from;
        if (1 + listed > steps) {
            return 0;
        }
        steps -= 1 + listed;
        for (uint32_t i = items.from; i < items.to; i++) {
            lrcsi_event_box *event = &c->search.event[grid->item[i]];
            if (lrcsi_view_box_behind(&event->box, &box) ||
                lrcsi_view_box_beside(&event->box, &box) || event->last_search == search) {
                continue;
            }
            if (!around.known) {
                meshlet_measure(c->view, meshlet, &around);
            }
            if (!event_beside_meshlet(c->view, &around, event->edge)) {
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

/* --- facets ----------------------------------------------------------------------------------- */

/* Decides which facets of an opened meshlet are undecided. */
static void meshlet_decide(lrcsi_classification *c, uint32_t meshlet, lrcsi_meter *meter)
{
    const lrcs_prepared *p = c->view->prepared;
    const uint32_t start = meshlet * LRCSI_MESHLET_FACETS;
    const uint32_t end = lrcsi_meshlet_end(start, p->scene->facet_count);
    lrcsi_crossing_candidates candidates;
    candidates.state = LRCSI_CANDIDATES_NOT_SOUGHT;
    candidates.examined = 0;
    for (uint32_t f = start; f < end; f++) {
        if (!lrcsi_view_casts(c->view, f)) {
            continue;
        }
        int along_side = 0;
        c->undecided[f] = intersection_divides(c->view, f) ||
                          lrcsi_crossings_possible(&c->search, f, meter, &candidates, &along_side);
        c->undecided_count += c->undecided[f];
        if (c->undecided[f] || along_side || p->intersections.met[f]) {
            lrcsi_facet_signs_clear(&c->joinable, f);
        }
    }
}

/* Decides which facets are undecided: none of a meshlet without contacts that no event can cross;
   in other meshlets each facet is tested. If the facets to be tested are large, the grid of events
   is made again with larger buckets. */
static int facets_decide(lrcsi_classification *c, lrcsi_meter *meter, lrcs_work *work)
{
    const lrcs_prepared *p = c->view->prepared;
    size_t mark = work->used;
    int status = lrcsi_grid_edges(c->events.edge, c->events.count, max_event_entries(p), work,
                                  &c->search.grid);
    for (uint32_t m = 0; m < p->meshlets.count && status == LRCS_OK; m++) {
        if (c->search.boxes.state[m] == LRCSI_BOXES_MESHLET &&
            (p->meshlets.meshlet[m].has_contacts || !meshlet_has_no_events(c, m, meter))) {
            lrcsi_boxes_open(&c->search.boxes, m);
        }
    }
    if (status == LRCS_OK && lrcsi_grid_fit(&c->search.grid, &c->search.boxes)) {
        work->used = mark;
        status = lrcsi_grid_edges(c->events.edge, c->events.count, max_event_entries(p), work,
                                  &c->search.grid);
    }
    for (uint32_t m = 0; m < p->meshlets.count && status == LRCS_OK; m++) {
        if (c->search.boxes.state[m] == LRCSI_BOXES_FACETS) {
            meshlet_decide(c, m, meter);
        }
    }
    return status;
}

size_t lrcsi_classify_need(const lrcs_prepared *prepared)
{
    size_t edges = prepared->topology.edge_count;
    size_t facets = prepared->scene->facet_count;
    size_t room = lrcsi_meshlets_room(prepared->scene->facet_count);
    size_t need = lrcsi_work_add(lrcsi_work_bytes(facets, 1),
                                 lrcsi_facet_signs_need(prepared->scene->facet_count));
    need = lrcsi_work_add(need, lrcsi_work_bytes(room, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_boxes_need(prepared));
    need = lrcsi_work_add(need, lrcsi_events_need(prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(lrcsi_event_box)));
    return lrcsi_work_add(need, lrcsi_grid_need(facets, max_event_entries(prepared)));
}

static uint32_t count_casters(const lrcsi_view *view)
{
    uint32_t count = 0;
    for (uint32_t m = 0; m < view->prepared->meshlets.count; m++) {
        const signed char *cast = view->cast.facet + (size_t)m * LRCSI_MESHLET_FACETS;
        if (view->cast.meshlet[m] != LRCSI_MESHLET_MIXED) {
            count += cast[0] != 0 ? LRCSI_MESHLET_FACETS : 0;
            continue;
        }
        for (uint32_t i = 0; i < LRCSI_MESHLET_FACETS; i++) {
            count += cast[i] != 0;
        }
    }
    return count;
}

/* The grid of events has about one bucket for every facet that can hide others: then most facets
   meet no bucket that lists an event, and need no further test. Called: lrcsi_boxes_make,
   lrcsi_events_make, events_sort, lrcsi_events_join (components), facets_decide. */
int lrcsi_classify_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_classification *classification)
{
    size_t mark = work->used;
    uint32_t count = view->prepared->scene->facet_count;
    size_t room = lrcsi_meshlets_room(count);
    lrcsi_classification c = {
        .view = view, .casters = count_casters(view), .search = {.view = view}};
    c.search.grid = lrcsi_grid_empty(view, c.casters);
    c.undecided = lrcsi_work_take_zero(work, count, 1);
    c.search.component = c.component = lrcsi_work_take(work, room, sizeof *c.component);
    int status = c.undecided && c.component && lrcsi_facet_signs_take(count, work, &c.joinable)
                     ? LRCS_OK
                     : LRCS_E_MEMORY;
    status = status == LRCS_OK ? lrcsi_boxes_make(view, work, &c.search.boxes) : status;
    status = status == LRCS_OK ? lrcsi_events_make(view, work, &c.events) : status;
    status = status == LRCS_OK ? events_sort(&c, work) : status;
    if (status == LRCS_OK) {
        lrcsi_events_join(view, &view->cast, c.component);
        lrcsi_facet_signs_copy(count, &view->cast, &c.joinable); /* all, until tested */
        status = facets_decide(&c, meter, work);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *classification = c;
    return LRCS_OK;
}

size_t lrcsi_classify_facets_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_add(lrcsi_work_bytes(1, sizeof(lrcsi_grid)),
                          lrcsi_grid_facets_need(prepared));
}

void lrcsi_classify_facets(lrcsi_classification *classification, lrcs_work *work)
{
    lrcsi_event_search *search = &classification->search;
    size_t mark = work->used;
    lrcsi_grid *facets = lrcsi_work_take(work, 1, sizeof *facets);
    if (facets && lrcsi_grid_facets(&search->grid, &search->boxes, NULL, work, facets) == LRCS_OK) {
        classification->facets = facets;
    } else {
        work->used = mark;
    }
}
