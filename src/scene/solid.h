/* SPDX-License-Identifier: MIT */
/* What can be proved about a scene's surface for all directions: closed and outward, convex. */
#ifndef LRCSI_SOLID_H
#define LRCSI_SOLID_H

#include "scene/prepared.h"

/* Divides the surface into shells: facets are in the same one if they are connected across edges.
   shell[facet] is the first facet of its shell. Returned: 1 if every edge of a live facet has
   exactly two live facets, which traverse it in opposite senses, and no facet has an opposite (two
   opposite facets enclose no volume, so no such scene is solid); else 0, and shell is undefined. */
int lrcsi_solid_shells(const lrcs_prepared *prepared, uint32_t *shell);

/* The last step of a proof that the winding number of the live facets is nowhere negative. The
   proof requires that all shells are closed (lrcsi_solid_shells), that no facet meets the inside
   or a side of another facet of its shell (lrcsi_intersections.self), and that each shell
   encloses a positive volume, which this function checks. By the second condition a shell meets
   itself at most in isolated points (coinciding corners, sides that cross): if two parts of the
   surface met along a line, they would do so inside a facet or along overlapping sides, of which
   one ends inside the other. Near an isolated point each of the two parts stays on one side of the
   other, because it is still connected when the point is removed; so it can be moved away from it.
   The result is an embedded surface: its winding number is 0 outside and 1 inside (Jordan-Brouwer),
   and winding numbers of shells add up. *proved: 1, or 0 if the volume of some shell is not
   provably positive. Given: the conditions above except the volume. Scratch is taken from work.
   Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_solid_outward(const lrcs_prepared *prepared, const uint32_t *shell, lrcs_work *work,
                        int *proved);

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
