/* SPDX-License-Identifier: MIT */
/* Draws every facet into one z-buffer and counts samples. Their owners are exact; the errors of
   areas are estimates, and nothing is proved about them.

   The driver is lrcsi_preview_make:
   1. lrcsi_raster_make: the owners of all samples.
   2. count_borders: the borders of each facet's visible region.
   3. find_fractions: the visible fraction of each facet.
   4. bias_of_small_facets, preview_area: the areas, and their estimated errors. */
#include "visibility/raster/preview.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/raster/raster.h"

/* A border between the samples of two owners, followed along a row or column of pixels. */
typedef struct preview_border {
    uint32_t facet[2];     /* the owners on its two sides */
    uint32_t last, length; /* its last pixel, and for how many pixels it has continued */
} preview_border;

/* The borders of a facet's visible region, and its fraction. Borders to adjacent facets of the mesh
   do not count. */
typedef struct preview_counts {
    uint32_t borders;  /* pixels on borders beyond which the facet continues, hidden by others */
    uint32_t longest;  /* pixels on the longest of these along one row or column */
    uint32_t bordered; /* 1 if there is any border, also if the facet does not continue beyond it */
    float fraction;    /* its visible fraction */
    uint32_t round; /* the round in which it was found; 0: from samples; LRCS_NONE: not found yet */
} preview_counts;

/* Facets with fewer samples than this are corrected for bias (preview_bias). Heuristic. */
#define FEW_SAMPLES 16u

/* Heuristic: over how many adjacent facets visible fractions propagate to facets without samples.
 */
enum { FRACTION_ROUNDS = 8 };

typedef struct preview_job {
    const lrcsi_view *view;
    lrcsi_raster raster;
    preview_counts *counts; /* facet */
    preview_border *column; /* column of pixels */
    double outline;         /* pairs of adjacent samples of which exactly one's owner reflects */
} preview_job;

/* --- counting --------------------------------------------------------------------------------- */

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
typedef struct preview_sample {
    uint32_t facet, x, y;
} preview_sample;

static int preview_reflects(const preview_job *job, uint32_t owner)
{
    return owner != LRCS_NONE && lrcsi_view_reflects(job->view, owner);
}

/* Counts the border between two adjacent samples of different owners; `position` is their pixel
   along the border. There is none between facets that are adjacent across a side of a. */
static void count_border(preview_job *job, preview_border *border, uint32_t position,
                         preview_sample a, preview_sample b)
{
    job->outline += preview_reflects(job, a.facet) != preview_reflects(job, b.facet);
    if (a.facet != LRCS_NONE && b.facet != LRCS_NONE) {
        const uint32_t *across = job->view->prepared->neighbours.facet[a.facet].corner;
        if (across[0] == b.facet || across[1] == b.facet || across[2] == b.facet) {
            return;
        }
    }
    int continues =
        border->last + 1 == position && border->facet[0] == a.facet && border->facet[1] == b.facet;
    *border = (preview_border){{a.facet, b.facet}, position, continues ? border->length + 1 : 1};
    for (int k = 0; k < 2; k++) {
        const preview_sample *beyond = k == 0 ? &b : &a;
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

/* Counts the borders between owners. Those along rows are followed in `along`, those along columns
   in job->column. */
static void count_borders(preview_job *job)
{
    uint32_t size = job->raster.size;
    for (uint32_t y = 0; y < size; y++) {
        const uint32_t *row = job->raster.owner + (size_t)y * size;
        const uint32_t *next = y + 1 < size ? row + size : row;
        preview_border along = {{LRCS_NONE, LRCS_NONE}, LRCS_NONE - 1, 0};
        for (uint32_t x = 0; x < size; x++) {
            uint32_t owner = row[x];
            if (next[x] != owner) {
                count_border(job, &along, x, (preview_sample){owner, x, y},
                             (preview_sample){next[x], x, y + 1});
            }
            if (x + 1 < size && row[x + 1] != owner) {
                count_border(job, &job->column[x], y + 1, (preview_sample){owner, x, y},
                             (preview_sample){row[x + 1], x + 1, y});
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
    uint32_t owner = r->owner[(size_t)y * r->size + x];
    if (owner == LRCS_NONE) {
        return 1;
    }
    lrcsi_plane plane = lrcsi_raster_plane(r, owner);
    double height = plane.c + plane.dx * middle[0] + plane.dy * middle[1];
    return middle[2] > height - r->pixel;
}

/* The visible fractions of all facets:
   1. for facets with samples, from these;
   2. for others, the mean over the adjacent facets whose fractions are known: in rounds, each from
      what earlier rounds found, so that the result does not depend on the order of facets;
   3. in the last round, for those that remain, from the depth of the centroid. */
static void find_fractions(preview_job *job)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t facets = p->scene->facet_count;
    for (uint32_t f = 0; f < facets; f++) {
        preview_counts *c = &job->counts[f];
        uint32_t covered = job->raster.covered[f];
        c->round = covered != 0 ? 0 : LRCS_NONE;
        c->fraction = covered != 0 ? (float)job->raster.owned[f] / (float)covered : 0;
    }
    for (uint32_t round = 1; round <= FRACTION_ROUNDS + 1; round++) {
        for (uint32_t f = 0; f < facets; f++) {
            preview_counts *c = &job->counts[f];
            const uint32_t *across = p->neighbours.facet[f].corner;
            float sum = 0;
            float known = 0;
            if (c->round != LRCS_NONE || !lrcsi_view_casts(job->view, f)) {
                continue;
            }
            for (int k = 0; k < 3; k++) {
                if (across[k] != f && across[k] != facets && job->counts[across[k]].round < round) {
                    sum += job->counts[across[k]].fraction;
                    known += 1;
                }
            }
            if (round > FRACTION_ROUNDS) {
                c->fraction = fraction_by_depth(job, f);
                c->round = round;
            } else if (known > 0) {
                c->fraction = sum / known;
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

/* The areas of facets with few samples are corrected for bias, by d^3 / (d^2 + e^2) in total. Here
   d is the difference between two values of their total visible area: that from their visible
   fractions, and that from all samples whose owners reflect, minus the areas of facets with many
   samples. The second value has no bias, only a random error e along the outline of the reflecting
   region. So nearly all of d is corrected if d is much larger than e, and little of it if d is
   smaller. The remaining bias is estimated as twice the uncorrected part of d, because one
   correction is applied to facets that reflect differently, plus the part of the correction that
   exceeds the areas to which it applies. */
typedef struct preview_bias {
    double reduce;    /* subtracted, relative to a facet's visible area */
    double enlarge;   /* added, relative to the hidden area of a facet of which something is
                         visible */
    double remaining; /* the estimated remaining bias, relative to its visible area */
} preview_bias;

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
            excess += by_fraction - pixel * job->raster.owned[f];
            visible += job->raster.covered[f] < FEW_SAMPLES ? by_fraction : 0;
            hidden += job->raster.covered[f] < FEW_SAMPLES ? area - by_fraction : 0;
        }
    }
    double random_error = sqrt(PIXEL_ERROR_SQUARE * job->outline) * pixel;
    double both = sqrt(excess * excess + random_error * random_error);
    preview_bias bias = {0, 0, 0};
    if (both > 0 && visible > 0) {
        double correction = excess * (excess / both) * (excess / both);
        double applied = lrcsi_min(visible, lrcsi_max(-hidden, correction));
        bias.reduce = applied > 0 ? applied / visible : 0;
        bias.enlarge = applied < 0 ? -applied / hidden : 0;
        bias.remaining =
            (2 * fabs(excess) * (random_error / both) + fabs(correction - applied)) / visible;
    }
    return bias;
}

static lrcsi_visible_area preview_area(const preview_job *job, uint32_t facet,
                                       const preview_bias *bias)
{
    const preview_counts *c = &job->counts[facet];
    double area = lrcsi_view_projected(job->view, facet);
    double pixel = job->raster.pixel * job->raster.pixel;
    uint32_t covered = job->raster.covered[facet];
    uint32_t owned = job->raster.owned[facet];
    lrcsi_visible_area v = {0, 0, area, 0, 0};
    v.area = area * (double)c->fraction;
    if (covered < FEW_SAMPLES && c->fraction > 0 && lrcsi_view_reflects(job->view, facet)) {
        v.bias = bias->remaining * v.area;
        v.area += bias->enlarge * (area - v.area) - bias->reduce * v.area;
        v.area = lrcsi_min(area, lrcsi_max(0, v.area));
    }
    if (covered == 0) {
        v.error_estimate = sqrt(PIXEL_ERROR_SQUARE) * area;
    } else if (owned != 0) { /* one that owns all: a part at a border may be hidden */
        double square = c->borders + (double)c->longest * c->longest;
        square = owned != covered ? square : c->bordered;
        v.error_estimate = lrcsi_min(area, sqrt(PIXEL_ERROR_SQUARE * square) * pixel);
    }
    return v;
}

/* --- the whole preview ------------------------------------------------------------------------ */

size_t lrcsi_preview_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t need = lrcsi_work_bytes(prepared->scene->facet_count, sizeof(preview_counts));
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, sizeof(preview_border)));
    return lrcsi_work_add(need, lrcsi_raster_need(prepared, size, 0));
}

int lrcsi_preview_make(const lrcsi_view *view, uint32_t size, lrcs_progress *progress,
                       lrcs_work *work, lrcsi_visible_area *visible, int *depth_undecided)
{
    const uint32_t facets = view->prepared->scene->facet_count;
    const size_t mark = work->used;
    preview_job job = {.view = view};
    int status = lrcsi_raster_make(view, size, NULL, progress, work, &job.raster);
    if (status == LRCS_OK) {
        job.counts = lrcsi_work_take_zero(work, facets, sizeof *job.counts);
        job.column = lrcsi_work_take_zero(work, size, sizeof *job.column);
        status = job.counts && job.column ? LRCS_OK : LRCS_E_MEMORY;
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    count_borders(&job);
    find_fractions(&job);
    const preview_bias bias = bias_of_small_facets(&job);
    *depth_undecided = 0;
    for (uint32_t f = 0; f < facets; f++) {
        visible[f] =
            lrcsi_view_casts(view, f) ? preview_area(&job, f, &bias) : lrcsi_visible_area_exact(0);
        *depth_undecided |= job.raster.order_undecided[f];
    }
    work->used = mark;
    return LRCS_OK;
}
