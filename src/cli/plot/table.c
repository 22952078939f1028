/* SPDX-License-Identifier: MIT */
/* Reads back the CSV files of lrcs profile, to draw them again. The first line says what wrote a
   file and what it was made from; columns are found by their names. The chart is that of the
   command. */
#include "cli/plot/table.h"

#include <lrcs/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

int cli_table_kind(const char *path)
{
    static const struct {
        const char *word;
        int kind;
    } known[] = {{" profile", TABLE_PROFILE}, {" statistics", TABLE_STATISTICS}};
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

static int svg_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const table_job *job = context;
    return cli_profile_chart(&job->profile, 0, out, error);
}

static int png_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const table_job *job = context;
    return cli_profile_chart(&job->profile, 1, out, error);
}

/* Reads the whole table, from the names of its columns. */
static int job_read(table_job *job, lrcs_host_error *error)
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
    status = profile_read(job, error);
    if (status == LRCS_OK && job->profile.rows == 0) {
        snprintf(error->text, sizeof error->text, "%s: has no rows: nothing to draw", job->path);
        return LRCS_E_SYNTAX;
    }
    return status;
}

int cli_table_draw(const cli_args *args, const char *path)
{
    lrcs_host_error error;
    table_job *job = calloc(1, sizeof *job);
    if (!job) {
        return cli_out_of_memory();
    }
    job->path = path;
    int code = job_read(job, &error) == LRCS_OK ? 0 : cli_failed(&error);
    job->about = code == 0 ? cli_text_of(about_write, job) : NULL;
    job->profile.about = job->about;
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
