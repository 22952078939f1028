/* SPDX-License-Identifier: MIT */
/* lrcs plot: draws the output of sweeps, range profiles and comparisons of lrcs converge again
   without computing: one file as its command draws it, or the curves of several sweeps together.
   This file decides which files fit together; the host layer and cli/plot/table.c draw. */
#include "cli/plot/table.h"
#include "cli/sweep/sweep.h"

#include <stdlib.h>
#include <string.h>

static const char plot_help[] =
    "usage: lrcs plot FILE... -o OUT [options]\n"
    "\n"
    "Draws again what other commands wrote, as their --plot does, without computing:\n"
    "  lrcs sweep            FILE.csv, FILE.jsonl, or FILE.npy with its FILE.npy.head; curves of\n"
    "                        several sweeps along the same axis are drawn together\n"
    "  lrcs profile          one FILE.csv\n"
    "  lrcs converge         one FILE.csv with its FILE.csv.json\n"
    "Files of sweeps are checked as by sweep --resume: one that is damaged, or a single shard\n"
    "(lrcs merge joins them), is refused. If the files differ in scene, options or version, a\n"
    "notice lists the differences.\n"
    "\n"
    "options\n"
    "  -o OUT                OUT.svg or OUT.png, repeatable: up to 7 curves, or a map\n"
    "for sweeps only:\n"
    "  --dbsm                sigma in dBsm (default: m2); where sigma is 0, curves have a gap,\n"
    "                        and maps are grey\n"
    "  --polar               curves about a pole: the angle counter-clockwise from the right\n"
    "  --projection KIND     of a map over azimuth and elevation: flat (default), or mollweide,\n"
    "                        which preserves areas; 0 deg is in the middle\n"
    "  --stats               of one file: mean by solid angle, percentiles, minimum, maximum,\n"
    "                        histogram, as a table on standard output\n"
    "  --stats-file OUT      the same as OUT.json, .csv, .svg or .png; repeatable\n"
    "\n"
    "Directions of sweep --sphere are drawn as a map: each place shows the nearest of them.\n"
    "Statistics are those of the rows. Each number is printed with the least and the most\n"
    "that it can be if sigma of every row is within its bound; and, if materials state\n"
    "errors, with a 68 % band, as if these errors moved all rows together: an estimate that\n"
    "is seldom too narrow.\n"
    "\n"
    "examples\n"
    "  lrcs plot map.npy -o sky.svg --projection mollweide --dbsm\n"
    "  lrcs plot before.csv after.csv -o both.svg --dbsm\n"
    "  lrcs plot profile.csv -o profile.svg\n"
    "  lrcs plot accuracy.csv -o accuracy.svg\n"
    "  lrcs plot ball.csv --stats --stats-file ball.json --stats-file ball.svg\n";

static const cli_option plot_options[] = {{"o", CLI_CHART, 1}, {"dbsm", 0, 0},
                                          {"polar", 0, 0},     {"projection", 1, 0},
                                          {"stats", 0, 0},     {"stats-file", CLI_FILE, 1},
                                          {"help", 0, 0},      {NULL, 0, 0}};

typedef struct plot_file {
    const char *path;
    lrcs_host_sweep_data data;
} plot_file;

typedef struct plot_job {
    const cli_args *args;
    uint32_t count;
    plot_file *file;
    lrcs_host_sweep_chart *plot;
    int stats;
} plot_job;

/* Appends to the list the options of `head` that `other` lacks or, if `values` is 1, gives with
   another value. */
static void differences_list(const lrcs_host_rows_head *head, const lrcs_host_rows_head *other,
                             int values, char *list, size_t size)
{
    for (uint32_t i = 0; i < head->options && i < LRCS_HOST_HEAD_OPTIONS; i++) {
        const char *key = head->option[i].key;
        const char *text = lrcs_host_rows_head_text(other, key);
        if (!text || (values && strcmp(text, head->option[i].text) != 0)) {
            lrcs_host_append(list, size, "%s%s", list[0] ? ", " : "", key);
        }
    }
}

/* Reports how a file differs from the first. */
static void differences_print(const plot_job *job, uint32_t k)
{
    const lrcs_host_rows_head *first = &job->file[0].data.head;
    const lrcs_host_rows_head *other = &job->file[k].data.head;
    char list[800] = "";
    if (first->scene_hash != other->scene_hash) {
        snprintf(list, sizeof list, "scene");
    }
    differences_list(first, other, 1, list, sizeof list);
    differences_list(other, first, 0, list, sizeof list);
    if (list[0] != '\0') {
        fprintf(stderr, "notice: %s differs from %s in %s\n", job->file[k].path, job->file[0].path,
                list);
    }
}

/* Checks the curves of several files: they need a common axis, and there are no more than
   colours. */
static int overlay_check(const plot_job *job)
{
    const cli_args *args = job->args;
    const lrcs_host_sweep_chart *first = &job->plot[0];
    uint64_t curves = 0;
    for (uint32_t k = 0; k < job->count; k++) {
        const lrcs_host_sweep_chart *plot = &job->plot[k];
        if (plot->map) {
            return cli_usage(args->command, "%s is a map: maps are drawn one by one",
                             job->file[k].path);
        }
        if (strcmp(plot->x.name, first->x.name) != 0) {
            return cli_usage(args->command,
                             "%s runs along '%s' and %s along '%s': they do not fit "
                             "in one chart",
                             job->file[0].path, first->x.name, job->file[k].path, plot->x.name);
        }
        curves += plot->y.count;
    }
    return curves <= LRCS_HOST_SWEEP_CURVES
               ? 0
               : cli_usage(args->command, "at most %u curves in one chart, found %llu",
                           LRCS_HOST_SWEEP_CURVES, (unsigned long long)curves);
}

static int plot_files_read(plot_job *job)
{
    const cli_args *args = job->args;
    int code = cli_stats_read(args, &job->stats);
    for (int i = 0; i < args->given_count && code == 0; i++) {
        if (args->given[i].name[0] != '\0') {
            continue;
        }
        lrcs_host_error error;
        plot_file *file = &job->file[job->count];
        lrcs_host_sweep_data *data = &file->data;
        lrcs_host_sweep_chart *plot = &job->plot[job->count++];
        file->path = args->given[i].value;
        cli_watch_stage(file->path, NULL);
        int status = lrcs_host_sweep_read(file->path, data, &error);
        code = status == LRCS_OK ? cli_plot_read(args, &data->plan, plot)
                                 : cli_plan_failed(args->command, status, &error);
        const char *title = lrcs_host_rows_head_text(&data->head, "title");
        plot->title = title ? title : cli_base_name(file->path);
        plot->accept = lrcs_host_rows_head_text(&data->head, "accept");
        plot->materials_assumed = lrcs_host_rows_head_text(&data->head, "materials") != NULL;
        plot->row = data->row;
        plot->band = data->band;
        plot->head = &data->head;
    }
    return code;
}

static int plot_run(plot_job *job)
{
    const cli_args *args = job->args;
    int code = plot_files_read(job);
    cli_watch_end();
    for (uint32_t k = 0; k < job->count && code == 0; k++) {
        code = cli_outputs_spare_input(args, job->file[k].path, "what is read");
    }
    const int plotted = cli_value(args, "o") != NULL;
    if (code == 0 && !plotted && !job->stats) {
        return cli_usage(args->command, "nothing to do: give -o OUT.svg, --stats or --stats-file");
    }
    if (code == 0 && job->stats && job->count > 1) {
        return cli_usage(args->command, "--stats needs a single file, found %lu",
                         (unsigned long)job->count);
    }
    if (code == 0 && plotted) {
        code = job->count > 1 ? overlay_check(job) : 0;
        int differ = 1; /* the legend has titles if all differ, else names of files */
        for (uint32_t k = 1; k < job->count; k++) {
            for (uint32_t i = 0; i < k; i++) {
                differ &= strcmp(job->plot[i].title, job->plot[k].title) != 0;
            }
        }
        for (uint32_t k = 0; k < job->count && job->count > 1 && code == 0; k++) {
            job->plot[k].name = differ ? job->plot[k].title : cli_base_name(job->file[k].path);
            if (k > 0) {
                differences_print(job, k);
            }
        }
        code = code ? code : cli_plot_write(args, job->plot, job->count);
    }
    if (code == 0 && job->stats) {
        const lrcs_host_sweep_data *data = &job->file->data;
        code = cli_stats_write(args, stdout, &data->plan, &data->head,
                               (const double(*)[2])data->row, (const double(*)[2])data->band);
    }
    return code;
}

/* Checks the options for one file of lrcs profile or lrcs converge, and draws it. */
static int table_run(const cli_args *args, const char *path, int kind)
{
    const char *what = kind == TABLE_CONVERGE ? "a table of lrcs converge" : "a range profile";
    int files = 0;
    int outputs = 0;
    if (kind == TABLE_STATISTICS) {
        return cli_usage(args->command,
                         "%s holds statistics: draw them from the sweep's own file, with "
                         "--stats-file OUT.svg",
                         path);
    }
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *one = &args->given[i];
        if (one->name[0] == '\0') {
            files++;
        } else if (strcmp(one->name, "o") != 0) {
            return cli_usage(args->command, "--%s is for sweeps: %s is %s", one->name, path, what);
        } else {
            outputs++;
        }
    }
    if (files > 1) {
        return cli_usage(args->command, "%s is %s: these are drawn one by one", path, what);
    }
    if (outputs == 0) {
        return cli_usage(args->command, "nothing to do: give -o OUT.svg");
    }
    int code = cli_outputs_spare_input(args, path, "what is read");
    return code ? code : cli_table_draw(args, path, kind);
}

static int plot_command(const cli_args *args)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *one = &args->given[i];
        int kind = one->name[0] == '\0' ? cli_table_kind(one->value) : TABLE_NONE;
        if (kind != TABLE_NONE) {
            return table_run(args, one->value, kind);
        }
    }
    size_t room = (size_t)args->given_count + 1;
    plot_job job = {args, 0, calloc(room, sizeof *job.file), calloc(room, sizeof *job.plot), 0};
    int code = job.file && job.plot ? plot_run(&job) : cli_out_of_memory();
    if (code == CLI_DONE) {
        cli_outputs_print(args, NULL);
    }
    for (uint32_t k = 0; k < job.count; k++) {
        lrcs_host_sweep_data_free(&job.file[k].data);
    }
    free(job.file);
    free(job.plot);
    return code;
}

const cli_command cli_plot_command = {
    "plot",    "FILE...",    "give files that lrcs sweep, profile or converge wrote",
    plot_help, plot_options, plot_command,
    NULL};
