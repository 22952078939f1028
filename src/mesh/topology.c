/* SPDX-License-Identifier: MIT */
/* Welds points, marks degenerate facets and groups sides into edges. It decides only which points
   and edges are the same; its callers decide whether the result is closed, oriented or convex.

   Points are welded in a hash table; if that takes too many probes, by sorting the bit patterns of
   coordinates (radix, stable). One counting sort groups sides by their lower ends; within a group
   they are sorted by their upper ends. Time is linear, except for a logarithm of the number of
   edges at a vertex that has many. */
#include "mesh/topology.h"

#include <string.h>

#include "base/bits.h"
#include "base/exact.h"
#include "base/hash.h"
#include "base/sort.h"
#include "base/work.h"

/* A side is 3 * facet + k, from corner k to the next. */
enum { SIDES = 3 };

/* The largest facet index that lrcsi_edge_use can hold; there are fewer sides than 2^32. */
#define FACET_INDEX_MAX 0x7fffffffu

/* The average number of probes per point at which hashing is abandoned; ordinary meshes take
   1.5. */
#define WELD_PROBES 8u

/* Points whose slots are read at once. */
enum { WELD_BATCH = 16 };

/* --- points ----------------------------------------------------------------------------------- */

static uint64_t coordinate_key(double x)
{
    return lrcsi_bits_of(x + 0.0); /* -0 becomes 0 */
}

static int same_position(const lrcs_point *a, const lrcs_point *b)
{
    return a->x[0] == b->x[0] && a->x[1] == b->x[1] && a->x[2] == b->x[2];
}

static size_t weld_scratch(uint32_t vertex_count)
{
    size_t sorted = lrcsi_work_add(lrcsi_work_blocks(2, vertex_count, sizeof(uint64_t)),
                                   lrcsi_work_blocks(2, vertex_count, sizeof(uint32_t)));
    size_t hashed = lrcsi_work_bytes(lrcsi_hash_slots(vertex_count), sizeof(uint32_t));
    return sorted > hashed ? sorted : hashed;
}

/* Represents each point by the first one at its position; the slots hold these representatives.
   Returns 0 if the allowed number of probes is exceeded. Slots are read for several points at once,
   so that waiting for one overlaps waiting for the others. */
static int weld_hashed(const lrcs_point *vertex, uint32_t count, uint32_t *slot, size_t slots,
                       uint32_t *weld)
{
    uint64_t probes = (uint64_t)WELD_PROBES * count + 64;
    memset(slot, 0xff, slots * sizeof *slot); /* LRCS_NONE */
    for (uint32_t first = 0; first < count; first += WELD_BATCH) {
        uint32_t batch = count - first < WELD_BATCH ? count - first : WELD_BATCH;
        size_t first_slot[WELD_BATCH];
        for (uint32_t j = 0; j < batch; j++) {
            uint64_t key = 0;
            for (int k = 0; k < 3; k++) {
                key = lrcsi_hash_mix(key + coordinate_key(vertex[first + j].x[k]));
            }
            first_slot[j] = (size_t)key & (slots - 1);
            weld[first + j] = slot[first_slot[j]]; /* overwritten below */
        }
        for (uint32_t j = 0; j < batch; j++) {
            uint32_t i = first + j;
            size_t at = first_slot[j];
            while (slot[at] != LRCS_NONE && !same_position(&vertex[slot[at]], &vertex[i])) {
                at = (at + 1) & (slots - 1);
                if (probes-- == 0) {
                    return 0;
                }
            }
            slot[at] = slot[at] == LRCS_NONE ? i : slot[at];
            weld[i] = slot[at];
        }
    }
    return 1;
}

/* Sorts vertex indices by position, equal positions by index; the first of each position represents
   it. */
static int weld_sorted(const lrcs_point *vertex, uint32_t count, lrcs_work *work, uint32_t *weld)
{
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
    return LRCS_OK;
}

static int weld_points(const lrcs_point *vertex, uint32_t count, lrcs_work *work, uint32_t *weld)
{
    size_t mark = work->used;
    size_t slots = lrcsi_hash_slots(count);
    uint32_t *slot = lrcsi_work_take(work, slots, sizeof *slot);
    int hashed = slot && weld_hashed(vertex, count, slot, slots, weld);
    work->used = mark;
    int status = hashed ? LRCS_OK : slot ? weld_sorted(vertex, count, work, weld) : LRCS_E_MEMORY;
    work->used = mark;
    return status;
}

/* Marks the degenerate facets, which have no edges; returns the number of others. */
static uint32_t mark_degenerate(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t count,
                                lrcsi_topology *t)
{
    uint32_t proper = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *c = facet[i].corner;
        int degenerate = lrcsi_exact_collinear(vertex[c[0]].x, vertex[c[1]].x, vertex[c[2]].x);
        t->degenerate[i] = (unsigned char)degenerate;
        if (degenerate) {
            t->facet_edge[i] = (lrcs_facet){{LRCS_NONE, LRCS_NONE, LRCS_NONE}};
        }
        proper += !degenerate;
    }
    return proper;
}

/* --- sides ------------------------------------------------------------------------------------ */

/* Fills use[], edge[] and facet_edge[]. Scratch: side[], with as many items as use[], each a side
   with the upper end of its edge as key; and place[], with vertex_count + 1. */
static void build_edges(lrcsi_topology *t, uint32_t vertex_count, const lrcs_facet *facet,
                        uint32_t facet_count, lrcsi_sort_item *side, uint32_t *place)
{
    /* 1. Counts the sides whose lower end is at each vertex; then computes the index where they
       begin. */
    memset(place, 0, ((size_t)vertex_count + 1) * sizeof *place);
    for (uint32_t f = 0; f < facet_count; f++) {
        const uint32_t *corner = facet[f].corner;
        const uint32_t at[3] = {t->weld[corner[0]], t->weld[corner[1]], t->weld[corner[2]]};
        for (int k = 0; k < SIDES && !t->degenerate[f]; k++) {
            uint32_t other = at[k == 2 ? 0 : k + 1];
            place[(at[k] < other ? at[k] : other) + 1]++;
        }
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        place[v + 1] += place[v];
    }
    /* 2. Stores the sides there, in order; place[v] is then the end of those of v. */
    for (uint32_t f = 0; f < facet_count; f++) {
        const uint32_t *corner = facet[f].corner;
        const uint32_t at[3] = {t->weld[corner[0]], t->weld[corner[1]], t->weld[corner[2]]};
        for (uint32_t k = 0; k < SIDES && !t->degenerate[f]; k++) {
            uint32_t other = at[k == 2 ? 0 : k + 1];
            uint32_t low = at[k] < other ? at[k] : other;
            side[place[low]++] = (lrcsi_sort_item){at[k] ^ other ^ low, SIDES * f + k};
        }
    }
    /* 3. Sorts the sides of each vertex by their upper ends: those with the same one are
       an edge. */
    uint32_t begin = 0;
    t->edge_count = 0;
    for (uint32_t v = 0; v < vertex_count; v++) {
        lrcsi_sort_items(side + begin, place[v] - begin);
        lrcsi_edge *edge = NULL;
        for (uint32_t i = begin; i < place[v]; i++) {
            uint32_t f = side[i].value / SIDES;
            uint32_t k = side[i].value % SIDES;
            if (!edge || edge->high != side[i].key) {
                edge = &t->edge[t->edge_count++];
                *edge = (lrcsi_edge){v, side[i].key, i, 0};
            }
            edge->uses++;
            t->facet_edge[f].corner[k] = t->edge_count - 1;
            t->use[i].facet = f & FACET_INDEX_MAX;
            t->use[i].forward = t->weld[facet[f].corner[k]] == v;
        }
        begin = place[v];
    }
}

/* The size of the result without the edges. */
static size_t kept_before_edges(uint32_t vertex_count, uint32_t facet_count)
{
    size_t sides = (size_t)SIDES * facet_count;
    size_t kept = lrcsi_work_bytes(vertex_count, sizeof(uint32_t));
    kept = lrcsi_work_add(kept, lrcsi_work_bytes(facet_count, 1));
    kept = lrcsi_work_add(kept, lrcsi_work_bytes(facet_count, sizeof(lrcs_facet)));
    return lrcsi_work_add(kept, lrcsi_work_bytes(sides, sizeof(lrcsi_edge_use)));
}

size_t lrcsi_topology_kept(uint32_t vertex_count, uint32_t facet_count)
{
    size_t sides = (size_t)SIDES * facet_count;
    return lrcsi_work_add(kept_before_edges(vertex_count, facet_count),
                          lrcsi_work_bytes(sides, sizeof(lrcsi_edge)));
}

size_t lrcsi_topology_need(uint32_t vertex_count, uint32_t facet_count)
{
    size_t sides = (size_t)SIDES * facet_count;
    size_t weld =
        lrcsi_work_add(kept_before_edges(vertex_count, facet_count), weld_scratch(vertex_count));
    size_t edges = lrcsi_work_add(lrcsi_work_bytes(sides, sizeof(lrcsi_sort_item)),
                                  lrcsi_work_bytes((size_t)vertex_count + 1, sizeof(uint32_t)));
    edges = lrcsi_work_add(edges, lrcsi_topology_kept(vertex_count, facet_count));
    return weld > edges ? weld : edges;
}

int lrcsi_topology_make(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                        uint32_t facet_count, lrcs_work *work, lrcsi_topology *topology)
{
    if (facet_count > (LRCS_NONE - 1) / SIDES) {
        return LRCS_E_LIMIT;
    }
    size_t mark = work->used;
    lrcsi_topology t = {0};
    t.weld = lrcsi_work_take(work, vertex_count, sizeof *t.weld);
    t.degenerate = lrcsi_work_take(work, facet_count, sizeof *t.degenerate);
    t.facet_edge = lrcsi_work_take(work, facet_count, sizeof *t.facet_edge);
    int status = t.weld && t.degenerate && t.facet_edge
                     ? weld_points(vertex, vertex_count, work, t.weld)
                     : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        uint32_t sides = SIDES * mark_degenerate(vertex, facet, facet_count, &t);
        t.use = lrcsi_work_take(work, sides, sizeof *t.use);
        size_t end = work->used;
        t.edge = lrcsi_work_take(work, sides, sizeof *t.edge); /* there are at most as many */
        lrcsi_sort_item *side = lrcsi_work_take(work, sides, sizeof *side);
        uint32_t *place = lrcsi_work_take(work, (size_t)vertex_count + 1, sizeof *place);
        if (t.use && t.edge && side && place) {
            build_edges(&t, vertex_count, facet, facet_count, side, place);
            work->used = end; /* the edges are already stored here */
            t.edge = lrcsi_work_take(work, t.edge_count, sizeof *t.edge);
        } else {
            status = LRCS_E_MEMORY;
        }
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *topology = t;
    return LRCS_OK;
}
