/* SPDX-License-Identifier: MIT */
/* The blocks of the view plane, and the cell that each begins as: its facets, and its segments
   (visibility/cells/cells.c). */
#ifndef LRCSI_CELLS_BLOCK_H
#define LRCSI_CELLS_BLOCK_H

#include "visibility/cells/cells_division.h"
#include "visibility/uniform/classify.h"

/* A list for each block: item[first[b] .. first[b + 1]) of block b. */
typedef struct lrcsi_block_lists {
    uint32_t *first, *item;
} lrcsi_block_lists;

/* The grid of blocks into which the view plane is divided. */
typedef struct lrcsi_block_grid {
    const lrcsi_classification *classification;
    const unsigned char *answer; /* of uniform facets (visibility/uniform/query.h), or NULL */
    uint32_t size;               /* blocks along a side; those on the border hold what is outside */
    double low[2], high[2];      /* of the blocks within the border */
    double content_low[2], content_high[2]; /* of these and of all facets, with their errors */
    double block_side, blocks_per_unit;
    double rounding; /* more than the rounding errors of positions among the blocks */
    lrcsi_block_lists facets, events;
} lrcsi_block_grid;

/* Bytes at most. */
size_t lrcsi_block_grid_need(const lrcs_prepared *prepared);

/* Makes the blocks, and lists in each the event edges and the facets that can hide others, except
   those that are proved to be hidden (visibility/cells/cells_cover.c). 0 if memory does not
   suffice, or if the lists are too long. */
int lrcsi_block_grid_make(const lrcsi_classification *classification, const unsigned char *answer,
                          lrcs_work *work, lrcsi_block_grid *grid);

/* The square of a block, relative to its middle. Returns the largest coordinate. */
double lrcsi_block_grid_square(const lrcsi_block_grid *grid, uint32_t x, uint32_t y,
                               lrcsi_clip_polygon *shape, double middle[2]);

/* What was found of a facet in the cells that were decided, bits. */
enum lrcsi_finding {
    LRCSI_FINDING_VISIBLE = 1, /* it is visible in a cell */
    LRCSI_FINDING_HIDDEN = 2,
    LRCSI_FINDING_UNDECIDED = 4,
    LRCSI_FINDING_CHARGED = 8 /* listed in a cell of which all the area was charged */
};

/* A view that is divided into cells block by block. */
typedef struct lrcsi_blocks {
    lrcsi_block_grid grid;
    lrcsi_cells_frame frame;     /* its vertices, relative to the middle of the current block */
    unsigned char *coplanar;     /* facet: lrcsi_cells_has_coplanar */
    const unsigned char *wanted; /* facet: 1 if its area is wanted */
    lrcsi_cell_area *area;       /* facet: its areas in all blocks that have ended */
    unsigned char *finding;      /* facet: what was found in these, bits of enum lrcsi_finding */
    /* Of the current block, whose facets have records from 1 on: */
    lrcsi_division division;
    unsigned char *record_finding; /* record: with what was found in the blocks before */
} lrcsi_blocks;

/* The largest numbers of facets and of segments of a block, at most. Given: grid, coplanar, and the
   view. */
void lrcsi_blocks_max_lists(const lrcsi_blocks *b, size_t *facets, size_t *segments);

/* Begins to divide a block: makes the records of its facets and its segments, and the first cell,
   the only one that waits. Returns 0, and lists no segments, if there is no room. Given: the cell's
   shape, the block's extent, and its middle and number in the frame. */
int lrcsi_blocks_begin(lrcsi_blocks *b, size_t block, lrcsi_cell *cell);

/* Ends it: adds up what was found of its facets. */
void lrcsi_blocks_end(lrcsi_blocks *b, size_t block);

#endif
