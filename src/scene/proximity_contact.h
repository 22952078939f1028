/* SPDX-License-Identifier: MIT */
/* Where a facet meets another solid: how much of it the true shapes place inside of the solid and
   the facets outside, and the reverse. */
#ifndef LRCSI_PROXIMITY_CONTACT_H
#define LRCSI_PROXIMITY_CONTACT_H

#include "mesh/slice.h"
#include "scene/prepared.h"
#include "scene/proximity.h"

/* Upper bounds of fractions of a facet's area: of its points inside the facets of the other part
   that stand for points outside its true solid, and the reverse. */
typedef struct lrcsi_contact_fractions {
    double gain, loss;
} lrcsi_contact_fractions;

/* What of a facet matters for all of its contacts. */
typedef struct lrcsi_contact_wall {
    int known;  /* 0: its displacement is known only by a bound */
    int curved; /* 0: its points are not displaced at all */
    lrcsi_displacement displacement;
    double origin[3], half, tangent, kappa; /* of its sector, if it is on a straight wall */
    double base, top, height;               /* of this wall, scaled: radii, height */
} lrcsi_contact_wall;

lrcsi_contact_wall lrcsi_contact_wall_make(const lrcs_prepared *prepared, uint32_t facet);

/* Makes the fractions near the facet `other`, given what of the facet is within `slack` of it and
   `along` of its plane. They hold if the other facet, and the true surface around it, faces the
   laser. Returns 0 if nothing is known: the other part must be a box, or a cylinder, cone or
   frustum that is closed and placed without distortion. */
int lrcsi_contact_fractions_make(const lrcs_prepared *prepared, const lrcsi_contact_wall *wall,
                                 uint32_t facet, uint32_t other, double slack, double along,
                                 const lrcsi_slice *slice, lrcsi_contact_fractions *fractions);

#endif
