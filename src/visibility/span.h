/* SPDX-License-Identifier: MIT */
/* Which pixels of a row a facet may touch, and which it surely covers: found by where its sides
   cross the row, so that slivers are walked along, not their boxes. */
#ifndef LRCSI_SPAN_H
#define LRCSI_SPAN_H

#include <stdint.h>

#include "base/range.h"

/* A facet's edge functions in pixel coordinates, positive inside: value = at + along x + up y. */
typedef struct lrcsi_edges {
    double at[3], along[3], up[3];
    double over[3];         /* 1 / along, 0 if the side runs along the rows */
    double near[3], far[3]; /* half a pixel, and how far along a row a value changes by off, and by
                               off and what it changes over half a pixel */
    /* Where sides cross rows: side i at x = cross_at[i] + cross_up[i] y for the centres of row y. 0
       and 1 bound the facet on the left, 2 and 3 on the right; one that there is not is at
       infinity. cross_near and cross_far: their near and far. level: some side runs along the rows.
     */
    double cross_at[4], cross_up[4], cross_near[4], cross_far[4];
    int level;
    double position_err;     /* error bound of the corners' pixel coordinates and of samples' */
    double off;              /* error bound of a value in pixels touched, with 3 / 8 to spare */
    uint32_t x0, x1, y0, y1; /* pixels whose centres may be covered: x0 <= x < x1 */
    uint32_t left, right, bottom, top; /* pixels that may be touched: left <= x < right */
} lrcsi_edges;

/* Pixels x0 <= x < x1 of a row; none where they are equal. */
typedef struct lrcsi_pixels {
    uint32_t x0, x1;
} lrcsi_pixels;

static inline int lrcsi_span_has(lrcsi_pixels span, uint32_t x)
{
    return x >= span.x0 && x < span.x1;
}

/* A row of pixels. The last three lie one within the other. */
typedef struct lrcsi_row {
    lrcsi_pixels touched; /* all that the facet may touch */
    lrcsi_pixels may;     /* all whose centre it may cover */
    lrcsi_pixels sure;    /* those whose centre it surely covers, */
    lrcsi_pixels whole; /* and those of which it surely covers all: none is missing but by less than
                         the error of an edge function */
} lrcsi_row;

/* A segment to be followed from row to row: all x that it may have in row y lie from from + slope y
   to to + slope y, and from low to high. */
typedef struct lrcsi_segment {
    double slope, from, to, low, high;
} lrcsi_segment;

/* The segment a -> b; its ends are off by at most a fourth of `margin`, and the margin is at least
   128 u of their coordinates. */
lrcsi_segment lrcsi_span_segment(const double *a, const double *b, double margin);

/* Narrows *x0 and *x1, pixels of row y, to x0 <= x < x1 for those that the segment may touch; none
   are left where x0 >= x1. */
static inline void lrcsi_span_follow(const lrcsi_segment *s, uint32_t y, uint32_t *x0, uint32_t *x1)
{
    double from = lrcsi_most(s->low, lrcsi_least(s->high, s->from + s->slope * y));
    double to = lrcsi_most(s->low, lrcsi_least(s->high, s->to + s->slope * y));
    *x0 = from > *x0 ? (uint32_t)lrcsi_least(from, *x1) : *x0;
    *x1 = to < *x1 ? (uint32_t)lrcsi_most(to + 1, 0) : *x1;
}

/* Fills in over, near, far and the crossings of edges whose other numbers are known. */
void lrcsi_span_prepare(lrcsi_edges *edges);

lrcsi_row lrcsi_span_row(const lrcsi_edges *edges, uint32_t y);

/* What is covered of a row, alone: half of the work. */
typedef struct lrcsi_samples {
    lrcsi_pixels may, sure; /* as in lrcsi_row */
} lrcsi_samples;
lrcsi_samples lrcsi_span_samples(const lrcsi_edges *edges, uint32_t y);

/* What is touched of a row, alone: a third of the work. */
lrcsi_pixels lrcsi_span_touched(const lrcsi_edges *edges, uint32_t y);

#endif
