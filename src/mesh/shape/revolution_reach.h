/* SPDX-License-Identifier: MIT */
/* The distance of a body of revolution's facets from its true surface. */
#ifndef LRCSI_REVOLUTION_REACH_H
#define LRCSI_REVOLUTION_REACH_H

#include "mesh/shape/revolution.h"

/* Upper bounds of distances, m. The first four: how far a map of the true surface onto the facets
   moves points. The map takes every facet's patch to it, and stretches area evenly over a facet
   (before any lrcsi_patch_bounds_mapped). The others are Hausdorff distances: how far any point of
   either set is from the nearest point of the other. */
typedef struct lrcsi_reach {
    double all;    /* any point, caps included */
    double radial; /* points of the wall: from or towards the axis in the sector's middle plane */
    double axial;  /* along the axis */
    double tangential; /* perpendicular to the middle plane */
    double solid;      /* between the true solid and the one that the facets enclose; of a disc,
                          between it and its polygon */
    double surface;    /* between the true wall and its facets, and between the circles at the ends
                          of the wall and the polygons there */
} lrcsi_reach;
lrcsi_reach lrcsi_revolution_reach(const lrcsi_revolution *body);

/* An upper bound of how far the true surface of zone i is outside its facets, rho - r. */
double lrcsi_zone_outside(const lrcsi_revolution *body, uint32_t i);

/* Covers the relative rounding error of a reach: its terms are positive and accurate to 1e-9, even
   if 2^24 zones make the differences between neighbours small. */
#define LRCSI_REACH_MARGIN (1.0 + 1e-6)

#endif
