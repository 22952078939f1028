/* SPDX-License-Identifier: MIT */
/* The visible area of each facet, projected, with its bounds: the result of visibility for
   integration, whichever method found it. Here: areas without shadows, areas that queries decide,
   and areas from the samples of a z-buffer. */
#ifndef LRCSI_VISIBLE_H
#define LRCSI_VISIBLE_H

#include <math.h>

#include "visibility/decisions.h"
#include "visibility/raster.h"
#include "visibility/visible_area.h"

/* The area of a facet that nothing is known to hide: all of it. This is proved for |cos(theta)| >
   grazing_cos. Otherwise, and for every facet if grazing_cos is 1, the area is only an upper bound,
   and low is 0. */
static inline lrcsi_visible_area lrcsi_visible_area_unshadowed(const lrcsi_incidence *incidence,
                                                               double grazing_cos)
{
    double low = fabs(incidence->cos_theta) > grazing_cos ? incidence->projected : 0;
    return (lrcsi_visible_area){incidence->projected, low, incidence->projected, 0, 0};
}

/* A visible area, corrected for back sides. In a scene that is closed and outward they are never
   visible: there a search that did not find one hidden does not prove that it is visible. */
static inline lrcsi_visible_area lrcsi_visible_area_proved(const lrcsi_view *view, uint32_t facet,
                                                           lrcsi_visible_area visible)
{
    visible.low = view->prepared->solid && view->facing[facet] < 0 ? 0 : visible.low;
    return visible;
}

/* Sets visible[facet] to all of the facet or nothing, by its lrcsi_query_answer; does not change it
   if that is undecided. */
void lrcsi_visible_areas_from_answers(const lrcsi_view *view, const unsigned char *answer,
                                      lrcsi_visible_area *visible);

/* Bytes for lrcsi_visible_areas_from_samples, at most. */
size_t lrcsi_visible_areas_need(const lrcs_prepared *prepared, uint32_t size);

/* Finds visible areas by exact decisions and samples. A uniform facet has its exact projected area,
   or 0. The area of an undecided facet follows from the fraction of its samples that it owns,
   within the bounds that follow from the pixels in which its visibility does not change. Only the
   tiles around undecided facets are drawn. *undecided: 1 if the depth order of some facets could
   not be decided, or the query of a uniform facet had no answer; else 0.
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area. */
int lrcsi_visible_areas_from_samples(lrcsi_decisions *decisions, uint32_t size, lrcs_work *work,
                                     lrcsi_raster *raster, lrcsi_visible_area *visible,
                                     int *undecided);

#endif
