/* SPDX-License-Identifier: MIT */
/* Convex polygons and lines of the plane in plain doubles. The caller accounts for the errors of
   the arguments; rounding errors of the results are stated at each function. */
#include "visibility/base/clip.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"

/* --- measures --------------------------------------------------------------------------------- */

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
            lrcsi_range_extend(polygon->corner[i][k], &low[k], &high[k]);
        }
    }
}

double lrcsi_clip_box_perimeter(const lrcsi_clip_polygon *polygon)
{
    double low[2];
    double high[2];
    lrcsi_clip_box(polygon, low, high);
    return 2 * ((high[0] - low[0]) + (high[1] - low[1]));
}

int lrcsi_clip_longest_side(const double corner[3][2], double *square)
{
    int longest = 0;
    *square = 0;
    for (int k = 0; k < 3; k++) {
        double x = corner[(k + 1) % 3][0] - corner[k][0];
        double y = corner[(k + 1) % 3][1] - corner[k][1];
        if (x * x + y * y > *square) {
            *square = x * x + y * y;
            longest = k;
        }
    }
    return longest;
}

/* The signed area of triangle j, from 2, of the fan of triangles about the first corner. */
static inline double fan_area(const double (*corner)[2], uint32_t j)
{
    const double *apex = corner[0];
    const double *p = corner[j - 1];
    const double *q = corner[j];
    return 0.5 * ((p[0] - apex[0]) * (q[1] - apex[1]) - (p[1] - apex[1]) * (q[0] - apex[0]));
}

double lrcsi_clip_area(const lrcsi_clip_polygon *polygon)
{
    double area = 0;
    for (uint32_t j = 2; j < polygon->count; j++) {
        area += fan_area((const double(*)[2])polygon->corner, j);
    }
    return area;
}

double lrcsi_clip_add_moment(const lrcsi_clip_polygon *polygon, const double about[2],
                             lrcsi_moment *moment)
{
    const double(*c)[2] = (const double(*)[2])polygon->corner;
    double sum[2] = {0, 0};
    double square = 0;
    for (uint32_t j = 0; j < polygon->count; j++) {
        double x = c[j][0] - about[0];
        double y = c[j][1] - about[1];
        square = lrcsi_max(square, x * x + y * y);
    }
    for (uint32_t j = 2; j < polygon->count; j++) {
        double area = fan_area(c, j);
        for (int k = 0; k < 2; k++) {
            sum[k] +=
                area *
                (((c[0][k] - about[k]) + (c[j - 1][k] - about[k]) + (c[j][k] - about[k])) / 3);
        }
    }
    for (int k = 0; k < 2; k++) {
        moment->first[k] += sum[k];
        moment->error += LRCSI_U * fabs(moment->first[k]);
    }
    /* The root of the exact square is at most 2 u larger, and rounding it changes half an ulp: r =
       m 2^e, 1 <= m < 2, is too small by at most m + 1/2 ulps. The rounded r (1 + 4 u) is larger
       than r by at least 2 ulps, and by at least 2 m - 1/2. */
    return sqrt(square) * LRCSI_OUTWARD(4);
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
    double x_min = lrcsi_min(x, end);
    double x_max = lrcsi_max(x, end);
    double low = lrcsi_min(1, lrcsi_max(0, x_min));
    double high = lrcsi_min(1, lrcsi_max(0, x_max));
    double beyond = lrcsi_max(0, x_max - lrcsi_max(1, x_min));
    double mean =
        x_max > x_min ? (0.5 * (high - low) * (low + high) + beyond) / (x_max - x_min) : low;
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

/* --- lines and cells -------------------------------------------------------------------------- */

double lrcsi_line_through(const double *p, const double *q, double line[3])
{
    double a = p[1] - q[1];
    double b = q[0] - p[0];
    double length = sqrt(a * a + b * b);
    line[0] = length > 0 ? a / length : 1;
    line[1] = length > 0 ? b / length : 0;
    line[2] = -(line[0] * p[0] + line[1] * p[1]);
    return length;
}

void lrcsi_clip_sides_make(const lrcsi_clip_polygon *p, double tolerance, lrcsi_clip_sides *s)
{
    s->count = p->count;
    s->tolerance = tolerance;
    lrcsi_clip_box(p, s->low, s->high);
    s->perimeter = 2 * ((s->high[0] - s->low[0]) + (s->high[1] - s->low[1]));
    for (uint32_t i = 0; i < p->count; i++) {
        double *line = s->line[i];
        const double *from = p->corner[i];
        const double *to = p->corner[i + 1 < p->count ? i + 1 : 0];
        lrcsi_line_through(from, to, line);
        s->length[i] = fabs(to[0] - from[0]) + fabs(to[1] - from[1]);
        double lowest = 0;
        for (uint32_t k = 0; k < p->count; k++) {
            lowest = lrcsi_min(lowest, lrcsi_line_at(line, p->corner[k][0], p->corner[k][1]));
        }
        s->shift[i] = -lowest;
        line[2] -= lowest;
    }
}

void lrcsi_box_range(const double low[2], const double high[2], const double line[3],
                     double range[2])
{
    double middle = lrcsi_line_at(line, 0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]));
    double half = 0.5 * (fabs(line[0]) * (high[0] - low[0]) + fabs(line[1]) * (high[1] - low[1]));
    range[0] = middle - half;
    range[1] = middle + half;
}

/* A part of a segment is short if it is less than this fraction of it: a heuristic that saves time.
   The test of a short part (below) is valid for any part, but a longer one that is near a side
   along all its length is rare. */
#define SHORT_PART 0x1p-20

int lrcsi_clip_locate_near(const lrcsi_clip_polygon *shape, const lrcsi_clip_sides *s,
                           const double p[2], const double q[2], const double line[3], double w,
                           double line_w, lrcsi_clip_interval *interval)
{
    double range[2];
    lrcsi_line_range(shape, line, range);
    double deep = lrcsi_min(range[1], -range[0]);
    if (deep < -line_w) {
        return LRCSI_CLIP_OUTSIDE;
    }
    double width = deep <= line_w ? line_w + lrcsi_max(0, deep) : HUGE_VAL;
    interval->from = 0;
    interval->to = 1;
    for (uint32_t i = 0; i < s->count; i++) {
        double a = lrcsi_line_at(s->line[i], p[0], p[1]);
        double b = lrcsi_line_at(s->line[i], q[0], q[1]);
        if (a < w && b < w) {
            width = lrcsi_min(width, w + lrcsi_max3(0, a, b));
            if (a < -w && b < -w) {
                return LRCSI_CLIP_OUTSIDE;
            }
        }
        if (a < -w) {
            interval->from = lrcsi_max(interval->from, (-w - a) / (b - a));
        } else if (b < -w) {
            interval->to = lrcsi_min(interval->to, (-w - a) / (b - a));
        }
    }
    if (interval->from > interval->to) {
        return LRCSI_CLIP_OUTSIDE;
    }
    /* A short part may be in a corner of the cell, all of it near one side. Its ends have errors
       below w. */
    if (interval->to - interval->from < SHORT_PART && !(width < HUGE_VAL)) {
        for (uint32_t i = 0; i < s->count; i++) {
            double a = lrcsi_line_at(s->line[i], p[0], p[1]);
            double b = lrcsi_line_at(s->line[i], q[0], q[1]);
            double deepest = lrcsi_max(a + interval->from * (b - a), a + interval->to * (b - a));
            if (deepest < 2 * w) {
                width = lrcsi_min(width, 2 * w + lrcsi_max(0, deepest));
            }
        }
    }
    interval->strip_width = width;
    return width < HUGE_VAL ? LRCSI_CLIP_BORDER : LRCSI_CLIP_CROSSES;
}

/* A side is left out if it is no longer than this fraction of the perimeter plus so many
   tolerances: a heuristic, since any may be left out. The direction of such a side says little, and
   its line may pass close to points that are far from the side: that would make the bound small. */
#define SHORT_SIDE            0x1p-44
#define SHORT_SIDE_TOLERANCES 64
/* More than all relative rounding errors, which are below 4 u. */
#define DISTANCE_FACTOR 0.98

/* A point at a distance d from a side that is left out is no farther than d and the lengths of all
   sides left out from a corner of one that is not, and so from its line: the least distance from
   the lines of the latter, less these lengths, is at most d. It is also at most the distance from
   the border elsewhere. Corners are doubles, b their largest coordinate. The direction of a line
   has an error of 2 u, which moves it by 5.7 u b within the cell; its constant has an error of 2.9
   u b; and the value at a point one of 5.7 u b: together less than the tolerance, which is at least
   16 u b. */
double lrcsi_clip_border_distance(const lrcsi_clip_sides *s, const double at[2])
{
    double shortest = SHORT_SIDE * s->perimeter + SHORT_SIDE_TOLERANCES * s->tolerance;
    double least = HUGE_VAL;
    double left_out = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (s->length[i] > shortest) {
            least = lrcsi_min(least, lrcsi_line_at(s->line[i], at[0], at[1]) - s->shift[i]);
        } else {
            left_out += s->length[i];
        }
    }
    return DISTANCE_FACTOR * least - left_out - s->tolerance;
}

/* A line crosses two sides of a convex shape, and each part has at most one corner more; but of
   corners within rounding of the line, any may seem to lie on either side of it. A side adds at
   most two corners to a part. */
static int has_room(const lrcsi_clip_polygon *part)
{
    return part->count + 2 <= LRCSI_CLIP_MAX_SIDES;
}

int lrcsi_clip_keep_left(lrcsi_clip_polygon *shape, const double line[3])
{
    lrcsi_clip_polygon out;
    out.count = 0;
    const double *p = shape->corner[0];
    double a = shape->count > 0 ? lrcsi_line_at(line, p[0], p[1]) : 0;
    double first = a;
    for (uint32_t i = 0; i < shape->count; i++) {
        int last = i + 1 == shape->count;
        if (!has_room(&out)) {
            return 0;
        }
        const double *q = shape->corner[last ? 0 : i + 1];
        double b = last ? first : lrcsi_line_at(line, q[0], q[1]);
        if (a >= 0) {
            memcpy(out.corner[out.count++], p, sizeof out.corner[0]);
        }
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            double t = a / (a - b);
            out.corner[out.count][0] = p[0] + t * (q[0] - p[0]);
            out.corner[out.count++][1] = p[1] + t * (q[1] - p[1]);
        }
        p = q;
        a = b;
    }
    shape->count = out.count;
    memcpy(shape->corner, out.corner, out.count * sizeof out.corner[0]);
    return 1;
}

/* The distance from the line of a side to a corner that was computed on it: at the fraction t of
   the side, which is the vector (x, y). The error of each coordinate is u of itself and 2 u of what
   was added, or 0 if nothing was; only the component across the side counts. */
static double corner_err(double x, double y, double t, const double corner[2])
{
    x = fabs(x);
    y = fabs(y);
    double x_err = x > 0 ? LRCSI_U * (2 * t * x + fabs(corner[0])) : 0;
    double y_err = y > 0 ? LRCSI_U * (2 * t * y + fabs(corner[1])) : 0;
    return LRCSI_OUTWARD(8) * (x * y_err + y * x_err) / lrcsi_max(x, y);
}

double lrcsi_clip_divide(const lrcsi_clip_polygon *shape, const double line[3],
                         lrcsi_clip_polygon *left, lrcsi_clip_polygon *right)
{
    double shape_err = 0;
    left->count = right->count = 0;
    for (uint32_t i = 0; i < shape->count; i++) {
        const double *here = shape->corner[i];
        const double *next = shape->corner[i + 1 < shape->count ? i + 1 : 0];
        double a = lrcsi_line_at(line, here[0], here[1]);
        double b = lrcsi_line_at(line, next[0], next[1]);
        if (!has_room(left) || !has_room(right)) {
            return -1;
        }
        if (a >= 0) {
            memcpy(left->corner[left->count++], here, 2 * sizeof *here);
        }
        if (a <= 0) {
            memcpy(right->corner[right->count++], here, 2 * sizeof *here);
        }
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            double t = a / (a - b);
            double *corner = left->corner[left->count++];
            corner[0] = here[0] + t * (next[0] - here[0]);
            corner[1] = here[1] + t * (next[1] - here[1]);
            memcpy(right->corner[right->count++], corner, 2 * sizeof *corner);
            shape_err =
                lrcsi_max(shape_err, corner_err(next[0] - here[0], next[1] - here[1], t, corner));
        }
    }
    return shape_err;
}
