/* SPDX-License-Identifier: MIT */
/* One quadrature for every integral without a closed form: Gauss-Legendre on panels that halve
   towards both ends. It decides how finely the panels at an end are graded; the samples define the
   integrand.

   Truncation. All singularities of the integrands are at an end, beyond it, or on the line through
   it parallel to the imaginary axis, and every peak is at an end or is as wide as its distance from
   one. So on a panel [h/2, h] an integrand is analytic inside the ellipse with foci at the panel's
   ends and rho = 2.2 (the ellipse through the end of the arc has rho = 5.8), and there |F| is at
   most its size on the axis: arguments stay within 18 degrees, where exp(-z^2), z^nu and
   exp(-1/z^4) all decay. Gauss's rule of n = 24 points then has an error of at most
   (64/15) M rho^(-2n) / (1 - rho^-2) (Trefethen 2008, Theorem 4.5), 2e-16 M per unit of length,
   where M is the magnitude of F on the panel. The last panel at an end is one over which F changes
   by less than a factor e and the rest is smooth, or one that holds less than 2^-40 of the
   integral, in which an algebraic end is still summed to 1e-4.
   A left end with a square root (`left_root`): the last panel [0, h] is summed in x, x^2 = d. There
   the integrand is analytic in x inside the ellipse that reaches to rho = 5.8, |d| < 4 h, since no
   other singularity is nearer than h / 0.15 (CAP_SMOOTH_LEFT, closed_cap.c). From 0 to h F falls by
   at most a factor e. tan^2 and -log(cos) have positive Taylor coefficients and grow by a factor
   below 40 from h to 4 h; so inside the ellipse F changes by at most a factor exp(40), and the
   error is exp(40) rho^(-48), about 1e-19.

   Rounding. Values are positive, and their sums compensated. q is accurate to 4 units, which the
   exponent E of exp(-E) multiplies by at most 4 E; E is below 3 on average where F is not
   negligible. With the powers the error is 40 units in all. */
#include "optics/closed_arc.h"

#include <math.h>

#define ARC_PANELS 1100 /* halvings of a double before it underflows */
#define ARC_SMALL  0x1p-40
#define ARC_DARK   800.0 /* exp(-800) (its exponent)^2 is below 2^-1100 of the peak */

const double lrcsi_gauss_rule[LRCSI_GAUSS_PAIRS][2] = {
    {0x1.0660853eda2e8p-4, 0x1.060475e763736p-3}, {0x1.8769542b94f8dp-3, 0x1.01b7117cf8bd8p-3},
    {0x1.429a8c588e910p-2, 0x1.f25cbce1d1ff6p-4}, {0x1.bc345d81e24b5p-2, 0x1.d91c78acb1b2dp-4},
    {0x1.17417bac4d72bp-1, 0x1.b8177ba4a68dcp-4}, {0x1.4bd2ee5fa1086p-1, 0x1.8fd8936444b16p-4},
    {0x1.7af18edb9ddd6p-1, 0x1.6108ef504463ap-4}, {0x1.a3d74ce0d3700p-1, 0x1.2c6d5c2eff064p-4},
    {0x1.c5d841864d0f5p-1, 0x1.e5c6255d25edap-5}, {0x1.e06585a70aa4dp-1, 0x1.6ab884f57c979p-5},
    {0x1.f30f9f0cbf876p-1, 0x1.d375514486f1dp-6}, {0x1.fd892de691982p-1, 0x1.9465bd3112202p-7},
};

lrcsi_arc_integrand lrcsi_arc_integrand_make(const lrcs_brdf *brdf, int term, double cos_reference)
{
    double slope = brdf->s * cos_reference;
    lrcsi_arc_integrand integrand = {term, term == LRCSI_GLINT ? 1.0 / slope / slope : 0.0,
                                     brdf->m + 2.0};
    return integrand;
}

/* F of one term at a point: its value; the exponent by which it has fallen from its reference
   (infinity if it is 0); and whether it decreases monotonically with q from here on. */
typedef struct arc_sample {
    double value, decay;
    int falling;
} arc_sample;

static arc_sample law_sample(const lrcsi_arc_integrand *integrand, const lrcsi_arc_point *at)
{
    arc_sample sample = {0.0, HUGE_VAL, 1};
    double q = at->q;
    if (!(q > 0.0)) {
        return sample;
    }
    if (integrand->term == LRCSI_GLINT) {
        double decay = at->y * (2.0 - at->y) * integrand->gain / q / q;
        sample.falling = q * q <= 0.5 * integrand->gain; /* the peak of c^-4 exp(-1/(s c)^2) */
        if (decay < ARC_DARK) {
            double q2 = q * q;
            sample.decay = decay;
            sample.value = exp(-decay) / (q2 * q2) * at->weight;
        }
    } else {
        double decay = integrand->nu * (at->y < 0.5 ? -log1p(-at->y) : -log(q));
        if (decay < ARC_DARK) {
            sample.decay = decay;
            sample.value = exp(-decay) * at->weight;
        }
    }
    return sample;
}

static lrcsi_arc_point arc_point(const lrcsi_arc *arc, int right, double d)
{
    return arc->is_cap ? lrcsi_cap_point(arc, right, d) : lrcsi_circle_point(arc, right, d);
}

/* sum[term] += width times F at that distance from an end. */
static void arc_add_point(const lrcsi_arc *arc, int right, double d, double width, lrcsi_dd *sum)
{
    lrcsi_arc_point at = arc_point(arc, right, d);
    for (int term = 0; term < LRCSI_TERMS; term++) {
        if (arc->requested[term]) {
            double value = width * law_sample(&arc->integrand[term], &at).value;
            lrcsi_dd next = lrcsi_dd_two_sum(sum[term].hi, value);
            sum[term] = (lrcsi_dd){next.hi, sum[term].lo + next.lo};
        }
    }
}

/* sum += the integrals over distances [low, high] from an end. */
static void arc_add_panel(const lrcsi_arc *arc, int right, double low, double high, lrcsi_dd *sum)
{
    double half = 0.5 * (high - low);
    double middle = low + half;
    for (int i = 0; i < 2 * LRCSI_GAUSS_PAIRS; i++) {
        const double *rule = lrcsi_gauss_rule[i / 2];
        double step = i % 2 ? half : -half;
        arc_add_point(arc, right, middle + step * rule[0], rule[1] * half, sum);
    }
}

/* May [0, h] at an end be the last panel, given `sum`, the integrals outside it? Towards the left
   end F grows, so it must be within a factor e of its end value; towards the right end it must
   decrease monotonically or hardly change. */
static int arc_ends(const lrcsi_arc *arc, int right, double h, const lrcsi_dd *sum)
{
    double smooth = right ? arc->right_smooth : arc->left_smooth;
    lrcsi_arc_point point = arc_point(arc, right, h);
    lrcsi_arc_point last = right ? arc_point(arc, right, 0.0) : point;
    int ends = 1;
    for (int term = 0; term < LRCSI_TERMS && ends; term++) {
        if (!arc->requested[term]) {
            continue;
        }
        arc_sample at = law_sample(&arc->integrand[term], &point);
        int negligible = h <= arc->weight_scale && h * at.value <= ARC_SMALL * sum[term].hi;
        if (!right) {
            ends = at.decay <= 1.0 && (h <= smooth || negligible);
            continue;
        }
        arc_sample end = law_sample(&arc->integrand[term], &last);
        int level = end.decay - at.decay <= 1.0 && last.q >= 0.5 * point.q;
        ends = h <= smooth ? level || (at.falling && h * at.value <= 0x1p-60 * sum[term].hi)
                           : (level || at.falling) && negligible;
    }
    return ends;
}

/* Panels from the middle of the arc to one of its ends. At a left end with a root the last panel
   [0, h] is summed in x, x^2 = d. */
static void arc_add_half(const lrcsi_arc *arc, int right, lrcsi_dd *sum)
{
    double h = 0.5 * arc->length;
    for (int i = 0; i < ARC_PANELS && !arc_ends(arc, right, h, sum); i++) {
        arc_add_panel(arc, right, 0.5 * h, h, sum);
        h *= 0.5;
    }
    if (right || !arc->left_root) {
        arc_add_panel(arc, right, 0.0, h, sum);
        return;
    }
    double half = 0.5 * sqrt(h);
    for (int i = 0; i < 2 * LRCSI_GAUSS_PAIRS; i++) {
        const double *rule = lrcsi_gauss_rule[i / 2];
        double x = half + (i % 2 ? half : -half) * rule[0];
        arc_add_point(arc, 0, x * x, rule[1] * half * 2.0 * x, sum);
    }
}

void lrcsi_arc_integral(const lrcsi_arc *arc, double integral[LRCSI_TERMS])
{
    lrcsi_dd sum[LRCSI_TERMS] = {{0.0, 0.0}, {0.0, 0.0}};
    if (arc->length > 0.0) {
        arc_add_half(arc, 0, sum);
        arc_add_half(arc, 1, sum);
    }
    for (int term = 0; term < LRCSI_TERMS; term++) {
        integral[term] = lrcsi_dd_value(sum[term]);
    }
}
