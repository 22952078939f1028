/* SPDX-License-Identifier: MIT */
/* Which facet lies across each side of a facet, whatever the direction: what every pose walks over,
   in as few bytes as possible. Facets that are always redundant (scene/coincident.h) do not count.
   Of two twins one faces the laser and counts then: where two pairs of twins meet, the facet across
   is the one that runs the side the other way, for it faces the laser where the surface goes on. */
#ifndef LRCSI_ACROSS_H
#define LRCSI_ACROSS_H

#include "scene/prepared.h"

size_t lrcsi_across_need(uint32_t facet_count);

/* Given which facets are redundant (a lrcsi_redundant), and their twins or NULL. Status: LRCS_OK;
   LRCS_E_MEMORY. The result stays in the work area. Linear time. */
int lrcsi_across_make(const lrcsi_topology *topology, uint32_t facet_count,
                      const unsigned char *redundant, const uint32_t *twin, lrcs_work *work,
                      lrcsi_across *across);

#endif
