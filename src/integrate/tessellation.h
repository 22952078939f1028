/* SPDX-License-Identifier: MIT */
/* What flat facets in the place of curved shapes may cost: Eq. 2 over the true shapes, with their
   true shadows, against Eq. 2 over the facets. */
#ifndef LRCSI_TESSELLATION_H
#define LRCSI_TESSELLATION_H

#include "visibility/proximity_band.h"
#include "visibility/visible.h"

/* 1 where that error can be bounded: every part's curvature is known. */
int lrcsi_tessellation_known(const lrcs_prepared *prepared, int unshadowed);

/* A bound on it for one facet that is not skipped and its patch, scaled, without the 4 pi.
   Given: what the facet wears; the visible areas of all facets; the margin of doubt, or NULL where
   every front is wholly visible or what could be hidden is in the visible area's bounds. */
double lrcsi_tessellation_error(const lrcsi_view *view, uint32_t facet, const lrcs_brdf *brdf,
                                const lrcsi_incidence *incidence, const lrcsi_visible *visible,
                                const lrcsi_proximity_band *margin);

#endif
