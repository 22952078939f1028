/* SPDX-License-Identifier: MIT */
/* Measured rows as Markdown tables, as CSV and as a chart. It decides how numbers are shown, and
   none of them. */
#include "bench/rows.h"

#include <lrcs/host.h>

#include <string.h>

bench_row *bench_row_add(bench_table *table, const char *scene, const lrcs_scene *of,
                         const char *stage, bench_times *times)
{
    bench_check(table->count < BENCH_ROWS ? LRCS_OK : LRCS_E_LIMIT, "rows");
    bench_row *row = &table->row[table->count++];
    *row = (bench_row){.facets = of->facet_count, .vertices = of->vertex_count};
    snprintf(row->scene, sizeof row->scene, "%s", scene);
    snprintf(row->stage, sizeof row->stage, "%s", stage);
    row->ms = bench_quantile(times, 0.5);
    row->low = bench_quantile(times, 0.25);
    row->high = bench_quantile(times, 0.75);
    return row;
}

/* ---- Markdown ---- */

enum { CELL = 32 };
#define LINE "------------------------------------------------"

/* A number in a cell to some places, or a dash where there is none. */
static const char *cell_text(char cell[CELL], int places, double value)
{
    if (value > 0) {
        snprintf(cell, CELL, "%.*f", places, value);
    } else {
        snprintf(cell, CELL, "-");
    }
    return cell;
}

static double per_facet(const bench_row *row)
{
    return row->facets > 0 ? 1e6 * row->ms / row->facets : 0;
}

static double per_pixel(const bench_row *row)
{
    return row->pixels > 0 ? 1e6 * row->ms / (double)row->pixels : 0;
}

static double over(double ms, double limit)
{
    return limit > 0 ? ms / limit : 0;
}

/* "1.5: met", "1.5: 3.2 x over" */
static const char *target_text(char cell[CELL], const bench_row *row)
{
    if (!(row->target > 0)) {
        snprintf(cell, CELL, "-");
    } else if (row->ms <= row->target) {
        snprintf(cell, CELL, "%.3g: met", row->target);
    } else {
        snprintf(cell, CELL, "%.3g: %.1f x over", row->target, row->ms / row->target);
    }
    return cell;
}

void bench_table_scene(const bench_table *table, uint32_t first)
{
    char cell[7][CELL];
    const bench_row *head = &table->row[first];
    printf("\n%s: %lu facets\n\n", head->scene, (unsigned long)head->facets);
    printf("| %-18s | %10s | %21s | %8s | %8s | %9s | %9s | %7s | %-24s |\n", "stage", "ms",
           "quartiles", "ns/facet", "ns/pixel", "work MB", "limit ms", "x limit", "target ms");
    printf("|:%.18s-|%.11s:|%.22s:|%.9s:|%.9s:|%.10s:|%.10s:|%.8s:|:%.24s-|\n", LINE, LINE, LINE,
           LINE, LINE, LINE, LINE, LINE, LINE);
    for (uint32_t i = first; i < table->count; i++) {
        const bench_row *row = &table->row[i];
        printf("| %-18s | %10.4g | %10.4g .. %-7.4g | %8s | %8s | %9s | %9s | %7s | %-24s |\n",
               row->stage, row->ms, row->low, row->high, cell_text(cell[0], 1, per_facet(row)),
               cell_text(cell[1], 2, per_pixel(row)),
               cell_text(cell[2], 2, 1e-6 * (double)row->bytes), cell_text(cell[3], 3, row->limit),
               cell_text(cell[4], 1, over(row->ms, row->limit)), target_text(cell[5], row));
    }
    fflush(stdout);
}

/* The row of a stage in the scene that starts at `first`, or NULL. */
static const bench_row *stage_row(const bench_table *table, uint32_t first, const char *stage)
{
    for (uint32_t i = first; i < table->count; i++) {
        const bench_row *row = &table->row[i];
        if (strcmp(row->scene, table->row[first].scene) != 0) {
            return NULL;
        }
        if (strcmp(row->stage, stage) == 0) {
            return row;
        }
    }
    return NULL;
}

/* "2.31 (1.5: 1.5 x over)" */
static void pose_print(const bench_row *row)
{
    char text[2 * CELL] = "-";
    char cell[CELL];
    if (row && row->target > 0) {
        snprintf(text, sizeof text, "%.3g (%s)", row->ms, target_text(cell, row));
    } else if (row) {
        snprintf(text, sizeof text, "%.3g", row->ms);
    }
    printf(" %-24s |", text);
}

void bench_table_poses(const bench_table *table)
{
    static const char *const shown[] = {"load",       "prepare",  "pose facet", "pose zbuffer 1024",
                                        "pose exact", "read mesh"};
    printf("\nWhole poses, medians in ms (target: how it is met)\n\n");
    printf("| %-26s | %9s | %-24s | %-24s | %-24s | %-24s | %-24s | %-24s |\n", "scene", "facets",
           "load", "prepare", "facet", "zbuffer 1024", "exact", "mesh read once (limit)");
    printf("|:%.26s-|%.10s:|", LINE, LINE);
    for (size_t k = 0; k < sizeof shown / sizeof shown[0]; k++) {
        printf(":%.24s-|", LINE);
    }
    printf("\n");
    for (uint32_t i = 0; i < table->count; i++) {
        if (i > 0 && strcmp(table->row[i - 1].scene, table->row[i].scene) == 0) {
            continue;
        }
        printf("| %-26s | %9lu |", table->row[i].scene, (unsigned long)table->row[i].facets);
        for (size_t k = 0; k < sizeof shown / sizeof shown[0]; k++) {
            pose_print(stage_row(table, i, shown[k]));
        }
        printf("\n");
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

static void count_print(FILE *out, size_t value)
{
    if (value > 0) {
        fprintf(out, ",%zu", value);
    } else {
        fprintf(out, ",");
    }
}

void bench_table_csv(const bench_table *table, FILE *out)
{
    bench_machine(out, "# ");
    fprintf(out, "scene,facets,vertices,stage,ms,ms_low_quartile,ms_high_quartile,ns_per_facet,"
                 "ns_per_pixel,work_bytes,limit_ms,times_limit,target_ms,times_target\n");
    for (uint32_t i = 0; i < table->count; i++) {
        const bench_row *row = &table->row[i];
        fprintf(out, "%s,%lu,%lu,%s,%.6g,%.6g,%.6g", row->scene, (unsigned long)row->facets,
                (unsigned long)row->vertices, row->stage, row->ms, row->low, row->high);
        field_print(out, per_facet(row));
        field_print(out, per_pixel(row));
        count_print(out, row->bytes);
        field_print(out, row->limit);
        field_print(out, over(row->ms, row->limit));
        field_print(out, row->target);
        field_print(out, over(row->ms, row->target));
        fprintf(out, "\n");
    }
}

/* ---- chart ---- */

enum { CURVE_POINTS = 16 };

typedef struct bench_curve {
    const char *name, *stage;
    int convex; /* of the convex body */
    int colour, marker, dash, hollow;
    double x[CURVE_POINTS], y[CURVE_POINTS];
} bench_curve;

static lrcs_host_series curve_fill(const bench_table *table, const char *scenes, bench_curve *curve)
{
    lrcs_host_series series = {.name = curve->name,
                               .x = curve->x,
                               .y = curve->y,
                               .colour = curve->colour,
                               .marker = curve->marker,
                               .dash = curve->dash,
                               .hollow = curve->hollow};
    for (uint32_t i = 0; i < table->count && series.count < CURVE_POINTS; i++) {
        const bench_row *row = &table->row[i];
        if (strncmp(row->scene, scenes, strlen(scenes)) == 0 &&
            strcmp(row->stage, curve->stage) == 0) {
            curve->x[series.count] = row->facets;
            curve->y[series.count++] = row->ms;
        }
    }
    return series;
}

void bench_table_chart(const bench_table *table, const char *made, const char *convex, FILE *out)
{
    bench_curve curve[] = {
        {"prepare (once)", "prepare", 0, LRCS_HOST_ORANGE, LRCS_HOST_TRIANGLE, 0, 0, {0}, {0}},
        {"zbuffer 1024", "pose zbuffer 1024", 0, LRCS_HOST_BLUE, LRCS_HOST_DISC, 0, 0, {0}, {0}},
        {"exact", "pose exact", 0, LRCS_HOST_VERMILION, LRCS_HOST_DIAMOND, 0, 0, {0}, {0}},
        {"facet", "pose facet", 0, LRCS_HOST_PURPLE, LRCS_HOST_SQUARE, 0, 0, {0}, {0}},
        {"facet, convex body", "pose facet", 1, LRCS_HOST_PURPLE, LRCS_HOST_SQUARE, 0, 1, {0}, {0}},
        {"stage: raster 1024", "raster 1024", 0, LRCS_HOST_BLUE, LRCS_HOST_DISC, 1, 1, {0}, {0}},
        {"stage: contest", "contest", 0, LRCS_HOST_GREEN, LRCS_HOST_TRIANGLE, 1, 1, {0}, {0}},
        {"stage: sum", "sum", 0, LRCS_HOST_SKY_BLUE, LRCS_HOST_DISC, 1, 1, {0}, {0}},
        {"stage: cull", "cull", 0, LRCS_HOST_GREEN, LRCS_HOST_SQUARE, 1, 1, {0}, {0}},
        {"limit: write a frame",
         "write frame 1024",
         0,
         LRCS_HOST_BLACK,
         LRCS_HOST_CROSS,
         2,
         0,
         {0},
         {0}},
        {"limit: read the mesh", "read mesh", 0, LRCS_HOST_BLACK, LRCS_HOST_CROSS, 1, 0, {0}, {0}},
    };
    enum { CURVES = sizeof curve / sizeof curve[0] };
    lrcs_host_series series[CURVES];
    for (int i = 0; i < CURVES; i++) {
        series[i] = curve_fill(table, curve[i].convex ? convex : made, &curve[i]);
    }
    const lrcs_host_chart chart = {
        .title = "What a pose costs, and its stages, as the mesh grows",
        .note =
            "generated satellite, medians over directions; dotted and dashed black: memory alone",
        .x_name = "facets",
        .y_name = "time (ms)",
        .x_log = 1,
        .y_log = 1,
        .series = series,
        .series_count = CURVES};
    lrcs_host_chart_svg(out, &chart);
}
