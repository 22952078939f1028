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
    int cause = errno;
    int missing = cause == ENOENT && access(folder, F_OK) != 0;
    return cli_fail("%s: cannot write: %s%s%s", path, strerror(cause),
                    missing ? "; there is no folder " : "", missing ? folder : "");
}

static int option_kind(const cli_command *command, const char *name)
{
    const cli_option *option = command->option;
    while (option->name && strcmp(option->name, name) != 0) {
        option++;
    }
    return option->name ? option->has_value : 0;
}

int cli_is_output(const cli_command *command, const char *option)
{
    return option_kind(command, option) >= CLI_FILE;
}

void cli_outputs_print(const cli_args *args, const char *kept)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        int written = !kept || strcmp(given->name, kept) != 0;
        if (written && cli_is_output(args->command, given->name) &&
            strcmp(given->value, "-") != 0) {
            fprintf(stderr, "wrote %s\n", given->value);
        }
    }
}

int cli_outputs_check(const cli_args *args)
{
    const cli_command *command = args->command;
    const int json = cli_value(args, "json") && !cli_is_output(command, "json");
    for (int i = 0; i < args->given_count; i++) {
        const char *name = args->given[i].name;
        const char *path = args->given[i].value;
        const int kind = option_kind(command, name);
        if (kind < CLI_FILE) {
            continue;
        }
        if (kind == CLI_CHART && !cli_extension(path, ".svg") && !cli_extension(path, ".png")) {
            return cli_usage(command, "%s%s: expected FILE.svg or FILE.png, found '%s'",
                             cli_dashes(name), name, path);
        }
        for (int k = 0; k < i; k++) {
            const cli_given *other = &args->given[k];
            if (cli_is_output(command, other->name) && lrcs_host_output_same(other->value, path)) {
                return cli_usage(command, "%s%s and %s%s name the same file: '%s', '%s'",
                                 cli_dashes(other->name), other->name, cli_dashes(name), name,
                                 other->value, path);
            }
        }
        /* -o is what a command writes in any case, in the form that --json may choose */
        if (json && strcmp(path, "-") == 0 && strcmp(name, "o") != 0) {
            return cli_usage(command, "--%s - and --json both want standard output", name);
        }
        int code = output_place(path);
        if (code != 0) {
            return code;
        }
    }
    return 0;
}

int cli_outputs_spare(const cli_args *args, const lrcs_host_scene *scene)
{
    lrcs_host_error error;
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        if (cli_is_output(args->command, given->name) &&
            lrcs_host_output_check(given->value, scene, &error) != LRCS_OK) {
            return cli_usage(args->command, "%s%s %s", cli_dashes(given->name), given->name,
                             error.text);
        }
    }
    return 0;
}

int cli_outputs_spare_input(const cli_args *args, const char *input, const char *what)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        if (cli_is_output(args->command, given->name) &&
            lrcs_host_output_same(given->value, input)) {
            return cli_usage(args->command, "%s%s %s: would overwrite %s", cli_dashes(given->name),
                             given->name, given->value, what);
        }
    }
    return 0;
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

typedef struct text_output {
    cli_text_writer *write;
    const void *context;
} text_output;

static int text_put(FILE *out, const void *context, lrcs_host_error *error)
{
    const text_output *text = context;
    (void)error;
    text->write(out, text->context);
    return LRCS_OK;
}

int cli_text_write(const char *path, cli_text_writer *write, const void *context)
{
    const text_output text = {write, context};
    return cli_output_write(path, text_put, &text);
}

typedef struct chart_output {
    cli_chart_writer *draw;
    const void *context;
    int png;
} chart_output;

static int chart_output_draw(FILE *out, const void *context, lrcs_host_error *error)
{
    const chart_output *chart = context;
    return chart->draw(out, chart->context, chart->png, error);
}

int cli_chart_write(const char *path, cli_chart_writer *draw, const void *context)
{
    const chart_output chart = {draw, context, cli_extension(path, ".png")};
    return cli_output_write(path, chart_output_draw, &chart);
}

int cli_charts_write(const cli_args *args, const char *option, cli_chart_writer *draw,
                     const void *context)
{
    int code = 0;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        if (strcmp(args->given[i].name, option) == 0) {
            code = cli_chart_write(args->given[i].value, draw, context);
        }
    }
    return code;
}

int cli_chart_put(FILE *out, const void *chart, int png, lrcs_host_error *error)
{
    if (png) {
        return lrcs_host_chart_png(out, chart, error);
    }
    lrcs_host_chart_svg(out, chart);
    return LRCS_OK;
}
