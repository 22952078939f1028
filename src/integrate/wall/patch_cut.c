/* SPDX-License-Identifier: MIT */
/* Divides a piece along the end of the shadow of a rim, the curve E = 0, and integrates over what
   is visible of it, E > 0. It does not decide which pieces are halved before
   (integrate/wall/patch.c).

   The piece is a rectangle in (alpha, phi). Let v be the variable, and u the other one, for which
   |E_v| times the width of the rectangle is larger, with E_v of its middle, and let E_v be nowhere
   0 in the rectangle. Then there is at most one v with E = 0 for each u: v_c(u). It enters and
   leaves the rectangle through the sides of constant v where E of these is 0: if E_u is nowhere 0
   in the rectangle, E has different signs at the ends of such a side, and has one root between
   them; if E has no root on either side, there is nothing to find. In any other case the piece is
   to be halved. The roots divide the rectangle into strips between two values of u. A strip is
   visible or not, or it is visible between a side v_0 of constant v and v_c(u). There the integral
   of F is that over s in 0 .. 1 of
       F(u, v_0 + s (v_c(u) - v_0)) (v_c(u) - v_0) du.

   Remainder. For real u the rule in s is one in v over a part of the strip's interval of v, which
   begins at one of its ends: all complex points that the bound for that rule refers to
   (integrate/wall/mean_rule.h) belong to those of the whole interval. For the rule in u, let u be
   complex, |u - u_m| <= x, with the middle u_m of the strip and v_m = v_c(u_m). With the bound R on
   the second-order terms of E, if
       |E_u| x + R(x, y) + err < |E_v| y,
   then E(u, v) and E_v (v - v_m) have, by Rouche's theorem, the same number of roots with |v - v_m|
   < y: one. So v_c(u) is an analytic function, within y of v_m. It is then within y of the strip's
   interval, and so are all points between v_0 and it.

   Rounding. E has an error of at most err: a root, a side that is taken for visible, and the points
   up to which a strip reaches are off by at most 2 err / |E_v| in v. F times that is an error. */
#include "integrate/wall/patch_cut.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"
#include "base/sort.h"

/* A root is found by at most so many steps of Newton's method or bisections. */
#define ROOT_STEPS 80

/* A rectangle: its middle, and half its widths, in alpha (0) and phi (1). */
typedef struct rectangle {
    double middle[2], half[2];
} rectangle;

static rectangle rectangle_of(const lrcsi_patch_frame *f)
{
    return (rectangle){{f->alpha, f->phi}, {f->step, f->half}};
}

static lrcsi_patch_frame frame_of(const lrcsi_patch_frame *f, const rectangle *r)
{
    return lrcsi_patch_frame_part(f, r->middle[0], r->half[0], r->middle[1], r->half[1]);
}

static lrcsi_rim_value value_at(const lrcsi_patch_frame *f, int u, double at_u, double at_v)
{
    return u == 0 ? lrcsi_rim_shadow_at(f->shadow, at_u, at_v)
                  : lrcsi_rim_shadow_at(f->shadow, at_v, at_u);
}

int lrcsi_patch_cut_part(const lrcsi_patch_frame *f)
{
    const lrcsi_rim_value at = lrcsi_rim_shadow_at(f->shadow, f->alpha, f->phi);
    const double spread = fabs(at.slope[0]) * f->step + fabs(at.slope[1]) * f->half +
                          lrcsi_rim_shadow_second(f->shadow, f->step, f->half) + f->shadow->err;
    if (!f->shadow->lit || at.value < -spread) {
        return LRCSI_CUT_NOTHING;
    }
    return at.value > spread ? LRCSI_CUT_ALL : LRCSI_CUT_SOME;
}

/* A root of E in one variable, between two values at which it has different signs; the other
   variable, number u, is given. *found: is |E| at most twice its error there? */
static double root_between(const lrcsi_patch_frame *f, int u, double at_u, double low, double high,
                           int *found)
{
    const int rises = value_at(f, u, at_u, high).value > 0;
    double at = 0.5 * (low + high);
    *found = 0;
    for (int i = 0; i < ROOT_STEPS && !*found; i++) {
        const lrcsi_rim_value value = value_at(f, u, at_u, at);
        if ((value.value > 0) == rises) {
            high = at;
        } else {
            low = at;
        }
        const double next = at - value.value / value.slope[1 - u];
        *found = fabs(value.value) <= f->shadow->err;
        if (!*found) {
            at = next > low && next < high ? next : 0.5 * (low + high);
        }
    }
    return at;
}

/* The u at which the curve crosses a side of constant v. Returns their number, 0 or 1; -1 if the
   piece is to be halved. is_monotone: E_u is nowhere 0. */
static int side_crossing(const lrcsi_patch_frame *f, const rectangle *r, int u, double at_v,
                         int is_monotone, double *crossing)
{
    const double low = r->middle[u] - r->half[u];
    const double high = r->middle[u] + r->half[u];
    const int from = value_at(f, u, low, at_v).value > 0;
    const int to = value_at(f, u, high, at_v).value > 0;
    if (is_monotone && from != to) {
        int found;
        *crossing = root_between(f, 1 - u, at_v, low, high, &found);
        return found ? 1 : -1;
    }
    const lrcsi_rim_value middle = value_at(f, u, r->middle[u], at_v);
    const double x = u == 0 ? r->half[u] : 0;
    const double y = u == 0 ? 0 : r->half[u];
    const double spread = fabs(middle.slope[u]) * r->half[u] +
                          lrcsi_rim_shadow_second(f->shadow, x, y) + f->shadow->err;
    return is_monotone || fabs(middle.value) > spread ? 0 : -1;
}

/* The bounds y for the complex x = radius times the half width of a strip; infinite where none is
   found. at: E where u = u_m, v = v_m. */
static double bend_bound(const lrcsi_patch_frame *f, int u, const lrcsi_rim_value *at, double x)
{
    const double along = fabs(at->slope[u]) * x + 2 * f->shadow->err;
    const double slope = fabs(at->slope[1 - u]);
    double y = 1.01 * along / slope;
    for (int i = 0; i < 8; i++) {
        const double second = u == 0 ? lrcsi_rim_shadow_second(f->shadow, x, y)
                                     : lrcsi_rim_shadow_second(f->shadow, y, x);
        const double sum = (along + second) * LRCSI_OUTWARD_MICRO;
        if (sum < slope * y) {
            return y;
        }
        y = 1.05 * sum / slope;
        if (!(y < 1)) {
            break;
        }
    }
    return HUGE_VAL;
}

/* Adds the mean over a strip that is visible between the side v_0 and the curve. Returns the
   remainder of the rules. */
static double strip_add(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, const rectangle *strip,
                        int u, double v_0, double target, double fraction, lrcsi_patch *patch)
{
    const int v = 1 - u;
    const double low = strip->middle[v] - strip->half[v];
    const double high = strip->middle[v] + strip->half[v];
    double bend[LRCSI_PATCH_RADII];
    double error[2];
    int found;
    const double v_m = root_between(f, u, strip->middle[u], low, high, &found);
    const lrcsi_rim_value at = value_at(f, u, strip->middle[u], v_m);
    const double widest = bend_bound(f, u, &at, strip->half[u]);
    if (!found || !(widest < HUGE_VAL)) {
        return HUGE_VAL;
    }
    rectangle visible = *strip; /* smaller, but it contains all that is visible */
    const double end = v_0 < v_m ? lrcsi_min(high, v_m + widest) : lrcsi_max(low, v_m - widest);
    visible.middle[v] = 0.5 * (v_0 + end);
    visible.half[v] = 0.5 * fabs(end - v_0);
    const lrcsi_patch_frame part = frame_of(f, &visible);
    for (int i = 0; i < LRCSI_PATCH_RADII; i++) {
        bend[i] = bend_bound(f, u, &at, lrcsi_patch_radii[i] * strip->half[u]);
    }
    const lrcsi_mean_rule *across =
        lrcsi_patch_rule_choose(&part, brdf, v == 0, NULL, target, &error[0]);
    const lrcsi_mean_rule *along =
        lrcsi_patch_rule_choose(&part, brdf, u == 0, bend, target, &error[1]);
    double x[LRCSI_MEAN_RULE_POINTS];
    double weight_x[LRCSI_MEAN_RULE_POINTS];
    double s[LRCSI_MEAN_RULE_POINTS];
    double weight_s[LRCSI_MEAN_RULE_POINTS];
    const int columns = lrcsi_mean_rule_points(along, x, weight_x);
    const int rows = lrcsi_mean_rule_points(across, s, weight_s);
    for (int i = 0; i < columns; i++) {
        const double at_u = strip->middle[u] + x[i] * strip->half[u];
        const double v_c = root_between(f, u, at_u, low, high, &found);
        const double share = fraction * weight_x[i] * (fabs(v_c - v_0) / (2 * strip->half[v]));
        for (int k = 0; k < rows && found; k++) {
            const double at_v = v_0 + 0.5 * (1 + s[k]) * (v_c - v_0);
            found = lrcsi_patch_add_point(&part, brdf, u == 0 ? at_u : at_v, u == 0 ? at_v : at_u,
                                          share * weight_s[k], patch);
        }
        if (!found) {
            return HUGE_VAL;
        }
    }
    return (error[0] + error[1]) * (visible.half[v] / strip->half[v]);
}

double lrcsi_patch_cut_add(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double target,
                           double fraction, lrcsi_patch *patch)
{
    const rectangle whole = rectangle_of(f);
    const lrcsi_rim_value at = lrcsi_rim_shadow_at(f->shadow, f->alpha, f->phi);
    const int u = fabs(at.slope[0]) * f->step < fabs(at.slope[1]) * f->half ? 0 : 1;
    const int v = 1 - u;
    double least[2];
    for (int k = 0; k < 2; k++) {
        least[k] =
            fabs(at.slope[k]) - lrcsi_rim_shadow_slope_change(f->shadow, k, f->step, f->half);
    }
    if (!(least[v] > 0)) {
        return HUGE_VAL;
    }
    const double low = whole.middle[v] - whole.half[v];
    const double high = whole.middle[v] + whole.half[v];
    double limit[4] = {whole.middle[u] - whole.half[u]}; /* of the strips */
    int strips = 1;
    for (int i = 0; i < 2; i++) {
        const int count =
            side_crossing(f, &whole, u, i == 0 ? low : high, least[u] > 0, &limit[strips]);
        if (count < 0) {
            return HUGE_VAL;
        }
        strips += count;
    }
    lrcsi_sort_ascending(limit + 1, (uint32_t)strips - 1);
    limit[strips] = whole.middle[u] + whole.half[u];
    double remainder =
        2 * f->shadow->err / (least[v] * whole.half[v]) * lrcsi_patch_largest(f, brdf);
    for (int i = 0; i < strips; i++) {
        rectangle strip = whole;
        strip.middle[u] = 0.5 * (limit[i] + limit[i + 1]);
        strip.half[u] = 0.5 * (limit[i + 1] - limit[i]);
        const double share = strip.half[u] / whole.half[u];
        const int low_is_visible = value_at(f, u, strip.middle[u], low).value > 0;
        const int high_is_visible = value_at(f, u, strip.middle[u], high).value > 0;
        if (!(share > 0) || !(low_is_visible || high_is_visible)) {
            continue;
        }
        if (low_is_visible && high_is_visible) {
            const lrcsi_mean_rule *rule[2];
            const lrcsi_patch_frame part = frame_of(f, &strip);
            remainder += share * lrcsi_patch_rules(&part, brdf, target, rule);
            if (!lrcsi_patch_add_points(&part, brdf, rule, fraction * share, patch)) {
                return HUGE_VAL;
            }
        } else {
            remainder += share * strip_add(f, brdf, &strip, u, low_is_visible ? low : high, target,
                                           fraction * share, patch);
        }
        if (!(remainder < HUGE_VAL)) {
            return HUGE_VAL;
        }
    }
    return remainder * LRCSI_OUTWARD_NANO;
}
