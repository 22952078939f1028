/* SPDX-License-Identifier: MIT */
/* A meshlet is a few facets with consecutive indices. Most files list neighbouring facets one after
   another, so that the facets of a meshlet are usually close together and connected. A view can
   then process a whole meshlet at once. */
#ifndef LRCSI_MESHLETS_H
#define LRCSI_MESHLETS_H

#include "base/outward.h"
#include "base/range.h"
#include "scene/prepared.h"

size_t lrcsi_meshlets_need(uint32_t facet_count);

/* Given a scene whose edges, neighbours and contacts are prepared. Status: LRCS_OK; LRCS_E_MEMORY.
   The result stays in the work area. Linear time. */
int lrcsi_meshlets_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_meshlets *meshlets);

/* The middle of a meshlet's box, rounded, and how far its points are from there at most along each
   axis. */
static inline void lrcsi_meshlet_middle(const lrcsi_meshlet *meshlet, double middle[3],
                                        double half[3])
{
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (meshlet->low[k] + meshlet->high[k]);
        half[k] =
            LRCSI_OUTWARD(2) * lrcsi_max(meshlet->high[k] - middle[k], middle[k] - meshlet->low[k]);
    }
}

/* What a view knows of each facet: -1, 0 or 1; and of each meshlet: the number that all of its
   facets have, or LRCSI_MESHLET_MIXED if they may differ. After the last facet there are zeros that
   fill its meshlet and count as its facets, and one more. */
enum { LRCSI_MESHLET_MIXED = 2 };
typedef struct lrcsi_facet_signs {
    signed char *facet, *meshlet;
} lrcsi_facet_signs;

size_t lrcsi_facet_signs_need(uint32_t facet_count);

/* The arrays, to be filled. Returns 0 if memory is missing. */
int lrcsi_facet_signs_take(uint32_t facet_count, lrcs_work *work, lrcsi_facet_signs *signs);

/* Fills those of meshlets, and the zeros, from those of the facets. */
void lrcsi_facet_signs_finish(uint32_t facet_count, lrcsi_facet_signs *signs);

void lrcsi_facet_signs_copy(uint32_t facet_count, const lrcsi_facet_signs *from,
                            lrcsi_facet_signs *to);

static inline void lrcsi_facet_signs_clear(lrcsi_facet_signs *signs, uint32_t facet)
{
    signs->facet[facet] = 0;
    signs->meshlet[facet / LRCSI_MESHLET_FACETS] = LRCSI_MESHLET_MIXED;
}

#endif
