/* SPDX-License-Identifier: MIT */
/* Where to look for event edges near a facet in projection: in a box, and in rows of the grid
   between the facet's sides, whose errors include the largest relevant distance. Beyond a line
   parallel to one of the sides event edges are too far away. */
#ifndef LRCSI_EDGE_SEARCH_H
#define LRCSI_EDGE_SEARCH_H

#include "visibility/grid.h"

typedef struct lrcsi_edge_search {
    double low[3], high[3];
    lrcsi_view_segment side[3];
    double outward[3][2], limit[3]; /* beyond line k outward[k] . x > limit[k], errors included */
    int first;                      /* the line to try first: the one that excluded the last edge */
} lrcsi_edge_search;

/* For edges at a distance of at most `near` from a facet. */
lrcsi_edge_search lrcsi_edge_search_make(const lrcsi_view *view, const lrcsi_grid *grid,
                                         uint32_t facet, double near);

/* Is the whole edge a b, in view coordinates, beyond one of the lines? */
int lrcsi_edge_search_excludes(lrcsi_edge_search *search, const double a[3], const double b[3]);

#endif
