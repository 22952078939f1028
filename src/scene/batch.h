/* SPDX-License-Identifier: MIT */
/* The facets of a prepared scene as a structure of arrays, those of one material side by side.
   Computations over every facet of a view read it block by block, many facets at once. */
#ifndef LRCSI_BATCH_H
#define LRCSI_BATCH_H

#include "scene/prepared.h"

/* Given: which facets are skipped or redundant, and memory for the normals of all, which are
   computed on the way. Status: LRCS_OK; LRCS_E_MEMORY. Work: lrcsi_batches_need, all of which
   stays. */
size_t lrcsi_batches_need(const lrcs_scene *scene);
int lrcsi_batches_make(lrcs_prepared *p, lrcs_work *work);

#endif
