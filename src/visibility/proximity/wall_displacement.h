/* SPDX-License-Identifier: MIT */
/* The displacement of the points of a straight wall from their images on its facets, along a line
   in a view: on average it is far smaller than at a single point. */
#ifndef LRCSI_WALL_DISPLACEMENT_H
#define LRCSI_WALL_DISPLACEMENT_H

#include "visibility/proximity/event_band.h"

/* The component D, along a unit vector of the view plane, of x - y, where y is a point of a facet
   and x the point of the true wall that the map relates to it, both in projection. Lengths are
   scaled. */
typedef struct lrcsi_wall_displacement {
    double area, error; /* the integral of D over the points y above a segment of the view plane */
    double size;        /* an upper bound of that of |D| */
    double slope;       /* D at two points of the facet's plane differs by at most this times their
                           distance in projection */
} lrcsi_wall_displacement;

/* Given: a facet on the straight wall of a part that is placed without distortion; the
   segment from a to b, in the facet's projection or close to it; a bound on the error of
   positions; the unit vector. Returns 0 if no bound is known. */
int lrcsi_wall_displacement_make(const lrcsi_event_bands *bands, uint32_t facet, const double a[2],
                                 const double b[2], double position_err, const double along[2],
                                 lrcsi_wall_displacement *displacement);

#endif
