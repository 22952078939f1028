/* SPDX-License-Identifier: MIT */
/* Is a point inside the facets of a convex part, or inside its true solid? The former by all of its
   facets, the latter by the dimensions of the shape. */
#ifndef TEST_INSIDE_H
#define TEST_INSIDE_H

#include <math.h>

#include "base/vec3.h"
#include "scene/prepared.h"

/* Coordinates in the frame of a part, m. */
static inline void to_part(const lrcs_prepared *p, const lrcs_part *part, const double x[3],
                           double at[3])
{
    const double from[3] = {ldexp(x[0], p->exponent) - part->origin[0],
                            ldexp(x[1], p->exponent) - part->origin[1],
                            ldexp(x[2], p->exponent) - part->origin[2]};
    for (int i = 0; i < 3; i++) {
        at[i] = lrcsi_vec3_dot(part->axis[i], from);
    }
}

/* The radius of a wall at a height, by the dimensions of the shape. */
static inline double true_radius(const lrcs_shape *shape, double z)
{
    const double low = shape->kind == LRCS_SHAPE_FRUSTUM ? shape->radius2 : shape->radius;
    const double high = shape->kind == LRCS_SHAPE_CONE ? 0 : shape->radius;
    return low + (high - low) * (z / shape->length);
}

static inline int is_in_shape(const lrcs_prepared *p, const lrcs_part *part, const double x[3])
{
    double at[3];
    to_part(p, part, x, at);
    if (part->kind == LRCS_SHAPE_BOX) {
        const double *size = part->shape.size;
        return fabs(at[0]) <= 0.5 * size[0] && fabs(at[1]) <= 0.5 * size[1] &&
               fabs(at[2]) <= 0.5 * size[2];
    }
    return at[2] >= 0 && at[2] <= part->shape.length &&
           hypot(at[0], at[1]) <= true_radius(&part->shape, at[2]);
}

static inline int is_in_facets(const lrcs_prepared *p, const lrcs_part *part, const double x[3])
{
    int in = 1;
    for (uint32_t g = part->first_facet; g < part->first_facet + part->facet_count && in; g++) {
        double from[3];
        lrcsi_vec3_between(lrcsi_prepared_corner(p, g, 0), x, from);
        in = lrcsi_vec3_dot(p->normal[g].high, from) <= 0;
    }
    return in;
}

#endif
