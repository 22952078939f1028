/* SPDX-License-Identifier: MIT */
/* The areas that samples give undecided facets, within bounds that others found. */
#ifndef LRCSI_VISIBLE_FRACTION_H
#define LRCSI_VISIBLE_FRACTION_H

#include "visibility/raster.h"
#include "visibility/visible_area.h"

/* Sums over the facets of one component that share samples; areas in scaled units. */
typedef struct lrcsi_fraction_remainder {
    double owned, covered, area;
    double kept, low, high; /* what they were given so far, and their bounds */
} lrcsi_fraction_remainder;

typedef struct lrcsi_sharing {
    const lrcsi_known *known;
    const lrcsi_raster *raster;
    lrcsi_fraction_remainder *rest; /* facet: of the component that it names */
} lrcsi_sharing;

/* What is known of one facet. */
typedef struct lrcsi_visible_fraction {
    int row;        /* it shares its samples with its neighbours */
    double share;   /* visible: of its samples, or of theirs together */
    double longest; /* its longest side, in pixels */
} lrcsi_visible_fraction;

size_t lrcsi_visible_fraction_need(const lrcs_prepared *prepared);

/* Status: LRCS_OK; LRCS_E_MEMORY. What it takes stays in the work area. */
int lrcsi_visible_fraction_make(const lrcsi_known *known, const lrcsi_raster *raster,
                                lrcs_work *work, lrcsi_sharing *sharing);

/* Asks about an undecided facet. */
lrcsi_visible_fraction lrcsi_visible_fraction_facet(const lrcsi_sharing *sharing, uint32_t facet);

/* Puts its area, of the projected area given, between visible->low and visible->high. */
void lrcsi_visible_fraction_keep(const lrcsi_sharing *sharing, uint32_t facet, double area,
                                 const lrcsi_visible_fraction *share, lrcsi_visible *visible);

/* Gives what is left of a component to those of its facets that have room for it: once, after all
   facets have been kept. */
void lrcsi_visible_fraction_settle(const lrcsi_sharing *sharing, lrcsi_visible *visible);

#endif
