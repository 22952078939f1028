/* SPDX-License-Identifier: MIT */
/* Estimates of the time that the computation of visible areas takes, from counts made in a view
   beforehand. They are used to choose a method, and influence the answer in no other way. */
#ifndef LRCSI_COST_H
#define LRCSI_COST_H

#include "visibility/uniform/classify.h"

/* Counts of a view; all but the first are estimated from a sample of its facets. */
typedef struct lrcsi_cost {
    double facets;
    double casting;  /* facets that can hide something */
    double contacts; /* those of them that are in contact with another facet */
    double events;   /* event edges (visibility/index/event.h) */
    double borders;  /* their total length in the view; unit: side of the window */
    double overdraw; /* projected area of all casting facets; unit: area of the window */
} lrcsi_cost;

/* Given: a view with coordinates. */
lrcsi_cost lrcsi_cost_count(const lrcsi_view *view);

/* The estimated number of undecided facets. */
double lrcsi_cost_undecided(const lrcsi_cost *cost);

/* The estimated time, ns, of a raster of size x size samples (visibility/raster/preview.h), and of
   clipping the given number of undecided facets. */
double lrcsi_cost_draw(const lrcsi_cost *cost, uint32_t size);
double lrcsi_cost_clip(const lrcsi_cost *cost, double undecided);

/* The largest number of steps (lrcs_run_options.steps) that clipping can take in a time, ns. */
uint64_t lrcsi_cost_steps(double ns);

/* The size, at most `largest`, of a raster whose estimated error is likely to meet a tolerance, or
   of a finer one that takes little longer. It grows as the tolerance falls. */
uint32_t lrcsi_cost_size(const lrcsi_cost *cost, double tolerance, uint32_t largest);
/* The size of the first raster, given the size above. Because that is a rough guess, the first
   raster takes not much longer than the coarsest. */
uint32_t lrcsi_cost_first(const lrcsi_cost *cost, uint32_t size);

#endif
