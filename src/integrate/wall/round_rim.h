/* SPDX-License-Identifier: MIT */
/* The rim of an open round wall (a dome or paraboloid without its base) above its own inside. The
   laser sees that part of the inside which lies in the projection of the opening: a polygon for the
   facets, an ellipse for the true surface. Between a side of the polygon and its arc of the ellipse
   is a margin (integrate/wall/round_sector.h). This adds, for the sets C of round_pieces.h, the
   integral of G of the inside over these margins, or a bound on it.

   Let the side's facet face the laser, so that the wall beyond it hides the inside. Where the arc
   is outside the sector of that facet, the opening is smaller than the polygon by the margin, and
   the integral is to be subtracted. This holds if the margin lies above facets of C alone, and no
   shadow of another part ends on these (lrcsi_proximity_band.parts): then other parts hide all of
   them, in truth too, or nothing of them. They are connected, since the inside above a
   neighbourhood of the margin is; so they hide nothing if anything of one of these facets is
   visible. For any other margin, G's bound times the area is an error, in either direction. Where
   the side's facet faces away, and the true wall does too, the side is part of the border of C, or
   belongs to a patch that is entirely visible, and there is nothing to add. */
#ifndef LRCSI_ROUND_RIM_H
#define LRCSI_ROUND_RIM_H

#include "integrate/wall/round_sector.h"
#include "integrate/wall/wall_terms.h"
#include "visibility/base/visible_area.h"
#include "visibility/proximity/proximity_band.h"

/* Bytes for lrcsi_round_rim_add, at most. */
size_t lrcsi_round_rim_need(const lrcs_prepared *prepared);

/* For the wall's inside. Given: the visible areas of all facets, terms[facet_count] with all
   pieces. Returns 0, and adds nothing, if there is no memory, a side is not known, or a margin is
   wider than twice the part's reach; then no facet of the inside may be in a set. */
int lrcsi_round_rim_add(const lrcsi_round_wall *inside, const lrcsi_proximity_band *band,
                        const lrcsi_visible_area *visible, lrcs_work *work,
                        lrcsi_wall_terms *terms);

#endif
