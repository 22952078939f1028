/* SPDX-License-Identifier: MIT */
/* The options that several commands share: the pose, of which at most one may be given (without one
   the laser is on +z), and the accuracy and method of a run. */
#include "cli/cli.h"

#include <math.h>
#include <string.h>

#define RASTER_MOST 16384.0

/* ---- the pose ---- */

static int pose_direction(const cli_args *args, const char *text, lrcs_pose *pose)
{
    double v[3];
    if (cli_list(text, v, 3) != 0) {
        return cli_expected(args, "direction", "x,y,z (to the laser, body frame)");
    }
    return lrcs_pose_from_direction(v, pose) == LRCS_OK
               ? 0
               : cli_expected(args, "direction", "a vector that is not zero");
}

static int pose_azel(const cli_args *args, const char *text, lrcs_pose *pose)
{
    double v[2];
    return cli_list(text, v, 2) == 0 && lrcs_pose_from_azel(v[0], v[1], pose) == LRCS_OK
               ? 0
               : cli_expected(args, "azel", "AZ,EL in degrees");
}

static int pose_euler(const cli_args *args, const char *text, lrcs_pose *pose)
{
    const char *colon = strchr(text, ':');
    char sequence[4] = "";
    double v[3];
    if (!colon || colon - text != 3 || cli_list(colon + 1, v, 3) != 0) {
        return cli_expected(args, "euler",
                            "SEQ:a,b,c with SEQ three letters and a, b, c in degrees "
                            "(XYZ:10,20,30)");
    }
    memcpy(sequence, text, 3);
    int status = lrcs_pose_from_euler(sequence, v, pose);
    if (status == LRCS_E_NAME) {
        return cli_usage(args->command,
                         "--euler: expected three of XYZ (intrinsic) or of xyz (extrinsic), "
                         "neighbours different, found '%s'",
                         sequence);
    }
    return status == LRCS_OK ? 0
                             : cli_usage(args->command, "--euler: %s", lrcs_status_text(status));
}

static int pose_quaternion(const cli_args *args, const char *text, lrcs_pose *pose)
{
    double v[4];
    if (cli_list(text, v, 4) != 0) {
        return cli_expected(args, "quaternion", "w,x,y,z (body to observation)");
    }
    return lrcs_pose_from_quaternion(v, pose) == LRCS_OK
               ? 0
               : cli_expected(args, "quaternion", "one that is not zero");
}

int cli_pose_read(const cli_args *args, lrcs_pose *pose)
{
    static const struct {
        const char *name;
        int (*read)(const cli_args *args, const char *text, lrcs_pose *pose);
    } way[] = {{"direction", pose_direction},
               {"azel", pose_azel},
               {"euler", pose_euler},
               {"quaternion", pose_quaternion}};
    const char *first = NULL;
    int code = 0;
    *pose = lrcs_pose_default();
    for (size_t i = 0; i < sizeof way / sizeof way[0] && code == 0; i++) {
        const char *text = cli_value(args, way[i].name);
        if (text && first) {
            return cli_usage(args->command, "--%s and --%s both give the pose: give one", first,
                             way[i].name);
        }
        first = text ? way[i].name : first;
        code = text ? way[i].read(args, text, pose) : 0;
    }
    return code;
}

void cli_pose_unit(const lrcs_pose *pose, double s_hat[3])
{
    const double *d = pose->direction;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) {
        s_hat[k] = d[k] / length;
    }
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
