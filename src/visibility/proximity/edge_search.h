/* SPDX-License-Identifier: MIT */
/* Where to look for event edges near a facet in projection: in a box, and in rows of the grid
   between the facet's sides, whose errors include the largest relevant distance. An edge is too far
   away if all of it is beyond a line parallel to one of the sides, at a distance given for it. */
#ifndef LRCSI_EDGE_SEARCH_H
#define LRCSI_EDGE_SEARCH_H

#include "base/outward.h"
#include "visibility/index/grid.h"
#include "visibility/proximity/edge_rectangle.h"

typedef struct lrcsi_edge_search {
    double low[3], high[3];
    lrcsi_grid_walk rows; /* over the buckets that may list such edges */
    double outward[3][2]; /* unit normals of the sides; 0: the side has no length */
    double highest[3];    /* outward . x <= highest of the facet, errors included */
} lrcsi_edge_search;

/* For edges at a distance of at most `near` from a facet. */
lrcsi_edge_search lrcsi_edge_search_make(const lrcsi_view *view, const lrcsi_grid *grid,
                                         uint32_t facet, double near);

/* outward . x of a point, with `err` times its position's error added. */
static inline double lrcsi_edge_search_height(const lrcsi_edge_search *search, int side,
                                              const double x[3], double err)
{
    return search->outward[side][0] * x[0] + search->outward[side][1] * x[1] +
           err * lrcsi_view_point_err(x);
}

/* Is the whole edge a b, in view coordinates, farther than `near` from the facet beyond one of its
   sides? *line is the side that is tried first; it becomes the one that excludes the edge, and is
   likely to exclude the next one. */
static inline int lrcsi_edge_search_excludes(const lrcsi_edge_search *search, const double a[3],
                                             const double b[3], double near, int *line)
{
    int side = *line;
    const double beyond = near * LRCSI_OUTWARD_SUM;
    for (int i = 0; i < 3; i++) {
        const double limit = search->highest[side] + beyond;
        if (lrcsi_edge_search_height(search, side, a, -LRCSI_EDGE_RECTANGLE_ERR) > limit &&
            lrcsi_edge_search_height(search, side, b, -LRCSI_EDGE_RECTANGLE_ERR) > limit) {
            *line = side;
            return 1;
        }
        side = side < 2 ? side + 1 : 0;
    }
    return 0;
}

#endif
