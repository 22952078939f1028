/* SPDX-License-Identifier: MIT */
/* Computes the sum of Eq. 2 over visible areas, material by material, by compensated summation. A
   facet of area S at incidence theta whose visible projected area is a adds
       4 pi f_r cos(theta) a = 4 pi S f (a / (S cos(theta))),  f = f_r cos^2(theta).

   What each step adds to the bounds is stated beside it; at the end the bounds are increased by the
   fraction 1e-9 + 2 u per facet, for their own rounding: 2 u per facet for the sums, and far more
   than the few operations on each term need. The steps of lrcsi_total_make:
   1. records_start, if records are asked for: all of them except sigma;
   2. lrcsi_total_add_material, for each material: nearly all facets are summed in packets, in plain
      doubles (total_packet.c), the others one by one (total_facet.c);
   3. add_clear_shape, for each clear shape: lrcsi_shape_terms_make;
   4. add_tessellation_errors, if there are curved shapes: lrcsi_tessellation_error;
   5. total_finish: conversion to square metres, and the rounding of the sums. */
#include "integrate/sum/total.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/outward.h"
#include "integrate/sum/facet_terms.h"
#include "integrate/wall/tessellation.h"
#include "optics/reflect.h"

/* --- curved shapes ---------------------------------------------------------------------------- */

/* Adds the tessellation errors of all facets except those that represent patches: add_lanes has
   added theirs. */
static void add_tessellation_errors(lrcsi_total_run *run)
{
    const lrcsi_batches *b = &run->view->prepared->batches;
    for (uint32_t start = 0; start < b->count; start += LRCSI_INCIDENCES) {
        lrcsi_incidence incidence[LRCSI_INCIDENCES];
        uint32_t left = b->count - start;
        uint32_t count = left < LRCSI_INCIDENCES ? left : LRCSI_INCIDENCES;
        lrcsi_view_incidences(run->view, b->facet + start, count, incidence);
        for (uint32_t i = 0; i < count; i++) {
            if (!lrcsi_patch_exists(run->view->prepared, b->facet[start + i])) {
                lrcsi_total_add_tessellation(run, b->facet[start + i], &incidence[i]);
            }
        }
    }
}

/* The accuracy of the shares in which facets divide the sigma of a clear part. */
#define SHARE_TOLERANCE 1e-3

/* Divides the sigma of a clear part among its facets that face the laser: each of its terms in
   proportion to that of the facets or, if they have none, to the projected areas. */
static void record_shape(lrcsi_total_run *run, const lrcs_part *part,
                         const lrcsi_shape_terms *terms)
{
    lrcsi_shape_terms flat = {0, 0, 0, 0, 0};
    lrcsi_patches patches = {.derivatives = 0};
    lrcsi_plan plan = *run->plan;
    uint32_t end = part->first_facet + part->facet_count;
    plan.tolerance = fmax(plan.tolerance, SHARE_TOLERANCE);
    for (int adding = 1; adding >= 0; adding--) { /* first the sums, then the shares of each */
        for (uint32_t f = part->first_facet; f < end; f++) {
            if (run->view->facing[f] <= 0) {
                continue;
            }
            lrcsi_incidence incidence = lrcsi_view_incidence(run->view, f);
            double area = incidence.projected;
            lrcsi_visible_area whole = lrcsi_visible_area_exact(area);
            lrcsi_facet_terms facet =
                lrcsi_facet_terms_make(run->view, &plan, f, &incidence, &whole, &patches);
            if (adding) {
                flat.glint += facet.glint;
                flat.diffuse += facet.diffuse;
                flat.silhouette += area;
            } else {
                double by_area = area / flat.silhouette;
                double glint = flat.glint > 0 ? facet.glint / flat.glint : by_area;
                double diffuse = flat.diffuse > 0 ? facet.diffuse / flat.diffuse : by_area;
                lrcsi_total_record(run, f, glint * terms->glint, diffuse * terms->diffuse);
            }
        }
    }
}

/* Adds a clear shape. total_finish bounds the rounding of the compensated sums. */
static void add_clear_shape(lrcsi_total_run *run, uint32_t index, double slab)
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
        lrcsi_total_note_terms(&run->sums, &brdf);
    }
    if (run->details.records) {
        record_shape(run, part, &terms);
    }
}

/* --- the total -------------------------------------------------------------------------------- */

/* Fills the records, except for sigma. */
static void records_start(lrcsi_total_run *run)
{
    const lrcs_prepared *p = run->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        run->details.records[f] = (lrcs_facet_record){0, 0, 0, 0, 0};
        if (!p->skip[f]) {
            lrcsi_incidence incidence = lrcsi_view_incidence(run->view, f);
            lrcsi_visible_area visible =
                lrcsi_areas_of(run->areas, run->view, run->plan, f, &incidence);
            run->details.records[f].area_m2 = lrcsi_prepared_area(p, 0.5 * p->normal[f].length);
            run->details.records[f].cos_theta = incidence.cos_theta;
            run->details.records[f].visible_area_m2 = lrcsi_prepared_area(p, visible.area);
        }
    }
}

/* Converts the sums to square metres. The error of the compensated sums is part of rounding. */
static void total_finish(lrcsi_total_run *run)
{
    const lrcs_prepared *p = run->view->prepared;
    const lrcsi_total_sums *sums = &run->sums;
    lrcsi_total *total = &run->total;
    double glint = lrcsi_sum_value(&sums->glint);
    double diffuse = lrcsi_sum_value(&sums->diffuse);
    double count = p->scene->facet_count;
    double outward = LRCSI_OUTWARD_NANO + 2 * count * LRCSI_U;
    total->glint = lrcsi_prepared_area(p, glint);
    total->diffuse = lrcsi_prepared_area(p, diffuse);
    total->projected = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->projected));
    total->back_side = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->back_side));
    total->visibility = lrcsi_prepared_bound(p, sums->visibility * outward);
    double either = isfinite(sums->above + sums->below) ? fmax(sums->above, sums->below) : HUGE_VAL;
    total->tessellation = lrcsi_prepared_bound(p, either * outward);
    /* Corrections and the terms of round walls may be negative: each has a rounding bound of at
       least u times its size, more than the compensated sums lose by it. */
    double terms = 3 * count; /* at most, of each sum: a facet, its margin and its correction */
    double adding = (glint + diffuse) * (4 * LRCSI_U + 3 * (terms * LRCSI_U) * (terms * LRCSI_U));
    total->rounding = lrcsi_prepared_bound(p, (sums->rounding + adding) * outward);
    double estimate = lrcsi_length_flat(sums->error_estimate, sums->bias);
    total->error_estimate = fmin(lrcsi_prepared_area(p, estimate), total->visibility);
    total->cubature_estimate = lrcsi_prepared_area(p, sums->cubature_estimate);
    total->seen = sums->seen;
}

lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_areas *areas, const lrcsi_curve_terms *curve_terms,
                             const lrcsi_masked_band *band, const lrcsi_clear_shapes *clear,
                             lrcsi_total_details *details)
{
    const lrcs_prepared *p = view->prepared;
    double *part_error = details->part_error;
    lrcsi_total_run run = {.view = view,
                           .plan = plan,
                           .areas = areas,
                           .curve_terms = curve_terms,
                           .band = band,
                           .clear = clear,
                           .details = *details};
    for (uint32_t i = 0; part_error && i < p->scene->part_count; i++) {
        part_error[i] = 0;
        run.shared_reach += i < LRCSI_PART_SET_SINGLE ? 0 : p->scene->part[i].bounds.reach;
    }
    if (areas->moment) {
        memset(details->corrected, 0, p->scene->facet_count * sizeof *details->corrected);
    }
    if (details->records) { /* 1 */
        records_start(&run);
    }
    int replaced = plan->method != LRCS_METHOD_CLOSED && p->has_curved_shapes;
    run.bounds_tessellation = replaced && lrcsi_tessellation_known(p, plan);
    for (uint32_t i = 0; i < p->scene->material_count; i++) { /* 2 */
        lrcsi_total_add_material(&run, i);
    }
    for (uint32_t i = 0; i < p->scene->part_count; i++) { /* 3 */
        if (lrcsi_is_clear_shape(clear, i)) {
            add_clear_shape(&run, i, clear->slab[i]);
        }
    }
    if (run.bounds_tessellation) { /* 4 */
        add_tessellation_errors(&run);
    }
    total_finish(&run); /* 5 */
    const double shared = run.shared_reach > 0 ? run.shared_error / run.shared_reach : 0;
    for (uint32_t i = 0; part_error && i < p->scene->part_count; i++) {
        const double share =
            i < LRCSI_PART_SET_SINGLE ? 0 : shared * p->scene->part[i].bounds.reach;
        part_error[i] = lrcsi_prepared_area(p, part_error[i] + share);
    }
    if (replaced && !run.bounds_tessellation) {
        run.total.tessellation = -1;
    }
    return run.total;
}
