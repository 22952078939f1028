/* SPDX-License-Identifier: MIT */
/* A pose rotated about an axis of the body. base/rotate computes the matrix from the axis. */
#include <lrcs/sweep.h>

#include <string.h>

#include "base/rotate.h"

/* s_hat = R^T (0, 0, 1) for v_obs = R_pose R(axis, deg) v_body: the given direction, rotated back.
   It is computed from the given direction, not from R, which is rounded. */
int lrcs_host_pose_turn(const lrcs_pose *pose, const double axis[3], double deg, lrcs_pose *turned)
{
    double turn[3][3];
    double direction[3];
    lrcs_pose made;
    int status = lrcsi_rotate_axis(axis, deg, turn);
    if (status != LRCS_OK) {
        return status;
    }
    for (int k = 0; k < 3; k++) {
        direction[k] = 0.0;
        for (int i = 0; i < 3; i++) {
            direction[k] += pose->direction[i] * turn[i][k];
        }
    }
    status = lrcs_pose_from_direction(direction, &made);
    for (int i = 0; i < 3 && status == LRCS_OK; i++) {
        for (int k = 0; k < 3; k++) {
            made.R[i][k] = 0.0;
            for (int l = 0; l < 3; l++) {
                made.R[i][k] += pose->R[i][l] * turn[l][k];
            }
        }
    }
    if (status == LRCS_OK) {
        *turned = made;
    }
    return status;
}
