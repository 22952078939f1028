/* SPDX-License-Identifier: MIT */
/* Measured rows as Markdown tables, as CSV and as a chart. This file decides how numbers are shown,
   and computes none. */
#include "bench/rows.h"

#include <lrcs/host.h>

#include <string.h>

/* ---- rows ---- */

/* A number of a sample. */
enum sample_item { ITEM_CPU, ITEM_WALL, ITEM_BOUND, ITEM_ESTIMATE, ITEM_FIRST };

static double sample_item(const bench_sample *s, int item)
{
    return item == ITEM_CPU     ? s->cpu
           : item == ITEM_WALL  ? s->wall
           : item == ITEM_BOUND ? s->bound
           : item == ITEM_FIRST ? s->first
                                : s->estimate;
}

static double cell_quantile(const bench_cell *cell, int from, int item, double share)
{
    bench_times times = {.count = 0};
    for (int i = from; i < cell->count; i++) {
        bench_add(&times, sample_item(&cell->sample[i], item));
    }
    return bench_quantile(&times, share);
}

const bench_row *bench_row_add(bench_table *table, const char *scene, const lrcs_scene *of,
                               const char *what, const bench_cell *cell, int warm)
{
    bench_check(table->count < BENCH_ROWS ? LRCS_OK : LRCS_E_LIMIT, "rows");
    bench_row *row = &table->row[table->count++];
    int from = cell->count > warm ? warm : 0;
    *row = (bench_row){.facets = of->facet_count, .vertices = of->vertex_count, .end = cell->end};
    snprintf(row->scene, sizeof row->scene, "%s", scene);
    for (char *at = strpbrk(row->scene, ",\"\n"); at; at = strpbrk(at, ",\"\n")) {
        *at = '_'; /* a name is one field of the CSV */
    }
    snprintf(row->what, sizeof row->what, "%s", what);
    row->samples = cell->count - from;
    row->wall = cell_quantile(cell, from, ITEM_WALL, 0.5);
    int item = cell->count > 0 && cell->sample[0].cpu > 0 ? ITEM_CPU : ITEM_WALL;
    row->ms = cell_quantile(cell, from, item, 0.5);
    row->low = cell_quantile(cell, from, item, 0.25);
    row->high = cell_quantile(cell, from, item, 0.75);
    row->first = cell_quantile(cell, from, ITEM_FIRST, 0.5);
    row->bound = cell_quantile(cell, from, ITEM_BOUND, 0.5);
    row->estimate = cell_quantile(cell, from, ITEM_ESTIMATE, 0.5);
    for (int i = 0; i < cell->count; i++) {
        row->bytes = cell->sample[i].bytes > row->bytes ? cell->sample[i].bytes : row->bytes;
    }
    return row;
}

/* The row of something of the scene that row `first` is of, or NULL. */
static const bench_row *row_find(const bench_table *table, uint32_t first, const char *what)
{
    const char *scene = table->row[first].scene;
    for (uint32_t i = first; i < table->count && strcmp(table->row[i].scene, scene) == 0; i++) {
        if (strcmp(table->row[i].what, what) == 0) {
            return &table->row[i];
        }
    }
    return NULL;
}

static int scene_begins(const bench_table *table, uint32_t i)
{
    return i == 0 || strcmp(table->row[i - 1].scene, table->row[i].scene) != 0;
}

/* What is compared with which peer. */
typedef struct row_ratio {
    const char *what, *peer;
} row_ratio;

static const row_ratio ratios[] = {{"prepare", "Embree tree"},
                                   {"zbuffer 1024", "llvmpipe 1024"},
                                   {"exact", "Embree 1024"},
                                   {"estimate 1e-2", "llvmpipe 1024"},
                                   {"estimate 1e-3", "llvmpipe 1024"}};
enum { RATIOS = sizeof ratios / sizeof ratios[0] };

/* The ratio of two wall-clock times of this run; 0 if one is missing or incomplete. */
static double ratio_of(const bench_table *table, uint32_t first, const row_ratio *ratio)
{
    const bench_row *row = row_find(table, first, ratio->what);
    const bench_row *peer = row_find(table, first, ratio->peer);
    return row && peer && row->samples > 0 && peer->samples > 0 ? row->wall / peer->wall : 0;
}

/* ---- Markdown ---- */

/* "35.1", "> 20 s" if no sample came in time, "failed", or "-" if it was not to be measured. */
static void time_print(const bench_row *row, double ms, double limit_s)
{
    char text[32] = "-";
    if (row && row->samples > 0 && ms > 0) {
        snprintf(text, sizeof text, ms < 99.95 ? "%.3g" : "%.0f", ms);
    } else if (row && row->end == BENCH_TOO_LONG) {
        snprintf(text, sizeof text, "> %g s", limit_s);
    } else if (row && row->end == BENCH_FAILED) {
        snprintf(text, sizeof text, "failed");
    }
    printf(" %8s |", text);
}

static void scene_print(const bench_row *row)
{
    printf("| %-26s | %7lu |", row->scene, (unsigned long)row->facets);
}

static void times_print(const bench_table *table, double limit_s)
{
    static const char *const shown[] = {
        "load",      "prepare",   "facet",     "zbuffer 512", "zbuffer 1024",  "exact",
        "auto 1e-1", "auto 1e-2", "auto 1e-3", "auto 1e-4",   "estimate 1e-2", "estimate 1e-3"};
    enum { SHOWN = sizeof shown / sizeof shown[0], EXACT = 5 };
    printf(
        "\nMedians in ms of one processor's time, over the same directions; first: in a work area "
        "that nothing has been in\n\n");
    printf("| %-26s | %7s |", "scene", "facets");
    for (int k = 0; k < SHOWN; k++) {
        printf(k == EXACT ? " exact, first | exact |" : " %s |", shown[k]);
    }
    printf("\n|:---|---:|---:|");
    for (int k = 0; k < SHOWN; k++) {
        printf("---:|");
    }
    printf("\n");
    for (uint32_t i = 0; i < table->count; i++) {
        if (!scene_begins(table, i)) {
            continue;
        }
        scene_print(&table->row[i]);
        for (int k = 0; k < SHOWN; k++) {
            const bench_row *row = row_find(table, i, shown[k]);
            if (k == EXACT) {
                time_print(row, row ? row->first : 0, limit_s);
            }
            time_print(row, row ? row->ms : 0, limit_s);
        }
        printf("\n");
    }
}

static void ratios_print(const bench_table *table, double limit_s)
{
    static const char *const peer[] = {"llvmpipe 1024", "Embree 1024", "Embree tree"};
    printf("\nPeers' medians in ms on the wall (llvmpipe: all processors), and how many times as "
           "long lrcs takes\n\n| %-26s | %7s | llvmpipe 1024 | Embree 1024 | Embree tree |",
           "scene", "facets");
    for (int k = 0; k < RATIOS; k++) {
        printf(" %s / %s |", ratios[k].what, ratios[k].peer);
    }
    printf("\n|:---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (uint32_t i = 0; i < table->count; i++) {
        if (!scene_begins(table, i) || !row_find(table, i, peer[0])) {
            continue;
        }
        scene_print(&table->row[i]);
        for (int k = 0; k < 3; k++) {
            const bench_row *row = row_find(table, i, peer[k]);
            time_print(row, row ? row->ms : 0, limit_s);
        }
        for (int k = 0; k < RATIOS; k++) {
            double ratio = ratio_of(table, i, &ratios[k]);
            printf(ratio > 0 ? " %8.3g |" : "        - |", ratio);
        }
        printf("\n");
    }
}

void bench_table_print(const bench_table *table, double limit_s)
{
    times_print(table, limit_s);
    for (uint32_t i = 0; i < table->count; i++) {
        if (scene_begins(table, i) && row_find(table, i, ratios[0].peer)) {
            ratios_print(table, limit_s);
            return;
        }
    }
}

/* ---- CSV ---- */

static void field_print(FILE *out, double value)
{
    if (value > 0) {
        fprintf(out, ",%.6g", value);
    } else {
        fprintf(out, ",");
    }
}

void bench_table_csv(const bench_table *table, FILE *out)
{
    static const char *const end[] = {"done", "too long", "failed"};
    uint32_t first = 0;
    bench_machine(out, "# ");
    fprintf(out, "scene,facets,vertices,what,ms,ms_low_quartile,ms_high_quartile,wall_ms,"
                 "first_ms,samples,end,work_bytes,bound_over_sigma,estimate_over_sigma,peer,"
                 "times_peer\n");
    for (uint32_t i = 0; i < table->count; i++) {
        const bench_row *row = &table->row[i];
        const row_ratio *ratio = NULL;
        first = scene_begins(table, i) ? i : first;
        for (int k = 0; k < RATIOS; k++) {
            ratio = strcmp(ratios[k].what, row->what) == 0 ? &ratios[k] : ratio;
        }
        double times = ratio ? ratio_of(table, first, ratio) : 0;
        fprintf(out, "%s,%lu,%lu,%s", row->scene, (unsigned long)row->facets,
                (unsigned long)row->vertices, row->what);
        field_print(out, row->ms);
        field_print(out, row->low);
        field_print(out, row->high);
        field_print(out, row->wall);
        field_print(out, row->first);
        fprintf(out, ",%d,%s", row->samples, end[row->end]);
        field_print(out, row->bytes);
        field_print(out, row->bound);
        field_print(out, row->estimate);
        fprintf(out, ",%s", times > 0 ? ratio->peer : "");
        field_print(out, times);
        fprintf(out, "\n");
    }
}

/* ---- chart ---- */

enum { CURVE_POINTS = 64 };

/* One of the measured times, of every scene. */
typedef struct bench_curve {
    const char *what;
    int colour, marker, hollow;
    double x[CURVE_POINTS], y[CURVE_POINTS];
    const char *label[CURVE_POINTS];
} bench_curve;

static lrcs_host_series curve_fill(const bench_table *table, int labelled, bench_curve *curve)
{
    lrcs_host_series series = {.name = curve->what,
                               .x = curve->x,
                               .y = curve->y,
                               .label = labelled ? curve->label : NULL,
                               .colour = curve->colour,
                               .marker = curve->marker,
                               .dash = LRCS_HOST_NO_LINE,
                               .hollow = curve->hollow};
    for (uint32_t i = 0; i < table->count && series.count < CURVE_POINTS; i++) {
        const bench_row *row = &table->row[i];
        if (row->samples > 0 && strcmp(row->what, curve->what) == 0) {
            curve->label[series.count] = row->scene;
            curve->x[series.count] = row->facets;
            curve->y[series.count++] = row->ms;
        }
    }
    return series;
}

void bench_table_chart(const bench_table *table, FILE *out)
{
    static bench_curve curve[] = {
        {.what = "exact", .colour = LRCS_HOST_VERMILION, .marker = LRCS_HOST_DIAMOND},
        {.what = "estimate 1e-2", .colour = LRCS_HOST_ORANGE, .marker = LRCS_HOST_CROSS},
        {.what = "zbuffer 1024", .colour = LRCS_HOST_BLUE, .marker = LRCS_HOST_DISC},
        {.what = "facet", .colour = LRCS_HOST_PURPLE, .marker = LRCS_HOST_SQUARE},
        {.what = "prepare", .colour = LRCS_HOST_GREEN, .marker = LRCS_HOST_TRIANGLE},
        {.what = "llvmpipe 1024", .marker = LRCS_HOST_DISC, .hollow = 1},
        {.what = "Embree 1024", .marker = LRCS_HOST_DIAMOND, .hollow = 1},
        {.what = "Embree tree", .marker = LRCS_HOST_TRIANGLE, .hollow = 1},
    };
    enum { CURVES = sizeof curve / sizeof curve[0] };
    lrcs_host_series series[CURVES];
    uint32_t count = 0;
    for (int i = 0; i < CURVES; i++) {
        series[count] = curve_fill(table, i == 0, &curve[i]);
        count += series[count].count > 0;
    }
    const lrcs_host_chart chart = {.title = "What a pose costs, scene by scene",
                                   .note = "medians over directions, one thread; hollow: other "
                                           "engines, where they are built (llvmpipe: all "
                                           "processors)",
                                   .x_name = "facets",
                                   .y_name = "time (ms)",
                                   .x_log = 1,
                                   .y_log = 1,
                                   .series = series,
                                   .series_count = count};
    lrcs_host_chart_svg(out, &chart);
}
