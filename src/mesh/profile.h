/* SPDX-License-Identifier: MIT */
/* Bodies of revolution cut into sectors and rings, and how far their facets stand from the true
   surface. Every tessellated kind but plate and box is one. */
#ifndef LRCSI_PROFILE_H
#define LRCSI_PROFILE_H

#include <lrcs/shape.h>

/* A body's wall, from the base up. The sphere's is its upper half: the lower mirrors it. */
typedef struct lrcsi_profile {
    int kind;
    double base, top, height; /* m: radii at z = 0 and at the upper end, and the end's z */
    uint32_t around, strips;  /* sectors; strips of facets in the wall (0: a disc) */
    double half;              /* h = pi / around, half a sector */
    double swell;             /* vertex radius / true radius: the polygon has the circle's area */
    double slope;             /* paraboloid: 2 H / R, the tangent of the angle at its rim */
    double step;              /* rad of meridian between rings; 0 for straight walls */
} lrcsi_profile;

/* For a shape that lrcs_shape_check accepts, neither plate nor box, and divisions in range. */
lrcsi_profile lrcsi_profile_make(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* True radius of row i, 0 (base) .. strips (upper end), m; exactly 0 at an apex. */
double lrcsi_profile_radius(const lrcsi_profile *profile, uint32_t i);

/* What row i + 1 of the mesh lies above row i, m. */
double lrcsi_profile_rise(const lrcsi_profile *profile, uint32_t i);

/* The numbers of lrcs_curvature, proved, over all facets of the wall. */
lrcs_curvature lrcsi_profile_curvature(const lrcsi_profile *profile);

/* The numbers for facets that rounding tilts by at most `blur` rad, and resizes by that part. */
lrcs_curvature lrcsi_profile_blurred(const lrcs_curvature *curvature, double blur);

/* The numbers after a linear map whose largest singular value is `ratio` times its least, which
   patches and facets go through alike. Returned also: 1 + uneven bounds by how much more it
   stretches areas at one place of a patch than on average over the facet, or less. */
lrcs_curvature lrcsi_profile_stretched(const lrcs_curvature *curvature, double ratio,
                                       double *uneven);

/* A map of the true surface, caps included, onto the facets carries every facet's patch to it,
   stretches area evenly over a facet (before any
   lrcsi_profile_stretched), and moves no point farther than this, m. */
double lrcsi_profile_reach(const lrcsi_profile *profile);

#endif
