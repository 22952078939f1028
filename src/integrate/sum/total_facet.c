/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2, facet by facet: those near grazing incidence, in the bright lobe of a narrow
   glint, with curved normals, or on curved walls. Incidence is in double-double (view/view.h). Also
   the tessellation error of a facet, and what facets add to counts and records.
   integrate/derivative/sensitivity.c differentiates the same terms: a case that is added here needs
   its derivative there. */
#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/range.h"
#include "integrate/sum/facet_terms.h"
#include "integrate/sum/total_run.h"
#include "integrate/wall/tessellation.h"

/* Counts a facet that is hidden or partly visible. If the area of a clipped facet cannot be
   distinguished from 0, the facet counts as hidden; if not from the projected area, as visible. */
void lrcsi_total_count(lrcsi_total *total, double projected, const lrcsi_visible_area *visible)
{
    int below = visible->area < projected;
    int clipped = visible->error_estimate == 0 && visible->high - visible->low < projected;
    int partly = visible->area > 0 && below &&
                 !(clipped && (visible->low <= 0 || visible->high >= projected));
    total->partial += partly ? 1 : 0;
    total->hidden += visible->area == 0 || (below && visible->low <= 0 && !partly) ? 1 : 0;
}

void lrcsi_total_note_terms(lrcsi_total_sums *sums, const lrcs_brdf *brdf)
{
    sums->seen |= brdf->A > 0 ? 1u << LRCS_EFFECT_GLINT : 0u;
    sums->seen |= brdf->B > 0 ? 1u << LRCS_EFFECT_DIFFUSE : 0u;
}

/* Adds the errors due to an uncertain visible area. Given: sigma per unit of visible area. */
void lrcsi_total_add_area_error(lrcsi_total_sums *sums, double per_area,
                                const lrcsi_visible_area *visible)
{
    double area_err = lrcsi_max(visible->area - visible->low, visible->high - visible->area);
    sums->visibility += per_area * area_err;
    sums->error_estimate =
        lrcsi_length_flat(sums->error_estimate, per_area * visible->error_estimate);
    sums->bias += per_area * visible->bias;
}

/* Adds to the record of a facet. */
void lrcsi_total_record(lrcsi_total_run *run, uint32_t facet, double glint, double diffuse)
{
    if (run->details.records) {
        const lrcs_prepared *p = run->view->prepared;
        run->details.records[facet].sigma_m2 += lrcsi_prepared_area(p, glint + diffuse);
        run->details.records[facet].sigma_glint_m2 += lrcsi_prepared_area(p, glint);
    }
}

/* Adds what a facet contributes to sigma, to the sums and to its record. */
static void add_sigma(lrcsi_total_run *run, uint32_t facet, double glint, double diffuse)
{
    lrcsi_sum_add(&run->sums.glint, glint);
    lrcsi_sum_add(&run->sums.diffuse, diffuse);
    lrcsi_total_record(run, facet, glint, diffuse);
}

/* Adds the integrals over what is visible of the true surface at a facet. */
static void add_wall(lrcsi_total_run *run, uint32_t facet, const lrcsi_wall_terms *wall)
{
    double glint = LRCS_FOUR_PI * wall->sum.glint;
    double diffuse = LRCS_FOUR_PI * wall->sum.diffuse;
    run->sums.visibility += LRCS_FOUR_PI * wall->visibility;
    run->sums.rounding += LRCS_FOUR_PI * wall->sum.rounding +
                          8 * LRCSI_U * (fabs(glint) + fabs(diffuse)) + LRCSI_FACET_UNDERFLOW;
    add_sigma(run, facet, glint, diffuse);
}

/* Adds a facet that reflects towards the laser and may be visible:
   1. its incidence and visible area;
   2. with curved normals, the integral over them;
   3. on a wall whose visible pieces are known, the integral over these;
   4. otherwise 4 pi S f times the visible fraction, with the rounding error;
   5. the error of the visible area. */
void lrcsi_total_add_reflecting(lrcsi_total_run *run, uint32_t facet)
{
    lrcsi_total_sums *sums = &run->sums;
    lrcsi_incidence incidence = lrcsi_view_incidence(run->view, facet);
    lrcsi_visible_area visible =
        lrcsi_areas_of(run->areas, run->view, run->plan, facet, &incidence);
    lrcs_brdf brdf =
        lrcsi_plan_brdf(run->plan, lrcsi_prepared_material(run->view->prepared, facet));
    lrcsi_total_note_terms(sums, &brdf);
    lrcsi_sum_add(&sums->projected, visible.area);
    lrcsi_total_count(&run->total, incidence.projected, &visible);
    if (run->curve_terms && lrcsi_curve_applies(run->view, facet)) {
        const lrcsi_curve_terms *curve_terms = &run->curve_terms[facet];
        sums->visibility += curve_terms->visibility;
        sums->rounding += curve_terms->rounding + LRCSI_FACET_UNDERFLOW;
        sums->error_estimate = lrcsi_length_flat(sums->error_estimate, curve_terms->error_estimate);
        sums->cubature_estimate += curve_terms->estimate;
        add_sigma(run, facet, curve_terms->glint, curve_terms->diffuse);
        return;
    }
    const lrcsi_wall_terms *wall = lrcsi_areas_wall_terms(run->areas, facet);
    if (wall) {
        add_wall(run, facet, wall);
        return;
    }
    lrcsi_facet_terms terms =
        lrcsi_facet_terms_make(run->view, run->plan, facet, &incidence, &visible, &run->patches);
    sums->rounding += terms.rounding;
    add_sigma(run, facet, terms.glint, terms.diffuse);
    if (visible.low < visible.high) {
        lrcsi_total_add_area_error(sums, terms.per_area, &visible);
    }
}

/* Counts a facet of a clear shape, of which nothing hides the front. Its sigma is part of the
   closed form; so is its projected area if the shape is solid. */
void lrcsi_total_add_clear(lrcsi_total_run *run, uint32_t facet)
{
    const lrcs_prepared *p = run->view->prepared;
    int front = run->view->facing[facet] > 0;
    if (front && !p->scene->part[p->scene->facet_part[facet]].solid) {
        lrcsi_sum_add(&run->sums.projected, lrcsi_view_projected(run->view, facet));
    }
    run->total.hidden += front ? 0 : 1;
}

/* Adds a facet of any kind, by its exact facing. A facet that does not reflect towards the laser
   may still have the integral over a patch at the limb. */
void lrcsi_total_add_facet(lrcsi_total_run *run, uint32_t facet)
{
    int reflects = lrcsi_view_reflects(run->view, facet);
    const lrcsi_wall_terms *wall = lrcsi_areas_wall_terms(run->areas, facet);
    if (!reflects && wall && !lrcsi_total_in_clear_shape(run, facet)) {
        const lrcs_brdf brdf =
            lrcsi_plan_brdf(run->plan, lrcsi_prepared_material(run->view->prepared, facet));
        lrcsi_total_note_terms(&run->sums, &brdf);
        add_wall(run, facet, wall);
    }
    int visible =
        run->view->facing[facet] != 0 && lrcsi_areas_is_summed(run->areas, run->view, facet);
    if (reflects && lrcsi_total_in_clear_shape(run, facet)) {
        lrcsi_total_add_clear(run, facet);
    } else if (reflects && visible) {
        lrcsi_total_add_reflecting(run, facet);
    } else if (reflects) {
        run->total.hidden++;
    } else if (visible) { /* a back side that does not reflect */
        double area = run->areas->visible ? lrcsi_areas_value(run->areas, run->view, facet)
                                          : lrcsi_view_projected(run->view, facet);
        lrcsi_sum_add(&run->sums.projected, area);
        lrcsi_sum_add(&run->sums.back_side, area);
        run->total.back_sides += area > 0 ? 1 : 0;
    }
}

/* Divides an error of a facet among the parts that cause it, in proportion to their reaches: those
   of a set and, with `own`, its own part. */
static void divide_error(lrcsi_total_run *run, uint32_t facet, double error, lrcsi_part_set set,
                         int own)
{
    const lrcs_scene *scene = run->view->prepared->scene;
    if (own || set == 0) {
        set |= lrcsi_part_set_of(scene->facet_part[facet]);
    }
    double shared = set >> LRCSI_PART_SET_SINGLE != 0 ? run->shared_reach : 0;
    double reach = shared;
    for (uint32_t i = 0; i < scene->part_count && i < LRCSI_PART_SET_SINGLE; i++) {
        reach += (set & lrcsi_part_set_of(i)) != 0 ? scene->part[i].bounds.reach : 0;
    }
    if (!(reach > 0)) {
        return;
    }
    run->shared_error += error * (shared / reach);
    for (uint32_t i = 0; i < scene->part_count && i < LRCSI_PART_SET_SINGLE; i++) {
        run->details.part_error[i] +=
            (set & lrcsi_part_set_of(i)) != 0 ? error * (scene->part[i].bounds.reach / reach) : 0;
    }
}

/* Divides the tessellation error of a facet among the parts whose shadows may end on it and its own
   part. On a flat face whose margins are used, the facet that represents it has the errors of
   margins anywhere on the face, and the face's own part causes an error only where a side of the
   face is not free. */
static void add_part_errors(lrcsi_total_run *run, uint32_t facet, double error)
{
    const lrcsi_proximity_band *band = run->band ? run->band->whole : NULL;
    lrcsi_part_set set = band ? band->parts[facet] : 0;
    int own = 1;
    const lrcsi_flat_face *face = lrcsi_flat_face_of(run->areas->face, run->view, facet);
    if (band && face) {
        set |= face->facet == facet ? face->causes : 0;
        const unsigned sides = lrcsi_face_border_sides(run->view, facet);
        own = 0;
        for (int k = 0; k < 3; k++) {
            own |= ((sides >> k) & 1) != 0 && !lrcsi_band_side_is_free(band, facet, k);
        }
    }
    divide_error(run, facet, error, set, own);
}

/* Adds the tessellation error of a facet on a wall whose visible pieces are known: what other parts
   cause, and what its own part causes. */
static void add_round_errors(lrcsi_total_run *run, uint32_t facet, const lrcsi_wall_terms *wall)
{
    run->sums.above += LRCS_FOUR_PI * (wall->above + wall->sum.remainder);
    run->sums.below += LRCS_FOUR_PI * (wall->below + wall->sum.remainder);
    if (run->details.part_error) {
        uint32_t own = run->view->prepared->scene->facet_part[facet];
        run->details.part_error[own] += LRCS_FOUR_PI * wall->sum.remainder;
        divide_error(run, facet, LRCS_FOUR_PI * fmax(wall->above, wall->below),
                     run->band ? run->band->whole->parts[facet] : 0, 0);
    }
}

/* Adds what a facet's sigma is corrected by, because F varies over its patch. Its rounding error is
   part of the tessellation error. */
static void add_correction(lrcsi_total_run *run, uint32_t facet, const lrcsi_tessellation *error)
{
    run->details.corrected[facet] = error->corrected;
    add_sigma(run, facet, LRCS_FOUR_PI * error->glint, LRCS_FOUR_PI * error->diffuse);
}

/* Adds sigma of the margins on a facet, and of those of the face that it represents. The true
   reflectance differs from the facet's within the tessellation error. */
static void add_margin(lrcsi_total_run *run, uint32_t facet, const lrcsi_incidence *incidence)
{
    const double area = lrcsi_areas_margin(run->areas, run->view, facet);
    if (area == 0) {
        return;
    }
    const double sign = area < 0 ? -1 : 1;
    const lrcsi_visible_area size = lrcsi_visible_area_exact(fabs(area));
    const lrcsi_facet_terms terms =
        lrcsi_facet_terms_make(run->view, run->plan, facet, incidence, &size, &run->patches);
    run->sums.rounding += terms.rounding;
    add_sigma(run, facet, sign * terms.glint, sign * terms.diffuse);
}

/* Adds the tessellation error of a facet: the error of replacing curved shapes by facets, and the
   correction that goes with it. A facet with curved normals adds only the effect of differences in
   visibility within the proximity band; clear shapes have no such error. */
void lrcsi_total_add_tessellation(lrcsi_total_run *run, uint32_t facet,
                                  const lrcsi_incidence *incidence)
{
    const lrcsi_wall_terms *wall = lrcsi_areas_wall_terms(run->areas, facet);
    if (lrcsi_total_in_clear_shape(run, facet)) {
        return;
    }
    if (wall) {
        add_round_errors(run, facet, wall);
        return;
    }
    if (!run->curve_terms || !lrcsi_curve_applies(run->view, facet)) {
        const lrcsi_tessellation_input in = {
            run->view, run->plan,        run->areas->visible,        run->areas->moment,
            run->band, run->areas->face, run->areas->margins != NULL};
        lrcsi_tessellation error = lrcsi_tessellation_error(&in, facet, incidence, &run->patches);
        add_margin(run, facet, incidence);
        if (error.corrected > 0) {
            add_correction(run, facet, &error);
        }
        run->sums.above += LRCS_FOUR_PI * error.above;
        run->sums.below += LRCS_FOUR_PI * error.below;
        if (run->details.part_error && error.above + error.below > 0) {
            add_part_errors(run, facet, LRCS_FOUR_PI * fmax(error.above, error.below));
        }
    } else if (run->band) {
        run->sums.above +=
            lrcsi_masked_gain(run->band, facet) * run->curve_terms[facet].upper_bound;
        run->sums.below +=
            lrcsi_masked_loss(run->band, facet) * run->curve_terms[facet].upper_bound;
    }
}
