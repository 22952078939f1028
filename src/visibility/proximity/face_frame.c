/* SPDX-License-Identifier: MIT */
/* Decides which facets form the flat face that a part shows the laser, where that face lies in the
   view, and which other parts are behind all of it. Which margins lie on it is decided in
   visibility/proximity/face_margin.c; U and V are those of its proof. */
#include "visibility/proximity/face_frame.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "scene/neighbours.h"

/* The least cosine of the face's incidence. A heuristic, so that distances in the plane follow from
   those in projection. */
#define FACE_COS_MIN 0.02

int lrcsi_face_has_facet(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    return view->facing[facet] > 0 && p->scene->facet_smooth[facet] == 0 && part->rigid &&
           part->kind >= 0 && !lrcsi_shape_is_plane_faced(part->kind) && part->bounds.reach > 0 &&
           (part->solid || part->kind == LRCS_SHAPE_DISC);
}

unsigned lrcsi_face_border_sides(const lrcsi_view *view, uint32_t facet)
{
    unsigned sides = 0;
    for (int k = 0; k < 3; k++) {
        const uint32_t other = lrcsi_neighbour_in_part(view->prepared, facet, k);
        if (other == LRCS_NONE || !lrcsi_face_has_facet(view, other)) {
            sides |= 1u << k;
        }
    }
    return sides;
}

/* Are the facets of a curved part so far from the face in projection that neither they nor the true
   shape hide anything near it? */
static int part_is_beside(const lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                          uint32_t part)
{
    const lrcs_prepared *p = bands->view->prepared;
    const lrcsi_box *box = &bands->box[part];
    const double slack = 2 * lrcsi_proximity_slack(p, face->part, part) +
                         2 * p->proximity.reach[face->part] + 64 * LRCSI_PROXIMITY_ERR;
    int beside = 0;
    for (int k = 0; k < 2; k++) {
        const double wide = face->outer * (fabs(face->axis[0][k]) + fabs(face->axis[1][k])) + slack;
        beside |= box->low[k] > face->view[k] + wide || box->high[k] < face->view[k] - wide;
    }
    return beside;
}

/* Is every open curved part in front of the face's part, or of the plane of one of its facets, or
   behind the part, for all of the facet, or beside the face? */
static int open_parts_are_ordered(lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                                  uint32_t facet)
{
    const lrcs_prepared *p = bands->view->prepared;
    int ordered = lrcsi_meter_take(bands->meter, p->scene->part_count);
    for (uint32_t i = 0; i < p->scene->part_count && ordered; i++) {
        double err;
        double unproved = 0;
        ordered = i == face->part || !(p->proximity.hausdorff[i] > 0) ||
                  lrcsi_proximity_openings(p, i) == 0 ||
                  ((lrcsi_part_is_in_front(&bands->orders, facet, i, &err, &unproved) ||
                    lrcsi_part_is_behind(&bands->orders, facet, i, &unproved)) &&
                   unproved == 0) ||
                  part_is_beside(bands, face, i);
    }
    return ordered;
}

int lrcsi_face_frame_make(lrcsi_event_bands *bands, uint32_t index, lrcsi_face_frame *face)
{
    const lrcsi_view *view = bands->view;
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    double from[3];
    double x[3];
    *face = (lrcsi_face_frame){.part = index, .facet = LRCS_NONE};
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (lrcsi_face_has_facet(view, f)) {
            face->facet = f;
            if (p->skip[f] || p->redundant[f] >= LRCSI_REDUNDANT_FROM_BEHIND) {
                return 0;
            }
        }
    }
    if (face->facet == LRCS_NONE) {
        return 0;
    }
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const double unit = ldexp(part->unit, -p->exponent);
    for (int k = 0; k < 3; k++) {
        face->centre[k] = ldexp(part->origin[k], -p->exponent);
    }
    lrcsi_vec3_between(face->centre, lrcsi_prepared_corner(p, face->facet, 0), from);
    double height = lrcsi_vec3_dot(from, part->axis[2]);
    for (int k = 0; k < 3; k++) {
        face->centre[k] += height * part->axis[2][k];
    }
    lrcsi_view_coordinates(view, face->centre, x);
    for (int i = 0; i < 2; i++) {
        face->view[i] = x[i];
        for (int k = 0; k < 2; k++) {
            face->axis[k][i] = lrcsi_vec3_dot(view->R[i], part->axis[k]);
        }
    }
    /* the sides of U are at least this far from its centre, since cos h >= 1 - h^2 / 2 */
    int is_top = body.zones > 0 && fabs(height) > 0.5 * body.height * unit;
    face->radius = (is_top ? body.top : body.base) * unit *
                   lrcsi_min(1, body.vertex_ratio * (1 - 0.5 * body.half * body.half));
    face->outer = (is_top ? body.top : body.base) * unit * lrcsi_max(1, body.vertex_ratio) *
                  LRCSI_OUTWARD_NANO;
    face->det = face->axis[0][0] * face->axis[1][1] - face->axis[0][1] * face->axis[1][0];
    int ordered = fabs(face->det) > FACE_COS_MIN;
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count && ordered;
         f++) {
        ordered = !lrcsi_face_has_facet(view, f) || open_parts_are_ordered(bands, face, f);
    }
    return ordered;
}

void lrcsi_face_coordinates(const lrcsi_face_frame *face, const double x[2], double at[2])
{
    const double from[2] = {x[0] - face->view[0], x[1] - face->view[1]};
    at[0] = (from[0] * face->axis[1][1] - from[1] * face->axis[1][0]) / face->det;
    at[1] = (from[1] * face->axis[0][0] - from[0] * face->axis[0][1]) / face->det;
}

/* The projection makes no distance in the plane smaller than |det| times itself. */
int lrcsi_face_contains(const lrcsi_face_frame *face, const double x[2], double distance)
{
    double at[2];
    lrcsi_face_coordinates(face, x, at);
    double wide = (distance + LRCSI_PROXIMITY_ERR) / fabs(face->det) * LRCSI_OUTWARD_NANO;
    return sqrt(at[0] * at[0] + at[1] * at[1]) + wide < face->radius;
}

/* Where a segment enters a circle about the centre of the face, and leaves it, as fractions of the
   way; rounding moves them a little. Returns 0 if it does not meet the circle; both are then where
   it is nearest to it. */
static int face_circle_cut(const lrcsi_face_frame *face, const double a[2], const double b[2],
                           double radius, double cut[2])
{
    double p[2];
    double q[2];
    lrcsi_face_coordinates(face, a, p);
    lrcsi_face_coordinates(face, b, q);
    const double pq[2] = {q[0] - p[0], q[1] - p[1]};
    const double square = pq[0] * pq[0] + pq[1] * pq[1];
    const double middle = -(p[0] * pq[0] + p[1] * pq[1]) / square;
    const double across = (p[0] * pq[1] - p[1] * pq[0]) / sqrt(square);
    const double half = sqrt(lrcsi_max(0, radius * radius - across * across) / square);
    cut[0] = middle - half;
    cut[1] = middle + half;
    return square > 0 && radius > fabs(across);
}

/* A point of the segment from a to b. */
static void segment_point(const double a[2], const double b[2], double t, double x[2])
{
    for (int i = 0; i < 2; i++) {
        x[i] = a[i] + t * (b[i] - a[i]);
    }
}

/* A disc is convex: it contains what is between two points of it. The ends are tested; they are
   chosen a little closer together, so that rounding seldom matters. */
lrcsi_segment_part lrcsi_face_segment_inside(const lrcsi_face_frame *face, const double a[2],
                                             const double b[2], double distance)
{
    const lrcsi_segment_part none = {1, 0};
    const double wide = (distance + 4 * LRCSI_PROXIMITY_ERR) / fabs(face->det);
    double cut[2];
    double x[2][2];
    if (!face_circle_cut(face, a, b, (face->radius - wide) * (1 - 1e-9), cut)) {
        return none;
    }
    const lrcsi_segment_part part = {lrcsi_max(0, cut[0]), lrcsi_min(1, cut[1])};
    segment_point(a, b, part.from, x[0]);
    segment_point(a, b, part.to, x[1]);
    return !lrcsi_segment_part_is_empty(part) && lrcsi_face_contains(face, x[0], distance) &&
                   lrcsi_face_contains(face, x[1], distance)
               ? part
               : none;
}

/* The distance from the centre is a convex function along the segment: outside of two points on
   either side of the nearest one, all others are farther away. */
lrcsi_segment_part lrcsi_face_segment_near(const lrcsi_face_frame *face, const double a[2],
                                           const double b[2], double distance)
{
    const lrcsi_segment_part none = {1, 0};
    const double least =
        face->outer + (distance + 4 * LRCSI_PROXIMITY_ERR) / fabs(face->det) * LRCSI_OUTWARD_NANO;
    lrcsi_segment_part part = {0, 1};
    double cut[2];
    (void)face_circle_cut(face, a, b, least * (1 + 1e-6), cut);
    for (int i = 0; i < 2; i++) {
        const double t = lrcsi_min(1, lrcsi_max(0, cut[i]));
        double x[2];
        double at[2];
        segment_point(a, b, t, x);
        lrcsi_face_coordinates(face, x, at);
        if (sqrt(at[0] * at[0] + at[1] * at[1]) > least) {
            *(i == 0 ? &part.from : &part.to) = t;
        }
    }
    return part.from < part.to ? part : none;
}

int lrcsi_face_part_is_behind(lrcsi_event_bands *bands, const lrcsi_face_frame *face, uint32_t part)
{
    const lrcs_part *own = &bands->view->prepared->scene->part[face->part];
    const uint32_t end = own->first_facet + own->facet_count;
    int behind = lrcsi_meter_take(bands->meter, own->facet_count);
    for (uint32_t f = own->first_facet; f < end && behind; f++) {
        double unproved = 0;
        behind = !lrcsi_face_has_facet(bands->view, f) ||
                 (lrcsi_part_is_behind(&bands->orders, f, part, &unproved) && unproved == 0);
    }
    return behind;
}
