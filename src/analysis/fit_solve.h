/* SPDX-License-Identifier: MIT */
/* Shared by the modules of the fit: the readings as a least-squares problem, and how it is
   minimized. */
#ifndef LRCSI_FIT_SOLVE_H
#define LRCSI_FIT_SOLVE_H

#include <lrcs/fit.h>

/* The coordinates of a fit are A, B, log(s), log(1 + m), in the order of lrcs_fit_index. */
typedef struct lrcsi_fit_parameters {
    double at[LRCS_FIT_PARAMETERS];
    double square; /* sum of weighted squares of the residuals */
} lrcsi_fit_parameters;

/* The readings as arrays, their weights, and room for what is computed at a parameter vector.
   Functions that fill such room take the data without const, and say which of it they use. */
typedef struct lrcsi_fit_data {
    uint32_t count;
    double low[LRCS_FIT_PARAMETERS];  /* search range of each coordinate: from low */
    double high[LRCS_FIT_PARAMETERS]; /* to high */
    /* The readings: */
    double *u, *log_w; /* tan^2, log(1 + tan^2) */
    double *factor;    /* cos(theta) if readings are proportional to it, else 1 */
    double *y;         /* readings, scaled so that the largest is about 1 */
    /* Their weights, revised from one fit to the next: */
    double *inverse; /* 1 / (expected error of a reading), up to a common factor */
    double *weight;  /* at most `inverse`; 0 excludes the reading */
    /* Computed at a parameter vector: */
    double *column[LRCS_FIT_PARAMETERS]; /* weighted derivatives by A, B, and by log(s) and
                                            log(1 + m) for A = 1 and B = 1 */
    double *residual; /* residuals y - f, weighted or not as stated by the function that fills it */
    double *spare;
} lrcsi_fit_data;

/* The sums over the readings at a parameter vector: the normal equations of a step. */
typedef struct lrcsi_fit_normal {
    double gram[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS]; /* of the columns */
    double gradient[LRCS_FIT_PARAMETERS]; /* columns times weighted residuals: minus half
                                             the gradient of the sum of squares */
} lrcsi_fit_normal;

/* Fills the columns, weighted, for the s and m of a parameter vector. */
void lrcsi_fit_columns(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters);

/* Fills residual[] with the residuals of all readings at a parameter vector, unweighted. */
void lrcsi_fit_residuals(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters);

/* Solves for the best A and B >= 0 with the columns as they are; those in `fixed` (bits 1 << index)
   stay unchanged. Also returns the sum of squares and the normal equations there (of A and B only
   if s and m are fixed), and the weighted residuals in residual[]. */
void lrcsi_fit_amplitudes(lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_parameters *parameters,
                          lrcsi_fit_normal *normal);

/* The same, but first fills the columns for the s and m of the parameter vector. */
void lrcsi_fit_evaluate(lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_parameters *parameters,
                        lrcsi_fit_normal *normal);

/* Minimizes from a parameter vector to a local minimum over the coordinates that are not fixed. */
void lrcsi_fit_minimize(lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_parameters *parameters);

#endif
