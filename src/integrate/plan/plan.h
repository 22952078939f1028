/* SPDX-License-Identifier: MIT */
/* The planner decides which effects the scene and the direction require, and which method therefore
   suffices. It leaves an effect out only if that is proved not to change sigma, or on request. */
#ifndef LRCSI_PLAN_H
#define LRCSI_PLAN_H

#include <lrcs/run.h>

#include "view/clear.h"

/* What a run does with a term of the BRDF. */
enum lrcsi_term_use {
    LRCSI_TERM_OMITTED,  /* its amplitude counts as 0 */
    LRCSI_TERM_ASSIGNED, /* evaluated where its amplitude is not 0 */
    LRCSI_TERM_FORCED    /* evaluated even where its amplitude is 0 */
};

typedef struct lrcsi_plan {
    int method;    /* FACET, ZBUFFER, EXACT: the first to try; or CLOSED */
    uint32_t size; /* of the first raster whose areas are proved, if one is drawn; previews have
                           sizes of their own (integrate/plan/cost.h) */
    const char *reason; /* why this method */
    int previews;       /* auto, and the estimate of a raster may be accepted: the method that is
                           estimated to cost less comes first (integrate/plan/cost.h) */
    int samples_only; /* the areas of a raster are taken from its samples alone, without a proof */
    int fronts_visible; /* proved: in this view no front facet with cos(theta) > grazing_cos is
                         hidden */
    double grazing_cos; /* of the scene if fronts_visible, else 1 */
    int nothing_hidden; /* proved: nothing hides a front (fronts_visible) or a back that may be seen
                         */
    int shadows_forced; /* shadows are searched for even if nothing is hidden */
    int no_back_hidden; /* no facet hides a back side that could be visible */
    int proximity_band; /* differences in visibility between curved shapes and their facets are
                           bounded by a proximity band (visibility/proximity/proximity_band.h) */
    int patches; /* facets of curved walls represent the true surface (integrate/wall/patch.h) */
    double tolerance;   /* lrcs_run_options.tolerance */
    int glint, diffuse; /* lrcsi_term_use */
} lrcsi_plan;

/* Decides whether back sides cast shadows and reflect, from the proofs about the scene and from the
   options. */
lrcsi_view_backs lrcsi_plan_backs(const lrcs_prepared *prepared, const lrcs_run_options *options);

/* Makes the plan. Given: a view made with lrcsi_plan_backs, the shapes that nothing hides in it,
   and the options. */
lrcsi_plan lrcsi_plan_make(const lrcsi_view *view, const lrcsi_clear_shapes *clear,
                           const lrcs_run_options *options);

/* The BRDF of a material, without the terms that the plan leaves out. */
lrcs_brdf lrcsi_plan_brdf(const lrcsi_plan *plan, const lrcs_material *material);

/* Fills effect[LRCS_EFFECTS]: whether each is on, and why. `seen` has the bits GLINT and DIFFUSE if
   some facet that may be visible has that term. */
void lrcsi_plan_effects(const lrcsi_view *view, const lrcsi_plan *plan,
                        const lrcsi_clear_shapes *clear, uint32_t seen, lrcs_effect *effect);

#endif
