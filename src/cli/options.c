/* SPDX-License-Identifier: MIT */
/* The options that several commands share: the pose, of which at most one may be given (without one
   the laser is on +z), and the accuracy and method of a run. */
#include "cli/cli.h"

#include <lrcs/plan.h>

#include <math.h>
#include <string.h>

#define RASTER_MOST 16384.0 /* as lrcs_run_options.resolution */

/* ---- the pose ---- */

int cli_pose_read(const cli_args *args, lrcs_pose *pose)
{
    static const char *const way[] = {"direction", "azel", "euler", "quaternion"};
    lrcs_host_error error;
    const char *first = NULL;
    *pose = lrcs_pose_default();
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        const char *text = cli_value(args, way[i]);
        if (text && first) {
            return cli_usage(args->command, "--%s and --%s both give the pose: give one", first,
                             way[i]);
        }
        first = text ? way[i] : first;
        if (text && lrcs_host_pose_read(way[i], text, pose, &error) != LRCS_OK) {
            return cli_usage(args->command, "--%s", error.text);
        }
    }
    return 0;
}

void cli_pose_unit(const lrcs_pose *pose, double s_hat[3])
{
    const double *d = pose->direction;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) {
        s_hat[k] = d[k] / length;
    }
}

void cli_pose_azel(const lrcs_pose *pose, double azel_deg[2])
{
    const double *d = pose->direction;
    azel_deg[0] = atan2(d[1], d[0]) * LRCS_DEGREES_PER_RADIAN;
    azel_deg[1] = atan2(d[2], hypot(d[0], d[1])) * LRCS_DEGREES_PER_RADIAN;
}

/* ---- accuracy and method ---- */

int cli_accuracy_read(const cli_args *args, lrcs_run_options *options)
{
    *options = lrcs_run_options_default();
    int code = cli_positive(args, "tolerance", "a relative error > 0", &options->tolerance);
    code =
        code ? code : cli_choice(args, "method", "auto, facet, zbuffer or exact", &options->method);
    code = code ? code : cli_choice(args, "accept", "bound, estimate or any", &options->accept);
    return code ? code : cli_whole(args, "resolution", 1.0, RASTER_MOST, &options->resolution);
}

int cli_normals_read(const cli_args *args, lrcs_host_options *load)
{
    load->build.normals = LRCS_NORMALS_FLAT;
    return cli_choice(args, "normals", "flat, auto or smooth", &load->build.normals);
}

void cli_division_set(const lrcs_run_options *options, lrcs_host_options *load)
{
    load->build.tolerance = options->tolerance;
    load->build.facets_only = options->method != LRCS_METHOD_AUTO;
    load->build.division = LRCS_HOST_DIVISION;
    load->build.max_facets = LRCS_HOST_FACETS;
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
    uint32_t in_force = cli_flags_in_force(args, options, flags);
    int code = CLI_DONE;
    if (in_force & LRCS_FLAG_TOLERANCE_NOT_MET) {
        code = cli_degraded("the tolerance %g is missed", options->tolerance);
    }
    return in_force & LRCS_FLAG_MEMORY_FALLBACK
               ? cli_degraded("memory was short: the answer is coarser than asked for")
               : code;
}
