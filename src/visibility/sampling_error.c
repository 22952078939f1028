/* SPDX-License-Identifier: MIT */
/* An estimate of the error of an area that was counted in samples. It is heuristic: it is never
   part of a bound.

   Consider a straight line between the visible and the hidden part of a facet. In every step along
   the line's longer axis (a column of pixels, or a row) it passes between two neighbouring samples,
   and counting samples places it midway between them. The sum of the offsets between the line and
   these middles is the error of the area. The sum stays small if the offsets are spread evenly; it
   grows with every step if the line is parallel to the rows or has a simple slope. A step counts if
   one of its two samples shows the facet (or, outside the facet, its surface component) and the
   other does not. Which steps count is uncertain by one or two; therefore the range of the partial
   sums is used instead of the sum alone.

   A facet's own sides cause errors in both the covered and the owned samples. These cancel unless
   the visible fraction along the side differs from that of the facet.

   A facet that owns all of its samples or none, or that has no samples, may still be visible in
   part; the hidden part is at most as large as the facets that could hide it. These cases have
   calibrated constants (see below), and so has the error of thin facets whose samples are pooled.

   Strips that are thinner than a pixel and hide the facet between all samples are not detected. */
#include "visibility/sampling_error.h"

#include <math.h>

#include "base/range.h"

/* Squares of estimates, in pixels, calibrated on scenes of seeds 101 and 102 (make bounds), on the
   demo and on three models (make estimate). */
#define PARTIAL        0.9  /* a facet that owns some of its samples: errors at the ends of lines */
#define PARTIAL_SUMS   1.4  /* times the squared range of the partial sums along a line */
#define SIDES          0.3  /* the same for the facet's own sides, times fraction (1 - fraction) */
#define FRACTION_ERROR 1.5  /* times the squared error of the fraction that each side causes */
#define ALL            1.0  /* a facet that owns all of its samples */
#define OCCLUDERS      1.33 /* at most this, times the squared area of possible occluders */
#define NONE           2.0  /* a facet that owns none of its samples */
#define SMALL          0.8  /* any facet: at most this times its squared area */
#define UNSAMPLED      0.5  /* a facet without samples: times its squared area */
#define POOLED         0.5  /* a facet whose samples are pooled: times its width */
#define POOLED_PART    3.0  /* the same: in addition, times its width and fraction (1 - fraction) */

/* A facet in a raster. */
typedef struct sampled_facet {
    const lrcsi_raster *raster;
    lrcsi_edge_functions edges;
    const uint32_t *component; /* of each facet */
    uint32_t facet;
    double fraction; /* the fraction of its samples that it owns */
} sampled_facet;

/* The sum of the offsets along a line, over the steps that count. */
typedef struct offset_sum {
    double sum, low, high; /* the sum, and the least and the largest partial sum */
    double bias;           /* signed: positive if too much of the facet counts as visible */
    double fraction_error; /* of a side: the error of the visible fraction that its offsets cause */
} offset_sum;

/* Does the facet cover the sample in the middle of a pixel? */
static int sampled_covers(const lrcsi_edge_functions *e, double x, double y)
{
    for (int k = 0; k < 3; k++) {
        if (e->c[k] + e->dx[k] * (x + 0.5) + e->dy[k] * (y + 0.5) < 0) {
            return 0;
        }
    }
    return 1;
}

/* Does the sample show the facet or, outside the facet, another facet of its component? */
static int sampled_shows(const sampled_facet *f, int axis, double along, double across)
{
    const lrcsi_raster *r = f->raster;
    double x = axis == 0 ? along : across;
    double y = axis == 0 ? across : along;
    if (!(x >= 0 && y >= 0 && x < r->size && y < r->size)) {
        return 0;
    }
    uint32_t owner = lrcsi_raster_owner(r, (uint32_t)x, (uint32_t)y);
    return owner == f->facet ||
           (owner != LRCS_NONE && f->component[owner] == f->component[f->facet] &&
            !sampled_covers(&f->edges, x, y));
}

/* Where the samples place a line that passes at `across`: midway between the two samples on either
   side of it. If the line passes through a sample to within rounding, it may be placed on either
   side of that sample; then the samples decide. */
static double sampled_boundary(const sampled_facet *f, int axis, double along, double across)
{
    double boundary = floor(across + 0.5);
    double sample = floor(across);
    if (fabs(across - sample - 0.5) > 4 * f->edges.position_err) {
        return boundary;
    }
    int at = sampled_shows(f, axis, along, sample);
    return at != sampled_shows(f, axis, along, sample - 1)   ? sample
           : at != sampled_shows(f, axis, along, sample + 1) ? sample + 1
                                                             : boundary;
}

/* Adds one step. Along a facet's own side every step counts. */
static void offset_sum_add(offset_sum *s, double offset, int above, int below, int side)
{
    if (above != below || side != 0) {
        s->sum += offset;
        s->bias += above ? offset : -offset;
        s->low = lrcsi_min(s->low, s->sum);
        s->high = lrcsi_max(s->high, s->sum);
    }
}

/* The error of the visible fraction that a side causes in one step: the facet's sample next to the
   boundary has too large or too small a weight if the side passes on one or the other side of that
   boundary. */
static double side_weight_error(const sampled_facet *f, int axis, double along, double inner,
                                double offset)
{
    double x = axis == 0 ? along : inner;
    double y = axis == 0 ? inner : along;
    const lrcsi_raster *r = f->raster;
    if (!(x >= 0 && y >= 0 && x < r->size && y < r->size) || !sampled_covers(&f->edges, x, y)) {
        return 0;
    }
    int owns = lrcsi_raster_owner(r, (uint32_t)x, (uint32_t)y) == f->facet;
    return (owns - f->fraction) * offset;
}

/* Sums over the part of the segment a b that lies within the facet. side: 1 or -1 if the segment is
   a side of the facet and the facet lies above or below it; otherwise 0. */
static offset_sum offset_sum_along(const sampled_facet *f, const double a[2], const double b[2],
                                   int side)
{
    offset_sum s = {0};
    double t[2] = {0, 1};
    int axis = fabs(b[1] - a[1]) > fabs(b[0] - a[0]);
    double run = b[axis] - a[axis];
    if (run == 0 || !lrcsi_span_clip(&f->edges, a, b, 0, t)) {
        return s;
    }
    double slope = (b[!axis] - a[!axis]) / run;
    double from = a[axis] + lrcsi_min(t[0] * run, t[1] * run);
    double to = a[axis] + lrcsi_max(t[0] * run, t[1] * run);
    double last = lrcsi_min(to - 0.5, f->raster->size - 1.0);
    for (double step = lrcsi_max(ceil(from - 0.5), 0); step <= last; step++) {
        double across = a[!axis] + slope * (step + 0.5 - a[axis]);
        double boundary = sampled_boundary(f, axis, step, across);
        offset_sum_add(&s, across - boundary, sampled_shows(f, axis, step, boundary),
                       sampled_shows(f, axis, step, boundary - 1), side);
        if (side != 0) {
            s.fraction_error +=
                side * side_weight_error(f, axis, step, boundary - (side < 0), across - boundary);
        }
    }
    return s;
}

/* Adds the error of a line between the visible part and what another facet hides. */
static void add_line_error(const sampled_facet *f, const double a[2], const double b[2],
                           lrcsi_sampling_error *error)
{
    offset_sum s = offset_sum_along(f, a, b, 0);
    error->square += PARTIAL_SUMS * (s.high - s.low) * (s.high - s.low);
    error->bias += s.bias;
}

static void add_edge_error(const sampled_facet *f, uint32_t edge, lrcsi_sampling_error *error)
{
    const lrcsi_edge *e = &f->raster->view->prepared->topology.edge[edge];
    double a[2];
    double b[2];
    lrcsi_raster_point(f->raster, e->low, a);
    lrcsi_raster_point(f->raster, e->high, b);
    add_line_error(f, a, b, error);
}

/* Adds the line in which the planes of two facets intersect. */
static void add_intersection_error(const sampled_facet *f, uint32_t other,
                                   lrcsi_sampling_error *error)
{
    double a[2];
    double b[2];
    double err;
    if (lrcsi_raster_intersection(f->raster, &f->edges, f->facet, other, a, b, &err)) {
        add_line_error(f, a, b, error);
    }
}

static void add_contact_errors(const sampled_facet *f, lrcsi_sampling_error *error)
{
    const lrcsi_view *view = f->raster->view;
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[f->facet]; i < intersections->first[f->facet + 1]; i++) {
        const lrcsi_intersection *contact = &intersections->entry[i];
        if (!lrcsi_intersection_hides(view, f->facet, contact)) {
            continue;
        }
        if (contact->kind == LRCSI_INTERSECTION_CROSS) {
            add_intersection_error(f, contact->other, error);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            add_edge_error(f, view->prepared->topology.facet_edge[contact->other].corner[k], error);
        }
    }
}

static void add_side_errors(const sampled_facet *f, lrcsi_sampling_error *error)
{
    const uint32_t *corner = f->raster->view->prepared->scene->facet[f->facet].corner;
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(f->raster, corner[k], p[k]);
    }
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        const double *c = p[(k + 2) % 3];
        int axis = fabs(b[1] - a[1]) > fabs(b[0] - a[0]);
        double slope = (b[!axis] - a[!axis]) / (b[axis] - a[axis]);
        int above = c[!axis] - a[!axis] > slope * (c[axis] - a[axis]);
        offset_sum s = offset_sum_along(f, a, b, above ? 1 : -1);
        double range = s.high - s.low;
        error->square += SIDES * f->fraction * (1 - f->fraction) * range * range;
        error->square += FRACTION_ERROR * s.fraction_error * s.fraction_error;
    }
}

/* The projected area of a facet, in square pixels. */
static double area_in_pixels(const lrcsi_raster *raster, uint32_t facet)
{
    return lrcsi_view_projected(raster->view, facet) * raster->scale * raster->scale;
}

/* The area of the facets that may hide a part of a facet that owns all of its samples: the facets
   of the event edges that cross it (by half, since each crosses it with at least two edges), and
   the facets that intersect it. */
static double occluder_area(const lrcsi_raster *raster, uint32_t facet, const uint32_t *crossing,
                            uint32_t crossings)
{
    const lrcs_prepared *p = raster->view->prepared;
    double area = 0;
    for (uint32_t i = 0; i < crossings; i++) {
        const lrcsi_edge *edge = &p->topology.edge[crossing[i]];
        for (uint32_t k = 0; k < edge->uses; k++) {
            area += 0.5 * area_in_pixels(raster, p->topology.use[edge->first_use + k].facet);
        }
    }
    for (uint32_t i = p->intersections.first[facet]; i < p->intersections.first[facet + 1]; i++) {
        area += area_in_pixels(raster, p->intersections.entry[i].other);
    }
    return area;
}

lrcsi_sampling_error lrcsi_sampling_error_facet(const uint32_t *component,
                                                const lrcsi_raster *raster, uint32_t facet,
                                                const uint32_t *crossing, uint32_t crossings)
{
    sampled_facet f = {raster, lrcsi_raster_edge_functions(raster, facet), component, facet, 0};
    double area = area_in_pixels(raster, facet);
    uint32_t owned = raster->owned[facet];
    uint32_t covered = raster->covered[facet];
    lrcsi_sampling_error error = {SMALL * area * area, 0};
    if (covered == 0) {
        error.square = UNSAMPLED * area * area;
    } else if (owned == 0) {
        error.square = lrcsi_min(error.square, NONE);
    } else if (owned == covered) {
        double occluders = occluder_area(raster, facet, crossing, crossings);
        error.square = lrcsi_min(error.square, lrcsi_min(ALL, OCCLUDERS * occluders * occluders));
    } else {
        f.fraction = (double)owned / covered;
        error.square = PARTIAL;
        for (uint32_t i = 0; i < crossings; i++) {
            add_edge_error(&f, crossing[i], &error);
        }
        add_contact_errors(&f, &error);
        add_side_errors(&f, &error);
        error.square = lrcsi_min(error.square, SMALL * area * area);
    }
    return error;
}

lrcsi_sampling_error lrcsi_sampling_error_pooled(const lrcsi_raster *raster, uint32_t facet,
                                                 double longest, double fraction)
{
    double area = area_in_pixels(raster, facet);
    double width = longest > 0 ? lrcsi_min(1, 2 * area / longest) : 0;
    return (lrcsi_sampling_error){width * (POOLED + POOLED_PART * fraction * (1 - fraction)), 0};
}
