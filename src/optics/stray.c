/* SPDX-License-Identifier: MIT */
/* How far F = f_r cos^2 strays over the normals of a curved patch from its value at the facet's
   normal: the proved tessellation error of one facet. It knows the patch by four numbers only.

   On the sphere of normals F(n) = G(theta), theta the angle between n and s_hat. Along the geodesic
   from the facet's normal by the turn vector t
       F = F_i + grad F_i . t + R,  |R| <= |t|^2/2 sup |Hess F|,
   the eigenvalues of the Hessian being G'' and cot(theta) G'; G is once continuously
   differentiable, also across 90 deg where it becomes 0, and its second derivative is bounded,
   which is all that this needs. Integrated over the patch, per unit of facet area, with the numbers
   of lrcs_curvature (a = area_error) and each supremum taken over angles within `turn` of theta_i:
       second   a F_i + lean |G'_i| + spread^2/2 sup max(|G''|, |cot G'|)
       first    a F_i + sqrt(1 + a) spread sup |G'|        (Cauchy-Schwarz on the integral of |t|)
       range    a F_i + (1 + a) max(sup G - F_i, F_i)      (inf G >= 0)
   and the least of the three holds. At single points |F - F_i| is at most turn sup |G'|, and at
   most max(sup G - F_i, F_i). Over any part of the patch h = F - F_i integrates to at most the
   integral of its positive part, or of its negative one: with h = g . t + R, either is within (Int
   |g . t| + |Int g . t|)/2 + Int |R|, that is |G'_i| (sqrt(1 + a) spread + lean)/2 + spread^2/2 sup
   of the bend. Where both sides of a surface reflect, F continues as G(180 deg - theta) beyond 90
   deg: once continuously differentiable there too, with the same suprema, so that each bound holds
   also where some points beyond 90 deg count and others do not.

   With u = tan^2 theta, w = 1 + u, E = exp(-u/s^2), nu = m + 2:
       glint/A    G = w^2 E                              G' = 2 sqrt(u) (2 w^2 - w^3/s^2) E
           cot G' = (4 w^2 - 2 w^3/s^2) E
           G'' = (4 w^3 + 16 u w^2 + 4 u w^4/s^4 - (2 w^4 + 20 u w^3)/s^2) E
       diffuse/B  G = w^(-nu/2)   G' = -nu sqrt(u) w^(-nu/2)   cot G' = -nu w^(-nu/2)
           G'' = -nu w^(-nu/2) + nu (nu - 1) u w^(-nu/2)
   A difference of positive terms is at most the greater of their sums. Each glint term
   u^a w^b E / s^(2c) is unimodal in u (its logarithm is concave in u, E included), so its supremum
   over an interval is its value at the clamped peak, the root of u^2 + (1 - (a + b) s^2) u = a s^2.
   Terms are evaluated as the exponential of a sum of logarithms, none of them above 1e4 where the
   result is in double range: relative error below 1e4 * 2^-50, which MARGIN covers. */
#include "optics/reflect.h"

#include <math.h>

#define HALF_PI_BELOW 1.57079632679489655800 /* the double below pi/2 */
#define STRAY_UNIT    0x1p-53
#define STRAY_MARGIN  (1.0 + 1e-10)
#define EXPONENT_LOW  (-700.0)
#define STRAY_TINY    0x1p-1009 /* above e^-700: stands for what is below it */
#define SLOPE_HUGE    1e75      /* s beyond: peaks lie past every finite u met here */

/* An interval of u = tan^2(theta); high may be infinite. */
typedef struct tan2_range {
    double low, high;
} tan2_range;

/* Bounds on |.| of G and its derivatives, at the facet's normal and over the patch. */
typedef struct stray_size {
    double value, slope;                 /* at the facet's normal */
    double value_most, slope_most, bend; /* over the patch */
} stray_size;

/* An upper bound on e^x, but for the margin. */
static double exp_above(double x)
{
    return x < EXPONENT_LOW ? STRAY_TINY : exp(x);
}

/* 0 times infinity is 0 here. */
static double times(double a, double b)
{
    return a > 0.0 && b > 0.0 ? a * b : 0.0;
}

/* u^a w^b exp(-u/s^2) / s^(2c) at a finite u. */
static double glint_term(double a, double b, double c, double s, double u)
{
    if (u == 0.0 && a > 0.0) {
        return 0.0;
    }
    double x = b * log1p(u) - u / s / s - 2.0 * c * log(s);
    return exp_above(a > 0.0 ? x + a * log(u) : x);
}

/* Its supremum over a range. */
static double glint_sup(double a, double b, double c, double s, const tan2_range *range)
{
    double peak = HUGE_VAL;
    if (s < SLOPE_HUGE) {
        double s2 = s * s;
        double beta = (a + b) * s2 - 1.0;
        double root = sqrt(beta * beta + 4.0 * a * s2);
        peak = beta > 0.0 ? 0.5 * (beta + root) : a > 0.0 ? 2.0 * a * s2 / (root - beta) : 0.0;
    }
    double u = fmin(fmax(peak, range->low), range->high);
    return isfinite(u) ? glint_term(a, b, c, s, u) : HUGE_VAL;
}

static stray_size glint_size(double s, int front, double tan2, const tan2_range *range)
{
    stray_size size = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (front && isfinite(tan2)) {
        double up = 4.0 * glint_term(0.5, 2.0, 0.0, s, tan2);
        double down = 2.0 * glint_term(0.5, 3.0, 1.0, s, tan2);
        double more = fmax(up, down);
        size.value = glint_term(0.0, 2.0, 0.0, s, tan2);
        size.slope = isfinite(more) ? fabs(up - down) + 1e-10 * more : more;
    }
    size.value_most = glint_sup(0.0, 2.0, 0.0, s, range);
    size.slope_most =
        fmax(4.0 * glint_sup(0.5, 2.0, 0.0, s, range), 2.0 * glint_sup(0.5, 3.0, 1.0, s, range));
    double level = fmax(4.0 * size.value_most, 2.0 * glint_sup(0.0, 3.0, 1.0, s, range));
    double up = 4.0 * glint_sup(0.0, 3.0, 0.0, s, range) +
                16.0 * glint_sup(1.0, 2.0, 0.0, s, range) +
                4.0 * glint_sup(1.0, 4.0, 2.0, s, range);
    double down =
        2.0 * glint_sup(0.0, 4.0, 1.0, s, range) + 20.0 * glint_sup(1.0, 3.0, 1.0, s, range);
    size.bend = fmax(level, fmax(up, down));
    return size;
}

/* u^a w^(-nu/2) at its supremum, its peak at u = a / (nu/2 - a). */
static double diffuse_sup(double a, double nu, const tan2_range *range)
{
    double u = range->low;
    if (a > 0.0) {
        u = fmin(fmax(a / (0.5 * nu - a), range->low), range->high);
    }
    if (u == 0.0 && a > 0.0) {
        return 0.0;
    }
    if (!isfinite(u)) {
        return 1.0; /* a <= 1 <= nu/2: u^a <= w^(nu/2) */
    }
    return exp_above((a > 0.0 ? a * log(u) : 0.0) - 0.5 * nu * log1p(u));
}

static stray_size diffuse_size(double m, int front, double tan2, const tan2_range *range)
{
    double nu = m + 2.0;
    stray_size size = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (front && isfinite(tan2)) {
        tan2_range here = {tan2, tan2};
        size.value = diffuse_sup(0.0, nu, &here);
        size.slope = nu * diffuse_sup(0.5, nu, &here);
    }
    size.value_most = diffuse_sup(0.0, nu, range);
    size.slope_most = nu * diffuse_sup(0.5, nu, range);
    size.bend = fmax(nu * size.value_most, nu * (nu - 1.0) * diffuse_sup(1.0, nu, range));
    return size;
}

static void size_add(stray_size *sum, double amplitude, const stray_size *part)
{
    sum->value += times(amplitude, part->value);
    sum->slope += times(amplitude, part->slope);
    sum->value_most += times(amplitude, part->value_most);
    sum->slope_most += times(amplitude, part->slope_most);
    sum->bend += times(amplitude, part->bend);
}

/* tan^2 over the angles within `turn` of theta that face the laser; 0 where none does. */
static int range_around(double theta, double turn, tan2_range *range)
{
    double slack = 8.0 * STRAY_UNIT * (theta + turn);
    double low = theta - turn - slack;
    double high = theta + turn + slack;
    if (low > HALF_PI_BELOW) {
        return 0;
    }
    double near = low > 0.0 ? tan(low) : 0.0;
    double far = high < HALF_PI_BELOW ? tan(high) : HUGE_VAL;
    range->low = near * near * (1.0 - 8.0 * STRAY_UNIT);
    range->high = far * far * (1.0 + 8.0 * STRAY_UNIT);
    return 1;
}

/* The least of the three bounds, and what holds of every single point of the patch. */
static lrcsi_stray stray_of(const stray_size *all, const lrcs_curvature *c)
{
    double second = times(c->lean, all->slope) + times(0.5 * c->spread * c->spread, all->bend);
    double first = times(c->spread * sqrt(1.0 + c->area_error), all->slope_most);
    double range = fmax(all->value_most - all->value, all->value);
    double slope = times(c->turn, all->slope_most);
    double half = 0.5 * times(c->spread * sqrt(1.0 + c->area_error) + c->lean, all->slope) +
                  times(0.5 * c->spread * c->spread, all->bend);
    double least = fmin(second, first);
    double apart = slope;
    if (isfinite(all->value_most)) {
        least = fmin(least, times(1.0 + c->area_error, range));
        apart = fmin(slope, range);
    }
    return (lrcsi_stray){(times(c->area_error, all->value) + least) * STRAY_MARGIN,
                         apart * STRAY_MARGIN,
                         fmin(half, times(1.0 + c->area_error, apart)) * STRAY_MARGIN,
                         all->value * STRAY_MARGIN, all->value_most * STRAY_MARGIN};
}

lrcsi_stray lrcsi_stray_make(const lrcs_brdf *brdf, double cos_theta, double tan2,
                             const lrcs_curvature *curvature)
{
    int front = cos_theta > 0.0;
    double angle = atan(sqrt(tan2));
    tan2_range range;
    if (!range_around(front ? angle : 2.0 * HALF_PI_BELOW - angle, curvature->turn, &range)) {
        return (lrcsi_stray){0.0, 0.0, 0.0, 0.0, 0.0};
    }
    stray_size all = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (brdf->A > 0.0) {
        stray_size part = glint_size(brdf->s, front, tan2, &range);
        size_add(&all, brdf->A, &part);
    }
    if (brdf->B > 0.0) {
        stray_size part = diffuse_size(brdf->m, front, tan2, &range);
        size_add(&all, brdf->B, &part);
    }
    return stray_of(&all, curvature);
}

double lrcsi_reflect_stray(const lrcs_brdf *brdf, double cos_theta, double tan2,
                           const lrcs_curvature *curvature)
{
    const lrcs_curvature *c = curvature;
    if (c->turn == 0.0 && c->area_error == 0.0 && c->lean == 0.0 && c->spread == 0.0) {
        return 0.0;
    }
    return lrcsi_stray_make(brdf, cos_theta, tan2, curvature).whole;
}

/* f_r cos is w^(5/2) E, of the family of glint terms, and w^(-(m+1)/2), which only falls. */
lrcsi_reflection lrcsi_reflect_most(const lrcs_brdf *brdf, double theta, double turn)
{
    lrcsi_reflection most = {0.0, 0.0, 0.0};
    tan2_range range;
    if (!range_around(theta, turn, &range)) {
        return most;
    }
    if (brdf->A > 0.0) {
        most.glint = brdf->A * glint_sup(0.0, 2.5, 0.0, brdf->s, &range) * STRAY_MARGIN;
    }
    if (brdf->B > 0.0) {
        most.diffuse = brdf->B * diffuse_sup(0.0, brdf->m + 1.0, &range) * STRAY_MARGIN;
    }
    return most;
}
