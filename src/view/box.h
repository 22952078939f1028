/* SPDX-License-Identifier: MIT */
/* Boxes of what stands in a view, in floats: so many of them are passed over that their size
   matters. They are bounds in doubles (lrcsi_view_bounds), rounded and kept within what a float
   holds: neither changes the order of two numbers, unless to make them equal. So two boxes that lie
   apart prove that their bounds do, and no margin is called for. */
#ifndef LRCSI_VIEW_BOX_H
#define LRCSI_VIEW_BOX_H

#include "base/range.h"
#include "view/view.h"
#include <float.h>

/* In units of 1 / view->scale, so that the bulk of the scene fills [-1, 1] whatever stands far
   away: x right, y up, z to the laser. */
typedef struct lrcsi_view_box {
    float low[3], high[3];
} lrcsi_view_box;

static inline float lrcsi_view_box_float(double x)
{
    return (float)lrcsi_least((double)FLT_MAX, lrcsi_most(-(double)FLT_MAX, x));
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

/* The box of a point of view coordinates x, each off by at most `off`. */
static inline lrcsi_view_box lrcsi_view_box_about(const lrcsi_view *view, const double x[3],
                                                  double off)
{
    const double low[3] = {x[0] - off, x[1] - off, x[2] - off};
    const double high[3] = {x[0] + off, x[1] + off, x[2] + off};
    return lrcsi_view_box_round(view, low, high);
}

/* Do they lie beside each other in the view? */
static inline int lrcsi_view_box_beside(const lrcsi_view_box *a, const lrcsi_view_box *b)
{
    return a->high[0] < b->low[0] || a->low[0] > b->high[0] || a->high[1] < b->low[1] ||
           a->low[1] > b->high[1];
}

/* Is all of a farther from the laser than all of b? */
static inline int lrcsi_view_box_behind(const lrcsi_view_box *a, const lrcsi_view_box *b)
{
    return a->high[2] < b->low[2];
}

#endif
