/* SPDX-License-Identifier: MIT */
/* Positions in a needle, and the side of a line on which they lie. In the ordinary frame both have
   errors of some u of the facet's length r, and a needle seen edge-on may be no wider than that.
   Barycentric coordinates do not have this scale. What hides what is decided elsewhere.

   Errors. Let e and f be the sides from the origin, d the direction and T = det(e, f, d). With g =
   x
   - origin, the coordinates of x are det(g, f, d) / T and det(e, g, d) / T. A difference of doubles
   is exact as a pair. A component of f x d is two products (7 u^2 each) and a difference (3 u^2):
   at most 15 u^2 |f| |d| in norm. Its product with g is three products and two sums, 13.2 u^2 of
   |f| |d| |g|. So the error of the determinant is at most 29 u^2 r |d| |g|. The computed T is used
   as if it were exact: this scales the frame by 1 + 29 u^2 r^2 |d| / T, and moves the facet's own
   corners, and the point that a position in the frame stands for, by as much. `off` times the reach
   is more than twice that. The quotient adds 20 u^2 of a coordinate of at most 1.01 r |d| |g| / T.

   A clipped end is from + t (to - from), a difference, a product and a sum: 13 u^2 of 2 s, where s
   is the larger coordinate. If t comes from heights (visibility/contact.h), its quotient of rounded
   sums adds 30 u^2 of 2 s. The total is at most 137 u^2 r |d| |g| / T, less than OFF. */
#include "visibility/needle.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"

#define OFF (160 * LRCSI_U * LRCSI_U)

/* Products of coordinates and components are multiples of 2^-1056 (base/exact.c). This exceeds by
   far what underflow in products of quotients and positions can lose, some 2^-1074. */
#define UNDERFLOW_MOST 0x1p-900

/* A needle is at least NEEDLE_LEAST and at most NEEDLE_MOST times as long as wide; the remaining
   bits of 2^106 are its accuracy. In the ordinary frame areas have errors of some 24 u of the
   squared length. For facets more than half as long as the scene this may exceed 1e-15 of the
   scene's squared size, and 1e-12 of the facet's area if it is NEEDLE_LARGE times as long as wide:
   such facets count as needles from there on. */
#define NEEDLE_LEAST 0x1p20
#define NEEDLE_LARGE 0x1p8
#define NEEDLE_MOST  0x1p88

lrcsi_dd lrcsi_needle_quotient(lrcsi_dd a, lrcsi_dd b)
{
    double first = a.hi / b.hi;
    lrcsi_dd rest = lrcsi_dd_sub(a, lrcsi_dd_scale(b, first));
    return lrcsi_dd_quick_sum(first, rest.hi / b.hi);
}

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
    double turn = corner[1][0] * corner[2][1] - corner[1][1] * corner[2][0];
    const double *bulk = view->prepared->bulk;
    double large = lrcsi_max(bulk[0], lrcsi_max(bulk[1], bulk[2]));
    double least = reach > large ? NEEDLE_LARGE : NEEDLE_LEAST;
    if (turn * least > reach * reach) {
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
    n->whole = dot_dd(n->row[1], n->side[1]);
    n->off = OFF * n->reach * n->length / n->whole.hi;
    return n->whole.hi > UNDERFLOW_MOST &&
           n->whole.hi * NEEDLE_MOST > n->reach * n->reach * n->length;
}

double lrcsi_needle_coordinates(const lrcsi_needle *n, const double x[3], lrcsi_dd out[2])
{
    lrcsi_dd gap[3];
    double far = difference_dd(x, n->origin, gap);
    for (int i = 0; i < 2; i++) {
        out[i] = lrcsi_needle_quotient(dot_dd(n->row[i], gap), n->whole);
    }
    return n->off * far;
}

/* --- segments --------------------------------------------------------------------------------- */

/* Narrows the part of a segment, an interval of its parameter, to where sign (x - bound) >= 0 in
   one coordinate. Returns 0 if nothing remains. */
static int clip_coordinate(lrcsi_dd from, lrcsi_dd to, double bound, int sign, lrcsi_dd part[2])
{
    lrcsi_dd limit = {bound, 0};
    lrcsi_dd a = lrcsi_dd_sub(from, limit);
    lrcsi_dd b = lrcsi_dd_sub(to, limit);
    int out = sign * a.hi < 0;
    if (out && sign * b.hi < 0) {
        return 0;
    }
    if (out || sign * b.hi < 0) {
        lrcsi_dd at = lrcsi_needle_quotient(a, lrcsi_dd_sub(a, b));
        double later = lrcsi_dd_sub(at, part[!out]).hi;
        if (out ? later > 0 : later < 0) {
            part[!out] = at;
        }
    }
    return 1;
}

void lrcsi_needle_clip(const lrcsi_dd from[2], const lrcsi_dd to[2], double end[2][2],
                       lrcsi_dd part[2])
{
    int in = 1;
    part[0] = (lrcsi_dd){0, 0};
    part[1] = (lrcsi_dd){1, 0};
    for (int k = 0; k < 2 && in; k++) {
        in = clip_coordinate(from[k], to[k], -1, 1, part) &&
             clip_coordinate(from[k], to[k], 2, -1, part);
    }
    in = in && lrcsi_dd_sub(part[1], part[0]).hi >= 0;
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++) {
            lrcsi_dd along = lrcsi_dd_mul(part[i], lrcsi_dd_sub(to[k], from[k]));
            end[i][k] = in ? lrcsi_dd_value(lrcsi_dd_add(from[k], along)) : 2;
        }
    }
}

/* The parameter runs from the nearer end, so that the error of the farther end counts only in
   proportion to it. */
double lrcsi_needle_segment(const lrcsi_needle *n, const double p[3], const double q[3],
                            double end[2][2])
{
    lrcsi_dd at[2][2];
    lrcsi_dd part[2];
    double cut[2][2];
    const double off[2] = {lrcsi_needle_coordinates(n, p, at[0]),
                           lrcsi_needle_coordinates(n, q, at[1])};
    int far = off[1] > off[0];
    lrcsi_needle_clip((const lrcsi_dd *)at[!far], (const lrcsi_dd *)at[far], cut, part);
    for (int k = 0; k < 2; k++) {
        end[!far][k] = cut[0][k];
        end[far][k] = cut[1][k];
    }
    double t = lrcsi_min(1, lrcsi_max(part[0].hi, part[1].hi));
    return off[!far] + t * off[far];
}

/* --- sides ------------------------------------------------------------------------------------ */

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
           64 * LRCSI_U * LRCSI_U * length * far * n->length + UNDERFLOW_MOST;
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
    return guess || fabs(side) > 64 * LRCSI_U * LRCSI_U * length * far * n->length + UNDERFLOW_MOST
               ? side
               : 0;
}
