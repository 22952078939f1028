/* SPDX-License-Identifier: MIT */
/* Contacts between facets: which facets meet the interior of which others in space
   (interpenetration, T-junctions of surfaces, coplanar facets that overlap). Contacts do not depend
   on direction; visibility may change across them without a contour. Every decision is exact. */
#ifndef LRCSI_INTERSECTION_H
#define LRCSI_INTERSECTION_H

#include "mesh/contact/intersection_pair.h"
#include "mesh/topology.h"

/* A contact: `other`, with its boundary, meets the relative interior of `facet`. Contacts are
   directed: a strut whose end touches a plate meets the plate's interior, but the plate meets only
   the strut's boundary, so there is an entry for the plate alone. */
typedef struct lrcsi_intersection {
    uint32_t other;
    uint32_t kind;
} lrcsi_intersection;

typedef struct lrcsi_intersections {
    uint32_t *first; /* facet_count + 1: entries of facet i are entry[first[i] .. first[i+1]) */
    lrcsi_intersection *entry; /* by facet, then by other */
    uint32_t count;
    unsigned char *met; /* facet: not 0 if another facet meets it or a side of it, except in common
                           corners and along common sides; then also a bit for each of its sides
                           (lrcsi_intersection_along) */
} lrcsi_intersections;

/* Parts of a surface, each named by one of its facets. */
typedef struct lrcsi_shells {
    uint32_t *of;        /* facet: its shell; LRCS_NONE if it is in none */
    unsigned char *self; /* shell: 1 if a facet of it meets the interior or a side of another one of
                            it */
} lrcsi_shells;

/* How many contacts a facet has. */
static inline uint32_t lrcsi_intersection_of(const lrcsi_intersections *intersections,
                                             uint32_t facet)
{
    return intersections->first[facet + 1] - intersections->first[facet];
}

/* The contact of a facet with another one, or NULL. */
static inline const lrcsi_intersection *
lrcsi_intersection_find(const lrcsi_intersections *intersections, uint32_t facet, uint32_t other)
{
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        if (intersections->entry[i].other == other) {
            return &intersections->entry[i];
        }
    }
    return NULL;
}

/* Does side k of a facet, from its corner k to k + 1, overlap a side of another facet along a
   length, without being the same side? */
static inline int lrcsi_intersection_along(const lrcsi_intersections *intersections, uint32_t facet,
                                           int k)
{
    return (intersections->met[facet] >> (k + 1) & 1) != 0;
}

/* Finds all contacts. Facets marked in `skip` (degenerate, omitted) have none. Of `shells`, unless
   NULL, self[] is set where it becomes 1; that includes a corner of one facet on a side of another,
   ends excluded: that alone is no contact.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 entries).
   Work: almost linear on ordinary meshes, quadratic if all facets overlap each other. The result
   stays in the work area, and scratch memory is released; lrcsi_intersection_need bytes suffice for
   up to `count` entries. */
size_t lrcsi_intersection_need(uint32_t vertex_count, uint32_t facet_count, size_t count);
int lrcsi_intersection_make(const lrcs_point *vertex, uint32_t vertex_count,
                            const lrcs_facet *facet, uint32_t facet_count,
                            const lrcsi_topology *topology, const unsigned char *skip,
                            const lrcsi_shells *shells, lrcs_work *work,
                            lrcsi_intersections *intersections);

#endif
