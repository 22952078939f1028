/* SPDX-License-Identifier: MIT */
/* Decides which facets form the flat faces that a part shows the laser, where a face lies in the
   view, and which other parts are behind all of it. Which margins lie on it is decided in
   visibility/proximity/face_margin.c; U and V are those of its proof. */
#include "visibility/proximity/face_frame.h"

#include <math.h>
#include <string.h>

#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "scene/neighbours.h"

/* The least cosine of the face's incidence. A heuristic, so that distances in the plane follow from
   those in projection. */
#define FACE_COS_MIN 0.02
/* Rounding may turn the two facets of a rectangle against each other by this, rad: F counts as the
   same on both (integrate/wall/tessellation.c). */
#define PLANE_TURN_MAX 1e-12

/* Two successive facets of a box form a face, and two successive faces are parallel
   (mesh/shape/tessellate.c): only one of these faces the laser. */
uint32_t lrcsi_face_of(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t index = p->scene->facet_part[facet];
    const lrcs_part *part = &p->scene->part[index];
    if (view->facing[facet] <= 0 || p->scene->facet_smooth[facet] != 0 || !part->rigid ||
        part->kind < 0) {
        return LRCS_NONE;
    }
    if (lrcsi_shape_is_plane_faced(part->kind)) {
        return part->solid || part->kind == LRCS_SHAPE_PLATE
                   ? LRCSI_FACES_OF_PART * index + (facet - part->first_facet) / 4
                   : LRCS_NONE;
    }
    return part->bounds.reach > 0 && (part->solid || part->kind == LRCS_SHAPE_DISC)
               ? LRCSI_FACES_OF_PART * index
               : LRCS_NONE;
}

unsigned lrcsi_face_border_sides(const lrcsi_view *view, uint32_t facet)
{
    unsigned sides = 0;
    for (int k = 0; k < 3; k++) {
        const uint32_t other = lrcsi_neighbour_in_part(view->prepared, facet, k);
        if (other == LRCS_NONE || lrcsi_face_of(view, other) != lrcsi_face_of(view, facet)) {
            sides |= 1u << k;
        }
    }
    return sides;
}

/* Is every open curved part in front of the face's part, or of the planes of its facets, or behind
   the part, for all of each facet, or beside the face? */
static int open_parts_are_ordered(lrcsi_event_bands *bands, const lrcsi_face_frame *face)
{
    const lrcs_prepared *p = bands->view->prepared;
    const lrcs_part *own = &p->scene->part[face->part];
    int ordered = lrcsi_meter_take(bands->meter, p->scene->part_count);
    for (uint32_t i = 0; i < p->scene->part_count && ordered; i++) {
        if (i == face->part || !(p->proximity.hausdorff[i] > 0) ||
            lrcsi_proximity_openings(p, i) == 0 || lrcsi_face_part_is_beside(bands, face, i)) {
            continue;
        }
        ordered = lrcsi_meter_take(bands->meter, own->facet_count);
        for (uint32_t f = own->first_facet; f < own->first_facet + own->facet_count && ordered;
             f++) {
            double err;
            double unproved = 0;
            ordered = lrcsi_face_of(bands->view, f) != face->number ||
                      ((lrcsi_part_is_in_front(&bands->orders, f, i, &err, &unproved) ||
                        lrcsi_part_is_behind(&bands->orders, f, i, &unproved)) &&
                       unproved == 0);
        }
    }
    return ordered;
}

/* The circles of a face of a body of revolution. The sides of U are at least as far from its centre
   as the first one, since cos h >= 1 - h^2 / 2. */
static void circle_make(const lrcs_prepared *p, lrcsi_face_frame *face)
{
    const lrcs_part *part = &p->scene->part[face->part];
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const double unit = ldexp(part->unit, -p->exponent);
    double from[3];
    for (int k = 0; k < 3; k++) {
        face->centre[k] = ldexp(part->origin[k], -p->exponent);
    }
    lrcsi_vec3_between(face->centre, lrcsi_prepared_corner(p, face->facet, 0), from);
    const double height = lrcsi_vec3_dot(from, part->axis[2]);
    for (int k = 0; k < 3; k++) {
        face->centre[k] += height * part->axis[2][k];
        face->plane[0][k] = part->axis[0][k];
        face->plane[1][k] = part->axis[1][k];
    }
    const int is_top = body.zones > 0 && fabs(height) > 0.5 * body.height * unit;
    const double radius = (is_top ? body.top : body.base) * unit;
    face->radius = radius * lrcsi_min(1, body.vertex_ratio * (1 - 0.5 * body.half * body.half));
    face->outer = radius * lrcsi_max(1, body.vertex_ratio) * LRCSI_OUTWARD_NANO;
}

/* The rectangle of a face of a plate or box: of the corners of its first facet, the first and the
   third are opposite ones of the rectangle; of the second facet, the first and the second. Returns
   0 if the two are turned against each other: their turn is at most the sum of the differences
   between the components of their unit normals. */
static int rectangle_make(const lrcs_prepared *p, lrcsi_face_frame *face)
{
    const lrcs_part *part = &p->scene->part[face->part];
    const int normal = 2 - (int)(face->number % LRCSI_FACES_OF_PART);
    const int is_second = (face->facet - part->first_facet) % 2 != 0;
    const double *a = lrcsi_prepared_corner(p, face->facet, 0);
    const double *c = lrcsi_prepared_corner(p, face->facet, is_second ? 1 : 2);
    double diagonal[3];
    lrcsi_vec3_between(a, c, diagonal);
    face->is_rectangle = 1;
    for (int k = 0; k < 3; k++) {
        face->centre[k] = a[k] + 0.5 * diagonal[k];
    }
    for (int i = 0; i < 2; i++) {
        const double *axis = part->axis[(normal + 1 + i) % 3];
        memcpy(face->plane[i], axis, sizeof face->plane[i]);
        face->half[i] = 0.5 * fabs(lrcsi_vec3_dot(diagonal, axis));
    }
    const uint32_t other = is_second ? face->facet - 1 : face->facet + 1;
    double n[2][3];
    double turn = 0;
    double height = 0; /* of the other facet's corner that this one does not have */
    double from[3];
    lrcsi_prepared_unit_normal(p, face->facet, n[0]);
    lrcsi_prepared_unit_normal(p, other, n[1]);
    lrcsi_vec3_between(a, lrcsi_prepared_corner(p, other, is_second ? 1 : 2), from);
    for (int k = 0; k < 3; k++) {
        turn += fabs(n[0][k] - n[1][k]);
        height += from[k] * n[0][k];
    }
    face->plane_err = fabs(height);
    return turn <= PLANE_TURN_MAX && !p->skip[other];
}

int lrcsi_face_frame_make(lrcsi_event_bands *bands, uint32_t number, lrcsi_face_frame *face)
{
    const lrcsi_view *view = bands->view;
    const lrcs_prepared *p = view->prepared;
    const uint32_t index = number / LRCSI_FACES_OF_PART;
    const lrcs_part *part = &p->scene->part[index];
    double x[3];
    *face = (lrcsi_face_frame){.number = number, .part = index, .facet = LRCS_NONE};
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (lrcsi_face_of(view, f) == number) {
            face->facet = f;
            if (p->skip[f] || p->redundant[f] >= LRCSI_REDUNDANT_FROM_BEHIND) {
                return 0;
            }
        }
    }
    if (face->facet == LRCS_NONE) {
        return 0;
    }
    if (!lrcsi_shape_is_plane_faced(part->kind)) {
        circle_make(p, face);
    } else if (!rectangle_make(p, face)) {
        return 0;
    }
    lrcsi_view_coordinates(view, face->centre, x);
    for (int i = 0; i < 2; i++) {
        face->view[i] = x[i];
        for (int k = 0; k < 2; k++) {
            face->axis[k][i] = lrcsi_vec3_dot(view->R[i], face->plane[k]);
        }
    }
    face->det = face->axis[0][0] * face->axis[1][1] - face->axis[0][1] * face->axis[1][0];
    lrcsi_vec3_cross(face->plane[0], face->plane[1], face->up);
    for (int k = 0; k < 3; k++) {
        face->up[k] = face->det < 0 ? -face->up[k] : face->up[k];
    }
    return fabs(face->det) > FACE_COS_MIN && open_parts_are_ordered(bands, face);
}

double lrcsi_face_extent(const lrcsi_face_frame *face, int k)
{
    const double wide[2] = {face->is_rectangle ? face->half[0] : face->outer,
                            face->is_rectangle ? face->half[1] : face->outer};
    return wide[0] * fabs(face->axis[0][k]) + wide[1] * fabs(face->axis[1][k]);
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
    if (face->is_rectangle) {
        return fabs(at[0]) + wide < face->half[0] && fabs(at[1]) + wide < face->half[1];
    }
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

/* The part of a segment in a rectangle larger by `wide` on each side; rounding moves its ends a
   little. */
static lrcsi_segment_part face_rectangle_cut(const lrcsi_face_frame *face, const double a[2],
                                             const double b[2], double wide)
{
    lrcsi_segment_part part = {0, 1};
    double p[2];
    double q[2];
    lrcsi_face_coordinates(face, a, p);
    lrcsi_face_coordinates(face, b, q);
    for (int i = 0; i < 2; i++) {
        lrcsi_segment_part_limit(&part, p[i], q[i], face->half[i] + wide);
        lrcsi_segment_part_limit(&part, -p[i], -q[i], face->half[i] + wide);
    }
    return part;
}

/* The face is convex: it contains what is between two points of it. The ends are tested; they are
   chosen a little closer together, so that rounding seldom matters. */
lrcsi_segment_part lrcsi_face_segment_inside(const lrcsi_face_frame *face, const double a[2],
                                             const double b[2], double distance)
{
    const lrcsi_segment_part none = {1, 0};
    const double wide = (distance + 4 * LRCSI_PROXIMITY_ERR) / fabs(face->det);
    double cut[2];
    double x[2][2];
    lrcsi_segment_part part = none;
    if (face->is_rectangle) {
        part = face_rectangle_cut(face, a, b, -wide * (1 + 1e-9));
    } else if (face_circle_cut(face, a, b, (face->radius - wide) * (1 - 1e-9), cut)) {
        part = (lrcsi_segment_part){lrcsi_max(0, cut[0]), lrcsi_min(1, cut[1])};
    }
    segment_point(a, b, part.from, x[0]);
    segment_point(a, b, part.to, x[1]);
    return !lrcsi_segment_part_is_empty(part) && lrcsi_face_contains(face, x[0], distance) &&
                   lrcsi_face_contains(face, x[1], distance)
               ? part
               : none;
}

/* The distance from the centre is a convex function along the segment: outside of two points on
   either side of the nearest one, all others are farther away. Beside a rectangle, rounding moves
   points by less than is added to its distance. */
lrcsi_segment_part lrcsi_face_segment_near(const lrcsi_face_frame *face, const double a[2],
                                           const double b[2], double distance)
{
    const lrcsi_segment_part none = {1, 0};
    const double least =
        face->outer + (distance + 4 * LRCSI_PROXIMITY_ERR) / fabs(face->det) * LRCSI_OUTWARD_NANO;
    lrcsi_segment_part part = {0, 1};
    double cut[2];
    if (face->is_rectangle) {
        return face_rectangle_cut(face, a, b,
                                  (distance + 64 * LRCSI_PROXIMITY_ERR) / fabs(face->det) *
                                      LRCSI_OUTWARD_NANO);
    }
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

int lrcsi_face_part_is_beside(const lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                              uint32_t part)
{
    const lrcs_prepared *p = bands->view->prepared;
    const lrcsi_box *box = &bands->box[part];
    const double slack = 2 * lrcsi_proximity_slack(p, face->part, part) +
                         2 * p->proximity.reach[face->part] + 64 * LRCSI_PROXIMITY_ERR;
    int beside = 0;
    for (int k = 0; k < 2; k++) {
        const double wide = lrcsi_face_extent(face, k) + slack;
        beside |= box->low[k] > face->view[k] + wide || box->high[k] < face->view[k] - wide;
    }
    return beside;
}

int lrcsi_face_part_is_separated_in_front(lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                                          uint32_t part, double *unproved)
{
    const lrcsi_view *view = bands->view;
    const lrcs_part *own = &view->prepared->scene->part[face->part];
    const uint32_t end = own->first_facet + own->facet_count;
    int in_front = lrcsi_meter_take(bands->meter, own->facet_count);
    *unproved = 0;
    for (uint32_t f = own->first_facet; f < end && in_front; f++) {
        double fraction = 0;
        if (lrcsi_face_of(view, f) == face->number) {
            in_front = lrcsi_part_is_separated_in_front(&bands->orders, f, part, &fraction);
            *unproved += fraction * lrcsi_view_projected(view, f) * LRCSI_OUTWARD_NANO;
        }
    }
    return in_front;
}

int lrcsi_face_part_is_behind(lrcsi_event_bands *bands, const lrcsi_face_frame *face, uint32_t part)
{
    const lrcs_part *own = &bands->view->prepared->scene->part[face->part];
    const uint32_t end = own->first_facet + own->facet_count;
    int behind = lrcsi_meter_take(bands->meter, own->facet_count);
    for (uint32_t f = own->first_facet; f < end && behind; f++) {
        double unproved = 0;
        behind = lrcsi_face_of(bands->view, f) != face->number ||
                 (lrcsi_part_is_behind(&bands->orders, f, part, &unproved) && unproved == 0);
    }
    return behind;
}
