/* SPDX-License-Identifier: MIT */
/* The segments of a division, and its first cell. Which segments there are is decided by the
   caller; cells are cut in visibility/cells/cells_cut.c. */
#include "visibility/cells/cells_division.h"

#include "visibility/index/event.h"

lrcsi_cells_segment *lrcsi_division_segment(lrcsi_division *d)
{
    if (d->segment_count == d->segment_room) {
        return NULL;
    }
    lrcsi_cells_segment *e = &d->segment[d->segment_count++];
    *e = (lrcsi_cells_segment){.owner = {LRCS_NONE, LRCS_NONE}, .edge = LRCS_NONE};
    return e;
}

lrcsi_cells_segment *lrcsi_division_edge(lrcsi_division *d, uint32_t edge)
{
    lrcsi_cells_segment *e = lrcsi_division_segment(d);
    if (e) {
        const lrcsi_edge_facets on = lrcsi_edge_facets_of(d->view, edge, LRCS_NONE);
        e->owner[0] = lrcsi_division_owner(d, on.facet[0]);
        e->owner[1] = lrcsi_division_owner(d, on.facet[1]);
        e->edge = on.count > 2 ? edge : LRCS_NONE;
    }
    return e;
}

int lrcsi_division_edge_marked(const lrcsi_division *d, uint32_t edge, const lrcsi_marks *marks)
{
    const lrcsi_topology *topology = &d->view->prepared->topology;
    const lrcsi_edge_use *use = topology->use + topology->edge[edge].first_use;
    int marked = 0;
    for (uint32_t i = 0; i < topology->edge[edge].uses && !marked; i++) {
        marked = lrcsi_marked(marks, lrcsi_division_owner(d, use[i].facet));
    }
    return marked;
}

void lrcsi_division_start(lrcsi_division *d, lrcsi_cell *cell)
{
    cell->segment = d->segment_lists;
    cell->segment_count = d->segment_count;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        cell->segment[i] = i;
    }
    d->stack[0] = *cell;
    d->stack_count = 1;
}
