/* SPDX-License-Identifier: MIT */
/* On which side of a directed segment of the view a point lies, decided from view coordinates in
   plain doubles if their errors allow it. */
#ifndef LRCSI_SIDE_H
#define LRCSI_SIDE_H

#include <math.h>

#include "base/vec3.h"
#include "view/view.h"

/* A sign that plain doubles do not decide. */
enum { LRCSI_VIEW_UNDECIDED = 2 };

/* A segment of the view: start, direction, and their errors. */
typedef struct lrcsi_view_side {
    double at[2], to[2];
    double length; /* of `to`, in the 1-norm */
    double at_err; /* bound on the error of `at`, in each coordinate */
    double to_err; /* of `to` */
} lrcsi_view_side;

static inline lrcsi_view_side lrcsi_view_side_of(const lrcsi_view *view, uint32_t a, uint32_t b)
{
    const double *p = view->point[a].x;
    const double *q = view->point[b].x;
    double err = view->point[a].err;
    lrcsi_view_side side = {
        {p[0], p[1]}, {q[0] - p[0], q[1] - p[1]}, 0, err, err + view->point[b].err};
    side.length = fabs(side.to[0]) + fabs(side.to[1]);
    return side;
}

/* The error of p x q in the view, where p and q are differences of positions with the given lengths
   in the 1-norm and errors in each coordinate, which include rounding (lrcsi_view_point_err): with
   errors e and f it is e |q| + f |p| + 2 e f, and rounding of 2 u |p| |q| is below a fifth of that,
   because e is at least 10 u |p|. */
static inline double lrcsi_view_cross_err(double p_length, double p_err, double q_length,
                                          double q_err)
{
    return 1.5 * (p_err * (q_length + 2 * q_err) + q_err * p_length);
}

/* Given: a point x with an error of err in each coordinate. Returned: 1 if it lies to the left of
   the segment's line, -1 if to the right, or LRCSI_VIEW_UNDECIDED. */
static inline int lrcsi_view_side_orient(const lrcsi_view_side *side, const double *x, double err)
{
    const double q[2] = {x[0] - side->at[0], x[1] - side->at[1]};
    double cross = lrcsi_vec2_cross(side->to, q);
    double cross_err = lrcsi_view_cross_err(side->length, side->to_err, fabs(q[0]) + fabs(q[1]),
                                            side->at_err + err);
    return cross > cross_err ? 1 : cross < -cross_err ? -1 : LRCSI_VIEW_UNDECIDED;
}

#endif
