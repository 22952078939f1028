/* SPDX-License-Identifier: MIT */
/* Which facet lies across each side of a facet, independent of direction, in as few bytes as
   possible, because every pose reads it. Facets that are always redundant (scene/coincident.h) do
   not count. Of two coincident facets only the one that faces the laser counts in a view. If two
   pairs of coincident facets meet, the facet across is the one that traverses the side in the
   opposite sense, because it faces the laser if the surface continues there. */
#ifndef LRCSI_ACROSS_H
#define LRCSI_ACROSS_H

#include "scene/prepared.h"

size_t lrcsi_across_need(uint32_t facet_count);

/* Given which facets are redundant (a lrcsi_redundant), and the facets coincident with them
   (prepared->opposite) or NULL. Status: LRCS_OK; LRCS_E_MEMORY. The result stays in the work area.
   Linear time. */
int lrcsi_across_make(const lrcsi_topology *topology, uint32_t facet_count,
                      const unsigned char *redundant, const uint32_t *opposite, lrcs_work *work,
                      lrcsi_across *across);

#endif
