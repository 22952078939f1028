/* SPDX-License-Identifier: MIT */
/* A facet's frame of the view plane: how its corners and those of others come into it, and how
   points of it go back to the facet. It knows nothing of what hides what. */
#include "visibility/target.h"

#include <math.h>

#include "base/length.h"
#include "base/range.h"

#define U 0x1p-53

/* A scene point relative to the target's first corner, in the view plane; returns its distance. */
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
    return sqrt(square);
}

/* The facet's own number of its corner k, counted counter-clockwise in the view. */
static int corner_number(const lrcsi_view *view, uint32_t facet, int k)
{
    return view->facing[facet] > 0 ? k : (3 - k) % 3;
}

const double *lrcsi_target_corner(const lrcsi_view *view, uint32_t facet, int k)
{
    return lrcsi_prepared_corner(view->prepared, facet, corner_number(view, facet, k));
}

double lrcsi_target_frame(const lrcsi_view *view, uint32_t target, uint32_t facet,
                          double corner[3][2])
{
    const double *origin = lrcsi_prepared_corner(view->prepared, target, 0);
    double reach = 0;
    for (int k = 0; k < 3; k++) {
        const double *x = lrcsi_target_corner(view, facet, k);
        reach = lrcsi_most(reach, frame_point(view, origin, x, corner[k]));
    }
    return reach;
}

double lrcsi_target_place(const lrcsi_target *t, const double x[3], double out[2])
{
    return frame_point(t->view, lrcsi_prepared_corner(t->view->prepared, t->facet, 0), x, out);
}

void lrcsi_target_make(const lrcsi_view *view, uint32_t facet, lrcsi_target *t)
{
    *t = (lrcsi_target){.view = view, .facet = facet, .unit = 1};
    t->reach = lrcsi_target_frame(view, facet, facet, t->corner);
    for (int k = 0; k < 3; k++) {
        const double *p = t->corner[k];
        const double *q = t->corner[(k + 1) % 3];
        double side = lrcsi_length_flat(q[0] - p[0], q[1] - p[1]) + 32 * U * t->reach;
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
    return 100 * U * t->reach + 8 * U * t->size;
}

void lrcsi_target_refine(const lrcsi_target *t, lrcsi_needle *needle, lrcsi_target *refined)
{
    *refined = *t;
    if (lrcsi_needle_make(t->view, t->facet, t->corner, t->reach, needle)) {
        *refined = (lrcsi_target){.view = t->view,
                                  .facet = t->facet,
                                  .corner = {{0, 0}, {1, 0}, {0, 1}},
                                  .size = 1,
                                  .diameter = 1.4143,
                                  .perimeter = 3.4143,
                                  .slip = needle->off * needle->reach,
                                  .unit = 2 * lrcsi_view_tilt(t->view, t->facet).projected,
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
    for (int i = 0; i < 3; i++) {
        weight[corner_number(t->view, t->facet, (k + i) % 3)] = shares[i];
    }
}
