/* SPDX-License-Identifier: MIT */
/* The visible area of a facet with its bounds, and the moment of its visible region. */
#ifndef LRCSI_VISIBLE_AREA_H
#define LRCSI_VISIBLE_AREA_H

/* Projected areas in scaled units. Except for rounding, 0 <= low <= area <= high <= the facet's
   projected area. The true area is between low and high. */
typedef struct lrcsi_visible_area {
    double area, low, high;
    double error_estimate; /* estimated error of an area from samples; else 0 */
    double bias; /* the part of that error that has a sign: positive if the area is too large */
} lrcsi_visible_area;

/* An area without uncertainty: that of a facet known to be entirely visible; or 0, if it is hidden.
 */
static inline lrcsi_visible_area lrcsi_visible_area_exact(double area)
{
    return (lrcsi_visible_area){.area = area, .low = area, .high = area};
}

/* The first moment of a facet's visible region: the integral of x - c over its projection, c the
   facet's centroid in the view plane. 0 for a facet that is entirely visible or hidden. */
typedef struct lrcsi_moment {
    double first[2];
    double error; /* bound on the error of either component; HUGE_VAL: the moment is not known */
    double reach; /* scratch of its computation: the largest distance from c of what is visible */
} lrcsi_moment;

#endif
