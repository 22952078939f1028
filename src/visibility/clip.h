/* SPDX-License-Identifier: MIT */
/* Convex pieces of a facet, in plain doubles of its own frame of the view plane: split and
 * measured. */
#ifndef LRCSI_CLIP_H
#define LRCSI_CLIP_H

#include <stdint.h>

/* A convex piece, counter-clockwise. */
#define LRCSI_CLIP_SIDES 32u
typedef struct lrcsi_clip_polygon {
    double corner[LRCSI_CLIP_SIDES][2];
    uint32_t count;
} lrcsi_clip_polygon;

/* A segment, and its line, positive on the left: from `at`, along `to` and as long. */
typedef struct lrcsi_clip_line {
    double at[2], to[2];
} lrcsi_clip_line;

/* Positive where a point lies left of the line: the distance, times the length of `to`. */
double lrcsi_clip_side(const lrcsi_clip_line *line, const double p[2]);

void lrcsi_clip_triangle(const double corner[3][2], lrcsi_clip_polygon *polygon);
double lrcsi_clip_area(const lrcsi_clip_polygon *polygon);
void lrcsi_clip_box(const lrcsi_clip_polygon *polygon, double low[2], double high[2]);

/* That of its box: the longest that a convex figure within it can have. */
double lrcsi_clip_perimeter(const lrcsi_clip_polygon *polygon);

/* Splits a piece into what lies left of the line and what lies right of it. Either may come out
   with less than three corners: then it is nothing. 0 if one would have too many. */
int lrcsi_clip_split(const lrcsi_clip_polygon *from, const lrcsi_clip_line *line,
                     lrcsi_clip_polygon *left, lrcsi_clip_polygon *right);

/* The area that a counter-clockwise triangle has in the unit square at `low`. Within it its sides
   rise and fall by 2 in all, and run to and fro by as much: so with corners at most C away from it
   along either axis, of which the first subtraction takes u, and sides off by 6 u (C + 1) along x
   (clip.c), the area is off by less than 16 u (C + 1) + 10 u. */
double lrcsi_clip_box_area(const double corner[3][2], const double low[2]);

#endif
