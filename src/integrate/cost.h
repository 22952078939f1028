/* SPDX-License-Identifier: MIT */
/* What finding visible areas is likely to take, from what can be counted in a view beforehand. It
   chooses between methods; no answer depends on it but by that choice. */
#ifndef LRCSI_COST_H
#define LRCSI_COST_H

#include "visibility/classify.h"

/* Of a view, from a sample of its facets. */
typedef struct lrcsi_cost {
    double facets;   /* all, */
    double casting;  /* those that can hide something, */
    double contacts; /* and of these, those that another touches */
    double events;   /* event edges (visibility/event.h) */
    double borders;  /* their length in the view, over the window's side */
    double overdraw; /* projected area of those that cast, over that of the window */
} lrcsi_cost;

/* Given: a view with coordinates. */
lrcsi_cost lrcsi_cost_count(const lrcsi_view *view);

/* How many facets are likely to be undecided. */
double lrcsi_cost_undecided(const lrcsi_cost *cost);

/* Nanoseconds, roughly, of samples of all facets, size x size (visibility/preview.h); of clipping.
 */
double lrcsi_cost_draw(const lrcsi_cost *cost, uint32_t size);
double lrcsi_cost_clip(const lrcsi_cost *cost, double undecided);

/* The steps (lrcs_run_options.steps) that clipping makes in so many nanoseconds, at most. */
uint64_t lrcsi_cost_steps(double ns);

/* The size of the raster, at most `most`, whose estimate is likely to meet a tolerance, or of a
   finer one that costs little more. The finer the tolerance the finer it is. And the size to begin
   with: not much dearer than the coarsest, for what is likely may be far off. */
uint32_t lrcsi_cost_size(const lrcsi_cost *cost, double tolerance, uint32_t most);
uint32_t lrcsi_cost_first(const lrcsi_cost *cost, uint32_t size);

#endif
