/* SPDX-License-Identifier: MIT */
/* The grid of blocks that the view plane is divided into, with the facets and event edges of each
   (visibility/cells.c). */
#ifndef LRCSI_CELLS_BLOCK_H
#define LRCSI_CELLS_BLOCK_H

#include "visibility/cells_shape.h"
#include "visibility/classify.h"

/* Items of each block: item[first[b] .. first[b + 1]) of block b. */
typedef struct lrcsi_cells_lists {
    uint32_t *first, *item;
} lrcsi_cells_lists;

typedef struct lrcsi_cells_grid {
    const lrcsi_classification *classification;
    uint32_t side;          /* blocks along each, with the ring */
    double low[2], high[2]; /* of those within */
    double size;            /* of one */
    lrcsi_cells_lists facets, events;
} lrcsi_cells_grid;

/* Bytes at most. */
size_t lrcsi_cells_grid_need(const lrcs_prepared *prepared);

/* Places the blocks and files casting facets and events. 0 if they find no memory, are listed
   too often, or where much of the view lies outside of the bulk: blocks there are so large that
   nothing is decided. */
int lrcsi_cells_grid_make(const lrcsi_classification *classification, lrcs_work *work,
                          lrcsi_cells_grid *c);

/* The square of a block, from its middle; returns the largest coordinate. */
double lrcsi_cells_grid_square(const lrcsi_cells_grid *c, uint32_t x, uint32_t y,
                               lrcsi_clip_polygon *shape, double middle[2]);

#endif
