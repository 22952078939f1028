/* SPDX-License-Identifier: MIT */
/* Who continues a facet across its sides. All edges of rims and of facets with another in their
   plane count as events, so that no component goes on across them. */
#include "visibility/cells_join.h"

#include "visibility/grid.h"

int lrcsi_cells_apart(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        if (intersections->entry[i].kind == LRCSI_INTERSECTION_COPLANAR &&
            lrcsi_grid_casts(view, intersections->entry[i].other)) {
            return 1;
        }
    }
    return 0;
}

/* Across an irregular edge: the other of two facets on opposite sides of it (as edge_kind_of in
   visibility/event.c). */
static uint32_t odd_neighbour(const lrcsi_view *view, uint32_t facet, uint32_t edge)
{
    const lrcsi_topology *t = &view->prepared->topology;
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    uint32_t other = LRCS_NONE;
    uint32_t count = 0;
    int left = 0;
    for (uint32_t i = 0; i < t->edge[edge].uses; i++) {
        if (lrcsi_grid_casts(view, use[i].facet)) {
            other = use[i].facet != facet ? use[i].facet : other;
            count++;
            left += use[i].forward ? view->facing[use[i].facet] : -view->facing[use[i].facet];
        }
    }
    return count == 2 && left == 0 ? other : LRCS_NONE;
}

uint32_t lrcsi_cells_joined(const lrcsi_view *view, uint32_t facet, int k)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t other = p->across.facet[facet].corner[k];
    if (other == facet) {
        return odd_neighbour(view, facet, p->topology.facet_edge[facet].corner[k]);
    }
    return other < p->scene->facet_count && lrcsi_grid_casts(view, other) &&
                   view->facing[other] == view->facing[facet]
               ? other
               : LRCS_NONE;
}

uint32_t lrcsi_cells_next(const lrcsi_view *view, const unsigned char *kind, uint32_t facet, int k)
{
    uint32_t other = lrcsi_cells_joined(view, facet, k);
    return other != LRCS_NONE && ((kind[facet] | kind[other]) & LRCSI_CELLS_APART) == 0 &&
                   !lrcsi_intersection_along(&view->prepared->intersections, facet, k)
               ? other
               : LRCS_NONE;
}

int lrcsi_cells_side_number(const lrcsi_view *view, uint32_t facet, int k)
{
    return view->facing[facet] > 0 ? k : 2 - k;
}
