/* SPDX-License-Identifier: MIT */
/* Decides whether a part has an outline, and what of its solid is in front of a plane. The area
   along an edge is found in visibility/proximity/outline_area.c.

   Q, B, S^, k, K, K' and delta are those of outline.h. A line along the direction to the laser that
   meets B or S^ also meets the true surface or the facets: it cannot both enter and leave through
   the same opening. The boundary of K' consists of contour edges of Q, because only there the
   number of facets of S^ that face the laser above a point can fall to 0; and of rim edges, except
   where the opening faces the laser as the wall beside it does, or both face away.

   1. In front of a plane. Let P be a plane, and B and S^ in front of it: no point of them is behind
   it by more than e, and some point of B is in front of it by h. Then Q hides a point x of P if its
   projection lies in K, unless it is within e diameter(B) / h of the outside of K; and x only then.
   The same holds for the facets and K'. Proof: let B+ be the part of B in front of P. What lies on
   the ray of x lies in front of P, so Q hides x if and only if x lies in the projection of B+. The
   straight line from a point of B behind P to the point that is h in front of P meets P after at
   most e / (e + h) of its length. []

   For a closed Q of which a part is behind P as well, the same holds for the projections K of B+
   and K' of S+, the part of S^ in front of P, up to the errors e of heights: the ray of a point of
   P in B leaves B through its surface. Let some point of B and one of S^ be in front by at least h.
   A point of S+ is within k_Q of one of B, which is at most k_Q behind P. So B+ contains a point no
   farther than k = k_Q (1 + size / h) from it; likewise for points of B+. What
   outline_area.c proves holds for B+ and S+ in the place of B and S^. */
#include "visibility/proximity/outline.h"

#include <math.h>
#include <string.h>

#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "scene/proximity.h"
#include "view/separation.h"

/* A solid is cut by a plane only if it reaches so far in front of it, as a fraction of its size. */
#define CUT_HEIGHT_MIN 0x1p-4
/* Cosines larger than this have the sign that they seem to have: axes and directions are accurate
   to some 30 u. */
#define OPENING_COS_MIN 1e-6

lrcsi_outline lrcsi_outline_make(const lrcsi_view *view, uint32_t index)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    lrcsi_outline o = {.part = part};
    if (!part->rigid || !(part->bounds.reach > 0) || part->kind == LRCS_SHAPE_DISC ||
        lrcsi_proximity_openings(p, index) > 1) {
        return o;
    }
    lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    if (body.step > 0 && !body.level_zones) {
        return o; /* its vertices are not at the true heights */
    }
    double far = 0;
    o.known = 1;
    o.vertex_ratio = body.vertex_ratio;
    o.solid = lrcsi_body_solid(p, index);
    for (int k = 0; k < 3; k++) {
        o.origin[k] = ldexp(part->origin[k], -p->exponent);
        far += fabs(o.origin[k] - p->origin[k]) + fabs(o.origin[k]);
    }
    double x[3];
    lrcsi_view_coordinates(view, o.origin, x);
    for (int i = 0; i < 2; i++) {
        o.centre[i] = x[i];
        for (int k = 0; k < 3; k++) {
            o.axis[k][i] = lrcsi_vec3_dot(view->R[i], part->axis[k]);
        }
    }
    o.size = 2 * o.vertex_ratio * lrcsi_max(o.solid.radius, o.solid.radius2) + o.solid.length;
    o.k = p->proximity.hausdorff[index];
    o.err = 64 * LRCSI_U * (far + o.size) + ldexp(part->bounds.position_err, -p->exponent);
    return o;
}

lrcsi_outline lrcsi_outline_make_exact(const lrcsi_view *view, uint32_t index, double k)
{
    const lrcs_part *part = &view->prepared->scene->part[index];
    const int exact = lrcsi_shape_is_plane_faced(part->kind);
    return (lrcsi_outline){.part = part, .known = exact, .is_exact = exact, .k = k};
}

/* The unit normal of a facet's plane, on its front. The narrow facets of a disc are turned by
   rounding far more than the disc: its normal is along the part's axis. Returns the error of the
   normal, for the true surface that the facet stands for. */
static double plane_normal(const lrcs_prepared *p, uint32_t facet, double n[3])
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    lrcsi_prepared_unit_normal(p, facet, n);
    if (!(part->bounds.reach > 0 && part->rigid && p->scene->facet_smooth[facet] == 0)) {
        return part->bounds.normal_err;
    }
    const double side = lrcsi_vec3_dot(part->axis[2], n) < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        n[k] = side * part->axis[2][k];
    }
    return 0;
}

/* The plane of a flat facet beside a solid, in the frame of the solid's part: up . x = level, with
   an error e of heights above it. Heights: that of the solid's highest point, and the depth of the
   lowest one of the true solid and that of the facets. */
typedef struct outline_plane {
    double up[3], level, e;
    double height, behind;
} outline_plane;

/* The vertices of a solid of facets are those of the true one, stretched across the axis by
   vertex_ratio: so is its support. If the facet belongs to a curved part, the plane of its true
   surface differs from its own by the rounding of its corners. */
static outline_plane outline_plane_make(const lrcsi_outline *o, const lrcsi_view *view,
                                        uint32_t facet, double plane_err)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *own = &p->scene->part[p->scene->facet_part[facet]];
    double n[3];
    double from[3];
    double down[3];
    double lowest[3];
    double highest[3];
    outline_plane plane;
    const double normal_err = plane_normal(p, facet, n);
    lrcsi_vec3_between(o->origin, lrcsi_prepared_corner(p, facet, 0), from);
    for (int k = 0; k < 3; k++) {
        plane.up[k] = lrcsi_vec3_dot(o->part->axis[k], n);
        down[k] = -plane.up[k];
    }
    plane.level = lrcsi_vec3_dot(from, n);
    const double far = fabs(from[0]) + fabs(from[1]) + fabs(from[2]) + o->size;
    plane.e = 2 * o->err + 64 * LRCSI_U * far + plane_err;
    if (own->bounds.reach > 0) {
        plane.e += normal_err * far + 2 * ldexp(own->bounds.position_err, -p->exponent);
    }
    lrcsi_support_point(&o->solid, plane.up, highest);
    lrcsi_support_point(&o->solid, down, lowest);
    plane.behind = lrcsi_vec3_dot(lowest, down);
    const double wider[3] = {o->vertex_ratio * down[0], o->vertex_ratio * down[1], down[2]};
    lrcsi_support_point(&o->solid, wider, lowest);
    plane.behind = lrcsi_max(plane.behind, lrcsi_vec3_dot(lowest, wider)) + plane.level;
    plane.height = lrcsi_vec3_dot(highest, plane.up) - plane.level - plane.e;
    return plane;
}

/* Both the true solid and that of the facets leave open a distance of e size / height; the first of
   the two changes x, the second y and the depth of y. */
static double plane_open(const lrcsi_outline *o, const outline_plane *plane)
{
    return plane->height > 0 ? 4 * plane->e * (1 + o->size / plane->height) : HUGE_VAL;
}

int lrcsi_outline_in_front(const lrcsi_outline *o, const lrcsi_view *view, uint32_t facet,
                           double plane_err, double *err)
{
    const outline_plane plane = outline_plane_make(o, view, facet, plane_err);
    *err = plane_open(o, &plane);
    return view->facing[facet] > 0 && plane.behind <= plane.e && *err <= 0.5 * o->k;
}

int lrcsi_outline_cut(const lrcsi_outline *o, const lrcsi_view *view, uint32_t facet,
                      double plane_err, lrcsi_outline *cut, double *err)
{
    outline_plane plane = outline_plane_make(o, view, facet, plane_err);
    plane.height -= o->k; /* of the solid of the facets as well */
    *err = plane_open(o, &plane);
    *cut = *o;
    cut->is_cut = 1;
    cut->level = plane.level;
    memcpy(cut->up, plane.up, sizeof cut->up);
    cut->k *=
        (1 + o->size / lrcsi_max(plane.height, CUT_HEIGHT_MIN * o->size)) * LRCSI_OUTWARD_NANO;
    return o->part->solid && view->facing[facet] > 0 && plane.height > CUT_HEIGHT_MIN * o->size &&
           *err <= 0.5 * o->k;
}

/* The opening is at z = 0, its normal along -z. */
int lrcsi_outline_inside(const lrcsi_outline *o, const lrcsi_view *view, int facing)
{
    double cosine = -lrcsi_vec3_dot(o->part->axis[2], view->unit);
    return (facing > 0 && cosine > OPENING_COS_MIN) || (facing < 0 && cosine < -OPENING_COS_MIN);
}
