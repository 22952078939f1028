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
    double outline; /* the rim's length, upper bound; infinite where the region is so narrow that
                       lines as far off as that may run on beyond its ends */
    double charged; /* visibility/occlude.c: what it may be wrong by in the cells that it cut */
} lrcsi_occluder;

/* 1 and the region, where `other` hides some of the target; 0 where it hides nothing, or no more
   than the error, which is set either way, and so is the outline. */
int lrcsi_occluder_make(const lrcsi_target *target, uint32_t other, lrcsi_occluder *occluder);

/* The box of where `other`, which touches the target's inside, meets the target's plane: of all of
   `other` where that is the same plane, or cannot be told. As computed; returns the largest
   distance, in space, of a corner from the target's first. */
double lrcsi_occluder_contact(const lrcsi_target *target, uint32_t other, double low[2],
                              double high[2]);

#endif
