/* SPDX-License-Identifier: MIT */
/* What the planner can prove about a scene's shape, whatever the direction. */
#ifndef LRCSI_SOLID_H
#define LRCSI_SOLID_H

#include "scene/prepare.h"

/* Proves that the winding number of the live facets is nowhere negative: in every piece
   connected over edges, two facets stand on each edge, in opposite directions; no facet meets the
   inside of another; no corner lies inside a side; and the volume is positive. Then the piece
   meets itself in lone points at most (corners in one place, sides that cross): two sheets that
   meet along a line do so inside a facet or along overlapping sides, of which one ends inside the
   other. A sheet less such a point is connected, so it stays on one side of the other sheet and
   can be moved off it. What results is an embedded surface: winding number 0 outside and 1 inside
   (Jordan-Brouwer), and winding numbers add. 1: proved, 0: not; scratch from work.
   Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_solid_check(const lrcs_prepared *prepared, lrcs_work *work, int *proved);

/* Proves that all live facets lie on one convex surface, outward and one-sided. Exactly so
   (lrcs_mesh_check): *graze is 0. Or by construction (one engine-made part): then rounding, and
   on doubly curved bodies the choice of diagonals, may have left dents; a front facet with
   cos(theta) > *graze is wholly visible all the same. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_convex_check(const lrcs_prepared *prepared, lrcs_work *work, int *proved, double *graze);

#endif
