/* SPDX-License-Identifier: MIT */
/* The axes of a view: those of a pose, checked, and recomputed as accurately as doubles allow. */
#ifndef LRCSI_FRAME_H
#define LRCSI_FRAME_H

#include <lrcs/pose.h>

/* The direction, with components below 2^-300 set to zero, and the observation frame's axes; only
   the roll is taken from the pose's R. The rows of R, as vectors, differ by at most 4 u from those
   of an exact rotation that takes the direction to z.
   Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (a direction whose largest component
   is not in 0.5 .. 1, or an R that is not a rotation which takes it to z, to 2^-20). */
int lrcsi_frame_make(const lrcs_pose *pose, double direction[3], double R[3][3]);

#endif
