/* SPDX-License-Identifier: MIT */
/* One pose, from a prepared scene to a result: it chooses the raster's resolution, lays out the
   memory and hands each stage the work of the one before. */
#include "integrate/sigma.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "integrate/cost.h"
#include "integrate/image.h"
#include "integrate/plan.h"
#include "integrate/total.h"
#include "integrate/uncertainty.h"
#include "visibility/occlude.h"
#include "visibility/preview.h"

/* The finest raster: beyond it the bound gains less than it costs. */
#define LAST_SIZE 4096u

/* For the sake of an estimate a raster must be likely to cost so many times less than clipping: the
   first, and another one once an estimate did not suffice. */
#define CLIP_PREFERRED      1.5
#define CLIP_PREFERRED_NEXT 2.5

/* Fewer facets are never judged by samples alone. */
#define PREVIEW_FACETS 1024u

/* What a run passes from stage to stage. */
typedef struct sigma_run {
    lrcsi_view view;
    lrcsi_clear clear; /* shapes that count by their closed forms: under auto */
    lrcsi_plan plan;
    lrcsi_classification classification;
    lrcsi_proximity_band margin;
    const lrcsi_proximity_band *doubt; /* margin, or NULL if none was made */
    lrcsi_visible *visible;
    const unsigned char *answer;  /* of facets of which visible[] tells nothing, or NULL */
    lrcsi_curved *curved;         /* NULL: all facets are flat */
    lrcsi_cubature_cell *waiting; /* NULL: the same */
    int moments;                  /* of curved normals: for derivatives */
    double tolerance;
    lrcsi_meter meter; /* of the view */
    lrcsi_total total;
    lrcs_work *work;
    lrcs_image *image;
    int last;      /* lrcsi_sigma_stage: the run ends after it */
    uint32_t size; /* of the raster used, 0: none */
    int undecided; /* facets are classified, and the proximity band is made where it is wanted */
    uint32_t flags;
} sigma_run;

lrcs_run_options lrcs_run_options_default(void)
{
    return (lrcs_run_options){1e-4, LRCS_METHOD_AUTO, 0, 0, 0, 0, LRCS_ACCEPT_BOUND, NULL};
}

static int run_check(const lrcs_run_options *options, const lrcs_image *image)
{
    if (options->method < LRCS_METHOD_AUTO || options->method > LRCS_METHOD_EXACT ||
        !(options->tolerance > 0) || options->resolution > LRCSI_IMAGE_MOST ||
        options->accept < LRCS_ACCEPT_BOUND || options->accept > LRCS_ACCEPT_ANY ||
        ((options->without | options->with) & ~LRCS_EFFECTS_SWITCHED) != 0 ||
        (options->without & options->with) != 0 || (image && image->size > LRCSI_IMAGE_MOST)) {
        return LRCS_E_ARGUMENT;
    }
    return LRCS_OK;
}

/* What finding visible areas takes: under auto, whichever method does. On samples, curved facets
   that are seen in part are clipped. */
static size_t method_need(const lrcs_prepared *prepared, const lrcs_run_options *options)
{
    uint32_t size = options->resolution != 0 ? options->resolution : LAST_SIZE;
    size_t raster =
        lrcsi_work_add(lrcsi_visible_known_need(prepared), lrcsi_visible_need(prepared, size));
    size_t exact = lrcsi_occlude_need(prepared);
    raster = lrcsi_work_add(raster, prepared->smooth ? exact : 0);
    if (options->accept != LRCS_ACCEPT_BOUND) {
        size_t preview = lrcsi_preview_need(prepared, size);
        raster = preview > raster ? preview : raster;
    }
    return options->method == LRCS_METHOD_EXACT                       ? exact
           : options->method == LRCS_METHOD_ZBUFFER || raster > exact ? raster
                                                                      : exact;
}

size_t lrcs_sigma_need(const lrcs_prepared *prepared, const lrcs_run_options *options)
{
    size_t facets = prepared->scene->facet_count;
    size_t areas = lrcsi_work_bytes(facets, sizeof(lrcsi_visible));
    size_t curved =
        prepared->smooth
            ? lrcsi_work_add(lrcsi_work_bytes(facets, sizeof(lrcsi_curved)), lrcsi_cubature_need())
            : 0;
    if (options->method == LRCS_METHOD_FACET && options->with == 0) {
        return lrcsi_work_add(lrcsi_view_face_need(prepared),
                              prepared->smooth ? lrcsi_work_add(areas, curved) : 0);
    }
    size_t need = lrcsi_work_add(lrcsi_view_need(prepared), lrcsi_work_add(areas, curved));
    if (options->method == LRCS_METHOD_AUTO) {
        need = lrcsi_work_add(need, lrcsi_clear_need(prepared));
    }
    need = lrcsi_work_add(need, lrcsi_classify_need(prepared));
    need = lrcsi_work_add(need, lrcsi_proximity_band_need(prepared));
    return lrcsi_work_add(need, method_need(prepared, options));
}

static double run_bound(const lrcsi_total *total)
{
    return total->visibility + fmax(0, total->tessellation) + total->rounding;
}

static int run_meets(const lrcsi_total *total, double tolerance)
{
    double most = tolerance * (total->glint + total->diffuse);
    return run_bound(total) <= most && total->curvature <= most;
}

/* Does the likely error meet the tolerance where the proved one does not? Only the raster's part of
   the bound has an estimate. One that knows nothing is none: where sigma is 0, samples have met
   nothing that reflects; where a depth is undecided, an owner is a guess; where steps are spent,
   facets count by half. */
static int run_estimate_meets(const sigma_run *run, double tolerance)
{
    const lrcsi_total *t = &run->total;
    double most = tolerance * (t->glint + t->diffuse);
    return run->size != 0 && !(run->flags & LRCS_FLAG_DEPTH_UNDECIDED) && !run->meter.spent &&
           most > 0 && t->likely + fmax(0, t->tessellation) + t->rounding <= most &&
           t->curvature <= most;
}

/* What the answer is to be flagged with: 0 if its bound meets the tolerance. */
static uint32_t run_verdict(const sigma_run *run, const lrcs_run_options *options)
{
    return run_meets(&run->total, options->tolerance) ? 0u
           : options->accept != LRCS_ACCEPT_BOUND && run_estimate_meets(run, options->tolerance)
               ? LRCS_FLAG_ACCEPTED_BY_ESTIMATE
           : options->accept == LRCS_ACCEPT_ANY ? LRCS_FLAG_ACCEPTED_UNJUDGED
                                                : LRCS_FLAG_TOLERANCE_NOT_MET;
}

static int run_image(sigma_run *run)
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

static void run_total(sigma_run *run, lrcs_facet_record *records)
{
    const lrcsi_areas areas = {run->visible, run->answer};
    lrcsi_view_progress(&run->view, LRCS_PROGRESS_INTEGRATE, 0, 0);
    run->total = lrcsi_total_make(&run->view, &run->plan, &areas, run->curved, run->doubt,
                                  &run->clear, records);
}

static lrcsi_curving run_curving(const sigma_run *run)
{
    return (lrcsi_curving){&run->plan, run->tolerance, run->waiting, run->moments};
}

/* Areas are written down for curved normals only: the sum takes them from the plan. */
static int run_facet(sigma_run *run)
{
    if (run->last < LRCSI_SIGMA_SUM) {
        return LRCS_OK;
    }
    if (run->curved) {
        const lrcsi_view *view = &run->view;
        lrcsi_curving how = run_curving(run);
        for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
            lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
            run->visible[f] = lrcsi_grid_casts(view, f)
                                  ? lrcsi_visible_unshadowed(&incidence, run->plan.grazing_cos)
                                  : (lrcsi_visible){0, 0, 0, 0, 0};
        }
        lrcsi_curve_shares(&run->view, &how, run->visible, run->curved);
    }
    run_total(run, NULL);
    return LRCS_OK;
}

/* On a convex surface samples serve the back sides only: fronts are known. Where they were searched
   all the same, what is known joins what was found: bodies convex by construction are not searched
   for contacts, so that the search alone proves nothing of them. */
static void fronts_are_known(const lrcsi_view *view, const lrcsi_plan *plan, lrcsi_visible *visible)
{
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (view->facing[f] > 0) {
            lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
            lrcsi_visible known = lrcsi_visible_unshadowed(&incidence, plan->grazing_cos);
            if (plan->searched) {
                known.area = visible[f].area;
                known.low = lrcsi_least(known.low, visible[f].low);
                known.likely = visible[f].likely;
                known.bias = visible[f].bias;
            }
            visible[f] = known;
        }
    }
}

/* Back sides proved never to be seen, and looked for all the same: none of them may be all there
   is to the truth. */
static void backs_are_known(const lrcsi_view *view, lrcsi_visible *visible)
{
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        visible[f].low = view->facing[f] < 0 ? 0 : visible[f].low;
    }
}

/* The fronts of clear shapes are seen whole: for what is reported of their facets. */
static void shapes_are_known(const sigma_run *run)
{
    const lrcsi_view *view = &run->view;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (view->facing[f] > 0 && run->clear.part[view->prepared->scene->facet_part[f]]) {
            double whole = lrcsi_view_projected(view, f);
            run->visible[f] = (lrcsi_visible){whole, whole, whole, 0, 0};
        }
    }
}

/* Curved facets of which samples know the areas: clipped where they are seen in part, as far as
   there is memory for that. */
static void sum_curved(sigma_run *run)
{
    lrcsi_curving how = run_curving(run);
    int status =
        lrcsi_curve_pieces(&run->classification, &how, 1, run->work, run->visible, run->curved);
    if (status != LRCS_OK) {
        lrcsi_curve_shares(&run->view, &how, run->visible, run->curved);
    }
    run->flags |= status != LRCS_OK ? LRCS_FLAG_MEMORY_FALLBACK : 0u;
}

/* The sum over visible areas found by sampling or clipping. */
static void run_sum(sigma_run *run, int sampled)
{
    if (run->last < LRCSI_SIGMA_SUM) {
        return;
    }
    if (run->plan.unshadowed) {
        fronts_are_known(&run->view, &run->plan, run->visible);
    }
    if (run->view.prepared->solid && run->view.backs_cast) {
        backs_are_known(&run->view, run->visible);
    }
    if (run->clear.count > 0) {
        shapes_are_known(run);
    }
    if (run->curved && sampled) { /* clipping has integrated over its pieces */
        sum_curved(run);
    }
    if (run->doubt) {
        lrcsi_proximity_band_settle(run->doubt, run->visible);
    }
    run_total(run, NULL);
}

/* One raster of the given size, or of the largest smaller one that the work area holds. */
static int run_raster(sigma_run *run, const lrcsi_known *known, uint32_t size)
{
    lrcsi_raster raster;
    size_t mark = run->work->used;
    int status = LRCS_E_MEMORY;
    run->flags &= ~(uint32_t)LRCS_FLAG_DEPTH_UNDECIDED; /* of an earlier raster */
    run->answer = NULL;
    for (; status == LRCS_E_MEMORY && size >= 1; size /= 2) {
        status = lrcsi_visible_sampled(known, size, run->work, &raster, run->visible);
        run->flags |= status == LRCS_E_MEMORY ? LRCS_FLAG_MEMORY_FALLBACK : 0u;
    }
    if (status == LRCS_OK) {
        run->size = raster.size;
        for (uint32_t f = 0; f < run->view.prepared->scene->facet_count; f++) {
            run->flags |= raster.undecided[f] ? LRCS_FLAG_DEPTH_UNDECIDED : 0u;
        }
        run_sum(run, 1);
    }
    run->work->used = mark;
    return status;
}

/* Which facets are undecided, and what curved shapes may show otherwise: once. Where back sides are
   left out of a scene that shows some, its true curves are not known. */
static int run_classify(sigma_run *run)
{
    const lrcs_prepared *p = run->view.prepared;
    if (run->undecided) {
        return LRCS_OK;
    }
    lrcsi_view_progress(&run->view, LRCS_PROGRESS_CLASSIFY, 0, 0);
    int status = lrcsi_classify_make(&run->view, run->work, &run->classification);
    if (status == LRCS_OK && p->proximity.reach && (run->view.backs_cast || p->solid)) {
        status = lrcsi_proximity_band_make(&run->classification, run->work, &run->margin);
        run->doubt = &run->margin;
    }
    run->undecided = status == LRCS_OK;
    return status;
}

/* Are areas taken from samples alone, without a proof? Curved normals need to know where on a facet
   it is seen, and curved shapes among others which facets are undecided. Of few facets, what could
   hide them is searched for at less than the cost of a raster, and tells more of errors than so few
   do by chance. */
static int run_samples_only(const sigma_run *run, const lrcs_run_options *options)
{
    const lrcs_prepared *p = run->view.prepared;
    return run->plan.method == LRCS_METHOD_ZBUFFER && options->accept != LRCS_ACCEPT_BOUND &&
           !p->smooth && !p->proximity.reach && run->flags == 0 &&
           run->view.front + run->view.back >= PREVIEW_FACETS;
}

/* One such raster; of a size that the work area holds, if it can. */
static int run_preview_at(sigma_run *run, uint32_t size)
{
    int undecided = 0;
    int status = LRCS_E_MEMORY;
    run->flags &= ~(uint32_t)LRCS_FLAG_DEPTH_UNDECIDED; /* of an earlier raster */
    run->answer = NULL;
    for (; status == LRCS_E_MEMORY && size >= 1; size /= 2) {
        status = lrcsi_preview_make(&run->view, size, run->work, run->visible, &undecided);
        run->flags |= status == LRCS_E_MEMORY ? LRCS_FLAG_MEMORY_FALLBACK : 0u;
        run->size = size;
    }
    if (status == LRCS_OK) {
        run->flags |= undecided ? LRCS_FLAG_DEPTH_UNDECIDED : 0u;
        run_sum(run, 1);
    }
    return status;
}

/* Is the sum all that reads visible areas? It takes those of facets that are seen whole or not at
   all from their answers; tessellation, clear shapes, and what is known of fronts and backs, need
   them all. */
static int run_sums_alone(const sigma_run *run)
{
    const lrcs_prepared *p = run->view.prepared;
    return !p->curved && !run->plan.unshadowed && run->clear.count == 0 &&
           !(p->solid && run->view.backs_cast);
}

static int run_exact(sigma_run *run)
{
    lrcsi_curving how = run_curving(run);
    int status = run_classify(run);
    if (status == LRCS_OK) {
        status = run->curved
                     ? lrcsi_curve_pieces(&run->classification, &how, 0, run->work, run->visible,
                                          run->curved)
                     : lrcsi_occlude_all(&run->classification, run->work,
                                         run_sums_alone(run) ? &run->answer : NULL, run->visible);
    }
    if (status == LRCS_OK) {
        run->size = 0;
        run_sum(run, 0);
    }
    return status;
}

/* The size at which the visibility bound, falling as 1/N, would leave the tolerance room; or the
   likely error, which falls at least as N^-1.33 on most models: there in steps of at most four
   times, since a coarse raster's estimate is rough. */
static uint32_t next_size(const sigma_run *run, const lrcs_run_options *options)
{
    double sigma = run->total.glint + run->total.diffuse;
    double proved = run_bound(&run->total) - run->total.visibility;
    double room = options->tolerance * sigma - proved;
    double likely = sqrt(run->total.likely / room);
    double times = options->accept == LRCS_ACCEPT_BOUND ? 1.2 * run->total.visibility / room
                                                        : fmin(likely * sqrt(likely), 4);
    double size = run->size * fmax(1.5, times);
    if (!(room > 0) || !(size < LAST_SIZE)) {
        return LAST_SIZE;
    }
    return 64 * ((uint32_t)size / 64 + 1);
}

/* Is nothing to be gained by a finer raster than the last one? */
static int raster_ends(const sigma_run *run, const lrcs_run_options *options, int samples_only)
{
    return options->resolution != 0 || run->size >= LAST_SIZE || run->meter.spent ||
           (run->flags & LRCS_FLAG_MEMORY_FALLBACK) ||
           (!samples_only && run->classification.undecided_count == 0) ||
           !(run_verdict(run, options) & LRCS_FLAG_TOLERANCE_NOT_MET);
}

/* Rasters, from the first to one that is accepted, or to the finest. */
static int run_zbuffer(sigma_run *run, const lrcs_run_options *options)
{
    lrcsi_known known;
    size_t mark = run->work->used;
    int samples_only = run_samples_only(run, options);
    uint32_t size = run->plan.size;
    int status = samples_only ? LRCS_OK : run_classify(run);
    if (status == LRCS_OK && !samples_only) {
        status = lrcsi_visible_known(&run->classification, run->work, &known);
    }
    while (status == LRCS_OK) {
        status = samples_only ? run_preview_at(run, size) : run_raster(run, &known, size);
        if (status != LRCS_OK || raster_ends(run, options, samples_only)) {
            break;
        }
        size = next_size(run, options);
    }
    run->work->used = mark;
    return status;
}

/* What came of an attempt to clip. */
enum { CLIP_DONE, CLIP_GIVEN_UP, CLIP_NOT_BEGUN };

/* Clipping in no more steps than fit in the time that a raster takes. Where it does not come to an
   end, or is not begun since too many facets turn out to be undecided, nothing is left of it but
   which ones are, where that was found. */
static int run_clip_within(sigma_run *run, const lrcsi_cost *cost, double ns)
{
    const lrcsi_plan plan = run->plan;
    const lrcsi_total total = run->total;
    const uint32_t flags = run->flags;
    const uint32_t size = run->size;
    const int undecided = run->undecided;
    const lrcsi_proximity_band *doubt = run->doubt;
    const uint64_t most = run->meter.most;
    uint64_t steps = lrcsi_cost_steps(ns);
    uint64_t left = run->meter.most - run->meter.taken;
    size_t mark = run->work->used;
    int result = CLIP_GIVEN_UP;
    run->meter.most = run->meter.taken + (steps < left ? steps : left);
    if (run_classify(run) != LRCS_OK || run->meter.spent) {
        run->undecided = undecided;
        run->doubt = doubt;
    } else if (lrcsi_cost_clip(cost, run->classification.undecided_count) > ns) {
        mark = run->work->used;
        result = CLIP_NOT_BEGUN;
    } else {
        mark = run->work->used;
        run->plan.method = LRCS_METHOD_EXACT;
        int status = run_exact(run);
        result = status == LRCS_OK && !run->meter.spent ? CLIP_DONE : CLIP_GIVEN_UP;
    }
    run->meter.most = most;
    if (result != CLIP_DONE) {
        run->work->used = mark;
        run->meter.spent = 0;
        run->plan = plan;
        run->flags = flags;
        run->size = size;
        run->total = total;
    }
    return result;
}

/* For the sake of an estimate, where samples alone are judges, until an answer is accepted:
   1. run_clip_within, where that is likely to take not much longer than the next raster, whose
      estimate may not suffice; again only once a raster takes four times as long as the last
      attempt might;
   2. run_preview_at, a cheap one first.
   Where no raster is accepted the caller clips. Any answer being good, the first raster is. */
static int run_previews(sigma_run *run, const lrcs_run_options *options)
{
    const lrcsi_cost cost = lrcsi_cost_count(&run->view);
    const int any = options->accept == LRCS_ACCEPT_ANY;
    uint32_t size = lrcsi_cost_size(&cost, any ? 1 : options->tolerance, LAST_SIZE);
    double tried = 0;
    int status = LRCS_OK;
    for (int rasters = 0; status == LRCS_OK; rasters++) {
        double undecided =
            run->undecided ? run->classification.undecided_count : lrcsi_cost_undecided(&cost);
        double draw = lrcsi_cost_draw(&cost, size);
        draw *= rasters == 0 ? CLIP_PREFERRED : CLIP_PREFERRED_NEXT;
        if (!any && draw >= 4 * tried && lrcsi_cost_clip(&cost, undecided) <= draw) {
            int result = run_clip_within(run, &cost, draw);
            if (result == CLIP_DONE) {
                run->plan.reason = "clipping is reckoned to cost less than a raster";
                return LRCS_OK;
            }
            tried = result == CLIP_GIVEN_UP ? draw : tried;
        }
        size = rasters == 0 ? lrcsi_cost_first(&cost, size) : size;
        status = run_preview_at(run, size);
        if (status != LRCS_OK || raster_ends(run, options, 1) ||
            (run->flags & LRCS_FLAG_DEPTH_UNDECIDED)) {
            break;
        }
        size = next_size(run, options);
    }
    if (!any) {
        run->plan.reason = tried > 0 ? "clipping was begun, and took longer than a raster"
                                     : "a raster is reckoned to cost less than clipping";
    }
    return status;
}

static int run_method(sigma_run *run, const lrcs_run_options *options)
{
    return run->plan.method == LRCS_METHOD_EXACT ? run_exact(run)
           : run->plan.previews                  ? run_previews(run, options)
                                                 : run_zbuffer(run, options);
}

/* Under auto a raster goes first where its size was asked for, or where it costs less than clipping
   and its estimate may count; where it is not accepted, clipping follows. Clipping that finds no
   memory yields to a raster, which needs less, whether it was asked for or not. */
static int run_shadowed(sigma_run *run, const lrcs_run_options *options)
{
    int status = lrcsi_view_project(run->work, &run->view);
    if (run->plan.previews && !run_samples_only(run, options)) {
        run->plan.previews = 0;
        if (options->accept == LRCS_ACCEPT_ESTIMATE) {
            run->plan.method = LRCS_METHOD_EXACT;
            run->plan.reason = "few facets, or curved ones: a raster saves little of clipping";
        }
    }
    if (status == LRCS_OK && run->last > LRCSI_SIGMA_VIEW && !run_samples_only(run, options)) {
        status = run_classify(run);
    }
    if (status != LRCS_OK || run->last <= LRCSI_SIGMA_CLASSIFY) {
        return status;
    }
    lrcsi_view_progress(&run->view, LRCS_PROGRESS_VISIBILITY, 0, 0);
    status = run_method(run, options);
    if (status == LRCS_OK && options->method == LRCS_METHOD_AUTO &&
        run->plan.method == LRCS_METHOD_ZBUFFER && !run->meter.spent &&
        (run_verdict(run, options) & LRCS_FLAG_TOLERANCE_NOT_MET)) {
        run->plan.method = LRCS_METHOD_EXACT;
        run->plan.reason = options->resolution != 0 ? "the raster asked for misses the tolerance"
                                                    : "no raster's estimate meets the tolerance";
        run->flags = 0;
        status = run_exact(run);
    }
    if (status == LRCS_E_MEMORY && run->plan.method == LRCS_METHOD_EXACT) {
        run->plan.method = LRCS_METHOD_ZBUFFER;
        run->plan.reason = "too little memory for clipping";
        run->flags = LRCS_FLAG_MEMORY_FALLBACK;
        status = run_zbuffer(run, options);
    }
    return status;
}

static void result_fill(const sigma_run *run, const lrcs_run_options *options, lrcs_result *result)
{
    const lrcsi_total *t = &run->total;
    lrcs_result r = {.sigma_m2 = t->glint + t->diffuse,
                     .sigma_glint_m2 = t->glint,
                     .sigma_diffuse_m2 = t->diffuse,
                     .bound_m2 = run_bound(t),
                     .budget = {t->visibility, t->tessellation, t->rounding},
                     .estimate_m2 = run->size != 0 ? t->likely : -1,
                     .curvature_estimate_m2 = run->curved ? t->curvature : -1,
                     .projected_area_m2 = t->projected,
                     .back_side_area_m2 = t->back_side,
                     .back_side_facets = t->back_sides,
                     .method = run->plan.method,
                     .method_reason = run->plan.reason,
                     .resolution = run->size,
                     .facets_total = run->view.prepared->scene->facet_count,
                     .facets_front = run->view.front,
                     .facets_hidden = t->hidden,
                     .facets_partial = t->partial,
                     .flags = run->flags,
                     .steps = run->meter.taken};
    lrcsi_plan_effects(&run->view, &run->plan, &run->clear, t->seen, r.effect);
    r.flags |= run_verdict(run, options);
    r.flags |= run->meter.spent ? LRCS_FLAG_STEPS_SPENT : 0u;
    r.notices |= t->back_sides != 0 ? LRCS_NOTICE_BACK_SIDES_VISIBLE : 0u;
    r.notices |= t->tessellation < 0 ? LRCS_NOTICE_TESSELLATION_UNKNOWN : 0u;
    *result = r;
}

/* Is nothing searched for that could hide facets? */
static int run_unshadowed(const sigma_run *run)
{
    return run->plan.method == LRCS_METHOD_FACET || run->plan.method == LRCS_METHOD_CLOSED;
}

/* What the facets' results go to. */
static int run_take(sigma_run *run)
{
    const lrcs_prepared *p = run->view.prepared;
    uint32_t facets = p->scene->facet_count;
    int areas = !run_unshadowed(run) || p->smooth;
    run->visible = areas ? lrcsi_work_take(run->work, facets, sizeof *run->visible) : NULL;
    run->curved = p->smooth ? lrcsi_work_take(run->work, facets, sizeof *run->curved) : NULL;
    run->waiting = p->smooth ? lrcsi_cubature_cells(run->work) : NULL;
    return (run->visible || !areas) && ((run->curved && run->waiting) || !p->smooth)
               ? LRCS_OK
               : LRCS_E_MEMORY;
}

static int run_stages(sigma_run *run, const lrcs_prepared *prepared, const lrcs_pose *pose,
                      const lrcs_run_options *options)
{
    run->tolerance = options->tolerance;
    run->meter.most = options->steps != 0 ? options->steps : UINT64_MAX;
    int status = lrcsi_view_face(prepared, pose, run->work, &run->view);
    if (status == LRCS_OK) {
        run->view.meter = &run->meter;
        run->view.progress = options->progress;
        lrcsi_view_progress(&run->view, LRCS_PROGRESS_VIEW, 0, 0);
        const lrcsi_plan_sides backs = lrcsi_plan_backs(prepared, options);
        run->view.backs_cast = backs.cast;
        run->view.backs_reflect = backs.reflect;
        status = options->method == LRCS_METHOD_AUTO
                     ? lrcsi_clear_make(&run->view, run->work, &run->clear)
                     : LRCS_OK;
    }
    if (status == LRCS_OK) {
        run->plan = lrcsi_plan_make(&run->view, &run->clear, options);
        status = run_take(run);
    }
    if (status == LRCS_OK) {
        status = run_unshadowed(run) ? run_facet(run) : run_shadowed(run, options);
    }
    return status;
}

int lrcsi_sigma_until(const lrcs_prepared *prepared, const lrcs_pose *pose,
                      const lrcs_run_options *options, int last, lrcs_work *work)
{
    lrcs_run_options asked = *options;
    if (options->method == LRCS_METHOD_CLOSED) { /* auto's choice again, which runs once */
        asked.method = LRCS_METHOD_AUTO;
    }
    int status = options->method == LRCS_METHOD_AUTO ? LRCS_E_ARGUMENT : run_check(&asked, NULL);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    sigma_run run = {.work = work, .last = last};
    status = run_stages(&run, prepared, pose, &asked);
    work->used = mark;
    return status;
}

int lrcs_sigma_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                   const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                   lrcs_facet_record *records, lrcs_image *image)
{
    int status = run_check(options, image);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    sigma_run run = {.work = work, .image = image, .last = LRCSI_SIGMA_SUM};
    status = run_stages(&run, prepared, pose, options);
    if (status == LRCS_OK && !isfinite(run_bound(&run.total) + run.total.glint + run.total.diffuse +
                                       run.total.curvature)) {
        status = LRCS_E_NUMBER;
    }
    if (status == LRCS_OK && image && image->size != 0) {
        status = run_image(&run);
    }
    if (status == LRCS_OK) { /* nothing can fail from here on: outputs may be touched */
        if (records) {
            run_total(&run, records);
        }
        result_fill(&run, options, result);
    }
    work->used = mark;
    return status;
}

/* --- material uncertainty -----------------------------------------------------------------------
 */

#define DRAWS_MOST (1u << 20)

lrcs_uncertainty_options lrcs_uncertainty_options_default(void)
{
    return (lrcs_uncertainty_options){4096, 1};
}

/* How many nodes of s and m a sample needs: none but the materials' own where sigma is linear in
   all that is uncertain. */
static uint32_t uncertainty_nodes(const lrcs_prepared *prepared,
                                  const lrcs_uncertainty_options *how)
{
    return how->draws == 0 || !lrcsi_uncertainty_bends(prepared->scene) ? 1
           : prepared->smooth                                           ? LRCSI_NODES_CURVED
                                                                        : LRCSI_NODES;
}

size_t lrcs_uncertainty_need(const lrcs_prepared *prepared, const lrcs_run_options *options,
                             const lrcs_uncertainty_options *how)
{
    size_t count = prepared->scene->material_count;
    size_t need = lrcs_sigma_need(prepared, options);
    need = lrcsi_work_add(need, lrcsi_work_bytes(count * LRCSI_NODES, sizeof(lrcsi_node)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(lrcs_brdf)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(lrcsi_response)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(lrcs_material)));
    return lrcsi_work_add(need, lrcsi_uncertainty_need(prepared->scene, how));
}

/* Room for the responses of materials: at all nodes, and at one. */
typedef struct response_room {
    lrcsi_node *node; /* [nodes][material_count] */
    lrcs_brdf *brdf;
    lrcsi_response *response;
    lrcs_material *material; /* a scene's own, with other numbers */
} response_room;

static int room_take(lrcs_work *work, uint32_t nodes, uint32_t materials, response_room *room)
{
    room->node = lrcsi_work_take(work, (size_t)nodes * materials, sizeof *room->node);
    room->brdf = lrcsi_work_take(work, materials, sizeof *room->brdf);
    room->response = lrcsi_work_take(work, materials, sizeof *room->response);
    room->material = lrcsi_work_take(work, materials, sizeof *room->material);
    return room->node && room->brdf && room->response && room->material ? LRCS_OK : LRCS_E_MEMORY;
}

/* The responses of a finished run's materials, with the numbers of room->brdf, as node k. */
static void node_fill(const sigma_run *run, const response_room *room, uint32_t k)
{
    const lrcs_prepared *p = run->view.prepared;
    const lrcsi_areas areas = {run->visible, run->answer};
    uint32_t count = p->scene->material_count;
    lrcsi_response_make(&run->view, &run->plan, &areas, run->curved, &run->clear, room->brdf,
                        room->response);
    for (uint32_t i = 0; i < count; i++) {
        const lrcsi_response *at = &room->response[i];
        room->node[(size_t)k * count + i] =
            (lrcsi_node){lrcsi_prepared_area(p, lrcsi_sum_value(&at->glint)),
                         lrcsi_prepared_area(p, lrcsi_sum_value(&at->diffuse)),
                         lrcsi_prepared_area(p, lrcsi_sum_value(&at->glint_s)),
                         lrcsi_prepared_area(p, lrcsi_sum_value(&at->diffuse_m))};
    }
}

/* Node k of a scene with curved normals: the pose again, with these numbers at amplitudes of 1. */
static int node_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                    const lrcs_run_options *options, lrcs_work *work, const response_room *room,
                    uint32_t k)
{
    size_t mark = work->used;
    lrcs_scene scene = *prepared->scene;
    lrcs_prepared other = *prepared;
    sigma_run run = {.work = work, .last = LRCSI_SIGMA_SUM, .moments = 1};
    for (uint32_t i = 0; i < scene.material_count; i++) {
        room->material[i] = prepared->scene->material[i];
        room->material[i].brdf = room->brdf[i];
        room->material[i].brdf.A = room->brdf[i].s > 0 ? 1 : 0;
        room->material[i].brdf.B = 1;
    }
    scene.material = room->material;
    other.scene = &scene;
    int status = run_stages(&run, &other, pose, options);
    if (status == LRCS_OK) {
        node_fill(&run, room, k);
    }
    work->used = mark;
    return status;
}

static int errors_check(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *m = &scene->material[i];
        if (lrcs_brdf_error_check(&m->brdf, &m->error) != LRCS_OK) {
            return LRCS_E_NUMBER;
        }
    }
    return LRCS_OK;
}

/* The derivatives, from the materials' own node; and whether they are all numbers. */
static int sensitivity_check(const lrcs_scene *scene, const lrcsi_node *own)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_brdf *brdf = &scene->material[i].brdf;
        if (!isfinite(own[i].glint + own[i].diffuse + brdf->A * own[i].glint_s +
                      brdf->B * own[i].diffuse_m)) {
            return LRCS_E_NUMBER;
        }
    }
    return LRCS_OK;
}

static void sensitivity_fill(const lrcs_scene *scene, const lrcsi_node *own, lrcs_sensitivity *out)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_brdf *brdf = &scene->material[i].brdf;
        out[i] = (lrcs_sensitivity){own[i].glint, own[i].diffuse, brdf->A * own[i].glint_s,
                                    brdf->B * own[i].diffuse_m};
    }
}

/* Steps: 1. the pose, as lrcs_sigma_run; 2. the responses of materials at each node of s and m:
   over the areas of that pose, or with curved normals from a pose each; 3. derivatives, first order
   and sample. */
int lrcs_uncertainty_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                         const lrcs_run_options *options, const lrcs_uncertainty_options *how,
                         lrcs_work *work, lrcs_result *result, lrcs_sensitivity *sensitivity,
                         lrcs_uncertainty *uncertainty)
{
    const lrcs_scene *scene = prepared->scene;
    uint32_t nodes = uncertainty_nodes(prepared, how);
    size_t mark = work->used;
    response_room room;
    lrcs_result answer;
    lrcs_uncertainty found;
    sigma_run run = {.work = work, .last = LRCSI_SIGMA_SUM};
    int status = how->draws == 1 || how->draws > DRAWS_MOST ? LRCS_E_ARGUMENT : LRCS_OK;
    status = status == LRCS_OK ? run_check(options, NULL) : status;
    status = status == LRCS_OK ? errors_check(scene) : status;
    status = status == LRCS_OK ? room_take(work, nodes, scene->material_count, &room) : status;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    size_t start = work->used;
    status = run_stages(&run, prepared, pose, options);
    if (status == LRCS_OK && !isfinite(run_bound(&run.total) + run.total.glint + run.total.diffuse +
                                       run.total.curvature)) {
        status = LRCS_E_NUMBER;
    }
    if (status == LRCS_OK) {
        result_fill(&run, options, &answer);
    }
    for (uint32_t k = 0; k < nodes && status == LRCS_OK; k++) {
        for (uint32_t i = 0; i < scene->material_count; i++) {
            room.brdf[i] = lrcsi_uncertainty_node(&scene->material[i], k, nodes);
        }
        if (prepared->smooth) {
            work->used = start; /* what the pose left is done with */
            status = node_run(prepared, pose, options, work, &room, k);
        } else {
            node_fill(&run, &room, k);
        }
    }
    const lrcsi_node *own = room.node + (size_t)(nodes / 2) * scene->material_count;
    work->used = status == LRCS_OK ? start : work->used;
    status = status == LRCS_OK ? sensitivity_check(scene, own) : status;
    status = status == LRCS_OK ? lrcsi_uncertainty_make(scene, answer.sigma_m2, room.node, nodes,
                                                        how, work, &found)
                               : status;
    if (status == LRCS_OK) {
        sensitivity_fill(scene, own, sensitivity);
        *result = answer;
        *uncertainty = found;
    }
    work->used = mark;
    return status;
}
