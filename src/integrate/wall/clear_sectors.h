/* SPDX-License-Identifier: MIT */
/* Eq. 2 over sectors of which other parts hide nothing, and the part itself decides what the laser
   sees: at the limb, where it may see both sides, and on the inside of open walls, where the rim
   casts a shadow. The true surface is integrated, whose visible part is known exactly
   (integrate/wall/rim_shadow.h).

   Let the facets of a sector meet no proximity band of another part. Then any other part hides all
   of the sector's patch or nothing of it, and the same of every facet that is connected with it by
   facets of this kind (visibility/proximity/proximity_band.c, 4). If something of one of these
   facets is visible, other parts hide nothing of the patch. The laser then sees all of its inside
   that the part itself leaves visible, and all of its outside that faces the laser: that is not
   hidden by the part's own wall, which belongs to the boundary of a convex body. So the integral
   over a patch at the limb includes what faces the laser of it beyond the facets that do. */
#ifndef LRCSI_CLEAR_SECTORS_H
#define LRCSI_CLEAR_SECTORS_H

#include "integrate/plan/plan.h"
#include "integrate/wall/wall_terms.h"
#include "view/clear.h"
#include "visibility/base/visible_area.h"
#include "visibility/proximity/masked_band.h"

/* Bytes of scratch memory for lrcsi_clear_sectors_make. */
size_t lrcsi_clear_sectors_need(const lrcs_prepared *prepared);

/* Finds the sectors, and what they add: all of it to one of their facets, which may face away from
   the laser. Given: the shapes that have closed forms instead; the visible areas of all facets; a
   band whose hidden facets are masked, or NULL if there is one part alone, which is convex:
   `visible` and `work` are then not used; derivatives: 1 if the integrals are to include what
   derivatives need. Returned: terms[facet_count], LRCSI_WALL_FACET for all other facets; without
   enough memory no sector is found. */
void lrcsi_clear_sectors_make(const lrcsi_view *view, const lrcsi_plan *plan,
                              const lrcsi_clear_shapes *clear, const lrcsi_masked_band *band,
                              const lrcsi_visible_area *visible, int derivatives, lrcs_work *work,
                              lrcsi_wall_terms *terms);

#endif
