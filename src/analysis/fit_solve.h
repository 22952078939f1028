/* SPDX-License-Identifier: MIT */
/* What the rooms of the fit share: the readings as a least-squares problem, and its descent. */
#ifndef LRCSI_FIT_SOLVE_H
#define LRCSI_FIT_SOLVE_H

#include <lrcs/fit.h>

/* The coordinates of a fit are A, B, log(s), log(1 + m), in the order of lrcs_fit_index. */
typedef struct lrcsi_fit_spot {
    double at[LRCS_FIT_PARAMETERS];
    double square; /* sum of weighted squares of the residuals */
} lrcsi_fit_spot;

/* The readings as vectors. */
typedef struct lrcsi_fit_data {
    uint32_t count;
    double least[LRCS_FIT_PARAMETERS], most[LRCS_FIT_PARAMETERS]; /* where coordinates may be */
    double *u, *log_w;                                            /* tan^2, log(1 + tan^2) */
    double *factor;  /* cos(theta) where readings fall with it, else 1 */
    double *y;       /* readings, the largest about 1 */
    double *inverse; /* 1 / (error expected of a reading) but for a common factor */
    double *weight;  /* that, or less; 0 leaves the reading out */
    double *column[LRCS_FIT_PARAMETERS]; /* weighted derivatives by A, B, and by log(s) and
                                            log(1 + m) for A = 1 and B = 1 */
    double *rest;                        /* y - f, weighted by whoever fills it or not */
    double *spare;
} lrcsi_fit_data;

/* The sums over the readings at a spot that a step needs. */
typedef struct lrcsi_fit_normal {
    double gram[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS]; /* of the columns */
    double slope[LRCS_FIT_PARAMETERS];                     /* columns by weighted residuals */
} lrcsi_fit_normal;

/* Fills the columns at a spot's s and m, weighted. */
void lrcsi_fit_columns(const lrcsi_fit_data *data, const lrcsi_fit_spot *spot);

/* Fills rest[] at a spot, all of it, not weighted. */
void lrcsi_fit_rests(const lrcsi_fit_data *data, const lrcsi_fit_spot *spot);

/* The best A and B >= 0 for the columns as they are, but for those in `fixed` (bits 1 << index),
   which stay; the sum of squares and the sums there (of A and B alone where s and m are fixed), and
   in rest[] the weighted residuals. */
void lrcsi_fit_amplitudes(const lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_spot *spot,
                          lrcsi_fit_normal *normal);

/* The same at the spot's s and m, whose columns are filled first. */
void lrcsi_fit_settle(const lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_spot *spot,
                      lrcsi_fit_normal *normal);

/* Descends from a spot to a local minimum over the coordinates that are not fixed. */
void lrcsi_fit_descend(const lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_spot *spot);

#endif
