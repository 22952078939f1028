/* SPDX-License-Identifier: MIT */
/* Where each part of a scene stands, and which parts have closed forms: what a view needs to prove
   that nothing hides a part (view/clear.h). It does not depend on direction. */
#ifndef LRCSI_EXTENT_H
#define LRCSI_EXTENT_H

#include "scene/prepared.h"

/* Bytes; 0 where no shape has a closed form. */
size_t lrcsi_extents_need(const lrcs_scene *scene);

/* Fills prepared->extent[part_count], in the work area, or leaves NULL where no shape has a closed
   form. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_extents_make(lrcs_prepared *prepared, lrcs_work *work);

#endif
