/* SPDX-License-Identifier: MIT */
/* The options for accuracy and method of a run. */
#include "cli/cli.h"

#define RASTER_MOST 16384.0

int cli_accuracy_read(const cli_args *args, lrcs_run_options *options)
{
    const char *method = cli_value(args, "method");
    *options = lrcs_run_options_default();
    int code = cli_number(args, "tolerance", &options->tolerance);
    if (code == 0 && !(options->tolerance > 0.0)) {
        return cli_usage(args->command, "--tolerance: expected a relative error > 0, found '%s'",
                         cli_value(args, "tolerance"));
    }
    if (code == 0 && method) {
        options->method = lrcs_method_find(method);
        if (options->method < 0) {
            return cli_usage(args->command,
                             "--method: expected auto, facet, zbuffer or exact, found '%s'",
                             method);
        }
    }
    const char *accept = cli_value(args, "accept");
    if (code == 0 && accept) {
        options->accept = lrcs_accept_find(accept);
        if (options->accept < 0) {
            return cli_usage(args->command, "--accept: expected bound, estimate or any, found '%s'",
                             accept);
        }
    }
    return code ? code : cli_whole(args, "resolution", 1.0, RASTER_MOST, &options->resolution);
}

int cli_normals_read(const cli_args *args, lrcs_host_options *load)
{
    const char *normals = cli_value(args, "normals");
    int found = normals ? lrcs_normals_find(normals) : LRCS_NORMALS_FLAT;
    if (found < 0) {
        return cli_usage(args->command, "--normals: expected flat, auto or smooth, found '%s'",
                         normals);
    }
    load->build.normals = found;
    return 0;
}

int cli_tolerance_judged(const cli_args *args, const lrcs_run_options *options)
{
    return options->method == LRCS_METHOD_AUTO || cli_value(args, "tolerance") != NULL;
}

const char *cli_accepted_by(uint32_t flags)
{
    return flags & LRCS_FLAG_TOLERANCE_NOT_MET
               ? NULL
               : lrcs_accept_text(flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE ? LRCS_ACCEPT_ESTIMATE
                                  : flags & LRCS_FLAG_ACCEPTED_UNJUDGED  ? LRCS_ACCEPT_ANY
                                                                         : LRCS_ACCEPT_BOUND);
}

void cli_accepted_print(FILE *out, uint32_t flags)
{
    if (flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE) {
        fputs("notice: the tolerance is met by the estimate alone, not by the bound\n", out);
    }
    if (flags & LRCS_FLAG_ACCEPTED_UNJUDGED) {
        fputs("notice: the tolerance is not judged: any answer was accepted\n", out);
    }
}

uint32_t cli_flags_in_force(const cli_args *args, const lrcs_run_options *options, uint32_t flags)
{
    return cli_tolerance_judged(args, options) ? flags
                                               : flags & ~(uint32_t)LRCS_FLAG_TOLERANCE_NOT_MET;
}

int cli_accuracy_code(const cli_args *args, const lrcs_run_options *options, uint32_t flags)
{
    uint32_t degraded = LRCS_FLAG_TOLERANCE_NOT_MET | LRCS_FLAG_MEMORY_FALLBACK;
    return (cli_flags_in_force(args, options, flags) & degraded) != 0 ? CLI_DEGRADED : CLI_DONE;
}
