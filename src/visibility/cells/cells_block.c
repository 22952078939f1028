/* SPDX-License-Identifier: MIT */
/* The grid of blocks, with the facets and event edges of each block; and the first cell of a block.
   The segments of that cell are event edges of the view, contacts of its facets, and edges that
   count as events in cells although two facets continue each other across them. Contacts are
   defined in visibility/cells/cells_cover.c. */
#include "visibility/cells/cells_block.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "view/segment.h"
#include "visibility/cells/contact.h"
#include "visibility/index/lists.h"
#include "visibility/uniform/query.h"

/* Limit on the entries of all blocks: so many for each facet, and a constant. Heuristic: if they
   are more, blocks are made larger, which is slower but finds the same. */
#define ENTRIES_PER_FACET 16u
#define ENTRIES_CONSTANT  65536u

static uint64_t max_entries(const lrcs_prepared *p)
{
    return ENTRIES_CONSTANT + (uint64_t)ENTRIES_PER_FACET * p->scene->facet_count;
}

/* Blocks are squares with BLOCK buckets of the classification's grid along a side; twice or four
   times as many, and so on, if their lists would otherwise be too long. They fill the whole view
   or, if that would take too many blocks, the window of the scene's bulk. Border blocks around
   them hold what is outside. The number is heuristic: cells are cut until they are decided. */
#define BLOCK 4u

/* The largest number of blocks, border blocks included. */
static size_t max_blocks(const lrcs_prepared *p)
{
    return 2 * (size_t)p->scene->facet_count + 64;
}

static void blocks_place(lrcsi_block_grid *g, uint32_t buckets)
{
    const lrcsi_grid *grid = &g->classification->search.grid;
    const lrcsi_view *view = g->classification->view;
    double bucket = grid->buckets_per_unit > 0 ? 1 / (grid->buckets_per_unit * view->scale) : 1;
    double window = grid->size * bucket;
    double across = ceil(view->side / (BLOCK * bucket)) + 2;
    int whole = view->side > window && across * across <= (double)max_blocks(view->prepared);
    g->block_side = buckets * bucket;
    g->size = (uint32_t)ceil((whole ? view->side : window) / g->block_side) + 2;
    for (int k = 0; k < 2; k++) {
        g->low[k] = whole ? view->low[k] : grid->low[k] / view->scale;
        g->high[k] = g->low[k] + (g->size - 2) * g->block_side;
        g->content_low[k] = g->low[k];
        g->content_high[k] = g->high[k];
    }
    g->blocks_per_unit = 1 / g->block_side;
    g->rounding = 64 * LRCSI_U * (fabs(g->low[0]) + fabs(g->low[1]) + g->size * g->block_side);
}

/* The first coordinate of block i of a row, i from 1 to the last but one, or the last. */
static double block_edge(const lrcsi_block_grid *g, uint32_t i, int k)
{
    return g->low[k] + (i - 1) * g->block_side;
}

/* The block of a coordinate; possibly the adjacent one for a coordinate nearly on the border. */
static uint32_t block_of(const lrcsi_block_grid *g, double x, int k)
{
    double i = (x - g->low[k]) * g->blocks_per_unit + 1;
    return (uint32_t)lrcsi_min(g->size - 1.0, lrcsi_max(0, i));
}

/* The blocks that a range of coordinates meets: *from <= i < *to. */
static void block_range(const lrcsi_block_grid *g, double low, double high, int k, uint32_t *from,
                        uint32_t *to)
{
    *from = block_of(g, low - g->rounding, k);
    *to = block_of(g, high + g->rounding, k) + 1;
}

/* Counts or lists a polygon of at most three corners in the blocks that it may meet, row by row.
   Its range of x in a row is that of its sides in the row. What is computed from a side has an
   error below 8 u of a coordinate between the side's and the window's. (lrcsi_grid_walk does this
   in a grid whose rows have other borders and errors.) */
static void blocks_put(lrcsi_block_grid *g, lrcsi_block_lists *b,
                       const lrcsi_view_vertex *const corner[3], int corners, uint32_t item)
{
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    lrcsi_view_segment side[3];
    uint32_t x[2];
    uint32_t y[2];
    for (int i = 0; i < corners; i++) {
        double err = 4 * corner[i]->err;
        for (int k = 0; k < 2; k++) {
            low[k] = lrcsi_min(low[k], corner[i]->x[k] - err);
            high[k] = lrcsi_max(high[k], corner[i]->x[k] + err);
        }
    }
    for (int k = 0; k < 2; k++) {
        lrcsi_range_extend(low[k], &g->content_low[k], &g->content_high[k]);
        lrcsi_range_extend(high[k], &g->content_low[k], &g->content_high[k]);
    }
    block_range(g, low[0], high[0], 0, &x[0], &x[1]);
    block_range(g, low[1], high[1], 1, &y[0], &y[1]);
    int several = y[1] - y[0] > 1 && x[1] - x[0] > 1; /* rows and columns */
    for (int i = 0; several && i < corners; i++) {
        side[i] = lrcsi_view_segment_make(corner[i], corner[(i + 1) % corners], 1, g->rounding);
    }
    for (uint32_t row = y[0]; row < y[1]; row++) {
        double bottom = row > 0 ? block_edge(g, row, 1) - g->rounding : -HUGE_VAL;
        double top = row + 1 < g->size ? block_edge(g, row + 1, 1) + g->rounding : HUGE_VAL;
        double range[2];
        if (several && !lrcsi_view_segments_range(side, corners, bottom, top, range)) {
            continue;
        }
        if (several) {
            block_range(g, range[0], range[1], 0, &x[0], &x[1]);
        }
        lrcsi_lists_put(b->first + (size_t)row * g->size, b->item, x[0], x[1], item);
    }
}

/* Lists the facets that can hide others and are not proved to be hidden, or the events: counts
   them, then lists them. 0 if memory does not suffice, or the lists are too long. */
static int blocks_make(lrcsi_block_grid *g, lrcsi_block_lists *b, int events, lrcs_work *work)
{
    const lrcsi_classification *classification = g->classification;
    const lrcsi_view *view = classification->view;
    const lrcs_prepared *p = view->prepared;
    size_t count = (size_t)g->size * g->size;
    uint32_t items = events ? classification->events.count : p->scene->facet_count;
    b->first = lrcsi_work_take_zero(work, count + 1, sizeof *b->first);
    b->item = NULL;
    if (!b->first) {
        return 0;
    }
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < items; i++) {
            if (events) {
                const lrcsi_edge *e = &p->topology.edge[classification->events.edge[i]];
                const lrcsi_view_vertex *const end[3] = {&view->point[e->low],
                                                         &view->point[e->high], NULL};
                blocks_put(g, b, end, 2, i);
            } else if (lrcsi_view_casts(view, i) && !(g->answer && !classification->undecided[i] &&
                                                      g->answer[i] == LRCSI_QUERY_HIDDEN)) {
                const uint32_t *vertex = p->scene->facet[i].corner;
                const lrcsi_view_vertex *const corner[3] = {
                    &view->point[vertex[0]], &view->point[vertex[1]], &view->point[vertex[2]]};
                blocks_put(g, b, corner, 3, i);
            }
        }
        if (pass == 0 &&
            lrcsi_lists_room(b->first, count, max_entries(p), work, &b->item) != LRCS_OK) {
            return 0;
        }
    }
    lrcsi_lists_finish(b->first, count);
    return 1;
}

/* Border blocks extend beyond the window of the view, and beyond all facets with the errors of
   their corners: if the view is no wider than these errors, as along a needle, a large part of a
   facet may be outside its window. */
double lrcsi_block_grid_square(const lrcsi_block_grid *g, uint32_t x, uint32_t y,
                               lrcsi_clip_polygon *shape, double middle[2])
{
    const uint32_t at[2] = {x, y};
    double low[2];
    double high[2];
    double extent = 0;
    for (int k = 0; k < 2; k++) {
        double start = g->classification->view->low[k];
        double end = g->classification->view->low[k] + g->classification->view->side;
        double wide = 0x1p-30 * (fabs(start) + fabs(end) + g->size * g->block_side);
        double near = 64 * LRCSI_U * (fabs(g->content_low[k]) + fabs(g->content_high[k]));
        low[k] = at[k] > 0
                     ? block_edge(g, at[k], k)
                     : lrcsi_min(lrcsi_min(start, g->low[k]) - wide, g->content_low[k] - near);
        high[k] = at[k] + 1 < g->size
                      ? block_edge(g, at[k] + 1, k)
                      : lrcsi_max(lrcsi_max(end, g->high[k]) + wide, g->content_high[k] + near);
        middle[k] = 0.5 * (low[k] + high[k]);
        low[k] -= middle[k];
        high[k] -= middle[k];
        extent = lrcsi_max3(extent, fabs(low[k]), fabs(high[k]));
    }
    *shape = (lrcsi_clip_polygon){
        .corner = {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}},
        .count = 4};
    return extent;
}

size_t lrcsi_block_grid_need(const lrcs_prepared *prepared)
{
    size_t need = lrcsi_work_blocks(2, max_blocks(prepared) + 1, sizeof(uint32_t));
    return lrcsi_work_add(need,
                          lrcsi_work_blocks(2, (size_t)max_entries(prepared), sizeof(uint32_t)));
}

int lrcsi_block_grid_make(const lrcsi_classification *classification, const unsigned char *answer,
                          lrcs_work *work, lrcsi_block_grid *g)
{
    size_t mark = work->used;
    int made = 0;
    *g = (lrcsi_block_grid){.classification = classification, .answer = answer};
    for (uint32_t buckets = BLOCK; !made; buckets *= 2) {
        blocks_place(g, buckets);
        made = blocks_make(g, &g->facets, 0, work) && blocks_make(g, &g->events, 1, work);
        work->used = made ? work->used : mark;
        if (!made && g->size <= 3) {
            return 0;
        }
    }
    return 1;
}

/* --- the first cell of a block ---------------------------------------------------------------- */

/* Adds an edge. 0 if there is no room. */
static int add_edge(lrcsi_blocks *b, uint32_t edge)
{
    const lrcsi_edge *of = &b->division.view->prepared->topology.edge[edge];
    lrcsi_cells_segment *e = lrcsi_division_edge(&b->division, edge);
    if (!e) {
        return 0;
    }
    const lrcsi_cells_point *end[2] = {lrcsi_cells_vertex(&b->frame, of->low),
                                       lrcsi_cells_vertex(&b->frame, of->high)};
    for (int i = 0; i < 2; i++) {
        e->end[i][0] = end[i]->local[0].hi;
        e->end[i][1] = end[i]->local[1].hi;
        e->end[i][2] = end[i]->z;
    }
    e->err = lrcsi_max(end[0]->err, end[1]->err);
    e->line_err = lrcsi_max(end[0]->line_err, end[1]->line_err);
    e->z_err = lrcsi_max(end[0]->z_err, end[1]->z_err);
    e->length = lrcsi_cells_line(end[0], end[1], e->line);
    return 1;
}

/* 1 if no side of the facet counts as an event in cells only. */
static int has_ordinary_sides(const lrcsi_blocks *b, uint32_t facet)
{
    return !b->coplanar[facet] && b->division.view->prepared->intersections.met[facet] <= 1;
}

/* Adds the sides of a facet that count as events in cells only: one of their two facets overlaps
   others in its plane, or others meet it along parts of the side. 0 if there is no room. */
static int add_cell_events(lrcsi_blocks *b, uint32_t facet)
{
    const lrcsi_view *view = b->division.view;
    if (has_ordinary_sides(b, facet)) {
        return 1;
    }
    for (int k = 0; k < 3; k++) {
        uint32_t other = lrcsi_cells_neighbour(view, facet, k);
        if (other != LRCS_NONE && lrcsi_cells_connected(view, b->coplanar, facet, k) == LRCS_NONE &&
            !add_edge(b, view->prepared->topology.facet_edge[facet].corner[k])) {
            return 0;
        }
    }
    return 1;
}

/* Adds the segments along which other facets of the block meet the interior of a facet. 0 if there
   is no room. */
static int add_contacts(lrcsi_blocks *b, uint32_t facet)
{
    lrcsi_division *d = &b->division;
    const lrcsi_view *view = d->view;
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    lrcsi_target target = {.view = NULL};
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        uint32_t other = intersections->entry[i].other;
        if (intersections->entry[i].kind != LRCSI_INTERSECTION_CROSS || d->record[other] == 0 ||
            (other < facet && lrcsi_intersection_find(intersections, other, facet))) {
            continue;
        }
        if (!target.view) {
            lrcsi_target_make(view, facet, &target);
        }
        lrcsi_contact contact;
        int kind = lrcsi_contact_find(&target, other, &contact);
        if (kind == LRCSI_CONTACT_POINT) {
            continue;
        }
        if (kind == LRCSI_CONTACT_FLAT || kind == LRCSI_CONTACT_UNKNOWN) {
            d->facet[d->record[facet]].unknown_contact = 1;
            d->facet[d->record[other]].unknown_contact = 1;
            continue;
        }
        lrcsi_cells_segment *e = lrcsi_division_segment(d);
        if (!e) {
            return 0;
        }
        const lrcs_point *vertex = view->prepared->vertex;
        uint32_t corner = view->prepared->scene->facet[facet].corner[0];
        for (int k = 1; k < 3 && vertex[corner].x != target.origin; k++) {
            corner = view->prepared->scene->facet[facet].corner[k];
        }
        const lrcsi_cells_point *origin = lrcsi_cells_vertex(&b->frame, corner);
        for (int n = 0; n < 2; n++) {
            e->end[n][0] = origin->local[0].hi + contact.end[n][0];
            e->end[n][1] = origin->local[1].hi + contact.end[n][1];
        }
        e->end[0][2] = e->end[1][2] = 0;
        e->err = origin->err + 32 * LRCSI_U * contact.reach + contact.position_err;
        e->owner[0] = d->record[facet];
        e->owner[1] = d->record[other];
        e->contact = kind;
        e->line_err = e->err;
        e->length = lrcsi_line_through(e->end[0], e->end[1], e->line);
    }
    return 1;
}

void lrcsi_blocks_max_lists(const lrcsi_blocks *b, size_t *max_facets, size_t *max_segments)
{
    const lrcsi_intersections *intersections = &b->division.view->prepared->intersections;
    const lrcsi_block_lists *facets = &b->grid.facets;
    const lrcsi_block_lists *events = &b->grid.events;
    *max_facets = *max_segments = 0;
    for (size_t block = 0; block < (size_t)b->grid.size * b->grid.size; block++) {
        size_t facet_count = facets->first[block + 1] - facets->first[block];
        size_t segment_count = events->first[block + 1] - events->first[block];
        for (uint32_t i = facets->first[block]; i < facets->first[block + 1]; i++) {
            uint32_t f = facets->item[i];
            segment_count += intersections->first[f + 1] - intersections->first[f];
            segment_count += has_ordinary_sides(b, f) ? 0 : 3;
        }
        *max_facets = facet_count > *max_facets ? facet_count : *max_facets;
        *max_segments = segment_count > *max_segments ? segment_count : *max_segments;
    }
}

/* Makes the record of a facet, number `record`. The other facets of the block have got the numbers
   of theirs. */
static void make_record(lrcsi_blocks *b, uint32_t facet, uint32_t record)
{
    lrcsi_division *d = &b->division;
    lrcsi_cells_facet *f = &d->facet[record];
    lrcsi_cells_facet_make(&b->frame, facet, f);
    for (int k = 0; k < 3; k++) {
        f->neighbour[k] = lrcsi_division_owner(
            d, lrcsi_cells_connected(d->view, b->coplanar, facet,
                                     lrcsi_cells_side_number(d->view, facet, k)));
    }
    d->facet_err = lrcsi_max(d->facet_err, f->err);
    d->wanted[record] = b->wanted[facet];
    d->area[record] = b->area[facet];
    b->record_finding[record] =
        b->finding[facet] | (unsigned char)(f->degenerate ? LRCSI_FINDING_UNDECIDED : 0);
}

/* Adds the event edges of the block. An edge of none of the block's facets is hidden, or not near
   the block. 0 if there is no room. */
static int add_events(lrcsi_blocks *b, size_t block)
{
    const lrcsi_block_lists *events = &b->grid.events;
    const lrcsi_topology *topology = &b->division.view->prepared->topology;
    for (uint32_t i = events->first[block]; i < events->first[block + 1]; i++) {
        uint32_t edge = b->grid.classification->events.edge[events->item[i]];
        const lrcsi_edge_use *use = topology->use + topology->edge[edge].first_use;
        int listed = 0;
        for (uint32_t k = 0; k < topology->edge[edge].uses && !listed; k++) {
            listed = b->division.record[use[k].facet] != 0;
        }
        if (listed && !add_edge(b, edge)) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_blocks_begin(lrcsi_blocks *b, size_t block, lrcsi_cell *cell)
{
    lrcsi_division *d = &b->division;
    const lrcsi_block_lists *facets = &b->grid.facets;
    const uint32_t *listed = facets->item + facets->first[block];
    int room = 1;
    d->segment_count = 0;
    d->facet_err = 0;
    cell->facet = d->facet_lists;
    cell->facet_count = facets->first[block + 1] - facets->first[block];
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        cell->facet[i] = i + 1;
        d->record[listed[i]] = i + 1;
    }
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        make_record(b, listed[i], i + 1);
    }
    for (uint32_t i = 0; i < cell->facet_count && room; i++) {
        room = add_contacts(b, listed[i]) && add_cell_events(b, listed[i]);
    }
    if (!room || !add_events(b, block)) {
        return 0;
    }
    lrcsi_division_start(d, cell);
    return 1;
}

void lrcsi_blocks_end(lrcsi_blocks *b, size_t block)
{
    lrcsi_division *d = &b->division;
    const lrcsi_block_lists *facets = &b->grid.facets;
    for (uint32_t i = facets->first[block]; i < facets->first[block + 1]; i++) {
        uint32_t facet = facets->item[i];
        b->area[facet] = d->area[d->record[facet]];
        b->finding[facet] = b->record_finding[d->record[facet]];
        d->record[facet] = 0;
    }
}
