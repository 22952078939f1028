/* SPDX-License-Identifier: MIT */
/* Facets in the same place: on the same three welded points, in any order. */
#ifndef LRCSI_DUPLICATE_H
#define LRCSI_DUPLICATE_H

#include <lrcs/work.h>

#include "mesh/topology.h"

/* The three points of a facet in ascending order, and the parity of the reordering: facets in the
   same place with the same parity have the same winding. */
typedef struct lrcsi_duplicate_key {
    uint32_t low, middle, high;
    int odd;
} lrcsi_duplicate_key;

lrcsi_duplicate_key lrcsi_duplicate_key_of(const lrcsi_topology *topology, const lrcs_facet *facet);

static inline int lrcsi_duplicate_place(const lrcsi_duplicate_key *a, const lrcsi_duplicate_key *b)
{
    return a->low == b->low && a->middle == b->middle && a->high == b->high;
}

/* Lists the facets that are not degenerate; those in the same place are consecutive, by index.
   Returned: order[*count], in the work area. Status: LRCS_OK; LRCS_E_MEMORY. Work:
   lrcsi_duplicate_need bytes at most. Linear time. */
size_t lrcsi_duplicate_need(uint32_t facet_count);
int lrcsi_duplicate_order(const lrcsi_topology *topology, const lrcs_facet *facet,
                          uint32_t facet_count, lrcs_work *work, const uint32_t **order,
                          uint32_t *count);

#endif
