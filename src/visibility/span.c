/* SPDX-License-Identifier: MIT */
/* Where edge functions cross a row of pixels. Whether a sample near a side is covered is not
   decided here, but exactly by visibility/sample.h.

   Within a pixel an edge function differs from its value at the centre by at most bend = (|along| +
   |up|) / 2. Therefore the limits of the four kinds of pixels are where it passes -off - bend
   (touched), -off (may be covered), off (certainly covered) and off + bend (entirely covered). With
   `row` its value at the left end of the row, it passes a limit at (limit - row) / along; pixel x
   has its centre at x + 1/2.

   The computed position has an error of at most 4 u of its terms. This changes the value by at most
   4 u (|row| + |limit|) <= 10 u N h + off / 16, for a box of half perimeter h on N x N pixels. That
   is less than off / 4, because off is at least 64 u N (h + 2), and the edge function's own error
   is at most 5/8 of it (visibility/raster.c). So the limits -off and off are still safe.

   Crossings are computed as cross_at + cross_up y: cross_at from at + up / 2 with three more
   roundings, cross_up y with three, and their sum with one. With the limit the error is at most 5 u
   (|at| + |up| (N + 1)) + 2 u |limit| <= 10 u N (h + 2) + off / 16, the same bound. */
#include "visibility/span.h"

#include <math.h>

#include "base/range.h"

/* Where spans begin and end, before rounding to whole pixels; in the order of lrcsi_row. */
enum { TOUCHED, MAY, SURE, WHOLE, KINDS };
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
static double side_bend(const lrcsi_edges *e, int k)
{
    return 0.5 * (fabs(e->along[k]) + fabs(e->up[k]));
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

void lrcsi_span_prepare(lrcsi_edges *edges)
{
    for (int k = 0; k < 3; k++) {
        double over = fabs(edges->along[k]) > 0x1p-1000 ? 1 / edges->along[k] : 0;
        edges->over[k] = over;
        edges->sample_offset[k] = 0.5 + edges->off * fabs(over);
        edges->pixel_offset[k] = 0.5 + (edges->off + side_bend(edges, k)) * fabs(over);
    }
    int sides[2] = {0, 0};
    edges->level = 0;
    for (int i = 0; i < 4; i++) {
        edges->cross_at[i] = i < 2 ? -HUGE_VAL : HUGE_VAL;
        edges->cross_up[i] = edges->cross_sample_offset[i] = edges->cross_pixel_offset[i] = 0;
    }
    for (int k = 0; k < 3; k++) { /* at most two sides bound a triangle on the same side */
        int right = edges->over[k] < 0;
        if (edges->over[k] == 0) {
            edges->level = 1;
        } else {
            int i = 2 * right + sides[right]++;
            edges->cross_at[i] = -(edges->at[k] + 0.5 * edges->up[k]) * edges->over[k];
            edges->cross_up[i] = -edges->up[k] * edges->over[k];
            edges->cross_sample_offset[i] = edges->sample_offset[k];
            edges->cross_pixel_offset[i] = edges->pixel_offset[k];
        }
    }
}

/* A side parallel to the row decides for all its pixels at once. */
static inline void ends_level(span_ends *ends, const lrcsi_edges *e, int k, double row)
{
    double far = e->off + side_bend(e, k);
    ends->to[TOUCHED] = row < -far ? 0 : ends->to[TOUCHED];
    ends->to[MAY] = row < -e->off ? 0 : ends->to[MAY];
    ends->to[SURE] = row > e->off ? ends->to[SURE] : 0;
    ends->to[WHOLE] = row > far ? ends->to[WHOLE] : 0;
}

/* Narrows the ends by one side of the facet. */
static inline void ends_narrow(span_ends *ends, const lrcsi_edges *e, int k, double cy)
{
    double row = e->at[k] + e->up[k] * cy;
    double zero = -row * e->over[k];
    if (e->over[k] > 0) {
        ends->from[TOUCHED] = lrcsi_max(ends->from[TOUCHED], zero - e->pixel_offset[k]);
        ends->from[MAY] = lrcsi_max(ends->from[MAY], zero - e->sample_offset[k]);
        ends->from[SURE] = lrcsi_max(ends->from[SURE], zero + e->sample_offset[k]);
        ends->from[WHOLE] = lrcsi_max(ends->from[WHOLE], zero + e->pixel_offset[k]);
    } else if (e->over[k] < 0) {
        ends->to[TOUCHED] = lrcsi_min(ends->to[TOUCHED], zero + e->pixel_offset[k]);
        ends->to[MAY] = lrcsi_min(ends->to[MAY], zero + e->sample_offset[k]);
        ends->to[SURE] = lrcsi_min(ends->to[SURE], zero - e->sample_offset[k]);
        ends->to[WHOLE] = lrcsi_min(ends->to[WHOLE], zero - e->pixel_offset[k]);
    } else {
        ends_level(ends, e, k, row);
    }
}

static inline lrcsi_pixels span_of(uint32_t x0, uint32_t x1)
{
    return (lrcsi_pixels){x0 < x1 ? x0 : x1, x1};
}

static inline lrcsi_pixels outer_span(const span_ends *ends, int kind, uint32_t x0, uint32_t x1)
{
    return span_of(round_up(lrcsi_min(ends->from[kind], x1)),
                   (uint32_t)lrcsi_max(ends->to[kind], x0));
}

static inline lrcsi_pixels inner_span(const span_ends *ends, int kind, lrcsi_pixels outer)
{
    return span_of((uint32_t)lrcsi_max(lrcsi_min(ends->from[kind], outer.x1), outer.x0),
                   round_up(lrcsi_min(lrcsi_max(ends->to[kind], outer.x0), outer.x1)));
}

lrcsi_row lrcsi_span_row(const lrcsi_edges *edges, uint32_t y)
{
    double x0 = edges->x0;
    double x1 = edges->x1;
    span_ends ends = {{edges->left, x0, x0, x0}, {edges->right, x1, x1, x1}};
    ends_narrow(&ends, edges, 0,
                y + 0.5); /* not a loop, so that compilers keep the ends in registers */
    ends_narrow(&ends, edges, 1, y + 0.5);
    ends_narrow(&ends, edges, 2, y + 0.5);
    lrcsi_row row;
    row.touched = outer_span(&ends, TOUCHED, edges->left, edges->right);
    row.may = outer_span(&ends, MAY, edges->x0, edges->x1);
    row.sure = inner_span(&ends, SURE, row.may);
    row.whole = inner_span(&ends, WHOLE, row.sure);
    return row;
}

/* The same, for samples only. */
static void samples_level(const lrcsi_edges *e, uint32_t y, double may[2], double sure[2])
{
    for (int k = 0; k < 3; k++) {
        if (e->over[k] == 0) {
            double row = e->at[k] + e->up[k] * (y + 0.5);
            may[1] = row < -e->off ? 0 : may[1];
            sure[1] = row > e->off ? sure[1] : 0;
        }
    }
}

lrcsi_samples lrcsi_span_samples(const lrcsi_edges *e, uint32_t y)
{
    double x0 = e->x0;
    double x1 = e->x1;
    double cross[4];
    for (int i = 0; i < 4; i++) {
        cross[i] = e->cross_at[i] + e->cross_up[i] * y;
    }
    const double *offset = e->cross_sample_offset;
    double may[2] = {lrcsi_max(x0, lrcsi_max(cross[0] - offset[0], cross[1] - offset[1])),
                     lrcsi_min(x1, lrcsi_min(cross[2] + offset[2], cross[3] + offset[3]))};
    double sure[2] = {lrcsi_max(x0, lrcsi_max(cross[0] + offset[0], cross[1] + offset[1])),
                      lrcsi_min(x1, lrcsi_min(cross[2] - offset[2], cross[3] - offset[3]))};
    if (e->level) {
        samples_level(e, y, may, sure);
    }
    lrcsi_samples samples;
    samples.may = span_of(round_up(lrcsi_min(may[0], x1)), (uint32_t)lrcsi_max(may[1], x0));
    x0 = samples.may.x0;
    x1 = samples.may.x1;
    samples.sure = span_of((uint32_t)lrcsi_max(lrcsi_min(sure[0], x1), x0),
                           round_up(lrcsi_min(lrcsi_max(sure[1], x0), x1)));
    return samples;
}

lrcsi_pixels lrcsi_span_whole(const lrcsi_edges *e, uint32_t y, lrcsi_pixels sure)
{
    span_ends ends = {.from = {[WHOLE] = sure.x0}, .to = {[WHOLE] = sure.x1}};
    for (int i = 0; i < 2; i++) {
        double left = e->cross_at[i] + e->cross_up[i] * y + e->cross_pixel_offset[i];
        double right = e->cross_at[2 + i] + e->cross_up[2 + i] * y - e->cross_pixel_offset[2 + i];
        ends.from[WHOLE] = lrcsi_max(ends.from[WHOLE], left);
        ends.to[WHOLE] = lrcsi_min(ends.to[WHOLE], right);
    }
    for (int k = 0; e->level && k < 3; k++) {
        if (e->over[k] == 0) {
            ends_level(&ends, e, k, e->at[k] + e->up[k] * (y + 0.5));
        }
    }
    return inner_span(&ends, WHOLE, sure);
}

lrcsi_pixels lrcsi_span_touched(const lrcsi_edges *e, uint32_t y)
{
    return lrcsi_span_touched_rows(e, y, y);
}

/* Where a side crosses the rows, and the value of one that is parallel to them, are linear in y: in
   rows between the first and the last they lie between the values there, which have the errors of
   those rows. */
lrcsi_pixels lrcsi_span_touched_rows(const lrcsi_edges *e, uint32_t y0, uint32_t y1)
{
    double from[2];
    double to[2];
    for (int i = 0; i < 2; i++) {
        double left[2] = {e->cross_at[i] + e->cross_up[i] * y0,
                          e->cross_at[i] + e->cross_up[i] * y1};
        double right[2] = {e->cross_at[2 + i] + e->cross_up[2 + i] * y0,
                           e->cross_at[2 + i] + e->cross_up[2 + i] * y1};
        from[i] = lrcsi_min(left[0], left[1]) - e->cross_pixel_offset[i];
        to[i] = lrcsi_max(right[0], right[1]) + e->cross_pixel_offset[2 + i];
    }
    span_ends ends = {.from = {lrcsi_max(e->left, lrcsi_max(from[0], from[1]))},
                      .to = {lrcsi_min(e->right, lrcsi_min(to[0], to[1]))}};
    for (int k = 0; e->level && k < 3; k++) {
        if (e->over[k] == 0) {
            ends_level(
                &ends, e, k,
                lrcsi_max(e->at[k] + e->up[k] * (y0 + 0.5), e->at[k] + e->up[k] * (y1 + 0.5)));
        }
    }
    return outer_span(&ends, TOUCHED, e->left, e->right);
}
