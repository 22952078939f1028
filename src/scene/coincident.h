/* SPDX-License-Identifier: MIT */
/* Coincident facets have the same three points, with either winding. Of all facets on the same
   three points exactly one is seen from any direction, and it alone hides what is behind them. */
#ifndef LRCSI_COINCIDENT_H
#define LRCSI_COINCIDENT_H

#include "scene/prepared.h"

/* Fills p->redundant and p->opposite; facets of curved shapes are not redundant and have no
   opposite. Given: the topology, and p->redundant of skipped facets. Status: LRCS_OK;
   LRCS_E_MEMORY. Work: at most lrcsi_coincident_need bytes; p->opposite stays in use unless it is
   NULL. Linear time. */
size_t lrcsi_coincident_need(uint32_t vertex_count, uint32_t facet_count);
int lrcsi_coincident_mark(lrcs_prepared *p, lrcs_work *work);

/* Completes the contacts, for which only the first facet of each opposite pair was searched: the
   second facet gets a copy of the list of the first, and in every list a facet is followed by its
   opposite. Given: p->intersections, the last block taken from the work area. Status: LRCS_OK;
   LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 entries). Linear time. */
int lrcsi_coincident_contacts(lrcs_prepared *p, lrcs_work *work);

#endif
