/* SPDX-License-Identifier: MIT */
/* Bounds on the deviation of F = f_r cos^2 over the normals of a curved patch from its value at the
   facet's normal: the proved tessellation error of one facet. Four numbers describe the patch
   (lrcs_patch_bounds).

   On the sphere of normals F(n) = G(theta), theta the angle between n and s_hat. Along the geodesic
   from the facet's normal by the turn vector t
       F = F_i + grad F_i . t + R,  |R| <= |t|^2/2 sup |Hess F|,
   where the eigenvalues of the Hessian are G'' and cot(theta) G'. G is once continuously
   differentiable, also across 90 deg, where it becomes 0, and its second derivative is bounded,
   which suffices here. This is integrated over the patch, per unit of facet area, with the numbers
   of lrcs_patch_bounds (a = area_err) and suprema over the angles within `turn` of theta_i:
       second   a F_i + bias |G'_i| + rms_turn^2/2 sup max(|G''|, |cot G'|)
       first    a F_i + sqrt(1 + a) rms_turn sup |G'|        (Cauchy-Schwarz on the integral of |t|)
       range    a F_i + (1 + a) max(sup G - F_i, F_i)      (inf G >= 0)
   All three bounds hold; the smallest is used. At single points |F - F_i| is at most turn sup |G'|,
   and at most max(sup G - F_i, F_i). Over any region of the patch the integral of h = F - F_i is at
   most that of its positive part or of its negative part over the whole patch: with h = g . t + R
   both are at most (Int |g . t| + |Int g . t|)/2 + Int |R|, that is
       |G'_i| (sqrt(1 + a) rms_turn + bias)/2 + rms_turn^2/2 sup max(|G''|, |cot G'|).
   If both sides of a surface reflect, F continues as G(180 deg - theta) beyond 90 deg. It is once
   continuously differentiable there too, with the same suprema; so each bound also holds if some
   points beyond 90 deg count and others do not.

   With u = tan^2 theta, w = 1 + u, E = exp(-u/s^2), nu = m + 2:
       glint/A    G = w^2 E                              G' = 2 sqrt(u) (2 w^2 - w^3/s^2) E
           cot G' = (4 w^2 - 2 w^3/s^2) E
           G'' = (4 w^3 + 16 u w^2 + 4 u w^4/s^4 - (2 w^4 + 20 u w^3)/s^2) E
       diffuse/B  G = w^(-nu/2)   G' = -nu sqrt(u) w^(-nu/2)   cot G' = -nu w^(-nu/2)
           G'' = -nu w^(-nu/2) + nu (nu - 1) u w^(-nu/2)
   A difference of positive terms is at most the greater of their sums. Each glint term
   u^a w^b E / s^(2c) is unimodal in u (its logarithm is concave in u, E included), so its supremum
   over an interval is its value at the clamped peak, the root of u^2 + (1 - (a + b) s^2) u = a s^2.
   Terms are evaluated as the exponential of a sum of logarithms, none of them above 1e4 if the
   result is in double range: the relative error is below 1e4 * 2^-50, which DEVIATION_ERR
   covers. */
#include "base/constant.h"
#include "optics/reflect.h"

#include <math.h>

#include "base/elementary.h"

#define HALF_PI_BELOW    1.57079632679489655800 /* the double below pi/2 */
#define DEVIATION_ERR    1e-10
#define DEVIATION_MARGIN (1.0 + DEVIATION_ERR)
#define EXPONENT_LOW     (-700.0)
#define DEVIATION_TINY   0x1p-1009 /* above e^-700: replaces all smaller values */
#define SLOPE_HUGE       1e75      /* for larger s the peaks are beyond all finite u that occur */

/* u = tan^2(theta), and the logarithms from which the terms are computed. They are computed at
   first use, because they are most of the work. */
typedef struct tan2_point {
    double u, log_u, log_w;
    int known;
} tan2_point;

/* An interval of u; high may be infinite. */
typedef struct tan2_range {
    tan2_point low, high;
} tan2_range;

/* Upper bounds of G, |G'| and max(|G''|, |cot G'|). */
typedef struct deviation_suprema {
    double value, slope;                 /* at the facet's normal */
    double value_max, slope_max, second; /* over the patch */
} deviation_suprema;

/* An upper bound of e^x, up to DEVIATION_MARGIN. */
static double exp_above(double x)
{
    return x < EXPONENT_LOW ? DEVIATION_TINY : lrcsi_exp(x);
}

/* a b, where 0 times infinity is 0. */
static double times(double a, double b)
{
    return a > 0.0 && b > 0.0 ? a * b : 0.0;
}

static tan2_point tan2_at(double u)
{
    return (tan2_point){u, 0.0, 0.0, 0};
}

/* Computes the logarithms, for a finite u; log_u is 0 if u is. */
static void point_logarithms(tan2_point *at)
{
    if (!at->known) {
        at->log_w = lrcsi_log1p(at->u).hi;
        at->log_u = at->u > 0.0 ? lrcsi_log(at->u).hi : 0.0;
        at->known = 1;
    }
}

/* The point of a range that is nearest to u: one of its ends, or *inside. */
static tan2_point *range_nearest(tan2_range *range, double u, tan2_point *inside)
{
    if (!(u > range->low.u)) {
        return &range->low;
    }
    if (!(u < range->high.u)) {
        return &range->high;
    }
    *inside = tan2_at(u);
    return inside;
}

/* The glint's slope, and its logarithm if it is requested. */
typedef struct glint_slope {
    double s, log_s;
} glint_slope;

/* u^a w^b exp(-u/s^2) / s^(2c) at a finite u. */
static double glint_term(double a, double b, double c, const glint_slope *slope, tan2_point *at)
{
    if (at->u == 0.0 && a > 0.0) {
        return 0.0;
    }
    point_logarithms(at);
    double x = b * at->log_w - at->u / slope->s / slope->s - 2.0 * c * slope->log_s;
    return exp_above(x + a * at->log_u);
}

/* Its supremum over a range. */
static double glint_sup(double a, double b, double c, const glint_slope *slope, tan2_range *range)
{
    double peak = HUGE_VAL;
    if (slope->s < SLOPE_HUGE) {
        double s2 = slope->s * slope->s;
        double beta = (a + b) * s2 - 1.0;
        double root = sqrt(beta * beta + 4.0 * a * s2);
        peak = beta > 0.0 ? 0.5 * (beta + root) : a > 0.0 ? 2.0 * a * s2 / (root - beta) : 0.0;
    }
    tan2_point inside;
    tan2_point *at = range_nearest(range, peak, &inside);
    return isfinite(at->u) ? glint_term(a, b, c, slope, at) : HUGE_VAL;
}

static deviation_suprema glint_suprema(double s, int front, tan2_point *at_facet, tan2_range *range)
{
    const glint_slope slope = {s, lrcsi_log(s).hi};
    deviation_suprema sup = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (front && isfinite(at_facet->u)) {
        double up = 4.0 * glint_term(0.5, 2.0, 0.0, &slope, at_facet);
        double down = 2.0 * glint_term(0.5, 3.0, 1.0, &slope, at_facet);
        double larger = fmax(up, down);
        sup.value = glint_term(0.0, 2.0, 0.0, &slope, at_facet);
        sup.slope = isfinite(larger) ? fabs(up - down) + DEVIATION_ERR * larger : larger;
    }
    sup.value_max = glint_sup(0.0, 2.0, 0.0, &slope, range);
    sup.slope_max = fmax(4.0 * glint_sup(0.5, 2.0, 0.0, &slope, range),
                         2.0 * glint_sup(0.5, 3.0, 1.0, &slope, range));
    double level = fmax(4.0 * sup.value_max, 2.0 * glint_sup(0.0, 3.0, 1.0, &slope, range));
    double up = 4.0 * glint_sup(0.0, 3.0, 0.0, &slope, range) +
                16.0 * glint_sup(1.0, 2.0, 0.0, &slope, range) +
                4.0 * glint_sup(1.0, 4.0, 2.0, &slope, range);
    double down = 2.0 * glint_sup(0.0, 4.0, 1.0, &slope, range) +
                  20.0 * glint_sup(1.0, 3.0, 1.0, &slope, range);
    sup.second = fmax(level, fmax(up, down));
    return sup;
}

/* u^a w^(-nu/2). */
static double diffuse_term(double a, double nu, tan2_point *at)
{
    if (at->u == 0.0 && a > 0.0) {
        return 0.0;
    }
    if (!isfinite(at->u)) {
        return 1.0; /* a <= 1 <= nu/2: u^a <= w^(nu/2) */
    }
    point_logarithms(at);
    return exp_above(a * at->log_u - 0.5 * nu * at->log_w);
}

/* Its supremum over a range: its peak is at u = a / (nu/2 - a), for a = 0 at 0. */
static double diffuse_sup(double a, double nu, tan2_range *range)
{
    tan2_point inside;
    double peak = a > 0.0 ? a / (0.5 * nu - a) : 0.0;
    return diffuse_term(a, nu, range_nearest(range, peak, &inside));
}

static deviation_suprema diffuse_suprema(double m, int front, tan2_point *at_facet,
                                         tan2_range *range)
{
    double nu = m + 2.0;
    deviation_suprema sup = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (front && isfinite(at_facet->u)) {
        sup.value = diffuse_term(0.0, nu, at_facet);
        sup.slope = nu * diffuse_term(0.5, nu, at_facet);
    }
    sup.value_max = diffuse_sup(0.0, nu, range);
    sup.slope_max = nu * diffuse_sup(0.5, nu, range);
    sup.second = fmax(nu * sup.value_max, nu * (nu - 1.0) * diffuse_sup(1.0, nu, range));
    return sup;
}

static void suprema_add(deviation_suprema *sum, double amplitude, const deviation_suprema *term)
{
    sum->value += times(amplitude, term->value);
    sum->slope += times(amplitude, term->slope);
    sum->value_max += times(amplitude, term->value_max);
    sum->slope_max += times(amplitude, term->slope_max);
    sum->second += times(amplitude, term->second);
}

/* tan^2 over the angles within `turn` of theta that face the laser; 0 if none does. */
static int range_around(double theta, double turn, tan2_range *range)
{
    /* rounding: of theta, an arctangent of a root, and of the sums; then of tan and its square */
    double slack = 8.0 * LRCSI_U * (theta + turn);
    double low = theta - turn - slack;
    double high = theta + turn + slack;
    if (low > HALF_PI_BELOW) {
        return 0;
    }
    double tan_low = low > 0.0 ? tan(low) : 0.0;
    double tan_high = high < HALF_PI_BELOW ? tan(high) : HUGE_VAL;
    range->low = tan2_at(tan_low * tan_low * (1.0 - 8.0 * LRCSI_U));
    range->high = tan2_at(tan_high * tan_high * (1.0 + 8.0 * LRCSI_U));
    return 1;
}

/* The smallest of the three bounds, and the other bounds. */
static lrcsi_deviation deviation_of(const deviation_suprema *all, const lrcs_patch_bounds *c)
{
    double second =
        times(c->bias, all->slope) + times(0.5 * c->rms_turn * c->rms_turn, all->second);
    double first = times(c->rms_turn * sqrt(1.0 + c->area_err), all->slope_max);
    double range = fmax(all->value_max - all->value, all->value);
    double slope = times(c->turn, all->slope_max);
    double region = 0.5 * times(c->rms_turn * sqrt(1.0 + c->area_err) + c->bias, all->slope) +
                    times(0.5 * c->rms_turn * c->rms_turn, all->second);
    double least = fmin(second, first);
    double point = slope;
    if (isfinite(all->value_max)) {
        least = fmin(least, times(1.0 + c->area_err, range));
        point = fmin(slope, range);
    }
    return (lrcsi_deviation){(times(c->area_err, all->value) + least) * DEVIATION_MARGIN,
                             point * DEVIATION_MARGIN,
                             fmin(region, times(1.0 + c->area_err, point)) * DEVIATION_MARGIN,
                             all->value * DEVIATION_MARGIN,
                             all->value_max * DEVIATION_MARGIN,
                             all->second * DEVIATION_MARGIN};
}

lrcsi_deviation lrcsi_deviation_make(const lrcs_brdf *brdf, double cos_theta, double tan2,
                                     const lrcs_patch_bounds *bounds)
{
    /* below -sin(turn), with room for the error of cos_theta: all of the patch faces away */
    if (cos_theta < -(bounds->turn + 0x1p-40)) {
        return (lrcsi_deviation){0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    }
    int front = cos_theta > 0.0;
    double angle = atan(sqrt(tan2));
    tan2_range range;
    if (!range_around(front ? angle : 2.0 * HALF_PI_BELOW - angle, bounds->turn, &range)) {
        return (lrcsi_deviation){0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    }
    tan2_point at_facet = tan2_at(tan2);
    deviation_suprema all = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (brdf->A > 0.0) {
        deviation_suprema term = glint_suprema(brdf->s, front, &at_facet, &range);
        suprema_add(&all, brdf->A, &term);
    }
    if (brdf->B > 0.0) {
        deviation_suprema term = diffuse_suprema(brdf->m, front, &at_facet, &range);
        suprema_add(&all, brdf->B, &term);
    }
    return deviation_of(&all, bounds);
}

double lrcsi_reflect_deviation(const lrcs_brdf *brdf, double cos_theta, double tan2,
                               const lrcs_patch_bounds *bounds)
{
    const lrcs_patch_bounds *c = bounds;
    if (c->turn == 0.0 && c->area_err == 0.0 && c->bias == 0.0 && c->rms_turn == 0.0) {
        return 0.0;
    }
    return lrcsi_deviation_make(brdf, cos_theta, tan2, bounds).whole;
}

/* f_r cos is w^(5/2) E, one of the glint terms, and w^(-(m+1)/2), which decreases. */
lrcsi_reflection lrcsi_reflect_bound(const lrcs_brdf *brdf, double theta, double turn)
{
    lrcsi_reflection bound = {0.0, 0.0, 0.0};
    tan2_range range;
    if (!range_around(theta, turn, &range)) {
        return bound;
    }
    if (brdf->A > 0.0) {
        const glint_slope slope = {brdf->s, 0.0}; /* a term with c = 0 needs no logarithm */
        bound.glint = brdf->A * glint_sup(0.0, 2.5, 0.0, &slope, &range) * DEVIATION_MARGIN;
    }
    if (brdf->B > 0.0) {
        bound.diffuse = brdf->B * diffuse_sup(0.0, brdf->m + 1.0, &range) * DEVIATION_MARGIN;
    }
    return bound;
}
