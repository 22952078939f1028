/* SPDX-License-Identifier: MIT */
/* The frame of a facet in the view plane: transformations of scene points into it, and of points of
   the frame back onto the facet. What hides what is decided elsewhere. */
#include "visibility/target.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/length.h"
#include "base/range.h"
#include "view/product.h"

/* A point counts as far away if its distance is this many times that of the points it is compared
   with. */
#define FAR_OFF 8.0

/* The position of a scene point that is much deeper, or much nearer, than the origin. The rows r of
   R have errors of 4 u, which a large depth would multiply. Therefore their components
   perpendicular to the direction d are used, r - (r . d) d / d^2: they are as close to the exact
   axes, and exactly perpendicular to d. Errors: the products with the exact difference p, 16 u^2
   |p|; the slope r . d (at most 4 u |d|), 21 u^2 |d|; its product with the depth, 24 u^2 |p| more.
   Together less than 80 u^2 |p|. */
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

/* A scene point relative to the target's first corner, in the view plane. Returns a distance; the
   position error is at most 10 u times it. */
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

/* The corner at which a facet's frame begins: its first, unless that one is far away from the bulk
   of the scene and another is not. With a far corner as origin, positions near the other corners
   would have errors in proportion to the distance. */
static int corner_first(const lrcsi_view *view, uint32_t facet)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double off = lrcsi_view_point_err(view->point[corner[0]].x);
    if (off * view->scale <= FAR_OFF * 10 * LRCSI_U) {
        return 0;
    }
    double second = lrcsi_view_point_err(view->point[corner[1]].x);
    double third = lrcsi_view_point_err(view->point[corner[2]].x);
    return off <= FAR_OFF * lrcsi_min(second, third) ? 0 : second <= third ? 1 : 2;
}

/* The index within the facet of corner k, counted counter-clockwise in the view from `first`. */
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

double lrcsi_target_coordinates(const lrcsi_target *t, const double x[3], double out[2])
{
    return frame_point(t->view, t->origin, x, out);
}

/* Let n and f be the distances of the nearer and the farther end. The point at parameter t (0 .. 1)
   of the segment has an error of 10 u ((1 - t) n + t f). The target lies within its diameter d of
   the frame's origin. The segment can therefore be cut where a coordinate exceeds 4 d: if its end
   is at least 32 u f beyond that, the coordinate grows faster than the error. The rounding error
   of the new end is 4 u (n + 8 d). */
double lrcsi_target_segment(const lrcsi_target *t, double end[2][2], const double away[2])
{
    int far = away[1] > away[0];
    double n = away[!far];
    double f = away[far];
    double box = 4 * t->diameter;
    double t_end = 1;
    for (int k = 0; k < 2 && f > FAR_OFF * (n + box); k++) {
        if (fabs(end[far][k]) > box + 32 * LRCSI_U * f) {
            double exit = copysign(box, end[far][k]) - end[!far][k];
            t_end = lrcsi_min(t_end, exit / (end[far][k] - end[!far][k]));
        }
    }
    if (!(t_end > 0 && t_end < 1)) {
        return f;
    }
    for (int k = 0; k < 2; k++) {
        end[far][k] = end[!far][k] + t_end * (end[far][k] - end[!far][k]);
    }
    return (2 - t_end) * n + t_end * f + box;
}

void lrcsi_target_make(const lrcsi_view *view, uint32_t facet, lrcsi_target *t)
{
    *t = (lrcsi_target){.view = view, .facet = facet, .unit = 1};
    t->origin = lrcsi_target_own(view, facet, 0);
    for (int k = 0; k < 3; k++) {
        double away = lrcsi_target_coordinates(t, lrcsi_target_own(view, facet, k), t->corner[k]);
        t->reach = lrcsi_max(t->reach, away);
    }
    for (int k = 0; k < 3; k++) {
        const double *p = t->corner[k];
        const double *q = t->corner[(k + 1) % 3];
        double side = lrcsi_length_flat(q[0] - p[0], q[1] - p[1]) + 32 * LRCSI_U * t->reach;
        t->diameter = lrcsi_max(t->diameter, side);
        t->perimeter += side;
        for (int i = 0; i < 3; i++) {
            t->size = lrcsi_max(t->size, fabs(lrcsi_target_corner(view, facet, k)[i]));
        }
    }
}

/* The barycentric coordinates cause an error of 100 u of the reach. The sum of three products, with
   coordinates that add up to 1, has an error of 3 u of the largest component in each component,
   less than 6 u in norm. */
double lrcsi_target_lift_err(const lrcsi_target *t)
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
    return lrcsi_max(low, lrcsi_min(x, high));
}

/* The corner at which the longest side begins. */
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

/* Barycentric coordinates with respect to the longest side, of length d. Along this side the
   position is as accurate as the given coordinates, also in a needle. Across it only the ratio of
   the point's height to that of the third corner is known, with an error of u d divided by the
   latter. Therefore the third corner's coordinate is computed first, and the other two are chosen
   so that the position along the side is kept. Errors from rounded differences, two products, a sum
   and a quotient: the position along the side, 9 u d; the foot of the third corner, the same; the
   heights, 4 u d each. A coordinate computed from a height h with an error of 4 u d moves the point
   by at most 8 u d (if h < 8 u d, by less than h). With the rounding of the coordinates themselves
   at most 50 u d; d is at most twice the reach. */
void lrcsi_target_weights(const lrcsi_target *t, const double at[2], double weight[3])
{
    int k = longest_from(t);
    const double *from = t->corner[k];
    const double *third = t->corner[(k + 2) % 3];
    double b[3] = {0, 0, 1}; /* barycentric coordinates of corners k, k + 1, k + 2 */
    if (at[0] != third[0] || at[1] != third[1]) {
        const double to[2] = {t->corner[(k + 1) % 3][0] - from[0],
                              t->corner[(k + 1) % 3][1] - from[1]};
        const double top[2] = {third[0] - from[0], third[1] - from[1]};
        const double p[2] = {at[0] - from[0], at[1] - from[1]};
        double square = to[0] * to[0] + to[1] * to[1];
        double height = to[0] * top[1] - to[1] * top[0];
        double foot = (to[0] * top[0] + to[1] * top[1]) / square;
        double along = (to[0] * p[0] + to[1] * p[1]) / square;
        b[2] = height > 0 ? clamped((to[0] * p[1] - to[1] * p[0]) / height, 0, 1) : 0;
        b[1] = clamped(along - b[2] * foot, 0, 1 - b[2]);
        b[0] = 1 - b[2] - b[1];
    }
    int first = corner_first(t->view, t->facet);
    for (int i = 0; i < 3; i++) {
        weight[corner_number(t->view, t->facet, first, (k + i) % 3)] = b[i];
    }
}
