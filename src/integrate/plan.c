/* SPDX-License-Identifier: MIT */
/* What the planner decides from the proofs of scene/solid.h and the facets' facing. */
#include "integrate/plan.h"

lrcsi_plan lrcsi_plan_make(const lrcsi_view *view, const lrcs_run_options *options)
{
    const lrcs_prepared *p = view->prepared;
    lrcsi_plan plan;
    plan.unshadowed = p->convex;
    plan.alone = p->convex && (p->solid || view->front == 0 || view->back == 0);
    plan.method = options->method;
    if (options->method == LRCS_METHOD_AUTO) { /* clipping the few contested facets costs less
                                                  than a raster fine enough for its bound */
        plan.method = plan.alone                 ? LRCS_METHOD_FACET
                      : options->resolution != 0 ? LRCS_METHOD_ZBUFFER
                                                 : LRCS_METHOD_EXACT;
    }
    return plan;
}

static lrcs_effect shadowing_effect(const lrcsi_plan *plan)
{
    if (plan->method == LRCS_METHOD_FACET && plan->alone) {
        return (lrcs_effect){0, "convex and alone: no front side is ever hidden"};
    }
    if (plan->method == LRCS_METHOD_FACET) {
        return (lrcs_effect){0, "left out on request; the bound holds all that could be hidden"};
    }
    if (plan->unshadowed) {
        return (lrcs_effect){1, "an open convex surface: fronts hide backs"};
    }
    return (lrcs_effect){1, "not proved convex and alone"};
}

static lrcs_effect caster_effect(const lrcs_prepared *p, const lrcsi_plan *plan)
{
    if (p->solid) {
        return (lrcs_effect){0, "closed and outward, proved: back sides are never seen"};
    }
    if (plan->method == LRCS_METHOD_FACET) {
        return (lrcs_effect){0, "no self-shadowing"};
    }
    return (lrcs_effect){1, "not proved closed and outward"};
}

/* Shapes are tessellated to the tolerance, with a proof: they need none. */
static lrcs_effect normals_effect(const lrcs_prepared *p)
{
    int given = 0;
    for (uint32_t i = 0; i < p->scene->part_count; i++) {
        given |= p->scene->part[i].smoothed;
    }
    switch (p->scene->normals) {
    case LRCS_NORMALS_AUTO:
        return p->smooth ? (lrcs_effect){1, "some facets turn too far for the glint they wear"}
               : given   ? (lrcs_effect){0, "no model's facets turn too far for their glint"}
                         : (lrcs_effect){0, "no model has smoothing groups or vertex normals"};
    case LRCS_NORMALS_SMOOTH:
        return p->smooth ? (lrcs_effect){1, "smoothing groups or vertex normals, as asked"}
               : given   ? (lrcs_effect){0, "all smoothed facets are flat"}
                         : (lrcs_effect){0, "no model has smoothing groups or vertex normals"};
    default:
        return (lrcs_effect){0, "flat facets, as Eq. 2 over facets means"};
    }
}

void lrcsi_plan_effects(const lrcsi_view *view, const lrcsi_plan *plan, lrcs_effect *effect)
{
    const lrcs_prepared *p = view->prepared;
    effect[LRCS_EFFECT_SELF_SHADOWING] = shadowing_effect(plan);
    effect[LRCS_EFFECT_BACK_FACE_CASTERS] = caster_effect(p, plan);
    effect[LRCS_EFFECT_GLINT] = p->glint ? (lrcs_effect){1, "a material has A > 0"}
                                         : (lrcs_effect){0, "A = 0 for every material"};
    effect[LRCS_EFFECT_DIFFUSE] = p->diffuse ? (lrcs_effect){1, "a material has B > 0"}
                                             : (lrcs_effect){0, "B = 0 for every material"};
    effect[LRCS_EFFECT_CURVED_NORMALS] = normals_effect(p);
    effect[LRCS_EFFECT_TWO_SIDED] =
        !p->two_sided ? (lrcs_effect){0, "no material is two-sided"}
        : p->solid    ? (lrcs_effect){0, "closed and outward: back sides are never seen"}
                      : (lrcs_effect){1, "a material is two-sided"};
    effect[LRCS_EFFECT_ARTICULATION] = p->articulated
                                           ? (lrcs_effect){1, "a part stands on a joint"}
                                           : (lrcs_effect){0, "no part stands on a joint"};
}
