/* SPDX-License-Identifier: MIT */
/* Welds points, marks degenerate facets and groups sides into edges. It decides only what is the
   same: whether the result is closed, oriented or convex is decided by its readers.

   Points are welded by sorting the bit patterns of their coordinates (radix, stable), so the
   lowest index of a group comes first and no choice of coordinates makes it slow. Sides are
   grouped by two counting sorts, by high and then by low end. Everything is linear in time. */
#include "mesh/topology.h"

#include <string.h>

#include "base/exact.h"
#include "base/sort.h"
#include "base/work.h"

/* A side is 3 * facet + k, from corner k to the next. */
enum { SIDES = 3 };

static uint64_t coordinate_key(double x)
{
    double plain = x + 0.0; /* -0 becomes 0 */
    uint64_t key;
    memcpy(&key, &plain, sizeof key);
    return key;
}

static int same_position(const lrcs_point *a, const lrcs_point *b)
{
    return a->x[0] == b->x[0] && a->x[1] == b->x[1] && a->x[2] == b->x[2];
}

static size_t weld_scratch(uint32_t vertex_count)
{
    return lrcsi_work_add(2 * lrcsi_work_bytes(vertex_count, sizeof(uint64_t)),
                          2 * lrcsi_work_bytes(vertex_count, sizeof(uint32_t)));
}

/* Sorts vertex indices by position, equal positions by index, and names the first of each. */
static int weld_points(const lrcs_point *vertex, uint32_t count, lrcs_work *work, uint32_t *weld)
{
    size_t mark = work->used;
    uint64_t *key = lrcsi_work_take(work, count, sizeof *key);
    uint64_t *key_spare = lrcsi_work_take(work, count, sizeof *key);
    uint32_t *order = lrcsi_work_take(work, count, sizeof *order);
    uint32_t *order_spare = lrcsi_work_take(work, count, sizeof *order);
    if (!key || !key_spare || !order || !order_spare) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        order[i] = i;
    }
    for (int k = 2; k >= 0; k--) {
        for (uint32_t i = 0; i < count; i++) {
            key[i] = coordinate_key(vertex[order[i]].x[k]);
        }
        lrcsi_sort_pairs(key, order, key_spare, order_spare, count);
    }
    for (uint32_t i = 0; i < count; i++) {
        int again = i > 0 && same_position(&vertex[order[i - 1]], &vertex[order[i]]);
        weld[order[i]] = again ? weld[order[i - 1]] : order[i];
    }
    work->used = mark;
    return LRCS_OK;
}

/* Marks the degenerate facets; returns the number of others. */
static uint32_t mark_degenerate(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t count,
                                unsigned char *degenerate)
{
    uint32_t proper = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *c = facet[i].corner;
        degenerate[i] =
            (unsigned char)lrcsi_exact_collinear(vertex[c[0]].x, vertex[c[1]].x, vertex[c[2]].x);
        proper += !degenerate[i];
    }
    return proper;
}

typedef struct side_ends {
    uint32_t low, high;
    uint32_t forward;
} side_ends;

static side_ends side_ends_of(const uint32_t *weld, const lrcs_facet *facet, uint32_t f, uint32_t k)
{
    uint32_t from = weld[facet[f].corner[k]];
    uint32_t to = weld[facet[f].corner[(k + 1) % SIDES]];
    return from < to ? (side_ends){from, to, 1} : (side_ends){to, from, 0};
}

/* One stable counting sort of sides, by their high (or low) end; `place` has vertex_count + 1. */
static void sort_sides(const uint32_t *weld, uint32_t vertex_count, const lrcs_facet *facet,
                       int by_high, const uint32_t *side, uint32_t count, uint32_t *place,
                       uint32_t *sorted)
{
    memset(place, 0, ((size_t)vertex_count + 1) * sizeof *place);
    for (uint32_t i = 0; i < count; i++) {
        side_ends e = side_ends_of(weld, facet, side[i] / SIDES, side[i] % SIDES);
        place[(by_high ? e.high : e.low) + 1]++;
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        place[v + 1] += place[v];
    }
    for (uint32_t i = 0; i < count; i++) {
        side_ends e = side_ends_of(weld, facet, side[i] / SIDES, side[i] % SIDES);
        sorted[place[by_high ? e.high : e.low]++] = side[i];
    }
}

static size_t group_scratch(uint32_t vertex_count, size_t sides)
{
    return lrcsi_work_add(2 * lrcsi_work_bytes(sides, sizeof(uint32_t)),
                          lrcsi_work_bytes((size_t)vertex_count + 1, sizeof(uint32_t)));
}

/* Fills use[] in the order of edges. Until fill_edges reads it, `forward` holds the corner k. */
static int group_sides(const lrcsi_topology *t, uint32_t vertex_count, const lrcs_facet *facet,
                       uint32_t facet_count, uint32_t sides, lrcs_work *work)
{
    size_t mark = work->used;
    uint32_t *side = lrcsi_work_take(work, sides, sizeof *side);
    uint32_t *sorted = lrcsi_work_take(work, sides, sizeof *sorted);
    uint32_t *place = lrcsi_work_take(work, (size_t)vertex_count + 1, sizeof *place);
    if (!side || !sorted || !place) {
        return LRCS_E_MEMORY;
    }
    uint32_t n = 0;
    for (uint32_t f = 0; f < facet_count; f++) {
        for (uint32_t k = 0; k < SIDES && !t->degenerate[f]; k++) {
            side[n++] = SIDES * f + k;
        }
    }
    sort_sides(t->weld, vertex_count, facet, 1, side, sides, place, sorted);
    sort_sides(t->weld, vertex_count, facet, 0, sorted, sides, place, side);
    for (uint32_t i = 0; i < sides; i++) {
        t->use[i] = (lrcsi_edge_use){side[i] / SIDES, side[i] % SIDES};
    }
    work->used = mark;
    return LRCS_OK;
}

static int use_starts_edge(const lrcsi_topology *t, const lrcs_facet *facet, uint32_t i)
{
    if (i == 0) {
        return 1;
    }
    side_ends a = side_ends_of(t->weld, facet, t->use[i - 1].facet, t->use[i - 1].forward);
    side_ends b = side_ends_of(t->weld, facet, t->use[i].facet, t->use[i].forward);
    return a.low != b.low || a.high != b.high;
}

static uint32_t count_edges(const lrcsi_topology *t, const lrcs_facet *facet, uint32_t sides)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < sides; i++) {
        n += (uint32_t)use_starts_edge(t, facet, i);
    }
    return n;
}

/* Fills edge[] and facet_edge[], and turns corners into directions. */
static void fill_edges(const lrcsi_topology *t, const lrcs_facet *facet, uint32_t sides)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < sides; i++) {
        lrcsi_edge_use *use = &t->use[i];
        uint32_t k = use->forward;
        side_ends e = side_ends_of(t->weld, facet, use->facet, k);
        if (n == 0 || t->edge[n - 1].low != e.low || t->edge[n - 1].high != e.high) {
            t->edge[n++] = (lrcsi_edge){e.low, e.high, i, 0};
        }
        t->edge[n - 1].uses++;
        t->facet_edge[use->facet].corner[k] = n - 1;
        use->forward = e.forward;
    }
}

size_t lrcsi_topology_need(uint32_t vertex_count, uint32_t facet_count)
{
    size_t sides = (size_t)SIDES * facet_count;
    size_t stays = lrcsi_work_bytes(vertex_count, sizeof(uint32_t));
    stays = lrcsi_work_add(stays, lrcsi_work_bytes(facet_count, 1));
    stays = lrcsi_work_add(stays, lrcsi_work_bytes(facet_count, sizeof(lrcs_facet)));
    stays = lrcsi_work_add(stays, lrcsi_work_bytes(sides, sizeof(lrcsi_edge_use)));
    size_t weld = weld_scratch(vertex_count);
    size_t group = group_scratch(vertex_count, sides);
    size_t edges = lrcsi_work_bytes(sides, sizeof(lrcsi_edge));
    size_t most = weld > group ? weld : group;
    return lrcsi_work_add(stays, most > edges ? most : edges);
}

/* Everything but the release on failure. */
static int topology_build(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                          uint32_t facet_count, lrcs_work *work, lrcsi_topology *t)
{
    t->weld = lrcsi_work_take(work, vertex_count, sizeof *t->weld);
    t->degenerate = lrcsi_work_take(work, facet_count, sizeof *t->degenerate);
    t->facet_edge = lrcsi_work_take(work, facet_count, sizeof *t->facet_edge);
    if (!t->weld || !t->degenerate || !t->facet_edge) {
        return LRCS_E_MEMORY;
    }
    int status = weld_points(vertex, vertex_count, work, t->weld);
    if (status != LRCS_OK) {
        return status;
    }
    uint32_t sides = SIDES * mark_degenerate(vertex, facet, facet_count, t->degenerate);
    for (uint32_t f = 0; f < facet_count; f++) {
        t->facet_edge[f] = (lrcs_facet){{LRCS_NONE, LRCS_NONE, LRCS_NONE}};
    }
    t->use = lrcsi_work_take(work, sides, sizeof *t->use);
    if (!t->use) {
        return LRCS_E_MEMORY;
    }
    status = group_sides(t, vertex_count, facet, facet_count, sides, work);
    if (status != LRCS_OK) {
        return status;
    }
    t->edge_count = count_edges(t, facet, sides);
    t->edge = lrcsi_work_take(work, t->edge_count, sizeof *t->edge);
    if (!t->edge) {
        return LRCS_E_MEMORY;
    }
    fill_edges(t, facet, sides);
    return LRCS_OK;
}

int lrcsi_topology_make(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                        uint32_t facet_count, lrcs_work *work, lrcsi_topology *topology)
{
    if (facet_count > (LRCS_NONE - 1) / SIDES) {
        return LRCS_E_LIMIT;
    }
    size_t mark = work->used;
    lrcsi_topology made;
    int status = topology_build(vertex, vertex_count, facet, facet_count, work, &made);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *topology = made;
    return LRCS_OK;
}
