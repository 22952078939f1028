/* SPDX-License-Identifier: MIT */
/* The distribution of sigma over the rows of a sweep: weights, mean, percentiles, histogram and
   cumulative distribution. A map of azimuth and elevation weights each row by the solid angle of
   its cell; in all other sweeps rows have equal weights (for --sphere that is the solid angle). The
   statistics are those of the rows: how sigma varies between them is not known. stats_write.c
   writes them.

   Materials are the same in all rows, so that their errors move the rows together. The band of a
   statistic is from its value with every row at the low end of that row's band to its value with
   every row at the high end. With one uncertain parameter that moves sigma of all rows the same
   way, this is the interval of the same probability: mean and percentiles increase with every
   sigma. With several it is an estimate that errs to the wide side: to first order the deviation of
   the mean is at most the mean of the deviations, whatever their correlations (Minkowski's
   inequality). It is no bound. */
#include "cli/sweep/sweep.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STATS_DEEP 100.0 /* the histogram reaches this many dB below the maximum */

const int cli_stats_percent[STATS_PERCENTS] = {1, 5, 10, 25, 50, 75, 90, 95, 99};

static int by_sigma(const void *a, const void *b)
{
    const stats_row *x = a;
    const stats_row *y = b;
    int order = (x->sigma > y->sigma) - (x->sigma < y->sigma);
    return order ? order : (x->index > y->index) - (x->index < y->index);
}

/* ---- weights ---- */

/* 1 if azimuth and elevation are both varied, elevation within the poles. */
static int is_map(const sweep_plan *plan)
{
    int varied = plan->kind == SWEEP_AZEL;
    for (uint32_t i = plan->scene_axes; i < plan->axes && varied; i++) {
        const sweep_range *range = &plan->axis[i].range;
        varied = range->count > 1 && (plan->axis[i].option[0] == 'a' ||
                                      (fabs(cli_range_at(range, 0)) <= 90.0 &&
                                       fabs(cli_range_at(range, range->count - 1)) <= 90.0));
    }
    return varied;
}

/* The width of a cell along one axis of a map: for azimuth the same for all, except the ends of a
   full turn, which are one direction; for elevation the difference of sines, clipped at the
   poles. */
static double axis_weight(const sweep_plan *plan, uint64_t row, uint32_t axis)
{
    const sweep_axis *along = &plan->axis[axis];
    uint64_t place = cli_plan_place(plan, row, axis);
    uint64_t last = along->range.count - 1;
    double first = cli_range_at(&along->range, 0);
    double here = cli_range_at(&along->range, place);
    double half = 0.5 * fabs(cli_range_at(&along->range, 1) - first);
    if (along->option[0] == 'a') {
        int turn = fabs(cli_range_at(&along->range, last) - first) == 360.0;
        return turn && (place == 0 || place == last) ? 0.5 : 1.0;
    }
    return sin(fmin(here + half, 90.0) / CLI_DEGREES) - sin(fmax(here - half, -90.0) / CLI_DEGREES);
}

static double row_weight(const sweep_plan *plan, uint64_t row)
{
    double weight = 1.0;
    for (uint32_t i = plan->scene_axes; i < plan->axes; i++) {
        weight *= fmax(axis_weight(plan, row, i), 0.0);
    }
    return weight;
}

static const char *weights_text(const sweep_plan *plan, int map)
{
    return map                          ? "each by the solid angle that it stands for"
           : plan->kind == SWEEP_SPHERE ? "all alike: each stands for the same solid angle"
           : plan->kind == SWEEP_AZEL   ? "all alike: a cut stands for no solid angle"
                                        : "all alike";
}

/* ---- percentiles ---- */

/* The first of the rows in ascending order at which `part` of the weight is reached. `slack` is a
   share of the weight that allows for the rounding of sums. */
static uint64_t row_at(const stats_row *row, uint64_t rows, double part, double slack)
{
    double below = 0.0;
    uint64_t at = 0;
    while (at + 1 < rows && below + row[at].weight < part + slack) {
        below += row[at++].weight;
    }
    return at;
}

/* The rows from which percentiles and shares are taken: sigma, sigma at one end of its bound, or at
   one end of its material band. */
enum stats_end { END_LEAST = -1, END_VALUE, END_MOST, END_LOW, END_HIGH };

static double *value_at(stats_value *value, int which)
{
    return which == END_LEAST  ? &value->least
           : which == END_MOST ? &value->most
           : which == END_LOW  ? &value->low
           : which == END_HIGH ? &value->high
                               : &value->value;
}

/* Percentiles of sigma moved to an end. Sigma of every row lies
   between its ends, and a percentile increases with every sigma, so that the percentiles of the
   ends enclose it. If weights are not whole numbers, two sums of n weights differ by at most 2 n u
   of the whole, u = DBL_EPSILON / 2. */
static void percentiles_at(sweep_stats *stats, stats_row *end, int which)
{
    int whole = stats->whole == (double)stats->rows; /* all weights are 1, and sums are exact */
    int side = which <= END_MOST ? which : 0;
    double slack = whole ? 0.0 : side * (double)stats->rows * DBL_EPSILON * stats->whole;
    for (uint64_t i = 0; i < stats->rows; i++) {
        end[i] = stats->row[i];
        if (end[i].bound > 0.0 && side != 0) {
            double moved = end[i].sigma + side * end[i].bound;
            end[i].sigma = fmax(nextafter(moved, side * HUGE_VAL), 0.0);
        }
        end[i].sigma = which == END_LOW    ? end[i].low
                       : which == END_HIGH ? end[i].high
                                           : end[i].sigma;
    }
    qsort(end, stats->rows, sizeof *end, by_sigma);
    for (int k = 0; k < STATS_PERCENTS; k++) {
        stats_value *value = &stats->percentile[k];
        double part = cli_stats_percent[k] * stats->whole / 100.0;
        double sigma = end[row_at(end, stats->rows, part, slack)].sigma;
        *value_at(value, which) = sigma;
    }
    double below = 0.0;
    uint64_t at = 0;
    for (uint32_t i = 0; i <= stats->bins; i++) {
        stats_value *value = &stats->cdf[i];
        for (; at < stats->rows && end[at].sigma <= stats->edge_m2[i]; at++) {
            below += end[at].weight;
        }
        double share = at == stats->rows ? 1.0 : below / stats->whole;
        share += whole || at == 0 || at == stats->rows ? 0.0 : -slack / stats->whole;
        share = fmax(fmin(share, 1.0), 0.0);
        /* more sigma, a smaller share below an edge */
        *value_at(value, which == END_LEAST  ? END_MOST
                         : which == END_MOST ? END_LEAST
                         : which == END_LOW  ? END_HIGH
                         : which == END_HIGH ? END_LOW
                                             : END_VALUE) = share;
    }
}

/* ---- mean ---- */

/* The weighted mean, and that of the bounds. Products and the division have relative errors of u
   each and the compensated sums of less than 2 u, as all terms are positive: 8 u of the mean
   exceeds the total, and so does 16 u of the bound. */
static void mean_make(sweep_stats *stats)
{
    cli_sum mean = {0.0, 0.0};
    cli_sum total = {0.0, 0.0};
    cli_sum bound = {0.0, 0.0};
    cli_sum low = {0.0, 0.0};
    cli_sum high = {0.0, 0.0};
    sweep_tally tally = {0};
    for (uint64_t i = 0; i < stats->rows; i++) {
        const stats_row *row = &stats->row[i];
        const sweep_row one = {.field[FIELD_SIGMA] = row->sigma, .field[FIELD_BOUND] = row->bound};
        cli_sum_add(&mean, row->weight * row->sigma);
        cli_sum_add(&bound, row->weight * row->bound);
        cli_sum_add(&total, row->weight);
        cli_sum_add(&low, row->weight * row->low);
        cli_sum_add(&high, row->weight * row->high);
        cli_tally_add(&tally, &one);
    }
    stats->whole = cli_sum_value(&total);
    double value = cli_sum_value(&mean) / stats->whole;
    double within = cli_sum_value(&bound) / stats->whole * (1.0 + 8.0 * DBL_EPSILON) +
                    4.0 * DBL_EPSILON * value;
    stats->mean =
        (stats_value){fmax(value - within, 0.0), value, value + within,
                      cli_sum_value(&low) / stats->whole, cli_sum_value(&high) / stats->whole};
    stats->standard_error = cli_plan_has_mean(stats->plan) ? cli_tally_error(&tally) : (double)NAN;
}

/* ---- histogram ---- */

/* Chooses the narrowest bins with a round width in dB such that few enough cover the range from the
   smallest sigma above 0 to the largest. */
static void bins_choose(sweep_stats *stats)
{
    static const int tenths[] = {1, 2, 5, 10, 20, 50};
    double most = stats->row[stats->rows - 1].sigma;
    uint64_t at = 0;
    while (at < stats->rows && !(stats->row[at].sigma > 0.0)) {
        at++;
    }
    if (at == stats->rows) {
        return; /* sigma is 0 in all rows */
    }
    double high = cli_dbsm(most);
    double low = fmax(cli_dbsm(stats->row[at].sigma), high - STATS_DEEP);
    int k = 0;
    while (k < 5 && (high - low) * 10.0 / tenths[k] > STATS_BINS - 3) {
        k++;
    }
    double first = ceil(low * 10.0 / tenths[k]) - 1.0;
    double last = fmax(ceil(high * 10.0 / tenths[k]), first + 1.0);
    /* edges in m2 are rounded: the maximum must still lie in the last bin */
    last += pow(10.0, 0.1 * (last * tenths[k] / 10.0)) < most;
    stats->bins = (uint32_t)(last - first);
    for (uint32_t i = 0; i <= stats->bins; i++) {
        stats->edge_dbsm[i] = (first + i) * tenths[k] / 10.0;
        stats->edge_m2[i] = pow(10.0, 0.1 * stats->edge_dbsm[i]);
    }
}

/* ---- all of it ---- */

int cli_stats_make(const sweep_plan *plan, const sweep_head *head, const double (*row)[2],
                   const double (*band)[2], sweep_stats *stats)
{
    int map = is_map(plan);
    stats_row *end = calloc(plan->rows, sizeof *end);
    *stats = (sweep_stats){.plan = plan,
                           .head = head,
                           .rows = plan->rows,
                           .row = calloc(plan->rows, sizeof *stats->row),
                           .weights = weights_text(plan, map),
                           .banded = band != NULL};
    if (!stats->row || !end) {
        free(end);
        return cli_out_of_memory();
    }
    for (uint64_t i = 0; i < plan->rows; i++) {
        stats->row[i] = (stats_row){.sigma = row[i][0],
                                    .bound = row[i][1],
                                    .weight = map ? row_weight(plan, i) : 1.0,
                                    .low = band ? band[i][0] : (double)NAN,
                                    .high = band ? band[i][1] : (double)NAN,
                                    .index = i};
    }
    for (int k = 0; k < STATS_PERCENTS; k++) {
        stats->percentile[k].low = stats->percentile[k].high = (double)NAN;
    }
    for (int i = 0; i <= STATS_BINS; i++) {
        stats->cdf[i].low = stats->cdf[i].high = (double)NAN;
    }
    mean_make(stats);
    qsort(stats->row, plan->rows, sizeof *stats->row, by_sigma);
    bins_choose(stats);
    for (int which = END_LEAST; which <= (band ? END_HIGH : END_MOST); which++) {
        percentiles_at(stats, end, which);
    }
    free(end);
    return 0;
}

void cli_stats_free(sweep_stats *stats)
{
    free(stats->row);
    stats->row = NULL;
}
