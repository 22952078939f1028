/* SPDX-License-Identifier: MIT */
/* What the modules of cells share: a cell, what is found of facets, and the state of a view that is
   being divided (visibility/cells.c). */
#ifndef LRCSI_CELLS_STATE_H
#define LRCSI_CELLS_STATE_H

#include "base/constant.h"
#include "visibility/cells_block.h"
#include "visibility/cells_facet.h"
#include "visibility/cells_join.h"

/* Cuts on the way to a cell, at most; cells that wait. */
#define LRCSI_CELLS_CUTS    200u
#define LRCSI_CELLS_WAITING (LRCSI_CELLS_CUTS + 2)
/* Edges of a component at the border of a cell. */
#define LRCSI_CELLS_BORDERS 128u

/* A part of the view plane that is yet to be done. Its facets are the first so many of the list of
   facets, its segments those of the list of segments. Of two cells that a cut makes, one comes
   first, and then the other: each reorders no more of the lists than the cell had that was cut. So
   the one that waits finds all that may be its own among the first `facets` and `segments`, and
   keeps those once its turn has come (visibility/cells_cut.h). */
typedef struct lrcsi_cells_cell {
    lrcsi_clip_polygon shape;
    uint32_t facets, segments;
    uint32_t cuts, struck;
    double drift;       /* how far a place that belongs to it may be from it */
    double uncertainty; /* area that may be wrong for any facet, yet to be charged */
    double inset;       /* the widest w of what was struck */
    double cut[3];      /* the line along which it was last cut, */
    double sign;        /* which side of it it lies on, */
    double strip;       /* and how wide a strip was charged there */
    uint32_t both[2];   /* a cell that waits: behind so many facets, segments, all are its own */
} lrcsi_cells_cell;

/* What is found of a facet that is asked about. */
typedef struct lrcsi_cells_found {
    double seen;        /* area in cells where it is seen */
    double off;         /* by which that may be wrong */
    double uncertainty; /* area of strips, */
    double cut;         /* and their length */
} lrcsi_cells_found;

/* A segment at the border of a cell. */
typedef struct lrcsi_cells_border {
    double line[3], start[2]; /* of it, and where it starts */
    double length;
    lrcsi_cells_part part;
} lrcsi_cells_border;

/* What was found of a facet. */
enum {
    LRCSI_CELLS_SEEN = 1,   /* a cell shows it */
    LRCSI_CELLS_HIDDEN = 2, /* it is hidden in a cell */
    LRCSI_CELLS_OPEN = 4,   /* nothing can be decided about it in a cell */
    LRCSI_CELLS_SPARED = 8  /* a cell was charged whole */
};

typedef struct lrcsi_cells_work {
    const lrcsi_view *view;
    lrcsi_cells_grid grid;
    lrcsi_cells_frame frame;
    unsigned char *open;
    unsigned char *found; /* facet: what was found of it, as above */
    unsigned char *kind;  /* facet: LRCSI_CELLS_APART, LRCSI_CELLS_VAGUE */
    lrcsi_cells_facet *facet;
    lrcsi_cells_found *area;
    uint32_t *listed; /* facet: the look that found it in the list */
    uint32_t *met;    /* facet: 2 look + 1 if it surely covers the sample, 2 look where perhaps */
    uint32_t *joined; /* facet: the look whose component it is in */
    uint32_t *component, *hit; /* hit: what may cover the sample */
    uint32_t components, hits, look;
    lrcsi_cells_border *border; /* of the component, at the border of the cell */
    uint32_t borders;
    uint32_t *facets;   /* the list of facets, */
    uint32_t *segments; /* and of segments */
    lrcsi_cells_segment *segment;
    uint32_t segment_count, segment_room;
    lrcsi_cells_cell *stack;
    uint32_t top;
    double reach;  /* the largest coordinate in the block at hand, from its middle */
    double off;    /* the largest of what is listed there */
    double trifle; /* area undecided that is charged without a closer look */
} lrcsi_cells_work;

/* Keeps item i of a list as one of the first: puts it in place `kept`, and that one in its own. */
static inline void lrcsi_cells_keep(uint32_t *list, uint32_t i, uint32_t kept)
{
    uint32_t item = list[i];
    list[i] = list[kept];
    list[kept] = item;
}

/* What is said of a cell holds for places within so much of it, computed: its drift, and 16 u of
   the largest coordinate for distances from lines. */
static inline double lrcsi_cells_reach(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell)
{
    return 16 * LRCSI_U * c->reach + cell->drift;
}

#endif
