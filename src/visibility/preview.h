/* SPDX-License-Identifier: MIT */
/* Visible areas at the cost of a raster, for answers that need no proof: an item buffer of N x N
   samples at pixel centres, each owned by the facet nearest the laser there, exactly
   (visibility/sample.h); of each facet the share of its samples that it owns. Nothing is proved of
   the areas but that each lies between none and all of its facet; their likely error is told from
   the pixels where owners change. */
#ifndef LRCSI_PREVIEW_H
#define LRCSI_PREVIEW_H

#include "visibility/visible.h"

/* Bytes at most. */
size_t lrcsi_preview_need(const lrcs_prepared *prepared, uint32_t size);

/* Finds visible[facet_count] from size x size samples. *undecided: 1 if some depth could not be
 * decided, else 0. Status: LRCS_OK; LRCS_E_MEMORY. Nothing stays in the work area. */
int lrcsi_preview_make(const lrcsi_view *view, uint32_t size, lrcs_work *work,
                       lrcsi_visible *visible, int *undecided);

#endif
