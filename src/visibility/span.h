/* SPDX-License-Identifier: MIT */
/* The pixels of a row that a facet may touch, and those that it certainly covers, from where its
   sides cross the row. The cost for a sliver is in proportion to its length, not to its box. */
#ifndef LRCSI_SPAN_H
#define LRCSI_SPAN_H

#include <stdint.h>

#include "base/range.h"

/* A facet's edge functions in pixel coordinates, positive inside: value = at + along x + up y. */
typedef struct lrcsi_edges {
    double at[3], along[3], up[3];
    double over[3]; /* 1 / along, 0 if the side is parallel to the rows */
    /* Half a pixel, plus the distance along a row over which the value changes by `off`
       (sample_offset: beyond it a sample is decided), or by `off` and its variation within a pixel
       (pixel_offset: beyond it a whole pixel is). */
    double sample_offset[3], pixel_offset[3];
    /* The crossings of sides and rows: for the centres of row y, side i is at x = cross_at[i] +
       cross_up[i] y. Sides 0 and 1 bound the facet on the left, 2 and 3 on the right; a side that
       does not exist is at infinity. The offsets are those of that side. level: a side is parallel
       to the rows. */
    double cross_at[4], cross_up[4], cross_sample_offset[4], cross_pixel_offset[4];
    int level;
    double position_err;     /* error bound of the pixel coordinates of corners and samples */
    double off;              /* 8/5 of the error bound of a value in touched pixels */
    uint32_t x0, x1, y0, y1; /* pixels whose centres may be covered: x0 <= x < x1 */
    uint32_t left, right, bottom, top; /* pixels that may be touched: left <= x < right */
} lrcsi_edges;

/* Pixels x0 <= x < x1 of a row; none if x0 = x1. */
typedef struct lrcsi_pixels {
    uint32_t x0, x1;
} lrcsi_pixels;

static inline int lrcsi_span_has(lrcsi_pixels span, uint32_t x)
{
    return x >= span.x0 && x < span.x1;
}

/* The pixels of a row. `whole` lies within `sure`, and `sure` within `may`. */
typedef struct lrcsi_row {
    lrcsi_pixels touched; /* those that the facet may touch */
    lrcsi_pixels may;     /* those whose centre it may cover */
    lrcsi_pixels sure;    /* those whose centre it certainly covers */
    lrcsi_pixels whole;   /* those that it certainly covers entirely; a pixel is missing only if it
                               is covered by less than the error of an edge function */
} lrcsi_row;

/* A segment to be followed from row to row. In row y its x lies between from + slope y and to +
   slope y, and between low and high. */
typedef struct lrcsi_segment {
    double slope, from, to, low, high;
} lrcsi_segment;

/* The segment a -> b. The position error of its ends is at most a quarter of `margin`, and `margin`
   is at least 128 u of their coordinates. */
lrcsi_segment lrcsi_span_segment(const double *a, const double *b, double margin);

/* Narrows x0 <= x < x1, pixels of row y, to those that the segment may touch; none if x0 >= x1. */
static inline void lrcsi_span_follow(const lrcsi_segment *s, uint32_t y, uint32_t *x0, uint32_t *x1)
{
    double from = lrcsi_max(s->low, lrcsi_min(s->high, s->from + s->slope * y));
    double to = lrcsi_max(s->low, lrcsi_min(s->high, s->to + s->slope * y));
    *x0 = from > *x0 ? (uint32_t)lrcsi_min(from, *x1) : *x0;
    *x1 = to < *x1 ? (uint32_t)lrcsi_max(to + 1, 0) : *x1;
}

/* Computes over, the offsets, the crossings and level of edges whose other members are set. */
void lrcsi_span_prepare(lrcsi_edges *edges);

lrcsi_row lrcsi_span_row(const lrcsi_edges *edges, uint32_t y);

/* Only which centres of a row are covered: half the cost. */
typedef struct lrcsi_samples {
    lrcsi_pixels may, sure; /* as in lrcsi_row */
} lrcsi_samples;
lrcsi_samples lrcsi_span_samples(const lrcsi_edges *edges, uint32_t y);

/* Of the pixels whose centres are certainly covered, those that are certainly covered entirely. */
lrcsi_pixels lrcsi_span_whole(const lrcsi_edges *edges, uint32_t y, lrcsi_pixels sure);

/* Only which pixels of a row are touched: a third of the cost. */
lrcsi_pixels lrcsi_span_touched(const lrcsi_edges *edges, uint32_t y);

/* A range of columns that holds all pixels touched in rows y0 <= y <= y1, and possibly others. */
lrcsi_pixels lrcsi_span_touched_rows(const lrcsi_edges *edges, uint32_t y0, uint32_t y1);

#endif
