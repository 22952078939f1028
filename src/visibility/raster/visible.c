/* SPDX-License-Identifier: MIT */
/* From samples to visible areas with bounds.

   A pixel is mixed for an undecided facet if an event edge that crosses the facet touches the
   pixel, or if a contact on the facet may lie in it. In any other pixel, the part of the facet is
   either entirely visible or entirely hidden. A sample on the facet in that pixel decides which,
   exactly. So does a sample on it in an adjacent pixel that is not mixed, because the parts of the
   facet in the two pixels are connected.

   In any pixel, mixed or not, a facet is hidden if one other facet covers the whole pixel and is
   higher everywhere, or is known to be visible (raster->occluder).

   The areas of facets in such pixels are lower bounds of what is visible and of what is hidden.
   Between the bounds of a facet, its samples decide (visibility/raster/visible_fraction.h).

   The driver is lrcsi_visible_areas_from_samples:
   1. lrcsi_raster_make: the samples of the tiles that undecided facets touch.
   2. lrcsi_query_areas: the areas of facets that queries decided.
   3. For each undecided facet: facet_pixels finds its mixed pixels, decides the others, and adds up
      their areas; sampled_area finds the area within the bounds, and its estimated error.
   4. lrcsi_visible_fraction_correct: area that the bounds cut off goes to other facets of the
      component. */
#include "visibility/raster/visible.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/base/clip.h"
#include "visibility/base/sample.h"
#include "visibility/index/marks.h"
#include "visibility/raster/sampling_error.h"
#include "visibility/raster/visible_fraction.h"
#include "visibility/uniform/query.h"

/* --- the pixels of one facet ------------------------------------------------------------------ */

/* The area of a facet that is certainly visible and the area that is certainly hidden, in pixels.
   Pixels that the facet covers entirely are counted, without error. The areas in other pixels are
   added up: at most 12 N of them, because a side touches at most 4 pixels in each row or column.
   Each addition rounds by at most 12 u N, less than what pixel_area subtracts from each area. */
typedef struct pixel_sums {
    uint32_t full_visible, full_hidden;
    double visible, hidden; /* hidden: HUGE_VAL if all of the facet is */
} pixel_sums;

/* What a facet covers of a row of pixels. */
typedef struct visible_row {
    lrcsi_pixel_span touched; /* pixels that it may touch */
    lrcsi_pixel_span certain; /* pixels whose centre it certainly covers */
    lrcsi_pixel_span full;    /* pixels that it certainly covers entirely */
} visible_row;

/* Data that all facets of a raster share. */
typedef struct visible_job {
    const lrcsi_raster *raster;
    visible_row *row;     /* by row: those of the current facet, in the rows that it touches */
    unsigned char *mixed; /* by pixel: 1 if mixed for the current facet; set where it touches */
} visible_job;

/* The current facet. */
typedef struct drawn_facet {
    uint32_t facet;
    lrcsi_edge_functions edges;
    double corner[3][2]; /* in pixels, counter-clockwise */
    lrcsi_plane plane;
    double rise; /* a point of it in a pixel is at most this much above the height of its plane at
                    the pixel's centre */
    double high; /* upper bound of its heights */
} drawn_facet;

/* Makes a facet the current one: finds what it covers. */
static drawn_facet drawn_facet_make(visible_job *job, uint32_t facet)
{
    const lrcsi_raster *r = job->raster;
    const uint32_t *corner = r->view->prepared->scene->facet[facet].corner;
    drawn_facet f = {
        .facet = facet, .edges = lrcsi_raster_edge_functions(r, facet), .high = -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(r, corner[r->view->facing[facet] > 0 ? k : 2 - k], f.corner[k]);
        const lrcsi_view_vertex *at = &r->view->point[corner[k]];
        f.high = lrcsi_max(f.high, at->x[2] + at->err);
    }
    f.plane = lrcsi_raster_plane(r, facet);
    f.rise = 0.5 * (fabs(f.plane.dx) + fabs(f.plane.dy)) + f.plane.err;
    for (uint32_t y = f.edges.bottom; y < f.edges.top; y++) {
        visible_row *row = &job->row[y];
        row->touched = lrcsi_span_touched(&f.edges, y);
        row->certain = lrcsi_span_samples(&f.edges, y).certain;
        row->full = lrcsi_span_full(&f.edges, y, row->certain);
    }
    return f;
}

static size_t pixel_index(const visible_job *job, uint32_t x, uint32_t y)
{
    return (size_t)y * job->raster->size + x;
}

/* Marks every pixel of the facet that a segment may touch: rows and ranges are widened by four
   times the error of its points (visibility/raster/span.h). */
static void mark_segment(visible_job *job, const drawn_facet *f,
                         const lrcsi_raster_segment *segment)
{
    const double *a = segment->a;
    const double *b = segment->b;
    const double margin = 4 * segment->err;
    const double bottom = f->edges.bottom;
    const double top = f->edges.top;
    const lrcsi_pixel_segment s = lrcsi_span_segment(a, b, margin);
    const double y0 = lrcsi_max(bottom, lrcsi_min(a[1], b[1]) - margin);
    const double y1 = lrcsi_min(top, lrcsi_max(a[1], b[1]) + margin + 1);
    for (uint32_t y = (uint32_t)lrcsi_min(y0, top); y < (uint32_t)lrcsi_max(y1, bottom); y++) {
        uint32_t x0 = job->row[y].touched.x0;
        uint32_t x1 = job->row[y].touched.x1;
        lrcsi_span_follow(&s, y, &x0, &x1);
        if (x0 < x1) {
            memset(job->mixed + pixel_index(job, x0, y), 1, x1 - x0);
        }
    }
}

/* Marks all pixels of the facet that another one touches too. */
static void mark_overlap(visible_job *job, const drawn_facet *f, const lrcsi_edge_functions *other)
{
    uint32_t y = other->bottom > f->edges.bottom ? other->bottom : f->edges.bottom;
    for (; y < other->top && y < f->edges.top; y++) {
        const lrcsi_pixel_span own = job->row[y].touched;
        const lrcsi_pixel_span theirs = lrcsi_span_touched(other, y);
        const uint32_t x0 = own.x0 > theirs.x0 ? own.x0 : theirs.x0;
        const uint32_t x1 = own.x1 < theirs.x1 ? own.x1 : theirs.x1;
        memset(job->mixed + pixel_index(job, x0, y), 1, x0 < x1 ? x1 - x0 : 0);
    }
}

/* Clips a segment to within its error of a facet. Returns 0 if nothing remains. */
static int segment_clip(lrcsi_raster_segment *s, const lrcsi_edge_functions *facet)
{
    const lrcsi_raster_segment all = *s;
    double t[2];
    if (!lrcsi_span_clip(facet, all.a, all.b, all.err, t)) {
        return 0;
    }
    for (int k = 0; k < 2; k++) {
        s->a[k] = all.a[k] + t[0] * (all.b[k] - all.a[k]);
        s->b[k] = all.a[k] + t[1] * (all.b[k] - all.a[k]);
    }
    return 1;
}

/* Marks the pixels that are mixed for a facet: along the event edges that cross it, and where
   others are in contact with it. A facet that passes through it meets it on the line in which their
   planes intersect, as far as that may lie in the other facet. If the line is not known to an
   eighth of a pixel, because the planes are close to parallel or the other facet to edge-on, these
   are all pixels that both touch. */
static void mark_mixed(visible_job *job, const drawn_facet *f, const lrcsi_crossings *crossings)
{
    const lrcsi_raster *r = job->raster;
    const lrcsi_intersections *contacts = &r->view->prepared->intersections;
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        const lrcsi_pixel_span touched = job->row[y].touched;
        memset(job->mixed + pixel_index(job, touched.x0, y), 0, touched.x1 - touched.x0);
    }
    for (uint32_t i = 0; i < crossings->count; i++) {
        const lrcsi_raster_segment s = lrcsi_raster_edge(r, crossings->edge[i]);
        mark_segment(job, f, &s);
    }
    for (uint32_t i = contacts->first[f->facet]; i < contacts->first[f->facet + 1]; i++) {
        const lrcsi_intersection *contact = &contacts->entry[i];
        lrcsi_raster_segment s[3];
        if (!lrcsi_sample_contact_hides(r->view, f->facet, contact)) {
            continue;
        }
        int segments = lrcsi_raster_contact(r, &f->edges, f->facet, contact, s);
        if (contact->kind == LRCSI_INTERSECTION_CROSS) {
            const lrcsi_edge_functions other = lrcsi_raster_edge_functions(r, contact->other);
            if (!(s[0].err <= LRCSI_RASTER_LINE_ERR_MAX)) {
                mark_overlap(job, f, &other);
                continue;
            }
            segments = segments > 0 && segment_clip(&s[0], &other);
        }
        for (int k = 0; k < segments; k++) {
            mark_segment(job, f, &s[k]);
        }
    }
}

/* The part of a unit square in which a linear function is positive. Given: its value at the centre,
   and how much it changes along the sides of the square, larger >= smaller >= 0. */
static double square_part(double value, double larger, double smaller)
{
    double from = fabs(value);
    double beyond = 0.5 * (larger + smaller) - from;
    double less = beyond >= smaller ? 0.5 - from / larger
                  : beyond > 0      ? 0.5 * (beyond / larger) * (beyond / smaller)
                                    : 0;
    return value > 0 ? 1 - less : less;
}

/* A lower bound of the area of the facet in a pixel that it may not cover entirely.

   If one side alone passes through the pixel: an error of value_err moves the line by
   value_err / |gradient|, and the area by that times the length of the line in the pixel, which is
   below 1.5. Roundings are below 8 u, and value_err is at least 64 u N h.

   Otherwise, the corners have errors of position_err in each coordinate. The area then has an error
   of at most 4 position_err: the extents of the sides within the pixel, along both axes together.
   Roundings (visibility/base/clip.h) are less than another 4 position_err, because position_err is
   more than 8 u of the distance of a corner from any pixel, and more than 16 u. */
static double pixel_area(const drawn_facet *f, uint32_t x, uint32_t y)
{
    const lrcsi_edge_functions *e = &f->edges;
    int sides = 0;
    double area = 0;
    for (int k = 0; k < 3; k++) {
        double dx = fabs(e->dx[k]);
        double dy = fabs(e->dy[k]);
        double value = e->c[k] + e->dx[k] * (x + 0.5) + e->dy[k] * (y + 0.5);
        if (!(value - 0.5 * (dx + dy) > e->value_err)) {
            double larger = lrcsi_max(dx, dy);
            sides++;
            area = square_part(value, larger, lrcsi_min(dx, dy)) - 2 * e->value_err / larger;
        }
    }
    if (sides != 1) {
        const double low[2] = {x, y};
        area = lrcsi_clip_box_area((const double(*)[2])f->corner, low) - 8 * e->position_err;
    }
    return lrcsi_max(0, area);
}

/* Is the facet certainly hidden in the whole pixel by one that covers all of it? */
static int pixel_hidden(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    return (double)job->raster->occluder[pixel_index(job, x, y)] >
           lrcsi_min(f->high, lrcsi_plane_height(&f->plane, x, y) + f->rise);
}

enum { PIXEL_HIDDEN, PIXEL_VISIBLE, PIXEL_UNRESOLVED };

/* Is the part of a facet in a pixel certainly visible or certainly hidden? If the pixel is not
   mixed, a sample of the facet in it, or in an adjacent pixel that is not mixed either, decides.
   Otherwise it may be hidden by what covers the pixel. Coordinates below 0 wrap round, and are then
   outside the facet's rows or spans. */
static int pixel_visibility(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    static const int32_t step[5][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (int i = 0; i < 5 && !job->mixed[pixel_index(job, x, y)]; i++) {
        uint32_t sx = x + (uint32_t)step[i][0];
        uint32_t sy = y + (uint32_t)step[i][1];
        if (sy >= f->edges.bottom && sy < f->edges.top &&
            lrcsi_span_has(job->row[sy].certain, sx) && !job->mixed[pixel_index(job, sx, sy)]) {
            return job->raster->owner[pixel_index(job, sx, sy)] == f->facet ? PIXEL_VISIBLE
                                                                            : PIXEL_HIDDEN;
        }
    }
    return pixel_hidden(job, f, x, y) ? PIXEL_HIDDEN : PIXEL_UNRESOLVED;
}

/* Is all of a facet certainly hidden, pixel by pixel? */
static int pixels_hide_facet(const visible_job *job, const drawn_facet *f)
{
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        const lrcsi_pixel_span touched = job->row[y].touched;
        for (uint32_t x = touched.x0; x < touched.x1; x++) {
            if (!pixel_hidden(job, f, x, y)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Adds up the pixels of a facet that are decided, row by row. A pixel that it may not cover
   entirely is examined alone. Of the pixels that it covers entirely, only mixed ones are: the
   others are decided, and it owns the samples of those that are visible. So their number is that of
   all samples that it owns, less those in the pixels that are examined. */
static pixel_sums facet_pixels(visible_job *job, uint32_t facet, const lrcsi_crossings *crossings)
{
    const lrcsi_raster *r = job->raster;
    const drawn_facet f = drawn_facet_make(job, facet);
    pixel_sums sums = {0, 0, 0, 0};
    uint32_t decided = 0; /* pixels that it covers entirely */
    uint32_t visible = r->owned[facet];
    if (visible == 0 && pixels_hide_facet(job, &f)) {
        sums.hidden = HUGE_VAL;
        return sums;
    }
    mark_mixed(job, &f, crossings);
    for (uint32_t y = f.edges.bottom; y < f.edges.top; y++) {
        const uint32_t *owner = r->owner + pixel_index(job, 0, y);
        const unsigned char *mixed = job->mixed + pixel_index(job, 0, y);
        const lrcsi_pixel_span touched = job->row[y].touched;
        const lrcsi_pixel_span full = job->row[y].full;
        for (uint32_t x = touched.x0; x < touched.x1; x++) {
            if (lrcsi_span_has(full, x)) {
                x = full.x1 - 1; /* the mixed ones of these follow below */
                continue;
            }
            visible -= owner[x] == facet;
            int visibility = pixel_visibility(job, &f, x, y);
            if (visibility == PIXEL_VISIBLE) {
                sums.visible += pixel_area(&f, x, y);
            } else if (visibility == PIXEL_HIDDEN) {
                sums.hidden += pixel_area(&f, x, y);
            }
        }
        decided += full.x1 - full.x0;
        for (const unsigned char *at = mixed + full.x0;
             (at = memchr(at, 1, (size_t)(mixed + full.x1 - at))); at++) {
            uint32_t x = (uint32_t)(at - mixed);
            visible -= owner[x] == facet;
            decided -= !pixel_hidden(job, &f, x, y);
        }
    }
    sums.full_visible = visible;
    sums.full_hidden = decided - visible;
    return sums;
}

/* --- areas ------------------------------------------------------------------------------------ */

/* The area of an undecided facet, its bounds and its estimated error. The area of a pixel is
   side^2 / N^2 within a few roundings, for which 1e-12 of it is subtracted. */
static void sampled_area(lrcsi_sample_pool *pool, const pixel_sums *sums, uint32_t facet,
                         const lrcsi_crossings *crossings, lrcsi_visible_area *v)
{
    const lrcsi_raster *raster = pool->raster;
    const double area = lrcsi_view_projected(raster->view, facet);
    const double pixel = raster->pixel * raster->pixel;
    const lrcsi_visible_fraction fraction = lrcsi_visible_fraction_facet(pool, facet);
    lrcsi_sampling_error error = {HUGE_VAL, 0};
    if (!raster->order_undecided[facet] && fraction.pooled) {
        error = lrcsi_sampling_error_pooled(raster, facet, fraction.longest, fraction.fraction);
    } else if (!raster->order_undecided[facet]) {
        error = lrcsi_sampling_error_facet(pool->decisions->classification->component, raster,
                                           facet, crossings);
    }
    v->low = lrcsi_min(area, (sums->full_visible + sums->visible) * pixel * (1 - 1e-12));
    v->high = lrcsi_max(v->low, area - (sums->full_hidden + sums->hidden) * pixel * (1 - 1e-12));
    lrcsi_visible_fraction_apply(pool, facet, area, &fraction, v);
    double gap = v->high - v->low;
    v->error_estimate = lrcsi_min(gap, sqrt(error.square) * pixel);
    v->bias = lrcsi_min(gap, lrcsi_max(-gap, error.bias * pixel));
}

size_t lrcsi_visible_areas_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes(lrcsi_work_square(size), 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(visible_row)));
    need = lrcsi_work_add(need, lrcsi_visible_fraction_need(prepared));
    return lrcsi_work_add(need, lrcsi_raster_need(prepared, size, 1));
}

/* If the depth order of a facet could not be decided, its sums are 0, and nothing is certain. */
int lrcsi_visible_areas_from_samples(lrcsi_decisions *decisions, uint32_t size,
                                     lrcs_progress *progress, lrcs_work *work,
                                     lrcsi_visible_area *visible, int *depth_undecided)
{
    const lrcsi_classification *classification = decisions->classification;
    const lrcsi_view *view = classification->view;
    const uint32_t count = view->prepared->scene->facet_count;
    const size_t mark = work->used;
    lrcsi_raster raster;
    int status = lrcsi_raster_make(view, size, decisions->answer, progress, work, &raster);
    visible_job job = {.raster = &raster};
    lrcsi_crossings search = decisions->search;
    lrcsi_sample_pool pool;
    if (status == LRCS_OK) {
        job.mixed = lrcsi_work_take(work, lrcsi_work_square(size), 1);
        job.row = lrcsi_work_take(work, size, sizeof *job.row);
        status = job.mixed && job.row ? lrcsi_visible_fraction_make(decisions, &raster, work, &pool)
                                      : LRCS_E_MEMORY;
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    lrcsi_query_areas(view, decisions->answer, visible);
    *depth_undecided = memchr(raster.order_undecided, 1, count) != NULL;
    for (uint32_t f = 0;
         (f = lrcsi_marks_next(decisions->answer, f, count, LRCSI_QUERY_NO_ANSWER)) < count; f++) {
        if (!classification->undecided[f]) { /* uniform, but its query gave no answer */
            double area = lrcsi_view_projected(view, f);
            visible[f] = (lrcsi_visible_area){0.5 * area, 0, area, 0.5 * area, 0};
            *depth_undecided = 1;
            continue;
        }
        const lrcsi_crossings crossings = lrcsi_decisions_crossings(decisions, f, &search);
        pixel_sums sums = {0, 0, 0, 0};
        if (!raster.order_undecided[f]) {
            sums = facet_pixels(&job, f, &crossings);
        }
        sampled_area(&pool, &sums, f, &crossings, &visible[f]);
    }
    lrcsi_visible_fraction_correct(&pool, visible);
    work->used = mark;
    return LRCS_OK;
}
