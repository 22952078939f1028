/* SPDX-License-Identifier: MIT */
/* Where most of a scene's vertices stand. Views measure from there, so that a few vertices far away
   neither blur the rest (rounding errors grow with the distance from the origin) nor leave it in a
   single cell of a grid (visibility/grid.h). */
#ifndef LRCSI_BULK_H
#define LRCSI_BULK_H

#include "scene/prepared.h"

/* Given the box around the live facets (centre, half sides `half`): fills prepared->origin and
   prepared->bulk. Both are the box's own unless a small part of the vertices accounts for most of
   its size. Nothing that is computed from them is proved by what they are: any box would do.
   O(vertices). */
void lrcsi_bulk_find(lrcs_prepared *prepared, const double half[3]);

#endif
