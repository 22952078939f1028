/* SPDX-License-Identifier: MIT */
/* The extent of each part of a scene, and which parts have closed forms. A view uses this to prove
   that nothing hides a part (view/clear.h). It does not depend on direction. */
#ifndef LRCSI_EXTENT_H
#define LRCSI_EXTENT_H

#include "scene/prepared.h"

/* Bytes that lrcsi_extents_make takes; 0 if no shape has a closed form. */
size_t lrcsi_extents_need(const lrcs_scene *scene);

/* Fills prepared->extent[part_count], in the work area, or leaves it NULL if no shape has a closed
   form. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_extents_make(lrcs_prepared *prepared, lrcs_work *work);

#endif
