/* SPDX-License-Identifier: MIT */
/* Where edge functions cross a row of pixels. It decides nothing where doubles cannot tell: whom a
   sample near a side belongs to is asked of visibility/sample.h.

   Over a pixel an edge function differs from its value at the centre by at most
   bend = (|along| + |up|) / 2. So what is touched is bounded by where it passes -off - bend, what
   may be covered, is sure and is whole by -off, off and off + bend. With `row` its value at the
   row's left end, it passes a limit at (limit - row) / along, and pixel x has its centre at x +
   1/2. As computed that is off by at most 4 u of its parts, which moves the value by at most 4 u
   (|row| + |limit|) <= 10 u N h + off / 16 for a box of half perimeter h on N x N pixels: less than
   off / 4, for off is at least 64 u N (h + 2), of which an edge function's own error takes 5 / 8
   (visibility/raster.c). So limits of -off and off still err on the safe side. */
#include "visibility/span.h"

#include <math.h>

#include "base/range.h"

/* Of a number from 0 to below 2^32. */
static inline uint32_t round_up(double x)
{
    uint32_t down = (uint32_t)x;
    return down + (down < x);
}

/* Half of what an edge function changes over a pixel, in all. */
static double side_bend(const lrcsi_edges *e, int k)
{
    return 0.5 * (fabs(e->along[k]) + fabs(e->up[k]));
}

void lrcsi_span_segment(const double *a, const double *b, double bottom, double top, double margin,
                        double range[2])
{
    double rise = b[1] - a[1];
    double t0 = 0;
    double t1 = 1;
    if (fabs(rise) > margin) {
        double u = (bottom - a[1]) / rise;
        double v = (top - a[1]) / rise;
        t0 = lrcsi_least(1, lrcsi_most(0, lrcsi_least(u, v)));
        t1 = lrcsi_least(1, lrcsi_most(0, lrcsi_most(u, v)));
    }
    double x0 = a[0] + t0 * (b[0] - a[0]);
    double x1 = a[0] + t1 * (b[0] - a[0]);
    range[0] = lrcsi_least(x0, x1);
    range[1] = lrcsi_most(x0, x1);
}

void lrcsi_span_prepare(lrcsi_edges *edges)
{
    for (int k = 0; k < 3; k++) {
        double over = fabs(edges->along[k]) > 0x1p-1000 ? 1 / edges->along[k] : 0;
        edges->over[k] = over;
        edges->near[k] = 0.5 + edges->off * fabs(over);
        edges->far[k] = 0.5 + (edges->off + side_bend(edges, k)) * fabs(over);
    }
}

static inline lrcsi_pixels span_of(uint32_t x0, uint32_t x1)
{
    return (lrcsi_pixels){x0 < x1 ? x0 : x1, x1};
}

/* Pixels from the first that is not left of `from` to the last that is not right of `to`. */
static inline lrcsi_pixels outer_span(double from, double to, double x0, double x1)
{
    return span_of(round_up(lrcsi_least(from, x1)), (uint32_t)lrcsi_most(to, x0));
}

/* Pixels right of `from` and left of `to`, within others. */
static inline lrcsi_pixels inner_span(double from, double to, lrcsi_pixels outer)
{
    return span_of((uint32_t)lrcsi_most(lrcsi_least(from, outer.x1), outer.x0),
                   round_up(lrcsi_least(lrcsi_most(to, outer.x0), outer.x1)));
}

/* One side of an edge at a time. A side along the row tells of all its pixels at once. */
lrcsi_row lrcsi_span_row(const lrcsi_edges *e, uint32_t y)
{
    double touched[2] = {e->left, e->right};
    double sure[2] = {e->x0, e->x1};
    double whole[2] = {e->x0, e->x1};
    for (int k = 0; k < 3; k++) {
        double row = e->at[k] + e->up[k] * (y + 0.5);
        double zero = -row * e->over[k];
        if (e->over[k] > 0) {
            touched[0] = lrcsi_most(touched[0], zero - e->far[k]);
            sure[0] = lrcsi_most(sure[0], zero + e->near[k]);
            whole[0] = lrcsi_most(whole[0], zero + e->far[k]);
        } else if (e->over[k] < 0) {
            touched[1] = lrcsi_least(touched[1], zero + e->far[k]);
            sure[1] = lrcsi_least(sure[1], zero - e->near[k]);
            whole[1] = lrcsi_least(whole[1], zero - e->far[k]);
        } else {
            double far = e->off + side_bend(e, k);
            touched[1] = row < -far ? 0 : touched[1];
            sure[1] = row > e->off ? sure[1] : 0;
            whole[1] = row > far ? whole[1] : 0;
        }
    }
    lrcsi_row r;
    r.touched = outer_span(touched[0], touched[1], e->left, e->right);
    lrcsi_pixels all = {e->x0 > r.touched.x0 ? e->x0 : r.touched.x0,
                        e->x1 < r.touched.x1 ? e->x1 : r.touched.x1};
    all.x0 = all.x0 < all.x1 ? all.x0 : all.x1;
    r.sure = inner_span(sure[0], sure[1], all);
    r.whole = inner_span(whole[0], whole[1], r.sure);
    return r;
}

lrcsi_samples lrcsi_span_samples(const lrcsi_edges *edges, uint32_t y)
{
    double x0 = edges->x0;
    double x1 = edges->x1;
    double may[2] = {x0, x1};
    double sure[2] = {x0, x1};
    for (int k = 0; k < 3; k++) {
        double row = edges->at[k] + edges->up[k] * (y + 0.5);
        double zero = -row * edges->over[k];
        double near = edges->near[k];
        if (edges->over[k] > 0) {
            may[0] = lrcsi_most(may[0], zero - near);
            sure[0] = lrcsi_most(sure[0], zero + near);
        } else if (edges->over[k] < 0) {
            may[1] = lrcsi_least(may[1], zero + near);
            sure[1] = lrcsi_least(sure[1], zero - near);
        } else {
            may[1] = row < -edges->off ? 0 : may[1];
            sure[1] = row > edges->off ? sure[1] : 0;
        }
    }
    lrcsi_samples samples;
    samples.may = span_of(round_up(lrcsi_least(may[0], x1)), (uint32_t)lrcsi_most(may[1], x0));
    x0 = samples.may.x0;
    x1 = samples.may.x1;
    samples.sure = span_of((uint32_t)lrcsi_most(lrcsi_least(sure[0], x1), x0),
                           round_up(lrcsi_least(lrcsi_most(sure[1], x0), x1)));
    return samples;
}

lrcsi_pixels lrcsi_span_touched(const lrcsi_edges *e, uint32_t y)
{
    double touched[2] = {e->left, e->right};
    for (int k = 0; k < 3; k++) {
        double row = e->at[k] + e->up[k] * (y + 0.5);
        double zero = -row * e->over[k];
        if (e->over[k] > 0) {
            touched[0] = lrcsi_most(touched[0], zero - e->far[k]);
        } else if (e->over[k] < 0) {
            touched[1] = lrcsi_least(touched[1], zero + e->far[k]);
        } else {
            touched[1] = row < -(e->off + side_bend(e, k)) ? 0 : touched[1];
        }
    }
    return outer_span(touched[0], touched[1], e->left, e->right);
}
