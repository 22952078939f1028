/* SPDX-License-Identifier: MIT */
/* Drawing facets into the item buffer. It decides which pixels to ask and answers what doubles can
   prove; the rest it asks of visibility/sample.h. What the samples mean for areas is not its
   business. */
#include "visibility/raster.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/grid.h"
#include "visibility/sample.h"

double lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2])
{
    const double *p = raster->view->point[vertex].x;
    xy[0] = (p[0] - raster->view->low[0]) * raster->scale;
    xy[1] = (p[1] - raster->view->low[1]) * raster->scale;
    return lrcsi_view_point_err(p) * raster->scale + raster->off;
}

/* First pixel whose centre is not left of `x` less its error, kept within 0 .. size. */
static uint32_t pixel_from(const lrcsi_raster *raster, double x, double off)
{
    double least = lrcsi_min(lrcsi_max(x - 0.5 - off, 0), raster->size);
    uint32_t pixel = (uint32_t)least;
    return pixel < least ? pixel + 1 : pixel;
}

/* One past the last pixel whose centre is not right of `x` plus its error. */
static uint32_t pixel_to(const lrcsi_raster *raster, double x, double off)
{
    return (uint32_t)lrcsi_min(lrcsi_max(x + 0.5 + off, 0), raster->size);
}

/* The pixels that the facet may cover and touch, from the box of its corners and their position
 * error. */
static void edges_box(const lrcsi_raster *r, double p[3][2], lrcsi_edges *e)
{
    double x0 = lrcsi_min(p[0][0], lrcsi_min(p[1][0], p[2][0]));
    double x1 = lrcsi_max(p[0][0], lrcsi_max(p[1][0], p[2][0]));
    double y0 = lrcsi_min(p[0][1], lrcsi_min(p[1][1], p[2][1]));
    double y1 = lrcsi_max(p[0][1], lrcsi_max(p[1][1], p[2][1]));
    e->off = 8 * e->position_err * (x1 - x0 + y1 - y0 + 2);
    e->x0 = pixel_from(r, x0, e->position_err);
    e->x1 = pixel_to(r, x1, e->position_err);
    e->y0 = pixel_from(r, y0, e->position_err);
    e->y1 = pixel_to(r, y1, e->position_err);
    e->left = e->x0 > 0 ? e->x0 - 1 : 0;
    e->right = e->x1 < r->size ? e->x1 + 1 : r->size;
    e->bottom = e->y0 > 0 ? e->y0 - 1 : 0;
    e->top = e->y1 < r->size ? e->y1 + 1 : r->size;
}

/* Corners are off by `position_err`, and so is the sample; with |q - p| and |sample - p| at most
   the box's half perimeter h and the margin of a pixel, the cross product is off by at most 4
   position_err (h + 2). Roundings add 2 u N h for `at`, u N h for the differences and 5 u N h for
   the value, together at most position_err h. */
lrcsi_edges lrcsi_raster_edges(const lrcsi_raster *raster, uint32_t facet)
{
    lrcsi_edges e = {.position_err = 0};
    const uint32_t *corner = raster->view->prepared->scene->facet[facet].corner;
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        e.position_err = lrcsi_max(e.position_err, lrcsi_raster_point(raster, corner[k], p[k]));
    }
    edges_box(raster, p, &e);
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        e.along[k] = -raster->view->facing[facet] * (b[1] - a[1]);
        e.up[k] = raster->view->facing[facet] * (b[0] - a[0]);
        e.at[k] = -(e.along[k] * a[0] + e.up[k] * a[1]);
    }
    lrcsi_span_prepare(&e);
    return e;
}

/* N . R rows in doubles: each off by 8 u |N|. */
static void plane_normal(const lrcsi_view *view, uint32_t facet, double out[3])
{
    const double *n = view->prepared->normal[facet].high;
    for (int k = 0; k < 3; k++) {
        out[k] = view->R[k][0] * n[0] + view->R[k][1] * n[1] + view->R[k][2] * n[2];
    }
}

lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet)
{
    const lrcsi_view *view = raster->view;
    double n[3];
    plane_normal(view, facet, n);
    const double *a = view->point[view->prepared->scene->facet[facet].corner[0]].x;
    double along = n[2] != 0 ? -n[0] / n[2] : 0; /* edge-on: nothing is decided by it, see below */
    double up = n[2] != 0 ? -n[1] / n[2] : 0;
    lrcsi_plane plane;
    plane.at = a[2] - along * (a[0] - view->low[0]) - up * (a[1] - view->low[1]);
    plane.along = along * raster->pixel;
    plane.up = up * raster->pixel;
    return plane;
}

/* A height in doubles: a corner's, and slopes times differences from that, of coordinates below the
   reach of samples and of the corners together, each off by 16 u of that, and the sample beside
   them, all over |cos|; the denominator's own error moves a height that lies within as much
   again. */
double lrcsi_raster_slack(const lrcsi_raster *raster, uint32_t facet)
{
    const lrcsi_view *view = raster->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double n[3];
    double reach = raster->reach;
    plane_normal(view, facet, n);
    for (int k = 0; k < 3; k++) {
        const double *x = view->point[corner[k]].x;
        reach = lrcsi_max(reach, raster->reach + fabs(x[0]) + fabs(x[1]) + fabs(x[2]));
    }
    double cosine = fabs(n[2]) / view->prepared->normal[facet].length;
    double off = 256 * LRCSI_U * reach + 4 * raster->off * raster->pixel;
    return cosine > 64 * LRCSI_U ? off / cosine : HUGE_VAL;
}

/* --- facets ----------------------------------------------------------------------------------- */

/* A facet being drawn. */
typedef struct raster_job {
    lrcsi_raster *raster;
    uint32_t facet;
    lrcsi_edges edges;
    lrcsi_plane plane;
    double slack;
    uint32_t met;  /* the owner that doubles last left undecided, or LRCS_NONE, */
    int met_order; /* and its lrcsi_sample_order */
} raster_job;

static void sample_point(const lrcsi_raster *r, uint32_t x, uint32_t y, double point[3])
{
    lrcsi_view_lift(r->view, r->view->low[0] + (x + 0.5) * r->pixel,
                    r->view->low[1] + (y + 0.5) * r->pixel, point);
}

/* Does the facet cover the sample, where its edge functions cannot tell? */
static int job_covers(const raster_job *job, uint32_t x, uint32_t y)
{
    double point[3];
    sample_point(job->raster, x, y, point);
    return lrcsi_sample_covers(job->raster->view, job->facet, point);
}

/* Is the facet nearer than the owner of a sample that both cover? Where doubles cannot tell, most
   pairs have the same order at all samples, which is found once. */
static int job_nearer(raster_job *job, uint32_t owner, double ahead, uint32_t x, uint32_t y)
{
    lrcsi_raster *r = job->raster;
    double slack = job->slack + r->slack[owner];
    if (ahead > slack || ahead < -slack) {
        return ahead > 0;
    }
    if (owner != job->met) {
        job->met = owner;
        job->met_order = lrcsi_sample_order(r->view, job->facet, owner);
    }
    if (job->met_order != 0) {
        return job->met_order > 0;
    }
    double point[3];
    sample_point(r, x, y, point);
    int nearer = lrcsi_sample_nearer(r->view, job->facet, owner, point, 1);
    r->undecided[job->facet] |= nearer == 0;
    r->undecided[owner] |= nearer == 0;
    return nearer > 0;
}

/* Samples x0 <= x < x1 of a row, which the facet covers: it takes them, or leaves them to their
   owners. */
static void draw_run(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    lrcsi_raster *r = job->raster;
    double row = job->plane.at + job->plane.up * (y + 0.5);
    size_t at = (size_t)y * r->size + x0;
    uint32_t taken = 0;
    double centre = x0 + 0.5;
    for (uint32_t x = x0; x < x1; x++, at++, centre += 1) {
        double height = row + job->plane.along * centre;
        uint32_t owner = r->owner[at];
        if (owner != LRCS_NONE) {
            if (r->slack[owner] < 0 || !job_nearer(job, owner, height - r->depth[at], x, y)) {
                continue;
            }
            r->owned[owner]--;
        }
        taken++;
        r->owner[at] = job->facet;
        r->depth[at] = height;
    }
    r->covered[job->facet] += x1 - x0;
    r->owned[job->facet] += taken;
}

static void draw_doubtful(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    for (uint32_t x = x0; x < x1; x++) {
        if (job_covers(job, x, y)) {
            draw_run(job, y, x, x + 1);
        }
    }
}

/* The largest difference between the height of a facet's plane at the centre of a pixel and the
   facet itself in any part of the pixel, with the rounding of the lower height to a float: heights
   of covered samples lie between those of the corners, to within the slack. HUGE_VAL where floats
   might overflow. */
static double occluded_below(const raster_job *job)
{
    const lrcsi_view *view = job->raster->view;
    const uint32_t *corner = view->prepared->scene->facet[job->facet].corner;
    double most = job->slack;
    for (int k = 0; k < 3; k++) {
        most = lrcsi_max(most, fabs(view->point[corner[k]].x[2]));
    }
    double below = 0.5 * (fabs(job->plane.along) + fabs(job->plane.up)) + job->slack;
    below += 0x1p-22 * (most + below) + 0x1p-140;
    return most + below < 0x1p100 ? below : HUGE_VAL;
}

/* Raises the occluded heights of pixels that the facet covers entirely. */
static void occluded_raise(const raster_job *job, double below, uint32_t y, lrcsi_pixels whole)
{
    double row = job->plane.at + job->plane.up * (y + 0.5) - below;
    float *occluded = job->raster->occluded + (size_t)y * job->raster->size;
    for (uint32_t x = whole.x0; x < whole.x1; x++) {
        float low = (float)(row + job->plane.along * (x + 0.5));
        occluded[x] = low > occluded[x] ? low : occluded[x];
    }
}

void lrcsi_raster_draw(lrcsi_raster *raster, uint32_t facet)
{
    raster_job job = {.raster = raster, .facet = facet, .met = LRCS_NONE};
    raster->slack[facet] = job.slack = lrcsi_raster_slack(raster, facet);
    job.edges = lrcsi_raster_edges(raster, facet);
    job.plane = lrcsi_raster_plane(raster, facet);
    const double below = raster->occluded ? occluded_below(&job) : HUGE_VAL;
    for (uint32_t y = job.edges.y0; y < job.edges.y1; y++) {
        lrcsi_samples row = lrcsi_span_samples(&job.edges, y);
        draw_doubtful(&job, y, row.may.x0, row.sure.x0);
        draw_run(&job, y, row.sure.x0, row.sure.x1);
        draw_doubtful(&job, y, row.sure.x1, row.may.x1);
        if (below < HUGE_VAL && row.sure.x1 - row.sure.x0 > 1) {
            occluded_raise(&job, below, y, lrcsi_span_whole(&job.edges, y, row.sure));
        }
    }
}

/* --- tiles ------------------------------------------------------------------------------------ */

static size_t tile_at(const lrcsi_raster *r, uint32_t x, uint32_t y)
{
    return (size_t)(y / LRCSI_RASTER_TILE) * r->tiles + x / LRCSI_RASTER_TILE;
}

/* The first pixel of a row of the tiles given, from x on and before x1, whose tile is wanted (or is
   not, for `wanted` 0); x1 where there is none. */
static inline uint32_t tile_next(const unsigned char *tiles, uint32_t x, uint32_t x1, int wanted)
{
    if (x < x1 && tiles[x / LRCSI_RASTER_TILE] != wanted) {
        uint32_t tile = x / LRCSI_RASTER_TILE + 1;
        uint32_t end = (x1 - 1) / LRCSI_RASTER_TILE + 1;
        while (tile < end && tiles[tile] != wanted) {
            tile++;
        }
        x = tile * LRCSI_RASTER_TILE;
    }
    return x < x1 ? x : x1;
}

static const unsigned char *tile_row(const lrcsi_raster *r, uint32_t y)
{
    return r->wanted + tile_at(r, 0, y);
}

/* Pixels x0 <= x < x1 of a row of tiles, the lowest row of which is y. All bits of LRCS_NONE are
   set. */
static void clear_run(lrcsi_raster *r, uint32_t y, uint32_t x0, uint32_t x1)
{
    for (uint32_t row = y; row < y + LRCSI_RASTER_TILE && row < r->size; row++) {
        size_t at = (size_t)row * r->size + x0;
        memset(r->owner + at, 0xff, (x1 - x0) * sizeof *r->owner);
        memset(r->pure + at, 0, x1 - x0);
        float *occluded = r->occluded ? r->occluded + at : NULL;
        for (uint32_t x = 0; occluded && x < x1 - x0; x++) {
            occluded[x] = -HUGE_VALF;
        }
    }
}

void lrcsi_raster_clear(lrcsi_raster *raster)
{
    uint32_t size = raster->size;
    for (uint32_t y = 0; y < size; y += LRCSI_RASTER_TILE) {
        const unsigned char *tiles = tile_row(raster, y);
        uint32_t x = tile_next(tiles, 0, size, 1);
        while (x < size) {
            uint32_t end = tile_next(tiles, x, size, 0);
            clear_run(raster, y, x, end);
            x = tile_next(tiles, end, size, 1);
        }
    }
}

/* A row of tiles at a time: its tiles from the first to the last column that the facet may touch in
   these pixel rows and in the two rows on either side of them. */
void lrcsi_raster_want(lrcsi_raster *raster, uint32_t facet)
{
    const uint32_t tile = LRCSI_RASTER_TILE;
    const lrcsi_edges e = lrcsi_raster_edges(raster, facet);
    if (e.bottom >= e.top) {
        return;
    }
    for (uint32_t row = (e.bottom > 2 ? e.bottom - 2 : 0) / tile;
         row < raster->tiles && row * tile < e.top + 2; row++) {
        uint32_t first = row * tile > e.bottom + 2 ? row * tile - 2 : e.bottom;
        uint32_t end = (row + 1) * tile + 2 < e.top ? (row + 1) * tile + 2 : e.top;
        lrcsi_pixels span = lrcsi_span_touched_rows(&e, first, end - 1);
        if (span.x0 < span.x1) {
            uint32_t x0 = span.x0 > 2 ? span.x0 - 2 : 0;
            uint32_t x1 = span.x1 + 2 < raster->size ? span.x1 + 2 : raster->size;
            memset(raster->wanted + tile_at(raster, x0, row * tile), 1,
                   (x1 - 1) / tile - x0 / tile + 1);
        }
    }
}

static uint32_t tile_of(const lrcsi_raster *r, double pixel)
{
    double tile = pixel * (1.0 / LRCSI_RASTER_TILE);
    return (uint32_t)lrcsi_min(r->tiles - 1, lrcsi_max(tile, 0));
}

/* Is a tile wanted that the facet may touch? */
static int facet_wanted(const lrcsi_raster *r, uint32_t facet)
{
    double low[3];
    double high[3];
    lrcsi_view_bounds(r->view, r->view->prepared->scene->facet[facet].corner, 3, low, high);
    uint32_t tile[2][2];
    for (int k = 0; k < 2; k++) {
        tile[k][0] = tile_of(r, (low[k] - r->view->low[k]) * r->scale - r->off);
        tile[k][1] = tile_of(r, (high[k] - r->view->low[k]) * r->scale + r->off);
    }
    for (uint32_t y = tile[1][0]; y <= tile[1][1]; y++) {
        const unsigned char *row = r->wanted + (size_t)y * r->tiles;
        for (uint32_t x = tile[0][0]; x <= tile[0][1]; x++) { /* few: so no memchr */
            if (row[x]) {
                return 1;
            }
        }
    }
    return 0;
}

static void claim_run(const raster_job *job, const lrcsi_row *row, uint32_t y, uint32_t x0,
                      uint32_t x1)
{
    lrcsi_raster *r = job->raster;
    size_t start = (size_t)y * r->size;
    for (uint32_t x = x0; x < x1; x++) {
        if (lrcsi_span_has(row->sure, x) || job_covers(job, x, y)) {
            r->owner[start + x] = job->facet;
            r->pure[start + x] = (unsigned char)lrcsi_span_has(row->whole, x);
        }
    }
}

static void claim_row(const raster_job *job, uint32_t y)
{
    const unsigned char *tiles = tile_row(job->raster, y);
    if (tile_next(tiles, job->edges.x0, job->edges.x1, 1) == job->edges.x1) {
        return;
    }
    lrcsi_row row = lrcsi_span_row(&job->edges, y);
    uint32_t x = tile_next(tiles, row.may.x0, row.may.x1, 1);
    while (x < row.may.x1) {
        uint32_t end = tile_next(tiles, x, row.may.x1, 0);
        claim_run(job, &row, y, x, end);
        x = tile_next(tiles, end, row.may.x1, 1);
    }
}

void lrcsi_raster_claim(lrcsi_raster *raster, uint32_t facet)
{
    if (!facet_wanted(raster, facet)) {
        return;
    }
    raster_job job = {.raster = raster, .facet = facet};
    job.edges = lrcsi_raster_edges(raster, facet);
    raster->slack[facet] = -1;
    for (uint32_t y = job.edges.y0; y < job.edges.y1; y++) {
        claim_row(&job, y);
    }
}

/* --- all of it -------------------------------------------------------------------------------- */

/* Tiles along a side. */
static uint32_t raster_tiles(uint32_t size)
{
    return (size - 1) / LRCSI_RASTER_TILE + 1;
}

static size_t tile_count(uint32_t size)
{
    return lrcsi_work_square(raster_tiles(size));
}

size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t pixels = lrcsi_work_square(size);
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(pixels, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(pixels, sizeof(double)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(pixels, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(tile_count(size), 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(double)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
}

static int raster_arrays(lrcsi_raster *r, lrcs_work *work)
{
    size_t pixels = lrcsi_work_square(r->size);
    size_t facets = r->view->prepared->scene->facet_count;
    r->owner = lrcsi_work_take(work, pixels, sizeof *r->owner);
    r->depth = lrcsi_work_take(work, pixels, sizeof *r->depth);
    r->pure = lrcsi_work_take(work, pixels, 1);
    r->slack = lrcsi_work_take(work, facets, sizeof *r->slack);
    if (!r->owner || !r->depth || !r->pure || !r->slack) {
        return LRCS_E_MEMORY;
    }
    r->wanted = lrcsi_work_take_zero(work, tile_count(r->size), 1);
    r->covered = lrcsi_work_take_zero(work, facets, sizeof *r->covered);
    r->owned = lrcsi_work_take_zero(work, facets, sizeof *r->owned);
    r->undecided = lrcsi_work_take_zero(work, facets, sizeof *r->undecided);
    return r->wanted && r->covered && r->owned && r->undecided ? LRCS_OK : LRCS_E_MEMORY;
}

void lrcsi_raster_over(const lrcsi_view *view, uint32_t size, lrcsi_raster *raster)
{
    lrcsi_raster r = {.view = view, .size = size};
    r.pixel = view->side / size;
    r.scale = view->side > 0 ? size / view->side : 0;
    for (int k = 0; k < 2; k++) {
        r.reach += lrcsi_max(fabs(view->low[k]), fabs(view->low[k] + view->side));
    }
    r.off = lrcsi_view_lift_err(view, r.reach, 0) * r.scale + 8 * LRCSI_U * size;
    *raster = r;
}

int lrcsi_raster_start(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster)
{
    size_t mark = work->used;
    lrcsi_raster r;
    lrcsi_raster_over(view, size, &r);
    r.tiles = raster_tiles(size);
    int status = raster_arrays(&r, work);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *raster = r;
    return LRCS_OK;
}

int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster)
{
    int status = lrcsi_raster_start(view, size, work, raster);
    if (status != LRCS_OK) {
        return status;
    }
    memset(raster->wanted, 1, tile_count(size));
    lrcsi_raster_clear(raster);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        lrcsi_view_progress(view, LRCS_PROGRESS_VISIBILITY, f, view->prepared->scene->facet_count);
        if (lrcsi_view_casts(view, f)) {
            lrcsi_raster_draw(raster, f);
        }
    }
    return LRCS_OK;
}
