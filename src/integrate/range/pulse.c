/* SPDX-License-Identifier: MIT */
/* The response of a range profile to a pulse: the convolution of the two, from the sigma and the
   first moment of each bin. */
#include <lrcs/profile.h>

#include <float.h>
#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/sum.h"

/* More than this many standard deviations from its peak the pulse counts as 0, with an error of at
   most e^-72 of the peak. */
#define PULSE_END       12.0
#define PULSE_END_VALUE 5.4e-32 /* above e^-72 */

/* The full width at half maximum is 2 sqrt(2 ln 2) standard deviations. */
#define FWHM_DEVIATIONS 2.3548200450309493

/* Let g be the pulse, z the range at which the response is requested, and c the centre of a bin.
   For a point x of the bin g(z - x) = g(z - c) - (x - c) g'(z - c) + R,  |R| <= (x - c)^2 / 2 sup
   |g''|, where |x - c| is at most half the bin. With t in standard deviations d, g' = -t g / d and
   g'' = (t^2 - 1) g / d^2. Over a bin g is at most its value at the point nearest to z, and
   |t^2 - 1| at most the larger of 1 and t^2 - 1 at the farthest point. The error of the bin's sigma
   adds at most that value of g times itself; an error e in the range of points adds e |g'|.
   Rounding: t has an error of 4 u (|z| + |c|) / d, as if z had one of 4 u (|z| + |c|), which is
   added to e; all other rounding errors are below 64 u. */
int lrcs_profile_pulse(const lrcs_profile *profile, double fwhm_m, double range_m,
                       double *density_m, double *bound_m, double *estimate_m)
{
    double d = fwhm_m / FWHM_DEVIATIONS;
    double peak = 1 / (d * sqrt(2 * LRCS_PI));
    lrcsi_sum density = {0, 0};
    double bound = 0;
    double estimate = 0;
    if (!(fwhm_m > 0 && d >= DBL_MIN)) { /* the peak is then below 2^1022 */
        return LRCS_E_ARGUMENT;
    }
    for (uint32_t i = 0; i < profile->count; i++) {
        const lrcs_profile_bin *bin = &profile->bin[i];
        double centre = ((double)(profile->first + i) + 0.5) * profile->bin_m;
        double sigma = bin->sigma_glint_m2 + bin->sigma_diffuse_m2;
        double err = profile->range_err_m + 4 * LRCSI_U * (fabs(range_m) + fabs(centre));
        double t = (range_m - centre) / d;
        double half = (0.5 * profile->bin_m + err) / d * LRCSI_OUTWARD(8);
        double nearest = lrcsi_max(0, fabs(t) - half);
        double farthest = fabs(t) + half;
        if (nearest > PULSE_END) {
            bound += peak * PULSE_END_VALUE * (bin->variation_m2 + sigma);
            continue;
        }
        double g = peak * lrcsi_exp(-0.5 * t * t);
        double highest = peak * lrcsi_exp(-0.5 * nearest * nearest);
        double curvature = lrcsi_max(1, farthest * farthest - 1);
        double remainder = 0.5 * half * half * curvature + err / d * farthest;
        lrcsi_sum_add(&density, g * sigma);
        lrcsi_sum_add(&density, g * (t / d) * bin->moment_m3);
        bound += highest * (bin->variation_m2 + remainder * sigma);
        estimate += highest * bin->curvature_estimate_m2;
        bound += 64 * LRCSI_U * highest * (1 + farthest * farthest) * sigma;
    }
    bound *= LRCSI_OUTWARD_NANO + 4 * LRCSI_U * profile->count;
    if (!isfinite(lrcsi_sum_value(&density) + bound)) {
        return LRCS_E_NUMBER;
    }
    *density_m = lrcsi_sum_value(&density);
    *estimate_m = estimate;
    *bound_m = bound + (bound > 0 && bound < DBL_MIN ? 0x1p-1073 : 0);
    return LRCS_OK;
}
