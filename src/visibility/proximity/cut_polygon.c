/* SPDX-License-Identifier: MIT */
/* Decides which points are corners of the polygon: the part's contour in front of the plane ends
   there, or meets the plane, or one of the edges of its facets does. All corners are among these
   points, and all of them are in the polygon: it is their convex hull. */
#include "visibility/proximity/cut_polygon.h"

#include <math.h>
#include <string.h>

#include "base/bits.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/sort.h"
#include "base/vec3.h"
#include "base/work.h"

/* The points among which the corners are, with what sorting needs. */
typedef struct candidate_list {
    const lrcsi_event_bands *bands;
    const lrcsi_face_frame *face;
    double distance;
    double (*x)[3];
    uint32_t count, most;
    int inside; /* all points on the plane are inside the face */
} candidate_list;

/* The number of points for a part of so many facets. A cylinder has four facets in a sector, two of
   them on its wall, and each sector has at most one event edge, with two ends, and at most one
   crossing of the plane that faces the laser. Other shapes have fewer points. Larger parts have no
   polygon. */
static uint32_t candidates_most(uint32_t facets)
{
    return facets < (1u << 16) ? facets + 64 : 1u << 16;
}

static void candidate_add(candidate_list *list, const double x[3])
{
    if (list->count < list->most) {
        memcpy(list->x[list->count], x, sizeof *list->x);
    }
    list->count += list->count < UINT32_MAX;
}

/* The height of a vertex above the plane of the face. */
static double vertex_height(const candidate_list *list, uint32_t vertex)
{
    const lrcs_prepared *p = list->bands->view->prepared;
    double from[3];
    lrcsi_vec3_between(list->face->centre, p->vertex[vertex].x, from);
    return lrcsi_vec3_dot(from, list->face->up);
}

/* Adds the point where an edge between two vertices meets the plane, if it does. */
static void crossing_add(candidate_list *list, uint32_t low, uint32_t high)
{
    const double h[2] = {vertex_height(list, low), vertex_height(list, high)};
    if ((h[0] < 0) == (h[1] < 0)) {
        return;
    }
    const lrcsi_view *view = list->bands->view;
    const double part = h[0] / (h[0] - h[1]);
    double x[3];
    for (int k = 0; k < 3; k++) {
        x[k] = view->point[low].x[k] + part * (view->point[high].x[k] - view->point[low].x[k]);
    }
    list->inside &= list->face->is_rectangle || lrcsi_face_contains(list->face, x, list->distance);
    candidate_add(list, x);
}

/* Adds all points of a part. Event edges are listed; any other edge between facets that face the
   laser is the side of two of them, in both directions. Returns 0 if a facet is not live. */
static int candidates_add(candidate_list *list, uint32_t index)
{
    const lrcsi_view *view = list->bands->view;
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    const lrcsi_proximity_events *events = &list->bands->events;
    for (uint32_t i = 0; i < events->count; i++) {
        const lrcsi_edge *edge = &p->topology.edge[events->edge[i]];
        if (events->part[i] != index) {
            continue;
        }
        crossing_add(list, edge->low, edge->high);
        if (vertex_height(list, edge->low) >= 0) {
            candidate_add(list, view->point[edge->low].x);
        }
        if (vertex_height(list, edge->high) >= 0) {
            candidate_add(list, view->point[edge->high].x);
        }
    }
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        const uint32_t *corner = p->scene->facet[f].corner;
        if (p->skip[f]) {
            return 0;
        }
        for (int k = 0; k < 3 && view->facing[f] > 0; k++) {
            if (corner[k] < corner[(k + 1) % 3]) {
                crossing_add(list, corner[k], corner[(k + 1) % 3]);
            }
        }
    }
    return list->count >= 3 && list->count <= list->most;
}

/* A key by which numbers are in order, as unsigned integers. */
static uint64_t order_key(double x)
{
    const uint64_t bits = lrcsi_bits_of(x);
    return (bits >> 63) != 0 ? ~bits : bits | (UINT64_C(1) << 63);
}

/* Is b to the right of the way from a to c, or on it? */
static int is_right(const double a[3], const double b[3], const double c[3])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0;
}

/* The convex hull, counter-clockwise: its lower side from left to right, its upper side back
   (Andrew 1979). hull has room for all points and two more. */
static uint32_t convex_hull(double (*x)[3], const uint32_t *order, uint32_t count,
                            double (*hull)[3])
{
    uint32_t n = 0;
    uint32_t least = 1; /* corners that stay */
    for (uint32_t i = 0; i < 2 * count - 1; i++) {
        const double *next = x[order[i < count ? i : 2 * count - 2 - i]];
        while (n > least && is_right(hull[n - 2], hull[n - 1], next)) {
            n--;
        }
        memcpy(hull[n++], next, sizeof *hull);
        least = i + 1 == count ? n : least;
    }
    return n - 1; /* the last one is the first */
}

size_t lrcsi_cut_polygon_need(const lrcs_prepared *p)
{
    uint32_t facets = 0;
    for (uint32_t i = 0; i < p->scene->part_count; i++) {
        const lrcs_part *part = &p->scene->part[i];
        if (part->bounds.reach > 0 && part->facet_count > facets) {
            facets = part->facet_count;
        }
    }
    const size_t most = candidates_most(facets);
    size_t need = lrcsi_work_blocks(2, most + 2, 3 * sizeof(double));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, most, sizeof(uint64_t)));
    return lrcsi_work_add(need, lrcsi_work_blocks(2, most, sizeof(uint32_t)));
}

int lrcsi_cut_polygon_make(const lrcsi_event_bands *bands, uint32_t part,
                           const lrcsi_face_frame *face, double distance, lrcs_work *work,
                           lrcsi_cut_polygon *polygon)
{
    const lrcs_scene *scene = bands->view->prepared->scene;
    const uint32_t most = candidates_most(scene->part[part].facet_count);
    candidate_list list = {.bands = bands, .face = face, .distance = distance, .most = most};
    uint64_t *key = lrcsi_work_take(work, most, sizeof *key);
    uint64_t *key_spare = lrcsi_work_take(work, most, sizeof *key_spare);
    uint32_t *order = lrcsi_work_take(work, most, sizeof *order);
    uint32_t *order_spare = lrcsi_work_take(work, most, sizeof *order_spare);
    polygon->corner = lrcsi_work_take(work, most + (size_t)2, sizeof *polygon->corner);
    list.x = lrcsi_work_take(work, most, sizeof *list.x);
    list.inside = 1;
    if (!key || !key_spare || !order || !order_spare || !polygon->corner || !list.x ||
        !lrcsi_meter_take(bands->meter,
                          (uint64_t)bands->events.count + scene->part[part].facet_count) ||
        !candidates_add(&list, part) || !list.inside) {
        return 0;
    }
    for (uint32_t i = 0; i < list.count; i++) {
        key[i] = order_key(list.x[i][0]);
        order[i] = i;
    }
    lrcsi_sort_pairs(key, order, key_spare, order_spare, list.count);
    polygon->count = convex_hull(list.x, order, list.count, polygon->corner);
    return polygon->count >= 3;
}

/* --- which sides are near another ------------------------------------------------------------- */

/* Follows the sides that lead away from the end b (1) or a (0) of one of them: first those that
   follow it in the sense of (d), up to one that ends farther than w from there, or to a corner
   where the polygon turns by more than 0.5 rad; then on to a corner deeper than w. The depth of the
   corners of a convex polygon rises up to the deepest one, and falls from there: so the sides that
   remain are deeper than w. If all that were followed lead away from the edge, only the first of
   them are in N. Returned: the turn, negative if there was such a corner. Returns 0 if some lead
   back, or none is so deep. */
static int follow(const lrcsi_cut_polygon *polygon, uint32_t i, const lrcsi_edge_margin *m, int end,
                  double *turn)
{
    const uint32_t count = polygon->count;
    const double sign = end == 0 ? -1 : 1;
    const double *start = end == 0 ? m->a : m->b;
    uint32_t at = end == 0 ? i : (i + 1) % count;
    int follows = 1;
    *turn = 0;
    for (uint32_t steps = 2; steps < count; steps++) {
        const uint32_t next = end == 0 ? (at + count - 1) % count : (at + 1) % count;
        const double away[2] = {polygon->corner[next][0] - polygon->corner[at][0],
                                polygon->corner[next][1] - polygon->corner[at][1]};
        const double along = sign * (away[0] * m->along[0] + away[1] * m->along[1]);
        const double angle = follows ? lrcsi_edge_margin_turn(m, away) : 0;
        if (!(along > 0)) {
            return 0;
        }
        if (follows) {
            *turn = angle < 0 ? -1 : lrcsi_max(*turn, angle);
        }
        at = next;
        const double from[2] = {polygon->corner[at][0] - start[0],
                                polygon->corner[at][1] - start[1]};
        follows = follows && angle >= 0 &&
                  !(sign * (from[0] * m->along[0] + from[1] * m->along[1]) > m->width + m->err);
        if (-(from[0] * m->outward[0] + from[1] * m->outward[1]) > m->width + m->err) {
            return 1;
        }
    }
    return 0;
}

void lrcsi_cut_polygon_find_gaps(const lrcsi_cut_polygon *polygon, uint32_t i,
                                 const lrcsi_edge_margin *side, lrcsi_edge_gaps *gaps,
                                 double turn[2])
{
    for (int end = 0; end < 2; end++) {
        if (!follow(polygon, i, side, end, &turn[end])) {
            lrcsi_edge_gaps_add(gaps, (lrcsi_segment_part){0, 1});
        } else if (turn[end] < 0) {
            lrcsi_edge_margin_add_end_gap(side, end, gaps);
        }
    }
}
