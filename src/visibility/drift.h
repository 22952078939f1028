/* SPDX-License-Identifier: MIT */
/* How far samples are likely to misjudge the area of a facet that is seen in part: a guess from the
   pixels of the run, not a bound. */
#ifndef LRCSI_DRIFT_H
#define LRCSI_DRIFT_H

#include "visibility/contest.h"
#include "visibility/raster.h"

/* In pixels: twice what errors are in the root mean square, so that few are above it. Errors of
   different facets add up by chance, but for those along one edge, which lean one way: of many
   facets the guess is the root of the sum of `square` and of the square of the sum of `lean`. */
typedef struct lrcsi_drift {
    double square;
    double lean; /* signed: too much is positive */
} lrcsi_drift;

/* Given: contest and raster of one view; a contested facet; contest->crossing holding the event
   edges that cross it, so many. */
lrcsi_drift lrcsi_drift_facet(const lrcsi_contest *contest, uint32_t crossings,
                              const lrcsi_raster *raster, uint32_t facet);

/* A facet of the longest side given, in pixels, that shares its samples with its neighbours
   (visibility/share.h), of whose samples together that share is seen. */
lrcsi_drift lrcsi_drift_row(const lrcsi_raster *raster, uint32_t facet, double longest,
                            double share);

#endif
