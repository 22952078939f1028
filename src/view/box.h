/* SPDX-License-Identifier: MIT */
/* Bounding boxes in a view, in floats: loops pass over so many of them that their size matters. A
   box has the bounds in doubles (lrcsi_view_bounds), rounded to float and clamped to its range.
   Both are monotonic: they never reverse the order of two numbers, though they can make them equal.
   So if two boxes are disjoint, their bounds in doubles are disjoint, and no margin is needed. */
#ifndef LRCSI_VIEW_BOX_H
#define LRCSI_VIEW_BOX_H

#include "base/range.h"
#include "view/view.h"
#include <float.h>

/* In units of 1 / view->scale, so that the bulk of the scene fills [-1, 1] even if some parts are
   far away: x right, y up, z to the laser. */
typedef struct lrcsi_view_box {
    float low[3], high[3];
} lrcsi_view_box;

static inline float lrcsi_view_box_float(double x)
{
    return (float)lrcsi_min((double)FLT_MAX, lrcsi_max(-(double)FLT_MAX, x));
}

/* The box of bounds. */
static inline lrcsi_view_box lrcsi_view_box_round(const lrcsi_view *view, const double low[3],
                                                  const double high[3])
{
    double scale = view->scale;
    return (lrcsi_view_box){
        {lrcsi_view_box_float(low[0] * scale), lrcsi_view_box_float(low[1] * scale),
         lrcsi_view_box_float(low[2] * scale)},
        {lrcsi_view_box_float(high[0] * scale), lrcsi_view_box_float(high[1] * scale),
         lrcsi_view_box_float(high[2] * scale)}};
}

/* The box of some vertices. */
static inline lrcsi_view_box lrcsi_view_box_of(const lrcsi_view *view, const uint32_t *vertex,
                                               int count)
{
    double low[3];
    double high[3];
    lrcsi_view_bounds(view, vertex, count, low, high);
    return lrcsi_view_box_round(view, low, high);
}

/* The box of a point with view coordinates x, each with an error of at most `err`. */
static inline lrcsi_view_box lrcsi_view_box_about(const lrcsi_view *view, const double x[3],
                                                  double err)
{
    const double low[3] = {x[0] - err, x[1] - err, x[2] - err};
    const double high[3] = {x[0] + err, x[1] + err, x[2] + err};
    return lrcsi_view_box_round(view, low, high);
}

/* 1 if the two boxes are disjoint in the view plane, else 0. */
static inline int lrcsi_view_box_beside(const lrcsi_view_box *a, const lrcsi_view_box *b)
{
    return a->high[0] < b->low[0] || a->low[0] > b->high[0] || a->high[1] < b->low[1] ||
           a->low[1] > b->high[1];
}

/* 1 if all of a is farther from the laser than all of b, else 0. */
static inline int lrcsi_view_box_behind(const lrcsi_view_box *a, const lrcsi_view_box *b)
{
    return a->high[2] < b->low[2];
}

#endif
