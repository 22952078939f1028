/* SPDX-License-Identifier: MIT */
/* Convex pieces and lines: what only the former clipping needs, in addition to visibility/base/clip.h.
   Rounding errors are accounted for in reference/occlude.c. */
#ifndef REF_CLIP_H
#define REF_CLIP_H

#include "visibility/base/clip.h"

/* A directed segment, from `at` to `at + to`, and the line through it. */
typedef struct lrcsi_clip_line {
    double at[2], to[2];
} lrcsi_clip_line;

/* The signed distance of a point from the line, positive on its left, times the length of `to`. */
static inline double lrcsi_clip_side(const lrcsi_clip_line *line, const double p[2])
{
    return line->to[0] * (p[1] - line->at[1]) - line->to[1] * (p[0] - line->at[0]);
}

/* The line that halves a piece across the longer side of its bounding box. */
lrcsi_clip_line ref_clip_halving(const lrcsi_clip_polygon *polygon);

/* Splits a polygon into the parts to the left and to the right of the line. A part with fewer than
   three corners is empty. Returns 0 if a part would have too many corners. */
int ref_clip_split(const lrcsi_clip_polygon *from, const lrcsi_clip_line *line,
                   lrcsi_clip_polygon *left, lrcsi_clip_polygon *right);

enum ref_clip_place {
    REF_CLIP_APART,  /* no point of the segment is within `width` of the piece */
    REF_CLIP_BESIDE, /* the computed piece lies on one side of the segment's line */
    REF_CLIP_CROSSES /* neither is certain */
};

/* The position of a segment relative to a piece: a ref_clip_place. */
int ref_clip_meets(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *segment, double width);

/* The computed length of the part of a segment along which the piece comes within `width` of the
   segment's line. */
double ref_clip_within(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *segment,
                       double width);

/* The mean of a piece's corners. */
void ref_clip_middle(const lrcsi_clip_polygon *polygon, double middle[2]);

/* Lower bound of the distance of a point inside a piece from every side of it. */
double ref_clip_clear(const lrcsi_clip_polygon *polygon, const double at[2]);

#endif
