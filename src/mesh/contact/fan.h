/* SPDX-License-Identifier: MIT */
/* Fans of facets around vertices, proved to be free of self-contact; one proof per vertex. */
#ifndef LRCSI_FAN_H
#define LRCSI_FAN_H

#include "mesh/topology.h"

/* Upper bound of the scratch that lrcsi_fans_prove takes. */
size_t lrcsi_fans_need(uint32_t vertex_count);

/* Marks the points (topology->weld) around which the facets are proved to meet each other only in
   the point itself and in sides that two of them have in common. Facets marked in `skip` (which may
   be NULL) are left out. Returned: proved[vertex_count]; apex[facet], unless apex is NULL: among
   the facet's corners that at least 32 facets share, the point with the most facets, preferring
   proved ones; LRCS_NONE if there is none. Status: LRCS_OK; LRCS_E_MEMORY. Nothing stays in the
   work area. Linear time. */
int lrcsi_fans_prove(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                     uint32_t facet_count, const lrcsi_topology *topology,
                     const unsigned char *skip, lrcs_work *work, unsigned char *proved,
                     uint32_t *apex);

#endif
