/* SPDX-License-Identifier: MIT */
/* What the planner can prove about a scene's shape for all directions. */
#ifndef LRCSI_SOLID_H
#define LRCSI_SOLID_H

#include "scene/prepared.h"

/* Pieces of surface, connected across edges: piece[facet] identifies its piece by its first facet.
   Returned: 1 if every edge of the live facets has exactly two of them, in opposite directions, and
   none is coincident with another (coincident facets enclose no volume, so no such scene is solid);
   else 0, and piece is undefined. */
int lrcsi_solid_pieces(const lrcs_prepared *prepared, uint32_t *piece);

/* Proves that the winding number of the live facets is nowhere negative: their pieces are closed
   (lrcsi_solid_pieces); no facet meets the inside or a side of another of its piece
   (lrcsi_intersections.self); and the volume is positive. Then the piece meets itself at most in
   isolated points (corners in one place, sides that cross): two parts of the surface that meet
   along a line do so inside a facet or along overlapping sides, of which one ends inside the other.
   A part without such a point is connected, so it stays on one side of the other part and can be
   moved off it. The result is an embedded surface: winding number 0 outside and 1 inside
   (Jordan-Brouwer), and winding numbers add. This is the last step, the volume. 1: proved, 0: not;
   scratch from work. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_solid_outward(const lrcs_prepared *prepared, const uint32_t *piece, lrcs_work *work,
                        int *proved);

/* 1 if all live facets belong to one part that the library tessellated, which lies on a convex
   surface, outward, and one-sided or closed (then also *solid): convex by construction. A body
   thinner than 1e6 roundings is refused. */
int lrcsi_convex_by_construction(const lrcs_prepared *prepared, int *solid);

/* Given such a scene with its normals. Rounding, and on doubly curved bodies the choice of
   diagonals, may have left dents; a front facet with cos(theta) above the returned value is
   nevertheless entirely visible. */
double lrcsi_convex_grazing(const lrcs_prepared *prepared);

/* Proves that the live facets of a solid scene are one convex body, exactly (mesh/convex.h).
   Status: LRCS_OK; LRCS_E_MEMORY. Work: nothing stays; lrcsi_convex_exact_need. */
size_t lrcsi_convex_exact_need(const lrcs_scene *scene);
int lrcsi_convex_exact(const lrcs_prepared *prepared, lrcs_work *work, int *proved);

#endif
