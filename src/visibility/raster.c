/* SPDX-License-Identifier: MIT */
/* Draws facets into the z-buffer. Edge functions and heights in doubles decide coverage and depth
   order where their error bounds suffice; visibility/sample.h decides the rest. What the samples
   mean for visible areas is decided elsewhere (visibility/visible.h).

   The driver is lrcsi_raster_make, for all of a view:
   1. lrcsi_raster_start: the geometry of the raster, and its arrays.
   2. All tiles become active; lrcsi_raster_clear.
   3. lrcsi_raster_draw, facet by facet and row by row: draw_span where the samples are certainly
      covered, draw_uncertain where an exact test has to decide. */
#include "visibility/raster.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/grid.h"
#include "visibility/sample.h"

/* --- geometry of a raster and of facets in it ------------------------------------------------- */

void lrcsi_raster_layout(const lrcsi_view *view, uint32_t size, lrcsi_raster *raster)
{
    lrcsi_raster r = {.view = view, .size = size};
    r.pixel = view->side / size;
    r.scale = view->side > 0 ? size / view->side : 0;
    for (int k = 0; k < 2; k++) {
        r.radius += lrcsi_max(fabs(view->low[k]), fabs(view->low[k] + view->side));
    }
    r.sample_err = lrcsi_view_lift_err(view, r.radius, 0) * r.scale + 8 * LRCSI_U * size;
    *raster = r;
}

void lrcsi_raster_sample(const lrcsi_raster *raster, uint32_t x, uint32_t y, double point[3])
{
    const lrcsi_view *view = raster->view;
    lrcsi_view_lift(view, view->low[0] + (x + 0.5) * raster->pixel,
                    view->low[1] + (y + 0.5) * raster->pixel, point);
}

double lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2])
{
    const double *p = raster->view->point[vertex].x;
    xy[0] = (p[0] - raster->view->low[0]) * raster->scale;
    xy[1] = (p[1] - raster->view->low[1]) * raster->scale;
    return lrcsi_view_point_err(p) * raster->scale + raster->sample_err;
}

/* The pixels along one axis whose centres lie within low .. high, coordinates with errors up to
   `err`: pixels *from <= pixel < *to. */
static void centres_between(const lrcsi_raster *r, double low, double high, double err,
                            uint32_t *from, uint32_t *to)
{
    double first = lrcsi_min(lrcsi_max(low - 0.5 - err, 0), r->size);
    *from = (uint32_t)first;
    *from += *from < first;
    *to = (uint32_t)lrcsi_min(lrcsi_max(high + 0.5 + err, 0), r->size);
}

/* Error of a value in a touched pixel. Corners have errors of position_err, and so has the sample.
   |q - p| and |sample - p| are at most the half perimeter h of the box and the width of a pixel, so
   the error of the cross product is at most 4 position_err (h + 2). Roundings add 2 u N h for `c`,
   u N h for the differences and 5 u N h for the value: together at most position_err h. The sum is
   at most 5 position_err (h + 2); value_err is 8/5 of that. */
lrcsi_edge_functions lrcsi_raster_edge_functions(const lrcsi_raster *raster, uint32_t facet)
{
    const uint32_t *corner = raster->view->prepared->scene->facet[facet].corner;
    const int facing = raster->view->facing[facet];
    lrcsi_edge_functions e = {.position_err = 0};
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        e.position_err = lrcsi_max(e.position_err, lrcsi_raster_point(raster, corner[k], p[k]));
    }
    double x0 = lrcsi_min(p[0][0], lrcsi_min(p[1][0], p[2][0]));
    double x1 = lrcsi_max(p[0][0], lrcsi_max(p[1][0], p[2][0]));
    double y0 = lrcsi_min(p[0][1], lrcsi_min(p[1][1], p[2][1]));
    double y1 = lrcsi_max(p[0][1], lrcsi_max(p[1][1], p[2][1]));
    e.value_err = 8 * e.position_err * (x1 - x0 + y1 - y0 + 2);
    centres_between(raster, x0, x1, e.position_err, &e.x0, &e.x1);
    centres_between(raster, y0, y1, e.position_err, &e.y0, &e.y1);
    e.left = e.x0 > 0 ? e.x0 - 1 : 0;
    e.right = e.x1 < raster->size ? e.x1 + 1 : raster->size;
    e.bottom = e.y0 > 0 ? e.y0 - 1 : 0;
    e.top = e.y1 < raster->size ? e.y1 + 1 : raster->size;
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        e.dx[k] = -facing * (b[1] - a[1]);
        e.dy[k] = facing * (b[0] - a[0]);
        e.c[k] = -(e.dx[k] * a[0] + e.dy[k] * a[1]);
    }
    lrcsi_span_prepare(&e);
    return e;
}

/* A facet's normal N in view coordinates, in doubles. Error of each: 8 u |N|. */
static void normal_in_view(const lrcsi_view *view, uint32_t facet, double normal[3])
{
    const double *n = view->prepared->normal[facet].high;
    for (int k = 0; k < 3; k++) {
        normal[k] = view->R[k][0] * n[0] + view->R[k][1] * n[1] + view->R[k][2] * n[2];
    }
}

/* For a facet that is edge-on the plane is arbitrary: the error bound of its heights is infinite,
   so that they decide nothing. */
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet)
{
    const lrcsi_view *view = raster->view;
    double n[3];
    normal_in_view(view, facet, n);
    const double *a = view->point[view->prepared->scene->facet[facet].corner[0]].x;
    double dx = n[2] != 0 ? -n[0] / n[2] : 0;
    double dy = n[2] != 0 ? -n[1] / n[2] : 0;
    lrcsi_plane plane;
    plane.c = a[2] - dx * (a[0] - view->low[0]) - dy * (a[1] - view->low[1]);
    plane.dx = dx * raster->pixel;
    plane.dy = dy * raster->pixel;
    return plane;
}

/* A height is that of a corner plus slopes times differences of coordinates from the corner. These
   differences are at most `radius`, which includes samples and corners. Each has an error of 16 u
   radius, to which the error of the sample is added. Division by |cos| gives the error of the
   height. The error of the denominator changes a height within `radius` by as much again. */
double lrcsi_raster_height_err(const lrcsi_raster *raster, uint32_t facet)
{
    const lrcsi_view *view = raster->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double n[3];
    double radius = raster->radius;
    normal_in_view(view, facet, n);
    for (int k = 0; k < 3; k++) {
        const double *x = view->point[corner[k]].x;
        radius = lrcsi_max(radius, raster->radius + fabs(x[0]) + fabs(x[1]) + fabs(x[2]));
    }
    double cosine = fabs(n[2]) / view->prepared->normal[facet].length;
    double err = 256 * LRCSI_U * radius + 4 * raster->sample_err * raster->pixel;
    return cosine > 64 * LRCSI_U ? err / cosine : HUGE_VAL;
}

/* --- drawing ---------------------------------------------------------------------------------- */

/* A facet being drawn. */
typedef struct raster_job {
    lrcsi_raster *raster;
    uint32_t facet;
    lrcsi_edge_functions edges;
    lrcsi_plane plane;
    double height_err;
    /* The last owner for which heights in doubles did not decide: */
    uint32_t last_owner; /* its facet, or LRCS_NONE */
    int last_order;      /* its lrcsi_sample_order */
} raster_job;

/* Does the facet cover the sample? Decided exactly. */
static int job_covers(const raster_job *job, uint32_t x, uint32_t y)
{
    double point[3];
    lrcsi_raster_sample(job->raster, x, y, point);
    return lrcsi_sample_covers(job->raster->view, job->facet, point);
}

/* Is the facet nearer than the owner of a sample that both cover? ahead: the difference of their
   heights. If doubles do not decide: most pairs have the same order at all samples, which is
   computed only once. */
static int job_nearer(raster_job *job, uint32_t owner, double ahead, uint32_t x, uint32_t y)
{
    lrcsi_raster *r = job->raster;
    double height_err = job->height_err + r->height_err[owner];
    if (ahead > height_err || ahead < -height_err) {
        return ahead > 0;
    }
    if (owner != job->last_owner) {
        job->last_owner = owner;
        job->last_order = lrcsi_sample_order(r->view, job->facet, owner);
    }
    if (job->last_order != 0) {
        return job->last_order > 0;
    }
    double point[3];
    lrcsi_raster_sample(r, x, y, point);
    int nearer = lrcsi_sample_nearer(r->view, job->facet, owner, point, 1);
    r->undecided[job->facet] |= nearer == 0;
    r->undecided[owner] |= nearer == 0;
    return nearer > 0;
}

/* The depth test for samples x0 <= x < x1 of a row, all of which the facet covers. */
static void draw_span(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    lrcsi_raster *r = job->raster;
    double row = job->plane.c + job->plane.dy * (y + 0.5);
    size_t i = (size_t)y * r->size + x0;
    uint32_t won = 0;
    double centre = x0 + 0.5;
    for (uint32_t x = x0; x < x1; x++, i++, centre += 1) {
        double height = row + job->plane.dx * centre;
        uint32_t owner = r->owner[i];
        if (owner != LRCS_NONE) {
            if (r->height_err[owner] < 0 || !job_nearer(job, owner, height - r->depth[i], x, y)) {
                continue;
            }
            r->owned[owner]--;
        }
        won++;
        r->owner[i] = job->facet;
        r->depth[i] = height;
    }
    r->covered[job->facet] += x1 - x0;
    r->owned[job->facet] += won;
}

/* The same for samples that the facet may or may not cover. */
static inline void draw_uncertain(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    for (uint32_t x = x0; x < x1; x++) {
        if (job_covers(job, x, y)) {
            draw_span(job, y, x, x + 1);
        }
    }
}

/* For a pixel that the facet covers entirely, an upper bound of the height of its plane at the
   pixel's centre above the lowest point of the facet in that pixel; rounding to a float is
   included. The heights of covered samples lie between those of the corners, within the height
   error. HUGE_VAL if floats might overflow. */
static double occluder_drop(const raster_job *job)
{
    const lrcsi_view *view = job->raster->view;
    const uint32_t *corner = view->prepared->scene->facet[job->facet].corner;
    double magnitude = job->height_err;
    for (int k = 0; k < 3; k++) {
        magnitude = lrcsi_max(magnitude, fabs(view->point[corner[k]].x[2]));
    }
    double drop = 0.5 * (fabs(job->plane.dx) + fabs(job->plane.dy)) + job->height_err;
    drop += 0x1p-22 * (magnitude + drop) + 0x1p-140;
    return magnitude + drop < 0x1p100 ? drop : HUGE_VAL;
}

/* Raises the occluder heights of pixels of a row that the facet covers entirely. */
static void occluder_raise(const raster_job *job, double drop, uint32_t y, lrcsi_pixel_span full)
{
    double row = job->plane.c + job->plane.dy * (y + 0.5) - drop;
    float *occluder = job->raster->occluder + (size_t)y * job->raster->size;
    for (uint32_t x = full.x0; x < full.x1; x++) {
        float low = (float)(row + job->plane.dx * (x + 0.5));
        occluder[x] = low > occluder[x] ? low : occluder[x];
    }
}

void lrcsi_raster_draw(lrcsi_raster *raster, uint32_t facet)
{
    raster_job job = {.raster = raster, .facet = facet, .last_owner = LRCS_NONE};
    raster->height_err[facet] = job.height_err = lrcsi_raster_height_err(raster, facet);
    job.edges = lrcsi_raster_edge_functions(raster, facet);
    job.plane = lrcsi_raster_plane(raster, facet);
    const double drop = raster->occluder ? occluder_drop(&job) : HUGE_VAL;
    for (uint32_t y = job.edges.y0; y < job.edges.y1; y++) {
        lrcsi_sample_spans row = lrcsi_span_samples(&job.edges, y);
        draw_uncertain(&job, y, row.possible.x0, row.certain.x0);
        draw_span(&job, y, row.certain.x0, row.certain.x1);
        draw_uncertain(&job, y, row.certain.x1, row.possible.x1);
        if (drop < HUGE_VAL && row.certain.x1 - row.certain.x0 > 1) {
            occluder_raise(&job, drop, y, lrcsi_span_full(&job.edges, y, row.certain));
        }
    }
}

/* --- tiles ------------------------------------------------------------------------------------ */

/* The row of tiles that contains pixels of row y. */
static unsigned char *tile_row(const lrcsi_raster *r, uint32_t y)
{
    return r->active + (size_t)(y / LRCSI_RASTER_TILE) * r->tiles;
}

/* The first pixel x <= pixel < x1 of a row of tiles whose tile is active (or is not, for `active`
   0); x1 if there is none. */
static inline uint32_t tile_next(const unsigned char *tiles, uint32_t x, uint32_t x1, int active)
{
    if (x < x1 && tiles[x / LRCSI_RASTER_TILE] != active) {
        uint32_t tile = x / LRCSI_RASTER_TILE + 1;
        uint32_t end = (x1 - 1) / LRCSI_RASTER_TILE + 1;
        while (tile < end && tiles[tile] != active) {
            tile++;
        }
        x = tile * LRCSI_RASTER_TILE;
    }
    return x < x1 ? x : x1;
}

/* For each row of tiles: the tiles from the first to the last column that the facet may touch in
   the row's pixels and in two rows of pixels on either side. */
void lrcsi_raster_activate(lrcsi_raster *raster, uint32_t facet)
{
    const uint32_t tile = LRCSI_RASTER_TILE;
    const lrcsi_edge_functions e = lrcsi_raster_edge_functions(raster, facet);
    if (e.bottom >= e.top) {
        return;
    }
    for (uint32_t row = (e.bottom > 2 ? e.bottom - 2 : 0) / tile;
         row < raster->tiles && row * tile < e.top + 2; row++) {
        uint32_t first = row * tile > e.bottom + 2 ? row * tile - 2 : e.bottom;
        uint32_t end = (row + 1) * tile + 2 < e.top ? (row + 1) * tile + 2 : e.top;
        lrcsi_pixel_span span = lrcsi_span_touched_rows(&e, first, end - 1);
        if (span.x0 < span.x1) {
            uint32_t x0 = span.x0 > 2 ? span.x0 - 2 : 0;
            uint32_t x1 = span.x1 + 2 < raster->size ? span.x1 + 2 : raster->size;
            memset(tile_row(raster, row * tile) + x0 / tile, 1, (x1 - 1) / tile - x0 / tile + 1);
        }
    }
}

void lrcsi_raster_clear(lrcsi_raster *raster)
{
    const uint32_t size = raster->size;
    for (uint32_t y = 0; y < size; y++) {
        const unsigned char *tiles = tile_row(raster, y);
        uint32_t end = 0;
        for (uint32_t x0; (x0 = tile_next(tiles, end, size, 1)) < size;) {
            end = tile_next(tiles, x0, size, 0);
            size_t first = (size_t)y * size + x0;
            memset(raster->owner + first, 0xff, (end - x0) * sizeof *raster->owner); /* LRCS_NONE */
            memset(raster->full + first, 0, end - x0);
            for (uint32_t x = 0; raster->occluder && x < end - x0; x++) {
                raster->occluder[first + x] = -HUGE_VALF;
            }
        }
    }
}

/* Does the box of a facet meet an active tile? */
static int box_meets_active(const lrcsi_raster *r, uint32_t facet)
{
    double bounds[2][3]; /* low, high */
    uint32_t tile[2][2];
    lrcsi_view_bounds(r->view, r->view->prepared->scene->facet[facet].corner, 3, bounds[0],
                      bounds[1]);
    for (int end = 0; end < 2; end++) {
        for (int k = 0; k < 2; k++) {
            double pixel = (bounds[end][k] - r->view->low[k]) * r->scale +
                           (end == 0 ? -r->sample_err : r->sample_err);
            tile[end][k] =
                (uint32_t)lrcsi_min(r->tiles - 1, lrcsi_max(pixel * (1.0 / LRCSI_RASTER_TILE), 0));
        }
    }
    for (uint32_t y = tile[0][1]; y <= tile[1][1]; y++) {
        const unsigned char *row = r->active + (size_t)y * r->tiles;
        for (uint32_t x = tile[0][0]; x <= tile[1][0]; x++) { /* few: memchr would cost more */
            if (row[x]) {
                return 1;
            }
        }
    }
    return 0;
}

void lrcsi_raster_fill(lrcsi_raster *raster, uint32_t facet)
{
    if (!box_meets_active(raster, facet)) {
        return;
    }
    raster_job job = {.raster = raster, .facet = facet};
    job.edges = lrcsi_raster_edge_functions(raster, facet);
    raster->height_err[facet] = -1;
    for (uint32_t y = job.edges.y0; y < job.edges.y1; y++) {
        const unsigned char *tiles = tile_row(raster, y);
        if (tile_next(tiles, job.edges.x0, job.edges.x1, 1) == job.edges.x1) {
            continue;
        }
        const lrcsi_row_spans row = lrcsi_span_row(&job.edges, y);
        const size_t first = (size_t)y * raster->size;
        uint32_t x = tile_next(tiles, row.possible.x0, row.possible.x1, 1);
        while (x < row.possible.x1) {
            for (uint32_t end = tile_next(tiles, x, row.possible.x1, 0); x < end; x++) {
                if (lrcsi_span_has(row.certain, x) || job_covers(&job, x, y)) {
                    raster->owner[first + x] = facet;
                    raster->full[first + x] = (unsigned char)lrcsi_span_has(row.full, x);
                }
            }
            x = tile_next(tiles, x, row.possible.x1, 1);
        }
    }
}

/* --- the whole raster ------------------------------------------------------------------------- */

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

int lrcsi_raster_start(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster)
{
    const size_t mark = work->used;
    const size_t pixels = lrcsi_work_square(size);
    const size_t facets = view->prepared->scene->facet_count;
    lrcsi_raster r;
    lrcsi_raster_layout(view, size, &r);
    r.tiles = raster_tiles(size);
    r.owner = lrcsi_work_take(work, pixels, sizeof *r.owner);
    r.depth = lrcsi_work_take(work, pixels, sizeof *r.depth);
    r.full = lrcsi_work_take(work, pixels, 1);
    r.height_err = lrcsi_work_take(work, facets, sizeof *r.height_err);
    if (r.owner && r.depth && r.full && r.height_err) {
        r.active = lrcsi_work_take_zero(work, tile_count(size), 1);
        r.covered = lrcsi_work_take_zero(work, facets, sizeof *r.covered);
        r.owned = lrcsi_work_take_zero(work, facets, sizeof *r.owned);
        r.undecided = lrcsi_work_take_zero(work, facets, sizeof *r.undecided);
    }
    if (!r.active || !r.covered || !r.owned || !r.undecided) {
        work->used = mark;
        return LRCS_E_MEMORY;
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
    memset(raster->active, 1, tile_count(size));
    lrcsi_raster_clear(raster);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        lrcsi_view_progress(view, LRCS_PROGRESS_VISIBILITY, f, view->prepared->scene->facet_count);
        if (lrcsi_view_casts(view, f)) {
            lrcsi_raster_draw(raster, f);
        }
    }
    return LRCS_OK;
}
