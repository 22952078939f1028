/* SPDX-License-Identifier: MIT */
/* What one facet hides of another, as a convex region of the view plane: the projection of the
   occluder, cut by the half-space in front of the other's plane. */
#ifndef LRCSI_OCCLUDER_H
#define LRCSI_OCCLUDER_H

#include "view/view.h"
#include "visibility/clip.h"

/* The facet that may be hidden, in its own frame: relative to its first corner, view axes. */
typedef struct lrcsi_target {
    const lrcsi_view *view;
    uint32_t facet;
    double corner[3][2]; /* counter-clockwise in the view */
    double reach;        /* largest distance, in space, of a corner from the first */
    double diameter;     /* its longest side in the view, upper bound */
    double perimeter;    /* in the view, upper bound */
} lrcsi_target;

void lrcsi_target_make(const lrcsi_view *view, uint32_t facet, lrcsi_target *target);

typedef struct lrcsi_occluder {
    lrcsi_clip_region region;
    double error; /* the rim by which the region may be wrong, times four sides; infinite where the
                     two planes lie too close to tell where they meet */
} lrcsi_occluder;

/* 1 and the region, where `other` hides some of the target; 0 where it hides nothing, or no more
   than the error, which is set either way. */
int lrcsi_occluder_make(const lrcsi_target *target, uint32_t other, lrcsi_occluder *occluder);

#endif
