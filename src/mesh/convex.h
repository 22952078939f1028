/* SPDX-License-Identifier: MIT */
/* Proof that a facet mesh is the boundary of a convex body, facing outward. */
#ifndef LRCSI_CONVEX_H
#define LRCSI_CONVEX_H

#include "mesh/topology.h"

/* Upper bound of the scratch that lrcsi_convex_prove takes. */
size_t lrcsi_convex_need(uint32_t vertex_count, uint32_t facet_count);

/* Sets *convex to 1 if the facets of positive area are exactly the boundary of one convex body
   (coplanar facets allowed), counter-clockwise seen from outside; else to 0: open, in several
   shells, inverted, flat, folded onto itself, wound more than once. Nothing stays in the work
   area. Status: LRCS_OK; LRCS_E_MEMORY. Linear time. */
int lrcsi_convex_prove(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                       uint32_t facet_count, const lrcsi_topology *topology, lrcs_work *work,
                       int *convex);

#endif
