/* SPDX-License-Identifier: MIT */
/* Facets in the same place: on the same three welded points, in any order. */
#ifndef LRCSI_SAME_H
#define LRCSI_SAME_H

#include <lrcs/work.h>

#include "mesh/topology.h"

/* The three points of a facet in ascending order, and the parity of the reordering: facets in the
   same place with the same parity have the same winding. */
typedef struct lrcsi_same_key {
    uint32_t low, middle, high;
    int odd;
} lrcsi_same_key;

lrcsi_same_key lrcsi_same_key_of(const lrcsi_topology *topology, const lrcs_facet *facet);

static inline int lrcsi_same_place(const lrcsi_same_key *a, const lrcsi_same_key *b)
{
    return a->low == b->low && a->middle == b->middle && a->high == b->high;
}

/* Lists the facets that are not degenerate; those in the same place are consecutive, by index.
   Returned: order[*count]. It lies where the next block of the work area will be, so it must be
   read before that block is allocated. Status: LRCS_OK; LRCS_E_MEMORY. Work: lrcsi_same_need bytes
   at most. Linear time. */
size_t lrcsi_same_need(uint32_t facet_count);
int lrcsi_same_order(const lrcsi_topology *topology, const lrcs_facet *facet, uint32_t facet_count,
                     lrcs_work *work, const uint32_t **order, uint32_t *count);

#endif
