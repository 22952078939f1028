/* SPDX-License-Identifier: MIT */
/* A facet that may be hidden, in a frame of its own in the view plane: relative to its first
   corner, along the view's axes; for a needle also in barycentric coordinates
   (visibility/needle.h). */
#ifndef LRCSI_TARGET_H
#define LRCSI_TARGET_H

#include "view/view.h"
#include "visibility/needle.h"

typedef struct lrcsi_target {
    const lrcsi_view *view;
    uint32_t facet;
    const double *origin; /* the first corner */
    double corner[3][2];  /* counter-clockwise in the view */
    double reach;         /* the largest distance, in space, of a corner from the first (less for a
                             corner far behind it): position errors are at most 10 u of this */
    double size;          /* the largest component of a corner, in space */
    double diameter;      /* upper bound of the longest side in the view */
    double perimeter;     /* upper bound of the perimeter in the view */
    double position_err;  /* error of the corners' positions, in addition to 10 u reach */
    double unit;          /* the area in the view plane of a unit area of the frame */
    const lrcsi_needle *needle; /* the needle whose barycentric coordinates these are; NULL: the
                                   view's axes */
} lrcsi_target;

void lrcsi_target_make(const lrcsi_view *view, uint32_t facet, lrcsi_target *target);

/* Upper bound of the distance, in the view, between a point of the frame (view axes) and the point
   of the facet that lrcsi_target_weights gives for it, with rounded coordinates. */
double lrcsi_target_lift_err(const lrcsi_target *target);

/* The frame in which parts of the facet can be told apart: barycentric coordinates if it is a
   needle, otherwise the same frame. */
void lrcsi_target_refine(const lrcsi_target *target, lrcsi_needle *needle, lrcsi_target *refined);

/* From the refined frame to that of the view's axes, within 3 u of the reach. */
void lrcsi_target_unrefine(const lrcsi_target *refined, const double at[2], double out[2]);

/* Corner k of a facet, counted so that they run counter-clockwise in the view. */
const double *lrcsi_target_corner(const lrcsi_view *view, uint32_t facet, int k);

/* The same, counted from the corner at which the facet's frame begins: one that is not far away
   from the bulk of the scene, if the facet has one. */
const double *lrcsi_target_own(const lrcsi_view *view, uint32_t facet, int k);

/* A scene point in the target's frame. Returns a distance, at most that of the point from the first
   corner, in space: the position error is at most 10 u of it. */
double lrcsi_target_coordinates(const lrcsi_target *target, const double x[3], double out[2]);

/* Cuts off the part of a segment that is far away from the target.
   Given: end, in the frame, with errors of 10 u times away[0] and away[1]. Returns a distance: the
   errors of both ends are then at most 10 u of it. */
double lrcsi_target_segment(const lrcsi_target *target, double end[2][2], const double away[2]);

/* The point of the facet that is seen at `at`, a point of the frame, in barycentric coordinates, in
   the order of the facet's corners: each at least 0, their sum 1 to rounding. A corner gives
   exactly that corner; a point outside the facet gives a point of its boundary. The projection of
   the point is within 100 u of the reach of `at`; along the direction the error may be tan(theta)
   times as large. */
void lrcsi_target_weights(const lrcsi_target *target, const double at[2], double weight[3]);

#endif
