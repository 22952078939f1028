/* SPDX-License-Identifier: MIT */
/* Draws a view as graphics hardware does. This file decides which facet owns which pixel, by the
   arithmetic and rules of that hardware; visibility/raster/raster_draw.c and visibility/occlude.c
   decide what the laser truly sees. */
#include "analysis/gpu.h"

#include <math.h>

#include "base/range.h"
#include "base/single.h"
#include "base/work.h"

#define SUBPIXELS 256 /* sub-pixels along a pixel */

/* Corners are kept within this many pixels of the window's corner. Edge functions then stay below
   2^52: they are whole numbers that doubles represent exactly. */
#define GUARD_BAND 0x1p15

/* A window is at least this fraction of the extent of the scene, so that its matrix fits a
   float. */
#define WINDOW_MIN 0x1p-100

/* The margin of the depth range at each end, as a fraction of the window's side: no end of the
   scene is clipped, and the depth range of a scene without depth is not 0. */
#define DEPTH_MARGIN 0x1p-7

/* --- vertices --------------------------------------------------------------------------------- */

/* What the host uploads for a pose: the transformation from body to clip coordinates, which range
   from -1 to 1. */
typedef struct clip_matrix {
    double rotation[3][3], translation[3];
    double unit; /* per scaled unit: a power of two */
} clip_matrix;

/* The cube of the clip coordinates encloses the window and, with a margin, the depths of all facets
   that are drawn. Positions are relative to the centre of the scene; in most scenes that is the
   origin of views. */
static clip_matrix clip_make(const lrcsi_gpu *gpu)
{
    const lrcsi_view *view = &gpu->view;
    const lrcs_prepared *p = view->prepared;
    clip_matrix clip = {.unit = ldexp(1, -ilogb(p->radius))};
    double low = HUGE_VAL; /* depths */
    double high = -HUGE_VAL;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        for (int corner = 0; corner < 3 && !p->skip[f]; corner++) {
            double z = view->point[p->scene->facet[f].corner[corner]].x[2];
            low = lrcsi_min(low, z);
            high = lrcsi_max(high, z);
        }
    }
    const double middle[3] = {view->low[0] + 0.5 * view->side, view->low[1] + 0.5 * view->side,
                              0.5 * (low + high)};
    const double half[3] = {0.5 * view->side, 0.5 * view->side,
                            -(0.5 * (high - low) + DEPTH_MARGIN * view->side)};
    for (int k = 0; k < 3; k++) {
        double centre = 0; /* of the scene, along a view axis */
        for (int j = 0; j < 3; j++) {
            clip.rotation[k][j] = lrcsi_single(gpu->single, view->R[k][j] / (half[k] * clip.unit));
            centre += view->R[k][j] * (p->centre[j] - p->origin[j]);
        }
        clip.translation[k] = lrcsi_single(gpu->single, (centre - middle[k]) / half[k]);
    }
    return clip;
}

/* Converts a clip coordinate to a window coordinate, from 0 to 2 `half`. */
static double window_coordinate(int single, const double *rotation, double translation,
                                const double *p, double half)
{
    double x = lrcsi_single(single, rotation[0] * p[0]);
    x = lrcsi_single(single, x + lrcsi_single(single, rotation[1] * p[1]));
    x = lrcsi_single(single, x + lrcsi_single(single, rotation[2] * p[2]));
    x = lrcsi_single(single, x + translation);
    return lrcsi_single(single, lrcsi_single(single, x * half) + half);
}

static lrcsi_gpu_vertex gpu_vertex(const lrcsi_gpu *gpu, const clip_matrix *clip, uint32_t i)
{
    const lrcs_prepared *prepared = gpu->view.prepared;
    lrcsi_gpu_vertex vertex;
    double p[3];
    for (int k = 0; k < 3; k++) {
        double from_centre = prepared->vertex[i].x[k] - prepared->centre[k];
        p[k] = lrcsi_single(gpu->single, from_centre * clip->unit);
    }
    for (int k = 0; k < 2; k++) {
        double x = window_coordinate(gpu->single, clip->rotation[k], clip->translation[k], p,
                                     0.5 * gpu->size);
        x = lrcsi_min(lrcsi_max(x, -GUARD_BAND), GUARD_BAND);
        vertex.at[k] = (int64_t)floor(x * SUBPIXELS + 0.5);
    }
    vertex.depth = window_coordinate(gpu->single, clip->rotation[2], clip->translation[2], p, 0.5);
    return vertex;
}

/* --- facets ----------------------------------------------------------------------------------- */

/* Twice the signed area of the triangle of an edge and the centre of a pixel, in sub-pixels:
   at + along x + up y for pixel (x, y), positive inside. The pixel is covered if the value is at
   least `threshold`. */
typedef struct gpu_edge {
    int64_t at, along, up, threshold;
} gpu_edge;

/* A facet that is being drawn: edge k is opposite corner k. */
typedef struct gpu_facet {
    gpu_edge edge[3];
    double inverse;         /* sum of the edge functions */
    double depth, rise[2];  /* depth at corner 0; differences to corners 1 and 2 */
    int64_t x0, x1, y0, y1; /* pixels x0 <= x < x1 */
} gpu_facet;

/* The top-left rule: a pixel centre on an edge belongs to the facet if the edge is a left one
   (going down, with the inside to its left) or a top one (horizontal, going left). */
static gpu_edge edge_make(const int64_t a[2], const int64_t b[2])
{
    int64_t dx = b[0] - a[0];
    int64_t dy = b[1] - a[1];
    gpu_edge e = {.along = -dy * SUBPIXELS, .up = dx * SUBPIXELS};
    e.at = dx * (SUBPIXELS / 2 - a[1]) - dy * (SUBPIXELS / 2 - a[0]);
    e.threshold = dy < 0 || (dy == 0 && dx < 0) ? 0 : 1;
    return e;
}

/* Floor and ceiling of a quotient, for b > 0. */
static int64_t floor_divide(int64_t a, int64_t b)
{
    return a / b - (a % b < 0);
}

static int64_t ceil_divide(int64_t a, int64_t b)
{
    return -floor_divide(-a, b);
}

/* The pixels of the window whose centres lie between the minimum and the maximum of three
   coordinates. */
static void facet_extent(const lrcsi_gpu *gpu, int64_t a, int64_t b, int64_t c, int64_t *from,
                         int64_t *to)
{
    int64_t low = a < b ? a : b;
    int64_t high = a > b ? a : b;
    low = low < c ? low : c;
    high = high > c ? high : c;
    *from = ceil_divide(low - SUBPIXELS / 2, SUBPIXELS);
    *to = floor_divide(high - SUBPIXELS / 2, SUBPIXELS) + 1;
    *from = *from > 0 ? *from : 0;
    *to = *to < gpu->size ? *to : gpu->size;
}

/* Prepares a facet for drawing. Returns 0 if it covers nothing: after snapping, some facets have no
   area. */
static int facet_start(const lrcsi_gpu *gpu, uint32_t facet, gpu_facet *out)
{
    const uint32_t *corner = gpu->view.prepared->scene->facet[facet].corner;
    const lrcsi_gpu_vertex *a = &gpu->vertex[corner[0]];
    const lrcsi_gpu_vertex *b = &gpu->vertex[corner[1]];
    const lrcsi_gpu_vertex *c = &gpu->vertex[corner[2]];
    int64_t twice = (b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) -
                    (b->at[1] - a->at[1]) * (c->at[0] - a->at[0]);
    if (twice == 0) {
        return 0;
    }
    if (twice < 0) { /* seen from behind */
        const lrcsi_gpu_vertex *other = b;
        b = c;
        c = other;
        twice = -twice;
    }
    out->edge[0] = edge_make(b->at, c->at);
    out->edge[1] = edge_make(c->at, a->at);
    out->edge[2] = edge_make(a->at, b->at);
    out->inverse = lrcsi_single(gpu->single, 1 / lrcsi_single(gpu->single, (double)twice));
    out->depth = a->depth;
    out->rise[0] = lrcsi_single(gpu->single, b->depth - a->depth);
    out->rise[1] = lrcsi_single(gpu->single, c->depth - a->depth);
    facet_extent(gpu, a->at[0], b->at[0], c->at[0], &out->x0, &out->x1);
    facet_extent(gpu, a->at[1], b->at[1], c->at[1], &out->y0, &out->y1);
    return 1;
}

/* The depth, as the buffer stores it, at the point where the edge functions of corners 1 and 2 are
   e1 and e2. */
static double depth_stored(const lrcsi_gpu *gpu, const gpu_facet *f, int64_t e1, int64_t e2)
{
    int single = gpu->single;
    double w1 = lrcsi_single(single, lrcsi_single(single, (double)e1) * f->inverse);
    double w2 = lrcsi_single(single, lrcsi_single(single, (double)e2) * f->inverse);
    double rise = lrcsi_single(single, lrcsi_single(single, w1 * f->rise[0]) +
                                           lrcsi_single(single, w2 * f->rise[1]));
    double depth = lrcsi_single(single, f->depth + rise);
    depth = lrcsi_min(lrcsi_max(depth, 0), 1);
    return gpu->steps > 0 ? floor(depth * gpu->steps + 0.5) : lrcsi_single(gpu->short_depth, depth);
}

/* The range of pixels of row y that are inside all three edges. */
static void row_span(const gpu_facet *f, int64_t y, int64_t *from, int64_t *to)
{
    *from = f->x0;
    *to = f->x1;
    for (int k = 0; k < 3; k++) {
        const gpu_edge *e = &f->edge[k];
        int64_t needed = e->threshold - (e->at + e->up * y); /* along x must be at least this */
        if (e->along > 0) {
            int64_t x = ceil_divide(needed, e->along);
            *from = x > *from ? x : *from;
        } else if (e->along < 0) {
            int64_t x = floor_divide(-needed, -e->along) + 1;
            *to = x < *to ? x : *to;
        } else if (needed > 0) {
            *to = *from;
        }
    }
}

static void facet_draw(lrcsi_gpu *gpu, uint32_t facet)
{
    gpu_facet f;
    if (!facet_start(gpu, facet, &f)) {
        return;
    }
    for (int64_t y = f.y0; y < f.y1; y++) {
        int64_t from;
        int64_t to;
        row_span(&f, y, &from, &to);
        for (int64_t x = from; x < to; x++) {
            size_t at = (size_t)y * gpu->size + (size_t)x;
            double depth =
                depth_stored(gpu, &f, f.edge[1].at + f.edge[1].along * x + f.edge[1].up * y,
                             f.edge[2].at + f.edge[2].along * x + f.edge[2].up * y);
            if (depth < gpu->depth[at]) {
                gpu->depth[at] = depth;
                gpu->owner[at] = facet;
            }
        }
    }
}

/* --- the whole view --------------------------------------------------------------------------- */

size_t lrcsi_gpu_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t pixels = lrcsi_work_square(size);
    size_t need = lrcsi_work_bytes(prepared->scene->vertex_count, sizeof(lrcsi_gpu_vertex));
    need = lrcsi_work_add(need, lrcsi_work_bytes(pixels, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(pixels, sizeof(double)));
}

int lrcsi_gpu_make(const lrcsi_view *view, const lrcs_emulation_options *options, lrcs_work *work,
                   lrcsi_gpu *gpu)
{
    size_t mark = work->used;
    lrcsi_gpu g = {.view = *view, .size = options->resolution};
    g.single = options->precision == LRCS_PRECISION_FLOAT32;
    g.steps = options->depth_bits < 32 ? ldexp(1, (int)options->depth_bits) - 1 : 0;
    g.short_depth = options->depth_bits == 32;
    double wider = WINDOW_MIN * view->prepared->radius - view->side;
    if (wider > 0) { /* a needle that is seen along its axis */
        g.view.low[0] -= 0.5 * wider;
        g.view.low[1] -= 0.5 * wider;
        g.view.side += wider;
    }
    const lrcs_prepared *p = view->prepared;
    size_t pixels = lrcsi_work_square(g.size);
    g.vertex = lrcsi_work_take(work, p->scene->vertex_count, sizeof *g.vertex);
    g.owner = lrcsi_work_take(work, pixels, sizeof *g.owner);
    g.depth = lrcsi_work_take(work, pixels, sizeof *g.depth);
    if (!g.vertex || !g.owner || !g.depth) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    for (size_t i = 0; i < pixels; i++) {
        g.owner[i] = LRCS_NONE;
        g.depth[i] = g.steps > 0 ? g.steps : 1;
    }
    if (p->live > 0) {
        clip_matrix clip = clip_make(&g);
        for (uint32_t i = 0; i < p->scene->vertex_count; i++) {
            g.vertex[i] = gpu_vertex(&g, &clip, i);
        }
        for (uint32_t f = 0; f < p->scene->facet_count; f++) {
            if (!p->skip[f]) {
                facet_draw(&g, f);
            }
        }
    }
    *gpu = g;
    return LRCS_OK;
}
