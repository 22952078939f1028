/* SPDX-License-Identifier: MIT */
/* The frame of a facet in the view plane: transformations of scene points into it, and of points of
   the frame back onto the facet. What hides what is decided elsewhere. */
#include "visibility/cells/target.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "view/product.h"
#include "visibility/base/clip.h"

/* A point counts as far if its distance is more than this many times that of the points with which
   it is compared. Heuristic: the errors returned hold for either choice. */
#define FAR_POINT 8.0

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

/* The corner that is the origin of a facet's frame: its first, unless that one is far from the bulk
   of the scene and another is not. With a far corner as origin, positions near the other corners
   would have errors in proportion to the distance. */
static int corner_first(const lrcsi_view *view, uint32_t facet)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double first = view->point[corner[0]].err;
    if (first * view->scale <= FAR_POINT * 10 * LRCSI_U) {
        return 0;
    }
    double second = view->point[corner[1]].err;
    double third = view->point[corner[2]].err;
    return first <= FAR_POINT * lrcsi_min(second, third) ? 0 : second <= third ? 1 : 2;
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

const double *lrcsi_target_frame_corner(const lrcsi_view *view, uint32_t facet, int k)
{
    int first = corner_first(view, facet);
    return lrcsi_prepared_corner(view->prepared, facet, corner_number(view, facet, first, k));
}

double lrcsi_target_coordinates(const lrcsi_target *t, const double x[3], double out[2])
{
    const lrcsi_view *view = t->view;
    double p[3];
    double square = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = x[k] - t->origin[k];
        square += p[k] * p[k];
    }
    for (int k = 0; k < 2; k++) {
        out[k] = view->R[k][0] * p[0] + view->R[k][1] * p[1] + view->R[k][2] * p[2];
    }
    double distance = sqrt(square);
    return distance * view->scale > FAR_POINT &&
                   distance > FAR_POINT * (fabs(out[0]) + fabs(out[1]))
               ? frame_point_deep(view, t->origin, x, out)
               : distance;
}

/* Let n and f be the distances of the nearer and the farther end. The point at parameter t (0 .. 1)
   of the segment has an error of 10 u ((1 - t) n + t f). The target lies within its diameter d of
   the frame's origin. The segment can therefore be cut where a coordinate exceeds 4 d: if its end
   is at least 32 u f beyond that, the coordinate grows faster than the error. The rounding error
   of the new end is 4 u (n + 8 d). */
double lrcsi_target_segment(const lrcsi_target *t, double end[2][2], const double distance[2])
{
    int far = distance[1] > distance[0];
    double n = distance[!far];
    double f = distance[far];
    double box = 4 * t->diameter;
    double t_end = 1;
    for (int k = 0; k < 2 && f > FAR_POINT * (n + box); k++) {
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
    t->origin = lrcsi_target_frame_corner(view, facet, 0);
    for (int k = 0; k < 3; k++) {
        double distance =
            lrcsi_target_coordinates(t, lrcsi_target_frame_corner(view, facet, k), t->corner[k]);
        t->reach = lrcsi_max(t->reach, distance);
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
double lrcsi_target_unproject_err(const lrcsi_target *t)
{
    return 100 * LRCSI_U * t->reach + 8 * LRCSI_U * t->size;
}

/* --- needles ---------------------------------------------------------------------------------- */

/* In the frame along the view's axes, positions and the side of a line on which they lie have
   errors of some u of the facet's length r, and a needle seen edge-on may be no wider than that.
   Barycentric coordinates do not have this scale.

   Errors. Let e and f be the sides from the origin, d the direction and T = det(e, f, d). With g =
   x - origin, the coordinates of x are det(g, f, d) / T and det(e, g, d) / T. A difference of
   doubles is exact as a pair. A component of f x d is two products (7 u^2 each) and a difference (3
   u^2): at most 15 u^2 |f| |d| in norm. Its product with g is three products and two sums, 13.2 u^2
   of |f| |d| |g|. So the error of the determinant is at most 29 u^2 r |d| |g|. The computed T is
   used as if it were exact: this scales the frame by 1 + 29 u^2 r^2 |d| / T, and moves the facet's
   own corners, and the point that a position in the frame represents, by as much. `relative_err`
   times the reach is more than twice that. The quotient adds 20 u^2 of a coordinate of at most 1.01
   r |d| |g| / T.

   A clipped end is from + t (to - from), a difference, a product and a sum: 13 u^2 of 2 s, where s
   is the larger coordinate. If t comes from heights (visibility/cells/contact.c), its quotient of
   rounded sums adds 30 u^2 of 2 s. The total is at most 137 u^2 r |d| |g| / T, less than
   NEEDLE_ERR. */
#define NEEDLE_ERR (160 * LRCSI_U * LRCSI_U)

/* Products of coordinates and components are multiples of 2^-1056 (base/exact.c). This exceeds by
   far what underflow in products of quotients and positions can lose, some 2^-1074. */
#define NEEDLE_UNDERFLOW 0x1p-900

/* A needle is at least NEEDLE_MIN_RATIO and at most NEEDLE_MAX_RATIO times as long as wide; the
   remaining bits of 2^106 are its accuracy. In the frame along the axes, areas have errors of some
   24 u of the squared length. For facets more than half as long as the scene this may exceed 1e-15
   of the scene's squared size, and 1e-12 of the facet's area if it is NEEDLE_LARGE_RATIO times as
   long as wide: such facets count as needles from that ratio on. */
#define NEEDLE_MIN_RATIO   0x1p20
#define NEEDLE_LARGE_RATIO 0x1p8
#define NEEDLE_MAX_RATIO   0x1p88

/* x - from, exactly. Returns its length, within 4 u. */
static double difference_dd(const double *x, const double *from, lrcsi_dd out[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = lrcsi_dd_two_sum(x[k], -from[k]);
        square += out[k].hi * out[k].hi;
    }
    return sqrt(square);
}

/* a x d, times a sign. */
static void cross_view(const lrcsi_dd a[3], const double *d, int sign, lrcsi_dd out[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        out[k] = lrcsi_dd_sub(lrcsi_dd_scale(a[i], sign * d[j]), lrcsi_dd_scale(a[j], sign * d[i]));
    }
}

static lrcsi_dd dot_dd(const lrcsi_dd a[3], const lrcsi_dd b[3])
{
    lrcsi_dd sum = lrcsi_dd_mul(a[0], b[0]);
    sum = lrcsi_dd_add(sum, lrcsi_dd_mul(a[1], b[1]));
    return lrcsi_dd_add(sum, lrcsi_dd_mul(a[2], b[2]));
}

int lrcsi_needle_make(const lrcsi_view *view, const double *const point[3],
                      const double corner[3][2], double reach, lrcsi_needle *n)
{
    double twice_area = corner[1][0] * corner[2][1] - corner[1][1] * corner[2][0];
    const double *bulk = view->prepared->bulk;
    double large = lrcsi_max3(bulk[0], bulk[1], bulk[2]);
    double ratio = reach > large ? NEEDLE_LARGE_RATIO : NEEDLE_MIN_RATIO;
    if (twice_area * ratio > reach * reach) {
        return 0;
    }
    n->origin = point[0];
    n->direction = view->direction;
    n->length = view->length;
    n->reach = 0;
    for (int i = 0; i < 2; i++) {
        n->reach = lrcsi_max(n->reach, difference_dd(point[i + 1], n->origin, n->side[i]));
        n->corner[i][0] = corner[i + 1][0];
        n->corner[i][1] = corner[i + 1][1];
    }
    cross_view(n->side[1], n->direction, 1, n->row[0]);
    cross_view(n->side[0], n->direction, -1, n->row[1]);
    n->determinant = dot_dd(n->row[1], n->side[1]);
    n->relative_err = NEEDLE_ERR * n->reach * n->length / n->determinant.hi;
    return n->determinant.hi > NEEDLE_UNDERFLOW &&
           n->determinant.hi * NEEDLE_MAX_RATIO > n->reach * n->reach * n->length;
}

double lrcsi_needle_coordinates(const lrcsi_needle *n, const double x[3], lrcsi_dd out[2])
{
    lrcsi_dd gap[3];
    double far = difference_dd(x, n->origin, gap);
    for (int i = 0; i < 2; i++) {
        out[i] = lrcsi_dd_div(dot_dd(n->row[i], gap), n->determinant);
    }
    return n->relative_err * far;
}

/* Narrows an interval of the parameter of a segment to where sign (x - bound) >= 0 in one
   coordinate. Returns 0 if nothing remains. */
static int clip_coordinate(lrcsi_dd from, lrcsi_dd to, double bound, int sign, lrcsi_dd interval[2])
{
    lrcsi_dd limit = {bound, 0};
    lrcsi_dd a = lrcsi_dd_sub(from, limit);
    lrcsi_dd b = lrcsi_dd_sub(to, limit);
    int out = sign * a.hi < 0;
    if (out && sign * b.hi < 0) {
        return 0;
    }
    if (out || sign * b.hi < 0) {
        lrcsi_dd at = lrcsi_dd_div(a, lrcsi_dd_sub(a, b));
        double later = lrcsi_dd_sub(at, interval[!out]).hi;
        if (out ? later > 0 : later < 0) {
            interval[!out] = at;
        }
    }
    return 1;
}

void lrcsi_needle_clip(const lrcsi_dd from[2], const lrcsi_dd to[2], double end[2][2],
                       lrcsi_dd interval[2])
{
    int in = 1;
    interval[0] = (lrcsi_dd){0, 0};
    interval[1] = (lrcsi_dd){1, 0};
    for (int k = 0; k < 2 && in; k++) {
        in = clip_coordinate(from[k], to[k], -1, 1, interval) &&
             clip_coordinate(from[k], to[k], 2, -1, interval);
    }
    in = in && lrcsi_dd_sub(interval[1], interval[0]).hi >= 0;
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++) {
            lrcsi_dd along = lrcsi_dd_mul(interval[i], lrcsi_dd_sub(to[k], from[k]));
            end[i][k] = in ? lrcsi_dd_value(lrcsi_dd_add(from[k], along)) : 2;
        }
    }
}

/* The parameter is 0 at the nearer end, so that it multiplies the error of the farther end. */
double lrcsi_needle_segment(const lrcsi_needle *n, const double p[3], const double q[3],
                            double end[2][2])
{
    lrcsi_dd at[2][2];
    lrcsi_dd interval[2];
    double cut[2][2];
    const double err[2] = {lrcsi_needle_coordinates(n, p, at[0]),
                           lrcsi_needle_coordinates(n, q, at[1])};
    int far = err[1] > err[0];
    lrcsi_needle_clip((const lrcsi_dd *)at[!far], (const lrcsi_dd *)at[far], cut, interval);
    for (int k = 0; k < 2; k++) {
        end[!far][k] = cut[0][k];
        end[far][k] = cut[1][k];
    }
    double t = lrcsi_min(1, lrcsi_max(interval[0].hi, interval[1].hi));
    return err[!far] + t * err[far];
}

/* The determinant of lrcsi_needle_side as a linear function of u and v. Each coefficient has an
   error of 29 u^2 of the lengths of its factors, as above, and a rounding error of u of itself;
   evaluating the function adds 3 u of its terms. u and v are below 2 in magnitude. */
double lrcsi_needle_line(const lrcsi_needle *n, const double p[3], const double q[3],
                         double line[3])
{
    lrcsi_dd along[3];
    lrcsi_dd gap[3];
    lrcsi_dd row[3];
    double length = difference_dd(q, p, along);
    double far = difference_dd(n->origin, p, gap) + 4 * n->reach;
    cross_view(along, n->direction, -1, row);
    line[0] = lrcsi_dd_value(dot_dd(row, n->side[0]));
    line[1] = lrcsi_dd_value(dot_dd(row, n->side[1]));
    line[2] = lrcsi_dd_value(dot_dd(row, gap));
    return 8 * LRCSI_U * (2 * fabs(line[0]) + 2 * fabs(line[1]) + fabs(line[2])) +
           64 * LRCSI_U * LRCSI_U * length * far * n->length + NEEDLE_UNDERFLOW;
}

/* det(q - p, x - p, d) at x = origin + u e + v f. The error of x - p is 13 u^2 of the lengths of
   its terms; with the errors above, less than 45 u^2 in total. */
double lrcsi_needle_side(const lrcsi_needle *n, const double p[3], const double q[3],
                         const double at[2], int guess)
{
    lrcsi_dd along[3];
    lrcsi_dd gap[3];
    lrcsi_dd row[3];
    double length = difference_dd(q, p, along);
    double far = difference_dd(n->origin, p, gap) + 2 * n->reach;
    for (int k = 0; k < 3; k++) {
        gap[k] = lrcsi_dd_add(gap[k], lrcsi_dd_scale(n->side[0][k], at[0]));
        gap[k] = lrcsi_dd_add(gap[k], lrcsi_dd_scale(n->side[1][k], at[1]));
    }
    cross_view(along, n->direction, -1, row);
    double side = lrcsi_dd_value(dot_dd(row, gap));
    return guess ||
                   fabs(side) > 64 * LRCSI_U * LRCSI_U * length * far * n->length + NEEDLE_UNDERFLOW
               ? side
               : 0;
}

/* --- the frame of a needle as a target -------------------------------------------------------- */

void lrcsi_target_refine(const lrcsi_target *t, lrcsi_needle *needle, lrcsi_target *refined)
{
    const double *const point[3] = {t->origin, lrcsi_target_frame_corner(t->view, t->facet, 1),
                                    lrcsi_target_frame_corner(t->view, t->facet, 2)};
    *refined = *t;
    if (lrcsi_needle_make(t->view, point, t->corner, t->reach, needle)) {
        *refined = (lrcsi_target){.view = t->view,
                                  .facet = t->facet,
                                  .origin = t->origin,
                                  .corner = {{0, 0}, {1, 0}, {0, 1}},
                                  .size = 1,
                                  .diameter = LRCSI_ROOT_2_OUTWARD,
                                  .perimeter = 2 + LRCSI_ROOT_2_OUTWARD,
                                  .position_err = needle->relative_err * needle->reach,
                                  .unit = 2 * lrcsi_view_incidence(t->view, t->facet).projected,
                                  .needle = needle};
    }
}

void lrcsi_target_to_axes(const lrcsi_target *refined, const double at[2], double out[2])
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
    double longest; /* squared */
    int k = lrcsi_clip_longest_side(t->corner, &longest);
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
