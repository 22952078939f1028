/* SPDX-License-Identifier: MIT */
/* The pose options: at most one may be given; without one the laser is on +z. */
#include "cli/cli.h"

#include <math.h>
#include <string.h>

static int pose_direction(const cli_command *command, const char *text, lrcs_pose *pose)
{
    double v[3];
    if (cli_list(text, v, 3) != 0) {
        return cli_usage(
            command, "--direction: expected x,y,z (to the laser, body frame), found '%s'", text);
    }
    if (lrcs_pose_from_direction(v, pose) != LRCS_OK) {
        return cli_usage(command, "--direction: expected a vector that is not zero, found '%s'",
                         text);
    }
    return 0;
}

static int pose_azel(const cli_command *command, const char *text, lrcs_pose *pose)
{
    double v[2];
    if (cli_list(text, v, 2) != 0 || lrcs_pose_from_azel(v[0], v[1], pose) != LRCS_OK) {
        return cli_usage(command, "--azel: expected AZ,EL in degrees, found '%s'", text);
    }
    return 0;
}

static int pose_euler(const cli_command *command, const char *text, lrcs_pose *pose)
{
    const char *colon = strchr(text, ':');
    char sequence[4] = "";
    double v[3];
    if (!colon || colon - text != 3 || cli_list(colon + 1, v, 3) != 0) {
        return cli_usage(command,
                         "--euler: expected SEQ:a,b,c with SEQ three letters and a, b, c in degrees"
                         " (XYZ:10,20,30), found '%s'",
                         text);
    }
    memcpy(sequence, text, 3);
    int status = lrcs_pose_from_euler(sequence, v, pose);
    if (status == LRCS_E_NAME) {
        return cli_usage(command,
                         "--euler: expected three of XYZ (intrinsic) or of xyz (extrinsic), "
                         "neighbours different, found '%s'",
                         sequence);
    }
    return status == LRCS_OK ? 0 : cli_usage(command, "--euler: %s", lrcs_status_text(status));
}

static int pose_quaternion(const cli_command *command, const char *text, lrcs_pose *pose)
{
    double v[4];
    if (cli_list(text, v, 4) != 0) {
        return cli_usage(command,
                         "--quaternion: expected w,x,y,z (body to observation), found '%s'", text);
    }
    if (lrcs_pose_from_quaternion(v, pose) != LRCS_OK) {
        return cli_usage(command, "--quaternion: expected one that is not zero, found '%s'", text);
    }
    return 0;
}

int cli_pose_read(const cli_args *args, lrcs_pose *pose)
{
    static const struct {
        const char *name;
        int (*read)(const cli_command *command, const char *text, lrcs_pose *pose);
    } way[] = {{"direction", pose_direction},
               {"azel", pose_azel},
               {"euler", pose_euler},
               {"quaternion", pose_quaternion}};
    const char *first = NULL;
    *pose = lrcs_pose_default();
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        const char *text = cli_value(args, way[i].name);
        if (text && first) {
            return cli_usage(args->command, "--%s and --%s both give the pose: give one", first,
                             way[i].name);
        }
        first = text ? way[i].name : first;
        int code = text ? way[i].read(args->command, text, pose) : 0;
        if (code != 0) {
            return code;
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
