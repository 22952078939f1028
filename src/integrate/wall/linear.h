/* SPDX-License-Identifier: MIT */
/* F = f_r cos^2 over the patch of a facet (integrate/wall/patch.h), approximated by a linear
   function of position on the facets, where only a part of them is visible. */
#ifndef LRCSI_LINEAR_H
#define LRCSI_LINEAR_H

#include "integrate/wall/patch.h"
#include "optics/reflect.h"
#include "scene/proximity.h"
#include "visibility/base/visible_area.h"

/* l = (mean over the patch) + gradient . (x - c), where x is a point of the facets that share the
   patch, c their centroid, and both are projected to the view plane. Scaled, per unit of area of
   the facets. */
typedef struct lrcsi_linear {
    double glint[2], diffuse[2];     /* the gradients of both terms, axes of the view */
    double glint_s[2], diffuse_m[2]; /* their derivatives in s, in m */
    double slope;                    /* upper bound of the length of their sum */
    double scale;                    /* the gradients are so many times those for all rows */
    double variation; /* upper bound of |gradient . (x - c)|; of each term it is at most its mean */
    /* Bounds on the difference h of F, at a point of the patch, and l at its image, divided by
       patch area / facet area: */
    double region;   /* on |the integral of h over any region of the patch| / area of the facets */
    double point;    /* on |h| */
    double rounding; /* the part of either that is due to rounding */
} lrcsi_linear;

/* Given: a patch that is known; the bounds of its part; `second` of lrcsi_deviation for it; rows of
   a straight wall, in which the bounds of h hold, or NULL: in all. The bounds do not include the
   errors of the patch's mean. Returned: 1 and l; 0 if there is none: the shape's scale differs
   between axes, or rounding errors are too large. */
int lrcsi_linear_make(const lrcsi_view *view, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                      const lrcs_patch_bounds *bounds, double second, const lrcsi_row_range *rows,
                      lrcsi_linear *linear);

/* What is visible of a facet, about the centroid of the facets that share its patch. */
typedef struct lrcsi_linear_moment {
    double first[2]; /* the integral of x - c over its projection */
    double error;    /* bound on the length of its error, except for rounding (lrcsi_linear) and: */
    double area_err; /* bound on the area of the facets that it includes although it is not visible,
                        or the reverse */
    double ratio;    /* the area of those facets divided by this one's, an upper bound */
} lrcsi_linear_moment;

/* Given: the facet's patch, visible area and moment. */
lrcsi_linear_moment lrcsi_linear_moment_make(const lrcsi_view *view, uint32_t facet,
                                             const lrcsi_patch *patch,
                                             const lrcsi_visible_area *visible,
                                             const lrcsi_moment *moment);

#endif
