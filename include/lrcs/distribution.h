/* SPDX-License-Identifier: MIT */
/* The distribution of sigma over many poses: its mean, percentiles, cumulative distribution and
   histogram, each between the least and the most that it can be where sigma of every pose is within
   its bound. These are statistics of the poses given: how sigma varies between them is
   not known. */
#ifndef LRCS_DISTRIBUTION_H
#define LRCS_DISTRIBUTION_H

#include <lrcs/status.h>

/* A pose. Shares of poses are shares of their weights. */
typedef struct lrcs_distribution_row {
    double sigma_m2, bound_m2; /* >= 0 */
    double weight;             /* >= 0, for example the solid angle that the pose stands for */
    double low_m2, high_m2;    /* the interval of its material uncertainty; NAN if there is none */
    uint64_t index;            /* of the pose, for the caller; orders poses of equal sigma */
} lrcs_distribution_row;

/* A number as it follows from sigma of every pose; with every sigma at the lower and at the upper
   end of its bound, which enclose it; and with every sigma at the low and the high end of its
   material interval (NAN if there are none), an estimate (note 2). */
enum lrcs_distribution_end {
    LRCS_DISTRIBUTION_LEAST,
    LRCS_DISTRIBUTION_VALUE,
    LRCS_DISTRIBUTION_MOST,
    LRCS_DISTRIBUTION_LOW,
    LRCS_DISTRIBUTION_HIGH,
    LRCS_DISTRIBUTION_ENDS
};
typedef struct lrcs_distribution_value {
    double at[LRCS_DISTRIBUTION_ENDS];
} lrcs_distribution_value;

#define LRCS_DISTRIBUTION_PERCENTS 9  /* 1, 5, 10, 25, 50, 75, 90, 95, 99 */
#define LRCS_DISTRIBUTION_BINS     30 /* at most */

typedef struct lrcs_distribution {
    uint64_t rows;
    double weight;     /* of all rows */
    int has_intervals; /* 1 if rows have material intervals */
    lrcs_distribution_value mean_m2;
    double standard_error_m2; /* of the mean of rows of equal weight, as if they were drawn at
                                 random; NAN of one row. ESTIMATE */
    int percent[LRCS_DISTRIBUTION_PERCENTS];
    lrcs_distribution_value percentile_m2[LRCS_DISTRIBUTION_PERCENTS];
    uint32_t
        bins; /* of equal width in dB; bin i is (edge[i], edge[i + 1]]; 0 if every sigma is 0 */
    double edge_dbsm[LRCS_DISTRIBUTION_BINS + 1], edge_m2[LRCS_DISTRIBUTION_BINS + 1];
    double cdf[LRCS_DISTRIBUTION_ENDS]
              [LRCS_DISTRIBUTION_BINS + 1];              /* share with sigma <= edge_m2 */
    double share[LRCS_DISTRIBUTION_BINS], largest_share; /* of each bin, and the largest of these */
} lrcs_distribution;

/* Computes a distribution.
   Given: row[count].
   Returned: row, sorted by ascending sigma; distribution. room[count] is scratch memory.
   Status: LRCS_OK; LRCS_E_EMPTY (no row, or all weights 0); LRCS_E_NUMBER (sigma not finite, or
   anything negative or NAN; intervals of some rows only).
   Work: O(count log count).
   Notes: 1. A percentile is the sigma of the first row at which the share of the weight is reached.
   The bins are the narrowest of a round width in dB that cover the range from the smallest sigma
   above 0 to the largest, but at most 100 dB, and are at most LRCS_DISTRIBUTION_BINS.
   2. Materials are the same in all rows, so that their errors move the rows together. With one
   uncertain parameter that moves sigma of all rows the same way, LOW to HIGH is the interval of the
   same probability as those of the rows: mean and percentiles increase with every sigma. With
   several it errs to the wide side: to first order the deviation of the mean is at most the mean of
   the deviations, whatever their correlations (Minkowski's inequality). It is no bound.
   3. LEAST and MOST are bounds to rounding: their own error is included (distribution.c). */
int lrcs_distribution_make(lrcs_distribution_row *row, lrcs_distribution_row *room, uint64_t count,
                           lrcs_distribution *distribution);

#endif
