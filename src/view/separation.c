/* SPDX-License-Identifier: MIT */
/* Proofs that a part hides nothing of another. It does not decide which planes are tried.

   Claim. Let P and Q be two sets, d the direction to the laser, and n a vector with n . d >= 0. If
   n . x >= c on P and n . x <= c on Q, then Q hides nothing of P that has a projected area.
   Proof. A point q of Q that hides p in P is q = p + t d with t > 0. Then
       c >= n . q = n . p + t n . d >= c + t n . d,
   so that n . d = 0, and p lies in the plane n . x = c. That plane contains d, so what lies in it
   is edge-on, without projected area. []

   Rounding. Let the errors of the supports be e_P and e_Q, that of n . d 8 u, and all distances
   below LENGTH. Then the gap between P and Q along n must exceed
       e = e_P + e_Q + LENGTH max(0, 8 u - n . d).
   If the gap is zero up to e, only points of P within 2 e of its lowest end may be hidden.

   Facets. The mesh of a curved shape whose zones are level has its vertices at the heights of the
   true surface, at radii that are larger by vertex_ratio (mesh/shape/revolution.h): they lie in the
   true solid stretched by that ratio across the axis, whose support along n is that of the true
   solid along n stretched in the same way. If the zones are not level, every facet is within the
   Hausdorff distance of the true solid. */
#include "view/separation.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "optics/closed.h"

/* An upper bound of distances: coordinates are below 1, and true shapes not much larger than
   facets. */
#define LENGTH 5.0

/* The support of parts with fewer facets is computed from their corners, that of others from the
   box around them. */
#define CORNERS_MAX 32u

lrcsi_support lrcsi_body_solid(const lrcs_prepared *p, uint32_t index)
{
    const lrcs_part *part = &p->scene->part[index];
    double unit = ldexp(part->unit, -p->exponent);
    return (lrcsi_support){part->kind, unit * part->shape.radius, unit * part->shape.radius2,
                           unit * lrcsi_closed_length(&part->shape)};
}

/* The error of a support: 64 u covers about 30 operations on magnitudes below the sum of the
   dimensions; 4 u more cover the length of a cone from its half-angle. */
lrcsi_body lrcsi_body_make(const lrcs_prepared *p, uint32_t index)
{
    const lrcs_part *part = &p->scene->part[index];
    lrcsi_body body = {.prepared = p,
                       .part = part,
                       .extent = &p->extent[index],
                       .curved = p->extent[index].closed_form,
                       .vertex_ratio = 1,
                       .err = 64 * LRCSI_U};
    for (int k = 0; k < 3; k++) {
        body.centre[k] = 0.5 * body.extent->low[k] + 0.5 * body.extent->high[k];
    }
    if (body.curved) {
        lrcsi_revolution shape = lrcsi_revolution_make(&part->shape, &part->divisions);
        double size = 0;
        body.solid = lrcsi_body_solid(p, index);
        body.vertex_ratio = shape.vertex_ratio;
        body.beyond = shape.step > 0 && !shape.level_zones
                          ? ldexp(part->bounds.hausdorff, -p->exponent) * LRCSI_OUTWARD(8)
                          : 0;
        for (int k = 0; k < 3; k++) {
            body.origin[k] = ldexp(part->origin[k], -p->exponent);
            size += fabs(body.origin[k]);
        }
        size += body.vertex_ratio * (body.solid.radius + body.solid.radius2) + body.solid.length;
        body.err = 64 * LRCSI_U * size + ldexp(part->bounds.position_err, -p->exponent);
    }
    return body;
}

/* The support of the closed form, stretched across its axis. */
static double support_curved(const lrcsi_body *body, const double n[3], double ratio)
{
    double along[3];
    double point[3];
    for (int k = 0; k < 3; k++) {
        along[k] = (k < 2 ? ratio : 1) * lrcsi_vec3_dot(body->part->axis[k], n);
    }
    lrcsi_support_point(&body->solid, along, point);
    return lrcsi_vec3_dot(body->origin, n) + lrcsi_vec3_dot(point, along);
}

/* That of the facets, or of the box around them and the true shape. */
static double support_facets(const lrcsi_body *body, const double n[3])
{
    const lrcs_prepared *p = body->prepared;
    const lrcs_part *part = body->part;
    double highest = -HUGE_VAL;
    if (part->bounds.reach > 0 || part->facet_count > CORNERS_MAX) {
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

double lrcsi_body_support(const lrcsi_body *body, const double n[3])
{
    return body->curved ? support_curved(body, n, 1) : support_facets(body, n);
}

double lrcsi_body_support_all(const lrcsi_body *body, const double n[3])
{
    if (!body->curved) {
        return support_facets(body, n);
    }
    return lrcsi_max(support_curved(body, n, 1),
                     support_curved(body, n, body->vertex_ratio) + body->beyond);
}

/* The wall between two heights is at most `height` times the largest 2 pi r sqrt(1 + r'^2), r the
   radius and r' its derivative along the axis, where sqrt(1 + r'^2) <= 1 + |r'|. On a sphere or
   dome r sqrt(1 + r'^2) is the radius; on a cone or frustum r' is constant; on a paraboloid of
   radius R and length H, r r' = R^2 / (2 H). The factor 1.001 exceeds all rounding. */
double lrcsi_body_slab(const lrcsi_body *body, double height)
{
    double radius = lrcsi_max(body->solid.radius, body->solid.radius2);
    double slant = 1;
    if (body->part->kind == LRCS_SHAPE_CONE || body->part->kind == LRCS_SHAPE_FRUSTUM) {
        double rise =
            (body->part->kind == LRCS_SHAPE_CONE ? 0 : body->solid.radius2) - body->solid.radius;
        slant += fabs(rise) / body->solid.length;
    } else if (body->part->kind == LRCS_SHAPE_PARABOLOID) {
        slant += 0.5 * radius / body->solid.length;
    }
    return 1.001 * (2 * LRCS_PI) * radius * slant * height + 32 * LRCSI_U * radius * radius;
}

lrcsi_gap lrcsi_gap_make(const lrcsi_body *P, const lrcsi_body *Q, const double d[3],
                         const double n[3], int facets)
{
    const double down[3] = {-n[0], -n[1], -n[2]};
    double error = P->err + Q->err + LENGTH * lrcsi_max(0, 8 * LRCSI_U - lrcsi_vec3_dot(n, d));
    double low = facets ? -lrcsi_body_support_all(P, down) : -lrcsi_body_support(P, down);
    double gap = low - (facets ? lrcsi_body_support_all(Q, n) : lrcsi_body_support(Q, n));
    return (lrcsi_gap){gap > error, gap >= -error && gap <= error, low, 2 * error};
}
