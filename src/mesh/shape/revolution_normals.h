/* SPDX-License-Identifier: MIT */
/* The true normals of a body of revolution, over its facets. */
#ifndef LRCSI_REVOLUTION_NORMALS_H
#define LRCSI_REVOLUTION_NORMALS_H

#include "mesh/shape/revolution_reach.h"

/* The true normals N of the patch of one facet or sector, approximated by a linear function of
   position on its facets. In their plane, x is measured along the rows from the middle of the
   sector, y along the line that falls most steeply away from the apex, from anywhere; e_x and e_y
   are unit vectors in these directions. A point of the patch and its image (lrcsi_reach) satisfy
       |N . e_x - across x| <= across_err,  mean over the patch <= across_mean,
       |N . e_y - along y - constant| <= along_err. */
typedef struct lrcsi_revolution_normals {
    double sine, cosine;  /* of the angle between the facets' normal and the axis */
    double across, along; /* 1/m */
    double across_err, across_mean, along_err;
    double width, length; /* m: upper bounds of |x|, and of differences of y */
} lrcsi_revolution_normals;

/* For the zone between rows i and i + 1. */
lrcsi_revolution_normals lrcsi_revolution_normals_make(const lrcsi_revolution *body, uint32_t i);

/* On a straight wall, for the points between two heights, as fractions of its own: across x is then
   closer to the true normals there. `width` and `length` are still those of the whole wall. */
lrcsi_revolution_normals lrcsi_revolution_normals_between(const lrcsi_revolution *body, double low,
                                                          double high);

#endif
