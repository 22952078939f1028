/* SPDX-License-Identifier: MIT */
/* A facet's frame of the view plane: how its corners and those of others come into it, and how
   points of it go back to the facet. It knows nothing of what hides what. */
#include "visibility/target.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/length.h"
#include "base/range.h"
#include "view/product.h"

/* What is so many times as far off as what is near is far away. */
#define FAR_OFF 8.0

/* A scene point far behind or before the origin. The rows of R are off by 4 u, and so is what they
   make of a depth. Taken instead are their parts across the direction d, r - (r . d) d / d^2: in
   the plane as near to the exact axes, and exactly across d. Products with the exact difference p
   are off by 16 u^2 |p|, the slope r . d, below 4 u |d|, by 21 u^2 |d|, and its product with the
   depth by 24 u^2 |p| more: all below 80 u^2 |p|. */
static double frame_point_deep(const lrcsi_view *view, const double *origin, const double *x,
                               double out[2])
{
    static const double exact[3]; /* R is: it has no low part */
    const double *d = view->direction;
    lrcsi_dd p[3];
    double depth = 0;
    double length = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = lrcsi_dd_two_sum(x[k], -origin[k]);
        depth += p[k].hi * d[k] / (view->length * view->length);
        length += fabs(p[k].hi);
    }
    for (int k = 0; k < 2; k++) {
        lrcsi_dd slope = {-lrcsi_product_dot(view->R[k], exact, d), 0};
        lrcsi_dd sum = lrcsi_dd_scale(slope, depth);
        for (int j = 0; j < 3; j++) {
            sum = lrcsi_dd_add(sum, lrcsi_dd_scale(p[j], view->R[k][j]));
        }
        out[k] = lrcsi_dd_value(sum);
    }
    return fabs(out[0]) + fabs(out[1]) + 8 * LRCSI_U * length;
}

/* A scene point relative to the target's first corner, in the view plane; returns the distance of
   which it is off by 10 u. */
static double frame_point(const lrcsi_view *view, const double *origin, const double *x,
                          double out[2])
{
    double p[3];
    double square = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = x[k] - origin[k];
        square += p[k] * p[k];
    }
    for (int k = 0; k < 2; k++) {
        out[k] = view->R[k][0] * p[0] + view->R[k][1] * p[1] + view->R[k][2] * p[2];
    }
    double away = sqrt(square);
    return away * view->scale > FAR_OFF && away > FAR_OFF * (fabs(out[0]) + fabs(out[1]))
               ? frame_point_deep(view, origin, x, out)
               : away;
}

/* The corner from which a facet is counted: its first, unless that is far away from the scene's
   bulk and another is not. Seen from a far corner, all that is near the others would be off by as
   much. */
static int corner_first(const lrcsi_view *view, uint32_t facet)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double off = lrcsi_view_off(view->point[corner[0]].x);
    if (off * view->scale <= FAR_OFF * 10 * LRCSI_U) {
        return 0;
    }
    double second = lrcsi_view_off(view->point[corner[1]].x);
    double third = lrcsi_view_off(view->point[corner[2]].x);
    return off <= FAR_OFF * lrcsi_least(second, third) ? 0 : second <= third ? 1 : 2;
}

/* The facet's own number of its corner k, counted counter-clockwise in the view from its first. */
static int corner_number(const lrcsi_view *view, uint32_t facet, int first, int k)
{
    return (first + (view->facing[facet] > 0 ? k : 3 - k)) % 3;
}

const double *lrcsi_target_corner(const lrcsi_view *view, uint32_t facet, int k)
{
    return lrcsi_prepared_corner(view->prepared, facet, corner_number(view, facet, 0, k));
}

const double *lrcsi_target_own(const lrcsi_view *view, uint32_t facet, int k)
{
    int first = corner_first(view, facet);
    return lrcsi_prepared_corner(view->prepared, facet, corner_number(view, facet, first, k));
}

double lrcsi_target_place(const lrcsi_target *t, const double x[3], double out[2])
{
    return frame_point(t->view, t->origin, x, out);
}

/* With n and f the distances of its nearer and its farther end, a point at the share t of its
   length is off by 10 u ((1 - t) n + t f). The target lies within its diameter d of the frame's
   origin, so that the segment may end where a coordinate passes 4 d: beyond, the coordinate grows
   by more than the error does, if its end is 32 u f and more beyond that. The new end is rounded
   by 4 u (n + 8 d). */
double lrcsi_target_segment(const lrcsi_target *t, double end[2][2], const double away[2])
{
    int far = away[1] > away[0];
    double n = away[!far];
    double f = away[far];
    double box = 4 * t->diameter;
    double share = 1;
    for (int k = 0; k < 2 && f > FAR_OFF * (n + box); k++) {
        if (fabs(end[far][k]) > box + 32 * LRCSI_U * f) {
            double exit = copysign(box, end[far][k]) - end[!far][k];
            share = lrcsi_least(share, exit / (end[far][k] - end[!far][k]));
        }
    }
    if (!(share > 0 && share < 1)) {
        return f;
    }
    for (int k = 0; k < 2; k++) {
        end[far][k] = end[!far][k] + share * (end[far][k] - end[!far][k]);
    }
    return (2 - share) * n + share * f + box;
}

void lrcsi_target_make(const lrcsi_view *view, uint32_t facet, lrcsi_target *t)
{
    *t = (lrcsi_target){.view = view, .facet = facet, .unit = 1};
    t->origin = lrcsi_target_own(view, facet, 0);
    for (int k = 0; k < 3; k++) {
        double away = lrcsi_target_place(t, lrcsi_target_own(view, facet, k), t->corner[k]);
        t->reach = lrcsi_most(t->reach, away);
    }
    for (int k = 0; k < 3; k++) {
        const double *p = t->corner[k];
        const double *q = t->corner[(k + 1) % 3];
        double side = lrcsi_length_flat(q[0] - p[0], q[1] - p[1]) + 32 * LRCSI_U * t->reach;
        t->diameter = lrcsi_most(t->diameter, side);
        t->perimeter += side;
        for (int i = 0; i < 3; i++) {
            t->size = lrcsi_most(t->size, fabs(lrcsi_target_corner(view, facet, k)[i]));
        }
    }
}

/* Shares are off by 100 u of the reach. A sum of three products, of shares that add up to 1, is off
   by 3 u of the largest coordinate in each, below 6 u in norm. */
double lrcsi_target_lift_off(const lrcsi_target *t)
{
    return 100 * LRCSI_U * t->reach + 8 * LRCSI_U * t->size;
}

void lrcsi_target_refine(const lrcsi_target *t, lrcsi_needle *needle, lrcsi_target *refined)
{
    const double *const point[3] = {t->origin, lrcsi_target_own(t->view, t->facet, 1),
                                    lrcsi_target_own(t->view, t->facet, 2)};
    *refined = *t;
    if (lrcsi_needle_make(t->view, point, t->corner, t->reach, needle)) {
        *refined = (lrcsi_target){.view = t->view,
                                  .facet = t->facet,
                                  .origin = t->origin,
                                  .corner = {{0, 0}, {1, 0}, {0, 1}},
                                  .size = 1,
                                  .diameter = 1.4143,
                                  .perimeter = 3.4143,
                                  .position_err = needle->off * needle->reach,
                                  .unit = 2 * lrcsi_view_incidence(t->view, t->facet).projected,
                                  .needle = needle};
    }
}

void lrcsi_target_unrefine(const lrcsi_target *refined, const double at[2], double out[2])
{
    for (int k = 0; k < 2; k++) {
        out[k] = refined->needle
                     ? at[0] * refined->needle->corner[0][k] + at[1] * refined->needle->corner[1][k]
                     : at[k];
    }
}

/* --- back to the facet ------------------------------------------------------------------------ */

static double clamped(double x, double low, double high)
{
    return lrcsi_most(low, lrcsi_least(x, high));
}

/* The corner at which the longest side starts. */
static int longest_from(const lrcsi_target *t)
{
    int longest = 0;
    double most = 0;
    for (int k = 0; k < 3; k++) {
        double x = t->corner[(k + 1) % 3][0] - t->corner[k][0];
        double y = t->corner[(k + 1) % 3][1] - t->corner[k][1];
        if (x * x + y * y > most) {
            most = x * x + y * y;
            longest = k;
        }
    }
    return longest;
}

/* Along the longest side (of length d) places are as good as their coordinates, in a needle too;
   across it the height's share of the third corner's is all there is, and that is off by u d over
   the latter. So this share goes first, and the place along, which it must not disturb, is kept by
   the other two. Of rounded differences, two products, a sum and a quotient: the place along is off
   by 9 u d, the foot of the third corner likewise, heights by 4 u d each; a share of a height h
   that is off by 4 u d moves the point by at most 8 u d (where h < 8 u d, by less than h). With the
   shares' own rounding at most 50 u d, and d is at most twice the reach. */
void lrcsi_target_weights(const lrcsi_target *t, const double at[2], double weight[3])
{
    int k = longest_from(t);
    const double *from = t->corner[k];
    const double *third = t->corner[(k + 2) % 3];
    double shares[3] = {0, 0, 1}; /* of corners k, k + 1, k + 2 */
    if (at[0] != third[0] || at[1] != third[1]) {
        const double to[2] = {t->corner[(k + 1) % 3][0] - from[0],
                              t->corner[(k + 1) % 3][1] - from[1]};
        const double top[2] = {third[0] - from[0], third[1] - from[1]};
        const double p[2] = {at[0] - from[0], at[1] - from[1]};
        double square = to[0] * to[0] + to[1] * to[1];
        double height = to[0] * top[1] - to[1] * top[0];
        double foot = (to[0] * top[0] + to[1] * top[1]) / square;
        double along = (to[0] * p[0] + to[1] * p[1]) / square;
        shares[2] = height > 0 ? clamped((to[0] * p[1] - to[1] * p[0]) / height, 0, 1) : 0;
        shares[1] = clamped(along - shares[2] * foot, 0, 1 - shares[2]);
        shares[0] = 1 - shares[2] - shares[1];
    }
    int first = corner_first(t->view, t->facet);
    for (int i = 0; i < 3; i++) {
        weight[corner_number(t->view, t->facet, first, (k + i) % 3)] = shares[i];
    }
}
