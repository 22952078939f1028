/* SPDX-License-Identifier: MIT */
/* Which parts of a facet nothing divides. That no other edge or contact matters is exact
   (visibility/contest.h), and so is the sample; only places are computed in doubles.

   In the facet's frame, with d its diameter and r the largest distance in space from its first
   corner of all corners at hand, corners are off by 10 u r (visibility/occlude.c) and the side of a
   line is told wrong within 4 u (r + d) of it: together below 16 u (r + d), the width. A shape
   farther than that from every edge, and from the box of every contact, is divided by none: any two
   points in it are joined by a straight path that meets no event, so all are seen alike. The sample
   is taken at a point farther inside the shape than it may be off: 100 u of the reach
   (visibility/target.h), and 8 u for coordinates below 1. */
#include "visibility/calm.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/occluder.h"

#define U 0x1p-53

/* A facet crossed by more is left to clipping. */
#define CALM_EDGES 4096u
/* Lists of cells inside one another, in all: this many times the first. */
#define CALM_LISTS 8u

static uint32_t calm_room(const lrcs_prepared *prepared)
{
    uint32_t edges = prepared->topology.edge_count;
    return edges < CALM_EDGES ? edges : CALM_EDGES;
}

size_t lrcsi_calm_need(const lrcs_prepared *prepared)
{
    size_t room = calm_room(prepared);
    return lrcsi_work_add(lrcsi_work_bytes(room, sizeof(lrcsi_calm_edge)),
                          lrcsi_work_bytes(CALM_LISTS * room, sizeof(uint32_t)));
}

int lrcsi_calm_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_calm *calm)
{
    *calm = (lrcsi_calm){.room = calm_room(prepared)};
    calm->edge = lrcsi_work_take(work, calm->room, sizeof *calm->edge);
    calm->list = lrcsi_work_take(work, (size_t)CALM_LISTS * calm->room, sizeof *calm->list);
    return calm->edge && calm->list ? LRCS_OK : LRCS_E_MEMORY;
}

/* --- what may divide -------------------------------------------------------------------------- */

static lrcsi_calm_edge *edge_new(lrcsi_calm *calm)
{
    lrcsi_calm_edge *edge = &calm->edge[calm->edges++];
    *edge = (lrcsi_calm_edge){{{0, 0}, {0, 0}, 0}, {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    return edge;
}

static void edge_grow(lrcsi_calm_edge *edge, const double *p)
{
    for (int k = 0; k < 2; k++) {
        edge->low[k] = lrcsi_least(edge->low[k], p[k]);
        edge->high[k] = lrcsi_most(edge->high[k], p[k]);
    }
}

/* The event edges that cross the facet. */
static double calm_crossings(lrcsi_calm *calm, const uint32_t *crossing, uint32_t count)
{
    const lrcs_prepared *p = calm->target->view->prepared;
    double reach = calm->target->reach;
    for (uint32_t i = 0; i < count; i++) {
        const lrcsi_edge *e = &p->topology.edge[crossing[i]];
        lrcsi_calm_edge *edge = edge_new(calm);
        double to[2];
        double low = lrcsi_target_place(calm->target, p->vertex[e->low].x, edge->line.at);
        double high = lrcsi_target_place(calm->target, p->vertex[e->high].x, to);
        edge_grow(edge, edge->line.at);
        edge_grow(edge, to);
        for (int k = 0; k < 2; k++) {
            edge->line.to[k] = to[k] - edge->line.at[k];
        }
        reach = lrcsi_most(reach, lrcsi_most(low, high));
    }
    return reach;
}

/* The facets that touch its inside; LRCS_NONE where there is no room for all. */
static uint32_t calm_touches(lrcsi_calm *calm, double *reach)
{
    const lrcsi_target *t = calm->target;
    const lrcsi_touches *touches = &t->view->prepared->touches;
    for (uint32_t i = touches->first[t->facet]; i < touches->first[t->facet + 1]; i++) {
        if (!lrcsi_contest_touch_hides(t->view, t->facet, &touches->touch[i])) {
            continue;
        }
        if (calm->edges == calm->room) {
            return LRCS_NONE;
        }
        lrcsi_calm_edge *edge = edge_new(calm);
        double far = lrcsi_occluder_contact(t, touches->touch[i].other, edge->low, edge->high);
        *reach = lrcsi_most(*reach, far);
    }
    return calm->edges;
}

uint32_t lrcsi_calm_start(lrcsi_calm *calm, lrcsi_contest *contest, const lrcsi_target *target)
{
    uint32_t crossings = lrcsi_contest_crossings(contest, target->facet);
    calm->target = target;
    calm->edges = 0;
    if (crossings > calm->room) {
        return LRCS_NONE;
    }
    double reach = calm_crossings(calm, contest->crossing, crossings);
    uint32_t count = calm_touches(calm, &reach);
    for (uint32_t i = 0; i < calm->edges; i++) {
        calm->list[i] = i;
    }
    calm->width = 16 * U * (reach + target->diameter);
    return count;
}

/* --- cells ------------------------------------------------------------------------------------ */

uint32_t lrcsi_calm_keep(lrcsi_calm *calm, const lrcsi_clip_polygon *shape, uint32_t first,
                         uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index = calm->list[first + i];
        const lrcsi_calm_edge *edge = &calm->edge[index];
        if (!lrcsi_clip_meets(shape, &edge->line, edge->low, edge->high, calm->width)) {
            continue;
        }
        if (first + count + kept == CALM_LISTS * calm->room) {
            return LRCS_NONE;
        }
        calm->list[first + count + kept++] = index;
    }
    return kept;
}

int lrcsi_calm_answer(const lrcsi_calm *calm, const lrcsi_grid *facets,
                      const lrcsi_clip_polygon *shape)
{
    const lrcsi_target *t = calm->target;
    double middle[2];
    double weight[3];
    double point[3] = {0, 0, 0};
    if (!lrcsi_clip_middle(shape, 100 * U * t->reach + 8 * U, middle)) {
        return LRCSI_QUERY_UNDECIDED;
    }
    lrcsi_target_weights(t, middle, weight);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            point[k] += weight[i] * lrcsi_prepared_corner(t->view->prepared, t->facet, i)[k];
        }
    }
    return lrcsi_query_point(facets, t->facet, point);
}
