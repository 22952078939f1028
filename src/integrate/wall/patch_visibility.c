/* SPDX-License-Identifier: MIT */
/* Classifies patches by what is known about their visibility. It does not decide what that costs
   (integrate/wall/wall_error.c, tessellation.c). */
#include "integrate/wall/patch_visibility.h"

#include <math.h>

#include "base/constant.h"

/* A facet of which at most this fraction can be visible counts as hidden; what may be visible of it
   is then part of its error. A heuristic: the bounds hold for any fraction. */
#define HIDDEN_FRACTION 0x1p-20

/* Does the back of a facet face the laser and reflect? The inside of a closed curved part is always
   hidden, even if rounding has turned a facet of it towards the laser. */
static int back_reflects(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_part *part = lrcsi_patch_part(view->prepared, facet);
    return view->facing[facet] < 0 && lrcsi_view_reflects(view, facet) &&
           !(part->bounds.reach > 0 && part->solid);
}

int lrcsi_patch_state_of(const lrcsi_view *view, uint32_t facet, const lrcsi_visible_area *visible,
                         const lrcsi_masked_band *band)
{
    if (band && lrcsi_masked_band_is_hidden(band, facet)) {
        return LRCSI_PATCH_HIDDEN;
    }
    if (view->facing[facet] <= 0 && !back_reflects(view, facet)) {
        return LRCSI_PATCH_AWAY;
    }
    if (!band || (lrcsi_masked_mismatch(band, facet) == 0 &&
                  !band->whole->classification->undecided[facet] && visible[facet].low > 0)) {
        return LRCSI_PATCH_VISIBLE;
    }
    return visible[facet].high > HIDDEN_FRACTION * lrcsi_view_projected(view, facet)
               ? LRCSI_PATCH_PARTIAL
               : LRCSI_PATCH_HIDDEN;
}

int lrcsi_patch_partner_state(const lrcsi_view *view, uint32_t facet,
                              const lrcsi_visible_area *visible, const lrcsi_masked_band *band)
{
    uint32_t partner = lrcsi_patch_partner(view->prepared, facet);
    return view->prepared->skip[partner] ? LRCSI_PATCH_HIDDEN
                                         : lrcsi_patch_state_of(view, partner, visible, band);
}

lrcsi_patch_fractions lrcsi_patch_fractions_of(const lrcsi_incidence *incidence, uint32_t facet,
                                               const lrcsi_visible_area *visible,
                                               const lrcsi_masked_band *band, int margins)
{
    double error = incidence->error + 8 * LRCSI_U;
    lrcsi_patch_fractions f = {0, 0, 0, 1, 0, 0};
    if (!band) {
        return f;
    }
    if (band->whole->classification->undecided[facet] || !(visible[facet].low > 0)) {
        f.hidden = 1 + error - visible[facet].low / incidence->projected;
    }
    f.hidden = f.hidden >= 0 ? fmin(1, f.hidden) : 1;
    double visible_most = visible[facet].high / incidence->projected * (1 + 2 * error);
    const int less = margins && !band->facet_hidden[facet]; /* 0 of hidden facets anyway */
    const lrcsi_wall_margin *margin = &band->whole->margin[facet];
    f.gain = fmin(less ? margin->gain : lrcsi_masked_gain(band, facet), f.hidden);
    f.loss = fmin(less ? margin->loss : lrcsi_masked_loss(band, facet), visible_most);
    f.visible = fmin(1, visible_most + fmin(lrcsi_masked_gain(band, facet), f.hidden));
    if (margins && lrcsi_wall_margin_of(band, facet)) {
        const double unit = (1 + 2 * error) / incidence->projected;
        f.margin_added = fabs(lrcsi_wall_margin_area(band, visible, facet)) * unit;
        f.margin_max = margin->area_max * unit;
    }
    return f;
}

double lrcsi_patch_visible_max(const lrcsi_incidence *incidence, uint32_t facet,
                               const lrcsi_visible_area *visible, const lrcsi_masked_band *band)
{
    return !band || lrcsi_masked_band_is_hidden(band, facet) || !(visible[facet].high > 0)
               ? 0
               : fmin(1, visible[facet].high / incidence->projected * (1 + 2 * incidence->error));
}
