/* SPDX-License-Identifier: MIT */
/* The visible areas of undecided facets, from their samples and within given bounds. */
#ifndef LRCSI_VISIBLE_FRACTION_H
#define LRCSI_VISIBLE_FRACTION_H

#include "visibility/base/visible_area.h"
#include "visibility/raster/raster.h"
#include "visibility/uniform/decisions.h"

/* Sums over the facets of one component whose samples are pooled; areas in scaled units. */
typedef struct lrcsi_component_sum {
    double owned, covered, area;
    double applied, low, high; /* the areas so far, and their bounds */
} lrcsi_component_sum;

/* The data that the facets of one raster share. */
typedef struct lrcsi_sample_pool {
    const lrcsi_decisions *decisions;
    const lrcsi_raster *raster;
    lrcsi_component_sum *sum; /* by component */
} lrcsi_sample_pool;

/* How the area of one facet follows from samples. */
typedef struct lrcsi_visible_fraction {
    int pooled;      /* 1 if its samples are pooled with those of its neighbours */
    double fraction; /* the visible fraction of its samples, or of the pooled ones */
    double longest;  /* its longest side, in pixels */
} lrcsi_visible_fraction;

size_t lrcsi_visible_fraction_need(const lrcs_prepared *prepared);

/* Status: LRCS_OK; LRCS_E_MEMORY. What it takes stays in the work area. */
int lrcsi_visible_fraction_make(const lrcsi_decisions *decisions, const lrcsi_raster *raster,
                                lrcs_work *work, lrcsi_sample_pool *pool);

/* Finds the visible fraction of an undecided facet. */
lrcsi_visible_fraction lrcsi_visible_fraction_facet(const lrcsi_sample_pool *pool, uint32_t facet);

/* Sets visible->area from the fraction found, within visible->low and visible->high.
   Given: area, the projected area of the facet. */
void lrcsi_visible_fraction_apply(lrcsi_sample_pool *pool, uint32_t facet, double area,
                                  const lrcsi_visible_fraction *found, lrcsi_visible_area *visible);

/* Distributes area that the bounds cut off over the other facets of the component. Called once,
   after lrcsi_visible_fraction_apply for all undecided facets. */
void lrcsi_visible_fraction_correct(const lrcsi_sample_pool *pool, lrcsi_visible_area *visible);

#endif
