/* SPDX-License-Identifier: MIT */
/* Facets and segments in view coordinates, and their errors.

   Positions. b is the largest coordinate of the block. A vertex is computed in double-double, with
   an error of 256 u^2 of its distance from the origin. Its position relative to the middle of the
   block is then rounded once, by u of itself, and a sum of products that gives its distance from a
   line has an error of 5 u of that: together `err`. The line through two vertices has a smaller
   error near the block. Its direction has an error of 2 u. Its distance from the middle of the
   block is computed in double-double, with a relative error of 2 u, apart from a factor that a, b
   and c have in common. Both cost 5.7 u b within the block, and evaluating the line there 2.9 u b.
   That is less than 16 u b, which all cells allow for (visibility/cells/cells_cut.c); `line_err` is
   the rest, due to the errors of the vertices.

   Heights. Let H be the smallest height of a facet. A point within w of the facet has barycentric
   coordinates with an error of w / H. Let G be twice the computed slope of the facet, an upper
   bound of the true one. Then z at that point has an error of e + G (w + 8 u l^2 / H), where e is
   the error of z of the vertices and l the longest side; the last term is due to the error of the
   slope itself. Also, z is always between the smallest and the largest z of the corners. Nothing
   else is used for a facet with an H below 64 times the position error of its vertices, or below
   2^-40 l: G bounds the true slope wherever H exceeds that error by far, and any such limit is
   right. */
#include "visibility/cells/cells_facet.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/range.h"
#include "visibility/base/sample.h"
#include "visibility/index/event.h"
#include "visibility/index/grid.h"

/* The axes of the view, perpendicular to the direction within 32 u^2. The rows of R are
   perpendicular to it within 4 u; their components along the direction are subtracted in the lower
   parts. The axes may deviate by 4 u from a right angle to each other. */
void lrcsi_cells_frame_make(lrcsi_cells_frame *c)
{
    const double *d = c->view->direction;
    for (int i = 0; i < 2; i++) {
        const double *row = c->view->R[i];
        lrcsi_dd dot = {0, 0};
        for (int k = 0; k < 3; k++) {
            dot = lrcsi_dd_add(dot, lrcsi_dd_two_product(row[k], d[k]));
        }
        double along = lrcsi_dd_value(dot) / (c->view->length * c->view->length);
        for (int k = 0; k < 3; k++) {
            c->axis_low[i][k] = -along * d[k];
        }
    }
}

/* A vertex in the view: x and y in double-double, with errors of at most 256 u^2 of the distance
   from the origin (some 100 u^2 follow from the operations below); z from the view, with an error
   of at most 20 u of that distance, twice what the view states. */
static void point_make(const lrcsi_cells_frame *c, uint32_t vertex, lrcsi_cells_point *p)
{
    const lrcs_prepared *prepared = c->view->prepared;
    lrcsi_dd gap[3];
    for (int k = 0; k < 3; k++) {
        gap[k] = lrcsi_dd_two_sum(prepared->vertex[vertex].x[k], -prepared->origin[k]);
    }
    for (int i = 0; i < 2; i++) {
        const double *row = c->view->R[i];
        lrcsi_dd sum = {0, 0};
        double low = 0;
        for (int k = 0; k < 3; k++) {
            lrcsi_dd term = lrcsi_dd_two_product(row[k], gap[k].hi);
            low += term.lo + (row[k] * gap[k].lo + c->axis_low[i][k] * gap[k].hi);
            lrcsi_dd next = lrcsi_dd_two_sum(sum.hi, term.hi);
            sum = (lrcsi_dd){next.hi, sum.lo + next.lo};
        }
        p->x[i] = lrcsi_dd_quick_sum(sum.hi, sum.lo + low);
    }
    p->z = c->view->point[vertex].x[2];
    double far = fabs(p->x[0].hi) + fabs(p->x[1].hi) + fabs(p->z);
    p->line_err = 256 * LRCSI_U * LRCSI_U * far;
    p->z_err = 20 * LRCSI_U * far;
    p->block = 0;
}

const lrcsi_cells_point *lrcsi_cells_vertex(lrcsi_cells_frame *c, uint32_t vertex)
{
    lrcsi_cells_point *p = &c->point[vertex];
    if (!c->made[vertex]) {
        point_make(c, vertex, p);
        c->made[vertex] = 1;
    }
    if (p->block != c->block) {
        for (int k = 0; k < 2; k++) {
            lrcsi_dd gap = lrcsi_dd_two_sum(p->x[k].hi, -c->middle[k]);
            p->local[k] = lrcsi_dd_two_sum(gap.hi, gap.lo + p->x[k].lo);
        }
        p->err = 6 * LRCSI_U * (fabs(p->local[0].hi) + fabs(p->local[1].hi)) + p->line_err;
        p->block = c->block;
    }
    return p;
}

double lrcsi_cells_line(const lrcsi_cells_point *p, const lrcsi_cells_point *q, double line[3])
{
    const lrcsi_dd *at = p->local;
    lrcsi_dd along[2];
    for (int k = 0; k < 2; k++) {
        lrcsi_dd gap = lrcsi_dd_two_sum(q->local[k].hi, -at[k].hi);
        along[k] = lrcsi_dd_two_sum(gap.hi, gap.lo + (q->local[k].lo - at[k].lo));
    }
    lrcsi_dd one = lrcsi_dd_two_product(along[1].hi, at[0].hi);
    lrcsi_dd two = lrcsi_dd_two_product(along[0].hi, at[1].hi);
    double low = (along[1].hi * at[0].lo + along[1].lo * at[0].hi) -
                 (along[0].hi * at[1].lo + along[0].lo * at[1].hi);
    lrcsi_dd cross = lrcsi_dd_two_sum(one.hi, -two.hi);
    double length = sqrt(along[0].hi * along[0].hi + along[1].hi * along[1].hi);
    double inverse = length > 0 ? 1 / length : 0;
    line[0] = length > 0 ? -along[1].hi * inverse : 1;
    line[1] = along[0].hi * inverse;
    line[2] = length > 0 ? (cross.hi + (cross.lo + (one.lo - two.lo + low))) * inverse : -at[0].hi;
    return length;
}

static int longest_side(const lrcsi_cells_facet *f)
{
    int k = f->length[1] > f->length[0] ? 1 : 0;
    return f->length[2] > f->length[k] ? 2 : k;
}

/* Its smallest height, as computed: negative if rounding has reversed its orientation. */
static double facet_min_height(const lrcsi_cells_facet *f)
{
    int k = (longest_side(f) + 2) % 3;
    return lrcsi_line_at(f->side[longest_side(f)], f->x[k], f->y[k]);
}

/* A facet so narrow that rounding may have reversed its orientation. Its sides are replaced by
   those of a band along its longest side that contains it. It surely covers no sample, and its area
   is left undecided. */
static void facet_make_band(lrcsi_cells_facet *f)
{
    double wide = fabs(facet_min_height(f)) + 4 * f->err;
    double line[3];
    memcpy(line, f->side[longest_side(f)], sizeof line);
    for (int k = 0; k < 3; k++) {
        int sign = k == 1 ? -1 : 1;
        f->side[k][0] = sign * line[0];
        f->side[k][1] = sign * line[1];
        f->side[k][2] = sign * line[2] + wide;
    }
}

/* The plane and its error (see Heights above); HUGE_VAL if the facet is so narrow that only the
   heights of its corners are used. */
static void facet_make_plane(lrcsi_cells_facet *f, const double z[3])
{
    const double dx[2] = {f->x[1] - f->x[0], f->x[2] - f->x[0]};
    const double dy[2] = {f->y[1] - f->y[0], f->y[2] - f->y[0]};
    double twice = dx[0] * dy[1] - dx[1] * dy[0];
    double longest = lrcsi_max3(f->length[0], f->length[1], f->length[2]);
    double height = twice / longest; /* the least */
    double rise = lrcsi_max3(z[0], z[1], z[2]) - lrcsi_min3(z[0], z[1], z[2]) + 4 * f->z_err;
    f->z_low = lrcsi_min3(z[0], z[1], z[2]) - f->z_err;
    f->z_high = lrcsi_max3(z[0], z[1], z[2]) + f->z_err;
    f->z[0] = f->z[1] = f->z[2] = 0;
    f->plane_err[0] = f->plane_err[1] = HUGE_VAL;
    if (height > 64 * f->err && height > 0x1p-40 * longest) {
        const double dz[2] = {z[1] - z[0], z[2] - z[0]};
        f->z[0] = (dz[0] * dy[1] - dz[1] * dy[0]) / twice;
        f->z[1] = (dz[1] * dx[0] - dz[0] * dx[1]) / twice;
        f->z[2] = z[0] - f->z[0] * f->x[0] - f->z[1] * f->y[0];
        double slope = lrcsi_min(4 * rise / height,
                                 2 * (fabs(f->z[0]) + fabs(f->z[1])) + 8 * f->z_err / height);
        f->plane_err[1] = slope;
        f->plane_err[0] =
            3 * f->z_err + slope * (2 * f->err + 8 * LRCSI_U * longest * longest / height) +
            8 * LRCSI_U * (fabs(z[0]) + fabs(f->z[0] * f->x[0]) + fabs(f->z[1] * f->y[0]));
    }
}

void lrcsi_cells_facet_make(lrcsi_cells_frame *c, uint32_t facet, lrcsi_cells_facet *f)
{
    const lrcsi_view *view = c->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const lrcsi_cells_point *p[3];
    double z[3];
    f->facet = facet;
    f->unknown_contact = 0;
    f->err = f->z_err = f->line_err = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = lrcsi_cells_vertex(c, corner[view->facing[facet] > 0 ? k : (3 - k) % 3]);
        f->x[k] = p[k]->local[0].hi;
        f->y[k] = p[k]->local[1].hi;
        z[k] = p[k]->z;
        f->err = lrcsi_max(f->err, p[k]->err);
        f->line_err = lrcsi_max(f->line_err, p[k]->line_err);
        f->z_err = lrcsi_max(f->z_err, p[k]->z_err);
    }
    for (int k = 0; k < 3; k++) {
        f->length[k] = lrcsi_cells_line(p[k], p[k == 2 ? 0 : k + 1], f->side[k]) + 4 * f->err;
    }
    f->low[0] = lrcsi_min3(f->x[0], f->x[1], f->x[2]);
    f->high[0] = lrcsi_max3(f->x[0], f->x[1], f->x[2]);
    f->low[1] = lrcsi_min3(f->y[0], f->y[1], f->y[2]);
    f->high[1] = lrcsi_max3(f->y[0], f->y[1], f->y[2]);
    facet_make_plane(f, z);
    f->degenerate = !(facet_min_height(f) > 16 * f->err);
    if (f->degenerate) {
        facet_make_band(f);
    }
}

void lrcsi_cells_facet_z(const lrcsi_cells_facet *f, const double at[2], double tolerance,
                         double range[2])
{
    range[0] = f->z_low;
    range[1] = f->z_high;
    double err = f->plane_err[0] + f->plane_err[1] * tolerance;
    if (err < HUGE_VAL) {
        double z = f->z[0] * at[0] + f->z[1] * at[1] + f->z[2];
        range[0] = lrcsi_max(range[0], z - err);
        range[1] = lrcsi_min(range[1], z + err);
    }
}

double lrcsi_cells_facet_z_bound(const lrcsi_cells_facet *f, const lrcsi_clip_sides *s, int sign)
{
    double corner = sign > 0 ? f->z_high : f->z_low;
    double err = f->plane_err[0] + f->plane_err[1] * s->tolerance;
    if (!(err < HUGE_VAL)) {
        return corner;
    }
    double x = 0.5 * (s->low[0] + s->high[0]);
    double y = 0.5 * (s->low[1] + s->high[1]);
    double half = fabs(f->z[0]) * (s->high[0] - x) + fabs(f->z[1]) * (s->high[1] - y);
    double z = f->z[0] * x + f->z[1] * y + f->z[2];
    return sign > 0 ? lrcsi_min(corner, z + half + err) : lrcsi_max(corner, z - half - err);
}

int lrcsi_cells_facet_order(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    int side = lrcsi_sample_side(view, second, first);
    if (side != 0) {
        return side;
    }
    const lrcsi_intersection *contact = lrcsi_intersection_find(intersections, first, second);
    contact = contact ? contact : lrcsi_intersection_find(intersections, second, first);
    return !contact ? lrcsi_sample_overlap_order(view, second, first)
           : contact->kind != LRCSI_INTERSECTION_COPLANAR     ? 0
           : lrcsi_sample_has_precedence(view, second, first) ? 1
                                                              : -1;
}

/* --- which facet continues another ------------------------------------------------------------ */

int lrcsi_cells_has_coplanar(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        if (intersections->entry[i].kind == LRCSI_INTERSECTION_COPLANAR &&
            lrcsi_view_casts(view, intersections->entry[i].other)) {
            return 1;
        }
    }
    return 0;
}

uint32_t lrcsi_cells_neighbour(const lrcsi_view *view, uint32_t facet, int k)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t other = p->neighbours.facet[facet].corner[k];
    if (other == facet) {
        lrcsi_edge_facets on;
        uint32_t edge = p->topology.facet_edge[facet].corner[k]; /* irregular */
        return lrcsi_edge_kind_of(view, edge, LRCS_NONE, &on) != LRCSI_EDGE_JOINS
                   ? LRCS_NONE
                   : on.facet[on.facet[0] == facet];
    }
    return other < p->scene->facet_count && lrcsi_view_casts(view, other) &&
                   lrcsi_event_continues(view->facing[facet], view->facing[other])
               ? other
               : LRCS_NONE;
}

uint32_t lrcsi_cells_connected(const lrcsi_view *view, const unsigned char *coplanar,
                               uint32_t facet, int k)
{
    uint32_t other = lrcsi_cells_neighbour(view, facet, k);
    return other != LRCS_NONE && !coplanar[facet] && !coplanar[other] &&
                   !lrcsi_intersection_along(&view->prepared->intersections, facet, k)
               ? other
               : LRCS_NONE;
}

int lrcsi_cells_side_number(const lrcsi_view *view, uint32_t facet, int k)
{
    return view->facing[facet] > 0 ? k : 2 - k;
}
