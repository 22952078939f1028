/* SPDX-License-Identifier: MIT */
/* The convex polygon of a cell: lines along its sides, how lines, boxes and segments stand to it,
   and how it is divided along a line (visibility/cells.c). */
#ifndef LRCSI_CELLS_SHAPE_H
#define LRCSI_CELLS_SHAPE_H

#include "base/range.h"
#include "visibility/clip.h"

/* The line through two points: a x + b y + c is the distance from it, positive on the left. Returns
   how far they are apart, but for 4 u of it. */
double lrcsi_line_through(const double *p, const double *q, double line[3]);

static inline double lrcsi_line_at(const double line[3], double x, double y)
{
    return line[0] * x + line[1] * y + line[2];
}

/* Lines that a cell lies on the inner side of, one along each side of it. */
typedef struct lrcsi_cells_sides {
    double line[LRCSI_CLIP_SIDES][3];
    double moved[LRCSI_CLIP_SIDES]; /* how far out */
    double length[LRCSI_CLIP_SIDES];
    uint32_t count;
    double low[2], high[2];
    double perimeter;
    double g; /* what was given for places near the cell */
} lrcsi_cells_sides;

/* Makes them for a cell, of which is said what holds of places within `g` of it. */
void lrcsi_cells_sides_make(const lrcsi_clip_polygon *p, double g, lrcsi_cells_sides *s);

/* How a line passes the corners of a cell: the least and the most distance. */
void lrcsi_line_range(const lrcsi_clip_polygon *shape, const double line[3], double range[2]);

/* The same of a box around it: the range is as wide or wider. */
void lrcsi_box_range(const double low[2], const double high[2], const double line[3],
                     double range[2]);

/* What of a segment is in a cell, or near it: between two shares of its length; at the border, how
   far from there places are undecided. */
typedef struct lrcsi_cells_part {
    double from, to, strip;
} lrcsi_cells_part;

/* Is the box of a segment from p to q farther than w from that of the cell? */
static inline int lrcsi_cells_box_away(const lrcsi_cells_sides *s, const double p[2],
                                       const double q[2], double w)
{
    double x = lrcsi_most(s->low[0] - lrcsi_most(p[0], q[0]), lrcsi_least(p[0], q[0]) - s->high[0]);
    double y = lrcsi_most(s->low[1] - lrcsi_most(p[1], q[1]), lrcsi_least(p[1], q[1]) - s->high[1]);
    return lrcsi_most(x, y) > w;
}

enum lrcsi_cells_place {
    LRCSI_CELLS_AWAY,   /* no point of the segment within its error of the cell */
    LRCSI_CELLS_BORDER, /* nowhere deeper than its error within the cell */
    LRCSI_CELLS_MEETS   /* neither is sure */
};

/* How a segment from p to q, known to w, on a line that is known to line_w, stands to a cell: a
   lrcsi_cells_place; the part is told where it is not away. */
int lrcsi_cells_place_of(const lrcsi_clip_polygon *shape, const lrcsi_cells_sides *s,
                         const double p[2], const double q[2], const double line[3], double w,
                         double line_w, lrcsi_cells_part *part);

/* A lower bound of how far inside the cell a point lies (as lrcsi_clip_clear). */
double lrcsi_cells_sides_clear(const lrcsi_cells_sides *s, const double at[2]);

/* Keeps what lies left of a line. */
void lrcsi_cells_shape_clip(lrcsi_clip_polygon *shape, const double line[3]);

/* Divides a shape along a line, into what lies left of it and what lies right of it. Returned: how
   far the new corners are from the sides that they cut, at most. */
double lrcsi_cells_shape_divide(const lrcsi_clip_polygon *shape, const double line[3],
                                lrcsi_clip_polygon *left, lrcsi_clip_polygon *right);

#endif
