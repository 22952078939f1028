/* SPDX-License-Identifier: MIT */
/* One quadrature for every integral without a closed form: Gauss-Legendre on panels that halve
   towards both ends. It decides how finely an end is graded; what is integrated, the samples say.

   Truncation. All singularities of the integrands lie at an end, behind it, or on the imaginary
   axis through it, and every peak stands at an end or is as wide as its distance from one. On a
   panel [h/2, h] such a function is analytic inside the ellipse with foci at the panel's ends that
   reaches to rho = 2.2 (the one through the end itself has rho = 5.8), and there |F| is bounded by
   its own size on the axis: arguments stay within 18 degrees, where exp(-z^2), z^nu and
   exp(-1/z^4) all decay. Gauss's rule of n = 24 points then errs by at most
   (64/15) M rho^(-2n) / (1 - rho^-2) (Trefethen 2008, Theorem 4.5), 2e-16 M per unit of length; M
   is the size that the panels on the axis carry. The last panel at an end is one over which F
   changes by less than a factor e and the rest is smooth, or one that holds less than 2^-40 of the
   integral, in which an algebraic end is still summed to 1e-4.

   Rounding. Values are positive, their sums compensated: q to 4 units, which the exponent E of
   exp(-E) multiplies by at most 4 E, and E averages below 3 where F counts; with the powers, 40
   units in all. */
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

lrcsi_arc_law lrcsi_arc_law_make(const lrcs_brdf *brdf, int part, double cos_reference)
{
    double slope = brdf->s * cos_reference;
    lrcsi_arc_law law = {part, part == LRCSI_GLINT ? 1.0 / slope / slope : 0.0, brdf->m + 2.0};
    return law;
}

lrcsi_arc_sample lrcsi_arc_law_sample(const lrcsi_arc_law *law, double y, double q)
{
    lrcsi_arc_sample sample = {0.0, q, HUGE_VAL, 1};
    if (!(q > 0.0)) {
        return sample;
    }
    if (law->part == LRCSI_GLINT) {
        double decay = y * (2.0 - y) * law->gain / q / q;
        sample.falling = q * q <= 0.5 * law->gain; /* the peak of c^-4 exp(-1/(s c)^2) */
        if (decay < ARC_DARK) {
            double q2 = q * q;
            sample.decay = decay;
            sample.value = exp(-decay) / (q2 * q2);
        }
    } else {
        double decay = law->nu * (y < 0.5 ? -log1p(-y) : -log(q));
        if (decay < ARC_DARK) {
            sample.decay = decay;
            sample.value = exp(-decay);
        }
    }
    return sample;
}

static lrcsi_arc_sample arc_sample(const lrcsi_arc *arc, int right, double d)
{
    return arc->is_cap ? lrcsi_cap_sample(arc, right, d) : lrcsi_ring_sample(arc, right, d);
}

/* sum += the integral over distances [low, high] from an end. */
static void arc_add_panel(const lrcsi_arc *arc, int right, double low, double high, lrcsi_dd *sum)
{
    double half = 0.5 * (high - low);
    double middle = low + half;
    for (int i = 0; i < LRCSI_GAUSS_PAIRS; i++) {
        double step = half * lrcsi_gauss_rule[i][0];
        double pair = arc_sample(arc, right, middle - step).value +
                      arc_sample(arc, right, middle + step).value;
        lrcsi_dd next = lrcsi_dd_two_sum(sum->hi, lrcsi_gauss_rule[i][1] * half * pair);
        *sum = (lrcsi_dd){next.hi, sum->lo + next.lo};
    }
}

/* Is [0, h] at an end fit to be the last panel, `sum` having been gathered outside it? Towards the
   left end F grows, so it must have come within a factor e; towards the right it may fall for good,
   or hardly change. */
static int arc_ends(const lrcsi_arc *arc, int right, double h, double sum)
{
    double clear = right ? arc->right_clear : arc->left_clear;
    lrcsi_arc_sample at = arc_sample(arc, right, h);
    if (!right) {
        return at.decay <= 1.0 &&
               (h <= clear || (h <= arc->grain && h * at.value <= ARC_SMALL * sum));
    }
    lrcsi_arc_sample end = arc_sample(arc, right, 0.0);
    int level = end.decay - at.decay <= 1.0 && end.q >= 0.5 * at.q;
    if (h <= clear) {
        return level || (at.falling && h * at.value <= 0x1p-60 * sum);
    }
    return h <= arc->grain && (level || at.falling) && h * at.value <= ARC_SMALL * sum;
}

static void arc_add_half(const lrcsi_arc *arc, int right, lrcsi_dd *sum)
{
    double h = 0.5 * arc->length;
    for (int i = 0; i < ARC_PANELS && !arc_ends(arc, right, h, sum->hi); i++) {
        arc_add_panel(arc, right, 0.5 * h, h, sum);
        h *= 0.5;
    }
    arc_add_panel(arc, right, 0.0, h, sum);
}

double lrcsi_arc_integral(const lrcsi_arc *arc)
{
    lrcsi_dd sum = {0.0, 0.0};
    if (arc->length > 0.0) {
        arc_add_half(arc, 0, &sum);
        arc_add_half(arc, 1, &sum);
    }
    return lrcsi_dd_value(sum);
}
