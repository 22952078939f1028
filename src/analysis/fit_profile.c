/* SPDX-License-Identifier: MIT */
/* How well readings determine the parameters of a fit: by the matrix of its derivatives, and by
   moving one parameter away from the fit, with the others minimized, until the sum of squares has
   risen to the limit. This file decides where that happens; fit.c decides what an interval without
   a finite limit means. */
#include "analysis/fit_profile.h"

#include <math.h>
#include <string.h>

#include "base/range.h"

/* More strides than doublings lead through any range of the search, and more iterations than the
   tolerance below needs. */
#define PROFILE_STRIDES    60
#define PROFILE_ITERATIONS 24

#define PROFILE_SHAPES 12 /* intervals between the values of s or m at which a walk looks */

/* The relative error to which a limit is found, in the square root of the rise. */
#define PROFILE_TOLERANCE 1e-4

/* A sum that is lower than the minimum by more than this fraction of the rise belongs to another
   minimum and is not due to rounding. */
#define PROFILE_LOWER 1e-6

/* Of a matrix whose diagonal is 1: a smaller pivot is a row that depends on others. */
#define PROFILE_PIVOT 1e-12

/* ---- by derivatives ---- */

/* Inverts a symmetric positive matrix in place, in units of its diagonal. Rows that are zero, or
   linearly dependent on others to within rounding, are left out: in[] is 0 for them. */
static void matrix_invert(double m[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS],
                          int in[LRCS_FIT_PARAMETERS])
{
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) { /* Gauss-Jordan elimination, pivots in order */
        in[p] = m[p][p] > PROFILE_PIVOT;
        double pivot = in[p] ? 1.0 / m[p][p] : 0.0;
        for (int j = 0; j < LRCS_FIT_PARAMETERS; j++) {
            double factor = m[j][p] * pivot;
            for (int k = 0; k < LRCS_FIT_PARAMETERS && j != p; k++) {
                m[j][k] -= k == p ? 0.0 : factor * m[p][k];
            }
            m[j][p] = j == p ? pivot : -factor;
        }
        for (int k = 0; k < LRCS_FIT_PARAMETERS; k++) {
            m[p][k] *= k == p ? 1.0 : pivot;
        }
    }
}

lrcsi_fit_spread lrcsi_fit_spread_make(lrcsi_fit_data *data, unsigned fixed,
                                       const lrcsi_fit_parameters *best, double noise)
{
    const double scale[LRCS_FIT_PARAMETERS] = {1.0, 1.0, best->at[LRCS_FIT_A],
                                               best->at[LRCS_FIT_B]};
    double m[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS];
    double length[LRCS_FIT_PARAMETERS];
    int in[LRCS_FIT_PARAMETERS];
    lrcsi_fit_parameters parameters = *best;
    lrcsi_fit_normal normal;
    lrcsi_fit_spread spread;
    lrcsi_fit_evaluate(data, 3u, &parameters, &normal);
    for (int j = 0; j < LRCS_FIT_PARAMETERS; j++) {
        length[j] = (fixed & (1u << j)) ? 0.0 : scale[j] * sqrt(normal.gram[j][j]);
    }
    for (int j = 0; j < LRCS_FIT_PARAMETERS; j++) {
        for (int k = 0; k < LRCS_FIT_PARAMETERS; k++) {
            double both = length[j] * length[k];
            m[j][k] = both > 0.0 ? scale[j] * scale[k] * normal.gram[j][k] / both : 0.0;
        }
    }
    matrix_invert(m, in);
    memset(&spread, 0, sizeof spread);
    for (int j = 0; j < LRCS_FIT_PARAMETERS; j++) {
        spread.error[j] = in[j] ? noise * sqrt(m[j][j]) / length[j] : HUGE_VAL;
        for (int k = 0; k < LRCS_FIT_PARAMETERS; k++) {
            spread.correlation[j][k] = j == k           ? 1.0
                                       : in[j] && in[k] ? m[j][k] / sqrt(m[j][j] * m[k][k])
                                                        : 0.0;
        }
    }
    return spread;
}

/* ---- by profile ---- */

typedef struct profile_walk {
    lrcsi_fit_data *data;
    int parameter;
    double rise;
    const lrcsi_fit_parameters *best, *full;
    lrcsi_fit_parameters last; /* the minimum at the last x below the limit */
    lrcsi_fit_parameters low;  /* the lowest minimum found */
} profile_walk;

/* Minimizes from a parameter vector with the profiled parameter fixed at x; *lowest becomes the
   lower of this minimum and *lowest. */
static void walk_minimize(profile_walk *walk, double x, const lrcsi_fit_parameters *from,
                          lrcsi_fit_parameters *lowest)
{
    lrcsi_fit_parameters parameters = *from;
    parameters.at[walk->parameter] = x;
    lrcsi_fit_minimize(walk->data, 1u << walk->parameter, &parameters);
    *lowest = parameters.square < lowest->square ? parameters : *lowest;
}

/* The best minimum over several shapes of a term, with the profiled parameter at x: a glint may lie
   between readings or be wide, and a maximum may separate the two. A and m use shapes of the glint,
   B and s those of the diffuse term. */
static lrcsi_fit_parameters walk_shape(profile_walk *walk, double x)
{
    int p = walk->parameter;
    int shape = p == LRCS_FIT_A || p == LRCS_FIT_M ? LRCS_FIT_S : LRCS_FIT_M;
    unsigned fixed = 1u << p | 1u << LRCS_FIT_S | 1u << LRCS_FIT_M;
    double low = walk->data->low[shape];
    double high = walk->data->high[shape];
    lrcsi_fit_parameters best = walk->last;
    best.square = HUGE_VAL;
    for (int k = 0; k <= PROFILE_SHAPES; k++) {
        lrcsi_fit_normal normal;
        lrcsi_fit_parameters parameters = walk->last;
        parameters.at[p] = x;
        parameters.at[shape] = low + (high - low) * k / PROFILE_SHAPES;
        lrcsi_fit_evaluate(walk->data, fixed, &parameters, &normal);
        best = parameters.square < best.square ? parameters : best;
    }
    return best;
}

/* The square root of the relative rise at x; it is 1 at the limit. */
static double walk_rise(profile_walk *walk, double x, lrcsi_fit_parameters *parameters)
{
    *parameters = walk->last;
    parameters->square = HUGE_VAL;
    walk_minimize(walk, x, &walk->last, parameters);
    walk_minimize(walk, x, walk->full, parameters);
    lrcsi_fit_parameters from = walk_shape(walk, x);
    walk_minimize(walk, x, &from, parameters);
    if (parameters->square < walk->low.square) {
        walk->low = *parameters;
    }
    return sqrt(lrcsi_max(0.0, parameters->square - walk->best->square) / walk->rise);
}

/* The x between `in` and `out` at which the root of the rise is 1, by the Illinois variant of false
   position: the value at an end that stays is halved. */
static double walk_crossing(profile_walk *walk, double in, double f_in, double out, double f_out)
{
    double f_low = f_in - 1.0;
    double f_high = f_out - 1.0;
    int side = 0;
    for (int i = 0; i < PROFILE_ITERATIONS && fabs(f_high) > PROFILE_TOLERANCE; i++) {
        lrcsi_fit_parameters parameters;
        double x = in + (out - in) * (f_low / (f_low - f_high));
        double f = walk_rise(walk, x, &parameters) - 1.0;
        if (f < 0.0) {
            in = x;
            f_low = f;
            f_high *= side < 0 ? 0.5 : 1.0;
            walk->last = parameters;
            side = -1;
        } else {
            out = x;
            f_high = f;
            f_low *= side > 0 ? 0.5 : 1.0;
            side = 1;
        }
        if (fabs(f) <= PROFILE_TOLERANCE) {
            return x;
        }
    }
    return out;
}

/* The limit on one side, direction -1 or 1; an infinity if the search range ends before it. */
static double walk_limit(profile_walk *walk, double stride, int direction)
{
    const lrcsi_fit_data *data = walk->data;
    int p = walk->parameter;
    double end = direction < 0 ? data->low[p] : data->high[p];
    double in = walk->best->at[p];
    double f_in = 0.0;
    walk->last = *walk->best;
    for (int i = 0; i < PROFILE_STRIDES && direction * (end - in) > 0.0; i++, stride *= 2.0) {
        lrcsi_fit_parameters parameters;
        double x = in + direction * stride;
        x = direction < 0 ? lrcsi_max(x, end) : lrcsi_min(x, end);
        double f = walk_rise(walk, x, &parameters);
        if (f > 1.0) {
            return walk_crossing(walk, in, f_in, x, f);
        }
        in = x;
        f_in = f;
        walk->last = parameters;
    }
    return direction < 0 && end == 0.0 ? 0.0 : direction * HUGE_VAL;
}

int lrcsi_fit_profile(lrcsi_fit_data *data, const lrcsi_fit_spread *spread, double rise,
                      const lrcsi_fit_parameters *best, lrcsi_fit_parameters *full,
                      double limit[LRCS_FIT_PARAMETERS][2])
{
    lrcsi_fit_parameters low = *full;
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        profile_walk walk = {data, p, rise, best, full, *best, low};
        /* The first stride: about where the limit is expected, at most half a unit of a logarithm;
           strides double until the limit is passed. */
        double stride_max = p < LRCS_FIT_S ? HUGE_VAL : 0.5;
        double stride = lrcsi_min(2.0 * spread->error[p], stride_max);
        stride = stride > 0.0 && stride < HUGE_VAL ? stride : 0.1;
        limit[p][0] = walk_limit(&walk, stride, -1);
        limit[p][1] = walk_limit(&walk, stride, 1);
        low = walk.low;
    }
    int lower = full->square - low.square > PROFILE_LOWER * rise;
    *full = lower ? low : *full;
    return !lower;
}
