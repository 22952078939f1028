/* SPDX-License-Identifier: MIT */
/* Boxes parallel to the axes: made empty, grown by points, made around a facet. */
#ifndef LRCSI_BOX_H
#define LRCSI_BOX_H

#include <math.h>

#include <lrcs/mesh.h>

#include "base/range.h"

typedef struct lrcsi_box {
    double low[3], high[3];
} lrcsi_box;

/* A box without points: low > high. */
static inline lrcsi_box lrcsi_box_empty(void)
{
    return (lrcsi_box){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

/* Grows a box to contain a point. */
static inline void lrcsi_box_add(lrcsi_box *box, const double x[3])
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = lrcsi_min(x[k], box->low[k]);
        box->high[k] = lrcsi_max(x[k], box->high[k]);
    }
}

/* The longest side of a box that is not empty. */
static inline double lrcsi_box_side(const lrcsi_box *box)
{
    double side = 0.0;
    for (int k = 0; k < 3; k++) {
        side = lrcsi_max(side, box->high[k] - box->low[k]);
    }
    return side;
}

/* The box around a facet. */
static inline lrcsi_box lrcsi_box_of(const lrcs_point *vertex, const lrcs_facet *facet)
{
    const double *a = vertex[facet->corner[0]].x;
    const double *b = vertex[facet->corner[1]].x;
    const double *c = vertex[facet->corner[2]].x;
    lrcsi_box box;
    for (int k = 0; k < 3; k++) {
        box.low[k] = lrcsi_min(lrcsi_min(a[k], b[k]), c[k]);
        box.high[k] = lrcsi_max(lrcsi_max(a[k], b[k]), c[k]);
    }
    return box;
}

#endif
