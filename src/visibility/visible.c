/* SPDX-License-Identifier: MIT */
/* From samples to areas with bounds. A pixel wholly inside a contested facet, touched by no event
   edge that crosses the facet and by no contact with it, shows all of the facet or nothing: its
   sample tells which, exactly. Those pixels bound the area from below and above; the estimate
   between the bounds is the share of samples. */
#include "visibility/visible.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/query.h"
#include "visibility/sample.h"

/* --- nothing hides anything ------------------------------------------------------------------- */

void lrcsi_visible_unshadowed(const lrcsi_view *view, double graze, lrcsi_visible *visible)
{
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        visible[f] = (lrcsi_visible){0, 0, 0, 0};
        if (lrcsi_grid_casts(view, f)) {
            lrcsi_tilt tilt = lrcsi_view_tilt(view, f);
            visible[f].area = visible[f].high = tilt.projected;
            visible[f].low = fabs(tilt.cos_theta) > graze ? tilt.projected : 0;
        }
    }
}

/* --- pixels where visibility may change ------------------------------------------------------- */

/* The pixels of a facet's box, and which of them are mixed. */
typedef struct pixel_marks {
    const lrcsi_raster *raster;
    lrcsi_edges edges; /* of the facet; x0 .. x1, y0 .. y1 is the box */
    unsigned char *mixed;
} pixel_marks;

static void mark_row(pixel_marks *m, uint32_t y, double from, double to)
{
    double x0 = lrcsi_most(floor(from), m->edges.x0);
    double x1 = lrcsi_least(floor(to) + 1, m->edges.x1);
    size_t row = (size_t)(y - m->edges.y0) * (m->edges.x1 - m->edges.x0);
    for (double x = x0; x < x1; x++) {
        m->mixed[row + (uint32_t)x - m->edges.x0] = 1;
    }
}

/* Marks every pixel that the segment a b may touch. Its ends are off by at most the raster's
   error; the same margin widens the row and the range (see visibility/grid.c). */
static void mark_segment(pixel_marks *m, const double a[2], const double b[2])
{
    double margin = 4 * m->raster->off;
    double rise = b[1] - a[1];
    double first = lrcsi_most(floor(lrcsi_least(a[1], b[1]) - margin), m->edges.y0);
    double last = lrcsi_least(floor(lrcsi_most(a[1], b[1]) + margin) + 1, m->edges.y1);
    for (double y = first; y < last; y++) {
        double t0 = 0;
        double t1 = 1;
        if (fabs(rise) > margin) {
            double u = (y - margin - a[1]) / rise;
            double v = (y + 1 + margin - a[1]) / rise;
            t0 = lrcsi_least(1, lrcsi_most(0, lrcsi_least(u, v)));
            t1 = lrcsi_least(1, lrcsi_most(0, lrcsi_most(u, v)));
        }
        double x0 = a[0] + t0 * (b[0] - a[0]);
        double x1 = a[0] + t1 * (b[0] - a[0]);
        mark_row(m, (uint32_t)y, lrcsi_least(x0, x1) - margin, lrcsi_most(x0, x1) + margin);
    }
}

static void mark_edge(pixel_marks *m, uint32_t edge)
{
    const lrcsi_edge *e = &m->raster->view->prepared->topology.edge[edge];
    double a[2];
    double b[2];
    lrcsi_raster_point(m->raster, e->low, a);
    lrcsi_raster_point(m->raster, e->high, b);
    mark_segment(m, a, b);
}

/* Marks the pixels in both boxes where the two planes may meet: where the difference of heights is
   not surely of one sign over the whole pixel. */
static void mark_meeting(pixel_marks *m, uint32_t facet, uint32_t other)
{
    const lrcsi_raster *r = m->raster;
    lrcsi_plane p = lrcsi_raster_plane(r, facet);
    lrcsi_plane q = lrcsi_raster_plane(r, other);
    lrcsi_edges box = lrcsi_raster_edges(r, other);
    double along = p.along - q.along;
    double up = p.up - q.up;
    double slack = r->slack[facet] + r->slack[other] + 0.51 * (fabs(along) + fabs(up));
    uint32_t y0 = box.y0 > m->edges.y0 + 1 ? box.y0 - 1 : m->edges.y0;
    uint32_t x0 = box.x0 > m->edges.x0 + 1 ? box.x0 - 1 : m->edges.x0;
    for (uint32_t y = y0; y < m->edges.y1 && y <= box.y1; y++) {
        for (uint32_t x = x0; x < m->edges.x1 && x <= box.x1; x++) {
            double height = p.at - q.at + along * (x + 0.5) + up * (y + 0.5);
            if (!(fabs(height) > slack)) {
                mark_row(m, y, x, x);
            }
        }
    }
}

static void mark_touches(pixel_marks *m, uint32_t facet)
{
    const lrcsi_view *view = m->raster->view;
    const lrcsi_touches *touches = &view->prepared->touches;
    for (uint32_t i = touches->first[facet]; i < touches->first[facet + 1]; i++) {
        const lrcsi_touch *touch = &touches->touch[i];
        if (!lrcsi_contest_touch_hides(view, facet, touch)) {
            continue;
        }
        if (touch->kind == LRCSI_TOUCH_CROSS) {
            mark_meeting(m, facet, touch->other);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            mark_edge(m, view->prepared->topology.facet_edge[touch->other].corner[k]);
        }
    }
}

/* --- contested facets ------------------------------------------------------------------------- */

/* Is the pixel wholly inside the facet, beyond the error of its edge functions? */
static int pixel_inside(const lrcsi_edges *e, uint32_t x, uint32_t y)
{
    for (int k = 0; k < 3; k++) {
        double middle = e->at[k] + e->along[k] * (x + 0.5) + e->up[k] * (y + 0.5);
        if (!(middle - 0.5 * (fabs(e->along[k]) + fabs(e->up[k])) > e->off)) {
            return 0;
        }
    }
    return 1;
}

/* Counts the certain pixels of a facet: those it owns, and those it does not. */
static void count_certain(const pixel_marks *m, uint32_t facet, double *shown, double *hidden)
{
    const unsigned char *mixed = m->mixed;
    for (uint32_t y = m->edges.y0; y < m->edges.y1; y++) {
        const uint32_t *owner = m->raster->owner + (size_t)y * m->raster->size;
        for (uint32_t x = m->edges.x0; x < m->edges.x1; x++, mixed++) {
            if (*mixed == 0 && pixel_inside(&m->edges, x, y)) {
                *(owner[x] == facet ? shown : hidden) += 1;
            }
        }
    }
}

/* The share of its samples that a facet owns; one query where it has none. */
static double sampled_share(const lrcsi_raster *raster, const lrcsi_grid *facets, uint32_t facet)
{
    static const double share[] = {0, 1, 0.5}; /* by lrcsi_query_answer */
    if (raster->covered[facet] != 0) {
        return (double)raster->owned[facet] / raster->covered[facet];
    }
    return share[lrcsi_query_facet(facets, facet)];
}

/* Pixel areas are side^2 / N^2 to a few roundings; 1e-12 of them is given away. */
static lrcsi_visible contested_area(lrcsi_contest *contest, const lrcsi_raster *raster,
                                    const lrcsi_grid *facets, pixel_marks *marks, uint32_t facet)
{
    double area = lrcsi_view_tilt(contest->view, facet).projected;
    double shown = 0;
    double hidden = 0;
    if (!raster->undecided[facet]) {
        marks->edges = lrcsi_raster_edges(raster, facet);
        size_t width = marks->edges.x1 - marks->edges.x0;
        for (size_t i = 0; i < width * (marks->edges.y1 - marks->edges.y0); i++) {
            marks->mixed[i] = 0;
        }
        uint32_t crossings = lrcsi_contest_crossings(contest, facet);
        for (uint32_t i = 0; i < crossings; i++) {
            mark_edge(marks, contest->crossing[i]);
        }
        mark_touches(marks, facet);
        count_certain(marks, facet, &shown, &hidden);
    }
    double pixel = raster->pixel * raster->pixel;
    lrcsi_visible v;
    v.low = lrcsi_least(area, shown * pixel * (1 - 1e-12));
    v.high = lrcsi_most(v.low, area - hidden * pixel * (1 - 1e-12));
    v.area = lrcsi_least(v.high, lrcsi_most(v.low, area * sampled_share(raster, facets, facet)));
    v.likely = 0.5 * sqrt((v.high - v.low) * lrcsi_least(pixel, v.high - v.low));
    return v;
}

/* --- uniform facets --------------------------------------------------------------------------- */

static lrcsi_visible uniform_area(const lrcsi_view *view, const lrcsi_raster *raster,
                                  const lrcsi_grid *facets, uint32_t facet)
{
    double area = lrcsi_view_tilt(view, facet).projected;
    int answer = raster->undecided[facet]      ? LRCSI_QUERY_UNDECIDED
                 : raster->covered[facet] == 0 ? lrcsi_query_facet(facets, facet)
                 : raster->owned[facet] != 0   ? LRCSI_QUERY_VISIBLE
                                               : LRCSI_QUERY_HIDDEN;
    if (answer == LRCSI_QUERY_UNDECIDED) {
        return (lrcsi_visible){0.5 * area, 0, area, 0.5 * area};
    }
    if (answer == LRCSI_QUERY_HIDDEN) {
        return (lrcsi_visible){0, 0, 0, 0};
    }
    return (lrcsi_visible){area, area, area, 0};
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcsi_visible_need(const lrcs_prepared *prepared, uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_bytes((size_t)size * size, 1),
                          lrcsi_grid_facets_need(prepared));
}

int lrcsi_visible_sampled(lrcsi_contest *contest, const lrcsi_raster *raster, lrcs_work *work,
                          lrcsi_visible *visible)
{
    const lrcsi_view *view = contest->view;
    size_t mark = work->used;
    lrcsi_grid facets;
    pixel_marks marks = {.raster = raster};
    marks.mixed = lrcsi_work_take(work, (size_t)raster->size * raster->size, 1);
    int status = marks.mixed ? lrcsi_grid_facets(view, work, &facets) : LRCS_E_MEMORY;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        visible[f] = (lrcsi_visible){0, 0, 0, 0};
        if (!lrcsi_grid_casts(view, f)) {
            continue;
        }
        if (!contest->contested[f]) {
            visible[f] = uniform_area(view, raster, &facets, f);
        } else if (!lrcsi_query_screened(contest, &facets, f)) {
            visible[f] = contested_area(contest, raster, &facets, &marks, f);
        }
    }
    work->used = mark;
    return status;
}
