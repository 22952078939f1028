/* SPDX-License-Identifier: MIT */
/* The outline of a true curved shape in a view, beside that of its facets: how much area lies
   between the two along an edge. It does not decide which facets the shape's shadow meets
   (visibility/proximity/proximity_band.h).

   Q is a part that the library makes, placed without distortion, and closed or with one flat
   opening. B is its true solid, a convex body, S^ the solid that its facets enclose, with flat
   openings closed, and k its Hausdorff distance (bounds.hausdorff). K and K' are the images of B
   and S^ in projection along the direction to the laser. For a point y, and x at a distance of at
   most delta from it in projection: y is gained if it is in K' and x not in K, and lost if x is in
   K and y not in K'. outline.c proves what is claimed here. */
#ifndef LRCSI_OUTLINE_H
#define LRCSI_OUTLINE_H

#include "mesh/shape/support.h"
#include "view/view.h"

/* A part's true solid, its opening closed. */
typedef struct lrcsi_outline {
    const lrcs_part *part;
    int known;           /* 0: the part has no outline here; the other fields are not set */
    lrcsi_support solid; /* scaled */
    double vertex_ratio; /* vertex radius / true radius */
    double origin[3];    /* scaled */
    double centre[2], axis[3][2]; /* its origin and axes in view coordinates */
    double size;                  /* at least the solid's diameter */
    double k;
    double err;          /* bound on the errors of points of the solid */
    int is_cut;          /* 1: it is that of the part of the solid in front of a plane */
    double up[3], level; /* where up . x >= level, in the frame of the part */
} lrcsi_outline;

lrcsi_outline lrcsi_outline_make(const lrcsi_view *view, uint32_t part);

/* Is a rim edge of the part, beside a facet with the given facing, surely inside K'? */
int lrcsi_outline_inside(const lrcsi_outline *outline, const lrcsi_view *view, int facing);

/* Is the solid in front of the plane of a flat facet that faces the laser, from which the points
   that matter are no farther than plane_err? If so, Q hides exactly the points of the plane whose
   projection lies in K, and its facets those in K', except within a distance of *err in projection,
   at most k / 2, of the boundary: for B and S^ together, it is to be added to delta. */
int lrcsi_outline_in_front(const lrcsi_outline *outline, const lrcsi_view *view, uint32_t facet,
                           double plane_err, double *err);

/* If a closed solid is in front of such a plane in part, and far enough: the outline of that part.
   Of both B and S^ only what is in front of the plane counts, k is a bound on its Hausdorff
   distance, and Q hides exactly the points of the plane whose projection lies in the new K, except
   within a distance of *err, as above. Returns 0 if it is not. */
int lrcsi_outline_cut(const lrcsi_outline *outline, const lrcsi_view *view, uint32_t facet,
                      double plane_err, lrcsi_outline *cut, double *err);

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
   in the terms of outline.c. */
lrcsi_outline_margin lrcsi_outline_margin_make(const lrcsi_outline *outline, const double a[3],
                                               const double b[3], int side, double from, double to);

#endif
