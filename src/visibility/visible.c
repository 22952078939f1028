/* SPDX-License-Identifier: MIT */
/* From samples to areas with bounds. What a contested facet has in a pixel that is touched by no
   event edge crossing the facet and by no contact with it is visible all together or not at all: a
   sample on the facet tells which, exactly, and one in a neighbouring such pixel does too, since
   the facet's part of both is connected. And where a pixel is known to be covered by one visible
   facet, all others are hidden there. Those pixels bound the area from below and above; the
   area between the bounds comes from the samples (visibility/share.h). */
#include "visibility/visible.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/clip.h"
#include "visibility/drift.h"
#include "visibility/query.h"
#include "visibility/sample.h"
#include "visibility/share.h"

/* --- pixels where visibility may change ------------------------------------------------------- */

/* The pixels that a facet may touch, and which of them are mixed. */
typedef struct pixel_marks {
    const lrcsi_raster *raster;
    lrcsi_edges edges;       /* of the facet */
    double corner[3][2];     /* its corners, in pixels, counter-clockwise */
    uint32_t x0, x1, y0, y1; /* the box: x0 <= x < x1 */
    unsigned char *mixed;    /* pixel of the box: visibility may change in it */
    unsigned char *pure;     /* pixel of the raster: its owner covers it and is visible */
} pixel_marks;

static void marks_start(pixel_marks *m, uint32_t facet)
{
    const lrcsi_raster *r = m->raster;
    const uint32_t *corner = r->view->prepared->scene->facet[facet].corner;
    m->edges = lrcsi_raster_edges(r, facet);
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(r, corner[r->view->facing[facet] > 0 ? k : 2 - k], m->corner[k]);
    }
    m->x0 = m->edges.x0 > 0 ? m->edges.x0 - 1 : 0; /* pixels touched, not only their centres */
    m->y0 = m->edges.y0 > 0 ? m->edges.y0 - 1 : 0;
    m->x1 = m->edges.x1 < r->size ? m->edges.x1 + 1 : r->size;
    m->y1 = m->edges.y1 < r->size ? m->edges.y1 + 1 : r->size;
    size_t count = (size_t)(m->x1 - m->x0) * (m->y1 - m->y0);
    for (size_t i = 0; i < count; i++) {
        m->mixed[i] = 0;
    }
}

static size_t marks_at(const pixel_marks *m, uint32_t x, uint32_t y)
{
    return (size_t)(y - m->y0) * (m->x1 - m->x0) + (x - m->x0);
}

static void mark_row(pixel_marks *m, uint32_t y, double from, double to)
{
    double x0 = lrcsi_most(floor(from), m->x0);
    double x1 = lrcsi_least(floor(to) + 1, m->x1);
    for (double x = x0; x < x1; x++) {
        m->mixed[marks_at(m, (uint32_t)x, y)] = 1;
    }
}

/* Marks every pixel that the segment a b may touch. Its ends are off by at most the raster's
   error; the same margin widens the row and the range (see visibility/grid.c). */
static void mark_segment(pixel_marks *m, const double a[2], const double b[2])
{
    double margin = 4 * m->raster->off;
    double rise = b[1] - a[1];
    double first = lrcsi_most(floor(lrcsi_least(a[1], b[1]) - margin), m->y0);
    double last = lrcsi_least(floor(lrcsi_most(a[1], b[1]) + margin) + 1, m->y1);
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
    uint32_t y0 = box.y0 > m->y0 + 1 ? box.y0 - 1 : m->y0;
    uint32_t x0 = box.x0 > m->x0 + 1 ? box.x0 - 1 : m->x0;
    for (uint32_t y = y0; y < m->y1 && y <= box.y1; y++) {
        for (uint32_t x = x0; x < m->x1 && x <= box.x1; x++) {
            double height = p.at - q.at + along * (x + 0.5) + up * (y + 0.5);
            if (!(fabs(height) > slack)) {
                m->mixed[marks_at(m, x, y)] = 1;
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

/* The smallest of the facet's edge functions over a pixel's centre, less `reach` times how much it
   changes over half a pixel. */
static double pixel_least(const lrcsi_edges *e, uint32_t x, uint32_t y, double reach)
{
    double least = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double middle = e->at[k] + e->along[k] * (x + 0.5) + e->up[k] * (y + 0.5);
        double change = 0.5 * (fabs(e->along[k]) + fabs(e->up[k]));
        least = lrcsi_least(least, middle - reach * change);
    }
    return least;
}

/* Does the facet surely cover the whole pixel? */
static int pixel_inside(const pixel_marks *m, uint32_t x, uint32_t y)
{
    return pixel_least(&m->edges, x, y, 1) > m->edges.off;
}

/* How much of a pixel the facet covers, in pixels. Corners are off by the raster's error, so this
   is off by at most the length of the cut, below 6, times that. */
static double pixel_share(const pixel_marks *m, uint32_t x, uint32_t y)
{
    if (pixel_inside(m, x, y)) {
        return 1;
    }
    if (pixel_least(&m->edges, x, y, -1) < -m->edges.off) {
        return 0;
    }
    const double low[2] = {x, y};
    double share = lrcsi_clip_box_area((const double(*)[2])m->corner, low);
    return lrcsi_most(0, share - 8 * m->raster->off);
}

/* Does a sample on the facet tell what the pixel shows of it? Then *shows. */
static int pixel_tells(const pixel_marks *m, uint32_t facet, uint32_t x, uint32_t y, int *shows)
{
    if (x < m->x0 || x >= m->x1 || y < m->y0 || y >= m->y1 || m->mixed[marks_at(m, x, y)] ||
        !(pixel_least(&m->edges, x, y, 0) > m->edges.off)) {
        return 0;
    }
    *shows = m->raster->owner[(size_t)y * m->raster->size + x] == facet;
    return 1;
}

/* The same, from the pixel or from one beside it. Coordinates below 0 wrap round and are outside.
 */
static int pixel_known(const pixel_marks *m, uint32_t facet, uint32_t x, uint32_t y, int *shows)
{
    return m->mixed[marks_at(m, x, y)] == 0 &&
           (pixel_tells(m, facet, x, y, shows) || pixel_tells(m, facet, x - 1, y, shows) ||
            pixel_tells(m, facet, x + 1, y, shows) || pixel_tells(m, facet, x, y - 1, shows) ||
            pixel_tells(m, facet, x, y + 1, shows));
}

/* Adds up what is certain of a facet, in pixels: what it shows, and what is hidden. */
static void count_certain(pixel_marks *m, uint32_t facet, double *shown, double *hidden)
{
    const lrcsi_raster *r = m->raster;
    for (uint32_t y = m->y0; y < m->y1; y++) {
        for (uint32_t x = m->x0; x < m->x1; x++) {
            size_t at = (size_t)y * r->size + x;
            double share = pixel_share(m, x, y);
            int shows = 0;
            if (share == 0) {
                continue;
            }
            if (m->pure[at] && r->owner[at] != facet) {
                *hidden += share;
            } else if (pixel_known(m, facet, x, y, &shows)) {
                *(shows ? shown : hidden) += share;
            }
        }
    }
}

/* The pixels that a facet covers and is visible in: all that it covers where it is uniform. */
static void mark_pure(pixel_marks *m, uint32_t facet, int uniform)
{
    const lrcsi_raster *r = m->raster;
    for (uint32_t y = m->edges.y0; y < m->edges.y1; y++) {
        for (uint32_t x = m->edges.x0; x < m->edges.x1; x++) {
            size_t at = (size_t)y * r->size + x;
            if (r->owner[at] == facet && pixel_inside(m, x, y) &&
                (uniform || m->mixed[marks_at(m, x, y)] == 0)) {
                m->pure[at] = 1;
            }
        }
    }
}

/* Marks where the visibility of a contested facet may change. Returns how many event edges cross
   it; they stand in contest->crossing. */
static uint32_t mark_changes(pixel_marks *m, lrcsi_contest *contest, uint32_t facet)
{
    marks_start(m, facet);
    uint32_t crossings = lrcsi_contest_crossings(contest, facet);
    for (uint32_t i = 0; i < crossings; i++) {
        mark_edge(m, contest->crossing[i]);
    }
    mark_touches(m, facet);
    return crossings;
}

/* Pixel areas are side^2 / N^2 to a few roundings; 1e-12 of them is given away. */
static lrcsi_visible contested_area(lrcsi_contest *contest, const lrcsi_sharing *sharing,
                                    pixel_marks *marks, uint32_t facet)
{
    const lrcsi_raster *raster = sharing->raster;
    double area = lrcsi_view_tilt(contest->view, facet).projected;
    double pixel = raster->pixel * raster->pixel;
    lrcsi_share share = lrcsi_share_facet(sharing, facet);
    double shown = 0;
    double hidden = 0;
    lrcsi_drift drift = {HUGE_VAL, 0};
    if (!raster->undecided[facet]) {
        uint32_t crossings = mark_changes(marks, contest, facet);
        drift = share.row ? lrcsi_drift_row(raster, facet, share.longest, share.share)
                          : lrcsi_drift_facet(contest, crossings, raster, facet);
        count_certain(marks, facet, &shown, &hidden);
    }
    lrcsi_visible v;
    v.low = lrcsi_least(area, shown * pixel * (1 - 1e-12));
    v.high = lrcsi_most(v.low, area - hidden * pixel * (1 - 1e-12));
    lrcsi_share_keep(sharing, facet, area, &share, &v);
    double gap = v.high - v.low;
    v.likely = lrcsi_least(gap, sqrt(drift.square) * pixel);
    v.lean = lrcsi_least(gap, lrcsi_most(-gap, drift.lean * pixel));
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
        return (lrcsi_visible){0.5 * area, 0, area, 0.5 * area, 0};
    }
    if (answer == LRCSI_QUERY_HIDDEN) {
        return (lrcsi_visible){0, 0, 0, 0, 0};
    }
    return (lrcsi_visible){area, area, area, 0, 0};
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcsi_visible_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes((size_t)size * size, 2);
    need = lrcsi_work_add(need, lrcsi_grid_facets_need(prepared));
    return lrcsi_work_add(need, lrcsi_share_need(prepared));
}

/* The pixels of which one facet is known to hold all. */
static void mark_all_pure(lrcsi_contest *contest, pixel_marks *marks, const lrcsi_visible *visible)
{
    const lrcsi_raster *raster = marks->raster;
    for (uint32_t f = 0; f < contest->view->prepared->scene->facet_count; f++) {
        if (raster->owned[f] == 0 || raster->undecided[f]) {
            continue;
        }
        if (contest->contested[f]) {
            mark_changes(marks, contest, f);
            mark_pure(marks, f, 0);
        } else if (visible[f].low > 0) {
            marks->edges = lrcsi_raster_edges(raster, f);
            mark_pure(marks, f, 1);
        }
    }
}

static void visible_fill(lrcsi_contest *contest, const lrcsi_sharing *sharing, pixel_marks *marks,
                         lrcsi_visible *visible)
{
    const lrcsi_view *view = contest->view;
    uint32_t count = view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        visible[f] = (lrcsi_visible){0, 0, 0, 0, 0};
        if (lrcsi_grid_casts(view, f) && !contest->contested[f]) {
            visible[f] = uniform_area(view, marks->raster, sharing->facets, f);
        }
    }
    if (contest->contested_count == 0) {
        return;
    }
    mark_all_pure(contest, marks, visible);
    for (uint32_t f = 0; f < count; f++) {
        if (contest->contested[f] && !lrcsi_query_screened(contest, sharing->facets, f)) {
            visible[f] = contested_area(contest, sharing, marks, f);
        }
    }
    lrcsi_share_settle(sharing, visible);
}

int lrcsi_visible_sampled(lrcsi_contest *contest, const lrcsi_raster *raster, lrcs_work *work,
                          lrcsi_visible *visible)
{
    size_t mark = work->used;
    size_t pixels = (size_t)raster->size * raster->size;
    lrcsi_grid facets;
    lrcsi_sharing sharing;
    pixel_marks marks = {.raster = raster};
    marks.mixed = lrcsi_work_take(work, pixels, 1);
    marks.pure = lrcsi_work_take_zero(work, pixels, 1);
    int status =
        marks.mixed && marks.pure ? lrcsi_grid_facets(contest->view, work, &facets) : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        status = lrcsi_share_make(contest, raster, &facets, work, &sharing);
    }
    if (status == LRCS_OK) {
        visible_fill(contest, &sharing, &marks, visible);
    }
    work->used = mark;
    return status;
}
