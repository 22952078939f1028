/* SPDX-License-Identifier: MIT */
/* f_r cos^2 from u = tan^2(theta), with its rounding bound. It decides in which form each term is
   evaluated; the caller gives u and its error.

   Glint: A q^2 with q = (1 + u) exp(-x/2), x = u / s^2: no cancellation between a growing and a
   decaying exponent (for s > 0.7 they cancel), no intermediate overflow, and x carries a correction
   term, so that the far tail (x up to 745) is as accurate as the peak.
   Diffuse: B r^2 / (1 + u) with r = (1 + u)^(-m/4), with its exponent in double-double.
   For m = 0, 1/2, 1 and 2, the usual values, roots replace the power: correctly rounded, and in a
   quarter of the time.

   Rounding, in units of 2^-53, with the errors of base/elementary.h:
   glint    1 + u: 1, exp: 2, its correction 1 - x'/2 and two products: 4; squared: 14; times A: 2
            far tail: log1p, below x/1.9: 1, x/2: 2, their difference: 1; exp: 2; squared: 8 x
   diffuse  the exponent y = (m/4) log(1 + u), by LRCSI_LOG_ERROR y and at most y or (m/4) 2^-53;
            exp: 3; squared: twice all that; 1 + u, quotient and two products: 4
            by roots: the rounding of 1 + u, times m/2 + 1: 2; a root of a root: 1.5; quotients: 2
   These are first order; the constants below leave room for the rest. */
#include "optics/reflect.h"

#include <float.h>
#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/elementary.h"
#include "base/range.h"

#define REFLECT_GLINT_UNITS   18.0
#define REFLECT_DIFFUSE_UNITS 11.0
#define REFLECT_ROOT_UNITS    7.0

/* Beyond the first limit of x, exp(-x/2) is close to underflow although q may not be: the exponents
   are added instead. Beyond the second limit their sum is below -790 for every double u: exp gives
   0. */
#define REFLECT_X_FAR  1400.0
#define REFLECT_X_NONE 3000.0

/* One term; a bound on its relative error; and a bound on |d log(term) / d log(u)|. */
typedef struct reflect_term {
    double value, relative, log_slope;
} reflect_term;

/* u / s^2 = hi + lo. With s^2 = S + S' exactly, the remainder u - hi S is exact, and lo has a
   relative error of a few units if products neither overflow nor underflow noticeably: s in
   [2^-500, 2^500]; large s is scaled down, and u with it, which is exact unless u is so small that
   x is negligible. Otherwise lo = 0, and x has an error of 2 units. */
static lrcsi_dd glint_exponent(double u, double s)
{
    if (s < 0x1p-500 || s > 0x1p500) {
        return (lrcsi_dd){u / s / s, 0.0};
    }
    double scale = s > 1.0 ? 0x1p-256 : 1.0;
    lrcsi_dd square = lrcsi_dd_two_product(s * scale, s * scale);
    double v = u * scale * scale;
    double x = v / square.hi;
    if (!(x < REFLECT_X_FAR)) {
        return (lrcsi_dd){x, 0.0};
    }
    lrcsi_dd p = lrcsi_dd_two_product(x, square.hi);
    return (lrcsi_dd){x, (((v - p.hi) - p.lo) - x * square.lo) / square.hi};
}

static reflect_term reflect_glint(const lrcs_brdf *brdf, double u)
{
    lrcsi_dd x = glint_exponent(u, brdf->s);
    reflect_term term = {0.0, REFLECT_GLINT_UNITS * LRCSI_U, 2.0 * lrcsi_min(u, 1.0) + x.hi};
    double q = 0.0;
    if (x.hi < REFLECT_X_FAR) {
        q = (1.0 + u) * (lrcsi_exp(-0.5 * x.hi) * (1.0 - 0.5 * x.lo));
        term.relative += x.lo == 0.0 ? 4.0 * LRCSI_U * x.hi : 0.0;
    } else {
        q = x.hi < REFLECT_X_NONE ? lrcsi_exp(lrcsi_log1p(u).hi - 0.5 * x.hi) : 0.0;
        term.relative += 16.0 * LRCSI_U * x.hi;
    }
    term.value = brdf->A * q * q;
    return term;
}

static reflect_term reflect_diffuse(const lrcs_brdf *brdf, double u)
{
    reflect_term term;
    const double m = brdf->m;
    const double w = 1.0 + u;
    term.log_slope = (0.5 * m + 1.0) * lrcsi_min(u, 1.0);
    /* w^(m/2), or 0 where it is no root */
    double root = m == 0.5   ? sqrt(sqrt(w))
                  : m == 1.0 ? sqrt(w)
                  : m == 2.0 ? w
                  : m == 0.0 ? 1.0
                             : 0.0;
    if (root > 0.0) {
        term.value = brdf->B / root / w;
        term.relative = LRCSI_U * REFLECT_ROOT_UNITS;
        return term;
    }
    lrcsi_dd log = lrcsi_log1p(u);
    double y = 0.25 * m * log.hi;
    double r = lrcsi_power(log, -0.25 * m);
    term.value = brdf->B * r * r / w;
    term.relative = LRCSI_U * (REFLECT_DIFFUSE_UNITS + 2.0 * LRCSI_LOG_ERROR * y +
                               lrcsi_min(2.0 * y, 0.5 * m * LRCSI_U));
    return term;
}

/* Is the first-order error valid? If not (the error of u is large, or the term is so small that one
   of its factors may have underflowed), a bound on the term itself replaces it. */
static int first_order_holds(const reflect_term *term, double e)
{
    return e <= 0.25 && term->relative + 2.0 * e * term->log_slope <= 0.25 &&
           term->value > 0x1p-900;
}

/* The true u lies in [u / (1 + e), u / (1 - e)]. For e <= 1/4 the error of log(u) is at most
   1.16 e, and log_slope grows by at most a factor of 4/3. So the error of log(term) is at most
   delta. */
static double term_error(const reflect_term *term, double e)
{
    double delta = term->relative + 2.0 * e * term->log_slope;
    return term->value * delta * (1.0 + delta);
}

/* A bound on the error from one on the term itself: twice that covers underflow and rounding. */
static double term_error_bound(const reflect_term *term, double term_bound)
{
    return 2.0 * fmax(term->value, term_bound) + 0x1p-1000;
}

double lrcsi_reflect_glint_root(double s)
{
    double s2 = s * s;
    return s2 > 0.5 ? 2.0 * s2 * lrcsi_exp(-1.0 + 0.5 / s2) : 1.0;
}

/* Where the first-order error is not valid, there are two cases.
   1. tan^2 is exact, and the glint so small that only underflow affects it: it bounds its own
      error. For these A a value of at most 2^-900 has q < 2^-200. Then (A q) q has errors of
      2^-1074 q and 2^-1074, and a q below 2^-1022, which is accurate to 2^-1074, causes an error of
      2^-1071. `relative` is above 1 only if both the true and the computed value are negligible.
      All of this is below 2^-1000.
   2. Else a bound on the glint anywhere takes its place. If e <= 1/4, u is in [tan2 / (1 + e),
      tan2 / (1 - e)] (else it may have any value), and over that interval (1 + u)^2 is largest at
      its upper end, the exponential at its lower. */
static double glint_error(const lrcs_brdf *brdf, const reflect_term *glint, double tan2, double e)
{
    if (first_order_holds(glint, e)) {
        return term_error(glint, e);
    }
    if (e == 0.0 && glint->value <= 0x1p-900 && brdf->A >= 0x1p-500) {
        return term_error_bound(glint, glint->value);
    }
    double q = lrcsi_reflect_glint_root(brdf->s);
    double high = e <= 0.25 ? tan2 / (1.0 - e) : HUGE_VAL;
    if (isfinite(high)) {
        double low = tan2 / (1.0 + e);
        q = fmin(q, lrcsi_exp(lrcsi_log1p(high).hi - 0.5 * (low / brdf->s / brdf->s)));
    }
    return term_error_bound(glint, brdf->A * q * q);
}

/* The diffuse term decreases with u, so that its value at the smallest possible u bounds it. */
static double diffuse_error(const lrcs_brdf *brdf, const reflect_term *diffuse, double tan2,
                            double e)
{
    if (first_order_holds(diffuse, e)) {
        return term_error(diffuse, e);
    }
    double low = e <= 0.25 ? tan2 / (1.0 + e) : 0.0;
    return term_error_bound(diffuse, reflect_diffuse(brdf, low).value);
}

lrcsi_reflection lrcsi_reflect(const lrcs_brdf *brdf, double tan2, double tan2_err)
{
    lrcsi_reflection out = {0.0, 0.0, 0.0};
    if (brdf->A > 0.0 && isfinite(tan2)) {
        reflect_term glint = reflect_glint(brdf, tan2);
        out.glint = lrcsi_min(glint.value, DBL_MAX);
        out.error = glint_error(brdf, &glint, tan2, tan2_err);
    }
    if (brdf->B > 0.0 && isfinite(tan2)) {
        reflect_term diffuse = reflect_diffuse(brdf, tan2);
        out.diffuse = diffuse.value;
        out.error += diffuse_error(brdf, &diffuse, tan2, tan2_err);
    }
    return out;
}
