/* SPDX-License-Identifier: MIT */
/* The grid of blocks: where they are, and what stands in each. What a block holds is cut into cells
   elsewhere. */
#include "visibility/cells_block.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/grid.h"

/* How often facets and events may be listed in blocks, a facet and beside that. */
#define ENTRIES_A_FACET 16u
#define ENTRIES_LEAST   65536u

static uint64_t block_entries(const lrcs_prepared *p)
{
    return ENTRIES_LEAST + (uint64_t)ENTRIES_A_FACET * p->scene->facet_count;
}

/* Blocks are squares of the window of the scene's bulk, four times as large as the cells of the
   grid of the classification, in a ring of blocks that hold what stands outside. */
#define BLOCK 4u

static void blocks_place(lrcsi_cells_grid *c)
{
    const lrcsi_grid *grid = &c->classification->grid;
    uint32_t size = (grid->size + BLOCK - 1) / BLOCK;
    c->side = size + 2;
    c->size = grid->scale > 0 ? BLOCK / (grid->scale * c->classification->view->scale) : 1;
    for (int k = 0; k < 2; k++) {
        c->low[k] = grid->low[k] / c->classification->view->scale;
        c->high[k] = c->low[k] + size * c->size;
    }
}

/* The first coordinate of block i of a row, i from 1 to the last but one, or the last. */
static double block_edge(const lrcsi_cells_grid *c, uint32_t i, int k)
{
    return c->low[k] + (i - 1) * c->size;
}

/* The block of a coordinate, or one beside it, where it is nearly on the edge. */
static uint32_t block_of(const lrcsi_cells_grid *c, double x, int k)
{
    double i = (x - c->low[k]) / c->size + 1;
    return (uint32_t)lrcsi_least(c->side - 1.0, lrcsi_most(0, i));
}

/* The blocks that a range of coordinates touches: *from <= i < *to. */
static void block_range(const lrcsi_cells_grid *c, double low, double high, int k, uint32_t *from,
                        uint32_t *to)
{
    double near = 64 * LRCSI_U * (fabs(c->low[k]) + c->side * c->size);
    *from = block_of(c, low - near, k);
    *to = block_of(c, high + near, k) + 1;
}

/* Counts items in blocks, or files them, rows y0 <= y < y1. */
static void block_put(lrcsi_cells_lists *b, size_t row, uint32_t x0, uint32_t x1, uint32_t item)
{
    for (size_t i = row + x0; i < row + x1; i++) {
        if (b->item) {
            b->item[b->first[i]++] = item;
        } else {
            b->first[i + 1]++;
        }
    }
}

static void blocks_put_facet(lrcsi_cells_grid *c, lrcsi_cells_lists *b, uint32_t facet)
{
    const uint32_t *corner = c->classification->view->prepared->scene->facet[facet].corner;
    double low[3];
    double high[3];
    uint32_t x[2];
    uint32_t y[2];
    lrcsi_view_bounds(c->classification->view, corner, 3, low, high);
    block_range(c, low[0], high[0], 0, &x[0], &x[1]);
    block_range(c, low[1], high[1], 1, &y[0], &y[1]);
    for (uint32_t row = y[0]; row < y[1]; row++) {
        block_put(b, (size_t)row * c->side, x[0], x[1], facet);
    }
}

/* An edge, row by row: where it is in one, but for twice its error. */
static void blocks_put_edge(lrcsi_cells_grid *c, lrcsi_cells_lists *b, uint32_t event)
{
    const lrcsi_edge *e =
        &c->classification->view->prepared->topology.edge[c->classification->events.edge[event]];
    const double *p = c->classification->view->point[e->low].x;
    const double *q = c->classification->view->point[e->high].x;
    double off = 4 * lrcsi_most(lrcsi_view_off(p), lrcsi_view_off(q));
    uint32_t y[2];
    block_range(c, lrcsi_least(p[1], q[1]) - off, lrcsi_most(p[1], q[1]) + off, 1, &y[0], &y[1]);
    for (uint32_t row = y[0]; row < y[1]; row++) {
        double from = lrcsi_least(p[0], q[0]);
        double to = lrcsi_most(p[0], q[0]);
        double rise = q[1] - p[1];
        if (y[1] - y[0] > 1 && fabs(rise) > 64 * off) {
            double slope = (q[0] - p[0]) / rise;
            double near = off + 64 * LRCSI_U * (fabs(c->low[1]) + c->side * c->size);
            double low = row > 0 ? block_edge(c, row, 1) - near : -HUGE_VAL;
            double high = row + 1 < c->side ? block_edge(c, row + 1, 1) + near : HUGE_VAL;
            low = lrcsi_most(low, lrcsi_least(p[1], q[1]));
            high = lrcsi_least(high, lrcsi_most(p[1], q[1]));
            double a = p[0] + slope * (low - p[1]);
            double z = p[0] + slope * (high - p[1]);
            from = lrcsi_most(from, lrcsi_least(a, z) - fabs(slope) * off);
            to = lrcsi_least(to, lrcsi_most(a, z) + fabs(slope) * off);
        }
        uint32_t x[2];
        block_range(c, from - off, to + off, 0, &x[0], &x[1]);
        block_put(b, (size_t)row * c->side, x[0], x[1], event);
    }
}

/* Files casting facets, or events. 0 if they find no memory, or are listed too often. */
static int blocks_make(lrcsi_cells_grid *c, lrcsi_cells_lists *b, int events, lrcs_work *work)
{
    size_t count = (size_t)c->side * c->side;
    uint32_t items = events ? c->classification->events.count
                            : c->classification->view->prepared->scene->facet_count;
    b->first = lrcsi_work_take_zero(work, count + 1, sizeof *b->first);
    b->item = NULL;
    if (!b->first) {
        return 0;
    }
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < items; i++) {
            if (events) {
                blocks_put_edge(c, b, i);
            } else if (lrcsi_grid_casts(c->classification->view, i)) {
                blocks_put_facet(c, b, i);
            }
        }
        if (pass == 0) {
            uint64_t total = 0;
            for (size_t k = 0; k < count; k++) {
                total += b->first[k + 1];
                b->first[k + 1] = (uint32_t)total;
                if (total > block_entries(c->classification->view->prepared)) {
                    return 0;
                }
            }
            b->item = lrcsi_work_take(work, (size_t)total, sizeof *b->item);
            if (!b->item) {
                return 0;
            }
        }
    }
    for (size_t k = count; k > 0; k--) {
        b->first[k] = b->first[k - 1];
    }
    b->first[0] = 0;
    return 1;
}

/* The ring reaches out of the window of all that stands in the view. */
double lrcsi_cells_grid_square(const lrcsi_cells_grid *c, uint32_t x, uint32_t y,
                               lrcsi_clip_polygon *shape, double middle[2])
{
    const uint32_t at[2] = {x, y};
    double low[2];
    double high[2];
    double reach = 0;
    for (int k = 0; k < 2; k++) {
        double start = c->classification->view->low[k];
        double end = c->classification->view->low[k] + c->classification->view->side;
        double wide = 0x1p-30 * (fabs(start) + fabs(end) + c->side * c->size);
        low[k] = at[k] > 0 ? block_edge(c, at[k], k) : lrcsi_least(start, c->low[k]) - wide;
        high[k] =
            at[k] + 1 < c->side ? block_edge(c, at[k] + 1, k) : lrcsi_most(end, c->high[k]) + wide;
        middle[k] = 0.5 * (low[k] + high[k]);
        low[k] -= middle[k];
        high[k] -= middle[k];
        reach = lrcsi_most(reach, lrcsi_most(fabs(low[k]), fabs(high[k])));
    }
    *shape = (lrcsi_clip_polygon){
        .corner = {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}},
        .count = 4};
    return reach;
}

size_t lrcsi_cells_grid_need(const lrcs_prepared *prepared)
{
    size_t blocks = 2 * (size_t)prepared->scene->facet_count +
                    64; /* at most half as many along a side as the grid has, and 2 */
    size_t need = 2 * lrcsi_work_bytes(blocks, sizeof(uint32_t));
    return lrcsi_work_add(need,
                          2 * lrcsi_work_bytes((size_t)block_entries(prepared), sizeof(uint32_t)));
}

int lrcsi_cells_grid_make(const lrcsi_classification *classification, lrcs_work *work,
                          lrcsi_cells_grid *c)
{
    *c = (lrcsi_cells_grid){.classification = classification};
    blocks_place(c);
    return classification->view->side <= 2 * c->side * c->size &&
           blocks_make(c, &c->facets, 0, work) && blocks_make(c, &c->events, 1, work);
}
