/* SPDX-License-Identifier: MIT */
/* Operations on convex pieces, in rounded arithmetic. This file does not depend on facets. */
#include "visibility/reference/clip.h"

#include <math.h>

#include "base/range.h"

static void polygon_add(lrcsi_clip_polygon *polygon, double x, double y)
{
    if (polygon->count < LRCSI_CLIP_MAX_SIDES) {
        polygon->corner[polygon->count][0] = x;
        polygon->corner[polygon->count][1] = y;
    }
    polygon->count++;
}

int ref_clip_split(const lrcsi_clip_polygon *from, const lrcsi_clip_line *line,
                   lrcsi_clip_polygon *left, lrcsi_clip_polygon *right)
{
    left->count = right->count = 0;
    const double *p = from->corner[from->count - 1];
    double side = lrcsi_clip_side(line, p);
    for (uint32_t i = 0; i < from->count; i++) {
        const double *q = from->corner[i];
        double next = lrcsi_clip_side(line, q);
        if ((side < 0 && next > 0) || (side > 0 && next < 0)) {
            double t = side / (side - next);
            double x = p[0] + t * (q[0] - p[0]);
            double y = p[1] + t * (q[1] - p[1]);
            polygon_add(left, x, y);
            polygon_add(right, x, y);
        }
        if (next >= 0) {
            polygon_add(left, q[0], q[1]);
        }
        if (next <= 0) {
            polygon_add(right, q[0], q[1]);
        }
        p = q;
        side = next;
    }
    return left->count <= LRCSI_CLIP_MAX_SIDES && right->count <= LRCSI_CLIP_MAX_SIDES;
}

/* At least the length of a line's direction, and at most 1.42 times that. */
static double line_length(const lrcsi_clip_line *line)
{
    return fabs(line->to[0]) + fabs(line->to[1]);
}

static lrcsi_clip_line polygon_side(const lrcsi_clip_polygon *polygon, uint32_t i)
{
    const double *p = polygon->corner[i];
    const double *q = polygon->corner[i + 1 < polygon->count ? i + 1 : 0];
    return (lrcsi_clip_line){{p[0], p[1]}, {q[0] - p[0], q[1] - p[1]}};
}

lrcsi_clip_line ref_clip_halving(const lrcsi_clip_polygon *polygon)
{
    double low[2];
    double high[2];
    lrcsi_clip_box(polygon, low, high);
    int wide = high[0] - low[0] > high[1] - low[1];
    return (lrcsi_clip_line){{0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])},
                             {wide ? 0 : 1, wide ? 1 : 0}};
}

/* A direction in which all corners lie beyond the segment separates the two. The two directions
   across the segment and the two along it are tried. */
int ref_clip_meets(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *segment, double width)
{
    const double *to = segment->to;
    double clear = width * line_length(segment);
    double end = to[0] * to[0] + to[1] * to[1] + clear;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    int before = 1;
    int behind = 1;
    for (uint32_t i = 0; i < polygon->count; i++) {
        const double *p = polygon->corner[i];
        double side = lrcsi_clip_side(segment, p);
        double along = to[0] * (p[0] - segment->at[0]) + to[1] * (p[1] - segment->at[1]);
        least = lrcsi_min(least, side);
        most = lrcsi_max(most, side);
        before &= along < -clear;
        behind &= along > end;
    }
    return before || behind || least > clear || most < -clear ? REF_CLIP_APART
           : least < 0 && most > 0                            ? REF_CLIP_CROSSES
                                                              : REF_CLIP_BESIDE;
}

static void range_grow(double range[2], double x)
{
    range[0] = lrcsi_min(range[0], x);
    range[1] = lrcsi_max(range[1], x);
}

double ref_clip_within(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *segment,
                       double width)
{
    const double *to = segment->to;
    double square = to[0] * to[0] + to[1] * to[1];
    double strip = width * line_length(segment);
    double range[2] = {HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < polygon->count; i++) {
        lrcsi_clip_line edge = polygon_side(polygon, i);
        double from = lrcsi_clip_side(segment, edge.at);
        double along =
            to[0] * (edge.at[0] - segment->at[0]) + to[1] * (edge.at[1] - segment->at[1]);
        double rise = to[0] * edge.to[1] - to[1] * edge.to[0];
        double run = to[0] * edge.to[0] + to[1] * edge.to[1];
        if (fabs(from) <= strip) {
            range_grow(range, along);
        }
        for (int k = -1; k <= 1 && rise != 0; k += 2) {
            double t = (k * strip - from) / rise;
            if (t > 0 && t < 1) {
                range_grow(range, along + t * run);
            }
        }
    }
    double within = lrcsi_min(range[1], square) - lrcsi_max(range[0], 0);
    return within > 0 ? within / sqrt(square) : 0;
}

void ref_clip_middle(const lrcsi_clip_polygon *polygon, double middle[2])
{
    middle[0] = middle[1] = 0;
    for (uint32_t i = 0; i < polygon->count; i++) {
        middle[0] += polygon->corner[i][0];
        middle[1] += polygon->corner[i][1];
    }
    middle[0] /= polygon->count;
    middle[1] /= polygon->count;
}

/* The direction of a side between two corners that almost coincide is determined by rounding alone.
   Such short sides are not measured. If the point of the boundary nearest to `at` lies on short
   sides, an end of a long side is farther by at most their total length. Long sides are those whose
   direction changes by at most 1 % through rounding. */
double ref_clip_clear(const lrcsi_clip_polygon *polygon, const double at[2])
{
    double counts = 0x1p-44 * lrcsi_clip_box_perimeter(polygon);
    double short_ones = 0;
    double clear = HUGE_VAL;
    for (uint32_t i = 0; i < polygon->count; i++) {
        lrcsi_clip_line side = polygon_side(polygon, i);
        double length = line_length(&side);
        if (length > counts) {
            clear = lrcsi_min(clear, lrcsi_clip_side(&side, at) / length);
        } else {
            short_ones += length;
        }
    }
    return 0.98 * clear - short_ones;
}
