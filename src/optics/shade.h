/* SPDX-License-Identifier: MIT */
/* f_r cos(theta) of a block of facets of one material, in plain doubles, with an a priori bound on
   its error: what nearly every facet of a view takes. Facets near grazing incidence, and in the
   bright lobe of a narrow glint, are not for it: they need tan^2 to more digits than unit vectors
   of doubles hold (reflect.h). */
#ifndef LRCSI_SHADE_H
#define LRCSI_SHADE_H

#include <lrcs/brdf.h>

#include "base/elementary.h"

/* A material as its blocks need it. */
typedef struct lrcsi_lobes {
    double A, B; /* 4 pi times those of the material */
    double inverse_s2;
    double m;
    double nothing;   /* bounds a part that is taken for 0, in units of u */
    double low, high; /* cosines between which blocks serve; none where low >= high */
    int glint, diffuse;
} lrcsi_lobes;

/* Given: the material; whether its glint and its diffuse part are to be evaluated. */
lrcsi_lobes lrcsi_lobes_make(const lrcs_brdf *brdf, int glint, int diffuse);

typedef struct lrcsi_shades {
    double normal[3][LRCSI_LANES];                   /* given: unit, turned to the laser */
    double cosine[LRCSI_LANES];                      /* cos(theta) */
    double glint[LRCSI_LANES], diffuse[LRCSI_LANES]; /* 4 pi f_r cos(theta) */
    double error[LRCSI_LANES];
} lrcsi_shades;

/* Given: unit vectors d + d_low to 2^-100, and normals n whose components are off by at most 1.01 u
   of themselves, u = 2^-53, with n . d in [lobes->low, lobes->high] but for 2^-50.
   Returned: the rest of `shades`. Times a visible projected area, or S cos(theta) with an S good to
   3 u and the cosine as returned, glint + diffuse is 4 pi f_r cos(theta) area to within error times
   LRCSI_SHADE_UNIT times that area; the area's own error comes on top, that of S and S cos(theta)
   is included. */
#define LRCSI_SHADE_UNIT (0x1p-53 * (1 + 0x1p-10))
void lrcsi_shade(const lrcsi_lobes *lobes, const double d[3], const double d_low[3],
                 lrcsi_shades *shades);

#endif
