/* SPDX-License-Identifier: MIT */
/* lrcs merge: joins the shards of a sweep. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>

static const char merge_help[] =
    "usage: lrcs merge FILE... -o OUT\n"
    "\n"
    "Joins the files that lrcs sweep --shard wrote, in any order, into the file that one\n"
    "sweep would have written, byte for byte. All must belong to the same sweep, hold every\n"
    "row once, and agree with the checksums in their last lines. FILE.npy.head states which\n"
    "sweep a map belongs to.\n"
    "\n"
    "options\n"
    "  -o OUT                FILE.csv or FILE.jsonl, in the format of the shards, or FILE.npy;\n"
    "                        '-': standard output\n"
    "\n"
    "examples\n"
    "  lrcs merge map.1.csv map.2.csv map.3.csv -o map.csv\n"
    "  lrcs merge map.*.csv -o map.npy\n";

static const cli_option merge_options[] = {{"o", CLI_FILE, 0}, {"help", 0, 0}, {NULL, 0, 0}};

static int merge_shards(const cli_args *args, const lrcs_host_sweep_output *file,
                        lrcs_host_sweep_part *part)
{
    static const char *const name[] = {"CSV", "JSON lines"};
    lrcs_host_error error;
    uint32_t count = 0;
    for (int i = 0; i < args->given_count; i++) {
        const char *path = args->given[i].value;
        if (args->given[i].name[0] == '\0') {
            cli_watch_stage(path, NULL);
            if (lrcs_host_sweep_part_read(path, count > 0 ? part : NULL, &part[count], &error) !=
                LRCS_OK) {
                return cli_failed(&error);
            }
            count++;
        }
    }
    const int format = part[0].rows.format;
    if (file->path && !file->npy && file->format != format) {
        return cli_usage(args->command, "-o %s: the shards are %s", file->path, name[format]);
    }
    for (uint32_t i = 0; file->path && i < count; i++) {
        int code = cli_outputs_spare_input(args, part[i].path, "a shard");
        if (code != 0) {
            return code;
        }
    }
    cli_watch_stage("writing", NULL);
    int status =
        lrcs_host_sweep_join(part, count, file->path ? file->path : "-", file->npy, &error);
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    cli_watch_end();
    cli_outputs_print(args, NULL);
    return CLI_DONE;
}

static int merge_command(const cli_args *args)
{
    lrcs_host_sweep_output file;
    if (!cli_value(args, "o")) {
        return cli_usage(args->command, "-o OUT is missing");
    }
    int code = cli_rows_output_read(args, &file);
    lrcs_host_sweep_part *part = calloc((size_t)args->given_count + 1, sizeof *part);
    if (code == 0) {
        code = part ? merge_shards(args, &file, part) : cli_out_of_memory();
    }
    for (int i = 0; part && i < args->given_count; i++) {
        lrcs_host_sweep_part_free(&part[i]);
    }
    free(part);
    lrcs_host_sweep_output_free(&file);
    return code;
}

const cli_command cli_merge_command = {
    "merge",    "FILE...",     "give the files that lrcs sweep --shard made",
    merge_help, merge_options, merge_command,
    NULL};
