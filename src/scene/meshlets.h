/* SPDX-License-Identifier: MIT */
/* A meshlet is a few facets with consecutive indices. Most files list neighbouring facets one after
   another, so that the facets of a meshlet are usually close together and connected. A view can
   then process a whole meshlet at once. */
#ifndef LRCSI_MESHLETS_H
#define LRCSI_MESHLETS_H

#include <string.h>

#include "scene/prepared.h"

size_t lrcsi_meshlets_need(uint32_t facet_count);

/* Given a scene whose edges, neighbours and contacts are prepared. Status: LRCS_OK; LRCS_E_MEMORY.
   The result stays in the work area. Linear time. */
int lrcsi_meshlets_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_meshlets *meshlets);

/* Are all LRCSI_MESHLET_FACETS values of a meshlet equal? */
static inline int lrcsi_meshlet_alike(const signed char *value, uint32_t meshlet)
{
    uint64_t word[LRCSI_MESHLET_FACETS / sizeof(uint64_t)];
    memcpy(word, value + (size_t)meshlet * LRCSI_MESHLET_FACETS, sizeof word);
    return word[0] == word[1] && word[0] == (word[0] & 0xff) * 0x0101010101010101u;
}

#endif
