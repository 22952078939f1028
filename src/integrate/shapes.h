/* SPDX-License-Identifier: MIT */
/* What shapes that nothing hides reflect, from their closed forms instead of their facets. */
#ifndef LRCSI_SHAPES_H
#define LRCSI_SHAPES_H

#include "integrate/plan.h"
#include "view/clear.h"

/* What one of them adds, scaled, with the factor 4 pi. */
typedef struct lrcsi_shape_terms {
    double glint, diffuse;
    double rounding;   /* bound: of the closed form, and of the direction in the shape's frame */
    double visibility; /* bound: on what the slab of lrcsi_clear may hide */
    double silhouette; /* projected area of the side towards the laser, rounded */
} lrcsi_shape_terms;

/* Given: a part that is clear in this view, and its slab. */
lrcsi_shape_terms lrcsi_shape_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t part, double slab);

/* The same at amplitudes of 1, and its derivatives in s and m. */
typedef struct lrcsi_shape_response {
    double glint, diffuse, glint_s, diffuse_m;
} lrcsi_shape_response;

/* Given: such a part; the s and m to use. The glint counts as 0 for slopes outside the domain of
   the closed forms, 2^-333 .. 2^333. The derivatives are differences of order 8, with errors of
   about 1e-9 of themselves and 1e-11 of the term. */
lrcsi_shape_response lrcsi_shape_response_make(const lrcsi_view *view, uint32_t part,
                                               const lrcs_brdf *brdf);

#endif
