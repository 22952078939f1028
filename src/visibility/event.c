/* SPDX-License-Identifier: MIT */
/* Which edges are event edges in a view and which join two facets of one surface, from the
   directions in which their facets face. What event edges cross is decided elsewhere. */
#include "visibility/event.h"

#include <string.h>

#include "base/join.h"
#include "base/work.h"
#include "visibility/boxes.h"

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

/* Are all facets of the runs around a run of the same value as all of its own? */
static int run_surrounded(const lrcs_prepared *p, const signed char *value, uint32_t run)
{
    signed char own = value[(size_t)run * LRCSI_RUN];
    for (uint32_t i = p->runs.first_link[run]; i < p->runs.first_link[run + 1]; i++) {
        uint32_t other = p->runs.link[i];
        if (other == LRCS_NONE
                ? own != 0
                : value[(size_t)other * LRCSI_RUN] != own || !lrcsi_run_alike(value, other)) {
            return 0;
        }
    }
    return 1;
}

/* Marks events among the plain edges (scene/across.h): two facets continue each other across such
   an edge if both cast shadows and face the same way. A run that is like all around it has none. */
static void mark_plain(const lrcs_prepared *p, const signed char *cast, uint32_t *mark)
{
    uint32_t count = p->scene->facet_count;
    for (uint32_t r = 0; r < p->runs.count; r++) {
        uint32_t start = r * LRCSI_RUN;
        uint32_t end = lrcsi_run_end(start, count);
        int alike = lrcsi_run_alike(cast, r);
        for (uint32_t f = start; f < end && !alike; f++) {
            for (int k = 0; k < 3; k++) {
                uint32_t other = p->across.facet[f].corner[k];
                if (other >= start && other < end && cast[f] != 0 && cast[other] != cast[f]) {
                    mark_edge_event(mark, p->topology.facet_edge[f].corner[k]);
                }
            }
        }
        if (alike && run_surrounded(p, cast, r)) {
            continue;
        }
        for (uint32_t i = p->runs.run[r].first_side; i < p->runs.run[r + 1].first_side; i++) {
            const lrcsi_run_side *side = &p->runs.side[i];
            if (cast[side->facet] != cast[side->other]) {
                mark_edge_event(mark, side->edge);
            }
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

/* The item that stands for a facet: of a run all of which is joined, its first one. */
static inline uint32_t item_of(const lrcs_prepared *p, const signed char *joinable, uint32_t facet)
{
    uint32_t run = facet / LRCSI_RUN;
    return lrcsi_events_joined(p, joinable, run) == LRCSI_JOINED_ALL ? run * LRCSI_RUN : facet;
}

/* Joins the facets of a run among themselves, each an item. */
static void join_within(const lrcs_prepared *p, const signed char *joinable, uint32_t run,
                        uint32_t *group)
{
    uint32_t start = run * LRCSI_RUN;
    uint32_t end = lrcsi_run_end(start, p->scene->facet_count);
    int alike = lrcsi_run_alike(joinable, run);
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

/* Joins a run that is one item to earlier ones of which the same holds. 0 if it leads to others. */
static int join_linked(const lrcs_prepared *p, const signed char *joinable, uint32_t run,
                       uint32_t *group)
{
    uint32_t start = run * LRCSI_RUN;
    for (uint32_t i = p->runs.first_link[run]; i < p->runs.first_link[run + 1]; i++) {
        uint32_t other = p->runs.link[i];
        int joined = other < run ? lrcsi_events_joined(p, joinable, other) : LRCSI_JOINED_NONE;
        if (joined == LRCSI_JOINED_SOME) {
            return 0;
        }
        if (joined == LRCSI_JOINED_ALL && joinable[(size_t)other * LRCSI_RUN] == joinable[start]) {
            lrcsi_join(group, other * LRCSI_RUN, start);
        }
    }
    return 1;
}

/* Joins a run to earlier ones, side by side. */
static void join_sides(const lrcs_prepared *p, const signed char *joinable, uint32_t run,
                       uint32_t *group)
{
    for (uint32_t i = p->runs.run[run].first_side; i < p->runs.run[run + 1].first_side; i++) {
        const lrcsi_run_side *side = &p->runs.side[i];
        if (side->other < side->facet && joinable[side->facet] != 0 &&
            joinable[side->other] == joinable[side->facet]) {
            lrcsi_join(group, item_of(p, joinable, side->other), item_of(p, joinable, side->facet));
        }
    }
}

/* Sets the group of each facet to the first one of its group. Earlier runs are settled already, and
   the groups of later ones are not named by theirs. */
static void join_finish(const lrcs_prepared *p, const signed char *joinable, uint32_t *group)
{
    uint32_t count = p->scene->facet_count;
    for (uint32_t r = 0; r < p->runs.count; r++) {
        uint32_t start = r * LRCSI_RUN;
        int joined = lrcsi_events_joined(p, joinable, r);
        if (joined == LRCSI_JOINED_SOME) {
            for (uint32_t f = start; f < lrcsi_run_end(start, count); f++) {
                group[f] = group[group[f]];
            }
            continue;
        }
        uint32_t step = joined == LRCSI_JOINED_NONE;
        uint32_t root = group[group[start]];
        for (uint32_t i = 0; i < LRCSI_RUN; i++) {
            group[start + i] = root + step * i;
        }
    }
}

/* Run by run: each is joined within and then to earlier runs, while its facets are in the cache.
   The groups do not depend on the order. */
void lrcsi_events_join(const lrcsi_view *view, const signed char *joinable, uint32_t *group)
{
    const lrcs_prepared *p = view->prepared;
    for (uint32_t r = 0; r < p->runs.count; r++) {
        uint32_t start = r * LRCSI_RUN;
        int joined = lrcsi_events_joined(p, joinable, r);
        group[start] = start;
        if (joined == LRCSI_JOINED_SOME) {
            join_within(p, joinable, r, group);
        }
        if (joined == LRCSI_JOINED_SOME ||
            (joined == LRCSI_JOINED_ALL && !join_linked(p, joinable, r, group))) {
            join_sides(p, joinable, r, group);
        }
    }
    for (uint32_t i = 0; i < p->across.irregular_count; i++) {
        uint32_t pair[2];
        if (lrcsi_edge_kind_of(view, p->across.irregular[i], LRCS_NONE, pair) == LRCSI_EDGE_JOINS &&
            joinable[pair[0]] != 0 && joinable[pair[1]] != 0) {
            lrcsi_join(group, item_of(p, joinable, pair[0]), item_of(p, joinable, pair[1]));
        }
    }
    join_finish(p, joinable, group);
}
