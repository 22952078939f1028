/* SPDX-License-Identifier: MIT */
/* Where the fit of readings starts: a grid of s and m. At each node A and B minimize the sum of
   absolute residuals, on which single readings have little influence. This file decides the grid
   and which of its nodes are starting points. */
#include "analysis/fit_search.h"

#include <math.h>
#include <string.h>

#include "base/range.h"

/* The nodes of the grid in log(s) and log(1 + m). */
#define SEARCH_S_STEPS 24
#define SEARCH_M_STEPS 10

/* Least squares, reweighted with the inverse of the previous residuals: after five passes the sum
   of absolute residuals is close enough to its minimum for a starting point. A residual below this
   fraction of their mean is weighted as if it were that large. */
#define SEARCH_PASSES 5
#define SEARCH_FLOOR  0.01

static lrcsi_fit_parameters node_parameters(const lrcsi_fit_data *data, int i_s, int i_m)
{
    lrcsi_fit_parameters parameters = {{0.0}, 0.0};
    const int step[2] = {i_s, i_m};
    const int steps[2] = {SEARCH_S_STEPS - 1, SEARCH_M_STEPS - 1};
    for (int k = 0; k < 2; k++) {
        int p = LRCS_FIT_S + k;
        double fraction = (double)step[k] / steps[k];
        parameters.at[p] = data->low[p] + fraction * (data->high[p] - data->low[p]);
    }
    return parameters;
}

/* The sum of absolute residuals, from weighted ones in residual[]. */
static double node_sum(const lrcsi_fit_data *data)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < data->count; i++) {
        sum += fabs(data->residual[i]) * (data->inverse[i] / data->weight[i]);
    }
    return sum;
}

/* Weights readings and columns by the inverse of the residuals, each taken as at least SEARCH_FLOOR
   of their mean. */
static void node_weigh(lrcsi_fit_data *data, double mean)
{
    double floor = lrcsi_max(SEARCH_FLOOR * mean, 0x1p-500);
    for (uint32_t i = 0; i < data->count; i++) {
        double deviation = fabs(data->residual[i]) * (data->inverse[i] / data->weight[i]);
        double weight = data->inverse[i] / sqrt(lrcsi_max(deviation, floor));
        data->column[LRCS_FIT_A][i] *= weight / data->weight[i];
        data->column[LRCS_FIT_B][i] *= weight / data->weight[i];
        data->weight[i] = weight;
    }
}

/* The least sum of absolute residuals for the s and m of a node. */
static double node_minimize(lrcsi_fit_data *data, const lrcsi_fit_parameters *node)
{
    const unsigned shapes = 1u << LRCS_FIT_S | 1u << LRCS_FIT_M;
    lrcsi_fit_parameters parameters = *node;
    lrcsi_fit_normal normal;
    memcpy(data->weight, data->inverse, data->count * sizeof *data->weight);
    lrcsi_fit_columns(data, &parameters);
    lrcsi_fit_amplitudes(data, shapes, &parameters, &normal);
    double sum = node_sum(data);
    for (int pass = 1; pass < SEARCH_PASSES; pass++) {
        node_weigh(data, sum / data->count);
        lrcsi_fit_amplitudes(data, shapes, &parameters, &normal);
        sum = node_sum(data);
    }
    return sum;
}

static int is_local_minimum(double sum[SEARCH_S_STEPS][SEARCH_M_STEPS], int i_s, int i_m)
{
    for (int i = i_s - 1; i <= i_s + 1; i++) {
        for (int k = i_m - 1; k <= i_m + 1; k++) {
            int inside = i >= 0 && i < SEARCH_S_STEPS && k >= 0 && k < SEARCH_M_STEPS;
            int before = i < i_s || (i == i_s && k < i_m); /* the first of equal values counts */
            if (inside && (sum[i][k] < sum[i_s][i_m] || (before && sum[i][k] == sum[i_s][i_m]))) {
                return 0;
            }
        }
    }
    return 1;
}

/* Inserts a starting point in order, the smallest sum first; the last one is dropped. */
static uint32_t start_enter(lrcsi_fit_parameters start[LRCSI_FIT_STARTS], uint32_t count,
                            const lrcsi_fit_parameters *parameters)
{
    uint32_t at = count;
    while (at > 0 && start[at - 1].square > parameters->square) {
        at--;
    }
    if (at == LRCSI_FIT_STARTS) {
        return count;
    }
    count += count < LRCSI_FIT_STARTS;
    for (uint32_t k = count - 1; k > at; k--) {
        start[k] = start[k - 1];
    }
    start[at] = *parameters;
    return count;
}

uint32_t lrcsi_fit_search(lrcsi_fit_data *data, lrcsi_fit_parameters start[LRCSI_FIT_STARTS])
{
    double sum[SEARCH_S_STEPS][SEARCH_M_STEPS];
    uint32_t count = 0;
    for (int i = 0; i < SEARCH_S_STEPS; i++) {
        for (int k = 0; k < SEARCH_M_STEPS; k++) {
            lrcsi_fit_parameters parameters = node_parameters(data, i, k);
            sum[i][k] = node_minimize(data, &parameters);
        }
    }
    for (int i = 0; i < SEARCH_S_STEPS; i++) {
        for (int k = 0; k < SEARCH_M_STEPS; k++) {
            lrcsi_fit_parameters parameters = node_parameters(data, i, k);
            parameters.square = sum[i][k];
            count = is_local_minimum(sum, i, k) ? start_enter(start, count, &parameters) : count;
        }
    }
    return count;
}
