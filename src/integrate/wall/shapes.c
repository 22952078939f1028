/* SPDX-License-Identifier: MIT */
/* Evaluates the closed form of a placed shape (optics/closed.h), in its own frame and scale, and
   bounds the errors of these. view/clear.h proves which shapes may be evaluated like this.

   Error of the direction to the laser in the shape's frame. The direction is exact by definition,
   and the axes have errors below 2^-97: angles have errors of at most eta = 2^-95 rad, or none
   where the axes are exact. With t = tan(theta), d ln F / d theta is 4 t - 2 t (1 + t^2) / s^2 for
   the glint. Up to t = 64 s its absolute value is at most 64 s (4 + 2 (1 + 4096 s^2) / s^2), and
   that times eta is the relative error of the glint at such angles; at larger angles F is below
   exp(-4095) of its peak, and underflows. F of the diffuse term changes by at most (m + 2) B eta
   per unit of surface. */
#include "integrate/wall/shapes.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "optics/closed.h"

#define AXES_ERR 0x1p-95

/* Adds the error that eta causes. */
static void add_axis_error(const lrcs_shape *shape, const lrcs_brdf *brdf,
                           lrcsi_term_integrals *amount)
{
    double s = brdf->s;
    double radius = fmax(shape->radius, shape->radius2);
    double surface = 4 * LRCS_PI * radius * (radius + lrcsi_closed_length(shape)); /* at most */
    if (amount->value[LRCSI_GLINT] > 0) {
        double flank = 64 * s * (4 + 2 * (1 + 4096 * s * s) / s / s);
        amount->error[LRCSI_GLINT] += 2 * AXES_ERR * flank * amount->value[LRCSI_GLINT];
    }
    amount->error[LRCSI_DIFFUSE] += 2 * AXES_ERR * (brdf->m + 2) * brdf->B * surface;
}

/* The direction to the laser in the shape's frame. */
static void shape_direction(const lrcsi_view *view, const lrcs_part *placed, lrcsi_dd direction[3])
{
    for (int i = 0; i < 3; i++) {
        direction[i] = (lrcsi_dd){0, 0};
        for (int k = 0; k < 3; k++) {
            lrcsi_dd axis = {placed->axis[i][k], placed->axis_low[i][k]};
            direction[i] = lrcsi_dd_add(direction[i], lrcsi_dd_scale(axis, view->direction[k]));
        }
    }
}

/* What the slab may hide is at most its area times the largest value of F. The glint
   (1 + u)^2 exp(-u / s^2) is at most q^2 for q = 2 s^2 > 1, else 1. */
lrcsi_shape_terms lrcsi_shape_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t part, double slab)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *placed = &p->scene->part[part];
    lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, placed->first_facet));
    double unit = ldexp(placed->unit, -p->exponent);
    lrcsi_dd direction[3];
    shape_direction(view, placed, direction);
    lrcsi_term_integrals sum = {{0, 0}, {0, 0}};
    double silhouette = 0;
    if (lrcsi_closed_shape(&placed->shape, &brdf, direction, &sum, &silhouette) != LRCS_OK) {
        sum.error[LRCSI_GLINT] = HUGE_VAL; /* never: pose and shape have been checked */
    }
    if (!placed->axis_exact) {
        add_axis_error(&placed->shape, &brdf, &sum);
    }
    lrcsi_closed_scale(&sum, unit * unit, 1);
    lrcsi_closed_scale(&sum, LRCS_FOUR_PI, 1);
    double q = 2 * brdf.s * brdf.s;
    double bound = (brdf.A > 0 ? brdf.A * (q <= 1 ? 1 : q * q) : 0) + brdf.B;
    return (lrcsi_shape_terms){.glint = sum.value[LRCSI_GLINT],
                               .diffuse = sum.value[LRCSI_DIFFUSE],
                               .rounding = sum.error[LRCSI_GLINT] + sum.error[LRCSI_DIFFUSE],
                               .visibility = LRCS_FOUR_PI * LRCSI_OUTWARD_MICRO * slab * bound,
                               .silhouette = silhouette * unit * unit};
}

/* --- derivatives ------------------------------------------------------------------------------ */

/* The integrals of both terms over the shape, at amplitudes of 1. */
static void unit_terms(const lrcs_shape *shape, const lrcsi_dd direction[3], double s, double m,
                       double out[2])
{
    const lrcs_brdf brdf = {s > 0 ? 1 : 0, 1, s, m};
    lrcsi_term_integrals sum = {{0, 0}, {0, 0}};
    double silhouette = 0;
    (void)lrcsi_closed_shape(shape, &brdf, direction, &sum, &silhouette); /* checked before */
    out[0] = sum.value[LRCSI_GLINT];
    out[1] = sum.value[LRCSI_DIFFUSE];
}

/* The logarithmic slope |change / value| / step of a term that is above 0. Its inverse is the step
   in which the term changes by about as much as its value; it sets the step of a difference. */
static double term_slope(double value, double moved, double step)
{
    return fabs(moved - value) / value / step;
}

/* The derivative of the glint in s: a central difference of order 8 at steps h s,
   f' = sum c_k (f(s + k h s) - f(s - k h s)) / (h s) with an error of h^8 f(9) / 630. Where
   log f has slope L in log s, h = 0.05 / (1 + L) leaves some (0.05)^8 of f', and the closed form's
   own rounding over h L / (1 + L) some 1e-12. */
static double shape_glint_s(const lrcs_shape *shape, const lrcsi_dd direction[3], double s,
                            double m, double value)
{
    static const double c[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double high[2];
    double low[2];
    unit_terms(shape, direction, s * (1 + 1e-4), m, high);
    double h = 0.05 / (1 + term_slope(value, high[0], 1e-4));
    double slope = 0;
    for (int k = 1; k <= 4; k++) {
        unit_terms(shape, direction, s * (1 + k * h), m, high);
        unit_terms(shape, direction, s * (1 - k * h), m, low);
        slope += c[k - 1] * (high[0] - low[0]);
    }
    return slope / h / s;
}

/* The derivative of the diffuse term in m: a forward difference of order 8, because m may be 0,
   with an error of h^8 f(9) / 9, below 1e-10 of f'; rounding adds some 1e-12 of f. */
static double shape_diffuse_m(const lrcs_shape *shape, const lrcsi_dd direction[3], double s,
                              double m, double value)
{
    static const double c[8] = {8, -14, 56.0 / 3, -35.0 / 2, 56.0 / 5, -14.0 / 3, 8.0 / 7, -0.125};
    double at[2];
    unit_terms(shape, direction, s, m + 1e-3, at);
    double h = 0.05 / (1 + term_slope(value, at[1], 1e-3));
    double slope = 0;
    for (int k = 1; k <= 8; k++) { /* the weight of f(m) makes the sum of all nine 0 */
        unit_terms(shape, direction, s, m + k * h, at);
        slope += c[k - 1] * (at[1] - value);
    }
    return slope / h;
}

lrcsi_unit_response lrcsi_shape_response_make(const lrcsi_view *view, uint32_t part,
                                              const lrcs_brdf *brdf)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *placed = &p->scene->part[part];
    double unit = ldexp(placed->unit, -p->exponent);
    double scale = LRCS_FOUR_PI * unit * unit;
    double s = brdf->s >= 0x1p-333 && brdf->s <= 0x1p333 ? brdf->s : 0;
    double term[2];
    lrcsi_dd direction[3];
    shape_direction(view, placed, direction);
    unit_terms(&placed->shape, direction, s, brdf->m, term);
    lrcsi_unit_response out = {scale * term[0], scale * term[1], 0, 0};
    if (term[0] > 0) {
        out.glint_s = scale * shape_glint_s(&placed->shape, direction, s, brdf->m, term[0]);
    }
    if (term[1] > 0) {
        out.diffuse_m = scale * shape_diffuse_m(&placed->shape, direction, s, brdf->m, term[1]);
    }
    return out;
}
