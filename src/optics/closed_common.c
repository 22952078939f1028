/* SPDX-License-Identifier: MIT */
/* Angles in double-double, and F at such an angle. closed.c decides what is summed. */
#include <math.h>

#include "base/constant.h"
#include "optics/closed.h"

/* Square root with one Newton step. */
static lrcsi_dd closed_root(lrcsi_dd a)
{
    if (!(a.hi > 0.0)) {
        return (lrcsi_dd){0.0, 0.0};
    }
    double r = sqrt(a.hi);
    lrcsi_dd residual = lrcsi_dd_sub(a, lrcsi_dd_two_product(r, r));
    return lrcsi_dd_quick_sum(r, residual.hi / (2.0 * r));
}

static lrcsi_dd closed_shift(lrcsi_dd a, int shift)
{
    return (lrcsi_dd){scalbn(a.hi, shift), scalbn(a.lo, shift)};
}

lrcsi_dd lrcsi_closed_hypot(lrcsi_dd a, lrcsi_dd b)
{
    double largest = fmax(fabs(a.hi), fabs(b.hi));
    int shift = largest > 0.0 ? -ilogb(largest) : 0;
    a = closed_shift(a, shift);
    b = closed_shift(b, shift);
    return closed_shift(closed_root(lrcsi_dd_add(lrcsi_dd_mul(a, a), lrcsi_dd_mul(b, b))), -shift);
}

lrcsi_angle lrcsi_closed_angle_sum(lrcsi_angle a, lrcsi_angle b)
{
    lrcsi_angle sum = {
        lrcsi_dd_add(lrcsi_dd_mul(a.sine, b.cosine), lrcsi_dd_mul(a.cosine, b.sine)),
        lrcsi_dd_sub(lrcsi_dd_mul(a.cosine, b.cosine), lrcsi_dd_mul(a.sine, b.sine))};
    return sum;
}

lrcsi_angle lrcsi_closed_angle_difference(lrcsi_angle a, lrcsi_angle b)
{
    b.sine = lrcsi_dd_negate(b.sine);
    return lrcsi_closed_angle_sum(a, b);
}

double lrcsi_closed_radians(lrcsi_angle a)
{
    return atan2(a.sine.hi, a.cosine.hi);
}

/* tan^2 of an angle with a positive cosine; infinite if it overflows. */
static lrcsi_dd closed_tan2(lrcsi_angle theta)
{
    lrcsi_dd tangent = lrcsi_dd_div(theta.sine, theta.cosine);
    if (fabs(tangent.hi) < 0x1p490) {
        return lrcsi_dd_mul(tangent, tangent);
    }
    return (lrcsi_dd){tangent.hi * tangent.hi, 0.0};
}

/* tan^2 = hi + lo; lrcsi_reflect takes hi, and lo enters to first order by d log F / d log u =
   2u/(1+u) - u/s^2 and -(m/2 + 1) u/(1+u): |lo/hi| <= 2^-53, and unless F has underflowed the
   derivative is below 3000, so the second order is below 2^-83. */
lrcsi_term_integrals lrcsi_closed_reflect(const lrcs_brdf *brdf, lrcsi_angle theta)
{
    lrcsi_term_integrals out = {{0.0, 0.0}, {0.0, 0.0}};
    lrcsi_dd u = theta.cosine.hi > 0.0 ? closed_tan2(theta) : (lrcsi_dd){HUGE_VAL, 0.0};
    if (!isfinite(u.hi)) {
        return out;
    }
    double change = u.hi > 0.0 ? u.lo / u.hi : 0.0;
    double sine2 = u.hi / (1.0 + u.hi); /* sin^2(theta) */
    lrcs_brdf glint = {brdf->A, 0.0, brdf->s, 0.0};
    lrcsi_reflection r = lrcsi_reflect(&glint, u.hi, 0.0);
    double log_slope = r.glint > 0.0 ? 2.0 * sine2 - u.hi / brdf->s / brdf->s : 0.0;
    out.value[LRCSI_GLINT] = r.glint * (1.0 + log_slope * change);
    out.error[LRCSI_GLINT] = r.error + 2.0 * LRCSI_U * out.value[LRCSI_GLINT];
    lrcs_brdf diffuse = {0.0, brdf->B, 0.0, brdf->m};
    r = lrcsi_reflect(&diffuse, u.hi, 0.0);
    log_slope = r.diffuse > 0.0 ? -(0.5 * brdf->m + 1.0) * sine2 : 0.0;
    out.value[LRCSI_DIFFUSE] = r.diffuse * (1.0 + log_slope * change);
    out.error[LRCSI_DIFFUSE] = r.error + 2.0 * LRCSI_U * out.value[LRCSI_DIFFUSE];
    return out;
}

void lrcsi_closed_scale_terms(lrcsi_term_integrals *amount, const double factor[LRCSI_TERMS],
                              double units)
{
    for (int term = 0; term < LRCSI_TERMS; term++) {
        /* a term that is exactly 0 stays 0 for every factor */
        if (amount->error[term] > 0.0) {
            double before = amount->value[term];
            double after = before * factor[term];
            amount->value[term] = after;
            amount->error[term] = amount->error[term] * factor[term] * (1.0 + 0x1p-40) +
                                  (units + 1.0) * LRCSI_U * after;
            amount->error[term] += factor[term] > 0.0 ? 0x1p-1070 * before : 0.0;
        }
    }
}

void lrcsi_closed_scale(lrcsi_term_integrals *amount, double factor, double units)
{
    const double both[LRCSI_TERMS] = {factor, factor};
    lrcsi_closed_scale_terms(amount, both, units);
}

void lrcsi_closed_add(lrcsi_term_integrals *sum, const lrcsi_term_integrals *amount)
{
    for (int term = 0; term < LRCSI_TERMS; term++) {
        sum->value[term] += amount->value[term];
        sum->error[term] += amount->error[term] + LRCSI_U * sum->value[term];
    }
}
