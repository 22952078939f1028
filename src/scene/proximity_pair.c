/* SPDX-License-Identifier: MIT */
/* Cuts one facet by planes around the other. All results are rounded outward: every distance is
   increased by LRCSI_PROXIMITY_ERR. */
#include "scene/proximity_pair.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/vec3.h"
#include "scene/proximity.h"

/* Products of vectors whose square is less may underflow. */
#define LEAST_SQUARE 0x1p-900

/* Are all corners of `other` farther than `slack` from the plane of a facet, on one side of it? */
static int pair_apart_by_plane(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack)
{
    const lrcsi_normal *n = &p->normal[facet];
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    double limit = slack * n->length;
    int above = 0;
    int below = 0;
    for (int k = 0; k < 3; k++) {
        double from_a[3];
        lrcsi_vec3_between(a, lrcsi_prepared_corner(p, other, k), from_a);
        double height = lrcsi_vec3_dot(n->high, from_a);
        above += height > limit;
        below += height < -limit;
    }
    return above == 3 || below == 3;
}

/* The longest side of a facet, as a vector. */
static void pair_longest_side(const lrcs_prepared *p, uint32_t facet, double side[3])
{
    lrcsi_vec3_between(lrcsi_prepared_corner(p, facet, 0), lrcsi_prepared_corner(p, facet, 1),
                       side);
    double longest = lrcsi_vec3_dot(side, side);
    for (int k = 1; k < 3; k++) {
        double at[3];
        lrcsi_vec3_between(lrcsi_prepared_corner(p, facet, k),
                           lrcsi_prepared_corner(p, facet, (k + 1) % 3), at);
        const double square = lrcsi_vec3_dot(at, at);
        if (square > longest) {
            longest = square;
            memcpy(side, at, sizeof at);
        }
    }
}

/* Are two facets farther apart than `slack` along the direction perpendicular to the longest sides
   of both? Distances along it have errors of some 16 u, which LRCSI_PROXIMITY_ERR covers, as long
   as no product underflows. */
static int pair_apart_by_sides(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack)
{
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    double side[2][3];
    double direction[3];
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    pair_longest_side(p, facet, side[0]);
    pair_longest_side(p, other, side[1]);
    lrcsi_vec3_cross(side[0], side[1], direction);
    const double square = lrcsi_vec3_dot(direction, direction);
    const double limit = slack * sqrt(square);
    for (int k = 0; k < 6; k++) {
        double from_a[3];
        lrcsi_vec3_between(a, lrcsi_prepared_corner(p, k < 3 ? facet : other, k % 3), from_a);
        lrcsi_range_extend(lrcsi_vec3_dot(direction, from_a), &low[k / 3], &high[k / 3]);
    }
    return square > LEAST_SQUARE && (low[0] - high[1] > limit || low[1] - high[0] > limit);
}

/* Is it proved that no part of a facet is within `slack` of the other? The long, narrow facets of
   two flat faces that intersect have boxes that overlap, and neither plane separates them; but most
   pass each other at a distance. */
static int pair_is_apart(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack,
                         double along)
{
    return pair_apart_by_plane(p, facet, other, slack) ||
           pair_apart_by_plane(p, other, facet, along) ||
           pair_apart_by_sides(p, facet, other, slack);
}

/* The part between the two planes at that distance from the plane of `other`, and within the three
   planes at the slack outside its sides. */
lrcsi_slice lrcsi_proximity_slice(const lrcs_prepared *p, uint32_t facet, uint32_t other,
                                  double slack, double along)
{
    if (pair_is_apart(p, facet, other, slack, along)) {
        return (lrcsi_slice){.count = 0};
    }
    lrcsi_slice slice =
        lrcsi_slice_start(lrcsi_prepared_corner(p, facet, 0), lrcsi_prepared_corner(p, facet, 1),
                          lrcsi_prepared_corner(p, facet, 2));
    const double *origin = lrcsi_prepared_corner(p, other, 0);
    double n[3];
    lrcsi_prepared_unit_normal(p, other, n);
    lrcsi_slice_cut_between(&slice, n, origin, origin, along);
    for (int side = 0; side < 3 && slice.count > 0; side++) {
        const double *a = lrcsi_prepared_corner(p, other, side);
        const double *b = lrcsi_prepared_corner(p, other, (side + 1) % 3);
        double ab[3];
        double out[3];
        lrcsi_vec3_between(a, b, ab);
        lrcsi_vec3_cross(ab, n, out);
        lrcsi_slice_cut(&slice, out, a, slack * sqrt(lrcsi_vec3_dot(out, out)));
    }
    return slice;
}

lrcsi_sides_fraction lrcsi_proximity_slice_fractions(const lrcs_prepared *p, uint32_t facet,
                                                     const lrcsi_slice *slice, uint32_t other)
{
    const double *origin = lrcsi_prepared_corner(p, other, 0);
    const double whole = 0.5 * p->normal[facet].length;
    const double longest = lrcsi_proximity_longest(p, facet);
    lrcsi_slice front = *slice;
    lrcsi_slice back = *slice;
    double n[3];
    lrcsi_prepared_unit_normal(p, other, n);
    const double down[3] = {-n[0], -n[1], -n[2]};
    lrcsi_slice_cut(&front, down, origin, LRCSI_PROXIMITY_ERR);
    lrcsi_slice_cut(&back, n, origin, LRCSI_PROXIMITY_ERR);
    return (lrcsi_sides_fraction){lrcsi_slice_fraction(&front, whole, longest),
                                  lrcsi_slice_fraction(&back, whole, longest)};
}

lrcsi_sides_fraction lrcsi_proximity_fractions(const lrcs_prepared *p, uint32_t facet,
                                               uint32_t other, double slack)
{
    const lrcsi_slice slice = lrcsi_proximity_slice(p, facet, other, slack, slack);
    return lrcsi_proximity_slice_fractions(p, facet, &slice, other);
}

int lrcsi_proximity_side_is_far(const lrcs_prepared *p, uint32_t facet, int side, uint32_t other,
                                double distance)
{
    const double *a = lrcsi_prepared_corner(p, facet, side);
    const double *b = lrcsi_prepared_corner(p, facet, (side + 1) % 3);
    lrcsi_slice slice =
        lrcsi_slice_start(lrcsi_prepared_corner(p, other, 0), lrcsi_prepared_corner(p, other, 1),
                          lrcsi_prepared_corner(p, other, 2));
    double n[3][3]; /* normal to the facet; along the side; in the facet, perpendicular to it */
    lrcsi_prepared_unit_normal(p, facet, n[0]);
    lrcsi_vec3_between(a, b, n[1]);
    lrcsi_vec3_cross(n[0], n[1], n[2]);
    for (int i = 0; i < 3 && slice.count > 0; i++) {
        const double square = lrcsi_vec3_dot(n[i], n[i]);
        if (square > LEAST_SQUARE) {
            lrcsi_slice_cut_between(&slice, n[i], a, b, distance * sqrt(square));
        }
    }
    return slice.count == 0;
}
