/* SPDX-License-Identifier: MIT */
/* Parts that lie behind a face of another, as seen by the laser: the deck behind a tank that stands
   on it, the bus behind its panels. Such a part hides nothing of the other, neither in truth nor by
   facets, however close the two are. */
#ifndef LRCSI_BEHIND_H
#define LRCSI_BEHIND_H

#include "view/separation.h"

typedef struct lrcsi_behind {
    int known; /* 1: the part behind hides nothing of the part in front except, where both touch the
                  plane to within rounding, points at which n . x < level */
    double n[3], level;
    double slab; /* a bound on the area of the true curved surface with such points */
} lrcsi_behind;

/* Given: two parts, the unit vector d to the laser. Tried are planes across the axes of both. */
lrcsi_behind lrcsi_behind_make(const lrcsi_body *front, const lrcsi_body *back, const double d[3]);

/* An upper bound of the fraction of a facet of the part in front, and of its patch, that is hidden
   after all; 0 for most facets. */
double lrcsi_behind_fraction(const lrcsi_behind *behind, const lrcs_prepared *prepared,
                             uint32_t facet);

#endif
