/* SPDX-License-Identifier: MIT */
/* What shapes that nothing hides reflect, from their closed forms: in place of their facets. */
#ifndef LRCSI_SHAPES_H
#define LRCSI_SHAPES_H

#include "integrate/plan.h"
#include "view/clear.h"

/* What one of them adds, scaled, with the 4 pi. */
typedef struct lrcsi_shape_terms {
    double glint, diffuse;
    double rounding;   /* a bound: of the closed form, and of where the laser stands to the shape */
    double visibility; /* a bound: on what the slab of lrcsi_clear may hide */
    double silhouette; /* projected area of what faces the laser, rounded */
} lrcsi_shape_terms;

/* Given: a part that is clear in this view, and its slab. */
lrcsi_shape_terms lrcsi_shape_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t part, double slab);

/* The same at amplitudes of 1, and its derivatives in s and m. */
typedef struct lrcsi_shape_response {
    double glint, diffuse, glint_s, diffuse_m;
} lrcsi_shape_response;

/* Given: such a part; the s and m to use. Beyond the slopes that closed forms serve (2^-333 ..
   2^333) the glint is 0. The derivatives are differences of order 8, good to about 1e-9 of
   themselves and 1e-11 of the term. */
lrcsi_shape_response lrcsi_shape_response_make(const lrcsi_view *view, uint32_t part,
                                               const lrcs_brdf *brdf);

#endif
