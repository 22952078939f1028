/* SPDX-License-Identifier: MIT */
/* The terms of one facet: 4 pi S f times the visible fraction, f = f_r cos^2, and a bound on their
   rounding error. f is that of the facet's normal, or its mean over the patch that the facet
   represents (integrate/wall/patch.h). integrate/sum/total_facet.c adds the terms up; most facets
   are evaluated in packets instead (integrate/sum/total_packet.c). */
#include "integrate/sum/facet_terms.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"
#include "integrate/sum/areas.h"
#include "optics/reflect.h"

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

/* The largest value of the glint. */
static double glint_peak(const lrcs_brdf *brdf)
{
    double root = brdf->A > 0 ? lrcsi_reflect_glint_root(brdf->s) : 0;
    return brdf->A * root * root;
}

/* A bound on the error of the glint where the relative error of tan^2 is too large for a linear
   approximation. Beyond the peak (at 2 s^2 - 1) the glint decreases, so the true and the computed
   value both lie between 0 and the glint at the lower bound of tan^2. */
static double glint_uncertainty(const lrcs_brdf *brdf, const lrcsi_incidence *incidence)
{
    double lower = incidence->tan2 * (1 - 2 * incidence->tan2_err);
    if (!(lower >= 2 * brdf->s * brdf->s)) {
        return glint_peak(brdf);
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
        double highest = glint_peak(brdf) + brdf->B;
        return incidence->tan2 >= 2 * brdf->s * brdf->s ? at->glint + at->diffuse : highest;
    }
    double u_or_1 = lrcsi_min(incidence->tan2, 1);
    double glint =
        brdf->A > 0 ? incidence->tan2_err * (2 * u_or_1 + incidence->tan2 / brdf->s / brdf->s) : 0;
    double diffuse = incidence->tan2_err * (0.5 * brdf->m + 1) * u_or_1;
    return (glint < 1 ? at->glint * exp_minus_1_bound(glint) : glint_uncertainty(brdf, incidence)) +
           (diffuse < 1 ? at->diffuse * exp_minus_1_bound(diffuse) : brdf->B);
}

/* The reflectance is the mean over the facet's patch if it represents a part of a curved wall, else
   that of its normal. Rounding: S, 4 pi, two products and the fraction, 8 u; the relative error of
   areas; and the error of f_r cos^2, times the upper bound of the visible area. */
lrcsi_facet_terms lrcsi_facet_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t facet, const lrcsi_incidence *incidence,
                                         const lrcsi_visible_area *visible, lrcsi_patches *patches)
{
    const lrcs_prepared *p = view->prepared;
    lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, facet));
    lrcsi_reflection at;
    double uncertainty = 0;
    const lrcsi_patch *patch = lrcsi_patch_make(view, plan, &brdf, facet, patches);
    if (patch) {
        at = (lrcsi_reflection){patch->glint, patch->diffuse, patch->rounding};
    } else {
        at = reflection_planned(&brdf, plan, incidence->tan2);
        uncertainty = reflection_uncertainty(&brdf, incidence, &at);
    }
    double four_pi_s = LRCS_FOUR_PI * 0.5 * p->normal[facet].length;
    double fraction = lrcsi_areas_fraction(visible->area, incidence->projected);
    double fraction_high = lrcsi_areas_fraction(visible->high, incidence->projected);
    lrcsi_facet_terms terms = {.glint = four_pi_s * at.glint * fraction,
                               .diffuse = four_pi_s * at.diffuse * fraction};
    terms.rounding = (terms.glint + terms.diffuse) * (incidence->error + 8 * LRCSI_U) +
                     four_pi_s * fraction_high * (at.error + uncertainty) +
                     (brdf.A > 0 || brdf.B > 0 ? LRCSI_FACET_UNDERFLOW : 0);
    terms.per_area = four_pi_s * (at.glint + at.diffuse) / incidence->projected;
    return terms;
}
