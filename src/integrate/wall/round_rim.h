/* SPDX-License-Identifier: MIT */
/* The rim of an open round wall (a dome or paraboloid without its base) above its own inside. The
   laser sees that part of the inside which lies in the projection of the opening: a polygon for the
   facets, an ellipse for the true surface. Between a side of the polygon and its arc of the ellipse
   is a margin (integrate/wall/round_sector.h). This adds, for the sets C of round_pieces.h, the
   integral of G of the inside over these margins, or a bound on it.

   Let the side's facet face the laser, so that the wall beyond it hides the inside. Where the arc
   is outside the sector of that facet, the opening is smaller than the polygon by the margin, and
   the integral is to be subtracted. This holds for the parts of the margin that
   (a) lie above facets of C alone, and
   (b) near which no event edge of another part passes that may matter to the inside: none is closer
       in projection than r' + 2 e_P to the side there (visibility/proximity/event_band.c, 5).
   Within 2 e_P of the side, where the margin is, other parts then hide all of the inside, in truth
   and for the facets, or nothing of it. A sample next to the side tells which, in the opening of
   the facets, where the own wall hides nothing. If they hide all of it, the margin adds nothing.

   For any other part of a margin, G's bound times the area is an error, in either direction. Where
   the side's facet faces away, and the true wall does too, the side is part of the border of C, or
   belongs to a patch that is entirely visible, and the margin adds nothing. */
#ifndef LRCSI_ROUND_RIM_H
#define LRCSI_ROUND_RIM_H

#include "integrate/wall/round_sector.h"
#include "integrate/wall/wall_terms.h"
#include "visibility/base/visible_area.h"
#include "visibility/occlude.h"
#include "visibility/proximity/proximity_band.h"

/* Bytes for lrcsi_round_rim_add, at most. */
size_t lrcsi_round_rim_need(const lrcs_prepared *prepared);

/* For the wall's inside. Given: the visible areas of all facets, terms[facet_count] with all
   pieces; for samples the occlusion and the meter, which may be NULL. Returns 0, and adds nothing,
   if there is no memory, a side is not known, or a margin is wider than twice the part's reach;
   then no facet of the inside may be in a set. */
int lrcsi_round_rim_add(const lrcsi_round_wall *inside, const lrcsi_proximity_band *band,
                        const lrcsi_visible_area *visible, const lrcsi_occlusion *o,
                        lrcsi_meter *meter, lrcs_work *work, lrcsi_wall_terms *terms);

#endif
