/* SPDX-License-Identifier: MIT */
/* What of a facet is within a distance of another one. */
#ifndef LRCSI_PROXIMITY_PAIR_H
#define LRCSI_PROXIMITY_PAIR_H

#include "mesh/slice.h"
#include "scene/prepared.h"

/* Contains the part of a facet that is within `slack` of the facet `other`, and within `along` of
   its plane. */
lrcsi_slice lrcsi_proximity_slice(const lrcs_prepared *prepared, uint32_t facet, uint32_t other,
                                  double slack, double along);

/* Fractions of a facet's area on both sides of a plane. */
typedef struct lrcsi_sides_fraction {
    double front, back;
} lrcsi_sides_fraction;

/* Upper bounds of the fractions of a facet's area that a slice of it has in front of the plane of
   another facet and behind it. */
lrcsi_sides_fraction lrcsi_proximity_slice_fractions(const lrcs_prepared *prepared, uint32_t facet,
                                                     const lrcsi_slice *slice, uint32_t other);

/* The same of the part of the facet that is within `slack` of the other. */
lrcsi_sides_fraction lrcsi_proximity_fractions(const lrcs_prepared *prepared, uint32_t facet,
                                               uint32_t other, double slack);

/* Is it proved that a facet's side, from corner `side` to the next, is farther than this distance
   from another facet? */
int lrcsi_proximity_side_is_far(const lrcs_prepared *prepared, uint32_t facet, int side,
                                uint32_t other, double distance);

#endif
