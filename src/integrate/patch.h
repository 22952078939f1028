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
    int moments;         /* given: 1 if the next two are needed; else they are 0 */
    double glint_u;      /* the mean of u times the glint, u = tan^2(theta) */
    double diffuse_log;  /* the mean of log(1 + u) times the diffuse term */
    double remainder;    /* bound on the error of glint + diffuse due to the quadrature rule */
    double rounding;     /* bound on their rounding error */
    double area_err;     /* bound on the relative change that rounding of the corners makes in the
                            area of a region of the facets */
    double negligible;   /* given: no smaller remainder is needed */
    lrcsi_wall_patch at; /* its position on the shape */
    uint32_t part;       /* the part that is the shape */
    int side;            /* 1: seen from outside, -1: from inside; 0: there is no patch yet */
    int known;           /* lrcsi_patch_make returned 1 */
} lrcsi_patch;

/* 1 if a facet may represent a patch: it is on the curved wall of a shape. */
int lrcsi_patch_exists(const lrcs_prepared *prepared, uint32_t facet);

/* Given: a facet that is not skipped; the BRDF; patch->negligible, patch->moments; what `patch`
   holds from the last call with the same BRDF, which is used again for the other facet of the same
   patch, or side = 0. Returned: 1 and the patch; or 0: the plan asks for facets, the facet has no
   patch, the laser may see the patch edge-on or from its other side in part, or it is too large for
   the rules. */
int lrcsi_patch_make(const lrcsi_view *view, const lrcsi_plan *plan, const lrcs_brdf *brdf,
                     uint32_t facet, lrcsi_patch *patch);

#endif
