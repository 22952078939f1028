/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2 over visible areas, in facet order, compensated. A facet of area S at incidence
   theta, of which a share is visible, adds 4 pi (f_r cos^2)(theta) S share. What each facet adds to
   the bounds stands beside each step; the bounds themselves are widened by 1e-9 and 2 u a facet
   for their own rounding. */
#include "integrate/total.h"

#include <float.h>
#include <math.h>

#include "base/length.h"
#include "base/range.h"
#include "base/sum.h"
#include "integrate/tessellation.h"
#include "optics/reflect.h"

#define U       0x1p-53
#define FOUR_PI 12.566370614359172954

/* What a facet's terms may lose to underflow, scaled: some 30 operations, of 2^-1075 each, and
   nothing that comes after makes any of them larger than its term. */
#define FACET_UNDERFLOW 0x1p-1070

/* Running sums, in scaled units. */
typedef struct total_sums {
    lrcsi_sum glint, diffuse, projected, back_side;
    double visibility, tessellation, rounding, curvature;
    double likely, lean; /* of errors that add up by chance; of those that lean one way */
    uint32_t seen;
} total_sums;

/* The last reflection. Facets of one plane mostly come one after the other, and many of them share
   their incidence to the last bit: so do one in two to one in ten of the models tried. */
typedef struct total_last {
    const lrcs_material *material; /* NULL: none yet */
    double tan2;
    lrcs_brdf brdf;
    lrcsi_reflection at;
} total_last;

/* What the sum is over, and what has come together. */
typedef struct total_job {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_visible *visible; /* NULL: all that nothing is known to hide */
    const lrcsi_curved *curved;   /* NULL: all facets are flat */
    const lrcsi_margin *margin;   /* NULL: none was made */
    lrcsi_total total;
    total_sums sums;
    total_last last;
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

static void reflect_facet(total_job *job, uint32_t facet, double tan2)
{
    const lrcs_material *material = lrcsi_prepared_material(job->view->prepared, facet);
    total_last *last = &job->last;
    if (material != last->material || tan2 != last->tan2) {
        last->material = material;
        last->tan2 = tan2;
        last->brdf = lrcsi_plan_brdf(job->plan, material);
        last->at = reflection_planned(&last->brdf, job->plan, tan2);
    }
}

/* The largest value of (1 + u)^2 exp(-u / s^2) over u >= 0. */
static double glint_peak(double s)
{
    double q = 2 * s * s;
    return q <= 1 ? 1 : q * q * exp(2 / q - 2);
}

/* How far the glint may be off where tan^2 is too vague for its flank: truth and value both lie
   between 0 and the glint at the least tan^2, which beyond the peak (2 s^2 - 1) is the most. */
static double glint_vague(const lrcs_brdf *brdf, const lrcsi_tilt *tilt)
{
    double least = tilt->tan2 * (1 - 2 * tilt->stretch);
    if (!(least >= 2 * brdf->s * brdf->s)) {
        return brdf->A * glint_peak(brdf->s);
    }
    const lrcs_brdf alone = {brdf->A, 0, brdf->s, 0};
    lrcsi_reflection most = lrcsi_reflect(&alone, least, 0);
    return most.glint + most.error;
}

/* e^x - 1, for 0 <= x < 1. Of a small x, as it nearly always is, two terms are as good as libm's.
 */
static double growth(double x)
{
    return x < 0x1p-30 ? x + 0.5 * x * x : expm1(x);
}

/* How far f_r cos^2 may be off for want of knowing tan^2. With u = tan^2 known to a relative r,
   log of the glint moves by at most r (2 min(u, 1) + u / s^2), of the diffuse part by at most
   r (m + 2)/2 min(u, 1); where these are no small numbers, each part is bounded itself. Near
   edge-on (r infinite) u is at least this, and beyond the glint's peak both parts only fall. */
static double reflection_vague(const lrcs_brdf *brdf, const lrcsi_tilt *tilt,
                               const lrcsi_reflection *at)
{
    if (isinf(tilt->stretch)) {
        double most = (brdf->A > 0 ? brdf->A * glint_peak(brdf->s) : 0) + brdf->B;
        return tilt->tan2 >= 2 * brdf->s * brdf->s ? at->glint + at->diffuse : most;
    }
    double bent = lrcsi_least(tilt->tan2, 1);
    double glint = brdf->A > 0 ? tilt->stretch * (2 * bent + tilt->tan2 / brdf->s / brdf->s) : 0;
    double diffuse = tilt->stretch * (0.5 * brdf->m + 1) * bent;
    return (glint < 1 ? at->glint * growth(glint) : glint_vague(brdf, tilt)) +
           (diffuse < 1 ? at->diffuse * growth(diffuse) : brdf->B);
}

static void add_seen(total_sums *sums, const lrcs_brdf *brdf)
{
    sums->rounding += brdf->A > 0 || brdf->B > 0 ? FACET_UNDERFLOW : 0;
    sums->seen |= brdf->A > 0 ? 1u << LRCS_EFFECT_GLINT : 0u;
    sums->seen |= brdf->B > 0 ? 1u << LRCS_EFFECT_DIFFUSE : 0u;
}

/* What one facet adds, scaled. */
typedef struct total_return {
    double glint, diffuse;
} total_return;

/* Of nearly all facets the whole is visible: no quotient, then. */
static double share_of(double part, double whole)
{
    return part == whole ? 1 : part / whole;
}

static void add_doubt(total_sums *sums, double per_area, const lrcsi_visible *visible)
{
    double doubt = lrcsi_most(visible->area - visible->low, visible->high - visible->area);
    sums->visibility += per_area * doubt;
    sums->likely = lrcsi_length_flat(sums->likely, per_area * visible->likely);
    sums->lean += per_area * visible->lean;
}

/* One facet that reflects towards the laser. */
static total_return add_reflecting(total_job *job, uint32_t facet, const lrcsi_tilt *tilt,
                                   const lrcsi_visible *visible)
{
    const lrcs_prepared *p = job->view->prepared;
    total_sums *sums = &job->sums;
    reflect_facet(job, facet, tilt->tan2);
    lrcsi_reflection at = job->last.at;
    double whole = FOUR_PI * 0.5 * p->normal[facet].length;
    double share = share_of(visible->area, tilt->projected);
    double most = share_of(visible->high, tilt->projected);
    double glint = whole * at.glint * share;
    double diffuse = whole * at.diffuse * share;
    lrcsi_sum_add(&sums->glint, glint);
    lrcsi_sum_add(&sums->diffuse, diffuse);
    if (visible->low < visible->high) {
        add_doubt(sums, whole * (at.glint + at.diffuse) / tilt->projected, visible);
    }
    /* S, 4 pi, two products and the share: 8 u, with the relative error of areas */
    sums->rounding += (glint + diffuse) * (tilt->error + 8 * U) +
                      whole * most * (at.error + reflection_vague(&job->last.brdf, tilt, &at));
    add_seen(sums, &job->last.brdf);
    return (total_return){glint, diffuse};
}

/* One with curved normals, which comes summed. */
static total_return add_curved(total_job *job, uint32_t facet)
{
    const lrcsi_curved *curved = &job->curved[facet];
    total_sums *sums = &job->sums;
    lrcs_brdf brdf =
        lrcsi_plan_brdf(job->plan, lrcsi_prepared_material(job->view->prepared, facet));
    add_seen(sums, &brdf);
    lrcsi_sum_add(&sums->glint, curved->glint);
    lrcsi_sum_add(&sums->diffuse, curved->diffuse);
    sums->visibility += curved->visibility;
    sums->rounding += curved->rounding;
    sums->likely = lrcsi_length_flat(sums->likely, curved->likely);
    sums->curvature += curved->estimate;
    return (total_return){curved->glint, curved->diffuse};
}

/* Can what the facets err from the true shapes be bounded? Where nothing is searched, all that
   could be hidden is in the bound. */
static int tessellation_known(const total_job *job)
{
    int unshadowed = job->plan->unshadowed;
    return lrcsi_tessellation_known(job->view->prepared, unshadowed) &&
           (unshadowed || job->margin || job->plan->method == LRCS_METHOD_FACET);
}

/* Is only a part of the facet visible? An area computed by clipping that cannot be told from none,
   or from all, counts as that. Likewise nothing_visible. */
static int partly_visible(const lrcsi_tilt *tilt, const lrcsi_visible *visible)
{
    if (!(visible->area > 0 && visible->area < tilt->projected)) {
        return 0;
    }
    int clipped = visible->likely == 0 && visible->high - visible->low < tilt->projected;
    return !(clipped && (visible->low <= 0 || visible->high >= tilt->projected));
}

static int nothing_visible(const lrcsi_tilt *tilt, const lrcsi_visible *visible)
{
    return visible->area == 0 ||
           (visible->area < tilt->projected && visible->low <= 0 && !partly_visible(tilt, visible));
}

static void count_facet(total_job *job, int reflects, const lrcsi_tilt *tilt,
                        const lrcsi_visible *visible)
{
    lrcsi_sum_add(&job->sums.projected, visible->area);
    if (reflects) {
        job->total.hidden += nothing_visible(tilt, visible) ? 1 : 0;
        job->total.partial += partly_visible(tilt, visible) ? 1 : 0;
    } else if (visible->area > 0) {
        lrcsi_sum_add(&job->sums.back_side, visible->area);
        job->total.back_sides++;
    }
}

static lrcs_facet_record record_of(const lrcsi_view *view, uint32_t facet, const lrcsi_tilt *tilt,
                                   double visible, const total_return *sigma)
{
    const lrcs_prepared *p = view->prepared;
    lrcs_facet_record record = {0, 0, 0, 0, 0};
    if (!p->skip[facet]) {
        record.area_m2 = lrcsi_prepared_area(p, 0.5 * p->normal[facet].length);
        record.cos_theta = tilt->cos_theta;
        record.visible_area_m2 = lrcsi_prepared_area(p, visible);
        record.sigma_m2 = lrcsi_prepared_area(p, sigma->glint + sigma->diffuse);
        record.sigma_glint_m2 = lrcsi_prepared_area(p, sigma->glint);
    }
    return record;
}

/* A bound in square metres. Where that is no normal double its rounding is made up for, and that of
   the two values that it may hold for: half of 2^-1074 each. */
static double bound_area(const lrcs_prepared *p, double scaled)
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
    double outward = 1 + 1e-9 + 2 * count * U;
    total->glint = lrcsi_prepared_area(p, glint);
    total->diffuse = lrcsi_prepared_area(p, diffuse);
    total->projected = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->projected));
    total->back_side = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->back_side));
    total->visibility = bound_area(p, sums->visibility * outward);
    total->tessellation = sums->tessellation < 0 ? -1 : bound_area(p, sums->tessellation * outward);
    double adding = (glint + diffuse) * (4 * U + 3 * (count * U) * (count * U));
    total->rounding = bound_area(p, (sums->rounding + adding) * outward);
    double likely = lrcsi_length_flat(sums->likely, sums->lean);
    total->likely = fmin(lrcsi_prepared_area(p, likely), total->visibility);
    total->curvature = lrcsi_prepared_area(p, sums->curvature);
    total->seen = sums->seen;
}

/* What is visible of a facet. */
static lrcsi_visible facet_visible(const total_job *job, uint32_t facet, const lrcsi_tilt *tilt)
{
    if (job->visible) {
        return job->visible[facet];
    }
    return lrcsi_grid_casts(job->view, facet) ? lrcsi_visible_unshadowed(tilt, job->plan->graze)
                                              : (lrcsi_visible){0, 0, 0, 0, 0};
}

/* Could any of it be visible? The back sides of a closed body cannot, and cost no arithmetic. */
static int may_show(const total_job *job, uint32_t facet)
{
    return job->visible ? job->visible[facet].high > 0 : lrcsi_grid_casts(job->view, facet);
}

static double facet_tessellation(const total_job *job, uint32_t facet, const lrcsi_tilt *tilt)
{
    const lrcs_prepared *p = job->view->prepared;
    if (job->curved && lrcsi_curve_wanted(job->view, facet)) {
        return job->margin ? job->margin->share[facet] * job->curved[facet].most : 0;
    }
    lrcs_brdf brdf = lrcsi_plan_brdf(job->plan, lrcsi_prepared_material(p, facet));
    return FOUR_PI *
           lrcsi_tessellation_error(job->view, facet, &brdf, tilt, job->visible, job->margin);
}

static void sum_facet(total_job *job, uint32_t facet, const lrcsi_tilt *tilt,
                      lrcs_facet_record *record)
{
    const lrcsi_view *view = job->view;
    lrcsi_visible visible = facet_visible(job, facet, tilt);
    total_return sigma = {0, 0};
    if (view->facing[facet] != 0) {
        int reflects = lrcsi_view_reflects(view, facet);
        if (reflects && visible.high > 0) {
            sigma = job->curved && lrcsi_curve_wanted(view, facet)
                        ? add_curved(job, facet)
                        : add_reflecting(job, facet, tilt, &visible);
        }
        count_facet(job, reflects, tilt, &visible);
    }
    if (view->prepared->curved && !view->prepared->skip[facet]) {
        job->sums.tessellation += facet_tessellation(job, facet, tilt);
    }
    if (record) {
        *record = record_of(view, facet, tilt, visible.area, &sigma);
    }
}

/* The next facets in order, their incidence computed side by side. */
static void sum_facets(total_job *job, const uint32_t *facet, uint32_t count,
                       lrcs_facet_record *records)
{
    lrcsi_tilt tilt[LRCSI_TILTS];
    lrcsi_view_tilts(job->view, facet, count, tilt);
    for (uint32_t i = 0; i < count; i++) {
        sum_facet(job, facet[i], &tilt[i], records ? &records[facet[i]] : NULL);
    }
}

lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_visible *visible, const lrcsi_curved *curved,
                             const lrcsi_margin *margin, lrcs_facet_record *records)
{
    const lrcs_prepared *p = view->prepared;
    total_job job = {
        .view = view, .plan = plan, .visible = visible, .curved = curved, .margin = margin};
    if (p->curved && !tessellation_known(&job)) {
        job.sums.tessellation = -HUGE_VAL;
    }
    uint32_t facet[LRCSI_TILTS];
    uint32_t count = 0;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (p->curved || records || may_show(&job, f)) {
            facet[count++] = f;
        } else {
            job.total.hidden += lrcsi_view_reflects(view, f) ? 1 : 0;
        }
        if (count == LRCSI_TILTS) {
            sum_facets(&job, facet, count, records);
            count = 0;
        }
    }
    if (count > 0) {
        sum_facets(&job, facet, count, records);
    }
    total_finish(&job);
    return job.total;
}
