/* SPDX-License-Identifier: MIT */
/* Bodies of revolution divided into sectors, and by rows of vertices into zones of facets. Every
   tessellated kind except plate and box is a body of revolution. */
#ifndef LRCSI_REVOLUTION_H
#define LRCSI_REVOLUTION_H

#include <lrcs/shape.h>

#include "base/constant.h"

/* Is the surface of a kind of shape doubly curved: of a sphere, dome or paraboloid? Only these have
   more than one zone. */
static inline int lrcsi_shape_is_round(int kind)
{
    return kind == LRCS_SHAPE_SPHERE || kind == LRCS_SHAPE_DOME || kind == LRCS_SHAPE_PARABOLOID;
}

/* Is it a plate or box, and so no body of revolution? */
static inline int lrcsi_shape_is_plane_faced(int kind)
{
    return kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_BOX;
}

/* A body's wall, from the base up. For the sphere it is the upper half; the lower half is its
   mirror image. */
typedef struct lrcsi_revolution {
    int kind;
    double base, top, height; /* m: radii at z = 0 and at the upper end, and the end's z */
    uint32_t around, zones;   /* sectors; zones of facets in the wall (0: a disc) */
    double half;              /* h = pi / around, half a sector */
    double vertex_ratio;      /* vertex radius / true radius: the polygon has the circle's area */
    double slope;             /* paraboloid: 2 H / R, the tangent of the angle at its rim */
    double step;              /* rad of meridian between zones; 0 for straight walls */
    int level_zones;          /* lrcs_divisions.level_zones, of curved walls */
} lrcsi_revolution;

/* Divides a shape that lrcs_shape_check accepts and that is neither plate nor box; the divisions
   are in range. */
lrcsi_revolution lrcsi_revolution_make(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* True radius of row i, 0 (base) .. zones (upper end), m; exactly 0 at an apex. */
double lrcsi_revolution_radius(const lrcsi_revolution *body, uint32_t i);

/* The height of row i + 1 of the mesh above row i, m. */
double lrcsi_revolution_rise(const lrcsi_revolution *body, uint32_t i);

/* The numbers of lrcs_patch_bounds, proved, over all facets of the wall. */
lrcs_patch_bounds lrcsi_revolution_patch_bounds(const lrcsi_revolution *body);

/* An upper bound of the angle (rad) by which rounding of the vertices rotates the facets between
   rows i and i + 1, and of the relative change of their areas. */
double lrcsi_revolution_rounding(const lrcsi_revolution *body, uint32_t i);

/* --- what the proofs about zones share ------------------------------------------------------- */

/* Covers rounding in D (revolution.c), which is 1 minus a quotient of sums of positive products,
   computed with 20 roundings or functions accurate to 2 units; and in A/A' - 1 likewise. */
#define LRCSI_REVOLUTION_SLACK (64.0 * LRCSI_U)

/* A zone's patch and facet: areas and vector areas, all in the same unit, which is arbitrary. */
typedef struct lrcsi_zone {
    double area, across, up; /* A, X, V */
    double gain;             /* X' / X */
    double low, high;        /* elevation of the true normal on the lower and the upper circle */
} lrcsi_zone;

/* Is the wall straight? Given: a body that has zones. */
int lrcsi_revolution_is_straight(const lrcsi_revolution *body);

/* Angle on the meridian from the top to row i. */
double lrcsi_revolution_polar(const lrcsi_revolution *body, uint32_t i);

/* Paraboloid: slope of the surface at row i, and its radius as a fraction of the base's. */
double lrcsi_revolution_tangent(const lrcsi_revolution *body, uint32_t i);
double lrcsi_revolution_fraction(const lrcsi_revolution *body, uint32_t i);

/* The rise between the true circles of rows i and i + 1 of a curved wall. */
double lrcsi_revolution_level_rise(const lrcsi_revolution *body, uint32_t i);

/* Zone i, between rows i and i + 1. */
lrcsi_zone lrcsi_zone_make(const lrcsi_revolution *body, uint32_t i);

#endif
