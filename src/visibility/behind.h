/* SPDX-License-Identifier: MIT */
/* Parts that lie behind another, as seen by the laser, because a face of either separates them: the
   deck behind a tank that stands on it, the bus behind its panels. What is behind hides nothing of
   what is in front, neither in truth nor by facets, however close the two are; and it is hidden
   exactly where its projection lies in that of the part in front. */
#ifndef LRCSI_BEHIND_H
#define LRCSI_BEHIND_H

#include "view/separation.h"

/* What is proved of one of the two parts, except for its points at which n . x < level: where both
   parts touch the plane to within rounding. */
typedef struct lrcsi_behind_proof {
    int known; /* 0: nothing is proved */
    double n[3], level;
    double slab; /* a bound on the area of its true curved surface with such points */
} lrcsi_behind_proof;

typedef struct lrcsi_behind {
    lrcsi_behind_proof front; /* the part behind hides nothing of the part in front */
    lrcsi_behind_proof back;  /* the part in front hides a point of the part behind if and only if
                                 the point's projection lies in that of the part in front */
} lrcsi_behind;

/* Given: two parts, the unit vector d to the laser. Tried are planes across the axes of both. */
lrcsi_behind lrcsi_behind_make(const lrcsi_body *front, const lrcsi_body *back, const double d[3]);

/* An upper bound of the fraction of a facet of that part, and of its patch, for which the proof
   does not hold; 0 for most facets. */
double lrcsi_behind_fraction(const lrcsi_behind_proof *proof, const lrcs_prepared *prepared,
                             uint32_t facet);

#endif
