/* SPDX-License-Identifier: MIT */
/* Computes one pose, from a prepared scene to a result. This file decides in which order the stages
   run, which method follows if the first one does not meet the tolerance, and at which resolution
   rasters are drawn. The stages, in the order of lrcsi_sigma_stages:
   1. view: lrcsi_plan_backs, lrcsi_view_face, lrcsi_clear_make, lrcsi_plan_make,
      lrcsi_view_project;
   2. classification: run_classify;
   3. visible areas: run_clip, or run_raster (samples), or run_unshadowed where nothing is searched
      for shadows;
   4. the sum of Eq. 2: run_sum.
   Rasters are drawn until one is accepted (run_rasters), or clipping and rasters take turns
   (run_previews); so 3 and 4 may be repeated. */
#include "integrate/sigma.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "integrate/cost.h"
#include "integrate/image.h"
#include "visibility/preview.h"
#include "visibility/proximity_hidden.h"

/* The size of the finest raster: a finer one would improve the bound too little for its cost. */
#define LAST_SIZE 4096u

/* Clipping is tried before a raster if its estimated cost is at most this many times that of the
   raster: by the first factor before the first raster, by the second before each later one. */
#define CLIP_PREFERRED      1.5
#define CLIP_PREFERRED_NEXT 2.5

lrcs_run_options lrcs_run_options_default(void)
{
    return (lrcs_run_options){1e-4, LRCS_METHOD_AUTO, 0, 0, 0, 0, LRCS_ACCEPT_BOUND, NULL, NULL};
}

int lrcsi_sigma_check(const lrcs_run_options *options, const lrcs_image *image)
{
    if (options->method < LRCS_METHOD_AUTO || options->method > LRCS_METHOD_EXACT ||
        !(options->tolerance > 0) || options->resolution > LRCSI_IMAGE_SIZE_MAX ||
        options->accept < LRCS_ACCEPT_BOUND || options->accept > LRCS_ACCEPT_ANY ||
        ((options->without | options->with) & ~LRCS_EFFECTS_SWITCHED) != 0 ||
        (options->without & options->with) != 0 || (image && image->size > LRCSI_IMAGE_SIZE_MAX)) {
        return LRCS_E_ARGUMENT;
    }
    return LRCS_OK;
}

/* --- memory ----------------------------------------------------------------------------------- */

/* Moments of visible regions are used where facets stand for curved shapes among others. They are
   not computed with curved normals. */
static int moments_wanted(const lrcs_prepared *prepared)
{
    return prepared->proximity.reach && !prepared->smooth;
}

/* 1. Results by facet: areas, moments, integrals over curved normals;
   2. the view, clear shapes, the classification, the proximity band;
   3. visible areas: by clipping, or by a raster, after which facets with curved normals that are
      partly visible are clipped as well; under auto, the larger of the two. */
size_t lrcs_sigma_need(const lrcs_prepared *prepared, const lrcs_run_options *options)
{
    size_t facets = prepared->scene->facet_count;
    size_t areas = lrcsi_work_bytes(facets, sizeof(lrcsi_visible_area));
    size_t errors =
        options->part_error_m2 ? lrcsi_work_bytes(prepared->scene->part_count, sizeof(double)) : 0;
    size_t curved =
        prepared->smooth
            ? lrcsi_work_add(lrcsi_work_bytes(facets, sizeof(lrcsi_curved)), lrcsi_cubature_need())
            : 0;
    if (options->method == LRCS_METHOD_FACET && options->with == 0) {
        return lrcsi_work_add(lrcsi_work_add(lrcsi_view_face_need(prepared), errors),
                              prepared->smooth ? lrcsi_work_add(areas, curved) : 0);
    }
    size_t need = lrcsi_work_add(lrcsi_work_add(lrcsi_view_need(prepared), errors),
                                 lrcsi_work_add(areas, curved));
    if (options->method == LRCS_METHOD_AUTO) {
        need = lrcsi_work_add(need, lrcsi_clear_need(prepared));
    }
    if (moments_wanted(prepared)) {
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_moment)));
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_round_piece)));
    }
    need = lrcsi_work_add(need, lrcsi_classify_need(prepared));
    need = lrcsi_work_add(need, lrcsi_proximity_band_need(prepared));
    need = lrcsi_work_add(need, lrcsi_proximity_hidden_need(prepared));
    uint32_t size = options->resolution != 0 ? options->resolution : LAST_SIZE;
    size_t exact =
        moments_wanted(prepared) ? lrcsi_round_pieces_need(prepared) : lrcsi_occlude_need(prepared);
    size_t raster =
        lrcsi_work_add(lrcsi_decisions_need(prepared), lrcsi_visible_areas_need(prepared, size));
    raster = lrcsi_work_add(raster, prepared->smooth ? exact : 0);
    if (options->accept != LRCS_ACCEPT_BOUND) {
        size_t preview = lrcsi_preview_need(prepared, size);
        raster = preview > raster ? preview : raster;
    }
    int clips = options->method == LRCS_METHOD_EXACT ||
                (options->method != LRCS_METHOD_ZBUFFER && exact >= raster);
    return lrcsi_work_add(need, clips ? exact : raster);
}

/* Is there no search for shadows? */
static int run_is_unshadowed(const lrcsi_sigma *run)
{
    return run->plan.method == LRCS_METHOD_FACET || run->plan.method == LRCS_METHOD_CLOSED;
}

/* Takes memory for the results of facets, as far as the plan's method needs it. */
static int run_take(lrcsi_sigma *run)
{
    const lrcs_prepared *p = run->view.prepared;
    uint32_t facets = p->scene->facet_count;
    int areas = !run_is_unshadowed(run) || p->smooth;
    run->visible = areas ? lrcsi_work_take(run->work, facets, sizeof *run->visible) : NULL;
    int moments = !run_is_unshadowed(run) && moments_wanted(p);
    run->moment_memory =
        moments ? lrcsi_work_take(run->work, facets, sizeof *run->moment_memory) : NULL;
    run->corrected = moments ? lrcsi_work_take(run->work, facets, 1) : NULL;
    run->piece_memory =
        moments ? lrcsi_work_take(run->work, facets, sizeof *run->piece_memory) : NULL;
    run->curved = p->smooth ? lrcsi_work_take(run->work, facets, sizeof *run->curved) : NULL;
    run->stack = p->smooth ? lrcsi_cubature_stack(run->work) : NULL;
    return (run->visible || !areas) &&
                   ((run->moment_memory && run->corrected && run->piece_memory) || !moments) &&
                   ((run->curved && run->stack) || !p->smooth)
               ? LRCS_OK
               : LRCS_E_MEMORY;
}

/* --- is the answer accepted? ------------------------------------------------------------------ */

static double total_bound(const lrcsi_total *total)
{
    return total->visibility + fmax(0, total->tessellation) + total->rounding;
}

/* How the answer is accepted: 0 if its bound meets the tolerance, else a flag. If the options
   accept estimates, the estimated error of sampled areas replaces the proved bound. There is no
   such estimate in three cases: sigma is 0, because no sample has met anything that reflects; the
   depth order at a sample is undecided, because its owner is then a guess; the steps are spent,
   because undecided facets then count by half. */
static uint32_t run_acceptance(const lrcsi_sigma *run)
{
    const lrcsi_outcome *outcome = &run->outcome;
    const lrcsi_total *t = &outcome->total;
    double allowed = run->options->tolerance * (t->glint + t->diffuse);
    int estimated = outcome->size != 0 && !(outcome->flags & LRCS_FLAG_DEPTH_UNDECIDED) &&
                    !run->meter.spent && allowed > 0 &&
                    t->error_estimate + fmax(0, t->tessellation) + t->rounding <= allowed;
    if (total_bound(t) <= allowed && t->curvature <= allowed) {
        return 0;
    }
    if (run->options->accept != LRCS_ACCEPT_BOUND && estimated && t->curvature <= allowed) {
        return LRCS_FLAG_ACCEPTED_BY_ESTIMATE;
    }
    return run->options->accept == LRCS_ACCEPT_ANY ? LRCS_FLAG_ACCEPTED_UNJUDGED
                                                   : LRCS_FLAG_TOLERANCE_NOT_MET;
}

/* --- the sum over visible areas --------------------------------------------------------------- */

static lrcsi_curve_options run_curve_options(const lrcsi_sigma *run, lrcsi_meter *meter)
{
    return (lrcsi_curve_options){&run->plan, run->options->tolerance, meter, run->stack,
                                 run->derivatives};
}

static const lrcsi_proximity_band *run_band(const lrcsi_sigma *run)
{
    return run->classified && run->plan.proximity_band ? &run->band : NULL;
}

static lrcsi_total run_total(const lrcsi_sigma *run, lrcs_facet_record *records)
{
    const lrcsi_areas areas = {run->visible, run->answer, run->moment, run->piece};
    const lrcsi_total_details details = {records, run->part_error, run->corrected};
    lrcsi_progress_report(run->view.progress, LRCS_PROGRESS_INTEGRATE, 0, 0);
    return lrcsi_total_make(&run->view, &run->plan, &areas, run->curved, run_band(run), &run->clear,
                            &details);
}

/* The areas of method facet. Only facets with curved normals need them in memory; for all others
   lrcsi_total_make derives them from the plan. */
static void run_unshadowed(lrcsi_sigma *run)
{
    const lrcsi_view *view = &run->view;
    for (uint32_t f = 0; run->curved && f < view->prepared->scene->facet_count; f++) {
        lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
        run->visible[f] = lrcsi_view_casts(view, f)
                              ? lrcsi_visible_area_unshadowed(&incidence, run->plan.grazing_cos)
                              : lrcsi_visible_area_exact(0);
    }
    if (run->curved) {
        lrcsi_curve_options options = run_curve_options(run, &run->meter);
        lrcsi_curve_from_areas(view, &options, run->visible, run->curved);
    }
}

/* Are there proofs about the visible areas of the pose that the methods do not use? */
static int run_has_proofs(const lrcsi_sigma *run)
{
    return run->plan.fronts_visible || run->clear.count > 0 ||
           (run->view.prepared->solid && run->view.backs.cast);
}

/* Replaces areas by what is proved about them:
   1. On a convex surface fronts are visible, and only the areas of back sides are used. If the
      options force a search for shadows, the interval that it found for a front is extended by the
      proved one: for bodies that are convex by construction no contacts are computed, so that the
      search alone proves nothing.
   2. Back sides that are proved never to be seen have no visible area, whatever the search found.
   3. The fronts of clear shapes are visible; this is needed only for what is reported about their
      facets. */
static void areas_apply_proofs(const lrcsi_sigma *run)
{
    const lrcsi_view *view = &run->view;
    const lrcs_prepared *p = view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        lrcsi_visible_area *visible = &run->visible[f];
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
        if (front && run->clear.count > 0 && run->clear.part[p->scene->facet_part[f]]) {
            double projected = lrcsi_view_projected(view, f);
            *visible = lrcsi_visible_area_exact(projected);
        }
    }
}

/* Computes the sum over the visible areas that samples or clipping found:
   1. replaces areas by what is proved about them;
   2. if they are sampled, integrates over facets with curved normals, which are clipped if they are
      partly visible and there is memory for it; clipping has already integrated over its pieces;
   3. finds the hidden regions of the proximity band;
   4. sums. Steps are taken from the given meter, which is that of the run or of an attempt. */
static void run_sum(lrcsi_sigma *run, lrcsi_meter *meter)
{
    int sampled = run->outcome.size != 0;
    if (run->last < LRCSI_SIGMA_SUM) {
        return;
    }
    if (run_has_proofs(run)) {
        areas_apply_proofs(run);
    }
    if (run->curved && sampled) {
        lrcsi_curve_options options = run_curve_options(run, meter);
        int status = lrcsi_curve_from_samples(&run->classification, &options, run->work,
                                              run->visible, run->curved);
        if (status != LRCS_OK) {
            lrcsi_curve_from_areas(&run->view, &options, run->visible, run->curved);
            run->outcome.flags |= LRCS_FLAG_MEMORY_FALLBACK;
        }
    }
    if (run_band(run)) {
        lrcsi_proximity_find_hidden(&run->band, run->visible, meter, run->work);
    }
    run->piece = NULL;
    if (run_band(run) && run->moment && !run->derivatives) {
        lrcsi_round_pieces_make(&run->classification, &run->plan, &run->band, run->visible, meter,
                                run->work, run->piece_memory);
        run->piece = run->piece_memory;
    }
    run->outcome.total = run_total(run, NULL);
}

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
    if (status == LRCS_OK && run->curved) {
        lrcsi_curve_options options = run_curve_options(run, meter);
        status = lrcsi_curve_from_pieces(&run->classification, &options, run->work, run->visible,
                                         run->curved);
    } else if (status == LRCS_OK) {
        int sum_only = !run->view.prepared->curved && !run_has_proofs(run);
        status =
            lrcsi_occlude_all(&run->classification, meter, run->work,
                              sum_only ? &run->answer : NULL, run->visible, run->moment_memory);
        /* Moments must belong to the areas (areas_apply_proofs). Where steps ran out, areas are
           uncertain, and corrections by moments would make bounds grow where more steps are left.
         */
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

/* The size of the next raster. With the size N the visibility bound falls as 1/N, and the estimated
   error as N^-1.33 or faster on most models. Because the estimate of a coarse raster is rough, it
   increases the size to at most four times. */
static uint32_t next_size(const lrcsi_sigma *run)
{
    const lrcsi_total *total = &run->outcome.total;
    double sigma = total->glint + total->diffuse;
    double others = total_bound(total) - total->visibility;
    double allowed = run->options->tolerance * sigma - others; /* for visibility */
    double ratio = sqrt(total->error_estimate / allowed);
    double times = run->options->accept == LRCS_ACCEPT_BOUND ? 1.2 * total->visibility / allowed
                                                             : fmin(ratio * sqrt(ratio), 4);
    double size = run->outcome.size * fmax(1.5, times);
    if (!(allowed > 0) || !(size < LAST_SIZE)) {
        return LAST_SIZE;
    }
    return 64 * ((uint32_t)size / 64 + 1);
}

/* Is the last raster accepted, or would a finer one be no better? */
static int raster_ends(const lrcsi_sigma *run, int samples_only)
{
    const lrcsi_outcome *outcome = &run->outcome;
    return run->options->resolution != 0 || outcome->size >= LAST_SIZE || run->meter.spent ||
           (outcome->flags & LRCS_FLAG_MEMORY_FALLBACK) ||
           (!samples_only && run->classification.undecided_count == 0) ||
           !(run_acceptance(run) & LRCS_FLAG_TOLERANCE_NOT_MET);
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
        run_sum(run, &run->meter);
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
            run_sum(run, &meter);
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
    const int any = run->options->accept == LRCS_ACCEPT_ANY;
    uint32_t size = lrcsi_cost_size(&cost, any ? 1 : run->options->tolerance, LAST_SIZE);
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
        run_sum(run, &run->meter);
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

/* --- the stages ------------------------------------------------------------------------------- */

/* Clips, and sums; where there is too little memory for clipping, draws rasters instead. */
static int run_exact(lrcsi_sigma *run, const char *reason)
{
    run->outcome.method = LRCS_METHOD_EXACT;
    run->outcome.reason = reason;
    int status = run_clip(run, &run->meter);
    if (status == LRCS_OK) {
        run_sum(run, &run->meter);
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
static int run_shadowed(lrcsi_sigma *run)
{
    const lrcs_run_options *options = run->options;
    int status = lrcsi_view_project(run->work, &run->view);
    if (status == LRCS_OK && run->last > LRCSI_SIGMA_VIEW && !run->plan.samples_only) {
        status = run_classify(run, &run->meter);
    }
    if (status != LRCS_OK || run->last <= LRCSI_SIGMA_CLASSIFY) {
        return status;
    }
    lrcsi_progress_report(run->view.progress, LRCS_PROGRESS_VISIBILITY, 0, 0);
    if (run->plan.method == LRCS_METHOD_EXACT) {
        return run_exact(run, run->plan.reason);
    }
    status = run->plan.previews ? run_previews(run) : run_rasters(run, run->plan.samples_only);
    if (status == LRCS_OK && options->method == LRCS_METHOD_AUTO &&
        run->outcome.method == LRCS_METHOD_ZBUFFER && !run->meter.spent &&
        (run_acceptance(run) & LRCS_FLAG_TOLERANCE_NOT_MET)) {
        run->outcome.flags = 0;
        status =
            run_exact(run, options->resolution != 0 ? "the requested raster misses the tolerance"
                                                    : "no raster's estimate meets the tolerance");
    }
    return status;
}

int lrcsi_sigma_stages(lrcsi_sigma *run, const lrcs_prepared *prepared, const lrcs_pose *pose)
{
    const lrcs_run_options *options = run->options;
    run->meter.limit = options->steps != 0 ? options->steps : UINT64_MAX;
    const lrcsi_view_backs backs = lrcsi_plan_backs(prepared, options);
    int status = lrcsi_view_face(prepared, pose, backs, run->work, &run->view);
    if (status == LRCS_OK) {
        run->view.progress = options->progress;
        lrcsi_progress_report(run->view.progress, LRCS_PROGRESS_VIEW, 0, 0);
        status = options->method == LRCS_METHOD_AUTO
                     ? lrcsi_clear_make(&run->view, run->work, &run->clear)
                     : LRCS_OK;
    }
    if (status == LRCS_OK) {
        run->plan = lrcsi_plan_make(&run->view, &run->clear, options);
        run->outcome = (lrcsi_outcome){.method = run->plan.method, .reason = run->plan.reason};
        status = run_take(run);
    }
    if (status != LRCS_OK || !run_is_unshadowed(run)) {
        return status == LRCS_OK ? run_shadowed(run) : status;
    }
    if (run->last == LRCSI_SIGMA_SUM) {
        run_unshadowed(run);
        run->outcome.total = run_total(run, NULL);
    }
    return LRCS_OK;
}

double *lrcsi_sigma_part_error(const lrcs_prepared *prepared, const lrcs_run_options *options,
                               lrcs_work *work, int *status)
{
    double *part_error = NULL;
    if (*status == LRCS_OK && options->part_error_m2) {
        part_error = lrcsi_work_take(work, prepared->scene->part_count, sizeof *part_error);
        *status = part_error ? LRCS_OK : LRCS_E_MEMORY;
    }
    return part_error;
}

void lrcsi_sigma_part_error_give(const lrcsi_sigma *run)
{
    if (run->part_error) {
        memcpy(run->options->part_error_m2, run->part_error,
               run->view.prepared->scene->part_count * sizeof *run->part_error);
    }
}

int lrcsi_sigma_result(const lrcsi_sigma *run, lrcs_result *result)
{
    const lrcsi_outcome *outcome = &run->outcome;
    const lrcsi_total *t = &outcome->total;
    if (!isfinite(total_bound(t) + t->glint + t->diffuse + t->curvature)) {
        return LRCS_E_NUMBER;
    }
    lrcs_result r = {.sigma_m2 = t->glint + t->diffuse,
                     .sigma_glint_m2 = t->glint,
                     .sigma_diffuse_m2 = t->diffuse,
                     .bound_m2 = total_bound(t),
                     .budget = {t->visibility, t->tessellation, t->rounding},
                     .estimate_m2 = outcome->size != 0 ? t->error_estimate : -1,
                     .curvature_estimate_m2 = run->curved ? t->curvature : -1,
                     .projected_area_m2 = t->projected,
                     .back_side_area_m2 = t->back_side,
                     .back_side_facets = t->back_sides,
                     .method = outcome->method,
                     .method_reason = outcome->reason,
                     .resolution = outcome->size,
                     .facets_total = run->view.prepared->scene->facet_count,
                     .facets_front = run->view.front,
                     .facets_hidden = t->hidden,
                     .facets_partial = t->partial,
                     .flags = outcome->flags,
                     .steps = run->meter.taken};
    lrcsi_plan_effects(&run->view, &run->plan, &run->clear, t->seen, r.effect);
    r.flags |= run_acceptance(run);
    r.flags |= run->meter.spent ? LRCS_FLAG_STEPS_SPENT : 0u;
    /* Without a search for shadows, back sides are known to be visible only if nothing hides any.
     */
    int backs_known = outcome->method != LRCS_METHOD_FACET || run->plan.no_back_hidden;
    r.notices |= backs_known && t->back_sides != 0 ? LRCS_NOTICE_BACK_SIDES_VISIBLE : 0u;
    r.notices |= t->tessellation < 0 ? LRCS_NOTICE_TESSELLATION_UNKNOWN : 0u;
    *result = r;
    return LRCS_OK;
}

int lrcsi_sigma_until(const lrcs_prepared *prepared, const lrcs_pose *pose,
                      const lrcs_run_options *options, int last, lrcs_work *work)
{
    lrcs_run_options asked = *options;
    if (options->method == LRCS_METHOD_CLOSED) { /* only auto chooses it, and then runs once */
        asked.method = LRCS_METHOD_AUTO;
    }
    int status =
        options->method == LRCS_METHOD_AUTO ? LRCS_E_ARGUMENT : lrcsi_sigma_check(&asked, NULL);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    lrcsi_sigma run = {.options = &asked, .work = work, .last = last};
    status = lrcsi_sigma_stages(&run, prepared, pose);
    work->used = mark;
    return status;
}

/* Draws the requested picture. */
static int run_image(const lrcsi_sigma *run)
{
    lrcsi_raster raster;
    lrcsi_view view = run->view;
    size_t mark = run->work->used;
    int status = view.point ? LRCS_OK : lrcsi_view_project(run->work, &view);
    if (status == LRCS_OK) {
        status = lrcsi_raster_make(&view, run->image->size, run->work, &raster);
    }
    if (status == LRCS_OK) {
        lrcsi_image_fill(&view, raster.owner, run->image);
    }
    run->work->used = mark;
    return status;
}

int lrcs_sigma_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                   const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                   lrcs_facet_record *records, lrcs_image *image)
{
    int status = lrcsi_sigma_check(options, image);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    lrcs_result answer;
    lrcsi_sigma run = {.options = options, .work = work, .image = image, .last = LRCSI_SIGMA_SUM};
    run.part_error = lrcsi_sigma_part_error(prepared, options, work, &status);
    status = status == LRCS_OK ? lrcsi_sigma_stages(&run, prepared, pose) : status;
    status = status == LRCS_OK ? lrcsi_sigma_result(&run, &answer) : status;
    if (status == LRCS_OK && image && image->size != 0) {
        status = run_image(&run);
    }
    if (status == LRCS_OK) { /* nothing can fail from here on: outputs may be touched */
        if (records) {
            run.outcome.total = run_total(&run, records);
        }
        lrcsi_sigma_part_error_give(&run);
        *result = answer;
    }
    work->used = mark;
    return status;
}
