/* SPDX-License-Identifier: MIT */
/* The format of rows: CSV, with '#' before lines that are no rows, or JSON lines. This file decides
   their bytes, which depend only on the sweep and its results; file.c decides where they are
   written. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <string.h>

const char *const cli_field_name[SWEEP_FIELDS] = {"sigma_m2",           "sigma_dbsm",
                                                  "bound_m2",           "sigma_glint_m2",
                                                  "sigma_diffuse_m2",   "material_deviation_m2",
                                                  "material_low_m2",    "material_high_m2",
                                                  "material_sampled",   "glint_error_estimate_m2",
                                                  "one_facet_dominates"};

sweep_fields cli_fields_make(int materials, int glint)
{
    sweep_fields fields = {.materials = materials, .glint = glint};
    for (int kind = 0; kind < SWEEP_FIELDS; kind++) {
        if (kind < FIELD_DEVIATION || (kind < FIELD_GLINT_ERROR ? materials : glint)) {
            fields.kind[fields.count++] = kind;
        }
    }
    return fields;
}

void cli_tally_add(sweep_tally *tally, const sweep_row *row)
{
    double sigma = row->field[FIELD_SIGMA];
    double off = sigma - tally->mean;
    tally->rows++;
    tally->mean += off / (double)tally->rows; /* B. P. Welford, Technometrics 4 (1962) 419 */
    tally->square += off * (sigma - tally->mean);
    tally->bound += row->field[FIELD_BOUND];
    tally->missed += (row->flags & LRCS_FLAG_TOLERANCE_NOT_MET) != 0;
    tally->estimated += (row->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE) != 0;
    tally->unjudged += (row->flags & LRCS_FLAG_ACCEPTED_UNJUDGED) != 0;
    tally->dominated += row->field[FIELD_DOMINATED] > 0.0;
    tally->starved += (row->flags & LRCS_FLAG_MEMORY_FALLBACK) != 0;
}

double cli_tally_error(const sweep_tally *tally)
{
    double n = (double)tally->rows;
    return tally->rows > 1 ? sqrt(tally->square / (n - 1.0) / n) : (double)NAN;
}

/* A number that is not finite is left out. */
static void number_put(FILE *out, const char *before, double value)
{
    if (isfinite(value)) {
        cli_number_put(out, before, value);
    } else {
        fputs(before, out);
    }
}

/* ---- CSV ---- */

static void csv_field(FILE *out, const char *text)
{
    int quoted = strpbrk(text, ",\"") != NULL;
    if (quoted) {
        putc('"', out);
    }
    for (; *text; text++) {
        if (*text == '"') {
            putc('"', out);
        }
        putc(*text, out);
    }
    if (quoted) {
        putc('"', out);
    }
}

static void csv_head(FILE *out, const sweep_head *head, const sweep_plan *plan)
{
    fprintf(out, "# lrcs %s sweep; scene_hash=%016llx; rows=%llu; shape=", lrcs_version(),
            (unsigned long long)head->scene_hash, (unsigned long long)head->rows);
    for (uint32_t i = 0; i < head->dimensions; i++) {
        fprintf(out, "%s%llu", i > 0 ? "x" : "", (unsigned long long)head->shape[i]);
    }
    for (uint32_t i = 0; i < head->options; i++) {
        fprintf(out, "; %s=%s", head->option[i].key, head->option[i].text);
    }
    fputs("\nindex", out);
    for (uint32_t i = 0; i < plan->columns; i++) {
        putc(',', out);
        csv_field(out, plan->column[i]);
    }
    for (uint32_t i = 0; i < plan->fields.count; i++) {
        fprintf(out, ",%s", cli_field_name[plan->fields.kind[i]]);
    }
    fputs(",flags\n", out);
}

static void csv_row(FILE *out, const sweep_plan *plan, const sweep_row *row)
{
    const char *before = ",";
    fprintf(out, "%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < plan->columns; i++) {
        number_put(out, ",", row->value[i]);
    }
    for (uint32_t i = 0; i < plan->fields.count; i++) {
        number_put(out, ",", row->field[plan->fields.kind[i]]);
    }
    for (uint32_t bits = row->flags, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            fprintf(out, "%s%s", before, lrcs_flag_text((int)bit));
            before = " ";
        }
    }
    fputs(row->flags ? "\n" : ",\n", out);
}

/* ---- JSON lines ---- */

static void jsonl_head(FILE *out, const sweep_head *head, const sweep_plan *plan)
{
    lrcs_host_json json = lrcs_host_json_make(out);
    cli_json(&json, "{lrcs=%s", "sweep");
    cli_version_json(&json);
    cli_hash_json(head->scene_hash, &json);
    cli_json(&json, "rows=%llu shape=[", (unsigned long long)head->rows);
    for (uint32_t i = 0; i < head->dimensions; i++) {
        lrcs_host_json_count(&json, NULL, head->shape[i]);
    }
    cli_json(&json, "] columns=[");
    for (uint32_t i = 0; i < plan->columns; i++) {
        lrcs_host_json_text(&json, NULL, plan->column[i]);
    }
    cli_json(&json, "]");
    for (uint32_t i = 0; i < head->options; i++) {
        lrcs_host_json_text(&json, head->option[i].key, head->option[i].text);
    }
    cli_json(&json, "}");
}

static void jsonl_row(FILE *out, const sweep_plan *plan, const sweep_row *row)
{
    lrcs_host_json json = lrcs_host_json_make(out);
    cli_json(&json, "{index=%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < plan->columns; i++) {
        lrcs_host_json_number(&json, plan->column[i], row->value[i]);
    }
    for (uint32_t i = 0; i < plan->fields.count; i++) {
        int kind = plan->fields.kind[i];
        lrcs_host_json_number(&json, cli_field_name[kind], row->field[kind]);
    }
    cli_flags_json(&json, row->flags);
    cli_json(&json, "}");
}

/* ---- either ---- */

void cli_rows_head(FILE *out, int format, const sweep_head *head, const sweep_plan *plan)
{
    if (format == SWEEP_JSONL) {
        jsonl_head(out, head, plan);
    } else {
        csv_head(out, head, plan);
    }
}

void cli_rows_put(FILE *out, int format, const sweep_plan *plan, const sweep_row *row)
{
    if (format == SWEEP_JSONL) {
        jsonl_row(out, plan, row);
    } else {
        csv_row(out, plan, row);
    }
}

void cli_rows_mean(FILE *out, int format, const sweep_tally *tally)
{
    double bound = tally->bound / (double)tally->rows;
    if (format == SWEEP_JSONL) {
        lrcs_host_json json = lrcs_host_json_make(out);
        cli_json(&json, "{mean_sigma_m2=%g standard_error_m2=%g mean_bound_m2=%g}", tally->mean,
                 cli_tally_error(tally), bound);
        return;
    }
    number_put(out, "# mean_sigma_m2=", tally->mean);
    number_put(out, "; standard_error_m2=", cli_tally_error(tally));
    number_put(out, "; mean_bound_m2=", bound);
    putc('\n', out);
}

void cli_rows_sum(FILE *out, int format, uint64_t sum)
{
    fprintf(out,
            format == SWEEP_JSONL ? "{\"checksum\": \"fnv1a:%016llx\"}\n"
                                  : "# checksum=fnv1a:%016llx\n",
            (unsigned long long)sum);
}
