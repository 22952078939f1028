/* SPDX-License-Identifier: MIT */
/* The files that lrcs run writes: their options, what they may not replace, and the writing. */
#include "cli/run.h"

#include <stdlib.h>
#include <string.h>

#define IMAGE_LEAST   16.0
#define IMAGE_MOST    4096.0
#define IMAGE_DEFAULT 512u

int cli_run_outputs_read(run_job *job)
{
    const cli_args *args = job->args;
    job->facets = cli_value(args, "facets");
    job->image_path = cli_value(args, "image");
    if (job->facets && job->image_path && lrcs_host_output_same(job->facets, job->image_path)) {
        return cli_usage(args->command, "--facets and --image name the same file: '%s', '%s'",
                         job->facets, job->image_path);
    }
    if (job->image_path && strcmp(job->image_path, "-") == 0) {
        return cli_usage(args->command, "--image: a picture does not go to standard output");
    }
    if (job->facets && strcmp(job->facets, "-") == 0 && cli_value(args, "json")) {
        return cli_usage(args->command, "--facets - and --json both want standard output");
    }
    if (job->facets && strcmp(job->facets, "-") == 0 && cli_value(args, "explain")) {
        return cli_usage(args->command, "--facets - and --explain both want standard output");
    }
    if (cli_value(args, "image-size") && !job->image_path) {
        return cli_usage(args->command, "--image-size needs --image FILE.png");
    }
    job->image_size = IMAGE_DEFAULT;
    return cli_whole(args, "image-size", IMAGE_LEAST, IMAGE_MOST, &job->image_size);
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
    int code = output_spares(job, "facets", job->facets);
    return code ? code : output_spares(job, "image", job->image_path);
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
    return code == 0 && job->facets ? facets_write(job) : code;
}
