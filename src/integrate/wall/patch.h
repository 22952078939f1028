/* SPDX-License-Identifier: MIT */
/* Eq. 2 over the patch of a facet on a shape's curved wall: the part of the true surface that the
   facet represents. */
#ifndef LRCSI_PATCH_H
#define LRCSI_PATCH_H

#include "base/constant.h"
#include "integrate/plan/plan.h"
#include "mesh/shape/tessellate.h"

/* The mean of f_r cos^2 over a patch, per unit of area of the patch's facets. Where the patch faces
   away from the laser, f_r cos^2 counts as 0. */
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
    lrcs_brdf brdf;
    int side;  /* 1: seen from outside, -1: from inside; 0: there is no patch yet */
    int known; /* 0: there is a patch, but its mean is not known */
} lrcsi_patch;

/* What evaluates patches, one after the other. The last one is kept only to save time, because the
   other facet of its sector represents it as well: no result depends on it. */
typedef struct lrcsi_patches {
    double negligible; /* given: no smaller remainder is needed */
    int derivatives;   /* given: 1 if glint_u and diffuse_log are needed, for derivatives */
    lrcsi_patch last;  /* side = 0: none yet */
} lrcsi_patches;

/* The part of a facet. */
const lrcs_part *lrcsi_patch_part(const lrcs_prepared *prepared, uint32_t facet);

/* The first facet of a sector, of which the given one is the first or the second: the two are
   neighbours in the part's list of facets, in which every strip of a wall begins at an even index
   (mesh/shape/tessellate.c). In a strip that ends in an apex each facet has a sector of its own;
   the two are neighbours in the list all the same. */
uint32_t lrcsi_patch_sector(const lrcs_prepared *prepared, uint32_t facet);

/* The other facet of the sector. */
uint32_t lrcsi_patch_partner(const lrcs_prepared *prepared, uint32_t facet);

/* 1 if a facet may represent a patch: it is on the curved wall of a shape. */
int lrcsi_patch_exists(const lrcs_prepared *prepared, uint32_t facet);

/* The patch of a facet that is not skipped, valid until the next call. Returned: NULL if the plan
   asks for facets, the facet has no patch, or the remainder would be too large. */
const lrcsi_patch *lrcsi_patch_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                    const lrcs_brdf *brdf, uint32_t facet, lrcsi_patches *patches);

/* With a smaller slope s the flank of the glint is so steep, |d log glint / du| up to 2 + 1/s^2,
   that the rounding error of u would exceed 1e-8 of the glint. No proof depends on the value:
   errors are computed for any s. */
#define LRCSI_PATCH_SLOPE_MIN 1e-3

/* The error of a normal of a patch and the direction to the laser together. */
#define LRCSI_PATCH_NORMAL_ERR (64 * LRCSI_U)

/* What an error e of a unit normal, at most 2^-10 c, changes in both terms of f_r cos^2, relative,
   up to the factor exp of it (integrate/wall/patch.c). Given: u = tan^2, the cosine c and the sine
   p of the incidence angle. */
typedef struct lrcsi_term_errors {
    double glint, diffuse;
} lrcsi_term_errors;
lrcsi_term_errors lrcsi_patch_term_errors(const lrcs_brdf *brdf, double e, double u, double c,
                                          double p);

#endif
