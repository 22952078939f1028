/* SPDX-License-Identifier: MIT */
/* The depth order of two parts: which lies behind the other, as seen by the laser, because a plane
   separates them: the deck behind a tank that stands on it, a mast behind the tank beside it.
   What is behind hides nothing of what is in front, neither in truth nor by facets, however close
   the two are; and it is hidden exactly where its projection lies in that of the part in front. */
#ifndef LRCSI_DEPTH_ORDER_H
#define LRCSI_DEPTH_ORDER_H

#include "view/separation.h"

/* What is proved of one of the two parts, except for its points at which n . x < level: where both
   parts touch the plane to within rounding. */
typedef struct lrcsi_order_proof {
    int known; /* 0: nothing is proved */
    double n[3], level;
    double slab; /* a bound on the area with such points of any one sector of its true curved
                    surface */
} lrcsi_order_proof;

typedef struct lrcsi_depth_order {
    lrcsi_order_proof front_is_free;   /* the part behind hides nothing of the part in front */
    lrcsi_order_proof back_by_outline; /* the part in front hides a point of the part behind if and
                                 only if the point's projection lies in that of the part in front */
} lrcsi_depth_order;

/* Given: two parts, the unit vector d to the laser. It tries planes perpendicular to the axes of
   both; to the line between their centres, as it is and without its component along either axis;
   and to d. */
lrcsi_depth_order lrcsi_depth_order_make(const lrcsi_body *front, const lrcsi_body *back,
                                         const double d[3]);

/* An upper bound of the fraction of a facet of that part, and of its patch, for which the proof
   does not hold; 0 for most facets. */
double lrcsi_order_unproved(const lrcsi_order_proof *proof, const lrcs_prepared *prepared,
                            uint32_t facet);

#endif
