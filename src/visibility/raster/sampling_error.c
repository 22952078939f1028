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
#include "visibility/raster/sampling_error.h"

#include <math.h>

#include "base/range.h"
#include "visibility/base/sample.h"

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

/* Sums over the part of the segment a b that lies within the facet. side: 1 or -1 if the segment is
   a side of the facet and the facet lies above or below it; otherwise 0. Along a side every step
   counts. It also causes an error of the visible fraction: the facet's sample next to the boundary
   has too large or too small a weight if the side passes on one or the other side of that boundary.
 */
static offset_sum offset_sum_along(const sampled_facet *f, const double a[2], const double b[2],
                                   int side)
{
    offset_sum s = {0};
    const lrcsi_raster *r = f->raster;
    double t[2];
    int axis = fabs(b[1] - a[1]) > fabs(b[0] - a[0]);
    double length = b[axis] - a[axis];
    if (length == 0 || !lrcsi_span_clip(&f->edges, a, b, 0, t)) {
        return s;
    }
    double slope = (b[!axis] - a[!axis]) / length;
    double from = a[axis] + lrcsi_min(t[0] * length, t[1] * length);
    double to = a[axis] + lrcsi_max(t[0] * length, t[1] * length);
    double last = lrcsi_min(to - 0.5, r->size - 1.0);
    for (double step = lrcsi_max(ceil(from - 0.5), 0); step <= last; step++) {
        double across = a[!axis] + slope * (step + 0.5 - a[axis]);
        double boundary = sampled_boundary(f, axis, step, across);
        double offset = across - boundary;
        int above = sampled_shows(f, axis, step, boundary);
        int below = sampled_shows(f, axis, step, boundary - 1);
        if (above != below || side != 0) {
            s.sum += offset;
            s.bias += above ? offset : -offset;
            lrcsi_range_extend(s.sum, &s.low, &s.high);
        }
        double inner = boundary - (side < 0);
        double x = axis == 0 ? step : inner;
        double y = axis == 0 ? inner : step;
        if (side != 0 && x >= 0 && y >= 0 && x < r->size && y < r->size &&
            sampled_covers(&f->edges, x, y)) {
            int owns = lrcsi_raster_owner(r, (uint32_t)x, (uint32_t)y) == f->facet;
            s.fraction_error += side * ((owns - f->fraction) * offset);
        }
    }
    return s;
}

/* Adds the error of a line between the visible part and what another facet hides. */
static void add_line_error(const sampled_facet *f, const lrcsi_raster_segment *line,
                           lrcsi_sampling_error *error)
{
    offset_sum s = offset_sum_along(f, line->a, line->b, 0);
    error->square += PARTIAL_SUMS * (s.high - s.low) * (s.high - s.low);
    error->bias += s.bias;
}

/* The error of a facet that owns some of its samples: 1. of event edges; 2. of contacts; 3. of its
   own sides. */
static lrcsi_sampling_error partial_error(const sampled_facet *f, const lrcsi_crossings *crossings)
{
    const lrcsi_raster *r = f->raster;
    const lrcsi_intersections *contacts = &r->view->prepared->intersections;
    const uint32_t *corner = r->view->prepared->scene->facet[f->facet].corner;
    lrcsi_sampling_error error = {PARTIAL, 0};
    lrcsi_raster_segment line[3];
    double p[3][2];
    for (uint32_t i = 0; i < crossings->count; i++) {
        line[0] = lrcsi_raster_edge(r, crossings->edge[i]);
        add_line_error(f, &line[0], &error);
    }
    for (uint32_t i = contacts->first[f->facet]; i < contacts->first[f->facet + 1]; i++) {
        if (lrcsi_sample_contact_hides(r->view, f->facet, &contacts->entry[i])) {
            int lines = lrcsi_raster_contact(r, &f->edges, f->facet, &contacts->entry[i], line);
            for (int k = 0; k < lines; k++) {
                add_line_error(f, &line[k], &error);
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(r, corner[k], p[k]);
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
        error.square += SIDES * f->fraction * (1 - f->fraction) * range * range;
        error.square += FRACTION_ERROR * s.fraction_error * s.fraction_error;
    }
    return error;
}

/* The projected area of a facet, in square pixels. */
static double area_in_pixels(const lrcsi_raster *raster, uint32_t facet)
{
    return lrcsi_view_projected(raster->view, facet) * raster->pixels_per_unit *
           raster->pixels_per_unit;
}

/* The area of the facets that may hide a part of a facet that owns all of its samples: the facets
   of the event edges that cross it (by half, since each crosses it with at least two edges), and
   the facets that intersect it. */
static double occluder_area(const lrcsi_raster *raster, uint32_t facet,
                            const lrcsi_crossings *crossings)
{
    const lrcs_prepared *p = raster->view->prepared;
    double area = 0;
    for (uint32_t i = 0; i < crossings->count; i++) {
        const lrcsi_edge *edge = &p->topology.edge[crossings->edge[i]];
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
                                                const lrcsi_crossings *crossings)
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
        double occluders = occluder_area(raster, facet, crossings);
        error.square = lrcsi_min3(error.square, ALL, OCCLUDERS * occluders * occluders);
    } else {
        f.fraction = (double)owned / covered;
        error = partial_error(&f, crossings);
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
