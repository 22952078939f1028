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

static double side_row(const lrcsi_edges *e, int k, uint32_t y)
{
    return e->at[k] + e->up[k] * (y + 0.5);
}

static double side_bend(const lrcsi_edges *e, int k, double square)
{
    return 0.5 * square * (fabs(e->along[k]) + fabs(e->up[k]));
}

/* Of a number from 0 to 2^32. */
static double round_up(double x)
{
    uint32_t down = (uint32_t)x;
    return down < x ? down + 1.0 : down;
}

/* Both within what was looked at, the fraction of either yet to be dropped. */
static lrcsi_span span_of(double from, double to)
{
    uint32_t x0 = (uint32_t)from;
    uint32_t x1 = (uint32_t)to;
    return (lrcsi_span){x0 < x1 ? x0 : x1, x1};
}

lrcsi_span lrcsi_span_meets(const lrcsi_edges *edges, double square, uint32_t y, uint32_t x0,
                            uint32_t x1)
{
    double from = x0;
    double to = x1;
    for (int k = 0; k < 3; k++) {
        double row = side_row(edges, k, y);
        double limit = -edges->off - side_bend(edges, k, square);
        double x = (limit - row) * edges->over[k];
        if (edges->over[k] > 0) {
            from = lrcsi_most(from, x - 0.5);
        } else if (edges->over[k] < 0) {
            to = lrcsi_least(to, x + 0.5);
        } else if (row < limit) {
            to = x0;
        }
    }
    return span_of(round_up(lrcsi_least(from, x1)), lrcsi_most(to, x0));
}

lrcsi_span lrcsi_span_holds(const lrcsi_edges *edges, double square, uint32_t y, lrcsi_span within)
{
    double from = within.x0;
    double to = within.x1;
    for (int k = 0; k < 3; k++) {
        double row = side_row(edges, k, y);
        double limit = edges->off + side_bend(edges, k, square);
        double x = (limit - row) * edges->over[k];
        if (edges->over[k] > 0) {
            from = lrcsi_most(from, x + 0.5);
        } else if (edges->over[k] < 0) {
            to = lrcsi_least(to, x - 0.5);
        } else if (!(row > limit)) {
            to = within.x0;
        }
    }
    return span_of(lrcsi_least(from, within.x1), round_up(lrcsi_most(to, within.x0)));
}
