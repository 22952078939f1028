/* SPDX-License-Identifier: MIT */
/* Which pixels of a row a facet may touch, and which it surely covers: found by where its sides
   cross the row, so that slivers are walked along, not their boxes. */
#ifndef LRCSI_SPAN_H
#define LRCSI_SPAN_H

#include <stdint.h>

/* A facet's edge functions in pixel coordinates, positive inside: value = at + along x + up y. */
typedef struct lrcsi_edges {
    double at[3], along[3], up[3];
    double over[3];          /* 1 / along, 0 where the side runs along the rows */
    double off;              /* error bound of a value in pixels touched, with 3 / 8 to spare */
    uint32_t x0, x1, y0, y1; /* pixels whose centres may be covered: x0 <= x < x1 */
    uint32_t left, right, bottom, top; /* pixels that may be touched: left <= x < right */
} lrcsi_edges;

/* Pixels x0 <= x < x1 of a row; none where they are equal, then at the end of what was looked at.
 */
typedef struct lrcsi_span {
    uint32_t x0, x1;
} lrcsi_span;

/* Sides of a pixel's middle square, as a share of it: its centre alone, and all of it. */
#define LRCSI_SPAN_CENTRE 0.0
#define LRCSI_SPAN_PIXEL  1.0

/* The pixels of row y, x0 <= x < x1 among them, whose middle square the facet may meet: none is
   left out. */
lrcsi_span lrcsi_span_meets(const lrcsi_edges *edges, double square, uint32_t y, uint32_t x0,
                            uint32_t x1);

/* Pixels of row y among those of `within` whose middle square the facet surely covers: all but such
   as it covers by less than the error of an edge function. */
lrcsi_span lrcsi_span_holds(const lrcsi_edges *edges, double square, uint32_t y, lrcsi_span within);

#endif
