/* SPDX-License-Identifier: MIT */
/* The report on a mesh: its counts, box, area and volume. topology.c decides which points and edges
   are the same, and convex.c decides convexity.

   Area and volume are computed in double-double on coordinates divided by a power of two near the
   box's size, so that nothing overflows and only negligible terms underflow. With u = 2^-53 and
   coordinate differences exact, each component of a facet's normal has an error of at most 20 u^2
   times its largest product: for a sliver of aspect q the relative error is q times larger, so the
   error of its area is a few u up to q = 10^15. Volume: the corners relative to the box centre are
   exact, and each facet's determinant has an error of at most 64 u^2 times the sum of its products.
   Sums are double-double. */
#include <lrcs/mesh.h>

#include <math.h>

#include "base/dd.h"
#include "base/work.h"
#include "mesh/box.h"
#include "mesh/convex.h"
#include "mesh/topology.h"

/* The mesh to be measured. */
typedef struct measured_mesh {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    uint32_t facet_count;
} measured_mesh;

/* The box around all facets; of none, a point at the origin. */
static lrcsi_box measure_box(const measured_mesh *m)
{
    if (m->facet_count == 0) {
        return (lrcsi_box){.low = {0.0}};
    }
    lrcsi_box box = lrcsi_box_empty();
    for (uint32_t f = 0; f < m->facet_count; f++) {
        for (int c = 0; c < 3; c++) {
            lrcsi_box_add(&box, m->vertex[m->facet[f].corner[c]].x);
        }
    }
    return box;
}

/* A power of two within a factor of two of `side` (1 if that is 0). */
static double power_of_two_near(double side)
{
    double scale = 1.0;
    while (scale < side) {
        scale *= 2.0;
    }
    while (side > 0.0 && scale * 0.5 >= side && scale > 0x1p-1000) {
        scale *= 0.5;
    }
    return scale;
}

/* (p - o) / scale, exactly. */
static void scaled_difference(const double *p, const double *o, double scale, lrcsi_dd d[3])
{
    for (int k = 0; k < 3; k++) {
        lrcsi_dd s = lrcsi_dd_two_sum(p[k], -o[k]);
        d[k] = (lrcsi_dd){s.hi / scale, s.lo / scale};
    }
}

static void dd_cross(const lrcsi_dd a[3], const lrcsi_dd b[3], lrcsi_dd c[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        c[k] = lrcsi_dd_sub(lrcsi_dd_mul(a[i], b[j]), lrcsi_dd_mul(a[j], b[i]));
    }
}

/* The length, without overflow or underflow of the squares; relative error at most 4 u. */
static double vector_length(const lrcsi_dd v[3])
{
    double x = fabs(lrcsi_dd_value(v[0]));
    double y = fabs(lrcsi_dd_value(v[1]));
    double z = fabs(lrcsi_dd_value(v[2]));
    double largest = fmax(x, fmax(y, z));
    if (largest == 0.0) {
        return 0.0;
    }
    x /= largest;
    y /= largest;
    z /= largest;
    return largest * sqrt(x * x + y * y + z * z);
}

static double measure_area(const measured_mesh *m, const unsigned char *degenerate, double scale)
{
    lrcsi_dd sum = {0.0, 0.0};
    for (uint32_t f = 0; f < m->facet_count; f++) {
        if (degenerate[f]) {
            continue;
        }
        const uint32_t *c = m->facet[f].corner;
        lrcsi_dd p[3];
        lrcsi_dd q[3];
        lrcsi_dd n[3];
        scaled_difference(m->vertex[c[1]].x, m->vertex[c[0]].x, scale, p);
        scaled_difference(m->vertex[c[2]].x, m->vertex[c[0]].x, scale, q);
        dd_cross(p, q, n);
        sum = lrcsi_dd_add(sum, (lrcsi_dd){vector_length(n), 0.0});
    }
    return 0.5 * lrcsi_dd_value(sum) * scale * scale;
}

static double measure_volume(const measured_mesh *m, const unsigned char *degenerate,
                             const double centre[3], double scale)
{
    lrcsi_dd sum = {0.0, 0.0};
    for (uint32_t f = 0; f < m->facet_count; f++) {
        if (degenerate[f]) {
            continue;
        }
        lrcsi_dd p[3][3];
        lrcsi_dd n[3];
        for (int c = 0; c < 3; c++) {
            scaled_difference(m->vertex[m->facet[f].corner[c]].x, centre, scale, p[c]);
        }
        dd_cross(p[0], p[1], n);
        for (int k = 0; k < 3; k++) {
            sum = lrcsi_dd_add(sum, lrcsi_dd_mul(n[k], p[2][k]));
        }
    }
    return lrcsi_dd_value(sum) / 6.0 * scale * scale * scale;
}

static void count_edge_uses(const lrcsi_topology *t, lrcs_mesh_report *report)
{
    report->edges = t->edge_count;
    report->closed = t->edge_count > 0;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        uint32_t uses = t->edge[e].uses;
        uint32_t forward = 0;
        for (uint32_t i = 0; i < uses; i++) {
            forward += t->use[t->edge[e].first_use + i].forward;
        }
        report->boundary_edges += uses == 1;
        report->nonmanifold_edges += uses > 2;
        report->misoriented_edges += uses == 2 && forward != 1;
        report->closed = report->closed && uses % 2 == 0 && forward == uses / 2;
    }
}

/* The first facet, of lowest index, on a lowest edge and the point opposite it. */
typedef struct first_facet {
    uint32_t edge, forward; /* how it traverses the edge */
} first_facet;

/* Counts the facets that coincide with one of lower index, and those of them whose winding is
   opposite to that of the first. Coincident facets are all found at their lowest edge: first[v] is
   the first facet at the latest edge that has a facet with v opposite it. Which of them the laser
   sees: scene/coincident.c. */
static int count_duplicates(const measured_mesh *m, const lrcsi_topology *t, uint32_t vertex_count,
                            lrcs_work *work, lrcs_mesh_report *report)
{
    size_t mark = work->used;
    first_facet *first = lrcsi_work_take(work, vertex_count, sizeof *first);
    if (!first) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        first[v].edge = LRCS_NONE;
    }
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const lrcsi_edge_use *use = t->use + t->edge[e].first_use;
        for (uint32_t i = 0; i < t->edge[e].uses; i++) {
            uint32_t f = use[i].facet;
            if (lrcsi_topology_lowest_edge(t, f) != e) {
                continue;
            }
            uint32_t k = lrcsi_topology_corner_opposite(t, f, e);
            first_facet *at = &first[t->weld[m->facet[f].corner[k]]];
            if (at->edge == e) {
                report->duplicate++;
                report->opposite_pairs += at->forward != use[i].forward;
            } else {
                *at = (first_facet){e, use[i].forward};
            }
        }
    }
    work->used = mark;
    return LRCS_OK;
}

/* Counts the welded points that facets have as corners, and the degenerate facets, whose corners do
   not count. */
static int count_used_points(const measured_mesh *m, const lrcsi_topology *t, uint32_t vertex_count,
                             lrcs_work *work, lrcs_mesh_report *report)
{
    size_t mark = work->used;
    unsigned char *used = lrcsi_work_take_zero(work, vertex_count, sizeof *used);
    if (!used) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < m->facet_count; f++) {
        report->degenerate += t->degenerate[f];
        for (int c = 0; c < 3 && !t->degenerate[f]; c++) {
            unsigned char *u = &used[t->weld[m->facet[f].corner[c]]];
            report->vertices += !*u;
            *u = 1;
        }
    }
    work->used = mark;
    return LRCS_OK;
}

size_t lrcs_mesh_check_need(uint32_t vertex_count, uint32_t facet_count)
{
    size_t convex = lrcsi_convex_need(vertex_count, facet_count);
    size_t duplicates = lrcsi_work_bytes(vertex_count, sizeof(first_facet));
    size_t points = lrcsi_work_bytes(vertex_count, 1);
    size_t scratch = convex > duplicates ? convex : duplicates;
    return lrcsi_work_add(lrcsi_topology_need(vertex_count, facet_count),
                          scratch > points ? scratch : points);
}

int lrcs_mesh_check(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                    uint32_t facet_count, lrcs_work *work, lrcs_mesh_report *report)
{
    size_t mark = work->used;
    measured_mesh m = {vertex, facet, facet_count};
    lrcs_mesh_report made = {0};
    lrcsi_topology t;
    int status = lrcsi_topology_make(vertex, vertex_count, facet, facet_count, work, &t);
    if (status == LRCS_OK) {
        status = count_used_points(&m, &t, vertex_count, work, &made);
    }
    if (status == LRCS_OK) {
        status = count_duplicates(&m, &t, vertex_count, work, &made);
    }
    if (status == LRCS_OK) {
        status =
            lrcsi_convex_prove(vertex, vertex_count, facet, facet_count, &t, work, &made.convex);
    }
    if (status == LRCS_OK) {
        count_edge_uses(&t, &made);
        lrcsi_box box = measure_box(&m);
        double scale = power_of_two_near(lrcsi_box_side(&box));
        double centre[3];
        for (int k = 0; k < 3; k++) {
            made.box_min[k] = box.low[k];
            made.box_max[k] = box.high[k];
            centre[k] = 0.5 * box.low[k] + 0.5 * box.high[k];
        }
        made.area = measure_area(&m, t.degenerate, scale);
        made.volume = measure_volume(&m, t.degenerate, centre, scale);
        *report = made;
    }
    work->used = mark;
    return status;
}
