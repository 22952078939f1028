/* SPDX-License-Identifier: MIT */
/* From samples to areas with bounds. A pixel is mixed for an undecided facet if an event edge that
   crosses the facet touches it, or a contact on the facet may lie in it. In any other pixel the
   part of the facet is either entirely visible or entirely hidden. A sample on the facet in that
   pixel decides which, exactly; so does a sample in a neighbouring pixel that is not mixed, because
   the facet's parts in the two pixels are connected. A pixel that one visible facet covers whole is
   pure: all other facets are hidden there. Where one facet covers a whole pixel, mixed or not,
   everything lower than that facet is hidden in the pixel, even if the facet itself is not visible.
   These pixels bound the area from below and above; between the bounds the samples decide
   (visibility/visible_fraction.h).

   The driver is lrcsi_visible_sampled:
   1. known_draw: the samples of the tiles that undecided facets touch.
   2. certain_begin: each undecided facet that owns samples has its mixed pixels marked and the
   others counted; pixels that it proves pure are noted.
   3. drawn_area: the bounds of each undecided facet, with all pure pixels known; its area and its
      likely error.
   4. lrcsi_visible_fraction_correct: what bounds cut off goes to other facets of the component. */
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

/* --- answers ---------------------------------------------------------------------------------- */

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
   Pixels that the facet covers whole are counted exactly. The areas in other pixels are added up,
   at most 12 N of them (a side touches at most 4 pixels in each row or column). So each addition
   rounds by at most 12 u N, which is less than the margin subtracted from each area. */
typedef struct pixel_sums {
    uint32_t whole_visible, whole_hidden;
    double visible, hidden; /* hidden: HUGE_VAL if all of the facet is */
    int listed;             /* the facet's open pixels are listed, and not in these sums */
} pixel_sums;

/* What the facets of one raster share. */
typedef struct visible_job {
    const lrcsi_known *known;
    lrcsi_raster *raster;
    lrcsi_row *row;       /* row of the raster, of those that the facet at hand touches */
    unsigned char *mixed; /* pixel of the raster, of those touched: mixed for that facet */
    pixel_sums *begun;    /* undecided facet: what certain_begin found */
    /* Open pixels: those of which nothing is certain yet, facet after facet. 2 place + 1 if the
       facet covers all of the pixel, else 2 place; LRCS_NONE ends those of a facet. */
    uint32_t *open;
    size_t open_room, open_count;
} visible_job;

/* The facet at hand. */
typedef struct drawn_facet {
    uint32_t facet;
    lrcsi_edges edges;
    double corner[3][2]; /* in pixels, counter-clockwise */
    lrcsi_plane plane;
    double rise; /* how much higher a point of it in a pixel may be than its plane at the centre */
    double high; /* upper bound of its heights */
} drawn_facet;

static drawn_facet drawn_facet_of(const lrcsi_raster *r, uint32_t facet)
{
    const uint32_t *corner = r->view->prepared->scene->facet[facet].corner;
    drawn_facet f = {.facet = facet, .edges = lrcsi_raster_edges(r, facet), .high = -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(r, corner[r->view->facing[facet] > 0 ? k : 2 - k], f.corner[k]);
        const double *x = r->view->point[corner[k]].x;
        f.high = lrcsi_max(f.high, x[2] + lrcsi_view_point_err(x));
    }
    f.plane = lrcsi_raster_plane(r, facet);
    f.rise = 0.5 * (fabs(f.plane.along) + fabs(f.plane.up)) + lrcsi_raster_slack(r, facet);
    return f;
}

static size_t pixel_place(const visible_job *job, uint32_t x, uint32_t y)
{
    return (size_t)y * job->raster->size + x;
}

/* Marks every pixel of the facet that an edge may touch. The coordinates of its ends have errors of
   at most a fourth of the margin, which widens rows and ranges (visibility/span.h). */
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
            memset(job->mixed + pixel_place(job, x0, y), 1, x1 - x0);
        }
    }
}

/* Narrows the range *x0 .. *x1 - 1 to the pixels of a row in which a height may be 0, given that
   the height is row + along (x + 1/2) to within slack. The range is widened by two pixels and 8
   roundings on either side; where the division gives no number, the range stays. */
static void level_narrow(double row, double along, double slack, double *x0, double *x1)
{
    double middle = -row / along;
    double half = slack / fabs(along);
    double spare = 2 + 8 * LRCSI_U * (fabs(middle) + half);
    if (middle - half - spare > *x0) {
        *x0 = floor(middle - half - spare);
    }
    if (middle + half + spare < *x1) {
        *x1 = ceil(middle + half + spare);
    }
}

/* Marks the pixels of both facets in which their planes may intersect: where the difference of
   heights does not have one sign for certain over the whole pixel. In each row the range where it
   may be 0 is found first, so that only the line of intersection is followed. */
static void mark_intersection(const visible_job *job, const drawn_facet *f, uint32_t other)
{
    const lrcsi_raster *r = job->raster;
    const lrcsi_plane p = lrcsi_raster_plane(r, f->facet);
    const lrcsi_plane q = lrcsi_raster_plane(r, other);
    const lrcsi_edges e = lrcsi_raster_edges(r, other);
    const double along = p.along - q.along;
    const double up = p.up - q.up;
    const double slack = lrcsi_raster_slack(r, f->facet) + lrcsi_raster_slack(r, other) +
                         0.51 * (fabs(along) + fabs(up));
    uint32_t bottom = e.bottom > f->edges.bottom ? e.bottom : f->edges.bottom;
    for (uint32_t y = bottom; y < f->edges.top && y < e.top; y++) {
        double row = p.at - q.at + up * (y + 0.5);
        double x0 = job->row[y].touched.x0;
        double x1 = job->row[y].touched.x1;
        level_narrow(row, along, slack, &x0, &x1);
        if (!(x0 < x1)) {
            continue;
        }
        lrcsi_pixels touched = lrcsi_span_touched(&e, y);
        x1 = lrcsi_min(x1, touched.x1);
        for (double x = lrcsi_max(x0, touched.x0); x < x1; x++) {
            if (!(fabs(row + along * (x + 0.5)) > slack)) {
                job->mixed[pixel_place(job, (uint32_t)x, y)] = 1;
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

/* Finds the pixels that a facet touches, and marks those that are mixed for it. */
static void mark_facet(const visible_job *job, const drawn_facet *f)
{
    const lrcsi_view *view = job->raster->view;
    const lrcs_prepared *p = view->prepared;
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        lrcsi_row row = job->row[y] = lrcsi_span_row(&f->edges, y);
        memset(job->mixed + pixel_place(job, row.touched.x0, y), 0,
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

/* --- what is certain -------------------------------------------------------------------------- */

/* The part of a unit square where a linear function that is `value` at its centre, and changes by
   most >= least >= 0 along its sides, is positive. */
static double square_part(double value, double most, double least)
{
    double from = fabs(value);
    double beyond = 0.5 * (most + least) - from;
    double less = beyond >= least ? 0.5 - from / most
                  : beyond > 0    ? 0.5 * (beyond / most) * (beyond / least)
                                  : 0;
    return value > 0 ? 1 - less : less;
}

/* How much a facet surely covers of a pixel that it may not cover whole. Where one side alone
   passes through it: a value that is too large by off moves the line by off / |gradient|, and the
   area by that times its length in the pixel, below 1.5; roundings are below 8 u, and off is at
   least 64 u N h. Otherwise corners are off by their position error in each coordinate, and the
   area by at most 4 times that, as far as sides run within the pixel along both axes together.
   Roundings (visibility/clip.h) are less than another 4 times: a position error is more than 8 u of
   a corner's distance from any pixel, and more than 16 u. */
static double pixel_part(const drawn_facet *f, uint32_t x, uint32_t y)
{
    const lrcsi_edges *e = &f->edges;
    int sides = 0;
    double part = 0;
    for (int k = 0; k < 3; k++) {
        double along = fabs(e->along[k]);
        double up = fabs(e->up[k]);
        double value = e->at[k] + e->along[k] * (x + 0.5) + e->up[k] * (y + 0.5);
        if (!(value - 0.5 * (along + up) > e->off)) {
            double most = lrcsi_max(along, up);
            sides++;
            part = square_part(value, most, lrcsi_min(along, up)) - 2 * e->off / most;
        }
    }
    if (sides != 1) {
        const double low[2] = {x, y};
        part = lrcsi_clip_box_area((const double(*)[2])f->corner, low) - 8 * e->position_err;
    }
    return lrcsi_max(0, part);
}

enum { SAMPLE_HIDDEN, SAMPLE_VISIBLE, SAMPLE_NONE };

/* Whether the sample of a pixel shows that the facet is visible there. It does not if the pixel is
   mixed or the facet may not cover the sample. Coordinates below 0 wrap round and are outside. */
static int sample_visibility(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    if (y < f->edges.bottom || y >= f->edges.top || !lrcsi_span_has(job->row[y].sure, x) ||
        job->mixed[pixel_place(job, x, y)]) {
        return SAMPLE_NONE;
    }
    return job->raster->owner[pixel_place(job, x, y)] == f->facet ? SAMPLE_VISIBLE : SAMPLE_HIDDEN;
}

/* Is the facet certainly hidden in the whole pixel: because another one is visible all over it, or
   because one that covers it is higher everywhere? */
static int pixel_hides(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    const lrcsi_raster *r = job->raster;
    const size_t place = pixel_place(job, x, y);
    const double height = f->plane.at + f->plane.along * (x + 0.5) + f->plane.up * (y + 0.5);
    return (r->pure[place] && r->owner[place] != f->facet) ||
           (double)r->occluded[place] > lrcsi_min(f->high, height + f->rise);
}

/* Whether the part of a facet in a pixel is certainly visible or certainly hidden: decided by what
   covers the pixel, by its sample, or else by the sample of a neighbouring pixel. */
static int pixel_visibility(const visible_job *job, const drawn_facet *f, uint32_t x, uint32_t y)
{
    if (pixel_hides(job, f, x, y)) {
        return SAMPLE_HIDDEN;
    }
    if (job->mixed[pixel_place(job, x, y)]) {
        return SAMPLE_NONE;
    }
    int found = sample_visibility(job, f, x, y);
    found = found == SAMPLE_NONE ? sample_visibility(job, f, x - 1, y) : found;
    found = found == SAMPLE_NONE ? sample_visibility(job, f, x + 1, y) : found;
    found = found == SAMPLE_NONE ? sample_visibility(job, f, x, y - 1) : found;
    return found == SAMPLE_NONE ? sample_visibility(job, f, x, y + 1) : found;
}

/* Lists a pixel as open; where there is no room it is only counted. */
static void open_add(visible_job *job, size_t place, uint32_t whole)
{
    if (job->open_count < job->open_room) {
        job->open[job->open_count] = 2 * (uint32_t)place + whole;
    }
    job->open_count++;
}

/* Adds up the pixels of a facet of which something is certain, and lists the others. Pixels that it
   covers whole and is visible in are noted as pure. */
static pixel_sums certain_sums(visible_job *job, const drawn_facet *f)
{
    const lrcsi_raster *r = job->raster;
    pixel_sums sums = {0, 0, 0, 0, 0};
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        const size_t row = pixel_place(job, 0, y);
        const lrcsi_pixels touched = job->row[y].touched;
        lrcsi_pixels whole = job->row[y].whole;
        if (whole.x0 == whole.x1) { /* it may be anywhere then */
            whole = (lrcsi_pixels){touched.x1, touched.x1};
        }
        for (uint32_t x = touched.x0; x < touched.x1; x++) {
            if (x == whole.x0) {
                for (; x < whole.x1; x++) { /* most pixels, and few operations each */
                    uint32_t own = r->owner[row + x] == f->facet;
                    uint32_t decided = job->mixed[row + x] == 0;
                    if (decided == 0) {
                        decided = (uint32_t)pixel_hides(job, f, x, y);
                        own &= decided ^ 1;
                    }
                    sums.whole_visible += decided & own;
                    sums.whole_hidden += decided & (own ^ 1);
                    r->pure[row + x] |= (unsigned char)(decided & own);
                    if (decided == 0) {
                        open_add(job, row + x, 1);
                    }
                }
                if (x >= touched.x1) {
                    break;
                }
            }
            int decided = pixel_visibility(job, f, x, y);
            if (decided == SAMPLE_NONE) {
                open_add(job, row + x, 0);
            } else {
                *(decided == SAMPLE_VISIBLE ? &sums.visible : &sums.hidden) += pixel_part(f, x, y);
            }
        }
    }
    return sums;
}

/* Is all of a facet certainly hidden, pixel by pixel? */
static int pixels_hide_facet(const visible_job *job, const drawn_facet *f)
{
    for (uint32_t y = f->edges.bottom; y < f->edges.top; y++) {
        const lrcsi_pixels touched = lrcsi_span_touched(&f->edges, y);
        for (uint32_t x = touched.x0; x < touched.x1; x++) {
            if (!pixel_hides(job, f, x, y)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Begins a facet: its sums and its open pixels, if there is room for these. */
static pixel_sums certain_begin(visible_job *job, uint32_t facet)
{
    const drawn_facet f = drawn_facet_of(job->raster, facet);
    const size_t first = job->open_count;
    mark_facet(job, &f);
    pixel_sums sums = certain_sums(job, &f);
    sums.listed = job->open_count < job->open_room;
    if (sums.listed) {
        job->open[job->open_count++] = LRCS_NONE;
    } else {
        job->open_count = first;
    }
    return sums;
}

/* Ends it, once all pure pixels are known: open pixels that other facets are visible in are hidden.
   *read: where its open pixels are listed; it moves on to those of the next facet. A facet without
   a list is measured anew. */
static pixel_sums certain_end(visible_job *job, uint32_t facet, size_t *read)
{
    const lrcsi_raster *r = job->raster;
    pixel_sums sums = job->begun[facet];
    drawn_facet f = {.facet = LRCS_NONE};
    uint32_t open;
    if (!sums.listed) {
        f = drawn_facet_of(r, facet);
        if (r->owned[facet] == 0 && pixels_hide_facet(job, &f)) {
            return (pixel_sums){.hidden = HUGE_VAL};
        }
        job->open_count = job->open_room; /* nobody asks again */
        mark_facet(job, &f);
        return certain_sums(job, &f);
    }
    while ((open = job->open[(*read)++]) != LRCS_NONE) {
        const size_t place = open / 2;
        if (!r->pure[place] || r->owner[place] == facet) {
            continue;
        }
        if (open % 2 != 0) {
            sums.whole_hidden++;
            continue;
        }
        if (f.facet != facet) {
            f = drawn_facet_of(r, facet);
        }
        sums.hidden += pixel_part(&f, (uint32_t)(place % r->size), (uint32_t)(place / r->size));
    }
    return sums;
}

/* --- areas ------------------------------------------------------------------------------------ */

/* The area of an undecided facet. Pixel areas are side^2 / N^2 to a few roundings; 1e-12 of them is
   given away. Where a depth was undecided nothing is certain. */
static void drawn_area(const lrcsi_sharing *sharing, const pixel_sums *sums, uint32_t facet,
                       lrcsi_visible *v)
{
    const lrcsi_raster *raster = sharing->raster;
    const double area = lrcsi_view_projected(raster->view, facet);
    const double pixel = raster->pixel * raster->pixel;
    const lrcsi_visible_fraction fraction = lrcsi_visible_fraction_facet(sharing, facet);
    lrcsi_sampling_error error = {HUGE_VAL, 0};
    if (!raster->undecided[facet] && fraction.row) {
        error = lrcsi_sampling_error_row(raster, facet, fraction.longest, fraction.fraction);
    } else if (!raster->undecided[facet]) {
        uint32_t crossings;
        const uint32_t *crossing = known_crossings(sharing->known, facet, &crossings);
        error = lrcsi_sampling_error_facet(sharing->known->classification->component, raster, facet,
                                           crossing, crossings);
    }
    v->low = lrcsi_min(area, (sums->whole_visible + sums->visible) * pixel * (1 - 1e-12));
    v->high = lrcsi_max(v->low, area - (sums->whole_hidden + sums->hidden) * pixel * (1 - 1e-12));
    lrcsi_visible_fraction_keep(sharing, facet, area, &fraction, v);
    double gap = v->high - v->low;
    v->likely = lrcsi_min(gap, sqrt(error.square) * pixel);
    v->bias = lrcsi_min(gap, lrcsi_max(-gap, error.bias * pixel));
}

/* Room for crossings: more than ordinary scenes have. Those of facets beyond it are searched for
   whenever they are needed. */
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

/* Uniform facets are asked first. Of the others one search for what crosses them serves to prove
   that they are hidden, and is listed for the rasters. */
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

/* Room for open pixels: more than ordinary scenes have. Facets beyond it are measured twice. */
static size_t open_room(const lrcs_prepared *prepared, uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_square(size) / 2, 2 * (size_t)prepared->scene->facet_count);
}

size_t lrcsi_visible_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes(lrcsi_work_square(size), 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(lrcsi_work_square(size), sizeof(float)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(lrcsi_row)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(prepared->scene->facet_count, sizeof(pixel_sums)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(open_room(prepared, size), sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_visible_fraction_need(prepared));
    return lrcsi_work_add(need, lrcsi_raster_need(prepared, size));
}

static int visible_start(visible_job *job, lrcs_work *work)
{
    const lrcs_prepared *p = job->raster->view->prepared;
    const uint32_t size = job->raster->size;
    job->mixed = lrcsi_work_take(work, lrcsi_work_square(size), 1);
    job->raster->occluded =
        lrcsi_work_take(work, lrcsi_work_square(size), sizeof *job->raster->occluded);
    job->row = lrcsi_work_take(work, size, sizeof *job->row);
    job->begun = lrcsi_work_take(work, p->scene->facet_count, sizeof *job->begun);
    job->open_room = open_room(p, size);
    job->open = lrcsi_work_take(work, job->open_room, sizeof *job->open);
    return job->mixed && job->raster->occluded && job->row && job->begun && job->open
               ? LRCS_OK
               : LRCS_E_MEMORY;
}

/* Facets proved hidden own no samples; those proved visible own all of theirs. Only the tiles of
   the others matter. */
static void known_draw(const lrcsi_known *known, lrcsi_raster *raster)
{
    uint32_t count = raster->view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_UNDECIDED) {
            lrcsi_raster_want(raster, f);
        }
    }
    lrcsi_raster_clear(raster);
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_VISIBLE) {
            lrcsi_raster_claim(raster, f);
        }
    }
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_UNDECIDED) {
            lrcsi_raster_draw(raster, f);
        }
    }
}

/* A uniform facet for which no query gave an answer. */
static lrcsi_visible unknown_area(lrcsi_raster *raster, uint32_t facet)
{
    double area = lrcsi_view_projected(raster->view, facet);
    raster->undecided[facet] = 1;
    return (lrcsi_visible){0.5 * area, 0, area, 0.5 * area, 0};
}

int lrcsi_visible_sampled(const lrcsi_known *known, uint32_t size, lrcs_work *work,
                          lrcsi_raster *raster, lrcsi_visible *visible)
{
    const lrcsi_classification *classification = known->classification;
    const uint32_t count = classification->view->prepared->scene->facet_count;
    const size_t mark = work->used;
    int status = lrcsi_raster_start(classification->view, size, work, raster);
    if (status != LRCS_OK) {
        return status;
    }
    const size_t end = work->used;
    visible_job job = {.known = known, .raster = raster};
    lrcsi_sharing sharing;
    if (visible_start(&job, work) != LRCS_OK ||
        lrcsi_visible_fraction_make(known, raster, work, &sharing) != LRCS_OK) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    known_draw(known, raster);
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] == LRCSI_QUERY_UNDECIDED && classification->undecided[f]) {
            job.begun[f].listed = 0;
            if (raster->owned[f] != 0 && !raster->undecided[f]) {
                job.begun[f] = certain_begin(&job, f);
            }
        }
    }
    lrcsi_visible_answered(classification->view, known->answer, visible);
    size_t read = 0;
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] != LRCSI_QUERY_UNDECIDED) {
            continue;
        }
        if (!classification->undecided[f]) {
            visible[f] = unknown_area(raster, f);
            continue;
        }
        pixel_sums sums = {0, 0, 0, 0, 0};
        if (!raster->undecided[f]) {
            sums = certain_end(&job, f, &read);
        }
        drawn_area(&sharing, &sums, f, &visible[f]);
    }
    lrcsi_visible_fraction_correct(&sharing, visible);
    raster->occluded = NULL;
    work->used = end;
    return LRCS_OK;
}
