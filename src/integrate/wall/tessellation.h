/* SPDX-License-Identifier: MIT */
/* The tessellation error: the difference between Eq. 2 over the true curved shapes, with their true
   shadows, and Eq. 2 over the facets that replace them. */
#ifndef LRCSI_TESSELLATION_H
#define LRCSI_TESSELLATION_H

#include "integrate/wall/wall_error.h"

/* 1 if that error can be bounded: the bounds of every part must be known, and one of these must
   hold: no front facet is hidden; a proximity band bounds the difference in visibility; no shadows
   are searched for, so that the bound includes everything that could be hidden. */
int lrcsi_tessellation_known(const lrcs_prepared *prepared, const lrcsi_plan *plan);

/* The bounds for one facet that is not skipped. Given: its incidence. */
lrcsi_tessellation lrcsi_tessellation_error(const lrcsi_tessellation_input *in, uint32_t facet,
                                            const lrcsi_incidence *incidence,
                                            lrcsi_patches *patches);

/* Numbers that bound the tessellation error of what a facet contributes where a coordinate, such as
   the range, lies in an interval. The map between facet and patch changes the coordinate by at most
   the part's reach. Scaled, without the factor 4 pi. */
typedef struct lrcsi_interval_error {
    double whole;     /* the error of the whole facet: the larger of `above` and `below` */
    int visible;      /* 1: the facet is visible, at least in part; 0: only `whole` is valid, and
                              holds for any interval */
    double deviation; /* the difference between F on the patch and on the facet; to be multiplied
                         by the fraction of the facet whose points may be in the interval */
    double shift;     /* what the facet reflects; to be multiplied by the fraction whose points may
                         be in the interval, or visible, on only one of patch and facet: */
    double mismatch;  /* the fraction that may be visible on only one of them */
    double upper_bound; /* of what the true surface reflects; to be multiplied by the fraction that
                           may be in the interval */
    uint32_t partner;   /* `whole` holds for the sum over this facet and the given one */
} lrcsi_interval_error;

/* These numbers for one facet that is not skipped. Given: its incidence; in->moment NULL. */
lrcsi_interval_error lrcsi_tessellation_interval(const lrcsi_tessellation_input *in, uint32_t facet,
                                                 const lrcsi_incidence *incidence,
                                                 lrcsi_patches *patches);

#endif
