/* SPDX-License-Identifier: MIT */
/* lrcs sweep --stats, --stats-file and lrcs plot: the distribution of sigma over the rows of a
   sweep (lrcs/distribution.h) as a table for people, JSON, CSV and a chart. A map of azimuth and
   elevation weights each row by the solid angle of its cell; in all other sweeps rows have equal
   weights, which for --sphere is their solid angle. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CHART_POINTS 2000u /* of the cumulative distribution */
#define TEXT_BAR     40
#define STATS_MEDIAN 4 /* the percentile of 50 % */

/* What is written. */
typedef struct sweep_stats {
    const lrcs_host_plan *plan;
    const lrcs_host_rows_head *head;
    const char *weights;        /* how rows are weighted, in words */
    lrcs_distribution_row *row; /* sorted by ascending sigma */
    lrcs_distribution all;
} sweep_stats;

/* The least, the value, the most, and the ends of the material band of a number. */
enum { LEAST = LRCS_DISTRIBUTION_LEAST, VALUE, MOST, LOW, HIGH };

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

static void place_print(FILE *out, const char *label, const lrcs_host_plan *plan,
                        const lrcs_distribution_row *row)
{
    double value[LRCS_HOST_PLAN_COLUMNS];
    lrcs_host_plan_values(plan, row->index, value);
    sigma_print(out, label, row->sigma_m2);
    for (uint32_t i = 0; i < plan->columns; i++) {
        fprintf(out, "%s%s = %.9g", i == 0 ? " at " : ", ", plan->column[i], value[i]);
    }
    band_print(out, row->low_m2, row->high_m2);
}

/* The largest possible error of a value. */
static double value_error(const lrcs_distribution_value *value)
{
    const double *at = value->at;
    return fmax(at[MOST] - at[VALUE], at[VALUE] - at[LEAST]);
}

/* The mean, the percentiles between the extremes, and the histogram. */
static void stats_print(FILE *out, const sweep_stats *stats)
{
    char error[LRCS_HOST_BOUND_SIZE];
    double worst = 0.0;
    fprintf(out, "statistics   %llu rows, %s\n", (unsigned long long)stats->all.rows,
            stats->weights);
    sigma_print(out, "mean", stats->all.mean_m2.at[VALUE]);
    lrcs_host_bound_text(value_error(&stats->all.mean_m2), 2, error);
    fprintf(out, ", known to %s m2 for these rows", error);
    band_print(out, stats->all.mean_m2.at[LOW], stats->all.mean_m2.at[HIGH]);
    place_print(out, "least", stats->plan, &stats->row[0]);
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
        const lrcs_distribution_value *value = &stats->all.percentile_m2[k];
        char label[16];
        snprintf(label, sizeof label, "%d %%", stats->all.percent[k]);
        sigma_print(out, label, value->at[VALUE]);
        fputs(stats->all.percent[k] == 50 ? "   median" : "", out);
        band_print(out, value->at[LOW], value->at[HIGH]);
        worst = fmax(worst, value_error(value));
    }
    place_print(out, "most", stats->plan, &stats->row[stats->all.rows - 1]);
    lrcs_host_bound_text(worst, 2, error);
    fprintf(out, "  percentiles are known to %s m2 or better for these rows\n", error);
    if (stats->all.has_intervals) {
        fputs("  materials: 68 % by their errors, as if these moved all rows together, which is\n"
              "  seldom too narrow; an estimate, not a bound\n",
              out);
    }
    const double *cdf = stats->all.cdf[VALUE];
    fprintf(out, "  share of rows by sigma in dBsm, and of all up to there\n");
    if (stats->all.bins == 0 || cdf[0] > 0.0) {
        double percent = stats->all.bins ? 100.0 * cdf[0] : 100.0;
        fprintf(out, "  %8s %7s  %7.2f %%  %7.2f %%\n", stats->all.bins ? "less" : "sigma 0", "",
                percent, percent);
    }
    for (uint32_t i = 0; i < stats->all.bins; i++) {
        int bar = (int)lround(stats->all.share[i] / stats->all.largest_share * TEXT_BAR);
        fprintf(out, "  %7.1f .. %5.1f  %7.2f %%  %7.2f %%  %.*s\n", stats->all.edge_dbsm[i],
                stats->all.edge_dbsm[i + 1], 100.0 * stats->all.share[i], 100.0 * cdf[i + 1], bar,
                "########################################");
    }
}

/* ---- JSON ---- */

static void band_json(lrcs_host_json *json, double low, double high)
{
    if (high >= 0.0) {
        lrcs_host_json_put(json, "material_low=%g material_high=%g", low, high);
    }
}

static void value_json(lrcs_host_json *json, const char *key, const lrcs_distribution_value *value)
{
    const double *at = value->at;
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_put(json, "value=%g least=%g most=%g", at[VALUE], at[LEAST], at[MOST]);
    band_json(json, at[LOW], at[HIGH]);
    lrcs_host_json_put(json, "}");
}

static void row_json(lrcs_host_json *json, const char *key, const sweep_stats *stats,
                     const lrcs_distribution_row *row)
{
    double value[LRCS_HOST_PLAN_COLUMNS];
    lrcs_host_plan_values(stats->plan, row->index, value);
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_put(json, "sigma_m2=%g bound_m2=%g", row->sigma_m2, row->bound_m2);
    band_json(json, row->low_m2, row->high_m2);
    lrcs_host_json_put(json, "index=%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < stats->plan->columns; i++) {
        lrcs_host_json_number(json, stats->plan->column[i], value[i]);
    }
    lrcs_host_json_put(json, "}");
}

static void stats_json(FILE *out, const void *context)
{
    const sweep_stats *stats = context;
    const lrcs_host_rows_head *head = stats->head;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\nlrcs=%s", "statistics");
    cli_version_json(&json);
    cli_hash_json(head->scene_hash, &json);
    lrcs_host_json_put(&json, "rows=%llu weights=%s", (unsigned long long)stats->all.rows,
                       stats->weights);
    value_json(&json, "mean_m2", &stats->all.mean_m2);
    lrcs_host_json_put(&json, "standard_error_m2=%g",
                       lrcs_host_plan_is_sphere(stats->plan) ? stats->all.standard_error_m2
                                                             : (double)NAN);
    row_json(&json, "least", stats, &stats->row[0]);
    row_json(&json, "most", stats, &stats->row[stats->all.rows - 1]);
    lrcs_host_json_put(&json, "percentiles=[\n");
    for (int k = 0; k < LRCS_DISTRIBUTION_PERCENTS; k++) {
        lrcs_host_json_put(&json, "{percent=%u", stats->all.percent[k]);
        value_json(&json, "sigma_m2", &stats->all.percentile_m2[k]);
        lrcs_host_json_put(&json, "}");
    }
    lrcs_host_json_put(&json, "] cdf=[\n");
    for (uint32_t i = 0; i <= stats->all.bins && stats->all.bins > 0; i++) {
        lrcs_distribution_value share;
        for (int end = 0; end < LRCS_DISTRIBUTION_ENDS; end++) {
            share.at[end] = stats->all.cdf[end][i];
        }
        lrcs_host_json_put(&json, "{sigma_dbsm=%g sigma_m2=%g", stats->all.edge_dbsm[i],
                           stats->all.edge_m2[i]);
        value_json(&json, "share", &share);
        lrcs_host_json_put(&json, "}");
    }
    lrcs_host_json_put(&json, "] sweep={\n");
    for (uint32_t i = 0; i < head->options; i++) {
        lrcs_host_json_text(&json, head->option[i].key, head->option[i].text);
    }
    lrcs_host_json_put(&json, "}}");
}

/* ---- CSV ---- */

/* The histogram: one row for each bin; the first row is for everything below. */
static void stats_csv(FILE *out, const void *context)
{
    static const int column[] = {VALUE, LEAST, MOST, LOW, HIGH};
    const sweep_stats *stats = context;
    fprintf(out, "# lrcs %s statistics; scene_hash=%016llx; rows=%llu; weights=%s", lrcs_version(),
            (unsigned long long)stats->head->scene_hash, (unsigned long long)stats->all.rows,
            stats->weights);
    lrcs_host_rows_options_write(out, stats->head);
    fprintf(out, "\nto_dbsm,to_m2,share,cdf,cdf_least,cdf_most%s\n",
            stats->all.has_intervals ? ",cdf_material_low,cdf_material_high" : "");
    for (uint32_t i = 0; i <= stats->all.bins && stats->all.bins > 0; i++) {
        lrcs_host_number_put(out, "", stats->all.edge_dbsm[i]);
        lrcs_host_number_put(out, ",", stats->all.edge_m2[i]);
        lrcs_host_number_put(out, ",", i > 0 ? stats->all.share[i - 1] : stats->all.cdf[VALUE][0]);
        for (int k = 0; k < (stats->all.has_intervals ? 5 : 3); k++) {
            lrcs_host_number_put(out, ",", stats->all.cdf[column[k]][i]);
        }
        putc('\n', out);
    }
}

/* ---- the chart ---- */

typedef struct stats_chart {
    const sweep_stats *stats;
    double *x, *y; /* of the cumulative distribution */
    uint32_t count;
    double bin_x[2 * LRCS_DISTRIBUTION_BINS + 2],
        bin_y[2 * LRCS_DISTRIBUTION_BINS + 2]; /* the histogram's outline */
} stats_chart;

static void about_put(FILE *out, const void *context)
{
    const lrcs_host_rows_head *head = context;
    fprintf(out, "lrcs %s statistics; scene_hash=%016llx", lrcs_version(),
            (unsigned long long)head->scene_hash);
    lrcs_host_rows_options_write(out, head);
}

/* The series of the chart: the intervals by the bounds if they can be seen, and the band if there
   is one. Returns their number. */
static uint32_t series_make(const stats_chart *from, const char *bars, lrcs_host_series series[5])
{
    const sweep_stats *stats = from->stats;
    uint32_t edges = stats->all.bins + 1;
    double wide = 0.0;
    for (uint32_t i = 0; i < edges; i++) {
        wide = fmax(wide, stats->all.cdf[MOST][i] - stats->all.cdf[LEAST][i]);
    }
    const lrcs_host_series all[] = {
        {bars, 2 * edges, from->bin_x, from->bin_y, NULL, LRCS_HOST_ORANGE, LRCS_HOST_NO_MARKER,
         LRCS_HOST_SOLID, 0, NULL, NULL},
        {"cumulative", from->count, from->x, from->y, NULL, LRCS_HOST_BLUE, LRCS_HOST_NO_MARKER,
         LRCS_HOST_SOLID, 0, NULL, NULL},
        {"at least, by bound", edges, stats->all.edge_dbsm, stats->all.cdf[LEAST], NULL,
         LRCS_HOST_SKY_BLUE, LRCS_HOST_TRIANGLE, LRCS_HOST_NO_LINE, 0, NULL, NULL},
        {"at most, by bound", edges, stats->all.edge_dbsm, stats->all.cdf[MOST], NULL,
         LRCS_HOST_PURPLE, LRCS_HOST_CROSS, LRCS_HOST_NO_LINE, 0, NULL, NULL},
        {NULL, edges, stats->all.edge_dbsm, stats->all.cdf[VALUE], NULL, LRCS_HOST_BLUE,
         LRCS_HOST_NO_MARKER, LRCS_HOST_NO_LINE, 0, stats->all.cdf[LOW], stats->all.cdf[HIGH]}};
    uint32_t count = wide > 0.02 ? 4 : 2;
    memcpy(series, all, 4 * sizeof all[0]);
    series[count] = all[4];
    return count + (stats->all.has_intervals != 0);
}

static int chart_write(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const stats_chart *from = context;
    const sweep_stats *stats = from->stats;
    const char *title = lrcs_host_rows_head_text(stats->head, "title");
    char words[300], note[300], bars[80];
    lrcs_host_series series[5];
    snprintf(words, sizeof words, "Distribution of sigma of %.200s", title ? title : "");
    snprintf(note, sizeof note, "%llu rows, %s; mean %.4g m2, median %.4g m2%s",
             (unsigned long long)stats->all.rows, stats->weights, stats->all.mean_m2.at[VALUE],
             stats->all.percentile_m2[STATS_MEDIAN].at[VALUE],
             stats->all.has_intervals ? "; shaded: 68 % by the errors of materials" : "");
    snprintf(bars, sizeof bars, "histogram: highest bar %.3g %% in %.3g dB",
             100.0 * stats->all.largest_share, stats->all.edge_dbsm[1] - stats->all.edge_dbsm[0]);
    char *about = cli_text_of(about_put, stats->head);
    const lrcs_host_chart chart = {.title = words,
                                   .note = note,
                                   .about = about,
                                   .x_name = "sigma (dBsm)",
                                   .y_name = "share of all rows; histogram: of its highest bar",
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
    uint64_t each = stats->all.rows / CHART_POINTS + 1;
    uint64_t room = 2 * (stats->all.rows / each + 3);
    double below = 0.0;
    *chart = (stats_chart){.stats = stats, .x = malloc(2 * room * sizeof(double))};
    if (!chart->x) {
        return cli_out_of_memory();
    }
    chart->y = chart->x + room;
    for (uint64_t i = 0; i < stats->all.rows; i++) {
        double before = below / stats->all.weight;
        double sigma = stats->row[i].sigma_m2;
        int drawn = (i % each == 0 || i + 1 == stats->all.rows) && stats->all.bins > 0 &&
                    sigma > stats->all.edge_m2[0];
        below += stats->row[i].weight;
        if (drawn) {
            chart->x[chart->count] = chart->x[chart->count + 1] = cli_dbsm(sigma);
            chart->y[chart->count] = before;
            chart->y[chart->count + 1] = i + 1 == stats->all.rows ? 1.0 : below / stats->all.weight;
            chart->count += 2;
        }
    }
    for (size_t i = 0; i <= stats->all.bins; i++) {
        chart->bin_x[2 * i] = chart->bin_x[2 * i + 1] = stats->all.edge_dbsm[i];
        chart->bin_y[2 * i] = i > 0 ? stats->all.share[i - 1] / stats->all.largest_share : 0.0;
        chart->bin_y[2 * i + 1] =
            i < stats->all.bins ? stats->all.share[i] / stats->all.largest_share : 0.0;
    }
    return 0;
}

/* ---- all of them ---- */

/* Computes the distribution; the caller frees the rows in any case. 0 or CLI_FAILED. */
static int stats_make(const double (*row)[2], const double (*band)[2], sweep_stats *stats)
{
    const lrcs_host_plan *plan = stats->plan;
    int map = lrcs_host_plan_is_map(plan);
    lrcs_distribution_row *room = calloc(plan->rows, sizeof *room);
    stats->row = calloc(plan->rows, sizeof *stats->row);
    if (!stats->row || !room) {
        free(room);
        return cli_out_of_memory();
    }
    stats->weights =
        map                                   ? "each by the solid angle that it stands for"
        : plan->kind == LRCS_HOST_PLAN_SPHERE ? "all alike: each stands for the same solid angle"
        : plan->kind == LRCS_HOST_PLAN_AZEL   ? "all alike: a cut stands for no solid angle"
                                              : "all alike";
    for (uint64_t i = 0; i < plan->rows; i++) {
        stats->row[i] =
            (lrcs_distribution_row){.sigma_m2 = row[i][0],
                                    .bound_m2 = row[i][1],
                                    .weight = map ? lrcs_host_plan_weight(plan, i) : 1.0,
                                    .low_m2 = band ? band[i][0] : (double)NAN,
                                    .high_m2 = band ? band[i][1] : (double)NAN,
                                    .index = i};
    }
    int status = lrcs_distribution_make(stats->row, room, plan->rows, &stats->all);
    free(room);
    return status == LRCS_OK ? 0 : cli_fail("statistics: %s", lrcs_status_text(status));
}

int cli_stats_write(const cli_args *args, FILE *out, const lrcs_host_plan *plan,
                    const lrcs_host_rows_head *head, const double (*row)[2],
                    const double (*band)[2])
{
    sweep_stats stats = {.plan = plan, .head = head};
    stats_chart chart;
    int code = stats_make(row, band, &stats);
    if (code == 0 && cli_value(args, "stats")) {
        stats_print(out, &stats);
    }
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const char *path = args->given[i].value;
        if (!is_stats_file(&args->given[i])) {
            continue;
        }
        if (cli_extension(path, ".json") || cli_extension(path, ".csv")) {
            code =
                cli_text_write(path, cli_extension(path, ".csv") ? stats_csv : stats_json, &stats);
        } else if (stats.all.bins == 0) {
            code = cli_fail("%s: nothing to draw: sigma of every row is 0", path);
        } else {
            code = chart_make(&stats, &chart);
            code = code ? code : cli_chart_write(path, chart_write, &chart);
            free(chart.x);
        }
    }
    free(stats.row);
    return code;
}
