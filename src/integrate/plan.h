/* SPDX-License-Identifier: MIT */
/* The planner: which effects the scene and this direction call for, and so which method is
   enough. What it leaves out is proved not to change sigma. */
#ifndef LRCSI_PLAN_H
#define LRCSI_PLAN_H

#include "view/view.h"

typedef struct lrcsi_plan {
    int method;     /* FACET, ZBUFFER or EXACT: the first to try */
    int unshadowed; /* proved: in this view front facets above prepared->graze are not hidden */
    int alone;      /* proved: nor does any facet hide a back side */
} lrcsi_plan;

/* Given: the view and what was asked for. */
lrcsi_plan lrcsi_plan_make(const lrcsi_view *view, const lrcs_run_options *options);

/* Fills effect[LRCS_EFFECTS]: on or off, and why. */
void lrcsi_plan_effects(const lrcsi_view *view, const lrcsi_plan *plan, lrcs_effect *effect);

#endif
