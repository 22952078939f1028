/* SPDX-License-Identifier: MIT */
/* Where the rows of a sweep go. It decides what is on disk at every moment: rows in FILE.partial,
   each complete before the next, and FILE itself only when it is whole; and what --resume makes of
   what it finds. */
#include "cli/sweep.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FILE_PERIOD 0.2 /* s: no more than this is lost with the process */

static int file_refuse(const char *path, const char *what)
{
    fprintf(stderr, "lrcs: %s: cannot %s: %s\n", path, what, strerror(errno));
    return CLI_FAILED;
}

/* ---- options ---- */

int cli_file_read(const cli_args *args, sweep_file *file)
{
    static const char *const extension[] = {".csv", ".jsonl", ".npy"};
    const char *path = cli_value(args, "o");
    int lines = cli_value(args, "json") != NULL;
    memset(file, 0, sizeof *file);
    file->format = lines ? SWEEP_JSONL : SWEEP_CSV;
    if (!path || strcmp(path, "-") == 0) {
        return cli_value(args, "resume")
                   ? cli_usage(args->command, "--resume needs -o FILE: it goes on with that file")
                   : 0;
    }
    if (lines) {
        return cli_usage(args->command, "--json is for standard output; -o FILE.jsonl writes it");
    }
    int found = -1;
    for (int i = 0; i < 3; i++) {
        found = cli_extension(path, extension[i]) ? i : found;
    }
    if (found < 0) {
        return cli_usage(args->command, "-o: expected FILE.csv, FILE.jsonl or FILE.npy, found '%s'",
                         path);
    }
    file->npy = found == SWEEP_NPY;
    file->format = found == SWEEP_JSONL ? SWEEP_JSONL : SWEEP_CSV;
    char *real = realpath(path, NULL); /* a link stays one */
    size_t room = strlen(real ? real : path) + sizeof ".partial";
    file->path = real ? real : strdup(path);
    file->partial = malloc(room);
    if (!file->path || !file->partial) {
        return cli_out_of_memory();
    }
    snprintf(file->partial, room, "%s.partial", file->path);
    return 0;
}

void cli_file_free(sweep_file *file)
{
    if (file->stream && file->path) {
        fclose(file->stream);
    }
    free(file->path);
    free(file->partial);
    memset(file, 0, sizeof *file);
}

/* A row that is written, now or before. */
static void row_take(sweep_file *file, const sweep_row *row)
{
    cli_tally_add(&file->tally, row);
    if (file->row) {
        file->row[row->index][0] = row->sigma_m2;
        file->row[row->index][1] = row->bound_m2;
    }
    file->next++;
}

/* ---- what is there already ---- */

/* The head as it would be written, to be compared; freed by the caller, NULL without memory. */
static char *head_bytes(int format, const sweep_head *head, const sweep_plan *plan, size_t *size)
{
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, size);
    if (!out) {
        return NULL;
    }
    cli_rows_head(out, format, head, plan);
    return fclose(out) == 0 ? bytes : NULL;
}

/* Takes up the rows that follow the right head. Returns the bytes that are good; 0 for none, and
   where there are rows of another shard. */
static size_t rows_recover(sweep_file *file, const sweep_plan *plan, const lrcs_host_file *there,
                           const char *head, size_t head_size)
{
    sweep_text text;
    sweep_row row;
    const char *line;
    size_t size;
    const char *bytes = (const char *)there->bytes;
    if (there->size < head_size || memcmp(bytes, head, head_size) != 0 ||
        cli_text_open(bytes, there->size, &text) != 0) {
        return 0;
    }
    const char *good = text.at;
    while (cli_text_next(&text, &row, &line, &size)) {
        if (row.index != file->next || row.index >= plan->end) {
            return 0;
        }
        row_take(file, &row);
        good = line + size;
    }
    return (size_t)(good - bytes);
}

/* Goes on with FILE.partial: what follows the last whole row is cut off. */
static int partial_continue(sweep_file *file, const sweep_plan *plan, const char *head,
                            size_t head_size)
{
    lrcs_host_error error;
    lrcs_host_file there;
    if (lrcs_host_file_read(file->partial, &there, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    size_t good = rows_recover(file, plan, &there, head, head_size);
    int torn = there.size < head_size && memcmp(there.bytes, head, there.size) == 0;
    lrcs_host_file_free(&there);
    if (good == 0 && !torn) {
        fprintf(stderr,
                "lrcs: %s: is of another sweep (scene, options, shard or version): remove it, or "
                "give the same\n",
                file->partial);
        return CLI_FAILED;
    }
    if (truncate(file->partial, (off_t)good) != 0) {
        return file_refuse(file->partial, "continue");
    }
    file->stream = fopen(file->partial, "ab");
    if (!file->stream) {
        return file_refuse(file->partial, "continue");
    }
    if (torn) {
        fwrite(head, 1, head_size, file->stream);
    }
    return 0;
}

/* Is FILE whole and of this very sweep? A map holds no head: it is made again. */
static int file_is_whole(sweep_file *file, const sweep_plan *plan, const char *head,
                         size_t head_size)
{
    lrcs_host_file there;
    if (file->npy || lrcs_host_file_read(file->path, &there, NULL) != LRCS_OK) {
        return 0;
    }
    sweep_file found = *file;
    size_t good = rows_recover(&found, plan, &there, head, head_size);
    lrcs_host_file_free(&there);
    if (good == 0 || found.next != plan->end) {
        return 0;
    }
    *file = found;
    return 1;
}

/* A new FILE.partial; one that is there may be hours of work. */
static int partial_begin(sweep_file *file, const char *head, size_t head_size)
{
    int descriptor = open(file->partial, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0 && errno == EEXIST) {
        fprintf(stderr,
                "lrcs: %s: is there from a sweep that was stopped: --resume goes on with "
                "it; or remove it\n",
                file->partial);
        return CLI_FAILED;
    }
    file->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (!file->stream) {
        return file_refuse(file->partial, "write");
    }
    fwrite(head, 1, head_size, file->stream);
    return 0;
}

int cli_file_open(const cli_args *args, sweep_file *file, const sweep_head *head,
                  const sweep_plan *plan)
{
    struct stat about;
    size_t size = 0;
    int resume = cli_value(args, "resume") != NULL;
    int code = 0;
    file->next = plan->first;
    if (!file->path) {
        file->stream = stdout;
        cli_rows_head(stdout, file->format, head, plan);
        return 0;
    }
    char *text = head_bytes(file->format, head, plan, &size);
    if (!text) {
        return cli_out_of_memory();
    }
    if (resume && stat(file->partial, &about) == 0) {
        code = partial_continue(file, plan, text, size);
    } else if (!resume || !file_is_whole(file, plan, text, size)) {
        code = partial_begin(file, text, size);
    }
    free(text);
    return code;
}

/* ---- rows, and the end ---- */

static int stream_fault(const sweep_file *file, lrcs_host_error *error)
{
    snprintf(error->text, sizeof error->text, "%.900s: cannot write: %s",
             file->path ? file->partial : "standard output", strerror(errno));
    return LRCS_E_SYSTEM;
}

int cli_file_put(sweep_file *file, const sweep_plan *plan, const sweep_row *row,
                 lrcs_host_error *error)
{
    cli_rows_put(file->stream, file->format, plan, row);
    row_take(file, row);
    double now = cli_seconds();
    if (now - file->flushed < FILE_PERIOD) {
        return LRCS_OK;
    }
    file->flushed = now;
    return fflush(file->stream) == 0 && !ferror(file->stream) ? LRCS_OK : stream_fault(file, error);
}

/* FILE.npy from the rows of FILE.npy.partial, which then goes. */
static int map_make(const sweep_file *file)
{
    lrcs_host_error error = {"the rows of the map cannot be read back"};
    lrcs_host_file rows;
    lrcs_host_output out;
    sweep_text text;
    sweep_row row;
    const char *line;
    size_t size;
    if (lrcs_host_file_read(file->partial, &rows, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    int status = cli_text_open((const char *)rows.bytes, rows.size, &text);
    status = status == 0 ? lrcs_host_output_open(file->path, &out, &error) : LRCS_E_SYNTAX;
    if (status == LRCS_OK) {
        cli_npy_head(out.stream, &text);
        while (cli_text_next(&text, &row, &line, &size)) {
            cli_npy_row(out.stream, &text, &row);
        }
        status = lrcs_host_output_close(&out, 1, &error);
    }
    lrcs_host_file_free(&rows);
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    return remove(file->partial) == 0 ? 0 : file_refuse(file->partial, "remove");
}

int cli_file_close(sweep_file *file, const sweep_plan *plan, int all)
{
    lrcs_host_error error;
    if (!file->stream) {
        return 0;
    }
    if (all && cli_plan_has_mean(plan) && file->tally.rows == plan->rows) {
        cli_rows_mean(file->stream, file->format, &file->tally);
    }
    int good = fflush(file->stream) == 0 && !ferror(file->stream);
    if (!file->path) {
        return 0; /* the tool's end looks at standard output */
    }
    if (fclose(file->stream) != 0 || !good) {
        file->stream = NULL;
        stream_fault(file, &error);
        return cli_failed(&error);
    }
    file->stream = NULL;
    if (!all) {
        return file->next > plan->first || remove(file->partial) == 0
                   ? 0
                   : file_refuse(file->partial, "remove");
    }
    if (file->npy) {
        return map_make(file);
    }
    return rename(file->partial, file->path) == 0 ? 0 : file_refuse(file->path, "write");
}
