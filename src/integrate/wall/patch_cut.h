/* SPDX-License-Identifier: MIT */
/* Pieces of a round wall's inside that the end of the shadow of its own rim may cross
   (integrate/wall/rim_shadow.h). */
#ifndef LRCSI_PATCH_CUT_H
#define LRCSI_PATCH_CUT_H

#include "integrate/wall/patch_frame.h"

/* What of a piece with a shadow is visible. */
enum { LRCSI_CUT_NOTHING, LRCSI_CUT_ALL, LRCSI_CUT_SOME };
int lrcsi_patch_cut_part(const lrcsi_patch_frame *f);

/* Adds the mean over a piece of F where it is visible, times `fraction`, if the end of the shadow
   is simple enough there. target: the remainder that rules should have. Returns a bound on the
   error of the mean, except for rounding errors of F; infinite, with the patch in an undefined
   state, if none is known. */
double lrcsi_patch_cut_add(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double target,
                           double fraction, lrcsi_patch *patch);

#endif
