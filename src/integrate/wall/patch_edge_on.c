/* SPDX-License-Identifier: MIT */
/* Bounds F, and encloses its mean. It does not decide how a patch is divided
   (integrate/wall/patch.c).

   Bound. With kappa for real angles up to the ends of a piece (integrate/wall/patch_frame.h), and c
   of its middle, no cosine of incidence in it exceeds x = (c + kappa) / (nu - kappa), and F is at
   most its value at u = 1 / x^2 - 1, if that is 2 s^2 or more: the diffuse term decreases with u,
   and the glint does where w > 2 s^2. The weights are at most |sin alpha| + a, nu + kappa and
   (|cos alpha| - a)^-4.

   Mean. The diffuse term is B (c / nu)^p where c > 0, and 0 elsewhere, with p = m + 2, times the
   weights, one of which is nu: it grows with c = g . n = g' . N, where g' is the image of g under
   the transpose of H, no longer than 1, or g itself. c differs from its linear function about the
   middle of the piece,
       l = c_m + c_alpha x + c_phi y,  |x| <= a, |y| <= b,
   by at most R = (a^2 + 2 a b + b^2 sin alpha_max) / 2, because the second derivatives of N are no
   longer than 1, 1 and sin alpha. So the mean is between those of (l - R)^p and (l + R)^p, where
   these are positive, times the least and the largest weight, those of nu^(1 - p) included: nu
   differs by at most kappa from that in the middle. The mean of a power of the positive
   part of a linear function over a rectangle is
       (sum over its four corners of +- (l at the corner)^(p + 2)) / (4 A C (p + 1) (p + 2)),
   with A = |c_alpha| a, C = |c_phi| b, and + where both changes have the same sign. If one of A and
   C is small compared with the other, it is added to R, and the mean over an interval is taken, 1 /
   (2 A (p + 1)) times the difference of the powers p + 1 at its ends. */
#include "integrate/wall/patch_edge_on.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"
#include "optics/reflect.h"

/* A change of c below this fraction of the other one, of R or of c is added to R. Then both, where
   they are used, are above 2^-10 of c. */
#define SMALL_CHANGE 0x1p-10
/* Times p + 1, more than the rounding error of a mean, relative to the largest one, that of (l +
   R)^p. Powers have relative errors of 4 u (p + 2), those of their rounded bases included, so that
   the sum over the corners has one of 16 u (p + 2) times the largest power. With q = p + 2 this is
   at most 2^24 / (q (q - 1)) times the sum where c > A + C, and 2^11 times that elsewhere: there 1
   - (1 - y)^q - y^q >= y for y = 2 C / (c + A + C) <= 1/2, and y >= 2^-11. */
#define MEAN_ERR 1e-8

double lrcsi_patch_edge_on_bound(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double shift)
{
    const double nu_min = f->nu - shift;
    const double x = (f->c + shift) / nu_min; /* the largest cosine */
    const double sine = f->sine + f->step;
    const double cosine = fabs(f->cosine) - f->step;
    double weight = f->step > 0 ? sine : 1;
    if (!(nu_min > 0) || !(x < 0.5) || (f->fourth && !(cosine > 0))) {
        return HUGE_VAL;
    }
    double u = 1 / (x * x) - 1;
    if (brdf->A > 0 && !(u >= 2 * brdf->s * brdf->s)) {
        return HUGE_VAL;
    }
    weight /= f->fourth ? cosine * cosine * (cosine * cosine) : 1;
    const lrcsi_reflection at = lrcsi_reflect(brdf, u * (1 - 1e-10), 0);
    return LRCSI_OUTWARD_MICRO * weight * (f->nu + shift) * (at.glint + at.diffuse + at.error);
}

double lrcsi_patch_edge_on_most(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double shift)
{
    const double most = lrcsi_min(f->c + shift, f->nu) / f->nu; /* cosine */
    return lrcsi_patch_integrand(f, brdf, 1 / (most * most) - 1);
}

/* x^p for positive x, else 0. */
static double positive_power(double x, double p)
{
    return x > 0 ? pow(x, p) : 0;
}

/* The mean of the positive part of l to the power p. change: the larger one, and the other one,
   which is 0 if it is small. */
static double power_mean(double middle, const double change[2], double p)
{
    const double a = change[0];
    const double c = change[1];
    if (!(a > 0)) {
        return positive_power(middle, p);
    }
    if (!(c > 0)) {
        return (positive_power(middle + a, p + 1) - positive_power(middle - a, p + 1)) /
               (2 * a * (p + 1));
    }
    const double sum =
        (positive_power(middle + a + c, p + 2) - positive_power(middle + a - c, p + 2)) -
        (positive_power(middle - a + c, p + 2) - positive_power(middle - a - c, p + 2));
    return sum / (4 * a * c * (p + 1) * (p + 2));
}

lrcsi_edge_on_mean lrcsi_patch_edge_on_mean(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                                            double shift)
{
    const lrcs_brdf glint = {brdf->A, 0, brdf->s, brdf->m};
    const double highest_glint = brdf->A > 0 ? lrcsi_patch_edge_on_bound(f, &glint, shift) : 0;
    const double x = cos(f->phi);
    const double y = sin(f->phi);
    double g[3];
    lrcsi_patch_direction(f, g);
    const double across = g[0] * x + g[1] * y;
    const double along = fabs(f->cosine * across - g[2] * f->sine) * f->step;
    const double around = f->sine * fabs(g[1] * x - g[0] * y) * f->half;
    const double highest = lrcsi_min(1, f->sine + f->step);
    const double p = brdf->m + 2;
    double least = 1; /* the weights */
    double most = 1;
    double change[2] = {lrcsi_max(along, around), lrcsi_min(along, around)};
    double r = 0.5 * (f->step * f->step + 2 * f->step * f->half + f->half * f->half * highest) *
                   LRCSI_OUTWARD_NANO +
               2 * LRCSI_PATCH_NORMAL_ERR;
    if (f->shadow || !(shift < 0.5 * f->nu) || !(highest_glint < HUGE_VAL)) {
        return (lrcsi_edge_on_mean){0, HUGE_VAL, 0};
    }
    if (f->step > 0) {
        const double cosine = fabs(f->cosine);
        least = f->sine - f->step;
        most = highest;
        if (f->fourth) {
            const double low = cosine - f->step;
            const double high = lrcsi_min(1, cosine + f->step);
            least /= high * high * (high * high);
            most = low > 0 ? most / (low * low * (low * low)) : HUGE_VAL;
        }
        least = lrcsi_max(0, least);
    }
    if (f->axis) {
        least *= pow(f->nu + shift, 1 - p);
        most *= pow(f->nu - shift, 1 - p);
    }
    for (int k = 1; k >= 0; k--) {
        const double scale = lrcsi_max(k == 1 ? change[0] : r, fabs(f->c));
        if (change[k] <= SMALL_CHANGE * scale) {
            r += change[k];
            change[k] = 0;
        }
    }
    const double low = least * brdf->B * power_mean(f->c - r, change, p);
    const double high = most * brdf->B * power_mean(f->c + r, change, p);
    const double middle = 0.5 * (low + high);
    const double log_w = middle > 0 ? -2 / p * log(middle / (brdf->B * most)) : 0;
    return (lrcsi_edge_on_mean){middle,
                                (0.5 * (high - low) + MEAN_ERR * (p + 1) * high + highest_glint) *
                                    LRCSI_OUTWARD_MICRO,
                                middle * lrcsi_max(0, log_w)};
}
