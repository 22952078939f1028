/* SPDX-License-Identifier: MIT */
/* The derivatives of sigma in attitude, as central difference quotients of poses with proved
   bounds. The bound of a quotient with step h is the sum of the bounds of its two poses, divided by
   2 h. Its deviation from the derivative is estimated by its difference from the quotient with step
   2 h. (sigma is continuous, and differentiable except at kinks, where a facet becomes edge-on or
   an edge passes a corner.) */
#include <lrcs/uncertainty.h>

#include <math.h>

#include "base/constant.h"
#include "base/degrees.h"
#include "base/outward.h"
#include "base/vec3.h"

/* A heuristic: wide enough that bounds of some 1e-7 of sigma leave the quotient a few digits, and
   narrow beside the widths of most glints. How well it suits a pose is estimated. */
#define STEP_DEG 0.01

/* The pose after a rotation of the body by `deg` degrees about the observation axis x (0) or y (1):
   v_obs' = Rx(deg) v_obs or Ry(deg) v_obs. */
static void pose_turn(const lrcs_pose *pose, int axis, double deg, lrcs_pose *turned)
{
    const double *d = pose->direction;
    double length = sqrt(lrcsi_vec3_dot(d, d));
    double sine = 0;
    double cosine = 1;
    lrcsi_degrees_sincos(deg, &sine, &cosine);
    *turned = *pose;
    for (int k = 0; k < 3; k++) {
        double z = d[k] / length;
        double other = pose->R[1 - axis][k];
        /* about x: y' = c y - s z, z' = s y + c z; about y: x' = c x + s z, z' = -s x + c z */
        double sign = axis == 0 ? 1 : -1;
        turned->R[1 - axis][k] = cosine * other - sign * sine * z;
        turned->R[2][k] = turned->direction[k] = sign * sine * other + cosine * z;
    }
}

int lrcs_attitude_slope_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                            const lrcs_run_options *options, lrcs_work *work,
                            lrcs_attitude_slope *slope)
{
    lrcs_attitude_slope out = {{0, 0}, {0, 0}, {0, 0}};
    lrcs_run_options turned_options = *options;
    turned_options.part_error_m2 = NULL; /* of the pose itself, not of turned ones */
    for (int axis = 0; axis < 2; axis++) {
        double quotient[2];
        for (int wide = 0; wide < 2; wide++) {
            double step = wide ? 2 * STEP_DEG : STEP_DEG;
            lrcs_result end[2];
            for (int i = 0; i < 2; i++) {
                lrcs_pose turned;
                pose_turn(pose, axis, i ? step : -step, &turned);
                int status =
                    lrcs_sigma_run(prepared, &turned, &turned_options, work, &end[i], NULL, NULL);
                if (status != LRCS_OK) {
                    return status;
                }
            }
            quotient[wide] = (end[1].sigma_m2 - end[0].sigma_m2) / (2 * step);
            if (!wide) {
                out.bound_m2[axis] =
                    (end[0].bound_m2 + end[1].bound_m2) / (2 * step) * LRCSI_OUTWARD(8) +
                    4 * LRCSI_U * fabs(quotient[wide]); /* of the quotient */
            }
        }
        out.per_deg_m2[axis] = quotient[0];
        out.estimate_m2[axis] = fabs(quotient[1] - quotient[0]);
    }
    *slope = out;
    return LRCS_OK;
}
