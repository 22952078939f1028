/* SPDX-License-Identifier: MIT */
/* What flat facets in the place of curved shapes may cost: Eq. 2 over the true shapes, with their
   true shadows, against Eq. 2 over the facets. */
#ifndef LRCSI_TESSELLATION_H
#define LRCSI_TESSELLATION_H

#include "integrate/patch.h"
#include "visibility/proximity_band.h"
#include "visibility/visible.h"

/* 1 if that error can be bounded: every part's curvature is known and visibility is that of the
   true shapes, because no front facet is hidden or because a proximity band bounds the difference;
   or no shadows are searched for, so that the bound includes everything that could be hidden. */
int lrcsi_tessellation_known(const lrcs_prepared *prepared, const lrcsi_plan *plan);

/* A bound on it for one facet that is not skipped and its patch, scaled, without the 4 pi.
   Given: what the facet has; the visible areas of all facets; the proximity band, or NULL if
   every front is wholly visible or what could be hidden is in the visible area's bounds; the patch
   of the last facet, or one with side = 0. */
double lrcsi_tessellation_error(const lrcsi_view *view, const lrcsi_plan *plan, uint32_t facet,
                                const lrcsi_incidence *incidence, const lrcsi_visible *visible,
                                const lrcsi_proximity_band *margin, lrcsi_patch *patch);

/* What may be wrong in a part of a patch: of the points of facet and patch, those in some interval
   of a coordinate, which the map between facet and patch changes by at most the part's reach.
   Scaled, without the 4 pi. */
typedef struct lrcsi_patch_parts {
    double whole; /* lrcsi_tessellation_error */
    int lit;      /* the facet is seen, in part at least; else `whole` bounds any part, too */
    double bend;  /* lit: F on the patch against F on the facet, times the share of the facet whose
                     points may be in the interval */
    double shift; /* lit: times the share whose points may be in the interval in truth and not on
                     the facet, or the other way round, or are seen only in one of the two: */
    double share; /* of these last */
    double most;  /* what the truth reflects, times the share that may be in the interval */
    uint32_t partner; /* `whole` needs this facet's `whole`, too: both hold together */
} lrcsi_patch_parts;

/* For one facet that is not skipped; what is given is as for lrcsi_tessellation_error. */
lrcsi_patch_parts lrcsi_tessellation_parts(const lrcsi_view *view, const lrcsi_plan *plan,
                                           uint32_t facet, const lrcsi_incidence *incidence,
                                           const lrcsi_visible *visible,
                                           const lrcsi_proximity_band *margin, lrcsi_patch *patch);

#endif
