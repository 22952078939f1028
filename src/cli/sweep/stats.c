/* SPDX-License-Identifier: MIT */
/* The distribution of sigma over the rows of a sweep: weights, mean, percentiles, histogram and
   cumulative distribution. A map of azimuth and elevation weights each row by the solid angle of
   its cell; in all other sweeps rows have equal weights (for --sphere that is the solid angle). The
   statistics are those of the rows: how sigma varies between them is not known. They are written
   as a table for people, JSON, CSV and a chart.

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

#define STATS_DEEP   100.0 /* the histogram reaches this many dB below the maximum */
#define CHART_POINTS 2000u /* of the cumulative distribution */
#define TEXT_BAR     40

static const int stats_percent[STATS_PERCENTS] = {1, 5, 10, 25, 50, 75, 90, 95, 99};

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

/* The solid angle of a cell of a map, up to a factor. Along azimuth all cells have the same width,
   except the ends of a full turn, which are one direction; along elevation it is the difference of
   sines, clipped at the poles. */
static double row_weight(const sweep_plan *plan, uint64_t row)
{
    double weight = 1.0;
    for (uint32_t i = plan->scene_axes; i < plan->axes; i++) {
        const sweep_axis *along = &plan->axis[i];
        uint64_t place = cli_plan_place(plan, row, i);
        uint64_t last = along->range.count - 1;
        double first = cli_range_at(&along->range, 0);
        double here = cli_range_at(&along->range, place);
        double half = 0.5 * fabs(cli_range_at(&along->range, 1) - first);
        if (along->option[0] == 'a') {
            int turn = fabs(cli_range_at(&along->range, last) - first) == 360.0;
            weight *= turn && (place == 0 || place == last) ? 0.5 : 1.0;
        } else {
            double width = sin(fmin(here + half, 90.0) / CLI_DEGREES) -
                           sin(fmax(here - half, -90.0) / CLI_DEGREES);
            weight *= fmax(width, 0.0);
        }
    }
    return weight;
}

/* ---- percentiles ---- */

/* Percentiles of sigma moved to an end. Sigma of every row lies between its ends, and a percentile
   increases with every sigma, so that the percentiles of the ends enclose it. If weights are not
   whole numbers, two sums of n weights differ by at most 2 n u of the whole, u = DBL_EPSILON / 2.
 */
static void percentiles_at(sweep_stats *stats, stats_row *end, enum stats_end which)
{
    /* more sigma, a smaller share below an edge */
    static const enum stats_end opposite[STATS_ENDS] = {END_MOST, END_VALUE, END_LEAST, END_HIGH,
                                                        END_LOW};
    int whole = stats->whole == (double)stats->rows; /* all weights are 1, and sums are exact */
    int side = which == END_LEAST ? -1 : which == END_MOST;
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
    double below = 0.0;
    uint64_t at = 0;
    for (int k = 0; k < STATS_PERCENTS; k++) { /* the first row at which the part is reached */
        double part = stats_percent[k] * stats->whole / 100.0;
        while (at + 1 < stats->rows && below + end[at].weight < part + slack) {
            below += end[at++].weight;
        }
        stats->percentile[k].at[which] = end[at].sigma;
    }
    below = 0.0;
    at = 0;
    for (uint32_t i = 0; i <= stats->bins; i++) {
        for (; at < stats->rows && end[at].sigma <= stats->edge_m2[i]; at++) {
            below += end[at].weight;
        }
        double share = at == stats->rows ? 1.0 : below / stats->whole;
        share += whole || at == 0 || at == stats->rows ? 0.0 : -slack / stats->whole;
        stats->cdf[opposite[which]][i] = fmax(fmin(share, 1.0), 0.0);
    }
}

/* ---- mean ---- */

/* The weighted mean, and that of the bounds. Products and the division have relative errors of u
   each and the compensated sums of less than 2 u, as all terms are positive: 8 u of the mean
   exceeds the total, and so does 16 u of the bound. */
static void mean_make(sweep_stats *stats)
{
    cli_sum mean = {0.0, 0.0}, total = mean, bound = mean, low = mean, high = mean;
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
        (stats_value){{fmax(value - within, 0.0), value, value + within,
                       cli_sum_value(&low) / stats->whole, cli_sum_value(&high) / stats->whole}};
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
    *stats = (sweep_stats){
        .plan = plan,
        .head = head,
        .rows = plan->rows,
        .row = calloc(plan->rows, sizeof *stats->row),
        .weights = map                          ? "each by the solid angle that it stands for"
                   : plan->kind == SWEEP_SPHERE ? "all alike: each stands for the same solid angle"
                   : plan->kind == SWEEP_AZEL   ? "all alike: a cut stands for no solid angle"
                                                : "all alike",
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
    for (int end_of = END_LOW; end_of <= END_HIGH; end_of++) {
        for (int k = 0; k < STATS_PERCENTS; k++) {
            stats->percentile[k].at[end_of] = (double)NAN;
        }
        for (int i = 0; i <= STATS_BINS; i++) {
            stats->cdf[end_of][i] = (double)NAN;
        }
    }
    mean_make(stats);
    qsort(stats->row, plan->rows, sizeof *stats->row, by_sigma);
    bins_choose(stats);
    for (int which = END_LEAST; which <= (band ? END_HIGH : END_MOST); which++) {
        percentiles_at(stats, end, (enum stats_end)which);
    }
    for (uint32_t i = 0; i < stats->bins; i++) {
        stats->share[i] = stats->cdf[END_VALUE][i + 1] - stats->cdf[END_VALUE][i];
        stats->fullest = fmax(stats->fullest, stats->share[i]);
    }
    free(end);
    return 0;
}

void cli_stats_free(sweep_stats *stats)
{
    free(stats->row);
    stats->row = NULL;
}

/* ---- options ---- */

static const char *const stats_extension[] = {".json", ".csv", ".svg", ".png"};

static int is_stats_file(const cli_given *given)
{
    return strcmp(given->name, "stats-file") == 0;
}

int cli_stats_read(const cli_args *args, int *asked)
{
    *asked = cli_value(args, "stats") != NULL;
    for (int i = 0; i < args->given_count; i++) {
        const char *path = args->given[i].value;
        int known = 0;
        for (int k = 0; k < 4 && is_stats_file(&args->given[i]); k++) {
            known |= cli_extension(path, stats_extension[k]);
        }
        if (is_stats_file(&args->given[i]) && !known) {
            return cli_usage(args->command,
                             "--stats-file: expected FILE.json, .csv, .svg or .png, found '%s'",
                             path);
        }
        *asked |= known;
    }
    return 0;
}

/* ---- for people ---- */

static void sigma_print(FILE *out, const char *label, double sigma)
{
    fprintf(out, "  %-10s %.9g m2", label, sigma);
    if (sigma > 0.0) {
        fprintf(out, "   %.4f dBsm", cli_dbsm(sigma));
    }
}

/* Prints the band of the errors of materials, if there is one, and ends the line. */
static void band_print(FILE *out, double low, double high)
{
    if (high >= 0.0) {
        fprintf(out, ";  materials %.5g .. %.5g m2", low, high);
    }
    fputc('\n', out);
}

static void place_print(FILE *out, const char *label, const sweep_plan *plan, const stats_row *row)
{
    double value[SWEEP_COLUMNS];
    cli_plan_values(plan, row->index, value);
    sigma_print(out, label, row->sigma);
    for (uint32_t i = 0; i < plan->columns; i++) {
        fprintf(out, "%s%s = %.9g", i == 0 ? " at " : ", ", plan->column[i], value[i]);
    }
    band_print(out, row->low, row->high);
}

/* The largest possible error of a value. */
static double value_error(const stats_value *value)
{
    const double *at = value->at;
    return fmax(at[END_MOST] - at[END_VALUE], at[END_VALUE] - at[END_LEAST]);
}

static void histogram_print(FILE *out, const sweep_stats *stats)
{
    const double *cdf = stats->cdf[END_VALUE];
    fprintf(out, "  share of rows by sigma in dBsm, and of all up to there\n");
    if (stats->bins == 0 || cdf[0] > 0.0) {
        double percent = stats->bins ? 100.0 * cdf[0] : 100.0;
        fprintf(out, "  %8s %7s  %7.2f %%  %7.2f %%\n", stats->bins ? "less" : "sigma 0", "",
                percent, percent);
    }
    for (uint32_t i = 0; i < stats->bins; i++) {
        int bar = (int)lround(stats->share[i] / stats->fullest * TEXT_BAR);
        fprintf(out, "  %7.1f .. %5.1f  %7.2f %%  %7.2f %%  %.*s\n", stats->edge_dbsm[i],
                stats->edge_dbsm[i + 1], 100.0 * stats->share[i], 100.0 * cdf[i + 1], bar,
                "########################################");
    }
}

static void stats_print(FILE *out, const sweep_stats *stats)
{
    char error[CLI_BOUND_SIZE];
    double worst = 0.0;
    fprintf(out, "statistics   %llu rows, %s\n", (unsigned long long)stats->rows, stats->weights);
    sigma_print(out, "mean", stats->mean.at[END_VALUE]);
    cli_bound_text(value_error(&stats->mean), 2, error);
    fprintf(out, ", known to %s m2 for these rows", error);
    band_print(out, stats->mean.at[END_LOW], stats->mean.at[END_HIGH]);
    place_print(out, "least", stats->plan, &stats->row[0]);
    for (int k = 0; k < STATS_PERCENTS; k++) {
        const stats_value *value = &stats->percentile[k];
        char label[16];
        snprintf(label, sizeof label, "%d %%", stats_percent[k]);
        sigma_print(out, label, value->at[END_VALUE]);
        fputs(stats_percent[k] == 50 ? "   median" : "", out);
        band_print(out, value->at[END_LOW], value->at[END_HIGH]);
        worst = fmax(worst, value_error(value));
    }
    place_print(out, "most", stats->plan, &stats->row[stats->rows - 1]);
    cli_bound_text(worst, 2, error);
    fprintf(out, "  percentiles are known to %s m2 or better for these rows\n", error);
    if (stats->banded) {
        fputs("  materials: 68 % by their errors, as if these moved all rows together, which is\n"
              "  seldom too narrow; an estimate, not a bound\n",
              out);
    }
    histogram_print(out, stats);
}

/* ---- JSON ---- */

static void band_json(lrcs_host_json *json, double low, double high)
{
    if (high >= 0.0) {
        cli_json(json, "material_low=%g material_high=%g", low, high);
    }
}

static void value_json(lrcs_host_json *json, const char *key, const stats_value *value)
{
    const double *at = value->at;
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_OBJECT);
    cli_json(json, "value=%g least=%g most=%g", at[END_VALUE], at[END_LEAST], at[END_MOST]);
    band_json(json, at[END_LOW], at[END_HIGH]);
    cli_json(json, "}");
}

static void row_json(lrcs_host_json *json, const char *key, const sweep_stats *stats,
                     const stats_row *row)
{
    double value[SWEEP_COLUMNS];
    cli_plan_values(stats->plan, row->index, value);
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_OBJECT);
    cli_json(json, "sigma_m2=%g bound_m2=%g", row->sigma, row->bound);
    band_json(json, row->low, row->high);
    cli_json(json, "index=%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < stats->plan->columns; i++) {
        lrcs_host_json_number(json, stats->plan->column[i], value[i]);
    }
    cli_json(json, "}");
}

static void stats_json(FILE *out, const void *context)
{
    const sweep_stats *stats = context;
    const sweep_head *head = stats->head;
    lrcs_host_json json = lrcs_host_json_make(out);
    cli_json(&json, "{\nlrcs=%s", "statistics");
    cli_version_json(&json);
    cli_hash_json(head->scene_hash, &json);
    cli_json(&json, "rows=%llu weights=%s", (unsigned long long)stats->rows, stats->weights);
    value_json(&json, "mean_m2", &stats->mean);
    cli_json(&json, "standard_error_m2=%g", stats->standard_error);
    row_json(&json, "least", stats, &stats->row[0]);
    row_json(&json, "most", stats, &stats->row[stats->rows - 1]);
    cli_json(&json, "percentiles=[\n");
    for (int k = 0; k < STATS_PERCENTS; k++) {
        cli_json(&json, "{percent=%u", stats_percent[k]);
        value_json(&json, "sigma_m2", &stats->percentile[k]);
        cli_json(&json, "}");
    }
    cli_json(&json, "] cdf=[\n");
    for (uint32_t i = 0; i <= stats->bins && stats->bins > 0; i++) {
        stats_value share;
        for (int end = 0; end < STATS_ENDS; end++) {
            share.at[end] = stats->cdf[end][i];
        }
        cli_json(&json, "{sigma_dbsm=%g sigma_m2=%g", stats->edge_dbsm[i], stats->edge_m2[i]);
        value_json(&json, "share", &share);
        cli_json(&json, "}");
    }
    cli_json(&json, "] sweep={\n");
    for (uint32_t i = 0; i < head->options; i++) {
        lrcs_host_json_text(&json, head->option[i].key, head->option[i].text);
    }
    cli_json(&json, "}}");
}

/* ---- CSV ---- */

/* The histogram: one row for each bin; the first row is for everything below. */
static void stats_csv(FILE *out, const void *context)
{
    static const enum stats_end column[] = {END_VALUE, END_LEAST, END_MOST, END_LOW, END_HIGH};
    const sweep_stats *stats = context;
    fprintf(out, "# lrcs %s statistics; scene_hash=%016llx; rows=%llu; weights=%s", lrcs_version(),
            (unsigned long long)stats->head->scene_hash, (unsigned long long)stats->rows,
            stats->weights);
    cli_head_put(out, stats->head);
    fprintf(out, "\nto_dbsm,to_m2,share,cdf,cdf_least,cdf_most%s\n",
            stats->banded ? ",cdf_material_low,cdf_material_high" : "");
    for (uint32_t i = 0; i <= stats->bins && stats->bins > 0; i++) {
        cli_number_put(out, "", stats->edge_dbsm[i]);
        cli_number_put(out, ",", stats->edge_m2[i]);
        cli_number_put(out, ",", i > 0 ? stats->share[i - 1] : stats->cdf[END_VALUE][0]);
        for (int k = 0; k < (stats->banded ? 5 : 3); k++) {
            cli_number_put(out, ",", stats->cdf[column[k]][i]);
        }
        putc('\n', out);
    }
}

/* ---- the chart ---- */

typedef struct stats_chart {
    const sweep_stats *stats;
    double *x, *y; /* of the cumulative distribution */
    uint32_t count;
    double bin_x[2 * STATS_BINS + 2], bin_y[2 * STATS_BINS + 2]; /* the histogram's outline */
} stats_chart;

static void about_put(FILE *out, const void *context)
{
    const sweep_head *head = context;
    fprintf(out, "lrcs %s statistics; scene_hash=%016llx", lrcs_version(),
            (unsigned long long)head->scene_hash);
    cli_head_put(out, head);
}

/* The series of the chart: the intervals by the bounds if they can be seen, and the band if there
   is one. Returns their number. */
static uint32_t series_make(const stats_chart *from, const char *bars, lrcs_host_series series[5])
{
    const sweep_stats *stats = from->stats;
    uint32_t edges = stats->bins + 1;
    double wide = 0.0;
    for (uint32_t i = 0; i < edges; i++) {
        wide = fmax(wide, stats->cdf[END_MOST][i] - stats->cdf[END_LEAST][i]);
    }
    const lrcs_host_series all[] = {
        {bars, 2 * edges, from->bin_x, from->bin_y, NULL, LRCS_HOST_ORANGE, LRCS_HOST_NO_MARKER,
         LRCS_HOST_SOLID, 0, NULL, NULL},
        {"cumulative", from->count, from->x, from->y, NULL, LRCS_HOST_BLUE, LRCS_HOST_NO_MARKER,
         LRCS_HOST_SOLID, 0, NULL, NULL},
        {"at least, by bound", edges, stats->edge_dbsm, stats->cdf[END_LEAST], NULL,
         LRCS_HOST_SKY_BLUE, LRCS_HOST_TRIANGLE, LRCS_HOST_NO_LINE, 0, NULL, NULL},
        {"at most, by bound", edges, stats->edge_dbsm, stats->cdf[END_MOST], NULL, LRCS_HOST_PURPLE,
         LRCS_HOST_CROSS, LRCS_HOST_NO_LINE, 0, NULL, NULL},
        {NULL, edges, stats->edge_dbsm, stats->cdf[END_VALUE], NULL, LRCS_HOST_BLUE,
         LRCS_HOST_NO_MARKER, LRCS_HOST_NO_LINE, 0, stats->cdf[END_LOW], stats->cdf[END_HIGH]}};
    uint32_t count = wide > 0.02 ? 4 : 2;
    memcpy(series, all, 4 * sizeof all[0]);
    series[count] = all[4];
    return count + (stats->banded != 0);
}

static int chart_write(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const stats_chart *from = context;
    const sweep_stats *stats = from->stats;
    const char *title = cli_head_text(stats->head, "title");
    char words[300], note[300], bars[80];
    lrcs_host_series series[5];
    snprintf(words, sizeof words, "Distribution of sigma of %.200s", title ? title : "");
    snprintf(note, sizeof note, "%llu rows, %s; mean %.4g m2, median %.4g m2%s",
             (unsigned long long)stats->rows, stats->weights, stats->mean.at[END_VALUE],
             stats->percentile[4].at[END_VALUE],
             stats->banded ? "; shaded: 68 % by the errors of materials" : "");
    snprintf(bars, sizeof bars, "histogram: 1 is %.3g %% in %.3g dB", 100.0 * stats->fullest,
             stats->edge_dbsm[1] - stats->edge_dbsm[0]);
    char *about = cli_text_of(about_put, stats->head);
    const lrcs_host_chart chart = {.title = words,
                                   .note = note,
                                   .about = about,
                                   .x_name = "sigma (dBsm)",
                                   .y_name = "share of all rows",
                                   .y_from_0 = 1,
                                   .series = series,
                                   .series_count = series_make(from, bars, series)};
    int status = cli_chart_put(out, &chart, png, error);
    free(about);
    return status;
}

/* The cumulative distribution as steps at the rows from the first edge on (if there are many rows,
   at some of them); and the outline of the histogram. 0 or CLI_FAILED; the caller frees x. */
static int chart_make(const sweep_stats *stats, stats_chart *chart)
{
    uint64_t each = stats->rows / CHART_POINTS + 1;
    uint64_t room = 2 * (stats->rows / each + 3);
    double below = 0.0;
    *chart = (stats_chart){.stats = stats, .x = malloc(2 * room * sizeof(double))};
    if (!chart->x) {
        return cli_out_of_memory();
    }
    chart->y = chart->x + room;
    for (uint64_t i = 0; i < stats->rows; i++) {
        double before = below / stats->whole;
        double sigma = stats->row[i].sigma;
        int drawn =
            (i % each == 0 || i + 1 == stats->rows) && stats->bins > 0 && sigma > stats->edge_m2[0];
        below += stats->row[i].weight;
        if (drawn) {
            chart->x[chart->count] = chart->x[chart->count + 1] = cli_dbsm(sigma);
            chart->y[chart->count] = before;
            chart->y[chart->count + 1] = i + 1 == stats->rows ? 1.0 : below / stats->whole;
            chart->count += 2;
        }
    }
    for (size_t i = 0; i <= stats->bins; i++) {
        chart->bin_x[2 * i] = chart->bin_x[2 * i + 1] = stats->edge_dbsm[i];
        chart->bin_y[2 * i] = i > 0 ? stats->share[i - 1] / stats->fullest : 0.0;
        chart->bin_y[2 * i + 1] = i < stats->bins ? stats->share[i] / stats->fullest : 0.0;
    }
    return 0;
}

/* ---- all of them ---- */

int cli_stats_write(const cli_args *args, FILE *out, const sweep_stats *stats)
{
    int code = 0;
    if (cli_value(args, "stats")) {
        stats_print(out, stats);
    }
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const char *path = args->given[i].value;
        stats_chart chart;
        if (!is_stats_file(&args->given[i])) {
            continue;
        }
        if (cli_extension(path, ".json") || cli_extension(path, ".csv")) {
            code =
                cli_text_write(path, cli_extension(path, ".csv") ? stats_csv : stats_json, stats);
        } else if (stats->bins == 0) {
            code = cli_fail("%s: nothing to draw: sigma of every row is 0", path);
        } else {
            code = chart_make(stats, &chart);
            code = code ? code : cli_chart_write(path, chart_write, &chart);
            free(chart.x);
        }
    }
    return code;
}
