/* SPDX-License-Identifier: MIT */
/* From samples to visible areas with bounds.

   A pixel is mixed for an undecided facet if an event edge that crosses the facet touches the
   pixel, or if a contact on the facet may lie in it. In any other pixel, the part of the facet is
   either entirely visible or entirely hidden. A sample on the facet in that pixel decides which,
   exactly. So does a sample on it in an adjacent pixel that is not mixed, because the parts of the
   facet in the two pixels are connected.

   A pixel is full if its owner covers all of it and is visible in all of it: every other facet is
   hidden there. If one facet covers a whole pixel, mixed or not, everything lower than that facet
   is hidden in the pixel, even where the facet itself is not visible (raster->occluder).

   The areas of facets in such pixels are lower bounds of what is visible and of what is hidden.
   Between the bounds of a facet, its samples decide (visibility/visible_fraction.h).

   The driver is lrcsi_visible_sampled:
   1. draw_undecided: the samples of the tiles that undecided facets touch.
   2. lrcsi_visible_answered: the areas of facets that queries decided.
   3. find_areas: the others.
      a. first_pass, for each undecided facet that owns samples: marks its mixed pixels, adds up the
         areas of pixels that are decided, lists the others, and notes full pixels.
      b. second_pass, for each undecided facet, now that all full pixels are known: the remaining
         pixels. sampled_area: the area within the bounds, and its estimated error.
   4. lrcsi_visible_fraction_correct: area that the bounds cut off goes to other facets of the
      component. */
#include "visibility/visible.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/clip.h"
#include "visibility/query.h"
#include "visibility/sample.h"
#include "visibility/sampling_error.h"
#include "visibility/visible_fraction.h"

/* --- what queries decide ---------------------------------------------------------------------- */

void lrcsi_visible_answered(const lrcsi_view *view, const unsigned char *answer,
                            lrcsi_visible *visible)
{
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (answer[f] != LRCSI_QUERY_UNDECIDED) {
            double area = answer[f] == LRCSI_QUERY_VISIBLE ? lrcsi_view_projected(view, f) : 0;
            visible[f] = (lrcsi_visible){area, area, area, 0, 0};
        }
    }
}

/* --- mixed pixels ----------------------------------------------------------------------------- */

/* The area of a facet that is certainly visible and the area that is certainly hidden, in pixels.
   Pixels that the facet covers entirely are counted, without error. The areas in other pixels are
   added up: at most 12 N of them, because a side touches at most 4 pixels in each row or column.
   Each addition rounds by at most 12 u N, less than what pixel_area subtracts from each area. */
typedef struct pixel_sums {
    uint32_t full_visible, full_hidden;
    double visible, hidden; /* hidden: HUGE_VAL if all of the facet is */
    int listed;             /* 1 if the unresolved pixels of the facet are listed; they are not in
                               these sums */
} pixel_sums;

/* Data that all facets of a raster share. */
typedef struct visible_job {
    const lrcsi_known *known;
    lrcsi_raster *raster;
    lrcsi_row_spans *row; /* by row: the spans of the current facet, in the rows that it touches */
    unsigned char *mixed; /* by pixel: 1 if mixed for the current facet; set where it touches */
    pixel_sums *first;    /* by undecided facet: the result of first_pass */
    /* The pixels in which first_pass decides nothing, facet after facet: 2 pixel + 1 if the facet
       covers the whole pixel, otherwise 2 pixel; LRCS_NONE ends the list of a facet. */
    uint32_t *unresolved;
    size_t unresolved_room, unresolved_count;
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

static drawn_facet drawn_facet_make(const lrcsi_raster *r, uint32_t facet)
{
    const uint32_t *corner = r->view->prepared->scene->facet[facet].corner;
    drawn_facet f = {
        .facet = facet, .edges = lrcsi_raster_edge_functions(r, facet), .high = -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(r, corner[r->view->facing[facet] > 0 ? k : 2 - k], f.corner[k]);
        const double *x = r->view->point[corner[k]].x;
        f.high = lrcsi_max(f.high, x[2] + lrcsi_view_point_err(x));
    }
    f.plane = lrcsi_raster_plane(r, facet);
    f.rise = 0.5 * (fabs(f.plane.dx) + fabs(f.plane.dy)) + lrcsi_raster_height_err(r, facet);
    return f;
}

static size_t pixel_index(const visible_job *job, uint32_t x, uint32_t y)
{
    return (size_t)y * job->raster->size + x;
}

/* Marks every pixel of the facet that an edge may touch. The coordinates of its ends have errors of
   at most a quarter of the margin, by which rows and ranges are widened (visibility/span.h). */
static void mark_edge(const visible_job *job, const drawn_facet *f, uint32_t edge)
{
    const lrcsi_edge *e = &job->raster->view->prepared->topology.edge[edge];
    const double bottom = f->edges.bottom;
    const double top = f->edges.top;
    double a[2];
    double b[2];
    const double a_err = lrcsi_raster_point(job->raster, e->low, a);
    const double b_err = lrcsi_raster_point(job->raster, e->high, b);
    const double margin = 4 * lrcsi_max(a_err, b_err);
    const lrcsi_segment s = lrcsi_span_segment(a, b, margin);
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

/* Marks the pixels that both facets touch and in which their planes may intersect: those in which
   the difference of their heights, row + dx (x + 1/2), may be 0. It varies by |dx| / 2 + |dy| / 2
   within a pixel, and `err` includes that. In each row only the range around the zero is examined:
   it is widened by two pixels and 8 roundings on either side. If the division gives no number, the
   range stays as it is. */
static void mark_intersection(const visible_job *job, const drawn_facet *f, uint32_t other)
{
    const lrcsi_raster *r = job->raster;
    const lrcsi_plane p = lrcsi_raster_plane(r, f->facet);
    const lrcsi_plane q = lrcsi_raster_plane(r, other);
    const lrcsi_edge_functions e = lrcsi_raster_edge_functions(r, other);
    const double dx = p.dx - q.dx;
    const double dy = p.dy - q.dy;
    const double err = lrcsi_raster_height_err(r, f->facet) + lrcsi_raster_height_err(r, other) +
                       0.51 * (fabs(dx) + fabs(dy));
    uint32_t bottom = e.bottom > f->edges.bottom ? e.bottom : f->edges.bottom;
    for (uint32_t y = bottom; y < f->edges.top && y < e.top; y++) {
        double row = p.c - q.c + dy * (y + 0.5);
        double x0 = job->row[y].touched.x0;
        double x1 = job->row[y].touched.x1;
        double zero = -row / dx;
        double half = err / fabs(dx);
        double widening = 2 + 8 * LRCSI_U * (fabs(zero) + half);
        if (zero - half - widening > x0) {
            x0 = floor(zero - half - widening);
        }
        if (zero + half + widening < x1) {
            x1 = ceil(zero + half + widening);
        }
        if (!(x0 < x1)) {
            continue;
        }
        lrcsi_pixel_span touched = lrcsi_span_touched(&e, y);
        x1 = lrcsi_min(x1, touched.x1);
        for (double x = lrcsi_max(x0, touched.x0); x < x1; x++) {
            if (!(fabs(row + dx * (x + 0.5)) > err)) {
                job->mixed[pixel_index(job, (uint32_t)x, y)] = 1;
            }
        }
    }
}

/* The event edges that cross a facet; they may be those of classification->crossing. */
static const uint32_t *known_crossings(const lrcsi_known *k, uint32_t facet, uint32_t *count)
{
    if (facet < k->listed) {
        *count = k->first[facet + 1] - k->first[facet];
        return k->crossing + k->first[facet];
    }
    *count = lrcsi_classify_crossings(k->classification, facet, NULL);
    return k->classification->crossing;
}

/* Finds the spans of a facet, and marks the pixels that are mixed for it. */
static void mark_mixed(const visible_job *job, const drawn_facet *f)
{
    const lrcsi_view *view = job->raster->view;
    const lrcs_prepared *p = view->prepared;
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        lrcsi_row_spans row = job->row[y] = lrcsi_span_row(&f->edges, y);
        memset(job->mixed + pixel_index(job, row.touched.x0, y), 0,
               row.touched.x1 - row.touched.x0);
    }
    uint32_t crossings;
    const uint32_t *crossing = known_crossings(job->known, f->facet, &crossings);
    for (uint32_t i = 0; i < crossings; i++) {
        mark_edge(job, f, crossing[i]);
    }
    const lrcsi_intersections *contacts = &p->intersections;
    for (uint32_t i = contacts->first[f->facet]; i < contacts->first[f->facet + 1]; i++) {
        const lrcsi_intersection *contact = &contacts->entry[i];
        if (!lrcsi_intersection_hides(view, f->facet, contact)) {
            continue;
        }
        if (contact->kind == LRCSI_INTERSECTION_CROSS) {
            mark_intersection(job, f, contact->other);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            mark_edge(job, f, p->topology.facet_edge[contact->other].corner[k]);
        }
    }
}

/* --- decided pixels --------------------------------------------------------------------------- */

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

   If one side alone passes through the pixel: an error of value_err moves the line by value_err /
   |gradient|, and the area by that times the length of the line in the pixel, which is below 1.5.
   Roundings are below 8 u, and value_err is at least 64 u N h.

   Otherwise, the corners have errors of position_err in each coordinate. The area then has an error
   of at most 4 position_err: the extents of the sides within the pixel, along both axes together.
   Roundings (visibility/clip.h) are less than another 4 position_err, because position_err is more
   than 8 u of the distance of a corner from any pixel, and more than 16 u. */
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

/* Is the facet certainly hidden in the whole pixel: because another one is visible in all of it, or
   because one that covers all of it is higher everywhere? */
static int pixel_hidden(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    const lrcsi_raster *r = job->raster;
    const size_t pixel = pixel_index(job, x, y);
    const double height = f->plane.c + f->plane.dx * (x + 0.5) + f->plane.dy * (y + 0.5);
    return (r->full[pixel] && r->owner[pixel] != f->facet) ||
           (double)r->occluder[pixel] > lrcsi_min(f->high, height + f->rise);
}

enum { PIXEL_HIDDEN, PIXEL_VISIBLE, PIXEL_UNRESOLVED };

/* Is the part of a facet in a pixel certainly visible or certainly hidden? Decided by what covers
   the pixel; if it is not mixed, by a sample of the facet in it or in an adjacent pixel that is not
   mixed either. Coordinates below 0 wrap round, and are then outside the facet's rows or spans. */
static int pixel_visibility(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    if (pixel_hidden(job, f, x, y)) {
        return PIXEL_HIDDEN;
    }
    if (job->mixed[pixel_index(job, x, y)]) {
        return PIXEL_UNRESOLVED;
    }
    const uint32_t sample[5][2] = {{x, y}, {x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}};
    for (int i = 0; i < 5; i++) {
        uint32_t sx = sample[i][0];
        uint32_t sy = sample[i][1];
        if (sy >= f->edges.bottom && sy < f->edges.top &&
            lrcsi_span_has(job->row[sy].certain, sx) && !job->mixed[pixel_index(job, sx, sy)]) {
            return job->raster->owner[pixel_index(job, sx, sy)] == f->facet ? PIXEL_VISIBLE
                                                                            : PIXEL_HIDDEN;
        }
    }
    return PIXEL_UNRESOLVED;
}

/* Adds a pixel to the list of unresolved ones; if there is no room, it is only counted. */
static void unresolved_add(visible_job *job, size_t pixel, uint32_t full)
{
    if (job->unresolved_count < job->unresolved_room) {
        job->unresolved[job->unresolved_count] = 2 * (uint32_t)pixel + full;
    }
    job->unresolved_count++;
}

/* Adds up the pixels of a facet that are decided, and lists the others. Pixels that it covers
   entirely and in which it is visible are noted as full. */
static pixel_sums sum_pixels(visible_job *job, const drawn_facet *f)
{
    const lrcsi_raster *r = job->raster;
    pixel_sums sums = {0, 0, 0, 0, 0};
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        const size_t row = pixel_index(job, 0, y);
        const lrcsi_pixel_span touched = job->row[y].touched;
        lrcsi_pixel_span full = job->row[y].full;
        if (full.x0 == full.x1) { /* an empty span may lie anywhere */
            full = (lrcsi_pixel_span){touched.x1, touched.x1};
        }
        for (uint32_t x = touched.x0; x < touched.x1; x++) {
            /* Nearly all pixels are covered entirely: this loop does little in each of them. */
            for (; x >= full.x0 && x < full.x1; x++) {
                uint32_t visible = r->owner[row + x] == f->facet;
                uint32_t decided = job->mixed[row + x] == 0;
                if (decided == 0) {
                    decided = (uint32_t)pixel_hidden(job, f, x, y);
                    visible &= decided ^ 1;
                }
                sums.full_visible += decided & visible;
                sums.full_hidden += decided & (visible ^ 1);
                r->full[row + x] |= (unsigned char)(decided & visible);
                if (decided == 0) {
                    unresolved_add(job, row + x, 1);
                }
            }
            if (x >= touched.x1) {
                break;
            }
            int visibility = pixel_visibility(job, f, x, y);
            if (visibility == PIXEL_UNRESOLVED) {
                unresolved_add(job, row + x, 0);
            } else if (visibility == PIXEL_VISIBLE) {
                sums.visible += pixel_area(f, x, y);
            } else {
                sums.hidden += pixel_area(f, x, y);
            }
        }
    }
    return sums;
}

/* The sums of a facet before all full pixels are known. Its unresolved pixels are listed if there
   is room for all of them. */
static pixel_sums first_pass(visible_job *job, uint32_t facet)
{
    const drawn_facet f = drawn_facet_make(job->raster, facet);
    const size_t start = job->unresolved_count;
    mark_mixed(job, &f);
    pixel_sums sums = sum_pixels(job, &f);
    sums.listed = job->unresolved_count < job->unresolved_room;
    if (sums.listed) {
        job->unresolved[job->unresolved_count++] = LRCS_NONE;
    } else {
        job->unresolved_count = start;
    }
    return sums;
}

/* Is all of a facet certainly hidden, pixel by pixel? */
static int pixels_hide_facet(const visible_job *job, const drawn_facet *f)
{
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        const lrcsi_pixel_span touched = lrcsi_span_touched(&f->edges, y);
        for (uint32_t x = touched.x0; x < touched.x1; x++) {
            if (!pixel_hidden(job, f, x, y)) {
                return 0;
            }
        }
    }
    return 1;
}

/* The sums of a facet when all full pixels are known: a facet is hidden in the unresolved pixels in
   which others are visible. *next: where its unresolved pixels are listed; it advances to those of
   the next facet. The sums of a facet without a list are computed anew. */
static pixel_sums second_pass(visible_job *job, uint32_t facet, size_t *next)
{
    const lrcsi_raster *r = job->raster;
    pixel_sums sums = job->first[facet];
    drawn_facet f = {.facet = LRCS_NONE};
    if (!sums.listed) {
        f = drawn_facet_make(r, facet);
        if (r->owned[facet] == 0 && pixels_hide_facet(job, &f)) {
            return (pixel_sums){.hidden = HUGE_VAL};
        }
        job->unresolved_count = job->unresolved_room; /* no list is needed any more */
        mark_mixed(job, &f);
        return sum_pixels(job, &f);
    }
    for (uint32_t entry; (entry = job->unresolved[(*next)++]) != LRCS_NONE;) {
        const size_t pixel = entry / 2;
        if (!r->full[pixel] || r->owner[pixel] == facet) {
            continue;
        }
        if (entry % 2 != 0) {
            sums.full_hidden++;
            continue;
        }
        if (f.facet != facet) {
            f = drawn_facet_make(r, facet);
        }
        sums.hidden += pixel_area(&f, (uint32_t)(pixel % r->size), (uint32_t)(pixel / r->size));
    }
    return sums;
}

/* --- areas ------------------------------------------------------------------------------------ */

/* The area of an undecided facet, its bounds and its estimated error. The area of a pixel is
   side^2 / N^2 within a few roundings, for which 1e-12 of it is subtracted. If a depth order of the
   facet could not be decided, its sums are 0, and nothing is certain. */
static void sampled_area(const lrcsi_sample_pool *pool, const pixel_sums *sums, uint32_t facet,
                         lrcsi_visible *v)
{
    const lrcsi_raster *raster = pool->raster;
    const double area = lrcsi_view_projected(raster->view, facet);
    const double pixel = raster->pixel * raster->pixel;
    const lrcsi_visible_fraction fraction = lrcsi_visible_fraction_facet(pool, facet);
    lrcsi_sampling_error error = {HUGE_VAL, 0};
    if (!raster->undecided[facet] && fraction.pooled) {
        error = lrcsi_sampling_error_pooled(raster, facet, fraction.longest, fraction.fraction);
    } else if (!raster->undecided[facet]) {
        uint32_t crossings;
        const uint32_t *crossing = known_crossings(pool->known, facet, &crossings);
        error = lrcsi_sampling_error_facet(pool->known->classification->component, raster, facet,
                                           crossing, crossings);
    }
    v->low = lrcsi_min(area, (sums->full_visible + sums->visible) * pixel * (1 - 1e-12));
    v->high = lrcsi_max(v->low, area - (sums->full_hidden + sums->hidden) * pixel * (1 - 1e-12));
    lrcsi_visible_fraction_apply(pool, facet, area, &fraction, v);
    double gap = v->high - v->low;
    v->error_estimate = lrcsi_min(gap, sqrt(error.square) * pixel);
    v->bias = lrcsi_min(gap, lrcsi_max(-gap, error.bias * pixel));
}

/* Room for crossings: more than ordinary scenes have. The crossings of facets beyond it are
   searched for whenever they are needed. */
static size_t known_room(const lrcs_prepared *prepared)
{
    return 4 * (size_t)prepared->scene->facet_count;
}

size_t lrcsi_visible_known_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(facets, 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets + 1, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(known_room(prepared), sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_grid_facets_need(prepared));
}

/* Queries of uniform facets come first. For each of the others, one search for the event edges that
   cross it serves two purposes: to prove that it is hidden, and as a list for rasters. */
int lrcsi_visible_known(lrcsi_classification *classification, lrcs_work *work, lrcsi_known *known)
{
    size_t mark = work->used;
    const lrcs_prepared *p = classification->view->prepared;
    uint32_t count = p->scene->facet_count;
    lrcsi_known k = {.classification = classification};
    k.answer = lrcsi_work_take(work, count, 1);
    k.first = lrcsi_work_take(work, (size_t)count + 1, sizeof *k.first);
    k.crossing = lrcsi_work_take(work, known_room(p), sizeof *k.crossing);
    int status = k.answer && k.first && k.crossing
                     ? lrcsi_query_uniform(classification, NULL, work, &k.facets, k.answer)
                     : LRCS_E_MEMORY;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    k.first[0] = 0;
    for (uint32_t f = 0; f < count; f++) {
        uint32_t crossings = 0;
        if (classification->undecided[f] &&
            !lrcsi_query_screened(classification, &k.facets, f, NULL)) {
            k.answer[f] = LRCSI_QUERY_UNDECIDED;
            crossings = k.listed == f ? lrcsi_classify_crossings(classification, f, NULL) : 0;
        }
        if (k.listed == f && crossings <= known_room(p) - k.first[f]) {
            memcpy(k.crossing + k.first[f], classification->crossing,
                   crossings * sizeof *k.crossing);
            k.first[f + 1] = k.first[f] + crossings;
            k.listed++;
        }
    }
    *known = k;
    return LRCS_OK;
}

/* Room for unresolved pixels: more than ordinary scenes have. Facets beyond it are computed twice.
 */
static size_t unresolved_room(const lrcs_prepared *prepared, uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_square(size) / 2, 2 * (size_t)prepared->scene->facet_count);
}

size_t lrcsi_visible_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes(lrcsi_work_square(size), 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(lrcsi_work_square(size), sizeof(float)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(lrcsi_row_spans)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(prepared->scene->facet_count, sizeof(pixel_sums)));
    need =
        lrcsi_work_add(need, lrcsi_work_bytes(unresolved_room(prepared, size), sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_visible_fraction_need(prepared));
    return lrcsi_work_add(need, lrcsi_raster_need(prepared, size));
}

/* Draws the samples of the tiles that undecided facets touch. Facets proved visible own all samples
   that they cover; facets proved hidden own none and are not drawn. */
static void draw_undecided(const lrcsi_known *known, lrcsi_raster *raster)
{
    uint32_t count = raster->view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_UNDECIDED) {
            lrcsi_raster_activate(raster, f);
        }
    }
    lrcsi_raster_clear(raster);
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_VISIBLE) {
            lrcsi_raster_fill(raster, f);
        }
    }
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_UNDECIDED) {
            lrcsi_raster_draw(raster, f);
        }
    }
}

/* Finds the areas of the facets that queries left undecided. */
static void find_areas(visible_job *job, const lrcsi_sample_pool *pool, lrcsi_visible *visible)
{
    const lrcsi_known *known = job->known;
    const unsigned char *undecided = known->classification->undecided;
    lrcsi_raster *raster = job->raster;
    const uint32_t count = raster->view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_UNDECIDED && undecided[f]) {
            job->first[f].listed = 0;
            if (raster->owned[f] != 0 && !raster->undecided[f]) {
                job->first[f] = first_pass(job, f);
            }
        }
    }
    size_t next = 0;
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] != LRCSI_QUERY_UNDECIDED) {
            continue;
        }
        if (!undecided[f]) { /* uniform, but its query gave no answer */
            double area = lrcsi_view_projected(raster->view, f);
            raster->undecided[f] = 1;
            visible[f] = (lrcsi_visible){0.5 * area, 0, area, 0.5 * area, 0};
            continue;
        }
        pixel_sums sums = {0, 0, 0, 0, 0};
        if (!raster->undecided[f]) {
            sums = second_pass(job, f, &next);
        }
        sampled_area(pool, &sums, f, &visible[f]);
    }
}

int lrcsi_visible_sampled(const lrcsi_known *known, uint32_t size, lrcs_work *work,
                          lrcsi_raster *raster, lrcsi_visible *visible)
{
    const lrcsi_view *view = known->classification->view;
    const lrcs_prepared *prepared = view->prepared;
    const size_t pixels = lrcsi_work_square(size);
    const size_t mark = work->used;
    int status = lrcsi_raster_start(view, size, work, raster);
    if (status != LRCS_OK) {
        return status;
    }
    const size_t end = work->used;
    visible_job job = {.known = known, .raster = raster};
    lrcsi_sample_pool pool;
    job.mixed = lrcsi_work_take(work, pixels, 1);
    raster->occluder = lrcsi_work_take(work, pixels, sizeof *raster->occluder);
    job.row = lrcsi_work_take(work, size, sizeof *job.row);
    job.first = lrcsi_work_take(work, prepared->scene->facet_count, sizeof *job.first);
    job.unresolved_room = unresolved_room(prepared, size);
    job.unresolved = lrcsi_work_take(work, job.unresolved_room, sizeof *job.unresolved);
    if (!job.mixed || !raster->occluder || !job.row || !job.first || !job.unresolved ||
        lrcsi_visible_fraction_make(known, raster, work, &pool) != LRCS_OK) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    draw_undecided(known, raster);
    lrcsi_visible_answered(view, known->answer, visible);
    find_areas(&job, &pool, visible);
    lrcsi_visible_fraction_correct(&pool, visible);
    raster->occluder = NULL;
    work->used = end;
    return LRCS_OK;
}
