/* SPDX-License-Identifier: MIT */
/* Where the edge functions of a facet cross a row of pixels. Whether the facet covers a sample near
   one of its sides is not decided here, but exactly in visibility/base/sample.h.

   Within a pixel, an edge function differs from its value at the centre by at most variation =
   (|dx| + |dy|) / 2. A span therefore ends where the edge function passes one of four limits:

     touched   -value_err - variation
     possible  -value_err
     certain    value_err
     full       value_err + variation

   At the height of the centres of row y, the edge function is 0 at the distance
   -(c + dy (y + 1/2)) / dx from the left end of the row; the centre of pixel x is at x + 1/2. The
   limit is passed |limit / dx| before or after that.

   Error. Crossings are computed as cross_x + cross_dx y: cross_x from c + dy / 2 with three more
   roundings, cross_dx with three, and their sum with one. Including the limit, this changes the
   value by at most 5 u (|c| + |dy| (N + 1)) + 2 u |limit| <= 10 u N (h + 2) + value_err / 16, for a
   box of half perimeter h on N x N pixels. This is less than value_err / 4, because value_err is at
   least 64 u N (h + 2); and the error of the edge function itself is at most 5/8 of value_err
   (visibility/raster/raster.c). Therefore the limits -value_err and value_err are still safe.

   A side that is parallel to the rows has no crossing. Its value decides for all pixels of a
   row. */
#include "visibility/raster/span.h"

#include <math.h>

#include "base/range.h"

/* The ceiling of a number from 0 to below 2^32. */
static inline uint32_t round_up(double x)
{
    uint32_t down = (uint32_t)x;
    return down + (down < x);
}

/* The position error of the ends, and of every point between them, is at most a quarter of the
   margin in either coordinate. Rounding errors of x are less than 4 u of the x of the ends, and
   less than 4 u of y and of the y of the ends, along the segment: together less than another
   quarter. Beyond the ends, the line is clamped to low and high. */
lrcsi_pixel_segment lrcsi_span_segment(const double *a, const double *b, double margin)
{
    double rise = b[1] - a[1];
    lrcsi_pixel_segment s = {.low = lrcsi_min(a[0], b[0]), .high = lrcsi_max(a[0], b[0])};
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

/* At a point of the facet, an edge function of the computed corners is above -5/8 value_err; within
   err of that point it is above -5/8 value_err - err (|dx| + |dy|). Its values are computed at the
   ends. Their coordinates are below 9 N, so that rounding changes these values, and the linear
   function between them, by less than 45 u N h, which is below 3/4 of value_err. Rounding of t
   moves a point by less than 4 u of the segment's length. */
int lrcsi_span_clip(const lrcsi_edge_functions *e, const double a[2], const double b[2], double err,
                    double t[2])
{
    t[0] = 0;
    t[1] = 1;
    for (int k = 0; k < 3; k++) {
        double limit = 2 * e->value_err + err * (fabs(e->dx[k]) + fabs(e->dy[k]));
        double p = e->c[k] + e->dx[k] * a[0] + e->dy[k] * a[1] + limit;
        double q = e->c[k] + e->dx[k] * b[0] + e->dy[k] * b[1] + limit;
        if (p < 0 && q < 0) {
            return 0;
        }
        if (p < 0) {
            t[0] = lrcsi_max(t[0], p / (p - q));
        } else if (q < 0) {
            t[1] = lrcsi_min(t[1], p / (p - q));
        }
    }
    return t[0] < t[1];
}

void lrcsi_span_prepare(lrcsi_edge_functions *e)
{
    int sides[2] = {0, 0};
    e->parallel = 0;
    for (int i = 0; i < 4; i++) {
        e->cross_x[i] = i < 2 ? -HUGE_VAL : HUGE_VAL;
        e->cross_dx[i] = e->sample_margin[i] = e->pixel_margin[i] = 0;
    }
    for (int k = 0; k < 3; k++) { /* at most two sides bound a triangle on the same side */
        if (!(fabs(e->dx[k]) > 0x1p-1000)) {
            e->parallel |= 1 << k;
            continue;
        }
        int right = e->dx[k] < 0;
        int i = 2 * right + sides[right]++;
        double inv_dx = 1 / e->dx[k];
        double variation = 0.5 * (fabs(e->dx[k]) + fabs(e->dy[k]));
        e->cross_x[i] = -(e->c[k] + 0.5 * e->dy[k]) * inv_dx;
        e->cross_dx[i] = -e->dy[k] * inv_dx;
        e->sample_margin[i] = 0.5 + e->value_err * fabs(inv_dx);
        e->pixel_margin[i] = 0.5 + (e->value_err + variation) * fabs(inv_dx);
    }
}

/* Where the sides cross row y. */
static inline void row_crossings(const lrcsi_edge_functions *e, double y, double cross[4])
{
    for (int i = 0; i < 4; i++) {
        cross[i] = e->cross_x[i] + e->cross_dx[i] * y;
    }
}

/* Where a span begins and ends, before rounding to whole pixels: with the uncertain pixels
   (touched, possible; outward 1) or without them (certain, full; outward -1). */
static inline void span_ends(const double cross[4], const double margin[4], double outward,
                             double x0, double x1, double end[2])
{
    end[0] = lrcsi_max3(x0, cross[0] - outward * margin[0], cross[1] - outward * margin[1]);
    end[1] = lrcsi_min3(x1, cross[2] + outward * margin[2], cross[3] + outward * margin[3]);
}

/* The least of max(value at row y0, value at row y1) + pixels * variation over the sides that are
   parallel to the rows; infinity if there are none. Values are those at the centres of the rows,
   the variation that within a pixel, `pixels` is 1, 0 or -1. */
static double parallel_value(const lrcsi_edge_functions *e, double y0, double y1, double pixels)
{
    double least = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        if (e->parallel >> k & 1) {
            double value =
                lrcsi_max(e->c[k] + e->dy[k] * (y0 + 0.5), e->c[k] + e->dy[k] * (y1 + 0.5));
            value += pixels * 0.5 * (fabs(e->dx[k]) + fabs(e->dy[k]));
            least = lrcsi_min(least, value);
        }
    }
    return least;
}

/* The span from x0 to x1, empty if x0 is beyond x1. */
static inline lrcsi_pixel_span span_of(uint32_t x0, uint32_t x1)
{
    return (lrcsi_pixel_span){x0 < x1 ? x0 : x1, x1};
}

/* The pixels between outer ends, which are within x0 and x1. */
static inline lrcsi_pixel_span outer_span(const double end[2], uint32_t x0, uint32_t x1)
{
    return span_of(round_up(lrcsi_min(end[0], x1)), (uint32_t)lrcsi_max(end[1], x0));
}

/* The pixels of `outer` between inner ends. */
static inline lrcsi_pixel_span inner_span(const double end[2], lrcsi_pixel_span outer)
{
    return span_of((uint32_t)lrcsi_max(lrcsi_min(end[0], outer.x1), outer.x0),
                   round_up(lrcsi_min(lrcsi_max(end[1], outer.x0), outer.x1)));
}

lrcsi_sample_spans lrcsi_span_samples(const lrcsi_edge_functions *e, uint32_t y)
{
    double cross[4];
    double possible[2];
    double certain[2];
    row_crossings(e, y, cross);
    span_ends(cross, e->sample_margin, 1, e->x0, e->x1, possible);
    span_ends(cross, e->sample_margin, -1, e->x0, e->x1, certain);
    if (e->parallel) {
        double value = parallel_value(e, y, y, 0);
        possible[1] = value < -e->value_err ? 0 : possible[1];
        certain[1] = value > e->value_err ? certain[1] : 0;
    }
    lrcsi_sample_spans samples;
    samples.possible = outer_span(possible, e->x0, e->x1);
    samples.certain = inner_span(certain, samples.possible);
    return samples;
}

lrcsi_pixel_span lrcsi_span_full(const lrcsi_edge_functions *e, uint32_t y,
                                 lrcsi_pixel_span certain)
{
    double cross[4];
    double full[2];
    row_crossings(e, y, cross);
    span_ends(cross, e->pixel_margin, -1, certain.x0, certain.x1, full);
    if (e->parallel && !(parallel_value(e, y, y, -1) > e->value_err)) {
        full[1] = 0;
    }
    return inner_span(full, certain);
}

/* The crossing of a side with the rows is linear in y, and so is the value of a side parallel to
   them. Between the first and the last row both therefore lie between their values in these two
   rows. */
lrcsi_pixel_span lrcsi_span_touched_rows(const lrcsi_edge_functions *e, uint32_t y0, uint32_t y1)
{
    double cross[2][4];
    row_crossings(e, y0, cross[0]);
    row_crossings(e, y1, cross[1]);
    for (int i = 0; i < 4; i++) {
        cross[0][i] =
            i < 2 ? lrcsi_min(cross[0][i], cross[1][i]) : lrcsi_max(cross[0][i], cross[1][i]);
    }
    double touched[2];
    span_ends(cross[0], e->pixel_margin, 1, e->left, e->right, touched);
    if (e->parallel && parallel_value(e, y0, y1, 1) < -e->value_err) {
        touched[1] = 0;
    }
    return outer_span(touched, e->left, e->right);
}

lrcsi_pixel_span lrcsi_span_touched(const lrcsi_edge_functions *e, uint32_t y)
{
    return lrcsi_span_touched_rows(e, y, y);
}
