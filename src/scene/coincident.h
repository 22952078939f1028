/* SPDX-License-Identifier: MIT */
/* Coincident facets: on the same three points, wound either way. Of all facets in one place one is
   seen, whatever the direction, and it alone hides what lies behind. */
#ifndef LRCSI_COINCIDENT_H
#define LRCSI_COINCIDENT_H

#include "scene/prepared.h"

/* Fills p->redundant and p->twin; facets of curved shapes stand for themselves. Given: the
   topology, and p->redundant where facets are skipped. Status: LRCS_OK; LRCS_E_MEMORY. Work: twins
   stay, if there are any; lrcsi_coincident_need bytes at most. Linear time. */
size_t lrcsi_coincident_need(uint32_t vertex_count, uint32_t facet_count);
int lrcsi_coincident_mark(lrcs_prepared *p, lrcs_work *work);

/* Gives contacts found between first twins, and facets without, to both twins: each has the list
   of the first, and in every list a facet is followed by its twin. Given: p->intersections, the
   last that was taken from the work area. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than
   2^32 - 2 entries). Linear time. */
int lrcsi_coincident_touches(lrcs_prepared *p, lrcs_work *work);

#endif
