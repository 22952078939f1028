/* SPDX-License-Identifier: MIT */
/* The tessellation error: the difference between Eq. 2 over the true curved shapes, with their true
   shadows, and Eq. 2 over the facets that replace them. */
#ifndef LRCSI_TESSELLATION_H
#define LRCSI_TESSELLATION_H

#include "integrate/patch.h"
#include "visibility/proximity_band.h"
#include "visibility/visible.h"

/* 1 if that error can be bounded: the curvature of every part must be known, and one of these must
   hold: no front facet is hidden; a proximity band bounds the difference in visibility; no shadows
   are searched for, so that the bound includes everything that could be hidden. */
int lrcsi_tessellation_known(const lrcs_prepared *prepared, const lrcsi_plan *plan);

/* Bounds on the error: the true value exceeds that of the facets, and the correction if there is
   one, by at most `above`, and falls below it by at most `below`. Scaled, without the factor 4 pi.
 */
typedef struct lrcsi_tessellation {
    double above, below;
    double glint, diffuse; /* the correction: what is to be added to the facet's terms because only
                              a part of it is visible, and F varies over its patch */
    int corrected;         /* 0: there is none; both are 0 */
} lrcsi_tessellation;

/* The bounds for one facet that is not skipped, and its patch. Given: the facet's incidence; the
   visible areas of all facets; the proximity band, or NULL if every front is entirely visible or
   the bounds of the visible area include what could be hidden; the moments of the visible regions
   of all undecided facets, or NULL for an error without a correction; the patch of the last facet,
   or one with side = 0. */
lrcsi_tessellation lrcsi_tessellation_error(const lrcsi_view *view, const lrcsi_plan *plan,
                                            uint32_t facet, const lrcsi_incidence *incidence,
                                            const lrcsi_visible *visible,
                                            const lrcsi_moment *moment,
                                            const lrcsi_proximity_band *band, lrcsi_patch *patch);

/* Numbers that bound the tessellation error of the part of a facet where a coordinate, such as the
   range, lies in an interval. The map between facet and patch changes the coordinate by at most the
   part's reach. Scaled, without the factor 4 pi. */
typedef struct lrcsi_patch_parts {
    double whole;     /* the error of the whole facet: the larger of `above` and `below` */
    int lit;          /* 1: the facet is visible, at least in part; 0: only `whole` is valid, and
                              holds for any interval */
    double deviation; /* the difference between F on the patch and on the facet; to be multiplied
                         by the fraction of the facet whose points may be in the interval */
    double shift;     /* what the facet reflects; to be multiplied by the fraction whose points may
                         be in the interval, or visible, on only one of patch and facet: */
    double mismatch;  /* the fraction that may be visible on only one of them */
    double upper_bound; /* of what the true surface reflects; to be multiplied by the fraction that
                           may be in the interval */
    uint32_t partner;   /* `whole` holds for the sum over this facet and the given one */
} lrcsi_patch_parts;

/* These numbers for one facet that is not skipped. Given: as for lrcsi_tessellation_error. */
lrcsi_patch_parts lrcsi_tessellation_parts(const lrcsi_view *view, const lrcsi_plan *plan,
                                           uint32_t facet, const lrcsi_incidence *incidence,
                                           const lrcsi_visible *visible,
                                           const lrcsi_proximity_band *band, lrcsi_patch *patch);

#endif
