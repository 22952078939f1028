/* SPDX-License-Identifier: MIT */
/* Tables of a study: how they fill, and how they are written as CSV and as charts. Other files
   decide which tables there are and what they contain. */
#include "study.h"

#include <math.h>
#include <string.h>

/* ---- filling ---- */

study_table *study_table_add(study_job *job, const char *stem, const char *title)
{
    study_table *table = &job->table[job->tables++];
    table->stem = stem;
    table->title = title;
    table->maker = "Closed forms";
    return table;
}

uint32_t study_column_add(study_table *table, const char *id, const char *name, int colour,
                          int dash)
{
    study_column *column = &table->column[table->columns];
    snprintf(column->id, sizeof column->id, "%s", id);
    snprintf(column->name, sizeof column->name, "%s", name);
    column->colour = colour;
    column->dash = dash;
    return table->columns++;
}

void study_put(study_table *table, uint32_t column, uint32_t row, study_number number)
{
    table->column[column].value[row] = number.value;
    table->bound[row] = fmax(table->bound[row], number.bound);
    if (number.value > table->floor) {
        table->relative = fmax(table->relative, number.bound / number.value);
    }
    table->rows = row + 1 > table->rows ? row + 1 : table->rows;
}

const study_table *study_find(const study_job *job, const char *stem)
{
    uint32_t i = 0;
    while (i + 1 < job->tables && strcmp(job->table[i].stem, stem) != 0) {
        i++;
    }
    return &job->table[i];
}

/* ---- CSV ---- */

static void cell_write(FILE *out, double value)
{
    char text[LRCS_HOST_NUMBER_SIZE];
    lrcs_host_number_text(value, text);
    fprintf(out, ",%s", text);
}

/* The last column: the largest bound of the row, with the unit that its columns have. */
static void bound_head(const study_table *table, FILE *out)
{
    const char *unit = strrchr(table->column[0].id, '_');
    int known = unit && (strcmp(unit, "_m2") == 0 || strcmp(unit, "_deg") == 0);
    fprintf(out, ",%s%s\n", table->estimate ? "error_estimate" : "bound", known ? unit : "");
}

static int csv_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const study_table *table = context;
    (void)error;
    fprintf(out, "%s", table->x_id);
    for (uint32_t c = 0; c < table->columns; c++) {
        fprintf(out, ",%s", table->column[c].id);
    }
    bound_head(table, out);
    for (uint32_t r = 0; r < table->rows; r++) {
        char text[LRCS_HOST_NUMBER_SIZE];
        lrcs_host_number_text(table->x[r], text);
        fprintf(out, "%s", table->row_name[r] ? table->row_name[r] : text);
        for (uint32_t c = 0; c < table->columns; c++) {
            cell_write(out, table->column[c].value[r]);
        }
        cell_write(out, table->bound[r]);
        fputc('\n', out);
    }
    return LRCS_OK;
}

/* ---- charts ---- */

/* The points of one curve, and of the other half turn of a body that looks alike. */
typedef struct chart_curve {
    uint32_t count;
    double x[2 * STUDY_ROWS], y[2 * STUDY_ROWS];
} chart_curve;

static void curve_take(const study_table *table, uint32_t column, int polar, chart_curve *curve)
{
    curve->count = polar ? 2 * table->rows - 1 : table->rows;
    for (uint32_t i = 0; i < curve->count; i++) {
        uint32_t row = i < table->rows ? i : 2 * table->rows - 2 - i;
        double value = table->column[column].value[row];
        curve->x[i] = i < table->rows ? table->x[row] : 360.0 - table->x[row];
        curve->y[i] = table->chart == STUDY_DBSM ? study_dbsm(value) : value;
    }
}

/* A curve ends at the floor: the first point below it is moved there, the others are dropped. */
static void curve_clip(chart_curve *curve, double floor)
{
    double before = HUGE_VAL;
    for (uint32_t i = 0; i < curve->count; i++) {
        double now = curve->y[i];
        int next_above = i + 1 < curve->count && curve->y[i + 1] > floor;
        int last_above = i > 0 && before > floor;
        before = now;
        if (now > floor) {
            continue;
        }
        curve->y[i] = next_above || last_above ? floor : (double)NAN;
        if ((next_above || last_above) && isfinite(now)) {
            uint32_t other = last_above ? i - 1 : i + 1;
            double part = (floor - now) / (curve->y[other] - now);
            curve->x[i] += part * (curve->x[other] - curve->x[i]);
        }
    }
}

static int chart_write(FILE *out, const study_table *table, int polar)
{
    chart_curve curve[STUDY_COLUMNS];
    lrcs_host_series series[STUDY_COLUMNS];
    for (uint32_t c = 0; c < table->columns; c++) {
        curve_take(table, c, polar, &curve[c]);
        if (table->chart == STUDY_DBSM) {
            curve_clip(&curve[c], study_dbsm(table->floor));
        }
        series[c] = (lrcs_host_series){.name = table->column[c].name,
                                       .count = curve[c].count,
                                       .x = curve[c].x,
                                       .y = curve[c].y,
                                       .colour = table->column[c].colour,
                                       .marker = LRCS_HOST_NO_MARKER,
                                       .dash = table->column[c].dash};
    }
    const lrcs_host_chart chart = {
        .title = table->title,
        .note = table->note,
        .x_name = polar ? "line of sight from the axis (deg)" : table->x_name,
        .y_name = table->y_name,
        .x_log = table->chart == STUDY_LOG_LOG,
        .y_log = table->chart == STUDY_LOG_LOG || table->chart == STUDY_LOG,
        .x_deg = table->chart == STUDY_DBSM,
        .polar = polar,
        .series = series,
        .series_count = table->columns};
    lrcs_host_chart_svg(out, &chart);
    return LRCS_OK;
}

static int svg_write(FILE *out, const void *context, lrcs_host_error *error)
{
    (void)error;
    return chart_write(out, context, 0);
}

static int polar_write(FILE *out, const void *context, lrcs_host_error *error)
{
    (void)error;
    return chart_write(out, context, 1);
}

/* ---- files ---- */

static int page_write(FILE *out, const void *context, lrcs_host_error *error)
{
    (void)error;
    study_page(context, out);
    return LRCS_OK;
}

typedef int study_writer(FILE *out, const void *context, lrcs_host_error *error);

static int file_write(const char *folder, const char *stem, const char *end, study_writer *write,
                      const void *context, lrcs_host_error *error)
{
    char path[4096];
    int size = snprintf(path, sizeof path, "%s/%s%s", folder, stem, end);
    if (size < 0 || (size_t)size >= sizeof path) {
        snprintf(error->text, sizeof error->text, "the name of the folder is too long");
        return LRCS_E_LIMIT;
    }
    lrcs_host_output out;
    int status = lrcs_host_output_open(path, &out, error);
    if (status == LRCS_OK) {
        status = write(out.stream, context, error);
        int good = status == LRCS_OK;
        int closed = lrcs_host_output_close(&out, good, good ? error : NULL);
        status = good ? closed : status;
    }
    return status;
}

int study_write(const study_job *job, const char *folder, lrcs_host_error *error)
{
    int status = LRCS_OK;
    for (uint32_t i = 0; i < job->tables && status == LRCS_OK; i++) {
        const study_table *table = &job->table[i];
        status = file_write(folder, table->stem, ".csv", csv_write, table, error);
        if (status == LRCS_OK && table->chart != STUDY_NO_CHART) {
            status = file_write(folder, table->stem, ".svg", svg_write, table, error);
        }
        if (status == LRCS_OK && table->polar) {
            status = file_write(folder, table->stem, "-polar.svg", polar_write, table, error);
        }
    }
    return status == LRCS_OK ? file_write(folder, "study", ".md", page_write, job, error) : status;
}
