/* SPDX-License-Identifier: MIT */
/* The segments of a division, and its first cell. Which segments there are is decided by the
   caller; cells are cut in visibility/cells/cells_cut.c. */
#include "visibility/cells/cells_division.h"

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
    const lrcsi_topology *t = &d->view->prepared->topology;
    lrcsi_cells_segment *e = lrcsi_division_segment(d);
    uint32_t owners = 0;
    for (uint32_t i = 0; e && i < t->edge[edge].uses; i++) {
        uint32_t facet = t->use[t->edge[edge].first_use + i].facet;
        if (lrcsi_view_casts(d->view, facet)) {
            if (owners < 2) {
                e->owner[owners] = facet;
            }
            owners++;
        }
    }
    if (owners > 2) {
        e->edge = edge;
    }
    return e;
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
