/* SPDX-License-Identifier: MIT */
/* The files that lrcs run writes: their options, what they may not replace, and the writing. */
#include "cli/run.h"

#include <stdlib.h>
#include <string.h>

#define IMAGE_LEAST   16.0
#define IMAGE_MOST    4096.0
#define IMAGE_DEFAULT 512u

/* One of the files that a run may write. */
typedef struct run_file {
    const char *option, *path; /* NULL: not asked for */
} run_file;

#define FILES 3

static void files_list(const run_job *job, run_file file[FILES])
{
    file[0] = (run_file){"facets", job->facets};
    file[1] = (run_file){"polygons", job->polygons_path};
    file[2] = (run_file){"image", job->image_path};
}

static int to_stdout(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

/* No two outputs in one place, a file or standard output. */
static int files_apart(const run_job *job)
{
    const cli_command *command = job->args->command;
    run_file file[FILES];
    files_list(job, file);
    for (int i = 0; i < FILES; i++) {
        const char *table = cli_value(job->args, "json")      ? "json"
                            : cli_value(job->args, "explain") ? "explain"
                                                              : NULL;
        if (to_stdout(file[i].path) && table) {
            return cli_usage(command, "--%s - and --%s both want standard output", file[i].option,
                             table);
        }
        for (int k = i + 1; k < FILES; k++) {
            if (file[i].path && file[k].path && lrcs_host_output_same(file[i].path, file[k].path)) {
                return cli_usage(command, "--%s and --%s name the same file: '%s', '%s'",
                                 file[i].option, file[k].option, file[i].path, file[k].path);
            }
        }
    }
    return 0;
}

int cli_run_outputs_read(run_job *job)
{
    const cli_args *args = job->args;
    int method = job->options.method;
    job->facets = cli_value(args, "facets");
    job->polygons_path = cli_value(args, "polygons");
    job->image_path = cli_value(args, "image");
    if (to_stdout(job->image_path)) {
        return cli_usage(args->command, "--image: a picture does not go to standard output");
    }
    if (job->polygons_path && method != LRCS_METHOD_AUTO && method != LRCS_METHOD_EXACT) {
        return cli_usage(args->command,
                         "--polygons: visible polygons come from --method exact (or auto), found "
                         "--method %s",
                         lrcs_method_text(method));
    }
    int code = files_apart(job);
    if (code == 0 && cli_value(args, "image-size") && !job->image_path) {
        return cli_usage(args->command, "--image-size needs --image FILE.png");
    }
    job->image_size = IMAGE_DEFAULT;
    return code ? code : cli_whole(args, "image-size", IMAGE_LEAST, IMAGE_MOST, &job->image_size);
}

/* Does an option's file replace none of those that the scene was read from? */
static int output_spares(const run_job *job, const char *option, const char *path)
{
    lrcs_host_error error;
    if (path && lrcs_host_output_check(path, &job->scene, &error) != LRCS_OK) {
        return cli_usage(job->args->command, "--%s %s", option, error.text);
    }
    return 0;
}

int cli_run_outputs_check(const run_job *job)
{
    run_file file[FILES];
    int code = 0;
    files_list(job, file);
    for (int i = 0; i < FILES && code == 0; i++) {
        code = output_spares(job, file[i].option, file[i].path);
    }
    return code;
}

int cli_run_outputs_stdout(const run_job *job)
{
    return to_stdout(job->facets) || to_stdout(job->polygons_path);
}

static int facets_write(const run_job *job)
{
    lrcs_host_error error;
    lrcs_host_output out;
    if (lrcs_host_output_open(job->facets, &out, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    lrcs_host_facets_write(out.stream, &job->scene.scene, job->records);
    return lrcs_host_output_close(&out, 1, &error) == LRCS_OK ? 0 : cli_failed(&error);
}

static int polygons_write(const run_job *job)
{
    lrcs_host_error error;
    lrcs_host_output out;
    if (lrcs_host_output_open(job->polygons_path, &out, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    lrcs_host_polygons_write(out.stream, &job->polygons.list);
    return lrcs_host_output_close(&out, 1, &error) == LRCS_OK ? 0 : cli_failed(&error);
}

static int image_write(const run_job *job)
{
    lrcs_host_error error;
    lrcs_host_output out;
    size_t side = job->image_size;
    unsigned char *rgb = malloc(3 * side * side);
    if (!rgb) {
        fprintf(stderr, "lrcs: out of memory\n");
        return CLI_FAILED;
    }
    lrcs_host_picture_make(&job->scene.scene, job->records, &job->image, job->image_size, rgb);
    int status = lrcs_host_output_open(job->image_path, &out, &error);
    if (status == LRCS_OK) {
        status = lrcs_host_png_write(out.stream, rgb, job->image_size, job->image_size, 3, &error);
        int good = status == LRCS_OK;
        int closed = lrcs_host_output_close(&out, good, good ? &error : NULL);
        status = good ? closed : status;
    }
    free(rgb);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

int cli_run_outputs_write(const run_job *job)
{
    int code = job->image_path ? image_write(job) : 0;
    code = code == 0 && job->facets ? facets_write(job) : code;
    return code == 0 && job->polygons_path ? polygons_write(job) : code;
}
