/* SPDX-License-Identifier: MIT */
/* The likely error of a sampled area. A straight line that parts what is seen from what is not is
   met between two samples at every step along its longer axis, and the samples put it midway
   between them. The sum of these offsets is the error of the area: it stays small where they go
   round all values, and grows with every step where the line runs along the rows or at a simple
   slope to them. A step counts where just one of the two samples shows the facet, or beside the
   facet its component; since those are known to a step or two only, how far the sum strays counts,
   too. The facet's own sides miscount its covered and its owned samples alike, which matters where
   more is seen along them, or less, than elsewhere. A facet that owns all of its samples, or none,
   or has none, may still be seen in part, though no more of it is hidden than there is to hide it;
   how much that matters was measured, as was what is left where thin facets share their samples:
   per facet what a line across it would err. All this is a guess, and strips thinner than a pixel
   that hide from all samples escape it. */
#include "visibility/sampling_error.h"

#include <math.h>

#include "base/range.h"

/* Squares of guesses, in pixels, calibrated on scenes of seeds 101 and 102 (make bounds), on the
   demo and three models (make estimate). */
#define PARTED    0.9  /* of a facet that owns some of its samples, not all: at ends of lines */
#define STRAY     1.4  /* for each square of how far the sum of a line strays */
#define SIDES     0.3  /* for that of its own sides, times share (1 - share) */
#define MISCOUNT  1.5  /* for the square of what each side makes of the share */
#define ALL       1.0  /* of one that owns all of its samples */
#define HIDERS    1.33 /* of it at most so much, times the square of what could hide some of it */
#define NONE      2.0  /* of one that owns none of them */
#define SMALL     0.8  /* of any at most so much, times the square of its area */
#define UNSAMPLED 0.5  /* of one that has no samples, likewise */
#define ROW       0.5  /* of one that shares its samples, times its width */
#define ROW_SEEN  3.0  /* and so much more, times its width and share (1 - share) */

/* A facet on the raster. */
typedef struct sampled_facet {
    const lrcsi_raster *raster;
    lrcsi_edges edges;
    const uint32_t *component; /* of each facet */
    uint32_t facet;
    double share; /* of its samples, that it owns */
} sampled_facet;

/* A sum of offsets along a line, over the steps that count. */
typedef struct miscount_sum {
    double sum, low, high;
    double bias;     /* signed: too much of the facet is positive */
    double miscount; /* of a side: what the share of samples errs for its offsets */
} miscount_sum;

/* Does the facet cover the sample in the middle of a pixel? */
static int sampled_covers(const lrcsi_edges *e, double x, double y)
{
    for (int k = 0; k < 3; k++) {
        if (e->at[k] + e->along[k] * (x + 0.5) + e->up[k] * (y + 0.5) < 0) {
            return 0;
        }
    }
    return 1;
}

/* Does the sample show the facet, or beside the facet one of its component? */
static int sampled_shows(const sampled_facet *d, int axis, double along, double across)
{
    const lrcsi_raster *r = d->raster;
    double x = axis == 0 ? along : across;
    double y = axis == 0 ? across : along;
    if (!(x >= 0 && y >= 0 && x < r->size && y < r->size)) {
        return 0;
    }
    uint32_t owner = lrcsi_raster_owner(r, (uint32_t)x, (uint32_t)y);
    return owner == d->facet ||
           (owner != LRCS_NONE && d->component[owner] == d->component[d->facet] &&
            !sampled_covers(&d->edges, x, y));
}

/* Where samples put a line that passes at `across`: midway between the two about it. Through a
   sample itself it may count as passing on either side. */
static double sampled_limit(const sampled_facet *d, int axis, double along, double across)
{
    double limit = floor(across + 0.5);
    double sample = floor(across);
    if (fabs(across - sample - 0.5) > 4 * d->edges.position_err) {
        return limit;
    }
    int at = sampled_shows(d, axis, along, sample);
    return at != sampled_shows(d, axis, along, sample - 1)   ? sample
           : at != sampled_shows(d, axis, along, sample + 1) ? sample + 1
                                                             : limit;
}

/* One step. Of a facet's own side every one counts. */
static void miscount_step(miscount_sum *s, double offset, int above, int below, int side)
{
    if (above != below || side != 0) {
        s->sum += offset;
        s->bias += above ? offset : -offset;
        s->low = lrcsi_least(s->low, s->sum);
        s->high = lrcsi_most(s->high, s->sum);
    }
}

/* A side that passes between the facet's inner sample of a step and its limit makes too much of
   what it shows there, or of what it does not: both count in the share of the facet's samples. */
static double sampled_miscount(const sampled_facet *d, int axis, double along, double inner,
                               double offset)
{
    double x = axis == 0 ? along : inner;
    double y = axis == 0 ? inner : along;
    const lrcsi_raster *r = d->raster;
    if (!(x >= 0 && y >= 0 && x < r->size && y < r->size) || !sampled_covers(&d->edges, x, y)) {
        return 0;
    }
    int owns = lrcsi_raster_owner(r, (uint32_t)x, (uint32_t)y) == d->facet;
    return (owns - d->share) * offset;
}

/* Cuts the line a b off where it leaves the facet: from a + t[0] (b - a) to a + t[1] (b - a).
   Returns 0 if nothing is left. */
static int drift_clip(const lrcsi_edges *e, const double a[2], const double b[2], double t[2])
{
    for (int k = 0; k < 3; k++) {
        double p = e->at[k] + e->along[k] * a[0] + e->up[k] * a[1] + e->off;
        double q = e->at[k] + e->along[k] * b[0] + e->up[k] * b[1] + e->off;
        if (p < 0 && q < 0) {
            return 0;
        }
        if (p < 0) {
            t[0] = lrcsi_most(t[0], p / (p - q));
        } else if (q < 0) {
            t[1] = lrcsi_least(t[1], p / (p - q));
        }
    }
    return t[0] < t[1];
}

/* Walks the part of the line a b that lies over the facet. side: 1 or -1 if the line is a side
   of the facet, which lies above or below it, else 0. */
static miscount_sum miscount_walk(const sampled_facet *d, const double a[2], const double b[2],
                                  int side)
{
    miscount_sum s = {0};
    double t[2] = {0, 1};
    int axis = fabs(b[1] - a[1]) > fabs(b[0] - a[0]);
    double run = b[axis] - a[axis];
    if (run == 0 || !drift_clip(&d->edges, a, b, t)) {
        return s;
    }
    double slope = (b[!axis] - a[!axis]) / run;
    double from = a[axis] + lrcsi_least(t[0] * run, t[1] * run);
    double to = a[axis] + lrcsi_most(t[0] * run, t[1] * run);
    double last = lrcsi_least(to - 0.5, d->raster->size - 1.0);
    for (double step = lrcsi_most(ceil(from - 0.5), 0); step <= last; step++) {
        double across = a[!axis] + slope * (step + 0.5 - a[axis]);
        double limit = sampled_limit(d, axis, step, across);
        miscount_step(&s, across - limit, sampled_shows(d, axis, step, limit),
                      sampled_shows(d, axis, step, limit - 1), side);
        if (side != 0) {
            s.miscount +=
                side * sampled_miscount(d, axis, step, limit - (side < 0), across - limit);
        }
    }
    return s;
}

/* A line that parts what is seen from what another facet hides. */
static void miscount_add(const sampled_facet *d, const double a[2], const double b[2],
                         lrcsi_sampling_error *sampling_error)
{
    miscount_sum s = miscount_walk(d, a, b, 0);
    sampling_error->square += STRAY * (s.high - s.low) * (s.high - s.low);
    sampling_error->bias += s.bias;
}

static void miscount_add_edge(const sampled_facet *d, uint32_t edge,
                              lrcsi_sampling_error *sampling_error)
{
    const lrcsi_edge *e = &d->raster->view->prepared->topology.edge[edge];
    double a[2];
    double b[2];
    lrcsi_raster_point(d->raster, e->low, a);
    lrcsi_raster_point(d->raster, e->high, b);
    miscount_add(d, a, b, sampling_error);
}

/* The line where the planes of two facets meet, as far as it may pass over the facet's box. */
static void drift_add_meeting(const sampled_facet *d, uint32_t other,
                              lrcsi_sampling_error *sampling_error)
{
    const lrcsi_edges *box = &d->edges;
    lrcsi_plane p = lrcsi_raster_plane(d->raster, d->facet);
    lrcsi_plane q = lrcsi_raster_plane(d->raster, other);
    double along = p.along - q.along;
    double up = p.up - q.up;
    double steep = sqrt(along * along + up * up);
    double x = 0.5 * ((double)box->x0 + box->x1);
    double y = 0.5 * ((double)box->y0 + box->y1);
    double reach = 2.0 + box->x1 - box->x0 + box->y1 - box->y0;
    double far = (p.at - q.at + along * x + up * y) / steep; /* from the middle of the box */
    if (!(fabs(far) < reach)) {
        return;
    }
    along /= steep;
    up /= steep;
    const double a[2] = {x - along * far - up * reach, y - up * far + along * reach};
    const double b[2] = {x - along * far + up * reach, y - up * far - along * reach};
    miscount_add(d, a, b, sampling_error);
}

static void drift_add_touches(const sampled_facet *d, lrcsi_sampling_error *sampling_error)
{
    const lrcsi_view *view = d->raster->view;
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[d->facet]; i < intersections->first[d->facet + 1]; i++) {
        const lrcsi_intersection *touch = &intersections->entry[i];
        if (!lrcsi_intersection_hides(view, d->facet, touch)) {
            continue;
        }
        if (touch->kind == LRCSI_INTERSECTION_CROSS) {
            drift_add_meeting(d, touch->other, sampling_error);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            miscount_add_edge(d, view->prepared->topology.facet_edge[touch->other].corner[k],
                              sampling_error);
        }
    }
}

static void drift_add_sides(const sampled_facet *d, lrcsi_sampling_error *sampling_error)
{
    const uint32_t *corner = d->raster->view->prepared->scene->facet[d->facet].corner;
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(d->raster, corner[k], p[k]);
    }
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        const double *c = p[(k + 2) % 3];
        int axis = fabs(b[1] - a[1]) > fabs(b[0] - a[0]);
        double slope = (b[!axis] - a[!axis]) / (b[axis] - a[axis]);
        int above = c[!axis] - a[!axis] > slope * (c[axis] - a[axis]);
        miscount_sum s = miscount_walk(d, a, b, above ? 1 : -1);
        double stray = s.high - s.low;
        sampling_error->square += SIDES * d->share * (1 - d->share) * stray * stray;
        sampling_error->square += MISCOUNT * s.miscount * s.miscount;
    }
}

/* In square pixels. */
static double miscount_area(const lrcsi_raster *raster, uint32_t facet)
{
    return lrcsi_view_projected(raster->view, facet) * raster->scale * raster->scale;
}

/* The area, at most, of what may hide some of a facet that owns all of its samples: of the facets
   at the event edges that cross it, which do so with two edges each at least, and of those that
   touch it. */
static double drift_hiders(const lrcsi_raster *raster, uint32_t facet, const uint32_t *crossing,
                           uint32_t crossings)
{
    const lrcs_prepared *p = raster->view->prepared;
    double area = 0;
    for (uint32_t i = 0; i < crossings; i++) {
        const lrcsi_edge *edge = &p->topology.edge[crossing[i]];
        for (uint32_t k = 0; k < edge->uses; k++) {
            area += 0.5 * miscount_area(raster, p->topology.use[edge->first_use + k].facet);
        }
    }
    for (uint32_t i = p->intersections.first[facet]; i < p->intersections.first[facet + 1]; i++) {
        area += miscount_area(raster, p->intersections.entry[i].other);
    }
    return area;
}

/* Of a facet that owns some of its samples, not all. */
static lrcsi_sampling_error drift_parted(const sampled_facet *d, const uint32_t *crossing,
                                         uint32_t crossings)
{
    lrcsi_sampling_error sampling_error = {PARTED, 0};
    for (uint32_t i = 0; i < crossings; i++) {
        miscount_add_edge(d, crossing[i], &sampling_error);
    }
    drift_add_touches(d, &sampling_error);
    drift_add_sides(d, &sampling_error);
    return sampling_error;
}

lrcsi_sampling_error lrcsi_sampling_error_facet(const uint32_t *component,
                                                const lrcsi_raster *raster, uint32_t facet,
                                                const uint32_t *crossing, uint32_t crossings)
{
    sampled_facet d = {raster, lrcsi_raster_edges(raster, facet), component, facet, 0};
    double area = miscount_area(raster, facet);
    uint32_t owned = raster->owned[facet];
    uint32_t covered = raster->covered[facet];
    lrcsi_sampling_error sampling_error = {SMALL * area * area, 0};
    if (covered == 0) {
        sampling_error.square = UNSAMPLED * area * area;
    } else if (owned == 0) {
        sampling_error.square = lrcsi_least(sampling_error.square, NONE);
    } else if (owned == covered) {
        double hiders = drift_hiders(raster, facet, crossing, crossings);
        sampling_error.square =
            lrcsi_least(sampling_error.square, lrcsi_least(ALL, HIDERS * hiders * hiders));
    } else {
        d.share = (double)owned / covered;
        sampling_error = drift_parted(&d, crossing, crossings);
        sampling_error.square = lrcsi_least(sampling_error.square, SMALL * area * area);
    }
    return sampling_error;
}

lrcsi_sampling_error lrcsi_sampling_error_row(const lrcsi_raster *raster, uint32_t facet,
                                              double longest, double share)
{
    double area = miscount_area(raster, facet);
    double width = longest > 0 ? lrcsi_least(1, 2 * area / longest) : 0;
    return (lrcsi_sampling_error){width * (ROW + ROW_SEEN * share * (1 - share)), 0};
}
