/* SPDX-License-Identifier: MIT */
/* Normals of facets. */
#ifndef LRCSI_NORMAL_H
#define LRCSI_NORMAL_H

#include "scene/prepared.h"

/* Computes prepared->normal of the `count` facets listed. */
void lrcsi_normals_make(lrcs_prepared *prepared, const uint32_t *facet, uint32_t count);

#endif
