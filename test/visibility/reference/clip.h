/* SPDX-License-Identifier: MIT */
/* What the former clipping asks of convex pieces (visibility/clip.h) beside: how they stand to
   lines. visibility/reference/occlude.c accounts for their error. */
#ifndef REF_CLIP_H
#define REF_CLIP_H

#include "visibility/clip.h"

/* A directed segment, from `at` to `at + to`, and the line through it. */
typedef struct lrcsi_clip_line {
    double at[2], to[2];
} lrcsi_clip_line;

/* The signed distance of a point from the line, positive on its left, times the length of `to`. */
static inline double lrcsi_clip_side(const lrcsi_clip_line *line, const double p[2])
{
    return line->to[0] * (p[1] - line->at[1]) - line->to[1] * (p[0] - line->at[0]);
}

/* The line that halves a piece across the longer side of its box. */
lrcsi_clip_line ref_clip_halving(const lrcsi_clip_polygon *polygon);

/* Splits a polygon into the parts to the left and to the right of the line. A part with fewer than
   three corners is empty. Returns 0 if a part would have too many corners. */
int ref_clip_split(const lrcsi_clip_polygon *from, const lrcsi_clip_line *line,
                   lrcsi_clip_polygon *left, lrcsi_clip_polygon *right);

enum ref_clip_place {
    REF_CLIP_APART,  /* no point of the segment within the width of the piece */
    REF_CLIP_BESIDE, /* all of the piece on one side of the segment's line, as computed */
    REF_CLIP_CROSSES /* neither is sure */
};

/* How a segment stands to a piece: a ref_clip_place. */
int ref_clip_meets(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *segment, double width);

/* The length of that part of a segment along which the piece comes within `width` of its line, as
   computed. */
double ref_clip_within(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *segment,
                       double width);

/* The mean of a piece's corners. */
void ref_clip_middle(const lrcsi_clip_polygon *polygon, double middle[2]);

/* How far inside a piece a point lies, lower bound: at least so far from every side. */
double ref_clip_clear(const lrcsi_clip_polygon *polygon, const double at[2]);

#endif
