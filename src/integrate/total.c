/* SPDX-License-Identifier: MIT */
/* Computes the sum of Eq. 2 over visible areas, material by material, by compensated summation. A
   facet of area S at incidence theta whose visible projected area is a adds
       4 pi f_r cos(theta) a = 4 pi S f (a / (S cos(theta))),  f = f_r cos^2(theta).

   Nearly all facets are summed in blocks of LRCSI_LANES, in plain doubles (optics/shade.h). Facets
   near grazing incidence, in the bright lobe of a narrow glint, with curved normals, or on curved
   walls are added one by one (add_any_facet), with incidence in double-double (view/view.h). What
   each step adds to the bounds is stated beside it; at the end the bounds are increased by the
   fraction 1e-9 + 2 u per facet, for the rounding of their own sums. The steps of lrcsi_total_make:
   1. add_batch, for each material: select_facets selects the facets of its batch that face the
      laser (lrcsi_view_dot), keep_visible keeps those that are visible, and add_block evaluates
      blocks of them: normals and areas, lrcsi_shade, visible areas, sums, bounds;
   2. add_clear_shape, for each clear shape: lrcsi_shape_terms_make;
   3. add_tessellation_errors, if shapes are curved: lrcsi_tessellation_error;
   4. total_finish: conversion to square metres, and the rounding of the sums. */
#include "integrate/total.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/bits.h"
#include "base/constant.h"
#include "base/elementary.h"
#include "base/length.h"
#include "base/range.h"
#include "base/sum.h"
#include "integrate/patch.h"
#include "integrate/tessellation.h"
#include "optics/reflect.h"
#include "optics/shade.h"
#include "visibility/query.h"

/* The relative error of the area of a facet that is entirely visible and not near grazing: that of
   lrcsi_incidence.projected (8 u), and a product. */
#define AREA_ERROR (10 * LRCSI_U)

/* The remainders of all patches together are to be at most this fraction of the tolerance: small,
   so that bounds change little. */
#define REMAINDER_SHARE 0x1p-10

/* Running sums, scaled. */
typedef struct total_sums {
    lrcsi_sum glint, diffuse, projected, back_side;
    double visibility, rounding, curvature;
    double above, below; /* bounds on how far the true sigma is above, and below, the facets' sum */
    double error_estimate,
        bias; /* estimated errors: random (root of the sum of squares); systematic (sum) */
    uint32_t seen;
} total_sums;

/* What is given to lrcsi_total_make, and the sums so far. */
typedef struct total_run {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_visible *visible;     /* lrcsi_areas */
    const unsigned char *answer;      /* lrcsi_areas */
    const lrcsi_moment *moment;       /* lrcsi_areas */
    unsigned char *corrected;         /* lrcsi_areas */
    const lrcsi_curved *curved;       /* NULL: all normals are flat */
    const lrcsi_proximity_band *band; /* NULL: none was made */
    const lrcsi_clear *clear;         /* NULL: no shape is evaluated by its closed form */
    lrcs_facet_record *records;       /* NULL: none are asked for */
    double *part_error;               /* by part, scaled until the end; NULL: not asked for */
    int tessellation;  /* 1: facets replace curved shapes, and the error of that can be bounded */
    lrcsi_patch patch; /* of the last facet that has one */
    lrcsi_total total;
    total_sums sums;
} total_run;

/* --- the terms of one facet ------------------------------------------------------------------- */

/* The reflection at tan^2. If the plan forces the evaluation of a term of amplitude 0, it is
   evaluated at amplitude 1 and multiplied by 0; the glint is not evaluated if s = 0. */
static lrcsi_reflection reflection_planned(const lrcs_brdf *brdf, const lrcsi_plan *plan,
                                           double tan2)
{
    lrcsi_reflection at = lrcsi_reflect(brdf, tan2, 0);
    int glint = plan->glint == LRCSI_TERM_FORCED && brdf->A == 0 && brdf->s > 0;
    int diffuse = plan->diffuse == LRCSI_TERM_FORCED && brdf->B == 0;
    if (glint || diffuse) {
        const lrcs_brdf unit = {glint, diffuse, brdf->s, brdf->m};
        lrcsi_reflection forced = lrcsi_reflect(&unit, tan2, 0);
        at.glint += brdf->A * forced.glint;
        at.diffuse += brdf->B * forced.diffuse;
    }
    return at;
}

/* The largest value of the glint of amplitude 1, (1 + u)^2 exp(-u / s^2), over u >= 0. */
static double glint_peak(double s)
{
    double q = 2 * s * s;
    return q <= 1 ? 1 : q * q * lrcsi_exp(2 / q - 2);
}

/* A bound on the error of the glint where the relative error of tan^2 is too large for a linear
   approximation. Beyond the peak (at 2 s^2 - 1) the glint decreases, so the true and the computed
   value both lie between 0 and the glint at the lower bound of tan^2. */
static double glint_uncertainty(const lrcs_brdf *brdf, const lrcsi_incidence *incidence)
{
    double lower = incidence->tan2 * (1 - 2 * incidence->tan2_err);
    if (!(lower >= 2 * brdf->s * brdf->s)) {
        return brdf->A * glint_peak(brdf->s);
    }
    const lrcs_brdf alone = {brdf->A, 0, brdf->s, 0};
    lrcsi_reflection upper = lrcsi_reflect(&alone, lower, 0);
    return upper.glint + upper.error;
}

/* An upper bound of e^x - 1, for 0 <= x < 1. */
static double exp_minus_1_bound(double x)
{
    return x + x * x;
}

/* A bound on the error of f_r cos^2 from the error of tan^2. If u = tan^2 has the relative error r,
   the logarithm of the glint changes by at most r (2 min(u, 1) + u / s^2), and that of the diffuse
   term by at most r (m + 2)/2 min(u, 1). If these changes are not small, the terms themselves are
   bounded. Near edge-on r is infinite, and u is a lower bound; beyond the peak of the glint both
   terms decrease with u. */
static double reflection_uncertainty(const lrcs_brdf *brdf, const lrcsi_incidence *incidence,
                                     const lrcsi_reflection *at)
{
    if (isinf(incidence->tan2_err)) {
        double highest = (brdf->A > 0 ? brdf->A * glint_peak(brdf->s) : 0) + brdf->B;
        return incidence->tan2 >= 2 * brdf->s * brdf->s ? at->glint + at->diffuse : highest;
    }
    double u_or_1 = lrcsi_min(incidence->tan2, 1);
    double glint =
        brdf->A > 0 ? incidence->tan2_err * (2 * u_or_1 + incidence->tan2 / brdf->s / brdf->s) : 0;
    double diffuse = incidence->tan2_err * (0.5 * brdf->m + 1) * u_or_1;
    return (glint < 1 ? at->glint * exp_minus_1_bound(glint) : glint_uncertainty(brdf, incidence)) +
           (diffuse < 1 ? at->diffuse * exp_minus_1_bound(diffuse) : brdf->B);
}

/* The fraction part / whole; without a division for the many facets that are entirely visible. */
static double fraction_of(double part, double whole)
{
    return part == whole ? 1 : part / whole;
}

/* The reflectance is the mean over the facet's patch if it represents a part of a curved wall, else
   that of its normal. Rounding: S, 4 pi, two products and the fraction, 8 u; the relative error of
   areas; and the error of f_r cos^2, times the upper bound of the visible area. */
lrcsi_facet_terms lrcsi_facet_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t facet, const lrcsi_incidence *incidence,
                                         const lrcsi_visible *visible, lrcsi_patch *patch)
{
    const lrcs_prepared *p = view->prepared;
    lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, facet));
    lrcsi_reflection at;
    double uncertainty = 0;
    if (lrcsi_patch_make(view, plan, &brdf, facet, patch)) {
        at = (lrcsi_reflection){patch->glint, patch->diffuse, patch->rounding};
    } else {
        at = reflection_planned(&brdf, plan, incidence->tan2);
        uncertainty = reflection_uncertainty(&brdf, incidence, &at);
    }
    double four_pi_s = LRCS_FOUR_PI * 0.5 * p->normal[facet].length;
    double fraction = fraction_of(visible->area, incidence->projected);
    double fraction_high = fraction_of(visible->high, incidence->projected);
    lrcsi_facet_terms terms = {.glint = four_pi_s * at.glint * fraction,
                               .diffuse = four_pi_s * at.diffuse * fraction};
    terms.rounding = (terms.glint + terms.diffuse) * (incidence->error + 8 * LRCSI_U) +
                     four_pi_s * fraction_high * (at.error + uncertainty) +
                     (brdf.A > 0 || brdf.B > 0 ? LRCSI_FACET_UNDERFLOW : 0);
    terms.per_area = four_pi_s * (at.glint + at.diffuse) / incidence->projected;
    return terms;
}

/* --- what is visible of a facet --------------------------------------------------------------- */

/* Has the facet an answer, that it is entirely visible or entirely hidden? */
static inline int facet_answered(const total_run *run, uint32_t facet)
{
    return run->answer && run->answer[facet] != LRCSI_QUERY_UNDECIDED;
}

static lrcsi_visible facet_visible(const total_run *run, uint32_t facet,
                                   const lrcsi_incidence *incidence)
{
    if (facet_answered(run, facet)) {
        double area = run->answer[facet] == LRCSI_QUERY_VISIBLE ? incidence->projected : 0;
        return (lrcsi_visible){area, area, area, 0, 0};
    }
    if (run->visible) {
        return run->visible[facet];
    }
    return lrcsi_view_casts(run->view, facet)
               ? lrcsi_visible_unshadowed(incidence, run->plan->grazing_cos)
               : (lrcsi_visible){0, 0, 0, 0, 0};
}

/* The visible area of a facet that may be visible. Given: visible areas (not method facet). */
static inline double facet_area(const total_run *run, uint32_t facet)
{
    return facet_answered(run, facet) ? lrcsi_view_projected(run->view, facet)
                                      : run->visible[facet].area;
}

/* May some of a facet be visible? Given: visible areas (not method facet). */
static inline int area_may_be_visible(const total_run *run, uint32_t facet)
{
    return facet_answered(run, facet) ? run->answer[facet] == LRCSI_QUERY_VISIBLE
                                      : run->visible[facet].high > 0;
}

/* The same for any method. Given: the side that faces the laser, 1, or -1 for the back. A redundant
   facet is not visible; a facet that coincides with it is seen instead. */
static inline int side_may_be_visible(const total_run *run, uint32_t facet, int side)
{
    int limit = side > 0 ? LRCSI_REDUNDANT : LRCSI_REDUNDANT_FROM_BEHIND;
    return run->visible ? area_may_be_visible(run, facet)
                        : run->view->prepared->redundant[facet] < limit;
}

/* Is what a facet reflects part of a closed form? */
static int is_in_clear_shape(const total_run *run, uint32_t facet)
{
    return run->clear && run->clear->part[run->view->prepared->scene->facet_part[facet]];
}

/* Counts a facet that is hidden or partly visible. If the area of a clipped facet cannot be
   distinguished from 0, the facet counts as hidden; if not from the projected area, as visible. */
static void count_visible(lrcsi_total *total, double projected, const lrcsi_visible *visible)
{
    int below = visible->area < projected;
    int clipped = visible->error_estimate == 0 && visible->high - visible->low < projected;
    int partly = visible->area > 0 && below &&
                 !(clipped && (visible->low <= 0 || visible->high >= projected));
    total->partial += partly ? 1 : 0;
    total->hidden += visible->area == 0 || (below && visible->low <= 0 && !partly) ? 1 : 0;
}

/* --- facets one by one ------------------------------------------------------------------------ */

static void add_seen(total_sums *sums, const lrcs_brdf *brdf)
{
    sums->seen |= brdf->A > 0 ? 1u << LRCS_EFFECT_GLINT : 0u;
    sums->seen |= brdf->B > 0 ? 1u << LRCS_EFFECT_DIFFUSE : 0u;
}

/* Adds the errors due to an uncertain visible area. Given: sigma per unit of visible area. */
static void add_area_error(total_sums *sums, double per_area, const lrcsi_visible *visible)
{
    double area_err = lrcsi_max(visible->area - visible->low, visible->high - visible->area);
    sums->visibility += per_area * area_err;
    sums->error_estimate =
        lrcsi_length_flat(sums->error_estimate, per_area * visible->error_estimate);
    sums->bias += per_area * visible->bias;
}

static void record_sigma(const total_run *run, uint32_t facet, double glint, double diffuse)
{
    if (run->records) {
        const lrcs_prepared *p = run->view->prepared;
        run->records[facet].sigma_m2 = lrcsi_prepared_area(p, glint + diffuse);
        run->records[facet].sigma_glint_m2 = lrcsi_prepared_area(p, glint);
    }
}

/* Adds a facet that reflects towards the laser and may be visible:
   1. its incidence and visible area;
   2. with curved normals, the integral over them;
   3. otherwise 4 pi S f times the visible fraction, with the rounding error;
   4. the error of the visible area. */
static void add_reflecting_facet(total_run *run, uint32_t facet)
{
    total_sums *sums = &run->sums;
    lrcsi_incidence incidence = lrcsi_view_incidence(run->view, facet);
    lrcsi_visible visible = facet_visible(run, facet, &incidence);
    lrcs_brdf brdf =
        lrcsi_plan_brdf(run->plan, lrcsi_prepared_material(run->view->prepared, facet));
    add_seen(sums, &brdf);
    lrcsi_sum_add(&sums->projected, visible.area);
    count_visible(&run->total, incidence.projected, &visible);
    if (run->curved && lrcsi_curve_applies(run->view, facet)) {
        const lrcsi_curved *curved = &run->curved[facet];
        lrcsi_sum_add(&sums->glint, curved->glint);
        lrcsi_sum_add(&sums->diffuse, curved->diffuse);
        sums->visibility += curved->visibility;
        sums->rounding += curved->rounding + LRCSI_FACET_UNDERFLOW;
        sums->error_estimate = lrcsi_length_flat(sums->error_estimate, curved->error_estimate);
        sums->curvature += curved->estimate;
        record_sigma(run, facet, curved->glint, curved->diffuse);
        return;
    }
    lrcsi_facet_terms terms =
        lrcsi_facet_terms_make(run->view, run->plan, facet, &incidence, &visible, &run->patch);
    lrcsi_sum_add(&sums->glint, terms.glint);
    lrcsi_sum_add(&sums->diffuse, terms.diffuse);
    sums->rounding += terms.rounding;
    record_sigma(run, facet, terms.glint, terms.diffuse);
    if (visible.low < visible.high) {
        add_area_error(sums, terms.per_area, &visible);
    }
}

/* Counts a facet of a clear shape, of which nothing hides the front. Its sigma is part of the
   closed form; so is its projected area if the shape is solid. */
static void add_facet_of_clear_shape(total_run *run, uint32_t facet)
{
    const lrcs_prepared *p = run->view->prepared;
    int front = run->view->facing[facet] > 0;
    if (front && !p->scene->part[p->scene->facet_part[facet]].solid) {
        lrcsi_sum_add(&run->sums.projected, lrcsi_view_projected(run->view, facet));
    }
    run->total.hidden += front ? 0 : 1;
}

/* Adds a facet of any kind, by its exact facing. */
static void add_any_facet(total_run *run, uint32_t facet)
{
    int reflects = lrcsi_view_reflects(run->view, facet);
    int visible =
        run->view->facing[facet] != 0 &&
        (run->visible ? area_may_be_visible(run, facet) : lrcsi_view_casts(run->view, facet));
    if (reflects && is_in_clear_shape(run, facet)) {
        add_facet_of_clear_shape(run, facet);
    } else if (reflects && visible) {
        add_reflecting_facet(run, facet);
    } else if (reflects) {
        run->total.hidden++;
    } else if (visible) { /* a back side that does not reflect */
        double area =
            run->visible ? facet_area(run, facet) : lrcsi_view_projected(run->view, facet);
        lrcsi_sum_add(&run->sums.projected, area);
        lrcsi_sum_add(&run->sums.back_side, area);
        run->total.back_sides += area > 0 ? 1 : 0;
    }
}

/* Divides the error of a facet among the parts that cause it, in proportion to their reaches: its
   own part, and those whose shadows may end on the facet. */
static void add_part_errors(const total_run *run, uint32_t facet, double error)
{
    const lrcs_scene *scene = run->view->prepared->scene;
    const uint32_t own = scene->facet_part[facet];
    const lrcsi_part_set others = run->band ? run->band->parts[facet] : 0;
    const lrcsi_part_set set = others | lrcsi_part_set_of(own);
    double reach = 0;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        reach += (set & lrcsi_part_set_of(i)) != 0 ? scene->part[i].reach : 0;
    }
    for (uint32_t i = 0; reach > 0 && i < scene->part_count; i++) {
        run->part_error[i] +=
            (set & lrcsi_part_set_of(i)) != 0 ? error * (scene->part[i].reach / reach) : 0;
    }
}

/* Adds what a facet's sigma is corrected by, because F varies over its patch. Its rounding error is
   part of the tessellation error. */
static void add_correction(total_run *run, uint32_t facet, double glint, double diffuse)
{
    lrcsi_sum_add(&run->sums.glint, LRCS_FOUR_PI * glint);
    lrcsi_sum_add(&run->sums.diffuse, LRCS_FOUR_PI * diffuse);
    run->corrected[facet] = 1;
    if (run->records) {
        const lrcs_prepared *p = run->view->prepared;
        run->records[facet].sigma_m2 += lrcsi_prepared_area(p, LRCS_FOUR_PI * (glint + diffuse));
        run->records[facet].sigma_glint_m2 += lrcsi_prepared_area(p, LRCS_FOUR_PI * glint);
    }
}

/* Adds the tessellation error of a facet: the error of replacing curved shapes by facets, and the
   correction that goes with it. A facet with curved normals adds only the effect of differences in
   visibility within the proximity band; clear shapes have no such error. */
static void add_tessellation_error(total_run *run, uint32_t facet, const lrcsi_incidence *incidence)
{
    if (is_in_clear_shape(run, facet)) {
        return;
    }
    if (!run->curved || !lrcsi_curve_applies(run->view, facet)) {
        lrcsi_tessellation error =
            lrcsi_tessellation_error(run->view, run->plan, facet, incidence, run->visible,
                                     run->moment, run->band, &run->patch);
        if (error.corrected) {
            add_correction(run, facet, error.glint, error.diffuse);
        }
        run->sums.above += LRCS_FOUR_PI * error.above;
        run->sums.below += LRCS_FOUR_PI * error.below;
        if (run->part_error && error.above + error.below > 0) {
            add_part_errors(run, facet, LRCS_FOUR_PI * fmax(error.above, error.below));
        }
    } else if (run->band) {
        run->sums.above += run->band->gain[facet] * run->curved[facet].upper_bound;
        run->sums.below += run->band->loss[facet] * run->curved[facet].upper_bound;
    }
}

/* --- facets in blocks ------------------------------------------------------------------------- */

/* The facets of one material. Those that can be evaluated in blocks are collected until there are
   enough for one block. */
typedef struct total_batch {
    lrcsi_lobes lobes;
    int back_reflects;                 /* back sides reflect */
    int back_visible;                  /* back sides may be visible */
    int seen;                          /* a facet that reflects may be visible */
    uint32_t waiting;                  /* facets collected for the next block */
    uint32_t element[2 * LRCSI_LANES]; /* their indices in prepared->batches */
    signed char side[2 * LRCSI_LANES]; /* 1 or, if back sides reflect, -1 for those */
    lrcsi_shades shades;
    double area[LRCSI_LANES]; /* S, then S cos(theta), then the visible part of that */
    double high[LRCSI_LANES]; /* upper bounds of the visible areas, where areas were found */
    lrcsi_sum_lanes glint, diffuse, projected, back_side;
    double error[LRCSI_SUM_LANES];
} total_batch;

/* Fills the block with the unit normals, on the side towards the laser, and the areas of the first
   `count` facets collected. Unused lanes get the direction to the laser as their normal, and area
   0. */
static void block_gather(const total_run *run, total_batch *batch, uint32_t count)
{
    const lrcsi_view *view = run->view;
    const lrcsi_batches *b = &view->prepared->batches;
    const double *x = b->normal[0];
    const double *y = b->normal[1];
    const double *z = b->normal[2];
    const double *area = b->area;
    lrcsi_shades *shades = &batch->shades;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t at = batch->element[i];
        shades->normal[0][i] = x[at];
        shades->normal[1][i] = y[at];
        shades->normal[2][i] = z[at];
        batch->area[i] = area[at];
    }
    for (uint32_t i = 0; batch->back_reflects && i < count; i++) {
        shades->normal[0][i] *= batch->side[i];
        shades->normal[1][i] *= batch->side[i];
        shades->normal[2][i] *= batch->side[i];
    }
    for (uint32_t i = count; i < LRCSI_LANES; i++) {
        for (int k = 0; k < 3; k++) {
            shades->normal[k][i] = view->unit[k];
        }
        batch->area[i] = 0;
    }
}

/* Replaces S cos(theta) by the visible areas of facets that have no answer, and adds the errors due
   to these areas. */
static void block_visible(total_run *run, total_batch *batch, uint32_t count)
{
    const lrcsi_shades *shades = &batch->shades;
    memcpy(batch->high, batch->area, sizeof batch->high);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t facet = run->view->prepared->batches.facet[batch->element[i]];
        if (facet_answered(run, facet)) {
            continue;
        }
        const lrcsi_visible *visible = &run->visible[facet];
        batch->area[i] = visible->area;
        batch->high[i] = lrcsi_max(visible->high, visible->area);
        if (visible->low < visible->high) {
            add_area_error(&run->sums, shades->glint[i] + shades->diffuse[i], visible);
            count_visible(&run->total, lrcsi_view_projected(run->view, facet), visible);
        }
    }
}

/* Adds one block by Eq. 2, the first LRCSI_LANES facets collected:
   1. gathers their normals and areas S;
   2. computes 4 pi f_r cos(theta), with errors;
   3. computes projected areas S cos(theta), and replaces them by visible areas. With method facet,
      facets may be hidden unless cos(theta) is proved to exceed the plan's grazing threshold;
   4. adds the products of 2 and 3 to the sums;
   5. fills records. */
static void add_block(total_run *run, total_batch *batch)
{
    const lrcsi_view *view = run->view;
    const double threshold = run->plan->grazing_cos;
    const double *high = run->visible ? batch->high : batch->area;
    lrcsi_shades *shades = &batch->shades;
    uint32_t count = batch->waiting < LRCSI_LANES ? batch->waiting : LRCSI_LANES;
    double glint[LRCSI_LANES];
    double diffuse[LRCSI_LANES];
    double error[LRCSI_LANES];
    block_gather(run, batch, count);
    lrcsi_shade(&batch->lobes, view->unit, view->unit_low, shades);
    for (int i = 0; i < LRCSI_LANES; i++) {
        batch->area[i] *= shades->cosine[i];
    }
    if (run->visible) {
        block_visible(run, batch, count);
    } else if (threshold > 0 && threshold < 1) {
        for (uint32_t i = 0; i < count; i++) {
            double per_area = shades->glint[i] + shades->diffuse[i];
            int proved = shades->cosine[i] > threshold + 0x1p-40;
            run->sums.visibility += proved ? 0 : per_area * batch->area[i];
        }
    }
    for (int i = 0; i < LRCSI_LANES; i++) {
        glint[i] = shades->glint[i] * batch->area[i];
        diffuse[i] = shades->diffuse[i] * batch->area[i];
        error[i] = shades->error[i] * high[i];
    }
    lrcsi_sum_lanes_add(&batch->glint, glint);
    lrcsi_sum_lanes_add(&batch->diffuse, diffuse);
    lrcsi_sum_lanes_add(&batch->projected, batch->area);
    lrcsi_lanes_add(batch->error, error);
    for (uint32_t i = 0; run->records && i < count; i++) {
        record_sigma(run, view->prepared->batches.facet[batch->element[i]], glint[i], diffuse[i]);
    }
    if (batch->lobes.A > 0 || batch->lobes.B > 0) {
        run->sums.rounding += count * LRCSI_FACET_UNDERFLOW;
    }
    batch->waiting -= count;
    memmove(batch->element, batch->element + LRCSI_LANES, sizeof batch->element / 2);
    memmove(batch->side, batch->side + LRCSI_LANES, sizeof batch->side / 2);
}

/* Given the indices in the batches of facets that reflect, keeps those that are evaluated in
   blocks, and returns their number. Facets of clear shapes and facets with curved normals are added
   here; hidden ones are counted. */
static uint32_t keep_visible(total_run *run, uint32_t *list, uint32_t count, int side)
{
    const uint32_t *facet = run->view->prepared->batches.facet;
    uint32_t left = count;
    if (run->clear) {
        left = 0;
        for (uint32_t k = 0; k < count; k++) {
            if (is_in_clear_shape(run, facet[list[k]])) {
                add_facet_of_clear_shape(run, facet[list[k]]);
            } else {
                list[left++] = list[k];
            }
        }
    }
    count = left;
    left = 0;
    for (uint32_t k = 0; k < count; k++) { /* without branches */
        uint32_t at = list[k];
        list[left] = at;
        left += (uint32_t)side_may_be_visible(run, facet[at], side);
    }
    run->total.hidden += count - left;
    if (run->curved) {
        count = left;
        left = 0;
        for (uint32_t k = 0; k < count; k++) {
            if (lrcsi_curve_applies(run->view, facet[list[k]])) {
                add_reflecting_facet(run, facet[list[k]]);
            } else {
                list[left++] = list[k];
            }
        }
    }
    return left;
}

/* Collects the selected facets among the LRCSI_LANES from index `start` on, and adds the block once
   it is full. The facets reflect from the side that faces the laser: 1, or -1 for their back. */
static void batch_collect(total_run *run, total_batch *batch, uint32_t start,
                          const uint64_t pick[LRCSI_LANES], int side)
{
    uint32_t *list = batch->element + batch->waiting;
    uint32_t count = 0;
    for (uint32_t i = 0; i < LRCSI_LANES; i++) { /* without branches: facings follow no pattern */
        list[count] = start + i;
        count += (uint32_t)(pick[i] >> 63);
    }
    if (run->visible || run->clear || run->view->prepared->batches.redundant) {
        count = keep_visible(run, list, count, side);
    }
    for (uint32_t i = 0; batch->back_reflects && i < count; i++) {
        batch->side[batch->waiting + i] = (signed char)side;
    }
    batch->waiting += count;
    batch->seen |= count > 0;
    if (batch->waiting >= LRCSI_LANES) {
        add_block(run, batch);
    }
}

/* The cosine of the incidence of an element of the batches. */
static inline double element_dot(const lrcsi_batches *b, uint32_t at, const double d[3])
{
    return lrcsi_view_dot(b->normal[0][at], b->normal[1][at], b->normal[2][at], d);
}

/* Adds the visible areas of the selected back sides, which do not reflect. */
static void add_back_areas(total_run *run, total_batch *batch, uint32_t start,
                           const uint64_t pick[LRCSI_LANES])
{
    const lrcsi_batches *b = &run->view->prepared->batches;
    const double *d = run->view->unit;
    double area[LRCSI_LANES] = {0}; /* projected */
    uint32_t count = 0;
    if (run->visible || b->redundant) {
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            if (pick[i] >> 63) {
                uint32_t facet = b->facet[start + i];
                if (side_may_be_visible(run, facet, -1)) {
                    area[count] = run->visible ? facet_area(run, facet)
                                               : -element_dot(b, start + i, d) * b->area[start + i];
                }
                run->total.back_sides += area[count++] > 0;
            }
        }
    } else {
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            uint32_t at = start + i;
            area[i] =
                lrcsi_bits_masked(-element_dot(b, at, d) * b->area[at], ~((pick[i] >> 63) - 1));
            count += (uint32_t)(pick[i] >> 63);
        }
        run->total.back_sides += count;
    }
    lrcsi_sum_lanes_add(&batch->back_side, area);
}

/* Which of LRCSI_LANES facets are evaluated in blocks, as sign bits: those whose front faces the
   laser, and those whose back does. */
typedef struct total_selection {
    uint64_t front[LRCSI_LANES], back[LRCSI_LANES];
    uint64_t any_front, any_back, any_other; /* sign bit: 1 if there is one */
} total_selection;

/* Selects among the facets from index `start` on, without branches: the comparison a < b is the
   sign bit of a - b. */
static void select_facets(const total_run *run, const total_batch *batch, uint32_t start,
                          uint32_t count, total_selection *restrict pick)
{
    const lrcsi_batches *b = &run->view->prepared->batches;
    const double *x = b->normal[0] + start;
    const double *y = b->normal[1] + start;
    const double *z = b->normal[2] + start;
    const double d[3] = {run->view->unit[0], run->view->unit[1], run->view->unit[2]};
    const double low = batch->lobes.low;
    const double high = batch->lobes.high;
    const double back_high = batch->back_reflects ? high : 2;
    uint64_t fronts = 0;
    uint64_t backs = 0;
    uint64_t others = 0;
    for (int i = 0; i < LRCSI_LANES; i++) {
        double dot = lrcsi_view_dot(x[i], y[i], z[i], d);
        uint64_t front = lrcsi_bits_of(low - dot) & lrcsi_bits_of(dot - high);
        uint64_t back = lrcsi_bits_of(low + dot) & lrcsi_bits_of(-back_high - dot);
        pick->front[i] = front;
        pick->back[i] = back;
        fronts |= front;
        backs |= back;
        others |= ~(front | back);
    }
    for (uint32_t i = count; i < LRCSI_LANES; i++) { /* of other materials */
        pick->front[i] = pick->back[i] = 0;
    }
    pick->any_front = fronts;
    pick->any_back = backs;
    pick->any_other = others;
}

/* Adds up to LRCSI_LANES facets from index `start` on:
   1. selects those that are evaluated in blocks, except facets that represent patches of curved
      walls;
   2. collects front sides for a block;
   3. collects back sides too if they reflect; otherwise adds their areas;
   4. adds the others one by one: facets near grazing incidence or in the bright lobe of a narrow
      glint, and those of curved walls. */
static void add_lanes(total_run *run, total_batch *batch, uint32_t start, uint32_t count)
{
    const uint32_t *facet = run->view->prepared->batches.facet + start;
    total_selection pick;
    select_facets(run, batch, start, count, &pick);
    for (uint32_t i = 0; run->plan->patches && i < count; i++) {
        if (lrcsi_patch_exists(run->view->prepared, facet[i])) {
            pick.front[i] = pick.back[i] = 0;
            pick.any_other = UINT64_MAX;
        }
    }
    if (pick.any_front >> 63) {
        batch_collect(run, batch, start, pick.front, 1);
    }
    int back = (int)(pick.any_back >> 63);
    if (back && batch->back_reflects) { /* then they cast shadows, and may be visible */
        batch_collect(run, batch, start, pick.back, -1);
    } else if (back && batch->back_visible) {
        add_back_areas(run, batch, start, pick.back);
    }
    for (uint32_t i = 0; pick.any_other >> 63 && i < count; i++) {
        if (!((pick.front[i] | pick.back[i]) >> 63)) {
            add_any_facet(run, facet[i]);
            if (run->tessellation &&
                lrcsi_patch_exists(run->view->prepared, facet[i])) { /* run->patch is its patch */
                lrcsi_incidence incidence = lrcsi_view_incidence(run->view, facet[i]);
                add_tessellation_error(run, facet[i], &incidence);
            }
        }
    }
}

static int is_evaluated(int term, double amplitude)
{
    return amplitude > 0 || term == LRCSI_TERM_FORCED;
}

/* Adds all facets of a material, in their order:
   1. the facets, in blocks or one by one;
   2. the last block, which may not be full;
   3. the sums and the errors of the blocks. With method facet and a grazing threshold of 1, nothing
      is known about what is hidden, and all of the material may be. */
static void add_batch(total_run *run, uint32_t material)
{
    const lrcsi_view *view = run->view;
    const lrcs_material *m = &view->prepared->scene->material[material];
    lrcs_brdf brdf = lrcsi_plan_brdf(run->plan, m);
    total_batch batch = {
        .lobes = lrcsi_lobes_make(&brdf, brdf.s > 0 && is_evaluated(run->plan->glint, brdf.A),
                                  is_evaluated(run->plan->diffuse, brdf.B)),
        .back_reflects = view->backs.reflect && m->two_sided,
        .back_visible = view->backs.cast || run->visible};
    const uint32_t *first = view->prepared->batches.first + material;
    for (uint32_t start = first[0]; start < first[1]; start += LRCSI_LANES) {
        uint32_t left = first[1] - start;
        add_lanes(run, &batch, start, left < LRCSI_LANES ? left : LRCSI_LANES);
    }
    if (batch.waiting > 0) {
        add_block(run, &batch);
    }
    total_sums *sums = &run->sums;
    lrcsi_sum both = {0, 0};
    lrcsi_sum_lanes_join(&both, &batch.glint);
    lrcsi_sum_lanes_join(&both, &batch.diffuse);
    lrcsi_sum_lanes_join(&sums->glint, &batch.glint);
    lrcsi_sum_lanes_join(&sums->diffuse, &batch.diffuse);
    lrcsi_sum_lanes_join(&sums->projected, &batch.projected);
    lrcsi_sum_lanes_join(&sums->projected, &batch.back_side);
    lrcsi_sum_lanes_join(&sums->back_side, &batch.back_side);
    for (int k = 0; k < LRCSI_SUM_LANES; k++) {
        sums->rounding += batch.error[k] * LRCSI_SHADE_UNIT;
    }
    sums->rounding += run->visible ? lrcsi_sum_value(&both) * AREA_ERROR : 0;
    sums->visibility += !run->visible && run->plan->grazing_cos >= 1 ? lrcsi_sum_value(&both) : 0;
    if (batch.seen) {
        add_seen(sums, &brdf);
    }
}

/* --- curved shapes ---------------------------------------------------------------------------- */

/* Adds the tessellation errors of all facets except those that represent patches: add_lanes has
   added theirs. */
static void add_tessellation_errors(total_run *run)
{
    const lrcsi_batches *b = &run->view->prepared->batches;
    for (uint32_t start = 0; start < b->count; start += LRCSI_INCIDENCES) {
        lrcsi_incidence incidence[LRCSI_INCIDENCES];
        uint32_t left = b->count - start;
        uint32_t count = left < LRCSI_INCIDENCES ? left : LRCSI_INCIDENCES;
        lrcsi_view_incidences(run->view, b->facet + start, count, incidence);
        for (uint32_t i = 0; i < count; i++) {
            if (!lrcsi_patch_exists(run->view->prepared, b->facet[start + i])) {
                add_tessellation_error(run, b->facet[start + i], &incidence[i]);
            }
        }
    }
}

/* The BRDF with a glint as wide as that of a facet of a curved wall: neighbouring facets differ by
   up to its turn. */
static lrcs_brdf brdf_widened(const lrcs_brdf *brdf, double turn)
{
    lrcs_brdf wide = *brdf;
    double square = brdf->s * brdf->s + turn * turn;
    if (brdf->A > 0 && square > 0) {
        wide.A = brdf->A * (brdf->s * brdf->s / square);
        wide.s = sqrt(square);
    }
    return wide;
}

/* The remainder that can be neglected in the mean over a patch: REMAINDER_SHARE of the tolerance,
   divided among the patches by area. Where the glint is dim, or reaches only one end of a patch,
   this saves most of the work. Sigma is estimated from the normals of facets. This is a choice
   without a proof: the remainders are part of the bound, whatever they are. */
static double negligible_remainder(const total_run *run)
{
    const lrcs_prepared *p = run->view->prepared;
    const lrcsi_batches *b = &p->batches;
    double sum = 0;   /* sigma / 4 pi */
    double areas = 0; /* of facets with patches */
    for (uint32_t at = 0; at < b->count; at++) {
        uint32_t facet = b->facet[at];
        double cosine = fabs(element_dot(b, at, run->view->unit));
        if (!lrcsi_view_reflects(run->view, facet) || !(cosine > 0) ||
            (run->visible && !area_may_be_visible(run, facet))) {
            continue;
        }
        const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
        int has_patch = lrcsi_patch_exists(p, facet);
        lrcs_brdf brdf = lrcsi_plan_brdf(run->plan, lrcsi_prepared_material(p, facet));
        brdf = brdf_widened(&brdf, has_patch ? part->curvature.turn : 0);
        lrcsi_reflection f =
            lrcsi_reflect(&brdf, (1 - cosine) * (1 + cosine) / (cosine * cosine), 0);
        double visible = run->visible ? facet_area(run, facet) : b->area[at] * cosine;
        sum += (f.glint + f.diffuse) * (visible / cosine);
        areas += has_patch ? b->area[at] : 0;
    }
    return areas > 0 && isfinite(sum) ? REMAINDER_SHARE * run->plan->tolerance * sum / areas : 0;
}

/* Divides the sigma of a clear part among its facets that face the laser: each of its terms in
   proportion to that of the flat facets or, if they have none, to the projected areas. */
static void record_shape(const total_run *run, const lrcs_part *part,
                         const lrcsi_shape_terms *terms)
{
    lrcs_facet_record *records = run->records;
    lrcsi_shape_terms flat = {0, 0, 0, 0, 0};
    lrcsi_patch patch = {.negligible = run->patch.negligible};
    uint32_t end = part->first_facet + part->facet_count;
    for (uint32_t f = part->first_facet; f < end; f++) {
        lrcsi_incidence incidence = lrcsi_view_incidence(run->view, f);
        lrcsi_visible whole = {incidence.projected, incidence.projected, incidence.projected, 0, 0};
        if (run->view->facing[f] > 0) {
            lrcsi_facet_terms facet =
                lrcsi_facet_terms_make(run->view, run->plan, f, &incidence, &whole, &patch);
            records[f].sigma_glint_m2 = facet.glint; /* scaled, until the second loop */
            records[f].sigma_m2 = facet.diffuse;
            flat.glint += facet.glint;
            flat.diffuse += facet.diffuse;
            flat.silhouette += incidence.projected;
        }
    }
    for (uint32_t f = part->first_facet; f < end; f++) {
        if (run->view->facing[f] > 0) {
            double by_area = lrcsi_view_projected(run->view, f) / flat.silhouette;
            double glint = flat.glint > 0 ? records[f].sigma_glint_m2 / flat.glint : by_area;
            double diffuse = flat.diffuse > 0 ? records[f].sigma_m2 / flat.diffuse : by_area;
            record_sigma(run, f, glint * terms->glint, diffuse * terms->diffuse);
        }
    }
}

/* Adds a clear shape. total_finish bounds the rounding of the compensated sums. */
static void add_clear_shape(total_run *run, uint32_t index, double slab)
{
    const lrcs_prepared *p = run->view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    lrcsi_shape_terms terms = lrcsi_shape_terms_make(run->view, run->plan, index, slab);
    lrcs_brdf brdf = lrcsi_plan_brdf(run->plan, lrcsi_prepared_material(p, part->first_facet));
    lrcsi_sum_add(&run->sums.glint, terms.glint);
    lrcsi_sum_add(&run->sums.diffuse, terms.diffuse);
    lrcsi_sum_add(&run->sums.projected, part->solid ? terms.silhouette : 0);
    run->sums.rounding += terms.rounding;
    run->sums.visibility += terms.visibility;
    if (terms.silhouette > 0) {
        add_seen(&run->sums, &brdf);
    }
    if (run->records) {
        record_shape(run, part, &terms);
    }
}

/* --- the total -------------------------------------------------------------------------------- */

/* Fills the records, except for sigma. */
static void records_start(const total_run *run)
{
    const lrcs_prepared *p = run->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        run->records[f] = (lrcs_facet_record){0, 0, 0, 0, 0};
        if (!p->skip[f]) {
            lrcsi_incidence incidence = lrcsi_view_incidence(run->view, f);
            lrcsi_visible visible = facet_visible(run, f, &incidence);
            run->records[f].area_m2 = lrcsi_prepared_area(p, 0.5 * p->normal[f].length);
            run->records[f].cos_theta = incidence.cos_theta;
            run->records[f].visible_area_m2 = lrcsi_prepared_area(p, visible.area);
        }
    }
}

/* If the result is denormal, the conversion may round by up to 2^-1075, and so may the conversions
   of the values to which the bound applies, at most two: 2^-1073 covers all of them. */
double lrcsi_bound_area(const lrcs_prepared *p, double scaled)
{
    double area = lrcsi_prepared_area(p, scaled);
    return scaled > 0 && area < DBL_MIN ? area + 0x1p-1073 : area;
}

/* Converts the sums to square metres. The error of the compensated sums is part of rounding. */
static void total_finish(total_run *run)
{
    const lrcs_prepared *p = run->view->prepared;
    const total_sums *sums = &run->sums;
    lrcsi_total *total = &run->total;
    double glint = lrcsi_sum_value(&sums->glint);
    double diffuse = lrcsi_sum_value(&sums->diffuse);
    double count = p->scene->facet_count;
    double outward = 1 + 1e-9 + 2 * count * LRCSI_U;
    total->glint = lrcsi_prepared_area(p, glint);
    total->diffuse = lrcsi_prepared_area(p, diffuse);
    total->projected = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->projected));
    total->back_side = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->back_side));
    total->visibility = lrcsi_bound_area(p, sums->visibility * outward);
    double either = isfinite(sums->above + sums->below) ? fmax(sums->above, sums->below) : HUGE_VAL;
    total->tessellation = lrcsi_bound_area(p, either * outward);
    double adding = (glint + diffuse) * (4 * LRCSI_U + 3 * (count * LRCSI_U) * (count * LRCSI_U));
    total->rounding = lrcsi_bound_area(p, (sums->rounding + adding) * outward);
    double estimate = lrcsi_length_flat(sums->error_estimate, sums->bias);
    total->error_estimate = fmin(lrcsi_prepared_area(p, estimate), total->visibility);
    total->curvature = lrcsi_prepared_area(p, sums->curvature);
    total->seen = sums->seen;
}

lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_areas *areas, const lrcsi_curved *curved,
                             const lrcsi_proximity_band *band, const lrcsi_clear *clear,
                             lrcs_facet_record *records, double *part_error)
{
    const lrcs_prepared *p = view->prepared;
    total_run run = {.view = view,
                     .plan = plan,
                     .visible = areas->visible,
                     .answer = areas->answer,
                     .moment = areas->moment,
                     .corrected = areas->corrected,
                     .curved = curved,
                     .band = band,
                     .clear = clear->count > 0 ? clear : NULL,
                     .records = records,
                     .part_error = part_error};
    for (uint32_t i = 0; part_error && i < p->scene->part_count; i++) {
        part_error[i] = 0;
    }
    if (areas->moment) {
        memset(areas->corrected, 0, p->scene->facet_count);
    }
    if (plan->patches) {
        run.patch.negligible = negligible_remainder(&run);
    }
    if (records) {
        records_start(&run);
    }
    int replaced = plan->method != LRCS_METHOD_CLOSED && p->curved;
    run.tessellation = replaced && lrcsi_tessellation_known(p, plan);
    for (uint32_t i = 0; i < p->scene->material_count; i++) {
        add_batch(&run, i);
    }
    for (uint32_t i = 0; run.clear && i < p->scene->part_count; i++) {
        if (run.clear->part[i]) {
            add_clear_shape(&run, i, run.clear->slab[i]);
        }
    }
    if (run.tessellation) {
        add_tessellation_errors(&run);
    }
    total_finish(&run);
    for (uint32_t i = 0; part_error && i < p->scene->part_count; i++) {
        part_error[i] = lrcsi_prepared_area(p, part_error[i]);
    }
    if (replaced && !run.tessellation) {
        run.total.tessellation = -1;
    }
    return run.total;
}
