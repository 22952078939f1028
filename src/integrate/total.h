/* SPDX-License-Identifier: MIT */
/* Eq. 2 summed: from visible areas to sigma, its parts, and what each cause adds to its bound. */
#ifndef LRCSI_TOTAL_H
#define LRCSI_TOTAL_H

#include "visibility/margin.h"
#include "visibility/visible.h"

/* All in square metres. */
typedef struct lrcsi_total {
    double glint, diffuse;
    double visibility, tessellation, rounding; /* bounds; tessellation negative: not known */
    double likely;                             /* likely error of the sampled areas */
    double projected, back_side;
    uint32_t back_sides, hidden, partial;
} lrcsi_total;

/* Given: the view, and the visible area of each of its facets; whether every front facet is known
   to be wholly visible, on the true shapes as on their meshes; where not, the margin of doubt about
   the true shapes (NULL: none was made, areas being bounded by all that could be hidden).
   Returned: total, summed in facet order; records[facet_count] unless NULL. */
lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_visible *visible, int unshadowed,
                             const lrcsi_margin *margin, lrcs_facet_record *records);

#endif
