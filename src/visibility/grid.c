/* SPDX-License-Identifier: MIT */
/* The grid's cells and how items are sorted into them: counted first, then filled, in item order.
   It decides nothing about visibility. */
#include "visibility/grid.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"

/* Cells along a side at most. */
#define MOST_CELLS 2048

size_t lrcsi_grid_need(size_t cells, size_t entries)
{
    const size_t most = (size_t)MOST_CELLS * MOST_CELLS;
    cells = cells < most ? cells : most;
    return lrcsi_work_add(lrcsi_work_bytes(cells + 1, sizeof(uint32_t)),
                          lrcsi_work_bytes(entries, sizeof(uint32_t)));
}

size_t lrcsi_grid_facets_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    return lrcsi_grid_need(facets, 16 * facets + 65536);
}

static int grid_start(const lrcsi_view *view, uint32_t cells, lrcs_work *work, lrcsi_grid *grid)
{
    double size = lrcsi_least(MOST_CELLS, lrcsi_most(1, sqrt((double)cells)));
    grid->view = view;
    grid->size = (uint32_t)size;
    grid->last = grid->size - 1.0;
    grid->scale = view->side > 0 ? grid->size / view->side : 0;
    grid->first =
        lrcsi_work_take_zero(work, (size_t)grid->size * grid->size + 1, sizeof *grid->first);
    return grid->first ? LRCS_OK : LRCS_E_MEMORY;
}

/* first[c + 1] holds the count of cell c; makes it the end of cell c's items, and takes room for
   them. Filling then moves first[c] .. up; grid_finish moves them back. */
static int grid_room(lrcs_work *work, lrcsi_grid *grid)
{
    size_t cells = (size_t)grid->size * grid->size;
    uint64_t total = 0;
    for (size_t c = 0; c <= cells; c++) {
        total += grid->first[c];
        if (total >= LRCS_NONE) {
            return LRCS_E_LIMIT;
        }
        grid->first[c] = (uint32_t)total;
    }
    grid->item = lrcsi_work_take(work, (size_t)total, sizeof *grid->item);
    return grid->item ? LRCS_OK : LRCS_E_MEMORY;
}

static void grid_finish(lrcsi_grid *grid)
{
    for (size_t c = (size_t)grid->size * grid->size; c > 0; c--) {
        grid->first[c] = grid->first[c - 1];
    }
    grid->first[0] = 0;
}

/* Counts (item NULL) or files an item in a row of cells. */
static void grid_put(lrcsi_grid *grid, uint32_t y, uint32_t x0, uint32_t x1, uint32_t item)
{
    for (uint32_t x = x0; x < x1; x++) {
        size_t cell = (size_t)y * grid->size + x;
        if (grid->item) {
            grid->item[grid->first[cell]++] = item;
        } else {
            grid->first[cell + 1]++;
        }
    }
}

/* The part of segment a -> b within a row of cells, as its range of x; the row is widened by the
   view's error, and so is the range where it is used. */
static void segment_row(const lrcsi_grid *grid, const double *a, const double *b, uint32_t y,
                        double range[2])
{
    double margin = 2 * grid->view->off;
    double bottom = grid->view->low[1] + y / grid->scale - margin;
    double top = grid->view->low[1] + (y + 1) / grid->scale + margin;
    double rise = b[1] - a[1];
    double t0 = 0;
    double t1 = 1;
    if (fabs(rise) > margin) {
        double u = (bottom - a[1]) / rise;
        double v = (top - a[1]) / rise;
        t0 = lrcsi_least(1, lrcsi_most(0, lrcsi_least(u, v)));
        t1 = lrcsi_least(1, lrcsi_most(0, lrcsi_most(u, v)));
    }
    double x0 = a[0] + t0 * (b[0] - a[0]);
    double x1 = a[0] + t1 * (b[0] - a[0]);
    range[0] = lrcsi_least(x0, x1);
    range[1] = lrcsi_most(x0, x1);
}

static void grid_put_edge(lrcsi_grid *grid, const lrcsi_edge *edge, uint32_t item)
{
    const uint32_t ends[2] = {edge->low, edge->high};
    double low[2];
    double high[2];
    lrcsi_grid_box(grid->view, ends, 2, low, high);
    lrcsi_cells cells = lrcsi_grid_cells(grid, low, high);
    if (cells.y1 - cells.y0 == 1) {
        grid_put(grid, cells.y0, cells.x0, cells.x1, item);
        return;
    }
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        double range[2];
        segment_row(grid, grid->view->point[edge->low].x, grid->view->point[edge->high].x, y,
                    range);
        double off = 4 * grid->view->off;
        grid_put(grid, y, lrcsi_grid_cell(grid, range[0] - off, 0),
                 lrcsi_grid_cell(grid, range[1] + off, 0) + 1, item);
    }
}

int lrcsi_grid_edges(const lrcsi_view *view, const uint32_t *edge, uint32_t count, uint32_t cells,
                     lrcs_work *work, lrcsi_grid *grid)
{
    lrcsi_grid g = {.view = view};
    int status = grid_start(view, cells, work, &g);
    for (int pass = 0; pass < 2 && status == LRCS_OK; pass++) {
        for (uint32_t i = 0; i < count; i++) {
            grid_put_edge(&g, &view->prepared->topology.edge[edge[i]], i);
        }
        if (pass == 0) {
            status = grid_room(work, &g);
        }
    }
    if (status == LRCS_OK) {
        grid_finish(&g);
        *grid = g;
    }
    return status;
}

static void grid_put_facet(lrcsi_grid *grid, uint32_t facet)
{
    double low[2];
    double high[2];
    lrcsi_grid_box(grid->view, grid->view->prepared->scene->facet[facet].corner, 3, low, high);
    lrcsi_cells cells = lrcsi_grid_cells(grid, low, high);
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        grid_put(grid, y, cells.x0, cells.x1, facet);
    }
}

int lrcsi_grid_facets(const lrcsi_view *view, lrcs_work *work, lrcsi_grid *grid)
{
    uint32_t count = view->prepared->scene->facet_count;
    lrcsi_grid g = {.view = view};
    int status = grid_start(view, view->front + view->back, work, &g);
    for (int pass = 0; pass < 2 && status == LRCS_OK; pass++) {
        for (uint32_t f = 0; f < count; f++) {
            if (lrcsi_grid_casts(view, f)) {
                grid_put_facet(&g, f);
            }
        }
        if (pass == 0) {
            status = grid_room(work, &g);
        }
    }
    if (status == LRCS_OK) {
        grid_finish(&g);
        *grid = g;
    }
    return status;
}
