/* SPDX-License-Identifier: MIT */
/* Exponential and logarithm. Argument reduction after Cody and Waite (1980), then Taylor series,
   whose coefficients need no derivation. Doubles are converted to integers and back through their
   bits, because vector units without AVX-512 have no such conversion.

   ln 2 = LN2_HIGH + LN2_LOW within 2^-86. LN2_HIGH has 32 bits: k LN2_HIGH is exact for |k| <= 2^11
   and a multiple of 2^-32.

   Exponential: x = k ln 2 + r, k the integer nearest to x / ln 2 up to rounding: |r| <= 0.34658.
   x - k LN2_HIGH is exact (0 for k = 0; else |x| > 0.34, so both are multiples of 2^-54 or larger,
   and their difference is below 0.347). Absolute errors of e^r, in units of u:
     r       k LN2_LOW: 1e-6; subtracting it: |r| <= 0.35; times e^r
     P(r)    of 1/2 + r/6 + ... + r^11/13!, below 0.57: 2 relative units, mostly the last sum's
     r^2 P   two products more: 4 relative units of at most 0.069: 0.28
     + r     below 0.42: 0.25
     + 1     1 above 1, 0.5 below
     series  r^14/14! and beyond: 0.04
   Relative to e^r >= 0.7071: below 1, 0.35 + (0.28 + 0.25 + 0.5 + 0.04) / 0.7071 = 1.9; above it,
   0.35 + 0.28 + 0.25 + 1 + 0.04 = 1.92. Scaling by 2^k is exact. LRCSI_EXP_ERROR is 2.

   Logarithm: x = 2^k f with f in [sqrt(1/2), sqrt(2)), s = (f - 1)/(f + 1), |s| <= 0.17158,
   z = s^2 <= 0.02944, log(f) = 2 s + s z Q(z), Q = 2/3 + 2 z/5 + ... + 2 z^9/21. f - 1 is exact.
   The remainder of the series, 2 s z^11/23 (1 + ...), is below 2^-59 of 2 s.
   Double-double: the quotient of f - 1 and f + 1 = b + b' exactly, with its remainder, is accurate
   to 2^-100; s z Q to 10 relative units (s, z, Q and products), and it is at most 0.01 of log(f):
   0.1. The terms added to it (k LN2_LOW, and the rounding error of 2 s + k LN2_HIGH) are below it
   or below 2^-31 |k|: three sums of at most 0.01 each. |log x| >= 0.34 for k != 0: below 0.15 in
   all. Lanes: s to 2 units (b' left out), 2 s + s z Q to 3.1; k LN2_LOW and that sum: 0.35
   absolute; the sum with k LN2_HIGH 1 relative: for k = 0, 3.1 + 1; else |log(f)| <= 0.34658 <=
   |log x|: 3.1 + 1.1 + 1. LRCSI_LOG_LANES_ERROR is 6. */
#include "base/elementary.h"

#include <math.h>

#include "base/bits.h"

#define LOG2_E   0x1.71547652b82fep+0
#define LN2_HIGH 0x1.62e42ff000000p-1
#define LN2_LOW  (-0x1.718432a1b0e26p-35)

/* Adding it to a number rounds that to an integer, which then occupies the lowest bits. */
#define ROUND_TO_INTEGER 0x1.8p52

/* e^x for |x| <= 708. */
static inline double exp_reduced(double x)
{
    double shifted = x * LOG2_E + ROUND_TO_INTEGER;
    double k = shifted - ROUND_TO_INTEGER;
    double r = (x - k * LN2_HIGH) - k * LN2_LOW;
    double p = 1.0 / 6227020800.0;
    p = p * r + 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = 1.0 + (r + r * r * p);
    return p * lrcsi_bits_double((lrcsi_bits_of(shifted) + 1023) << 52);
}

/* Near the ends of the range of doubles the power of two might not be representable; there the
   result is e^(x/2) squared. x/2 is exact unless x is subnormal. */
double lrcsi_exp(double x)
{
    if (x >= -700.0 && x <= 700.0) {
        return exp_reduced(x);
    }
    if (x < -746.0) {
        return 0.0;
    }
    double root = exp_reduced(0.5 * (x < 710.0 ? x : 710.0));
    return root * root;
}

/* 1 + x.lo, |x.lo| <= 2^-43, and the product: 1 unit and 2^-34. */
double lrcsi_exp_dd(lrcsi_dd x)
{
    double e = lrcsi_exp(x.hi);
    return e > 0.0 && e < HUGE_VAL ? e + e * x.lo : e;
}

/* x = 2^k f, normal. */
static inline double log_reduced(double x, double *k)
{
    uint64_t above = lrcsi_bits_of(x) - UINT64_C(0x3fe6a09e667f3bcd); /* sqrt(1/2) */
    uint64_t biased = (above >> 52 & 0xfff) ^ 0x800;                  /* k + 2048 */
    *k = lrcsi_bits_double(UINT64_C(0x4330000000000000) | biased) - (0x1p52 + 2048.0);
    return lrcsi_bits_double(lrcsi_bits_of(x) - (above & UINT64_C(0xfff0000000000000)));
}

/* Q(z). */
static inline double log_series(double z)
{
    double q = 2.0 / 21.0;
    q = q * z + 2.0 / 19.0;
    q = q * z + 2.0 / 17.0;
    q = q * z + 2.0 / 15.0;
    q = q * z + 2.0 / 13.0;
    q = q * z + 2.0 / 11.0;
    q = q * z + 2.0 / 9.0;
    q = q * z + 2.0 / 7.0;
    q = q * z + 2.0 / 5.0;
    return q * z + 2.0 / 3.0;
}

lrcsi_dd lrcsi_log(double x)
{
    double scale = x < 0x1p-1000 ? 54.0 : 0.0;
    double k;
    double f = log_reduced(scale > 0.0 ? x * 0x1p54 : x, &k);
    k -= scale;
    double a = f - 1.0;
    lrcsi_dd b = lrcsi_dd_two_sum(f, 1.0);
    double s = a / b.hi;
    lrcsi_dd product = lrcsi_dd_two_product(s, b.hi);
    double s_low = (((a - product.hi) - product.lo) - s * b.lo) / b.hi; /* (f-1)/(f+1) - s */
    lrcsi_dd high = lrcsi_dd_two_sum(k * LN2_HIGH, 2.0 * s);
    double low = high.lo + (k * LN2_LOW + (2.0 * s_low + s * (s * s) * log_series(s * s)));
    return lrcsi_dd_quick_sum(high.hi, low);
}

/* 1 + u = w + w' exactly, |w'| <= v w with v = 2^-53. Beside log(w), log(1 + w'/w) is w'/w less
   half its square, at most v^2 / 2, and the quotient is rounded by at most v^2 / 2: v^2 in all,
   which is one unit relative to log(1 + u) >= v. Or w = 1 and w' = u <= v: then only half the
   square is lost, half a unit. */
lrcsi_dd lrcsi_log1p(double u)
{
    lrcsi_dd w = lrcsi_dd_two_sum(1.0, u);
    lrcsi_dd log = lrcsi_log(w.hi);
    return lrcsi_dd_quick_sum(log.hi, log.lo + w.lo / w.hi);
}

/* The product is exact except for y times the low part, u^2 of it. The scale is exact, and keeps
   the product in range. */
double lrcsi_power(lrcsi_dd log, double y)
{
    if (!(fabs(y * log.hi) < 800.0)) {
        return y * log.hi > 0.0 ? HUGE_VAL : 0.0;
    }
    double scale = fabs(y) > 0x1p500 ? 0x1p-300 : 1.0;
    lrcsi_dd power = lrcsi_dd_two_product(y * scale, log.hi / scale);
    return lrcsi_exp_dd((lrcsi_dd){power.hi, power.lo + y * log.lo});
}

void lrcsi_exp_lanes(const double x[LRCSI_LANES], double out[restrict LRCSI_LANES])
{
    for (int i = 0; i < LRCSI_LANES; i++) {
        out[i] = exp_reduced(x[i]);
    }
}

void lrcsi_log_lanes(const double x[LRCSI_LANES], double out[restrict LRCSI_LANES])
{
    for (int i = 0; i < LRCSI_LANES; i++) {
        double k;
        double f = log_reduced(x[i], &k);
        double s = (f - 1.0) / (f + 1.0);
        double z = s * s;
        out[i] = k * LN2_HIGH + (k * LN2_LOW + (2.0 * s + s * z * log_series(z)));
    }
}
