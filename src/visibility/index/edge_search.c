/* SPDX-License-Identifier: MIT */
/* The lines parallel to the sides of facets, or of a rectangle around them, beyond which event
   edges are too far away. It does not decide how far that is. */
#include "visibility/index/edge_search.h"

#include <math.h>

#include "base/range.h"

/* An empty box and no sides. */
static lrcsi_edge_search search_empty(void)
{
    return (lrcsi_edge_search){.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                               .high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

/* Extends the box, and the heights of the sides, to a facet and to what is within `near` of it. */
static void search_add(lrcsi_edge_search *search, const lrcsi_view *view, uint32_t facet,
                       double near)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double wide = near + LRCSI_EDGE_SEARCH_ERR * lrcsi_view_facet_err(view, facet);
    double low[3];
    double high[3];
    lrcsi_view_bounds(view, corner, 3, low, high);
    for (int k = 0; k < 3; k++) {
        search->low[k] = lrcsi_min(search->low[k], low[k] - wide);
        search->high[k] = lrcsi_max(search->high[k], high[k] + wide);
    }
    for (int i = 0; i < 3; i++) {
        const double *x = view->point[corner[i]].x;
        const double err = LRCSI_EDGE_SEARCH_ERR * lrcsi_view_point_err(x);
        for (int side = 0; side < search->sides; side++) {
            const double height = lrcsi_edge_search_height(search, side, x) + err;
            search->highest[side] = lrcsi_max(search->highest[side], height);
        }
    }
}

/* The direction of a segment in projection, or 0 if it has no length. Returns its length. */
static double direction_of(const double from[3], const double to[3], double direction[2])
{
    const double x = to[0] - from[0];
    const double y = to[1] - from[1];
    const double length = sqrt(x * x + y * y);
    direction[0] = length > 0 ? x / length : 0;
    direction[1] = length > 0 ? y / length : 0;
    return length;
}

/* Nothing is beyond a side without length. */
lrcsi_edge_search lrcsi_edge_search_make(const lrcsi_view *view, uint32_t facet, double near)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    lrcsi_edge_search search = search_empty();
    search.sides = 3;
    for (int k = 0; k < 3; k++) {
        const double *from = view->point[corner[k]].x;
        const double *apex = view->point[corner[(k + 2) % 3]].x;
        double along[2];
        const double length = direction_of(from, view->point[corner[(k + 1) % 3]].x, along);
        const double sign =
            along[1] * (apex[0] - from[0]) - along[0] * (apex[1] - from[1]) > 0 ? -1 : 1;
        search.outward[k][0] = sign * along[1];
        search.outward[k][1] = -sign * along[0];
        search.highest[k] = length > 0 ? -HUGE_VAL : HUGE_VAL;
    }
    search_add(&search, view, facet, near);
    return search;
}

/* The longest side of a facet gives the direction of the rectangle's sides: adjacent facets of a
   curved wall are long in about the same direction. */
static void rectangle_sides(lrcsi_edge_search *search, const lrcsi_view *view, uint32_t facet)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double along[2] = {1, 0};
    double longest = 0;
    for (int k = 0; k < 3; k++) {
        double direction[2];
        const double length =
            direction_of(view->point[corner[k]].x, view->point[corner[(k + 1) % 3]].x, direction);
        if (length > longest) {
            longest = length;
            along[0] = direction[0];
            along[1] = direction[1];
        }
    }
    search->sides = 4;
    for (int side = 0; side < 4; side++) {
        const double sign = side < 2 ? 1 : -1;
        search->outward[side][0] = sign * (side % 2 == 0 ? along[0] : -along[1]);
        search->outward[side][1] = sign * (side % 2 == 0 ? along[1] : along[0]);
        search->highest[side] = -HUGE_VAL;
    }
}

/* A corner of the rectangle is computed from its heights over two adjacent sides, whose normals are
   orthogonal, and unit vectors to within 3 u. The heights contain the errors of the facets; an edge
   is listed wherever it may be by its own. */
lrcsi_edge_search lrcsi_edge_search_around(const lrcsi_view *view, const lrcsi_grid *grid,
                                           const uint32_t *facet, uint32_t count, double near,
                                           lrcsi_grid_walk *walk)
{
    lrcsi_edge_search search = search_empty();
    lrcsi_view_vertex corner[4];
    rectangle_sides(&search, view, facet[0]);
    for (uint32_t i = 0; i < count; i++) {
        search_add(&search, view, facet[i], near);
    }
    for (int k = 0; k < 4; k++) {
        const double *one = search.outward[k];
        const double *next = search.outward[(k + 1) % 4];
        const double height = search.highest[k] + near;
        const double across = search.highest[(k + 1) % 4] + near;
        corner[k] = (lrcsi_view_vertex){
            {one[0] * height + next[0] * across, one[1] * height + next[1] * across, 0},
            8 * LRCSI_U * (fabs(height) + fabs(across))};
    }
    const lrcsi_view_box box = lrcsi_view_box_round(view, search.low, search.high);
    const lrcsi_grid_rect buckets = lrcsi_grid_buckets(grid, &box);
    lrcsi_grid_walk_begin(grid, buckets, walk);
    if (buckets.x1 - buckets.x0 > 1 && buckets.y1 - buckets.y0 > 1) {
        lrcsi_grid_walk_limit(walk, corner, 4);
    }
    return search;
}
