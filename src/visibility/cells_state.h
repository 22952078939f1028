/* SPDX-License-Identifier: MIT */
/* The data that the modules of cells share: the grid of blocks, a cell, what is known of facets,
   and the state of a view that is being divided (visibility/cells.c). */
#ifndef LRCSI_CELLS_STATE_H
#define LRCSI_CELLS_STATE_H

#include "base/constant.h"
#include "visibility/cells_facet.h"
#include "visibility/classify.h"

/* The grid of blocks that the view plane is divided into, with the facets and the event edges of
   each. */
/* item[first[b] .. first[b + 1]) of block b. */
typedef struct lrcsi_cells_lists {
    uint32_t *first, *item;
} lrcsi_cells_lists;

typedef struct lrcsi_cells_grid {
    const lrcsi_classification *classification;
    const unsigned char *answer; /* of uniform facets (visibility/query.h), or NULL */
    uint32_t side;            /* blocks along a side, with a ring of blocks for what is outside */
    double low[2], high[2];   /* of the blocks within the ring */
    double least[2], most[2]; /* of these and of all facets, with the errors of their corners */
    double size, per;         /* of a block, and 1 / size */
    double rounding;          /* more than the rounding errors of places among the blocks */
    lrcsi_cells_lists facets, events;
} lrcsi_cells_grid;

/* The largest number of cuts from a block to a cell, and of cells that wait. */
#define LRCSI_CELLS_CUTS    200u
#define LRCSI_CELLS_WAITING (LRCSI_CELLS_CUTS + 2)
/* The largest number of a component's edges at the border of a cell. */
#define LRCSI_CELLS_BORDERS 128u

/* A part of the view plane that is not done yet. Its facets are the first `facets` of the list of
   facets, its segments the first `segments` of the list of segments. A cut makes two cells: the
   left one is done first, with all that are cut from it, while the right one waits. The left one
   only reorders entries that the cut cell had; so the right one then finds its own among the same
   first entries, and selects them (visibility/cells_cut.h). */
typedef struct lrcsi_cells_cell {
    lrcsi_clip_polygon shape;
    uint32_t facets, segments;
    uint32_t cuts, struck;
    double drift;       /* how far a point that belongs to the cell may be from it */
    double uncertainty; /* area not yet charged, by which that of any facet may be wrong */
    double inset;       /* the widest strip of a segment removed from the list */
    double cut[3];      /* the line of the last cut, */
    double sign;        /* the cell's side of it, 1 left, -1 right, */
    double strip;       /* and the width of the strip charged there */
    uint32_t both[2];   /* a cell that waits: entries from these on (facets, segments) are its own;
                           earlier ones may be */
} lrcsi_cells_cell;

/* Areas of a facet. */
typedef struct lrcsi_cells_found {
    double seen;        /* in cells in which it is visible */
    double off;         /* error of `seen` */
    double uncertainty; /* in strips in which its visibility is undecided */
    double cut;         /* the length of those strips */
} lrcsi_cells_found;

/* A segment at the border of a cell: its line, first end and length, and the part near the cell. */
typedef struct lrcsi_cells_border {
    double line[3], start[2];
    double length;
    lrcsi_cells_part part;
} lrcsi_cells_border;

/* What was found of a facet, bits. */
enum {
    LRCSI_CELLS_SEEN = 1,   /* visible in a cell */
    LRCSI_CELLS_HIDDEN = 2, /* hidden in a cell */
    LRCSI_CELLS_OPEN = 4,   /* undecided in a cell */
    LRCSI_CELLS_SPARED = 8  /* listed in a cell of which all the area was charged */
};

typedef struct lrcsi_cells_work {
    const lrcsi_view *view;
    lrcsi_meter *meter; /* limit on steps; NULL: none */
    lrcsi_cells_grid grid;
    lrcsi_cells_frame frame;
    unsigned char *open;  /* facet: 1 if its area is wanted */
    unsigned char *found; /* facet: what was found of it, as above */
    unsigned char *kind;  /* facet: LRCSI_CELLS_APART, LRCSI_CELLS_VAGUE */
    lrcsi_cells_facet *facet;
    lrcsi_cells_found *area;
    uint32_t look;    /* the number of the sample at hand, which the next four arrays refer to */
    uint32_t *listed; /* facet: the last sample in whose cell it was listed */
    uint32_t *met;    /* facet: 2 look + 1 if it surely covers the sample, 2 look if it may */
    uint32_t *joined; /* facet: the last sample in whose component it was */
    uint32_t *meets;  /* facet: the last sample whose component it met at a contact */
    uint32_t *component, components; /* facets of the component */
    uint32_t *hit, hits;             /* facets that may cover the sample */
    lrcsi_cells_border *border;      /* edges of the component at the border of the cell */
    uint32_t borders;
    uint32_t *facets;   /* the list of facets */
    uint32_t *segments; /* the list of segments */
    lrcsi_cells_segment *segment;
    uint32_t segment_count, segment_room;
    lrcsi_cells_cell *stack;
    uint32_t top;
    double reach;  /* the largest coordinate in the block at hand, from its middle */
    double off;    /* the largest position error of its facets */
    double trifle; /* undecided area that is charged without computing it more closely */
} lrcsi_cells_work;

/* Moves item i of a list among the first ones: exchanges it with the one at `kept`. */
static inline void lrcsi_cells_keep(uint32_t *list, uint32_t i, uint32_t kept)
{
    uint32_t item = list[i];
    list[i] = list[kept];
    list[kept] = item;
}

/* Statements about a cell hold for all points within this distance of it, as computed: its drift,
   and 16 u of the largest coordinate for distances from lines. */
static inline double lrcsi_cells_reach(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell)
{
    return 16 * LRCSI_U * c->reach + cell->drift;
}

#endif
