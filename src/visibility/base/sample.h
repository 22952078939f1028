/* SPDX-License-Identifier: MIT */
/* One line of sight: which facets it meets, and which of two is nearer to the laser. The line
   passes through a point in scaled scene coordinates, along the direction; all decisions are exact.
   A line that meets an edge or a vertex is perturbed symbolically: it counts as moved by (eps,
   eps^2), eps infinitesimal, along two fixed axes. So it meets a surface without holes exactly
   once. */
#ifndef LRCSI_SAMPLE_H
#define LRCSI_SAMPLE_H

#include "view/view.h"

/* 1 if the line through `point` meets the facet, else 0. Its facing must not be 0. */
int lrcsi_sample_covers(const lrcsi_view *view, uint32_t facet, const double point[3]);

/* The same; the line counts as moved along the two axes if `sense` is 1, against them if it is -1.
 */
int lrcsi_sample_covers_towards(const lrcsi_view *view, uint32_t facet, const double point[3],
                                int sense);

/* On which side of the facet's plane a scene point lies: 1 if it is nearer to the laser than the
   plane, -1 if farther, 0 if on it. Exact. The facet's facing must not be 0. */
int lrcsi_sample_above(const lrcsi_view *view, uint32_t facet, const double point[3]);

/* 1 if `winner` counts as nearer than `loser`; both lie exactly in one plane. A front side counts
   as nearer than a back side, a back side that reflects as nearer than one that does not, and
   otherwise the facet with the lower index. */
int lrcsi_sample_has_precedence(const lrcsi_view *view, uint32_t winner, uint32_t loser);

/* Can the other facet of a contact hide a part of the facet? */
int lrcsi_sample_contact_hides(const lrcsi_view *view, uint32_t facet,
                               const lrcsi_intersection *contact);

/* 1 if the first facet is nearer on every line of sight that meets both, -1 if the second is,
   because one of them lies on one side of the other's plane; otherwise 0, also if they lie in one
   plane. Exact. */
int lrcsi_sample_side(const lrcsi_view *view, uint32_t first, uint32_t second);

/* The same; for two facets in one plane, lrcsi_sample_has_precedence decides. */
int lrcsi_sample_order(const lrcsi_view *view, uint32_t first, uint32_t second);

/* Given two facets whose interiors do not intersect: 1 if the first is nearer on all lines of sight
   that meet both, -1 if the second is; 0 if they do not overlap in the view, or lie in one plane.
   Exact. */
int lrcsi_sample_overlap_order(const lrcsi_view *view, uint32_t first, uint32_t second);

/* Which of two facets that the line meets is nearer: 1 the first, -1 the second. If they intersect
   so close to the line that double-double does not decide, the answer is a guess, or 0. The line
   counts as moved as in lrcsi_sample_covers_towards. */
int lrcsi_sample_nearer(const lrcsi_view *view, uint32_t first, uint32_t second,
                        const double point[3], int sense);

#endif
