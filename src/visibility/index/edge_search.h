/* SPDX-License-Identifier: MIT */
/* Where to look for event edges near facets in projection: in a box around them, and between the
   sides of a facet, or of a rectangle around several facets. An edge is excluded if all of it is
   certainly beside the box, or beyond a line parallel to one of the sides, at a distance given for
   the edge: true positions count, of which those in the view have errors. */
#ifndef LRCSI_EDGE_SEARCH_H
#define LRCSI_EDGE_SEARCH_H

#include "base/outward.h"
#include "visibility/index/grid.h"

/* The errors of a position and of its distance from a line, as a multiple of the error of view
   coordinates: two products and two sums, of a unit vector to within 3 u. */
#define LRCSI_EDGE_SEARCH_ERR 8.0

typedef struct lrcsi_edge_search {
    double low[3], high[3]; /* the box, larger by the distance that the search was made for */
    int sides;              /* 3 or 4 */
    double outward[4][2];   /* unit normals of the sides; 0: the side has no length */
    double highest[4];      /* outward . x <= highest of the facets, errors included */
} lrcsi_edge_search;

/* For edges at a distance of at most `near` from a facet. */
lrcsi_edge_search lrcsi_edge_search_make(const lrcsi_view *view, uint32_t facet, double near);

/* For edges at a distance of at most `near` from any of several facets. Such an edge is listed in a
   bucket that the walk meets. */
lrcsi_edge_search lrcsi_edge_search_around(const lrcsi_view *view, const lrcsi_grid *grid,
                                           const uint32_t *facet, uint32_t count, double near,
                                           lrcsi_grid_walk *walk);

static inline double lrcsi_edge_search_height(const lrcsi_edge_search *search, int side,
                                              const double x[3])
{
    return search->outward[side][0] * x[0] + search->outward[side][1] * x[1];
}

/* Is the whole edge a b, in view coordinates, farther than `near` from the facets: beside the box,
   or beyond one of the sides? *line is the side that is tried first; it becomes the one that
   excludes the edge, and is likely to exclude the next one. */
static inline int lrcsi_edge_search_excludes(const lrcsi_edge_search *search, const double a[3],
                                             const double b[3], double near, int *line)
{
    int side = *line;
    const double beyond = near * LRCSI_OUTWARD_SUM;
    const double a_err = LRCSI_EDGE_SEARCH_ERR * lrcsi_view_point_err(a);
    const double b_err = LRCSI_EDGE_SEARCH_ERR * lrcsi_view_point_err(b);
    for (int k = 0; k < 2; k++) {
        if ((a[k] - a_err > search->high[k] && b[k] - b_err > search->high[k]) ||
            (a[k] + a_err < search->low[k] && b[k] + b_err < search->low[k])) {
            return 1;
        }
    }
    for (int i = 0; i < search->sides; i++) {
        const double limit = search->highest[side] + beyond;
        if (lrcsi_edge_search_height(search, side, a) - a_err > limit &&
            lrcsi_edge_search_height(search, side, b) - b_err > limit) {
            *line = side;
            return 1;
        }
        side = side + 1 < search->sides ? side + 1 : 0;
    }
    return 0;
}

#endif
