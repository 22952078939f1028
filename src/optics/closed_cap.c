/* SPDX-License-Identifier: MIT */
/* Bodies whose normals fill a cap about the axis, once each: sphere, dome, paraboloid. It decides
   which of the normals are lit; except for the sphere, the integrals are over circles about the
   laser.

   The normals within tau of +z (dome: pi/2; paraboloid: atan(2 H / R)) carry a surface of
   dA = R^2 dOmega (dome), K n_z^-4 dOmega with K = (R^2 / 2 H)^2 (paraboloid: 1/K n_z^4 is its
   Gaussian curvature). With theta and phi about the laser, at alpha from +z,
     integral of F dA = integral over theta of F(theta) sin(theta) Phi(theta),
   Phi the integral over the azimuths phi whose normal lies in the cap: all, if
   theta < tau - alpha; else |phi| < phi_1, by the half-angle formula of the triangle with sides
   theta, alpha, tau:
     tan^2(phi_1/2) = sin((tau+theta-alpha)/2) sin((tau+alpha-theta)/2) /
                      (sin((alpha+theta+tau)/2) sin((alpha+theta-tau)/2)).
   Each of these four angles is a sum of positive ones if theta is measured from the nearer end.
   From theta_d = |tau - alpha| on, phi_1/2 is the arctangent, or a right angle less the arctangent,
   of the root of theta - theta_d times an analytic function: the numerator and denominator add up
   to sin(theta) sin(alpha), so that nothing else is singular nearer than theta = 0.

   Paraboloid: n_z = P + Q cos(phi), P = cos(alpha) cos(theta), Q = sin(alpha) sin(theta). With
   kappa = (P - Q)/(P + Q), tan(phi/2) = tan(sqrt(kappa) y / 2)/sqrt(kappa) and
   S = sin^2(sqrt(kappa) y / 2)/kappa (for kappa < 0 their hyperbolic counterparts) one finds
     dphi / n_z^4 = (1 + 2 S Q/(P + Q))^3 dy / (P + Q)^4,  n_z = (P + Q)/(1 + 2 S Q/(P + Q)),
   an entire function of y with positive terms only, smooth across kappa = 0. */
#include <math.h>

#include "base/constant.h"
#include "optics/closed_arc.h"
#include "optics/special.h"

/* The longest panel, in y sqrt(-kappa), for one Gauss rule. */
#define CAP_PANEL_LENGTH 3.0

/* lrcsi_arc.left_smooth and right_smooth as fractions of the distance of the nearest singularity
   beyond that end. From the first, closed_arc.c derives how far the integrand is analytic about a
   square root; at the other end it falls, and the ellipse may be flatter. */
#define CAP_SMOOTH_LEFT  0.15
#define CAP_SMOOTH_RIGHT 0.25

/* sigma = 4 pi^2 R^2 A E + 8 pi^2 R^2 B / (m + 3), E = s^2 + (sqrt(pi)/2) s^3 erfcx(1/s): the
   integrals of F over a hemisphere of normals. */
lrcsi_term_integrals lrcsi_closed_sphere(const lrcs_shape *shape, const lrcs_brdf *brdf)
{
    double s = brdf->s;
    double width = s > 0.0 ? 1.0 + 0.5 * sqrt(LRCS_PI) * s * lrcsi_special_erfcx(1.0 / s) : 0.0;
    const double factor[LRCSI_TERMS] = {s * s * width, 2.0 / (brdf->m + 3.0)};
    lrcsi_term_integrals amount = {{brdf->A, brdf->B}, {0.0, 0.0}};
    amount.error[LRCSI_GLINT] = LRCSI_U * brdf->A;
    amount.error[LRCSI_DIFFUSE] = LRCSI_U * brdf->B;
    lrcsi_closed_scale_terms(&amount, factor, 22.0);
    lrcsi_closed_scale(&amount, LRCS_PI * shape->radius * shape->radius, 3.0);
    return amount;
}

/* The 14-point Gauss-Legendre rule, in the form of lrcsi_gauss_rule. */
#define CAP_PAIRS 7
static const double cap_rule[CAP_PAIRS][2] = {
    {0x1.ba97d36de76b0p-4, 0x1.b8dc415514e34p-3}, {0x1.46c564912d702p-2, 0x1.a43f1796fab09p-3},
    {0x1.07ceab54ef096p-1, 0x1.7bfb8e2a8f57ep-3}, {0x1.5fe4db09e0c89p-1, 0x1.41f3bbee2d2f2p-3},
    {0x1.a786ee46dd9c4p-1, 0x1.f1bd74ef611c1p-4}, {0x1.db5bd12b99e9fp-1, 0x1.4853d8adc703dp-4},
    {0x1.f8fa30fddab0bp-1, 0x1.1fb2d8b27f553p-5}};

/* The integral over y sqrt(|kappa|) = low .. high of (g + 2 g r S)^3; r = Q/(P+Q), g = n_0/(P+Q).
   That is a polynomial of degree 3 in the cosine or the hyperbolic cosine, over no more than pi: 14
   points have an error of (3 pi/2)^28 2^29 (14!)^4 / (29 (28!)^3), 3e-19 of its largest term, which
   is at most 20 times the integral. */
static double cap_weight_panel(double kappa, double low, double high, double g, double r)
{
    double root = sqrt(fabs(kappa));
    double half = 0.5 * (high - low);
    double sum = 0.0;
    for (int i = 0; i < 2 * CAP_PAIRS; i++) {
        const double *rule = cap_rule[i / 2];
        double at = 0.5 * (low + half + (i % 2 ? half : -half) * rule[0]);
        double sine = (kappa < 0.0 ? sinh(at) : sin(at)) / root;
        double n = g * (1.0 + 2.0 * r * sine * sine);
        sum += rule[1] * n * n * n;
    }
    return half * sum;
}

/* Phi, weighted with (n_0/n_z)^4, over the arc |phi| < phi_1 with w2 = tan^2(phi_1/2); n_max is
   P + Q and n_min is P - Q. For kappa < 0, 1 + kappa w2 = n_0 (1 + w2)/(P + Q) without
   cancellation, and the integrand grows exponentially: panels are added from the far end until the
   next is below 2^-60 of the sum. */
static double cap_weight_arc(double n_max, double n_min, double q, double n_0, double w2)
{
    double kappa = n_min != 0.0 ? n_min / n_max : 0x1p-1000;
    double g = n_0 / n_max;
    double r = q / n_max;
    double z = sqrt(fabs(kappa) * w2);
    double end = 2.0 * atan(z); /* of y sqrt(|kappa|) */
    int panels = 1;
    if (kappa < 0.0) {
        double complement = g * (1.0 + w2); /* 1 - z^2 */
        end = complement > 0.5 ? 2.0 * atanh(z) : 2.0 * log1p(z) - log(complement);
        panels = 1 + (int)(end / CAP_PANEL_LENGTH);
    }
    double sum = 0.0;
    for (int i = 0; i < panels; i++) {
        double high = end - i * CAP_PANEL_LENGTH;
        double low = i + 1 < panels ? high - CAP_PANEL_LENGTH : 0.0;
        double panel = cap_weight_panel(kappa, low, high, g, r);
        sum += panel;
        if (panel <= 0x1p-60 * sum) {
            break;
        }
    }
    return 2.0 * (sum / sqrt(fabs(kappa)) * g);
}

/* Phi at theta = start + delta = end - h (outer), sine and cosine of theta given. */
static double cap_outer_weight(const lrcsi_cap *cap, double delta, double h, double sine,
                               double cosine)
{
    double inward = cap->laser_inside ? 2.0 * cap->start + delta : delta;  /* tau + theta - alpha */
    double outward = cap->laser_inside ? delta : 2.0 * cap->start + delta; /* alpha + theta - tau */
    double first = sin(0.5 * inward) * sin(0.5 * (cap->horizon ? cap->gap + h : h));
    double second = sin(0.5 * outward) *
                    (cap->horizon ? sin(0.5 * (cap->supplement + h)) : sin(cap->end - 0.5 * h));
    if (!cap->paraboloid) {
        return 4.0 * atan2(sqrt(first), sqrt(second));
    }
    double n_max = cap->cos_alpha >= 0.0 ? cap->cos_alpha * cosine + cap->sin_alpha * sine
                                         : cap->n_0 * cos(delta) + cap->sin_tau * sin(delta);
    double n_min = cap->n_0 * cos(outward) - cap->sin_tau * sin(outward);
    return cap_weight_arc(n_max, n_min, cap->sin_alpha * sine, cap->n_0, first / second);
}

/* Phi over the whole circle at theta = end - h. For the paraboloid kappa > 0: (a - b cos E)^3
   integrated over a half turn. */
static double cap_inner_weight(const lrcsi_cap *cap, double h, double sine, double cosine)
{
    if (!cap->paraboloid) {
        return 2.0 * LRCS_PI;
    }
    double n_max = cap->cos_alpha * cosine + cap->sin_alpha * sine;
    double n_min = cap->n_0 * cos(h) + cap->sin_tau * sin(h); /* cos(tau - h) */
    double g = cap->n_0 / n_max;
    double a = 0.5 * g * ((n_max + n_min) / n_min);
    double b = g * (cap->sin_alpha * sine / n_min);
    return 2.0 * LRCS_PI * sqrt(g) * sqrt(cap->n_0 / n_min) * (a * a * a + 1.5 * a * b * b);
}

lrcsi_arc_point lrcsi_cap_point(const lrcsi_arc *arc, int right, double d)
{
    const lrcsi_cap *cap = &arc->cap;
    double delta = right ? arc->length - d : d;
    double h = right ? d : arc->length - d;
    double half = sin(0.5 * delta);
    double cos_from_end = cap->horizon && !cap->full_circle
                              ? sin(h)
                              : cap->cos_end * cos(h) + cap->sin_end * sin(h); /* cos(end - h) */
    if (cap->full_circle) {
        double cosine = right ? cos_from_end : cos(delta);
        lrcsi_arc_point at = {2.0 * half * half, cosine, 0.0};
        if (cosine > 0.0) {
            at.weight = sin(delta) * cap_inner_weight(cap, h, sin(delta), cosine);
        }
        return at;
    }
    double y = 2.0 * half * half + cap->sin_start / cap->cos_start * sin(delta);
    double q = right ? cos_from_end / cap->cos_start : 1.0 - y;
    lrcsi_arc_point at = {y, q, 0.0};
    if (q > 0.0) {
        double sine = sin(cap->start + delta);
        at.weight = sine * cap_outer_weight(cap, delta, h, sine, q * cap->cos_start);
    }
    return at;
}

/* What distinguishes the caps of dome and paraboloid: the normals' radius tau, and the surface per
   solid angle of normals, `scale`^2 times the weight of a direction; `area` in all. */
typedef struct cap_body {
    lrcsi_angle tau;
    int paraboloid;
    double scale, area;
} cap_body;

/* sum += the integral over one interval of theta, which starts at theta_r, nearest to the laser.
   Values that underflow there are smaller still elsewhere, over at most the whole area. Units: the
   interval's ends 10, its weight 20, scale 10, the arc. */
static void cap_add_interval(const lrcs_brdf *brdf, const cap_body *body, lrcsi_arc *arc,
                             lrcsi_angle theta_r, lrcsi_term_integrals *sum)
{
    lrcsi_term_integrals amount = lrcsi_closed_reflect(brdf, theta_r);
    double factor[LRCSI_TERMS] = {body->area, body->area};
    double integral[LRCSI_TERMS];
    for (int term = 0; term < LRCSI_TERMS; term++) {
        arc->requested[term] = amount.value[term] > 0.0;
        arc->integrand[term] = lrcsi_arc_integrand_make(brdf, term, theta_r.cosine.hi);
    }
    if (arc->requested[LRCSI_GLINT] || arc->requested[LRCSI_DIFFUSE]) {
        lrcsi_arc_integral(arc, integral);
    }
    for (int term = 0; term < LRCSI_TERMS; term++) {
        if (arc->requested[term]) {
            factor[term] = integral[term] * body->scale * body->scale;
        }
    }
    lrcsi_closed_scale_terms(&amount, factor, LRCSI_ARC_UNITS + 40.0);
    lrcsi_closed_add(sum, &amount);
}

/* Two intervals of theta: whole circles up to |tau - alpha|, where the laser is inside the cap of
   normals; then arcs up to tau + alpha or the horizon. n_z is regular within pi/2 - tau
   (`weight_scale`) of what is lit. */
static lrcsi_term_integrals cap_integral(const lrcs_brdf *brdf, const lrcsi_laser_direction *laser,
                                         const cap_body *body)
{
    const lrcsi_angle zero = {{0.0, 0.0}, {1.0, 0.0}};
    lrcsi_angle start = lrcsi_closed_angle_difference(body->tau, laser->aspect);
    lrcsi_angle end = lrcsi_closed_angle_sum(body->tau, laser->aspect);
    int laser_inside = start.sine.hi > 0.0;
    if (!laser_inside) {
        start.sine = lrcsi_dd_negate(start.sine); /* |tau - alpha| */
    }
    double beyond = 0.0 - end.cosine.hi; /* +0, not -0, where the end is the horizon */
    lrcsi_arc arc = {.is_cap = 1,
                     .cap = {.laser_inside = laser_inside,
                             .horizon = !(end.cosine.hi > 0.0),
                             .paraboloid = body->paraboloid,
                             .sin_start = start.sine.hi,
                             .cos_start = start.cosine.hi,
                             .start = lrcsi_closed_radians(start),
                             .end = lrcsi_closed_radians(end),
                             .gap = atan2(beyond, end.sine.hi),
                             .supplement = atan2(beyond, -end.sine.hi),
                             .sin_alpha = laser->aspect.sine.hi,
                             .cos_alpha = laser->aspect.cosine.hi,
                             .sin_tau = body->tau.sine.hi,
                             .n_0 = body->tau.cosine.hi}};
    lrcsi_cap *cap = &arc.cap;
    lrcsi_term_integrals sum = {{0.0, 0.0}, {0.0, 0.0}};
    arc.weight_scale = body->paraboloid ? atan2(cap->n_0, cap->sin_tau) : LRCS_PI;
    if (cap->laser_inside) {
        cap->full_circle = 1;
        cap->sin_end = cap->sin_start;
        cap->cos_end = cap->cos_start;
        arc.length = arc.left_smooth = cap->start;
        arc.right_smooth = CAP_SMOOTH_RIGHT * fmin(cap->cos_start, arc.weight_scale);
        cap_add_interval(brdf, body, &arc, zero, &sum);
    }
    cap->full_circle = 0;
    cap->sin_end = end.sine.hi;
    cap->cos_end = end.cosine.hi;
    arc.right_smooth = 0.0;
    arc.length = 2.0 * fmin(lrcsi_closed_radians(laser->aspect), lrcsi_closed_radians(body->tau));
    if (cap->horizon) {
        arc.length = atan2(cap->cos_start, cap->sin_start); /* pi/2 - start */
    }
    arc.left_root = 1;
    arc.left_smooth = CAP_SMOOTH_LEFT * fmin(fmin(cap->start, arc.length), arc.weight_scale);
    cap_add_interval(brdf, body, &arc, start, &sum);
    return sum;
}

lrcsi_term_integrals lrcsi_closed_dome(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                       const lrcsi_laser_direction *laser)
{
    double radius = shape->radius;
    cap_body body = {{{1.0, 0.0}, {0.0, 0.0}}, 0, radius, 2.0 * LRCS_PI * radius * radius};
    return cap_integral(brdf, laser, &body);
}

/* K n_0^-4 = ((R^2 + 4 H^2)/(2 H))^2. A paraboloid flatter than 2^-480 is its disc: its normals
   turn by less than 2^-478, which moves F by less than a unit for s > 2^-333. Its area is at most
   pi R^2 sqrt(1 + T^2), T = 2 H / R. */
lrcsi_term_integrals lrcsi_closed_paraboloid(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                             const lrcsi_laser_direction *laser)
{
    double radius = shape->radius;
    double height = shape->length;
    if (height <= 0x1p-480 * radius || radius == 0.0) {
        lrcsi_term_integrals flat = lrcsi_closed_reflect(brdf, laser->aspect);
        lrcsi_closed_scale(&flat, LRCS_PI * radius * radius, 4.0);
        return flat;
    }
    lrcsi_dd r = {radius, 0.0};
    lrcsi_dd h = {2.0 * height, 0.0};
    lrcsi_dd hyp = lrcsi_closed_hypot(r, h);
    cap_body body = {{lrcsi_dd_div(h, hyp), lrcsi_dd_div(r, hyp)},
                     1,
                     hyp.hi * (hyp.hi / h.hi),
                     LRCS_PI * radius * hyp.hi};
    return cap_integral(brdf, laser, &body);
}
