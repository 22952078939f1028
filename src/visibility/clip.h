/* SPDX-License-Identifier: MIT */
/* Convex polygons in a facet's frame of the view plane, measured. They are cut in
   visibility/cells_shape.h. */
#ifndef LRCSI_CLIP_H
#define LRCSI_CLIP_H

#include <stdint.h>

/* A convex polygon, counter-clockwise. */
#define LRCSI_CLIP_SIDES 32u
typedef struct lrcsi_clip_polygon {
    double corner[LRCSI_CLIP_SIDES][2];
    uint32_t count;
} lrcsi_clip_polygon;

/* A directed segment, from `at` to `at + to`, and the line through it. */
typedef struct lrcsi_clip_line {
    double at[2], to[2];
} lrcsi_clip_line;

/* The signed distance of a point from the line, positive on its left, times the length of `to`. */
double lrcsi_clip_side(const lrcsi_clip_line *line, const double p[2]);

void lrcsi_clip_triangle(const double corner[3][2], lrcsi_clip_polygon *polygon);
double lrcsi_clip_area(const lrcsi_clip_polygon *polygon);
void lrcsi_clip_box(const lrcsi_clip_polygon *polygon, double low[2], double high[2]);

/* The perimeter of the bounding box: an upper bound of that of the polygon. */
double lrcsi_clip_perimeter(const lrcsi_clip_polygon *polygon);

/* The area of a counter-clockwise triangle within the unit square at `low`. With corners at most C
   away from the square along either axis, the error is less than 16 u (C + 1) + 10 u: within the
   square the sides rise and fall by 2 in total, the first subtraction adds u C, and the error of x
   along a side is 6 u (C + 1) (clip.c). */
double lrcsi_clip_box_area(const double corner[3][2], const double low[2]);

#endif
