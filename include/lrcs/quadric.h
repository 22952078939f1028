/* SPDX-License-Identifier: MIT */
/* Which facets of imported models lie on a plane, cylinder, cone or sphere: the surface is fitted,
   the distance of the facets from it is proved. */
#ifndef LRCS_QUADRIC_H
#define LRCS_QUADRIC_H

#include <lrcs/scene.h>

enum lrcs_quadric_kind {
    LRCS_QUADRIC_PLANE,
    LRCS_QUADRIC_CYLINDER,
    LRCS_QUADRIC_SPHERE,
    LRCS_QUADRIC_CONE /* one nappe, on the side of the apex to which the axis points */
};

/* An unbounded surface in the body frame. These doubles define it exactly. */
typedef struct lrcs_quadric {
    int kind;        /* lrcs_quadric_kind */
    double point[3]; /* m; on the plane, on the cylinder's axis, the sphere's centre, the apex */
    double axis[3];  /* the plane's normal or the axis: of unit length to rounding; the surface is
                        that of the vector divided by its length. Not used for a sphere */
    double radius;   /* m, > 0, of a cylinder or sphere */
    double slope;    /* > 0, tangent of a cone's half angle */
} lrcs_quadric;

/* Proved bounds for all points of a facet. */
typedef struct lrcs_quadric_bound {
    double displacement; /* m, of their distance from the surface */
    double normal_angle; /* rad, of the angle between the facet's normal and the normals of the
                            surface at the nearest points (note 2 of lrcs_quadric_facet_bound) */
    int inside;          /* 1: the front of the facet faces the axis or the centre; of a plane, it
                            faces against the plane's normal */
} lrcs_quadric_bound;

/* Bounds the distance of a facet from a surface, and the angle between their normals.
   Given: surface; corner (m, body frame, at most 1e100 in magnitude).
   Returned: bound; normal_angle is HUGE_VAL if the facet has no area beyond rounding, or if the
   angle is not proved to be less than a right angle.
   Status: LRCS_OK; LRCS_E_ARGUMENT (an unknown kind, an axis of other than unit length, a radius or
   slope that is not positive); LRCS_E_NUMBER (not finite or above 1e100; a slope above 1e6).
   Work: none.
   Notes: 1. Rounding adds about 1e-14 of the distance from surface.point to the displacement.
   2. A cone has no normal at its apex. A corner no farther from its axis than `displacement` counts
   as lying on the axis: the angle is that of the facet with its corner moved there.
   3. normal_angle is computed with asin of libm, taken to be accurate to 4 ulp. */
int lrcs_quadric_facet_bound(const lrcs_quadric *surface, const lrcs_point corner[3],
                             lrcs_quadric_bound *bound);

/* Facets of one part and material, connected across their edges, that lie on a surface. */
typedef struct lrcs_quadric_region {
    uint32_t part, material; /* of the scene */
    uint32_t first_facet;    /* the lowest index among its facets */
    uint32_t facet_count;
    lrcs_quadric surface;
    lrcs_quadric_bound bound; /* the greatest of its facets; `inside` of all of them */
    double area;              /* m2 */
    double glint_error;       /* ESTIMATE: relative error of the glint from neighbours that turn by
                                 2 normal_angle, as in lrcs/glint.h; 0 for a plane, or if A is 0 */
} lrcs_quadric_region;

/* The smallest number of facets of a region. */
#define LRCS_QUADRIC_FACETS 12u

/* No region is displaced from a curved surface by more than this fraction of its size, which is the
   lesser of the region's extent (the diagonal of its box) and the largest radius there. A polygon
   of 12 sides in a circle is displaced by 3.4 % of the radius, one of 10 sides by 4.9 %: prisms of
   fewer sides are as often intended as prisms as they approximate cylinders. */
#define LRCS_QUADRIC_SHARE 0.04

/* For a plane: the limits of the displacement, as a fraction of the region's extent, and of the
   angle in rad. */
#define LRCS_QUADRIC_FLAT 1e-3

/* Finds such regions among the facets of models (not of engine-made shapes, whose surfaces are
   known). Which facets are found to lie on which surface is a heuristic and may miss some; what is
   returned is proved.
   Given: scene.
   Returned: list, in the work area, the largest area first; count; facet_region (NULL, or
   facet_count elements): of each facet the index of its region, or LRCS_NONE.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 1.4e9 facets).
   Work: at most lrcs_quadric_need bytes. Time is limited to about 100 comparisons of a facet with
   a surface per facet of the scene; where a scene takes more, the smallest facets are left out.
   Notes: 1. Of a curved surface, the corners lie closer to it than half the displacement of the
   facets, or than 1e-6 of its size: it could be tessellated into this mesh. From the first
   facet found, its normals turn within the region by at least four times normal_angle or 135 deg.
   2. Facets turn by less than 37 deg across the edges of a region. */
size_t lrcs_quadric_need(const lrcs_scene *scene);
int lrcs_quadric_find(const lrcs_scene *scene, lrcs_work *work, lrcs_quadric_region **list,
                      uint32_t *count, uint32_t *facet_region);

#endif
