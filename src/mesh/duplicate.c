/* SPDX-License-Identifier: MIT */
/* It finds, by sorting, which facets have the same three points. It does not decide what that means
   for a report or for visibility. */
#include "mesh/duplicate.h"

#include "base/sort.h"
#include "base/work.h"

lrcsi_duplicate_key lrcsi_duplicate_key_of(const lrcsi_topology *topology, const lrcs_facet *facet)
{
    uint32_t a = topology->weld[facet->corner[0]];
    uint32_t b = topology->weld[facet->corner[1]];
    uint32_t c = topology->weld[facet->corner[2]];
    int odd = (a > b) ^ (b > c) ^ (a > c); /* one inversion each */
    uint32_t low = a < b ? (a < c ? a : c) : (b < c ? b : c);
    uint32_t high = a > b ? (a > c ? a : c) : (b > c ? b : c);
    return (lrcsi_duplicate_key){low, a ^ b ^ c ^ low ^ high, high, odd};
}

size_t lrcsi_duplicate_need(uint32_t facet_count)
{
    return lrcsi_work_add(lrcsi_work_blocks(2, facet_count, sizeof(uint64_t)),
                          lrcsi_work_blocks(2, facet_count, sizeof(uint32_t)));
}

int lrcsi_duplicate_order(const lrcsi_topology *topology, const lrcs_facet *facet,
                          uint32_t facet_count, lrcs_work *work, const uint32_t **order,
                          uint32_t *count)
{
    size_t mark = work->used;
    uint32_t *of = lrcsi_work_take(work, facet_count, sizeof *of);
    size_t end = work->used;
    uint32_t *of_spare = lrcsi_work_take(work, facet_count, sizeof *of);
    uint64_t *key = lrcsi_work_take(work, facet_count, sizeof *key);
    uint64_t *key_spare = lrcsi_work_take(work, facet_count, sizeof *key);
    if (!of || !of_spare || !key || !key_spare) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    uint32_t n = 0;
    for (uint32_t f = 0; f < facet_count; f++) {
        if (!topology->degenerate[f]) {
            key[n] = lrcsi_duplicate_key_of(topology, &facet[f]).high;
            of[n++] = f;
        }
    }
    lrcsi_sort_pairs(key, of, key_spare, of_spare, n);
    for (uint32_t i = 0; i < n; i++) {
        lrcsi_duplicate_key k = lrcsi_duplicate_key_of(topology, &facet[of[i]]);
        key[i] = (uint64_t)k.low << 32 | k.middle;
    }
    lrcsi_sort_pairs(key, of, key_spare, of_spare, n);
    work->used = end;
    *order = of;
    *count = n;
    return LRCS_OK;
}
