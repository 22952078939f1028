/* SPDX-License-Identifier: MIT */
/* Eq. 2 over round walls (of spheres, domes and paraboloids) that are partly visible, with the true
   surface above every point of the view plane: the facets decide only what is visible, and not how
   the surface reflects.

   Let C be a set of sectors of one side of one part's wall, the outside or the inside, f their
   facets, U their patches, and f' and U' the projections of these. Let G be what the true surface
   reflects per unit of projected area (integrate/wall/round_surface.h), W 1 where a facet is
   visible and 0 where it is not, and V the same for the true surface, both as functions on the view
   plane. The truth of C is T = Int_U' G V. The sum uses M = sum over f of Int_f' G W, and what is
   between U' and f' along the border of C.
   1. Within the facets of C, V and W differ only on the fractions gain_aligned and loss_aligned of
      visibility/proximity/event_band.c, 5; and on the inside between the projected openings of the
      true surface and of the facets (integrate/wall/round_rim.h).
   2. Inside C, every point of the view plane belongs to one facet and to one patch. At the border
      it may belong to one of both only. A side of a sector is a segment of f' and an arc of U'; the
      margin between them is swept by the segments from a point of one to the point of the other
      with the same parameter. The integral over U' exceeds that over f' by the sum over all sides
      of the integrals over the margins, with the sign of their areas (Stokes' theorem for the
      homotopy of both borders). Sides inside C cancel.
   3. Beside a side that is free there, W = V, all 1 or all 0: there the integral of G over the
      margin is added, or nothing. Any other margin is an error, in either direction. []

   The integrals of G over visible pieces use rules of positive weights that are exact up to degree
   n: twice the largest difference between G and its Taylor polynomial bounds their error. */
#ifndef LRCSI_ROUND_PIECES_H
#define LRCSI_ROUND_PIECES_H

#include "integrate/plan/plan.h"
#include "integrate/wall/wall_terms.h"
#include "view/clear.h"
#include "visibility/occlude.h"
#include "visibility/proximity/masked_band.h"

/* Finds the sectors, and what their facets add. Given: the shapes that have closed forms instead;
   the visible areas of all facets; a band whose hidden facets are masked; derivatives: 1 if the
   integrals are to include what derivatives need; terms[facet_count] of the sectors that are
   integrated over their patches (integrate/wall/clear_sectors.h): these are left out. Returned: the
   terms of the others. Without enough memory, or if steps run out, no sector is found. */
void lrcsi_round_pieces_make(lrcsi_classification *classification, const lrcsi_plan *plan,
                             const lrcsi_clear_shapes *clear, const lrcsi_masked_band *band,
                             const lrcsi_visible_area *visible, int derivatives, lrcsi_meter *meter,
                             lrcs_work *work, lrcsi_wall_terms *terms);

#endif
