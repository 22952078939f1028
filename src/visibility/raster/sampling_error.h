/* SPDX-License-Identifier: MIT */
/* An estimate of the error of areas that are counted in samples. It is heuristic: not a bound. */
#ifndef LRCSI_SAMPLING_ERROR_H
#define LRCSI_SAMPLING_ERROR_H

#include "visibility/raster/raster.h"
#include "visibility/uniform/classify.h"

/* Estimates in pixels: twice the root mean square of the errors, so that few errors exceed them.
   The errors of different facets are independent, except those along one edge, which have the same
   sign. The estimate for many facets is therefore the root of (the sum of `square` + the square of
   the sum of `bias`). */
typedef struct lrcsi_sampling_error {
    double square;
    double bias; /* signed: positive if the sampled area is too large */
} lrcsi_sampling_error;

/* For an undecided facet.
   Given: the surface component of each facet; the raster; the event edges that cross the facet. */
lrcsi_sampling_error lrcsi_sampling_error_facet(const uint32_t *component,
                                                const lrcsi_raster *raster, uint32_t facet,
                                                const lrcsi_crossings *crossings);

/* For a facet whose samples are pooled with those of its neighbours
   (visibility/raster/visible_fraction.h). Given: its longest side, in pixels; fraction, the visible
   fraction of all those samples. */
lrcsi_sampling_error lrcsi_sampling_error_pooled(const lrcsi_raster *raster, uint32_t facet,
                                                 double longest, double fraction);

#endif
