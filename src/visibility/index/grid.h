/* SPDX-License-Identifier: MIT */
/* A uniform grid over the window of the scene's bulk, whose buckets list the items (facets or
   edges) that may lie in them. What lies outside the window belongs to the buckets on the border.
   Conservative: an item is listed in every bucket that its box meets. If large items make the lists
   too long, buckets are doubled until they are short enough: this bounds the memory of a grid for
   any scene, and the cost of walking through the buckets of all items. */
#ifndef LRCSI_GRID_H
#define LRCSI_GRID_H

#include "base/range.h"
#include "view/segment.h"
#include "visibility/index/boxes.h"

typedef struct lrcsi_grid {
    const lrcsi_view *view;
    lrcsi_boxes boxes;       /* if facets are the items: their boxes, to be read */
    double low[2], side;     /* of the window, in the units of boxes */
    uint32_t size;           /* buckets along each side */
    double buckets_per_unit; /* in the units of boxes */
    double last;             /* size - 1 */
    uint32_t *first;         /* size * size + 1 */
    uint32_t *item;          /* those of bucket b: item[first[b] .. first[b + 1]) */
} lrcsi_grid;

/* A rectangle of buckets: x0 <= x < x1, y0 <= y < y1. */
typedef struct lrcsi_grid_rect {
    uint16_t x0, x1, y0, y1;
} lrcsi_grid_rect;

/* The bucket of a coordinate in units of boxes, kept within 0 .. size - 1; of two coordinates the
   larger is never in the lower bucket. */
static inline uint16_t lrcsi_grid_bucket(const lrcsi_grid *grid, double x, int axis)
{
    double bucket = (x - grid->low[axis]) * grid->buckets_per_unit;
    return (uint16_t)lrcsi_min(grid->last, lrcsi_max(0, bucket));
}

/* The buckets that a box meets. */
static inline lrcsi_grid_rect lrcsi_grid_buckets(const lrcsi_grid *grid, const lrcsi_view_box *box)
{
    return (lrcsi_grid_rect){.x0 = lrcsi_grid_bucket(grid, (double)box->low[0], 0),
                             .x1 = (uint16_t)(lrcsi_grid_bucket(grid, (double)box->high[0], 0) + 1),
                             .y0 = lrcsi_grid_bucket(grid, (double)box->low[1], 1),
                             .y1 =
                                 (uint16_t)(lrcsi_grid_bucket(grid, (double)box->high[1], 1) + 1)};
}

/* A walk over a rectangle of buckets row by row; or over those of its rows that a polygon may
   meet. */
typedef struct lrcsi_grid_walk {
    const lrcsi_grid *grid;
    lrcsi_grid_rect left;       /* the rows that are left */
    int sides;                  /* 0: whole rows */
    lrcsi_view_segment side[4]; /* of the polygon, in the units of boxes */
} lrcsi_grid_walk;

static inline void lrcsi_grid_walk_begin(const lrcsi_grid *grid, lrcsi_grid_rect rect,
                                         lrcsi_grid_walk *walk)
{
    walk->grid = grid;
    walk->left = rect;
    walk->sides = 0;
}

/* Limits the rows of a walk to the buckets that a convex polygon may meet, given by its two to four
   corners in order; two: a segment. Rows and columns on the border extend to infinity. */
void lrcsi_grid_walk_limit(lrcsi_grid_walk *walk, const lrcsi_view_vertex *corner, int count);

/* A walk over the buckets that a facet of a given box may meet. */
void lrcsi_grid_walk_facet(const lrcsi_grid *grid, const lrcsi_view_box *box, uint32_t facet,
                           lrcsi_grid_walk *walk);

/* Buckets x0 <= x < x1 of row y; x0 == x1: none. */
typedef struct lrcsi_grid_row {
    uint32_t y, x0, x1;
} lrcsi_grid_row;

/* Those of a row that the polygon may meet. */
lrcsi_grid_row lrcsi_grid_walk_limited(const lrcsi_grid_walk *walk, uint32_t y);

/* The next row of a walk. Returns 0 if none is left. */
static inline int lrcsi_grid_walk_next(lrcsi_grid_walk *walk, lrcsi_grid_row *row)
{
    const uint32_t y = walk->left.y0;
    if (y == walk->left.y1) {
        return 0;
    }
    walk->left.y0++;
    *row = walk->sides > 0 ? lrcsi_grid_walk_limited(walk, y)
                           : (lrcsi_grid_row){y, walk->left.x0, walk->left.x1};
    return 1;
}

/* A range of grid->item: from <= i < to. */
typedef struct lrcsi_grid_items {
    uint32_t from, to;
} lrcsi_grid_items;

/* The items of buckets x0 <= x < x1 of row y, each once for each bucket that lists it: the lists of
   a row follow one another. */
static inline lrcsi_grid_items lrcsi_grid_row_items(const lrcsi_grid *grid, uint32_t y, uint32_t x0,
                                                    uint32_t x1)
{
    const uint32_t *row = grid->first + (size_t)y * grid->size;
    return (lrcsi_grid_items){row[x0], row[x1]};
}

/* Walks over a rectangle of buckets row by row: the items of its first row, which is then removed
   from it. Returns 0 if no row is left. */
static inline int lrcsi_grid_next_row(const lrcsi_grid *grid, lrcsi_grid_rect *rect,
                                      lrcsi_grid_items *items)
{
    if (rect->y0 == rect->y1) {
        return 0;
    }
    *items = lrcsi_grid_row_items(grid, rect->y0++, rect->x0, rect->x1);
    return 1;
}

/* The number of items of these buckets, each counted once for each bucket that lists it. */
static inline uint32_t lrcsi_grid_listed(const lrcsi_grid *grid, lrcsi_grid_rect rect)
{
    uint32_t listed = 0;
    lrcsi_grid_items items;
    while (lrcsi_grid_next_row(grid, &rect, &items)) {
        listed += items.to - items.from;
    }
    return listed;
}

/* Do these buckets list any item? */
static inline int lrcsi_grid_has_items(const lrcsi_grid *grid, lrcsi_grid_rect rect)
{
    lrcsi_grid_items items;
    while (lrcsi_grid_next_row(grid, &rect, &items)) {
        if (items.from != items.to) {
            return 1;
        }
    }
    return 0;
}

/* How often a facet is listed at most, on average. Facets that fill 16 buckets fill at most 9 of
   twice the size: a coarser grid has lists little more than twice as long, and fewer of them per
   facet. */
#define LRCSI_GRID_FACET_BUCKETS 16u

/* A grid of the window with at most `buckets` buckets, but at least one, without lists. */
lrcsi_grid lrcsi_grid_empty(const lrcsi_view *view, uint32_t buckets);

/* Lists edges in an empty grid, each in the buckets along it: item i stands for topology edge
   edge[i]. Until there are at most `most` entries, or one per edge, the grid is made coarser.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_grid_edges(const uint32_t *edge, uint32_t count, uint64_t most, lrcs_work *work,
                     lrcsi_grid *grid);

/* Bytes at most for a grid with so many buckets and entries. */
size_t lrcsi_grid_need(size_t buckets, size_t entries);

/* Makes an empty grid coarser until the facets whose boxes are made meet at most about
   LRCSI_GRID_FACET_BUCKETS buckets on average. Returns 1 if the grid has changed. */
int lrcsi_grid_fit(lrcsi_grid *grid, const lrcsi_boxes *boxes);

/* Bytes at most for a grid of facets. */
size_t lrcsi_grid_facets_need(const lrcs_prepared *prepared);

/* The facets around which a grid is going to be searched, so that its lists must be complete there:
   those that are marked and, unless region is NULL, the first of each region. */
typedef struct lrcsi_grid_readers {
    const unsigned char *undecided;    /* of each facet: is it marked? */
    const uint32_t *region;            /* of each facet: the first facet of its region */
    const lrcsi_facet_signs *joinable; /* visibility/uniform/classify.h; with region */
} lrcsi_grid_readers;

/* A grid of the facets that can hide something, in at most as many buckets as another grid: each is
   listed in the buckets that it may meet, at most LRCSI_GRID_FACET_BUCKETS times on average. Lists
   are complete in the buckets of the readers' boxes; with readers NULL, in all buckets. It opens
   the meshlets of the readers and of all facets that it lists. Status: as above. */
int lrcsi_grid_facets(const lrcsi_grid *like, lrcsi_boxes *boxes, const lrcsi_grid_readers *readers,
                      lrcs_work *work, lrcsi_grid *grid);

#endif
