/* SPDX-License-Identifier: MIT */
/* Which edges are event edges in a view and which join two facets of one surface, from the
   directions in which their facets face. What event edges cross is decided elsewhere. */
#include "visibility/event.h"

#include <string.h>

#include "base/join.h"
#include "base/work.h"
#include "visibility/grid.h"

/* --- one edge --------------------------------------------------------------------------------- */

/* In projection a facet lies to the left of its side if it faces the laser, otherwise to the right.
   Two facets lie on opposite sides of an edge if and only if they traverse it in opposite
   directions and face the same way, or in the same direction and face opposite ways (as where the
   winding of a surface changes). */
int lrcsi_edge_kind_of(const lrcsi_view *view, uint32_t edge, uint32_t part, uint32_t pair[2])
{
    const lrcs_prepared *p = view->prepared;
    const lrcsi_topology *t = &p->topology;
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    uint32_t count = 0;
    uint32_t forward = 0; /* facets that traverse the edge in its own direction */
    int left = 0;         /* facets on the left of the edge, less those on the right */
    for (uint32_t i = 0; i < t->edge[edge].uses; i++) {
        uint32_t f = use[i].facet;
        if (part == LRCS_NONE ? lrcsi_view_casts(view, f)
                              : p->scene->facet_part[f] == part && !p->skip[f]) {
            pair[count < 2 ? count : 1] = f;
            count++;
            forward += use[i].forward;
            left += use[i].forward ? view->facing[f] : -view->facing[f];
        }
    }
    if (count == 0) {
        return LRCSI_EDGE_UNUSED;
    }
    int opposite = count == 2 && left == 0;
    int continues = part == LRCS_NONE || (forward == 1 && view->facing[pair[0]] != 0);
    return opposite && continues ? LRCSI_EDGE_JOINS : LRCSI_EDGE_EVENT;
}

/* --- all edges -------------------------------------------------------------------------------- */

/* One bit for each edge: the events are listed in order, each once, in little memory. */
enum { MARK_BITS = 32 };

static size_t mark_words(const lrcs_prepared *p)
{
    return ((size_t)p->topology.edge_count + MARK_BITS - 1) / MARK_BITS;
}

static void mark_edge_event(uint32_t *mark, uint32_t edge)
{
    mark[edge / MARK_BITS] |= (uint32_t)1 << edge % MARK_BITS;
}

/* Do the facets of a run all have the same value? */
static int run_alike(const signed char *value, uint32_t start, uint32_t end)
{
    return memcmp(value + start, value + start + 1, end - start - 1) == 0;
}

/* Marks events among the plain edges (scene/across.h): two facets continue each other across such
   an edge if both cast shadows and face the same way. Within a run whose facets all have the same
   value there are none. */
static void mark_plain(const lrcs_prepared *p, const signed char *cast, uint32_t *mark)
{
    uint32_t count = p->scene->facet_count;
    for (uint32_t start = 0; start < count; start += LRCSI_RUN) {
        uint32_t end = lrcsi_run_end(start, count);
        for (uint32_t f = start; f < end && !run_alike(cast, start, end); f++) {
            for (int k = 0; k < 3; k++) {
                uint32_t other = p->across.facet[f].corner[k];
                if (other >= start && other < end && cast[f] != 0 && cast[other] != cast[f]) {
                    mark_edge_event(mark, p->topology.facet_edge[f].corner[k]);
                }
            }
        }
    }
    const lrcsi_run_side *side = p->runs.side;
    for (uint32_t i = p->runs.run[p->runs.count].first_side; i > 0; i--, side++) {
        if (cast[side->facet] != cast[side->other] &&
            (cast[side->facet] != 0 || side->other < side->facet)) {
            mark_edge_event(mark, side->edge);
        }
    }
}

static void mark_irregular(const lrcsi_view *view, uint32_t *mark)
{
    const lrcsi_across *across = &view->prepared->across;
    for (uint32_t i = 0; i < across->irregular_count; i++) {
        uint32_t pair[2];
        if (lrcsi_edge_kind_of(view, across->irregular[i], LRCS_NONE, pair) == LRCSI_EDGE_EVENT) {
            mark_edge_event(mark, across->irregular[i]);
        }
    }
}

static uint32_t mark_list(const uint32_t *mark, size_t words, uint32_t *edge)
{
    uint32_t count = 0;
    for (size_t w = 0; w < words; w++) {
        uint32_t e = (uint32_t)(w * MARK_BITS);
        for (uint32_t left = mark[w]; left != 0; left >>= 1) {
            edge[count] = e++;
            count += left & 1;
        }
    }
    return count;
}

size_t lrcsi_events_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_add(lrcsi_work_bytes(mark_words(prepared), sizeof(uint32_t)),
                          lrcsi_work_bytes(prepared->topology.edge_count, sizeof(uint32_t)));
}

/* Takes room for as many events as there are edges, and returns what is not needed. */
int lrcsi_events_make(const lrcsi_view *view, const signed char *cast, lrcs_work *work,
                      lrcsi_events *events)
{
    const lrcs_prepared *p = view->prepared;
    size_t mark = work->used;
    uint32_t *marks = lrcsi_work_take_zero(work, mark_words(p), sizeof *marks);
    size_t end = work->used;
    uint32_t *edge = lrcsi_work_take(work, p->topology.edge_count, sizeof *edge);
    if (!marks || !edge) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    mark_plain(p, cast, marks);
    mark_irregular(view, marks);
    events->count = mark_list(marks, mark_words(p), edge);
    work->used = end;
    events->edge = lrcsi_work_take(work, events->count, sizeof *edge);
    return LRCS_OK;
}

/* --- groups ----------------------------------------------------------------------------------- */

/* Joins the facets of a run among themselves. */
static void join_within(const lrcs_prepared *p, const signed char *joinable, uint32_t start,
                        uint32_t end, uint32_t *group)
{
    int alike = run_alike(joinable, start, end);
    for (uint32_t f = start; f < end; f++) {
        group[f] = alike ? start + p->runs.first[f] : f;
        for (int k = 0; k < 3 && !alike && joinable[f] != 0; k++) {
            uint32_t other = p->across.facet[f].corner[k];
            if (other >= start && other < f && joinable[other] == joinable[f]) {
                lrcsi_join(group, other, f);
            }
        }
    }
}

/* Run by run: each is joined within and then to earlier runs, while its facets are in the cache.
   The groups do not depend on the order. Nothing is joined in a run without joinable facets. */
void lrcsi_events_join(const lrcsi_view *view, const signed char *joinable, uint32_t *group)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t count = p->scene->facet_count;
    uint32_t last[2] = {0, 0}; /* the groups joined last: two runs mostly share many sides */
    for (uint32_t r = 0; r < p->runs.count; r++) {
        uint32_t start = r * LRCSI_RUN;
        uint32_t end = lrcsi_run_end(start, count);
        if (joinable[start] == 0 && run_alike(joinable, start, end)) {
            for (uint32_t f = start; f < end; f++) {
                group[f] = f;
            }
            continue;
        }
        join_within(p, joinable, start, end, group);
        for (uint32_t i = p->runs.run[r].first_side; i < p->runs.run[r + 1].first_side; i++) {
            const lrcsi_run_side *side = &p->runs.side[i];
            if (side->other < side->facet && joinable[side->facet] != 0 &&
                joinable[side->other] == joinable[side->facet]) {
                uint32_t a = group[side->other];
                uint32_t b = group[side->facet];
                if (a != b && (a != last[0] || b != last[1])) {
                    lrcsi_join(group, a, b);
                    last[0] = a;
                    last[1] = b;
                }
            }
        }
    }
    for (uint32_t i = 0; i < p->across.irregular_count; i++) {
        uint32_t pair[2];
        if (lrcsi_edge_kind_of(view, p->across.irregular[i], LRCS_NONE, pair) == LRCSI_EDGE_JOINS &&
            joinable[pair[0]] != 0 && joinable[pair[1]] != 0) {
            lrcsi_join(group, pair[0], pair[1]);
        }
    }
    lrcsi_join_settle(group, count);
}
