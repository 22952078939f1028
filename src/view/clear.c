/* SPDX-License-Identifier: MIT */
/* Proofs that nothing hides a curved shape in a view, or no proof. It does not decide what a shape
   then reflects.

   Claim. Let the true surface P of a part lie on the boundary of a convex body, d the direction to
   the laser, and n a vector with n . d >= 0. If n . x >= c on P and n . x <= c on another part Q,
   then Q hides no part of P that has a projected area.
   Proof. A point q of Q that hides p in P is q = p + t d with t > 0. Then
       c >= n . q = n . p + t n . d >= c + t n . d,
   so that n . d = 0, and p lies in the plane n . x = c. That plane contains d, so the part of P in
   it is edge-on, without projected area. [] P hides none of its own front, because it lies on a
   convex body. So P is clear if there is such a plane for each other part. A plane that contains d
   separates the silhouettes; n = d means that Q is behind P; planes in between separate parts that
   stand on one another.

   Rounding. Let the errors of the supports (the largest n . x over a body) be e_P and e_Q, that of
   n . d 8 u, and all distances below LENGTH. Then the gap between P and Q along n must exceed e_P +
   e_Q + LENGTH max(0, 8 u - n . d). If the gap is zero up to that error, P may be hidden within a
   slab at its lowest end whose height is twice the error. The area of P's lit surface in it,
   `slab`, is known if n is P's own axis (rings of the wall; the end there is a plane with the
   normal -n, which faces away from the laser or is within 16 u of edge-on) or if P is a sphere (a
   zone, for every n). */
#include "view/clear.h"

#include <math.h>

#include "base/constant.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/support.h"
#include "optics/closed.h"

/* With a larger slope s the slab is not known: slab_surface. */
#define GLINT_SLOPE_MAX 0x1p20
/* An upper bound of distances: coordinates are below 1, and true shapes not much larger than
 * facets. */
#define LENGTH 5.0

/* The support of parts with fewer facets is computed from their corners, that of others from the
   box around them. */
#define CORNERS_MAX 32u

/* A part as a convex body, of which supports are computed. */
typedef struct clear_body {
    const lrcs_prepared *prepared;
    const lrcs_part *part;
    const lrcsi_extent *extent;
    int curved; /* 1: support of the closed form with these scaled dimensions; 0: of the facets
                   or of the box around the part */
    lrcsi_support solid;
    double origin[3];
    double centre[3]; /* of its box */
    double err;       /* bound on the error of a support along a unit vector */
} clear_body;

/* The error of a support: 64 u covers about 30 operations on magnitudes below the sum of the
   dimensions; 4 u more cover the length of a cone from its half-angle. */
static clear_body body_make(const lrcs_prepared *p, uint32_t index)
{
    const lrcs_part *part = &p->scene->part[index];
    clear_body body = {
        .prepared = p, .part = part, .extent = &p->extent[index], .err = 64 * LRCSI_U};
    body.curved = body.extent->closed_form;
    for (int k = 0; k < 3; k++) {
        body.centre[k] = 0.5 * body.extent->low[k] + 0.5 * body.extent->high[k];
    }
    if (body.curved) {
        double size = 0;
        double unit = ldexp(part->unit, -p->exponent);
        body.solid =
            (lrcsi_support){part->kind, unit * part->shape.radius, unit * part->shape.radius2,
                            unit * lrcsi_closed_length(&part->shape)};
        for (int k = 0; k < 3; k++) {
            body.origin[k] = ldexp(part->origin[k], -p->exponent);
            size += fabs(body.origin[k]);
        }
        size += body.solid.radius + body.solid.radius2 + body.solid.length;
        body.err = 64 * LRCSI_U * size + ldexp(part->misplaced, -p->exponent);
    }
    return body;
}

/* The largest n . x over the true shape. */
static double support_curved(const clear_body *body, const double n[3])
{
    double along[3];
    double point[3];
    for (int k = 0; k < 3; k++) {
        along[k] = lrcsi_vec3_dot(body->part->axis[k], n);
    }
    lrcsi_support_point(&body->solid, along, point);
    return lrcsi_vec3_dot(body->origin, n) + lrcsi_vec3_dot(point, along);
}

/* The same over the facets, or over the box around them and the true shape. */
static double support_facets(const clear_body *body, const double n[3])
{
    const lrcs_prepared *p = body->prepared;
    const lrcs_part *part = body->part;
    double highest = -HUGE_VAL;
    if (part->reach > 0 || part->facet_count > CORNERS_MAX) {
        highest = 0;
        for (int k = 0; k < 3; k++) {
            highest += n[k] * (n[k] > 0 ? body->extent->high[k] : body->extent->low[k]);
        }
        return highest;
    }
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        for (int k = 0; k < 3 && !p->skip[f]; k++) {
            highest = lrcsi_max(highest, lrcsi_vec3_dot(lrcsi_prepared_corner(p, f, k), n));
        }
    }
    return highest;
}

static double support(const clear_body *body, const double n[3])
{
    return body->curved ? support_curved(body, n) : support_facets(body, n);
}

/* An upper bound of the lit surface within `height` of an end of a shape along its axis, or of a
   sphere in any direction: rings of the wall, each at most as long as the longest; and an area that
   covers the end itself, where F is below B (20 u)^2 if s is at most GLINT_SLOPE_MAX. */
static double slab_surface(const clear_body *body, double height)
{
    const double two_pi = 6.2832; /* rounded up */
    double radius = lrcsi_max(body->solid.radius, body->solid.radius2);
    double slant = 1;
    if (body->part->kind == LRCS_SHAPE_CONE || body->part->kind == LRCS_SHAPE_FRUSTUM) {
        double rise =
            (body->part->kind == LRCS_SHAPE_CONE ? 0 : body->solid.radius2) - body->solid.radius;
        slant += fabs(rise) / body->solid.length;
    } else if (body->part->kind == LRCS_SHAPE_PARABOLOID) {
        slant += 0.5 * radius / body->solid.length;
    }
    return 1.001 * two_pi * radius * slant * height + 32 * LRCSI_U * radius * radius;
}

/* Does a plane across n, a unit vector to 8 u, separate a pair? If so, *slab is the area that may
   nevertheless be hidden. has_slab: the area of slabs of P across n is known. */
static int is_separating(const clear_body *P, const clear_body *Q, const double d[3],
                         const double n[3], int has_slab, double *slab)
{
    double error = P->err + Q->err + LENGTH * lrcsi_max(0, 8 * LRCSI_U - lrcsi_vec3_dot(n, d));
    const double down[3] = {-n[0], -n[1], -n[2]};
    double gap = -support(P, down) - support(Q, n);
    if (gap > error) {
        *slab = 0;
        return 1;
    }
    *slab = slab_surface(P, 2 * error);
    return has_slab && gap >= -error && support(P, n) + support(P, down) > 8 * error;
}

/* Tries planes across n and -n, unless these face away from the laser; n need not have length 1. */
static int is_separated_along(const clear_body *P, const clear_body *Q, const double d[3],
                              const double n[3], int has_slab, double *slab)
{
    double length = sqrt(lrcsi_vec3_dot(n, n));
    if (!(length > 0x1p-30)) {
        return 0;
    }
    const double up[3] = {n[0] / length, n[1] / length, n[2] / length};
    const double down[3] = {-up[0], -up[1], -up[2]};
    double cosine = lrcsi_vec3_dot(up, d);
    return (cosine >= -8 * LRCSI_U && is_separating(P, Q, d, up, has_slab, slab)) ||
           (cosine <= 8 * LRCSI_U && is_separating(P, Q, d, down, has_slab, slab));
}

/* Tries these directions: P's axis; that to the laser; from centre to centre, and its projection
   into the view plane; the axes of Q; and, for long bodies and boxes, the directions in the view
   plane across each of these axes. */
static int is_separated(const clear_body *P, const clear_body *Q, const double d[3], double *slab)
{
    static const double body_axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const lrcs_brdf *brdf = &lrcsi_prepared_material(P->prepared, P->part->first_facet)->brdf;
    int has_slab = brdf->A == 0 || brdf->s <= GLINT_SLOPE_MAX;
    int sphere_slab = has_slab && P->part->kind == LRCS_SHAPE_SPHERE;
    double between[3];
    double flat[3];
    double across[3];
    for (int k = 0; k < 3; k++) {
        between[k] = P->centre[k] - Q->centre[k];
    }
    double along = lrcsi_vec3_dot(between, d);
    for (int k = 0; k < 3; k++) {
        flat[k] = between[k] - along * d[k];
    }
    lrcsi_vec3_cross(P->part->axis[2], d, across);
    if (is_separated_along(P, Q, d, flat, sphere_slab, slab) ||
        is_separated_along(P, Q, d, P->part->axis[2], has_slab, slab) ||
        is_separated_along(P, Q, d, d, sphere_slab, slab) ||
        is_separated_along(P, Q, d, between, sphere_slab, slab) ||
        is_separated_along(P, Q, d, across, sphere_slab, slab)) {
        return 1;
    }
    const double(*axis)[3] = Q->part->rigid ? (const double(*)[3])Q->part->axis : body_axis;
    for (int k = Q->curved ? 2 : 0; k < 3; k++) {
        lrcsi_vec3_cross(axis[k], d, across);
        if (is_separated_along(P, Q, d, axis[k], sphere_slab, slab) ||
            is_separated_along(P, Q, d, across, sphere_slab, slab)) {
            return 1;
        }
    }
    return 0;
}

/* The inside of an open shape with a two-sided material is lit through its opening, and has no
   closed form here: shapes with one opening, at z = 0, show none of it from above. */
static int shows_no_inside(const lrcsi_view *view, const lrcs_part *part)
{
    const lrcs_material *material = lrcsi_prepared_material(view->prepared, part->first_facet);
    int one = part->kind != LRCS_SHAPE_CYLINDER && part->kind != LRCS_SHAPE_FRUSTUM;
    return part->solid || !material->two_sided || !view->backs.reflect ||
           (one && lrcsi_vec3_dot(part->axis[2], view->unit) > 16 * LRCSI_U);
}

size_t lrcsi_clear_need(const lrcs_prepared *p)
{
    size_t parts = p->extent ? p->scene->part_count : 0;
    return lrcsi_work_add(lrcsi_work_bytes(parts, 1),
                          lrcsi_work_add(lrcsi_work_bytes(parts, sizeof(double)),
                                         lrcsi_work_bytes(parts, sizeof(clear_body))));
}

int lrcsi_clear_make(const lrcsi_view *view, lrcs_work *work, lrcsi_clear *clear)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t parts = p->scene->part_count;
    *clear = (lrcsi_clear){NULL, NULL, 0, 0};
    if (!p->extent) {
        return LRCS_OK;
    }
    clear->part = lrcsi_work_take_zero(work, parts, 1);
    clear->slab = lrcsi_work_take_zero(work, parts, sizeof *clear->slab);
    size_t mark = work->used;
    clear_body *body = lrcsi_work_take(work, parts, sizeof *body);
    if (!clear->part || !clear->slab || !body) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < parts; i++) {
        body[i] = body_make(p, i);
    }
    clear->all = 1;
    for (uint32_t i = 0; i < parts; i++) {
        int is_clear = body[i].curved && shows_no_inside(view, body[i].part);
        for (uint32_t j = 0; j < parts && is_clear; j++) {
            double slab = 0;
            int live = p->extent[j].low[0] <= p->extent[j].high[0];
            is_clear = j == i || !live || is_separated(&body[i], &body[j], view->unit, &slab);
            clear->slab[i] += slab;
        }
        clear->part[i] = (unsigned char)is_clear;
        clear->count += (uint32_t)is_clear;
        clear->all &= is_clear || !(p->extent[i].low[0] <= p->extent[i].high[0]);
    }
    work->used = mark;
    return LRCS_OK;
}
