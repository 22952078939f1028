/* SPDX-License-Identifier: MIT */
/* The frame of a facet that is a needle in the view: the shares of its second and third corner,
   counted counter-clockwise, so that its corners are (0, 0), (1, 0) and (0, 1) and it is as wide as
   it is long. Computed to double-double: what rounding may move is a part of the needle's width,
   not of its length. */
#ifndef LRCSI_NEEDLE_H
#define LRCSI_NEEDLE_H

#include "base/dd.h"
#include "view/view.h"

typedef struct lrcsi_needle {
    const double *origin; /* its first corner, */
    lrcsi_dd side[2][3];  /* and the others as seen from there, exactly */
    lrcsi_dd row[2][3];   /* a share is row . (x - origin) over the whole */
    lrcsi_dd whole;
    const double *direction;
    double length;       /* |direction| */
    double reach;        /* upper bound of the sides from the origin */
    double off;          /* by which the share of a point may be off, over its distance */
    double corner[2][2]; /* the others in the view plane, as seen from the first, rounded */
} lrcsi_needle;

/* Given a facet's corners as points of the scene and as seen from the first (corner, reach:
   visibility/target.h): 1 if it is a needle in the view, and then its frame; 0 if it is none, or
   one too thin for double-double. */
int lrcsi_needle_make(const lrcsi_view *view, const double *const point[3],
                      const double corner[3][2], double reach, lrcsi_needle *needle);

/* A scene point in the frame; returns by how much that may be off. */
double lrcsi_needle_place(const lrcsi_needle *needle, const double x[3], lrcsi_dd out[2]);

/* What a segment of the frame has in a box that reaches one beyond the facet on all sides, and from
   which share of it to which; a point in the box's corner, where it has nothing there. */
void lrcsi_needle_clip(const lrcsi_dd from[2], const lrcsi_dd to[2], double end[2][2],
                       lrcsi_dd part[2]);

/* The same of a segment between scene points; returns by how much it may be off. */
double lrcsi_needle_segment(const lrcsi_needle *needle, const double p[3], const double q[3],
                            double end[2][2]);

/* The same determinant as a line: line[0] u + line[1] v + line[2] has its sign at places with u and
   v between -2 and 2, where it exceeds in magnitude what is returned. */
double lrcsi_needle_line(const lrcsi_needle *n, const double p[3], const double q[3],
                         double line[3]);

/* On which side of p -> q, seen in the view, the point of the frame lies: positive on the left.
   0 if that is not sure, or, where a guess will do, where it is as good as on the line. */
double lrcsi_needle_side(const lrcsi_needle *needle, const double p[3], const double q[3],
                         const double at[2], int guess);

/* a / b, within 20 u^2. */
lrcsi_dd lrcsi_needle_quotient(lrcsi_dd a, lrcsi_dd b);

#endif
