/* SPDX-License-Identifier: MIT */
/* A uniform grid over the window of the scene's bulk: which items (facets, edges) may stand in
   which cell. What stands outside counts to the cells on the border. Conservative: an item is
   listed in every cell that its box touches. Where items are so large that they would be listed too
   often, cells are doubled until they are not: then the bytes that a grid takes are bounded
   whatever the scene, and so is what a walk through the cells of all items costs. */
#ifndef LRCSI_GRID_H
#define LRCSI_GRID_H

#include "base/range.h"
#include "view/strip.h"
#include "visibility/boxes.h"
#include "visibility/event.h"

typedef struct lrcsi_grid {
    const lrcsi_view *view;
    lrcsi_boxes boxes; /* of facets, if these are the items */
    double low[2];     /* of the window, in the units of boxes */
    double side;
    uint32_t size;   /* cells along each side */
    double scale;    /* cells per unit */
    double last;     /* size - 1 */
    uint32_t *first; /* size * size + 1 */
    uint32_t *item;  /* those of cell c: item[first[c] .. first[c + 1]) */
} lrcsi_grid;

/* Lists of items, made in two passes over the items. `first` begins as lists + 1 zeros.
   1. lrcsi_lists_put with item NULL counts: list i in first[i + 1].
   2. lrcsi_lists_room allocates the items. Status: LRCS_OK; LRCS_E_LIMIT, more than `most`;
      LRCS_E_MEMORY.
   3. lrcsi_lists_put with the items fills the lists; lrcsi_lists_finish makes first[i] the start of
      list i again. */
int lrcsi_lists_room(uint32_t *first, size_t lists, uint64_t most, lrcs_work *work,
                     uint32_t **item);
void lrcsi_lists_finish(uint32_t *first, size_t lists);

/* Counts or adds a value in each of the lists from <= i < to. */
static inline void lrcsi_lists_put(uint32_t *first, uint32_t *item, size_t from, size_t to,
                                   uint32_t value)
{
    for (size_t i = from; i < to; i++) {
        if (item) {
            item[first[i]++] = value;
        } else {
            first[i + 1]++;
        }
    }
}

/* A rectangle of cells: x0 <= x < x1, y0 <= y < y1. */
typedef struct lrcsi_cells {
    uint16_t x0, x1, y0, y1;
} lrcsi_cells;

/* The cell of a coordinate in units of boxes, kept within 0 .. size - 1; of two coordinates the
   larger is never in the lower cell. */
static inline uint16_t lrcsi_grid_cell(const lrcsi_grid *grid, double x, int axis)
{
    double cell = (x - grid->low[axis]) * grid->scale;
    return (uint16_t)lrcsi_min(grid->last, lrcsi_max(0, cell));
}

/* The cells that a box touches. */
static inline lrcsi_cells lrcsi_grid_cells(const lrcsi_grid *grid, const lrcsi_view_box *box)
{
    return (lrcsi_cells){.x0 = lrcsi_grid_cell(grid, (double)box->low[0], 0),
                         .x1 = (uint16_t)(lrcsi_grid_cell(grid, (double)box->high[0], 0) + 1),
                         .y0 = lrcsi_grid_cell(grid, (double)box->low[1], 1),
                         .y1 = (uint16_t)(lrcsi_grid_cell(grid, (double)box->high[1], 1) + 1)};
}

/* The sides of a facet (count 3), or an edge (count 2, one side), for lrcsi_grid_row; `near`: how
   far beyond them rows should reach. */
void lrcsi_grid_sides(const lrcsi_grid *grid, const uint32_t *corner, int count, double near,
                      lrcsi_strip_segment *side);

/* The cells of row y that a polygon with these sides, in the units of boxes, may touch; rows and
   columns on the border reach on without end. Empty (x0 == x1) if there are none. */
lrcsi_cells lrcsi_grid_row(const lrcsi_grid *grid, const lrcsi_strip_segment *side, int sides,
                           uint32_t y);

/* What the sides' errors must allow for besides their own: the rounding of what is computed of
   them, points at t, rows and the t at which the segment enters one, each off by less than 8 u of
   coordinates between the segment's and the window's; and boxes are rounded by 2^-24 of the latter.
 */
static inline double lrcsi_grid_rounding(const lrcsi_grid *grid)
{
    return 0x1p-23 * (fabs(grid->low[0]) + fabs(grid->low[1]) + grid->side);
}

/* A range of grid->item: from <= i < to. */
typedef struct lrcsi_grid_items {
    uint32_t from, to;
} lrcsi_grid_items;

/* What the cells x0 <= x < x1 of row y list, an item once for each cell that lists it: the lists of
   a row lie one behind the other. */
static inline lrcsi_grid_items lrcsi_grid_row_items(const lrcsi_grid *grid, uint32_t y, uint32_t x0,
                                                    uint32_t x1)
{
    const uint32_t *row = grid->first + (size_t)y * grid->size;
    return (lrcsi_grid_items){row[x0], row[x1]};
}

/* Do the cells list any item? */
static inline int lrcsi_grid_any(const lrcsi_grid *grid, lrcsi_cells cells)
{
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, cells.x0, cells.x1);
        if (items.from != items.to) {
            return 1;
        }
    }
    return 0;
}

/* How often a facet is listed at most, on average. Facets that fill 16 cells fill 9 of twice the
   size, or fewer: so a coarser grid has lists little more than twice as long, and fewer of them to
   walk through for each facet. */
#define LRCSI_GRID_FACET_CELLS 16u

/* The window in about `cells` cells (none more, but for one at least), without lists. */
lrcsi_grid lrcsi_grid_empty(const lrcsi_view *view, uint32_t cells);

/* Files edges in an empty grid: item i stands for topology edge `edge[i]`. Cells along the edge
   only. Lists `most` items at most, or each once: until it does, the grid is made coarser.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_grid_edges(const uint32_t *edge, uint32_t count, uint64_t most, lrcs_work *work,
                     lrcsi_grid *grid);

/* Bytes at most for a grid of so many cells that lists so many items. */
size_t lrcsi_grid_need(size_t cells, size_t entries);

/* Makes an empty grid coarser until the facets whose boxes are made touch LRCSI_GRID_FACET_CELLS
   cells at most, on average. 1 if it had to be. */
int lrcsi_grid_fit(lrcsi_grid *grid, const lrcsi_boxes *boxes);

/* Bytes at most for a grid of facets. */
size_t lrcsi_grid_facets_need(const lrcs_prepared *prepared);

/* The facets for which a grid is to be searched: those that are marked and, unless region is NULL,
   the first of each region. */
typedef struct lrcsi_grid_readers {
    const unsigned char *undecided; /* of each facet: is it marked? */
    const uint32_t *region;         /* of each facet: the first facet of its region */
    const signed char *joinable;    /* of each facet (visibility/classify.h); with region */
} lrcsi_grid_readers;

/* A grid of the facets that can hide something, in at most as many cells as another grid: it lists
   each of them at most LRCSI_GRID_FACET_CELLS times on average. Lists are complete in the cells of
   the readers' boxes; with readers NULL, in all cells. It makes the boxes of the readers and of all
   facets that it lists. Status: as above. */
int lrcsi_grid_facets(const lrcsi_grid *like, const lrcsi_boxes *boxes,
                      const lrcsi_grid_readers *readers, lrcs_work *work, lrcsi_grid *grid);

#endif
