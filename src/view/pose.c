/* SPDX-License-Identifier: MIT */
/* Poses: the direction to the laser and the rotation matrix for pictures. Decides how each
   description of an attitude becomes both; matrices from angles are computed in base/rotate. */
#include <lrcs/pose.h>

#include <math.h>
#include <string.h>

#include "base/degrees.h"
#include "base/length.h"
#include "base/rotate.h"

lrcs_pose lrcs_pose_default(void)
{
    lrcs_pose pose = {{0.0, 0.0, 1.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    return pose;
}

/* The unit vector (c, s) along (x, y), however small those are; (0, 1) if both are zero, which
   makes the shortest arc from -z a rotation about x. */
static void heading(double x, double y, double out[2])
{
    const double given[2] = {x, y};
    if (lrcsi_rotate_scale(given, 2, out) != LRCS_OK) {
        out[0] = 0.0;
        out[1] = 1.0;
        return;
    }
    double length = sqrt(out[0] * out[0] + out[1] * out[1]);
    out[0] /= length;
    out[1] /= length;
}

/* The shortest arc from a unit vector (x, y, z) to (0, 0, 1):
     [1 - x^2/(1+z)   -xy/(1+z)      -x]
     [-xy/(1+z)       1 - y^2/(1+z)  -y]
     [x               y               z].
   For z < 0 the denominator cancels; with (x, y) = sin t (c, s) and z = cos t,
   x^2/(1+z) = c^2 (1-z), so the block is [s^2 + c^2 z, -c s (1-z); -c s (1-z), c^2 + s^2 z]. */
static void shortest_arc(const double s_hat[3], double R[3][3])
{
    double x = s_hat[0];
    double y = s_hat[1];
    double z = s_hat[2];
    if (z >= 0.0) {
        R[0][0] = 1.0 - x * x / (1.0 + z);
        R[1][1] = 1.0 - y * y / (1.0 + z);
        R[0][1] = 0.0 - x * y / (1.0 + z);
    } else {
        double h[2];
        heading(x, y, h);
        R[0][0] = h[1] * h[1] + h[0] * h[0] * z;
        R[1][1] = h[0] * h[0] + h[1] * h[1] * z;
        R[0][1] = 0.0 - h[0] * h[1] * (1.0 - z);
    }
    R[1][0] = R[0][1];
    R[0][2] = 0.0 - x;
    R[1][2] = 0.0 - y;
    memcpy(R[2], s_hat, sizeof R[2]);
}

int lrcs_pose_from_direction(const double direction[3], lrcs_pose *pose)
{
    double d[3];
    int status = lrcsi_rotate_scale(direction, 3, d);
    if (status != LRCS_OK) {
        return status;
    }
    memcpy(pose->direction, d, sizeof d);
    double s_hat[3] = {d[0], d[1], d[2]};
    (void)lrcsi_length_normalise(s_hat); /* it is not 0 */
    shortest_arc(s_hat, pose->R);
    return LRCS_OK;
}

int lrcs_pose_from_azel(double az_deg, double el_deg, lrcs_pose *pose)
{
    if (!isfinite(az_deg) || !isfinite(el_deg)) {
        return LRCS_E_NUMBER;
    }
    double sin_az;
    double cos_az;
    double sin_el;
    double cos_el;
    lrcsi_degrees_sincos(az_deg, &sin_az, &cos_az);
    lrcsi_degrees_sincos(el_deg, &sin_el, &cos_el);
    const double direction[3] = {cos_el * cos_az, cos_el * sin_az, sin_el};
    return lrcs_pose_from_direction(direction, pose);
}

/* A pose whose direction is the third row of R: a unit vector to rounding, so never zero. */
static int from_matrix(int status, double R[3][3], lrcs_pose *pose)
{
    if (status != LRCS_OK) {
        return status;
    }
    memcpy(pose->R, R, sizeof pose->R);
    return lrcsi_rotate_scale(R[2], 3, pose->direction);
}

int lrcs_pose_from_euler(const char *sequence, const double angles_deg[3], lrcs_pose *pose)
{
    double R[3][3];
    return from_matrix(lrcsi_rotate_euler(sequence, angles_deg, R), R, pose);
}

int lrcs_pose_from_quaternion(const double q[4], lrcs_pose *pose)
{
    double R[3][3];
    return from_matrix(lrcsi_rotate_quaternion(q, R), R, pose);
}
