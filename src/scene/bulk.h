/* SPDX-License-Identifier: MIT */
/* The region of most of a scene's vertices. It holds the origin of views, so that a few distant
   vertices neither increase the rounding errors of the rest (which grow with the distance from the
   origin) nor leave it in a single cell of a grid (visibility/grid.h). */
#ifndef LRCSI_BULK_H
#define LRCSI_BULK_H

#include "scene/prepared.h"

/* Given the box around the live facets (centre, half sides `half`): fills prepared->origin and
   prepared->bulk. Both are the box's own unless a small part of the vertices accounts for most of
   its size. No proof depends on their values: any box would be valid. O(vertices). */
void lrcsi_bulk_find(lrcs_prepared *prepared, const double half[3]);

#endif
