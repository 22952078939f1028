/* SPDX-License-Identifier: MIT */
/* A part's joint and place, prepared for transforming points. */
#ifndef LRCSI_PLACE_H
#define LRCSI_PLACE_H

#include <lrcs/scene.h>

/* The steps that are not the identity; the others are left out, so that they cannot round. */
typedef struct lrcsi_placer {
    int turns, scales, rotates, moves;
    int flips; /* a reflection: the winding is to be reversed */
    double joint[3][3], origin[3];
    lrcs_place place;
} lrcsi_placer;

/* Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (a scale of 0, a rotation of
   determinant 0, a joint's axis of zero length). */
int lrcsi_placer_make(const lrcs_place *place, const lrcs_joint *joint, lrcsi_placer *placer);

/* translate + rotate (scale (joint (given))), rounded. */
void lrcsi_placer_run(const lrcsi_placer *placer, const double given[3], double placed[3]);

/* The directions of a shape's axes, in double-double: column by column of the rotations nearest to
   the joint's matrix and the place's, including reflections. Absolute error 2^-97; zero if every
   entry is 0, 1 or -1 (`exact`). Returns 0 if a matrix is not a rotation or reflection to 2^-40, or
   if the absolute scale differs between axes; then nothing is filled in. */
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

/* The largest singular value of the linear map, and its ratio to the least one: bounds on both;
   infinite if a matrix is far from a rotation. */
void lrcsi_placer_stretch(const lrcsi_placer *placer, double *most, double *ratio);

/* Transforms a normal by the inverse transpose of the same linear map, so that outward stays
   outward; the length may change. */
void lrcsi_placer_normal(const lrcsi_placer *placer, double normal[3]);

/* The largest distance of a placed point from the exact image of the true one under the same
   matrices, or under the rotations nearest to them (lrcsi_placer_axes): a bound on the distance,
   where the true point's coordinates are at most `most` and those given are within `error` of
   them. */
double lrcsi_placer_error(const lrcsi_placer *placer, double most, double error);

#endif
