/* SPDX-License-Identifier: MIT */
/* Where the solid of a curved shape is farthest in a direction: on its round wall, on one of its
   circles, or at its apex. */
#include "mesh/shape/support.h"

#include <math.h>

#include <lrcs/shape.h>

/* The meridian in the direction's half-plane gives the distance rho from the axis and the height.
   With r the component of n across the axis and z that along it, rho r + height z is largest
   - on a sphere where the normal is n;
   - on a paraboloid, rho r + z H (1 - rho^2/R^2), at rho = R r / (2 H z) R, up to its rim;
   - on a straight wall at one of its ends. */
void lrcsi_support_point(const lrcsi_support *s, const double n[3], double point[3])
{
    double z = n[2];
    double r = sqrt(n[0] * n[0] + n[1] * n[1]);
    double length = sqrt(r * r + z * z);
    double rho = s->radius;
    double height = 0;
    switch (s->kind) {
    case LRCS_SHAPE_SPHERE:
    case LRCS_SHAPE_DOME:
        if (s->kind == LRCS_SHAPE_SPHERE || z > 0) {
            rho = s->radius * (r / length);
            height = s->radius * (z / length);
        }
        break;
    case LRCS_SHAPE_CYLINDER:
        height = z > 0 ? s->length : 0;
        break;
    case LRCS_SHAPE_CONE:
        if (s->length * z > s->radius * r) {
            rho = 0;
            height = s->length;
        }
        break;
    case LRCS_SHAPE_FRUSTUM:
        if (s->radius * r + s->length * z > s->radius2 * r) {
            height = s->length;
        } else {
            rho = s->radius2;
        }
        break;
    default: /* paraboloid */
        if (2 * s->length * z > s->radius * r) {
            double fraction = s->radius * r / (2 * s->length * z);
            rho = s->radius * fraction;
            height = s->length * (1 - fraction) * (1 + fraction);
        }
    }
    point[0] = r > 0 ? rho * (n[0] / r) : rho;
    point[1] = r > 0 ? rho * (n[1] / r) : 0;
    point[2] = height;
}
