/* SPDX-License-Identifier: MIT */
/* Where the edge functions of a facet cross a row of pixels. Whether the facet covers a sample near
   one of its sides is not decided here, but exactly in visibility/sample.h.

   Within a pixel, an edge function differs from its value at the centre by at most variation =
   (|dx| + |dy|) / 2. A span therefore ends where the edge function passes one of four limits:

     touched   -value_err - variation
     possible  -value_err
     certain    value_err
     full       value_err + variation

   If `row` is the value at the left end of the row, the limit is passed at (limit - row) / dx; the
   centre of pixel x is at x + 1/2.

   Error. The computed position has an error of at most 4 u of its terms, which changes the value by
   at most 4 u (|row| + |limit|) <= 10 u N h + value_err / 16, for a box of half perimeter h on
   N x N pixels. This is less than value_err / 4, because value_err is at least 64 u N (h + 2); and
   the error of the edge function itself is at most 5/8 of value_err (visibility/raster.c).
   Therefore the limits -value_err and value_err are still safe.

   Crossings are computed as cross_x + cross_dx y: cross_x from c + dy / 2 with three more
   roundings, cross_dx with three, and their sum with one. Including the limit, the error is at most
   5 u (|c| + |dy| (N + 1)) + 2 u |limit| <= 10 u N (h + 2) + value_err / 16: the same bound. */
#include "visibility/span.h"

#include <math.h>

#include "base/range.h"

/* Where spans begin and end, before rounding to whole pixels; in the order of lrcsi_row_spans. */
enum { TOUCHED, POSSIBLE, CERTAIN, FULL, KINDS };
typedef struct span_ends {
    double from[KINDS], to[KINDS];
} span_ends;

/* The ceiling of a number from 0 to below 2^32. */
static inline uint32_t round_up(double x)
{
    uint32_t down = (uint32_t)x;
    return down + (down < x);
}

/* The largest difference of an edge function within a pixel from its value at the centre. */
static double value_variation(const lrcsi_edge_functions *e, int k)
{
    return 0.5 * (fabs(e->dx[k]) + fabs(e->dy[k]));
}

/* The position error of the ends, and of every point between them, is at most a quarter of the
   margin in either coordinate. Rounding errors of x are less than 4 u of the x of the ends, and
   less than 4 u of y and of the y of the ends, along the segment: together less than another
   quarter. Beyond the ends, the line is clamped to low and high. */
lrcsi_segment lrcsi_span_segment(const double *a, const double *b, double margin)
{
    double rise = b[1] - a[1];
    lrcsi_segment s = {.low = lrcsi_min(a[0], b[0]), .high = lrcsi_max(a[0], b[0])};
    s.from = s.low;
    s.to = s.high;
    if (fabs(rise) > margin) {
        s.slope = (b[0] - a[0]) / rise;
        double below = a[0] - (a[1] + margin) * s.slope;
        double above = a[0] - (a[1] - 1 - margin) * s.slope;
        s.from = lrcsi_min(below, above);
        s.to = lrcsi_max(below, above);
    }
    s.low -= margin;
    s.high += margin;
    s.from -= margin;
    s.to += margin;
    return s;
}

void lrcsi_span_prepare(lrcsi_edge_functions *e)
{
    for (int k = 0; k < 3; k++) {
        double inv_dx = fabs(e->dx[k]) > 0x1p-1000 ? 1 / e->dx[k] : 0;
        e->inv_dx[k] = inv_dx;
        e->sample_margin[k] = 0.5 + e->value_err * fabs(inv_dx);
        e->pixel_margin[k] = 0.5 + (e->value_err + value_variation(e, k)) * fabs(inv_dx);
    }
    int sides[2] = {0, 0};
    e->horizontal = 0;
    for (int i = 0; i < 4; i++) {
        e->cross_x[i] = i < 2 ? -HUGE_VAL : HUGE_VAL;
        e->cross_dx[i] = e->cross_sample_margin[i] = e->cross_pixel_margin[i] = 0;
    }
    for (int k = 0; k < 3; k++) { /* at most two sides bound a triangle on the same side */
        int right = e->inv_dx[k] < 0;
        if (e->inv_dx[k] == 0) {
            e->horizontal = 1;
        } else {
            int i = 2 * right + sides[right]++;
            e->cross_x[i] = -(e->c[k] + 0.5 * e->dy[k]) * e->inv_dx[k];
            e->cross_dx[i] = -e->dy[k] * e->inv_dx[k];
            e->cross_sample_margin[i] = e->sample_margin[k];
            e->cross_pixel_margin[i] = e->pixel_margin[k];
        }
    }
}

/* Narrows the ends by a side that is parallel to the row: its value there, `row`, decides for all
   pixels at once. */
static inline void ends_narrow_horizontal(span_ends *ends, const lrcsi_edge_functions *e, int k,
                                          double row)
{
    double limit = e->value_err + value_variation(e, k);
    ends->to[TOUCHED] = row < -limit ? 0 : ends->to[TOUCHED];
    ends->to[POSSIBLE] = row < -e->value_err ? 0 : ends->to[POSSIBLE];
    ends->to[CERTAIN] = row > e->value_err ? ends->to[CERTAIN] : 0;
    ends->to[FULL] = row > limit ? ends->to[FULL] : 0;
}

/* Narrows the ends by side k of the facet; cy is the height of the row's centres. */
static inline void ends_narrow(span_ends *ends, const lrcsi_edge_functions *e, int k, double cy)
{
    double row = e->c[k] + e->dy[k] * cy;
    double zero = -row * e->inv_dx[k];
    if (e->inv_dx[k] > 0) {
        ends->from[TOUCHED] = lrcsi_max(ends->from[TOUCHED], zero - e->pixel_margin[k]);
        ends->from[POSSIBLE] = lrcsi_max(ends->from[POSSIBLE], zero - e->sample_margin[k]);
        ends->from[CERTAIN] = lrcsi_max(ends->from[CERTAIN], zero + e->sample_margin[k]);
        ends->from[FULL] = lrcsi_max(ends->from[FULL], zero + e->pixel_margin[k]);
    } else if (e->inv_dx[k] < 0) {
        ends->to[TOUCHED] = lrcsi_min(ends->to[TOUCHED], zero + e->pixel_margin[k]);
        ends->to[POSSIBLE] = lrcsi_min(ends->to[POSSIBLE], zero + e->sample_margin[k]);
        ends->to[CERTAIN] = lrcsi_min(ends->to[CERTAIN], zero - e->sample_margin[k]);
        ends->to[FULL] = lrcsi_min(ends->to[FULL], zero - e->pixel_margin[k]);
    } else {
        ends_narrow_horizontal(ends, e, k, row);
    }
}

/* The span from x0 to x1, empty if x0 is beyond x1. */
static inline lrcsi_pixel_span span_of(uint32_t x0, uint32_t x1)
{
    return (lrcsi_pixel_span){x0 < x1 ? x0 : x1, x1};
}

/* The pixels between the ends of a kind with uncertain pixels: TOUCHED, POSSIBLE. */
static inline lrcsi_pixel_span outer_span(const span_ends *ends, int kind, uint32_t x0, uint32_t x1)
{
    return span_of(round_up(lrcsi_min(ends->from[kind], x1)),
                   (uint32_t)lrcsi_max(ends->to[kind], x0));
}

/* The pixels of `outer` between the ends of a kind without uncertain pixels: CERTAIN, FULL. */
static inline lrcsi_pixel_span inner_span(const span_ends *ends, int kind, lrcsi_pixel_span outer)
{
    return span_of((uint32_t)lrcsi_max(lrcsi_min(ends->from[kind], outer.x1), outer.x0),
                   round_up(lrcsi_min(lrcsi_max(ends->to[kind], outer.x0), outer.x1)));
}

lrcsi_row_spans lrcsi_span_row(const lrcsi_edge_functions *e, uint32_t y)
{
    double x0 = e->x0;
    double x1 = e->x1;
    span_ends ends = {{e->left, x0, x0, x0}, {e->right, x1, x1, x1}};
    /* No loop, so that compilers keep the ends in registers. */
    ends_narrow(&ends, e, 0, y + 0.5);
    ends_narrow(&ends, e, 1, y + 0.5);
    ends_narrow(&ends, e, 2, y + 0.5);
    lrcsi_row_spans row;
    row.touched = outer_span(&ends, TOUCHED, e->left, e->right);
    row.possible = outer_span(&ends, POSSIBLE, e->x0, e->x1);
    row.certain = inner_span(&ends, CERTAIN, row.possible);
    row.full = inner_span(&ends, FULL, row.certain);
    return row;
}

lrcsi_sample_spans lrcsi_span_samples(const lrcsi_edge_functions *e, uint32_t y)
{
    double x0 = e->x0;
    double x1 = e->x1;
    double cross[4];
    for (int i = 0; i < 4; i++) {
        cross[i] = e->cross_x[i] + e->cross_dx[i] * y;
    }
    const double *margin = e->cross_sample_margin;
    double possible[2] = {lrcsi_max(x0, lrcsi_max(cross[0] - margin[0], cross[1] - margin[1])),
                          lrcsi_min(x1, lrcsi_min(cross[2] + margin[2], cross[3] + margin[3]))};
    double certain[2] = {lrcsi_max(x0, lrcsi_max(cross[0] + margin[0], cross[1] + margin[1])),
                         lrcsi_min(x1, lrcsi_min(cross[2] - margin[2], cross[3] - margin[3]))};
    if (e->horizontal) {
        for (int k = 0; k < 3; k++) {
            double row = e->c[k] + e->dy[k] * (y + 0.5);
            if (e->inv_dx[k] == 0) {
                possible[1] = row < -e->value_err ? 0 : possible[1];
                certain[1] = row > e->value_err ? certain[1] : 0;
            }
        }
    }
    lrcsi_sample_spans samples;
    samples.possible =
        span_of(round_up(lrcsi_min(possible[0], x1)), (uint32_t)lrcsi_max(possible[1], x0));
    x0 = samples.possible.x0;
    x1 = samples.possible.x1;
    samples.certain = span_of((uint32_t)lrcsi_max(lrcsi_min(certain[0], x1), x0),
                              round_up(lrcsi_min(lrcsi_max(certain[1], x0), x1)));
    return samples;
}

lrcsi_pixel_span lrcsi_span_full(const lrcsi_edge_functions *e, uint32_t y,
                                 lrcsi_pixel_span certain)
{
    span_ends ends = {.from = {[FULL] = certain.x0}, .to = {[FULL] = certain.x1}};
    for (int i = 0; i < 2; i++) {
        double left = e->cross_x[i] + e->cross_dx[i] * y + e->cross_pixel_margin[i];
        double right = e->cross_x[2 + i] + e->cross_dx[2 + i] * y - e->cross_pixel_margin[2 + i];
        ends.from[FULL] = lrcsi_max(ends.from[FULL], left);
        ends.to[FULL] = lrcsi_min(ends.to[FULL], right);
    }
    for (int k = 0; e->horizontal && k < 3; k++) {
        if (e->inv_dx[k] == 0) {
            ends_narrow_horizontal(&ends, e, k, e->c[k] + e->dy[k] * (y + 0.5));
        }
    }
    return inner_span(&ends, FULL, certain);
}

lrcsi_pixel_span lrcsi_span_touched(const lrcsi_edge_functions *e, uint32_t y)
{
    return lrcsi_span_touched_rows(e, y, y);
}

/* The crossing of a side with the rows is linear in y, and so is the value of a side parallel to
   them. Between the first and the last row both therefore lie between their values in these two
   rows. */
lrcsi_pixel_span lrcsi_span_touched_rows(const lrcsi_edge_functions *e, uint32_t y0, uint32_t y1)
{
    double from[2];
    double to[2];
    for (int i = 0; i < 2; i++) {
        double left[2] = {e->cross_x[i] + e->cross_dx[i] * y0, e->cross_x[i] + e->cross_dx[i] * y1};
        double right[2] = {e->cross_x[2 + i] + e->cross_dx[2 + i] * y0,
                           e->cross_x[2 + i] + e->cross_dx[2 + i] * y1};
        from[i] = lrcsi_min(left[0], left[1]) - e->cross_pixel_margin[i];
        to[i] = lrcsi_max(right[0], right[1]) + e->cross_pixel_margin[2 + i];
    }
    span_ends ends = {.from = {lrcsi_max(e->left, lrcsi_max(from[0], from[1]))},
                      .to = {lrcsi_min(e->right, lrcsi_min(to[0], to[1]))}};
    for (int k = 0; e->horizontal && k < 3; k++) {
        if (e->inv_dx[k] == 0) {
            ends_narrow_horizontal(
                &ends, e, k,
                lrcsi_max(e->c[k] + e->dy[k] * (y0 + 0.5), e->c[k] + e->dy[k] * (y1 + 0.5)));
        }
    }
    return outer_span(&ends, TOUCHED, e->left, e->right);
}
