/* SPDX-License-Identifier: MIT */
/* The visible part of every facet as polygons, for drawing and checking: the visible regions from
   which the exact method takes its areas. */
#ifndef LRCS_POLYGON_H
#define LRCS_POLYGON_H

#include <lrcs/pose.h>
#include <lrcs/prepare.h>

/* A corner of a ring. */
typedef struct lrcs_ring_point {
    double body[3]; /* m, body frame, on the facet */
    double view[2]; /* m, observation frame: x to the right, y up */
} lrcs_ring_point;

/* A convex polygon on a facet, counter-clockwise as seen by the laser: point[first .. first +
   count), count >= 3; the last point is joined to the first. */
typedef struct lrcs_ring {
    uint32_t facet;
    uint32_t first, count;
} lrcs_ring;

typedef struct lrcs_polygons {
    lrcs_ring *ring; /* by facet, ascending; the rings of one facet are disjoint */
    lrcs_ring_point *point;
    uint32_t rings, points;
    double bound_m2; /* proved: the projected area of the symmetric difference between the rings
                        and the truly visible regions, summed over all facets, is at most this, plus
                        the effect of rounding the points */
} lrcs_polygons;

/* Bytes of work area, an upper bound for ordinary scenes. Where it does not suffice,
   lrcs_polygon_run returns LRCS_E_MEMORY, and work->peak is what it needed up to that point. */
size_t lrcs_polygon_need(const lrcs_prepared *prepared);

/* The visible polygons of a pose.
   Given: prepared; pose; work.
   Returned: polygons, in the work area.
   Status: LRCS_OK; LRCS_E_ARGUMENT, LRCS_E_NUMBER (the pose); LRCS_E_MEMORY; LRCS_E_LIMIT (more
   than 2^32 - 2 points, or candidates in a grid); LRCS_E_UNSUPPORTED (this thread's arithmetic, as
   lrcs_prepare_run).
   Notes: 1. A facet that is entirely visible, or cannot be distinguished from one that is, has one
   ring: its own three corners, exactly. A facet that cannot be distinguished from a hidden one has
   no ring, and neither has a facet whose visibility is unknown; bound_m2 includes both.
   2. The area of a facet's rings over `view` equals the visible_area_m2 of LRCS_METHOD_EXACT to
   within that bound and the rounding of the points; on a surface that is convex by construction,
   whose front that method takes as visible without clipping, to within the rounding of its
   vertices.
   3. Facets and their back sides have rings whether or not they reflect.
   4. With u = 2^-53 and D the largest distance of the facet's corners from the body's origin: view
   is rounded to within 32 u D; body lies on the facet to within 8 u D; and body projects to within
   256 u D of view. */
int lrcs_polygon_run(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                     lrcs_polygons *polygons);

#endif
