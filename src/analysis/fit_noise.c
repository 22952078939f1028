/* SPDX-License-Identifier: MIT */
/* Which errors suit readings of unknown errors: relative or absolute ones, by the likelihood of the
   residuals of both fits. */
#include <lrcs/fit.h>

#include <float.h>
#include <math.h>

#define NOISE_ROUNDS 60   /* of the iteration for the width, which converges linearly */
#define NOISE_LEAST  1e-4 /* of the largest value of the fit, as of LRCS_FIT_RELATIVE */

/* The logarithm of the likelihood of all residuals, up to a constant, for errors with a Cauchy
   distribution, on which outliers have little influence. The expected errors of the readings are
   the same (absolute) or in proportion to the fit (relative), up to a common width, which is the
   likeliest one (by expectation and maximisation). */
static double noise_likelihood(const lrcs_fit_point *point, uint32_t count, int noise)
{
    double most = 0.0;
    double square = 1.0; /* of the width */
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        most = fmax(most, point[i].fitted);
    }
    for (int round = 0; round < NOISE_ROUNDS; round++) {
        double next = 0.0;
        sum = 0.0;
        for (uint32_t i = 0; i < count; i++) {
            double size =
                noise == LRCS_FIT_RELATIVE ? fmax(point[i].fitted, NOISE_LEAST * most) : 1.0;
            double x = point[i].residual / size;
            sum -= log(size) + 0.5 * log(square) + log1p(x * x / square);
            next += 2.0 * x * x / (1.0 + x * x / square) / count;
        }
        square = fmax(next, DBL_MIN);
    }
    return sum;
}

int lrcs_fit_run_likelier(const lrcs_fit_reading *reading, uint32_t count,
                          const lrcs_fit_options *options, lrcs_work *work, int *noise,
                          lrcs_fit *fit, lrcs_fit_point *point)
{
    lrcs_fit_options own = *options;
    own.noise = *noise = LRCS_FIT_RELATIVE;
    int status = lrcs_fit_run(reading, count, &own, work, fit, point);
    if (status != LRCS_OK) {
        return status;
    }
    double relative = noise_likelihood(point, count, LRCS_FIT_RELATIVE);
    own.noise = *noise = LRCS_FIT_ABSOLUTE;
    status = lrcs_fit_run(reading, count, &own, work, fit, point);
    if (status == LRCS_OK && relative > noise_likelihood(point, count, LRCS_FIT_ABSOLUTE)) {
        own.noise = *noise = LRCS_FIT_RELATIVE;
        status = lrcs_fit_run(reading, count, &own, work, fit, point);
    }
    return status;
}
