/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2 over the visible areas of a pose, by whatever method they were found: replaces
   areas by what is proved about them, integrates where areas do not suffice, and sums. Also decides
   whether the answer is accepted. */
#include <math.h>

#include "base/progress.h"
#include "base/range.h"
#include "integrate/sigma_run.h"
#include "integrate/wall/clear_sectors.h"
#include "integrate/wall/round_pieces.h"

/* --- is the answer accepted? ------------------------------------------------------------------ */

double lrcsi_sigma_bound(const lrcsi_total *total)
{
    return total->visibility + fmax(0, total->tessellation) + total->rounding;
}

/* How the answer is accepted: 0 if its bound meets the tolerance, else a flag. If the options
   accept estimates, the estimated error of sampled areas replaces the proved bound. There is no
   such estimate in three cases: sigma is 0, because no sample has met anything that reflects; the
   depth order at a sample is undecided, because its owner is then a guess; the steps are spent,
   because undecided facets then count half. */
uint32_t lrcsi_sigma_acceptance(const lrcsi_sigma *run)
{
    const lrcsi_outcome *outcome = &run->outcome;
    const lrcsi_total *t = &outcome->total;
    double allowed = run->request.options->tolerance * (t->glint + t->diffuse);
    int estimated = outcome->size != 0 && !(outcome->flags & LRCS_FLAG_DEPTH_UNDECIDED) &&
                    !run->meter.spent && allowed > 0 &&
                    t->error_estimate + fmax(0, t->tessellation) + t->rounding <= allowed;
    if (lrcsi_sigma_bound(t) <= allowed && t->cubature_estimate <= allowed) {
        return 0;
    }
    if (run->request.options->accept != LRCS_ACCEPT_BOUND && estimated &&
        t->cubature_estimate <= allowed) {
        return LRCS_FLAG_ACCEPTED_BY_ESTIMATE;
    }
    return run->request.options->accept == LRCS_ACCEPT_ANY ? LRCS_FLAG_ACCEPTED_UNJUDGED
                                                           : LRCS_FLAG_TOLERANCE_NOT_MET;
}

/* --- the sum ---------------------------------------------------------------------------------- */

lrcsi_curve_options lrcsi_sigma_curve_options(const lrcsi_sigma *run, lrcsi_meter *meter)
{
    const lrcs_run_options *options = run->request.options;
    return (lrcsi_curve_options){&run->plan,        options->tolerance, meter,
                                 options->progress, run->stack,         run->request.derivatives};
}

static const lrcsi_masked_band *run_band(const lrcsi_sigma *run)
{
    return run->classified && run->plan.proximity_band ? &run->masked : NULL;
}

lrcsi_total lrcsi_sigma_sum(lrcsi_sigma *run, lrcs_facet_record *records)
{
    lrcsi_total_details details = {records, run->request.part_error, run->corrected};
    lrcsi_progress_report(run->request.options->progress, LRCS_PROGRESS_INTEGRATE, 0, 0);
    return lrcsi_total_make(&run->view, &run->plan, &run->areas, run->curve_terms, run_band(run),
                            &run->clear, &details);
}

/* Integrates over the sectors at the limb of a convex part that is alone: nothing hides any. */
static void limbs_integrate(lrcsi_sigma *run)
{
    if (lrcsi_sigma_is_one_convex_shape(run->view.prepared) && run->memory.wall_terms) {
        lrcsi_clear_sectors_make(&run->view, &run->plan, &run->clear, NULL, NULL,
                                 run->request.derivatives, run->work, run->memory.wall_terms);
        run->areas.wall_terms = run->memory.wall_terms;
    }
}

/* The areas of method facet. Only facets with curved normals need them in memory; for all others
   lrcsi_total_make derives them from the plan. */
void lrcsi_sigma_sum_unshadowed(lrcsi_sigma *run)
{
    const lrcsi_view *view = &run->view;
    lrcsi_visible_area *visible = run->memory.visible;
    run->areas = (lrcsi_areas){.visible = NULL};
    for (uint32_t f = 0; run->curve_terms && f < view->prepared->scene->facet_count; f++) {
        lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
        visible[f] = lrcsi_areas_of(&run->areas, view, &run->plan, f, &incidence);
    }
    if (run->curve_terms) {
        lrcsi_curve_options options = lrcsi_sigma_curve_options(run, &run->meter);
        lrcsi_curve_from_areas(view, &options, visible, run->curve_terms);
    }
    run->areas = (lrcsi_areas){.visible = visible};
    limbs_integrate(run);
    run->outcome.total = lrcsi_sigma_sum(run, NULL);
}

/* Are there proofs about the visible areas of the pose that the methods do not use? */
int lrcsi_sigma_has_proofs(const lrcsi_sigma *run)
{
    return run->plan.fronts_visible || run->clear.count > 0 ||
           run->view.backs.cast == LRCSI_BACKS_ALL;
}

/* Replaces areas by what is proved about them:
   1. On a convex surface fronts are visible, and only the areas of back sides are used. If the
      options force a search for shadows, the interval that it found for a front is extended by the
      proved one: for bodies that are convex by construction no contacts are computed, so that the
      search alone proves nothing.
   2. Back sides that are proved never to be seen have no visible area, whatever the search found.
   3. The fronts of clear shapes are visible; this is needed only for what is reported about their
      facets. */
static void areas_apply_proofs(lrcsi_sigma *run)
{
    const lrcsi_view *view = &run->view;
    const lrcs_prepared *p = view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        lrcsi_visible_area *visible = &run->memory.visible[f];
        int front = view->facing[f] > 0;
        if (front && run->plan.fronts_visible) {
            lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
            lrcsi_visible_area known =
                lrcsi_visible_area_unshadowed(&incidence, run->plan.grazing_cos);
            if (run->plan.shadows_forced) {
                known.area = visible->area;
                known.low = lrcsi_min(known.low, visible->low);
                known.error_estimate = visible->error_estimate;
                known.bias = visible->bias;
            }
            *visible = known;
        }
        *visible = lrcsi_visible_area_proved(view, f, *visible);
        if (front && lrcsi_is_clear_shape(&run->clear, p->scene->facet_part[f])) {
            double projected = lrcsi_view_projected(view, f);
            *visible = lrcsi_visible_area_exact(projected);
        }
    }
}

/* Integrates where a facet's visible area does not suffice for its sigma, given the areas that
   samples or clipping found:
   1. replaces areas by what is proved about them;
   2. if they are sampled, integrates over facets with curved normals, which are clipped if they are
      partly visible and there is memory for it; clipping has already integrated over its pieces;
   3. masks the facets of the proximity band that are hidden, chooses the flat faces whose margins
      are used, and integrates over the sectors of which other parts hide nothing, at the limb and
      on insides on which only their own rims cast shadows, and over the visible pieces of round
      walls.
   Steps are taken from the given meter, that of the attempt. */
void lrcsi_sigma_integrate(lrcsi_sigma *run, lrcsi_meter *meter)
{
    const lrcsi_sigma_memory *memory = &run->memory;
    int sampled = run->outcome.size != 0;
    if (lrcsi_sigma_has_proofs(run)) {
        areas_apply_proofs(run);
    }
    if (run->curve_terms && sampled) {
        lrcsi_curve_options options = lrcsi_sigma_curve_options(run, meter);
        int status = lrcsi_curve_from_samples(&run->classification, &options, run->work,
                                              memory->visible, run->curve_terms);
        if (status != LRCS_OK) {
            lrcsi_curve_from_areas(&run->view, &options, memory->visible, run->curve_terms);
            run->outcome.flags |= LRCS_FLAG_MEMORY_FALLBACK;
        }
    }
    if (run_band(run)) {
        lrcsi_masked_band_find(&run->masked, memory->visible, meter, run->work);
        lrcsi_flat_faces_make(&run->masked, memory->visible, memory->face);
        run->areas.face = memory->face;
        run->areas.margins = &run->masked;
    }
    if (run_band(run) && run->areas.moment) {
        lrcsi_clear_sectors_make(&run->view, &run->plan, &run->clear, &run->masked, memory->visible,
                                 run->request.derivatives, run->work, memory->wall_terms);
        lrcsi_round_pieces_make(&run->classification, &run->plan, &run->clear, &run->masked,
                                memory->visible, run->request.derivatives, meter, run->work,
                                memory->wall_terms);
        run->areas.wall_terms = memory->wall_terms;
    } else {
        limbs_integrate(run);
    }
}
