/* SPDX-License-Identifier: MIT */
/* The tessellation error of one facet on a curved wall. The proofs, and the symbols F, F_i, l, a:
   integrate/wall/tessellation.c. */
#ifndef LRCSI_WALL_ERROR_H
#define LRCSI_WALL_ERROR_H

#include "integrate/wall/flat_face.h"
#include "integrate/wall/patch.h"
#include "integrate/wall/patch_visibility.h"
#include "optics/reflect.h"
#include "visibility/base/visible_area.h"

/* What the errors of all facets of a run follow from. */
typedef struct lrcsi_tessellation_input {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_visible_area *visible; /* the visible areas of all facets */
    const lrcsi_moment *moment;    /* of the visible regions of all undecided facets; NULL: there
                                         are to be no corrections */
    const lrcsi_masked_band *band; /* NULL: every front is entirely visible, or the bounds of the
                                         visible areas include what could be hidden */
    const lrcsi_flat_face *face;   /* [faces]: margins on flat faces that the sum includes;
                                      NULL: it includes none */
    int margins;                   /* 1: the sum includes the margins of facets
                                      (lrcsi_wall_margin_area) */
} lrcsi_tessellation_input;

/* Bounds on the error: the true value exceeds that of the facets, and the correction if there is
   one, by at most `above`, and falls below it by at most `below`. Scaled, without the factor 4 pi.
 */
typedef struct lrcsi_tessellation {
    double above, below;
    double glint, diffuse; /* the correction: what is to be added to the facet's terms because only
                              a part of it is visible, and F varies over its patch */
    double corrected;      /* 0: there is none; both are 0. Otherwise the scale of its gradients
                              (lrcsi_linear) */
} lrcsi_tessellation;

/* A bound on the relative difference between the area of a region of a patch and that of its image
   on the facet: a. It combines the difference of the whole patch with the variation of the stretch
   over the patch. */
double lrcsi_patch_area_err(const lrcs_prepared *prepared, uint32_t facet,
                            const lrcs_patch_bounds *bounds);

/* How F varies over a patch. */
typedef struct lrcsi_patch_deviation {
    lrcsi_deviation of_f;     /* the deviation of F from F_i, the value that the sum uses */
    double stretch;           /* a bound on the relative difference of areas, to be multiplied by
                                 F_i */
    const lrcsi_patch *patch; /* F_i is this patch's mean; NULL: it is F at the facet's normal */
} lrcsi_patch_deviation;

/* For the patch of a facet of given incidence and bounds. */
lrcsi_patch_deviation lrcsi_patch_deviation_make(const lrcsi_tessellation_input *in, uint32_t facet,
                                                 const lrcsi_incidence *incidence,
                                                 const lrcs_patch_bounds *bounds,
                                                 lrcsi_patches *patches);

/* What is known about a facet on a curved wall. */
typedef struct lrcsi_wall_facet {
    uint32_t facet;
    lrcs_patch_bounds bounds;
    double area_err;    /* lrcsi_patch_area_err */
    int state, partner; /* lrcsi_patch_state, of the facet and of the other one of its sector */
    lrcsi_incidence
        pair[2]; /* of both, in their order; that of the other only if both are visible */
    lrcsi_patch_fractions fractions; /* if the facet is hidden, gain and loss include what may be
                                        visible of it */
    lrcsi_patch_deviation deviation;
} lrcsi_wall_facet;

/* The error of such a facet per unit of its area, and its correction. If both facets of the sector
   are visible and one of them is partly visible, they choose the same bound, and both are corrected
   or neither is. */
lrcsi_tessellation lrcsi_wall_error(const lrcsi_tessellation_input *in, const lrcsi_wall_facet *at);

#endif
