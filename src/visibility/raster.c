/* SPDX-License-Identifier: MIT */
/* Drawing facets into the item buffer. It decides which pixels to ask and answers what doubles can
   prove; the rest it asks of visibility/sample.h. What the samples mean for areas is not its
   business. */
#include "visibility/raster.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/sample.h"

#define U 0x1p-53

void lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2])
{
    const double *p = raster->view->point[vertex].x;
    xy[0] = (p[0] - raster->view->low[0]) * raster->scale;
    xy[1] = (p[1] - raster->view->low[1]) * raster->scale;
}

/* First pixel whose centre is not left of `x` less its error, kept within 0 .. size. */
static uint32_t pixel_from(const lrcsi_raster *raster, double x)
{
    double pixel = ceil(x - 0.5 - raster->off);
    return pixel <= 0 ? 0 : pixel >= raster->size ? raster->size : (uint32_t)pixel;
}

/* One past the last pixel whose centre is not right of `x` plus its error. */
static uint32_t pixel_to(const lrcsi_raster *raster, double x)
{
    double pixel = floor(x - 0.5 + raster->off) + 1;
    return pixel <= 0 ? 0 : pixel >= raster->size ? raster->size : (uint32_t)pixel;
}

/* Corners are off by `off`, and so is the sample; with |q - p| and |sample - p| at most the box's
   half perimeter h (plus the margin of a pixel), the cross product is off by at most 4 off h, its
   rounding by 8 u h^2 <= off h. */
lrcsi_edges lrcsi_raster_edges(const lrcsi_raster *raster, uint32_t facet)
{
    lrcsi_edges e;
    const uint32_t *corner = raster->view->prepared->scene->facet[facet].corner;
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(raster, corner[k], p[k]);
    }
    double x0 = lrcsi_least(p[0][0], lrcsi_least(p[1][0], p[2][0]));
    double x1 = lrcsi_most(p[0][0], lrcsi_most(p[1][0], p[2][0]));
    double y0 = lrcsi_least(p[0][1], lrcsi_least(p[1][1], p[2][1]));
    double y1 = lrcsi_most(p[0][1], lrcsi_most(p[1][1], p[2][1]));
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        e.along[k] = -raster->view->facing[facet] * (b[1] - a[1]);
        e.up[k] = raster->view->facing[facet] * (b[0] - a[0]);
        e.at[k] = -(e.along[k] * a[0] + e.up[k] * a[1]);
    }
    e.off = 8 * raster->off * (x1 - x0 + y1 - y0 + 2);
    e.x0 = pixel_from(raster, x0);
    e.x1 = pixel_to(raster, x1);
    e.y0 = pixel_from(raster, y0);
    e.y1 = pixel_to(raster, y1);
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
    double along = -n[0] / n[2];
    double up = -n[1] / n[2];
    lrcsi_plane plane;
    plane.at = a[2] - along * (a[0] - view->low[0]) - up * (a[1] - view->low[1]);
    plane.along = along * raster->pixel;
    plane.up = up * raster->pixel;
    return plane;
}

/* A height in doubles: numerator terms below 2 |N| radius, each off by 16 u of that, and corners
   by view->off, all over |N| |cos|; the denominator's own error moves a height that lies within
   the scene by as much again. view->off holds 32 u (radius + reach). */
static double plane_slack(const lrcsi_view *view, uint32_t facet)
{
    double n[3];
    plane_normal(view, facet, n);
    double cosine = fabs(n[2]) / view->prepared->normal[facet].length;
    return cosine > 64 * U ? 8 * view->off / cosine : HUGE_VAL;
}

/* One sample that the facet covers: it takes it, or leaves it to the owner. */
static void raster_contend(lrcsi_raster *r, uint32_t facet, size_t at, double height,
                           const double xy[2])
{
    uint32_t owner = r->owner[at];
    int wins = 1;
    if (owner != LRCS_NONE) {
        double ahead = height - r->depth[at];
        double slack = r->slack[facet] + r->slack[owner];
        if (ahead > slack || ahead < -slack) {
            wins = ahead > 0;
        } else {
            double point[3];
            lrcsi_view_lift(r->view, xy[0], xy[1], point);
            int nearer = lrcsi_sample_nearer(r->view, facet, owner, point, 1);
            wins = nearer > 0;
            r->undecided[facet] |= nearer == 0;
            r->undecided[owner] |= nearer == 0;
        }
    }
    if (wins) {
        r->owner[at] = facet;
        r->depth[at] = height;
    }
}

/* Does the facet cover the sample? `least` is the smallest of its edge functions there. */
static int raster_covers(const lrcsi_raster *r, uint32_t facet, double least, double off,
                         const double xy[2])
{
    if (least > off) {
        return 1;
    }
    if (least < -off) {
        return 0;
    }
    double point[3];
    lrcsi_view_lift(r->view, xy[0], xy[1], point);
    return lrcsi_sample_covers(r->view, facet, point);
}

/* Narrows [x0, x1) of a row to where no edge function is surely negative. */
static void row_narrow(const lrcsi_edges *e, const double *row, uint32_t *x0, uint32_t *x1)
{
    double from = *x0;
    double to = *x1;
    for (int k = 0; k < 3; k++) {
        if (e->along[k] > 0) {
            from = lrcsi_most(from, floor((-e->off - row[k]) / e->along[k] - 0.5));
        } else if (e->along[k] < 0) {
            to = lrcsi_least(to, ceil((-e->off - row[k]) / e->along[k] + 0.5));
        }
    }
    if (to > from) {
        *x0 = (uint32_t)from;
        *x1 = (uint32_t)to;
    } else {
        *x1 = *x0;
    }
}

static void raster_row(lrcsi_raster *r, uint32_t facet, const lrcsi_edges *e,
                       const lrcsi_plane *plane, uint32_t y)
{
    double cy = y + 0.5;
    double row[3];
    for (int k = 0; k < 3; k++) {
        row[k] = e->at[k] + e->up[k] * cy;
    }
    uint32_t x0 = e->x0;
    uint32_t x1 = e->x1;
    row_narrow(e, row, &x0, &x1);
    double xy[2] = {0, r->view->low[1] + cy * r->pixel};
    for (uint32_t x = x0; x < x1; x++) {
        double cx = x + 0.5;
        double least =
            lrcsi_least(row[0] + e->along[0] * cx,
                        lrcsi_least(row[1] + e->along[1] * cx, row[2] + e->along[2] * cx));
        xy[0] = r->view->low[0] + cx * r->pixel;
        if (raster_covers(r, facet, least, e->off, xy)) {
            r->covered[facet]++;
            raster_contend(r, facet, (size_t)y * r->size + x,
                           plane->at + plane->along * cx + plane->up * cy, xy);
        }
    }
}

static void raster_facet(lrcsi_raster *r, uint32_t facet)
{
    lrcsi_edges edges = lrcsi_raster_edges(r, facet);
    r->slack[facet] = plane_slack(r->view, facet);
    if (edges.x0 >= edges.x1 || edges.y0 >= edges.y1) {
        return;
    }
    lrcsi_plane plane = lrcsi_raster_plane(r, facet);
    for (uint32_t y = edges.y0; y < edges.y1; y++) {
        raster_row(r, facet, &edges, &plane, y);
    }
}

size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t pixels = (size_t)size * size;
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(pixels, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(pixels, sizeof(double)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(double)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
}

static int raster_arrays(lrcsi_raster *r, lrcs_work *work)
{
    size_t pixels = (size_t)r->size * r->size;
    size_t facets = r->view->prepared->scene->facet_count;
    r->owner = lrcsi_work_take(work, pixels, sizeof *r->owner);
    r->depth = lrcsi_work_take(work, pixels, sizeof *r->depth);
    r->slack = lrcsi_work_take_zero(work, facets, sizeof *r->slack);
    r->covered = lrcsi_work_take_zero(work, facets, sizeof *r->covered);
    r->owned = lrcsi_work_take_zero(work, facets, sizeof *r->owned);
    r->undecided = lrcsi_work_take_zero(work, facets, sizeof *r->undecided);
    if (!r->owner || !r->depth || !r->slack || !r->covered || !r->owned || !r->undecided) {
        return LRCS_E_MEMORY;
    }
    for (size_t i = 0; i < pixels; i++) {
        r->owner[i] = LRCS_NONE;
    }
    return LRCS_OK;
}

static void raster_draw(lrcsi_raster *r)
{
    const lrcsi_view *view = r->view;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (view->facing[f] > 0 || (view->facing[f] < 0 && view->backs_cast)) {
            raster_facet(r, f);
        }
    }
    size_t pixels = (size_t)r->size * r->size;
    for (size_t i = 0; i < pixels; i++) {
        if (r->owner[i] != LRCS_NONE) {
            r->owned[r->owner[i]]++;
        }
    }
}

int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster)
{
    size_t mark = work->used;
    lrcsi_raster r = {.view = view, .size = size};
    r.pixel = view->side / size;
    r.scale = view->side > 0 ? size / view->side : 0;
    r.off = view->off * r.scale + 8 * U * size;
    int status = raster_arrays(&r, work);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    if (view->side > 0) {
        raster_draw(&r);
    }
    *raster = r;
    return LRCS_OK;
}
