/* SPDX-License-Identifier: MIT */
/* A part's joint and placement, prepared for transforming points. */
#ifndef LRCSI_PLACE_H
#define LRCSI_PLACE_H

#include <lrcs/scene.h>

/* Steps that are the identity are left out, so that they cannot round. */
typedef struct lrcsi_placer {
    int has_joint, has_scale, has_rotation, has_translation; /* 0: the step is the identity */
    int reflects; /* the map contains a reflection, so that windings must be reversed */
    double joint[3][3], origin[3];
    lrcs_place place;
} lrcsi_placer;

/* Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (a scale of 0, a rotation of
   determinant 0, a joint's axis of zero length). */
int lrcsi_placer_make(const lrcs_place *place, const lrcs_joint *joint, lrcsi_placer *placer);

/* Places a point: translate + rotate (scale (joint (given))), rounded. */
void lrcsi_placer_run(const lrcsi_placer *placer, const double given[3], double placed[3]);

/* The directions of a shape's axes after placement, in double-double: the columns of the product of
   the rotations nearest to the given matrices of place and joint, including reflections. Absolute
   error 2^-97; zero if every entry is 0, 1 or -1 (`exact`). Returns 0, and fills in nothing, if a
   matrix differs from a rotation or reflection by more than 2^-40, or if the absolute scale differs
   between axes. */
typedef struct lrcsi_axes {
    double high[3][3], low[3][3]; /* axis, component */
    int exact;
} lrcsi_axes;
int lrcsi_placer_axes(const lrcsi_placer *placer, lrcsi_axes *axes);

/* How normals are transformed: by the inverse transpose of the linear map, times the least absolute
   scale, so that its largest singular value is 1. image[j]: the image of a unit normal along axis j
   of the shape, accurate to 4 u; without distortion it is the axis itself. *area: an element of
   area with unit normal N is multiplied by *area times the length of N's image, relative to the
   square of the largest absolute scale. Returns 0 if a matrix is not a rotation or reflection to
   2^-40, or if scales differ by more than a factor of 2^20; then nothing is filled in. */
int lrcsi_placer_normals(const lrcsi_placer *placer, double image[3][3], double *area);

/* Upper bounds on the largest singular value of the linear map, and on its condition number (the
   ratio of the largest to the smallest singular value); infinite if a matrix is far from a
   rotation. */
void lrcsi_placer_singular_values(const lrcsi_placer *placer, double *largest, double *condition);

/* Transforms a normal by the inverse transpose of the linear map, so that outward normals stay
   outward. The length may change. */
void lrcsi_placer_normal(const lrcsi_placer *placer, double normal[3]);

/* An upper bound on the distance of a placed point from the exact image of its true point, both
   under the given matrices and under the rotations nearest to them (lrcsi_placer_axes). Given: the
   true point's coordinates are at most `size` in magnitude, and those of the point that was placed
   are within `error` of them. */
double lrcsi_placer_error(const lrcsi_placer *placer, double size, double error);

#endif
