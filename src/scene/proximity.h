/* SPDX-License-Identifier: MIT */
/* Curved shapes among other parts: how far the true surface of each part may be from its facets,
   and how close two facets must be for the depth order of the true surfaces to differ from theirs.
   It does not depend on direction. */
#ifndef LRCSI_PROXIMITY_H
#define LRCSI_PROXIMITY_H

#include "mesh/slice.h"
#include "scene/prepared.h"

/* Every slack is increased by this for rounding: coordinates are below 1, and values computed from
   them are accurate to 2^-48. */
#define LRCSI_PROXIMITY_ERR 0x1p-44

/* Facets of other parts that are farther away than this times the slack are not near. */
#define LRCSI_PROXIMITY_NEAR 192.0

/* The slack of two parts: the visibility of the true shapes may differ from that of the facets only
   where a point of a facet of `part` is within this distance of a facet of `other` or, in
   projection, of a rim or contour of `other`. 0 if the facets of both parts are exact. */
double lrcsi_proximity_slack(const lrcs_prepared *prepared, uint32_t part, uint32_t other);

/* The slack in projection, for a facet of `part` whose points are displaced from the true surface
   by at most `lateral` perpendicular to the line of sight. */
double lrcsi_proximity_slack_across(const lrcs_prepared *prepared, uint32_t part, uint32_t other,
                                    double lateral);

/* The slack in projection where points of the true surface correspond to points of facets of the
   same projection (visibility/proximity/event_band.c, 5). */
double lrcsi_proximity_slack_aligned(const lrcs_prepared *prepared, uint32_t other);

/* How far points of the true surface may be from their images on a facet: by at most `bound[i]`
   along each of three perpendicular directions in the body frame; and by at most `reach`. On the
   curved wall of a shape that is placed without distortion the directions are radial, axial and
   tangential; of any other facet only the reach is known. */
typedef struct lrcsi_displacement {
    int known; /* 0: only the reach */
    double reach, bound[3], direction[3][3];
} lrcsi_displacement;
lrcsi_displacement lrcsi_proximity_displacement(const lrcs_prepared *prepared, uint32_t facet);

/* Bounds on the components parallel and perpendicular to a unit vector. */
double lrcsi_displacement_along(const lrcsi_displacement *displacement, const double unit[3]);
double lrcsi_displacement_across(const lrcsi_displacement *displacement, const double unit[3]);

/* The number of flat openings in the convex surface of a part; 0 if it is closed or flat. A model
   file counts as having one opening. */
int lrcsi_proximity_openings(const lrcs_prepared *prepared, uint32_t part);

/* The rows of a facet on the straight wall of a cylinder, cone or frustum are the lines parallel to
   its side on one of the wall's two circles; those between two heights, as fractions of the wall's,
   from its base. low > high: none. */
typedef struct lrcsi_row_range {
    double low, high;
} lrcsi_row_range;

/* Given: a facet's corners, in any coordinates, and a slice of the facet. Returned: the rows that
   the slice meets, rounded outward; all if the facet has no rows. */
lrcsi_row_range lrcsi_proximity_rows(const lrcs_prepared *prepared, uint32_t facet,
                                     const double *const corner[3], const lrcsi_slice *slice);

/* 1 if a facet has rows. */
int lrcsi_proximity_has_rows(const lrcs_prepared *prepared, uint32_t facet);

/* 1 if a facet is on the wall of a sphere, dome or paraboloid among other parts: `near` is filled
   for these facets only. */
int lrcsi_proximity_on_round_wall(const lrcs_prepared *prepared, uint32_t facet);

/* A facet's longest side, scaled. */
double lrcsi_proximity_longest(const lrcs_prepared *prepared, uint32_t facet);

/* Bytes that suffice for ordinary scenes; 0 if no shape is curved. */
size_t lrcsi_proximity_need(const lrcs_scene *scene);

/* Fills what prepared->proximity holds of each part, if the bounds of all parts are known, and
   makes room for what facets are near, in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_proximity_make(lrcs_prepared *prepared, lrcs_work *work);

#endif
