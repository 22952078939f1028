/* SPDX-License-Identifier: MIT */
/* Draws every facet into one z-buffer and counts samples. The owner of a sample is exact: heights
   in floats or doubles decide it where their error bounds suffice, which is nearly always;
   otherwise visibility/sample.h decides. The errors of areas are estimates; nothing is proved about
   them.

   The driver is lrcsi_preview_make:
   1. draw_facets. Depths are stored as floats. A facet is ordinary if the error of its heights, as
      floats, is below a millionth of the window's side; nearly all are. Ordinary facets are drawn
      first, several samples at once, and compared with the stored depths. The others (nearly
      edge-on, or extending far from the window) are drawn afterwards, sample by sample, with
      heights in doubles.
   2. count_samples: the samples that each facet owns, and the borders of its visible region.
   3. find_fractions: the visible fraction of each facet.
   4. bias_of_small_facets, preview_area: the areas, and their estimated errors. */
#include "visibility/preview.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/grid.h"
#include "visibility/sample.h"

/* The number of samples drawn at once. Samples beyond the end of a span are stored unchanged. */
enum { LANES = 8 };

/* The largest error of an ordinary facet's heights, relative to the window's side. */
#define ORDINARY_HEIGHT 0x1p-20

/* A border between the samples of two owners, followed along a row or column of pixels. */
typedef struct preview_border {
    uint32_t facet[2];     /* the owners on its two sides */
    uint32_t last, length; /* its last pixel, and for how many pixels it has continued */
} preview_border;

/* The samples of a facet, and the borders of its visible region. Borders to adjacent facets of the
   mesh do not count. */
typedef struct preview_counts {
    uint32_t covered, owned; /* samples */
    uint32_t borders;  /* pixels on borders beyond which the facet continues, hidden by others */
    uint32_t longest;  /* pixels on the longest of these along one row or column */
    uint32_t bordered; /* 1 if there is any border, also if the facet does not continue beyond it */
    float fraction;    /* its visible fraction */
    uint32_t round; /* the round in which it was found; 0: from samples; LRCS_NONE: not found yet */
} preview_counts;

/* Facets with fewer samples than this are corrected for bias (preview_bias). */
#define FEW_SAMPLES 16u

/* Over how many adjacent facets visible fractions propagate to facets without samples. */
enum { FRACTION_ROUNDS = 8 };

typedef struct preview_job {
    const lrcsi_view *view;
    lrcsi_raster raster; /* only its geometry (lrcsi_raster_layout) */
    uint32_t *owner;     /* N * N, row 0 at the bottom: facet, or LRCS_NONE */
    float *depth; /* N * N: height of an ordinary owner's plane; -HUGE_VALF if there is no owner */
    preview_counts *counts; /* facet */
    preview_border *column; /* column of pixels */
    double ordinary_err;    /* bound on the error of an ordinary facet's depth */
    double outline;         /* pairs of adjacent samples of which exactly one's owner reflects */
    int undecided;
} preview_job;

/* --- drawing ---------------------------------------------------------------------------------- */

/* Not a value of lrcsi_sample_order: it has not been computed yet. */
#define ORDER_UNKNOWN 2

/* A facet being drawn. */
typedef struct preview_facet {
    uint32_t facet;
    lrcsi_plane plane;
    double err; /* error bound of its heights */
    int ordinary;
    float tolerance; /* ordinary: floats do not decide between depths that differ by no more */
    /* The last owner for which floats did not decide: */
    uint32_t last_owner;    /* its facet, or LRCS_NONE */
    lrcsi_plane last_plane; /* its plane */
    double last_err;        /* the error of its heights */
    int last_order;         /* its lrcsi_sample_order; ORDER_UNKNOWN */
} preview_facet;

/* The height of a plane at the centre of a pixel. */
static double plane_height(const lrcsi_plane *plane, uint32_t x, uint32_t y)
{
    return plane->c + plane->dx * (x + 0.5) + plane->dy * (y + 0.5);
}

/* 1 if the facet is nearer than the owner of a sample that both cover: from heights in doubles,
   else exactly. */
static int preview_nearer(preview_job *job, preview_facet *f, uint32_t owner, uint32_t x,
                          uint32_t y)
{
    if (owner != f->last_owner) {
        f->last_owner = owner;
        f->last_plane = lrcsi_raster_plane(&job->raster, owner);
        f->last_err = lrcsi_raster_height_err(&job->raster, owner);
        f->last_order = ORDER_UNKNOWN;
    }
    double ahead = plane_height(&f->plane, x, y) - plane_height(&f->last_plane, x, y);
    if (fabs(ahead) > f->err + f->last_err) {
        return ahead > 0;
    }
    if (f->last_order == ORDER_UNKNOWN) {
        f->last_order = lrcsi_sample_order(job->view, f->facet, owner);
    }
    if (f->last_order != 0) {
        return f->last_order > 0;
    }
    double point[3];
    lrcsi_raster_sample(&job->raster, x, y, point);
    int nearer = lrcsi_sample_nearer(job->view, f->facet, owner, point, 1);
    job->undecided |= nearer == 0;
    return nearer > 0;
}

/* Makes the facet the owner of a sample that it covers, if it is nearer than the owner so far. */
static void draw_sample(preview_job *job, preview_facet *f, uint32_t x, uint32_t y)
{
    size_t i = (size_t)y * job->raster.size + x;
    if (job->owner[i] == LRCS_NONE || preview_nearer(job, f, job->owner[i], x, y)) {
        job->owner[i] = f->facet;
        job->depth[i] = (float)plane_height(&f->plane, x, y);
    }
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

/* Draws samples x0 <= x < x1 of a row, all of which the facet covers. Error of the float heights of
   an ordinary facet: with z the largest magnitude of a corner's depth, the heights of covered
   samples are at most z, and they change by at most 2 z along the span. Rounding the first height,
   the slope, two products and two sums adds less than 2^-21 z. */
static void draw_row_span(preview_job *job, preview_facet *f, uint32_t y, uint32_t x0, uint32_t x1)
{
    size_t start = (size_t)y * job->raster.size + x0;
    float first = (float)plane_height(&f->plane, x0, y);
    float slope = (float)f->plane.dx;
    uint32_t uncertainty = !f->ordinary;
    for (uint32_t i = 0; i < x1 - x0 && f->ordinary; i += LANES) {
        uncertainty |= draw_lanes(job->owner + start + i, job->depth + start + i,
                                  first + slope * (float)(int32_t)i, slope, f->tolerance, f->facet,
                                  (int32_t)(x1 - x0 - i));
    }
    for (uint32_t i = 0; i < x1 - x0 && uncertainty != 0; i++) { /* the undecided ones */
        float ahead = first + slope * (float)(int32_t)i - job->depth[start + i];
        if (job->owner[start + i] != f->facet && (!f->ordinary || ahead >= -f->tolerance)) {
            draw_sample(job, f, x0 + i, y);
        }
    }
    job->counts[f->facet].covered += x1 - x0;
}

/* Draws samples x0 <= x < x1 of a row for which edge functions do not decide whether the facet
   covers them. */
static inline void draw_if_covered(preview_job *job, preview_facet *f, uint32_t y, uint32_t x0,
                                   uint32_t x1)
{
    for (uint32_t x = x0; x < x1; x++) {
        double point[3];
        lrcsi_raster_sample(&job->raster, x, y, point);
        if (lrcsi_sample_covers(job->view, f->facet, point)) {
            draw_row_span(job, f, y, x, x + 1);
        }
    }
}

/* May a box of the view contain a sample? */
static int box_sampled(const lrcsi_raster *r, const double low[3], const double high[3])
{
    for (int k = 0; k < 2; k++) {
        double from = (low[k] - r->view->low[k]) * r->scale - r->sample_err - 0.5;
        double to = (high[k] - r->view->low[k]) * r->scale + r->sample_err - 0.5;
        if (from > 0 && floor(to) < from) {
            return 0;
        }
    }
    return 1;
}

/* Draws a facet if it is ordinary (`ordinary` 1), or if it is not (0). Returns 1 if it is ordinary;
   facets that certainly cover no sample count as ordinary. The last term of `err` covers subnormal
   floats. */
static int draw_facet(preview_job *job, uint32_t facet, int ordinary)
{
    double low[3];
    double high[3];
    lrcsi_view_bounds(job->view, job->view->prepared->scene->facet[facet].corner, 3, low, high);
    if (!box_sampled(&job->raster, low, high)) {
        return 1; /* as for most small facets */
    }
    preview_facet f = {.facet = facet, .last_owner = LRCS_NONE};
    f.plane = lrcsi_raster_plane(&job->raster, facet);
    f.err = lrcsi_raster_height_err(&job->raster, facet);
    double magnitude = lrcsi_max(fabs(low[2]), fabs(high[2])) + f.err;
    double err = f.err + 0x1p-21 * magnitude + 0x1p-140;
    f.ordinary = err <= job->ordinary_err;
    if (f.ordinary != ordinary) {
        return f.ordinary;
    }
    f.tolerance = f.ordinary ? (float)(1.01 * (err + job->ordinary_err)) : 0;
    lrcsi_edge_functions e = lrcsi_raster_edge_functions(&job->raster, facet);
    for (uint32_t y = e.y0; y < e.y1; y++) {
        lrcsi_sample_spans row = lrcsi_span_samples(&e, y);
        draw_if_covered(job, &f, y, row.possible.x0, row.certain.x0);
        if (row.certain.x0 < row.certain.x1) {
            draw_row_span(job, &f, y, row.certain.x0, row.certain.x1);
        }
        draw_if_covered(job, &f, y, row.certain.x1, row.possible.x1);
    }
    return f.ordinary;
}

static void draw_facets(preview_job *job)
{
    uint32_t others = 0; /* facets that are not ordinary and not drawn yet */
    uint32_t count = job->view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        others += lrcsi_view_casts(job->view, f) && !draw_facet(job, f, 1);
    }
    for (uint32_t f = 0; f < count && others > 0; f++) {
        others -= lrcsi_view_casts(job->view, f) && !draw_facet(job, f, 0);
    }
}

/* --- counting --------------------------------------------------------------------------------- */

/* Is there a border between owners a and b? Not if they are adjacent across a side of a. Either may
   be LRCS_NONE. */
static int is_border(const lrcs_prepared *p, uint32_t a, uint32_t b)
{
    if (a == LRCS_NONE || b == LRCS_NONE) {
        return 1;
    }
    const uint32_t *across = p->neighbours.facet[a].corner;
    return across[0] != b && across[1] != b && across[2] != b;
}

/* Does a facet cover the sample beyond a border, where another owner hides it? Only such borders
   cause errors of the visible fraction: at the facet's own sides, the numbers of its visible and of
   its covered samples have the same error. */
static int continues_beyond(const preview_job *job, uint32_t facet, uint32_t x, uint32_t y)
{
    const lrcsi_raster *r = &job->raster;
    const uint32_t *corner = job->view->prepared->scene->facet[facet].corner;
    const double at[2] = {job->view->low[0] + (x + 0.5) * r->pixel,
                          job->view->low[1] + (y + 0.5) * r->pixel};
    for (int k = 0; k < 3; k++) {
        const double *a = job->view->point[corner[k]].x;
        const double *b = job->view->point[corner[(k + 1) % 3]].x;
        double side = (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
        if (job->view->facing[facet] * side < 0) {
            return 0;
        }
    }
    return 1;
}

/* The owner of the sample at x, y. */
typedef struct preview_owned {
    uint32_t facet, x, y;
} preview_owned;

static int preview_reflects(const preview_job *job, uint32_t owner)
{
    return owner != LRCS_NONE && lrcsi_view_reflects(job->view, owner);
}

/* Counts the border between two adjacent samples of different owners; `position` is their pixel
   along the border. */
static void count_border(preview_job *job, preview_border *border, uint32_t position,
                         preview_owned a, preview_owned b)
{
    job->outline += preview_reflects(job, a.facet) != preview_reflects(job, b.facet);
    if (!is_border(job->view->prepared, a.facet, b.facet)) {
        return;
    }
    int continues =
        border->last + 1 == position && border->facet[0] == a.facet && border->facet[1] == b.facet;
    *border = (preview_border){{a.facet, b.facet}, position, continues ? border->length + 1 : 1};
    for (int k = 0; k < 2; k++) {
        const preview_owned *beyond = k == 0 ? &b : &a;
        uint32_t facet = border->facet[k];
        if (facet == LRCS_NONE) {
            continue;
        }
        preview_counts *c = &job->counts[facet];
        c->bordered = 1;
        if (continues_beyond(job, facet, beyond->x, beyond->y)) {
            c->borders++;
            c->longest = c->longest > border->length ? c->longest : border->length;
        }
    }
}

/* Counts the samples that each facet owns, and the borders between owners. Borders along rows are
   followed in `along`, borders along columns in job->column. */
static void count_samples(preview_job *job)
{
    uint32_t size = job->raster.size;
    for (uint32_t y = 0; y < size; y++) {
        const uint32_t *row = job->owner + (size_t)y * size;
        const uint32_t *next = y + 1 < size ? row + size : row;
        preview_border along = {{LRCS_NONE, LRCS_NONE}, LRCS_NONE - 1, 0};
        uint32_t from = 0; /* the first sample of a run of samples with the same owner */
        for (uint32_t x = 0; x < size; x++) {
            uint32_t owner = row[x];
            if (next[x] != owner) {
                count_border(job, &along, x, (preview_owned){owner, x, y},
                             (preview_owned){next[x], x, y + 1});
            }
            if (x + 1 < size && row[x + 1] == owner) {
                continue;
            }
            if (owner != LRCS_NONE) {
                job->counts[owner].owned += x + 1 - from;
            }
            from = x + 1;
            if (x + 1 < size) {
                count_border(job, &job->column[x], y + 1, (preview_owned){owner, x, y},
                             (preview_owned){row[x + 1], x + 1, y});
            }
        }
    }
}

/* --- areas ------------------------------------------------------------------------------------ */

/* The visible fraction of a facet from its centroid: 1 if that is at most a pixel behind the plane
   of the owner of the nearest sample, else 0. */
static float fraction_by_depth(const preview_job *job, uint32_t facet)
{
    const lrcsi_raster *r = &job->raster;
    const uint32_t *corner = job->view->prepared->scene->facet[facet].corner;
    double middle[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        double xy[2];
        lrcsi_raster_point(r, corner[k], xy);
        middle[0] += xy[0] / 3;
        middle[1] += xy[1] / 3;
        middle[2] += job->view->point[corner[k]].x[2] / 3;
    }
    uint32_t x = (uint32_t)lrcsi_min(lrcsi_max(middle[0], 0), r->size - 1.0);
    uint32_t y = (uint32_t)lrcsi_min(lrcsi_max(middle[1], 0), r->size - 1.0);
    uint32_t owner = job->owner[(size_t)y * r->size + x];
    if (owner == LRCS_NONE) {
        return 1;
    }
    lrcsi_plane plane = lrcsi_raster_plane(r, owner);
    double height = plane.c + plane.dx * middle[0] + plane.dy * middle[1];
    return middle[2] > height - r->pixel;
}

/* The visible fraction of a facet without samples: the mean over the neighbours whose fractions
   were found in earlier rounds. Returns 0 if there are none. */
static int fraction_by_neighbours(const preview_job *job, uint32_t facet, uint32_t round,
                                  float *fraction)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t *across = p->neighbours.facet[facet].corner;
    float sum = 0;
    float count = 0;
    for (int k = 0; k < 3; k++) {
        if (across[k] != facet && across[k] != p->scene->facet_count &&
            job->counts[across[k]].round < round) {
            sum += job->counts[across[k]].fraction;
            count += 1;
        }
    }
    *fraction = count > 0 ? sum / count : 0;
    return count > 0;
}

/* The visible fractions of all facets: of facets with samples from these; of others from adjacent
   facets, in rounds, so that the result does not depend on the order of facets; or, failing that,
   from the depth of the centroid. */
static void find_fractions(preview_job *job)
{
    uint32_t facets = job->view->prepared->scene->facet_count;
    for (uint32_t f = 0; f < facets; f++) {
        preview_counts *c = &job->counts[f];
        c->round = c->covered != 0 ? 0 : LRCS_NONE;
        c->fraction = c->covered != 0 ? (float)c->owned / (float)c->covered : 0;
    }
    for (uint32_t round = 1; round <= FRACTION_ROUNDS + 1; round++) {
        for (uint32_t f = 0; f < facets; f++) {
            preview_counts *c = &job->counts[f];
            float fraction;
            if (c->round == LRCS_NONE && lrcsi_view_casts(job->view, f) &&
                (fraction_by_neighbours(job, f, round, &fraction) || round > FRACTION_ROUNDS)) {
                c->fraction = round > FRACTION_ROUNDS ? fraction_by_depth(job, f) : fraction;
                c->round = round;
            }
        }
    }
}

/* The square of the estimated error of one pixel on a border: two standard deviations, which one
   error in twenty exceeds. The visible fraction of such a pixel is about uniformly distributed, and
   it is rounded to 0 or 1: the error is at most half a pixel, and its mean square is 1 / 12. The
   errors of pixels are independent, except along a border parallel to a row or column, where all
   are equal: therefore the longest such border is added with the square of its length. */
#define PIXEL_ERROR_SQUARE (4.0 / 12)

/* The total visible area of facets with few samples can be computed in two ways: from their visible
   fractions, and from all samples whose owners reflect, minus the areas of facets with many
   samples. The second has no bias, only a random error along the outline of the reflecting region.
   Therefore the fractions are corrected towards it. If the two differ by d, and the second has an
   estimated random error e, the correction is d^3 / (d^2 + e^2): nearly all of d if d is much
   larger than e, and little of it if d is smaller. The remaining bias is estimated as twice the
   uncorrected part of d, because one correction is applied to facets that reflect differently, plus
   the part of the correction that exceeds the areas to which it applies. */
typedef struct preview_bias {
    double less; /* subtracted, relative to a facet's visible area */
    double more; /* added, relative to the hidden area of a facet of which something is visible */
    double left; /* the estimated remaining bias, relative to its visible area */
} preview_bias;

/* Is the facet corrected for bias? */
static int few_samples(const preview_job *job, uint32_t facet)
{
    return job->counts[facet].covered < FEW_SAMPLES && job->counts[facet].fraction > 0 &&
           lrcsi_view_reflects(job->view, facet);
}

/* The correction of facets with few samples, from the difference described above. */
static preview_bias bias_of_small_facets(const preview_job *job)
{
    double pixel = job->raster.pixel * job->raster.pixel;
    double excess = 0;  /* area by visible fractions minus area by samples */
    double visible = 0; /* visible area of facets with few samples */
    double hidden = 0;  /* their hidden area */
    for (uint32_t f = 0; f < job->view->prepared->scene->facet_count; f++) {
        const preview_counts *c = &job->counts[f];
        if (lrcsi_view_casts(job->view, f) && c->fraction > 0 &&
            lrcsi_view_reflects(job->view, f)) {
            double area = lrcsi_view_projected(job->view, f);
            double by_fraction = area * (double)c->fraction;
            excess += by_fraction - pixel * c->owned;
            visible += c->covered < FEW_SAMPLES ? by_fraction : 0;
            hidden += c->covered < FEW_SAMPLES ? area - by_fraction : 0;
        }
    }
    double random_error = sqrt(PIXEL_ERROR_SQUARE * job->outline) * pixel;
    double both = sqrt(excess * excess + random_error * random_error);
    preview_bias bias = {0, 0, 0};
    if (both > 0 && visible > 0) {
        double correction = excess * (excess / both) * (excess / both);
        double applied = lrcsi_min(visible, lrcsi_max(-hidden, correction));
        bias.less = applied > 0 ? applied / visible : 0;
        bias.more = applied < 0 ? -applied / hidden : 0;
        bias.left =
            (2 * fabs(excess) * (random_error / both) + fabs(correction - applied)) / visible;
    }
    return bias;
}

static lrcsi_visible preview_area(const preview_job *job, uint32_t facet, const preview_bias *bias)
{
    const preview_counts *c = &job->counts[facet];
    double area = lrcsi_view_projected(job->view, facet);
    double pixel = job->raster.pixel * job->raster.pixel;
    lrcsi_visible v = {0, 0, area, 0, 0};
    v.area = area * (double)c->fraction;
    if (few_samples(job, facet)) {
        v.bias = bias->left * v.area;
        v.area += bias->more * (area - v.area) - bias->less * v.area;
        v.area = lrcsi_min(area, lrcsi_max(0, v.area));
    }
    if (c->covered == 0) {
        v.error_estimate = sqrt(PIXEL_ERROR_SQUARE) * area;
    } else if (c->owned != 0) { /* a facet that owns all: a strip at a border may be hidden */
        double square = c->borders + (double)c->longest * c->longest;
        square = c->owned != c->covered ? square : c->bordered;
        v.error_estimate = lrcsi_min(area, sqrt(PIXEL_ERROR_SQUARE * square) * pixel);
    }
    return v;
}

/* --- the whole preview ------------------------------------------------------------------------ */

/* The number of samples, with room for LANES samples after the last one. */
static size_t sample_room(uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_square(size), LANES);
}

size_t lrcsi_preview_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes(sample_room(size), sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(sample_room(size), sizeof(float)));
    need = lrcsi_work_add(need,
                          lrcsi_work_bytes(prepared->scene->facet_count, sizeof(preview_counts)));
    return lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(preview_border)));
}

int lrcsi_preview_make(const lrcsi_view *view, uint32_t size, lrcs_work *work,
                       lrcsi_visible *visible, int *undecided)
{
    const uint32_t facets = view->prepared->scene->facet_count;
    const size_t samples = sample_room(size);
    const size_t mark = work->used;
    preview_job job = {.view = view, .ordinary_err = ORDINARY_HEIGHT * view->side};
    lrcsi_raster_layout(view, size, &job.raster);
    job.owner = lrcsi_work_take(work, samples, sizeof *job.owner);
    job.depth = lrcsi_work_take(work, samples, sizeof *job.depth);
    job.counts = lrcsi_work_take_zero(work, facets, sizeof *job.counts);
    job.column = lrcsi_work_take_zero(work, size, sizeof *job.column);
    if (!job.owner || !job.depth || !job.counts || !job.column) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    memset(job.owner, 0xff, samples * sizeof *job.owner); /* LRCS_NONE */
    for (size_t i = 0; i < samples; i++) {
        job.depth[i] = -HUGE_VALF;
    }
    draw_facets(&job);
    count_samples(&job);
    find_fractions(&job);
    const preview_bias bias = bias_of_small_facets(&job);
    for (uint32_t f = 0; f < facets; f++) {
        visible[f] = lrcsi_view_casts(view, f) ? preview_area(&job, f, &bias)
                                               : (lrcsi_visible){0, 0, 0, 0, 0};
    }
    *undecided = job.undecided;
    work->used = mark;
    return LRCS_OK;
}
