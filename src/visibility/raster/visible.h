/* SPDX-License-Identifier: MIT */
/* Visible areas from exact decisions and the samples of a z-buffer. */
#ifndef LRCSI_VISIBLE_H
#define LRCSI_VISIBLE_H

#include "visibility/base/visible_area.h"
#include "visibility/raster/raster.h"
#include "visibility/uniform/decisions.h"

/* Bytes for lrcsi_visible_areas_from_samples, at most. */
size_t lrcsi_visible_areas_need(const lrcs_prepared *prepared, uint32_t size);

/* Finds visible areas by exact decisions and samples. A uniform facet has its exact projected area,
   or 0. The area of an undecided facet follows from the fraction of its samples that it owns,
   within the bounds that follow from the pixels in which its visibility does not change. Only the
   tiles around undecided facets are drawn. *depth_undecided: 1 if the depth order of some facets
   could not be decided, or the query of a uniform facet had no answer; else 0.
   Status: LRCS_OK; LRCS_E_MEMORY. Nothing stays in the work area. */
int lrcsi_visible_areas_from_samples(lrcsi_decisions *decisions, uint32_t size,
                                     lrcs_progress *progress, lrcs_work *work,
                                     lrcsi_visible_area *visible, int *depth_undecided);

#endif
