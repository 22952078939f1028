/* SPDX-License-Identifier: MIT */
/* Decides whether the depth order of a facet and another part is known, from planes between the two
   parts and from the plane of the facet; the proofs are kept for pairs of parts. What follows for
   the visibility of the true shapes is not decided here.

   In the terms of visibility/proximity/proximity_band.c, P is the facet's part and Q the other.

   1. A part behind another. If a plane that does not face away from the laser has P in front of it
   and Q behind it, true surfaces and facets of both, then Q hides neither x nor y
   (visibility/proximity/depth_order.h), and its facets and event edges need not be considered. If
   it has Q in front of it and P behind it, and Q has at most one opening, Q hides x if and only if
   the projection of x lies in that of B, and likewise for y and the facets: so (1) need not be
   considered. Where both parts touch the plane to within rounding, the fraction of the facet and of
   its patch that lies within rounding of it counts as gained and lost.

   2. A part in front of the plane of a flat facet. If Q has at most one opening, x and y lie in
   that plane, and whether Q and its facets hide them depends only on their outlines
   (visibility/proximity/outline.h): (1) need not be considered. */
#include "visibility/proximity/part_order.h"

#include "base/work.h"

/* A proof about a part (visibility/proximity/depth_order.h) is used for a facet only if it holds
   for all but this fraction of it. */
#define PROOF_FRACTION_MAX 0x1p-20
/* The number of pairs of parts whose proofs are kept. Facets are searched part by part, so few
   pairs are needed at a time. */
#define DEPTH_PAIRS 64u

/* What a plane between two parts proves; it is kept. */
static const lrcsi_depth_order *depth_order(lrcsi_part_orders *orders, uint32_t front,
                                            uint32_t back)
{
    lrcsi_part_pair *pair = &orders->pair[(front + 7 * back) % DEPTH_PAIRS]; /* any spread serves */
    if (pair->front != front || pair->back != back) {
        *pair = (lrcsi_part_pair){
            front, back,
            lrcsi_depth_order_make(&orders->body[front], &orders->body[back], orders->view->unit)};
    }
    return &pair->order;
}

/* Does a proof about a facet's part hold for the facet, except for the fraction *unproved? It does
   not if that is not small: then the facet lies in the plane. */
static int proof_holds(const lrcsi_part_orders *orders, uint32_t facet,
                       const lrcsi_order_proof *proof, double *unproved)
{
    double fraction = proof->known ? lrcsi_order_unproved(proof, orders->view->prepared, facet) : 1;
    *unproved = fraction > PROOF_FRACTION_MAX ? 0 : fraction;
    return fraction <= PROOF_FRACTION_MAX;
}

int lrcsi_part_is_behind(lrcsi_part_orders *orders, uint32_t facet, uint32_t part, double *unproved)
{
    uint32_t own = orders->view->prepared->scene->facet_part[facet];
    *unproved = 0;
    return orders->body &&
           proof_holds(orders, facet, &depth_order(orders, own, part)->front_is_free, unproved);
}

int lrcsi_part_is_separated_in_front(lrcsi_part_orders *orders, uint32_t facet, uint32_t part,
                                     double *unproved)
{
    uint32_t own = orders->view->prepared->scene->facet_part[facet];
    *unproved = 0;
    return orders->body &&
           proof_holds(orders, facet, &depth_order(orders, part, own)->back_by_outline, unproved);
}

int lrcsi_part_is_separated(lrcsi_part_orders *orders, uint32_t facet, uint32_t part,
                            double *unproved)
{
    return lrcsi_part_is_behind(orders, facet, part, unproved) ||
           lrcsi_part_is_separated_in_front(orders, facet, part, unproved);
}

int lrcsi_part_is_in_front(lrcsi_part_orders *orders, uint32_t facet, uint32_t part, double *err,
                           double *unproved)
{
    const lrcsi_view *view = orders->view;
    const lrcs_prepared *p = view->prepared;
    const lrcsi_outline *outline = &orders->outline[part];
    uint32_t own = p->scene->facet_part[facet];
    int is_flat = p->scene->facet_smooth[facet] == 0 || p->proximity.reach[own] == 0;
    *err = *unproved = 0;
    if (!outline->known) {
        return 0;
    }
    if (is_flat && view->facing[facet] > 0 &&
        lrcsi_outline_in_front(outline, view, facet, 0, err)) {
        return 1;
    }
    *err = 0;
    return lrcsi_part_is_separated_in_front(orders, facet, part, unproved);
}

size_t lrcsi_part_orders_need(const lrcs_prepared *p)
{
    size_t parts = p->scene->part_count;
    size_t need = lrcsi_work_bytes(parts, sizeof(lrcsi_outline));
    need = lrcsi_work_add(need, lrcsi_work_bytes(parts, sizeof(lrcsi_body)));
    return lrcsi_work_add(need, lrcsi_work_bytes(DEPTH_PAIRS, sizeof(lrcsi_part_pair)));
}

int lrcsi_part_orders_make(const lrcsi_view *view, lrcs_work *work, lrcsi_part_orders *orders)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t parts = p->scene->part_count;
    orders->view = view;
    orders->outline = lrcsi_work_take(work, parts, sizeof *orders->outline);
    orders->pair = lrcsi_work_take_zero(work, DEPTH_PAIRS, sizeof *orders->pair);
    orders->body = p->extent ? lrcsi_work_take(work, parts, sizeof *orders->body) : NULL;
    if (!orders->outline || !orders->pair || (p->extent && !orders->body)) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < parts; i++) {
        orders->outline[i] = lrcsi_outline_make(view, i);
        if (orders->body) {
            orders->body[i] = lrcsi_body_make(p, i);
        }
    }
    return LRCS_OK;
}
