/* SPDX-License-Identifier: MIT */
/* The visibility of a facet along one line of sight, against the facets listed in the grid buckets
   of the line. Which of two facets is nearer is decided by visibility/base/sample.h, unless their
   boxes already show it. */
#include "visibility/uniform/query.h"

#include <math.h>
#include <string.h>

#include "base/vec3.h"
#include "base/work.h"
#include "visibility/base/sample.h"

/* A point whose line of sight passes through the interior of the facet; the point lies on the facet
   up to rounding. If the facet is so thin that rounding moves such points outside, a corner is
   used: the line through one of the corners enters the facet when moved by an infinitesimal in one
   sense or the other, whatever the facet's shape (of three parallel lines through the corners of a
   triangle, the middle one passes through the interior). Returns the sense, 1 or -1; 0 if no point
   was found. */
static int inside_point(const lrcsi_view *view, uint32_t facet, double point[3])
{
    static const double weight[4][3] = {
        {1 / 3.0, 1 / 3.0, 1 / 3.0}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            point[k] = 0;
            for (int corner = 0; corner < 3; corner++) {
                point[k] +=
                    weight[i][corner] * lrcsi_prepared_corner(view->prepared, facet, corner)[k];
            }
        }
        if (lrcsi_sample_covers(view, facet, point)) {
            return 1;
        }
    }
    for (int i = 0; i < 6; i++) {
        const double *corner = lrcsi_prepared_corner(view->prepared, facet, i % 3);
        int sense = i < 3 ? 1 : -1;
        for (int k = 0; k < 3; k++) {
            point[k] = corner[k];
        }
        if (lrcsi_sample_covers_towards(view, facet, point, sense)) {
            return sense;
        }
    }
    return 0;
}

/* A line of sight through the interior of a facet, and the state of the search along it. */
typedef struct query_line {
    const lrcsi_grid *grid;
    lrcsi_meter *meter;
    uint32_t facet;
    double point[3];
    double x[3], x_err;      /* the point in view coordinates, and the error of each */
    lrcsi_view_box at;       /* the line in the view; in depth, the whole facet */
    int sense;               /* the sense of the infinitesimal by which it is moved */
    lrcsi_grid_rect buckets; /* in rows that are still to be searched */
    lrcsi_grid_items items;  /* of the current row, those that remain */
} query_line;

/* Finds the grid buckets of the line through line->point. */
static void line_find_buckets(query_line *line)
{
    const lrcsi_view *view = line->grid->view;
    const lrcsi_view_box *own = lrcsi_boxes_facet(&line->grid->boxes, line->facet);
    lrcsi_view_coordinates(view, line->point, line->x);
    line->x_err = lrcsi_view_point_err(line->x);
    line->at = lrcsi_view_box_about(view, line->x, line->x_err);
    line->at.low[2] = own->low[2];
    line->at.high[2] = own->high[2];
    line->buckets = lrcsi_grid_buckets(line->grid, &line->at);
}

/* Returns 0 if no point inside the facet was found. */
static int line_start(query_line *line, const lrcsi_grid *facets, uint32_t facet,
                      lrcsi_meter *meter)
{
    *line = (query_line){.grid = facets, .meter = meter, .facet = facet};
    line->sense = inside_point(facets->view, facet, line->point);
    if (line->sense == 0) {
        return 0;
    }
    line_find_buckets(line);
    return 1;
}

/* Does the line meet a facet? Nearly always plain doubles decide. Let a, b and c be the vectors
   from the line to the corners, `size` the sum of their 1-norms, and e the error of their
   coordinates. The line lies to the left of side a b by a x b, with an error of e (|a| + |b|) + 2
   e^2, and by rounding of 2 u |a| |b|, which is below e |a| / 5, because e is at least 10 u |b|. */
static int line_meets(const query_line *line, uint32_t facet)
{
    const lrcsi_view *view = line->grid->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const lrcsi_view_vertex *i = &view->point[corner[0]];
    const lrcsi_view_vertex *j = &view->point[corner[1]];
    const lrcsi_view_vertex *k = &view->point[corner[2]];
    const double a[2] = {i->x[0] - line->x[0], i->x[1] - line->x[1]};
    const double b[2] = {j->x[0] - line->x[0], j->x[1] - line->x[1]};
    const double c[2] = {k->x[0] - line->x[0], k->x[1] - line->x[1]};
    const double size = fabs(a[0]) + fabs(a[1]) + fabs(b[0]) + fabs(b[1]) + fabs(c[0]) + fabs(c[1]);
    const double err = line->x_err + lrcsi_max3(i->err, j->err, k->err);
    const double cross_err = 1.5 * err * (size + 2 * err);
    const double facing = view->facing[facet];
    const double inside =
        lrcsi_min3(facing * lrcsi_vec2_cross(a, b), facing * lrcsi_vec2_cross(b, c),
                   facing * lrcsi_vec2_cross(c, a));
    return inside > cross_err ||
           (!(inside < -cross_err) &&
            lrcsi_sample_covers_towards(view, facet, line->point, line->sense));
}

/* The next other facet that the line meets and that is not entirely behind the line's own, or
   LRCS_NONE; a facet may be returned more than once. LRCS_NONE too when the meter is spent. */
static uint32_t line_next(query_line *line)
{
    const lrcsi_grid *grid = line->grid;
    const lrcsi_boxes boxes = grid->boxes;
    const lrcsi_view_box at = line->at;
    for (;;) {
        const uint32_t *end = grid->item + line->items.to;
        for (const uint32_t *item = grid->item + line->items.from; item < end; item++) {
            const lrcsi_view_box *other_box = lrcsi_boxes_facet(&boxes, *item);
            if (!lrcsi_view_box_behind(other_box, &at) && !lrcsi_view_box_beside(other_box, &at) &&
                *item != line->facet && line_meets(line, *item)) {
                line->items.from = (uint32_t)(item + 1 - grid->item);
                return *item;
            }
        }
        line->items.from = line->items.to;
        if (!lrcsi_grid_next_row(grid, &line->buckets, &line->items) ||
            !lrcsi_meter_take(line->meter, line->items.to - line->items.from)) {
            return LRCS_NONE;
        }
    }
}

/* Is a facet that the line meets nearer than the line's own? 1 yes, -1 no, 0 undecided. */
static int line_nearer(const query_line *line, uint32_t other)
{
    const lrcsi_view *view = line->grid->view;
    return lrcsi_view_box_behind(&line->at, lrcsi_boxes_facet(&line->grid->boxes, other))
               ? 1
               : lrcsi_sample_nearer(view, other, line->facet, line->point, line->sense);
}

/* Is the facet hidden on its line? */
static int line_answer(query_line *line)
{
    int answer = LRCSI_QUERY_VISIBLE;
    uint32_t other;
    while ((other = line_next(line)) != LRCS_NONE) {
        int nearer = line_nearer(line, other);
        if (nearer > 0) {
            return LRCSI_QUERY_HIDDEN;
        }
        answer = nearer == 0 ? LRCSI_QUERY_NO_ANSWER : answer;
    }
    return lrcsi_meter_spent(line->meter) ? LRCSI_QUERY_NO_ANSWER : answer;
}

int lrcsi_query_facet(const lrcsi_grid *facets, uint32_t facet, lrcsi_meter *meter)
{
    query_line line;
    return line_start(&line, facets, facet, meter) ? line_answer(&line) : LRCSI_QUERY_NO_ANSWER;
}

int lrcsi_query_point(const lrcsi_grid *facets, uint32_t facet, const double point[3],
                      lrcsi_meter *meter)
{
    query_line line = {.grid = facets, .meter = meter, .facet = facet, .sense = 1};
    memcpy(line.point, point, sizeof line.point);
    if (!lrcsi_sample_covers(facets->view, facet, point)) {
        return LRCSI_QUERY_NO_ANSWER;
    }
    line_find_buckets(&line);
    return line_answer(&line);
}

int lrcsi_query_hidden_by_others(const lrcsi_grid *facets, uint32_t facet, lrcsi_part_set parts,
                                 lrcsi_meter *meter)
{
    const uint32_t *part = facets->view->prepared->scene->facet_part;
    query_line line;
    uint32_t other = line_start(&line, facets, facet, meter) ? line_next(&line) : LRCS_NONE;
    for (; other != LRCS_NONE; other = line_next(&line)) {
        if (!(parts & lrcsi_part_set_of(part[other])) && line_nearer(&line, other) > 0) {
            return 1;
        }
    }
    return 0;
}

size_t lrcsi_query_need(const lrcs_prepared *prepared)
{
    size_t room = lrcsi_meshlets_room(prepared->scene->facet_count);
    return lrcsi_work_add(lrcsi_work_bytes(room, sizeof(uint32_t)),
                          lrcsi_grid_facets_need(prepared));
}

/* 1. Finds the regions, and, unless the classification has a grid of all facets, makes one that
   lists only what the undecided facets and the first facet of each region need. 2. Makes one query
   for each region, at its first facet. 3. If a query gave no answer, which is rare, makes a
   complete grid if there was none, and a query for each facet of its region. */
int lrcsi_query_uniform(lrcsi_classification *classification, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_grid *facets, unsigned char *answer)
{
    const lrcs_prepared *p = classification->view->prepared;
    const unsigned char *undecided = classification->undecided;
    uint32_t count = p->scene->facet_count;
    uint32_t unanswered = 0;
    uint32_t *region = lrcsi_work_take(work, lrcsi_meshlets_room(count), sizeof *region);
    size_t mark = work->used;
    if (!region) {
        return LRCS_E_MEMORY;
    }
    lrcsi_events_join(classification->view, &classification->joinable, region);
    const lrcsi_grid_readers readers = {undecided, region, &classification->joinable};
    int status = LRCS_OK;
    if (classification->facets) {
        *facets = *classification->facets;
    } else {
        status = lrcsi_grid_facets(&classification->search.grid, &classification->search.boxes,
                                   &readers, work, facets);
    }
    if (status != LRCS_OK) {
        return status;
    }
    for (uint32_t m = 0; m < p->meshlets.count; m++) {
        uint32_t start = m * LRCSI_MESHLET_FACETS;
        uint32_t end = lrcsi_meshlet_end(start, count);
        int one_region = lrcsi_events_joined(p, &classification->joinable, m) == LRCSI_JOINED_ALL;
        memset(answer + start, LRCSI_QUERY_HIDDEN, end - start);
        if (classification->search.boxes.state[m] == LRCSI_BOXES_NONE) {
            continue; /* no facet of the meshlet can be visible */
        }
        for (uint32_t f = start; f < (one_region ? start + 1 : end); f++) {
            if (undecided[f]) {
                answer[f] = LRCSI_QUERY_NO_ANSWER;
            } else if (region[f] != f) {
                answer[f] = answer[region[f]];
            } else if (lrcsi_view_casts(classification->view, f)) {
                answer[f] = (unsigned char)lrcsi_query_facet(facets, f, meter);
                unanswered += answer[f] == LRCSI_QUERY_NO_ANSWER;
            }
        }
        if (one_region) {
            memset(answer + start, answer[start], end - start);
        }
    }
    if (unanswered > 0 && !classification->facets) {
        work->used = mark;
        status = lrcsi_grid_facets(&classification->search.grid, &classification->search.boxes,
                                   NULL, work, facets);
    }
    for (uint32_t f = 0; unanswered > 0 && f < count && status == LRCS_OK; f++) {
        if (!undecided[f] && answer[f] == LRCSI_QUERY_NO_ANSWER) {
            answer[f] = (unsigned char)lrcsi_query_facet(facets, f, meter);
        }
    }
    return status;
}

/* Does `other` meet the interior of the facet? Returns 1 too when the meter is spent. */
static int in_contact(const lrcs_prepared *p, uint32_t facet, uint32_t other, lrcsi_meter *meter)
{
    if (!lrcsi_meter_take(meter, lrcsi_intersection_of(&p->intersections, facet))) {
        return 1;
    }
    return lrcsi_intersection_find(&p->intersections, facet, other) != NULL;
}

/* Is it proved that a component that is in front of one point of the facet is in front of all of
   it: none of the component's event edges crosses the facet, and none of its facets meets it?
   Returns 0 too when the meter is spent. all: another component failed before; then all crossings
   of the facet are found at once. */
static int component_covers(lrcsi_classification *classification, uint32_t component,
                            uint32_t facet, int all, lrcsi_meter *meter, lrcsi_crossings *crossings)
{
    const lrcsi_intersections *contacts = &classification->view->prepared->intersections;
    if (all) {
        lrcsi_crossings_find(&classification->search, facet, meter, crossings);
        if (!lrcsi_meter_take(meter, crossings->count)) {
            return 0;
        }
    }
    if (!lrcsi_meter_take(meter, lrcsi_intersection_of(contacts, facet)) ||
        lrcsi_crossings_of_component(&classification->search, facet, component, meter, crossings)) {
        return 0;
    }
    for (uint32_t i = contacts->first[facet]; i < contacts->first[facet + 1]; i++) {
        if (classification->component[contacts->entry[i].other] == component) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_query_hidden_by_component(lrcsi_classification *classification, const lrcsi_grid *facets,
                                    uint32_t facet, lrcsi_meter *meter, lrcsi_crossings *crossings)
{
    query_line line;
    if (!line_start(&line, facets, facet, meter)) {
        return 0;
    }
    uint32_t failed = LRCS_NONE; /* the component that failed last */
    uint32_t other;
    while ((other = line_next(&line)) != LRCS_NONE) {
        if (classification->component[other] == failed ||
            in_contact(facets->view->prepared, other, facet,
                       meter) || /* their order may be uncertain */
            line_nearer(&line, other) <= 0) {
            continue;
        }
        if (component_covers(classification, classification->component[other], facet,
                             failed != LRCS_NONE, meter, crossings)) {
            return 1;
        }
        failed = classification->component[other];
    }
    return 0;
}

/* --- areas ------------------------------------------------------------------------------------ */

void lrcsi_query_areas(const lrcsi_view *view, const unsigned char *answer,
                       lrcsi_visible_area *visible)
{
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (answer[f] != LRCSI_QUERY_NO_ANSWER) {
            double area = answer[f] == LRCSI_QUERY_VISIBLE ? lrcsi_view_projected(view, f) : 0;
            visible[f] = lrcsi_visible_area_exact(area);
        }
    }
}
