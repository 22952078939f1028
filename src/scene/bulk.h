/* SPDX-License-Identifier: MIT */
/* The bulk of a scene: a box around most of its vertices. The origin of views is its centre, and
   grids are sized for it, so that a few distant vertices neither increase the rounding errors of
   the others (which grow with the distance from the origin) nor leave all others in a single cell
   of a grid (visibility/index/grid.h). */
#ifndef LRCSI_BULK_H
#define LRCSI_BULK_H

#include "scene/prepared.h"

/* Fills prepared->origin and prepared->bulk. Given: the box around the live facets, by
   prepared->centre and its half sides `half`. It is also the bulk, unless a small part of the
   vertices accounts for most of its size. No proof depends on the result: any box would be valid.
   O(vertices). */
void lrcsi_bulk_find(lrcs_prepared *prepared, const double half[3]);

#endif
