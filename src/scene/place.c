/* SPDX-License-Identifier: MIT */
/* Joint, scale, rotation, translation, in this order. Decides which of them are the identity and
   are left out, and whether the whole mirrors. */
#include "scene/place.h"

#include <math.h>
#include <string.h>

#include "base/rotate.h"

lrcs_place lrcs_place_default(void)
{
    lrcs_place place = {{0.0, 0.0, 0.0},
                        {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
                        {1.0, 1.0, 1.0}};
    return place;
}

static int all_finite(const double *number, int count)
{
    for (int i = 0; i < count; i++) {
        if (!isfinite(number[i])) {
            return 0;
        }
    }
    return 1;
}

static int is_identity(const double R[3][3])
{
    for (int i = 0; i < 9; i++) {
        if (R[i / 3][i % 3] != (i % 4 == 0 ? 1.0 : 0.0)) {
            return 0;
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

static int make_joint(const lrcs_joint *joint, lrcsi_placer *placer)
{
    if (!joint->used) {
        return LRCS_OK;
    }
    if (!all_finite(joint->origin, 3)) {
        return LRCS_E_NUMBER;
    }
    int status = lrcsi_rotate_axis(joint->axis, joint->angle_deg, placer->joint);
    placer->turns = status == LRCS_OK && !is_identity((const double(*)[3])placer->joint);
    memcpy(placer->origin, joint->origin, sizeof placer->origin);
    return status;
}

int lrcsi_placer_make(const lrcs_place *place, const lrcs_joint *joint, lrcsi_placer *placer)
{
    if (!all_finite(place->translate, 3) || !all_finite(place->scale, 3) ||
        !all_finite(place->rotate[0], 3) || !all_finite(place->rotate[1], 3) ||
        !all_finite(place->rotate[2], 3)) {
        return LRCS_E_NUMBER;
    }
    int hand = handedness(place->rotate);
    memset(placer, 0, sizeof *placer);
    placer->place = *place;
    placer->rotates = !is_identity(place->rotate);
    for (int i = 0; i < 3; i++) {
        hand = place->scale[i] == 0.0 ? 0 : place->scale[i] < 0.0 ? -hand : hand;
        placer->scales |= place->scale[i] != 1.0;
        placer->moves |= place->translate[i] != 0.0;
    }
    placer->flips = hand < 0;
    return hand == 0 ? LRCS_E_ARGUMENT : make_joint(joint, placer);
}

static void turn(const double R[3][3], double v[3])
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
    if (placer->turns) {
        for (int i = 0; i < 3; i++) {
            v[i] -= placer->origin[i];
        }
        turn((const double(*)[3])placer->joint, v);
        for (int i = 0; i < 3; i++) {
            v[i] += placer->origin[i];
        }
    }
    for (int i = 0; placer->scales && i < 3; i++) {
        v[i] *= placer->place.scale[i];
    }
    if (placer->rotates) {
        turn((const double(*)[3])placer->place.rotate, v);
    }
    for (int i = 0; placer->moves && i < 3; i++) {
        v[i] += placer->place.translate[i];
    }
    memcpy(placed, v, sizeof v);
}
