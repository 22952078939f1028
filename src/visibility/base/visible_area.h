/* SPDX-License-Identifier: MIT */
/* The visible area of a facet, projected, with its bounds, and the moment of its visible region:
   the result of visibility for integration, whichever method found it. */
#ifndef LRCSI_VISIBLE_AREA_H
#define LRCSI_VISIBLE_AREA_H

#include <math.h>

#include "view/view.h"

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

/* The area of a facet that nothing is known to hide: all of it. This is proved for |cos(theta)| >
   grazing_cos. Otherwise, and for every facet if grazing_cos is 1, the area is only an upper bound,
   and low is 0. */
static inline lrcsi_visible_area lrcsi_visible_area_unshadowed(const lrcsi_incidence *incidence,
                                                               double grazing_cos)
{
    double low = fabs(incidence->cos_theta) > grazing_cos ? incidence->projected : 0;
    return (lrcsi_visible_area){incidence->projected, low, incidence->projected, 0, 0};
}

/* A visible area, corrected for back sides. Those of solid shells are never visible: that a search
   did not find one hidden does not prove that it is visible. */
static inline lrcsi_visible_area lrcsi_visible_area_proved(const lrcsi_view *view, uint32_t facet,
                                                           lrcsi_visible_area visible)
{
    const lrcs_prepared *p = view->prepared;
    int never = p->solid || p->redundant[facet] == LRCSI_REDUNDANT_IN_SOLID;
    visible.low = never && view->facing[facet] < 0 ? 0 : visible.low;
    return visible;
}

/* The first moment of a facet's visible region: the integral of x - c over its projection, c the
   facet's centroid in the view plane. 0 for a facet that is entirely visible or hidden. It is the
   moment of a region that differs from the visible one by a small area anywhere on the facet, up to
   errors of positions. */
typedef struct lrcsi_moment {
    double first[2];
    double area_err; /* bound on that area */
    double error;    /* bound on the error of either component, except for that of this area;
                        HUGE_VAL: the moment is not known */
} lrcsi_moment;

#endif
