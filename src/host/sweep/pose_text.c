/* SPDX-License-Identifier: MIT */
/* A pose from its text: how many numbers each kind of text has, and what is expected of them. */
#include <lrcs/plan.h>

#include <string.h>

#include "host/fail.h"
#include "host/sweep/axis.h"

enum { POSE_DIRECTION, POSE_AZEL, POSE_EULER, POSE_QUATERNION, POSE_KINDS };

/* How many numbers a kind has, what a sentence expects of their form, and of numbers of that
   form. */
static const struct {
    const char *name;
    int numbers;
    const char *form, *value;
} pose_kinds[POSE_KINDS] = {
    {"direction", 3, "x,y,z (to the laser, body frame)", "a vector that is not zero"},
    {"azel", 2, "AZ,EL in degrees", "AZ,EL in degrees"},
    {"euler", 3, "SEQ:a,b,c with SEQ three letters and a, b, c in degrees (XYZ:10,20,30)", NULL},
    {"quaternion", 4, "w,x,y,z (body to observation)", "a quaternion that is not zero"}};

int lrcs_host_pose_read(const char *kind, const char *text, lrcs_pose *pose, lrcs_host_error *error)
{
    double v[4];
    char sequence[4] = "";
    const char *numbers = text;
    int i = 0;
    while (i < POSE_KINDS && strcmp(pose_kinds[i].name, kind) != 0) {
        i++;
    }
    if (i == POSE_KINDS) {
        return lrcsi_host_fail(error, LRCS_E_NAME, "%s: not a kind of pose", kind);
    }
    if (i == POSE_EULER) {
        const char *colon = strchr(text, ':');
        int three = colon && colon - text == 3;
        memcpy(sequence, three ? text : "", three ? 3 : 0);
        numbers = three ? colon + 1 : "";
    }
    if (lrcs_host_numbers_read(numbers, v, pose_kinds[i].numbers) != LRCS_OK) {
        return lrcsi_text_refuse(error, kind, pose_kinds[i].form, text);
    }
    int status = i == POSE_DIRECTION ? lrcs_pose_from_direction(v, pose)
                 : i == POSE_AZEL    ? lrcs_pose_from_azel(v[0], v[1], pose)
                 : i == POSE_EULER   ? lrcs_pose_from_euler(sequence, v, pose)
                                     : lrcs_pose_from_quaternion(v, pose);
    if (status == LRCS_OK) {
        return LRCS_OK;
    }
    return i == POSE_EULER
               ? lrcsi_text_refuse(error, kind,
                                   "three of XYZ (intrinsic) or of xyz (extrinsic), neighbours "
                                   "different",
                                   sequence)
               : lrcsi_text_refuse(error, kind, pose_kinds[i].value, text);
}
