/* SPDX-License-Identifier: MIT */
/* Statistics of a sweep as a table for people, JSON, CSV and a chart. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CHART_POINTS 2000u /* of the cumulative distribution */
#define TEXT_BAR     40

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

/* Prints the band of the errors of materials, if there is one. */
static void band_print(FILE *out, double low, double high)
{
    if (high >= 0.0) {
        fprintf(out, ";  materials %.5g .. %.5g m2", low, high);
    }
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
    fputc('\n', out);
}

/* Prints the largest possible error of a value, rounded up. */
static void within_print(FILE *out, const stats_value *value)
{
    char text[CLI_BOUND_SIZE];
    cli_bound_text(fmax(value->most - value->value, value->value - value->least), 2, text);
    fprintf(out, "%s m2", text);
}

static void histogram_print(FILE *out, const sweep_stats *stats)
{
    double fullest = 0.0;
    for (uint32_t i = 0; i < stats->bins; i++) {
        fullest = fmax(fullest, stats->cdf[i + 1].value - stats->cdf[i].value);
    }
    fprintf(out, "  share of rows by sigma in dBsm, and of all up to there\n");
    if (stats->bins == 0 || stats->cdf[0].value > 0.0) {
        fprintf(out, "  %8s %7s  %7.2f %%  %7.2f %%\n", stats->bins ? "less" : "sigma 0", "",
                stats->bins ? 100.0 * stats->cdf[0].value : 100.0,
                stats->bins ? 100.0 * stats->cdf[0].value : 100.0);
    }
    for (uint32_t i = 0; i < stats->bins; i++) {
        double share = stats->cdf[i + 1].value - stats->cdf[i].value;
        int bar = (int)lround(share / fullest * TEXT_BAR);
        fprintf(out, "  %7.1f .. %5.1f  %7.2f %%  %7.2f %%  %.*s\n", stats->edge_dbsm[i],
                stats->edge_dbsm[i + 1], 100.0 * share, 100.0 * stats->cdf[i + 1].value, bar,
                "########################################");
    }
}

static void stats_print(FILE *out, const sweep_stats *stats)
{
    fprintf(out, "statistics   %llu rows, %s\n", (unsigned long long)stats->rows, stats->weights);
    sigma_print(out, "mean", stats->mean.value);
    fprintf(out, ", known to ");
    within_print(out, &stats->mean);
    fprintf(out, " for these rows");
    band_print(out, stats->mean.low, stats->mean.high);
    fputc('\n', out);
    place_print(out, "least", stats->plan, &stats->row[0]);
    double worst = 0.0;
    for (int k = 0; k < STATS_PERCENTS; k++) {
        const stats_value *value = &stats->percentile[k];
        char label[16];
        snprintf(label, sizeof label, "%d %%", cli_stats_percent[k]);
        sigma_print(out, label, value->value);
        fputs(cli_stats_percent[k] == 50 ? "   median" : "", out);
        band_print(out, value->low, value->high);
        fputc('\n', out);
        worst = fmax(worst, fmax(value->most - value->value, value->value - value->least));
    }
    place_print(out, "most", stats->plan, &stats->row[stats->rows - 1]);
    char text[CLI_BOUND_SIZE];
    cli_bound_text(worst, 2, text);
    fprintf(out, "  percentiles are known to %s m2 or better for these rows\n", text);
    if (stats->banded) {
        fprintf(
            out,
            "  materials: 68 %% by their errors, as if these moved all rows together, which is\n"
            "  seldom too narrow; an estimate, not a bound\n");
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
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_OBJECT);
    cli_json(json, "value=%g least=%g most=%g", value->value, value->least, value->most);
    band_json(json, value->low, value->high);
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
        cli_json(&json, "{percent=%u", cli_stats_percent[k]);
        value_json(&json, "sigma_m2", &stats->percentile[k]);
        cli_json(&json, "}");
    }
    cli_json(&json, "] cdf=[\n");
    for (uint32_t i = 0; i <= stats->bins && stats->bins > 0; i++) {
        cli_json(&json, "{sigma_dbsm=%g sigma_m2=%g", stats->edge_dbsm[i], stats->edge_m2[i]);
        value_json(&json, "share", &stats->cdf[i]);
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
    const sweep_stats *stats = context;
    fprintf(out, "# lrcs %s statistics; scene_hash=%016llx; rows=%llu; weights=%s", lrcs_version(),
            (unsigned long long)stats->head->scene_hash, (unsigned long long)stats->rows,
            stats->weights);
    for (uint32_t i = 0; i < stats->head->options; i++) {
        fprintf(out, "; %s=%s", stats->head->option[i].key, stats->head->option[i].text);
    }
    fprintf(out, "\nto_dbsm,to_m2,share,cdf,cdf_least,cdf_most%s\n",
            stats->banded ? ",cdf_material_low,cdf_material_high" : "");
    for (uint32_t i = 0; i <= stats->bins && stats->bins > 0; i++) {
        const stats_value *cdf = &stats->cdf[i];
        cli_number_put(out, "", stats->edge_dbsm[i]);
        cli_number_put(out, ",", stats->edge_m2[i]);
        cli_number_put(out, ",", cdf->value - (i > 0 ? cdf[-1].value : 0.0));
        cli_number_put(out, ",", cdf->value);
        cli_number_put(out, ",", cdf->least);
        cli_number_put(out, ",", cdf->most);
        if (stats->banded) {
            cli_number_put(out, ",", cdf->low);
            cli_number_put(out, ",", cdf->high);
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
    double fullest;
} stats_chart;

static int chart_write(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const stats_chart *from = context;
    const sweep_stats *stats = from->stats;
    const char *title = cli_head_text(stats->head, "title");
    char words[300], note[300], bars[80], about[4000];
    double least[STATS_BINS + 1], most[STATS_BINS + 1];
    double middle[STATS_BINS + 1], low[STATS_BINS + 1], high[STATS_BINS + 1];
    double wide = 0.0;
    for (uint32_t i = 0; i <= stats->bins; i++) {
        least[i] = stats->cdf[i].least;
        most[i] = stats->cdf[i].most;
        wide = fmax(wide, most[i] - least[i]);
        middle[i] = stats->cdf[i].value;
        low[i] = stats->cdf[i].low;
        high[i] = stats->cdf[i].high;
    }
    snprintf(words, sizeof words, "Distribution of sigma of %.200s", title ? title : "");
    snprintf(note, sizeof note, "%llu rows, %s; mean %.4g m2, median %.4g m2%s",
             (unsigned long long)stats->rows, stats->weights, stats->mean.value,
             stats->percentile[4].value,
             stats->banded ? "; shaded: 68 % by the errors of materials" : "");
    snprintf(bars, sizeof bars, "histogram: 1 is %.3g %% in %.3g dB", 100.0 * from->fullest,
             stats->edge_dbsm[1] - stats->edge_dbsm[0]);
    const lrcs_host_series known[] = {
        {bars, 2 * stats->bins + 2, from->bin_x, from->bin_y, NULL, LRCS_HOST_ORANGE,
         LRCS_HOST_NO_MARKER, LRCS_HOST_SOLID, 0, NULL, NULL},
        {"cumulative", from->count, from->x, from->y, NULL, LRCS_HOST_BLUE, LRCS_HOST_NO_MARKER,
         LRCS_HOST_SOLID, 0, NULL, NULL},
        {"at least, by bound", stats->bins + 1, stats->edge_dbsm, least, NULL, LRCS_HOST_SKY_BLUE,
         LRCS_HOST_TRIANGLE, LRCS_HOST_NO_LINE, 0, NULL, NULL},
        {"at most, by bound", stats->bins + 1, stats->edge_dbsm, most, NULL, LRCS_HOST_PURPLE,
         LRCS_HOST_CROSS, LRCS_HOST_NO_LINE, 0, NULL, NULL},
        {NULL, stats->bins + 1, stats->edge_dbsm, middle, NULL, LRCS_HOST_BLUE, LRCS_HOST_NO_MARKER,
         LRCS_HOST_NO_LINE, 0, low, high}};
    lrcs_host_series series[5] = {known[0], known[1], known[2], known[3]};
    uint32_t count = wide > 0.02 ? 4 : 2;
    if (stats->banded) {
        series[count++] = known[4];
    }
    int used = snprintf(about, sizeof about, "lrcs %s statistics", lrcs_version());
    cli_head_about(stats->head, about, sizeof about, (size_t)used);
    const lrcs_host_chart chart = {.title = words,
                                   .note = note,
                                   .about = about,
                                   .x_name = "sigma (dBsm)",
                                   .y_name = "share of all rows",
                                   .y_from_0 = 1,
                                   .series = series,
                                   .series_count = count};
    return cli_chart_put(out, &chart, png, error);
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
    for (uint32_t i = 0; i < stats->bins; i++) {
        chart->fullest = fmax(chart->fullest, stats->cdf[i + 1].value - stats->cdf[i].value);
    }
    for (size_t i = 0; i <= stats->bins; i++) {
        double left = i > 0 ? stats->cdf[i].value - stats->cdf[i - 1].value : 0.0;
        double right = i < stats->bins ? stats->cdf[i + 1].value - stats->cdf[i].value : 0.0;
        chart->bin_x[2 * i] = chart->bin_x[2 * i + 1] = stats->edge_dbsm[i];
        chart->bin_y[2 * i] = left / chart->fullest;
        chart->bin_y[2 * i + 1] = right / chart->fullest;
    }
    return 0;
}

/* ---- all of them ---- */

static int file_write(const char *path, const sweep_stats *stats)
{
    if (cli_extension(path, ".json") || cli_extension(path, ".csv")) {
        return cli_text_write(path, cli_extension(path, ".csv") ? stats_csv : stats_json, stats);
    }
    stats_chart chart;
    int code = chart_make(stats, &chart);
    if (code == 0 && stats->bins == 0) {
        fprintf(stderr, "lrcs: %s: nothing to draw: sigma of every row is 0\n", path);
        code = CLI_FAILED;
    }
    code = code ? code : cli_chart_write(path, chart_write, &chart);
    free(chart.x);
    return code;
}

int cli_stats_write(const cli_args *args, FILE *out, const sweep_stats *stats)
{
    int code = 0;
    if (cli_value(args, "stats")) {
        stats_print(out, stats);
    }
    for (int i = 0; i < args->given_count && code == 0; i++) {
        if (is_stats_file(&args->given[i])) {
            code = file_write(args->given[i].value, stats);
        }
    }
    return code;
}
