/* SPDX-License-Identifier: MIT */
/* The format of the rows of a sweep: CSV, with '#' before lines that are no rows, or JSON lines.
   This file decides their bytes, which depend only on the sweep and its results. */
#include "host/sweep/rows.h"

#include <lrcs/write.h>

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/sum.h"

/* A character of a text that stays on its line. */
#define PLAIN_CHAR(c) ((unsigned char)(c) < 0x20 || (c) == 0x7f ? '?' : (c))

const char *lrcsi_row_field_text(int field)
{
    static const char *const name[LRCS_HOST_ROW_FIELDS] = {
        "sigma_m2",           "sigma_dbsm",
        "bound_m2",           "sigma_glint_m2",
        "sigma_diffuse_m2",   "material_deviation_m2",
        "material_low_m2",    "material_high_m2",
        "material_sampled",   "glint_error_estimate_m2",
        "one_facet_dominates"};
    return name[field];
}

lrcs_host_row_fields lrcsi_row_fields(int materials, int glint)
{
    lrcs_host_row_fields fields = {.materials = materials, .glint = glint};
    for (int kind = 0; kind < LRCS_HOST_ROW_FIELDS; kind++) {
        if (kind < LRCS_HOST_ROW_DEVIATION ||
            (kind < LRCS_HOST_ROW_GLINT_ERROR ? materials : glint)) {
            fields.kind[fields.count++] = kind;
        }
    }
    return fields;
}

/* Adds a number to a compensated sum. */
static void tally_sum_add(double sum[2], double x)
{
    lrcsi_sum both = {sum[0], sum[1]};
    lrcsi_sum_add(&both, x);
    sum[0] = both.high;
    sum[1] = both.low;
}

void lrcs_host_tally_add(lrcs_host_tally *tally, const lrcs_host_row *row)
{
    static const uint32_t flag[LRCS_HOST_TALLY_FLAGS] = {
        LRCS_FLAG_TOLERANCE_NOT_MET, LRCS_FLAG_MEMORY_FALLBACK, LRCS_FLAG_ACCEPTED_BY_ESTIMATE,
        LRCS_FLAG_ACCEPTED_UNJUDGED};
    double sigma = row->field[LRCS_HOST_ROW_SIGMA];
    double off = sigma - tally->mean;
    tally->rows++;
    tally->mean += off / (double)tally->rows; /* B. P. Welford, Technometrics 4 (1962) 419 */
    tally->square += off * (sigma - tally->mean);
    tally_sum_add(tally->sigma, sigma);
    tally_sum_add(tally->bound, row->field[LRCS_HOST_ROW_BOUND]);
    for (int k = 0; k < LRCS_HOST_TALLY_FLAGS; k++) {
        tally->count[k] += (row->flags & flag[k]) != 0;
    }
    tally->count[LRCS_HOST_TALLY_DOMINATED] += row->field[LRCS_HOST_ROW_DOMINATED] > 0.0;
}

double lrcs_host_tally_mean(const lrcs_host_tally *tally)
{
    return (tally->sigma[0] + tally->sigma[1]) / (double)tally->rows;
}

/* The sums have relative errors of less than 2 u each, as all terms are positive; 4 u of the mean
   include the division, and so do 8 u of the bound. */
double lrcs_host_tally_bound(const lrcs_host_tally *tally)
{
    double bound = (tally->bound[0] + tally->bound[1]) / (double)tally->rows;
    return bound * (1.0 + 8.0 * LRCSI_U) + 4.0 * LRCSI_U * lrcs_host_tally_mean(tally);
}

double lrcs_host_tally_error(const lrcs_host_tally *tally)
{
    double n = (double)tally->rows;
    return tally->rows > 1 ? sqrt(tally->square / (n - 1.0) / n) : (double)NAN;
}

/* ---- the first lines ---- */

int lrcs_host_rows_head_add(lrcs_host_rows_head *head, const char *key, const char *text)
{
    const size_t room = sizeof head->option[0].text;
    uint32_t at = 0;
    while (at < head->options && strcmp(head->option[at].key, key) != 0) {
        at++;
    }
    if (at == LRCS_HOST_HEAD_OPTIONS) {
        return 0;
    }
    char *end = head->option[at].text + strlen(head->option[at].text);
    size_t left = room - (size_t)(end - head->option[at].text);
    int size = snprintf(end, left, "%s%s", at < head->options ? " and " : "", text);
    head->option[at].key = key;
    head->options += at == head->options;
    for (; *end; end++) {
        *end = PLAIN_CHAR(*end);
    }
    return size >= 0 && (size_t)size < left;
}

void lrcs_host_rows_head_make(const lrcs_host_plan *plan, uint64_t scene_hash, int materials,
                              int glint, lrcs_host_rows_head *head)
{
    memset(head, 0, sizeof *head);
    head->scene_hash = scene_hash;
    head->rows = plan->rows;
    head->fields = lrcsi_row_fields(materials, glint);
    for (uint32_t i = 0; i < plan->axes; i++) {
        if (plan->axis[i].range.count > 1) {
            head->shape[head->dimensions++] = plan->axis[i].range.count;
        }
    }
    if (plan->kind == LRCS_HOST_PLAN_SPHERE || plan->kind == LRCS_HOST_PLAN_TRACK ||
        head->dimensions == 0) {
        head->shape[head->dimensions++] = plan->kind == LRCS_HOST_PLAN_FIXED ? 1 : plan->poses;
    }
    if (materials) { /* before all texts from users: readers search for it */
        lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
        char text[64];
        snprintf(text, sizeof text, "%lu draws seed %lu", (unsigned long)how.draws,
                 (unsigned long)how.seed);
        lrcs_host_rows_head_add(head, LRCSI_ROWS_UNCERTAINTY, text);
    }
    if (glint) {
        lrcs_host_rows_head_add(head, LRCSI_ROWS_COARSE_GLINT, "estimated");
    }
}

const char *lrcs_host_rows_head_text(const lrcs_host_rows_head *head, const char *key)
{
    for (uint32_t i = 0; i < head->options; i++) {
        if (strcmp(head->option[i].key, key) == 0) {
            return head->option[i].text;
        }
    }
    return NULL;
}

void lrcs_host_rows_options_write(FILE *out, const lrcs_host_rows_head *head)
{
    for (uint32_t i = 0; i < head->options; i++) {
        fprintf(out, "; %s=%s", head->option[i].key, head->option[i].text);
    }
}

/* ---- CSV ---- */

/* A number that is not finite is left out. */
static void row_number_write(FILE *out, const char *before, double value)
{
    char text[LRCS_HOST_NUMBER_SIZE] = "";
    if (isfinite(value)) {
        lrcs_host_number_text(value, text);
    }
    fprintf(out, "%s%s", before, text);
}

static void csv_head_write(FILE *out, const lrcs_host_rows_head *head, const lrcs_host_plan *plan)
{
    fprintf(out, "# lrcs %s sweep; scene_hash=%016llx; rows=%llu; shape=", lrcs_version(),
            (unsigned long long)head->scene_hash, (unsigned long long)head->rows);
    for (uint32_t i = 0; i < head->dimensions; i++) {
        fprintf(out, "%s%llu", i > 0 ? "x" : "", (unsigned long long)head->shape[i]);
    }
    lrcs_host_rows_options_write(out, head);
    fputs("\nindex", out);
    for (uint32_t i = 0; i < plan->columns; i++) {
        putc(',', out);
        lrcs_host_csv_text(out, plan->column[i], ",\"");
    }
    for (uint32_t i = 0; i < head->fields.count; i++) {
        fprintf(out, ",%s", lrcsi_row_field_text(head->fields.kind[i]));
    }
    fputs(",flags\n", out);
}

static void csv_row_write(FILE *out, const lrcs_host_row_fields *fields, const lrcs_host_plan *plan,
                          const lrcs_host_row *row)
{
    const char *before = ",";
    fprintf(out, "%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < plan->columns; i++) {
        row_number_write(out, ",", row->value[i]);
    }
    for (uint32_t i = 0; i < fields->count; i++) {
        row_number_write(out, ",", row->field[fields->kind[i]]);
    }
    for (uint32_t bits = row->flags; bits != 0; bits &= bits - 1) {
        fprintf(out, "%s%s", before, lrcs_flag_text((int)(bits & ~(bits - 1))));
        before = " ";
    }
    fputs(row->flags ? "\n" : ",\n", out);
}

/* ---- JSON lines ---- */

static void jsonl_head_write(FILE *out, const lrcs_host_rows_head *head, const lrcs_host_plan *plan)
{
    char hash[17];
    lrcs_host_json json = lrcs_host_json_make(out);
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)head->scene_hash);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_text(&json, "lrcs", "sweep");
    lrcs_host_json_count(&json, "schema", LRCS_HOST_ROWS_SCHEMA);
    lrcs_host_json_text(&json, "version", lrcs_version());
    lrcs_host_json_text(&json, "scene_hash", hash);
    lrcs_host_json_count(&json, "rows", head->rows);
    lrcs_host_json_begin(&json, "shape", LRCS_HOST_ROW_ARRAY);
    for (uint32_t i = 0; i < head->dimensions; i++) {
        lrcs_host_json_count(&json, NULL, head->shape[i]);
    }
    lrcs_host_json_end(&json);
    lrcs_host_json_begin(&json, "columns", LRCS_HOST_ROW_ARRAY);
    for (uint32_t i = 0; i < plan->columns; i++) {
        lrcs_host_json_text(&json, NULL, plan->column[i]);
    }
    lrcs_host_json_end(&json);
    for (uint32_t i = 0; i < head->options; i++) {
        lrcs_host_json_text(&json, head->option[i].key, head->option[i].text);
    }
    lrcs_host_json_end(&json);
}

static void jsonl_row_write(FILE *out, const lrcs_host_row_fields *fields,
                            const lrcs_host_plan *plan, const lrcs_host_row *row)
{
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_count(&json, "index", row->index);
    for (uint32_t i = 0; i < plan->columns; i++) {
        lrcs_host_json_number(&json, plan->column[i], row->value[i]);
    }
    for (uint32_t i = 0; i < fields->count; i++) {
        int kind = fields->kind[i];
        lrcs_host_json_number(&json, lrcsi_row_field_text(kind), row->field[kind]);
    }
    lrcs_host_json_begin(&json, "flags", LRCS_HOST_ROW_ARRAY);
    for (uint32_t bits = row->flags; bits != 0; bits &= bits - 1) {
        lrcs_host_json_text(&json, NULL, lrcs_flag_text((int)(bits & ~(bits - 1))));
    }
    lrcs_host_json_end(&json);
    lrcs_host_json_end(&json);
}

/* ---- either ---- */

void lrcs_host_rows_head_write(FILE *out, int format, const lrcs_host_rows_head *head,
                               const lrcs_host_plan *plan)
{
    (format == LRCS_HOST_ROWS_JSONL ? jsonl_head_write : csv_head_write)(out, head, plan);
}

void lrcs_host_row_write(FILE *out, int format, const lrcs_host_row_fields *fields,
                         const lrcs_host_plan *plan, const lrcs_host_row *row)
{
    (format == LRCS_HOST_ROWS_JSONL ? jsonl_row_write : csv_row_write)(out, fields, plan, row);
}

void lrcs_host_rows_mean_write(FILE *out, int format, const lrcs_host_tally *tally)
{
    double mean = lrcs_host_tally_mean(tally);
    double bound = lrcs_host_tally_bound(tally);
    if (format == LRCS_HOST_ROWS_JSONL) {
        lrcs_host_json json = lrcs_host_json_make(out);
        lrcs_host_json_begin(&json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_number(&json, "mean_sigma_m2", mean);
        lrcs_host_json_number(&json, "standard_error_m2", lrcs_host_tally_error(tally));
        lrcs_host_json_number(&json, "mean_bound_m2", bound);
        lrcs_host_json_end(&json);
        return;
    }
    row_number_write(out, "# mean_sigma_m2=", mean);
    row_number_write(out, "; standard_error_m2=", lrcs_host_tally_error(tally));
    row_number_write(out, "; mean_bound_m2=", bound);
    putc('\n', out);
}

void lrcsi_rows_sum_text(int format, uint64_t sum, char text[LRCSI_ROWS_SUM_SIZE])
{
    snprintf(text, LRCSI_ROWS_SUM_SIZE,
             format == LRCS_HOST_ROWS_JSONL ? "{\"checksum\": \"fnv1a:%016llx\"}\n"
                                            : "# checksum=fnv1a:%016llx\n",
             (unsigned long long)sum);
}

void lrcs_host_rows_sum_write(FILE *out, int format, uint64_t sum)
{
    char text[LRCSI_ROWS_SUM_SIZE];
    lrcsi_rows_sum_text(format, sum, text);
    fputs(text, out);
}
