/* SPDX-License-Identifier: MIT */
/* The outline of a true curved shape in a view, beside that of its facets: how much area lies
   between the two along an edge. It does not decide which facets the shape's shadow meets
   (visibility/proximity/proximity_band.h).

   Q is a part that the library makes, placed without distortion, and closed or with one flat
   opening; B is its true solid, a convex body, S^ the solid that its facets enclose, with flat
   openings closed, and k its Hausdorff distance (lrcs_part.hausdorff). In projection along the
   direction to the laser K is the image of B and K' that of S^. A line along that direction that
   meets B or S^ also meets the true surface or the facets: it cannot both enter and leave through
   the same opening. The boundary of K' consists of contour edges of Q, because only there the
   number of facets of S^ that face the laser above a point can fall to 0; and of rim edges, except
   where the opening faces the laser as the wall beside it does, or both face away.

   1. In front of a plane. Let P be a plane, and B and S^ in front of it: no point of them is behind
   it by more than e, and some point of B is in front of it by h. Then Q hides a point x of P if its
   projection lies in K, unless it is within e diameter(B) / h of the outside of K; and x only then.
   The same holds for the facets and K'. Proof: let B+ be the part of B in front of P. What lies on
   the ray of x lies in front of P, so Q hides x if and only if x lies in the projection of B+. The
   straight line from a point of B behind P to the point that is h in front of P meets P after at
   most e / (e + h) of its length. []

   2. Along an edge. Consider a contour edge of length L, and coordinates in projection: t along the
   edge, 0 .. L, and the depth, perpendicular to it, positive towards the facets of Q. Let y be a
   point of K' and x one outside K, or y a point outside K' and x one of K, at a distance of at most
   delta from each other, delta <= k. Then y is within k + delta of the boundary of K'. Let the edge
   be the one nearest to y.
   - Gain (y in K'): the nearest point of the boundary is on the edge, so 0 <= t <= L. Let q_j be
     points of the boundary of K, in order along it. Their polygon lies in K, so x is on the other
     side of it, and y no farther than delta from there: where the polygon's slope is at most 1,
     0 <= depth <= polygon(t) + sqrt(2) delta.
   - Loss (y outside K'): the nearest point may also be an end of the edge, so
     -2 k <= t <= L + 2 k. K lies within its tangents at the points q_j, so
     0 <= -depth <= -tangents(t) + sqrt(2) delta.
   The areas of these two regions are integrals over t of piecewise linear functions.

   The points q_j are support points: those of B that are farthest in a direction of the view plane.
   Their tangents are perpendicular to that direction. Here these directions are turned from the
   edge's outward normal to either side until the point is 2 k beyond the end of the edge. */
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
    double err; /* bound on the errors of points of the solid */
} lrcsi_outline;

lrcsi_outline lrcsi_outline_make(const lrcsi_view *view, uint32_t part);

/* Is a rim edge of the part, beside a facet with the given facing, surely inside K'? */
int lrcsi_outline_inside(const lrcsi_outline *outline, const lrcsi_view *view, int facing);

/* Is the solid in front of the plane of a flat facet that faces the laser? If so, *err bounds what
   1 leaves open, for B and S^ together: a distance in projection, at most k / 2, to be added to
   delta. */
int lrcsi_outline_in_front(const lrcsi_outline *outline, const lrcsi_view *view, uint32_t facet,
                           double *err);

/* Upper bounds of the areas of 2, in projection: gain and loss, to which `width` times delta is to
   be added. If nothing is known, gain and loss are infinite, and width is 0. */
typedef struct lrcsi_outline_areas {
    double gain, loss, width;
} lrcsi_outline_areas;

/* Given: a contour edge of the part from a to b in view coordinates; the side of its facets, 1 left
   and -1 right. */
lrcsi_outline_areas lrcsi_outline_areas_make(const lrcsi_outline *outline, const double a[3],
                                             const double b[3], int side);

#endif
