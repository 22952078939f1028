/* SPDX-License-Identifier: MIT */
/* Applies joint, scale, rotation and translation, in this order. Decides which of them are the
   identity and are left out, and whether the whole map is a reflection. */
#include "scene/build/place.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/outward.h"
#include "base/rotate.h"

lrcs_place lrcs_place_default(void)
{
    lrcs_place place = {
        {0.0, 0.0, 0.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, {1.0, 1.0, 1.0}};
    return place;
}

static int is_finite(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static int is_identity(const double R[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            if (R[i][j] != (i == j ? 1.0 : 0.0)) {
                return 0;
            }
        }
    }
    return 1;
}

/* The sign of det(R): for a rotation or reflection, +1 or -1 to rounding. */
static int handedness(const double R[3][3])
{
    double det = R[0][0] * (R[1][1] * R[2][2] - R[1][2] * R[2][1]) -
                 R[0][1] * (R[1][0] * R[2][2] - R[1][2] * R[2][0]) +
                 R[0][2] * (R[1][0] * R[2][1] - R[1][1] * R[2][0]);
    return (det > 0.0) - (det < 0.0);
}

int lrcsi_placer_make(const lrcs_place *place, const lrcs_joint *joint, lrcsi_placer *placer)
{
    int finite = is_finite(place->translate) && is_finite(place->scale);
    for (int i = 0; i < 3; i++) {
        finite = finite && is_finite(place->rotate[i]);
    }
    if (!finite) {
        return LRCS_E_NUMBER;
    }
    int hand = handedness(place->rotate);
    memset(placer, 0, sizeof *placer);
    placer->place = *place;
    placer->has_rotation = !is_identity(place->rotate);
    for (int i = 0; i < 3; i++) {
        hand = place->scale[i] == 0.0 ? 0 : place->scale[i] < 0.0 ? -hand : hand;
        placer->has_scale |= place->scale[i] != 1.0;
        placer->has_translation |= place->translate[i] != 0.0;
    }
    placer->reflects = hand < 0;
    if (hand == 0) {
        return LRCS_E_ARGUMENT;
    }
    if (!joint->used) {
        return LRCS_OK;
    }
    if (!is_finite(joint->origin)) {
        return LRCS_E_NUMBER;
    }
    int status = lrcsi_rotate_axis(joint->axis, joint->angle_deg, placer->joint);
    placer->has_joint = status == LRCS_OK && !is_identity((const double(*)[3])placer->joint);
    memcpy(placer->origin, joint->origin, sizeof placer->origin);
    return status;
}

static void rotate_vector(const double R[3][3], double v[3])
{
    const double x = v[0];
    const double y = v[1];
    const double z = v[2];
    for (int i = 0; i < 3; i++) {
        v[i] = R[i][0] * x + R[i][1] * y + R[i][2] * z;
    }
}

void lrcsi_placer_run(const lrcsi_placer *placer, const double given[3], double placed[3])
{
    double v[3] = {given[0], given[1], given[2]};
    if (placer->has_joint) {
        for (int i = 0; i < 3; i++) {
            v[i] -= placer->origin[i];
        }
        rotate_vector((const double(*)[3])placer->joint, v);
        for (int i = 0; i < 3; i++) {
            v[i] += placer->origin[i];
        }
    }
    for (int i = 0; placer->has_scale && i < 3; i++) {
        v[i] *= placer->place.scale[i];
    }
    if (placer->has_rotation) {
        rotate_vector((const double(*)[3])placer->place.rotate, v);
    }
    for (int i = 0; placer->has_translation && i < 3; i++) {
        v[i] += placer->place.translate[i];
    }
    memcpy(placed, v, sizeof v);
}

void lrcsi_placer_normal(const lrcsi_placer *placer, double normal[3])
{
    const double *scale = placer->place.scale;
    double smallest = fmin(fabs(scale[0]), fmin(fabs(scale[1]), fabs(scale[2])));
    if (placer->has_joint) {
        rotate_vector((const double(*)[3])placer->joint, normal);
    }
    for (int i = 0; placer->has_scale && i < 3; i++) {
        normal[i] *= smallest / scale[i];
    }
    if (placer->has_rotation) {
        rotate_vector((const double(*)[3])placer->place.rotate, normal);
    }
}

/* --- the nearest rotation --------------------------------------------------------------------- */

/* A matrix R with |R^T R - I| above this is not taken for a rounded rotation, but used as it is. */
#define ROTATION_DEFECT_MAX 0x1p-40
/* The largest ratio of two scales for which the images of normals are computed. */
#define NORMALS_RATIO_MAX 0x1p20

/* D = R^T R - I in double-double: the error of every entry is at most 2^-101. Returns its Frobenius
   norm, rounded up, or 0 if D is exactly 0. */
static double rotation_defect(const double R[3][3], lrcsi_dd D[3][3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            lrcsi_dd sum = {i == j ? -1.0 : 0.0, 0.0};
            for (int k = 0; k < 3; k++) {
                sum = lrcsi_dd_add(sum, lrcsi_dd_two_product(R[k][i], R[k][j]));
            }
            D[i][j] = sum;
            square += sum.hi * sum.hi;
        }
    }
    return square > 0.0 ? LRCSI_OUTWARD_MICRO * sqrt(square) + 0x1p-98 : 0.0;
}

/* The rotation or reflection nearest to R, the polar factor R (I + D)^(-1/2) = R (I - D/2 + (3/8)
   D^2 - ...): for |D| <= 2^-40 the next term is below 2^-121. Returns 0 if D is larger. */
static int nearest_rotation(const double R[3][3], lrcsi_dd out[3][3])
{
    lrcsi_dd D[3][3];
    lrcsi_dd root[3][3];
    if (!(rotation_defect(R, D) <= ROTATION_DEFECT_MAX)) {
        return 0;
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            lrcsi_dd square = {0.0, 0.0};
            for (int k = 0; k < 3; k++) {
                square = lrcsi_dd_add(square, lrcsi_dd_mul(D[i][k], D[k][j]));
            }
            root[i][j] = lrcsi_dd_sub(lrcsi_dd_scale(square, 0.375), lrcsi_dd_scale(D[i][j], 0.5));
            root[i][j] = lrcsi_dd_add((lrcsi_dd){i == j ? 1.0 : 0.0, 0.0}, root[i][j]);
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = (lrcsi_dd){0.0, 0.0};
            for (int k = 0; k < 3; k++) {
                out[i][j] = lrcsi_dd_add(out[i][j], lrcsi_dd_scale(root[k][j], R[i][k]));
            }
        }
    }
    return 1;
}

/* The images of a shape's axes, image[axis][component]: the joint's nearest rotation, a factor
   along each axis, the place's nearest rotation. Returns 0 if there is none near enough. */
static int images_of_axes(const lrcsi_placer *placer, const double factor[3], lrcsi_dd image[3][3])
{
    static const double identity[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    lrcsi_dd joint[3][3];
    lrcsi_dd place[3][3];
    if (!nearest_rotation(placer->has_joint ? placer->joint : identity, joint) ||
        !nearest_rotation(placer->has_rotation ? placer->place.rotate : identity, place)) {
        return 0;
    }
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            image[j][i] = (lrcsi_dd){0.0, 0.0};
            for (int k = 0; k < 3; k++) {
                lrcsi_dd term = lrcsi_dd_mul(place[i][k], joint[k][j]);
                image[j][i] = lrcsi_dd_add(image[j][i], lrcsi_dd_scale(term, factor[k]));
            }
        }
    }
    return 1;
}

int lrcsi_placer_axes(const lrcsi_placer *placer, lrcsi_axes *axes)
{
    const double *scale = placer->place.scale;
    const double sign[3] = {copysign(1.0, scale[0]), copysign(1.0, scale[1]),
                            copysign(1.0, scale[2])};
    lrcsi_dd image[3][3];
    if (fabs(scale[0]) != fabs(scale[1]) || fabs(scale[1]) != fabs(scale[2]) ||
        !images_of_axes(placer, sign, image)) {
        return 0;
    }
    axes->exact = 1;
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            double high = image[j][i].hi;
            axes->high[j][i] = high;
            axes->low[j][i] = image[j][i].lo;
            axes->exact &= image[j][i].lo == 0.0 && (high == 0.0 || fabs(high) == 1.0);
        }
    }
    return 1;
}

int lrcsi_placer_normals(const lrcsi_placer *placer, double image[3][3], double *area)
{
    const double *scale = placer->place.scale;
    const double smallest = fmin(fabs(scale[0]), fmin(fabs(scale[1]), fabs(scale[2])));
    const double largest = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    double factor[3];
    double product = largest / smallest;
    lrcsi_dd sum[3][3];
    for (int k = 0; k < 3; k++) {
        factor[k] = smallest / scale[k];
        product *= fabs(scale[k]) / largest;
    }
    if (!(largest / smallest <= NORMALS_RATIO_MAX) || !images_of_axes(placer, factor, sum)) {
        return 0;
    }
    for (int n = 0; n < 9; n++) {
        image[n / 3][n % 3] = sum[n / 3][n % 3].hi;
    }
    *area = product;
    return 1;
}

/* The singular values of a matrix R with |R^T R - I| <= d lie between the square roots of 1 - d and
   1 + d. */
void lrcsi_placer_singular_values(const lrcsi_placer *placer, double *largest, double *condition)
{
    const double *scale = placer->place.scale;
    double large = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    double small = fmin(fabs(scale[0]), fmin(fabs(scale[1]), fabs(scale[2])));
    lrcsi_dd D[3][3];
    double joint = placer->has_joint ? rotation_defect(placer->joint, D) : 0.0;
    double place = placer->has_rotation ? rotation_defect(placer->place.rotate, D) : 0.0;
    *largest = HUGE_VAL;
    *condition = HUGE_VAL;
    if (joint < 0.5 && place < 0.5) {
        *largest = large * sqrt((1.0 + joint) * (1.0 + place));
        *condition = large / small;
        *condition *= sqrt((1.0 + joint) / (1.0 - joint) * (1.0 + place) / (1.0 - place));
    }
    if (joint > 0.0 || place > 0.0 || large != small) {
        *largest *= LRCSI_OUTWARD_MICRO;
        *condition *= LRCSI_OUTWARD_MICRO;
    }
}

/* Bounds on the magnitudes of a point's coordinates, and on their errors. */
typedef struct placed_bound {
    double size, error;
} placed_bound;

/* x + t is rounded once: by at most u (|x| + error + |t|). The factor 2 covers the sums here. */
static placed_bound bound_translation(placed_bound x, const double t[3])
{
    double step = fmax(fabs(t[0]), fmax(fabs(t[1]), fabs(t[2])));
    double size = x.size + step;
    return (placed_bound){size, x.error + 2.0 * LRCSI_U * (size + x.error)};
}

/* s x is rounded once; if the result is denormal, by less than 2^-1074 more. */
static placed_bound bound_scale(placed_bound x, const double s[3])
{
    double factor = fmax(fabs(s[0]), fmax(fabs(s[1]), fabs(s[2])));
    double size = factor * x.size;
    double error = factor * x.error;
    return (placed_bound){size, error + 2.0 * LRCSI_U * (size + error) + 0x1p-1074};
}

/* R x has three products and two sums per row. Their rounding is at most 3 u (1 + 3 u) times the
   sum of the magnitudes of the products, which is at most the largest sum of |R_ij| over a row
   times the size of x. The nearest rotation differs from R by at most half of
   |R^T R - I| (1 + 2^-40), so that it takes x, whose length is at most sqrt(3) size, to a point at
   most 0.87 |R^T R - I| size away. */
static placed_bound bound_rotation(placed_bound x, const double R[3][3])
{
    lrcsi_dd D[3][3];
    double defect = rotation_defect(R, D);
    double row = 0.0;
    for (int i = 0; i < 3; i++) {
        row = fmax(row, fabs(R[i][0]) + fabs(R[i][1]) + fabs(R[i][2]));
    }
    double size = row * x.size;
    double error = row * x.error + (defect <= ROTATION_DEFECT_MAX ? 0.87 * defect * x.size : 0.0);
    return (placed_bound){size, error + 4.0 * LRCSI_U * (size + error) + 0x1p-1072};
}

double lrcsi_placer_error(const lrcsi_placer *placer, double size, double error)
{
    placed_bound x = {size, error};
    if (placer->has_joint) {
        x = bound_translation(x, placer->origin);
        x = bound_rotation(x, (const double(*)[3])placer->joint);
        x = bound_translation(x, placer->origin);
    }
    if (placer->has_scale) {
        x = bound_scale(x, placer->place.scale);
    }
    if (placer->has_rotation) {
        x = bound_rotation(x, (const double(*)[3])placer->place.rotate);
    }
    if (placer->has_translation) {
        x = bound_translation(x, placer->place.translate);
    }
    /* At most sqrt(3) times the error of a coordinate. */
    return LRCSI_ROOT_3_OUTWARD * x.error;
}
