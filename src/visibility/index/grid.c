/* SPDX-License-Identifier: MIT */
/* The buckets of a grid, and how items are sorted into them: counted first, then filled, in item
   order. Nothing is decided about visibility. */
#include "visibility/index/grid.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/index/event.h"
#include "visibility/index/lists.h"

/* The largest number of buckets along a side: their numbers must fit 16 bits, and the lists of so
   many fit ordinary memory. */
#define MAX_SIZE 2048

/* --- the grid --------------------------------------------------------------------------------- */

/* The number of buckets along a side of a square grid of about this many. */
static uint32_t grid_size(size_t buckets)
{
    return (uint32_t)lrcsi_min(MAX_SIZE, lrcsi_max(1, sqrt((double)buckets)));
}

size_t lrcsi_grid_need(size_t buckets, size_t entries)
{
    size_t size = grid_size(buckets);
    return lrcsi_work_add(lrcsi_work_bytes(size * size + 1, sizeof(uint32_t)),
                          lrcsi_work_bytes(entries, sizeof(uint32_t)));
}

size_t lrcsi_grid_facets_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_work_bytes(lrcsi_work_square(grid_size(facets)), 1),
                                 lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_grid_need(facets, LRCSI_GRID_FACET_BUCKETS * facets));
}

/* The window: what the view's own has in common with the projection of the box around the bulk. No
   proof rests on where it is. */
lrcsi_grid lrcsi_grid_empty(const lrcsi_view *view, uint32_t buckets)
{
    lrcsi_grid grid = {.view = view, .size = grid_size(buckets)};
    const double *bulk = view->prepared->bulk;
    for (int k = 0; k < 2; k++) {
        const double *row = view->R[k];
        double half = fabs(row[0]) * bulk[0] + fabs(row[1]) * bulk[1] + fabs(row[2]) * bulk[2];
        double low = lrcsi_max(view->low[k], -half);
        double high = lrcsi_min(view->low[k] + view->side, half);
        grid.low[k] = low * view->scale;
        grid.side = lrcsi_max(grid.side, (high - low) * view->scale);
    }
    grid.buckets_per_unit = grid.side > 0 ? grid.size / grid.side : 0;
    grid.last = grid.size - 1.0;
    return grid;
}

/* Doubles the size of the buckets; the grid has no lists then. Halving the scale is exact, except
   for numbers so small that they are in bucket 0 in any case: the new bucket of a coordinate is
   half the old one, rounded down. */
static void grid_coarsen(lrcsi_grid *grid)
{
    grid->first = grid->item = NULL;
    grid->size = (grid->size + 1) / 2;
    grid->buckets_per_unit /= 2;
    grid->last = grid->size - 1.0;
}

static size_t grid_count(const lrcsi_grid *grid)
{
    return (size_t)grid->size * grid->size;
}

static int grid_start(lrcsi_grid *grid, lrcs_work *work)
{
    grid->first = lrcsi_work_take_zero(work, grid_count(grid) + 1, sizeof *grid->first);
    return grid->first ? LRCS_OK : LRCS_E_MEMORY;
}

static int grid_room(lrcs_work *work, lrcsi_grid *grid)
{
    return lrcsi_lists_room(grid->first, grid_count(grid), LRCS_NONE - 1, work, &grid->item);
}

/* Counts or lists an item in a row of buckets. Returns how many they are. */
static uint32_t grid_put(lrcsi_grid *grid, uint32_t y, uint32_t x0, uint32_t x1, uint32_t item)
{
    lrcsi_lists_put(grid->first + (size_t)y * grid->size, grid->item, x0, x1, item);
    return x1 - x0;
}

/* The errors of the sides are increased by the rounding errors of what is computed from them
   (points at t, rows, and the t at which a side enters a row), each less than 8 u of a coordinate
   between the side's and the window's; and by the rounding of boxes, 2^-24 of the latter. */
void lrcsi_grid_walk_limit(lrcsi_grid_walk *walk, const lrcsi_view_vertex *corner, int count)
{
    const lrcsi_grid *grid = walk->grid;
    double rounding = 0x1p-23 * (fabs(grid->low[0]) + fabs(grid->low[1]) + grid->side);
    walk->sides = count == 2 ? 1 : count;
    for (int k = 0; k < walk->sides; k++) {
        walk->side[k] = lrcsi_view_segment_make(&corner[k], &corner[(k + 1) % count],
                                                grid->view->scale, rounding);
    }
}

/* If a facet is in at least so many rows and columns of the grid, each row is limited to the
   buckets between its sides: long facets across the grid meet few of the buckets of their boxes.
   Heuristic: with fewer rows this saves less than it takes. */
enum { MIN_ROWS = 3 };

void lrcsi_grid_walk_facet(const lrcsi_grid *grid, const lrcsi_view_box *box, uint32_t facet,
                           lrcsi_grid_walk *walk)
{
    const lrcsi_grid_rect all = lrcsi_grid_buckets(grid, box);
    lrcsi_grid_walk_begin(grid, all, walk);
    if (all.x1 - all.x0 >= MIN_ROWS && all.y1 - all.y0 >= MIN_ROWS) {
        const uint32_t *corner = grid->view->prepared->scene->facet[facet].corner;
        const lrcsi_view_vertex *point = grid->view->point;
        const lrcsi_view_vertex corners[3] = {point[corner[0]], point[corner[1]], point[corner[2]]};
        lrcsi_grid_walk_limit(walk, corners, 3);
    }
}

lrcsi_grid_row lrcsi_grid_walk_limited(const lrcsi_grid_walk *walk, uint32_t y)
{
    const lrcsi_grid *grid = walk->grid;
    double bottom = y > 0 ? grid->low[1] + y / grid->buckets_per_unit : -HUGE_VAL;
    double top = y + 1 < grid->size ? grid->low[1] + (y + 1) / grid->buckets_per_unit : HUGE_VAL;
    double x[2];
    return lrcsi_view_segments_range(walk->side, walk->sides, bottom, top, x)
               ? (lrcsi_grid_row){y, lrcsi_grid_bucket(grid, x[0], 0),
                                  lrcsi_grid_bucket(grid, x[1], 0) + 1u}
               : (lrcsi_grid_row){y, 0, 0};
}

/* Counts or lists the edges. Returns the number of entries, or of those up to the first edge with
   which they are more than `most`. */
static uint64_t edges_put(lrcsi_grid *grid, const uint32_t *edge, uint32_t count, uint64_t most)
{
    const lrcsi_view *view = grid->view;
    uint64_t listed = 0;
    for (uint32_t i = 0; i < count && listed <= most; i++) {
        const lrcsi_edge *e = &view->prepared->topology.edge[edge[i]];
        const uint32_t ends[2] = {e->low, e->high};
        const lrcsi_view_box box = lrcsi_view_box_of(view, ends, 2);
        const lrcsi_grid_rect buckets = lrcsi_grid_buckets(grid, &box);
        lrcsi_grid_walk walk;
        lrcsi_grid_row row;
        lrcsi_grid_walk_begin(grid, buckets, &walk);
        if (buckets.y1 - buckets.y0 > 1) {
            const lrcsi_view_vertex corners[2] = {view->point[ends[0]], view->point[ends[1]]};
            lrcsi_grid_walk_limit(&walk, corners, 2);
        }
        while (lrcsi_grid_walk_next(&walk, &row)) {
            listed += grid_put(grid, row.y, row.x0, row.x1, i);
        }
    }
    return listed;
}

/* A grid of one bucket lists each edge once, which is never too often. */
int lrcsi_grid_edges(const uint32_t *edge, uint32_t count, uint64_t most, lrcs_work *work,
                     lrcsi_grid *grid)
{
    size_t mark = work->used;
    most = most > count ? most : count;
    int status = grid_start(grid, work);
    while (status == LRCS_OK && edges_put(grid, edge, count, most) > most) {
        work->used = mark;
        grid_coarsen(grid);
        status = grid_start(grid, work);
    }
    status = status == LRCS_OK ? grid_room(work, grid) : status;
    if (status == LRCS_OK) {
        edges_put(grid, edge, count, most);
        lrcsi_lists_finish(grid->first, grid_count(grid));
    }
    return status;
}

/* --- facets ----------------------------------------------------------------------------------- */

/* In a scene of at least MANY_FACETS, a facet whose box meets at least MIN_BOX_BUCKETS is listed
   only in the buckets along it. Heuristics: with fewer buckets, finding these takes longer than it
   saves; with fewer facets, the smaller buckets that a grid then has cost more than they save. */
enum { MANY_FACETS = 32768, MIN_BOX_BUCKETS = 32 };

static int is_listed_by_box(const lrcsi_grid *grid, lrcsi_grid_rect r)
{
    return (r.x1 - r.x0) * (r.y1 - r.y0) < MIN_BOX_BUCKETS ||
           grid->view->prepared->scene->facet_count < MANY_FACETS;
}

/* About how many buckets a facet is listed in. Averaged over all places, a convex figure meets as
   many unit squares as its area, its width, its height and 1 add up to. */
static uint64_t facet_buckets(const lrcsi_grid *grid, const lrcsi_boxes *boxes, uint32_t facet)
{
    const lrcsi_grid_rect r = lrcsi_grid_buckets(grid, lrcsi_boxes_facet(boxes, facet));
    const uint32_t count = (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
    if (is_listed_by_box(grid, r)) {
        return count;
    }
    const double unit = grid->view->scale * grid->buckets_per_unit;
    const double area = lrcsi_view_projected(grid->view, facet) * unit * unit;
    const int around = (r.x1 - r.x0) + (r.y1 - r.y0) - 1;
    return (uint64_t)lrcsi_min(count, area + around);
}

/* A grid of one bucket lists each facet once, so the loop ends. */
int lrcsi_grid_fit(lrcsi_grid *grid, const lrcsi_boxes *boxes)
{
    const lrcs_prepared *p = grid->view->prepared;
    for (int changed = 0;; changed = 1) {
        uint64_t filled = 0;
        uint64_t facets = 0;
        for (uint32_t m = 0; m < p->meshlets.count; m++) {
            uint32_t start = m * LRCSI_MESHLET_FACETS;
            uint32_t end = lrcsi_meshlet_end(start, p->scene->facet_count);
            end = boxes->state[m] == LRCSI_BOXES_FACETS ? end : start;
            for (uint32_t f = start; f < end; f++) {
                if (lrcsi_view_casts(grid->view, f)) {
                    filled += facet_buckets(grid, boxes, f);
                    facets++;
                }
            }
        }
        if (filled <= LRCSI_GRID_FACET_BUCKETS * facets) {
            return changed;
        }
        grid_coarsen(grid);
    }
}

/* Marks the buckets of the readers' boxes, whose lists will be read: *needed has a byte for each
   bucket; NULL without readers: all will be. Facets that meet none of these buckets are not listed.
   */
static int needed_make(const lrcsi_grid *grid, lrcsi_boxes *boxes,
                       const lrcsi_grid_readers *readers, lrcs_work *work, unsigned char **needed)
{
    *needed = NULL;
    if (!readers) {
        return LRCS_OK;
    }
    *needed = lrcsi_work_take_zero(work, grid_count(grid), 1);
    const lrcs_prepared *p = grid->view->prepared;
    for (uint32_t m = 0; m < p->meshlets.count && *needed; m++) {
        uint32_t start = m * LRCSI_MESHLET_FACETS;
        uint32_t end = lrcsi_meshlet_end(start, p->scene->facet_count);
        if (boxes->state[m] == LRCSI_BOXES_NONE) {
            continue;
        }
        if (readers->region && lrcsi_events_joined(p, readers->joinable, m) == LRCSI_JOINED_ALL) {
            end = start + 1; /* the others are not the first of their region, nor undecided */
        }
        for (uint32_t f = start; f < end; f++) {
            if ((readers->undecided[f] || (readers->region && readers->region[f] == f)) &&
                lrcsi_view_casts(grid->view, f)) {
                lrcsi_boxes_open(boxes, m);
                lrcsi_grid_rect r = lrcsi_grid_buckets(grid, lrcsi_boxes_facet(boxes, f));
                for (uint32_t y = r.y0; y < r.y1; y++) {
                    memset(*needed + (size_t)y * grid->size + r.x0, 1, (size_t)(r.x1 - r.x0));
                }
            }
        }
    }
    return *needed ? LRCS_OK : LRCS_E_MEMORY;
}

/* Is any of these buckets marked? */
static int needed_in_row(const lrcsi_grid *grid, const unsigned char *needed, lrcsi_grid_row row)
{
    const unsigned char *bucket = needed + (size_t)row.y * grid->size;
    for (uint32_t x = row.x0; x < row.x1; x++) { /* few: memchr would cost more */
        if (bucket[x]) {
            return 1;
        }
    }
    return 0;
}

static int needed_any(const lrcsi_grid *grid, const unsigned char *needed, lrcsi_grid_rect r)
{
    for (uint32_t y = r.y0; y < r.y1; y++) {
        if (needed_in_row(grid, needed, (lrcsi_grid_row){y, r.x0, r.x1})) {
            return 1;
        }
    }
    return 0;
}

/* Is a facet listed in a marked bucket? */
static int facet_is_needed(const lrcsi_grid *grid, const unsigned char *needed,
                           const lrcsi_boxes *boxes, uint32_t facet)
{
    const lrcsi_view_box *box = lrcsi_boxes_facet(boxes, facet);
    const lrcsi_grid_rect r = lrcsi_grid_buckets(grid, box);
    if (is_listed_by_box(grid, r)) {
        return needed_any(grid, needed, r);
    }
    lrcsi_grid_walk walk;
    lrcsi_grid_row row;
    lrcsi_grid_walk_facet(grid, box, facet, &walk);
    while (lrcsi_grid_walk_next(&walk, &row)) {
        if (needed_in_row(grid, needed, row)) {
            return 1;
        }
    }
    return 0;
}

/* Lists the facets that meet buckets to be read, in order, and makes their boxes. Status: LRCS_OK;
   LRCS_E_MEMORY. */
static int facets_select(const lrcsi_grid *grid, lrcsi_boxes *boxes, const unsigned char *needed,
                         lrcs_work *work, uint32_t **facet, uint32_t *selected)
{
    uint32_t count = grid->view->prepared->scene->facet_count;
    size_t mark = work->used;
    uint32_t *list = lrcsi_work_take(work, count, sizeof *list);
    uint32_t listed = 0;
    for (uint32_t start = 0; start < count && list; start += LRCSI_MESHLET_FACETS) {
        uint32_t meshlet = start / LRCSI_MESHLET_FACETS;
        if (boxes->state[meshlet] == LRCSI_BOXES_NONE ||
            (needed &&
             !needed_any(grid, needed, lrcsi_grid_buckets(grid, &boxes->meshlet[meshlet])))) {
            continue;
        }
        lrcsi_boxes_open(boxes, meshlet);
        uint32_t end = lrcsi_meshlet_end(start, count);
        for (uint32_t f = start; f < end; f++) {
            if (lrcsi_view_casts(grid->view, f) &&
                (!needed || facet_is_needed(grid, needed, boxes, f))) {
                list[listed++] = f;
            }
        }
    }
    if (!list) {
        return LRCS_E_MEMORY;
    }
    work->used = mark; /* the list is already stored here */
    *facet = lrcsi_work_take(work, listed, sizeof *list);
    *selected = listed;
    return LRCS_OK;
}

/* Counts the entries of a facet, or writes them. Returns the number of entries. */
static uint64_t facet_put(lrcsi_grid *grid, uint32_t facet)
{
    const lrcsi_view_box *box = lrcsi_boxes_facet(&grid->boxes, facet);
    const lrcsi_grid_rect r = lrcsi_grid_buckets(grid, box);
    uint64_t listed = 0;
    if (is_listed_by_box(grid, r)) {
        for (uint32_t y = r.y0; y < r.y1; y++) {
            listed += grid_put(grid, y, r.x0, r.x1, facet);
        }
        return listed;
    }
    lrcsi_grid_walk walk;
    lrcsi_grid_row row;
    lrcsi_grid_walk_facet(grid, box, facet, &walk);
    while (lrcsi_grid_walk_next(&walk, &row)) {
        listed += grid_put(grid, row.y, row.x0, row.x1, facet);
    }
    return listed;
}

/* The same for all selected facets. */
static uint64_t facets_put(lrcsi_grid *grid, const uint32_t *facet, uint32_t selected)
{
    uint64_t listed = 0;
    for (uint32_t i = 0; i < selected; i++) {
        listed += facet_put(grid, facet[i]);
    }
    return listed;
}

/* 1. Mark the buckets that will be read. 2. Select the facets that meet them. 3. Count the facets
   of each bucket; if there are too many entries, make the buckets larger and start again. 4. Fill
   the lists. */
int lrcsi_grid_facets(const lrcsi_grid *like, lrcsi_boxes *boxes, const lrcsi_grid_readers *readers,
                      lrcs_work *work, lrcsi_grid *grid)
{
    size_t mark = work->used;
    const lrcsi_view *view = like->view;
    uint64_t most = LRCSI_GRID_FACET_BUCKETS * ((uint64_t)view->front + view->back);
    lrcsi_grid g = *like;
    unsigned char *needed;
    uint32_t *facet = NULL;
    uint32_t selected = 0;
    int status;
    g.first = g.item = NULL;
    for (;;) {
        status = needed_make(&g, boxes, readers, work, &needed);
        status =
            status == LRCS_OK ? facets_select(&g, boxes, needed, work, &facet, &selected) : status;
        status = status == LRCS_OK ? grid_start(&g, work) : status;
        g.boxes = *boxes;
        if (status != LRCS_OK || facets_put(&g, facet, selected) <= most) {
            break;
        }
        work->used = mark;
        grid_coarsen(&g);
    }
    status = status == LRCS_OK ? grid_room(work, &g) : status;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    facets_put(&g, facet, selected);
    lrcsi_lists_finish(g.first, grid_count(&g));
    *grid = g;
    return LRCS_OK;
}
