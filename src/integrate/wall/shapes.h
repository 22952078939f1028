/* SPDX-License-Identifier: MIT */
/* Clear shapes, which nothing hides: their contributions to sigma, from closed forms instead of
   from facets. */
#ifndef LRCSI_SHAPES_H
#define LRCSI_SHAPES_H

#include "integrate/plan/plan.h"
#include "view/clear.h"

/* What a clear shape adds to sigma, scaled, with the factor 4 pi. */
typedef struct lrcsi_shape_terms {
    double glint, diffuse;
    double
        rounding; /* bound: error of the closed form, and of the direction in the shape's frame */
    double visibility; /* bound: what the slab of lrcsi_clear_shapes may hide */
    double silhouette; /* projected area of the side towards the laser, rounded */
} lrcsi_shape_terms;

/* Given: a part that is clear in this view, and its slab. */
lrcsi_shape_terms lrcsi_shape_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t part, double slab);

/* What a surface adds to sigma at amplitudes of 1, scaled, and the derivatives of that in s and m.
 */
typedef struct lrcsi_unit_response {
    double glint, diffuse, glint_s, diffuse_m;
} lrcsi_unit_response;

/* Given: a clear part; the s and m to use. The glint counts as 0 for slopes outside the domain of
   the closed forms, 2^-333 .. 2^333. The derivatives are difference quotients of order 8; their
   errors are about 1e-9, relative, plus 1e-11 of the term. */
lrcsi_unit_response lrcsi_shape_response_make(const lrcsi_view *view, uint32_t part,
                                              const lrcs_brdf *brdf);

#endif
