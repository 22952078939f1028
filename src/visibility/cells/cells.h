/* SPDX-License-Identifier: MIT */
/* Visible areas by cells of the view plane: whatever lies behind a surface that covers a cell is
   culled there once, not facet by facet. */
#ifndef LRCSI_CELLS_H
#define LRCSI_CELLS_H

#include "base/progress.h"
#include "visibility/base/visible_area.h"
#include "visibility/uniform/classify.h"

/* Bytes at most. */
size_t lrcsi_cells_need(const lrcs_prepared *prepared);

/* Visible areas of the facets with wanted[facet] not 0, which must be able to hide others
   (lrcsi_view_casts). answer: of lrcsi_query_uniform; facets that it proves to be hidden are left
   out. NULL: none is known to be hidden. Returned: found[facet], 1 if the area of a wanted facet is
   found to 1e-12 of its projected area or 1e-15 of the square of the scene's extent, and is stored
   in visible[facet]; 0 otherwise: such facets are to be processed one by one. No area is found if
   memory does not suffice, only some if the meter is spent. Nothing stays in the work area. Unless
   NULL, moment[] gets the moments of the facets whose areas are found; it is all 0 at the
   beginning, and has no meaning for other facets at the end. */
void lrcsi_cells_areas(const lrcsi_classification *classification, lrcsi_meter *meter,
                       lrcs_progress *progress, lrcs_work *work, const unsigned char *answer,
                       const unsigned char *wanted, unsigned char *found,
                       lrcsi_visible_area *visible, lrcsi_moment *moment);

#endif
