/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2 over visible areas, material by material, compensated. A facet at incidence
   theta of which a projected area a is visible adds 4 pi f_r cos(theta) a.

   Nearly all facets go in blocks through plain doubles (optics/shade.h); those near grazing, in the
   bright lobe of a narrow glint, or with curved normals go one by one through double-double
   incidence (view/view.h) and optics/reflect.h. What each adds to the bounds stands beside each
   step; the bounds themselves are widened by 1e-9 and 2 u a facet for their own rounding.
   Called: lrcsi_view_dot, lrcsi_shade, lrcsi_sum_lanes_add; lrcsi_view_incidence, lrcsi_reflect;
   lrcsi_tessellation_error. */
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

/* The relative error of a visible area that is all of a facet not near grazing: that of
   lrcsi_incidence.projected (8 u), and a product. */
#define AREA_ERROR (10 * LRCSI_U)

/* Running sums, in scaled units. */
typedef struct total_sums {
    lrcsi_sum glint, diffuse, projected, back_side;
    double visibility, tessellation, rounding, curvature;
    double likely, bias; /* of errors that add up by chance; of those that share a sign */
    uint32_t seen;
} total_sums;

/* What the sum is over, and what has come together. */
typedef struct total_job {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_visible *visible;       /* NULL: all that nothing is known to hide */
    const unsigned char *answer;        /* lrcsi_areas */
    const lrcsi_curved *curved;         /* NULL: all facets are flat */
    const lrcsi_proximity_band *margin; /* NULL: none was made */
    const lrcsi_clear *clear;           /* shapes that count by closed forms; NULL: none */
    lrcs_facet_record *records;         /* NULL: none asked for */
    lrcsi_patch patch;                  /* of the last facet that has one */
    lrcsi_total total;
    total_sums sums;
} total_job;

/* Its reflection. A term of amplitude 0 that is to be evaluated all the same is so at amplitude 1,
   and added 0 times; with no slope there is no glint to evaluate. */
static lrcsi_reflection reflection_planned(const lrcs_brdf *brdf, const lrcsi_plan *plan,
                                           double tan2)
{
    lrcsi_reflection at = lrcsi_reflect(brdf, tan2, 0);
    int glint = plan->glint == LRCSI_TERM_FORCED && brdf->A == 0 && brdf->s > 0;
    int diffuse = plan->diffuse == LRCSI_TERM_FORCED && brdf->B == 0;
    if (glint || diffuse) {
        const lrcs_brdf idle = {glint, diffuse, brdf->s, brdf->m};
        lrcsi_reflection none = lrcsi_reflect(&idle, tan2, 0);
        at.glint += brdf->A * none.glint;
        at.diffuse += brdf->B * none.diffuse;
    }
    return at;
}

/* The largest value of (1 + u)^2 exp(-u / s^2) over u >= 0. */
static double glint_peak(double s)
{
    double q = 2 * s * s;
    return q <= 1 ? 1 : q * q * lrcsi_exp(2 / q - 2);
}

/* How far the glint may be off where tan^2 is too vague for its flank: truth and value both lie
   between 0 and the glint at the least tan^2, which beyond the peak (2 s^2 - 1) is the most. */
static double glint_uncertainty(const lrcs_brdf *brdf, const lrcsi_incidence *incidence)
{
    double least = incidence->tan2 * (1 - 2 * incidence->tan2_err);
    if (!(least >= 2 * brdf->s * brdf->s)) {
        return brdf->A * glint_peak(brdf->s);
    }
    const lrcs_brdf alone = {brdf->A, 0, brdf->s, 0};
    lrcsi_reflection most = lrcsi_reflect(&alone, least, 0);
    return most.glint + most.error;
}

/* At least e^x - 1, for 0 <= x < 1. */
static double growth(double x)
{
    return x + x * x;
}

/* How far f_r cos^2 may be off for want of knowing tan^2. With u = tan^2 known to a relative r,
   log of the glint moves by at most r (2 min(u, 1) + u / s^2), of the diffuse part by at most
   r (m + 2)/2 min(u, 1); where these are no small numbers, each part is bounded itself. Near
   edge-on (r infinite) u is at least this, and beyond the glint's peak both parts only fall. */
static double reflection_uncertainty(const lrcs_brdf *brdf, const lrcsi_incidence *incidence,
                                     const lrcsi_reflection *at)
{
    if (isinf(incidence->tan2_err)) {
        double most = (brdf->A > 0 ? brdf->A * glint_peak(brdf->s) : 0) + brdf->B;
        return incidence->tan2 >= 2 * brdf->s * brdf->s ? at->glint + at->diffuse : most;
    }
    double bent = lrcsi_least(incidence->tan2, 1);
    double glint =
        brdf->A > 0 ? incidence->tan2_err * (2 * bent + incidence->tan2 / brdf->s / brdf->s) : 0;
    double diffuse = incidence->tan2_err * (0.5 * brdf->m + 1) * bent;
    return (glint < 1 ? at->glint * growth(glint) : glint_uncertainty(brdf, incidence)) +
           (diffuse < 1 ? at->diffuse * growth(diffuse) : brdf->B);
}

static void add_seen(total_sums *sums, const lrcs_brdf *brdf)
{
    sums->seen |= brdf->A > 0 ? 1u << LRCS_EFFECT_GLINT : 0u;
    sums->seen |= brdf->B > 0 ? 1u << LRCS_EFFECT_DIFFUSE : 0u;
}

/* Of nearly all facets the whole is visible: no quotient, then. */
static double share_of(double part, double whole)
{
    return part == whole ? 1 : part / whole;
}

/* One facet that reflects towards the laser, precisely: by the mean over its patch where it stands
   for a part of a curved wall, else by its normal. Rounding: S, 4 pi, two products and the share,
   8 u; the relative error of areas; what f_r cos^2 is off by, over all that may be visible. */
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
    double whole = LRCSI_FOUR_PI * 0.5 * p->normal[facet].length;
    double share = share_of(visible->area, incidence->projected);
    double most = share_of(visible->high, incidence->projected);
    lrcsi_facet_terms terms = {.glint = whole * at.glint * share,
                               .diffuse = whole * at.diffuse * share};
    terms.rounding = (terms.glint + terms.diffuse) * (incidence->error + 8 * LRCSI_U) +
                     whole * most * (at.error + uncertainty) +
                     (brdf.A > 0 || brdf.B > 0 ? LRCSI_FACET_UNDERFLOW : 0);
    terms.per_area = whole * (at.glint + at.diffuse) / incidence->projected;
    return terms;
}

static void add_doubt(total_sums *sums, double per_area, const lrcsi_visible *visible)
{
    double doubt = lrcsi_most(visible->area - visible->low, visible->high - visible->area);
    sums->visibility += per_area * doubt;
    sums->likely = lrcsi_length_flat(sums->likely, per_area * visible->likely);
    sums->bias += per_area * visible->bias;
}

/* One with curved normals, which comes summed. */
static void add_curved(total_sums *sums, const lrcsi_curved *curved)
{
    lrcsi_sum_add(&sums->glint, curved->glint);
    lrcsi_sum_add(&sums->diffuse, curved->diffuse);
    sums->visibility += curved->visibility;
    sums->rounding += curved->rounding + LRCSI_FACET_UNDERFLOW;
    sums->likely = lrcsi_length_flat(sums->likely, curved->likely);
    sums->curvature += curved->estimate;
}

/* Counts a facet of which nothing, or only a part, is visible. An area computed by clipping that
   cannot be distinguished from none, or from all, counts as that. */
static void count_shown(lrcsi_total *total, double projected, const lrcsi_visible *visible)
{
    int below = visible->area < projected;
    int clipped = visible->likely == 0 && visible->high - visible->low < projected;
    int partly = visible->area > 0 && below &&
                 !(clipped && (visible->low <= 0 || visible->high >= projected));
    total->partial += partly ? 1 : 0;
    total->hidden += visible->area == 0 || (below && visible->low <= 0 && !partly) ? 1 : 0;
}

/* A bound in square metres. Where that is no normal double its rounding is made up for, and that of
   the two values that it may hold for: half of 2^-1074 each. */
double lrcsi_bound_area(const lrcs_prepared *p, double scaled)
{
    double area = lrcsi_prepared_area(p, scaled);
    return scaled > 0 && area < DBL_MIN ? area + 0x1p-1073 : area;
}

/* To square metres; the compensated sums' own error goes to rounding. */
static void total_finish(total_job *job)
{
    const lrcs_prepared *p = job->view->prepared;
    const total_sums *sums = &job->sums;
    lrcsi_total *total = &job->total;
    double glint = lrcsi_sum_value(&sums->glint);
    double diffuse = lrcsi_sum_value(&sums->diffuse);
    double count = p->scene->facet_count;
    double outward = 1 + 1e-9 + 2 * count * LRCSI_U;
    total->glint = lrcsi_prepared_area(p, glint);
    total->diffuse = lrcsi_prepared_area(p, diffuse);
    total->projected = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->projected));
    total->back_side = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->back_side));
    total->visibility = lrcsi_bound_area(p, sums->visibility * outward);
    total->tessellation =
        sums->tessellation < 0 ? -1 : lrcsi_bound_area(p, sums->tessellation * outward);
    double adding = (glint + diffuse) * (4 * LRCSI_U + 3 * (count * LRCSI_U) * (count * LRCSI_U));
    total->rounding = lrcsi_bound_area(p, (sums->rounding + adding) * outward);
    double likely = lrcsi_length_flat(sums->likely, sums->bias);
    total->likely = fmin(lrcsi_prepared_area(p, likely), total->visibility);
    total->curvature = lrcsi_prepared_area(p, sums->curvature);
    total->seen = sums->seen;
}

/* Is all of the facet visible, or nothing, as its answer tells? */
static inline int facet_answered(const total_job *job, uint32_t facet)
{
    return job->answer && job->answer[facet] != LRCSI_QUERY_UNDECIDED;
}

/* What is visible of a facet. */
static lrcsi_visible facet_visible(const total_job *job, uint32_t facet,
                                   const lrcsi_incidence *incidence)
{
    if (facet_answered(job, facet)) {
        double area = job->answer[facet] == LRCSI_QUERY_VISIBLE ? incidence->projected : 0;
        return (lrcsi_visible){area, area, area, 0, 0};
    }
    if (job->visible) {
        return job->visible[facet];
    }
    return lrcsi_grid_casts(job->view, facet)
               ? lrcsi_visible_unshadowed(incidence, job->plan->grazing_cos)
               : (lrcsi_visible){0, 0, 0, 0, 0};
}

/* What a facet adds goes into its record. */
static void record_sigma(const total_job *job, uint32_t facet, double glint, double diffuse)
{
    if (job->records) {
        const lrcs_prepared *p = job->view->prepared;
        job->records[facet].sigma_m2 = lrcsi_prepared_area(p, glint + diffuse);
        job->records[facet].sigma_glint_m2 = lrcsi_prepared_area(p, glint);
    }
}

/* --- one by one ------------------------------------------------------------------------------- */

/* A facet that reflects and of which something may be visible. */
static void sum_precisely(total_job *job, uint32_t facet)
{
    total_sums *sums = &job->sums;
    lrcsi_incidence incidence = lrcsi_view_incidence(job->view, facet);
    lrcsi_visible visible = facet_visible(job, facet, &incidence);
    lrcs_brdf brdf =
        lrcsi_plan_brdf(job->plan, lrcsi_prepared_material(job->view->prepared, facet));
    add_seen(sums, &brdf);
    lrcsi_sum_add(&sums->projected, visible.area);
    count_shown(&job->total, incidence.projected, &visible);
    if (job->curved && lrcsi_curve_applies(job->view, facet)) {
        add_curved(sums, &job->curved[facet]);
        record_sigma(job, facet, job->curved[facet].glint, job->curved[facet].diffuse);
        return;
    }
    lrcsi_facet_terms terms =
        lrcsi_facet_terms_make(job->view, job->plan, facet, &incidence, &visible, &job->patch);
    lrcsi_sum_add(&sums->glint, terms.glint);
    lrcsi_sum_add(&sums->diffuse, terms.diffuse);
    sums->rounding += terms.rounding;
    record_sigma(job, facet, terms.glint, terms.diffuse);
    if (visible.low < visible.high) {
        add_doubt(sums, terms.per_area, &visible);
    }
}

/* The visible area of a facet that shows, where areas were found. */
static inline double facet_area(const total_job *job, uint32_t facet)
{
    return facet_answered(job, facet) ? lrcsi_view_projected(job->view, facet)
                                      : job->visible[facet].area;
}

/* A back side that shows and does not reflect. */
static void sum_back(total_job *job, double area)
{
    lrcsi_sum_add(&job->sums.projected, area);
    lrcsi_sum_add(&job->sums.back_side, area);
    job->total.back_sides += area > 0 ? 1 : 0;
}

/* Does something of a facet show, where areas were found? */
static inline int area_shows(const total_job *job, uint32_t facet)
{
    return facet_answered(job, facet) ? job->answer[facet] == LRCSI_QUERY_VISIBLE
                                      : job->visible[facet].high > 0;
}

static int facet_shows(const total_job *job, uint32_t facet)
{
    return job->visible ? area_shows(job, facet) : lrcsi_grid_casts(job->view, facet);
}

/* Is a facet's reflection part of a closed form? */
static int is_in_shape(const total_job *job, uint32_t facet)
{
    return job->clear && job->clear->part[job->view->prepared->scene->facet_part[facet]];
}

/* A facet of a clear shape: what it reflects counts in the closed form, and nothing hides its
   front. The silhouette of a closed one has a formula too. */
static void sum_in_shape(total_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    int front = job->view->facing[facet] > 0;
    if (front && !p->scene->part[p->scene->facet_part[facet]].solid) {
        lrcsi_sum_add(&job->sums.projected, lrcsi_view_projected(job->view, facet));
    }
    job->total.hidden += front ? 0 : 1;
}

/* Any facet, by its exact facing. */
static void sum_facet(total_job *job, uint32_t facet)
{
    int reflects = lrcsi_view_reflects(job->view, facet);
    int shows = job->view->facing[facet] != 0 && facet_shows(job, facet);
    if (reflects && is_in_shape(job, facet)) {
        sum_in_shape(job, facet);
    } else if (reflects && shows) {
        sum_precisely(job, facet);
    } else if (shows) {
        sum_back(job,
                 job->visible ? facet_area(job, facet) : lrcsi_view_projected(job->view, facet));
    } else if (reflects) {
        job->total.hidden++;
    }
}

/* --- in blocks -------------------------------------------------------------------------------- */

/* The facets of one material on their way through blocks. */
typedef struct total_batch {
    lrcsi_lobes lobes;
    int back_reflects, back_shows; /* back sides do, or may */
    int seen;                      /* one that reflects shows */
    uint32_t waiting;              /* places of facets that wait for a block to fill up */
    uint32_t place[2 * LRCSI_LANES];
    signed char side[2 * LRCSI_LANES]; /* 1; if back sides reflect, -1 for those */
    lrcsi_shades shades;
    double area[LRCSI_LANES]; /* S, then S cos(theta), then of that the visible part */
    double most[LRCSI_LANES]; /* that may be visible; by method facet all of `area`, and unused */
    lrcsi_sum_lanes glint, diffuse, projected, back_side;
    double error[LRCSI_SUM_LANES];
} total_batch;

/* Unit normals towards the laser, and areas, of the first facets that wait. Empty lanes get the
   direction for a normal, and no area. */
static void block_gather(const total_job *job, total_batch *batch, uint32_t count)
{
    const lrcsi_view *view = job->view;
    const lrcsi_batches *b = &view->prepared->batches;
    const double *x = b->normal[0];
    const double *y = b->normal[1];
    const double *z = b->normal[2];
    const double *area = b->area;
    lrcsi_shades *shades = &batch->shades;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t at = batch->place[i];
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

/* The areas of facets that are not known to be visible whole, where areas were found. */
static void block_parts(const total_job *job, total_batch *batch, uint32_t count)
{
    memcpy(batch->most, batch->area, sizeof batch->most);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t facet = job->view->prepared->batches.facet[batch->place[i]];
        if (!facet_answered(job, facet)) {
            const lrcsi_visible *visible = &job->visible[facet];
            batch->area[i] = visible->area;
            batch->most[i] = lrcsi_most(visible->high, visible->area);
        }
    }
}

/* Facets that are seen in part, or may be; by method facet, all whose cosine may be below the
   plan's threshold. */
static void block_doubts(total_job *job, const total_batch *batch, uint32_t count)
{
    const lrcsi_shades *shades = &batch->shades;
    for (uint32_t i = 0; i < count; i++) {
        double per_area = shades->glint[i] + shades->diffuse[i];
        if (!job->visible) {
            int sure = shades->cosine[i] > job->plan->grazing_cos + 0x1p-40;
            job->sums.visibility += sure ? 0 : per_area * batch->area[i];
            continue;
        }
        uint32_t facet = job->view->prepared->batches.facet[batch->place[i]];
        const lrcsi_visible *visible = &job->visible[facet];
        if (!facet_answered(job, facet) && visible->low < visible->high) {
            add_doubt(&job->sums, per_area, visible);
            count_shown(&job->total, lrcsi_view_projected(job->view, facet), visible);
        }
    }
}

/* Eq. 2 for one block, the first LRCSI_LANES facets that wait:
   1. normals and areas S;
   2. 4 pi f_r cos(theta), with errors;
   3. projected areas S cos(theta); of facets not visible whole, the visible part;
   4. each product with the area joins the sums;
   5. records, and what is doubtful about visible areas. */
static void block_run(total_job *job, total_batch *batch)
{
    const lrcsi_view *view = job->view;
    lrcsi_shades *shades = &batch->shades;
    const double *most = job->visible ? batch->most : batch->area;
    uint32_t count = batch->waiting < LRCSI_LANES ? batch->waiting : LRCSI_LANES;
    double glint[LRCSI_LANES];
    double diffuse[LRCSI_LANES];
    double error[LRCSI_LANES];
    block_gather(job, batch, count);
    lrcsi_shade(&batch->lobes, view->unit, view->unit_low, shades);
    for (int i = 0; i < LRCSI_LANES; i++) {
        batch->area[i] *= shades->cosine[i];
    }
    if (job->visible) {
        block_parts(job, batch, count);
    }
    for (int i = 0; i < LRCSI_LANES; i++) {
        glint[i] = shades->glint[i] * batch->area[i];
        diffuse[i] = shades->diffuse[i] * batch->area[i];
        error[i] = shades->error[i] * most[i];
    }
    lrcsi_sum_lanes_add(&batch->glint, glint);
    lrcsi_sum_lanes_add(&batch->diffuse, diffuse);
    lrcsi_sum_lanes_add(&batch->projected, batch->area);
    lrcsi_lanes_add(batch->error, error);
    for (uint32_t i = 0; job->records && i < count; i++) {
        record_sigma(job, view->prepared->batches.facet[batch->place[i]], glint[i], diffuse[i]);
    }
    if (job->visible || (job->plan->grazing_cos > 0 && job->plan->grazing_cos < 1)) {
        block_doubts(job, batch, count);
    }
    if (batch->lobes.A > 0 || batch->lobes.B > 0) {
        job->sums.rounding += count * LRCSI_FACET_UNDERFLOW;
    }
    batch->waiting -= count;
    memmove(batch->place, batch->place + LRCSI_LANES, sizeof batch->place / 2);
    memmove(batch->side, batch->side + LRCSI_LANES, sizeof batch->side / 2);
}

/* Does a facet that is seen from that side show? Of redundant ones another is seen instead. */
static inline int side_shows(const total_job *job, uint32_t facet, int side)
{
    int most = side > 0 ? LRCSI_REDUNDANT : LRCSI_REDUNDANT_FROM_BEHIND;
    return job->visible ? area_shows(job, facet) : job->view->prepared->redundant[facet] < most;
}

/* Of places listed, all of facets that reflect, those stay that blocks serve: not those of clear
   shapes, none that is hidden, none with curved normals, which are summed at once. Returns how many
   stay. */
static uint32_t places_filter(total_job *job, uint32_t *list, uint32_t count, int side)
{
    const uint32_t *facet = job->view->prepared->batches.facet;
    uint32_t left = count;
    if (job->clear) {
        left = 0;
        for (uint32_t k = 0; k < count; k++) {
            if (is_in_shape(job, facet[list[k]])) {
                sum_in_shape(job, facet[list[k]]);
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
        left += (uint32_t)side_shows(job, facet[at], side);
    }
    job->total.hidden += count - left;
    if (job->curved) {
        count = left;
        left = 0;
        for (uint32_t k = 0; k < count; k++) {
            if (lrcsi_curve_applies(job->view, facet[list[k]])) {
                sum_precisely(job, facet[list[k]]);
            } else {
                list[left++] = list[k];
            }
        }
    }
    return left;
}

/* Places from `place` on of facets that reflect on the side towards the laser, which is 1, or -1
   for their back: those that are picked and show wait for a block, which is run once it is full. */
static void batch_add(total_job *job, total_batch *batch, uint32_t place,
                      const uint64_t pick[LRCSI_LANES], int side)
{
    uint32_t *list = batch->place + batch->waiting;
    uint32_t count = 0;
    for (uint32_t i = 0; i < LRCSI_LANES; i++) { /* without branches: facings follow no pattern */
        list[count] = place + i;
        count += (uint32_t)(pick[i] >> 63);
    }
    if (job->visible || job->curved || job->clear || job->view->prepared->batches.redundant) {
        count = places_filter(job, list, count, side);
    }
    for (uint32_t i = 0; batch->back_reflects && i < count; i++) {
        batch->side[batch->waiting + i] = (signed char)side;
    }
    batch->waiting += count;
    batch->seen |= count > 0;
    if (batch->waiting >= LRCSI_LANES) {
        block_run(job, batch);
    }
}

/* The cosine of the incidence at a place. */
static inline double place_dot(const lrcsi_batches *b, uint32_t at, const double d[3])
{
    return lrcsi_view_dot(b->normal[0][at], b->normal[1][at], b->normal[2][at], d);
}

/* Adds the areas of the back sides picked that show and do not reflect. */
static void batch_backs(total_job *job, total_batch *batch, uint32_t place,
                        const uint64_t pick[LRCSI_LANES])
{
    const lrcsi_batches *b = &job->view->prepared->batches;
    const double *d = job->view->unit;
    double area[LRCSI_LANES] = {0}; /* projected */
    uint32_t count = 0;
    if (job->visible || b->redundant) {
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            if (pick[i] >> 63) {
                uint32_t facet = b->facet[place + i];
                if (side_shows(job, facet, -1)) {
                    area[count] = job->visible ? facet_area(job, facet)
                                               : -place_dot(b, place + i, d) * b->area[place + i];
                }
                job->total.back_sides += area[count++] > 0;
            }
        }
    } else {
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            uint32_t at = place + i;
            area[i] = lrcsi_bits_masked(-place_dot(b, at, d) * b->area[at], ~((pick[i] >> 63) - 1));
            count += (uint32_t)(pick[i] >> 63);
        }
        job->total.back_sides += count;
    }
    lrcsi_sum_lanes_add(&batch->back_side, area);
}

/* Which of LRCSI_LANES places hold facets that blocks serve, as sign bits: those that show their
   front, and their back, to the laser. */
typedef struct total_pick {
    uint64_t front[LRCSI_LANES], back[LRCSI_LANES];
    uint64_t any_front, any_back, any_other; /* none where the sign bit is clear */
} total_pick;

/* a - b is negative where a < b. */
static void places_pick(const total_job *job, const total_batch *batch, uint32_t place,
                        uint32_t count, total_pick *restrict pick)
{
    const lrcsi_batches *b = &job->view->prepared->batches;
    const double *x = b->normal[0] + place;
    const double *y = b->normal[1] + place;
    const double *z = b->normal[2] + place;
    const double d[3] = {job->view->unit[0], job->view->unit[1], job->view->unit[2]};
    const double low = batch->lobes.low;
    const double high = batch->lobes.high;
    const double far = batch->back_reflects ? high : 2;
    uint64_t fronts = 0;
    uint64_t backs = 0;
    uint64_t others = 0;
    for (int i = 0; i < LRCSI_LANES; i++) {
        double dot = lrcsi_view_dot(x[i], y[i], z[i], d);
        uint64_t front = lrcsi_bits_of(low - dot) & lrcsi_bits_of(dot - high);
        uint64_t back = lrcsi_bits_of(low + dot) & lrcsi_bits_of(-far - dot);
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

/* Facets that stand for patches of curved walls are summed one by one. */
static void patches_pick(const total_job *job, uint32_t place, uint32_t count, total_pick *pick)
{
    const lrcsi_batches *b = &job->view->prepared->batches;
    for (uint32_t i = 0; i < count; i++) {
        if (lrcsi_patch_exists(job->view->prepared, b->facet[place + i])) {
            pick->front[i] = pick->back[i] = 0;
            pick->any_other = UINT64_MAX;
        }
    }
}

/* Up to LRCSI_LANES facets from a place on:
   1. which of them blocks serve;
   2. front sides wait for a block;
   3. back sides too where they reflect, or their areas are added up;
   4. the others, near grazing or in the bright lobe of a narrow glint, are summed one by one. */
static void sum_places(total_job *job, total_batch *batch, uint32_t place, uint32_t count)
{
    total_pick pick;
    places_pick(job, batch, place, count, &pick);
    if (job->plan->patches) {
        patches_pick(job, place, count, &pick);
    }
    if (pick.any_front >> 63) {
        batch_add(job, batch, place, pick.front, 1);
    }
    if (!(pick.any_back >> 63)) {
        /* nothing */
    } else if (batch->back_reflects && batch->back_shows) {
        batch_add(job, batch, place, pick.back, -1);
    } else if (batch->back_shows) {
        batch_backs(job, batch, place, pick.back);
    } else if (batch->back_reflects) {
        for (uint32_t i = 0; i < count; i++) {
            job->total.hidden += (uint32_t)(pick.back[i] >> 63);
        }
    }
    for (uint32_t i = 0; pick.any_other >> 63 && i < count; i++) {
        if (!((pick.front[i] | pick.back[i]) >> 63)) {
            sum_facet(job, job->view->prepared->batches.facet[place + i]);
        }
    }
}

/* The batch's sums join the others. By method facet, where the plan knows nothing of what hides
   what, all of it may be hidden. */
static void batch_finish(total_job *job, total_batch *batch)
{
    if (batch->waiting > 0) {
        block_run(job, batch);
    }
    total_sums *sums = &job->sums;
    lrcsi_sum both = {0, 0};
    lrcsi_sum_lanes_join(&both, &batch->glint);
    lrcsi_sum_lanes_join(&both, &batch->diffuse);
    lrcsi_sum_lanes_join(&sums->glint, &batch->glint);
    lrcsi_sum_lanes_join(&sums->diffuse, &batch->diffuse);
    lrcsi_sum_lanes_join(&sums->projected, &batch->projected);
    lrcsi_sum_lanes_join(&sums->projected, &batch->back_side);
    lrcsi_sum_lanes_join(&sums->back_side, &batch->back_side);
    for (int k = 0; k < LRCSI_SUM_LANES; k++) {
        sums->rounding += batch->error[k] * LRCSI_SHADE_UNIT;
    }
    sums->rounding += job->visible ? lrcsi_sum_value(&both) * AREA_ERROR : 0;
    sums->visibility += !job->visible && job->plan->grazing_cos >= 1 ? lrcsi_sum_value(&both) : 0;
}

/* --- all of it -------------------------------------------------------------------------------- */

static int term_wanted(int term, double amplitude)
{
    return amplitude > 0 || term == LRCSI_TERM_FORCED;
}

static void sum_material(total_job *job, uint32_t material)
{
    const lrcsi_view *view = job->view;
    const lrcs_material *m = &view->prepared->scene->material[material];
    lrcs_brdf brdf = lrcsi_plan_brdf(job->plan, m);
    total_batch batch = {
        .lobes = lrcsi_lobes_make(&brdf, brdf.s > 0 && term_wanted(job->plan->glint, brdf.A),
                                  term_wanted(job->plan->diffuse, brdf.B)),
        .back_reflects = view->backs_reflect && m->two_sided,
        .back_shows = view->backs_cast || job->visible};
    const uint32_t *first = view->prepared->batches.first + material;
    for (uint32_t place = first[0]; place < first[1]; place += LRCSI_LANES) {
        uint32_t left = first[1] - place;
        sum_places(job, &batch, place, left < LRCSI_LANES ? left : LRCSI_LANES);
    }
    batch_finish(job, &batch);
    if (batch.seen) {
        add_seen(&job->sums, &brdf);
    }
}

/* What the facets of tessellated shapes err from their true surfaces. */
static double facet_tessellation(total_job *job, uint32_t facet, const lrcsi_incidence *incidence)
{
    if (is_in_shape(job, facet)) {
        return 0;
    }
    if (job->curved && lrcsi_curve_applies(job->view, facet)) {
        return job->margin ? job->margin->share[facet] * job->curved[facet].upper_bound : 0;
    }
    return LRCSI_FOUR_PI * lrcsi_tessellation_error(job->view, job->plan, facet, incidence,
                                                    job->visible, job->margin, &job->patch);
}

static void sum_tessellation(total_job *job)
{
    const lrcsi_batches *b = &job->view->prepared->batches;
    for (uint32_t place = 0; place < b->count; place += LRCSI_INCIDENCES) {
        lrcsi_incidence incidence[LRCSI_INCIDENCES];
        uint32_t left = b->count - place;
        uint32_t count = left < LRCSI_INCIDENCES ? left : LRCSI_INCIDENCES;
        lrcsi_view_incidences(job->view, b->facet + place, count, incidence);
        for (uint32_t i = 0; i < count; i++) {
            job->sums.tessellation += facet_tessellation(job, b->facet[place + i], &incidence[i]);
        }
    }
}

/* --- shapes by their closed forms ------------------------------------------------------------- */

/* What flat facets of a clear part would reflect, into their records; returns the sum. */
static lrcsi_shape_terms shape_records(const total_job *job, const lrcs_part *part)
{
    lrcsi_shape_terms all = {0, 0, 0, 0, 0};
    lrcsi_patch patch = {.side = 0};
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        lrcsi_incidence incidence = lrcsi_view_incidence(job->view, f);
        lrcsi_visible whole = {incidence.projected, incidence.projected, incidence.projected, 0, 0};
        if (job->view->facing[f] > 0) {
            lrcsi_facet_terms terms =
                lrcsi_facet_terms_make(job->view, job->plan, f, &incidence, &whole, &patch);
            job->records[f].sigma_glint_m2 = terms.glint;
            job->records[f].sigma_m2 = terms.diffuse;
            all.glint += terms.glint;
            all.diffuse += terms.diffuse;
            all.silhouette += incidence.projected;
        }
    }
    return all;
}

/* Shares a clear part's sigma out among its facets. */
static void share_out(const total_job *job, const lrcs_part *part, const lrcsi_shape_terms *terms)
{
    lrcsi_shape_terms flat = shape_records(job, part);
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (job->view->facing[f] > 0) {
            lrcs_facet_record *record = &job->records[f];
            double share = lrcsi_view_projected(job->view, f) / flat.silhouette;
            double glint = flat.glint > 0 ? record->sigma_glint_m2 / flat.glint : share;
            double diffuse = flat.diffuse > 0 ? record->sigma_m2 / flat.diffuse : share;
            record_sigma(job, f, glint * terms->glint, diffuse * terms->diffuse);
        }
    }
}

/* Adds one. Its compensated sums add what facets' do to the bound. */
static void sum_shape(total_job *job, uint32_t index, double slab)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    lrcsi_shape_terms terms = lrcsi_shape_terms_make(job->view, job->plan, index, slab);
    lrcs_brdf brdf = lrcsi_plan_brdf(job->plan, lrcsi_prepared_material(p, part->first_facet));
    lrcsi_sum_add(&job->sums.glint, terms.glint);
    lrcsi_sum_add(&job->sums.diffuse, terms.diffuse);
    lrcsi_sum_add(&job->sums.projected, part->solid ? terms.silhouette : 0);
    job->sums.rounding += terms.rounding;
    job->sums.visibility += terms.visibility;
    if (terms.silhouette > 0) {
        add_seen(&job->sums, &brdf);
    }
    if (job->records) {
        share_out(job, part, &terms);
    }
}

/* Records, all but for sigma. */
static void records_start(const total_job *job)
{
    const lrcs_prepared *p = job->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        job->records[f] = (lrcs_facet_record){0, 0, 0, 0, 0};
        if (!p->skip[f]) {
            lrcsi_incidence incidence = lrcsi_view_incidence(job->view, f);
            lrcsi_visible visible = facet_visible(job, f, &incidence);
            job->records[f].area_m2 = lrcsi_prepared_area(p, 0.5 * p->normal[f].length);
            job->records[f].cos_theta = incidence.cos_theta;
            job->records[f].visible_area_m2 = lrcsi_prepared_area(p, visible.area);
        }
    }
}

lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_areas *areas, const lrcsi_curved *curved,
                             const lrcsi_proximity_band *margin, const lrcsi_clear *clear,
                             lrcs_facet_record *records)
{
    const lrcs_prepared *p = view->prepared;
    total_job job = {.view = view,
                     .plan = plan,
                     .visible = areas->visible,
                     .answer = areas->answer,
                     .curved = curved,
                     .margin = margin,
                     .clear = clear && clear->count > 0 ? clear : NULL,
                     .records = records};
    if (records) {
        records_start(&job);
    }
    for (uint32_t i = 0; i < p->scene->material_count; i++) {
        sum_material(&job, i);
    }
    for (uint32_t i = 0; job.clear && i < p->scene->part_count; i++) {
        if (job.clear->part[i]) {
            sum_shape(&job, i, job.clear->slab[i]);
        }
    }
    if (plan->method == LRCS_METHOD_CLOSED) {
        job.sums.tessellation = 0;
    } else if (p->curved && lrcsi_tessellation_known(p, plan)) {
        sum_tessellation(&job);
    } else if (p->curved) {
        job.sums.tessellation = -HUGE_VAL;
    }
    total_finish(&job);
    return job.total;
}
