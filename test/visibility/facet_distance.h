/* SPDX-License-Identifier: MIT */
/* The distance of facets and edges in projection, by elementary geometry. */
#ifndef TEST_FACET_DISTANCE_H
#define TEST_FACET_DISTANCE_H

#include <math.h>

#include "view/view.h"

/* The distance of a point from the segment a b, in projection. */
static inline double point_distance(const double x[3], const double a[3], const double b[3])
{
    double along[2] = {b[0] - a[0], b[1] - a[1]};
    double square = along[0] * along[0] + along[1] * along[1];
    double t = square > 0 ? ((x[0] - a[0]) * along[0] + (x[1] - a[1]) * along[1]) / square : 0;
    t = fmin(1, fmax(0, t));
    return hypot(a[0] + t * along[0] - x[0], a[1] + t * along[1] - x[1]);
}

static inline double cross(const double a[3], const double b[3], const double x[3])
{
    return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
}

/* The distance of two segments; 0 if they intersect. */
static inline double segment_distance(const double p[3], const double q[3], const double a[3],
                                      const double b[3])
{
    if (cross(p, q, a) * cross(p, q, b) < 0 && cross(a, b, p) * cross(a, b, q) < 0) {
        return 0;
    }
    return fmin(fmin(point_distance(p, a, b), point_distance(q, a, b)),
                fmin(point_distance(a, p, q), point_distance(b, p, q)));
}

/* The distance of a facet and an edge in projection. */
static inline double facet_distance(const lrcsi_view *view, uint32_t facet, const lrcsi_edge *e)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double *p = view->point[e->low].x;
    const double *q = view->point[e->high].x;
    double nearest = HUGE_VAL;
    int left = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = view->point[corner[k]].x;
        const double *b = view->point[corner[(k + 1) % 3]].x;
        nearest = fmin(nearest, segment_distance(p, q, a, b));
        double turn = cross(a, b, p);
        left += (turn > 0) - (turn < 0);
    }
    return left == 3 || left == -3 ? 0 : nearest; /* it begins inside */
}

#endif
