/* SPDX-License-Identifier: MIT */
/* Convex polygons of the view plane: measured, divided along lines, and compared with lines, boxes
   and segments. */
#ifndef LRCSI_CLIP_H
#define LRCSI_CLIP_H

#include <math.h>
#include <stdint.h>

#include "base/constant.h"
#include "base/range.h"
#include "visibility/base/visible_area.h"

/* A convex polygon, counter-clockwise. */
#define LRCSI_CLIP_MAX_SIDES 32u
typedef struct lrcsi_clip_polygon {
    double corner[LRCSI_CLIP_MAX_SIDES][2];
    uint32_t count;
} lrcsi_clip_polygon;

void lrcsi_clip_triangle(const double corner[3][2], lrcsi_clip_polygon *polygon);

/* A copy of the corners that there are. */
static inline void lrcsi_clip_copy(const lrcsi_clip_polygon *from, lrcsi_clip_polygon *to)
{
    to->count = from->count;
    for (uint32_t i = 0; i < from->count; i++) {
        to->corner[i][0] = from->corner[i][0];
        to->corner[i][1] = from->corner[i][1];
    }
}

double lrcsi_clip_area(const lrcsi_clip_polygon *polygon);
/* The longest side of a triangle: the number of the corner at which it begins. *square: its length,
   squared. */
int lrcsi_clip_longest_side(const double corner[3][2], double *square);

/* Adds to moment->first the integral of x - about over a polygon, to moment->error the rounding
   error of this addition, and returns the largest distance of its corners from `about`. With n
   corners, the error of either component of the integral is at most 5 u n times that distance times
   the area of the polygon's box: each of its n - 2 triangles has an error of 4 u of the box in its
   area and 4 u in its centroid, and is added once. */
double lrcsi_clip_add_moment(const lrcsi_clip_polygon *polygon, const double about[2],
                             lrcsi_moment *moment);

/* The area of one triangle of the fan of a convex polygon about its corner c: that of c p q. *error
   is increased by a bound on its error in a sum to which negative areas should add nothing,
   rounding included. */
static inline double lrcsi_clip_fan_area(const double c[2], const double p[2], const double q[2],
                                         double *error)
{
    const double u[2] = {p[0] - c[0], p[1] - c[1]};
    const double v[2] = {q[0] - c[0], q[1] - c[1]};
    double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
    *error += lrcsi_max(0, -area) + 4 * LRCSI_U * (fabs(u[0] * v[1]) + fabs(u[1] * v[0]));
    return area;
}

void lrcsi_clip_box(const lrcsi_clip_polygon *polygon, double low[2], double high[2]);

/* The perimeter of the bounding box: an upper bound of that of the polygon. */
double lrcsi_clip_box_perimeter(const lrcsi_clip_polygon *polygon);

/* The area of a counter-clockwise triangle within the unit square at `low`. With corners at most C
   away from the square along either axis, the error is less than 16 u (C + 1) + 10 u: within the
   square the sides rise and fall by 2 in total, the first subtraction adds u C, and the error of x
   along a side is 6 u (C + 1). */
double lrcsi_clip_box_area(const double corner[3][2], const double low[2]);

/* The line through two points: a x + b y + c is the distance from it, positive on the left. Returns
   the distance of the points, with a relative error of 4 u. */
double lrcsi_line_through(const double *p, const double *q, double line[3]);

static inline double lrcsi_line_at(const double line[3], double x, double y)
{
    return line[0] * x + line[1] * y + line[2];
}

/* Half-planes that contain a cell, one along each of its sides. */
typedef struct lrcsi_clip_sides {
    double line[LRCSI_CLIP_MAX_SIDES][3];
    double shift[LRCSI_CLIP_MAX_SIDES]; /* how far each line was moved outward */
    double length[LRCSI_CLIP_MAX_SIDES];
    uint32_t count;
    double low[2], high[2];
    double perimeter;
    double tolerance; /* statements about the cell hold for all points within this distance of it */
} lrcsi_clip_sides;

void lrcsi_clip_sides_make(const lrcsi_clip_polygon *p, double tolerance, lrcsi_clip_sides *s);

/* The least and the largest signed distance of a cell's corners from a line. */
static inline void lrcsi_line_range(const lrcsi_clip_polygon *shape, const double line[3],
                                    double range[2])
{
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < shape->count; i++) {
        double d = lrcsi_line_at(line, shape->corner[i][0], shape->corner[i][1]);
        lrcsi_range_extend(d, &range[0], &range[1]);
    }
}

/* The same for a box: if it contains the cell, its range contains that of the cell. */
void lrcsi_box_range(const double low[2], const double high[2], const double line[3],
                     double range[2]);

/* Where a segment is in a cell or near it: between two fractions of its length; and, if it is at
   the border, the width of the undecided strip around it. */
typedef struct lrcsi_clip_interval {
    double from, to, strip_width;
} lrcsi_clip_interval;

/* Is the box of a segment from p to q farther than w from that of the cell? */
static inline int lrcsi_clip_box_outside(const lrcsi_clip_sides *s, const double p[2],
                                         const double q[2], double w)
{
    double x = lrcsi_max(s->low[0] - lrcsi_max(p[0], q[0]), lrcsi_min(p[0], q[0]) - s->high[0]);
    double y = lrcsi_max(s->low[1] - lrcsi_max(p[1], q[1]), lrcsi_min(p[1], q[1]) - s->high[1]);
    return lrcsi_max(x, y) > w;
}

enum lrcsi_clip_location {
    LRCSI_CLIP_OUTSIDE, /* the segment is farther from the cell than its error */
    LRCSI_CLIP_BORDER,  /* it extends into the cell by no more than its error; in a corner of the
                            cell, by no more than twice that */
    LRCSI_CLIP_CROSSES  /* neither is certain */
};

/* The position of a segment relative to a cell: a lrcsi_clip_location. Given: the ends p and q
   with the error w, and their line with the error line_w. The interval is returned unless
   it is outside. */
int lrcsi_clip_locate_near(const lrcsi_clip_polygon *shape, const lrcsi_clip_sides *s,
                           const double p[2], const double q[2], const double line[3], double w,
                           double line_w, lrcsi_clip_interval *interval);

/* The same; boxes are compared first. */
static inline int lrcsi_clip_locate(const lrcsi_clip_polygon *shape, const lrcsi_clip_sides *s,
                                    const double p[2], const double q[2], const double line[3],
                                    double w, double line_w, lrcsi_clip_interval *interval)
{
    return lrcsi_clip_box_outside(s, p, q, w)
               ? LRCSI_CLIP_OUTSIDE
               : lrcsi_clip_locate_near(shape, s, p, q, line, w, line_w, interval);
}

/* A lower bound of the distance of a point in the cell from the cell's border. */
double lrcsi_clip_border_distance(const lrcsi_clip_sides *s, const double at[2]);

/* Keeps the part to the left of a line. Returns 0, and leaves the shape as it is, if the part would
   have more sides than there is room for. */
int lrcsi_clip_keep_left(lrcsi_clip_polygon *shape, const double line[3]);

/* Divides a shape along a line into the part to its left and the part to its right. Returns an
   upper bound of the distance of the new corners from the sides that they are on; negative if a
   part would have more sides than there is room for: then the parts are not valid. */
double lrcsi_clip_divide(const lrcsi_clip_polygon *shape, const double line[3],
                         lrcsi_clip_polygon *left, lrcsi_clip_polygon *right);

#endif
