/* SPDX-License-Identifier: MIT */
/* Bodies of revolution cut into sectors and rings, and the distance of their facets from the true
   surface. Every tessellated kind except plate and box is a body of revolution. */
#ifndef LRCSI_PROFILE_H
#define LRCSI_PROFILE_H

#include <lrcs/shape.h>

/* A body's wall, from the base up. For the sphere it is the upper half; the lower half is its
   mirror image. */
typedef struct lrcsi_profile {
    int kind;
    double base, top, height; /* m: radii at z = 0 and at the upper end, and the end's z */
    uint32_t around, strips;  /* sectors; strips of facets in the wall (0: a disc) */
    double half;              /* h = pi / around, half a sector */
    double vertex_ratio;      /* vertex radius / true radius: the polygon has the circle's area */
    double slope;             /* paraboloid: 2 H / R, the tangent of the angle at its rim */
    double step;              /* rad of meridian between rings; 0 for straight walls */
    int level_rings;          /* lrcs_divisions.level_rings, of curved walls */
} lrcsi_profile;

/* Makes the profile of a shape that lrcs_shape_check accepts and that is neither plate nor box, for
   divisions in range. */
lrcsi_profile lrcsi_profile_make(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* True radius of row i, 0 (base) .. strips (upper end), m; exactly 0 at an apex. */
double lrcsi_profile_radius(const lrcsi_profile *profile, uint32_t i);

/* The height of row i + 1 of the mesh above row i, m. */
double lrcsi_profile_rise(const lrcsi_profile *profile, uint32_t i);

/* The numbers of lrcs_curvature, proved, over all facets of the wall. */
lrcs_curvature lrcsi_profile_curvature(const lrcsi_profile *profile);

/* An upper bound of the angle (rad) by which rounding of the vertices rotates the facets between
   rows i and i + 1, and of the relative change of their areas. */
double lrcsi_profile_rounding(const lrcsi_profile *profile, uint32_t i);

/* The numbers for facets that rounding rotates by at most `rounding` rad, and whose areas it
   changes by at most that fraction. */
lrcs_curvature lrcsi_profile_rounded(const lrcs_curvature *curvature, double rounding);

/* The numbers after a linear map whose largest singular value is `ratio` times its least, applied
   to both patches and facets. Also returned: `uneven`. 1 + uneven bounds the factor by which the
   map stretches areas at one place of a patch more, or less, than on average over the facet. */
lrcs_curvature lrcsi_profile_stretched(const lrcs_curvature *curvature, double ratio,
                                       double *uneven);

/* Upper bounds of distances, m. The first four: how far a map of the true surface onto the facets
   moves points. The map takes every facet's patch to it, and stretches area evenly over a facet
   (before any lrcsi_profile_stretched). The others are Hausdorff distances: how far any point of
   either set is from the nearest point of the other. */
typedef struct lrcsi_reach {
    double all;    /* any point, caps included */
    double radial; /* points of the wall: from or towards the axis in the sector's middle plane */
    double axial;  /* along the axis */
    double tangential; /* perpendicular to the middle plane */
    double solid;      /* between the true solid and the one that the facets enclose; of a disc,
                          between it and its polygon */
    double surface;    /* between the true wall and its facets, and between the circles at the ends
                          of the wall and the polygons there */
} lrcsi_reach;
lrcsi_reach lrcsi_profile_reach(const lrcsi_profile *profile);

/* The true normals N of the patch of one facet or sector, approximated by a linear function of
   position on its facets. In their plane, x is measured along the rows from the middle of the
   sector, y along the line that falls most steeply away from the apex, from anywhere; e_x and e_y
   are unit vectors in these directions. A point of the patch and its image (lrcsi_reach) satisfy
       |N . e_x - across x| <= across_err,  mean over the patch <= across_mean,
       |N . e_y - along y - constant| <= along_err. */
typedef struct lrcsi_profile_normals {
    double sine, cosine;  /* of the angle between the facets' normal and the axis */
    double across, along; /* 1/m */
    double across_err, across_mean, along_err;
    double width, length; /* m: upper bounds of |x|, and of differences of y */
} lrcsi_profile_normals;

/* For the strip between rows i and i + 1. */
lrcsi_profile_normals lrcsi_profile_normals_make(const lrcsi_profile *profile, uint32_t i);

#endif
