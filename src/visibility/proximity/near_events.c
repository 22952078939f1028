/* SPDX-License-Identifier: MIT */
/* Few event edges are near any facet of a meshlet, and near most meshlets there are none: so the
   grid is searched once for each meshlet. It does not decide what an edge that is near changes
   (visibility/proximity/event_band.c). */
#include "visibility/proximity/near_events.h"

#include "base/work.h"

size_t lrcsi_near_events_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_blocks(3, lrcsi_proximity_events_most(prepared), sizeof(uint32_t));
}

int lrcsi_near_events_make(const lrcsi_event_bands *bands, lrcs_work *work, lrcsi_near_events *near)
{
    const uint32_t events = bands->events.count;
    *near = (lrcsi_near_events){.bands = bands};
    near->considered.entry = lrcsi_work_take_zero(work, events, sizeof *near->considered.entry);
    near->meshlet = lrcsi_work_take(work, events, sizeof *near->meshlet);
    near->listed = lrcsi_work_take(work, events, sizeof *near->listed);
    return near->considered.entry && near->meshlet && near->listed ? LRCS_OK : LRCS_E_MEMORY;
}

/* The part whose event edges do not matter for a facet: its own, unless the laser sees its inside;
   then LRCS_NONE. */
static uint32_t part_left_out(const lrcsi_event_bands *bands, uint32_t facet)
{
    return lrcsi_band_sees_inside(bands, facet) ? LRCS_NONE
                                                : bands->view->prepared->scene->facet_part[facet];
}

void lrcsi_near_events_of_meshlet(lrcsi_near_events *near, const uint32_t *facet, uint32_t count)
{
    const lrcsi_event_bands *bands = near->bands;
    const lrcsi_grid *grid = &bands->events.grid;
    lrcsi_grid_walk walk;
    lrcsi_grid_row row;
    near->meshlet_count = 0;
    near->complete = 1;
    if (count == 0) {
        return;
    }
    const lrcsi_band_search where = lrcsi_band_search_around(bands, facet, count, &walk);
    uint32_t left_out = part_left_out(bands, facet[0]); /* for all of these facets */
    for (uint32_t i = 1; i < count; i++) {
        left_out = part_left_out(bands, facet[i]) == left_out ? left_out : LRCS_NONE;
    }
    int line = 0;
    lrcsi_marks_clear(&near->considered, bands->events.count);
    while (lrcsi_grid_walk_next(&walk, &row)) {
        const lrcsi_grid_items items = lrcsi_grid_row_items(grid, row.y, row.x0, row.x1);
        if (!lrcsi_meter_take(bands->meter, (uint64_t)1 + items.to - items.from)) {
            near->complete = 0;
            return;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            const uint32_t event = grid->item[i];
            if (bands->events.part[event] == left_out || lrcsi_marked(&near->considered, event)) {
                continue;
            }
            near->considered.entry[event] = near->considered.number;
            if (!lrcsi_band_excludes(bands, &where, event, &line)) {
                near->meshlet[near->meshlet_count++] = event;
            }
        }
    }
}

int lrcsi_near_events_of_facet(lrcsi_near_events *near, uint32_t facet,
                               const lrcsi_band_search *where)
{
    const lrcsi_event_bands *bands = near->bands;
    const uint32_t left_out = part_left_out(bands, facet);
    int line = 0;
    near->count = 0;
    if (!near->complete || !lrcsi_meter_take(bands->meter, (uint64_t)1 + near->meshlet_count)) {
        return 0;
    }
    for (uint32_t i = 0; i < near->meshlet_count; i++) {
        const uint32_t event = near->meshlet[i];
        if (bands->events.part[event] != left_out &&
            !lrcsi_band_excludes(bands, where, event, &line)) {
            near->listed[near->count++] = event;
        }
    }
    return 1;
}
