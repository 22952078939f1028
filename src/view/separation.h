/* SPDX-License-Identifier: MIT */
/* Parts as convex bodies, and planes that separate two of them. If such a plane does not face away
   from the laser, the part behind it hides nothing of the part in front of it. */
#ifndef LRCSI_SEPARATION_H
#define LRCSI_SEPARATION_H

#include "mesh/shape/support.h"
#include "scene/prepared.h"

/* A convex body around a part. Its support along n is the largest n . x over the body. */
typedef struct lrcsi_body {
    const lrcs_prepared *prepared;
    const lrcs_part *part;
    const lrcsi_extent *extent;
    int curved; /* 1: supports are those of the closed form with the scaled dimensions
                   `solid`; 0: those of the facets, or of the box around the part */
    lrcsi_support solid;
    double vertex_ratio; /* of a curved body: radius of its mesh's vertices / true radius */
    double beyond;       /* bound on the distance of its facets from the solid that is wider by
                            this ratio */
    double origin[3];
    double centre[3]; /* of its box */
    double err;       /* bound on the error of a support along a unit vector */
} lrcsi_body;

/* The scaled dimensions of a shape of revolution. */
lrcsi_support lrcsi_body_solid(const lrcs_prepared *prepared, uint32_t part);

/* Given: prepared->extent is not NULL. */
lrcsi_body lrcsi_body_make(const lrcs_prepared *prepared, uint32_t part);

/* The support of the true shape. */
double lrcsi_body_support(const lrcsi_body *body, const double n[3]);

/* That of the true shape and its facets together. */
double lrcsi_body_support_all(const lrcsi_body *body, const double n[3]);

/* A bound on the area of a curved body's wall within `height` of an end along its axis, or of a
   sphere in any direction; and more than that by 32 u times the square of its radius, for the face
   at the end, which is then edge-on to within rounding: if s is at most LRCSI_SLAB_GLINT_SLOPE_MAX,
   F is there below B (20 u)^2, so that this much area times the largest F of the wall exceeds what
   the face reflects. */
double lrcsi_body_slab(const lrcsi_body *body, double height);
#define LRCSI_SLAB_GLINT_SLOPE_MAX 0x1p20

/* Does a plane across n separate P, in front of it, from Q, behind it? */
typedef struct lrcsi_gap {
    int separates; /* 1: it does, so that Q hides nothing of P */
    int is_zero;   /* 1: to within rounding the gap is 0, so that both are at the plane: Q may hide
                      only points of P at which n . x < low + height */
    double low;    /* the lowest n . x over P */
    double height;
} lrcsi_gap;

/* A difference or cross product that is shorter than this is due to rounding, and has no meaningful
   direction. Any value is right: planes across any direction may be tried. */
#define LRCSI_GAP_NORMAL_MIN 0x1p-30

/* Given: the direction d to the laser and n, unit vectors to 8 u, n . d >= -8 u; facets: 1 if the
   plane is to separate the facets as well, otherwise only the true shapes. */
lrcsi_gap lrcsi_gap_make(const lrcsi_body *P, const lrcsi_body *Q, const double d[3],
                         const double n[3], int facets);

#endif
