/* SPDX-License-Identifier: MIT */
/* f_r cos(theta) of a packet of facets of one material, in plain doubles, with an a priori bound on
   its error. It is used for nearly every facet of a view, except facets near grazing incidence and
   facets in the bright lobe of a narrow glint: these need tan^2 to more digits than unit vectors
   of doubles provide (reflect.h). */
#ifndef LRCSI_SHADE_H
#define LRCSI_SHADE_H

#include <lrcs/brdf.h>

#include "base/constant.h"
#include "base/elementary.h"

/* The constants of a material for its packets. */
typedef struct lrcsi_lobes {
    double A, B; /* 4 pi times those of the material */
    double inverse_s2;
    double m;
    double cutoff;    /* bound on a term that is set to 0, in units of u */
    double low, high; /* the range of cosines for which packets may be used; empty if low >= high */
    int glint, diffuse;
} lrcsi_lobes;

/* Given: the material; whether its glint and its diffuse term are to be evaluated. */
lrcsi_lobes lrcsi_lobes_make(const lrcs_brdf *brdf, int glint, int diffuse);

/* Unit normals of the facets of a packet, on the side towards the laser. */
typedef struct lrcsi_shade_normals {
    double x[3][LRCSI_LANES];
} lrcsi_shade_normals;

typedef struct lrcsi_shades {
    double cosine[LRCSI_LANES];                      /* cos(theta) */
    double glint[LRCSI_LANES], diffuse[LRCSI_LANES]; /* 4 pi f_r cos(theta) */
    double error[LRCSI_LANES];
} lrcsi_shades;

/* Given: the unit vector d + d_low, accurate to 2^-100, and unit normals n whose components have
   relative errors of at most 1.01 u, u = 2^-53, with n . d in [lobes->low, lobes->high] to within
   2^-50.
   Returned: shades. The product of glint + diffuse and an area is
   4 pi f_r cos(theta) area to within error times LRCSI_SHADE_UNIT times that area. The area is
   either a visible projected area, whose own error is to be added, or S cos(theta) with an S
   accurate to 3 u and the cosine as returned, whose errors are included. */
#define LRCSI_SHADE_UNIT (LRCSI_U * (1 + 0x1p-10))
void lrcsi_shade(const lrcsi_lobes *lobes, const double d[3], const double d_low[3],
                 const lrcsi_shade_normals *normals, lrcsi_shades *shades);

#endif
