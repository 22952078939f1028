/* SPDX-License-Identifier: MIT */
/* The geometry of a raster: where its samples are; facets in pixels, as edge functions and as
   planes of heights, with their errors; the line in which two planes intersect. Drawing is in
   visibility/raster/raster_draw.c. */
#include "visibility/raster/raster.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"

void lrcsi_raster_layout(const lrcsi_view *view, uint32_t size, lrcsi_raster *raster)
{
    lrcsi_raster r = {.view = view, .size = size};
    r.pixel = view->side / size;
    r.pixels_per_unit = view->side > 0 ? size / view->side : 0;
    for (int k = 0; k < 2; k++) {
        r.radius += lrcsi_max(fabs(view->low[k]), fabs(view->low[k] + view->side));
    }
    r.sample_err =
        lrcsi_view_unproject_err(view, r.radius, 0) * r.pixels_per_unit + 8 * LRCSI_U * size;
    *raster = r;
}

void lrcsi_raster_sample(const lrcsi_raster *raster, uint32_t x, uint32_t y, double point[3])
{
    const lrcsi_view *view = raster->view;
    lrcsi_view_unproject(view, view->low[0] + (x + 0.5) * raster->pixel,
                         view->low[1] + (y + 0.5) * raster->pixel, point);
}

double lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2])
{
    const lrcsi_view_vertex *at = &raster->view->point[vertex];
    xy[0] = (at->x[0] - raster->view->low[0]) * raster->pixels_per_unit;
    xy[1] = (at->x[1] - raster->view->low[1]) * raster->pixels_per_unit;
    return at->err * raster->pixels_per_unit + raster->sample_err;
}

/* Error of a value in a touched pixel. Corners have errors of position_err, and so has the sample.
   |q - p| and |sample - p| are at most the half perimeter h of the box and the width of a pixel, so
   the error of the cross product is at most 4 position_err (h + 2). Roundings add 2 u N h for `c`,
   u N h for the differences and 5 u N h for the value: together at most position_err h. The sum is
   at most 5 position_err (h + 2); value_err is 8/5 of that. */
lrcsi_edge_functions lrcsi_raster_edge_functions(const lrcsi_raster *raster, uint32_t facet)
{
    const uint32_t *corner = raster->view->prepared->scene->facet[facet].corner;
    const int facing = raster->view->facing[facet];
    lrcsi_edge_functions e = {.position_err = 0};
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        e.position_err = lrcsi_max(e.position_err, lrcsi_raster_point(raster, corner[k], p[k]));
    }
    double x0 = lrcsi_min3(p[0][0], p[1][0], p[2][0]);
    double x1 = lrcsi_max3(p[0][0], p[1][0], p[2][0]);
    double y0 = lrcsi_min3(p[0][1], p[1][1], p[2][1]);
    double y1 = lrcsi_max3(p[0][1], p[1][1], p[2][1]);
    e.value_err = 8 * e.position_err * (x1 - x0 + y1 - y0 + 2);
    lrcsi_raster_centres(raster, x0, x1, e.position_err, &e.x0, &e.x1);
    lrcsi_raster_centres(raster, y0, y1, e.position_err, &e.y0, &e.y1);
    e.left = e.x0 > 0 ? e.x0 - 1 : 0;
    e.right = e.x1 < raster->size ? e.x1 + 1 : raster->size;
    e.bottom = e.y0 > 0 ? e.y0 - 1 : 0;
    e.top = e.y1 < raster->size ? e.y1 + 1 : raster->size;
    for (int k = 0; k < 3; k++) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        e.dx[k] = -facing * (b[1] - a[1]);
        e.dy[k] = facing * (b[0] - a[0]);
        e.c[k] = -(e.dx[k] * a[0] + e.dy[k] * a[1]);
    }
    lrcsi_span_prepare(&e);
    return e;
}

/* From the facet's normal n in view coordinates, in doubles, with errors of 8 u |n|. A height is
   that of a corner plus slopes times differences of coordinates from the corner. These differences
   are at most `radius`, which includes samples and corners. Each has an error of 16 u radius, to
   which the error of the sample is added. Division by |cos| gives the error of the height. The
   error of the denominator changes a height within `radius` by as much again. For a facet that is
   edge-on the plane is arbitrary: the error bound is infinite, so that its heights decide nothing.
   */
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet)
{
    const lrcsi_view *view = raster->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const lrcsi_normal *normal = &view->prepared->normal[facet];
    const double *a = view->point[corner[0]].x;
    double radius = raster->radius;
    double n[3];
    for (int k = 0; k < 3; k++) {
        const double *x = view->point[corner[k]].x;
        radius = lrcsi_max(radius, raster->radius + fabs(x[0]) + fabs(x[1]) + fabs(x[2]));
        n[k] = view->R[k][0] * normal->high[0] + view->R[k][1] * normal->high[1] +
               view->R[k][2] * normal->high[2];
    }
    double dx = n[2] != 0 ? -n[0] / n[2] : 0;
    double dy = n[2] != 0 ? -n[1] / n[2] : 0;
    double cosine = fabs(n[2]) / normal->length;
    double err = 256 * LRCSI_U * radius + 4 * raster->sample_err * raster->pixel;
    return (lrcsi_plane){.c = a[2] - dx * (a[0] - view->low[0]) - dy * (a[1] - view->low[1]),
                         .dx = dx * raster->pixel,
                         .dy = dy * raster->pixel,
                         .err = cosine > 64 * LRCSI_U ? err / cosine : HUGE_VAL};
}

/* The line in which the difference D = c + dx x + dy y of the two heights is 0. It is followed for
   `extent` to both sides of its point that is nearest to the centre of the facet's box: a point of
   the line in a pixel that the facet touches is no farther from the centre, because such pixels
   reach one pixel beyond the box on each side, and
   sqrt((w / 2 + 1)^2 + (h / 2 + 1)^2) < w + h + 2 - 1/2.

   Error. Where the facets meet in such a pixel, |D| is at most the sum e of their height errors, so
   the point is within e / |gradient| of the line. The terms of D at the centre are together less
   than 10 times the radius / |cos| of lrcsi_raster_plane for each facet; with 4 roundings each they
   change D by less than e / 6. The unit vector and the ends add less than 64 u N, and coordinates
   of ends are below 9 N. line->err is at least the sum, and 512 u N. */
int lrcsi_raster_intersection(const lrcsi_raster *raster, const lrcsi_edge_functions *box,
                              uint32_t facet, uint32_t other, lrcsi_raster_segment *line)
{
    lrcsi_plane p = lrcsi_raster_plane(raster, facet);
    lrcsi_plane q = lrcsi_raster_plane(raster, other);
    double dx = p.dx - q.dx;
    double dy = p.dy - q.dy;
    double gradient = sqrt(dx * dx + dy * dy);
    double x = 0.5 * ((double)box->x0 + box->x1);
    double y = 0.5 * ((double)box->y0 + box->y1);
    double extent = 2.0 + box->x1 - box->x0 + box->y1 - box->y0;
    double distance = (p.c - q.c + dx * x + dy * y) / gradient; /* of the box's centre */
    line->err = 1.25 * (p.err + q.err) / gradient + 512 * LRCSI_U * raster->size;
    if (!(fabs(distance) < extent)) {
        return 0;
    }
    dx /= gradient;
    dy /= gradient;
    line->a[0] = x - dx * distance - dy * extent;
    line->a[1] = y - dy * distance + dx * extent;
    line->b[0] = x - dx * distance + dy * extent;
    line->b[1] = y - dy * distance - dx * extent;
    return 1;
}

lrcsi_raster_segment lrcsi_raster_edge(const lrcsi_raster *raster, uint32_t edge)
{
    const lrcsi_edge *e = &raster->view->prepared->topology.edge[edge];
    lrcsi_raster_segment segment;
    const double a_err = lrcsi_raster_point(raster, e->low, segment.a);
    const double b_err = lrcsi_raster_point(raster, e->high, segment.b);
    segment.err = lrcsi_max(a_err, b_err);
    return segment;
}

int lrcsi_raster_contact(const lrcsi_raster *raster, const lrcsi_edge_functions *box,
                         uint32_t facet, const lrcsi_intersection *contact,
                         lrcsi_raster_segment segment[3])
{
    if (contact->kind == LRCSI_INTERSECTION_CROSS) {
        return lrcsi_raster_intersection(raster, box, facet, contact->other, &segment[0]);
    }
    const uint32_t *side = raster->view->prepared->topology.facet_edge[contact->other].corner;
    for (int k = 0; k < 3; k++) {
        segment[k] = lrcsi_raster_edge(raster, side[k]);
    }
    return 3;
}
