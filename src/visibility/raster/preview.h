/* SPDX-License-Identifier: MIT */
/* Visible areas at the cost of drawing, for answers that are accepted by estimate: a z-buffer of
   N x N samples at pixel centres, whose owners are exact (visibility/raster/raster.h), and for each
   facet the fraction of its samples that it owns. The only bounds of the area of a facet are 0 and
   its whole projected area; the error is estimated from the pixels in which owners change. */
#ifndef LRCSI_PREVIEW_H
#define LRCSI_PREVIEW_H

#include "base/progress.h"
#include "visibility/base/visible_area.h"

/* Upper bound of bytes. */
size_t lrcsi_preview_need(const lrcs_prepared *prepared, uint32_t size);

/* Finds visible[facet_count] from size x size samples. *undecided: 1 if the depth order of some
   facets could not be decided, else 0. Status: LRCS_OK; LRCS_E_MEMORY. Nothing stays in the work
   area. */
int lrcsi_preview_make(const lrcsi_view *view, uint32_t size, lrcs_progress *progress,
                       lrcs_work *work, lrcsi_visible_area *visible, int *depth_undecided);

#endif
