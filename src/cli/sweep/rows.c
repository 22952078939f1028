/* SPDX-License-Identifier: MIT */
/* The format of rows: CSV, with '#' before lines that are no rows, or JSON lines. This file decides
   their bytes, which depend only on the sweep and its results; file.c decides where they are
   written. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <string.h>

const char *const cli_extra_name[SWEEP_EXTRAS] = {"material_deviation_m2",   "material_low_m2",
                                                  "material_high_m2",        "material_sampled",
                                                  "glint_error_estimate_m2", "one_facet_dominates"};

const char *const cli_row_field[SWEEP_FIELDS] = {"sigma_m2",       "sigma_dbsm",       "bound_m2",
                                                 "sigma_glint_m2", "sigma_diffuse_m2", "flags"};

/* The numbers of a row up to its extras; sigma = 0 has no dBsm. */
static void row_numbers(const sweep_row *row, double number[FIELD_FLAGS])
{
    number[FIELD_SIGMA] = row->sigma_m2;
    number[FIELD_DBSM] = row->sigma_m2 > 0.0 ? cli_dbsm(row->sigma_m2) : (double)NAN;
    number[FIELD_BOUND] = row->bound_m2;
    number[FIELD_GLINT] = row->sigma_glint_m2;
    number[FIELD_DIFFUSE] = row->sigma_diffuse_m2;
}

sweep_extras cli_extras_make(int materials, int glint)
{
    sweep_extras extras = {.materials = materials, .glint = glint};
    for (int kind = 0; kind < SWEEP_EXTRAS; kind++) {
        if (kind < EXTRA_GLINT_ERROR ? materials : glint) {
            extras.kind[extras.count++] = kind;
        }
    }
    return extras;
}

void cli_tally_add(sweep_tally *tally, const sweep_row *row)
{
    double off = row->sigma_m2 - tally->mean;
    tally->rows++;
    tally->mean += off / (double)tally->rows; /* B. P. Welford, Technometrics 4 (1962) 419 */
    tally->square += off * (row->sigma_m2 - tally->mean);
    tally->bound += row->bound_m2;
    tally->missed += (row->flags & LRCS_FLAG_TOLERANCE_NOT_MET) != 0;
    tally->estimated += (row->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE) != 0;
    tally->unjudged += (row->flags & LRCS_FLAG_ACCEPTED_UNJUDGED) != 0;
    tally->dominated += row->extra[EXTRA_DOMINATED] > 0.0;
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
    for (int i = 0; i < FIELD_FLAGS; i++) {
        fprintf(out, ",%s", cli_row_field[i]);
    }
    for (uint32_t i = 0; i < plan->extras.count; i++) {
        fprintf(out, ",%s", cli_extra_name[plan->extras.kind[i]]);
    }
    fputs(",flags\n", out);
}

static void csv_row(FILE *out, const sweep_plan *plan, const sweep_row *row)
{
    const char *before = ",";
    double number[FIELD_FLAGS];
    row_numbers(row, number);
    fprintf(out, "%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < plan->columns; i++) {
        number_put(out, ",", row->value[i]);
    }
    for (int i = 0; i < FIELD_FLAGS; i++) {
        number_put(out, ",", number[i]);
    }
    for (uint32_t i = 0; i < plan->extras.count; i++) {
        number_put(out, ",", row->extra[plan->extras.kind[i]]);
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
    double number[FIELD_FLAGS];
    row_numbers(row, number);
    lrcs_host_json json = lrcs_host_json_make(out);
    cli_json(&json, "{index=%llu", (unsigned long long)row->index);
    for (uint32_t i = 0; i < plan->columns; i++) {
        lrcs_host_json_number(&json, plan->column[i], row->value[i]);
    }
    for (int i = 0; i < FIELD_FLAGS; i++) {
        lrcs_host_json_number(&json, cli_row_field[i], number[i]);
    }
    for (uint32_t i = 0; i < plan->extras.count; i++) {
        int kind = plan->extras.kind[i];
        lrcs_host_json_number(&json, cli_extra_name[kind], row->extra[kind]);
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
