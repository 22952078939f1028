/* SPDX-License-Identifier: MIT */
/* Passes over facets, edges and pixels: draw, find events, clear pixels of them, decide facets. Why
   this suffices stands in the header; who owns a sample is decided by visibility/raster.c. */
#include "visibility/zbuffer.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/clip.h"
#include "visibility/query.h"

/* Pixels of a word of a bit map. */
enum { BITS = 64 };

/* Pixels along a tile. */
enum { TILE = 8 };

/* Pixels touched are told with this margin, beyond the error of coordinates: far above rounding,
   and far below anything that would cost. */
#define MARGIN 0x1p-20

/* The likely error of an area is two standard deviations. Of a mixed pixel, a share that is as good
   as any is taken for 0 or 1, whichever is nearer: that errs by 1 / 12 in the mean square. Pixels
   err by chance, but for those along an edge that runs along a row or column, all of which err
   alike: so the longest run of them counts as one, if that is more. */
#define LIKELY (3 / 12.0)

/* The pixels x0 <= x < x1, y0 <= y < y1 that a facet may touch. */
typedef struct zbuffer_box {
    uint16_t x0, x1, y0, y1;
} zbuffer_box;

/* What is known of a facet. */
enum { PLAIN = 0, HIDDEN, VISIBLE, PARTLY };

/* Mixed pixels of a facet one behind the other that are likely to show the same: where they end,
   and their area. */
typedef struct doubt_chain {
    uint32_t facet, at;
    int32_t shows;
    float area;
} doubt_chain;

/* In a row, in each column, and in each diagonal either way. */
enum { CHAINS = 4 };

typedef struct zbuffer_job {
    const lrcsi_view *view;
    const unsigned char *answer; /* facet: what exact queries tell, or NULL */
    lrcsi_raster raster;
    uint32_t words;     /* of a row of a bit map */
    signed char *cast;  /* facet: its facing where it casts, else 0; one more 0 at the end */
    zbuffer_box *box;   /* facet that casts */
    lrcsi_events edges; /* event edges */
    float *event;       /* pixel met by events: the nearest depth of one; later t, parting depth */
    unsigned char *events; /* pixel met by events: how many, 255 for more */
    float *cover;          /* the same pixel: all of it is covered by one facet at least as near;
                              in the raster's depths, once those have served */
    uint64_t *met;         /* bit map: pixels that events may touch */
    uint64_t *crossed;     /* bit map: pixels not cleared by t; in the end those that are mixed */
    unsigned char *state;  /* facet */
    doubt_chain *chain;    /* of the facet at hand: its row, column by column, diagonals */
    lrcsi_row *row;        /* row of the raster: of the facet at hand */
    float *tile_low, *tile_high; /* tile: the least and the most t of its pixels, but of crossed */
    uint32_t tiles;              /* along each side */
    double margin;               /* in pixels: of all that is marked */
} zbuffer_job;

/* --- floats that err one way, bit maps -------------------------------------------------------- */

static float float_above(double x)
{
    return (float)(x + 0x1p-23 * fabs(x) + 0x1p-140);
}

static float float_below(double x)
{
    return (float)(x - 0x1p-23 * fabs(x) - 0x1p-140);
}

static inline int bit_get(const zbuffer_job *job, const uint64_t *map, uint32_t x, uint32_t y)
{
    return (int)(map[(size_t)y * job->words + x / BITS] >> x % BITS & 1);
}

static inline void bit_set(const zbuffer_job *job, uint64_t *map, uint32_t x, uint32_t y)
{
    map[(size_t)y * job->words + x / BITS] |= (uint64_t)1 << x % BITS;
}

/* The bits of a word that stand for pixels x0 <= x < x1, which are not none. */
static inline uint64_t bit_range(uint32_t word, uint32_t x0, uint32_t x1)
{
    uint32_t first = word * BITS;
    uint64_t bits = ~(uint64_t)0;
    bits = x0 > first ? bits << (x0 - first) : bits;
    return x1 < first + BITS ? bits & (((uint64_t)1 << (x1 - first)) - 1) : bits;
}

/* The place of the lowest bit of a word that is not 0: bits alone multiply to 64 different tops. */
static inline uint32_t bit_lowest(uint64_t word)
{
    static const unsigned char place[64] = {
        0,  1,  2,  53, 3,  7,  54, 27, 4,  38, 41, 8,  34, 55, 48, 28, 62, 5,  39, 46, 44, 42,
        22, 9,  24, 35, 59, 56, 49, 18, 29, 11, 63, 52, 6,  26, 37, 40, 33, 47, 61, 45, 43, 21,
        23, 58, 17, 10, 51, 25, 36, 32, 60, 20, 57, 16, 50, 31, 19, 15, 30, 14, 13, 12};
    return place[((word & (~word + 1)) * 0x022fdd63cc95386dull) >> 58];
}

static inline int bit_any(const zbuffer_job *job, const uint64_t *map, uint32_t y, uint32_t x0,
                          uint32_t x1)
{
    const uint64_t *row = map + (size_t)y * job->words;
    uint64_t any = 0;
    for (uint32_t word = x0 / BITS; word * BITS < x1; word++) {
        any |= row[word] & bit_range(word, x0, x1);
    }
    return any != 0;
}

/* Is a bit of the box set? */
static int bit_box(const zbuffer_job *job, const uint64_t *map, const zbuffer_box *box)
{
    for (uint32_t y = box->y0; y < box->y1; y++) {
        if (bit_any(job, map, y, box->x0, box->x1)) {
            return 1;
        }
    }
    return 0;
}

/* --- events ----------------------------------------------------------------------------------- */

static inline void event_mark(zbuffer_job *job, uint32_t x, uint32_t y, float z)
{
    size_t at = (size_t)y * job->raster.size + x;
    if (!bit_get(job, job->met, x, y)) {
        bit_set(job, job->met, x, y);
        job->event[at] = z;
        job->events[at] = 1;
    } else {
        job->event[at] = job->event[at] < z ? z : job->event[at];
        job->events[at] = (unsigned char)(job->events[at] + (job->events[at] != 0xff));
    }
}

/* The cell of a pixel coordinate. */
static inline uint32_t pixel_at(const zbuffer_job *job, double x)
{
    return (uint32_t)lrcsi_least(lrcsi_most(x, 0), job->raster.size - 1.0);
}

/* A segment over the pixels: stepped along its longer axis. */
typedef struct event_line {
    int axis;
    double from[3], run; /* its lower end along the axis, and how far it runs */
    double slope, climb; /* what it changes across, and in depth, for each pixel along */
    double across[2];    /* its least and most coordinate across */
    double near;         /* its nearest depth */
} event_line;

static event_line event_line_of(const zbuffer_job *job, uint32_t edge)
{
    const lrcsi_edge *e = &job->view->prepared->topology.edge[edge];
    double end[2][3];
    lrcsi_raster_point(&job->raster, e->low, end[0]);
    lrcsi_raster_point(&job->raster, e->high, end[1]);
    end[0][2] = job->view->point[e->low].x[2];
    end[1][2] = job->view->point[e->high].x[2];
    event_line l;
    int axis = l.axis = fabs(end[1][1] - end[0][1]) > fabs(end[1][0] - end[0][0]);
    int first = end[1][axis] < end[0][axis];
    const double *to = end[!first];
    memcpy(l.from, end[first], sizeof l.from);
    l.run = to[axis] - l.from[axis];
    l.slope = l.run > job->margin ? (to[!axis] - l.from[!axis]) / l.run : 0;
    l.climb = l.run > job->margin ? (to[2] - l.from[2]) / l.run : 0;
    l.across[0] = lrcsi_least(l.from[!axis], to[!axis]);
    l.across[1] = lrcsi_most(l.from[!axis], to[!axis]);
    l.near = lrcsi_most(l.from[2], to[2]);
    return l;
}

/* What it touches in a step: pixels first <= x <= last across, at this depth or farther. All is
   widened by the margin. A point of the true segment, and its depth, are off by no more than the
   ends are from the point computed at the same fraction of it. */
typedef struct event_step {
    uint32_t first, last;
    double depth;
} event_step;

static inline event_step event_step_of(const zbuffer_job *job, const event_line *l, uint32_t step)
{
    double m = job->margin;
    double low = l->across[0];
    double high = l->across[1];
    event_step s = {.depth = l->near};
    if (l->run > m) {
        double u = lrcsi_most(0, step - m - l->from[l->axis]);
        double v = lrcsi_least(l->run, step + 1 + m - l->from[l->axis]);
        double p = l->from[!l->axis] + l->slope * u;
        double q = l->from[!l->axis] + l->slope * v;
        low = lrcsi_most(low, lrcsi_least(p, q));
        high = lrcsi_least(high, lrcsi_most(p, q));
        s.depth = lrcsi_least(l->near, l->from[2] + lrcsi_most(l->climb * u, l->climb * v));
    }
    s.first = pixel_at(job, low - m);
    s.last = pixel_at(job, high + m);
    return s;
}

/* Marks the pixels that an edge touches. */
static void event_edge(zbuffer_job *job, uint32_t edge)
{
    event_line l = event_line_of(job, edge);
    uint32_t last = pixel_at(job, l.from[l.axis] + l.run + job->margin);
    for (uint32_t i = pixel_at(job, l.from[l.axis] - job->margin); i <= last; i++) {
        event_step s = event_step_of(job, &l, i);
        float depth = float_above(s.depth + 2 * job->view->off);
        for (uint32_t k = s.first; k <= s.last; k++) {
            event_mark(job, l.axis == 0 ? i : k, l.axis == 0 ? k : i, depth);
        }
    }
}

/* Does event_edge mark this pixel? */
static int event_marks(const zbuffer_job *job, const event_line *l, uint32_t x, uint32_t y)
{
    uint32_t i = l->axis == 0 ? x : y;
    uint32_t k = l->axis == 0 ? y : x;
    if (i < pixel_at(job, l->from[l->axis] - job->margin) ||
        i > pixel_at(job, l->from[l->axis] + l->run + job->margin)) {
        return 0;
    }
    event_step s = event_step_of(job, l, i);
    return s.first <= k && k <= s.last;
}

/* Event edges, and sides that a corner of another facet splits. */
static int events_edges(zbuffer_job *job, lrcs_work *work)
{
    const lrcs_prepared *p = job->view->prepared;
    int status = lrcsi_events_make(job->view, job->cast, work, &job->edges);
    if (status != LRCS_OK) {
        return status;
    }
    for (uint32_t i = 0; i < job->edges.count; i++) {
        event_edge(job, job->edges.edge[i]);
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        for (int k = 0; k < 3 && job->cast[f] != 0; k++) {
            if (p->touches.rim[f] >> k & 1) {
                event_edge(job, p->topology.facet_edge[f].corner[k]);
            }
        }
    }
    return LRCS_OK;
}

/* A facet's plane over pixels. */
typedef struct pixel_plane {
    lrcsi_plane plane;
    double bend;      /* heights in a pixel differ from that at its centre by no more, errors
                         included */
    double far, near; /* the facet's least and most depth, errors included */
} pixel_plane;

static pixel_plane pixel_plane_of(const zbuffer_job *job, uint32_t facet)
{
    pixel_plane p = {.plane = lrcsi_raster_plane(&job->raster, facet)};
    p.bend = 0.51 * (fabs(p.plane.along) + fabs(p.plane.up)) + 2 * p.plane.err;
    lrcsi_grid_depth(job->view, facet, &p.far, &p.near);
    p.far -= 2 * job->view->off;
    p.near += 2 * job->view->off;
    return p;
}

static inline double pixel_height(const pixel_plane *p, uint32_t x, uint32_t y)
{
    return p->plane.at + p->plane.along * (x + 0.5) + p->plane.up * (y + 0.5);
}

static inline double pixel_far(const pixel_plane *p, double height)
{
    return lrcsi_most(p->far, height - p->bend);
}

static inline double pixel_near(const pixel_plane *p, double height)
{
    return lrcsi_least(p->near, height + p->bend);
}

/* Where a height may be 0 in a row, it being row + along (x + 1/2) to within slack: among pixels
   *x0 .. *x1 - 1. As safely as two pixels to either side and 8 roundings are; where division gives
   no number, anywhere. */
static void level_narrow(double row, double along, double slack, double *x0, double *x1)
{
    double middle = -row / along;
    double half = slack / fabs(along);
    double spare = 2 + 0x1p-50 * (fabs(middle) + half);
    if (middle - half - spare > *x0) {
        *x0 = floor(middle - half - spare);
    }
    if (middle + half + spare < *x1) {
        *x1 = ceil(middle + half + spare);
    }
}

/* Marks the pixels of both facets where their planes may meet: where the difference of heights is
   not surely of one sign over the whole pixel. Each row is asked where that may be in it before the
   facets are asked what they touch there: so the line is walked along on which they meet. */
static void event_meeting(zbuffer_job *job, uint32_t facet, uint32_t other)
{
    const zbuffer_box *a = &job->box[facet];
    const zbuffer_box *b = &job->box[other];
    uint32_t bottom = a->y0 > b->y0 ? a->y0 : b->y0;
    uint32_t top = a->y1 < b->y1 ? a->y1 : b->y1;
    double left = a->x0 > b->x0 ? a->x0 : b->x0;
    double right = a->x1 < b->x1 ? a->x1 : b->x1;
    if (bottom >= top || !(left < right)) {
        return;
    }
    pixel_plane p = pixel_plane_of(job, facet);
    pixel_plane q = pixel_plane_of(job, other);
    lrcsi_edges e = lrcsi_raster_edges(&job->raster, facet);
    lrcsi_edges f = lrcsi_raster_edges(&job->raster, other);
    double along = p.plane.along - q.plane.along;
    double up = p.plane.up - q.plane.up;
    double slack = 2 * (p.plane.err + q.plane.err) + 0.51 * (fabs(along) + fabs(up));
    for (uint32_t y = bottom; y < top; y++) {
        double row = p.plane.at - q.plane.at + up * (y + 0.5);
        double x0 = left;
        double x1 = right;
        level_narrow(row, along, slack, &x0, &x1);
        if (!(x0 < x1)) {
            continue;
        }
        lrcsi_pixels touched = lrcsi_span_touched(&e, y);
        lrcsi_pixels others = lrcsi_span_touched(&f, y);
        x0 = lrcsi_most(x0, lrcsi_most(touched.x0, others.x0));
        x1 = lrcsi_least(x1, lrcsi_least(touched.x1, others.x1));
        for (double x = x0; x < x1; x++) {
            if (!(fabs(row + along * (x + 0.5)) > slack)) {
                uint32_t i = (uint32_t)x;
                double z = lrcsi_least(pixel_near(&p, pixel_height(&p, i, y)),
                                       pixel_near(&q, pixel_height(&q, i, y)));
                event_mark(job, i, y, float_above(z));
            }
        }
    }
}

/* Is a contact listed from both sides, and from the other's, too? */
static int contact_again(const zbuffer_job *job, uint32_t facet, uint32_t other)
{
    const lrcsi_touches *touches = &job->view->prepared->touches;
    for (uint32_t i = touches->first[other]; other < facet && i < touches->first[other + 1]; i++) {
        if (touches->touch[i].other == facet) {
            return 1;
        }
    }
    return 0;
}

static void events_contacts(zbuffer_job *job)
{
    const lrcs_prepared *p = job->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        for (uint32_t i = p->touches.first[f]; job->cast[f] != 0 && i < p->touches.first[f + 1];
             i++) {
            const lrcsi_touch *touch = &p->touches.touch[i];
            if (!lrcsi_contest_touch_hides(job->view, f, touch)) {
                continue;
            }
            if (touch->kind == LRCSI_TOUCH_COPLANAR) {
                for (int k = 0; k < 3; k++) {
                    event_edge(job, p->topology.facet_edge[touch->other].corner[k]);
                }
            } else if (!contact_again(job, f, touch->other)) {
                event_meeting(job, f, touch->other);
            }
        }
    }
}

/* --- pixels ----------------------------------------------------------------------------------- */

/* Chooses t of the pixels that events touch, between the sample and the nearest event; where there
   is no such depth they are crossed, and t is infinite. Then no facet covers them yet. A depth is
   off by near_err; half as much serves for its rounding here, of numbers below 2 sides. */
static void pixels_part(zbuffer_job *job)
{
    const lrcsi_raster *r = &job->raster;
    float err = (float)(1.5 * r->near_err);
    for (uint32_t y = 0; y < r->size; y++) {
        for (uint32_t word = 0; word < job->words; word++) {
            uint64_t crossed = 0;
            for (uint64_t bits = job->met[(size_t)y * job->words + word]; bits != 0;
                 bits &= bits - 1) {
                size_t at = (size_t)y * r->size + word * BITS + bit_lowest(bits);
                float sample = r->depth[at] - err; /* -infinity where nobody is */
                float t = 0.5f * (sample + job->event[at]);
                int parts = job->event[at] < t && t < sample;
                crossed |= parts ? 0 : bits & (~bits + 1);
                if (parts) {
                    size_t tile = (size_t)(y / TILE) * job->tiles + at % r->size / TILE;
                    job->tile_low[tile] = t < job->tile_low[tile] ? t : job->tile_low[tile];
                    job->tile_high[tile] = t > job->tile_high[tile] ? t : job->tile_high[tile];
                }
                job->event[at] = parts ? t : HUGE_VALF;
                job->cover[at] = -HUGE_VALF;
            }
            job->crossed[(size_t)y * job->words + word] = crossed;
        }
    }
}

/* May the facet cover a pixel? Then it touches those on either side, too. */
static int facet_covers(const zbuffer_job *job, uint32_t facet)
{
    const zbuffer_box *box = &job->box[facet];
    return box->x1 - box->x0 > 2 && box->y1 - box->y0 > 2;
}

/* May the facet pass through t in a pixel? Not where no t of the tiles that it touches lies between
   its least and its most depth. */
static int facet_passes(const zbuffer_job *job, uint32_t facet)
{
    const zbuffer_box *box = &job->box[facet];
    double far;
    double near;
    lrcsi_grid_depth(job->view, facet, &far, &near);
    far -= 2 * job->view->off;
    near += 2 * job->view->off;
    for (uint32_t y = box->y0 / TILE; y <= (box->y1 - 1u) / TILE; y++) {
        for (uint32_t x = box->x0 / TILE; x <= (box->x1 - 1u) / TILE; x++) {
            size_t tile = (size_t)y * job->tiles + x;
            if (far <= (double)job->tile_high[tile] && near >= (double)job->tile_low[tile]) {
                return 1;
            }
        }
    }
    return 0;
}

/* Of the pixels met by events: which does the facet pass through t in, and which does it cover? */
static void pixels_pass(zbuffer_job *job, uint32_t facet, int covers)
{
    const zbuffer_box *box = &job->box[facet];
    uint64_t clear = covers ? ~(uint64_t)0 : 0; /* pixels already crossed matter to covers only */
    pixel_plane p;
    lrcsi_edges e;
    int started = 0;
    for (uint32_t y = box->y0; y < box->y1; y++) {
        const uint64_t *met = job->met + (size_t)y * job->words;
        const uint64_t *crossed = job->crossed + (size_t)y * job->words;
        uint64_t any = 0;
        for (uint32_t word = box->x0 / BITS; word * BITS < box->x1; word++) {
            any |= met[word] & (~crossed[word] | clear) & bit_range(word, box->x0, box->x1);
        }
        if (any == 0) {
            continue;
        }
        if (!started) {
            p = pixel_plane_of(job, facet);
            e = lrcsi_raster_edges(&job->raster, facet);
            started = 1;
        }
        if (y < e.bottom || y >= e.top) {
            continue;
        }
        lrcsi_row row = lrcsi_span_row(&e, y);
        float *event = job->event + (size_t)y * job->raster.size;
        float *cover = job->cover + (size_t)y * job->raster.size;
        for (uint32_t word = row.touched.x0 / BITS; word * BITS < row.touched.x1; word++) {
            uint64_t bits = met[word] & (~crossed[word] | clear) &
                            bit_range(word, row.touched.x0, row.touched.x1);
            for (; bits != 0; bits &= bits - 1) {
                uint32_t x = word * BITS + bit_lowest(bits);
                double height = pixel_height(&p, x, y);
                double far = pixel_far(&p, height);
                double t = event[x];
                if (far <= t && t <= pixel_near(&p, height)) {
                    bit_set(job, job->crossed, x, y);
                }
                if (lrcsi_span_has(row.whole, x) && far > (double)cover[x]) {
                    cover[x] = float_below(far);
                }
            }
        }
    }
}

/* Crossed pixels that one facet covers nearer than t, and so than all events, are not mixed. */
static void pixels_cover(zbuffer_job *job)
{
    for (uint32_t y = 0; y < job->raster.size; y++) {
        uint64_t *crossed = job->crossed + (size_t)y * job->words;
        size_t row = (size_t)y * job->raster.size;
        for (uint32_t word = 0; word < job->words; word++) {
            for (uint64_t bits = crossed[word]; bits != 0; bits &= bits - 1) {
                size_t at = row + word * BITS + bit_lowest(bits);
                if (job->event[at] < job->cover[at]) {
                    crossed[word] &= ~(bits & (~bits + 1));
                }
            }
        }
    }
}

/* --- facets ----------------------------------------------------------------------------------- */

/* The sides of a facet that are event edges. */
typedef struct facet_sides {
    event_line line[3];
    int count;
} facet_sides;

static facet_sides facet_sides_of(const zbuffer_job *job, uint32_t facet)
{
    const uint32_t *edge = job->view->prepared->topology.facet_edge[facet].corner;
    facet_sides sides = {.count = 0};
    for (int k = 0; k < 3; k++) {
        if (lrcsi_events_has(&job->edges, edge[k])) {
            sides.line[sides.count++] = event_line_of(job, edge[k]);
        }
    }
    return sides;
}

/* Is a mixed pixel not mixed for the facet, all of its events being sides of it (claim 5)? */
static int facet_clear(const zbuffer_job *job, const facet_sides *sides, uint32_t x, uint32_t y)
{
    int own = 0;
    if (sides->count == 0 || !bit_get(job, job->met, x, y)) {
        return 0;
    }
    for (int i = 0; i < sides->count; i++) {
        own += event_marks(job, &sides->line[i], x, y);
    }
    return own == job->events[(size_t)y * job->raster.size + x];
}

/* Does the facet touch a pixel that is mixed for it? */
static int facet_mixed(const zbuffer_job *job, uint32_t facet)
{
    if (!bit_box(job, job->crossed, &job->box[facet])) {
        return 0;
    }
    lrcsi_edges e = lrcsi_raster_edges(&job->raster, facet);
    facet_sides sides;
    int asked = 0;
    for (uint32_t y = e.bottom; y < e.top; y++) {
        if (!bit_any(job, job->crossed, y, e.left, e.right)) {
            continue;
        }
        lrcsi_pixels touched = lrcsi_span_touched(&e, y);
        for (uint32_t word = touched.x0 / BITS; word * BITS < touched.x1; word++) {
            uint64_t bits = job->crossed[(size_t)y * job->words + word] &
                            bit_range(word, touched.x0, touched.x1);
            for (; bits != 0; bits &= bits - 1) {
                if (!asked) {
                    sides = facet_sides_of(job, facet);
                    asked = 1;
                }
                if (!facet_clear(job, &sides, word * BITS + bit_lowest(bits), y)) {
                    return 1;
                }
            }
        }
    }
    return 0;
}

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

/* Do the complements of two half-planes have a corner of the pixel in common? Then what both
   half-planes hold of it cannot be told from what each holds. */
static int corner_beyond_both(const lrcsi_edges *e, const double value[3], int a, int b)
{
    for (int i = 0; i < 4; i++) {
        double x = i & 1 ? 0.5 : -0.5;
        double y = i & 2 ? 0.5 : -0.5;
        if (value[a] + e->along[a] * x + e->up[a] * y < e->off &&
            value[b] + e->along[b] * x + e->up[b] * y < e->off) {
            return 1;
        }
    }
    return 0;
}

/* How much the facet covers at most, in pixels, of one that it may not cover whole: where one side
   passes, its share; where two pass that do not meet there, what is left between them. A value that
   is too small by off moves a line by off / |gradient|, and the area by that times its length in
   the pixel, below 1.5; roundings are below 8 u, and off is at least 64 u N h. Else corners are off
   by the raster's error, and the area by at most the length of the cut, below 6, times that. */
static double pixel_share(const zbuffer_job *job, const lrcsi_edges *e, double corner[3][2],
                          uint32_t x, uint32_t y)
{
    int sides = 0;
    int passing[3];
    double value[3];
    double missing = 0; /* beyond the sides */
    int meet = 0;
    for (int k = 0; k < 3; k++) {
        double along = fabs(e->along[k]);
        double up = fabs(e->up[k]);
        value[k] = e->at[k] + e->along[k] * (x + 0.5) + e->up[k] * (y + 0.5);
        if (!(value[k] - 0.5 * (along + up) > e->off)) {
            double most = lrcsi_most(along, up);
            passing[sides++] = k;
            meet |= !(most > 0);
            missing += 1 - square_share(value[k], most, lrcsi_least(along, up)) - 2 * e->off / most;
        }
    }
    if (sides == 2) { /* k and k + 1 at corner k + 1, 0 and 2 at corner 0 */
        const double *p = corner[passing[1] - passing[0] == 1 ? passing[1] : 0];
        double m = job->margin;
        meet |= (p[0] > x - m && p[0] < x + 1 + m && p[1] > y - m && p[1] < y + 1 + m) ||
                corner_beyond_both(e, value, passing[0], passing[1]);
    }
    double share = 1 - missing;
    if (sides == 3 || meet) {
        const double low[2] = {x, y};
        share = fabs(lrcsi_clip_box_area((const double(*)[2])corner, low)) + 8 * job->raster.off;
    }
    return lrcsi_least(1, lrcsi_most(0, share));
}

/* A facet that touches mixed pixels, or of which no sample tells. */
typedef struct doubt_job {
    zbuffer_job *job;
    uint32_t facet;
    lrcsi_edges edges;
    pixel_plane plane;
    double corner[3][2]; /* in pixels */
    facet_sides sides;
    uint32_t rows; /* of the job, below this: those last asked for and the one before */
} doubt_job;

static doubt_job doubt_start(zbuffer_job *job, uint32_t facet)
{
    doubt_job f = {.job = job, .facet = facet};
    const uint32_t *corner = job->view->prepared->scene->facet[facet].corner;
    f.edges = lrcsi_raster_edges(&job->raster, facet);
    f.plane = pixel_plane_of(job, facet);
    f.sides = facet_sides_of(job, facet);
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(&job->raster, corner[k], f.corner[k]);
    }
    f.rows = f.edges.bottom;
    return f;
}

/* Row y of the facet; rows are asked for in order, but for the one before. */
static const lrcsi_row *doubt_row(doubt_job *f, uint32_t y)
{
    lrcsi_row *row = &f->job->row[y];
    if (y >= f->rows) {
        *row = lrcsi_span_row(&f->edges, y);
        if (f->rows < y && y > f->edges.bottom) { /* the one before may be asked for, too */
            row[-1] = lrcsi_span_row(&f->edges, y - 1);
        }
        f->rows = y + 1;
    }
    return row;
}

/* In pixels, at most: by what shows of the facet there, PLAIN where nothing tells. */
typedef struct doubt_sums {
    double area[VISIBLE + 1];
    double square;          /* of areas in doubt of which no sample tells */
    double starts[CHAINS];  /* squares of others, where a chain begins */
    double longest;         /* the largest in a chain */
    double told, seen;      /* of the areas in doubt: where samples on the facet or beside tell what
                               is likely, and as how much they show it */
    int shows[VISIBLE + 1]; /* is there any? */
    int last;               /* what the last pixels showed of which samples tell */
} doubt_sums;

/* Lengthens a chain, or begins it anew. Returns its area. */
static double chain_grow(doubt_chain *chain, uint32_t facet, uint32_t at, int shows, double area)
{
    int goes_on = chain->facet == facet && chain->at + 1 == at && chain->shows == shows;
    double all = area + (goes_on ? (double)chain->area : 0);
    *chain = (doubt_chain){facet, at, shows, (float)all};
    return all;
}

/* Adds a mixed pixel to the chains that it is in. */
static void chains_grow(const doubt_job *f, uint32_t x, uint32_t y, double share, doubt_sums *sums)
{
    uint32_t size = f->job->raster.size;
    doubt_chain *chain = f->job->chain;
    doubt_chain *in[CHAINS] = {chain, chain + 1 + x, chain + 1 + size + (x + size - y),
                               chain + 1 + 3 * (size_t)size + (x + y)};
    for (int k = 0; k < CHAINS; k++) {
        double area = chain_grow(in[k], f->facet, k == 0 ? y * size + x : y, sums->last, share);
        sums->longest = lrcsi_most(sums->longest, area);
        sums->starts[k] += area > share ? 0 : share * share;
    }
}

static double doubt_share(const doubt_job *f, uint32_t x, uint32_t y)
{
    return lrcsi_span_has(f->job->row[y].whole, x)
               ? 1
               : pixel_share(f->job, &f->edges, (double(*)[2])f->corner, x, y);
}

/* Does the sample of a pixel show the facet, if it covers it? Adds to the counts of both. */
static void count_sample(doubt_job *f, uint32_t x, uint32_t y, int *covered, int *owned)
{
    const lrcsi_raster *r = &f->job->raster;
    if (y >= f->edges.bottom && y < f->edges.top && lrcsi_span_has(doubt_row(f, y)->sure, x)) {
        *covered += 1;
        *owned += r->owner[(size_t)y * r->size + x] == f->facet;
    }
}

/* An area in doubt that is likely to show what was seen last. */
static void sum_last(doubt_sums *sums, double area)
{
    sums->told += sums->last != PLAIN ? area : 0;
    sums->seen += sums->last == VISIBLE ? area : 0;
}

/* A mixed pixel: in doubt, but where another facet covers it nearer. How much of it is likely to be
   visible its sample tells, or those beside it. */
static void sum_mixed(doubt_job *f, uint32_t x, uint32_t y, doubt_sums *sums)
{
    const zbuffer_job *job = f->job;
    double share = doubt_share(f, x, y);
    double near = pixel_near(&f->plane, pixel_height(&f->plane, x, y));
    if (bit_get(job, job->met, x, y) &&
        near < (double)job->cover[(size_t)y * job->raster.size + x]) {
        sums->area[HIDDEN] += share;
        sums->shows[HIDDEN] = 1;
        return;
    }
    int covered = 0;
    int owned = 0;
    count_sample(f, x, y, &covered, &owned);
    if (covered > 0) {
        sums->last = owned ? VISIBLE : HIDDEN;
        sum_last(sums, share);
    } else {
        count_sample(f, x - 1, y, &covered, &owned);
        count_sample(f, x + 1, y, &covered, &owned);
        count_sample(f, x, y - 1, &covered, &owned);
        count_sample(f, x, y + 1, &covered, &owned);
        if (covered > 0) {
            sums->told += share;
            sums->seen += share * owned / covered;
        } else {
            sum_last(sums, share);
        }
    }
    sums->area[PLAIN] += share;
    sums->shows[PLAIN] = 1;
    chains_grow(f, x, y, share, sums);
}

/* What a sample in pixels x0 <= x < x1 of row y tells, none of which is mixed. */
static int run_sample(doubt_job *f, uint32_t y, uint32_t x0, uint32_t x1)
{
    const zbuffer_job *job = f->job;
    lrcsi_pixels sure = doubt_row(f, y)->sure;
    uint32_t from = x0 > sure.x0 ? x0 : sure.x0;
    uint32_t to = x1 < sure.x1 ? x1 : sure.x1;
    if (from >= to) {
        return PLAIN;
    }
    return job->raster.owner[(size_t)y * job->raster.size + from] == f->facet ? VISIBLE : HIDDEN;
}

/* The same, of a row beside the one where the pixels are not mixed. */
static int run_beside(doubt_job *f, uint32_t y, uint32_t x0, uint32_t x1)
{
    return y < f->edges.bottom || y >= f->edges.top || bit_any(f->job, f->job->crossed, y, x0, x1)
               ? PLAIN
               : run_sample(f, y, x0, x1);
}

/* Is the facet farther than t, or than a facet that covers the pixel, in all of a run? */
static int run_behind(const doubt_job *f, uint32_t y, uint32_t x0, uint32_t x1)
{
    const zbuffer_job *job = f->job;
    for (uint32_t x = x0; x < x1; x++) {
        size_t at = (size_t)y * job->raster.size + x;
        double near = pixel_near(&f->plane, pixel_height(&f->plane, x, y));
        if (!bit_get(job, job->met, x, y) || bit_get(job, job->crossed, x, y) ||
            !(near < (double)job->event[at])) {
            return 0;
        }
    }
    return 1;
}

/* Pixels x0 <= x < x1 of a row that the facet touches, none of them mixed: its part of them is
   convex, so that one sample tells of all, or one in the same pixels of the next row or the one
   before, if none of those is mixed: its part of both is. `areas`: the first
   pass tells which show what; areas that are known are added up in the second. */
static void sum_run(doubt_job *f, uint32_t y, uint32_t x0, uint32_t x1, int areas, doubt_sums *sums)
{
    int shows = run_sample(f, y, x0, x1);
    shows = shows != PLAIN ? shows : run_beside(f, y - 1, x0, x1);
    shows = shows != PLAIN ? shows : run_beside(f, y + 1, x0, x1);
    shows = shows != PLAIN ? shows : run_behind(f, y, x0, x1) ? HIDDEN : PLAIN;
    sums->last = shows != PLAIN ? shows : sums->last;
    sums->shows[shows] = 1;
    if (areas != (shows != PLAIN)) {
        return;
    }
    lrcsi_pixels whole = f->job->row[y].whole;
    for (uint32_t x = x0; x < x1; x++) {
        if (x >= whole.x0 && whole.x1 > x && whole.x1 <= x1) { /* all at once */
            sums->area[shows] += whole.x1 - x;
            x = whole.x1 - 1;
            continue;
        }
        double share = doubt_share(f, x, y);
        sums->area[shows] += share;
        if (shows == PLAIN) {
            sums->square += share * share;
            sum_last(sums, share);
        }
    }
}

/* The runs of a row between mixed pixels, and those. */
static void sum_row(doubt_job *f, uint32_t y, int areas, doubt_sums *sums)
{
    const zbuffer_job *job = f->job;
    lrcsi_pixels touched = doubt_row(f, y)->touched;
    const uint64_t *crossed = job->crossed + (size_t)y * job->words;
    uint32_t from = touched.x0;
    for (uint32_t word = touched.x0 / BITS; word * BITS < touched.x1; word++) {
        uint64_t bits = crossed[word] & bit_range(word, touched.x0, touched.x1);
        for (; bits != 0; bits &= bits - 1) {
            uint32_t x = word * BITS + bit_lowest(bits);
            if (facet_clear(job, &f->sides, x, y)) {
                continue; /* like those that are not mixed */
            }
            if (from < x) {
                sum_run(f, y, from, x, areas, sums);
            }
            if (!areas) {
                sum_mixed(f, x, y, sums);
            }
            from = x + 1;
        }
    }
    if (from < touched.x1) {
        sum_run(f, y, from, touched.x1, areas, sums);
    }
}

/* The area, in pixels, that the facet has in rows y0 <= y < y1, at most: what is left of its sides
   between those two lines, joined along them. */
static double rows_area(const doubt_job *f, uint32_t y0, uint32_t y1)
{
    double inside[8][2];
    int count = 0;
    for (int k = 0; k < 3; k++) { /* cut off what is below y0, and above y1 */
        const double *a = f->corner[k];
        const double *b = f->corner[(k + 1) % 3];
        const double limit[2] = {a[1] < b[1] ? y0 : y1, a[1] < b[1] ? y1 : y0};
        double t[2] = {0, 1};
        for (int i = 0; i < 2; i++) {
            if (a[1] != b[1]) {
                double cut = (limit[i] - a[1]) / (b[1] - a[1]);
                t[i] = i == 0 ? lrcsi_most(0, cut) : lrcsi_least(1, cut);
            } else if (a[1] < y0 || a[1] > y1) {
                t[0] = 2;
            }
        }
        for (int i = 0; i < 2 && t[0] <= t[1]; i++) {
            inside[count][0] = a[0] + t[i] * (b[0] - a[0]);
            inside[count++][1] = a[1] + t[i] * (b[1] - a[1]);
        }
    }
    double twice = 0;
    for (int i = 2; i < count; i++) {
        twice += (inside[i - 1][0] - inside[0][0]) * (inside[i][1] - inside[0][1]) -
                 (inside[i][0] - inside[0][0]) * (inside[i - 1][1] - inside[0][1]);
    }
    /* corners are off by `off`, the area by that times its perimeter, below 8 N, rounding included
     */
    return 0.5 * fabs(twice) + 8 * f->job->raster.off * f->job->raster.size;
}

/* Rows y0 <= y < y1 without mixed pixels: what the facet has there is convex, and one sample tells
   of all. */
static void sum_block(doubt_job *f, uint32_t y0, uint32_t y1, int areas, doubt_sums *sums)
{
    const lrcsi_raster *r = &f->job->raster;
    uint32_t middle = y0 + (y1 - y0) / 2;
    int shows = PLAIN;
    for (uint32_t i = 0; i < y1 - y0 && shows == PLAIN; i++) {
        uint32_t y = y0 + (middle - y0 + i) % (y1 - y0);
        lrcsi_pixels sure = lrcsi_span_samples(&f->edges, y).sure;
        if (sure.x0 < sure.x1) {
            shows = r->owner[(size_t)y * r->size + sure.x0] == f->facet ? VISIBLE : HIDDEN;
        }
    }
    sums->shows[shows] = 1;
    sums->last = shows != PLAIN ? shows : sums->last;
    if (areas == (shows != PLAIN)) {
        double area = rows_area(f, y0, y1);
        sums->area[shows] += area;
        if (shows == PLAIN) {
            sums->square += area * area;
            sum_last(sums, area);
        }
    }
}

/* All rows. Blocks without mixed pixels end where a row has some in the box of the facet. */
static void sum_rows(doubt_job *f, int areas, doubt_sums *sums)
{
    const zbuffer_job *job = f->job;
    uint32_t from = f->edges.bottom;
    f->rows = from;
    for (uint32_t y = from; y < f->edges.top; y++) {
        if (!bit_any(job, job->crossed, y, f->edges.left, f->edges.right)) {
            continue;
        }
        if (from < y) {
            sum_block(f, from, y, areas, sums);
        }
        sum_row(f, y, areas, sums);
        from = y + 1;
    }
    if (from < f->edges.top) {
        sum_block(f, from, f->edges.top, areas, sums);
    }
}

/* What shows and what is hidden is added up only where there is both, in a second pass. Whole
   pixels are counted exactly. Of the rest at most 12 N are added up (along each row or column a
   side touches 4 at most), so that an addition rounds by at most 12 u N: less than each share
   gives. */
static doubt_sums doubt_sum(doubt_job *f)
{
    doubt_sums sums = {.last = PLAIN};
    f->job->chain[0].at = LRCS_NONE - 1;
    sum_rows(f, 0, &sums);
    if (sums.shows[HIDDEN] && sums.shows[VISIBLE]) {
        sum_rows(f, 1, &sums);
    }
    return sums;
}

/* The share of a facet that covers no sample: all or nothing, as the owner of the sample next to
   its centroid is farther or nearer there, but for a pixel. */
static double doubt_guess(const doubt_job *f)
{
    const zbuffer_job *job = f->job;
    const lrcsi_raster *r = &job->raster;
    const uint32_t *corner = job->view->prepared->scene->facet[f->facet].corner;
    double middle[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        middle[0] += f->corner[k][0] / 3;
        middle[1] += f->corner[k][1] / 3;
        middle[2] += job->view->point[corner[k]].x[2] / 3;
    }
    uint32_t owner =
        r->owner[(size_t)pixel_at(job, middle[1]) * r->size + pixel_at(job, middle[0])];
    if (owner == LRCS_NONE) {
        return 1;
    }
    lrcsi_plane plane = lrcsi_raster_plane(r, owner);
    double height = plane.at + plane.along * middle[0] + plane.up * middle[1];
    return middle[2] > height - r->pixel;
}

/* Pixel areas are side^2 / N^2 to a few roundings; 1e-12 of them is given away. */
static lrcsi_visible doubt_area(zbuffer_job *job, uint32_t facet)
{
    double area = lrcsi_view_projected(job->view, facet);
    double pixel = job->raster.pixel * job->raster.pixel * (1 + 1e-12);
    doubt_job f = doubt_start(job, facet);
    doubt_sums sums = doubt_sum(&f);
    lrcsi_visible v = {0, 0, area, 0, 0};
    if (!job->raster.undecided[facet]) {
        double doubt = sums.area[PLAIN] * pixel;
        v.low =
            sums.shows[VISIBLE]
                ? lrcsi_most(0, area - doubt - (sums.shows[HIDDEN] ? sums.area[HIDDEN] * pixel : 0))
                : 0;
        v.high =
            sums.shows[HIDDEN]
                ? lrcsi_least(area, doubt + (sums.shows[VISIBLE] ? sums.area[VISIBLE] * pixel : 0))
                : area;
        v.low = lrcsi_least(v.low, v.high);
    }
    double share = sums.told > 0                               ? sums.seen / sums.told
                   : sums.shows[VISIBLE] != sums.shows[HIDDEN] ? sums.shows[VISIBLE]
                                                               : doubt_guess(&f);
    v.area = v.low + share * (v.high - v.low);
    double square = HUGE_VAL;
    for (int k = 0; k < CHAINS; k++) {
        square = lrcsi_least(square, sums.starts[k]);
    }
    square += sums.square;
    v.likely =
        lrcsi_least(v.high - v.low, sqrt(LIKELY * (square + sums.longest * sums.longest)) * pixel);
    return v;
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Facets that touch no mixed pixel, and what samples tell of them. Returns how many they do not
   tell of. */
static uint32_t facets_plain(zbuffer_job *job)
{
    const lrcsi_raster *r = &job->raster;
    uint32_t untold = 0;
    for (uint32_t f = 0; f < job->view->prepared->scene->facet_count; f++) {
        job->state[f] = HIDDEN;
        if (job->cast[f] == 0) {
            continue;
        }
        if (job->answer && job->answer[f] != LRCSI_QUERY_UNDECIDED) {
            job->state[f] = job->answer[f] == LRCSI_QUERY_VISIBLE ? VISIBLE : HIDDEN;
        } else if (r->undecided[f] || facet_mixed(job, f)) {
            job->state[f] = PARTLY;
        } else if (r->sample[f] == LRCS_NONE) {
            job->state[f] = PLAIN;
            untold++;
        } else {
            job->state[f] = r->owner[r->sample[f]] == f ? VISIBLE : HIDDEN;
        }
    }
    return untold;
}

/* Facets without samples that touch no mixed pixel are seen as those are that they join (claim 2),
   or are farther than some t. */
static int facets_join(zbuffer_job *job, lrcs_work *work)
{
    uint32_t count = job->view->prepared->scene->facet_count;
    size_t mark = work->used;
    uint32_t *group = lrcsi_work_take(work, count, sizeof *group);
    unsigned char *told = lrcsi_work_take_zero(work, count, 1);
    if (!group || !told) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < count; f++) {
        job->cast[f] = (signed char)(job->state[f] == PARTLY ? 0 : job->cast[f]);
    }
    lrcsi_events_join(job->view, job->cast, group);
    for (uint32_t f = 0; f < count; f++) {
        if (job->cast[f] != 0 && job->state[f] != PLAIN) {
            told[group[f]] = job->state[f];
        }
    }
    for (uint32_t f = 0; f < count; f++) {
        if (job->state[f] == PLAIN) {
            job->state[f] = told[group[f]] != PLAIN ? told[group[f]] : PARTLY;
        }
    }
    work->used = mark;
    return LRCS_OK;
}

static void facets_areas(zbuffer_job *job, lrcsi_visible *visible, lrcsi_zbuffer *zbuffer)
{
    for (uint32_t f = 0; f < job->view->prepared->scene->facet_count; f++) {
        double area = job->state[f] == VISIBLE ? lrcsi_view_projected(job->view, f) : 0;
        visible[f] = (lrcsi_visible){area, area, area, 0, 0};
        if (job->state[f] == PARTLY) {
            visible[f] = doubt_area(job, f);
            zbuffer->partial += visible[f].low < visible[f].high;
        }
        zbuffer->undecided |= job->raster.undecided[f];
    }
}

/* --- all of it -------------------------------------------------------------------------------- */

/* Words of a bit map. */
static size_t map_words(uint32_t size)
{
    return (size_t)((size + BITS - 1) / BITS) * size;
}

size_t lrcsi_zbuffer_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t facets = prepared->scene->facet_count;
    size_t pixels = lrcsi_work_square(size);
    size_t need = lrcsi_raster_need(prepared, size);
    need = lrcsi_work_add(need, lrcsi_work_bytes(pixels, sizeof(float)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(pixels, 1));
    need = lrcsi_work_add(need, 2 * lrcsi_work_bytes(map_words(size), sizeof(uint64_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(lrcsi_row)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(5 * (size_t)size + 1, sizeof(doubt_chain)));
    size_t tiles = lrcsi_work_square((size - 1) / TILE + 1);
    need = lrcsi_work_add(need, 2 * lrcsi_work_bytes(tiles, sizeof(float)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(zbuffer_box)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets + 1, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
    size_t join =
        lrcsi_work_add(lrcsi_work_bytes(facets, sizeof(uint32_t)), lrcsi_work_bytes(facets, 1));
    size_t events = lrcsi_events_need(prepared);
    return lrcsi_work_add(need, lrcsi_work_add(join, events));
}

static int zbuffer_arrays(zbuffer_job *job, uint32_t size, lrcs_work *work)
{
    size_t facets = job->view->prepared->scene->facet_count;
    job->words = (size + BITS - 1) / BITS;
    job->event = lrcsi_work_take(work, lrcsi_work_square(size), sizeof *job->event);
    job->events = lrcsi_work_take(work, lrcsi_work_square(size), 1);
    job->met = lrcsi_work_take_zero(work, map_words(size), sizeof *job->met);
    job->crossed = lrcsi_work_take_zero(work, map_words(size), sizeof *job->crossed);
    job->row = lrcsi_work_take(work, size, sizeof *job->row);
    job->chain = lrcsi_work_take_zero(work, 5 * (size_t)size + 1, sizeof *job->chain);
    job->tiles = (size - 1) / TILE + 1;
    size_t tiles = lrcsi_work_square(job->tiles);
    job->tile_low = lrcsi_work_take(work, tiles, sizeof *job->tile_low);
    job->tile_high = lrcsi_work_take(work, tiles, sizeof *job->tile_high);
    job->box = lrcsi_work_take(work, facets, sizeof *job->box);
    job->cast = lrcsi_work_take_zero(work, facets + 1, 1);
    job->state = lrcsi_work_take(work, facets, 1);
    for (size_t i = 0; job->tile_low && job->tile_high && i < tiles; i++) {
        job->tile_low[i] = HUGE_VALF;
        job->tile_high[i] = -HUGE_VALF;
    }
    return job->chain && job->event && job->events && job->tile_low && job->tile_high && job->met &&
                   job->crossed && job->row && job->box && job->cast && job->state
               ? LRCS_OK
               : LRCS_E_MEMORY;
}

/* Which facets cast, and the pixels that they touch. */
static void zbuffer_boxes(zbuffer_job *job)
{
    const lrcsi_raster *r = &job->raster;
    double m = job->margin;
    for (uint32_t f = 0; f < job->view->prepared->scene->facet_count; f++) {
        if (!lrcsi_grid_casts(job->view, f)) {
            continue;
        }
        double low[2];
        double high[2];
        job->cast[f] = job->view->facing[f];
        lrcsi_grid_box(job->view, job->view->prepared->scene->facet[f].corner, 3, low, high);
        job->box[f] = (zbuffer_box){
            .x0 = (uint16_t)pixel_at(job, (low[0] - job->view->low[0]) * r->scale - m),
            .x1 = (uint16_t)(pixel_at(job, (high[0] - job->view->low[0]) * r->scale + m) + 1),
            .y0 = (uint16_t)pixel_at(job, (low[1] - job->view->low[1]) * r->scale - m),
            .y1 = (uint16_t)(pixel_at(job, (high[1] - job->view->low[1]) * r->scale + m) + 1)};
    }
}

static int zbuffer_run(zbuffer_job *job, uint32_t size, lrcs_work *work, lrcsi_visible *visible,
                       lrcsi_zbuffer *zbuffer)
{
    int status = lrcsi_raster_make(job->view, size, work, &job->raster);
    status = status == LRCS_OK ? zbuffer_arrays(job, size, work) : status;
    if (status != LRCS_OK) {
        return status;
    }
    job->margin = 4 * job->raster.off + MARGIN;
    job->cover = job->raster.depth;
    zbuffer_boxes(job);
    status = events_edges(job, work);
    if (status != LRCS_OK) {
        return status;
    }
    events_contacts(job);
    pixels_part(job);
    for (uint32_t f = 0; f < job->view->prepared->scene->facet_count; f++) {
        int covers = job->cast[f] != 0 && facet_covers(job, f);
        if (covers || (job->cast[f] != 0 && facet_passes(job, f))) {
            pixels_pass(job, f, covers);
        }
    }
    pixels_cover(job);
    if (!(job->raster.off < 0.25)) { /* samples may stand outside their pixels: nothing is sure */
        memset(job->crossed, 0xff, map_words(size) * sizeof *job->crossed);
    }
    if (facets_plain(job) != 0) {
        status = facets_join(job, work);
    }
    if (status == LRCS_OK) {
        facets_areas(job, visible, zbuffer);
    }
    return status;
}

int lrcsi_zbuffer_make(const lrcsi_view *view, uint32_t size, const unsigned char *answer,
                       lrcs_work *work, lrcsi_visible *visible, lrcsi_zbuffer *zbuffer)
{
    zbuffer_job job = {.view = view, .answer = answer};
    lrcsi_zbuffer made = {0, 0};
    size_t mark = work->used;
    int status = zbuffer_run(&job, size, work, visible, &made);
    work->used = mark;
    *zbuffer = status == LRCS_OK ? made : *zbuffer;
    return status;
}
