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

/* Is every open curved part in front of a part, or of the plane of a facet of it, or behind the
   part, for all of the facet? */
static int open_parts_are_ordered(lrcsi_event_bands *bands, uint32_t facet)
{
    const lrcs_prepared *p = bands->view->prepared;
    int ordered = lrcsi_meter_take(bands->meter, p->scene->part_count);
    for (uint32_t i = 0; i < p->scene->part_count && ordered; i++) {
        double err;
        double unproved = 0;
        ordered = i == p->scene->facet_part[facet] || !(p->proximity.hausdorff[i] > 0) ||
                  lrcsi_proximity_openings(p, i) == 0 ||
                  ((lrcsi_part_is_in_front(&bands->orders, facet, i, &err, &unproved) ||
                    lrcsi_part_is_behind(&bands->orders, facet, i, &unproved)) &&
                   unproved == 0);
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
            if (p->skip[f] || p->redundant[f] >= LRCSI_REDUNDANT_FROM_BEHIND ||
                !open_parts_are_ordered(bands, f)) {
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
    face->det = face->axis[0][0] * face->axis[1][1] - face->axis[0][1] * face->axis[1][0];
    return fabs(face->det) > FACE_COS_MIN;
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
