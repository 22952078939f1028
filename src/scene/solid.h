/* SPDX-License-Identifier: MIT */
/* What can be proved about a scene's surface for all directions: which shells of it are solid, and
   whether it is convex. */
#ifndef LRCSI_SOLID_H
#define LRCSI_SOLID_H

#include "scene/prepared.h"

/* Divides the surface into shells: facets are in the same one if they are connected across edges. A
   shell is closed if every edge of its facets has exactly two live facets, which traverse it in
   opposite senses, and none of its facets coincides with another one. Returned in the arrays of
   `shells`: of each facet the first facet of its shell, or LRCS_NONE if that is not closed; and
   self[], all 0, to be set by lrcsi_intersection_make. */
void lrcsi_solid_shells(const lrcs_prepared *prepared, const lrcsi_shells *shells);

/* Finds the solid shells. A shell is solid if it is closed, no facet of it meets the inside or a
   side of another one of it (shells->self), and it encloses a positive volume. By the second
   condition it meets itself at most in isolated points (coinciding corners, sides that cross): if
   two parts of the surface met along a line, they would do so inside a facet or along overlapping
   sides, of which one ends inside the other. Near an isolated point each of the two parts stays on
   one side of the other, because a disc without that point is still connected; so it can be moved
   away from it. The result is an embedded surface: its winding number is 0 outside and 1 inside
   (Jordan-Brouwer).

   On a line to the laser the winding number becomes larger by 1 where the line meets a back of the
   shell, smaller by 1 where it meets a front, and is 0 in the end. Since it is never negative, it
   is at least 1 after a back, and a front follows: the backs of a solid shell are never seen, and
   hide nothing that its fronts do not hide. Its facets get LRCSI_REDUNDANT_IN_SOLID, unless any of
   them belongs to a curved shape, whose visibility may differ from that of its facets. Sets
   prepared->solid and solid_shells. Given: shells (lrcsi_solid_shells, lrcsi_intersection_make).
   Scratch is taken from work. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_solid_find(lrcs_prepared *prepared, const lrcsi_shells *shells, lrcs_work *work);

/* 1 if the scene is convex by construction: all live facets belong to one part that the library
   tessellated, which lies on a convex surface, outward, and is one-sided or closed (*solid is set
   to whether it is closed). 0 if the body is thinner than 1e6 times the error of its vertices. */
int lrcsi_convex_by_construction(const lrcs_prepared *prepared, int *solid);

/* The grazing threshold of a scene that is convex by construction: a facet with cos(theta) above it
   is entirely visible, in spite of the concavities that rounding and, on doubly curved bodies, the
   choice of diagonals may have left. Given: the normals. */
double lrcsi_convex_grazing(const lrcs_prepared *prepared);

/* Tries to prove that the live facets of a solid scene are the boundary of one convex body, exactly
   (mesh/convex.h). Status: LRCS_OK; LRCS_E_MEMORY. Work: lrcsi_convex_exact_need bytes while it
   runs. */
size_t lrcsi_convex_exact_need(const lrcs_scene *scene);
int lrcsi_convex_exact(const lrcs_prepared *prepared, lrcs_work *work, int *proved);

#endif
