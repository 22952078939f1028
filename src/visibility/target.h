/* SPDX-License-Identifier: MIT */
/* The facet that may be hidden, in its own frame of the view plane: relative to its first corner,
   view axes; a needle also in that of its shares (visibility/needle.h). */
#ifndef LRCSI_TARGET_H
#define LRCSI_TARGET_H

#include "view/view.h"
#include "visibility/needle.h"

typedef struct lrcsi_target {
    const lrcsi_view *view;
    uint32_t facet;
    const double *origin; /* its first corner */
    double corner[3][2];  /* counter-clockwise in the view */
    double reach;         /* largest distance, in space, of a corner from the first; of one far
                             behind it less: no corner is off by more than 10 u of it */
    double size;          /* largest coordinate of a corner, in space */
    double diameter;      /* its longest side in the view, upper bound */
    double perimeter;     /* in the view, upper bound */
    double position_err;  /* by which its corners may be off, but for 10 u reach */
    double unit;          /* the area of the view plane that is 1 in the frame */
    const lrcsi_needle *needle; /* whose frame it is; NULL: view axes */
} lrcsi_target;

void lrcsi_target_make(const lrcsi_view *view, uint32_t facet, lrcsi_target *target);

/* How far from a place of the frame of view axes, in the view, a point of the facet is that is put
   there by its corners' shares, its coordinates rounded. */
double lrcsi_target_lift_off(const lrcsi_target *target);

/* The same in the frame that its parts are distinguished in: of its shares, where it is a needle.
 */
void lrcsi_target_refine(const lrcsi_target *target, lrcsi_needle *needle, lrcsi_target *refined);

/* A point of the refined frame in that of the view axes, within 3 u of the reach. */
void lrcsi_target_unrefine(const lrcsi_target *refined, const double at[2], double out[2]);

/* Corner k of a facet, counted so that they run counter-clockwise in the view. */
const double *lrcsi_target_corner(const lrcsi_view *view, uint32_t facet, int k);

/* The same, counted from one that is not far away, if the facet has such: so a target's frame
   counts its own. */
const double *lrcsi_target_own(const lrcsi_view *view, uint32_t facet, int k);

/* A scene point in the target's frame; returns its distance, in space, from the first corner, or
   less: that of which it is off by 10 u. */
double lrcsi_target_place(const lrcsi_target *target, const double x[3], double out[2]);

/* Cuts off what a segment of the frame has far away, where the distances of its ends in space are
   `away` and each is off by 10 u of that. Returns the distance of which both are then off by
   10 u. */
double lrcsi_target_segment(const lrcsi_target *target, double end[2][2], const double away[2]);

/* The point of the facet that is seen at `at`, a point of the frame, as shares of the facet's
   corners in the facet's own order: each at least 0, their sum 1 but for rounding. At a corner of
   the frame exactly that corner; a point beyond the rim goes to the rim. Its projection is within
   100 u of the reach of `at`; along the direction that may be tan(theta) times as much. */
void lrcsi_target_weights(const lrcsi_target *target, const double at[2], double weight[3]);

#endif
