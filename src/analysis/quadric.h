/* SPDX-License-Identifier: MIT */
/* Points relative to a plane, cylinder, sphere or cone, in plain doubles; fitting one to points. */
#ifndef LRCSI_QUADRIC_H
#define LRCSI_QUADRIC_H

#include <lrcs/quadric.h>

/* A point relative to a surface; letters as in quadric.c. */
typedef struct lrcsi_quadric_at {
    double q[3], r[3]; /* from the surface's point; from its axis (of a sphere: its centre) */
    double z, rho;     /* along the axis; |r| */
    double cos, sin;   /* of the half angle */
    double radius;     /* 0 for a cone */
    double distance;   /* signed, accurate to 80 u (|q| + radius) */
} lrcsi_quadric_at;

lrcsi_quadric_at lrcsi_quadric_locate(const lrcs_quadric *surface, const double p[3]);

/* The outward unit normal of the surface at the point nearest to a point off the axis; for a plane
   its axis. */
void lrcsi_quadric_normal(const lrcs_quadric *surface, const lrcsi_quadric_at *at, double n[3]);

/* n = twice the facet's vector area; returns the product of the lengths of two sides. */
double lrcsi_quadric_cross(const lrcs_point corner[3], double n[3]);

/* LRCS_OK if the numbers define a surface; else as of lrcs_quadric_facet_bound. */
int lrcsi_quadric_check(const lrcs_quadric *surface);

/* The surface of a kind that three neighbouring facets with corners on it determine (two for a
   cylinder, the first alone for a plane): 1, or 0 if they do not. */
int lrcsi_quadric_guess(int kind, const lrcs_point corner[9], lrcs_quadric *surface);

/* Fits a surface to points by least squares of their distances: point i is
   vertex[facet[i / 3].corner[i % 3]] of every `stride`-th of the facets listed. One Gauss-Newton
   step from what `surface` holds; 0 if that fails. */
int lrcsi_quadric_step(lrcs_quadric *surface, const lrcs_scene *scene, const uint32_t *facet,
                       uint32_t count, uint32_t stride);

#endif
