/* SPDX-License-Identifier: MIT */
/* Finds the visible areas of a pose in which shadows are searched for, by one attempt: clipping, or
   one raster. Which attempts there are, and in which order, is decided in sigma_attempt.c; sums
   over the areas are computed in sigma_sum.c. */
#include "base/progress.h"
#include "base/work.h"
#include "integrate/sigma_run.h"
#include "visibility/raster/preview.h"
#include "visibility/raster/visible.h"

int lrcsi_sigma_classify(lrcsi_sigma *run, lrcsi_meter *meter, int retries)
{
    if (run->classified) {
        return LRCS_OK;
    }
    lrcsi_progress_report(run->request.options->progress, LRCS_PROGRESS_CLASSIFY, 0, 0);
    int status = lrcsi_classify_make(&run->view, meter, run->work, &run->classification);
    if (status == LRCS_OK && run->plan.proximity_band) {
        status = lrcsi_proximity_band_make(&run->classification, meter, run->work, &run->band);
        status = status == LRCS_OK ? lrcsi_masked_band_make(&run->band, run->work, &run->masked)
                                   : status;
    }
    run->classified = status == LRCS_OK && !(retries && meter->spent);
    return status;
}

void lrcsi_sigma_release_decisions(lrcsi_sigma *run, lrcsi_attempts *attempts)
{
    if (attempts->decided) {
        run->work->used = attempts->mark;
        attempts->decided = 0;
    }
}

/* Clips. If only the sum reads the visible areas, facets that are entirely visible or hidden get
   only an answer and no area; tessellation errors and areas_apply_proofs need the areas of all
   facets. */
static int clip_facets(lrcsi_sigma *run, lrcsi_meter *meter)
{
    const lrcsi_sigma_memory *memory = &run->memory;
    run->areas = (lrcsi_areas){.visible = memory->visible};
    if (run->curve_terms) {
        lrcsi_curve_options options = lrcsi_sigma_curve_options(run, meter);
        return lrcsi_curve_from_pieces(&run->classification, &options, run->work, memory->visible,
                                       run->curve_terms);
    }
    int sum_only = !run->view.prepared->has_curved_shapes && !lrcsi_sigma_has_proofs(run);
    int status =
        lrcsi_occlude_all(&run->classification, meter, run->request.options->progress, run->work,
                          sum_only ? &run->areas.answer : NULL, memory->visible, memory->moment);
    /* Moments must belong to the areas (areas_apply_proofs). Where steps ran out, areas are
       uncertain, and corrections by moments would make bounds grow where more steps are left. */
    run->areas.moment = run->plan.fronts_visible || meter->spent ? NULL : memory->moment;
    return status;
}

/* Clips, within the limit of the attempt if it has one: classifies, unless that is done, and clips
   undecided facets. Steps may run out in either. What an attempt leaves in the work area that has
   not found areas is released by lrcsi_attempts_end, except a classification that is complete.
   Any other failure than lack of memory ends the run. */
static int search_by_clipping(lrcsi_sigma *run, const lrcsi_cost *cost, lrcsi_attempt *attempt)
{
    const int limited = lrcsi_attempt_is_limited(attempt);
    attempt->mark = run->work->used;
    int status = lrcsi_sigma_classify(run, &attempt->meter, limited);
    if (status == LRCS_OK && run->classified) {
        attempt->mark = run->work->used;
        if (limited &&
            lrcsi_cost_clip(cost, run->classification.undecided_count) > attempt->limit_ns) {
            attempt->end = LRCSI_ATTEMPT_REFUSED;
            return LRCS_OK;
        }
        status = clip_facets(run, &attempt->meter);
    }
    if (status == LRCS_E_MEMORY) {
        attempt->end = LRCSI_ATTEMPT_NO_MEMORY;
        return LRCS_OK;
    }
    attempt->end =
        lrcsi_attempt_is_over_limit(attempt) ? LRCSI_ATTEMPT_ABANDONED : LRCSI_ATTEMPT_FOUND;
    return status;
}

/* Draws one raster of the attempt's size, or of half of it, a quarter and so on until it fits into
   the work area. Areas are taken from its samples alone, or from what is proved of each facet and,
   where that decides nothing, from samples. */
static int draw_raster(lrcsi_sigma *run, lrcsi_attempts *attempts)
{
    lrcsi_attempt *attempt = &attempts->current;
    lrcs_progress *progress = run->request.options->progress;
    lrcsi_outcome *outcome = &run->outcome;
    int undecided = 0;
    int status = LRCS_OK;
    if (!attempt->samples_only && !attempts->decided) {
        status = lrcsi_sigma_classify(run, &attempt->meter, 0);
        attempts->mark = run->work->used;
        status = status == LRCS_OK
                     ? lrcsi_decisions_make(&run->classification, run->work, &attempts->decisions)
                     : status;
        attempts->decided = status == LRCS_OK;
        if (status != LRCS_OK) {
            return status;
        }
    }
    run->areas = (lrcsi_areas){.visible = run->memory.visible};
    uint32_t size = attempt->size;
    do {
        status = attempt->samples_only
                     ? lrcsi_preview_make(&run->view, size, progress, run->work,
                                          run->memory.visible, &undecided)
                     : lrcsi_visible_areas_from_samples(&attempts->decisions, size, progress,
                                                        run->work, run->memory.visible, &undecided);
        outcome->flags |= status == LRCS_E_MEMORY ? LRCS_FLAG_MEMORY_FALLBACK : 0u;
        outcome->size = size;
        size /= 2;
    } while (status == LRCS_E_MEMORY && size >= 1);
    outcome->flags |= status == LRCS_OK && undecided ? LRCS_FLAG_DEPTH_UNDECIDED : 0u;
    return status;
}

int lrcsi_sigma_search(lrcsi_sigma *run, lrcsi_attempts *attempts)
{
    lrcsi_attempt *attempt = &attempts->current;
    run->outcome = (lrcsi_outcome){.method = attempt->method,
                                   .reason = attempt->reason,
                                   .flags = attempt->fallback ? LRCS_FLAG_MEMORY_FALLBACK : 0u};
    if (attempt->method == LRCS_METHOD_ZBUFFER) {
        attempt->end = LRCSI_ATTEMPT_FOUND;
        return draw_raster(run, attempts);
    }
    lrcsi_sigma_release_decisions(run, attempts);
    return search_by_clipping(run, &attempts->cost, attempt);
}
