/* SPDX-License-Identifier: MIT */
/* A line of sight through a facet, against the facets listed in its grid cell. */
#include "visibility/query.h"

#include <math.h>

#include "visibility/sample.h"

/* A point that the facet covers, on the facet but for rounding. Where the facet is so thin that
   such points round outside, a corner: moved by an infinitesimal one way or the other, the line
   through one of them enters the facet, whatever its shape (of the lines through the corners of a
   triangle that are parallel to a given one, the middle one passes inside). Returns that sense. */
static int inside_point(const lrcsi_view *view, uint32_t facet, double point[3])
{
    static const double weight[4][3] = {
        {1 / 3.0, 1 / 3.0, 1 / 3.0}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            point[k] = 0;
            for (int corner = 0; corner < 3; corner++) {
                point[k] +=
                    weight[i][corner] * lrcsi_prepared_corner(view->prepared, facet, corner)[k];
            }
        }
        if (lrcsi_sample_covers(view, facet, point)) {
            return 1;
        }
    }
    for (int i = 0; i < 6; i++) {
        const double *corner = lrcsi_prepared_corner(view->prepared, facet, i % 3);
        int sense = i < 3 ? 1 : -1;
        for (int k = 0; k < 3; k++) {
            point[k] = corner[k];
        }
        if (lrcsi_sample_covers_towards(view, facet, point, sense)) {
            return sense;
        }
    }
    return 0;
}

/* The view coordinates of a point near the scene's coordinates. */
static void view_of(const lrcsi_view *view, const double *point, double xy[2])
{
    for (int k = 0; k < 2; k++) {
        xy[k] = 0;
        for (int j = 0; j < 3; j++) {
            xy[k] += view->R[k][j] * (point[j] - view->prepared->centre[j]);
        }
    }
}

static int box_misses(const lrcsi_view *view, uint32_t facet, const double xy[2])
{
    double low[2];
    double high[2];
    lrcsi_grid_box(view, view->prepared->scene->facet[facet].corner, 3, low, high);
    double off = 2 * view->off;
    return xy[0] < low[0] - off || xy[0] > high[0] + off || xy[1] < low[1] - off ||
           xy[1] > high[1] + off;
}

int lrcsi_query_facet(const lrcsi_grid *facets, uint32_t facet)
{
    const lrcsi_view *view = facets->view;
    double point[3];
    int sense = inside_point(view, facet, point);
    if (sense == 0) {
        return LRCSI_QUERY_UNDECIDED;
    }
    double xy[2];
    view_of(view, point, xy);
    lrcsi_cells cells = lrcsi_grid_cells(facets, xy, xy);
    int answer = LRCSI_QUERY_VISIBLE;
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = facets->first[(size_t)y * facets->size + cells.x0];
        uint32_t end = facets->first[(size_t)y * facets->size + cells.x1];
        for (; i < end; i++) {
            uint32_t other = facets->item[i];
            if (other == facet || box_misses(view, other, xy) ||
                !lrcsi_sample_covers_towards(view, other, point, sense)) {
                continue;
            }
            int nearer = lrcsi_sample_nearer(view, other, facet, point);
            if (nearer > 0) {
                return LRCSI_QUERY_HIDDEN;
            }
            answer = nearer == 0 ? LRCSI_QUERY_UNDECIDED : answer;
        }
    }
    return answer;
}
