/* SPDX-License-Identifier: MIT */
/* Bounds of patches (lrcs_patch_bounds) whose facets are rounded, or mapped with them. */
#ifndef LRCSI_PATCH_BOUNDS_H
#define LRCSI_PATCH_BOUNDS_H

#include <lrcs/shape.h>

/* The numbers for facets that rounding rotates by at most `rounding` rad, and whose areas it
   changes by at most that fraction. */
lrcs_patch_bounds lrcsi_patch_bounds_rounded(const lrcs_patch_bounds *bounds, double rounding);

/* The numbers after a linear map whose largest singular value is `ratio` times its least, applied
   to both patches and facets. Also returned: `stretch_err`. 1 + stretch_err bounds the factor by
   which the map stretches areas at one place of a patch more, or less, than on average over the
   facet. */
lrcs_patch_bounds lrcsi_patch_bounds_mapped(const lrcs_patch_bounds *bounds, double ratio,
                                            double *stretch_err);

#endif
