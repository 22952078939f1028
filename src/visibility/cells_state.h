/* SPDX-License-Identifier: MIT */
/* The data that the modules of cells share: the grid of blocks, a cell, what is known of facets,
   and the state of a view that is being divided (visibility/cells.c). */
#ifndef LRCSI_CELLS_STATE_H
#define LRCSI_CELLS_STATE_H

#include "base/constant.h"
#include "visibility/cells_facet.h"
#include "visibility/classify.h"
#include "visibility/visible_area.h"

/* A list for each block: item[first[b] .. first[b + 1]) of block b. */
typedef struct lrcsi_block_lists {
    uint32_t *first, *item;
} lrcsi_block_lists;

/* The grid of blocks into which the view plane is divided. */
typedef struct lrcsi_block_grid {
    const lrcsi_classification *classification;
    const unsigned char *answer; /* of uniform facets (visibility/query.h), or NULL */
    uint32_t side;               /* blocks along a side; those on the border hold what is outside */
    double low[2], high[2];      /* of the blocks within the border */
    double content_low[2], content_high[2]; /* of these and of all facets, with their errors */
    double size, inverse_size;              /* of a block */
    double rounding; /* more than the rounding errors of positions among the blocks */
    lrcsi_block_lists facets, events;
} lrcsi_block_grid;

/* The largest number of cuts from a block to a cell, of cells on the stack, and of a component's
   edges at the border of a cell. */
#define LRCSI_CELL_MAX_CUTS 200u
#define LRCSI_CELL_STACK    (LRCSI_CELL_MAX_CUTS + 2)
/* Room for the lists of all cells on the stack: so many times all facets, and all segments of a
   block. Ordinary scenes take twice those of a block, a stack of 800 plates 9 times its facets and
   6 times its segments. A cell for whose parts there is no room is left undecided. */
#define LRCSI_CELL_FACET_LISTS   16u
#define LRCSI_CELL_SEGMENT_LISTS 8u
#define LRCSI_COVER_MAX_BORDERS  128u

/* A part of the view plane that is not decided yet, with lists of its facets and segments. A cut
   makes two cells: the left one is processed first, with all that are cut from it, while the right
   one waits on the stack. The lists of the right one take the place of those of the cell that was
   cut; behind them follow those of the left one. */
typedef struct lrcsi_cell {
    lrcsi_clip_polygon shape;
    uint32_t *facet, *segment; /* in the work's lists */
    uint32_t facets, segments;
    uint32_t cuts;       /* since the block */
    uint32_t removed;    /* segments removed from the list since the block */
    double shape_err;    /* the distance from the cell of a point that belongs to it, at most */
    double uncertainty;  /* area not charged yet, by which that of any facet may be wrong */
    double widest_strip; /* of a segment removed from the list */
    double cut_line[3];  /* of the last cut; positive in the cell */
} lrcsi_cell;

/* Areas of a facet. */
typedef struct lrcsi_cell_area {
    double visible; /* in cells in which it is visible */
    double visible_err;
    double uncertainty;  /* in strips in which its visibility is undecided */
    double strip_length; /* of those strips */
} lrcsi_cell_area;

/* A segment at the border of a cell: its line, first end and length, and where it is near the cell.
 */
typedef struct lrcsi_cell_border {
    double line[3], start[2];
    double length;
    lrcsi_clip_interval interval;
} lrcsi_cell_border;

/* What was found of a facet, bits. */
enum {
    LRCSI_FINDING_VISIBLE = 1, /* it is visible in a cell */
    LRCSI_FINDING_HIDDEN = 2,
    LRCSI_FINDING_UNDECIDED = 4,
    LRCSI_FINDING_CHARGED = 8 /* listed in a cell of which all the area was charged */
};

typedef struct lrcsi_cells_work {
    /* Given: */
    const lrcsi_view *view;
    lrcsi_meter *meter;          /* limit on steps; NULL: none */
    const unsigned char *wanted; /* facet: 1 if its area is wanted */
    double negligible; /* undecided area that is charged without computing it more closely */

    /* Found: */
    unsigned char *state; /* facet: what was found of it, as above */
    lrcsi_cell_area *area;
    lrcsi_moment *moment; /* facet: of its visible region; NULL: not wanted */

    /* The blocks, and the vertices in them: */
    lrcsi_block_grid grid;
    lrcsi_cells_frame frame;
    unsigned char *kind; /* facet: LRCSI_FACET_COPLANAR and so on (visibility/cells_facet.h) */

    /* The current block: */
    lrcsi_cells_facet *facet; /* facet: its record, if it is listed in the block */
    lrcsi_cells_segment *segment;
    uint32_t segment_count, segment_room;
    double extent;    /* the largest coordinate in the block, from its middle */
    double facet_err; /* the largest position error of its facets */

    /* The cells that wait: */
    lrcsi_cell *stack;
    uint32_t top;
    uint32_t *facets, *segments; /* the lists of facets and segments of all of them */
    size_t facets_room, segments_room;

    /* Scratch of the current cell. Arrays are marked with the number of its sample, so that they
       need no clearing: */
    uint32_t stamp;         /* that number */
    uint32_t *listed;       /* facet: the last sample in whose cell it was listed */
    uint32_t *covers;       /* facet: 2 stamp + 1 if it certainly covers the sample, 2 stamp
                               if it may */
    uint32_t *in_component; /* facet: the last sample in whose component it was */
    uint32_t *contacts;     /* facet: the last sample whose component it met at a contact */
    uint32_t *component, components; /* facets of the component */
    uint32_t *hit, hits;             /* facets that may cover the sample */
    lrcsi_cell_border *border;       /* edges of the component at the border of the cell */
    uint32_t borders;
} lrcsi_cells_work;

/* Statements about a cell hold for all points within this distance of it, as computed: its shape
   error, and 16 u of the largest coordinate for distances from lines. */
static inline double lrcsi_cells_tolerance(const lrcsi_cells_work *c, const lrcsi_cell *cell)
{
    return 16 * LRCSI_U * c->extent + cell->shape_err;
}

#endif
