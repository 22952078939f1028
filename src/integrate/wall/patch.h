/* SPDX-License-Identifier: MIT */
/* Eq. 2 over the patch of a facet on a shape's curved wall: the part of the true surface that the
   facet represents. */
#ifndef LRCSI_PATCH_H
#define LRCSI_PATCH_H

#include "integrate/plan/plan.h"
#include "integrate/wall/patch_frame.h"

/* What evaluates patches, one after the other. The last one is kept only to save time, because the
   other facet of its sector represents it as well: no result depends on it. */
typedef struct lrcsi_patches {
    int derivatives;  /* given: 1 if glint_u and diffuse_log are needed, for derivatives */
    lrcsi_patch last; /* side = 0: none yet */
} lrcsi_patches;

/* The patch of a facet that is not skipped, valid until the next call. Returned: NULL if the plan
   asks for facets, the facet has no patch, or the remainder would be too large. */
const lrcsi_patch *lrcsi_patch_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                    const lrcs_brdf *brdf, uint32_t facet, lrcsi_patches *patches);

/* The same for one side of the patch, whichever side its facets show: the outside or, with a
   shadow, what the laser sees of the inside past the rim of its own part. The mean is known if its
   remainder is finite. Returned: 1, and the patch; 0 if it is not known. */
int lrcsi_patch_make_side(const lrcsi_view *view, const lrcsi_plan *plan, const lrcs_brdf *brdf,
                          uint32_t facet, const lrcsi_rim_shadow *shadow, int derivatives,
                          lrcsi_patch *patch);

/* With a smaller slope s the flank of the glint is so steep, |d log glint / du| up to 2 + 1/s^2,
   that the rounding error of u would exceed 1e-8 of the glint. No proof depends on the value:
   errors are computed for any s. */
#define LRCSI_PATCH_SLOPE_MIN 1e-3

#endif
