/* SPDX-License-Identifier: MIT */
/* What the planner can prove about a scene's shape, whatever the direction. */
#ifndef LRCSI_SOLID_H
#define LRCSI_SOLID_H

#include "scene/prepare.h"

/* Proves that the winding number of the live facets is nowhere negative: every connected piece is
   a closed two-manifold that nowhere touches itself, with positive volume; such a piece has
   winding number 0 outside and 1 inside (Jordan-Brouwer), and winding numbers add. 1: proved, 0:
   not; scratch from work. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_solid_check(const lrcs_prepared *prepared, lrcs_work *work, int *proved);

/* Proves that all live facets lie on one convex surface, outward and one-sided. Exactly so
   (lrcs_mesh_check): *graze is 0. Or by construction (one engine-made part): then rounding, and
   on doubly curved bodies the choice of diagonals, may have left dents; a front facet with
   cos(theta) > *graze is wholly visible all the same. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_convex_check(const lrcs_prepared *prepared, lrcs_work *work, int *proved, double *graze);

#endif
