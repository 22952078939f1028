/* SPDX-License-Identifier: MIT */
/* Rotation matrices from angles, axes and quaternions, for poses and for placing parts.
   Each entry of R has an absolute error of at most 8 u (u = 2^-53) given the inputs as exact;
   multiples of 90 deg about a coordinate axis are exact; no entry is a negative zero. */
#ifndef LRCSI_ROTATE_H
#define LRCSI_ROTATE_H

/* Scales `count` numbers by one power of two so that the largest magnitude lies in (1/2, 1];
   exact except for numbers that underflow relative to the largest one.
   Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (all zero). */
int lrcsi_rotate_scale(const double *given, int count, double *scaled);

/* Three letters of xyz, neighbours different, all uppercase (intrinsic: "XYZ" is
   Rx(a) Ry(b) Rz(c)) or all lowercase (extrinsic: "xyz" is Rz(c) Ry(b) Rx(a)).
   Status: LRCS_OK; LRCS_E_NAME (sequence); LRCS_E_NUMBER. */
int lrcsi_rotate_euler(const char *sequence, const double deg[3], double R[3][3]);

/* Right-handed, about an axis of any length. Status: as lrcsi_rotate_scale for the axis;
   LRCS_E_NUMBER for the angle. */
int lrcsi_rotate_axis(const double axis[3], double deg, double R[3][3]);

/* v -> q v q* for q = (w, x, y, z), Hamilton, of any length. Status: as lrcsi_rotate_scale. */
int lrcsi_rotate_quaternion(const double q[4], double R[3][3]);

#endif
