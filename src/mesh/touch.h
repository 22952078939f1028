/* SPDX-License-Identifier: MIT */
/* Which facets touch the inside of which others, in space: interpenetration, T-contacts,
   coincident coplanar facets. It does not depend on direction; visibility may change across such
   contacts although no contour is near. Every decision is exact. */
#ifndef LRCSI_TOUCH_H
#define LRCSI_TOUCH_H

#include "mesh/topology.h"

enum lrcsi_touch_kind {
    LRCSI_TOUCH_NONE = -1,   /* no contact */
    LRCSI_TOUCH_CROSS = 0,   /* not in one plane: `other` meets the open inside of `facet` */
    LRCSI_TOUCH_COPLANAR = 1 /* exactly in one plane, and their open insides overlap */
};

/* `other` (closed) meets the relative interior of `facet`. Directed: a strut standing on a plate
   touches the plate's inside, but the plate only the strut's rim: then there is an entry for the
   plate alone. */
typedef struct lrcsi_touch {
    uint32_t other;
    uint32_t kind;
} lrcsi_touch;

typedef struct lrcsi_touches {
    uint32_t *first;    /* facet_count + 1: entries of facet i are touch[first[i] .. first[i+1]) */
    lrcsi_touch *touch; /* by facet, then by other */
    uint32_t count;
    unsigned char *rim; /* facet: 1 where another touches its inside, or meets its rim other than in
                           one of its corners or along a side that both have */
    int self; /* a facet meets the inside or a side of another of its own piece; 0 if not asked */
} lrcsi_touches;

/* How many contacts a facet has. */
static inline uint32_t lrcsi_touches_of(const lrcsi_touches *touches, uint32_t facet)
{
    return touches->first[facet + 1] - touches->first[facet];
}

/* How `other` (closed) meets the relative interior of `facet`: a lrcsi_touch_kind. Neither may be
   degenerate. */
int lrcsi_touch_pair(const lrcs_point *vertex, lrcs_facet facet, lrcs_facet other);

/* Finds all of them. Facets marked in `skip` (degenerate, omitted) neither touch nor are touched.
   `piece`, unless NULL, names the piece of surface that each facet belongs to: then `self` is told
   also. Inside a side: a corner of one facet on a side of the other, ends excluded, of which no
   contact in the sense above need come.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 entries).
   Work: near linear on ordinary meshes, quadratic where everything overlaps everything. The
   result stays in the work area, scratch does not; lrcsi_touches_need bytes serve up to `count`
   entries. */
size_t lrcsi_touches_need(uint32_t vertex_count, uint32_t facet_count, size_t count);
int lrcsi_touches_make(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                       uint32_t facet_count, const lrcsi_topology *topology,
                       const unsigned char *skip, const uint32_t *piece, lrcs_work *work,
                       lrcsi_touches *touches);

#endif
