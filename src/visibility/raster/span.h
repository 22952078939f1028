/* SPDX-License-Identifier: MIT */
/* The pixels of a row that a facet touches, those whose centres it covers, and those that it covers
   entirely, from where its sides cross the row. The cost for a sliver is in proportion to its
   length, not to the area of its box. */
#ifndef LRCSI_SPAN_H
#define LRCSI_SPAN_H

#include <stdint.h>

#include "base/range.h"

/* The edge functions of a facet in pixel coordinates, one for each side and positive inside the
   facet: value = c + dx x + dy y. */
typedef struct lrcsi_edge_functions {
    double c[3], dx[3], dy[3];
    /* Where the sides cross the rows: at the height of the centres of row y, side i is at x =
       cross_x[i] + cross_dx[i] y. Sides 0 and 1 bound the facet on the left, 2 and 3 on the right;
       a side that does not exist is at infinity. The margins are half a pixel plus the distance of
       a pixel's centre from the crossing beyond which the sign is certain: at the centre
       (sample_margin), in the whole pixel (pixel_margin). */
    double cross_x[4], cross_dx[4], sample_margin[4], pixel_margin[4];
    int parallel;            /* bit k: side k is parallel to the rows */
    double position_err;     /* error bound of the pixel coordinates of corners and samples */
    double value_err;        /* 8/5 of the error bound of a value in touched pixels */
    uint32_t x0, x1, y0, y1; /* pixels whose centres may be covered: x0 <= x < x1 */
    uint32_t left, right, bottom, top; /* pixels that may be touched: left <= x < right */
} lrcsi_edge_functions;

/* Pixels x0 <= x < x1 of a row; none if x0 = x1. */
typedef struct lrcsi_pixel_span {
    uint32_t x0, x1;
} lrcsi_pixel_span;

static inline int lrcsi_span_has(lrcsi_pixel_span span, uint32_t x)
{
    return x >= span.x0 && x < span.x1;
}

/* The coverage of the pixel centres of a row: `certain` lies within `possible`. */
typedef struct lrcsi_sample_spans {
    lrcsi_pixel_span possible; /* pixels whose centre the facet may cover */
    lrcsi_pixel_span certain;  /* pixels whose centre it certainly covers */
} lrcsi_sample_spans;

/* A line segment that is followed from row to row. In row y its x lies between from + slope y and
   to + slope y, and between low and high. */
typedef struct lrcsi_pixel_segment {
    double slope, from, to, low, high;
} lrcsi_pixel_segment;

/* The segment from a to b. The position error of its ends is at most a quarter of `margin`, and
   `margin` is at least 128 u of their coordinates. */
lrcsi_pixel_segment lrcsi_span_segment(const double *a, const double *b, double margin);

/* Narrows x0 <= x < x1, pixels of row y, to those that the segment may touch; none if x0 >= x1. */
static inline void lrcsi_span_follow(const lrcsi_pixel_segment *s, uint32_t y, uint32_t *x0,
                                     uint32_t *x1)
{
    double from = lrcsi_max(s->low, lrcsi_min(s->high, s->from + s->slope * y));
    double to = lrcsi_max(s->low, lrcsi_min(s->high, s->to + s->slope * y));
    *x0 = from > *x0 ? (uint32_t)lrcsi_min(from, *x1) : *x0;
    *x1 = to < *x1 ? (uint32_t)lrcsi_max(to + 1, 0) : *x1;
}

/* Clips the segment a b to within `err` of a facet: from a + t[0] (b - a) to a + t[1] (b - a); no
   point that near is lost. Its ends may be as far outside the window as those of
   lrcsi_raster_intersection. Returns 0 if nothing remains. */
int lrcsi_span_clip(const lrcsi_edge_functions *e, const double a[2], const double b[2], double err,
                    double t[2]);

/* Completes edge functions: computes the crossings, the margins and `parallel` from the other
   members. */
void lrcsi_span_prepare(lrcsi_edge_functions *e);

/* The spans of the samples of a row. */
lrcsi_sample_spans lrcsi_span_samples(const lrcsi_edge_functions *e, uint32_t y);

/* Of the pixels whose centres are certainly covered, those that are certainly covered entirely: one
   that is missing is covered only if an edge function in it is smaller than its error. */
lrcsi_pixel_span lrcsi_span_full(const lrcsi_edge_functions *e, uint32_t y,
                                 lrcsi_pixel_span certain);

/* The pixels of a row that the facet may touch. */
lrcsi_pixel_span lrcsi_span_touched(const lrcsi_edge_functions *e, uint32_t y);

/* A range of columns that contains all pixels touched in rows y0 <= y <= y1, and possibly more. */
lrcsi_pixel_span lrcsi_span_touched_rows(const lrcsi_edge_functions *e, uint32_t y0, uint32_t y1);

#endif
