/* SPDX-License-Identifier: MIT */
/* Reads back the CSV files of lrcs profile and lrcs converge, to draw them again. The first line
   says which command wrote a file and what it was made from; columns are found by their names. The
   charts are those of the commands. */
#include "cli/plot/table.h"

#include <lrcs/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/converge/converge.h"
#include "cli/profile/profile.h"

#define TABLE_TEXT 256

/* A file at work, and what is drawn of it. */
typedef struct table_job {
    const char *path;
    lrcs_host_file file;
    lrcs_host_table table;
    char title[TABLE_TEXT];
    char *about; /* the first line without "# " */
    profile_job profile;
    converge_job converge;
} table_job;

/* ---- the first line ---- */

/* Copies the text of a key in the first line, "; key=text"; 0 if there is no such key. A text ends
   where the next "; key=" begins. */
static int head_text(const lrcs_host_file *file, const char *key, char text[TABLE_TEXT])
{
    const char *at = (const char *)file->bytes;
    const char *end = memchr(at, '\n', file->size);
    size_t size = strlen(key);
    size_t used = 0;
    end = end ? end : at + file->size;
    while (
        (size_t)(end - at) > size + 2 &&
        !(at[0] == ';' && at[1] == ' ' && strncmp(at + 2, key, size) == 0 && at[2 + size] == '=')) {
        at++;
    }
    if ((size_t)(end - at) <= size + 2) {
        return 0;
    }
    for (at += size + 3; at < end && *at != '\r' && used + 1 < TABLE_TEXT; at++) {
        size_t word = 2;
        while (*at == ';' && at + word < end &&
               (at[word] == '_' || (at[word] >= 'a' && at[word] <= 'z') ||
                (at[word] >= '0' && at[word] <= '9'))) {
            word++;
        }
        if (*at == ';' && at[1] == ' ' && word > 2 && at + word < end && at[word] == '=') {
            break;
        }
        text[used++] = *at;
    }
    text[used] = '\0';
    return 1;
}

static double head_number(const lrcs_host_file *file, const char *key)
{
    char text[TABLE_TEXT];
    double value;
    return head_text(file, key, text) &&
                   lrcs_host_number_read(text, strlen(text), &value) == LRCS_OK
               ? value
               : (double)NAN;
}

/* Reads "direction=x,y,z"; 0 if it is not there. */
static int direction_read(const lrcs_host_file *file, double direction[3])
{
    char text[TABLE_TEXT];
    const char *at = text;
    if (!head_text(file, "direction", text)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        size_t size = strcspn(at, ",");
        if (lrcs_host_number_read(at, size, &direction[k]) != LRCS_OK) {
            return 0;
        }
        at += size + (at[size] == ',');
    }
    return 1;
}

int cli_table_kind(const char *path)
{
    static const struct {
        const char *word;
        int kind;
    } known[] = {{" profile", TABLE_PROFILE},
                 {" converge", TABLE_CONVERGE},
                 {" statistics", TABLE_STATISTICS}};
    lrcs_host_file file;
    lrcs_host_error error;
    int kind = TABLE_NONE;
    if (cli_extension(path, ".npy") || lrcs_host_file_read(path, &file, &error) != LRCS_OK) {
        return TABLE_NONE;
    }
    const char *at = (const char *)file.bytes;
    const char *words =
        file.size > 7 && memcmp(at, "# lrcs ", 7) == 0 ? memchr(at + 7, ' ', file.size - 7) : NULL;
    for (size_t i = 0; i < sizeof known / sizeof known[0] && words; i++) {
        size_t size = strlen(known[i].word);
        size_t left = file.size - (size_t)(words - at);
        if (left > size && memcmp(words, known[i].word, size) == 0 && words[size] == ';') {
            kind = known[i].kind;
        }
    }
    lrcs_host_file_free(&file);
    return kind;
}

/* ---- rows ---- */

/* Reads a field that may be empty, which is NAN. */
static int number_take(const table_job *job, uint32_t column, double *value, lrcs_host_error *error)
{
    *value = (double)NAN;
    return job->table.field[column].size == 0
               ? LRCS_OK
               : lrcs_host_field_read(&job->table, column, "a number", value, error);
}

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

static int profile_row_take(table_job *job, const uint32_t column[5], lrcs_host_error *error)
{
    profile_job *profile = &job->profile;
    double value[5] = {0.0}; /* near, far, glint, diffuse, pulse */
    profile_row *more = realloc(profile->row, (profile->rows + 1) * sizeof *more);
    if (!more) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return LRCS_E_SYSTEM;
    }
    profile->row = more;
    for (int i = 0; i < 5 && column[i] != LRCS_NONE; i++) {
        int status = lrcs_host_field_read(&job->table, column[i], "a number", &value[i], error);
        if (status != LRCS_OK) {
            return status;
        }
    }
    if (!(value[0] < value[1])) {
        return lrcs_host_field_refuse(&job->table, LRCS_E_NUMBER, column[1],
                                      "a range beyond near_m", error);
    }
    profile_row row = {.near_m = value[0], .far_m = value[1], .pulse_m = value[4]};
    row.bin.sigma_glint_m2 = value[2];
    row.bin.sigma_diffuse_m2 = value[3];
    profile->row[profile->rows++] = row;
    profile->bin_m = value[1] - value[0];
    return LRCS_OK;
}

static int profile_read(table_job *job, lrcs_host_error *error)
{
    static const char *const name[4] = {"near_m", "far_m", "sigma_glint_m2", "sigma_diffuse_m2"};
    char text[TABLE_TEXT];
    uint32_t column[5];
    profile_job *profile = &job->profile;
    int more;
    int status = columns_find(job, name, 4, column, error);
    column[4] = lrcs_host_table_column(&job->table, "pulse_m");
    profile->title = job->title;
    profile->open = head_text(&job->file, "materials", text);
    profile->profile.list.sigma_diffuse_m2 = head_number(&job->file, "sigma_m2");
    profile->fwhm_m = column[4] != LRCS_NONE ? head_number(&job->file, "pulse_fwhm_m") : 0.0;
    while (status == LRCS_OK && (more = lrcs_host_table_read(&job->table, error)) != 0) {
        status = more < 0 ? more : profile_row_take(job, column, error);
    }
    return status;
}

/* The digit k of "1e-k" in a text, 0 if there is none. */
static int digits_of(const char *text)
{
    const char *at = strstr(text, "1e-");
    return at && at[3] >= '1' && at[3] <= '9' ? at[3] - '0' : 0;
}

static int converge_row_take(table_job *job, const uint32_t column[8], lrcs_host_error *error)
{
    converge_job *converge = &job->converge;
    const lrcs_host_field *field = job->table.field;
    converge_setting *one = &converge->setting[converge->settings];
    char method[48];
    double value[6];
    if (converge->settings == CONVERGE_SETTINGS) {
        snprintf(error->text, sizeof error->text, "%s: more than %d settings", job->path,
                 CONVERGE_SETTINGS);
        return LRCS_E_LIMIT;
    }
    snprintf(one->name, sizeof one->name, "%.*s", (int)field[column[0]].size,
             field[column[0]].text);
    snprintf(method, sizeof method, "%.*s", (int)field[column[1]].size, field[column[1]].text);
    one->method = strcmp(method, lrcs_method_text(LRCS_METHOD_CLOSED)) == 0
                      ? LRCS_METHOD_CLOSED
                      : lrcs_method_find(method);
    for (int i = 0; i < 6; i++) {
        int status = number_take(job, column[i + 2], &value[i], error);
        if (status != LRCS_OK) {
            return status;
        }
    }
    if (one->method < 0 || !(value[1] >= 0.0)) {
        return lrcs_host_field_refuse(&job->table, LRCS_E_SYNTAX, column[one->method < 0 ? 1 : 3],
                                      "what lrcs converge writes", error);
    }
    int mesh = strstr(one->name, " on mesh ") != NULL;
    one->digits = digits_of(one->name);
    one->dial = strncmp(one->name, "by estimate", 11) == 0 ? CONVERGE_PREVIEW
                : mesh                                     ? CONVERGE_MESH
                : one->method == LRCS_METHOD_ZBUFFER       ? CONVERGE_ZBUFFER
                : one->method == LRCS_METHOD_FACET         ? CONVERGE_FACET
                : one->method == LRCS_METHOD_EXACT         ? CONVERGE_EXACT
                                                           : CONVERGE_CLOSED;
    one->mesh = mesh ? (uint32_t)one->digits % CONVERGE_MESHES : 0;
    converge->mesh[one->mesh].digits = mesh ? one->digits : converge->mesh[one->mesh].digits;
    one->resolution = value[0] > 0.0 ? (uint32_t)value[0] : 0;
    one->pose_s = 1e-3 * value[1];
    one->sigma_m2 = value[2];
    one->error_m2 = value[3] >= 0.0 ? value[3] : -1.0;
    one->bound_m2 = value[4] >= 0.0 ? value[4] : -1.0;
    one->estimate_m2 = value[5] >= 0.0 ? value[5] : -1.0;
    converge->settings++;
    return LRCS_OK;
}

static int converge_read(table_job *job, lrcs_host_error *error)
{
    static const char *const name[8] = {"setting",  "method",   "resolution", "pose_ms",
                                        "sigma_m2", "error_m2", "bound_m2",   "estimate_m2"};
    char text[TABLE_TEXT] = "";
    uint32_t column[8];
    converge_job *converge = &job->converge;
    int more;
    int status = columns_find(job, name, 8, column, error);
    converge->title = job->title;
    converge->truth.sigma_m2 = head_number(&job->file, "truth_m2");
    converge->truth.bound_m2 = head_number(&job->file, "truth_bound_m2");
    head_text(&job->file, "truth", text);
    snprintf(converge->truth.text, sizeof converge->truth.text, "%.90s", text);
    converge->truth.whole = head_text(&job->file, "truth_of", text) && strcmp(text, "shapes") == 0;
    int known = direction_read(&job->file, converge->pose.direction);
    if (status == LRCS_OK && !(known && converge->truth.sigma_m2 >= 0.0)) {
        snprintf(error->text, sizeof error->text,
                 "%s: its first line is not that of lrcs converge: no truth", job->path);
        status = LRCS_E_SYNTAX;
    }
    while (status == LRCS_OK && (more = lrcs_host_table_read(&job->table, error)) != 0) {
        status = more < 0 ? more : converge_row_take(job, column, error);
    }
    return status;
}

/* ---- the drawing ---- */

static void about_write(FILE *out, const void *context)
{
    const table_job *job = context;
    const char *at = (const char *)job->file.bytes;
    const char *end = memchr(at, '\n', job->file.size);
    size_t size = end ? (size_t)(end - at) : job->file.size;
    if (size > 2) {
        fwrite(at + 2, 1, size - 2 - (at[size - 1] == '\r'), out);
    }
}

static int drawing_write(FILE *out, const table_job *job, int png, lrcs_host_error *error)
{
    return job->profile.rows > 0 ? cli_profile_chart(&job->profile, png, out, error)
                                 : cli_converge_chart(&job->converge, png, out, error);
}

static int svg_write(FILE *out, const void *context, lrcs_host_error *error)
{
    return drawing_write(out, context, 0, error);
}

static int png_write(FILE *out, const void *context, lrcs_host_error *error)
{
    return drawing_write(out, context, 1, error);
}

/* Reads the whole table, from the names of its columns. */
static int job_read(table_job *job, int kind, lrcs_host_error *error)
{
    int status = lrcs_host_file_read(job->path, &job->file, error);
    if (status != LRCS_OK) {
        return status;
    }
    job->table = lrcs_host_table_make(job->path, &job->file);
    if (!head_text(&job->file, "title", job->title)) {
        snprintf(job->title, sizeof job->title, "%.200s", cli_base_name(job->path));
    }
    int named = lrcs_host_table_read(&job->table, error);
    if (named < 0) {
        return named;
    }
    lrcs_host_table_names(&job->table);
    status = kind == TABLE_PROFILE ? profile_read(job, error) : converge_read(job, error);
    if (status == LRCS_OK && job->profile.rows == 0 && job->converge.settings == 0) {
        snprintf(error->text, sizeof error->text, "%s: has no rows: nothing to draw", job->path);
        return LRCS_E_SYNTAX;
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
    int code = job_read(job, kind, &error) == LRCS_OK ? 0 : cli_failed(&error);
    job->about = code == 0 ? cli_text_of(about_write, job) : NULL;
    job->profile.about = job->converge.about = job->about;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const char *out = args->given[i].value;
        if (strcmp(args->given[i].name, "o") == 0) {
            code = cli_output_write(out, cli_extension(out, ".png") ? png_write : svg_write, job);
        }
    }
    free(job->about);
    free(job->profile.row);
    lrcs_host_file_free(&job->file);
    free(job);
    return code;
}
