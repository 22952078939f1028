/* SPDX-License-Identifier: MIT */
/* Finds the visible areas of a pose in which shadows are searched for. This file decides which
   method follows if the first one does not meet the tolerance, and at which resolution rasters are
   drawn; sigma_sum.c sums over the areas. Rasters are drawn until one is accepted (run_rasters), or
   clipping and rasters take turns (run_previews): the sum is computed each time, because its bound
   decides what follows. */
#include <math.h>

#include "base/work.h"
#include "integrate/cost.h"
#include "integrate/sigma_run.h"
#include "visibility/raster/preview.h"

/* Clipping is tried before a raster if its estimated cost is at most this many times that of the
   raster: by the first factor before the first raster, by the second before each later one.
   Heuristics, which affect only the time: clipping leaves only rounding errors, whereas the estimate
   of a raster may be refused, after one refusal more likely than before. */
#define CLIP_PREFERRED      1.5
#define CLIP_PREFERRED_NEXT 2.5

/* --- classification, clipping ----------------------------------------------------------------- */

/* Finds which facets are undecided, and the proximity band if the plan needs it; once per pose.
   Steps are taken from the given meter, which is that of the run or of an attempt. */
static int run_classify(lrcsi_sigma *run, lrcsi_meter *meter)
{
    if (run->classified) {
        return LRCS_OK;
    }
    lrcsi_progress_report(run->view.progress, LRCS_PROGRESS_CLASSIFY, 0, 0);
    int status = lrcsi_classify_make(&run->view, meter, run->work, &run->classification);
    if (status == LRCS_OK && run->plan.proximity_band) {
        status = lrcsi_proximity_band_make(&run->classification, meter, run->work, &run->band);
    }
    run->classified = status == LRCS_OK;
    return status;
}

/* Finds visible areas by clipping. If only the sum reads the visible areas, facets that are
   entirely visible or hidden get only an answer and no area; tessellation errors and
   areas_apply_proofs need the areas of all facets. The meter is as in run_classify. */
static int run_clip(lrcsi_sigma *run, lrcsi_meter *meter)
{
    int status = run_classify(run, meter);
    if (status == LRCS_OK && run->curve_terms) {
        lrcsi_curve_options options = lrcsi_sigma_curve_options(run, meter);
        status = lrcsi_curve_from_pieces(&run->classification, &options, run->work, run->visible,
                                         run->curve_terms);
    } else if (status == LRCS_OK) {
        int sum_only = !run->view.prepared->has_curved_shapes && !lrcsi_sigma_has_proofs(run);
        status =
            lrcsi_occlude_all(&run->classification, meter, run->work,
                              sum_only ? &run->answer : NULL, run->visible, run->moment_memory);
        /* Moments must belong to the areas (areas_apply_proofs). Where steps ran out, areas are
           uncertain, and corrections by moments would make bounds grow where more steps
           are left. */
        run->moment = run->plan.fronts_visible || meter->spent ? NULL : run->moment_memory;
    }
    run->outcome.size = 0;
    return status;
}

/* --- rasters ---------------------------------------------------------------------------------- */

/* Finds visible areas by one raster of the given size, or of half of it, a quarter and so on until
   it fits into the work area. If `known` is NULL, the areas are taken from the samples alone. */
static int run_raster(lrcsi_sigma *run, lrcsi_decisions *known, uint32_t size)
{
    lrcsi_outcome *outcome = &run->outcome;
    lrcsi_raster raster;
    int undecided = 0;
    size_t mark = run->work->used;
    int status = LRCS_E_MEMORY;
    outcome->flags &= ~(uint32_t)LRCS_FLAG_DEPTH_UNDECIDED; /* of an earlier raster */
    run->answer = NULL;
    run->moment = NULL;
    for (; status == LRCS_E_MEMORY && size >= 1; size /= 2) {
        status = known ? lrcsi_visible_areas_from_samples(known, size, run->work, &raster,
                                                          run->visible, &undecided)
                       : lrcsi_preview_make(&run->view, size, run->work, run->visible, &undecided);
        outcome->flags |= status == LRCS_E_MEMORY ? LRCS_FLAG_MEMORY_FALLBACK : 0u;
        outcome->size = size;
    }
    outcome->flags |= status == LRCS_OK && undecided ? LRCS_FLAG_DEPTH_UNDECIDED : 0u;
    run->work->used = mark;
    return status;
}

/* A raster is this many times as large as the one before, at least; with an estimate, at most.
   Heuristics, which affect only the time: smaller steps would draw more rasters, larger ones a
   raster that is finer than the tolerance requires. */
#define GROWTH_MIN 1.5
#define GROWTH_MAX 4.0
/* A size that is to meet the tolerance by its bound is chosen larger by this factor, because the
   next bound is known only approximately. A heuristic: it affects only the time. */
#define BOUND_MARGIN 1.2

/* The size of the next raster, a multiple of 64 pixels. With the size N the visibility bound falls
   as 1/N, and the estimated error as N^(-4/3) or faster on most models. These are choices that
   affect only the time: each raster is judged by its own bound or estimate. */
static uint32_t next_size(const lrcsi_sigma *run)
{
    const lrcsi_total *total = &run->outcome.total;
    double sigma = total->glint + total->diffuse;
    double others = lrcsi_sigma_bound(total) - total->visibility;
    double allowed = run->request.options->tolerance * sigma - others; /* for visibility */
    double ratio = sqrt(total->error_estimate / allowed);
    double times = run->request.options->accept == LRCS_ACCEPT_BOUND
                       ? BOUND_MARGIN * total->visibility / allowed
                       : fmin(ratio * sqrt(ratio), GROWTH_MAX);
    double size = run->outcome.size * fmax(GROWTH_MIN, times);
    if (!(allowed > 0) || !(size < LRCSI_SIGMA_SIZE_MAX)) {
        return LRCSI_SIGMA_SIZE_MAX;
    }
    return 64 * ((uint32_t)size / 64 + 1);
}

/* Is the last raster accepted, or would a finer one be no better? */
static int raster_ends(const lrcsi_sigma *run, int samples_only)
{
    const lrcsi_outcome *outcome = &run->outcome;
    return run->request.options->resolution != 0 || outcome->size >= LRCSI_SIGMA_SIZE_MAX ||
           run->meter.spent || (outcome->flags & LRCS_FLAG_MEMORY_FALLBACK) ||
           (!samples_only && run->classification.undecided_count == 0) ||
           !(lrcsi_sigma_acceptance(run) & LRCS_FLAG_TOLERANCE_NOT_MET);
}

/* Draws rasters of increasing size until one is accepted or is the finest. samples_only: 1 if their
   areas are taken from the samples alone. */
static int run_rasters(lrcsi_sigma *run, int samples_only)
{
    lrcsi_decisions known;
    size_t mark = run->work->used;
    uint32_t size = run->plan.size;
    int status = LRCS_OK;
    if (!samples_only) {
        status = run_classify(run, &run->meter);
        status = status == LRCS_OK ? lrcsi_decisions_make(&run->classification, run->work, &known)
                                   : status;
    }
    while (status == LRCS_OK) {
        status = run_raster(run, samples_only ? NULL : &known, size);
        if (status != LRCS_OK) {
            break;
        }
        lrcsi_sigma_sum(run, &run->meter);
        if (raster_ends(run, samples_only)) {
            break;
        }
        size = next_size(run);
    }
    run->work->used = mark;
    return status;
}

/* --- the cheapest method first ---------------------------------------------------------------- */

/* The outcome of an attempt to clip. */
enum clip_outcome { CLIP_DONE, CLIP_ABANDONED, CLIP_NOT_BEGUN };

/* Tries to clip and to sum within ns, the estimated time of a raster, which limits the number of
   steps. The attempt is abandoned when the steps are spent, and is not begun if too many facets
   turn out to be undecided. Of such an attempt only the number of steps taken and, if it was
   completed, the classification are kept. */
static int run_clip_within(lrcsi_sigma *run, const lrcsi_cost *cost, double ns)
{
    const lrcsi_outcome before = run->outcome;
    const int classified = run->classified;
    uint64_t steps = lrcsi_cost_steps(ns);
    uint64_t left = run->meter.limit - run->meter.taken;
    lrcsi_meter meter = {.limit = steps < left ? steps : left}; /* of this attempt */
    size_t mark = run->work->used;
    int outcome = CLIP_ABANDONED;
    if (run_classify(run, &meter) != LRCS_OK || meter.spent) {
        run->classified = classified;
    } else {
        mark = run->work->used;
        if (lrcsi_cost_clip(cost, run->classification.undecided_count) > ns) {
            outcome = CLIP_NOT_BEGUN;
        } else if (run_clip(run, &meter) == LRCS_OK) {
            run->outcome.method = LRCS_METHOD_EXACT;
            lrcsi_sigma_sum(run, &meter);
            outcome = meter.spent ? CLIP_ABANDONED : CLIP_DONE;
        }
    }
    run->meter.taken += meter.taken;
    if (outcome != CLIP_DONE) {
        run->work->used = mark;
        run->outcome = before;
    }
    return outcome;
}

/* Computes an answer whose estimate may be accepted, by the method whose estimated cost is lower.
   In each round:
   1. clipping is tried if it is likely to take little longer than the next raster, whose estimate
      may not be accepted; after an abandoned attempt it is tried again only if a raster takes four
      times as long as that attempt was allowed to take;
   2. a raster of samples alone is drawn; the first one is cheap.
   If no raster is accepted, the caller clips. If the options accept any answer, the first raster is
   accepted. */
static int run_previews(lrcsi_sigma *run)
{
    const lrcsi_cost cost = lrcsi_cost_count(&run->view);
    const int any = run->request.options->accept == LRCS_ACCEPT_ANY;
    uint32_t size =
        lrcsi_cost_size(&cost, any ? 1 : run->request.options->tolerance, LRCSI_SIGMA_SIZE_MAX);
    double abandoned_ns = 0;
    int status = LRCS_OK;
    for (int rasters = 0;; rasters++) {
        double undecided =
            run->classified ? run->classification.undecided_count : lrcsi_cost_undecided(&cost);
        double ns = lrcsi_cost_draw(&cost, size);
        ns *= rasters == 0 ? CLIP_PREFERRED : CLIP_PREFERRED_NEXT;
        if (!any && ns >= 4 * abandoned_ns && lrcsi_cost_clip(&cost, undecided) <= ns) {
            int outcome = run_clip_within(run, &cost, ns);
            if (outcome == CLIP_DONE) {
                run->outcome.reason = "clipping is estimated to cost less than a raster";
                return LRCS_OK;
            }
            abandoned_ns = outcome == CLIP_ABANDONED ? ns : abandoned_ns;
        }
        size = rasters == 0 ? lrcsi_cost_first(&cost, size) : size;
        status = run_raster(run, NULL, size);
        if (status != LRCS_OK) {
            break;
        }
        lrcsi_sigma_sum(run, &run->meter);
        if (raster_ends(run, 1) || (run->outcome.flags & LRCS_FLAG_DEPTH_UNDECIDED)) {
            break;
        }
        size = next_size(run);
    }
    if (!any) {
        run->outcome.reason = abandoned_ns > 0 ? "clipping was begun, and took longer than a raster"
                                               : "a raster is estimated to cost less than clipping";
    }
    return status;
}

/* --- the order of methods --------------------------------------------------------------------- */

/* Clips, and sums; where there is too little memory for clipping, draws rasters instead. */
static int run_exact(lrcsi_sigma *run, const char *reason)
{
    run->outcome.method = LRCS_METHOD_EXACT;
    run->outcome.reason = reason;
    int status = run_clip(run, &run->meter);
    if (status == LRCS_OK) {
        lrcsi_sigma_sum(run, &run->meter);
    } else if (status == LRCS_E_MEMORY) {
        run->outcome.method = LRCS_METHOD_ZBUFFER;
        run->outcome.reason = "too little memory for clipping";
        run->outcome.flags = LRCS_FLAG_MEMORY_FALLBACK;
        status = run_rasters(run, 0);
    }
    return status;
}

/* Computes visible areas and their sum, where shadows are searched for:
   1. view coordinates;
   2. the classification, unless areas are taken from samples alone;
   3. the plan's method. Under auto a raster comes first if its size was requested, or if it costs
      less than clipping and its estimate may be accepted;
   4. clipping under auto, if no raster was accepted. */
int lrcsi_sigma_search(lrcsi_sigma *run)
{
    const lrcs_run_options *options = run->request.options;
    int status = lrcsi_view_project(run->work, &run->view);
    if (status == LRCS_OK && run->request.last > LRCSI_SIGMA_VIEW && !run->plan.samples_only) {
        status = run_classify(run, &run->meter);
    }
    if (status != LRCS_OK || run->request.last <= LRCSI_SIGMA_CLASSIFY) {
        return status;
    }
    lrcsi_progress_report(run->view.progress, LRCS_PROGRESS_VISIBILITY, 0, 0);
    if (run->plan.method == LRCS_METHOD_EXACT) {
        return run_exact(run, run->plan.reason);
    }
    status = run->plan.previews ? run_previews(run) : run_rasters(run, run->plan.samples_only);
    if (status == LRCS_OK && options->method == LRCS_METHOD_AUTO &&
        run->outcome.method == LRCS_METHOD_ZBUFFER && !run->meter.spent &&
        (lrcsi_sigma_acceptance(run) & LRCS_FLAG_TOLERANCE_NOT_MET)) {
        run->outcome.flags = 0;
        status =
            run_exact(run, options->resolution != 0 ? "the requested raster misses the tolerance"
                                                    : "no raster's estimate meets the tolerance");
    }
    return status;
}
