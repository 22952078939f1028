/* SPDX-License-Identifier: MIT */
/* Contacts of two facets, decided by signs of determinants of the given vertices alone: no
   intersection point is ever computed. First, in rounded arithmetic with an error bound: does a
   plane separate the two facets, except for common corners? The planes of both are tried, and the
   planes through each side parallel to the axis of F. If so, they meet at most in common corners
   or along a common side. All other pairs are decided exactly.

   The exact predicates, for F with corners a_0 a_1 a_2 and T with corners p_0 p_1 p_2:
   1. Signs of the corners of each facet relative to the plane of the other. If those of the corners
      that are not common are all positive or all negative, the two meet at most in what is common.
   2. All are zero: the facets are coplanar. Seen along an axis along which they are not edge-on,
      neither meets the interior of the other if and only if the line of some side has one facet on
      one side and the other facet on the other side or on the line (separating axis theorem). If it
      is a side of F, T meets F at most on that side; if it is only a side of T, F has at most one
      corner on it.
   3. Otherwise T intersects the plane of F in a segment or a point. Its ends lie on lines u w
      through corners of T, with w off the plane and u on the plane or across it. The end X lies on
      the inner side of a side a b of F if and only if the sign of
          det(w - u, a - u, b - u) = (w - u) . ((a - X) x (b - X))
      is that of w relative to the plane. The segment misses the interior of F if and only if all of
      it is outside or on the line of one side, or F is on one side of the segment's own line
      (separating axis theorem again). That line is the intersection of the two planes, so the
      second condition is decided by the signs of a_k relative to the plane of T. With F and T
      exchanged the determinants are the same.
   4. A side of F crosses the plane of T in one point. The point is in T if no two of the
      determinants of that side and the three sides of T have opposite signs. If all ends of the
      segment of T are outside of one side of F, the facets have no point in common. */
#include "mesh/contact/intersection_pair.h"

#include <math.h>

#include "base/constant.h"
#include "base/exact.h"

static const double unit_axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* 10 u. For the height above a plane: with n the computed normal at corner a and w_k = |p_i q_j| +
   |p_j q_i|, each component of n has an error of at most 5 u w_k (base/exact.c), a difference x - a
   one of u of itself, and the sum of three products one of 3 u of its terms; |n_k| <= (1 + 4 u)
   w_k. For an orientation: 4 u of its two products. */
#define PAIR_FILTER (10.0 * LRCSI_U)

/* A sign that rounded arithmetic does not decide. */
enum { PAIR_UNDECIDED = 2 };

/* The axis is that of the largest component of the normal, unless the facet may be edge-on along
   it. */
void lrcsi_pair_plane(lrcsi_pair_facet *f)
{
    const double *a = f->x[0];
    const double *b = f->x[1];
    const double *c = f->x[2];
    const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double plus[3] = {p[1] * q[2], p[2] * q[0], p[0] * q[1]};
    const double minus[3] = {p[2] * q[1], p[0] * q[2], p[1] * q[0]};
    int best = 0;
    for (int k = 0; k < 3; k++) {
        f->normal[k] = plus[k] - minus[k];
        f->weight[k] = fabs(plus[k]) + fabs(minus[k]);
        best = fabs(f->normal[k]) > fabs(f->normal[best]) ? k : best;
    }
    f->axis = best;
    f->orientation = 0;
    if (fabs(f->normal[best]) > PAIR_FILTER * f->weight[best]) {
        f->orientation = f->normal[best] > 0.0 ? 1 : -1;
    }
    for (int k = 0; k < 3 && f->orientation == 0; k++) {
        f->axis = (best + k) % 3;
        f->orientation = lrcsi_exact_orient(a, b, c, unit_axis[f->axis]);
    }
}

static inline int is_corner_of(const lrcsi_pair_facet *f, const double *p)
{
    return p == f->x[0] || p == f->x[1] || p == f->x[2];
}

/* ---- separated, in rounded arithmetic ---- */

/* The side of F's plane on which p is proved to lie; 0 for a corner of F; else PAIR_UNDECIDED. */
static inline int rounded_side(const lrcsi_pair_facet *f, const double *p)
{
    const double *a = f->x[0];
    if (is_corner_of(f, p)) {
        return 0;
    }
    double x = p[0] - a[0];
    double y = p[1] - a[1];
    double z = p[2] - a[2];
    double height = (f->normal[0] * x + f->normal[1] * y) + f->normal[2] * z;
    double error =
        PAIR_FILTER * ((f->weight[0] * fabs(x) + f->weight[1] * fabs(y)) + f->weight[2] * fabs(z));
    return height > error ? 1 : height < -error ? -1 : PAIR_UNDECIDED;
}

/* Given the sides on which T's corners lie: are those that are not corners of F all strictly on one
   side, and is there at least one? Then T meets the plane of F at most in common corners and the
   segment between them. */
static int plane_separates(const int side[3])
{
    int above = side[0] == 1 || side[1] == 1 || side[2] == 1;
    int below = side[0] == -1 || side[1] == -1 || side[2] == -1;
    int undecided =
        side[0] == PAIR_UNDECIDED || side[1] == PAIR_UNDECIDED || side[2] == PAIR_UNDECIDED;
    return above != below && !undecided;
}

/* Seen along an axis along which F has the orientation `orientation`: are all corners of T proved
   to lie outside the line of one side of F, except those that are ends of the side? Then the facets
   meet at most in these ends and between them. */
static int line_separates(const lrcsi_pair_facet *f, int orientation, const lrcsi_pair_facet *t,
                          int axis)
{
    const int i = axis == 2 ? 0 : axis + 1;
    const int j = axis == 0 ? 2 : axis - 1;
    for (int k = 0; k < 3; k++) {
        const double *a = f->x[k];
        const double *b = f->x[k < 2 ? k + 1 : 0];
        const double along[2] = {orientation * (b[i] - a[i]), orientation * (b[j] - a[j])};
        int corner = 0;
        for (; corner < 3; corner++) {
            const double *p = t->x[corner];
            double plus = along[0] * (p[j] - a[j]);
            double minus = along[1] * (p[i] - a[i]);
            if (p != a && p != b && !(plus - minus < -PAIR_FILTER * (fabs(plus) + fabs(minus)))) {
                break;
            }
        }
        if (corner == 3) {
            return 1;
        }
    }
    return 0;
}

/* Are two facets, seen along F's axis, separated by the line of a side? */
static int lines_separate(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t)
{
    if (line_separates(f, f->orientation, t, f->axis)) {
        return 1;
    }
    const int i = f->axis == 2 ? 0 : f->axis + 1;
    const int j = f->axis == 0 ? 2 : f->axis - 1;
    const double *a = t->x[0];
    double plus = (t->x[1][i] - a[i]) * (t->x[2][j] - a[j]);
    double minus = (t->x[1][j] - a[j]) * (t->x[2][i] - a[i]);
    double error = PAIR_FILTER * (fabs(plus) + fabs(minus));
    int orientation = (plus - minus > error) - (plus - minus < -error);
    return orientation != 0 && line_separates(t, orientation, f, f->axis);
}

/* ---- exact ---- */

/* Does the convex hull of points on the line a b meet the open segment a b? Seen along the axis. */
static int line_covers_segment(const double *a, const double *b, const double *const *on, int count,
                               const double *axis)
{
    int k = 0;
    while (k < 2 && (axis[k] != 0 || a[k] == b[k])) {
        k++;
    }
    int below = 0;
    int above = 0;
    for (int i = 0; i < count; i++) {
        below += on[i][k] <= (a[k] < b[k] ? a[k] : b[k]);
        above += on[i][k] >= (a[k] < b[k] ? b[k] : a[k]);
    }
    return count > 0 && below != count && above != count;
}

/* Does T meet the open segment a b, which is in its plane? */
static int segment_meets_flat(const lrcsi_pair_facet *t, const double *a, const double *b)
{
    const double *axis = unit_axis[t->axis];
    const double *on[3];
    int count = 0;
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        int orientation = lrcsi_exact_orient(a, b, t->x[k], axis);
        left |= orientation > 0;
        right |= orientation < 0;
        if (orientation == 0) {
            on[count++] = t->x[k];
        }
    }
    if (!(left && right)) {
        return line_covers_segment(a, b, on, count, axis);
    }
    /* The line meets the interior of T; so does the segment, unless all of it is outside a side. */
    for (int k = 0; k < 3; k++) {
        const double *p = t->x[k];
        const double *q = t->x[(k + 1) % 3];
        if (t->orientation * lrcsi_exact_orient(p, q, a, axis) <= 0 &&
            t->orientation * lrcsi_exact_orient(p, q, b, axis) <= 0) {
            return 0;
        }
    }
    return 1;
}

/* Step 1: decides exactly on which side of F's plane the corners of T lie that are PAIR_UNDECIDED.
   Returned: whether a corner of T that is not one of F lies on the plane. */
static int exact_sides(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t, int side[3])
{
    int on = 0;
    for (int k = 0; k < 3; k++) {
        if (side[k] == PAIR_UNDECIDED) {
            side[k] = lrcsi_exact_side(f->x[0], f->x[1], f->x[2], t->x[k]);
            on |= side[k] == 0;
        }
    }
    return on;
}

/* Step 2: the first side of f, which has the orientation `orientation` seen along the axis, whose
   line has all of g outside or on it; -1 if there is none. */
static int separating_side(const lrcsi_pair_facet *f, int orientation, const lrcsi_pair_facet *g,
                           const double *axis)
{
    for (int k = 0; k < 3; k++) {
        const double *a = f->x[k];
        const double *b = f->x[(k + 1) % 3];
        int i = 0;
        while (i < 3 && orientation * lrcsi_exact_orient(a, b, g->x[i], axis) <= 0) {
            i++;
        }
        if (i == 3) {
            return k;
        }
    }
    return -1;
}

/* Does T, in the plane of F, meet side k of F elsewhere than in its ends, without having
   that side? */
static int flat_side_is_met(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t, int k)
{
    const double *a = f->x[k];
    const double *b = f->x[(k + 1) % 3];
    return !(is_corner_of(t, a) && is_corner_of(t, b)) && segment_meets_flat(t, a, b);
}

/* Step 2. */
static void meet_flat(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t,
                      lrcsi_pair_result *result)
{
    const double *axis = unit_axis[f->axis];
    int orientation = lrcsi_exact_orient(t->x[0], t->x[1], t->x[2], axis);
    int of_f = separating_side(f, f->orientation, t, axis);
    int of_t = separating_side(t, orientation, f, axis);
    if (of_f < 0 && of_t < 0) {
        *result =
            (lrcsi_pair_result){{LRCSI_INTERSECTION_COPLANAR, LRCSI_INTERSECTION_COPLANAR}, {1, 1}};
        return;
    }
    result->met[0] = of_f >= 0 && flat_side_is_met(f, t, of_f);
    result->met[1] = of_t >= 0 && flat_side_is_met(t, f, of_t);
}

/* Two facets f[0] and f[1] whose planes intersect. of[i][k]: the side of the other's plane on which
   corner k of f[i] lies; cross[j][k]: the sign of the determinant of side j of f[0] and side k of
   f[1], PAIR_UNDECIDED until it is computed. */
typedef struct pair_crossing {
    const lrcsi_pair_facet *f[2];
    const int *of[2];
    int cross[3][3];
} pair_crossing;

/* The sign of the determinant of side j of f[i] and side k of the other. */
static int cross_sign(pair_crossing *c, int i, int j, int k)
{
    int *sign = i == 0 ? &c->cross[j][k] : &c->cross[k][j];
    if (*sign == PAIR_UNDECIDED) {
        const double *u = c->f[i]->x[j];
        const double *w = c->f[i]->x[(j + 1) % 3];
        const double *a = c->f[!i]->x[k];
        const double *b = c->f[!i]->x[(k + 1) % 3];
        *sign = u == a || u == b || w == a || w == b ? 0 : lrcsi_exact_side(u, w, a, b);
    }
    return *sign;
}

/* Step 3. The ends of the segment in which f[i] intersects the plane of the other, and on which
   side of each side of the other they lie. Returned: 1 if the segment meets the interior of the
   other (each side has an end strictly inside, and the other has corners on both sides of the plane
   of f[i], or the segment is a point); 0 if not; -1 if one side has all ends strictly outside. */
static int cut_meets(pair_crossing *c, int i)
{
    const int *side = c->of[i];
    const int *other = c->of[!i];
    int along[2]; /* the sides of f[i] that contain its ends, and the sense in which they cross
                     the plane */
    int up[2];
    int ends = 0;
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        int last = (k + 2) % 3;
        if (side[k] == 0 && side[next] == 0) { /* an end in a corner, by the side before it */
            along[ends] = last;
            up[ends++] = -side[last];
        } else if (side[k] == 0 || side[k] == -side[next]) {
            along[ends] = k;
            up[ends++] = side[next];
        }
    }
    int inside = 1;
    for (int k = 0; k < 3; k++) {
        int inner = 0;
        int outer = 0;
        for (int e = 0; e < ends && !inner; e++) {
            int sign = up[e] * cross_sign(c, i, along[e], k);
            inner |= sign > 0;
            outer += sign < 0;
        }
        if (outer == ends) {
            return -1;
        }
        inside &= inner;
    }
    int above = other[0] > 0 || other[1] > 0 || other[2] > 0;
    int below = other[0] < 0 || other[1] < 0 || other[2] < 0;
    return inside && (ends == 1 || (above && below));
}

/* Step 4: does f[i] meet side k of the other elsewhere than in its ends, without having
   that side? */
static int side_is_met(pair_crossing *c, int i, int k)
{
    int at_a = c->of[!i][k];
    int at_b = c->of[!i][(k + 1) % 3];
    if (at_a == 0 && at_b == 0) {
        return flat_side_is_met(c->f[!i], c->f[i], k);
    }
    int left = 0;
    int right = 0;
    for (int j = 0; j < 3 && at_a == -at_b && !(left && right); j++) {
        int sign = cross_sign(c, i, j, k);
        left |= sign > 0;
        right |= sign < 0;
    }
    return at_a == -at_b && !(left && right);
}

/* Steps 3 and 4. */
static void meet_across(pair_crossing *c, lrcsi_pair_result *result)
{
    int meets[2];
    for (int i = 0; i < 2; i++) {
        meets[i] = cut_meets(c, i);
        if (meets[i] < 0) {
            return;
        }
    }
    for (int i = 0; i < 2; i++) { /* how f[i] meets the other */
        result->kind[i] = meets[i] ? LRCSI_INTERSECTION_CROSS : LRCSI_INTERSECTION_NONE;
        result->met[i] =
            meets[i] || side_is_met(c, i, 0) || side_is_met(c, i, 1) || side_is_met(c, i, 2);
    }
}

int lrcsi_pair_meet(const lrcsi_pair_facet *f, lrcsi_pair_facet *t, lrcsi_pair_result *result)
{
    int of_t[3];
    int of_f[3];
    *result = (lrcsi_pair_result){{LRCSI_INTERSECTION_NONE, LRCSI_INTERSECTION_NONE}, {0, 0}};
    of_t[0] = rounded_side(f, t->x[0]);
    int flat =
        of_t[0] == PAIR_UNDECIDED; /* probably in one plane: lines are then more likely to decide */
    if (flat && lines_separate(f, t)) {
        return 0;
    }
    of_t[1] = rounded_side(f, t->x[1]);
    of_t[2] = rounded_side(f, t->x[2]);
    if (plane_separates(of_t)) {
        return 0;
    }
    lrcsi_pair_plane(t);
    for (int k = 0; k < 3; k++) {
        of_f[k] = rounded_side(t, f->x[k]);
    }
    if (plane_separates(of_f) || (!flat && lines_separate(f, t))) {
        return 0;
    }
    int on_f = exact_sides(f, t, of_t);
    if (!on_f && plane_separates(of_t)) {
        return 0;
    }
    if (of_t[0] == 0 && of_t[1] == 0 && of_t[2] == 0) {
        meet_flat(f, t, result);
    } else {
        int on_t = exact_sides(t, f, of_f);
        if (!on_t && plane_separates(of_f)) {
            return 0;
        }
        pair_crossing c = {{t, f},
                           {of_t, of_f},
                           {{PAIR_UNDECIDED, PAIR_UNDECIDED, PAIR_UNDECIDED},
                            {PAIR_UNDECIDED, PAIR_UNDECIDED, PAIR_UNDECIDED},
                            {PAIR_UNDECIDED, PAIR_UNDECIDED, PAIR_UNDECIDED}}};
        meet_across(&c, result);
    }
    return result->met[0] || result->met[1];
}

int lrcsi_intersection_pair(const lrcs_point *vertex, lrcs_facet facet, lrcs_facet other)
{
    lrcsi_pair_facet f;
    lrcsi_pair_facet t;
    for (int k = 0; k < 3; k++) {
        f.x[k] = vertex[facet.corner[k]].x;
        t.x[k] = vertex[other.corner[k]].x;
    }
    for (int i = 0; i < 9; i++) { /* corners in one place are one corner */
        const double *a = f.x[i / 3];
        const double *b = t.x[i % 3];
        if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2]) {
            t.x[i % 3] = a;
        }
    }
    lrcsi_pair_result result;
    lrcsi_pair_plane(&f);
    lrcsi_pair_meet(&f, &t, &result);
    return result.kind[0];
}

/* Is p on the segment a b, which is longer than 0, and not at its ends? */
static int is_inside_segment(const double *a, const double *b, const double *p)
{
    int at_end = 0;
    for (int k = 0; k < 3; k++) {
        double low = a[k] < b[k] ? a[k] : b[k];
        double high = a[k] < b[k] ? b[k] : a[k];
        if (p[k] < low || p[k] > high) {
            return 0;
        }
        at_end |= low != high && (p[k] == low || p[k] == high);
    }
    return !at_end && lrcsi_exact_collinear(a, b, p);
}

/* Does a corner of t lie inside a side of f? */
static int corner_on_side(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t)
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            if (is_inside_segment(f->x[k], f->x[(k + 1) % 3], t->x[i])) {
                return 1;
            }
        }
    }
    return 0;
}

int lrcsi_pair_on_side(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t)
{
    return corner_on_side(f, t) || corner_on_side(t, f);
}
