/* SPDX-License-Identifier: MIT */
/* Which curved shapes nothing hides in a view, proved by planes that separate them from every
   other part. Their sigma then has a closed form, whatever else the scene contains. */
#ifndef LRCSI_CLEAR_H
#define LRCSI_CLEAR_H

#include "view/view.h"

typedef struct lrcsi_clear_shapes {
    unsigned char *part; /* part: 1 if no other part hides any of its true surface that faces the
                            laser, and no reflecting inside of it is visible; NULL: none */
    double *slab; /* part: an upper bound of the area of that surface that may be hidden after
                     all, scaled: not 0 if a separating plane touches the part to within
                     rounding */
    uint32_t count;
    int all; /* every part with live facets is clear */
} lrcsi_clear_shapes;

static inline int lrcsi_is_clear_shape(const lrcsi_clear_shapes *clear, uint32_t part)
{
    return clear->count > 0 && clear->part[part];
}

/* Bytes; 0 if no shape has a closed form. */
size_t lrcsi_clear_need(const lrcs_prepared *prepared);

/* Given: a view, with or without coordinates. Status: LRCS_OK; LRCS_E_MEMORY. What it
   finds stays in the work area. Work: O(parts * clear ones). */
int lrcsi_clear_make(const lrcsi_view *view, lrcs_work *work, lrcsi_clear_shapes *clear);

#endif
