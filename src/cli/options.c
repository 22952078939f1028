/* SPDX-License-Identifier: MIT */
/* The options that several commands share: the pose, of which at most one may be given (without one
   the laser is on +z), and the accuracy and method of a run. */
#include "cli/cli.h"

#include <math.h>
#include <string.h>

#define RASTER_MOST 16384.0

/* ---- the pose ---- */

/* The options that give a pose: how many numbers they have, what a message expects of their form,
   and of numbers of that form. */
enum { POSE_DIRECTION, POSE_AZEL, POSE_EULER, POSE_QUATERNION, POSE_WAYS };
static const struct {
    const char *name;
    int numbers;
    const char *form, *value;
} pose_way[POSE_WAYS] = {
    {"direction", 3, "x,y,z (to the laser, body frame)", "a vector that is not zero"},
    {"azel", 2, "AZ,EL in degrees", "AZ,EL in degrees"},
    {"euler", 3, "SEQ:a,b,c with SEQ three letters and a, b, c in degrees (XYZ:10,20,30)", NULL},
    {"quaternion", 4, "w,x,y,z (body to observation)", "one that is not zero"}};

static int pose_make(const cli_args *args, int way, const char *text, lrcs_pose *pose)
{
    double v[4];
    char sequence[4] = "";
    const char *numbers = text;
    if (way == POSE_EULER) {
        const char *colon = strchr(text, ':');
        int three = colon && colon - text == 3;
        memcpy(sequence, three ? text : "", three ? 3 : 0);
        numbers = three ? colon + 1 : "";
    }
    if (cli_list(numbers, v, pose_way[way].numbers) != 0) {
        return cli_expected(args, pose_way[way].name, pose_way[way].form);
    }
    int status = way == POSE_DIRECTION ? lrcs_pose_from_direction(v, pose)
                 : way == POSE_AZEL    ? lrcs_pose_from_azel(v[0], v[1], pose)
                 : way == POSE_EULER   ? lrcs_pose_from_euler(sequence, v, pose)
                                       : lrcs_pose_from_quaternion(v, pose);
    if (way == POSE_EULER && status == LRCS_E_NAME) {
        return cli_usage(args->command,
                         "--euler: expected three of XYZ (intrinsic) or of xyz (extrinsic), "
                         "neighbours different, found '%s'",
                         sequence);
    }
    if (way == POSE_EULER && status != LRCS_OK) {
        return cli_usage(args->command, "--euler: %s", lrcs_status_text(status));
    }
    return status == LRCS_OK ? 0 : cli_expected(args, pose_way[way].name, pose_way[way].value);
}

int cli_pose_read(const cli_args *args, lrcs_pose *pose)
{
    const char *first = NULL;
    int code = 0;
    *pose = lrcs_pose_default();
    for (int way = 0; way < POSE_WAYS && code == 0; way++) {
        const char *name = pose_way[way].name;
        const char *text = cli_value(args, name);
        if (text && first) {
            return cli_usage(args->command, "--%s and --%s both give the pose: give one", first,
                             name);
        }
        first = text ? name : first;
        code = text ? pose_make(args, way, text, pose) : 0;
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
