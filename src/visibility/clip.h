/* SPDX-License-Identifier: MIT */
/* Subtracting convex polygons from a facet: what is left is a list of convex pieces. Plain doubles
   in the facet's own frame of the view plane; visibility/occlude.c accounts for their error. */
#ifndef LRCSI_CLIP_H
#define LRCSI_CLIP_H

#include <lrcs/work.h>

#include <stdint.h>

/* Corners of all pieces together, and pieces, that a facet may fall into. */
#define LRCSI_CLIP_CORNERS 8192u
#define LRCSI_CLIP_PIECES  1024u

/* A convex piece, counter-clockwise. */
#define LRCSI_CLIP_SIDES 32u
typedef struct lrcsi_clip_polygon {
    double corner[LRCSI_CLIP_SIDES][2];
    uint32_t count;
} lrcsi_clip_polygon;

/* A line, positive on its left: through `at` along `to`. */
typedef struct lrcsi_clip_line {
    double at[2], to[2];
    double width; /* by which its true place may be off; overlaps alone look at it */
} lrcsi_clip_line;

/* A convex region: the left sides of at most four lines, and its box. */
typedef struct lrcsi_clip_region {
    lrcsi_clip_line line[4];
    int lines;
    double low[2], high[2];
    double width; /* of the box, as that of a line */
} lrcsi_clip_region;

typedef struct lrcsi_clip_list {
    double (*corner)[2];
    uint32_t *end; /* piece i is corner[lrcsi_clip_first .. end[i]) */
    uint32_t pieces;
} lrcsi_clip_list;

/* Where piece i of a list starts. */
static inline uint32_t lrcsi_clip_first(const lrcsi_clip_list *list, uint32_t i)
{
    return i == 0 ? 0 : list->end[i - 1];
}

typedef struct lrcsi_clip {
    lrcsi_clip_list list, spare;
    uint32_t splits; /* pieces split in two so far */
} lrcsi_clip;

/* Bytes lrcsi_clip_make takes. */
size_t lrcsi_clip_need(void);
int lrcsi_clip_make(lrcs_work *work, lrcsi_clip *clip);

void lrcsi_clip_triangle(const double corner[3][2], lrcsi_clip_polygon *polygon);
double lrcsi_clip_corners_area(const double (*corner)[2], uint32_t count);
double lrcsi_clip_polygon_area(const lrcsi_clip_polygon *polygon);

/* That of its box: the longest that a convex figure within it can have. */
double lrcsi_clip_polygon_perimeter(const lrcsi_clip_polygon *polygon);

/* Halves a piece across the longer side of its box. Either half may come out with less than three
   corners: then it is nothing. */
void lrcsi_clip_halve(const lrcsi_clip_polygon *polygon, lrcsi_clip_polygon *left,
                      lrcsi_clip_polygon *right);

/* The area that a counter-clockwise triangle has in the unit square at `low`. */
double lrcsi_clip_box_area(const double corner[3][2], const double low[2]);

enum lrcsi_clip_overlap_kind {
    LRCSI_CLIP_NONE,    /* surely apart, by more than the widths */
    LRCSI_CLIP_SOME,    /* none of the others */
    LRCSI_CLIP_COVERED, /* the region covers the piece, as computed */
    LRCSI_CLIP_BURIED   /* surely covers it */
};

/* How a region stands to a piece. */
int lrcsi_clip_overlap(const lrcsi_clip_polygon *polygon, const lrcsi_clip_region *region);

/* Starts again with one piece. */
void lrcsi_clip_start(lrcsi_clip *clip, const lrcsi_clip_polygon *polygon);

/* Takes a region away. 0 where the pieces would outgrow the lists; then nothing was taken. */
int lrcsi_clip_subtract(lrcsi_clip *clip, const lrcsi_clip_region *region);

/* May a segment of a line, or what else is in its box (where the line has no direction), come
   within `width` of a piece? 0: surely not. */
int lrcsi_clip_meets(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *line,
                     const double low[2], const double high[2], double width);

/* A point inside a piece, farther than `margin` from each of its sides: the mean of its corners; 0
   where that one is not. */
int lrcsi_clip_middle(const lrcsi_clip_polygon *polygon, double margin, double middle[2]);

/* The pieces' area. */
double lrcsi_clip_area(const lrcsi_clip *clip);

#endif
