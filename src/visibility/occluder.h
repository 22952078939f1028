/* SPDX-License-Identifier: MIT */
/* What one facet hides of another, as a convex region of the view plane: the projection of the
   occluder, cut by the half-space in front of the other's plane. */
#ifndef LRCSI_OCCLUDER_H
#define LRCSI_OCCLUDER_H

#include "visibility/clip.h"
#include "visibility/target.h"

typedef struct lrcsi_occluder {
    lrcsi_clip_region region;
    double error; /* the rim by which the region may be wrong, times four sides; infinite where the
                     two planes lie too close to tell where they meet */
} lrcsi_occluder;

/* 1 and the region, where `other` hides some of the target; 0 where it hides nothing, or no more
   than the error, which is set either way. */
int lrcsi_occluder_make(const lrcsi_target *target, uint32_t other, lrcsi_occluder *occluder);

#endif
