/* SPDX-License-Identifier: MIT */
/* How much of each facet the laser sees: a projected area with its bounds, whichever method found
   it. This is what visibility hands to integration. */
#ifndef LRCSI_VISIBLE_H
#define LRCSI_VISIBLE_H

#include <math.h>

#include "visibility/raster.h"
#include "visibility/visible_area.h"

/* The area of a facet that nothing is known to hide: all of it is visible. This is proved for
   |cos(theta)| > grazing_cos; otherwise the area is an upper bound (low is 0), as for every facet
   if grazing_cos is 1. */
static inline lrcsi_visible lrcsi_visible_unshadowed(const lrcsi_incidence *incidence,
                                                     double grazing_cos)
{
    double low = fabs(incidence->cos_theta) > grazing_cos ? incidence->projected : 0;
    return (lrcsi_visible){incidence->projected, low, incidence->projected, 0, 0};
}

/* A visible area, with what is proved about back sides: in a scene that is closed and outward they
   are never visible, and a search for them that does not find them hidden proves nothing else. */
static inline lrcsi_visible lrcsi_visible_proved(const lrcsi_view *view, uint32_t facet,
                                                 lrcsi_visible visible)
{
    visible.low = view->prepared->solid && view->facing[facet] < 0 ? 0 : visible.low;
    return visible;
}

/* All or nothing of each facet, by its lrcsi_query_answer; visible[facet] stays as it is where that
   is undecided. */
void lrcsi_visible_answered(const lrcsi_view *view, const unsigned char *answer,
                            lrcsi_visible *visible);

/* Bytes for lrcsi_visible_known, at most. */
size_t lrcsi_visible_known_need(const lrcs_prepared *prepared);

/* Asks of uniform facets whether they are visible, of undecided ones whether they are hidden.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. What is known stays in the work area. */
int lrcsi_visible_known(lrcsi_classification *classification, lrcs_work *work, lrcsi_known *known);

/* Bytes for lrcsi_visible_sampled, at most. */
size_t lrcsi_visible_need(const lrcs_prepared *prepared, uint32_t size);

/* The hybrid of exact decisions and samples. A uniform facet has its exact projected area, or 0.
   The area of an undecided facet is the fraction of its samples that it owns, within the bounds
   that follow from the pixels in which visibility does not change. Only the tiles around undecided
   facets are drawn.
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area. */
int lrcsi_visible_sampled(const lrcsi_known *known, uint32_t size, lrcs_work *work,
                          lrcsi_raster *raster, lrcsi_visible *visible);

#endif
