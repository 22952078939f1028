/* SPDX-License-Identifier: MIT */
/* Where the fit of readings starts: a grid of s and m, at each of whose nodes A and B have the
   least sum of absolute residuals, which single readings cannot pull far. It decides the grid and
   which of its nodes are starts. */
#include "optics/fit_search.h"

#include <math.h>

#include "base/range.h"

#define SEARCH_SLOPES 28
#define SEARCH_FALLS  12

/* Weighted least squares, the weights the inverse of the residuals before: six passes are near
   enough to the least absolute sum for a start. */
#define SEARCH_PASSES 6

static lrcsi_fit_spot node_spot(const lrcsi_fit_data *data, int slope, int fall)
{
    lrcsi_fit_spot spot = {{0.0}, 0.0};
    const int step[2] = {slope, fall};
    const int steps[2] = {SEARCH_SLOPES - 1, SEARCH_FALLS - 1};
    for (int k = 0; k < 2; k++) {
        int p = LRCS_FIT_S + k;
        double share = (double)step[k] / steps[k];
        spot.at[p] = data->least[p] + share * (data->most[p] - data->least[p]);
    }
    return spot;
}

/* The sum of absolute residuals at a spot, their weights for the next pass. */
static double node_weigh(const lrcsi_fit_data *data, const lrcsi_fit_spot *spot, double floor)
{
    double sum = 0.0;
    lrcsi_fit_rests(data, spot);
    for (uint32_t i = 0; i < data->count; i++) {
        double off = fabs(data->rest[i]) * data->inverse[i];
        sum += off;
        data->weight[i] = data->inverse[i] / sqrt(lrcsi_most(off, floor));
    }
    return sum;
}

static double node_sum(const lrcsi_fit_data *data, lrcsi_fit_spot *spot)
{
    const unsigned shape = 1u << LRCS_FIT_S | 1u << LRCS_FIT_M;
    lrcsi_fit_normal normal;
    double floor = 1.0;
    double sum = 0.0;
    for (uint32_t i = 0; i < data->count; i++) {
        data->weight[i] = data->inverse[i];
    }
    for (int pass = 0; pass < SEARCH_PASSES; pass++) {
        lrcsi_fit_settle(data, shape, spot, &normal);
        sum = node_weigh(data, spot, floor);
        if (pass == 0 || sum / data->count < 100.0 * floor) {
            floor = lrcsi_most(0.01 * sum / data->count, 0x1p-500);
            node_weigh(data, spot, floor);
        }
    }
    return sum;
}

static int is_least(double sum[SEARCH_SLOPES][SEARCH_FALLS], int slope, int fall)
{
    for (int i = slope - 1; i <= slope + 1; i++) {
        for (int k = fall - 1; k <= fall + 1; k++) {
            int inside = i >= 0 && i < SEARCH_SLOPES && k >= 0 && k < SEARCH_FALLS;
            int before = i < slope || (i == slope && k < fall); /* of equals the first */
            if (inside &&
                (sum[i][k] < sum[slope][fall] || (before && sum[i][k] == sum[slope][fall]))) {
                return 0;
            }
        }
    }
    return 1;
}

/* Enters a start in its order, the least first; the last one falls out. */
static uint32_t start_enter(lrcsi_fit_spot start[LRCSI_FIT_STARTS], uint32_t count,
                            const lrcsi_fit_spot *spot)
{
    uint32_t at = count;
    while (at > 0 && start[at - 1].square > spot->square) {
        at--;
    }
    if (at == LRCSI_FIT_STARTS) {
        return count;
    }
    count += count < LRCSI_FIT_STARTS;
    for (uint32_t k = count - 1; k > at; k--) {
        start[k] = start[k - 1];
    }
    start[at] = *spot;
    return count;
}

uint32_t lrcsi_fit_search(const lrcsi_fit_data *data, lrcsi_fit_spot start[LRCSI_FIT_STARTS])
{
    double sum[SEARCH_SLOPES][SEARCH_FALLS];
    uint32_t count = 0;
    for (int i = 0; i < SEARCH_SLOPES; i++) {
        for (int k = 0; k < SEARCH_FALLS; k++) {
            lrcsi_fit_spot spot = node_spot(data, i, k);
            sum[i][k] = node_sum(data, &spot);
        }
    }
    for (int i = 0; i < SEARCH_SLOPES; i++) {
        for (int k = 0; k < SEARCH_FALLS; k++) {
            lrcsi_fit_spot spot = node_spot(data, i, k);
            spot.square = sum[i][k];
            count = is_least(sum, i, k) ? start_enter(start, count, &spot) : count;
        }
    }
    return count;
}
