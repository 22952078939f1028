/* SPDX-License-Identifier: MIT */
/* The distribution of sigma over many poses (lrcs/distribution.h). This file decides what a
   percentile and a bin are, and between which values each number lies. */
#include <lrcs/distribution.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/constant.h"
#include "base/sum.h"

#define HISTOGRAM_DEEP 100.0 /* the histogram reaches this many dB below the maximum */

static const int distribution_percent[LRCS_DISTRIBUTION_PERCENTS] = {1,  5,  10, 25, 50,
                                                                     75, 90, 95, 99};

static int by_rising_sigma(const void *a, const void *b)
{
    const lrcs_distribution_row *x = a;
    const lrcs_distribution_row *y = b;
    int order = (x->sigma_m2 > y->sigma_m2) - (x->sigma_m2 < y->sigma_m2);
    return order ? order : (x->index > y->index) - (x->index < y->index);
}

static int rows_check(const lrcs_distribution_row *row, uint64_t count)
{
    const int has_intervals = count > 0 && !isnan(row[0].low_m2);
    double weight = 0.0;
    for (uint64_t i = 0; i < count; i++) {
        const lrcs_distribution_row *one = &row[i];
        int interval = has_intervals ? one->low_m2 >= 0.0 && one->high_m2 >= 0.0
                                     : isnan(one->low_m2) && isnan(one->high_m2);
        if (!(one->sigma_m2 >= 0.0 && one->sigma_m2 <= DBL_MAX) || !(one->bound_m2 >= 0.0) ||
            !(one->weight >= 0.0 && one->weight <= DBL_MAX) || !interval) {
            return LRCS_E_NUMBER;
        }
        weight += one->weight;
    }
    return weight > 0.0 ? LRCS_OK : LRCS_E_EMPTY;
}

/* The weighted mean, and that of the bounds. Products and the division have relative errors of u
   each and the compensated sums of less than 2 u, as all terms are positive: 8 u of the mean
   exceeds the total, and so does 16 u of the bound. */
static void mean_make(const lrcs_distribution_row *row, lrcs_distribution *d)
{
    lrcsi_sum mean = {0.0, 0.0}, total = mean, bound = mean, low = mean, high = mean;
    double plain = 0.0; /* mean without weights, and the sum of squared deviations from it */
    double square = 0.0;
    for (uint64_t i = 0; i < d->rows; i++) {
        double sigma = row[i].sigma_m2;
        double off = sigma - plain;
        plain += off / (double)(i + 1); /* B. P. Welford, Technometrics 4 (1962) 419 */
        square += off * (sigma - plain);
        lrcsi_sum_add(&mean, row[i].weight * sigma);
        lrcsi_sum_add(&bound, row[i].weight * row[i].bound_m2);
        lrcsi_sum_add(&total, row[i].weight);
        lrcsi_sum_add(&low, row[i].weight * row[i].low_m2);
        lrcsi_sum_add(&high, row[i].weight * row[i].high_m2);
    }
    d->weight = lrcsi_sum_value(&total);
    double n = (double)d->rows;
    double value = lrcsi_sum_value(&mean) / d->weight;
    double within =
        lrcsi_sum_value(&bound) / d->weight * (1.0 + 16.0 * LRCSI_U) + 8.0 * LRCSI_U * value;
    d->mean_m2 = (lrcs_distribution_value){{fmax(value - within, 0.0), value, value + within,
                                            lrcsi_sum_value(&low) / d->weight,
                                            lrcsi_sum_value(&high) / d->weight}};
    d->standard_error_m2 = d->rows > 1 ? sqrt(square / (n - 1.0) / n) : (double)NAN;
}

/* Chooses the narrowest bins with a round width in dB such that few enough cover the range from the
   smallest sigma above 0 to the largest. */
static void bins_choose(const lrcs_distribution_row *row, lrcs_distribution *d)
{
    static const int tenths[] = {1, 2, 5, 10, 20, 50};
    double most = row[d->rows - 1].sigma_m2;
    uint64_t at = 0;
    while (at < d->rows && !(row[at].sigma_m2 > 0.0)) {
        at++;
    }
    if (at == d->rows) {
        return; /* sigma is 0 in all rows */
    }
    double high = 10.0 * log10(most);
    double low = fmax(10.0 * log10(row[at].sigma_m2), high - HISTOGRAM_DEEP);
    int k = 0;
    while (k < 5 && (high - low) * 10.0 / tenths[k] > LRCS_DISTRIBUTION_BINS - 3) {
        k++;
    }
    double first = ceil(low * 10.0 / tenths[k]) - 1.0;
    double last = fmax(ceil(high * 10.0 / tenths[k]), first + 1.0);
    /* edges in m2 are rounded: the maximum must still lie in the last bin */
    last += pow(10.0, 0.1 * (last * tenths[k] / 10.0)) < most;
    d->bins = (uint32_t)(last - first);
    for (uint32_t i = 0; i <= d->bins; i++) {
        d->edge_dbsm[i] = (first + i) * tenths[k] / 10.0;
        d->edge_m2[i] = pow(10.0, 0.1 * d->edge_dbsm[i]);
    }
}

/* Percentiles and shares of sigma moved to an end. Sigma of every row lies between its ends, and a
   percentile increases with every sigma, so that the percentiles of the ends enclose it. If weights
   are not all 1, two sums of n weights differ by at most 2 n u of the whole. */
static void percentiles_at(const lrcs_distribution_row *row, lrcs_distribution_row *end, int which,
                           lrcs_distribution *d)
{
    /* more sigma, a smaller share below an edge */
    static const int opposite[LRCS_DISTRIBUTION_ENDS] = {
        LRCS_DISTRIBUTION_MOST, LRCS_DISTRIBUTION_VALUE, LRCS_DISTRIBUTION_LEAST,
        LRCS_DISTRIBUTION_HIGH, LRCS_DISTRIBUTION_LOW};
    int whole = 1; /* all weights are 1, and sums are exact */
    int side = which == LRCS_DISTRIBUTION_LEAST ? -1 : which == LRCS_DISTRIBUTION_MOST;
    for (uint64_t i = 0; i < d->rows; i++) {
        end[i] = row[i];
        whole &= row[i].weight == 1.0;
        if (end[i].bound_m2 > 0.0 && side != 0) {
            double moved = end[i].sigma_m2 + side * end[i].bound_m2;
            end[i].sigma_m2 = fmax(nextafter(moved, side * HUGE_VAL), 0.0);
        }
        end[i].sigma_m2 = which == LRCS_DISTRIBUTION_LOW    ? end[i].low_m2
                          : which == LRCS_DISTRIBUTION_HIGH ? end[i].high_m2
                                                            : end[i].sigma_m2;
    }
    double slack = whole ? 0.0 : side * 2.0 * (double)d->rows * LRCSI_U * d->weight;
    qsort(end, d->rows, sizeof *end, by_rising_sigma);
    double below = 0.0;
    uint64_t at = 0;
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) { /* the first row that reaches it */
        double target = d->percent[k] * d->weight / 100.0;
        while (at + 1 < d->rows && below + end[at].weight < target + slack) {
            below += end[at++].weight;
        }
        d->percentile_m2[k].at[which] = end[at].sigma_m2;
    }
    below = 0.0;
    at = 0;
    for (uint32_t i = 0; i <= d->bins; i++) {
        for (; at < d->rows && end[at].sigma_m2 <= d->edge_m2[i]; at++) {
            below += end[at].weight;
        }
        double share = at == d->rows ? 1.0 : below / d->weight;
        share += whole || at == 0 || at == d->rows ? 0.0 : -slack / d->weight;
        d->cdf[opposite[which]][i] = fmax(fmin(share, 1.0), 0.0);
    }
}

int lrcs_distribution_make(lrcs_distribution_row *row, lrcs_distribution_row *room, uint64_t count,
                           lrcs_distribution *distribution)
{
    int status = rows_check(row, count);
    if (status != LRCS_OK) {
        return status;
    }
    lrcs_distribution *d = distribution;
    *d = (lrcs_distribution){.rows = count, .has_intervals = !isnan(row[0].low_m2)};
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
        d->percent[k] = distribution_percent[k];
    }
    for (int which = LRCS_DISTRIBUTION_LOW; which <= LRCS_DISTRIBUTION_HIGH; which++) {
        for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
            d->percentile_m2[k].at[which] = (double)NAN;
        }
        for (int i = 0; i <= LRCS_DISTRIBUTION_BINS; i++) {
            d->cdf[which][i] = (double)NAN;
        }
    }
    mean_make(row, d);
    qsort(row, count, sizeof *row, by_rising_sigma);
    bins_choose(row, d);
    for (int which = 0;
         which <= (d->has_intervals ? LRCS_DISTRIBUTION_HIGH : LRCS_DISTRIBUTION_MOST); which++) {
        percentiles_at(row, room, which, d);
    }
    const double *value = d->cdf[LRCS_DISTRIBUTION_VALUE];
    for (uint32_t i = 0; i < d->bins; i++) {
        d->share[i] = value[i + 1] - value[i];
        d->largest_share = fmax(d->largest_share, d->share[i]);
    }
    return LRCS_OK;
}
