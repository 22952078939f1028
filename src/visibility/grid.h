/* SPDX-License-Identifier: MIT */
/* A uniform grid over the view's window: which items (facets, edges) may stand in which cell.
   Conservative: an item is listed in every cell that it touches within the view's error. */
#ifndef LRCSI_GRID_H
#define LRCSI_GRID_H

#include "view/view.h"

typedef struct lrcsi_grid {
    const lrcsi_view *view;
    uint32_t size;   /* cells along each side */
    double scale;    /* cells per scaled unit */
    uint32_t *first; /* size * size + 1 */
    uint32_t *item;  /* those of cell c: item[first[c] .. first[c + 1]) */
} lrcsi_grid;

/* A rectangle of cells: x0 <= x < x1, y0 <= y < y1. */
typedef struct lrcsi_cells {
    uint32_t x0, x1, y0, y1;
} lrcsi_cells;

/* The cells that the box low .. high of view coordinates touches. */
lrcsi_cells lrcsi_grid_cells(const lrcsi_grid *grid, const double low[2], const double high[2]);

/* The box of some points of the view. */
void lrcsi_grid_box(const lrcsi_view *view, const uint32_t *vertex, int count, double low[2],
                    double high[2]);

/* A grid of edges: item i stands for topology edge `edge[i]`. Cells along the edge only.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_grid_edges(const lrcsi_view *view, const uint32_t *edge, uint32_t count, lrcs_work *work,
                     lrcsi_grid *grid);

/* Bytes for a grid of so many items that stand in so many cells together. */
size_t lrcsi_grid_need(size_t items, size_t entries);

/* Bytes for a grid of facets, an upper bound for ordinary scenes. */
size_t lrcsi_grid_facets_need(const lrcs_prepared *prepared);

/* A grid of the facets that can hide something, by their boxes. Status as above. */
int lrcsi_grid_facets(const lrcsi_view *view, lrcs_work *work, lrcsi_grid *grid);

/* Can the facet hide anything in this view? */
int lrcsi_grid_casts(const lrcsi_view *view, uint32_t facet);

#endif
