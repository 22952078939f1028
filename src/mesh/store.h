/* SPDX-License-Identifier: MIT */
/* A mesh's blocks in the work area, and the slots of the table by which STL vertices are welded. */
#ifndef LRCSI_STORE_H
#define LRCSI_STORE_H

#include <lrcs/mesh.h>

/* Allocates a mesh's blocks for these counts, the vertices last, so that a reader that welds can
   release the rest of them. Materials, parts and facets are cleared: no material (LRCS_NONE), part
   0, hard, no normals. `text` is where counts->text_bytes of names may be written. Status: LRCS_OK;
   LRCS_E_MEMORY (nothing taken). */
int lrcsi_store_take(const lrcs_mesh_counts *counts, lrcs_work *work, lrcs_mesh *mesh, char **text);

/* The number of slots of an open-addressing table for `count` entries: a power of two, at least 2
   count (SIZE_MAX if there is none). */
size_t lrcsi_store_slots(size_t count);

/* Spreads 64 bits over all of them: an entry's first slot is lrcsi_store_mix(key) & (slots - 1). */
static inline uint64_t lrcsi_store_mix(uint64_t key)
{
    /* splitmix64's finaliser (Stafford 2011, variant 13) */
    key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9u;
    key = (key ^ key >> 27) * 0x94d049bb133111ebu;
    return key ^ key >> 31;
}

/* The position of a name's bytes in the input. */
typedef struct lrcsi_span {
    size_t at, size;
} lrcsi_span;

#endif
