/* SPDX-License-Identifier: MIT */
/* Signs of 3 x 3 determinants of differences of points, and accurate normals and heights of slivers
   and of facets near grazing incidence. No tolerances. A floating-point value with a proved error
   bound decides almost every call; the others are evaluated without error in expansion arithmetic
   (Priest 1991; Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
   geometric predicates"): sums of doubles that do not overlap, smallest first, zeros left out, so
   that the sign of the whole is that of the last term.

   Filter. Let u = 2^-53 and let each rounding multiply by (1 + e), |e| <= u. The three vectors are
   differences of doubles (one rounding each) or given. A term d_k (u_i v_j - u_j v_i) then carries
   at most 3 roundings in u, v, d, 1 in the product u_i v_j, 1 in the difference, 1 in the product
   with d_k, and 2 in the sum of the three terms: 8 in all, so that
       |computed - det| <= ((1 + u)^8 - 1) P <= 8.001 u P,
   P = sum |d_k| (|u_i v_j| + |u_j v_i|) of the true vectors. P is computed from the same rounded
   quantities without cancellation, hence is at least (1 - u)^8 P; 10 u times it, itself rounded,
   is above the error. A 2 x 2 minor has 4 roundings; 10 u suffices for it too.

   Underflow and overflow. With coordinates below 2^333 (1e100 is) differences stay below 2^334 and
   sums of triple products below 2^1004. With coordinates zero or above 2^-300, each is a multiple
   of 2^-352, every triple product a multiple of 2^-1056, and even the errors of products are
   representable. */
#include "base/exact.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/vec3.h"

/* 10 u */
#define EXACT_FILTER (10.0 * LRCSI_U)

#define EXACT_UNDECIDED 2

/* The largest numbers of terms: a difference 2, a product of two of them 8, a 2 x 2 minor 16, its
   product with a third 64, the determinant 192. */
enum { EXACT_PAIR = 8, EXACT_MINOR = 16, EXACT_TERM = 64, EXACT_DET = 192 };

/* h = e + f, en + fn terms at most (Shewchuk's fast expansion sum, with zeros left out). */
static int expansion_sum(const double *e, int en, const double *f, int fn, double *h)
{
    int i = 0;
    int j = 0;
    int n = 0;
    double q = 0.0;
    while (i < en || j < fn) {
        int from_e = j == fn || (i < en && fabs(e[i]) <= fabs(f[j]));
        lrcsi_dd s = lrcsi_dd_two_sum(q, from_e ? e[i++] : f[j++]);
        if (s.lo != 0.0) {
            h[n++] = s.lo;
        }
        q = s.hi;
    }
    if (q != 0.0) {
        h[n++] = q;
    }
    return n;
}

/* h = b e, 2 n terms at most (Shewchuk's scale expansion, with zeros left out). */
static int expansion_scale(const double *e, int n, double b, double *h)
{
    int m = 0;
    double q = 0.0;
    for (int i = 0; i < n; i++) {
        lrcsi_dd p = lrcsi_dd_two_product(e[i], b);
        lrcsi_dd s = lrcsi_dd_two_sum(q, p.lo);
        lrcsi_dd t = lrcsi_dd_quick_sum(p.hi, s.hi);
        if (s.lo != 0.0) {
            h[m++] = s.lo;
        }
        if (t.lo != 0.0) {
            h[m++] = t.lo;
        }
        q = t.hi;
    }
    if (q != 0.0) {
        h[m++] = q;
    }
    return m;
}

/* h = e (b.hi + b.lo), for n up to EXACT_MINOR; 4 n terms at most. */
static int expansion_times(const double *e, int n, lrcsi_dd b, double *h)
{
    if (b.lo == 0.0) {
        return expansion_scale(e, n, b.hi, h);
    }
    double low[2 * EXACT_MINOR];
    double high[2 * EXACT_MINOR];
    int ln = expansion_scale(e, n, b.lo, low);
    int hn = expansion_scale(e, n, b.hi, high);
    return expansion_sum(low, ln, high, hn, h);
}

/* h = a b, EXACT_PAIR terms at most. */
static int pair_product(lrcsi_dd a, lrcsi_dd b, double *h)
{
    double e[2];
    int n = 0;
    if (a.lo != 0.0) {
        e[n++] = a.lo;
    }
    if (a.hi != 0.0) {
        e[n++] = a.hi;
    }
    return expansion_times(e, n, b, h);
}

/* h = component k of p x q, EXACT_MINOR terms at most. */
static int expansion_cross(const lrcsi_dd p[3], const lrcsi_dd q[3], int k, double *h)
{
    int i = (k + 1) % 3;
    int j = (k + 2) % 3;
    double plus[EXACT_PAIR];
    double minus[EXACT_PAIR];
    int pn = pair_product(p[i], q[j], plus);
    int mn = pair_product(p[j], lrcsi_dd_negate(q[i]), minus);
    return expansion_sum(plus, pn, minus, mn, h);
}

/* h = component k of p x q times component k of r, EXACT_TERM terms at most. */
static int det_term(const lrcsi_dd p[3], const lrcsi_dd q[3], const lrcsi_dd r[3], int k, double *h)
{
    double minor[EXACT_MINOR];
    int n = expansion_cross(p, q, k, minor);
    return expansion_times(minor, n, r[k], h);
}

/* all = p x q . r, without error, EXACT_DET terms at most. */
static int expansion_det(const lrcsi_dd p[3], const lrcsi_dd q[3], const lrcsi_dd r[3], double *all)
{
    double one[EXACT_TERM];
    double other[EXACT_TERM];
    double two[2 * EXACT_TERM];
    int n = det_term(p, q, r, 0, one);
    int m = det_term(p, q, r, 1, other);
    int both = expansion_sum(one, n, other, m, two);
    m = det_term(p, q, r, 2, other);
    return expansion_sum(two, both, other, m, all);
}

static int exact_det_sign(const lrcsi_dd p[3], const lrcsi_dd q[3], const lrcsi_dd r[3])
{
    double all[EXACT_DET];
    int n = expansion_det(p, q, r, all);
    return n == 0 ? 0 : all[n - 1] > 0.0 ? 1 : -1;
}

/* Sign of p x q . r if the filter proves it, else EXACT_UNDECIDED. */
static int filtered_det_sign(const double p[3], const double q[3], const double r[3])
{
    double xy = p[0] * q[1];
    double yx = p[1] * q[0];
    double yz = p[1] * q[2];
    double zy = p[2] * q[1];
    double zx = p[2] * q[0];
    double xz = p[0] * q[2];
    double det = ((yz - zy) * r[0] + (zx - xz) * r[1]) + (xy - yx) * r[2];
    double sum = ((fabs(yz) + fabs(zy)) * fabs(r[0]) + (fabs(zx) + fabs(xz)) * fabs(r[1])) +
                 (fabs(xy) + fabs(yx)) * fabs(r[2]);
    double bound = EXACT_FILTER * sum;
    if (det > bound) {
        return 1;
    }
    if (det < -bound) {
        return -1;
    }
    return sum == 0.0 ? 0 : EXACT_UNDECIDED;
}

static int same_point(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static void exact_difference(const double a[3], const double b[3], lrcsi_dd d[3])
{
    for (int k = 0; k < 3; k++) {
        d[k] = lrcsi_dd_two_sum(b[k], -a[k]);
    }
}

int lrcsi_exact_orient(const double a[3], const double b[3], const double c[3], const double d[3])
{
    double p[3];
    double q[3];
    lrcsi_vec3_between(a, b, p);
    lrcsi_vec3_between(a, c, q);
    int sign = filtered_det_sign(p, q, d);
    if (sign != EXACT_UNDECIDED) {
        return sign;
    }
    if (same_point(b, c)) {
        return 0;
    }
    lrcsi_dd pp[3];
    lrcsi_dd qq[3];
    exact_difference(a, b, pp);
    exact_difference(a, c, qq);
    const lrcsi_dd rr[3] = {{d[0], 0.0}, {d[1], 0.0}, {d[2], 0.0}};
    return exact_det_sign(pp, qq, rr);
}

int lrcsi_exact_side(const double a[3], const double b[3], const double c[3], const double p[3])
{
    double ab[3];
    double ac[3];
    double ap[3];
    lrcsi_vec3_between(a, b, ab);
    lrcsi_vec3_between(a, c, ac);
    lrcsi_vec3_between(a, p, ap);
    int sign = filtered_det_sign(ab, ac, ap);
    if (sign != EXACT_UNDECIDED) {
        return sign;
    }
    if (same_point(b, c) || same_point(b, p) || same_point(c, p)) {
        return 0;
    }
    lrcsi_dd bb[3];
    lrcsi_dd cc[3];
    lrcsi_dd pp[3];
    exact_difference(a, b, bb);
    exact_difference(a, c, cc);
    exact_difference(a, p, pp);
    return exact_det_sign(bb, cc, pp);
}

/* 1 if the filter proves that some component of p x q is not zero. */
static int proved_not_parallel(const double p[3], const double q[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        double ij = p[i] * q[j];
        double ji = p[j] * q[i];
        if (fabs(ij - ji) > EXACT_FILTER * (fabs(ij) + fabs(ji))) {
            return 1;
        }
    }
    return 0;
}

int lrcsi_exact_collinear(const double a[3], const double b[3], const double c[3])
{
    double p[3];
    double q[3];
    lrcsi_vec3_between(a, b, p);
    lrcsi_vec3_between(a, c, q);
    if (proved_not_parallel(p, q)) {
        return 0;
    }
    if (same_point(a, b) || same_point(b, c) || same_point(c, a)) {
        return 1;
    }
    lrcsi_dd pp[3];
    lrcsi_dd qq[3];
    exact_difference(a, b, pp);
    exact_difference(a, c, qq);
    for (int k = 0; k < 3; k++) {
        double minor[EXACT_MINOR];
        if (expansion_cross(pp, qq, k, minor) != 0) {
            return 0;
        }
    }
    return 1;
}

/* The sum of an expansion. Its terms, smallest first, do not overlap, none is adjacent to two
   others, and two that are adjacent to each other are powers of two (Shewchuk's strongly
   nonoverlapping). So each is at most half of the next, each partial sum is at most twice its last
   term, all partial sums together are at most four times the largest term, and the total is at
   least a quarter of that. Additions of 3 u^2 each make 48 u^2. */
static lrcsi_dd expansion_value(const double *e, int n)
{
    lrcsi_dd sum = {0.0, 0.0};
    for (int i = 0; i < n; i++) {
        sum = lrcsi_dd_add(sum, (lrcsi_dd){e[i], 0.0});
    }
    return sum;
}

void lrcsi_exact_normal(const double a[3], const double b[3], const double c[3], double high[3],
                        double low[3])
{
    lrcsi_dd pp[3];
    lrcsi_dd qq[3];
    exact_difference(a, b, pp);
    exact_difference(a, c, qq);
    for (int k = 0; k < 3; k++) {
        double minor[EXACT_MINOR];
        int n = expansion_cross(pp, qq, k, minor);
        lrcsi_dd sum = expansion_value(minor, n);
        high[k] = sum.hi;
        low[k] = sum.lo;
    }
}

lrcsi_dd lrcsi_exact_height(const double a[3], const double b[3], const double c[3],
                            const double p[3])
{
    lrcsi_dd bb[3];
    lrcsi_dd cc[3];
    lrcsi_dd pp[3];
    double all[EXACT_DET];
    exact_difference(a, b, bb);
    exact_difference(a, c, cc);
    exact_difference(a, p, pp);
    return expansion_value(all, expansion_det(bb, cc, pp, all));
}

double lrcsi_exact_dot(const double a[3], const double b[3], const double c[3], const double d[3])
{
    lrcsi_dd pp[3];
    lrcsi_dd qq[3];
    double all[EXACT_DET];
    exact_difference(a, b, pp);
    exact_difference(a, c, qq);
    const lrcsi_dd rr[3] = {{d[0], 0.0}, {d[1], 0.0}, {d[2], 0.0}};
    return lrcsi_dd_value(expansion_value(all, expansion_det(pp, qq, rr, all)));
}
