/* SPDX-License-Identifier: MIT */
/* The facets of a prepared scene as a structure of arrays, those of one material side by side: what
   is computed for every facet of a view reads it block by block, many facets at once. */
#ifndef LRCSI_BATCH_H
#define LRCSI_BATCH_H

#include <lrcs/run.h>

#include "base/elementary.h"

/* Facets that are not skipped, by material and in facet order within one. A block may be read
   anywhere: LRCSI_LANES places beyond the last hold zeros. */
typedef struct lrcsi_batches {
    uint32_t count;
    uint32_t *first;   /* material i: places first[i] .. first[i + 1] */
    uint32_t *facet;   /* at each place */
    double *normal[3]; /* unit; component k is off by at most 1.01 u of itself */
    double *area;      /* S, scaled; relative error at most 3 u */
    int redundant;     /* some are, on one side at least */
} lrcsi_batches;

/* Given: the scene's normals, and which facets are skipped or redundant. Status: LRCS_OK;
   LRCS_E_MEMORY. Work: lrcsi_batches_need, all of which stays. */
size_t lrcsi_batches_need(const lrcs_scene *scene);
int lrcsi_batches_make(lrcs_prepared *p, lrcs_work *work);

#endif
