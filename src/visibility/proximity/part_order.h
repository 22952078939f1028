/* SPDX-License-Identifier: MIT */
/* The depth order of a facet and another part in a view: is the whole part behind the facet, or all
   of it in front? Where it is known, how close the two are does not matter: what the part hides of
   the facet follows from the part's outline alone.

   Each answer may leave a fraction of the facet unproved, where rounding decides; it is at
   most 2^-20, and 0 for most facets. */
#ifndef LRCSI_PART_ORDER_H
#define LRCSI_PART_ORDER_H

#include "visibility/proximity/depth_order.h"
#include "visibility/proximity/outline.h"

/* A pair of parts, `back` perhaps behind `front`; front == back: none yet. */
typedef struct lrcsi_part_pair {
    uint32_t front, back;
    lrcsi_depth_order order;
} lrcsi_part_pair;

typedef struct lrcsi_part_orders {
    const lrcsi_view *view;
    lrcsi_outline *outline; /* part */
    lrcsi_body *body;       /* part; NULL: no shape has a closed form, and pairs are not tried */
    lrcsi_part_pair *pair;  /* what was found last of pairs, to save time: it changes no answer */
} lrcsi_part_orders;

/* Bytes for it. It stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
size_t lrcsi_part_orders_need(const lrcs_prepared *prepared);
int lrcsi_part_orders_make(const lrcsi_view *view, lrcs_work *work, lrcsi_part_orders *orders);

/* Is a part behind the facet's own part? Then the part hides nothing of the facet, except perhaps
   of the fraction *unproved of it. */
int lrcsi_part_is_behind(lrcsi_part_orders *orders, uint32_t facet, uint32_t part,
                         double *unproved);

/* Is a part with a known outline in front of a facet: because the facet is flat, and the part in
   front of its plane (*err: as for lrcsi_outline_in_front, otherwise 0); or because a plane
   separates it from the facet's own part, except for the fraction *unproved? */
int lrcsi_part_is_in_front(lrcsi_part_orders *orders, uint32_t facet, uint32_t part, double *err,
                           double *unproved);

/* Does a plane separate a part, in front, from the facet's own part, except for the fraction
   *unproved of the facet? */
int lrcsi_part_is_separated_in_front(lrcsi_part_orders *orders, uint32_t facet, uint32_t part,
                                     double *unproved);

/* Does a plane separate a part from the facet's own part, so that it is behind it or in front of
   it, except for the fraction *unproved? */
int lrcsi_part_is_separated(lrcsi_part_orders *orders, uint32_t facet, uint32_t part,
                            double *unproved);

#endif
