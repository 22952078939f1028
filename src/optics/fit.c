/* SPDX-License-Identifier: MIT */
/* A material from readings of its BRDF: readings become vectors about 1, starts are sought and
   brought down, outliers set aside, limits found. It decides the order of these steps and what an
   interval says of a parameter; each step has a room of its own (fit_*.c). */
#include <lrcs/fit.h>

#include <math.h>
#include <string.h>

#include "base/degrees.h"
#include "base/range.h"
#include "base/work.h"
#include "optics/fit_profile.h"
#include "optics/fit_search.h"
#include "optics/special.h"

/* The vectors of lrcsi_fit_data. */
#define FIT_VECTORS 12u

/* Where the search ends: beyond what the model means (s > 0.7 peaks off the normal). */
#define FIT_SLOPE_MOST     2.0
#define FIT_FALL_MOST      1000.0
#define FIT_AMPLITUDE_MOST 1e9
#define FIT_SLOPE_SHARE    6.0 /* at a sixth of the smallest tangent a glint is exp(-36) there */

/* For the first look at readings with relative errors: those below this share of the largest are
   as uncertain as this share. */
#define FIT_FIRST_SHARE 0.01

#define FIT_TRIMS 20 /* rounds of setting outliers aside */
#define FIT_LOOKS 4  /* fits after a profile that met a better one */

/* A start ended in the fit where its sum of squares is the same but for the descent's end. */
#define FIT_SAME 1e-6

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

static int reading_is_good(const lrcs_fit_reading *reading, const lrcs_fit_options *options)
{
    int given = options->noise == LRCS_FIT_GIVEN;
    return fabs(reading->angle_deg) < 90.0 && isfinite(reading->value) &&
           isfinite(options->unit * reading->value) &&
           (!given || (reading->sigma > 0.0 && isfinite(reading->sigma)));
}

static int readings_check(const lrcs_fit_reading *reading, uint32_t count,
                          const lrcs_fit_options *options, double *largest)
{
    *largest = 0.0;
    if (!(options->unit > 0.0 && isfinite(options->unit)) || options->noise < LRCS_FIT_ABSOLUTE ||
        options->noise > LRCS_FIT_GIVEN) {
        return LRCS_E_ARGUMENT;
    }
    double most = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        if (!reading_is_good(&reading[i], options)) {
            return LRCS_E_NUMBER;
        }
        most = lrcsi_most(most, reading[i].value);
        *largest = lrcsi_most(*largest, fabs(reading[i].value));
    }
    return count < LRCS_FIT_READINGS || !(most > 0.0) ? LRCS_E_EMPTY : LRCS_OK;
}

static int data_take(lrcs_work *work, uint32_t count, lrcsi_fit_data *data)
{
    double **vector[FIT_VECTORS] = {&data->u,         &data->log_w,     &data->factor,
                                    &data->y,         &data->inverse,   &data->weight,
                                    &data->column[0], &data->column[1], &data->column[2],
                                    &data->column[3], &data->rest,      &data->spare};
    data->count = count;
    for (uint32_t i = 0; i < FIT_VECTORS; i++) {
        *vector[i] = lrcsi_work_take(work, count, sizeof(double));
        if (!*vector[i]) {
            return LRCS_E_MEMORY;
        }
    }
    return LRCS_OK;
}

/* The end of the search for each coordinate. */
static void data_limits(lrcsi_fit_data *data)
{
    double least = HUGE_VAL; /* the smallest tan^2 above 0 */
    for (uint32_t i = 0; i < data->count; i++) {
        least = data->u[i] > 0.0 ? lrcsi_least(least, data->u[i]) : least;
    }
    double slope = lrcsi_least(sqrt(least) / FIT_SLOPE_SHARE, 0.1 * FIT_SLOPE_MOST);
    const double most[] = {FIT_AMPLITUDE_MOST, FIT_AMPLITUDE_MOST, log(FIT_SLOPE_MOST),
                           log1p(FIT_FALL_MOST)};
    const double low[] = {0.0, 0.0, log(slope), 0.0};
    memcpy(data->least, low, sizeof low);
    memcpy(data->most, most, sizeof most);
}

/* Readings by the power of two below the largest: exact, and no square overflows. */
static void data_fill(const lrcs_fit_reading *reading, const lrcs_fit_options *options,
                      double scale, lrcsi_fit_data *data)
{
    for (uint32_t i = 0; i < data->count; i++) {
        double sine;
        double cosine;
        lrcsi_degrees_sincos(reading[i].angle_deg, &sine, &cosine);
        data->u[i] = sine / cosine * (sine / cosine);
        data->log_w[i] = log1p(data->u[i]);
        data->factor[i] = options->cosine ? cosine : 1.0;
        data->y[i] = reading[i].value / scale;
        data->inverse[i] = options->noise == LRCS_FIT_GIVEN ? scale / reading[i].sigma
                           : options->noise == LRCS_FIT_RELATIVE
                               ? 1.0 / lrcsi_most(fabs(data->y[i]), FIT_FIRST_SHARE)
                               : 1.0;
    }
    data_limits(data);
}

/* ---- the fit ---- */

/* All starts brought down softly, the best of them first: by the sum of absolute residuals, in
   which a few outliers do not decide. */
static uint32_t starts_make(lrcsi_fit_data *data, int noise, lrcsi_fit_spot start[LRCSI_FIT_STARTS])
{
    uint32_t count = lrcsi_fit_search(data, start);
    uint32_t best = 0;
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < count; i++) {
        double sum = lrcsi_fit_soften(data, noise, &start[i]);
        best = sum < least ? i : best;
        least = lrcsi_least(sum, least);
    }
    lrcsi_fit_spot first = start[best];
    start[best] = start[0];
    start[0] = first;
    return count;
}

/* Least squares over the readings that are kept: outliers and errors follow the fit until they
   stay. */
static void fit_settle(lrcsi_fit_data *data, int noise, lrcsi_fit_spot *best)
{
    lrcsi_fit_noise(data, noise, best);
    for (int i = 0; i < FIT_TRIMS; i++) {
        int changed = lrcsi_fit_trim(data, best);
        double before = best->square;
        lrcsi_fit_descend(data, 0, best);
        lrcsi_fit_noise(data, noise, best);
        int moved = fabs(best->square - before) > FIT_SAME * before;
        if (!changed && (noise != LRCS_FIT_RELATIVE || !moved)) {
            break;
        }
    }
}

/* Whether other starts end lower on the readings kept; how many end in the same place. */
static uint32_t starts_compare(const lrcsi_fit_data *data, const lrcsi_fit_spot *start,
                               uint32_t count, lrcsi_fit_spot *best)
{
    double end[LRCSI_FIT_STARTS];
    uint32_t agreeing = 0;
    for (uint32_t i = 0; i < count; i++) {
        lrcsi_fit_spot spot = start[i];
        lrcsi_fit_descend(data, 0, &spot);
        end[i] = spot.square;
        *best = spot.square < best->square * (1.0 - FIT_SAME) ? spot : *best;
    }
    for (uint32_t i = 0; i < count; i++) {
        agreeing += end[i] <= best->square * (1.0 + FIT_SAME) + 0x1p-80;
    }
    return agreeing;
}

/* The standard deviation of a weighted residual, and the rise of the sum of squares at the limits
   of confidence. */
static double fit_noise(const lrcsi_fit_data *data, int noise, const lrcsi_fit_spot *best,
                        uint32_t kept, double *rise)
{
    double size = 0.0;
    uint32_t freedom = kept - LRCS_FIT_PARAMETERS;
    for (uint32_t i = 0; i < data->count; i++) {
        size += data->weight[i] * data->weight[i] * data->y[i] * data->y[i];
    }
    double rounding = 0x1p-100 * size / kept;
    double variance = lrcsi_most(best->square / freedom, rounding);
    double t = lrcsi_special_student(freedom);
    int known = noise == LRCS_FIT_GIVEN && variance < 1.0;
    double t_known = lrcsi_special_student(UINT32_MAX);
    *rise = known ? t_known * t_known : variance * t * t;
    return sqrt(variance);
}

/* ---- the account ---- */

static uint32_t kept_count(const lrcsi_fit_data *data)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < data->count; i++) {
        kept += data->weight[i] > 0.0;
    }
    return kept;
}

/* The range of the angles that are kept, and how many there are, up to as many as parameters. */
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
        double next = fit->most_deg; /* the least above the last */
        for (uint32_t i = 0; i < data->count; i++) {
            double angle = fabs(reading[i].angle_deg);
            next = data->weight[i] > 0.0 && angle > last ? lrcsi_least(next, angle) : next;
        }
        last = next;
        fit->angles++;
    }
}

/* From coordinates to the parameters' own units. */
static double parameter_value(int p, double at, double unit)
{
    return p < LRCS_FIT_S ? at * unit : p == LRCS_FIT_S ? exp(at) : expm1(at);
}

static int parameter_verdict(int p, const double limit[2], int absent)
{
    int open_below = limit[0] == -HUGE_VAL || (limit[0] == 0.0 && p != LRCS_FIT_M);
    int open_above = limit[1] == HUGE_VAL;
    if (p >= LRCS_FIT_S && absent) {
        return LRCS_FIT_MOOT;
    }
    if (open_above) {
        return limit[0] > 0.0 || (p == LRCS_FIT_S && !open_below) ? LRCS_FIT_AT_LEAST
                                                                  : LRCS_FIT_FREE;
    }
    return !open_below ? LRCS_FIT_DETERMINED : p < LRCS_FIT_S ? LRCS_FIT_ABSENT : LRCS_FIT_AT_MOST;
}

static void parameters_fill(const lrcsi_fit_spot *best, const lrcsi_fit_spread *spread,
                            double limit[LRCS_FIT_PARAMETERS][2], double unit, lrcs_fit *fit)
{
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        int part = p < LRCS_FIT_S ? p : p - LRCS_FIT_S;
        int absent = limit[part][0] == 0.0;
        lrcs_fit_parameter *one = &fit->parameter[p];
        double by_coordinate = p < LRCS_FIT_S    ? unit
                               : p == LRCS_FIT_S ? exp(best->at[p])
                                                 : exp(best->at[p]); /* of s, of 1 + m */
        one->value =
            p >= LRCS_FIT_S && best->at[part] == 0.0 ? 0.0 : parameter_value(p, best->at[p], unit);
        one->error = spread->error[p] * by_coordinate;
        one->low = lrcsi_most(0.0, parameter_value(p, limit[p][0], unit));
        one->high = parameter_value(p, limit[p][1], unit);
        one->verdict = parameter_verdict(p, limit[p], absent);
    }
    memcpy(fit->correlation, spread->correlation, sizeof fit->correlation);
    fit->brdf = (lrcs_brdf){fit->parameter[LRCS_FIT_A].value, fit->parameter[LRCS_FIT_B].value,
                            fit->parameter[LRCS_FIT_S].value, fit->parameter[LRCS_FIT_M].value};
}

/* Fills rms; and the points, in the readings' unit. */
static void points_fill(const lrcsi_fit_data *data, const lrcsi_fit_spot *best, double noise,
                        double scale, double unit, lrcs_fit *fit, lrcs_fit_point *point)
{
    double square = 0.0;
    lrcsi_fit_rests(data, best);
    for (uint32_t i = 0; i < data->count; i++) {
        int keep = data->weight[i] > 0.0;
        square += keep ? data->rest[i] * data->rest[i] : 0.0;
        if (point) {
            point[i] = (lrcs_fit_point){scale * (data->y[i] - data->rest[i]), scale * data->rest[i],
                                        data->rest[i] * data->inverse[i] / noise, !keep};
        }
    }
    fit->rms = sqrt(square / fit->kept) * unit;
}

int lrcs_fit_run(const lrcs_fit_reading *reading, uint32_t count, const lrcs_fit_options *options,
                 lrcs_work *work, lrcs_fit *fit, lrcs_fit_point *point)
{
    double largest = 0.0;
    size_t mark = work->used;
    lrcsi_fit_data data;
    int status = readings_check(reading, count, options, &largest);
    status = status == LRCS_OK ? data_take(work, count, &data) : status;
    work->used = mark;
    if (status != LRCS_OK) {
        return status;
    }
    int exponent = ilogb(largest);
    double scale = ldexp(1.0, exponent);
    double unit = options->unit * scale;
    data_fill(reading, options, scale, &data);

    lrcsi_fit_spot start[LRCSI_FIT_STARTS];
    lrcsi_fit_spread spread;
    double limit[LRCS_FIT_PARAMETERS][2];
    double rise = 0.0;
    double noise = 0.0;
    int done = 0;
    fit->starts = starts_make(&data, options->noise, start);
    lrcsi_fit_spot best = start[0];
    for (int look = 0; look < FIT_LOOKS && !done; look++) {
        fit_settle(&data, options->noise, &best);
        fit->agreeing = starts_compare(&data, start, fit->starts, &best);
        fit->kept = kept_count(&data);
        noise = fit_noise(&data, options->noise, &best, fit->kept, &rise);
        spread = lrcsi_fit_spread_make(&data, &best, noise);
        done = lrcsi_fit_profile(&data, &spread, rise, &best, limit);
    }
    double by_unit = options->noise == LRCS_FIT_ABSOLUTE ? unit : 1.0;
    fit->noise = noise * by_unit;
    angles_count(reading, &data, fit);
    parameters_fill(&best, &spread, limit, unit, fit);
    points_fill(&data, &best, noise, scale, unit, fit, point);
    return LRCS_OK;
}

const char *lrcs_fit_verdict_text(int parameter, int verdict)
{
    int glint = parameter == LRCS_FIT_A || parameter == LRCS_FIT_S;
    switch (verdict) {
    case LRCS_FIT_DETERMINED:
        return "determined";
    case LRCS_FIT_ABSENT:
        return glint ? "cannot be told from 0: no glint stands out of the readings"
                     : "cannot be told from 0: no diffuse part stands out of the readings";
    case LRCS_FIT_MOOT:
        return glint ? "not determined: there may be no glint"
                     : "not determined: there may be no diffuse part";
    case LRCS_FIT_AT_MOST:
        return glint
                   ? "not determined but for an upper limit: too few readings on the glint's flank"
                   : "not determined but for an upper limit";
    case LRCS_FIT_AT_LEAST:
        return glint ? "not determined but for a lower limit: the readings begin beyond the glint"
                     : "not determined but for a lower limit: the readings end too early";
    case LRCS_FIT_FREE:
        return glint ? "not determined: a glint narrower than the readings reach would not show"
                     : "not determined: the readings do not limit it";
    default:
        return "unknown verdict";
    }
}
