/* SPDX-License-Identifier: MIT */
/* The areas that samples give contested facets, within bounds that others found. */
#ifndef LRCSI_SHARE_H
#define LRCSI_SHARE_H

#include "visibility/visible.h"

/* Sums over the facets of one sheet that share samples; areas in scaled units. */
typedef struct lrcsi_share_rest {
    double owned, covered, area;
    double kept, low, high; /* what they were given so far, and their bounds */
} lrcsi_share_rest;

typedef struct lrcsi_sharing {
    const lrcsi_known *known;
    const lrcsi_raster *raster;
    lrcsi_share_rest *rest; /* facet: of the sheet that it names */
} lrcsi_sharing;

/* What is known of one facet. */
typedef struct lrcsi_share {
    int row;        /* it shares its samples with its neighbours */
    double share;   /* visible: of its samples, or of theirs together */
    double longest; /* its longest side, in pixels */
} lrcsi_share;

size_t lrcsi_share_need(const lrcs_prepared *prepared);

/* Status: LRCS_OK; LRCS_E_MEMORY. What it takes stays in the work area. */
int lrcsi_share_make(const lrcsi_known *known, const lrcsi_raster *raster, lrcs_work *work,
                     lrcsi_sharing *sharing);

/* Asks about a contested facet. */
lrcsi_share lrcsi_share_facet(const lrcsi_sharing *sharing, uint32_t facet);

/* Puts its area, of the projected area given, between visible->low and visible->high. */
void lrcsi_share_keep(const lrcsi_sharing *sharing, uint32_t facet, double area,
                      const lrcsi_share *share, lrcsi_visible *visible);

/* Gives what is left of a sheet to those of its facets that have room for it: once, after all
   facets have been kept. */
void lrcsi_share_settle(const lrcsi_sharing *sharing, lrcsi_visible *visible);

#endif
