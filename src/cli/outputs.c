/* SPDX-License-Identifier: MIT */
/* The files that a command writes: no two are the same, none replaces a file that the scene was
   read from, and each appears complete or not at all. The command decides what they contain. */
#include "cli/cli.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

int cli_extension(const char *path, const char *extension)
{
    size_t size = strlen(path);
    size_t end = strlen(extension);
    return size > end && strcasecmp(path + size - end, extension) == 0;
}

/* Checks that a file of that name can be written: it is not a folder, and its folder exists. */
static int output_place(const char *path)
{
    struct stat about;
    char folder[4096] = ".";
    const char *slash = strrchr(path, '/');
    if (strcmp(path, "-") == 0) {
        return 0;
    }
    if (slash && (size_t)(slash - path) + 2 < sizeof folder) {
        snprintf(folder, sizeof folder, "%.*s/", (int)(slash - path), path);
    }
    int there = stat(path, &about) == 0;
    if (there && S_ISDIR(about.st_mode)) {
        errno = EISDIR;
    } else if ((there && !S_ISREG(about.st_mode)) || access(folder, W_OK | X_OK) == 0) {
        return 0; /* a device is written directly */
    }
    fprintf(stderr, "lrcs: %s: cannot write: %s\n", path, strerror(errno));
    return CLI_FAILED;
}

int cli_outputs_places(const cli_args *args)
{
    int code = 0;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const cli_option *option = args->command->option;
        while (option->name && strcmp(option->name, args->given[i].name) != 0) {
            option++;
        }
        code =
            option->name && option->has_value == CLI_FILE ? output_place(args->given[i].value) : 0;
    }
    return code;
}

int cli_outputs_apart(const cli_command *command, const cli_output *output, int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = i + 1; k < count; k++) {
            const char *a = output[i].path;
            const char *b = output[k].path;
            if (a && b && lrcs_host_output_same(a, b)) {
                return cli_usage(command, "%s%s and %s%s name the same file: '%s', '%s'",
                                 cli_dashes(output[i].option), output[i].option,
                                 cli_dashes(output[k].option), output[k].option, a, b);
            }
        }
    }
    return 0;
}

int cli_outputs_spare(const cli_command *command, const cli_output *output, int count,
                      const lrcs_host_scene *scene)
{
    lrcs_host_error error;
    for (int i = 0; i < count; i++) {
        if (output[i].path && lrcs_host_output_check(output[i].path, scene, &error) != LRCS_OK) {
            return cli_usage(command, "%s%s %s", cli_dashes(output[i].option), output[i].option,
                             error.text);
        }
    }
    return 0;
}

int cli_stdout_check(const cli_args *args)
{
    const char *csv = cli_value(args, "csv");
    return csv && strcmp(csv, "-") == 0 && cli_value(args, "json")
               ? cli_usage(args->command, "--csv - and --json both want standard output")
               : 0;
}

int cli_chart_check(const cli_args *args, const char *option, const char *path)
{
    return cli_extension(path, ".svg") || cli_extension(path, ".png")
               ? 0
               : cli_usage(args->command, "%s%s: expected FILE.svg or FILE.png, found '%s'",
                           cli_dashes(option), option, path);
}

int cli_chart_write(FILE *out, int png, const lrcs_host_chart *chart, const cli_args *args,
                    const lrcs_host_scene *scene, lrcs_host_error *error)
{
    lrcs_host_chart all = *chart;
    char *about = cli_provenance_text(args, scene);
    int status = LRCS_OK;
    all.about = about;
    if (png) {
        status = lrcs_host_chart_png(out, &all, error);
    } else {
        lrcs_host_chart_svg(out, &all);
    }
    free(about);
    return status;
}

int cli_picture_write(FILE *out, const lrcs_host_picture *picture, const lrcs_image *image,
                      uint32_t size, const cli_args *args, const lrcs_host_scene *scene,
                      lrcs_host_error *error)
{
    lrcs_host_picture all = *picture;
    char *about = cli_provenance_text(args, scene);
    all.about = about;
    int status = lrcs_host_picture_png(out, &all, image, size, error);
    free(about);
    return status;
}

int cli_output_write(const char *path, cli_writer *write, const void *context)
{
    lrcs_host_error error;
    lrcs_host_output out;
    int status = lrcs_host_output_open(path, &out, &error);
    if (status == LRCS_OK) {
        status = write(out.stream, context, &error);
        int good = status == LRCS_OK;
        int closed = lrcs_host_output_close(&out, good, good ? &error : NULL);
        status = good ? closed : status;
    }
    return status == LRCS_OK ? 0 : cli_failed(&error);
}
