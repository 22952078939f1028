/* SPDX-License-Identifier: MIT */
/* Bodies with a closed form: their dimensions, their sigma, and their facet meshes.
   Frame: axis +z, base at z = 0, nose up; plate, box and sphere centred at the origin, the
   plate's and the disc's normal +z (both at z = 0). Every surface reflects from outside only. */
#ifndef LRCS_SHAPE_H
#define LRCS_SHAPE_H

#include <lrcs/brdf.h>
#include <lrcs/mesh.h>

enum lrcs_shape_kind {
    LRCS_SHAPE_PLATE = 0,  /* size[0] x size[1], one-sided, normal +z */
    LRCS_SHAPE_DISC,       /* radius, one-sided, normal +z */
    LRCS_SHAPE_BOX,        /* size[0] x size[1] x size[2] */
    LRCS_SHAPE_SPHERE,     /* radius */
    LRCS_SHAPE_DOME,       /* radius: upper half sphere, z = 0 .. radius; base disc with ALL */
    LRCS_SHAPE_CYLINDER,   /* radius, length; two end discs with ALL */
    LRCS_SHAPE_CONE,       /* radius (base), and half_angle_deg or length; base with ALL */
    LRCS_SHAPE_FRUSTUM,    /* radius (the end at aspect 0, z = length), radius2 (z = 0), length */
    LRCS_SHAPE_PARABOLOID, /* radius (base), length (height): z = H (1 - r^2/R^2); base with ALL */
    LRCS_SHAPE_KINDS
};

enum lrcs_shape_parts {
    LRCS_SHAPE_ALL = 0, /* with caps or base */
    LRCS_SHAPE_WALL = 1
};

/* Lengths in metres; what a kind does not use is 0. A dimension may be zero (no area). */
typedef struct lrcs_shape {
    int kind;  /* lrcs_shape_kind */
    int parts; /* lrcs_shape_parts */
    double size[3];
    double radius, radius2, length;
    double half_angle_deg; /* cone, 0 < .. < 90; 0: take it from length */
} lrcs_shape;

/* The kind's name in lower case ("plate"), or NULL. And back: LRCS_E_NAME for none. */
const char *lrcs_shape_text(int kind);
int lrcs_shape_find(const char *name);

/* LRCS_OK, or LRCS_E_ARGUMENT / LRCS_E_NUMBER with where->item naming the dimension at fault. */
int lrcs_shape_check(const lrcs_shape *shape, lrcs_where *where);

/* Where the laser stands: by an angle from the axis, exact as given in degrees (90 is 90), or by
   a direction in the shape's frame, which need not be normalised. */
typedef struct lrcs_aspect {
    int by_direction;
    double deg;          /* 0 .. 180, angle between s_hat and +z; 0 is nose-on */
    double direction[3]; /* to the laser */
} lrcs_aspect;

/* A closed form's answer. |value - truth| <= bound, the dimensions, brdf and aspect taken as
   exact. */
typedef struct lrcs_closed {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2, bound_m2;
} lrcs_closed;

/* sigma of a shape alone, from its closed form (or a 1-D quadrature held to 1e-14 where none is
   known).
   Given: shape (lrcs_shape_check), brdf (lrcs_brdf_check), aspect. A box or plate whose aspect
   is an angle is turned about its y axis: s_hat = (sin, 0, cos).
   Returned: closed, m^2. Where exp, pow and their kin are within 2 ulp, bound_m2 is at most
   2e-14 sigma_m2, but for what underflows.
   Status: LRCS_OK; LRCS_E_ARGUMENT: no such shape, an angle outside 0 .. 180, a direction of no
   length; LRCS_E_NUMBER: not finite, outside its range or that of note 1, or sigma overflows.
   Work: O(1), bounded: some 1 to 100 us, for a dome or paraboloid 0.3 to 3 ms, and tens of ms
   where its height and radius differ by 1e100; no work area.
   Notes: 1. Lengths are 0 or at least 1e-150 m; s is within 2^-333 .. 2^333 where A > 0.
   2. A component of a direction below 2^-480 of the largest counts as 0.
   Source: see src/optics. */
int lrcs_closed_eval(const lrcs_shape *shape, const lrcs_brdf *brdf, const lrcs_aspect *aspect,
                     lrcs_closed *closed);

/* How a mesh stands to the curved body it replaces. For each facet there is a patch of the true
   surface, patches cover the body once (facets of one plane may share one, each in proportion to
   its area), and over every patch:
     the true normal turns from the facet's normal by at most `turn` (rad);
     |patch area - facet area| <= area_error * facet area;
     |integral over the patch of the turn vector (rad, in the facet's plane)| <= lean * facet area;
     integral over the patch of the squared turn (rad^2) <= spread^2 * facet area.
   All zero for plane-faced bodies. These hold for the exact dimensions, the rounding of the mesh's
   own vertices included, and outlive any rigid motion, mirror and uniform scale (whose own
   rounding is not in them). */
typedef struct lrcs_curvature {
    double turn;
    double area_error;
    double lean;
    double spread;
} lrcs_curvature;

/* How finely to tessellate. */
typedef struct lrcs_fineness {
    double tolerance;    /* relative error of sigma aimed at, > 0 */
    lrcs_brdf brdf;      /* the material it will wear */
    uint32_t max_facets; /* never more than this; >= 64 */
} lrcs_fineness;

/* Fineness for tolerance 1e-4, the default brdf, at most 2^21 facets. */
lrcs_fineness lrcs_fineness_default(void);

/* Divisions of a shape's mesh, chosen by lrcs_shape_count, obeyed by lrcs_shape_mesh. */
typedef struct lrcs_divisions {
    uint32_t around; /* sectors: a multiple of 4, 8 .. 2^24; 4 for plate and box */
    uint32_t along;  /* rings of a dome, a paraboloid, half a sphere: 1 .. 2^24; 1 otherwise */
} lrcs_divisions;

/* Chooses divisions for a shape and fineness, and counts the mesh they make (one part, no
   materials; text_bytes for the part's name). Curved bodies: the fewest facets whose proved error
   (lrcs_curvature with lrcs_brdf bounds) meets the tolerance relative to sigma or to its mean over
   attitudes, whichever is larger, at every one of a fan of aspects; capped. Where not even the cap
   brings the error below sigma itself, the glint is given up and the diffuse part sets the count.
   Status: LRCS_OK; LRCS_E_ARGUMENT; LRCS_E_NUMBER.
   Work: O(around log around); milliseconds. */
int lrcs_shape_count(const lrcs_shape *shape, const lrcs_fineness *fineness,
                     lrcs_divisions *divisions, lrcs_mesh_counts *counts);

/* Makes the mesh. Vertices shared by position; facets outward; symmetric to the bit; coordinates
   good to a few units of rounding. Every circle becomes an N-gon of the same area, its first corner
   on +x; a cylinder's, cone's or frustum's length is kept, the rise of a sphere, dome or paraboloid
   is such that each facet's normal is the mean normal of its patch. Smoothing group 1 is the curved
   wall; flat faces are hard. curvature may be NULL.
   Status: LRCS_OK; LRCS_E_ARGUMENT, LRCS_E_NUMBER (shape, or divisions that do not suit it);
   LRCS_E_MEMORY. */
int lrcs_shape_mesh(const lrcs_shape *shape, const lrcs_divisions *divisions, lrcs_work *work,
                    lrcs_mesh *mesh, lrcs_curvature *curvature);

#endif
