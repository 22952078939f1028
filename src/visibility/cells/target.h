/* SPDX-License-Identifier: MIT */
/* The target, a facet that may be hidden, and its frame in the view plane: the origin is one
   of its corners (lrcsi_target_frame_corner), the axes are those of the view. A needle, a facet
   that is much longer than wide in the view, has a second frame, of barycentric coordinates. */
#ifndef LRCSI_TARGET_H
#define LRCSI_TARGET_H

#include "base/dd.h"
#include "view/view.h"

/* The frame of a needle: the barycentric coordinates of its second and third corner, counted
   counter-clockwise. Its corners are (0, 0), (1, 0) and (0, 1), so that in this frame it is as wide
   as it is long. It is computed in double-double, so that rounding errors are in proportion to the
   needle's width, not to its length. */
typedef struct lrcsi_needle {
    const double *origin; /* its first corner: lrcsi_target_frame_corner */
    lrcsi_dd side[2][3];  /* the vectors from there to the other corners, exact */
    lrcsi_dd row[2][3];   /* a coordinate is row . (x - origin) / determinant */
    lrcsi_dd determinant;
    const double *direction;
    double length;       /* |direction| */
    double reach;        /* upper bound of the sides from the origin */
    double relative_err; /* error of the coordinates of a point, divided by its distance from the
                            origin */
    double corner[2][2]; /* the other corners relative to the first in the view plane, rounded */
} lrcsi_needle;

typedef struct lrcsi_target {
    const lrcsi_view *view;
    uint32_t facet;
    const double *origin; /* its first corner: lrcsi_target_frame_corner */
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
double lrcsi_target_unproject_err(const lrcsi_target *target);

/* The frame in which errors are small in proportion to the width of the facet: barycentric
   coordinates if it is a needle, otherwise the same frame. */
void lrcsi_target_refine(const lrcsi_target *target, lrcsi_needle *needle, lrcsi_target *refined);

/* From the refined frame to the frame along the view's axes, within 3 u of the reach. */
void lrcsi_target_to_axes(const lrcsi_target *refined, const double at[2], double out[2]);

/* Corner k of a facet, counted so that they run counter-clockwise in the view. */
const double *lrcsi_target_corner(const lrcsi_view *view, uint32_t facet, int k);

/* The same, counted from the corner that is the origin of the facet's frame: one that is not far
   from the bulk of the scene, if the facet has one. */
const double *lrcsi_target_frame_corner(const lrcsi_view *view, uint32_t facet, int k);

/* A scene point in the target's frame. Returns a distance, at most that of the point from the first
   corner, in space: the position error is at most 10 u of it. */
double lrcsi_target_coordinates(const lrcsi_target *target, const double x[3], double out[2]);

/* Removes the part of a segment that is far from the target.
   Given: end, in the frame, with errors of 10 u distance[0] and 10 u distance[1]. Returns a
   distance: the errors of both ends are then at most 10 u of it. */
double lrcsi_target_segment(const lrcsi_target *target, double end[2][2], const double distance[2]);

/* The point of the facet that is visible at `at`, a point of the frame, in barycentric coordinates,
   in the order of the facet's corners: each at least 0, their sum 1 within rounding. A corner gives
   exactly that corner; a point outside the facet gives a point of its boundary. The projection of
   the point is within 100 u of the reach of `at`; along the direction the error may be tan(theta)
   times as large. */
void lrcsi_target_weights(const lrcsi_target *target, const double at[2], double weight[3]);

/* --- needles ---------------------------------------------------------------------------------- */

/* Given: the corners of a facet as scene points, and in its frame (corner, reach). Returns 1 and
   the frame if the facet is a needle in the view; 0 if it is not, or if it is too thin for
   double-double. */
int lrcsi_needle_make(const lrcsi_view *view, const double *const point[3],
                      const double corner[3][2], double reach, lrcsi_needle *needle);

/* A scene point in the frame. Returns the position error. */
double lrcsi_needle_coordinates(const lrcsi_needle *needle, const double x[3], lrcsi_dd out[2]);

/* Clips a segment of the frame to the box -1 .. 2, which extends beyond the facet by 1 on all
   sides. Returned: the ends, and the interval of the segment's parameter between them; outside the
   box both ends are the box's corner (2, 2). */
void lrcsi_needle_clip(const lrcsi_dd from[2], const lrcsi_dd to[2], double end[2][2],
                       lrcsi_dd interval[2]);

/* The same for a segment between scene points. Returns the position error of both ends. */
double lrcsi_needle_segment(const lrcsi_needle *needle, const double p[3], const double q[3],
                            double end[2][2]);

/* The determinant of lrcsi_needle_side as a linear function, line[0] u + line[1] v + line[2].
   Returns its error bound for u and v between -2 and 2: if the value exceeds it in magnitude, its
   sign is exact. */
double lrcsi_needle_line(const lrcsi_needle *n, const double p[3], const double q[3],
                         double line[3]);

/* On which side of p -> q a point of the frame lies in the view: positive on the left. 0 if the
   sign is not certain; with `guess`, the computed value even then. */
double lrcsi_needle_side(const lrcsi_needle *needle, const double p[3], const double q[3],
                         const double at[2], int guess);

#endif
