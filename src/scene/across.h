/* SPDX-License-Identifier: MIT */
/* Who stands across each side of a facet, whatever the direction: what every pose walks over, in
   as few bytes as it can be said in. */
#ifndef LRCSI_ACROSS_H
#define LRCSI_ACROSS_H

#include "mesh/topology.h"

typedef struct lrcsi_across {
    lrcs_facet *facet; /* facet -> across its side from corner k to k + 1: the one other live facet
                          there, which runs the side the other way; the number of facets where
                          there is no other; itself where the edge is odd, or where it is skipped */
    uint32_t *odd;     /* the other edges with live facets: three or more of them, or two that run
                          the same way; ascending */
    uint32_t odd_count;
} lrcsi_across;

size_t lrcsi_across_need(uint32_t facet_count);

/* Given which facets to skip. Status: LRCS_OK; LRCS_E_MEMORY. The result stays in the work area.
   Linear time. */
int lrcsi_across_make(const lrcsi_topology *topology, uint32_t facet_count,
                      const unsigned char *skip, lrcs_work *work, lrcsi_across *across);

#endif
