/* SPDX-License-Identifier: MIT */
/* Convex pieces of a facet, in plain doubles of its own frame of the view plane: split, measured,
   held against lines. visibility/occlude.c accounts for their error. */
#ifndef REF_CLIP_H
#define REF_CLIP_H

#include <stdint.h>

/* A convex piece, counter-clockwise. */
#define REF_CLIP_SIDES 32u
typedef struct ref_clip_polygon {
    double corner[REF_CLIP_SIDES][2];
    uint32_t count;
} ref_clip_polygon;

/* A segment, and its line, positive on the left: from `at`, along `to` and as long. */
typedef struct ref_clip_line {
    double at[2], to[2];
} ref_clip_line;

/* Positive where a point lies left of the line: the distance, times the length of `to`. */
double ref_clip_side(const ref_clip_line *line, const double p[2]);

void ref_clip_triangle(const double corner[3][2], ref_clip_polygon *polygon);
double ref_clip_area(const ref_clip_polygon *polygon);
void ref_clip_box(const ref_clip_polygon *polygon, double low[2], double high[2]);

/* That of its box: the longest that a convex figure within it can have. */
double ref_clip_perimeter(const ref_clip_polygon *polygon);

/* Splits a piece into what lies left of the line and what lies right of it. Either may come out
   with less than three corners: then it is nothing. 0 where one would have too many. */
int ref_clip_split(const ref_clip_polygon *from, const ref_clip_line *line, ref_clip_polygon *left,
                   ref_clip_polygon *right);

/* The line that halves a piece across the longer side of its box. */
ref_clip_line ref_clip_halving(const ref_clip_polygon *polygon);

/* The area that a counter-clockwise triangle has in the unit square at `low`. */
double ref_clip_box_area(const double corner[3][2], const double low[2]);

enum ref_clip_place {
    REF_CLIP_APART,  /* no point of the segment within the width of the piece */
    REF_CLIP_BESIDE, /* all of the piece on one side of the segment's line, as computed */
    REF_CLIP_CROSSES /* neither is sure */
};

/* How a segment stands to a piece: a ref_clip_place. */
int ref_clip_meets(const ref_clip_polygon *polygon, const ref_clip_line *segment, double width);

/* The length of that part of a segment along which the piece comes within `width` of its line, as
   computed. */
double ref_clip_within(const ref_clip_polygon *polygon, const ref_clip_line *segment, double width);

/* The mean of a piece's corners. */
void ref_clip_middle(const ref_clip_polygon *polygon, double middle[2]);

/* How far inside a piece a point lies, lower bound: at least so far from every side. */
double ref_clip_clear(const ref_clip_polygon *polygon, const double at[2]);

#endif
