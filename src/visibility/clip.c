/* SPDX-License-Identifier: MIT */
/* Convex polygons in plain doubles, measured. Nothing here is exact. */
#include "visibility/clip.h"

#include <math.h>
#include <string.h>

#include "base/range.h"

double lrcsi_clip_side(const lrcsi_clip_line *line, const double p[2])
{
    return line->to[0] * (p[1] - line->at[1]) - line->to[1] * (p[0] - line->at[0]);
}

void lrcsi_clip_triangle(const double corner[3][2], lrcsi_clip_polygon *polygon)
{
    memcpy(polygon->corner, corner, 3 * sizeof *corner);
    polygon->count = 3;
}

void lrcsi_clip_box(const lrcsi_clip_polygon *polygon, double low[2], double high[2])
{
    for (int k = 0; k < 2; k++) {
        low[k] = high[k] = polygon->corner[0][k];
        for (uint32_t i = 1; i < polygon->count; i++) {
            double x = polygon->corner[i][k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    }
}

double lrcsi_clip_perimeter(const lrcsi_clip_polygon *polygon)
{
    double low[2];
    double high[2];
    lrcsi_clip_box(polygon, low, high);
    return 2 * ((high[0] - low[0]) + (high[1] - low[1]));
}

double lrcsi_clip_area(const lrcsi_clip_polygon *polygon)
{
    const double(*c)[2] = (const double(*)[2])polygon->corner;
    double area = 0;
    for (uint32_t j = 2; j < polygon->count; j++) {
        area += 0.5 * ((c[j - 1][0] - c[0][0]) * (c[j][1] - c[0][1]) -
                       (c[j - 1][1] - c[0][1]) * (c[j][0] - c[0][0]));
    }
    return area;
}

/* The contribution of the segment p q to the area of a polygon within the unit square at the
   origin: the integral of x, clamped to 0 .. 1, over y from p to q, also clamped to 0 .. 1.

   If the corners are at most C away from the square along either axis, the relative errors are u
   for differences of coordinates and 3 u for the slope; the error of x, where it is between 0 and
   1, is at most 6 u (C + 1). The mean of the clamped x is a quotient of sums of positive numbers,
   each a difference of given ones: its relative error is less than 10 u. */
static double box_integral(const double p[2], const double q[2])
{
    double from = lrcsi_min(1, lrcsi_max(0, p[1]));
    double to = lrcsi_min(1, lrcsi_max(0, q[1]));
    if (from == to) {
        return 0;
    }
    double slope = (q[0] - p[0]) / (q[1] - p[1]);
    double x = p[0] + (from - p[1]) * slope;
    double end = p[0] + (to - p[1]) * slope;
    double least = lrcsi_min(x, end);
    double most = lrcsi_max(x, end);
    double low = lrcsi_min(1, lrcsi_max(0, least));
    double high = lrcsi_min(1, lrcsi_max(0, most));
    double beyond = lrcsi_max(0, most - lrcsi_max(1, least));
    double mean =
        most > least ? (0.5 * (high - low) * (low + high) + beyond) / (most - least) : low;
    return (to - from) * mean;
}

double lrcsi_clip_box_area(const double corner[3][2], const double low[2])
{
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        p[k][0] = corner[k][0] - low[0];
        p[k][1] = corner[k][1] - low[1];
    }
    return box_integral(p[0], p[1]) + box_integral(p[1], p[2]) + box_integral(p[2], p[0]);
}
