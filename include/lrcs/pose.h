/* SPDX-License-Identifier: MIT */
/* The direction to the laser and the attitude of the body.
   Observation frame o-xyz: z points to the laser. R maps body to observation coordinates,
   v_obs = R v_body, so the direction to the laser in the body frame is R^T (0, 0, 1). */
#ifndef LRCS_POSE_H
#define LRCS_POSE_H

#include <lrcs/status.h>

/* The proved bound takes `direction` as exact: s_hat = direction / |direction|. Only the roll about
   s_hat is taken from R; it orients pictures and samples. Runs use the first row of R and recompute
   the axes, so that rounding errors in R have no effect. Every function that takes a pose rejects
   an invalid one: LRCS_E_NUMBER if a number is not finite; LRCS_E_ARGUMENT if the largest component
   of the direction is not in [0.5, 1], or if R differs by more than 2^-20 from a rotation that
   takes s_hat to z (a rotation in single precision is accurate enough). */
typedef struct lrcs_pose {
    double direction[3]; /* body frame, to the laser; |largest| in [0.5, 1]; components below
                            2^-300 in magnitude count as 0 */
    double R[3][3];      /* rows: observation x, y, z axes in the body frame */
} lrcs_pose;

/* The initial attitude: laser on +z, R the identity. */
lrcs_pose lrcs_pose_default(void);

/* From a direction in the body frame, any length. R is the rotation along the shortest arc; for -z
   a rotation by 180 deg about x. The direction is scaled by a power of two only.
   Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (zero). */
int lrcs_pose_from_direction(const double direction[3], lrcs_pose *pose);

/* From azimuth and elevation, deg, body frame: s_hat = (cos EL cos AZ, cos EL sin AZ, sin EL).
   Any elevation is taken: beyond 90 deg it goes on over the pole, (30, 100) is (210, 80). Degrees
   are reduced exactly: (0, 90) is exactly +z. Status: LRCS_OK; LRCS_E_NUMBER (not
   finite). */
int lrcs_pose_from_azel(double az_deg, double el_deg, lrcs_pose *pose);

/* From three Euler angles, deg. sequence: three letters of xyz, uppercase intrinsic, lowercase
   extrinsic, not mixed, neighbours different: "XYZ" means R = Rx(a) Ry(b) Rz(c), "xyz" means
   R = Rz(c) Ry(b) Rx(a). Status: LRCS_OK; LRCS_E_NAME (sequence); LRCS_E_NUMBER (not finite). */
int lrcs_pose_from_euler(const char *sequence, const double angles_deg[3], lrcs_pose *pose);

/* From a quaternion (w, x, y, z), Hamilton, body to observation; normalised here.
   Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (zero). */
int lrcs_pose_from_quaternion(const double q[4], lrcs_pose *pose);

#endif
