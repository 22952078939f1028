/* SPDX-License-Identifier: MIT */
/* The format of rows: CSV, with '#' before lines that are no rows, or JSON lines. This file decides
   their bytes, which depend only on the sweep and its results; file.c decides where they are
   written. The first line states everything that the rows depend on, and nothing that differs
   between machines, threads or shards: files that begin alike belong together. */
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
    static const uint32_t flag[TALLY_FLAGS] = {
        LRCS_FLAG_TOLERANCE_NOT_MET, LRCS_FLAG_MEMORY_FALLBACK, LRCS_FLAG_ACCEPTED_BY_ESTIMATE,
        LRCS_FLAG_ACCEPTED_UNJUDGED};
    double sigma = row->field[FIELD_SIGMA];
    double off = sigma - tally->mean;
    tally->rows++;
    tally->mean += off / (double)tally->rows; /* B. P. Welford, Technometrics 4 (1962) 419 */
    tally->square += off * (sigma - tally->mean);
    tally->bound += row->field[FIELD_BOUND];
    for (int k = 0; k < TALLY_FLAGS; k++) {
        tally->count[k] += (row->flags & flag[k]) != 0;
    }
    tally->count[TALLY_DOMINATED] += row->field[FIELD_DOMINATED] > 0.0;
}

double cli_tally_error(const sweep_tally *tally)
{
    double n = (double)tally->rows;
    return tally->rows > 1 ? sqrt(tally->square / (n - 1.0) / n) : (double)NAN;
}

/* ---- the first line ---- */

/* Adds an option; if it is repeated, its texts are joined. Returns 0 if there is no room. */
static int head_add(sweep_head *head, const char *key, const char *text)
{
    const size_t room = sizeof head->option[0].text;
    uint32_t at = 0;
    while (at < head->options && strcmp(head->option[at].key, key) != 0) {
        at++;
    }
    char *end = head->option[at].text + strlen(head->option[at].text);
    size_t left = room - (size_t)(end - head->option[at].text);
    int size = snprintf(end, left, "%s%s", at < head->options ? " and " : "", text);
    head->option[at].key = key;
    head->options += at == head->options;
    for (; *end; end++) {
        *end = CLI_PLAIN(*end);
    }
    return size >= 0 && (size_t)size < left;
}

/* Adds the options of these names as they were given. 0 or CLI_USAGE. */
static int head_given(const cli_args *args, const char *const *name, sweep_head *head)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        for (size_t k = 0; name[k]; k++) {
            if (strcmp(given->name, name[k]) == 0 &&
                !head_add(head, name[k], given->value ? given->value : "yes")) {
                return cli_usage(args->command, "--%s: too long", name[k]);
            }
        }
    }
    return 0;
}

/* Adds the options that rows depend on; the hash of the scene stands for all options of the
   scene. */
static int head_options(const cli_args *args, const sweep_plan *plan,
                        const lrcs_run_options *options, sweep_head *head)
{
    static const char *const varied[] = {"az",    "el",         "rotate",    "sphere",
                                         "joint", "vary",       "direction", "azel",
                                         "euler", "quaternion", NULL};
    char text[64];
    int code = head_given(args, varied, head);
    if (plan->kind == SWEEP_TRACK) {
        snprintf(text, sizeof text, "fnv1a:%016llx", (unsigned long long)plan->track.hash);
        head_add(head, "poses", text);
        if (plan->track.epoch[0]) {
            head_add(head, "time_from", plan->track.epoch);
        }
    }
    lrcs_host_number_text(options->tolerance, text);
    head_add(head, "tolerance", text);
    if (options->accept != LRCS_ACCEPT_BOUND) {
        head_add(head, "accept", lrcs_accept_text(options->accept));
    }
    head_add(head, "method", lrcs_method_text(options->method));
    snprintf(text, sizeof text, "%lu", (unsigned long)options->resolution);
    head_add(head, "resolution", options->resolution ? text : "auto");
    return code;
}

/* Adds the origin of the scene: its files with their hashes, by their last names, which do not
   depend on where the files are stored; and the command-line options that changed it. */
static int head_scene(const cli_args *args, const lrcs_host_scene *scene, sweep_head *head)
{
    static const char *const names[] = {"unit", "material", "two-sided", "keep-transparent", NULL};
    char text[CLI_FILE_TEXT];
    head_add(head, "normals", lrcs_normals_text(scene->scene.normals));
    head_add(head, "title", cli_base_name(cli_scene_title(args, scene)));
    if (cli_materials_open(&scene->scene)) {
        head_add(head, "materials", "illustrative or assumed");
    }
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        cli_file_text(input, text);
        if (!head_add(head, "files", text)) {
            break; /* the scene's hash stands for all of them */
        }
    }
    return head_given(args, names, head);
}

int cli_head_make(const cli_args *args, const sweep_plan *plan, const lrcs_run_options *options,
                  const lrcs_host_scene *scene, sweep_head *head)
{
    memset(head, 0, sizeof *head);
    head->scene_hash = lrcs_scene_hash(&scene->scene);
    head->rows = plan->rows;
    for (uint32_t i = 0; i < plan->axes; i++) {
        if (plan->axis[i].range.count > 1) {
            head->shape[head->dimensions++] = plan->axis[i].range.count;
        }
    }
    if (plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK || head->dimensions == 0) {
        head->shape[head->dimensions++] = plan->kind == SWEEP_FIXED ? 1 : plan->poses;
    }
    if (plan->fields.materials) { /* before all texts from users: readers search for it */
        lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
        char text[64];
        snprintf(text, sizeof text, "%lu draws seed %lu", (unsigned long)how.draws,
                 (unsigned long)how.seed);
        head_add(head, SWEEP_UNCERTAINTY, text);
    }
    if (plan->fields.glint) {
        head_add(head, SWEEP_COARSE_GLINT, "estimated");
    }
    int code = head_options(args, plan, options, head);
    return code ? code : head_scene(args, scene, head);
}

const char *cli_head_text(const sweep_head *head, const char *key)
{
    for (uint32_t i = 0; i < head->options; i++) {
        if (strcmp(head->option[i].key, key) == 0) {
            return head->option[i].text;
        }
    }
    return NULL;
}

void cli_head_put(FILE *out, const sweep_head *head)
{
    for (uint32_t i = 0; i < head->options; i++) {
        fprintf(out, "; %s=%s", head->option[i].key, head->option[i].text);
    }
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

static void csv_head(FILE *out, const sweep_head *head, const sweep_plan *plan)
{
    fprintf(out, "# lrcs %s sweep; scene_hash=%016llx; rows=%llu; shape=", lrcs_version(),
            (unsigned long long)head->scene_hash, (unsigned long long)head->rows);
    for (uint32_t i = 0; i < head->dimensions; i++) {
        fprintf(out, "%s%llu", i > 0 ? "x" : "", (unsigned long long)head->shape[i]);
    }
    cli_head_put(out, head);
    fputs("\nindex", out);
    for (uint32_t i = 0; i < plan->columns; i++) {
        cli_csv_text(out, ",", plan->column[i], ",\"");
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
    for (uint32_t bits = row->flags; bits != 0; bits &= bits - 1) {
        fprintf(out, "%s%s", before, lrcs_flag_text(CLI_LOWEST(bits)));
        before = " ";
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
    (format == SWEEP_JSONL ? jsonl_head : csv_head)(out, head, plan);
}

void cli_rows_put(FILE *out, int format, const sweep_plan *plan, const sweep_row *row)
{
    (format == SWEEP_JSONL ? jsonl_row : csv_row)(out, plan, row);
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
