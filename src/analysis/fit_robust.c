/* SPDX-License-Identifier: MIT */
/* Which readings a fit uses. This file decides how large the errors of readings are taken to be,
   how a minimization limits the influence of single readings, and which readings are excluded. */
#include "analysis/fit_robust.h"

#include <math.h>

#include "base/range.h"

/* Huber's constant: 95 % of the efficiency of least squares on normal errors. */
#define ROBUST_HUBER  1.345
#define ROBUST_ROUNDS 12

/* For a normal distribution the median of |x| is its standard deviation divided by 1.4826. */
#define ROBUST_NORMAL 1.4826

/* Readings are excluded beyond this many standard deviations: one in 2000 for normal errors. */
#define ROBUST_CUT       3.5
#define ROBUST_COUNT_MIN 8u

/* For readings whose fitted value is nearly 0, the expected error is a fraction of the
   largest fitted value. A fit that is negligible compared with the largest reading carries no
   information about errors, and squares divided by it overflow. */
#define ROBUST_RELATIVE 1e-4
#define ROBUST_FIT_MIN  0x1p-400

/* Residuals this small relative to the readings are rounding errors. */
#define ROBUST_ROUNDING 0x1p-44

/* Returns the value of rank `rank` in ascending order, 0 for the smallest (C. A. R. Hoare 1961);
   changes the order of the values. */
static double value_ranked(double *value, uint32_t count, uint32_t rank)
{
    uint32_t low = 0;
    uint32_t high = count - 1;
    while (low < high) {
        double pivot = value[low + (high - low) / 2];
        uint32_t i = low;
        uint32_t k = high;
        for (;;) {
            while (value[i] < pivot) {
                i++;
            }
            while (value[k] > pivot) {
                k--;
            }
            if (i >= k) {
                break;
            }
            double swap = value[i];
            value[i++] = value[k];
            value[k--] = swap;
        }
        /* value[low..k] <= pivot <= value[k+1..high] */
        if (rank <= k) {
            high = k;
        } else {
            low = k + 1;
        }
    }
    return value[rank];
}

void lrcsi_fit_noise(lrcsi_fit_data *data, int noise, const lrcsi_fit_parameters *parameters)
{
    double largest = 0.0;
    if (noise != LRCS_FIT_RELATIVE) {
        return;
    }
    lrcsi_fit_residuals(data, parameters);
    for (uint32_t i = 0; i < data->count; i++) {
        data->spare[i] = data->y[i] - data->residual[i];
        largest = lrcsi_max(largest, data->spare[i]);
    }
    for (uint32_t i = 0; i < data->count && largest > ROBUST_FIT_MIN; i++) {
        data->inverse[i] = 1.0 / lrcsi_max(data->spare[i], ROBUST_RELATIVE * largest);
    }
}

/* Computes |y - f| * inverse for each reading, and the sum. Returns the size below which such a
   value may be due to rounding alone. */
static double deviations_make(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters,
                              double *deviation, double *sum)
{
    double size = 0.0;
    *sum = 0.0;
    lrcsi_fit_residuals(data, parameters);
    for (uint32_t i = 0; i < data->count; i++) {
        deviation[i] = fabs(data->residual[i]) * data->inverse[i];
        size = lrcsi_max(size, fabs(data->y[i]) * data->inverse[i]);
        *sum += deviation[i];
    }
    return ROBUST_ROUNDING * size;
}

/* The standard deviation of such values, from their median; changes their order. A fit with nearly
   as many parameters as readings leaves small residuals; the factor 1 + 5/(n - p) corrects for that
   (Rousseeuw and Leroy 1987, ch. 5, Eq. 1.3). */
static double deviations_scale(double *deviation, uint32_t count, double rounding)
{
    double few = 1.0 + 5.0 / (count - LRCS_FIT_PARAMETERS);
    double median = value_ranked(deviation, count, count / 2);
    return lrcsi_max(ROBUST_NORMAL * few * median, rounding);
}

double lrcsi_fit_huber(lrcsi_fit_data *data, int noise, lrcsi_fit_parameters *parameters)
{
    double sum = 0.0;
    for (int round = 0; round < ROBUST_ROUNDS; round++) {
        double rounding = deviations_make(data, parameters, data->spare, &sum);
        double limit = ROBUST_HUBER * deviations_scale(data->spare, data->count, rounding);
        for (uint32_t i = 0; i < data->count; i++) {
            double deviation = fabs(data->residual[i]) * data->inverse[i];
            data->weight[i] =
                data->inverse[i] * (deviation > limit ? sqrt(limit / deviation) : 1.0);
        }
        lrcsi_fit_minimize(data, 0, parameters);
        lrcsi_fit_noise(data, noise, parameters);
    }
    deviations_make(data, parameters, data->spare, &sum);
    return sum;
}

int lrcsi_fit_trim(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters)
{
    double sum = 0.0;
    int changed = 0;
    double limit = HUGE_VAL;
    double rounding = deviations_make(data, parameters, data->spare, &sum);
    if (data->count >= ROBUST_COUNT_MIN) {
        limit = ROBUST_CUT * deviations_scale(data->spare, data->count, rounding);
        /* If more than half of the readings agree to the last digit, the others are not
           necessarily outliers: seven of ten readings are kept in any case. */
        uint32_t seven = (uint32_t)((7 * (uint64_t)data->count + 9) / 10) - 1;
        limit = lrcsi_max(limit, 2.0 * value_ranked(data->spare, data->count, seven));
    }
    for (uint32_t i = 0; i < data->count; i++) {
        int keep = fabs(data->residual[i]) * data->inverse[i] <= limit;
        changed |= keep != (data->weight[i] > 0.0);
        data->weight[i] = keep ? data->inverse[i] : 0.0;
    }
    return changed;
}
