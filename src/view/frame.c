/* SPDX-License-Identifier: MIT */
/* The axes of a view from a pose. Decides which poses are invalid, and how a rounded R is
   corrected: with d the direction and a the given first row, the axes are the unit vectors along a
   without its component along d, along d x a, and along d. */
#include "view/frame.h"

#include <math.h>
#include <string.h>

#include "scene/prepared.h"
#include "view/product.h"

/* How far R may be from a rotation: single precision suffices. */
#define ROTATION_TOLERANCE 0x1p-20

static const double zero_low[3]; /* the low parts of plain doubles */

/* The dot product is rounded once, the square root and the quotients once each: the length has an
   error of 1.5 u, and the rounded quotients add a vector of at most u. */
static void unit(const double v[3], double out[3])
{
    double length = sqrt(lrcsi_product_dot(v, zero_low, v));
    for (int k = 0; k < 3; k++) {
        out[k] = v[k] / length;
    }
}

/* Is x within `near` of y? Not if one of them is NaN. */
static int is_near(double x, double y, double near)
{
    return fabs(x - y) <= near;
}

static int pose_check(const lrcs_pose *pose)
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            if (!isfinite(pose->direction[j]) || !isfinite(pose->R[k][j])) {
                return LRCS_E_NUMBER;
            }
            if (fabs(pose->R[k][j]) > 1 + ROTATION_TOLERANCE) {
                return LRCS_E_ARGUMENT;
            }
        }
        largest = fmax(largest, fabs(pose->direction[k]));
    }
    return largest >= 0.5 && largest <= 1 ? LRCS_OK : LRCS_E_ARGUMENT;
}

/* First row: let e be the unit vector along it without its component along d. That component is due
   to rounding: u in a - t d (t is accurate to 4 u and below 2^-19) and u in the quotients. The
   length has an error of 2.5 u. Second row: d x (first row) is exactly along d x e; its components
   are rounded once, u, and `unit` adds 2.5 u. Third row: 2.5 u. All errors are below 4 u. */
int lrcsi_frame_make(const lrcs_pose *pose, double direction[3], double R[3][3])
{
    int status = pose_check(pose);
    if (status != LRCS_OK) {
        return status;
    }
    double d[3];
    double row[3];
    double made[3][3];
    for (int k = 0; k < 3; k++) {
        d[k] = fabs(pose->direction[k]) < LRCSI_COORDINATE_MIN ? 0 : pose->direction[k];
    }
    double t = lrcsi_product_dot(pose->R[0], zero_low, d) / lrcsi_product_dot(d, zero_low, d);
    for (int k = 0; k < 3; k++) {
        row[k] = pose->R[0][k] - t * d[k];
    }
    if (!is_near(t, 0, 2 * ROTATION_TOLERANCE) ||
        !is_near(lrcsi_product_dot(row, zero_low, row), 1, 4 * ROTATION_TOLERANCE)) {
        return LRCS_E_ARGUMENT;
    }
    unit(row, made[0]);
    for (int k = 0; k < 3; k++) {
        row[k] = lrcsi_product_cross(d, zero_low, made[0], (k + 1) % 3, (k + 2) % 3);
    }
    unit(row, made[1]);
    unit(d, made[2]);
    for (int k = 0; k < 9; k++) {
        if (!is_near(made[k / 3][k % 3], pose->R[k / 3][k % 3], ROTATION_TOLERANCE)) {
            return LRCS_E_ARGUMENT;
        }
    }
    memcpy(direction, d, sizeof d);
    memcpy(R, made, sizeof made);
    return LRCS_OK;
}
