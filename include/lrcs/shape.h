/* SPDX-License-Identifier: MIT */
/* Shapes with a closed form: their dimensions, their sigma, and their facet meshes.
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

/* Lengths in metres; fields that a kind does not use are 0. A dimension may be zero (no area). */
typedef struct lrcs_shape {
    int kind;  /* lrcs_shape_kind */
    int parts; /* lrcs_shape_parts */
    double size[3];
    double radius, radius2, length;
    double half_angle_deg; /* cone, 0 < .. < 90; 0: derived from length */
} lrcs_shape;

/* The kind's name in lower case ("plate"), or NULL. lrcs_shape_find is the inverse: LRCS_E_NAME for
   an unknown name. */
const char *lrcs_shape_text(int kind);
int lrcs_shape_find(const char *name);

/* Checks a shape. Status: LRCS_OK; LRCS_E_ARGUMENT (kind, parts, or a dimension that the kind does
   not use or that disagrees with another one); LRCS_E_NUMBER (not finite, or outside its range).
   where->item names what is at fault. */
int lrcs_shape_check(const lrcs_shape *shape, lrcs_where *where);

/* The direction to the laser: an angle from the axis, taken as exact in degrees (90 is exactly 90),
   or a direction in the shape's frame, which need not be normalised. */
typedef struct lrcs_aspect {
    int by_direction;
    double deg;          /* 0 .. 180, angle between s_hat and +z; 0 is nose-on */
    double direction[3]; /* to the laser */
} lrcs_aspect;

/* The result of a closed form. |value - truth| <= bound, where dimensions, brdf and aspect are
   taken as exact. */
typedef struct lrcs_closed_form {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2, bound_m2;
} lrcs_closed_form;

/* sigma of a shape alone, from its closed form (or, where none is known, from a 1-D quadrature
   accurate to 1e-14).
   Given: shape (lrcs_shape_check), brdf (lrcs_brdf_check), aspect. A box or plate whose aspect
   is an angle is rotated about its y axis: s_hat = (sin, 0, cos).
   Returned: closed, m^2. If exp, pow and the other libm functions are accurate to 2 ulp, bound_m2
   is at most 2e-14 sigma_m2, except for terms that underflow.
   Status: LRCS_OK; LRCS_E_ARGUMENT: no such shape, an angle outside 0 .. 180, a direction of length
   zero; LRCS_E_NUMBER: not finite, outside its range or that of note 1, or sigma overflows.
   Work: O(1), bounded: about 1 to 100 us; for a dome or paraboloid 0.3 to 3 ms, and tens of ms if
   its height and radius differ by a factor of 1e100; no work area.
   Notes: 1. Lengths are 0 or at least 1e-150 m; s is within 2^-333 .. 2^333 where A > 0.
   2. A component of a direction below 2^-480 of the largest counts as 0.
   Source: see src/optics. */
int lrcs_closed_eval(const lrcs_shape *shape, const lrcs_brdf *brdf, const lrcs_aspect *aspect,
                     lrcs_closed_form *closed);

/* Bounds on how closely the facets of a mesh approximate the curved body that they replace. For
   each facet there is a patch of the true surface. Patches cover the body once (facets of one plane
   may share a patch, each in proportion to its area), and over every patch:
     the true normal deviates from the facet's normal by at most `turn` (rad);
     |patch area - facet area| <= area_err * facet area;
     |integral over the patch of the turn vector (rad, in the facet's plane)| <= bias * facet area;
     integral over the patch of the squared turn (rad^2) <= rms_turn^2 * facet area.
   All are zero for polyhedra. The bounds hold for the exact dimensions and include the rounding of
   the mesh's own vertices. They are invariant under rigid motions, reflections and uniform scaling
   (the rounding of these is not included). */
typedef struct lrcs_patch_bounds {
    double turn;
    double area_err;
    double bias;
    double rms_turn;
} lrcs_patch_bounds;

/* How finely to tessellate. */
typedef struct lrcs_fineness {
    double tolerance;    /* target relative error of sigma, > 0 */
    lrcs_brdf brdf;      /* its material */
    uint32_t max_facets; /* limit, >= 64 */
} lrcs_fineness;

/* Fineness for tolerance 1e-4, the default brdf, at most 2^21 facets. */
lrcs_fineness lrcs_fineness_default(void);

/* Divisions of a shape's mesh, chosen by lrcs_shape_count, used by lrcs_shape_mesh. */
typedef struct lrcs_divisions {
    uint32_t around; /* sectors: a multiple of 4, 8 .. 2^24; 4 for plate and box */
    uint32_t along;  /* zones of a dome, a paraboloid, half a sphere: 1 .. 2^24; 1 otherwise */
    int level_zones; /* of these: 1: zones are at the heights of true circles; 0: at heights for
                        which each facet's normal is the mean normal of its patch */
} lrcs_divisions;

/* Chooses divisions for a shape and fineness, and counts the mesh they make (one part, no
   materials; text_bytes for the part's name). Curved bodies: the smallest number of facets for
   which the proved error (from lrcs_patch_bounds, and bounds of the brdf) meets the tolerance at
   every aspect of a sampled set, relative to sigma or to its mean over attitudes, whichever is
   larger; at most max_facets. If even max_facets do not reduce the error below sigma itself, the
   glint is disregarded and the diffuse term determines the count.
   Status: LRCS_OK; LRCS_E_ARGUMENT, LRCS_E_NUMBER (shape, as lrcs_shape_check; fineness).
   Work: O(around log around); milliseconds. */
int lrcs_shape_count(const lrcs_shape *shape, const lrcs_fineness *fineness,
                     lrcs_divisions *divisions, lrcs_mesh_counts *counts);

/* Makes the mesh. Facets share vertices by position and face outward; the mesh is symmetric to the
   bit; coordinates are accurate to a few ulp. Every circle becomes an N-gon of the same area with
   its first corner on +x. The length of a cylinder, cone or frustum is kept. The curved wall is
   smoothing group 1; flat faces are in none. bounds may be NULL. Status: LRCS_OK;
   LRCS_E_ARGUMENT, LRCS_E_NUMBER (shape, or divisions invalid for it); LRCS_E_MEMORY. */
int lrcs_shape_mesh(const lrcs_shape *shape, const lrcs_divisions *divisions, lrcs_work *work,
                    lrcs_mesh *mesh, lrcs_patch_bounds *bounds);

#endif
