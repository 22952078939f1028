/* SPDX-License-Identifier: MIT */
/* Estimates of the time that visible areas take, from what can be counted in a view beforehand.
   They serve to choose a method, and influence the answer in no other way. */
#ifndef LRCSI_COST_H
#define LRCSI_COST_H

#include "visibility/classify.h"

/* Counts of a view, estimated from a sample of its facets. */
typedef struct lrcsi_cost {
    double facets;   /* all of them */
    double casting;  /* facets that can hide something */
    double contacts; /* of these, facets in contact with another one */
    double events;   /* event edges (visibility/event.h) */
    double borders;  /* their length in the view, in sides of the window */
    double overdraw; /* projected area of the casting facets, in areas of the window */
} lrcsi_cost;

/* Given: a view with coordinates. */
lrcsi_cost lrcsi_cost_count(const lrcsi_view *view);

/* The estimated number of undecided facets. */
double lrcsi_cost_undecided(const lrcsi_cost *cost);

/* Estimated time, ns: of size x size samples of all facets (visibility/preview.h); of clipping. */
double lrcsi_cost_draw(const lrcsi_cost *cost, uint32_t size);
double lrcsi_cost_clip(const lrcsi_cost *cost, double undecided);

/* The largest number of steps (lrcs_run_options.steps) that clipping makes in a time of ns. */
uint64_t lrcsi_cost_steps(double ns);

/* The size, at most `largest`, of a raster whose estimate is likely to meet a tolerance, or of a
   finer one that takes little longer. It grows as the tolerance falls. lrcsi_cost_first: the size
   of the first raster, which takes not much longer than the coarsest, because these estimates are
   rough. */
uint32_t lrcsi_cost_size(const lrcsi_cost *cost, double tolerance, uint32_t largest);
uint32_t lrcsi_cost_first(const lrcsi_cost *cost, uint32_t size);

#endif
