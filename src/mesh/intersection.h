/* SPDX-License-Identifier: MIT */
/* Which facets touch the inside of which others, in space: interpenetration, T-contacts,
   coincident coplanar facets. It does not depend on direction; visibility may change across such
   contacts although no contour is near. Every decision is exact. */
#ifndef LRCSI_INTERSECTION_H
#define LRCSI_INTERSECTION_H

#include "mesh/intersection_pair.h"
#include "mesh/topology.h"

/* `other` (closed) meets the relative interior of `facet`. Directed: a strut standing on a plate
   touches the plate's inside, but the plate only the strut's rim: then there is an entry for the
   plate alone. */
typedef struct lrcsi_intersection {
    uint32_t other;
    uint32_t kind;
} lrcsi_intersection;

typedef struct lrcsi_intersections {
    uint32_t *first; /* facet_count + 1: entries of facet i are touch[first[i] .. first[i+1]) */
    lrcsi_intersection *touch; /* by facet, then by other */
    uint32_t count;
    unsigned char *rim; /* facet: not 0 if another touches its inside, or meets its rim other
                           than in one of its corners or along a side that both have; then also a
                           bit for each of its sides (lrcsi_intersection_along) */
    int self; /* a facet meets the inside or a side of another of its own piece; 0 if not asked */
} lrcsi_intersections;

/* How many contacts a facet has. */
static inline uint32_t lrcsi_intersection_of(const lrcsi_intersections *intersections,
                                             uint32_t facet)
{
    return intersections->first[facet + 1] - intersections->first[facet];
}

/* Does side k of a facet, from its corner k to k + 1, have more than a point in common with a side
   of another, but not both ends? */
static inline int lrcsi_intersection_along(const lrcsi_intersections *intersections, uint32_t facet,
                                           int k)
{
    return (intersections->rim[facet] >> (k + 1) & 1) != 0;
}

/* Finds all of them. Facets marked in `skip` (degenerate, omitted) neither touch nor are touched.
   `piece`, unless NULL, names the piece of surface that each facet belongs to: then `self` is told
   also. Inside a side: a corner of one facet on a side of the other, ends excluded, of which no
   contact in the sense above need come.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 entries).
   Work: near linear on ordinary meshes, quadratic where everything overlaps everything. The
   result stays in the work area, scratch does not; lrcsi_intersection_need bytes serve up to
   `count` entries. */
size_t lrcsi_intersection_need(uint32_t vertex_count, uint32_t facet_count, size_t count);
int lrcsi_intersection_make(const lrcs_point *vertex, uint32_t vertex_count,
                            const lrcs_facet *facet, uint32_t facet_count,
                            const lrcsi_topology *topology, const unsigned char *skip,
                            const uint32_t *piece, lrcs_work *work,
                            lrcsi_intersections *intersections);

#endif
