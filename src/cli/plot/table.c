/* SPDX-License-Identifier: MIT */
/* Reads back the CSV files of lrcs profile and lrcs converge, to draw them again. A line says what
   wrote a file and what it was made from: the first line of a profile, a key in the FILE.csv.json
   of a comparison. Columns are found by their names. The chart is that of the command. */
#include "cli/plot/table.h"

#include <lrcs/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/converge/converge.h"
#include "cli/profile/profile.h"

#define TABLE_TEXT 256 /* bytes of a title or a message */

/* A file at work, and what is drawn of it. */
typedef struct table_job {
    const char *path;
    int kind;
    lrcs_host_file file;
    lrcs_host_table table;
    char *text;  /* a copy of the text that `about` is in, with a NUL at its end */
    char *about; /* "lrcs VERSION COMMAND; key=text; .." */
    char title[TABLE_TEXT];
    profile_job profile;
    converge_job converge;
} table_job;

/* ---- what a file is ---- */

int cli_table_kind(const char *path)
{
    char line[80]; /* the beginning of the first line */
    char command[16] = "";
    struct stat about;
    FILE *file = stat(path, &about) == 0 && S_ISREG(about.st_mode) ? fopen(path, "rb") : NULL;
    if (!file) {
        return TABLE_NONE;
    }
    if (!fgets(line, sizeof line, file)) {
        line[0] = '\0';
    }
    fclose(file);
    if (strncmp(line, "setting,method,", 15) == 0) {
        return TABLE_CONVERGE;
    }
    sscanf(line, "# lrcs %*s %15[a-z];", command);
    return strcmp(command, "profile") == 0      ? TABLE_PROFILE
           : strcmp(command, "statistics") == 0 ? TABLE_STATISTICS
                                                : TABLE_NONE;
}

static int table_refuse(const table_job *job, const char *what, lrcs_host_error *error)
{
    snprintf(error->text, sizeof error->text, "%s: %s", job->path, what);
    return LRCS_E_SYNTAX;
}

/* The text of the key CLI_ABOUT in FILE.csv.json, which must state the hash of this table. */
static int about_of_json(table_job *job, lrcs_host_error *error)
{
    static const char key[] = "\"" CLI_ABOUT "\": \"";
    char hash[48];
    lrcs_host_file json;
    char *name = cli_beside_name(job->path);
    if (!name) {
        return table_refuse(job, "out of memory", error);
    }
    int status = lrcs_host_file_read(name, &json, error);
    free(name);
    if (status != LRCS_OK) {
        return table_refuse(job,
                            "expected its FILE" CLI_BESIDE ", which lrcs converge writes beside "
                            "it and which states the truth",
                            error);
    }
    job->text = strndup((const char *)json.bytes, json.size);
    lrcs_host_file_free(&json);
    if (!job->text) {
        return table_refuse(job, "out of memory", error);
    }
    snprintf(
        hash, sizeof hash, "\"hash\": \"fnv1a:%016llx\"",
        (unsigned long long)lrcs_host_hash(LRCS_HOST_HASH_START, job->file.bytes, job->file.size));
    char *at = strstr(job->text, key);
    if (!at || !strstr(job->text, hash)) {
        return table_refuse(job, "is not the table that its FILE" CLI_BESIDE " describes", error);
    }
    job->about = at + strlen(key);
    lrcs_host_json_unquote(job->about);
    return LRCS_OK;
}

/* ---- rows ---- */

/* Finds columns by name. */
static int columns_find(const table_job *job, const char *const *name, uint32_t count,
                        uint32_t *column, lrcs_host_error *error)
{
    for (uint32_t i = 0; i < count; i++) {
        column[i] = lrcs_host_table_column(&job->table, name[i]);
        if (column[i] == LRCS_NONE) {
            snprintf(error->text, sizeof error->text, "%s: has no column '%s'", job->path, name[i]);
            return LRCS_E_SYNTAX;
        }
    }
    return LRCS_OK;
}

static int profile_read(table_job *job, lrcs_host_error *error)
{
    static const char *const name[4] = {"near_m", "far_m", "sigma_glint_m2", "sigma_diffuse_m2"};
    char text[TABLE_TEXT];
    uint32_t column[5];
    profile_job *profile = &job->profile;
    int status = columns_find(job, name, 4, column, error);
    column[4] = lrcs_host_table_column(&job->table, "pulse_m");
    profile->title = job->title;
    profile->about = job->about;
    profile->materials_assumed = lrcs_host_key_text(job->about, "materials", text, sizeof text);
    profile->profile.list.sigma_diffuse_m2 = lrcs_host_key_number(job->about, "sigma_m2");
    profile->fwhm_m =
        column[4] != LRCS_NONE ? lrcs_host_key_number(job->about, "pulse_fwhm_m") : 0.0;
    int more = status == LRCS_OK ? lrcs_host_table_read(&job->table, error) : status;
    for (; more > 0; more = lrcs_host_table_read(&job->table, error)) {
        double value[5] = {0.0}; /* near, far, glint, diffuse, pulse */
        profile_row *grown = realloc(profile->row, (profile->rows + 1) * sizeof *grown);
        if (!grown) {
            return table_refuse(job, "out of memory", error);
        }
        profile->row = grown;
        for (int i = 0; i < 5 && column[i] != LRCS_NONE && status == LRCS_OK; i++) {
            status = lrcs_host_field_read(&job->table, column[i], "a number", &value[i], error);
        }
        if (status == LRCS_OK && !(value[0] < value[1])) {
            status = lrcs_host_field_refuse(&job->table, LRCS_E_NUMBER, column[1],
                                            "a range beyond near_m", error);
        }
        if (status != LRCS_OK) {
            return status;
        }
        profile_row row = {.near_m = value[0], .far_m = value[1], .pulse_m = value[4]};
        row.bin.sigma_glint_m2 = value[2];
        row.bin.sigma_diffuse_m2 = value[3];
        profile->row[profile->rows++] = row;
        profile->bin_m = value[1] - value[0];
    }
    return more;
}

/* The columns of a comparison that the chart needs. */
enum {
    ROW_SETTING,
    ROW_METHOD,
    ROW_RESOLUTION,
    ROW_TIME,
    ROW_ERROR,
    ROW_BOUND,
    ROW_ESTIMATE,
    ROWS
};

/* The kind of a setting, and its digits, from its name as lrcs/convergence.h gives it. The method
   of a preview is that which auto chose. */
static int setting_name_read(table_job *job, const uint32_t column[ROWS],
                             lrcs_host_convergence_setting *setting, lrcs_host_error *error)
{
    static const int kind[] = {[LRCS_METHOD_ZBUFFER] = LRCS_HOST_CONVERGENCE_KIND_ZBUFFER,
                               [LRCS_METHOD_FACET] = LRCS_HOST_CONVERGENCE_KIND_FACET,
                               [LRCS_METHOD_EXACT] = LRCS_HOST_CONVERGENCE_KIND_EXACT,
                               [LRCS_METHOD_CLOSED] = LRCS_HOST_CONVERGENCE_KIND_CLOSED};
    const lrcs_host_field *name = &job->table.field[column[ROW_SETTING]];
    const lrcs_host_field *method = &job->table.field[column[ROW_METHOD]];
    snprintf(setting->name, sizeof setting->name, "%.*s", (int)name->size, name->text);
    const char *digits = strstr(setting->name, " 1e-");
    setting->method = -1;
    for (int i = 0; i < (int)(sizeof kind / sizeof kind[0]); i++) {
        if (i != LRCS_METHOD_AUTO && lrcs_host_field_is(method, lrcs_method_text(i))) {
            setting->method = i;
            setting->kind = kind[i];
        }
    }
    if (setting->method < 0) {
        return lrcs_host_field_refuse(&job->table, LRCS_E_SYNTAX, column[ROW_METHOD], "a method",
                                      error);
    }
    if (digits && strncmp(setting->name, LRCS_HOST_PREVIEW_NAME_TEXT,
                          strlen(LRCS_HOST_PREVIEW_NAME_TEXT)) == 0) {
        setting->kind = LRCS_HOST_CONVERGENCE_KIND_PREVIEW;
        setting->digits = (int)strtol(digits + 4, NULL, 10);
    } else if (digits) {
        long mesh = strtol(digits + 4, NULL, 10);
        if (mesh < 1 || mesh > LRCS_HOST_CONVERGENCE_MESHES) {
            return lrcs_host_field_refuse(&job->table, LRCS_E_SYNTAX, column[ROW_SETTING],
                                          "a mesh of 1e-1 .. 1e-6", error);
        }
        setting->kind = LRCS_HOST_CONVERGENCE_KIND_MESH;
        setting->mesh = (uint32_t)mesh - 1;
        job->converge.all.mesh[mesh - 1].digits = (int)mesh;
    }
    return LRCS_OK;
}

static int converge_row_take(table_job *job, const uint32_t column[ROWS], lrcs_host_error *error)
{
    lrcs_host_convergence *converge = &job->converge.all;
    lrcs_host_convergence_setting *setting = &converge->setting[converge->settings];
    double value[ROWS];
    if (converge->settings == LRCS_HOST_CONVERGENCE_SETTINGS) {
        return table_refuse(job, "has too many rows for lrcs converge", error);
    }
    int status = setting_name_read(job, column, setting, error);
    for (int i = ROW_RESOLUTION; i < ROWS && status == LRCS_OK; i++) {
        int known = i == ROW_TIME || i == ROW_ERROR || job->table.field[column[i]].size > 0;
        value[i] = i == ROW_RESOLUTION ? 0.0 : -1.0;
        status = known ? lrcs_host_field_read(&job->table, column[i], "a number", &value[i], error)
                       : LRCS_OK;
        if (status == LRCS_OK && known && !(value[i] >= 0.0 && value[i] < 1e300)) {
            status = lrcs_host_field_refuse(&job->table, LRCS_E_NUMBER, column[i], "a number >= 0",
                                            error);
        }
    }
    if (status == LRCS_OK) {
        setting->resolution = (uint32_t)value[ROW_RESOLUTION];
        setting->pose_s = 1e-3 * value[ROW_TIME];
        setting->error_m2 = value[ROW_ERROR];
        setting->bound_m2 = value[ROW_BOUND];
        setting->estimate_m2 = value[ROW_ESTIMATE];
        converge->settings++;
    }
    return status;
}

static int converge_read(table_job *job, lrcs_host_error *error)
{
    static const char *const name[ROWS] = {"setting",  "method",   "resolution", "pose_ms",
                                           "error_m2", "bound_m2", "estimate_m2"};
    char text[TABLE_TEXT];
    uint32_t column[ROWS];
    lrcs_host_convergence *converge = &job->converge.all;
    lrcs_host_convergence_truth *truth = &converge->truth;
    int more;
    int status = columns_find(job, name, ROWS, column, error);
    job->converge.title = job->title;
    job->converge.about = job->about;
    truth->sigma_m2 = lrcs_host_key_number(job->about, "truth_m2");
    truth->bound_m2 = lrcs_host_key_number(job->about, "truth_bound_m2");
    truth->true_shapes = lrcs_host_key_text(job->about, "truth_of", text, sizeof text) &&
                         strcmp(text, "shapes") == 0;
    lrcs_host_key_text(job->about, "truth", truth->text, sizeof truth->text);
    converge->pose = lrcs_pose_default();
    if (status == LRCS_OK &&
        (!(truth->sigma_m2 >= 0.0) || !(truth->bound_m2 >= 0.0) ||
         !lrcs_host_key_text(job->about, "direction", text, sizeof text) ||
         lrcs_host_numbers_read(text, converge->pose.direction, 3) != LRCS_OK)) {
        status = table_refuse(job, "its " CLI_BESIDE " file states no truth or direction", error);
    }
    while (status == LRCS_OK && (more = lrcs_host_table_read(&job->table, error)) != 0) {
        status = more < 0 ? more : converge_row_take(job, column, error);
    }
    return status;
}

/* ---- the drawing ---- */

static int table_chart(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const table_job *job = context;
    return job->kind == TABLE_CONVERGE ? cli_converge_chart(out, &job->converge, png, error)
                                       : cli_profile_chart(out, &job->profile, png, error);
}

/* Reads the whole table, from the names of its columns. */
static int table_file_read(table_job *job, lrcs_host_error *error)
{
    int status = lrcs_host_file_read(job->path, &job->file, error);
    if (status != LRCS_OK) {
        return status;
    }
    if (job->kind == TABLE_CONVERGE) {
        status = about_of_json(job, error);
    } else { /* the first line without "# " */
        job->text = strndup((const char *)job->file.bytes, job->file.size);
        status = job->text ? LRCS_OK : table_refuse(job, "out of memory", error);
    }
    if (status != LRCS_OK) {
        return status;
    }
    if (job->kind != TABLE_CONVERGE) {
        job->text[strcspn(job->text, "\r\n")] = '\0';
        job->about = job->text + 2;
    }
    job->table = lrcs_host_table_make(job->path, &job->file);
    if (!lrcs_host_key_text(job->about, "title", job->title, sizeof job->title)) {
        snprintf(job->title, sizeof job->title, "%.200s", cli_base_name(job->path));
    }
    int named = lrcs_host_table_read(&job->table, error);
    if (named < 0) {
        return named;
    }
    lrcs_host_table_names(&job->table);
    status = job->kind == TABLE_CONVERGE ? converge_read(job, error) : profile_read(job, error);
    if (status == LRCS_OK && job->profile.rows + job->converge.all.settings == 0) {
        return table_refuse(job, "has no rows: nothing to draw", error);
    }
    return status;
}

int cli_table_draw(const cli_args *args, const char *path, int kind)
{
    lrcs_host_error error;
    table_job *job = calloc(1, sizeof *job);
    if (!job) {
        return cli_out_of_memory();
    }
    job->path = path;
    job->kind = kind;
    int code = table_file_read(job, &error) == LRCS_OK ? 0 : cli_failed(&error);
    code = code ? code : cli_charts_write(args, "o", table_chart, job);
    if (code == CLI_DONE) {
        cli_outputs_print(args, NULL);
    }
    free(job->text);
    free(job->profile.row);
    lrcs_host_file_free(&job->file);
    free(job);
    return code;
}
