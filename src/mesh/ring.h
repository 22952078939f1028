/* SPDX-License-Identifier: MIT */
/* Rings of facets about vertices, proved to be without self-contact, one proof a vertex. */
#ifndef LRCSI_RING_H
#define LRCSI_RING_H

#include "mesh/topology.h"

/* Upper bound of the scratch that lrcsi_rings_prove takes. */
size_t lrcsi_rings_need(uint32_t vertex_count);

/* Marks the points (topology->weld) about which the facets are proved to meet each other in nothing
   but the point and the sides that two of them have in common. Facets marked in `skip` (which may
   be NULL) are left out.
   Returned: proved[vertex_count]; apex[facet], unless apex is NULL: of a facet's corners, the
   point with the most facets of those that have at least 32, a proved one before others; LRCS_NONE
   where there is none. Status: LRCS_OK;
   LRCS_E_MEMORY. Nothing stays in the work area. Linear time. */
int lrcsi_rings_prove(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                      uint32_t facet_count, const lrcsi_topology *topology,
                      const unsigned char *skip, lrcs_work *work, unsigned char *proved,
                      uint32_t *apex);

#endif
