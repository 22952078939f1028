/* SPDX-License-Identifier: MIT */
/* Rectangles about event edges in projection, and what of a facet lies in them. All distances are
   increased by the errors of the positions between which they are measured. */
#ifndef LRCSI_EDGE_RECTANGLE_H
#define LRCSI_EDGE_RECTANGLE_H

#include "mesh/slice.h"
#include "view/view.h"

/* Contains all points of a facet within some distance of an edge. It extends by `half_width` to
   either side, by `before` before a, and by `beyond` beyond b. */
typedef struct lrcsi_edge_rectangle {
    const double *a, *b;
    double along[3];
    double half_width, before, beyond;
    double err;  /* a bound on the error of distances from the edge's line, within the rectangle */
    int reverse; /* a is the edge's end `high` */
    int has_sides;       /* 0: the edge has no length in projection; the rectangle is a square about
                            it, and the next two are not set */
    double across[3];    /* the unit vector perpendicular to the edge, in the axes of the scene */
    double rotation_err; /* bound on the error of its direction, rad */
} lrcsi_edge_rectangle;

/* Bound on the position errors of a facet's corners and of positions computed from them. */
double lrcsi_edge_rectangle_facet_err(const lrcsi_view *view, uint32_t facet);

/* The rectangle of points of a facet within `slack` of an edge. */
lrcsi_edge_rectangle lrcsi_edge_rectangle_make(const lrcsi_view *view, uint32_t facet,
                                               const lrcsi_edge *edge, double slack);

/* What of a facet lies in the rectangle about an edge. */
lrcsi_slice lrcsi_edge_rectangle_slice(const lrcsi_view *view, uint32_t facet,
                                       const lrcsi_edge_rectangle *box);

/* A part of a segment from one point to another, as fractions of the way. */
typedef struct lrcsi_segment_part {
    double from, to; /* from > to: it is empty */
} lrcsi_segment_part;

static inline int lrcsi_segment_part_is_empty(lrcsi_segment_part part)
{
    return part.from > part.to;
}

/* Limits it to where a function that is linear along the segment, of the values `first` and `last`
   at its ends, is at most `limit`. */
void lrcsi_segment_part_limit(lrcsi_segment_part *part, double first, double last, double limit);

/* The part of a segment between two points in view coordinates that may lie in the rectangle. */
lrcsi_segment_part lrcsi_edge_rectangle_part(const lrcsi_edge_rectangle *box, const double p[3],
                                             const double q[3]);

/* The part of a slice in the rectangle that may lie at most `depth` to the left of the edge's line
   (side 1), or to the right of it (-1), seen from low to high. */
lrcsi_slice lrcsi_edge_rectangle_limit(lrcsi_slice slice, const lrcsi_edge_rectangle *box, int side,
                                       double depth);

/* 1 if wherever the edge is within `slack` of a point of a facet in projection, it is at least 2
   slack behind that point; the same for all points of the facet's plane. */
int lrcsi_edge_rectangle_behind(const lrcsi_view *view, uint32_t facet, const lrcsi_edge *edge,
                                double slack);
int lrcsi_edge_rectangle_behind_plane(const lrcsi_view *view, uint32_t facet,
                                      const lrcsi_edge *edge, double slack);

/* The errors of positions computed here, of their differences and of what these are compared with,
   as a multiple of the error of view coordinates: at most two positions, three products and three
   sums in each, which add less than the positions' own errors. */
#define LRCSI_EDGE_RECTANGLE_ERR 8.0

#endif
