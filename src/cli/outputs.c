/* SPDX-License-Identifier: MIT */
/* Files that a command writes: that no two are one, that none replaces what the scene was read
   from, and that each appears whole or not at all. What stands in them is the command's. */
#include "cli/cli.h"

#include <string.h>
#include <strings.h>

int cli_extension(const char *path, const char *extension)
{
    size_t size = strlen(path);
    size_t end = strlen(extension);
    return size > end && strcasecmp(path + size - end, extension) == 0;
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
