/* SPDX-License-Identifier: MIT */
/* Fits a material to readings of its BRDF: the readings are scaled to about 1, starting points are
   found and minimized, outliers excluded, and limits computed. This file decides the order of these
   steps and the verdict that an interval gives on a parameter; each step has a file of its own
   (fit_*.c). */
#include <lrcs/fit.h>

#include <math.h>
#include <string.h>

#include "analysis/fit_presence.h"
#include "analysis/fit_profile.h"
#include "analysis/fit_robust.h"
#include "analysis/fit_search.h"
#include "base/degrees.h"
#include "base/range.h"
#include "base/work.h"
#include "optics/special.h"

/* The number of vectors of lrcsi_fit_data. */
#define FIT_VECTORS 12u

/* The limits of the search. Beyond them the model loses its meaning (for s > 0.7 the glint does
   not peak at the normal). */
#define FIT_S_MAX         2.0
#define FIT_M_MAX         1000.0
#define FIT_AMPLITUDE_MAX 1e9
#define FIT_S_DIVISOR     6.0 /* s a sixth of the smallest tangent: a glint is exp(-36) there */

/* For the first estimate of relative errors: readings below this fraction of the largest are as
   uncertain as a reading of this fraction. */
#define FIT_FLOOR 0.01

/* Upper limits of the largest f_r, and of the largest f_r in standard errors, of which determinants
   take the fourth power; the lower limits are their reciprocals. */
#define FIT_SIZE_MAX  1e100
#define FIT_RATIO_MAX 1e70

#define FIT_TRIM_ROUNDS 20 /* rounds of excluding outliers */
#define FIT_REPEATS     4  /* fits repeated after a profile has found a better one */

/* Errors that follow the fit have converged if the sum of squares changes by less than this. */
#define FIT_CONVERGED 1e-6

/* The variance that rounding leaves in readings that fit exactly, relative to their squares. */
#define FIT_ROUNDING 0x1p-100

lrcs_fit_options lrcs_fit_options_default(void)
{
    return (lrcs_fit_options){1.0, 0, LRCS_FIT_ABSOLUTE};
}

size_t lrcs_fit_need(uint32_t count)
{
    size_t one = lrcsi_work_bytes(count, sizeof(double));
    size_t need = 0;
    for (uint32_t i = 0; i < FIT_VECTORS; i++) {
        need = lrcsi_work_add(need, one);
    }
    return need;
}

/* ---- readings as vectors ---- */

/* 1 if a size is within its limits; 0 if not, or if it is a NaN. */
static int size_is_good(double size, double high)
{
    return size > 1.0 / high && size < high;
}

/* Checks options and readings. Returned: the largest absolute value of the readings. */
static int readings_check(const lrcs_fit_reading *reading, uint32_t count,
                          const lrcs_fit_options *options, double *largest)
{
    double highest = 0.0; /* by its sign */
    int given = options->noise == LRCS_FIT_GIVEN || options->noise == LRCS_FIT_WEIGHTED;
    *largest = 0.0;
    if (!(options->unit > 0.0 && isfinite(options->unit)) || options->noise < LRCS_FIT_ABSOLUTE ||
        options->noise > LRCS_FIT_WEIGHTED) {
        return LRCS_E_ARGUMENT;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!(fabs(reading[i].angle_deg) < 90.0) || !isfinite(reading[i].value)) {
            return LRCS_E_NUMBER;
        }
        highest = lrcsi_max(highest, reading[i].value);
        *largest = lrcsi_max(*largest, fabs(reading[i].value));
    }
    if (count < LRCS_FIT_READINGS || !(highest > 0.0)) {
        return LRCS_E_EMPTY;
    }
    int good = size_is_good(options->unit * *largest, FIT_SIZE_MAX);
    for (uint32_t i = 0; i < count && given && good; i++) {
        good = size_is_good(*largest / reading[i].sigma, FIT_RATIO_MAX);
    }
    return good ? LRCS_OK : LRCS_E_NUMBER;
}

static int data_take(lrcs_work *work, uint32_t count, lrcsi_fit_data *data)
{
    double **vector[FIT_VECTORS] = {&data->u,         &data->log_w,     &data->factor,
                                    &data->y,         &data->inverse,   &data->weight,
                                    &data->column[0], &data->column[1], &data->column[2],
                                    &data->column[3], &data->residual,  &data->spare};
    data->count = count;
    for (uint32_t i = 0; i < FIT_VECTORS; i++) {
        *vector[i] = lrcsi_work_take(work, count, sizeof(double));
        if (!*vector[i]) {
            return LRCS_E_MEMORY;
        }
    }
    return LRCS_OK;
}

/* Fills the vectors:
   1. tan^2 and log(1 + tan^2) of the angles;
   2. the readings, divided by the power of two just below the largest: an exact operation, after
      which no square overflows;
   3. 1 / (the first estimate of the error of a reading);
   4. the limits of the search for each coordinate. */
static void data_fill(const lrcs_fit_reading *reading, const lrcs_fit_options *options,
                      double scale, lrcsi_fit_data *data)
{
    double tan2_min = HUGE_VAL; /* the smallest above 0 */
    for (uint32_t i = 0; i < data->count; i++) {
        double sine;
        double cosine;
        lrcsi_degrees_sincos(reading[i].angle_deg, &sine, &cosine); /* 1 */
        data->u[i] = sine / cosine * (sine / cosine);
        data->log_w[i] = log1p(data->u[i]);
        tan2_min = data->u[i] > 0.0 ? lrcsi_min(tan2_min, data->u[i]) : tan2_min;
        data->factor[i] = options->cosine ? cosine : 1.0;
        data->y[i] = reading[i].value / scale;                       /* 2 */
        data->inverse[i] = options->noise == LRCS_FIT_ABSOLUTE ? 1.0 /* 3 */
                           : options->noise == LRCS_FIT_RELATIVE
                               ? 1.0 / lrcsi_max(fabs(data->y[i]), FIT_FLOOR)
                               : scale / reading[i].sigma;
    }
    double slope = lrcsi_min(sqrt(tan2_min) / FIT_S_DIVISOR, 0.1 * FIT_S_MAX); /* 4 */
    const double high[] = {FIT_AMPLITUDE_MAX, FIT_AMPLITUDE_MAX, log(FIT_S_MAX), log1p(FIT_M_MAX)};
    const double low[] = {0.0, 0.0, log(slope), 0.0};
    memcpy(data->low, low, sizeof low);
    memcpy(data->high, high, sizeof high);
}

/* ---- the fit ---- */

typedef struct fit_job {
    lrcsi_fit_data data;
    int noise;
    lrcsi_fit_parameters start[LRCSI_FIT_STARTS];
    uint32_t starts;
    uint32_t kept;
    lrcsi_fit_parameters full; /* the best fit of all four parameters */
    lrcsi_fit_parameters best; /* that, or the best fit without an insignificant term */
    int absent[2];             /* A or B of the term that is not significant */
    double error;              /* standard deviation of a weighted residual */
    double rise;               /* of the sum of squares at the confidence limits */
    lrcsi_fit_spread spread;
    double limit[LRCS_FIT_PARAMETERS][2];
} fit_job;

/* The lowest minimum from all starting points and from the fit so far, with A or B held at 0 if
   `without` names it. */
static lrcsi_fit_parameters starts_minimize(fit_job *job, unsigned without)
{
    lrcsi_fit_parameters best = job->full;
    for (uint32_t i = 0; i <= job->starts; i++) {
        lrcsi_fit_parameters parameters = i > 0 ? job->start[i - 1] : job->full;
        for (int k = 0; k < 2; k++) {
            parameters.at[k] = (without & (1u << k)) ? 0.0 : parameters.at[k];
        }
        lrcsi_fit_minimize(&job->data, without, &parameters);
        best = i == 0 || parameters.square < best.square ? parameters : best;
    }
    return best;
}

/* Least squares over the readings that are kept: outliers and errors are updated until they no
   longer change. */
static void full_fit(fit_job *job)
{
    lrcsi_fit_noise(&job->data, job->noise, &job->full);
    for (int i = 0; i < FIT_TRIM_ROUNDS; i++) {
        int changed = lrcsi_fit_trim(&job->data, &job->full);
        double before = job->full.square;
        job->full = starts_minimize(job, 0);
        lrcsi_fit_noise(&job->data, job->noise, &job->full);
        int moved = fabs(job->full.square - before) > FIT_CONVERGED * before;
        if (!changed && (job->noise != LRCS_FIT_RELATIVE || !moved)) {
            break;
        }
    }
    job->kept = 0;
    for (uint32_t i = 0; i < job->data.count; i++) {
        job->kept += job->data.weight[i] > 0.0;
    }
}

/* The fit that is reported: without the less significant term if that is not significant, or else
   without the other term if that is not significant, or else with both. */
static void terms_choose(fit_job *job)
{
    lrcsi_fit_parameters without[2];
    int known = job->noise == LRCS_FIT_GIVEN &&
                job->full.square < (double)(job->kept - LRCS_FIT_PARAMETERS);
    for (int k = 0; k < 2; k++) {
        without[k] = starts_minimize(job, 1u << k);
        job->absent[k] = 0;
    }
    job->best = job->full;
    int weaker = without[1].square < without[0].square;
    for (int i = 0; i < 2; i++) {
        int term = i == 0 ? weaker : !weaker;
        if (!lrcsi_fit_presence(&job->data, term, &without[term], job->full.square, job->kept,
                                known)) {
            job->absent[term] = 1;
            job->best = without[term];
            return;
        }
    }
}

/* The sum of the squares of readings: by their weights, or, if `all`, by their expected errors. */
static double readings_size(const lrcsi_fit_data *data, int all)
{
    double size = 0.0;
    for (uint32_t i = 0; i < data->count; i++) {
        double y = (all ? data->inverse[i] : data->weight[i]) * data->y[i];
        size += y * y;
    }
    return size;
}

/* The variance of the errors, estimated from the residuals; each term that is present has two
   parameters. It is at least that of rounding; if the squares of all kept readings vanish, the
   rounding of excluded readings counts too. */
static void errors_estimate(fit_job *job)
{
    int terms = 2 - job->absent[0] - job->absent[1];
    uint32_t freedom = job->kept - 2 * (uint32_t)terms;
    double rounding = FIT_ROUNDING * readings_size(&job->data, 0) / job->kept;
    double variance = lrcsi_max(job->best.square / freedom, rounding);
    if (!(variance > 0.0)) {
        variance = FIT_ROUNDING * readings_size(&job->data, 1) / job->kept;
    }
    int known = job->noise == LRCS_FIT_GIVEN && variance < 1.0;
    double t = lrcsi_special_student(known ? UINT32_MAX : freedom);
    job->error = sqrt(variance);
    job->rise = (known ? 1.0 : variance) * t * t;
}

/* Makes the fit:
   1. minimizes from all starting points with Huber's weights. They are ordered by the sum of
      absolute residuals, on which a few outliers have little influence;
   2. fits all four parameters, excluding outliers, and leaves out a term that is not significant;
   3. estimates the errors, and finds the confidence limits. If a better fit is found on the way, 2
      and 3 are repeated from there. */
static void fit_make(fit_job *job)
{
    int done = 0;
    uint32_t best = 0;
    double sum_min = HUGE_VAL;
    job->starts = lrcsi_fit_search(&job->data, job->start); /* 1 */
    for (uint32_t i = 0; i < job->starts; i++) {
        double sum = lrcsi_fit_huber(&job->data, job->noise, &job->start[i]);
        best = sum < sum_min ? i : best;
        sum_min = lrcsi_min(sum, sum_min);
    }
    lrcsi_fit_parameters first = job->start[best];
    job->start[best] = job->start[0];
    job->start[0] = first;
    job->full = first;
    for (int repeat = 0; repeat < FIT_REPEATS && !done; repeat++) {
        full_fit(job);
        terms_choose(job);
        errors_estimate(job);
        int known = job->noise == LRCS_FIT_GIVEN && job->error < 1.0;
        unsigned fixed = (job->absent[0] ? 1u << LRCS_FIT_A | 1u << LRCS_FIT_S : 0u) |
                         (job->absent[1] ? 1u << LRCS_FIT_B | 1u << LRCS_FIT_M : 0u);
        job->spread =
            lrcsi_fit_spread_make(&job->data, fixed, &job->best, known ? 1.0 : job->error);
        done = lrcsi_fit_profile(&job->data, &job->spread, job->rise, &job->best, &job->full,
                                 job->limit);
    }
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        if (job->absent[p % 2]) {
            job->limit[p][0] = p < LRCS_FIT_S ? 0.0 : -HUGE_VAL;
            job->limit[p][1] = p < LRCS_FIT_S ? job->limit[p][1] : HUGE_VAL;
        }
    }
}

/* ---- the result ---- */

/* The range of angles of the kept readings, and the number of different angles, counted up to the
   number of parameters. */
static void angles_count(const lrcs_fit_reading *reading, const lrcsi_fit_data *data, lrcs_fit *fit)
{
    double last = -1.0;
    fit->least_deg = 90.0;
    fit->most_deg = 0.0;
    for (uint32_t i = 0; i < data->count; i++) {
        double angle = fabs(reading[i].angle_deg);
        fit->least_deg = data->weight[i] > 0.0 ? fmin(fit->least_deg, angle) : fit->least_deg;
        fit->most_deg = data->weight[i] > 0.0 ? fmax(fit->most_deg, angle) : fit->most_deg;
    }
    fit->angles = 0;
    while (fit->angles < LRCS_FIT_PARAMETERS && last < fit->most_deg) {
        double next = fit->most_deg; /* the smallest angle above the last one */
        for (uint32_t i = 0; i < data->count; i++) {
            double angle = fabs(reading[i].angle_deg);
            next = data->weight[i] > 0.0 && angle > last ? lrcsi_min(next, angle) : next;
        }
        last = next;
        fit->angles++;
    }
}

/* Converts from coordinates to the parameters' own units. */
static double parameter_value(int p, double at, double unit)
{
    return p < LRCS_FIT_S ? at * unit : p == LRCS_FIT_S ? exp(at) : expm1(at);
}

static int parameter_verdict(int p, const double limit[2], int absent)
{
    int open = limit[0] == -HUGE_VAL || (limit[0] == 0.0 && p < LRCS_FIT_S);
    if (p >= LRCS_FIT_S && absent) {
        return LRCS_FIT_UNDEFINED;
    }
    if (limit[1] == HUGE_VAL) {
        return open || (p == LRCS_FIT_M && limit[0] == 0.0) ? LRCS_FIT_FREE : LRCS_FIT_AT_LEAST;
    }
    return !open ? LRCS_FIT_DETERMINED : p < LRCS_FIT_S ? LRCS_FIT_ABSENT : LRCS_FIT_AT_MOST;
}

static void parameters_fill(const fit_job *job, double unit, lrcs_fit *fit)
{
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        int term = p % 2;
        double at = job->best.at[p];
        int none = job->best.at[term] == 0.0;
        double by_coordinate =
            p < LRCS_FIT_S ? unit
                           : exp(at); /* for s and 1 + m, the exponential of the coordinate */
        fit->parameter[p] = (lrcs_fit_parameter){
            .value = none ? 0.0 : parameter_value(p, at, unit),
            .error = job->spread.error[p] * by_coordinate,
            .low = lrcsi_max(0.0, parameter_value(p, job->limit[p][0], unit)),
            .high = parameter_value(p, job->limit[p][1], unit),
            .verdict = parameter_verdict(p, job->limit[p], job->limit[term][0] == 0.0)};
    }
    memcpy(fit->correlation, job->spread.correlation, sizeof fit->correlation);
    fit->brdf = (lrcs_brdf){fit->parameter[LRCS_FIT_A].value, fit->parameter[LRCS_FIT_B].value,
                            fit->parameter[LRCS_FIT_S].value, fit->parameter[LRCS_FIT_M].value};
}

/* The residuals, and their root mean square over the kept readings, in the readings' unit. */
static double points_fill(fit_job *job, double scale, lrcs_fit_point *point)
{
    lrcsi_fit_data *data = &job->data;
    double square = 0.0;
    lrcsi_fit_residuals(data, &job->best);
    for (uint32_t i = 0; i < data->count; i++) {
        int keep = data->weight[i] > 0.0;
        square += keep ? data->residual[i] * data->residual[i] : 0.0;
        if (point) {
            point[i] = (lrcs_fit_point){scale * (data->y[i] - data->residual[i]),
                                        scale * data->residual[i],
                                        data->residual[i] * data->inverse[i] / job->error, !keep};
        }
    }
    return scale * sqrt(square / job->kept);
}

int lrcs_fit_run(const lrcs_fit_reading *reading, uint32_t count, const lrcs_fit_options *options,
                 lrcs_work *work, lrcs_fit *fit, lrcs_fit_point *point)
{
    double largest = 0.0;
    size_t mark = work->used;
    fit_job job;
    int status = readings_check(reading, count, options, &largest);
    status = status == LRCS_OK ? data_take(work, count, &job.data) : status;
    work->used = mark;
    if (status != LRCS_OK) {
        return status;
    }
    double scale = ldexp(1.0, ilogb(largest));
    job.noise = options->noise;
    data_fill(reading, options, scale, &job.data);
    fit_make(&job);
    fit->starts = job.starts;
    fit->kept = job.kept;
    fit->noise = job.error * (job.noise == LRCS_FIT_ABSOLUTE ? scale * options->unit : 1.0);
    fit->rms = points_fill(&job, scale, point) * options->unit;
    angles_count(reading, &job.data, fit);
    parameters_fill(&job, scale * options->unit, fit);
    return LRCS_OK;
}

const char *lrcs_fit_verdict_text(int parameter, int verdict)
{
    static const char *const text[][LRCS_FIT_PARAMETERS] = {
        [LRCS_FIT_DETERMINED] = {"determined", "determined", "determined", "determined"},
        [LRCS_FIT_ABSENT] = {"may be 0: no glint is needed to explain the readings",
                             "may be 0: no diffuse term is needed to explain the readings"},
        [LRCS_FIT_UNDEFINED] = {[LRCS_FIT_S] = "not determined: there may be no glint",
                                [LRCS_FIT_M] = "not determined: there may be no diffuse term"},
        [LRCS_FIT_AT_MOST] = {[LRCS_FIT_S] =
                                  "not determined, only an upper limit: the glint may be "
                                  "narrower, with too few readings on its slope"},
        [LRCS_FIT_AT_LEAST] = {"not determined, only a lower limit: the readings begin on the "
                               "slope of the glint",
                               "not determined, only a lower limit: the readings begin too far "
                               "from the normal",
                               "not determined, only a lower limit: so wide a glint looks diffuse",
                               "not determined, only a lower limit: the diffuse term may be as "
                               "narrow as a glint"},
        [LRCS_FIT_FREE] = {"not determined: a glint narrower than the smallest angle read would "
                           "not be seen",
                           "not determined: the readings begin too far from the normal",
                           "not determined: the readings do not limit it",
                           "not determined: the readings do not limit it"}};
    int known = parameter >= 0 && parameter < LRCS_FIT_PARAMETERS && verdict >= 0 &&
                verdict <= LRCS_FIT_FREE;
    return known && text[verdict][parameter] ? text[verdict][parameter] : "unknown verdict";
}
