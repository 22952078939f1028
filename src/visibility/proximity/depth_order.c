/* SPDX-License-Identifier: MIT */
/* Tries a few planes for each pair of parts; view/separation.c proves what they decide. It does not
   look for parts that are far from one another in projection.

   Let the part in front have n . x >= c and the part behind n . x <= c, with n . d >= 0. If a point
   q of the former and a point p of the latter lie on one line along d, q = p + t d, then
   t n . d >= 0: q is nearer the laser than p, or both lie in a plane that contains d. So p is
   hidden if and only if some q has the same projection.

   Where both touch the plane, this is proved except for points within rounding of it: those of the
   part in front that may be hidden, and those of the part behind that a point may seem to hide
   although it is behind them (the same proof, with the roles exchanged). On a part without curved
   surfaces a facet is the true surface. On a curved part such a plane is used only across its own
   axis, and if its zones are level: then a facet and its patch extend over the same heights, and
   the area of the true surface in a slab is known (lrcsi_body_slab). It is the same in all sectors.
   */
#include "visibility/proximity/depth_order.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"

/* The axes of a part across which a plane may be tangent to it: one of a body of revolution, three
   of a box or a plate. */
static int axes_count(const lrcsi_body *body)
{
    return !body->part->rigid ? 0 : body->curved ? 1 : 3;
}

/* Is the area of a part's surface in a slab known, across its own axis or another direction? */
static int has_slab(const lrcsi_body *body, int is_own)
{
    return body->part->bounds.reach == 0 || (body->curved && is_own && body->beyond == 0);
}

static lrcsi_order_proof proof_make(const lrcsi_body *body, double sign, const double n[3],
                                    double level, double height)
{
    const double sectors = body->part->divisions.around;
    return (lrcsi_order_proof){
        1,
        {sign * n[0], sign * n[1], sign * n[2]},
        level,
        body->curved ? lrcsi_body_slab(body, height) / sectors * LRCSI_OUTWARD(4) : 0};
}

/* Tries the plane across one axis of `own`, or with own NULL across any unit vector, on one of its
   sides, which does not face away from the laser. */
static void side_try(const lrcsi_body *front, const lrcsi_body *back, const double d[3],
                     const lrcsi_body *own, const double n[3], lrcsi_depth_order *order)
{
    lrcsi_gap gap = lrcsi_gap_make(front, back, d, n, 1);
    if (gap.separates) {
        order->front_is_free = order->back_by_outline = proof_make(front, 1, n, -HUGE_VAL, 0);
    }
    if (gap.is_zero && has_slab(front, own == front)) {
        order->front_is_free = proof_make(front, 1, n, gap.low + gap.height, gap.height);
    }
    if (gap.is_zero && has_slab(back, own == back)) {
        double high = lrcsi_body_support_all(back, n);
        order->back_by_outline = proof_make(back, -1, n, gap.height - high, gap.height);
    }
}

/* Tries the side of such a plane that faces the laser; both if the plane contains d, to within
   rounding. */
static void order_try(const lrcsi_body *front, const lrcsi_body *back, const double d[3],
                      const lrcsi_body *own, const double axis[3], lrcsi_depth_order *order)
{
    const double opposite[3] = {-axis[0], -axis[1], -axis[2]};
    const double cosine = lrcsi_vec3_dot(axis, d);
    if (cosine >= -8 * LRCSI_U) {
        side_try(front, back, d, own, axis, order);
    }
    if (cosine <= 8 * LRCSI_U) {
        side_try(front, back, d, own, opposite, order);
    }
}

/* A unit vector along number k of these directions: from centre to centre; the component of that
   perpendicular to the axis of either part; to the laser. Returns 0 if it has no length. */
static int order_normal(const lrcsi_body *front, const lrcsi_body *back, const double d[3], int k,
                        double n[3])
{
    const lrcsi_body *const own[4] = {NULL, front, back, NULL};
    for (int i = 0; i < 3; i++) {
        n[i] = k == 3 ? d[i] : front->centre[i] - back->centre[i];
    }
    if (own[k]) {
        const double *axis = own[k]->part->axis[2];
        const double along = lrcsi_vec3_dot(n, axis);
        for (int i = 0; i < 3; i++) {
            n[i] -= along * axis[i];
        }
    }
    if (!(lrcsi_length(n) > LRCSI_GAP_NORMAL_MIN)) {
        return 0;
    }
    (void)lrcsi_length_normalise(n);
    return 1;
}

lrcsi_depth_order lrcsi_depth_order_make(const lrcsi_body *front, const lrcsi_body *back,
                                         const double d[3])
{
    const lrcsi_body *const own[2] = {front, back};
    lrcsi_depth_order order = {{.known = 0}, {.known = 0}};
    for (int i = 0; i < 2; i++) {
        for (int k = 0;
             k < axes_count(own[i]) && !(order.front_is_free.known && order.back_by_outline.known);
             k++) {
            order_try(front, back, d, own[i], own[i]->part->axis[2 - k], &order);
        }
    }
    for (int k = 0; k < 4 && !(order.front_is_free.known && order.back_by_outline.known); k++) {
        double n[3];
        if (order_normal(front, back, d, k, n)) {
            order_try(front, back, d, NULL, n, &order);
        }
    }
    return order;
}

/* The heights n . x of a facet's points are linear: at most the fraction 2 (level - low) / (high -
   low) of its area is below the level. */
double lrcsi_order_unproved(const lrcsi_order_proof *proof, const lrcs_prepared *p, uint32_t facet)
{
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double height = lrcsi_vec3_dot(proof->n, lrcsi_prepared_corner(p, facet, k));
        low = lrcsi_min(low, height);
        high = lrcsi_max(high, height);
    }
    double below = proof->level + 16 * LRCSI_U - low;
    if (!(below > 0)) {
        return 0;
    }
    double area = 0.5 * p->normal[facet].length;
    double fraction = 2 * (below + 16 * LRCSI_U) / (high - low) + proof->slab / area;
    return fraction < 1 ? fraction * LRCSI_OUTWARD(16) : 1;
}
