/* SPDX-License-Identifier: MIT */
/* A mesh's blocks in the work area. */
#ifndef LRCSI_STORE_H
#define LRCSI_STORE_H

#include <lrcs/mesh.h>

/* Allocates a mesh's blocks for these counts, the vertices last, so that a reader that welds can
   release the rest of them. Materials, parts and facets are cleared: no material (LRCS_NONE), part
   0, hard, no normals. `text` is where counts->text_bytes of names may be written. Status: LRCS_OK;
   LRCS_E_MEMORY (nothing taken). */
int lrcsi_store_take(const lrcs_mesh_counts *counts, lrcs_work *work, lrcs_mesh *mesh, char **text);

#endif
