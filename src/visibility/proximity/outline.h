/* SPDX-License-Identifier: MIT */
/* The outline of a true curved shape in a view, beside that of its facets. It does not decide which
   facets the shape's shadow meets (visibility/proximity/proximity_band.h).

   Q is a part that the library makes, placed without distortion, and closed or with one flat
   opening. B is its true solid, a convex body, S^ the solid that its facets enclose, with flat
   openings closed, and k its Hausdorff distance (bounds.hausdorff). K and K' are the images of B
   and S^ in projection along the direction to the laser. For a point y, and x at a distance of at
   most delta from it in projection: y is gained if it is in K' and x not in K, and lost if x is in
   K and y not in K'. outline.c and
   outline_area.c prove what is claimed. */
#ifndef LRCSI_OUTLINE_H
#define LRCSI_OUTLINE_H

#include "mesh/shape/support.h"
#include "view/view.h"

/* A part's true solid, its opening closed. */
typedef struct lrcsi_outline {
    const lrcs_part *part;
    int known;           /* 0: the part has no outline here; the other fields are not set */
    int is_exact;        /* 1: along each of its edges K and K' coincide; of the other fields only k
                            and err are set */
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

/* The outline of a box or plate, of which the facets are the true surface, with a positive k. Other
   parts have none of this kind. */
lrcsi_outline lrcsi_outline_make_exact(const lrcsi_view *view, uint32_t part, double k);

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

#endif
