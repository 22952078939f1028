/* SPDX-License-Identifier: MIT */
/* Sine and cosine of degrees. It decides how an angle is reduced, exactly, to within 45 degrees of
   a multiple of 90, and sums the two series in double-double, or in doubles where that suffices; no
   sine of libm is used. */
#include "base/degrees.h"

#include <math.h>

/* pi/180 to 107 bits. */
static const lrcsi_dd radians_per_degree = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

/* a / b for a small integer b. The remainder of the first division is exact, so that the relative
   error is at most 4 * 2^-106. */
static lrcsi_dd dd_over_integer(lrcsi_dd a, double b)
{
    double q = a.hi / b;
    lrcsi_dd p = lrcsi_dd_two_product(q, b);
    double remainder = ((a.hi - p.hi) - p.lo) + a.lo;
    return lrcsi_dd_quick_sum(q, remainder / b);
}

/* 1 - y/(n(n+1)) (1 - y/((n+2)(n+3)) (1 - ...)), y = x^2 <= 0.62: from n = 2 this is sin(x)/x, from
   n = 1 cos(x). The first term left out, y^14 / 28!, is below 2^-107. Each level multiplies the
   error of the one inside by y/(n(n+1)) <= 0.31 and adds 15 * 2^-106: below 2^-101 in all, and the
   sum itself is at least 0.7. */
static lrcsi_dd alternating_series(lrcsi_dd y, int n)
{
    const lrcsi_dd one = {1.0, 0.0};
    lrcsi_dd sum = one;
    for (int k = n + 26; k >= n; k -= 2) {
        sum = lrcsi_dd_sub(one, dd_over_integer(lrcsi_dd_mul(y, sum), (double)k * (k + 1)));
    }
    return sum;
}

void lrcsi_degrees_sincos_dd(double deg, double addend, lrcsi_dd *sine, lrcsi_dd *cosine)
{
    lrcsi_dd sum = lrcsi_dd_two_sum(deg, addend); /* exact */
    int quarter = 0;
    double remainder = remquo(sum.hi, 90.0, &quarter); /* exact, |remainder| <= 45 */
    int quarter_lo = 0;
    double remainder_lo = remquo(sum.lo, 90.0, &quarter_lo);
    lrcsi_dd x = lrcsi_dd_two_sum(remainder, remainder_lo);
    int quarter_sum = 0;
    x.hi = remquo(x.hi, 90.0, &quarter_sum);
    x = lrcsi_dd_mul(lrcsi_dd_two_sum(x.hi, x.lo), radians_per_degree);
    lrcsi_dd y = lrcsi_dd_mul(x, x);
    lrcsi_dd s = lrcsi_dd_mul(x, alternating_series(y, 2));
    lrcsi_dd c = alternating_series(y, 1);
    /* remquo keeps the sign and at least the low three bits of the quotient: enough for mod 4. */
    unsigned quadrant = ((unsigned)quarter + (unsigned)quarter_lo + (unsigned)quarter_sum) & 3u;
    lrcsi_dd out_s = quadrant & 1u ? c : s;
    lrcsi_dd out_c = quadrant & 1u ? s : c;
    *sine = quadrant & 2u ? lrcsi_dd_negate(out_s) : out_s;
    *cosine = quadrant == 1 || quadrant == 2 ? lrcsi_dd_negate(out_c) : out_c;
}

/* The series as above. The angle has a relative error of 1.2 u, and with y <= 0.62 the terms left
   out are below 2^-60; each level halves the error of the one inside at least, and adds 2 u. */
static double plain_series(double y, int n)
{
    double sum = 1.0;
    for (int k = n + 16; k >= n; k -= 2) {
        sum = 1.0 - y / ((double)k * (k + 1)) * sum;
    }
    return sum;
}

void lrcsi_degrees_sincos_plain(double deg, double *sine, double *cosine)
{
    int quarter = 0;
    double x = remquo(deg, 90.0, &quarter) * radians_per_degree.hi;
    double s = x * plain_series(x * x, 2);
    double c = plain_series(x * x, 1);
    unsigned quadrant = (unsigned)quarter & 3u;
    double out_s = quadrant & 1u ? c : s;
    double out_c = quadrant & 1u ? s : c;
    *sine = quadrant & 2u ? -out_s : out_s;
    *cosine = quadrant == 1 || quadrant == 2 ? -out_c : out_c;
}

void lrcsi_degrees_sincos(double deg, double *sine, double *cosine)
{
    lrcsi_dd s, c;
    lrcsi_degrees_sincos_dd(deg, 0.0, &s, &c);
    *sine = lrcsi_dd_value(s) + 0.0; /* -0 becomes +0 */
    *cosine = lrcsi_dd_value(c) + 0.0;
}
