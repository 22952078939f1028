/* SPDX-License-Identifier: MIT */
/* The neighbours of each facet: the facet on the other side of each of its edges. They do not
   depend on direction. The table is small because every pose reads it. Facets that are always
   redundant (scene/coincident.h) are left out. Where two pairs of coincident facets meet, a facet's
   neighbour is the facet of the other pair that traverses the edge in the opposite sense: of that
   pair, it is the one that faces the laser where the surface continues. */
#ifndef LRCSI_NEIGHBOURS_H
#define LRCSI_NEIGHBOURS_H

#include "scene/prepared.h"

size_t lrcsi_neighbours_need(uint32_t facet_count);

/* Given which facets are redundant (a lrcsi_redundant), and the facets coincident with them
   (prepared->opposite) or NULL. Status: LRCS_OK; LRCS_E_MEMORY. The result stays in the work area.
   Linear time. */
int lrcsi_neighbours_make(const lrcsi_topology *topology, uint32_t facet_count,
                          const unsigned char *redundant, const uint32_t *opposite, lrcs_work *work,
                          lrcsi_neighbours *neighbours);

/* The neighbour across side k of a facet if it is another facet of the same part, else LRCS_NONE.
 */
static inline uint32_t lrcsi_neighbour_in_part(const lrcs_prepared *p, uint32_t facet, int k)
{
    const uint32_t *part = p->scene->facet_part;
    const uint32_t other = p->neighbours.facet[facet].corner[k];
    return other < p->scene->facet_count && other != facet && part[other] == part[facet]
               ? other
               : LRCS_NONE;
}

#endif
