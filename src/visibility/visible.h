/* SPDX-License-Identifier: MIT */
/* How much of each facet the laser sees: a projected area with its bounds, whichever method found
   it. This is what visibility hands to integration. */
#ifndef LRCSI_VISIBLE_H
#define LRCSI_VISIBLE_H

#include <math.h>

#include "visibility/contest.h"
#include "visibility/raster.h"

/* Projected areas in scaled units; 0 <= low <= area <= high <= the facet's projected area, but for
   rounding. The truth lies between low and high. */
typedef struct lrcsi_visible {
    double area, low, high;
    double likely; /* of a sampled area: its likely error; else 0 */
    double lean;   /* the part of it that has a sign, too much being positive */
} lrcsi_visible;

/* A facet that nothing is known to hide: all of it is visible, certainly so for |cos(theta)| >
   graze; below it the area is an upper bound (low is 0). graze = 1 makes every facet so. */
static inline lrcsi_visible lrcsi_visible_unshadowed(const lrcsi_tilt *tilt, double graze)
{
    double low = fabs(tilt->cos_theta) > graze ? tilt->projected : 0;
    return (lrcsi_visible){tilt->projected, low, tilt->projected, 0, 0};
}

#endif
