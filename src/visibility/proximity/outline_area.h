/* SPDX-License-Identifier: MIT */
/* The area in a view between the outline of a true curved shape and an edge of its facets. */
#ifndef LRCSI_OUTLINE_AREA_H
#define LRCSI_OUTLINE_AREA_H

#include "visibility/proximity/outline.h"

/* Upper bounds of the areas in projection, along one edge, where points y may be gained and lost,
   and of the distances of such points from the edge. `width` times delta is to be added to the
   areas, LRCSI_ROOT_2_OUTWARD times delta to the distances. If nothing is known, these four are
   infinite, and width is 0. */
typedef struct lrcsi_outline_areas {
    double gain, loss;
    double gain_depth, loss_depth;
    double width;
} lrcsi_outline_areas;

/* Given: a contour edge of the part from a to b in view coordinates; the side of its facets, 1 left
   and -1 right. */
lrcsi_outline_areas lrcsi_outline_areas_make(const lrcsi_outline *outline, const double a[3],
                                             const double b[3], int side);

/* The signed area in projection between such an edge, or a part of it, and the outline of the true
   solid over it: positive where the facets reach farther than the solid. */
typedef struct lrcsi_outline_margin {
    double area, error;  /* infinite error: not known */
    double width;        /* times an error of the outline's position: to be added to the error */
    double depth;        /* an upper bound of the difference of the largest and the least depth of
                           the outline beside that part, or of 0 */
    double end_depth[2]; /* upper bounds of the distance between outline and edge in projection, up
                            to 2 k before and behind the ends a and b; if a part is given, they may
                            be much larger than for the whole edge */
} lrcsi_outline_margin;

/* Given: as above; the part of the edge, as fractions of the way from a to b: from L <= t <= to L
   in the terms of outline_area.c. */
lrcsi_outline_margin lrcsi_outline_margin_make(const lrcsi_outline *outline, const double a[3],
                                               const double b[3], int side, double from, double to);

#endif
