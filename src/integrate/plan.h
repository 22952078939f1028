/* SPDX-License-Identifier: MIT */
/* The planner: which effects the scene and this direction call for, and so which method is
   enough. What it leaves out is proved not to change sigma, or was asked to be left out. */
#ifndef LRCSI_PLAN_H
#define LRCSI_PLAN_H

#include "view/clear.h"

/* A term of the BRDF. */
enum lrcsi_term {
    LRCSI_TERM_OUT,      /* its amplitude is taken for 0 */
    LRCSI_TERM_ASSIGNED, /* as the materials say */
    LRCSI_TERM_FORCED    /* evaluated even where its amplitude is 0 */
};

typedef struct lrcsi_plan {
    int method;         /* FACET, ZBUFFER, EXACT: the first to try; or CLOSED */
    uint32_t size;      /* of the first raster, if one is drawn */
    const char *reason; /* why that one */
    int previews;   /* auto, and a raster's estimate may count: then what costs least comes first
                       (integrate/cost.h) */
    int unshadowed; /* proved: in this view front facets with cos(theta) > graze are not hidden */
    double grazing_cos; /* of the scene where unshadowed, else 1 */
    int backless;       /* no facet hides a back side that counts */
    int alone;          /* proved: unshadowed and backless */
    int searched;       /* what hides them is looked for all the same */
    int patches;        /* facets of curved walls stand for the true surface (integrate/patch.h) */
    int glint, diffuse; /* lrcsi_term */
} lrcsi_plan;

/* What back sides do in a view. */
typedef struct lrcsi_plan_sides {
    int cast;    /* they hide others and can be visible */
    int reflect; /* and reflect if their material is two-sided */
} lrcsi_plan_sides;

/* Decides that from the proofs about a scene and what was asked for. */
lrcsi_plan_sides lrcsi_plan_backs(const lrcs_prepared *prepared, const lrcs_run_options *options);

/* Given: such a view, the shapes that nothing hides in it, and what was asked for. */
lrcsi_plan lrcsi_plan_make(const lrcsi_view *view, const lrcsi_clear *clear,
                           const lrcs_run_options *options);

/* The BRDF of a material, as far as the plan takes it into account. */
lrcs_brdf lrcsi_plan_brdf(const lrcsi_plan *plan, const lrcs_material *material);

/* Fills effect[LRCS_EFFECTS]: on or off, and why. `seen` holds the bits GLINT and DIFFUSE where
   something that may be seen has such a term. */
void lrcsi_plan_effects(const lrcsi_view *view, const lrcsi_plan *plan, const lrcsi_clear *clear,
                        uint32_t seen, lrcs_effect *effect);

#endif
