/* SPDX-License-Identifier: MIT */
/* Curved shapes among other parts: how far each part's true surface may be from its facets, and
   which facets are so close to one of another part that the order of the true surfaces may
   differ. It does not depend on direction. */
#ifndef LRCSI_PROXIMITY_H
#define LRCSI_PROXIMITY_H

#include "mesh/slice.h"
#include "scene/prepared.h"

/* Every slack is increased by this, for rounding: coordinates are below 1, and computed values
   accurate to 2^-48. */
#define LRCSI_PROXIMITY_ERR 0x1p-44

/* The distance from a facet of `part` to a facet of `other`, or in projection to its rims and
   contours, below which the visibility of the true shapes may differ from that of the facets: 0 if
   the facets of both parts are exact. */
double lrcsi_proximity_slack(const lrcs_prepared *prepared, uint32_t part, uint32_t other);

/* The same in projection, for a facet of `part` whose points move by at most `aside` across the
   line of sight. */
double lrcsi_proximity_slack_across(const lrcs_prepared *prepared, uint32_t part, uint32_t other,
                                    double aside);

/* How far points of a facet of a curved wall, other than caps, move across the line of sight on
   their way from the true surface. Given: the unit vector to the laser. At most the part's reach.
 */
double lrcsi_proximity_aside(const lrcs_prepared *prepared, uint32_t facet, const double unit[3]);

/* 1 if a part is a closed outward solid by construction: its back sides never hide anything by
   themselves. */
int lrcsi_proximity_closed(const lrcs_prepared *prepared, uint32_t part);

/* The number of flat openings in a convex surface; 0: it is closed, or flat. Of a model, which is
   its own truth: not 0 unless it is closed. */
int lrcsi_proximity_openings(const lrcs_prepared *prepared, uint32_t part);

/* The rows of a facet on the straight wall of a cylinder, cone or frustum are the lines parallel to
   its side on one of the wall's two circles. Given: the facet's corners, in any coordinates.
   Returned: an upper bound of the fraction of its rows, by height over that side, that a polygon
   within the facet meets; 1 if the facet has no rows. */
double lrcsi_proximity_rows(const lrcs_prepared *prepared, uint32_t facet,
                            const double *const corner[3], const lrcsi_slice *slice);

/* 1 if a facet has rows. */
int lrcsi_proximity_has_rows(const lrcs_prepared *prepared, uint32_t facet);

/* A facet's longest side, scaled. */
double lrcsi_proximity_longest(const lrcs_prepared *prepared, uint32_t facet);

/* Bytes for ordinary scenes; 0 if no shape is curved. */
size_t lrcsi_proximity_need(const lrcs_scene *scene);

/* Fills prepared->proximity, in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_proximity_make(lrcs_prepared *prepared, lrcs_work *work);

#endif
