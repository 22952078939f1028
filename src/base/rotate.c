/* SPDX-License-Identifier: MIT */
/* Rotation matrices. Decides how angles, axes and quaternions become nine numbers. */
#include "base/rotate.h"

#include <lrcs/status.h>

#include <math.h>
#include <string.h>

#include "base/degrees.h"
#include "base/vec3.h"

int lrcsi_rotate_scale(const double *given, int count, double *scaled)
{
    double largest = 0.0;
    for (int i = 0; i < count; i++) {
        if (!isfinite(given[i])) {
            return LRCS_E_NUMBER;
        }
        largest = fmax(largest, fabs(given[i]));
    }
    if (largest == 0.0) {
        return LRCS_E_ARGUMENT;
    }
    int exponent;
    if (frexp(largest, &exponent) == 0.5) { /* so that 1 stays 1, and (0, 0, 1) is unchanged */
        exponent--;
    }
    for (int i = 0; i < count; i++) {
        scaled[i] = ldexp(given[i], -exponent) + 0.0;
    }
    return LRCS_OK;
}

/* out = a b. Three products and two sums of numbers of magnitude at most 1: the error is at most 3
   u more than the sum of those of the factors, whose rows and columns are unit vectors. */
static void multiply(double a[3][3], double b[3][3], double out[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + 0.0;
        }
    }
}

/* The rotation about coordinate axis 0, 1 or 2. */
static void rotation_about(int axis, double deg, double R[3][3])
{
    double sine;
    double cosine;
    lrcsi_degrees_sincos(deg, &sine, &cosine);
    int j = (axis + 1) % 3;
    int k = (axis + 2) % 3;
    memset(R, 0, 9 * sizeof R[0][0]);
    R[axis][axis] = 1.0;
    R[j][j] = cosine;
    R[k][k] = cosine;
    R[j][k] = -sine;
    R[k][j] = sine;
}

/* Three coordinate axes from a sequence: 1 for intrinsic, 0 for extrinsic, negative for neither. */
static int read_sequence(const char *sequence, int axis[3])
{
    static const char letters[] = "XYZxyz";
    int upper = 0;
    for (int i = 0; i < 3; i++) {
        const char *at = sequence[i] ? strchr(letters, sequence[i]) : NULL;
        if (!at) {
            return LRCS_E_NAME;
        }
        axis[i] = (int)(at - letters) % 3;
        upper += at - letters < 3;
        if (i > 0 && axis[i] == axis[i - 1]) {
            return LRCS_E_NAME;
        }
    }
    return sequence[3] == '\0' && upper % 3 == 0 ? upper / 3 : LRCS_E_NAME;
}

int lrcsi_rotate_euler(const char *sequence, const double deg[3], double R[3][3])
{
    int axis[3];
    int intrinsic = read_sequence(sequence, axis);
    if (intrinsic < 0) {
        return LRCS_E_NAME;
    }
    if (!isfinite(deg[0]) || !isfinite(deg[1]) || !isfinite(deg[2])) {
        return LRCS_E_NUMBER;
    }
    double left[3][3];
    double middle[3][3];
    double right[3][3];
    double pair[3][3];
    int first = intrinsic ? 0 : 2;
    rotation_about(axis[first], deg[first], left);
    rotation_about(axis[1], deg[1], middle);
    rotation_about(axis[2 - first], deg[2 - first], right);
    multiply(left, middle, pair);
    multiply(pair, right, R);
    return LRCS_OK;
}

/* Rodrigues: R = c I + (1 - c) k k^T + s [k], its diagonal as k_i^2 + c (k_j^2 + k_l^2), which is
   exactly 1 about a coordinate axis. */
int lrcsi_rotate_axis(const double axis[3], double deg, double R[3][3])
{
    double k[3];
    int status = lrcsi_rotate_scale(axis, 3, k);
    if (status != LRCS_OK) {
        return status;
    }
    if (!isfinite(deg)) {
        return LRCS_E_NUMBER;
    }
    double length = sqrt(lrcsi_vec3_dot(k, k));
    for (int i = 0; i < 3; i++) {
        k[i] /= length;
    }
    double sine;
    double cosine;
    lrcsi_degrees_sincos(deg, &sine, &cosine);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int l = (i + 2) % 3;
        R[i][i] = k[i] * k[i] + cosine * (k[j] * k[j] + k[l] * k[l]) + 0.0;
        R[i][j] = (1.0 - cosine) * (k[i] * k[j]) - sine * k[l] + 0.0;
        R[j][i] = (1.0 - cosine) * (k[i] * k[j]) + sine * k[l] + 0.0;
    }
    return LRCS_OK;
}

/* With q = (w, v) and f = 2 / |q|^2: R = I + f (w [v] + v v^T - |v|^2 I). */
int lrcsi_rotate_quaternion(const double q[4], double R[3][3])
{
    double p[4];
    int status = lrcsi_rotate_scale(q, 4, p);
    if (status != LRCS_OK) {
        return status;
    }
    const double *v = p + 1;
    double f = 2.0 / (p[0] * p[0] + v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int l = (i + 2) % 3;
        R[i][i] = 1.0 - f * (v[j] * v[j] + v[l] * v[l]);
        R[i][j] = f * (v[i] * v[j] - p[0] * v[l]) + 0.0;
        R[j][i] = f * (v[i] * v[j] + p[0] * v[l]) + 0.0;
    }
    return LRCS_OK;
}
