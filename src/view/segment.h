/* SPDX-License-Identifier: MIT */
/* The range of x of segments of the view plane within a range of y. The errors of their ends may
   differ by many orders of magnitude. */
#ifndef LRCSI_SEGMENT_H
#define LRCSI_SEGMENT_H

#include "base/range.h"
#include "view/view.h"

/* The point from + t to, 0 <= t <= 1, has an error of at most err + t err_growth along each axis.
 */
typedef struct lrcsi_view_segment {
    double from[2], to[2];
    double err, err_growth;
} lrcsi_view_segment;

/* The segment between two vertices of the view, in units of 1 / scale. It begins at the point with
   the smaller error. Errors are multiplied by four, and `rounding` is added: together these must
   cover the rounding of everything that is computed from the segment. */
static inline lrcsi_view_segment lrcsi_view_segment_make(const lrcsi_view_vertex *a,
                                                         const lrcsi_view_vertex *b, double scale,
                                                         double rounding)
{
    const lrcsi_view_vertex *near = a->err <= b->err ? a : b;
    const lrcsi_view_vertex *far = a->err <= b->err ? b : a;
    double err = 4 * near->err;
    return (lrcsi_view_segment){
        {near->x[0] * scale, near->x[1] * scale},
        {(far->x[0] - near->x[0]) * scale, (far->x[1] - near->x[1]) * scale},
        err * scale + rounding,
        (4 * far->err - err) * scale};
}

/* Narrows the range of t to where value + t slope is not negative. */
static inline void lrcsi_view_segment_narrow(double value, double slope, double range[2])
{
    if (slope > 0) {
        range[0] = lrcsi_max(range[0], -value / slope);
    } else if (slope < 0) {
        range[1] = lrcsi_min(range[1], -value / slope);
    } else if (value < 0) {
        range[1] = -1;
    }
}

/* The range of x of the points that may have low <= y <= high. Returns 0 if there are none.
   Positions and their errors are linear in t, so that extrema are at the ends of the range of t. */
static inline int lrcsi_view_segment_range(const lrcsi_view_segment *s, double low, double high,
                                           double x[2])
{
    double t[2] = {0, 1};
    if (low > -HUGE_VAL) {
        lrcsi_view_segment_narrow(s->from[1] + s->err - low, s->to[1] + s->err_growth, t);
    }
    if (high < HUGE_VAL) {
        lrcsi_view_segment_narrow(high - s->from[1] + s->err, s->err_growth - s->to[1], t);
    }
    if (!(t[0] <= t[1])) {
        return 0;
    }
    x[0] = HUGE_VAL;
    x[1] = -HUGE_VAL;
    for (int i = 0; i < 2; i++) {
        double at = s->from[0] + t[i] * s->to[0];
        double err = s->err + t[i] * s->err_growth;
        x[0] = lrcsi_min(x[0], at - err);
        x[1] = lrcsi_max(x[1], at + err);
    }
    return 1;
}

/* The same for all points of several segments, as of the sides of a polygon. */
static inline int lrcsi_view_segments_range(const lrcsi_view_segment *segment, int count,
                                            double low, double high, double x[2])
{
    x[0] = HUGE_VAL;
    x[1] = -HUGE_VAL;
    for (int i = 0; i < count; i++) {
        double range[2];
        if (lrcsi_view_segment_range(&segment[i], low, high, range)) {
            x[0] = lrcsi_min(x[0], range[0]);
            x[1] = lrcsi_max(x[1], range[1]);
        }
    }
    return x[0] <= x[1];
}

#endif
