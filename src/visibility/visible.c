/* SPDX-License-Identifier: MIT */
/* From samples to areas with bounds. What an undecided facet has in a pixel that is touched by no
   event edge crossing the facet and by no contact with it is visible all together or not at all: a
   sample on the facet tells which, exactly, and one in a neighbouring such pixel does too, since
   the facet's part of both is connected. And where a pixel is known to be covered by one visible
   facet, all others are hidden there. Those pixels bound the area from below and above; the
   area between the bounds comes from the samples (visibility/visible_fraction.h). */
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

/* --- pixels where visibility may change ------------------------------------------------------- */

/* The pixels that a facet may touch, and which of them are mixed. */
typedef struct pixel_marks {
    const lrcsi_known *known;
    lrcsi_raster *raster;
    lrcsi_edges edges;    /* of the facet */
    double corner[3][2];  /* its corners, in pixels, counter-clockwise */
    lrcsi_row *row;       /* row of the raster, of those touched */
    unsigned char *mixed; /* pixel of the raster, of those touched: visibility may change in it */
    /* Pixels of which nothing is known of a facet yet, one list behind the other in facet order: 2
       at for pixel number `at`, + 1 if the facet covers all of it; each ends with LRCS_NONE. */
    uint32_t *open;
    size_t open_room, open_count, open_read;
} pixel_marks;

static size_t marks_at(const pixel_marks *m, uint32_t x, uint32_t y)
{
    return (size_t)y * m->raster->size + x;
}

/* The facet whose pixels are asked for. */
static void marks_facet(pixel_marks *m, uint32_t facet)
{
    const lrcsi_raster *r = m->raster;
    const uint32_t *corner = r->view->prepared->scene->facet[facet].corner;
    m->edges = lrcsi_raster_edges(r, facet);
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(r, corner[r->view->facing[facet] > 0 ? k : 2 - k], m->corner[k]);
    }
}

/* The same, with all pixels that it may touch, none of them mixed. */
static void marks_start(pixel_marks *m, uint32_t facet)
{
    marks_facet(m, facet);
    const lrcsi_edges e = m->edges;
    for (uint32_t y = e.bottom; y < e.top; y++) {
        lrcsi_row row = m->row[y] = lrcsi_span_row(&e, y);
        memset(m->mixed + marks_at(m, row.touched.x0, y), 0, row.touched.x1 - row.touched.x0);
    }
}

/* The first row from which on the segment may be marked, and one past the last. */
static uint32_t mark_row(const pixel_marks *m, double y)
{
    return (uint32_t)lrcsi_least(lrcsi_most(y, m->edges.bottom), m->edges.top);
}

/* Marks every pixel that the segment a b may touch. Its ends are off by at most `off`; the same
   margin widens rows and ranges. */
static void mark_segment(pixel_marks *m, const double a[2], const double b[2], double off)
{
    double margin = 4 * off;
    lrcsi_segment s = lrcsi_span_segment(a, b, margin);
    uint32_t first = mark_row(m, lrcsi_least(a[1], b[1]) - margin);
    uint32_t last = mark_row(m, lrcsi_most(a[1], b[1]) + margin + 1);
    for (uint32_t y = first; y < last; y++) {
        uint32_t x0 = m->row[y].touched.x0;
        uint32_t x1 = m->row[y].touched.x1;
        lrcsi_span_follow(&s, y, &x0, &x1);
        if (x0 < x1) {
            memset(m->mixed + marks_at(m, x0, y), 1, x1 - x0);
        }
    }
}

static void mark_edge(pixel_marks *m, uint32_t edge)
{
    const lrcsi_edge *e = &m->raster->view->prepared->topology.edge[edge];
    double a[2];
    double b[2];
    double off = lrcsi_raster_point(m->raster, e->low, a);
    off = lrcsi_most(off, lrcsi_raster_point(m->raster, e->high, b));
    mark_segment(m, a, b, off);
}

/* Where a height may be 0 in a row, it being row + along (x + 1/2) to within slack: among pixels
   *x0 .. *x1 - 1. As safely as two pixels to either side and 8 roundings are; where division gives
   no number, anywhere. */
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

/* Marks the pixels of both facets where their planes may meet: where the difference of heights is
   not surely of one sign over the whole pixel. Each row is asked where that may be in it before the
   other facet is asked what it touches there: so the line is walked along on which they meet. */
static void mark_meeting(pixel_marks *m, uint32_t facet, uint32_t other)
{
    const lrcsi_raster *r = m->raster;
    lrcsi_plane p = lrcsi_raster_plane(r, facet);
    lrcsi_plane q = lrcsi_raster_plane(r, other);
    lrcsi_edges e = lrcsi_raster_edges(r, other);
    double along = p.along - q.along;
    double up = p.up - q.up;
    double slack = lrcsi_raster_slack(r, facet) + lrcsi_raster_slack(r, other) +
                   0.51 * (fabs(along) + fabs(up));
    uint32_t bottom = e.bottom > m->edges.bottom ? e.bottom : m->edges.bottom;
    for (uint32_t y = bottom; y < m->edges.top && y < e.top; y++) {
        double row = p.at - q.at + up * (y + 0.5);
        double x0 = m->row[y].touched.x0;
        double x1 = m->row[y].touched.x1;
        level_narrow(row, along, slack, &x0, &x1);
        if (!(x0 < x1)) {
            continue;
        }
        lrcsi_pixels touched = lrcsi_span_touched(&e, y);
        x1 = lrcsi_least(x1, touched.x1);
        for (double x = lrcsi_most(x0, touched.x0); x < x1; x++) {
            if (!(fabs(row + along * (x + 0.5)) > slack)) {
                m->mixed[marks_at(m, (uint32_t)x, y)] = 1;
            }
        }
    }
}

static void mark_touches(pixel_marks *m, uint32_t facet)
{
    const lrcsi_view *view = m->raster->view;
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        const lrcsi_intersection *touch = &intersections->entry[i];
        if (!lrcsi_intersection_hides(view, facet, touch)) {
            continue;
        }
        if (touch->kind == LRCSI_INTERSECTION_CROSS) {
            mark_meeting(m, facet, touch->other);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            mark_edge(m, view->prepared->topology.facet_edge[touch->other].corner[k]);
        }
    }
}

/* --- undecided facets ------------------------------------------------------------------------- */

/* The part of a unit square where a linear function that is `value` at its centre, and changes by
   most >= least >= 0 along its sides, is positive. */
static double square_share(double value, double most, double least)
{
    double from = fabs(value);
    double rest = 0.5 * (most + least) - from;
    double less = rest >= least ? 0.5 - from / most
                  : rest > 0    ? 0.5 * (rest / most) * (rest / least)
                                : 0;
    return value > 0 ? 1 - less : less;
}

/* How much the facet surely covers, in pixels, of one that it may not cover whole. Where just one
   side passes: a value that is too large by off moves the line by off / |gradient|, and the area by
   that times its length in the pixel, below 1.5; roundings are below 8 u, and off is at least 64 u
   N h. Else corners are off by their position error in each coordinate, and the area by at most 4
   times that, as far as sides run within the pixel along both axes together. Roundings
   (visibility/clip.h) are less than another 4 times: a position error is more than 8 u of a
   corner's distance from any pixel, and more than 16 u. */
static double pixel_share(const pixel_marks *m, uint32_t x, uint32_t y)
{
    const lrcsi_edges *e = &m->edges;
    int sides = 0;
    double share = 0;
    for (int k = 0; k < 3; k++) {
        double along = fabs(e->along[k]);
        double up = fabs(e->up[k]);
        double value = e->at[k] + e->along[k] * (x + 0.5) + e->up[k] * (y + 0.5);
        if (!(value - 0.5 * (along + up) > e->off)) {
            double most = lrcsi_most(along, up);
            sides++;
            share = square_share(value, most, lrcsi_least(along, up)) - 2 * e->off / most;
        }
    }
    if (sides != 1) {
        const double low[2] = {x, y};
        share = lrcsi_clip_box_area((const double(*)[2])m->corner, low) - 8 * m->edges.position_err;
    }
    return lrcsi_most(0, share);
}

/* Does a sample on the facet tell what the pixel shows of it? Then *shows. Coordinates below 0 wrap
   round and are outside. */
static int pixel_tells(const pixel_marks *m, uint32_t facet, uint32_t x, uint32_t y, int *shows)
{
    if (y < m->edges.bottom || y >= m->edges.top || !lrcsi_span_has(m->row[y].sure, x) ||
        m->mixed[marks_at(m, x, y)]) {
        return 0;
    }
    *shows = m->raster->owner[marks_at(m, x, y)] == facet;
    return 1;
}

/* The same, from the pixel or from one beside it. */
static int pixel_known(const pixel_marks *m, uint32_t facet, uint32_t x, uint32_t y, int *shows)
{
    return m->mixed[marks_at(m, x, y)] == 0 &&
           (pixel_tells(m, facet, x, y, shows) || pixel_tells(m, facet, x - 1, y, shows) ||
            pixel_tells(m, facet, x + 1, y, shows) || pixel_tells(m, facet, x, y - 1, shows) ||
            pixel_tells(m, facet, x, y + 1, shows));
}

/* What is certain of a facet, in pixels: what it shows, and what is hidden. Those that it covers
   whole are counted, exactly. Of the rest at most 12 N are added up (along each row or column a
   side touches 4 at most), so that an addition rounds by at most 12 u N: less than each share gives
   away. */
typedef struct pixel_sums {
    uint32_t whole_shown, whole_hidden;
    double shown, hidden;
} pixel_sums;

/* Lists a pixel as open; where there is no room it is only counted. */
static void open_add(pixel_marks *m, size_t at, uint32_t whole)
{
    if (m->open_count < m->open_room) {
        m->open[m->open_count] = 2 * (uint32_t)at + whole;
    }
    m->open_count++;
}

/* Pixels that the facet touches and may not cover whole. */
static void count_parts(pixel_marks *m, uint32_t facet, uint32_t y, lrcsi_pixels part,
                        pixel_sums *sums)
{
    const lrcsi_raster *r = m->raster;
    for (uint32_t x = part.x0; x < part.x1; x++) {
        size_t at = marks_at(m, x, y);
        int shows = 0;
        if ((r->pure[at] && r->owner[at] != facet) || pixel_known(m, facet, x, y, &shows)) {
            *(shows ? &sums->shown : &sums->hidden) += pixel_share(m, x, y);
        } else {
            open_add(m, at, 0);
        }
    }
}

/* Pixels that it covers whole, and so their samples, which tell: most of them, and cheap. */
static void count_whole(pixel_marks *m, uint32_t facet, uint32_t y, lrcsi_pixels whole,
                        pixel_sums *sums)
{
    size_t row = marks_at(m, 0, y);
    const uint32_t *owner = m->raster->owner + row;
    unsigned char *pure = m->raster->pure + row;
    const unsigned char *mixed = m->mixed + row;
    for (uint32_t x = whole.x0; x < whole.x1; x++) {
        uint32_t own = owner[x] == facet;
        uint32_t tells = mixed[x] == 0;
        sums->whole_shown += tells & own;
        sums->whole_hidden += (tells | pure[x]) & (own ^ 1);
        pure[x] |= (unsigned char)(tells & own);
        if ((tells | pure[x]) == 0) {
            open_add(m, row + x, 1);
        }
    }
}

/* Visits the pixels of a facet: counts those of which something is certain, lists the others, and
   notes the pixels that it covers and is visible in, all of them, as pure. */
static pixel_sums count_certain(pixel_marks *m, uint32_t facet)
{
    pixel_sums sums = {0, 0, 0, 0};
    for (uint32_t y = m->edges.bottom; y < m->edges.top; y++) {
        lrcsi_pixels touched = m->row[y].touched;
        lrcsi_pixels whole = m->row[y].whole;
        if (whole.x0 == whole.x1) { /* it may stand anywhere then */
            whole = (lrcsi_pixels){touched.x1, touched.x1};
        }
        count_parts(m, facet, y, (lrcsi_pixels){touched.x0, whole.x0}, &sums);
        count_whole(m, facet, y, whole, &sums);
        count_parts(m, facet, y, (lrcsi_pixels){whole.x1, touched.x1}, &sums);
    }
    return sums;
}

/* Puts the event edges that cross a facet into classification->crossing; returns how many they are.
 */
static uint32_t known_crossings(const lrcsi_known *known, uint32_t facet)
{
    if (facet >= known->listed) {
        return lrcsi_classify_crossings(known->classification, facet);
    }
    uint32_t first = known->first[facet];
    uint32_t count = known->first[facet + 1] - first;
    lrcsi_classify_recall(known->classification, facet, known->crossing + first, count);
    return count;
}

/* Marks where the visibility of an undecided facet may change. */
static void mark_changes(pixel_marks *m, uint32_t facet)
{
    marks_start(m, facet);
    uint32_t crossings = known_crossings(m->known, facet);
    for (uint32_t i = 0; i < crossings; i++) {
        mark_edge(m, m->known->classification->crossing[i]);
    }
    mark_touches(m, facet);
}

/* Visits a facet that owns samples: what is certain of it is kept in *visible until
   certain_finish, its pixels as open. Returns 0 if there is no room for these. */
static int certain_begin(pixel_marks *m, uint32_t facet, lrcsi_visible *visible)
{
    size_t first = m->open_count;
    mark_changes(m, facet);
    pixel_sums sums = count_certain(m, facet);
    if (m->open_count >= m->open_room) {
        m->open_count = first;
        return 0;
    }
    m->open[m->open_count++] = LRCS_NONE;
    visible->low = sums.whole_shown + sums.shown;
    visible->high = sums.hidden;
    visible->likely = sums.whole_hidden;
    return 1;
}
/* The sums of such a facet, once all pure pixels are known: of those open, the ones that show
   another facet are hidden. */
static pixel_sums certain_finish(pixel_marks *m, uint32_t facet, const lrcsi_visible *visible)
{
    const lrcsi_raster *r = m->raster;
    pixel_sums sums = {0, (uint32_t)visible->likely, visible->low, visible->high};
    int shaped = 0; /* the facet's shape is at hand */
    uint32_t open;
    while ((open = m->open[m->open_read++]) != LRCS_NONE) {
        size_t at = open / 2;
        if (!r->pure[at] || r->owner[at] == facet) {
            continue;
        }
        if (open % 2 != 0) {
            sums.whole_hidden++;
            continue;
        }
        if (!shaped) {
            marks_facet(m, facet);
            shaped = 1;
        }
        sums.hidden += pixel_share(m, (uint32_t)(at % r->size), (uint32_t)(at / r->size));
    }
    return sums;
}

/* The sums of a facet of which nothing is kept. */
static pixel_sums certain_sums(pixel_marks *m, uint32_t facet)
{
    size_t first = m->open_count;
    mark_changes(m, facet);
    pixel_sums sums = count_certain(m, facet);
    m->open_count = first; /* nobody asks again */
    return sums;
}

static lrcsi_sampling_error undecided_error(const lrcsi_sharing *sharing, uint32_t facet,
                                            const lrcsi_visible_fraction *share)
{
    if (share->row) {
        return lrcsi_sampling_error_row(sharing->raster, facet, share->longest, share->share);
    }
    uint32_t crossings = known_crossings(sharing->known, facet);
    return lrcsi_sampling_error_facet(sharing->known->classification, crossings, sharing->raster,
                                      facet);
}

/* Of a facet that certain_begin visited *v holds what it kept. Pixel areas are side^2 / N^2 to a
   few roundings; 1e-12 of them is given away. */
static void undecided_area(const lrcsi_sharing *sharing, pixel_marks *marks, uint32_t facet,
                           int begun, lrcsi_visible *v)
{
    const lrcsi_raster *raster = sharing->raster;
    double area = lrcsi_view_projected(raster->view, facet);
    double pixel = raster->pixel * raster->pixel;
    lrcsi_visible_fraction share = lrcsi_visible_fraction_facet(sharing, facet);
    pixel_sums sums = {0, 0, 0, 0};
    lrcsi_sampling_error sampling_error = {HUGE_VAL, 0};
    if (!raster->undecided[facet]) {
        sums = begun ? certain_finish(marks, facet, v) : certain_sums(marks, facet);
        sampling_error = undecided_error(sharing, facet, &share);
    }
    v->low = lrcsi_least(area, (sums.whole_shown + sums.shown) * pixel * (1 - 1e-12));
    v->high = lrcsi_most(v->low, area - (sums.whole_hidden + sums.hidden) * pixel * (1 - 1e-12));
    lrcsi_visible_fraction_keep(sharing, facet, area, &share, v);
    double gap = v->high - v->low;
    v->likely = lrcsi_least(gap, sqrt(sampling_error.square) * pixel);
    v->bias = lrcsi_least(gap, lrcsi_most(-gap, sampling_error.bias * pixel));
}

/* --- what is known ---------------------------------------------------------------------------- */

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

/* Lists what crosses the next facet, which is undecided or not, unless there is no room. */
static void known_list(lrcsi_known *k, uint32_t facet, uint32_t crossings)
{
    uint32_t used = k->first[facet];
    if (crossings <= known_room(k->classification->view->prepared) - used) {
        if (crossings != 0) { /* mostly there are none */
            memcpy(k->crossing + used, k->classification->crossing,
                   crossings * sizeof *k->crossing);
        }
        k->first[facet + 1] = used + crossings;
        k->listed++;
    }
}

/* Asks about undecided facets. The search that serves the answer serves the list too. */
static void known_undecided(lrcsi_known *k)
{
    k->first[0] = 0;
    for (uint32_t f = 0; f < k->classification->view->prepared->scene->facet_count; f++) {
        uint32_t crossings = 0;
        if (k->classification->undecided[f] &&
            !lrcsi_query_screened(k->classification, &k->facets, f)) {
            k->answer[f] = LRCSI_QUERY_UNDECIDED;
            crossings = k->listed == f ? lrcsi_classify_crossings(k->classification, f) : 0;
        }
        if (k->listed == f) {
            known_list(k, f, crossings);
        }
    }
}

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
                     ? lrcsi_query_uniform(classification, work, &k.facets, k.answer)
                     : LRCS_E_MEMORY;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    known_undecided(&k);
    *known = k;
    return LRCS_OK;
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Room for open pixels: more than ordinary scenes have. Facets beyond it are visited twice. */
static size_t open_room(const lrcs_prepared *prepared, uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_square(size) / 2, 2 * (size_t)prepared->scene->facet_count);
}

size_t lrcsi_visible_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes((size_t)size * size, 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(lrcsi_row)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(open_room(prepared, size), sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_visible_fraction_need(prepared));
    return lrcsi_work_add(need, lrcsi_raster_need(prepared, size));
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

/* A uniform facet of which no query could tell. */
static lrcsi_visible unknown_area(lrcsi_raster *raster, uint32_t facet)
{
    double area = lrcsi_view_projected(raster->view, facet);
    raster->undecided[facet] = 1;
    return (lrcsi_visible){0.5 * area, 0, area, 0.5 * area, 0};
}

static void visible_fill(const lrcsi_sharing *sharing, pixel_marks *marks, lrcsi_visible *visible)
{
    const lrcsi_known *known = sharing->known;
    lrcsi_classification *classification = known->classification;
    lrcsi_raster *raster = marks->raster;
    uint32_t count = classification->view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        if (classification->undecided[f] && raster->owned[f] != 0 && !raster->undecided[f] &&
            !certain_begin(marks, f, &visible[f])) {
            visible[f].likely = -1; /* no room */
        }
    }
    lrcsi_visible_answered(classification->view, known->answer, visible);
    for (uint32_t f = 0; f < count; f++) {
        if (known->answer[f] != LRCSI_QUERY_UNDECIDED) {
            continue;
        }
        if (classification->undecided[f]) {
            int begun = raster->owned[f] != 0 && !raster->undecided[f] && visible[f].likely >= 0;
            undecided_area(sharing, marks, f, begun, &visible[f]);
        } else {
            visible[f] = unknown_area(raster, f);
        }
    }
    lrcsi_visible_fraction_settle(sharing, visible);
}

int lrcsi_visible_sampled(const lrcsi_known *known, uint32_t size, lrcs_work *work,
                          lrcsi_raster *raster, lrcsi_visible *visible)
{
    size_t mark = work->used;
    int status = lrcsi_raster_start(known->classification->view, size, work, raster);
    if (status != LRCS_OK) {
        return status;
    }
    size_t end = work->used;
    pixel_marks marks = {.known = known, .raster = raster};
    marks.mixed = lrcsi_work_take(work, (size_t)size * size, 1);
    marks.row = lrcsi_work_take(work, size, sizeof *marks.row);
    marks.open_room = open_room(known->classification->view->prepared, size);
    marks.open = lrcsi_work_take(work, marks.open_room, sizeof *marks.open);
    lrcsi_sharing sharing;
    if (!marks.mixed || !marks.row || !marks.open ||
        lrcsi_visible_fraction_make(known, raster, work, &sharing) != LRCS_OK) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    known_draw(known, raster);
    visible_fill(&sharing, &marks, visible);
    work->used = end;
    return LRCS_OK;
}
