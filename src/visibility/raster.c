/* SPDX-License-Identifier: MIT */
/* Drawing facets into the item buffer. It decides which pixels to ask and answers what floats and
   doubles can prove; the rest it asks of visibility/sample.h. What the samples mean for areas is
   not its business. */
#include "visibility/raster.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/grid.h"
#include "visibility/sample.h"

#define U 0x1p-53

/* Samples drawn side by side: what a run stores beyond its end is what was there before. */
enum { LANES = 8 };

/* --- geometry in pixels ----------------------------------------------------------------------- */

void lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2])
{
    const double *p = raster->view->point[vertex].x;
    xy[0] = (p[0] - raster->view->low[0]) * raster->scale;
    xy[1] = (p[1] - raster->view->low[1]) * raster->scale;
}

/* First pixel whose centre is not left of `x` less its error, kept within 0 .. size. */
static inline uint32_t pixel_from(const lrcsi_raster *raster, double x)
{
    double least = lrcsi_least(lrcsi_most(x - 0.5 - raster->off, 0), raster->size);
    uint32_t pixel = (uint32_t)least;
    return pixel < least ? pixel + 1 : pixel;
}

/* One past the last pixel whose centre is not right of `x` plus its error. */
static inline uint32_t pixel_to(const lrcsi_raster *raster, double x)
{
    return (uint32_t)lrcsi_least(lrcsi_most(x + 0.5 + raster->off, 0), raster->size);
}

static inline void edges_corners(const lrcsi_raster *raster, uint32_t facet, double p[3][2])
{
    const uint32_t *corner = raster->view->prepared->scene->facet[facet].corner;
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(raster, corner[k], p[k]);
    }
}

/* The box of the corners, and the pixels whose centres the facet may cover. */
static inline void edges_box(const lrcsi_raster *r, double p[3][2], lrcsi_edges *e)
{
    double x0 = lrcsi_least(p[0][0], lrcsi_least(p[1][0], p[2][0]));
    double x1 = lrcsi_most(p[0][0], lrcsi_most(p[1][0], p[2][0]));
    double y0 = lrcsi_least(p[0][1], lrcsi_least(p[1][1], p[2][1]));
    double y1 = lrcsi_most(p[0][1], lrcsi_most(p[1][1], p[2][1]));
    e->off = 8 * r->off * (x1 - x0 + y1 - y0 + 2);
    e->x0 = pixel_from(r, x0);
    e->x1 = pixel_to(r, x1);
    e->y0 = pixel_from(r, y0);
    e->y1 = pixel_to(r, y1);
}

/* Corners are off by `off`, and so is the sample; with |q - p| and |sample - p| at most the box's
   half perimeter h and the margin of a pixel, the cross product is off by at most 4 off (h + 2).
   Roundings add 2 u N h for `at`, u N h for the differences and 5 u N h for the value, together at
   most off h. */
static inline void edges_fill(const lrcsi_raster *raster, int facing, double p[3][2],
                              lrcsi_edges *e)
{
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        e->along[k] = -facing * (b[1] - a[1]);
        e->up[k] = facing * (b[0] - a[0]);
        e->at[k] = -(e->along[k] * a[0] + e->up[k] * a[1]);
    }
    e->left = e->x0 > 0 ? e->x0 - 1 : 0;
    e->right = e->x1 < raster->size ? e->x1 + 1 : raster->size;
    e->bottom = e->y0 > 0 ? e->y0 - 1 : 0;
    e->top = e->y1 < raster->size ? e->y1 + 1 : raster->size;
    lrcsi_span_prepare(e);
}

lrcsi_edges lrcsi_raster_edges(const lrcsi_raster *raster, uint32_t facet)
{
    lrcsi_edges e;
    double p[3][2];
    edges_corners(raster, facet, p);
    edges_box(raster, p, &e);
    edges_fill(raster, raster->view->facing[facet], p, &e);
    return e;
}

/* N . R rows in doubles: each off by 8 u |N|.
   A height: numerator terms below 2 |N| radius, each off by 16 u of that, and corners by view->off,
   all over |N| |cos|; the denominator's own error moves a height that lies within the scene by as
   much again. view->off holds 32 u (radius + reach). Edge-on, nothing is decided by the plane. */
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet)
{
    const lrcsi_view *view = raster->view;
    const lrcsi_normal *normal = &view->prepared->normal[facet];
    double n[3];
    for (int k = 0; k < 3; k++) {
        n[k] = view->R[k][0] * normal->high[0] + view->R[k][1] * normal->high[1] +
               view->R[k][2] * normal->high[2];
    }
    const double *a = view->point[view->prepared->scene->facet[facet].corner[0]].x;
    double inverse = n[2] != 0 ? 1 / n[2] : 0;
    double along = -n[0] * inverse;
    double up = -n[1] * inverse;
    double cosine = fabs(n[2]);
    lrcsi_plane plane;
    plane.at = a[2] - along * (a[0] - view->low[0]) - up * (a[1] - view->low[1]);
    plane.along = along * raster->pixel;
    plane.up = up * raster->pixel;
    plane.err =
        cosine > 64 * U * normal->length ? 8 * view->off * normal->length / cosine : HUGE_VAL;
    return plane;
}

/* --- facets ----------------------------------------------------------------------------------- */

/* A facet being drawn. */
typedef struct raster_job {
    lrcsi_raster *raster;
    uint32_t facet;
    lrcsi_plane plane;
    int ordinary;
    float close;           /* ordinary: depths that differ by no more are not told apart */
    float far;             /* else: no height of the facet is less */
    uint32_t met;          /* the owner last met at a depth too close for floats, or LRCS_NONE, */
    lrcsi_plane met_plane; /* its plane, */
    int met_order, met_asked; /* and, once asked, its lrcsi_sample_order */
} raster_job;

static void sample_point(const lrcsi_raster *r, uint32_t x, uint32_t y, double point[3])
{
    lrcsi_view_lift(r->view, r->view->low[0] + (x + 0.5) * r->pixel,
                    r->view->low[1] + (y + 0.5) * r->pixel, point);
}

static double plane_height(const lrcsi_plane *plane, uint32_t x, uint32_t y)
{
    return plane->at + plane->along * (x + 0.5) + plane->up * (y + 0.5);
}

/* Is the facet nearer than the owner of a sample that both cover? From heights in doubles, computed
   anew, else exactly. */
static int job_nearer(raster_job *job, uint32_t owner, uint32_t x, uint32_t y)
{
    lrcsi_raster *r = job->raster;
    if (owner != job->met) {
        job->met = owner;
        job->met_plane = lrcsi_raster_plane(r, owner);
        job->met_asked = 0;
    }
    double ahead = plane_height(&job->plane, x, y) - plane_height(&job->met_plane, x, y);
    if (fabs(ahead) > job->plane.err + job->met_plane.err) {
        return ahead > 0;
    }
    if (!job->met_asked) {
        job->met_asked = 1;
        job->met_order = lrcsi_sample_order(r->view, job->facet, owner);
    }
    if (job->met_order != 0) {
        return job->met_order > 0;
    }
    double point[3];
    sample_point(r, x, y, point);
    int nearer = lrcsi_sample_nearer(r->view, job->facet, owner, point, 1);
    r->undecided[job->facet] |= nearer == 0;
    r->undecided[owner] |= nearer == 0;
    return nearer > 0;
}

/* Gives the facet a sample that it covers, if it is nearer than the owner. */
static void draw_sample(raster_job *job, uint32_t x, uint32_t y)
{
    lrcsi_raster *r = job->raster;
    size_t at = (size_t)y * r->size + x;
    if (r->owner[at] == LRCS_NONE || job_nearer(job, r->owner[at], x, y)) {
        r->owner[at] = job->facet;
        r->depth[at] = job->ordinary ? (float)plane_height(&job->plane, x, y) : job->far;
    }
}

/* Gives the facet those of the first `left` of LANES samples at which it is surely nearer. Returns
   bits of which some are set where there are others at which it is not surely farther. Masks in the
   place of branches: so compilers do the lanes at once. */
static inline uint32_t draw_lanes(uint32_t *restrict owner, float *restrict depth, float first,
                                  float along, float close, uint32_t facet, int32_t left)
{
    uint32_t doubt[LANES];
    for (int32_t k = 0; k < LANES; k++) {
        float height = first + along * (float)k;
        float ahead = height - depth[k];
        uint32_t within = 0u - (uint32_t)(k < left);
        uint32_t nearer = (0u - (uint32_t)(ahead > close)) & within;
        uint32_t close_by = (0u - (uint32_t)(ahead >= -close)) & within;
        uint32_t new_bits;
        uint32_t bits;
        memcpy(&new_bits, &height, sizeof bits);
        memcpy(&bits, &depth[k], sizeof bits);
        bits = (new_bits & nearer) | (bits & ~nearer);
        memcpy(&depth[k], &bits, sizeof bits);
        owner[k] = (facet & nearer) | (owner[k] & ~nearer);
        doubt[k] = close_by & ~nearer;
    }
    uint32_t any = 0;
    for (int32_t k = 0; k < LANES; k++) {
        any |= doubt[k];
    }
    return any;
}

/* Samples x0 <= x < x1 of a row, which an ordinary facet covers. The float heights: with z the
   largest magnitude of a corner's depth, those of samples covered and what they change along the
   run are at most z and 2 z; rounding the first, the slope, two products and two sums costs less
   than 2^-21 z. */
static void draw_ordinary(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    lrcsi_raster *r = job->raster;
    size_t at = (size_t)y * r->size + x0;
    float first = (float)plane_height(&job->plane, x0, y);
    float along = (float)job->plane.along;
    uint32_t doubt = 0;
    for (uint32_t i = 0; i < x1 - x0; i += LANES) {
        doubt |= draw_lanes(r->owner + at + i, r->depth + at + i, first + along * (float)(int32_t)i,
                            along, job->close, job->facet, (int32_t)(x1 - x0 - i));
    }
    if (doubt == 0) {
        return;
    }
    for (uint32_t i = 0; i < x1 - x0; i++) { /* those in doubt, one by one */
        float ahead = first + along * (float)(int32_t)i - r->depth[at + i];
        if (r->owner[at + i] != job->facet && ahead >= -job->close) {
            draw_sample(job, x0 + i, y);
        }
    }
}

static void draw_run(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    if (x0 == x1) {
        return;
    }
    job->raster->sample[job->facet] = y * job->raster->size + x0;
    if (job->ordinary) {
        draw_ordinary(job, y, x0, x1);
        return;
    }
    for (uint32_t x = x0; x < x1; x++) {
        draw_sample(job, x, y);
    }
}

/* Samples of which the edge functions cannot tell whether the facet covers them. */
static void draw_doubtful(raster_job *job, uint32_t y, uint32_t x0, uint32_t x1)
{
    for (uint32_t x = x0; x < x1; x++) {
        double point[3];
        sample_point(job->raster, x, y, point);
        if (lrcsi_sample_covers(job->raster->view, job->facet, point)) {
            draw_run(job, y, x, x + 1);
        }
    }
}

/* Tells how the facet is drawn. Floats are subnormal below 2^-126: the last term. */
static raster_job job_make(lrcsi_raster *r, uint32_t facet)
{
    raster_job job = {.raster = r, .facet = facet, .met = LRCS_NONE};
    job.plane = lrcsi_raster_plane(r, facet);
    double far;
    double near;
    lrcsi_grid_depth(r->view, facet, &far, &near);
    double most = lrcsi_most(fabs(far), fabs(near)) + job.plane.err;
    double err = job.plane.err + 0x1p-21 * most + 0x1p-140;
    job.ordinary = err <= r->near_err;
    if (job.ordinary) {
        job.close = (float)(1.01 * (err + r->near_err));
    } else {
        far -= 2 * r->view->off;
        job.far = (float)(far - 0x1p-23 * fabs(far) - 0x1p-140);
    }
    return job;
}

/* Draws a facet if it is ordinary, or if it is not, as asked for. Returns 0 where it is not. Most
   small facets cover no sample: those count as ordinary. */
static int raster_draw(lrcsi_raster *r, uint32_t facet, int ordinary)
{
    lrcsi_edges e;
    double p[3][2];
    edges_corners(r, facet, p);
    edges_box(r, p, &e);
    if (e.x0 >= e.x1 || e.y0 >= e.y1) {
        return 1;
    }
    raster_job job = job_make(r, facet);
    if (job.ordinary != ordinary) {
        return job.ordinary;
    }
    edges_fill(r, r->view->facing[facet], p, &e);
    for (uint32_t y = e.y0; y < e.y1; y++) {
        lrcsi_samples row = lrcsi_span_samples(&e, y);
        draw_doubtful(&job, y, row.may.x0, row.sure.x0);
        draw_run(&job, y, row.sure.x0, row.sure.x1);
        draw_doubtful(&job, y, row.sure.x1, row.may.x1);
    }
    return ordinary;
}

/* --- all of it -------------------------------------------------------------------------------- */

/* Samples, and room for lanes behind the last one. */
static size_t raster_samples(uint32_t size)
{
    return lrcsi_work_add(lrcsi_work_square(size), LANES);
}

size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(raster_samples(size), sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(raster_samples(size), sizeof(float)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
}

static int raster_start(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *r)
{
    size_t samples = raster_samples(size);
    size_t facets = view->prepared->scene->facet_count;
    *r = (lrcsi_raster){.view = view, .size = size, .pixel = view->side / size};
    r->scale = view->side > 0 ? size / view->side : 0;
    r->off = view->off * r->scale + 8 * U * size;
    r->near_err = 0x1p-20 * view->side;
    r->owner = lrcsi_work_take(work, samples, sizeof *r->owner);
    r->depth = lrcsi_work_take(work, samples, sizeof *r->depth);
    r->sample = lrcsi_work_take(work, facets, sizeof *r->sample);
    r->undecided = lrcsi_work_take_zero(work, facets, 1);
    if (!r->owner || !r->depth || !r->sample || !r->undecided) {
        return LRCS_E_MEMORY;
    }
    memset(r->owner, 0xff, samples * sizeof *r->owner); /* LRCS_NONE */
    memset(r->sample, 0xff, facets * sizeof *r->sample);
    for (size_t i = 0; i < samples; i++) {
        r->depth[i] = -HUGE_VALF;
    }
    return LRCS_OK;
}

int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster)
{
    size_t mark = work->used;
    uint32_t count = view->prepared->scene->facet_count;
    lrcsi_raster r;
    int status = raster_start(view, size, work, &r);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    uint32_t left = 0; /* facets that are not ordinary */
    for (uint32_t f = 0; f < count; f++) {
        left += lrcsi_grid_casts(view, f) && !raster_draw(&r, f, 1);
    }
    for (uint32_t f = 0; f < count && left > 0; f++) {
        left -= lrcsi_grid_casts(view, f) && !raster_draw(&r, f, 0);
    }
    *raster = r;
    return LRCS_OK;
}
