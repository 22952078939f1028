/* SPDX-License-Identifier: MIT */
/* How far samples are likely to misjudge the area of a facet that is seen in part: a guess from the
   pixels of the run, not a bound. */
#ifndef LRCSI_SAMPLING_ERROR_H
#define LRCSI_SAMPLING_ERROR_H

#include "visibility/classify.h"
#include "visibility/raster.h"

/* In pixels: twice what errors are in the root mean square, so that few are above it. Errors of
   different facets add up by chance, but for those along one edge, which share a sign: of many
   facets the guess is the root of the sum of `square` and of the square of the sum of `bias`. */
typedef struct lrcsi_sampling_error {
    double square;
    double bias; /* signed: too much is positive */
} lrcsi_sampling_error;

/* Of an undecided facet. Given: the component of each facet, the raster, and the event edges that
   cross the facet (of the topology). */
lrcsi_sampling_error lrcsi_sampling_error_facet(const uint32_t *component,
                                                const lrcsi_raster *raster, uint32_t facet,
                                                const uint32_t *crossing, uint32_t crossings);

/* A facet of the longest side given, in pixels, that shares its samples with its neighbours
   (visibility/visible_fraction.h), of whose samples together that share is seen. */
lrcsi_sampling_error lrcsi_sampling_error_row(const lrcsi_raster *raster, uint32_t facet,
                                              double longest, double share);

#endif
