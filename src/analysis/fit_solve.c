/* SPDX-License-Identifier: MIT */
/* Weighted least squares of readings by A g(s) + B d(m), from one starting point to one local
   minimum. This file decides the steps of the minimization and when it ends; its callers decide
   which readings count and where to start.

   For every s and m, A and B are solved for (variable projection, G. Golub and V. Pereyra 1973, in
   the form of L. Kaufman 1975): the Gauss-Newton matrix of log(s) and log(1 + m) alone is the Schur
   complement of A and B in that of all four. Steps are damped after Levenberg and Marquardt and
   clipped to the limits of the search. */
#include "analysis/fit_solve.h"

#include <math.h>
#include <string.h>

#include "base/range.h"

/* The numbers of the minimization are choices: what it finds is a minimum to within rounding, from
   whichever steps. */
#define SOLVE_STEPS         80   /* most steps tried */
#define SOLVE_DAMPING       1e-3 /* of the first step */
#define SOLVE_DAMPING_RAISE 8.0  /* its factor after a step that is refused; after others, 1/8 */

/* A step that lowers the sum by less than this fraction is the last one. */
#define SOLVE_CONVERGED 1e-14

/* If no step up to this damping lowers the sum, it is at its minimum to within rounding. */
#define SOLVE_DAMPING_MAX 1e10

/* The largest step in log(s) or log(1 + m): a longer one would leave the range in which the model
   is nearly linear. */
#define SOLVE_STRIDE 1.0

/* A column that is a multiple of another one to within rounding is redundant. */
#define SOLVE_PIVOT 1e-13

/* For x above this, exp(-x) counts as 0. */
#define SOLVE_EXPONENT_MAX 700.0

/* ---- columns, residuals and sums ---- */

void lrcsi_fit_columns(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters)
{
    double s = exp(parameters->at[LRCS_FIT_S]);
    double w_m = exp(parameters->at[LRCS_FIT_M]);
    double half_m = 0.5 * expm1(parameters->at[LRCS_FIT_M]);
    for (uint32_t i = 0; i < data->count; i++) {
        double weight = data->weight[i] * data->factor[i];
        double x = data->u[i] / s / s;
        double exponent = x - 3.0 * data->log_w[i];
        double glint = exponent < SOLVE_EXPONENT_MAX ? weight * exp(-exponent) : 0.0;
        double exponent_m = half_m * data->log_w[i];
        double diffuse = exponent_m < SOLVE_EXPONENT_MAX ? weight * exp(-exponent_m) : 0.0;
        data->column[LRCS_FIT_A][i] = glint;
        data->column[LRCS_FIT_B][i] = diffuse;
        data->column[LRCS_FIT_S][i] = glint > 0.0 ? 2.0 * x * glint : 0.0;
        data->column[LRCS_FIT_M][i] = -0.5 * w_m * data->log_w[i] * diffuse;
    }
}

void lrcsi_fit_residuals(lrcsi_fit_data *data, const lrcsi_fit_parameters *parameters)
{
    double s = exp(parameters->at[LRCS_FIT_S]);
    double half_m = 0.5 * expm1(parameters->at[LRCS_FIT_M]);
    for (uint32_t i = 0; i < data->count; i++) {
        double exponent = data->u[i] / s / s - 3.0 * data->log_w[i];
        double f =
            exponent < SOLVE_EXPONENT_MAX ? parameters->at[LRCS_FIT_A] * exp(-exponent) : 0.0;
        f += parameters->at[LRCS_FIT_B] * exp(-half_m * data->log_w[i]);
        data->residual[i] = data->y[i] - data->factor[i] * f;
    }
}

/* The products of the first `order` columns. */
static void gram_fill(const lrcsi_fit_data *data, int order, lrcsi_fit_normal *normal)
{
    memset(normal, 0, sizeof *normal);
    for (uint32_t i = 0; i < data->count; i++) {
        for (int j = 0; j < order; j++) {
            for (int k = 0; k <= j; k++) {
                normal->gram[j][k] += data->column[j][i] * data->column[k][i];
            }
        }
    }
    for (int j = 0; j < LRCS_FIT_PARAMETERS; j++) {
        for (int k = 0; k < j; k++) {
            normal->gram[k][j] = normal->gram[j][k];
        }
    }
}

/* The gradient and the sum of squares, from the residuals themselves, which avoids cancellation. */
static void gradient_fill(lrcsi_fit_data *data, int order, lrcsi_fit_parameters *parameters,
                          lrcsi_fit_normal *normal)
{
    double sum[LRCS_FIT_PARAMETERS] = {0.0};
    parameters->square = 0.0;
    for (uint32_t i = 0; i < data->count; i++) {
        double residual = data->weight[i] * data->y[i] -
                          parameters->at[LRCS_FIT_A] * data->column[LRCS_FIT_A][i] -
                          parameters->at[LRCS_FIT_B] * data->column[LRCS_FIT_B][i];
        data->residual[i] = residual;
        parameters->square += residual * residual;
        for (int j = 0; j < order; j++) {
            sum[j] += data->column[j][i] * residual;
        }
    }
    memcpy(normal->gradient, sum, sizeof sum);
}

/* ---- A and B ---- */

/* The changes of A and B that make their gradients 0; only coordinates in `moving` change. */
static void amplitude_step(const lrcsi_fit_normal *normal, unsigned moving, double step[2])
{
    double a = normal->gram[0][0];
    double b = normal->gram[1][1];
    double ab = normal->gram[0][1];
    double det = a * b - ab * ab;
    step[0] = (moving & 1u) && a > 0.0 ? normal->gradient[0] / a : 0.0;
    step[1] = (moving & 2u) && b > 0.0 ? normal->gradient[1] / b : 0.0;
    if (moving == 3u && det > SOLVE_PIVOT * a * b) {
        step[0] = (b * normal->gradient[0] - ab * normal->gradient[1]) / det;
        step[1] = (a * normal->gradient[1] - ab * normal->gradient[0]) / det;
    }
}

/* Which of A and B are above 0 in the best solution, found from the gradients at A = B = 0 (or
   at their values if fixed). */
static unsigned amplitude_active(const lrcsi_fit_normal *normal, unsigned free)
{
    double step[2];
    amplitude_step(normal, free, step);
    double a = normal->gram[0][0];
    double b = normal->gram[1][1];
    if (free == 3u && !(a * b - normal->gram[0][1] * normal->gram[0][1] > SOLVE_PIVOT * a * b)) {
        return a >= b ? 1u : 2u; /* one column is a multiple of the other */
    }
    if (free != 3u || (step[0] >= 0.0 && step[1] >= 0.0)) {
        return free & ((step[0] > 0.0 ? 1u : 0u) | (step[1] > 0.0 ? 2u : 0u));
    }
    const double alone[2] = {a > 0.0 ? lrcsi_max(normal->gradient[0], 0.0) / sqrt(a) : 0.0,
                             b > 0.0 ? lrcsi_max(normal->gradient[1], 0.0) / sqrt(b) : 0.0};
    if (alone[0] == 0.0 && alone[1] == 0.0) {
        return 0;
    }
    return alone[0] > alone[1] ? 1u : 2u;
}

void lrcsi_fit_amplitudes(lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_parameters *parameters,
                          lrcsi_fit_normal *normal)
{
    unsigned free = 3u & ~fixed;
    int order = fixed >> LRCS_FIT_S == 3u ? 2 : LRCS_FIT_PARAMETERS;
    double step[2];
    gram_fill(data, order, normal);
    for (int k = 0; k < 2; k++) {
        parameters->at[k] = (free & (1u << k)) ? 0.0 : parameters->at[k];
    }
    gradient_fill(data, order, parameters, normal);
    unsigned active = amplitude_active(normal, free);
    for (int pass = 0; pass < 2 && active; pass++) { /* the second pass removes rounding errors */
        amplitude_step(normal, active, step);
        for (int k = 0; k < 2; k++) {
            parameters->at[k] =
                lrcsi_min(data->high[k], lrcsi_max(0.0, parameters->at[k] + step[k]));
        }
        gradient_fill(data, order, parameters, normal);
    }
}

void lrcsi_fit_evaluate(lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_parameters *parameters,
                        lrcsi_fit_normal *normal)
{
    lrcsi_fit_columns(data, parameters);
    lrcsi_fit_amplitudes(data, fixed, parameters, normal);
}

/* ---- s and m ---- */

/* The matrix of log(s) and log(1 + m) with A and B eliminated, and the gradient. */
typedef struct solve_shape {
    double matrix[2][2], gradient[2];
    int moves[2];
} solve_shape;

static solve_shape shape_make(const lrcsi_fit_data *data, unsigned fixed,
                              const lrcsi_fit_parameters *parameters,
                              const lrcsi_fit_normal *normal)
{
    const double scale[LRCS_FIT_PARAMETERS] = {1.0, 1.0, parameters->at[LRCS_FIT_A],
                                               parameters->at[LRCS_FIT_B]};
    double m[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS];
    double r[LRCS_FIT_PARAMETERS];
    for (int j = 0; j < LRCS_FIT_PARAMETERS; j++) {
        r[j] = scale[j] * normal->gradient[j];
        for (int k = 0; k < LRCS_FIT_PARAMETERS; k++) {
            m[j][k] = scale[j] * scale[k] * normal->gram[j][k];
        }
    }
    for (int p = 0; p < 2; p++) {
        int active = !(fixed & (1u << p)) && parameters->at[p] > 0.0;
        if (!active || !(m[p][p] > SOLVE_PIVOT * normal->gram[p][p])) {
            continue;
        }
        for (int j = p + 1; j < LRCS_FIT_PARAMETERS; j++) {
            double factor = m[j][p] / m[p][p];
            r[j] -= factor * r[p];
            for (int k = p + 1; k < LRCS_FIT_PARAMETERS; k++) {
                m[j][k] -= factor * m[p][k];
            }
        }
    }
    solve_shape shape;
    for (int j = 0; j < 2; j++) {
        int p = LRCS_FIT_S + j;
        int outward =
            r[p] > 0.0 ? parameters->at[p] >= data->high[p] : parameters->at[p] <= data->low[p];
        double whole = scale[p] * scale[p] * normal->gram[p][p];
        shape.moves[j] = !(fixed & (1u << p)) && !outward && m[p][p] > SOLVE_PIVOT * whole;
        shape.gradient[j] = r[p];
        shape.matrix[j][0] = m[p][LRCS_FIT_S];
        shape.matrix[j][1] = m[p][LRCS_FIT_M];
    }
    return shape;
}

/* The damped step; 0 if no coordinate is free. */
static int shape_step(const solve_shape *shape, double damping, double step[2])
{
    double a = shape->matrix[0][0] * (1.0 + damping);
    double b = shape->matrix[1][1] * (1.0 + damping);
    double ab = shape->matrix[0][1];
    double det = a * b - ab * ab;
    step[0] = shape->moves[0] ? shape->gradient[0] / a : 0.0;
    step[1] = shape->moves[1] ? shape->gradient[1] / b : 0.0;
    if (shape->moves[0] && shape->moves[1] && det > SOLVE_PIVOT * a * b) {
        step[0] = (b * shape->gradient[0] - ab * shape->gradient[1]) / det;
        step[1] = (a * shape->gradient[1] - ab * shape->gradient[0]) / det;
    }
    for (int k = 0; k < 2; k++) {
        step[k] = lrcsi_max(-SOLVE_STRIDE, lrcsi_min(SOLVE_STRIDE, step[k]));
    }
    return shape->moves[0] || shape->moves[1];
}

void lrcsi_fit_minimize(lrcsi_fit_data *data, unsigned fixed, lrcsi_fit_parameters *parameters)
{
    lrcsi_fit_normal normal;
    double damping = SOLVE_DAMPING;
    double step[2];
    lrcsi_fit_evaluate(data, fixed, parameters, &normal);
    for (int i = 0; i < SOLVE_STEPS && damping < SOLVE_DAMPING_MAX; i++) {
        solve_shape shape = shape_make(data, fixed, parameters, &normal);
        lrcsi_fit_normal there;
        lrcsi_fit_parameters next = *parameters;
        if (!shape_step(&shape, damping, step)) {
            break;
        }
        for (int k = 0; k < 2; k++) {
            int p = LRCS_FIT_S + k;
            next.at[p] = lrcsi_max(data->low[p], lrcsi_min(data->high[p], next.at[p] + step[k]));
        }
        lrcsi_fit_evaluate(data, fixed, &next, &there);
        if (!(next.square < parameters->square)) {
            damping *= SOLVE_DAMPING_RAISE;
            continue;
        }
        int converged = parameters->square - next.square <= SOLVE_CONVERGED * parameters->square;
        *parameters = next;
        normal = there;
        damping /= SOLVE_DAMPING_RAISE;
        if (converged) {
            break;
        }
    }
}
