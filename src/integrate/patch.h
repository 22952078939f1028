/* SPDX-License-Identifier: MIT */
/* Eq. 2 over the patch of a facet on a shape's curved wall: the part of the true surface that the
   facet represents. */
#ifndef LRCSI_PATCH_H
#define LRCSI_PATCH_H

#include "integrate/plan.h"
#include "mesh/tessellate.h"

/* The mean of f_r cos^2 over a patch, per unit of area of the patch's facets. */
typedef struct lrcsi_patch {
    double glint, diffuse;
    double glint_u;      /* the mean of u times the glint, u = tan^2(theta), if asked for; else 0 */
    double diffuse_log;  /* the mean of log(1 + u) times the diffuse term, likewise */
    double remainder;    /* bound on the error of glint + diffuse due to the quadrature rule */
    double rounding;     /* bound on their rounding error */
    double area_err;     /* bound on the relative change that rounding of the corners makes in the
                            area of a region of the facets */
    lrcsi_wall_patch at; /* its position on the shape */
    uint32_t part;       /* the part that is the shape */
    int side;            /* 1: seen from outside, -1: from inside; 0: there is no patch yet */
    int known;           /* 0: there is a patch, but its mean is not known */
} lrcsi_patch;

/* What evaluates patches, one after the other. The last one is kept, because the other facet of its
   sector represents it as well. */
typedef struct lrcsi_patches {
    double negligible; /* given: no smaller remainder is needed */
    int derivatives;   /* given: 1 if glint_u and diffuse_log are needed, for derivatives */
    lrcsi_patch last;  /* side = 0: none yet */
} lrcsi_patches;

/* 1 if a facet may represent a patch: it is on the curved wall of a shape. */
int lrcsi_patch_exists(const lrcs_prepared *prepared, uint32_t facet);

/* The patch of a facet that is not skipped, valid until the next call. Given: the BRDF, the same
   for all facets of a part that `patches` are used for. Returned: NULL if the plan asks for facets,
   the facet has no patch, the laser may see the patch edge-on or from its other side in part, or it
   is too large for the rules. */
const lrcsi_patch *lrcsi_patch_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                    const lrcs_brdf *brdf, uint32_t facet, lrcsi_patches *patches);

#endif
