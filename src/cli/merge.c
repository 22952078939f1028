/* SPDX-License-Identifier: MIT */
/* lrcs merge: joins the shards of a sweep. The rows are copied byte by byte, so that the file is
   identical to that of a single sweep. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>
#include <string.h>

static const char merge_help[] =
    "usage: lrcs merge FILE... -o OUT\n"
    "\n"
    "Joins the files that lrcs sweep --shard made, in any order, into the file that one sweep "
    "would\n"
    "have made, byte for byte. All must be of one sweep, hold every row once, and agree with the\n"
    "checksum in their last lines. FILE.npy.head says of which sweep a map is.\n"
    "\n"
    "options\n"
    "  -o OUT                FILE.csv or FILE.jsonl, as the shards are; or FILE.npy; '-' for\n"
    "                        standard output\n"
    "\n"
    "examples\n"
    "  lrcs merge map.1.csv map.2.csv map.3.csv -o map.csv\n"
    "  lrcs merge map.*.csv -o map.npy\n";

static const cli_option merge_options[] = {{"o", CLI_FILE, 0}, {"help", 0, 0}, {NULL, 0, 0}};

typedef struct merge_shard {
    const char *path;
    lrcs_host_file file;
    sweep_text text;
    uint64_t first, rows;
} merge_shard;

static int shard_read(merge_shard *shard, const merge_shard *first)
{
    lrcs_host_error error;
    if (lrcs_host_file_read(shard->path, &shard->file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    if (cli_text_open((const char *)shard->file.bytes, shard->file.size, &shard->text) != 0) {
        return cli_fail("%s: expected rows of lrcs sweep, CSV or JSON lines", shard->path);
    }
    if (shard->text.head_size != first->text.head_size ||
        memcmp(shard->text.head, first->text.head, first->text.head_size) != 0) {
        return cli_fail("%s: is of another sweep (its first lines differ from those of the "
                        "first file)",
                        shard->path);
    }
    return cli_text_rows(shard->path, &shard->text, NULL, NULL, NULL, &shard->first, &shard->rows);
}

static int by_first(const void *a, const void *b)
{
    const merge_shard *x = a;
    const merge_shard *y = b;
    int empty = (x->rows != 0) - (y->rows != 0); /* shards without rows come first */
    return empty ? empty : (x->first > y->first) - (x->first < y->first);
}

/* Checks that every row is present exactly once. */
static int shards_check(const merge_shard *shard, int count)
{
    uint64_t next = 0;
    for (int i = 0; i < count; i++) {
        if (shard[i].rows > 0 && shard[i].first < next) {
            return cli_fail("%s: holds rows that another file holds", shard[i].path);
        }
        if (shard[i].rows > 0 && shard[i].first > next) {
            break;
        }
        next += shard[i].rows;
    }
    if (next != shard[0].text.rows) {
        return cli_fail("row %llu of %llu is in none of the files", (unsigned long long)next,
                        (unsigned long long)shard[0].text.rows);
    }
    return 0;
}

/* The rows of all shards, in order. */
typedef struct merge_rows {
    const merge_shard *shard;
    int count, at;
    sweep_text text; /* the remaining text of shard `at` */
    const char *line;
    size_t size;
} merge_rows;

static int merge_next(void *context, sweep_row *row)
{
    merge_rows *rows = context;
    while (rows->at < rows->count) {
        if (cli_text_next(&rows->text, NULL, row, &rows->line, &rows->size) == 1) {
            return 1;
        }
        rows->at++;
        rows->text = rows->at < rows->count ? rows->shard[rows->at].text : rows->text;
    }
    return 0;
}

/* Writes the output, and adds up the checksum of its bytes. */
static void rows_write(FILE *out, merge_rows *rows)
{
    const sweep_text *head = &rows->shard[0].text;
    sweep_tally tally = {0};
    sweep_row row;
    uint64_t sum = cli_sum_more(CLI_SUM_BEGIN, head->head, head->head_size);
    fwrite(head->head, 1, head->head_size, out);
    while (merge_next(rows, &row) == 1) {
        cli_tally_add(&tally, &row);
        fwrite(rows->line, 1, rows->size, out);
        sum = cli_sum_more(sum, rows->line, rows->size);
    }
    if (head->has_mean) {
        char mean[256] = "";
        FILE *text = fmemopen(mean, sizeof mean, "w");
        if (text) {
            cli_rows_mean(text, head->format, &tally);
            fclose(text);
        }
        fputs(mean, out);
        sum = cli_sum_more(sum, mean, strlen(mean));
    }
    cli_rows_sum(out, head->format, sum);
}

static int merge_shards(const cli_args *args, const sweep_file *file, merge_shard *shard)
{
    static const char *const name[] = {"CSV", "JSON lines"};
    lrcs_host_error error;
    lrcs_host_output out;
    int count = 0;
    int code = 0;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        if (args->given[i].name[0] == '\0') {
            shard[count].path = args->given[i].value;
            cli_watch_stage(shard[count].path, NULL);
            code = shard_read(&shard[count], &shard[0]);
            count++;
        }
    }
    const int format = shard[0].text.format;
    if (code == 0 && file->path && !file->npy && file->format != format) {
        return cli_usage(args->command, "-o %s: the shards are %s", file->path, name[format]);
    }
    for (int i = 0; code == 0 && file->path && i < count; i++) {
        if (lrcs_host_output_same(file->path, shard[i].path)) {
            return cli_usage(args->command, "-o %s: would overwrite a shard", file->path);
        }
    }
    qsort(shard, (size_t)count, sizeof *shard, by_first);
    code = code ? code : shards_check(shard, count);
    if (code != 0) {
        return code;
    }
    cli_watch_stage("writing", NULL);
    merge_rows rows = {.shard = shard, .count = count, .text = shard[0].text};
    if (file->npy) {
        return cli_map_write(file->path, &shard[0].text, merge_next, &rows);
    }
    if (lrcs_host_output_open(file->path ? file->path : "-", &out, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    rows_write(out.stream, &rows);
    return lrcs_host_output_close(&out, 1, &error) == LRCS_OK ? CLI_DONE : cli_failed(&error);
}

static int merge_command(const cli_args *args)
{
    sweep_file file;
    if (!cli_value(args, "o")) {
        return cli_usage(args->command, "-o OUT is missing");
    }
    int code = cli_file_read(args, &file);
    merge_shard *shard = calloc((size_t)args->given_count + 1, sizeof *shard);
    if (code == 0) {
        code = shard ? merge_shards(args, &file, shard) : cli_out_of_memory();
    }
    for (int i = 0; shard && i < args->given_count; i++) {
        lrcs_host_file_free(&shard[i].file);
    }
    free(shard);
    cli_file_free(&file);
    return code;
}

const cli_command cli_merge_command = {
    "merge",    "FILE...",     "give the files that lrcs sweep --shard made",
    merge_help, merge_options, merge_command,
    NULL};
