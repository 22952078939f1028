/* SPDX-License-Identifier: MIT */
/* Where edge functions cross a row of pixels. It decides nothing where doubles cannot tell: whom a
   sample near a side belongs to is asked of visibility/sample.h.

   Over a square of side s about a pixel's centre an edge function differs from its value there by
   at most s / 2 (|along| + |up|). With `row` its value at the row's left end, it passes a limit at
   x = (limit - row) / along - 1/2. As computed that is off by at most 4 u of its parts, which moves
   the value by at most 4 u (|row| + |limit|) <= 10 u N h + off / 16 for a box of half perimeter h
   on N x N pixels: less than off / 4, for off is at least 64 u N (h + 2), of which an edge
   function's own error takes 5 / 8 (visibility/raster.c). So limits of -off and off still err on
   the safe side. */
#include "visibility/span.h"

#include <math.h>

#include "base/range.h"

/* Where side k passes a limit, so that pixel x has its centre there. */
static double side_crossing(const lrcsi_edges *e, int k, double row, double limit)
{
    return (limit - row) * e->over[k] - 0.5;
}

static double side_row(const lrcsi_edges *e, int k, uint32_t y)
{
    return e->at[k] + e->up[k] * (y + 0.5);
}

static double side_bend(const lrcsi_edges *e, int k, double square)
{
    return 0.5 * square * (fabs(e->along[k]) + fabs(e->up[k]));
}

/* None of it: at the right end, so that what may be is split there into before and after. */
static lrcsi_span span_of(double from, double to, uint32_t end)
{
    return to > from ? (lrcsi_span){(uint32_t)from, (uint32_t)to} : (lrcsi_span){end, end};
}

lrcsi_span lrcsi_span_meets(const lrcsi_edges *edges, double square, uint32_t y, uint32_t x0,
                            uint32_t x1)
{
    double from = x0;
    double to = x1;
    for (int k = 0; k < 3; k++) {
        double row = side_row(edges, k, y);
        double limit = -edges->off - side_bend(edges, k, square);
        if (edges->over[k] > 0) {
            from = lrcsi_most(from, ceil(side_crossing(edges, k, row, limit)));
        } else if (edges->over[k] < 0) {
            to = lrcsi_least(to, floor(side_crossing(edges, k, row, limit)) + 1);
        } else if (row < limit) {
            return span_of(0, 0, x1);
        }
    }
    return span_of(from, to, x1);
}

lrcsi_span lrcsi_span_holds(const lrcsi_edges *edges, double square, uint32_t y, lrcsi_span within)
{
    double from = within.x0;
    double to = within.x1;
    for (int k = 0; k < 3; k++) {
        double row = side_row(edges, k, y);
        double limit = edges->off + side_bend(edges, k, square);
        if (edges->over[k] > 0) {
            from = lrcsi_most(from, floor(side_crossing(edges, k, row, limit)) + 1);
        } else if (edges->over[k] < 0) {
            to = lrcsi_least(to, ceil(side_crossing(edges, k, row, limit)));
        } else if (!(row > limit)) {
            return span_of(0, 0, within.x1);
        }
    }
    return span_of(from, to, within.x1);
}
