/* SPDX-License-Identifier: MIT */
/* The facets of a prepared scene as a structure of arrays, sorted by material. Computations over
   every facet of a view process it in packets, many facets at once. */
#ifndef LRCSI_BATCH_H
#define LRCSI_BATCH_H

#include "scene/prepared.h"

/* Fills p->batches, and p->normal of every facet. Given: p->skip, p->redundant, and the memory of
   p->normal. Status: LRCS_OK; LRCS_E_MEMORY. Work: lrcsi_batches_need bytes, which stay in use. */
size_t lrcsi_batches_need(const lrcs_scene *scene);
int lrcsi_batches_make(lrcs_prepared *p, lrcs_work *work);

#endif
