/* SPDX-License-Identifier: MIT */
/* What is known about the visibility of a facet and of the patch of the true surface that it
   represents: a state, and bounds on fractions. The proofs that use them:
   integrate/wall/tessellation.c. Given to each function: the visible areas of all facets; the
   proximity band, or NULL if every front is entirely visible or the bounds of the visible area
   include what could be hidden. */
#ifndef LRCSI_PATCH_VISIBILITY_H
#define LRCSI_PATCH_VISIBILITY_H

#include "integrate/wall/patch.h"
#include "visibility/base/visible_area.h"
#include "visibility/proximity/masked_band.h"

enum lrcsi_patch_state {
    LRCSI_PATCH_AWAY,    /* no side of the facet that reflects faces the laser */
    LRCSI_PATCH_VISIBLE, /* facet and patch are entirely visible */
    LRCSI_PATCH_HIDDEN,  /* the facet is hidden, except for a tiny fraction of it */
    LRCSI_PATCH_PARTIAL  /* none of these */
};

/* Upper bounds of fractions of a facet: */
typedef struct lrcsi_patch_fractions {
    double hidden;       /* hidden, or not known to be visible, by facets */
    double gain, loss;   /* as in lrcsi_masked_band; only what is hidden may be gained, and only
                          what is visible lost */
    double visible;      /* visible on the true surface */
    double margin_added; /* the size of the area that the sum adds because of margins */
    double margin_max;   /* lrcsi_wall_margin.area_max */
} lrcsi_patch_fractions;

/* The state of a facet that is not skipped, a lrcsi_patch_state; that of its partner, which counts
   as hidden if it is skipped. */
int lrcsi_patch_state_of(const lrcsi_view *view, uint32_t facet, const lrcsi_visible_area *visible,
                         const lrcsi_masked_band *band);
int lrcsi_patch_partner_state(const lrcsi_view *view, uint32_t facet,
                              const lrcsi_visible_area *visible, const lrcsi_masked_band *band);

/* Is something of a patch in this state visible? */
static inline int lrcsi_patch_is_visible(int state)
{
    return state == LRCSI_PATCH_VISIBLE || state == LRCSI_PATCH_PARTIAL;
}

/* The fractions of a facet of which a side that reflects faces the laser. margins: 1 if the margins
   (visibility/proximity/wall_margin.h) are accounted for elsewhere. */
lrcsi_patch_fractions lrcsi_patch_fractions_of(const lrcsi_incidence *incidence, uint32_t facet,
                                               const lrcsi_visible_area *visible,
                                               const lrcsi_masked_band *band, int margins);

/* The margins of other parts' event edges on a facet; NULL if it has none or is hidden by other
   parts. */
static inline const lrcsi_wall_margin *lrcsi_wall_margin_of(const lrcsi_masked_band *band,
                                                            uint32_t facet)
{
    const lrcsi_wall_margin *margin = &band->whole->margin[facet];
    return margin->area_max + margin->area_err > 0 && !lrcsi_masked_band_is_hidden(band, facet)
               ? margin
               : NULL;
}

/* What the sum adds to the visible area of a facet because of them. Of a facet of which nothing is
   visible the sum includes nothing. */
static inline double lrcsi_wall_margin_area(const lrcsi_masked_band *band,
                                            const lrcsi_visible_area *visible, uint32_t facet)
{
    const lrcsi_wall_margin *margin = lrcsi_wall_margin_of(band, facet);
    return margin && visible[facet].high > 0 ? margin->area : 0;
}

/* An upper bound of the visible fraction of a facet that counts as hidden. */
double lrcsi_patch_visible_max(const lrcsi_incidence *incidence, uint32_t facet,
                               const lrcsi_visible_area *visible, const lrcsi_masked_band *band);

#endif
