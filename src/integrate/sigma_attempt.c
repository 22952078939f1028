/* SPDX-License-Identifier: MIT */
/* Which attempts to find visible areas a run makes, in which order: by which method, at which
   resolution of a raster, and within which limit; and what becomes of one that has ended. This file
   decides neither how areas are found (sigma_search.c) nor whether their sum is accepted
   (sigma_sum.c). All constants and estimates here affect only the time that a run takes, and which
   of several valid answers it gives. */
#include <math.h>

#include "integrate/sigma_run.h"

/* Clipping is tried before a raster if its estimated cost is at most this many times that of the
   raster: by the first factor before the first raster, by the second before each later one.
   Heuristics: clipping leaves only rounding errors, whereas the estimate of a raster may be
   refused, after one refusal more likely than before. */
#define CLIP_PREFERRED      1.5
#define CLIP_PREFERRED_NEXT 2.5
/* After clipping was abandoned it is tried again only with a limit larger by this factor. A
   heuristic: all abandoned attempts together then take at most 4/3 of the time of the last one. */
#define CLIP_AGAIN 4.0

/* A raster is this many times as large as the one before, at least; with an estimate, at most.
   Heuristics, which affect only the time: smaller steps would draw more rasters, larger ones a
   raster that is finer than the tolerance requires. */
#define GROWTH_MIN 1.5
#define GROWTH_MAX 4.0
/* A size that is to meet the tolerance by its bound is chosen larger by this factor, because the
   next bound is known only approximately. A heuristic: it affects only the time. */
#define BOUND_MARGIN 1.2

#define NO_MEMORY_REASON "too little memory for clipping"

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
           (run->plan.previews && (outcome->flags & LRCS_FLAG_DEPTH_UNDECIDED)) ||
           (!samples_only && run->classification.undecided_count == 0) ||
           !(lrcsi_sigma_acceptance(run) & LRCS_FLAG_TOLERANCE_NOT_MET);
}

/* --- the order of attempts -------------------------------------------------------------------- */

/* Clipping that may take an estimated time, HUGE_VAL for any, and as many steps as fit in it. */
static lrcsi_attempt attempt_clipping(const lrcsi_sigma *run, double limit_ns, const char *reason)
{
    lrcsi_attempt clipping = {
        .method = LRCS_METHOD_EXACT, .reason = reason, .limit_ns = limit_ns, .meter = run->meter};
    uint64_t left = run->meter.limit - run->meter.taken;
    if (limit_ns < HUGE_VAL && lrcsi_cost_steps(limit_ns) < left) {
        clipping.meter.limit = run->meter.taken + lrcsi_cost_steps(limit_ns);
    }
    return clipping;
}

static lrcsi_attempt attempt_raster(const lrcsi_sigma *run, uint32_t size, const char *reason)
{
    return (lrcsi_attempt){.method = LRCS_METHOD_ZBUFFER,
                           .reason = reason,
                           .limit_ns = HUGE_VAL,
                           .size = size,
                           .samples_only = run->plan.samples_only,
                           .meter = run->meter};
}

/* The next attempt if the plan has previews: rasters of samples alone, whose estimates may be
   accepted.
   1. The size of the next raster. If the options accept any answer, the coarsest does.
   2. Clipping is tried before the raster if it is likely to take little longer, because the
      estimate of the raster may not be accepted; after an abandoned attempt it is tried again only
      with a larger limit, and not at all if memory was short. Any answer is accepted from a raster.
      A raster after that does not count as a fallback: either the options accept its answer, or
      unlimited clipping follows, for which memory is short as well.
   3. The raster; the first one is cheap. */
static lrcsi_attempt preview_next(const lrcsi_sigma *run, lrcsi_attempts *attempts)
{
    const lrcsi_attempt *last = &attempts->current;
    const lrcsi_cost *cost = &attempts->cost;
    const int any = run->request.options->accept == LRCS_ACCEPT_ANY;
    if (last->end == LRCSI_ATTEMPT_NONE) { /* 1 */
        attempts->size =
            lrcsi_cost_size(cost, any ? 1 : run->request.options->tolerance, LRCSI_SIGMA_SIZE_MAX);
    } else if (last->method == LRCS_METHOD_ZBUFFER) {
        attempts->size = next_size(run);
    } else if (last->end == LRCSI_ATTEMPT_ABANDONED) {
        attempts->abandoned_ns = last->limit_ns;
        attempts->steps_short = last->meter.limit == run->meter.limit;
    } else if (last->end == LRCSI_ATTEMPT_NO_MEMORY) {
        attempts->memory_short = 1;
    }
    if (last->method != LRCS_METHOD_EXACT && !any && !attempts->memory_short) { /* 2 */
        double limit_ns = lrcsi_cost_draw(cost, attempts->size) *
                          (attempts->rasters == 0 ? CLIP_PREFERRED : CLIP_PREFERRED_NEXT);
        double undecided =
            run->classified ? run->classification.undecided_count : lrcsi_cost_undecided(cost);
        if (limit_ns >= CLIP_AGAIN * attempts->abandoned_ns &&
            lrcsi_cost_clip(cost, undecided) <= limit_ns) {
            return attempt_clipping(run, limit_ns,
                                    "clipping is estimated to cost less than a raster");
        }
    }
    uint32_t size = /* 3 */
        attempts->rasters == 0 ? lrcsi_cost_first(cost, attempts->size) : attempts->size;
    attempts->rasters++;
    return attempt_raster(
        run, size,
        any                          ? run->plan.reason
        : attempts->memory_short     ? NO_MEMORY_REASON
        : attempts->steps_short      ? "clipping was begun, and took more steps than the run has"
        : attempts->abandoned_ns > 0 ? "clipping was begun, and took longer than a raster"
                                     : "a raster is estimated to cost less than clipping");
}

/* The order of attempts:
   1. If the plan is to clip, clipping comes first, and nothing follows. If the work area is too
      small for it, a raster replaces it, of the first size that fits.
   2. Otherwise rasters are drawn, each finer than the one before, until one is accepted or a finer
      one would be no better; if the plan has previews, limited clipping may come before each of
      them.
   3. If no raster is accepted, auto clips, as in 1. */
int lrcsi_attempts_next(const lrcsi_sigma *run, lrcsi_attempts *attempts)
{
    const lrcs_run_options *options = run->request.options;
    const lrcsi_plan *plan = &run->plan;
    const lrcsi_attempt last = attempts->current;
    const int drawn = last.method == LRCS_METHOD_ZBUFFER;
    if (last.method == LRCS_METHOD_EXACT && last.end == LRCSI_ATTEMPT_FOUND) {
        return 0;
    }
    if (last.end == LRCSI_ATTEMPT_NO_MEMORY && !lrcsi_attempt_is_limited(&last)) { /* 1 */
        attempts->current = attempt_raster(run, plan->size, NO_MEMORY_REASON);
        attempts->current.samples_only = 0;
        attempts->current.fallback = 1;
    } else if (last.end == LRCSI_ATTEMPT_NONE && plan->method == LRCS_METHOD_EXACT) {
        attempts->current = attempt_clipping(run, HUGE_VAL, plan->reason);
    } else if (drawn && raster_ends(run, last.samples_only)) { /* 3 */
        if (options->method != LRCS_METHOD_AUTO || last.fallback || run->meter.spent ||
            !(lrcsi_sigma_acceptance(run) & LRCS_FLAG_TOLERANCE_NOT_MET)) {
            return 0;
        }
        attempts->current =
            attempt_clipping(run, HUGE_VAL,
                             options->resolution != 0 ? "the requested raster misses the tolerance"
                                                      : "no raster's estimate meets the tolerance");
    } else if (plan->previews) { /* 2 */
        attempts->current = preview_next(run, attempts);
    } else {
        attempts->current = attempt_raster(run, drawn ? next_size(run) : plan->size, plan->reason);
    }
    return 1;
}

void lrcsi_attempts_end(lrcsi_sigma *run, lrcsi_attempts *attempts)
{
    lrcsi_attempt *attempt = &attempts->current;
    run->meter.taken = attempt->meter.taken;
    if (!lrcsi_attempt_is_limited(attempt)) {
        run->meter.spent = attempt->meter.spent;
    } else if (attempt->end == LRCSI_ATTEMPT_FOUND && lrcsi_attempt_is_over_limit(attempt)) {
        attempt->end = LRCSI_ATTEMPT_ABANDONED; /* while it integrated */
    }
    if (attempt->end != LRCSI_ATTEMPT_FOUND) {
        run->work->used = attempt->mark;
    }
}
