/* SPDX-License-Identifier: MIT */
/* The frame of a facet that is a needle in the view: the barycentric coordinates of its second and
   third corner, counted counter-clockwise. Its corners are (0, 0), (1, 0) and (0, 1), so that in
   this frame it is as wide as it is long. Computed in double-double: rounding errors are a fraction
   of the needle's width, not of its length. */
#ifndef LRCSI_NEEDLE_H
#define LRCSI_NEEDLE_H

#include "base/dd.h"
#include "view/view.h"

typedef struct lrcsi_needle {
    const double *origin; /* the first corner */
    lrcsi_dd side[2][3];  /* from there to the other corners, exactly */
    lrcsi_dd row[2][3];   /* a coordinate is row . (x - origin) / whole */
    lrcsi_dd whole;
    const double *direction;
    double length; /* |direction| */
    double reach;  /* upper bound of the sides from the origin */
    double off; /* error of the coordinates of a point, divided by its distance from the origin */
    double corner[2][2]; /* the other corners relative to the first in the view plane, rounded */
} lrcsi_needle;

/* Given: the corners of a facet as scene points, and in its frame (corner, reach:
   visibility/target.h). Returns 1 and the frame if the facet is a needle in the view; 0 if it is
   not, or if it is too thin for double-double. */
int lrcsi_needle_make(const lrcsi_view *view, const double *const point[3],
                      const double corner[3][2], double reach, lrcsi_needle *needle);

/* A scene point in the frame. Returns the position error. */
double lrcsi_needle_coordinates(const lrcsi_needle *needle, const double x[3], lrcsi_dd out[2]);

/* Clips a segment of the frame to the box -1 .. 2, which extends beyond the facet by 1 on all
   sides. Returned: the ends, and their parameters along the segment; outside the box both ends are
   the box's corner (2, 2). */
void lrcsi_needle_clip(const lrcsi_dd from[2], const lrcsi_dd to[2], double end[2][2],
                       lrcsi_dd part[2]);

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

/* a / b, within 20 u^2. */
lrcsi_dd lrcsi_needle_quotient(lrcsi_dd a, lrcsi_dd b);

#endif
