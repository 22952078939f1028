/* SPDX-License-Identifier: MIT */
/* Computes one pose, from a prepared scene to a result. This file decides in which order the stages
   run, and what memory they need. Called, in this order:
   1. lrcsi_plan_backs, lrcsi_view_face, lrcsi_clear_make, lrcsi_plan_make: the view, and what it
      calls for;
   2. where no shadows are searched for, lrcsi_sigma_sum_unshadowed (sigma_sum.c), and that is all;
   3. lrcsi_view_project, lrcsi_sigma_classify (sigma_search.c): view coordinates, undecided facets;
   4. until an answer is accepted: lrcsi_attempts_next (sigma_attempt.c) chooses a method or a
      resolution, lrcsi_sigma_search (sigma_search.c) finds visible areas by it,
      lrcsi_sigma_integrate (sigma_sum.c) integrates where areas do not suffice, lrcsi_sigma_sum
      (sigma_sum.c) sums over all facets, lrcsi_attempts_end (sigma_attempt.c) ends the attempt.
   Two exceptions: lrcsi_sigma_search, if it clips, integrates over curved normals already, while
   it has a facet's pieces; and lrcsi_sigma_integrate clips those facets again whose pieces it
   needs, because pieces are not kept. */
#include "integrate/sigma.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "base/work.h"
#include "integrate/image.h"
#include "integrate/sigma_run.h"
#include "integrate/wall/clear_sectors.h"
#include "integrate/wall/round_rim.h"
#include "visibility/raster/preview.h"
#include "visibility/raster/visible.h"

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
    return prepared->proximity.reach && !prepared->has_curved_normals;
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
    size_t curve_terms = prepared->has_curved_normals
                             ? lrcsi_work_add(lrcsi_work_bytes(facets, sizeof(lrcsi_curve_terms)),
                                              lrcsi_cubature_need())
                             : 0;
    size_t wall_terms = lrcsi_work_bytes(facets, sizeof(lrcsi_wall_terms));
    if (options->method == LRCS_METHOD_FACET && options->with == 0) {
        size_t face = lrcsi_work_add(lrcsi_view_face_need(prepared), errors);
        face = lrcsi_work_add(face, lrcsi_sigma_is_one_convex_shape(prepared) ? wall_terms : 0);
        return lrcsi_work_add(
            face, prepared->has_curved_normals ? lrcsi_work_add(areas, curve_terms) : 0);
    }
    size_t need = lrcsi_work_add(lrcsi_work_add(lrcsi_view_need(prepared), errors),
                                 lrcsi_work_add(areas, curve_terms));
    if (moments_wanted(prepared) || lrcsi_sigma_is_one_convex_shape(prepared)) {
        need = lrcsi_work_add(need, wall_terms);
    }
    if (options->method == LRCS_METHOD_AUTO) {
        need = lrcsi_work_add(need, lrcsi_clear_need(prepared));
    }
    if (moments_wanted(prepared)) {
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_moment)));
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(double)));
        need = lrcsi_work_add(need, lrcsi_round_rim_need(prepared));
        need = lrcsi_work_add(need, lrcsi_clear_sectors_need(prepared));
    }
    if (prepared->proximity.reach) {
        need =
            lrcsi_work_add(need, lrcsi_work_blocks(LRCSI_FACES_OF_PART, prepared->scene->part_count,
                                                   sizeof(lrcsi_flat_face)));
    }
    need = lrcsi_work_add(need, lrcsi_classify_need(prepared));
    need = lrcsi_work_add(need, lrcsi_proximity_band_need(prepared));
    need = lrcsi_work_add(need, lrcsi_masked_band_need(prepared));
    uint32_t size = options->resolution != 0 ? options->resolution : LRCSI_SIGMA_SIZE_MAX;
    size_t exact = lrcsi_occlude_need(prepared);
    size_t raster =
        lrcsi_work_add(lrcsi_decisions_need(prepared), lrcsi_visible_areas_need(prepared, size));
    raster = lrcsi_work_add(raster, prepared->has_curved_normals ? exact : 0);
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
static int run_allocate(lrcsi_sigma *run)
{
    const lrcs_prepared *p = run->view.prepared;
    lrcsi_sigma_memory *memory = &run->memory;
    uint32_t facets = p->scene->facet_count;
    int areas = !run_is_unshadowed(run) || p->has_curved_normals;
    memory->visible = areas ? lrcsi_work_take(run->work, facets, sizeof *memory->visible) : NULL;
    int moments = !run_is_unshadowed(run) && moments_wanted(p);
    memory->moment = moments ? lrcsi_work_take(run->work, facets, sizeof *memory->moment) : NULL;
    run->corrected = moments ? lrcsi_work_take(run->work, facets, sizeof *run->corrected) : NULL;
    int wall_terms =
        moments || (lrcsi_sigma_is_one_convex_shape(p) && run->plan.method != LRCS_METHOD_CLOSED);
    memory->wall_terms =
        wall_terms ? lrcsi_work_take(run->work, facets, sizeof *memory->wall_terms) : NULL;
    int faces = !run_is_unshadowed(run) && p->proximity.reach != NULL;
    memory->face =
        faces ? lrcsi_work_take(run->work, LRCSI_FACES_OF_PART * (size_t)p->scene->part_count,
                                sizeof *memory->face)
              : NULL;
    run->curve_terms =
        p->has_curved_normals ? lrcsi_work_take(run->work, facets, sizeof *run->curve_terms) : NULL;
    run->stack = p->has_curved_normals ? lrcsi_cubature_stack(run->work) : NULL;
    return (memory->visible || !areas) && ((memory->moment && run->corrected) || !moments) &&
                   (memory->wall_terms || !wall_terms) && (memory->face || !faces) &&
                   ((run->curve_terms && run->stack) || !p->has_curved_normals)
               ? LRCS_OK
               : LRCS_E_MEMORY;
}

/* --- the stages ------------------------------------------------------------------------------- */

int lrcsi_sigma_stages(const lrcsi_sigma_request *request, const lrcs_prepared *prepared,
                       const lrcs_pose *pose, lrcs_work *work, lrcsi_sigma *run)
{
    const lrcs_run_options *options = request->options;
    memset(run, 0,
           sizeof *run); /* not a compound literal, which takes as much of the stack again */
    run->request = *request;
    run->work = work;
    run->meter.limit = options->steps != 0 ? options->steps : UINT64_MAX;

    /* 1. The view, and what it calls for. */
    int status =
        lrcsi_view_face(prepared, pose, lrcsi_plan_backs(prepared, options), work, &run->view);
    if (status == LRCS_OK) {
        lrcsi_progress_report(options->progress, LRCS_PROGRESS_VIEW, 0, 0);
        status = options->method == LRCS_METHOD_AUTO
                     ? lrcsi_clear_make(&run->view, work, &run->clear)
                     : LRCS_OK;
    }
    if (status == LRCS_OK) {
        run->plan = lrcsi_plan_make(&run->view, &run->clear, options);
        run->outcome.method = run->plan.method;
        run->outcome.reason = run->plan.reason;
        status = run_allocate(run);
    }
    if (status != LRCS_OK) {
        return status;
    }

    /* 2. Without a search for shadows: the sum over the areas that the plan implies. */
    if (run_is_unshadowed(run)) {
        if (request->last == LRCSI_SIGMA_SUM) {
            lrcsi_sigma_sum_unshadowed(run);
        }
        return LRCS_OK;
    }

    /* 3. View coordinates, and which facets are undecided, unless samples alone decide. */
    status = lrcsi_view_project(work, &run->view);
    if (status == LRCS_OK && request->last >= LRCSI_SIGMA_CLASSIFY && !run->plan.samples_only) {
        status = lrcsi_sigma_classify(run, &run->meter, 0);
    }
    if (status != LRCS_OK || request->last <= LRCSI_SIGMA_CLASSIFY) {
        return status;
    }

    /* 4. Visible areas and the sum over them, attempt by attempt, until an answer is accepted or no
       other attempt would improve it. */
    lrcsi_attempts attempts;
    lrcsi_attempt *attempt = &attempts.current;
    memset(&attempts, 0, sizeof attempts);
    if (run->plan.previews) {
        attempts.cost = lrcsi_cost_count(&run->view);
    }
    lrcsi_progress_report(options->progress, LRCS_PROGRESS_VISIBILITY, 0, 0);
    while (lrcsi_attempts_next(run, &attempts)) {    /* which method, how fine */
        status = lrcsi_sigma_search(run, &attempts); /* visible areas */
        if (status != LRCS_OK) {
            break;
        }
        if (attempt->end == LRCSI_ATTEMPT_FOUND && request->last == LRCSI_SIGMA_SUM) {
            lrcsi_sigma_integrate(run, &attempt->meter); /* where areas do not suffice */
            run->outcome.total = lrcsi_sigma_sum(run, NULL);
        }
        lrcsi_attempts_end(run, &attempts);
    }
    lrcsi_sigma_release_decisions(run, &attempts);
    return status;
}

int lrcsi_sigma_request_make(const lrcs_prepared *prepared, const lrcs_run_options *options,
                             lrcs_work *work, lrcsi_sigma_request *request)
{
    *request = (lrcsi_sigma_request){.options = options, .last = LRCSI_SIGMA_SUM};
    if (options->part_error_m2) {
        request->part_error =
            lrcsi_work_take(work, prepared->scene->part_count, sizeof *request->part_error);
    }
    return request->part_error || !options->part_error_m2 ? LRCS_OK : LRCS_E_MEMORY;
}

void lrcsi_sigma_part_error_copy(const lrcsi_sigma *run)
{
    if (run->request.part_error) {
        memcpy(run->request.options->part_error_m2, run->request.part_error,
               run->view.prepared->scene->part_count * sizeof *run->request.part_error);
    }
}

int lrcsi_sigma_result(const lrcsi_sigma *run, lrcs_result *result)
{
    const lrcsi_outcome *outcome = &run->outcome;
    const lrcsi_total *t = &outcome->total;
    if (!isfinite(lrcsi_sigma_bound(t) + t->glint + t->diffuse + t->cubature_estimate)) {
        return LRCS_E_NUMBER;
    }
    lrcs_result r = {.sigma_m2 = t->glint + t->diffuse,
                     .sigma_glint_m2 = t->glint,
                     .sigma_diffuse_m2 = t->diffuse,
                     .bound_m2 = lrcsi_sigma_bound(t),
                     .budget = {t->visibility, t->tessellation, t->rounding},
                     .estimate_m2 = outcome->size != 0 ? t->error_estimate : -1,
                     .curvature_estimate_m2 = run->curve_terms ? t->cubature_estimate : -1,
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
    r.flags |= lrcsi_sigma_acceptance(run);
    r.flags |= run->meter.spent ? LRCS_FLAG_STEPS_SPENT : 0u;
    /* Without a search for shadows, back sides are known to be visible only if nothing hides any.
     */
    int backs_known = outcome->method != LRCS_METHOD_FACET || run->plan.no_back_hidden;
    r.notices |= backs_known && t->back_sides != 0 ? LRCS_NOTICE_BACK_SIDES_VISIBLE : 0u;
    r.notices |= t->tessellation < 0 ? LRCS_NOTICE_TESSELLATION_UNKNOWN : 0u;
    *result = r;
    return LRCS_OK;
}

int lrcsi_sigma_run_until(const lrcs_prepared *prepared, const lrcs_pose *pose,
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
    const lrcsi_sigma_request request = {.options = &asked, .last = last};
    lrcsi_sigma run;
    status = lrcsi_sigma_stages(&request, prepared, pose, work, &run);
    work->used = mark;
    return status;
}

/* Draws the requested picture of a view, which need not have coordinates. */
static int image_draw(const lrcsi_view *view, lrcs_progress *progress, lrcs_work *work,
                      lrcs_image *image)
{
    lrcsi_raster raster;
    lrcsi_view projected = *view;
    size_t mark = work->used;
    int status = view->point ? LRCS_OK : lrcsi_view_project(work, &projected);
    if (status == LRCS_OK) {
        status = lrcsi_raster_make(&projected, image->size, NULL, progress, work, &raster);
    }
    if (status == LRCS_OK) {
        lrcsi_image_fill(&projected, raster.owner, image);
    }
    work->used = mark;
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
    lrcsi_sigma run;
    lrcsi_sigma_request request;
    status = lrcsi_sigma_request_make(prepared, options, work, &request);
    status = status == LRCS_OK ? lrcsi_sigma_stages(&request, prepared, pose, work, &run) : status;
    status = status == LRCS_OK ? lrcsi_sigma_result(&run, &answer) : status;
    if (status == LRCS_OK && image && image->size != 0) {
        status = image_draw(&run.view, options->progress, work, image);
    }
    if (status == LRCS_OK) { /* nothing can fail from here on: outputs may be touched */
        if (records) {
            (void)lrcsi_sigma_sum(&run, records); /* the same total again */
        }
        lrcsi_sigma_part_error_copy(&run);
        *result = answer;
    }
    work->used = mark;
    return status;
}
