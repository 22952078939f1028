/* SPDX-License-Identifier: MIT */
/* The planner decides from the proofs of scene/solid.h, from which facets face the laser, and from
   the effects that the options switch off or on. */
#include "integrate/plan/plan.h"

/* Heuristics, which affect the time of a run, and whether its answer is one of clipping or of a
   raster: the size of the first raster, if its bound is to meet the tolerance; the tolerance below
   which no raster is expected to be accepted by its estimate; the number of facets below which
   clipping costs less than a raster (samples_suffice). */
#define FIRST_SIZE            512u
#define PREVIEW_TOLERANCE_MIN 1e-4
#define PREVIEW_FACETS        1024u

static int has_effect(uint32_t set, int effect)
{
    return (set >> effect & 1u) != 0;
}

/* Do the options leave self-shadowing out, whether or not the scene requires it? */
static int shadows_omitted(const lrcs_run_options *options)
{
    return has_effect(options->without, LRCS_EFFECT_SELF_SHADOWING) ||
           (options->method == LRCS_METHOD_FACET &&
            !has_effect(options->with, LRCS_EFFECT_SELF_SHADOWING));
}

lrcsi_view_backs lrcsi_plan_backs(const lrcs_prepared *p, const lrcs_run_options *options)
{
    int requested = has_effect(options->with, LRCS_EFFECT_BACK_FACE_CASTERS) ||
                    (p->two_sided && has_effect(options->with, LRCS_EFFECT_TWO_SIDED));
    int cast = requested && !shadows_omitted(options) ? LRCSI_BACKS_ALL : lrcsi_backs_needed(p);
    cast = has_effect(options->without, LRCS_EFFECT_BACK_FACE_CASTERS) ? LRCSI_BACKS_NONE : cast;
    return (lrcsi_view_backs){cast, cast && !has_effect(options->without, LRCS_EFFECT_TWO_SIDED)};
}

static int plan_term(const lrcs_run_options *options, int effect)
{
    return has_effect(options->without, effect) ? LRCSI_TERM_OMITTED
           : has_effect(options->with, effect)  ? LRCSI_TERM_FORCED
                                                : LRCSI_TERM_ASSIGNED;
}

static void plan_choose(lrcsi_plan *plan, int method, const char *reason)
{
    plan->method = method;
    plan->reason = reason;
}

/* Does auto try a raster whose estimate may be accepted? */
static int preview_tried(const lrcs_run_options *options)
{
    return options->method == LRCS_METHOD_AUTO && options->accept != LRCS_ACCEPT_BOUND &&
           (options->tolerance >= PREVIEW_TOLERANCE_MIN || options->accept == LRCS_ACCEPT_ANY);
}

/* May areas be taken from the samples of a raster alone, without a proof? Not with curved normals,
   whose integrals need the visible region of each facet; nor with curved shapes among other parts,
   whose proximity band needs the classification; nor with few facets, for which clipping costs less
   than a raster, and which have too few sampling errors to estimate them well. */
static int samples_suffice(const lrcsi_view *view, const lrcs_run_options *options)
{
    const lrcs_prepared *p = view->prepared;
    return options->accept != LRCS_ACCEPT_BOUND && !p->has_curved_normals && !p->proximity.reach &&
           view->front + view->back >= PREVIEW_FACETS;
}

/* Chooses the method, with its reason. If nothing else suffices, auto chooses clipping, because a
   raster whose bound meets the tolerance costs more in most cases. */
static void plan_method(lrcsi_plan *plan, const lrcsi_view *view, const lrcsi_clear_shapes *clear,
                        const lrcs_run_options *options)
{
    int samples = samples_suffice(view, options);
    if (shadows_omitted(options)) {
        plan_choose(plan, LRCS_METHOD_FACET,
                    options->method == LRCS_METHOD_FACET ? "as requested"
                                                         : "self-shadowing is left out on request");
    } else if (clear->all && !plan->shadows_forced && plan->no_back_hidden) {
        plan_choose(plan, LRCS_METHOD_CLOSED,
                    "every part is a shape that nothing hides: closed forms");
    } else if (options->method > LRCS_METHOD_FACET) {
        plan_choose(plan, options->method, "as requested");
    } else if (plan->nothing_hidden && !plan->shadows_forced) {
        plan_choose(plan, LRCS_METHOD_FACET, "proved a single convex body: nothing is hidden");
    } else if (options->resolution != 0) {
        plan_choose(plan, LRCS_METHOD_ZBUFFER, "a raster of this size is requested");
    } else if (preview_tried(options) && (samples || options->accept == LRCS_ACCEPT_ANY)) {
        plan->previews = samples;
        plan_choose(plan, LRCS_METHOD_ZBUFFER, "any answer counts: the first raster");
    } else if (preview_tried(options)) {
        plan_choose(plan, LRCS_METHOD_EXACT,
                    "few facets, or curved ones: a raster would save little time");
    } else {
        plan_choose(plan, LRCS_METHOD_EXACT,
                    plan->nothing_hidden
                        ? "self-shadowing is requested"
                        : "not proved a single convex body; clipping has the closest bound");
    }
    plan->samples_only = plan->method == LRCS_METHOD_ZBUFFER && samples;
}

lrcsi_plan lrcsi_plan_make(const lrcsi_view *view, const lrcsi_clear_shapes *clear,
                           const lrcs_run_options *options)
{
    const lrcs_prepared *p = view->prepared;
    lrcsi_plan plan = {0};
    plan.fronts_visible = p->convex;
    plan.grazing_cos = p->convex ? p->grazing_cos : 1;
    plan.no_back_hidden = !view->backs.cast || view->front == 0 || view->back == 0;
    plan.nothing_hidden = p->convex && plan.no_back_hidden;
    plan.shadows_forced = has_effect(options->with, LRCS_EFFECT_SELF_SHADOWING);
    /* There is no proximity band if the options leave back sides out although some may be seen: it
       holds only if they cast shadows, or in solid scenes. */
    plan.proximity_band = p->proximity.reach && (view->backs.cast || p->solid);
    plan.patches = p->has_curved_shapes;
    plan.tolerance = options->tolerance;
    plan.glint = plan_term(options, LRCS_EFFECT_GLINT);
    plan.diffuse = plan_term(options, LRCS_EFFECT_DIFFUSE);
    plan.size = options->resolution != 0 ? options->resolution : FIRST_SIZE;
    plan_method(&plan, view, clear, options);
    return plan;
}

lrcs_brdf lrcsi_plan_brdf(const lrcsi_plan *plan, const lrcs_material *material)
{
    lrcs_brdf brdf = material->brdf;
    brdf.A = plan->glint == LRCSI_TERM_OMITTED ? 0 : brdf.A;
    brdf.B = plan->diffuse == LRCSI_TERM_OMITTED ? 0 : brdf.B;
    return brdf;
}

static lrcs_effect shadowing_effect(const lrcs_prepared *p, const lrcsi_plan *plan)
{
    if (plan->method == LRCS_METHOD_CLOSED) {
        return (lrcs_effect){0, "nothing hides any part, proved"};
    }
    if (plan->method == LRCS_METHOD_FACET && plan->nothing_hidden) {
        return (lrcs_effect){0, "a single convex body: no front side is ever hidden"};
    }
    if (plan->method == LRCS_METHOD_FACET) {
        return (lrcs_effect){
            0, "left out on request; the bound includes everything that could be hidden"};
    }
    if (plan->nothing_hidden) {
        return (lrcs_effect){1, "on request, though proved a single convex body"};
    }
    if (plan->fronts_visible) {
        return (lrcs_effect){1, p->solid ? "convex: fronts hide backs, searched on request"
                                         : "an open convex surface: fronts hide backs"};
    }
    return (lrcs_effect){1, "not proved a single convex body"};
}

static lrcs_effect caster_effect(const lrcsi_view *view, const lrcsi_plan *plan)
{
    if (view->backs.cast && view->prepared->solid) {
        return (lrcs_effect){1, "on request, though proved closed and outward"};
    }
    if (view->prepared->solid) {
        return (lrcs_effect){0, "closed and outward, proved: back sides are never seen"};
    }
    if (plan->method == LRCS_METHOD_FACET || plan->method == LRCS_METHOD_CLOSED) {
        return (lrcs_effect){0, "no self-shadowing"};
    }
    return view->backs.cast ? (lrcs_effect){1, "some surfaces are not proved closed and outward"}
                            : (lrcs_effect){0, "left out on request"};
}

/* Only models can have curved normals: shapes have flat facets, divided as finely as the tolerance
   requires, with a proved bound. */
static lrcs_effect normals_effect(const lrcs_prepared *p)
{
    int given = 0;
    for (uint32_t i = 0; i < p->scene->part_count; i++) {
        given |= p->scene->part[i].smoothed;
    }
    switch (p->scene->normals) {
    case LRCS_NORMALS_AUTO:
        return p->has_curved_normals
                   ? (lrcs_effect){1, "some facets turn too far for the glint of their material"}
               : given ? (lrcs_effect){0, "no model's facets turn too far for their glint"}
                       : (lrcs_effect){0, "no model has smoothing groups or vertex normals"};
    case LRCS_NORMALS_SMOOTH:
        return p->has_curved_normals
                   ? (lrcs_effect){1, "smoothing groups or vertex normals, as requested"}
               : given ? (lrcs_effect){0, "all smoothed facets are flat"}
                       : (lrcs_effect){0, "no model has smoothing groups or vertex normals"};
    default:
        return p->has_curved_shapes
                   ? (lrcs_effect){0, "facets of models are flat; those of round shapes "
                                      "represent the true surface"}
                   : (lrcs_effect){0, "flat facets, as Eq. 2 over facets means"};
    }
}

static lrcs_effect two_sided_effect(const lrcsi_view *view)
{
    if (!view->prepared->two_sided) {
        return (lrcs_effect){0, "no material is two-sided"};
    }
    if (view->backs.reflect) {
        return (lrcs_effect){1, view->prepared->solid
                                    ? "on request, though back sides are never seen"
                                    : "a material is two-sided"};
    }
    return (lrcs_effect){0, view->prepared->solid ? "closed and outward: back sides are never seen"
                                                  : "left out on request"};
}

/* The reasons that are reported for a term of the BRDF. */
typedef struct term_text {
    const char *assigned, *none, *unseen, *forced;
} term_text;

/* The effect of a term: it adds nothing, and is reported as off, if no visible facet has it. */
static lrcs_effect term_effect(int term, int assigned, int seen, const term_text *text)
{
    if (assigned && term == LRCSI_TERM_OMITTED) {
        return (lrcs_effect){0, "left out on request"};
    }
    if (!seen && term == LRCSI_TERM_FORCED) {
        return (lrcs_effect){1, text->forced};
    }
    return seen ? (lrcs_effect){1, text->assigned}
                : (lrcs_effect){0, assigned ? text->unseen : text->none};
}

static lrcs_effect closed_effect(const lrcsi_view *view, const lrcsi_clear_shapes *clear)
{
    const lrcs_prepared *p = view->prepared;
    if (clear->all) {
        return (lrcs_effect){1, "nothing hides any part: shapes count without facets"};
    }
    if (clear->count > 0) {
        return (lrcs_effect){1, "nothing hides some curved shapes: these count without facets"};
    }
    return clear->part            ? (lrcs_effect){0, "every curved shape may be hidden in part"}
           : p->extent            ? (lrcs_effect){0, "facets were requested"}
           : p->has_curved_shapes ? (lrcs_effect){0, "no curved shape has one"}
                                  : (lrcs_effect){0, "no part is a curved shape"};
}

void lrcsi_plan_effects(const lrcsi_view *view, const lrcsi_plan *plan,
                        const lrcsi_clear_shapes *clear, uint32_t seen, lrcs_effect *effect)
{
    static const term_text glint = {"a material has A > 0", "A = 0 for every material",
                                    "nothing seen has A > 0",
                                    "on request, though nothing seen has A > 0"};
    static const term_text diffuse = {"a material has B > 0", "B = 0 for every material",
                                      "nothing seen has B > 0",
                                      "on request, though nothing seen has B > 0"};
    const lrcs_prepared *p = view->prepared;
    effect[LRCS_EFFECT_SELF_SHADOWING] = shadowing_effect(p, plan);
    effect[LRCS_EFFECT_BACK_FACE_CASTERS] = caster_effect(view, plan);
    effect[LRCS_EFFECT_GLINT] =
        term_effect(plan->glint, p->glint, has_effect(seen, LRCS_EFFECT_GLINT), &glint);
    effect[LRCS_EFFECT_DIFFUSE] =
        term_effect(plan->diffuse, p->diffuse, has_effect(seen, LRCS_EFFECT_DIFFUSE), &diffuse);
    effect[LRCS_EFFECT_CURVED_NORMALS] = normals_effect(p);
    effect[LRCS_EFFECT_TWO_SIDED] = two_sided_effect(view);
    effect[LRCS_EFFECT_ARTICULATION] = p->articulated ? (lrcs_effect){1, "a part has a joint"}
                                                      : (lrcs_effect){0, "no part has a joint"};
    effect[LRCS_EFFECT_CLOSED_FORMS] = closed_effect(view, clear);
}
