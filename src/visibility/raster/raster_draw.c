/* SPDX-License-Identifier: MIT */
/* Draws facets into the z-buffer. Edge functions and heights in floats or doubles decide coverage
   and depth order where their error bounds suffice; visibility/base/sample.h decides the rest. What
   the samples mean for visible areas is decided elsewhere (visibility/raster/visible.h, preview.h).

   The driver is lrcsi_raster_make:
   1. lrcsi_raster_layout: the geometry of the raster; its arrays.
   2. Tiles become active: all of them, or those around undecided facets (activate_tiles).
      clear_tiles.
   3. fill_facet: facets that are known to be visible own what they cover.
   4. draw_facet: all others, with a depth test. A facet is ordinary if the error of its heights, as
      floats, is below a millionth of the window's side; nearly all are. Ordinary facets are drawn
      first, several samples at once, and compared with the stored depths. The others (nearly
      edge-on, or extending far from the window) are drawn afterwards, sample by sample, with
      heights in doubles.
   5. count_owned: the samples that each facet owns. */
#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/base/sample.h"
#include "visibility/index/grid.h"
#include "visibility/index/marks.h"
#include "visibility/raster/raster.h"
#include "visibility/uniform/query.h"

/* The number of samples drawn at once. Samples beyond the end of a span are stored unchanged. */
enum { LANES = 8 };

/* The largest error of an ordinary facet's heights, relative to the window's side. Heuristic: what
   is not ordinary is drawn more slowly, with the same owners. */
#define ORDINARY_ERR 0x1p-20

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

/* Activates the tiles of all pixels that the facet may touch, and of two pixels around them. For
   each row of tiles: the tiles from the first to the last column that the facet may touch in
   the row's pixels and in two rows of pixels on either side. */
static void activate_tiles(lrcsi_raster *raster, uint32_t facet)
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

/* The next span of pixels x0 <= x < x1 of a row, at or after *x and before `end`, whose tiles are
   active; none if empty. Advances *x to its end. */
static inline lrcsi_pixel_span tile_span(const unsigned char *tiles, uint32_t *x, uint32_t end)
{
    lrcsi_pixel_span span;
    span.x0 = tile_next(tiles, *x, end, 1);
    span.x1 = *x = tile_next(tiles, span.x0, end, 0);
    return span;
}

/* Samples of active tiles have no owner, and nothing is hidden in their pixels. */
static void clear_tiles(lrcsi_raster *r)
{
    for (uint32_t y = 0; y < r->size; y++) {
        const unsigned char *tiles = tile_row(r, y);
        const size_t row = (size_t)y * r->size;
        uint32_t x = 0;
        for (lrcsi_pixel_span span; span = tile_span(tiles, &x, r->size), span.x0 < span.x1;) {
            memset(r->owner + row + span.x0, 0xff, /* LRCS_NONE */
                   (span.x1 - span.x0) * sizeof *r->owner);
            for (size_t i = row + span.x0; i < row + span.x1; i++) {
                r->depth[i] = -HUGE_VALF;
            }
            for (size_t i = row + span.x0; r->occluder && i < row + span.x1; i++) {
                r->occluder[i] = -HUGE_VALF;
            }
        }
    }
}

/* May a facet with these bounds cover a sample of an active tile? */
static int bounds_drawn(const lrcsi_raster *r, const double low[3], const double high[3])
{
    uint32_t from[2];
    uint32_t to[2];
    for (int k = 0; k < 2; k++) {
        lrcsi_raster_centres(r, (low[k] - r->view->low[k]) * r->pixels_per_unit,
                             (high[k] - r->view->low[k]) * r->pixels_per_unit, r->sample_err,
                             &from[k], &to[k]);
        if (from[k] >= to[k]) {
            return 0; /* as for most small facets */
        }
    }
    for (uint32_t y = from[1] / LRCSI_RASTER_TILE; y <= (to[1] - 1) / LRCSI_RASTER_TILE; y++) {
        const unsigned char *tiles = r->active + (size_t)y * r->tiles;
        for (uint32_t x = from[0] / LRCSI_RASTER_TILE; x <= (to[0] - 1) / LRCSI_RASTER_TILE; x++) {
            if (tiles[x]) { /* few: memchr would cost more */
                return 1;
            }
        }
    }
    return 0;
}

/* --- drawing ---------------------------------------------------------------------------------- */

/* Not a value of lrcsi_sample_order: it has not been computed yet. */
#define ORDER_UNKNOWN 2

/* A facet being drawn. */
typedef struct raster_facet {
    uint32_t facet;
    lrcsi_plane plane;
    int ordinary;
    float tolerance; /* ordinary: floats do not decide between depths that differ by no more */
    /* The last owner for which floats did not decide: */
    uint32_t last_owner;    /* its facet, or LRCS_NONE */
    lrcsi_plane last_plane; /* its plane */
    int last_order;         /* its lrcsi_sample_order; ORDER_UNKNOWN */
} raster_facet;

/* Does the facet cover the sample? Decided exactly. */
static int sample_covered(const lrcsi_raster *r, uint32_t facet, uint32_t x, uint32_t y)
{
    double point[3];
    lrcsi_raster_sample(r, x, y, point);
    return lrcsi_sample_covers(r->view, facet, point);
}

/* 1 if the facet is nearer than the owner of a sample that both cover: from heights in doubles,
   else exactly. Most pairs have the same order at all samples; it is computed only once. */
static int facet_nearer(lrcsi_raster *r, raster_facet *f, uint32_t owner, uint32_t x, uint32_t y)
{
    if (owner != f->last_owner) {
        f->last_owner = owner;
        f->last_plane = lrcsi_raster_plane(r, owner);
        f->last_order = ORDER_UNKNOWN;
    }
    double ahead = lrcsi_plane_height(&f->plane, x, y) - lrcsi_plane_height(&f->last_plane, x, y);
    if (fabs(ahead) > f->plane.err + f->last_plane.err) {
        return ahead > 0;
    }
    if (f->last_order == ORDER_UNKNOWN) {
        f->last_order = lrcsi_sample_order(r->view, f->facet, owner);
    }
    if (f->last_order != 0) {
        return f->last_order > 0;
    }
    double point[3];
    lrcsi_raster_sample(r, x, y, point);
    int nearer = lrcsi_sample_nearer(r->view, f->facet, owner, point, 1);
    r->order_undecided[f->facet] |= nearer == 0;
    r->order_undecided[owner] |= nearer == 0;
    return nearer > 0;
}

/* The depth test for the first `count` of LANES samples: the facet becomes the owner of those at
   which it is certainly nearer. Its height at sample k is first + slope k. Returns 0 if the order
   is certain at all of them. Masks are used instead of branches, so that compilers vectorize the
   loop. */
static inline uint32_t draw_lanes(uint32_t *restrict owner, float *restrict depth, float first,
                                  float slope, float tolerance, uint32_t facet, int32_t count)
{
    uint32_t uncertainty[LANES];
    for (int32_t k = 0; k < LANES; k++) {
        float height = first + slope * (float)k;
        float ahead = height - depth[k];
        uint32_t within = 0u - (uint32_t)(k < count);
        uint32_t nearer = (0u - (uint32_t)(ahead > tolerance)) & within;
        uint32_t possible = (0u - (uint32_t)(ahead >= -tolerance)) & within;
        uint32_t new_bits;
        uint32_t bits;
        memcpy(&new_bits, &height, sizeof bits);
        memcpy(&bits, &depth[k], sizeof bits);
        bits = (new_bits & nearer) | (bits & ~nearer);
        memcpy(&depth[k], &bits, sizeof bits);
        owner[k] = (facet & nearer) | (owner[k] & ~nearer);
        uncertainty[k] = possible & ~nearer;
    }
    uint32_t any = 0;
    for (int32_t k = 0; k < LANES; k++) {
        any |= uncertainty[k];
    }
    return any;
}

/* Draws samples x0 <= x < x1 of a row, all of which the facet covers: it becomes the owner of those
   at which it is nearer than the owner so far. First all of them in floats, several at once, if it
   is ordinary; then, one by one, those that floats do not decide. Error of the float heights of
   an ordinary facet: with z the largest magnitude of a corner's depth, the heights of covered
   samples are at most z, and they change by at most 2 z along the span. Rounding the first height,
   the slope, two products and two sums adds less than 2^-21 z. */
static void draw_row_span(lrcsi_raster *r, raster_facet *f, uint32_t y, uint32_t x0, uint32_t x1)
{
    size_t start = (size_t)y * r->size + x0;
    float first = (float)lrcsi_plane_height(&f->plane, x0, y);
    float slope = (float)f->plane.dx;
    uint32_t uncertainty = !f->ordinary;
    for (uint32_t i = 0; i < x1 - x0 && f->ordinary; i += LANES) {
        uncertainty |= draw_lanes(r->owner + start + i, r->depth + start + i,
                                  first + slope * (float)(int32_t)i, slope, f->tolerance, f->facet,
                                  (int32_t)(x1 - x0 - i));
    }
    for (uint32_t x = x0; x < x1 && uncertainty != 0; x++) { /* the undecided ones */
        size_t i = (size_t)y * r->size + x;
        float ahead = first + slope * (float)(int32_t)(x - x0) - r->depth[i];
        if (r->owner[i] == f->facet || (f->ordinary && ahead < -f->tolerance)) {
            continue;
        }
        if (r->owner[i] == LRCS_NONE ||
            (r->depth[i] < HUGE_VALF && facet_nearer(r, f, r->owner[i], x, y))) {
            r->owner[i] = f->facet;
            r->depth[i] = f->ordinary ? (float)lrcsi_plane_height(&f->plane, x, y) : 0;
        }
    }
    r->covered[f->facet] += x1 - x0;
}

/* Draws samples x0 <= x < x1 of a row for which edge functions do not decide whether the facet
   covers them. */
static inline void draw_if_covered(lrcsi_raster *r, raster_facet *f, uint32_t y, uint32_t x0,
                                   uint32_t x1)
{
    for (uint32_t x = x0; x < x1; x++) {
        if (sample_covered(r, f->facet, x, y)) {
            draw_row_span(r, f, y, x, x + 1);
        }
    }
}

/* Raises the first `count` of LANES occluder heights to first + slope k. */
static inline void raise_lanes(float *restrict occluder, float first, float slope, int32_t count)
{
    for (int32_t k = 0; k < LANES; k++) {
        float height = first + slope * (float)k;
        uint32_t higher = 0u - (uint32_t)((k < count) & (height > occluder[k]));
        uint32_t new_bits;
        uint32_t bits;
        memcpy(&new_bits, &height, sizeof bits);
        memcpy(&bits, &occluder[k], sizeof bits);
        bits = (new_bits & higher) | (bits & ~higher);
        memcpy(&occluder[k], &bits, sizeof bits);
    }
}

/* Raises the occluder heights of the pixels of a row that an ordinary facet covers entirely, to
   `drop` below its heights at their centres. */
static void raise_row_span(lrcsi_raster *r, const raster_facet *f, double drop, uint32_t y,
                           lrcsi_pixel_span full)
{
    float *occluder = r->occluder + (size_t)y * r->size + full.x0;
    float first = (float)(lrcsi_plane_height(&f->plane, full.x0, y) - drop);
    float slope = (float)f->plane.dx;
    for (uint32_t i = 0; i < full.x1 - full.x0; i += LANES) {
        raise_lanes(occluder + i, first + slope * (float)(int32_t)i, slope,
                    (int32_t)(full.x1 - full.x0 - i));
    }
}

/* Draws a facet if it is ordinary (`ordinary` 1), or if it is not (0). Returns 1 if it is ordinary;
   facets that certainly cover no sample count as ordinary. The last term of `err` covers subnormal
   floats.

   drop: in a pixel that the facet covers entirely, its heights differ from that at the centre by at
   most half the sum of its slopes. The height error is added, and, for floats, as much as above
   with z + drop in the place of z. */
static int draw_facet(lrcsi_raster *r, uint32_t facet, int ordinary)
{
    double low[3];
    double high[3];
    lrcsi_view_bounds(r->view, r->view->prepared->scene->facet[facet].corner, 3, low, high);
    if (!bounds_drawn(r, low, high)) {
        return 1;
    }
    raster_facet f = {.facet = facet, .last_owner = LRCS_NONE};
    f.plane = lrcsi_raster_plane(r, facet);
    double magnitude = lrcsi_max(fabs(low[2]), fabs(high[2])) + f.plane.err;
    double err = f.plane.err + 0x1p-21 * magnitude + 0x1p-140;
    double ordinary_err = ORDINARY_ERR * r->view->side;
    f.ordinary = err <= ordinary_err;
    if (f.ordinary != ordinary) {
        return f.ordinary;
    }
    f.tolerance = f.ordinary ? (float)(1.01 * (err + ordinary_err)) : 0;
    double drop = 0.5 * (fabs(f.plane.dx) + fabs(f.plane.dy)) + f.plane.err;
    drop += 0x1p-20 * (magnitude + drop) + 0x1p-140;
    lrcsi_edge_functions e = lrcsi_raster_edge_functions(r, facet);
    for (uint32_t y = e.y0; y < e.y1; y++) {
        lrcsi_sample_spans row = lrcsi_span_samples(&e, y);
        draw_if_covered(r, &f, y, row.possible.x0, row.certain.x0);
        if (row.certain.x0 < row.certain.x1) {
            draw_row_span(r, &f, y, row.certain.x0, row.certain.x1);
        }
        draw_if_covered(r, &f, y, row.certain.x1, row.possible.x1);
        if (r->occluder && f.ordinary && row.certain.x1 - row.certain.x0 > 1) {
            raise_row_span(r, &f, drop, y, lrcsi_span_full(&e, y, row.certain));
        }
    }
    return f.ordinary;
}

/* Makes a facet that is known to be entirely visible the owner of all active samples that it
   covers. In the pixels that it covers entirely, everything else is hidden. */
static void fill_facet(lrcsi_raster *r, uint32_t facet)
{
    double low[3];
    double high[3];
    lrcsi_view_bounds(r->view, r->view->prepared->scene->facet[facet].corner, 3, low, high);
    if (!bounds_drawn(r, low, high)) {
        return;
    }
    lrcsi_edge_functions e = lrcsi_raster_edge_functions(r, facet);
    for (uint32_t y = e.y0; y < e.y1; y++) {
        const unsigned char *tiles = tile_row(r, y);
        if (tile_next(tiles, e.x0, e.x1, 1) == e.x1) {
            continue;
        }
        const lrcsi_sample_spans row = lrcsi_span_samples(&e, y);
        const lrcsi_pixel_span full = lrcsi_span_full(&e, y, row.certain);
        const size_t first = (size_t)y * r->size;
        uint32_t x = row.possible.x0;
        for (lrcsi_pixel_span span;
             span = tile_span(tiles, &x, row.possible.x1), span.x0 < span.x1;) {
            for (uint32_t i = span.x0; i < span.x1; i++) {
                if (lrcsi_span_has(row.certain, i) || sample_covered(r, facet, i, y)) {
                    r->owner[first + i] = facet;
                    r->depth[first + i] = HUGE_VALF;
                    if (lrcsi_span_has(full, i)) {
                        r->occluder[first + i] = HUGE_VALF;
                    }
                }
            }
        }
    }
}

/* The same for all such facets of a meshlet; most meshlets reach no active tile. */
static void fill_meshlet(lrcsi_raster *r, uint32_t meshlet, const unsigned char *answer)
{
    const lrcs_prepared *p = r->view->prepared;
    const uint32_t end = lrcsi_meshlet_end(meshlet * LRCSI_MESHLET_FACETS, p->scene->facet_count);
    double low[3];
    double high[3];
    lrcsi_boxes_meshlet_bounds(r->view, &p->meshlets.meshlet[meshlet], low, high);
    if (bounds_drawn(r, low, high)) {
        for (uint32_t f = meshlet * LRCSI_MESHLET_FACETS; f < end; f++) {
            if (answer[f] == LRCSI_QUERY_VISIBLE) {
                fill_facet(r, f);
            }
        }
    }
}

/* --- the whole raster ------------------------------------------------------------------------- */

/* Tiles along a side. */
static uint32_t raster_tiles(uint32_t size)
{
    return (size - 1) / LRCSI_RASTER_TILE + 1;
}

/* The number of samples, with room for LANES samples after the last one. */
static size_t sample_room(uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_square(size), LANES);
}

size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size, int answers)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(sample_room(size), sizeof(uint32_t));
    need =
        lrcsi_work_add(need, lrcsi_work_blocks(answers ? 2 : 1, sample_room(size), sizeof(float)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(lrcsi_work_square(raster_tiles(size)), 1));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
}

/* The first facet from `facet` on that is drawn with a depth test: of all that can hide others, or
   of undecided ones; the number of facets if there is none. */
static uint32_t next_drawn(const lrcsi_raster *r, const unsigned char *answer, uint32_t facet)
{
    const uint32_t count = r->view->prepared->scene->facet_count;
    if (answer) {
        return lrcsi_marks_next(answer, facet, count, LRCSI_QUERY_NO_ANSWER);
    }
    while (facet < count && !lrcsi_view_casts(r->view, facet)) {
        facet++;
    }
    return facet;
}

/* Counts the samples of active tiles by their owners. */
static void count_owned(lrcsi_raster *r)
{
    for (uint32_t y = 0; y < r->size; y++) {
        const unsigned char *tiles = tile_row(r, y);
        const uint32_t *owner = r->owner + (size_t)y * r->size;
        uint32_t x = 0;
        for (lrcsi_pixel_span span; span = tile_span(tiles, &x, r->size), span.x0 < span.x1;) {
            for (uint32_t from = span.x0, i = span.x0 + 1; i <= span.x1; i++) {
                if (i == span.x1 || owner[i] != owner[from]) {
                    if (owner[from] != LRCS_NONE) {
                        r->owned[owner[from]] += i - from;
                    }
                    from = i;
                }
            }
        }
    }
}

int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, const unsigned char *answer,
                      lrcs_progress *progress, lrcs_work *work, lrcsi_raster *raster)
{
    const uint32_t count = view->prepared->scene->facet_count;
    const size_t mark = work->used;
    lrcsi_raster r;
    lrcsi_raster_layout(view, size, &r);
    r.tiles = raster_tiles(size);
    r.owner = lrcsi_work_take(work, sample_room(size), sizeof *r.owner);
    r.depth = lrcsi_work_take(work, sample_room(size), sizeof *r.depth);
    r.occluder = answer ? lrcsi_work_take(work, sample_room(size), sizeof *r.occluder) : NULL;
    r.active = lrcsi_work_take(work, lrcsi_work_square(r.tiles), 1);
    r.covered = lrcsi_work_take_zero(work, count, sizeof *r.covered);
    r.owned = lrcsi_work_take_zero(work, count, sizeof *r.owned);
    r.order_undecided = lrcsi_work_take_zero(work, count, 1);
    if (!r.owner || !r.depth || (answer && !r.occluder) || !r.active || !r.covered || !r.owned ||
        !r.order_undecided) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    memset(r.active, answer ? 0 : 1, lrcsi_work_square(r.tiles));
    for (uint32_t f = 0; answer && (f = next_drawn(&r, answer, f)) < count; f++) {
        activate_tiles(&r, f);
    }
    clear_tiles(&r);
    for (uint32_t meshlet = 0; answer && meshlet < view->prepared->meshlets.count; meshlet++) {
        fill_meshlet(&r, meshlet, answer);
    }
    uint32_t others = count; /* facets that may not be ordinary */
    for (int ordinary = 1; ordinary >= 0 && others > 0; ordinary--) {
        others = 0;
        for (uint32_t f = 0; (f = next_drawn(&r, answer, f)) < count; f++) {
            lrcsi_progress_report(progress, LRCS_PROGRESS_VISIBILITY, f, count);
            others += !draw_facet(&r, f, ordinary);
        }
    }
    count_owned(&r);
    *raster = r;
    return LRCS_OK;
}
