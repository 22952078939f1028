/* SPDX-License-Identifier: MIT */
/* The position of lines and segments relative to the convex polygon of a cell, in plain doubles.
   Their errors are given by the caller. */
#include "visibility/cells_shape.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"

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

void lrcsi_cells_sides_make(const lrcsi_clip_polygon *p, double g, lrcsi_cells_sides *s)
{
    s->count = p->count;
    s->g = g;
    lrcsi_clip_box(p, s->low, s->high);
    s->perimeter = 2 * ((s->high[0] - s->low[0]) + (s->high[1] - s->low[1]));
    for (uint32_t i = 0; i < p->count; i++) {
        double *line = s->line[i];
        const double *from = p->corner[i];
        const double *to = p->corner[i + 1 < p->count ? i + 1 : 0];
        lrcsi_line_through(from, to, line);
        s->length[i] = fabs(to[0] - from[0]) + fabs(to[1] - from[1]);
        double least = 0;
        for (uint32_t k = 0; k < p->count; k++) {
            least = lrcsi_min(least, lrcsi_line_at(line, p->corner[k][0], p->corner[k][1]));
        }
        s->moved[i] = -least;
        line[2] -= least;
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

/* A part of a segment is short if it is less than this fraction of it. */
#define SHORT 0x1p-20

int lrcsi_cells_place_near(const lrcsi_clip_polygon *shape, const lrcsi_cells_sides *s,
                           const double p[2], const double q[2], const double line[3], double w,
                           double line_w, lrcsi_cells_part *part)
{
    double range[2];
    lrcsi_line_range(shape, line, range);
    double deep = lrcsi_min(range[1], -range[0]);
    if (deep < -line_w) {
        return LRCSI_CELLS_AWAY;
    }
    double strip = deep <= line_w ? line_w + lrcsi_max(0, deep) : HUGE_VAL;
    part->from = 0;
    part->to = 1;
    for (uint32_t i = 0; i < s->count; i++) {
        double a = lrcsi_line_at(s->line[i], p[0], p[1]);
        double b = lrcsi_line_at(s->line[i], q[0], q[1]);
        if (a < w && b < w) {
            strip = lrcsi_min(strip, w + lrcsi_max(0, lrcsi_max(a, b)));
            if (a < -w && b < -w) {
                return LRCSI_CELLS_AWAY;
            }
        }
        if (a < -w) {
            part->from = lrcsi_max(part->from, (-w - a) / (b - a));
        } else if (b < -w) {
            part->to = lrcsi_min(part->to, (-w - a) / (b - a));
        }
    }
    if (part->from > part->to) {
        return LRCSI_CELLS_AWAY;
    }
    /* A short part may be in a corner of the cell, all of it near one side. Its ends are off by
       less than w. */
    if (part->to - part->from < SHORT && !(strip < HUGE_VAL)) {
        for (uint32_t i = 0; i < s->count; i++) {
            double a = lrcsi_line_at(s->line[i], p[0], p[1]);
            double b = lrcsi_line_at(s->line[i], q[0], q[1]);
            double deepest = lrcsi_max(a + part->from * (b - a), a + part->to * (b - a));
            if (deepest < 2 * w) {
                strip = lrcsi_min(strip, 2 * w + lrcsi_max(0, deepest));
            }
        }
    }
    part->strip = strip;
    return strip < HUGE_VAL ? LRCSI_CELLS_BORDER : LRCSI_CELLS_MEETS;
}

double lrcsi_cells_sides_clear(const lrcsi_cells_sides *s, const double at[2])
{
    double counts = 0x1p-44 * s->perimeter + 64 * s->g;
    double clear = HUGE_VAL;
    double brief = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (s->length[i] > counts) {
            clear = lrcsi_min(clear, lrcsi_line_at(s->line[i], at[0], at[1]) - s->moved[i]);
        } else {
            brief += s->length[i];
        }
    }
    return 0.98 * clear - brief - s->g;
}

void lrcsi_cells_shape_clip(lrcsi_clip_polygon *shape, const double line[3])
{
    lrcsi_clip_polygon out;
    out.count = 0;
    const double *p = shape->corner[0];
    double a = shape->count > 0 ? lrcsi_line_at(line, p[0], p[1]) : 0;
    double first = a;
    for (uint32_t i = 0; i < shape->count; i++) {
        int last = i + 1 == shape->count;
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
}

/* The distance from the line of a side to a corner that was computed on it: at the fraction t of
   the side, which is the vector (x, y). The error of each coordinate is u of itself and 2 u of what
   was added, or 0 if nothing was; only the component across the side counts. */
static double corner_drift(double x, double y, double t, const double corner[2])
{
    x = fabs(x);
    y = fabs(y);
    double off_x = x > 0 ? LRCSI_U * (2 * t * x + fabs(corner[0])) : 0;
    double off_y = y > 0 ? LRCSI_U * (2 * t * y + fabs(corner[1])) : 0;
    return (1 + 8 * LRCSI_U) * (x * off_y + y * off_x) / lrcsi_max(x, y);
}

double lrcsi_cells_shape_divide(const lrcsi_clip_polygon *shape, const double line[3],
                                lrcsi_clip_polygon *left, lrcsi_clip_polygon *right)
{
    double drift = 0;
    left->count = right->count = 0;
    for (uint32_t i = 0; i < shape->count; i++) {
        const double *here = shape->corner[i];
        const double *next = shape->corner[i + 1 < shape->count ? i + 1 : 0];
        double a = lrcsi_line_at(line, here[0], here[1]);
        double b = lrcsi_line_at(line, next[0], next[1]);
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
            drift = lrcsi_max(drift, corner_drift(next[0] - here[0], next[1] - here[1], t, corner));
        }
    }
    return drift;
}
