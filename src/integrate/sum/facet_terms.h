/* SPDX-License-Identifier: MIT */
/* What one facet with a flat normal, or one patch of a curved wall, adds to sigma. */
#ifndef LRCSI_FACET_TERMS_H
#define LRCSI_FACET_TERMS_H

#include "integrate/wall/patch.h"
#include "visibility/base/visible_area.h"

/* Scaled, with the factor 4 pi. */
typedef struct lrcsi_facet_terms {
    double glint, diffuse;
    double rounding; /* bound on the rounding error of glint + diffuse, for any visible area up to
                        visible->high */
    double per_area; /* glint + diffuse per unit of visible area */
} lrcsi_facet_terms;

/* Computes these terms. Given: a facet that reflects towards the laser, its incidence, its visible
   area. */
lrcsi_facet_terms lrcsi_facet_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t facet, const lrcsi_incidence *incidence,
                                         const lrcsi_visible_area *visible, lrcsi_patches *patches);

/* A bound on the underflow error of a facet's terms, scaled: some 30 operations lose at most
   2^-1075 each, and no later operation enlarges a loss relative to its term. */
#define LRCSI_FACET_UNDERFLOW 0x1p-1070

#endif
