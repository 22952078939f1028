/* SPDX-License-Identifier: MIT */
/* One line of sight: which facets it meets, and which of them is nearest the laser. Exact: the
   line runs through a point of scaled scene coordinates along the direction. Where it meets an
   edge or a vertex, it counts as moved by an infinitesimal (eps, eps^2) along two fixed axes, so
   that a surface is met once on every line, never twice and never not at all. */
#ifndef LRCSI_SAMPLE_H
#define LRCSI_SAMPLE_H

#include "view/view.h"

/* Does the line through `point` meet the facet? Facing must not be 0. */
int lrcsi_sample_covers(const lrcsi_view *view, uint32_t facet, const double point[3]);

/* The same, the line counting as moved along the two axes where `sense` is 1, against them where it
   is -1. */
int lrcsi_sample_covers_towards(const lrcsi_view *view, uint32_t facet, const double point[3],
                                int sense);

/* Which side of the facet's plane a scene point lies on: 1 nearer the laser than the plane is
   there, -1 farther, 0 on it; exact. Facing must not be 0. */
int lrcsi_sample_above(const lrcsi_view *view, uint32_t facet, const double point[3]);

/* Does `winner` come first where both lie exactly in one plane? A front face beats a back face, a
   reflecting back a dead one, then the lower index. */
int lrcsi_sample_beats(const lrcsi_view *view, uint32_t winner, uint32_t loser);

/* Which of two facets is nearer wherever a line meets both, where that is so: 1 the first, -1 the
   second (they lie in one plane, or one lies on one side of the other's plane), else 0. Exact. */
int lrcsi_sample_order(const lrcsi_view *view, uint32_t first, uint32_t second);

/* Which of two facets that the line meets hides the other: 1 the first, -1 the second, 0
   undecided: nearer to each other there than double-double tells, each with corners on both sides
   of the other's plane, yet not touching. Where they pierce each other that near, a guess. The
   line counts as moved in the sense that lrcsi_sample_covers_towards takes. */
int lrcsi_sample_nearer(const lrcsi_view *view, uint32_t first, uint32_t second,
                        const double point[3], int sense);

#endif
