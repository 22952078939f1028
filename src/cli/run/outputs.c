/* SPDX-License-Identifier: MIT */
/* The files that lrcs run writes: their options, the files that they must not replace, and the
   writing. */
#include "cli/run/run.h"

#include <stdlib.h>
#include <string.h>

static int to_stdout(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

int cli_run_outputs_read(run_job *job)
{
    static const char *const not_png[] = {".jpg", ".jpeg", ".gif", ".svg", ".pdf"};
    const cli_args *args = job->args;
    const char *table = cli_value(args, "explain")  ? "explain"
                        : cli_value(args, "shares") ? "shares"
                                                    : NULL;
    int method = job->options.method;
    job->facets_path = cli_value(args, "facets");
    job->polygons_path = cli_value(args, "polygons");
    job->image_path = cli_value(args, "image");

    /* 1. The picture is a PNG file: with the extension of another format no program could open it.
     */
    if (to_stdout(job->image_path)) {
        return cli_usage(args->command, "--image: a picture does not go to standard output");
    }
    if (job->polygons_path && method != LRCS_METHOD_AUTO && method != LRCS_METHOD_EXACT) {
        return cli_usage(args->command,
                         "--polygons: visible polygons come from --method exact (or auto), found "
                         "--method %s",
                         lrcs_method_text(method));
    }
    for (size_t i = 0; job->image_path && i < sizeof not_png / sizeof not_png[0]; i++) {
        if (cli_extension(job->image_path, not_png[i])) {
            return cli_expected(args, "image", "FILE.png");
        }
    }

    /* 2. No file is standard output beside what --explain or --shares print there. */
    const char *const option[2] = {"facets", "polygons"};
    const char *const path[2] = {job->facets_path, job->polygons_path};
    for (int i = 0; table && i < 2; i++) {
        if (to_stdout(path[i])) {
            return cli_usage(args->command, "--%s - and --%s both want standard output", option[i],
                             table);
        }
    }

    /* 3. Neither file has the name of what stands beside the other one. */
    for (int i = 0; path[0] && path[1] && i < 2; i++) {
        size_t size = strlen(path[i]);
        if (strncmp(path[1 - i], path[i], size) == 0 &&
            strcmp(path[1 - i] + size, CLI_BESIDE) == 0) {
            return cli_usage(args->command, "%s is the file that names what '%s' was made from",
                             path[1 - i], path[i]);
        }
    }

    /* 4. The size of the picture. */
    if (cli_value(args, "image-size") && !job->image_path) {
        return cli_usage(args->command, "--image-size needs --image FILE.png");
    }
    job->image_size = CLI_PICTURE_DEFAULT;
    return cli_whole(args, "image-size", CLI_PICTURE_LEAST, CLI_PICTURE_MOST, &job->image_size);
}

int cli_run_outputs_stdout(const run_job *job)
{
    return to_stdout(job->facets_path) || to_stdout(job->polygons_path);
}

static void facets_write(FILE *out, const void *context)
{
    const run_job *job = context;
    lrcs_host_facets_write(out, &job->scene.scene, job->records);
}

static void polygons_write(FILE *out, const void *context)
{
    const run_job *job = context;
    lrcs_host_polygons_write(out, &job->polygons.list);
}

lrcs_host_picture cli_run_picture(const run_job *job)
{
    return (lrcs_host_picture){.scene = &job->scene.scene,
                               .pose = &job->pose,
                               .records = job->records,
                               .title = cli_scene_name(job->args, &job->scene),
                               .annotated = 1};
}

static int image_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const run_job *job = context;
    const lrcs_host_picture picture = cli_run_picture(job);
    return cli_picture_write(out, &picture, &job->image, job->image_size, job->args, &job->scene,
                             error);
}

/* Writes a table, and beside it what it was made from. */
static int table_write(const run_job *job, const char *path, cli_text_writer *write)
{
    int code = path ? cli_text_write(path, write, job) : 0;
    return code == 0 && path ? cli_provenance_beside(job->args, path, &job->scene, &job->pose, NULL)
                             : code;
}

int cli_run_outputs_write(const run_job *job)
{
    int code = job->image_path ? cli_output_write(job->image_path, image_write, job) : 0;
    code = code ? code : table_write(job, job->facets_path, facets_write);
    return code ? code : table_write(job, job->polygons_path, polygons_write);
}
