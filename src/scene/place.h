/* SPDX-License-Identifier: MIT */
/* A part's joint and place, made ready to move points. */
#ifndef LRCSI_PLACE_H
#define LRCSI_PLACE_H

#include <lrcs/scene.h>

/* Which steps do something: the others are left out, so that they cannot round. */
typedef struct lrcsi_placer {
    int turns, scales, rotates, moves;
    int flips; /* mirrors: the winding is to be turned round */
    double joint[3][3], origin[3];
    lrcs_place place;
} lrcsi_placer;

/* Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (a scale of 0, a rotation of
   determinant 0, a joint's axis of no length). */
int lrcsi_placer_make(const lrcs_place *place, const lrcs_joint *joint, lrcsi_placer *placer);

/* translate + rotate (scale (joint (given))), rounded. */
void lrcsi_placer_run(const lrcsi_placer *placer, const double given[3], double placed[3]);

/* A normal under the same: by the inverse transpose of the linear map, so that what was outward
   stays so, but for length. */
void lrcsi_placer_normal(const lrcsi_placer *placer, double normal[3]);

/* How far a placed point may lie from the exact image of the true one under the same matrices: a
   bound on the distance, where the true point's coordinates are at most `most` and those given are
   within `error` of them. */
double lrcsi_placer_error(const lrcsi_placer *placer, double most, double error);

#endif
