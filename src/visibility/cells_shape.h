/* SPDX-License-Identifier: MIT */
/* The convex polygon of a cell: the lines along its sides, the position of other lines, boxes and
   segments relative to it, and its division along a line (visibility/cells.c). */
#ifndef LRCSI_CELLS_SHAPE_H
#define LRCSI_CELLS_SHAPE_H

#include <math.h>

#include "base/range.h"
#include "visibility/clip.h"

/* The line through two points: a x + b y + c is the distance from it, positive on the left. Returns
   the distance of the points, with a relative error of 4 u. */
double lrcsi_line_through(const double *p, const double *q, double line[3]);

static inline double lrcsi_line_at(const double line[3], double x, double y)
{
    return line[0] * x + line[1] * y + line[2];
}

/* Half-planes that contain a cell, one along each of its sides. */
typedef struct lrcsi_cells_sides {
    double line[LRCSI_CLIP_SIDES][3];
    double moved[LRCSI_CLIP_SIDES]; /* how far each line was moved outward */
    double length[LRCSI_CLIP_SIDES];
    uint32_t count;
    double low[2], high[2];
    double perimeter;
    double g; /* statements about the cell hold for all points within this distance of it */
} lrcsi_cells_sides;

/* Makes them for a cell. */
void lrcsi_cells_sides_make(const lrcsi_clip_polygon *p, double g, lrcsi_cells_sides *s);

/* The least and the largest signed distance of a cell's corners from a line. */
static inline void lrcsi_line_range(const lrcsi_clip_polygon *shape, const double line[3],
                                    double range[2])
{
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < shape->count; i++) {
        double d = lrcsi_line_at(line, shape->corner[i][0], shape->corner[i][1]);
        range[0] = lrcsi_min(range[0], d);
        range[1] = lrcsi_max(range[1], d);
    }
}

/* The same for a box: if it contains the cell, its range contains that of the cell. */
void lrcsi_box_range(const double low[2], const double high[2], const double line[3],
                     double range[2]);

/* The part of a segment in a cell or near it, between two fractions of its length; for a segment at
   the border, the width of the strip around it that is undecided. */
typedef struct lrcsi_cells_part {
    double from, to, strip;
} lrcsi_cells_part;

/* Is the box of a segment from p to q farther than w from that of the cell? */
static inline int lrcsi_cells_box_away(const lrcsi_cells_sides *s, const double p[2],
                                       const double q[2], double w)
{
    double x = lrcsi_max(s->low[0] - lrcsi_max(p[0], q[0]), lrcsi_min(p[0], q[0]) - s->high[0]);
    double y = lrcsi_max(s->low[1] - lrcsi_max(p[1], q[1]), lrcsi_min(p[1], q[1]) - s->high[1]);
    return lrcsi_max(x, y) > w;
}

enum lrcsi_cells_place {
    LRCSI_CELLS_AWAY,   /* no point of the segment within its error of the cell */
    LRCSI_CELLS_BORDER, /* nowhere deeper than its error within the cell; in a corner, twice that */
    LRCSI_CELLS_MEETS   /* neither is sure */
};

/* The position of a segment relative to a cell: a lrcsi_cells_place. Given: the ends p and q with
   the error w, and their line with the error line_w. The part is returned unless it is away. */
int lrcsi_cells_place_near(const lrcsi_clip_polygon *shape, const lrcsi_cells_sides *s,
                           const double p[2], const double q[2], const double line[3], double w,
                           double line_w, lrcsi_cells_part *part);

/* The same; boxes are compared first. */
static inline int lrcsi_cells_place_of(const lrcsi_clip_polygon *shape, const lrcsi_cells_sides *s,
                                       const double p[2], const double q[2], const double line[3],
                                       double w, double line_w, lrcsi_cells_part *part)
{
    return lrcsi_cells_box_away(s, p, q, w)
               ? LRCSI_CELLS_AWAY
               : lrcsi_cells_place_near(shape, s, p, q, line, w, line_w, part);
}

/* A lower bound of how far inside the cell a point lies (as lrcsi_clip_clear). */
double lrcsi_cells_sides_clear(const lrcsi_cells_sides *s, const double at[2]);

/* Keeps the part to the left of a line. */
void lrcsi_cells_shape_clip(lrcsi_clip_polygon *shape, const double line[3]);

/* Divides a shape along a line into the part to its left and the part to its right. Returns an
   upper bound of the distance of the new corners from the sides that they are on. */
double lrcsi_cells_shape_divide(const lrcsi_clip_polygon *shape, const double line[3],
                                lrcsi_clip_polygon *left, lrcsi_clip_polygon *right);

#endif
