/* SPDX-License-Identifier: MIT */
/* The lines parallel to the sides of a facet beyond which event edges are too far away. It does not
   decide how far that is (visibility/proximity/event_band.c). */
#include "visibility/proximity/edge_search.h"

#include <math.h>

#include "base/range.h"
#include "visibility/proximity/edge_rectangle.h"

/* The outward normal of a side and how far the facet extends along it. Nothing is beyond a side
   without length. */
static void search_side(lrcsi_edge_search *search, int side, const double *const corner[3])
{
    const double *from = corner[side];
    const double *to = corner[(side + 1) % 3];
    const double *apex = corner[(side + 2) % 3];
    double x = to[1] - from[1];
    double y = from[0] - to[0];
    double length = sqrt(x * x + y * y);
    double sign = x * (apex[0] - from[0]) + y * (apex[1] - from[1]) > 0 ? -1 : 1;
    search->outward[side][0] = length > 0 ? sign * x / length : 0;
    search->outward[side][1] = length > 0 ? sign * y / length : 0;
    double highest = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        highest = lrcsi_max(
            highest, lrcsi_edge_search_height(search, side, corner[k], LRCSI_EDGE_RECTANGLE_ERR));
    }
    search->highest[side] = length > 0 ? highest : HUGE_VAL;
}

lrcsi_edge_search lrcsi_edge_search_make(const lrcsi_view *view, const lrcsi_grid *grid,
                                         uint32_t facet, double near)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double wide = near + lrcsi_edge_rectangle_facet_err(view, facet);
    const double *const point[3] = {view->point[corner[0]].x, view->point[corner[1]].x,
                                    view->point[corner[2]].x};
    lrcsi_edge_search search;
    lrcsi_view_bounds(view, corner, 3, search.low, search.high);
    for (int k = 0; k < 3; k++) {
        search.low[k] -= wide;
        search.high[k] += wide;
        search_side(&search, k, point);
    }
    const lrcsi_view_box box = lrcsi_view_box_round(view, search.low, search.high);
    const lrcsi_grid_rect buckets = lrcsi_grid_buckets(grid, &box);
    lrcsi_grid_walk_begin(grid, buckets, &search.rows);
    if (buckets.x1 - buckets.x0 > 1 && buckets.y1 - buckets.y0 > 1) {
        lrcsi_grid_walk_limit(&search.rows, corner, 3, near);
    }
    return search;
}
